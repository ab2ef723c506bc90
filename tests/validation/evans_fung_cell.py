# SPDX-License-Identifier: MPL-2.0
"""The Evans-Fung red cell: its size, its thickness, its bending energy.

Proves the shape generator and the bending operators on a shape with both signs of curvature. The meshes of the library
(258, 1026, 4098 vertices) and, to meet published figures at 2562, an icosphere carried onto the same shape. Vertices
lie on the surface, so flat triangles lack area and volume in the order h^2: 2 % is allowed at 258 vertices, 0.3 % at
2562. The lineage's mesh of 258 vertices is the same one: A = 131.87 um2, V = 91.80 um3.

Reference: A = 134.09 um2, V = 94.09 um3, reduced volume 0.6444, thickness 2.5657 um at most and 0.810 um in the
middle, bending energy 1.9287 x 8 pi kappa, integrals of the closed form with R0 = 3.91 um. The energy of the cotangent
operator is held to 1 % at 4098 vertices; at 258, 4 % are missing, and a cell on that mesh bends by so much more
easily. Weakness: one shape.
"""
import numpy

from npfem.validation import Case
from npfem.validation.membranes import area_and_volume, evans_fung, order, single_cell, sphere_energy, unit_sphere

CASE = Case(id="S8", title="The Evans-Fung red cell", tier="ci", cost_s=2,
            source="Evans & Fung, Microvasc. Res. 4 (1972) 335")

AREA_UM2, VOLUME_UM3, BENDING = 134.09, 94.09, 1.9287
MODULUS = 0.3  # pN um


def bending(law, shape, triangles):
    """Energy over 8 pi kappa."""
    batch = single_cell(shape, triangles, bending_law=law, bending_modulus=MODULUS, rest_angles="flat")
    batch.evaluate()
    return batch.measure("energy")[0] / sphere_energy(MODULUS)


def sizes(report, name, shape, triangles, tolerance, known_failure=""):
    """Area, volume and reduced volume of one mesh."""
    area, volume = area_and_volume(shape, triangles)
    report.compare("area, " + name, area, AREA_UM2, relative=tolerance, unit="um2")
    report.compare("volume, " + name, volume, VOLUME_UM3, relative=tolerance, unit="um3", known_failure=known_failure)
    report.compare("reduced volume, " + name, 6 * numpy.sqrt(numpy.pi) * volume / area**1.5, 0.6444, relative=0.003)
    return area, volume


def run(report):
    """Sizes, thickness, energy."""
    plot = report.plot("Bending energy of the Evans-Fung cell", "vertices", "energy / 8 pi kappa", x_log=True)
    counts, found = [258, 1026, 4098], {}
    errors = []
    for level, count in zip((3, 4, 5), counts):
        with_sphere, triangles = unit_sphere("sphere", level)
        shape = evans_fung(with_sphere)
        if level == 3:
            sizes(report, "258 vertices", shape, triangles, 0.02,
                  "flat triangles with their corners on the surface lack 2.4 % of the volume, an error of second order "
                  "in h; the mesh is the lineage's, to five digits")
        errors.append(area_and_volume(shape, triangles)[1] / VOLUME_UM3 - 1)
        for law in ("cotangent", "juelicher", "dihedral"):
            found.setdefault(law, []).append(bending(law, shape, triangles))
    ico, triangles = unit_sphere("icosphere", 4)
    sizes(report, "2562 vertices", evans_fung(ico), triangles, 0.003)
    report.compare("order of convergence of the volume", order([4, 2, 1], errors), 2, absolute=0.1)
    thickness = shape[:, 2].max() - shape[:, 2].min()
    middle = numpy.hypot(shape[:, 0], shape[:, 1]) < 1e-9
    report.compare("largest thickness, 4098 vertices", thickness, 2.5657, relative=0.003, unit="um")
    report.compare("thickness in the middle", numpy.ptp(shape[middle, 2]), 0.810, relative=0.001, unit="um")
    report.compare("cotangent: energy / 8 pi kappa, 4098 vertices", found["cotangent"][2], BENDING, relative=0.01)
    report.compare("juelicher: energy / 8 pi kappa, 4098 vertices", found["juelicher"][2], BENDING, relative=0.01)
    for law, energies in found.items():
        for count, energy in zip(counts, energies):
            report.measured("%s: energy over the exact one, %d vertices" % (law, count), energy / BENDING)
        report.curve(plot, law, counts, energies)
    report.curve(plot, "continuum", counts, [BENDING] * 3)
