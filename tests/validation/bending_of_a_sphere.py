# SPDX-License-Identifier: MPL-2.0
"""Bending energy of spheres: 8 pi kappa, whatever their size, and no force.

Proves the bending operators. Helfrich's energy (kappa/2) int (2H)^2 dA of any sphere is 8 pi kappa. Icospheres of 162,
642 and 2562 vertices and octahedral ones of 258, 1026, 4098, radii 0.5, 5 and 50 um. The cotangent and the Juelicher
operator tend to the continuum and are held to 1 % at 642 vertices; so is the cotangent one's order. The hinge
("dihedral") realises a share of the modulus that depends on the mesh and not on its fineness: shown, not judged.

A sphere bears no bending force. The energy has the same value at every size, so the power of the force in a swelling
is zero to round-off. The force on single vertices is not: around vertices with five neighbours, and where triangles
vary in shape, the energy of the mesh pulls vertices about; its size is shown, in kappa/R^3 per area, and along the
normal. Published operators differ strongly here.
"""
import numpy

from npfem.validation import Case
from npfem.validation.membranes import (order, pressure_directions, single_cell, sphere_energy, unit_sphere,
                                        vertex_areas)

CASE = Case(id="S7", title="Bending energy of a sphere", tier="ci", cost_s=1,
            source="Helfrich, Z. Naturforsch. C 28 (1973) 693: 8 pi kappa")

MODULUS = 0.3  # pN um


def bent(law, shape, level, radius_um):
    """(energy over 8 pi kappa, power in a swelling over the energy, rms normal force over kappa/R^3)."""
    sphere, triangles = unit_sphere(shape, level)
    x = radius_um * sphere
    batch = single_cell(x, triangles, bending_law=law, bending_modulus=MODULUS, rest_angles="flat")
    batch.evaluate()
    energy, force = batch.measure("energy")[0], batch.elastic_force[0]
    areas = vertex_areas(x, triangles)
    normals = pressure_directions(x, triangles)
    normals /= numpy.linalg.norm(normals, axis=1)[:, None]
    density = (force * normals).sum(axis=1) / areas
    rms = numpy.sqrt((areas * density**2).sum() / areas.sum()) * radius_um**3 / MODULUS
    return energy / sphere_energy(MODULUS), (force * x).sum() / energy, rms


def run(report):
    """Three operators on three meshes and three sizes."""
    plot = report.plot("Bending energy of a sphere", "vertices", "energy / 8 pi kappa", x_log=True)
    counts = [10 * 4**level + 2 for level in (2, 3, 4)]
    for law in ("cotangent", "juelicher", "dihedral"):
        found = [bent(law, "icosphere", level, 5.0) for level in (2, 3, 4)]
        sizes = [bent(law, "icosphere", 3, radius)[0] for radius in (0.5, 50.0)]
        report.curve(plot, law, counts, [energy for energy, _, _ in found])
        if law == "dihedral":
            for count, (energy, _, _) in zip(counts, found):
                report.measured("%s: energy / 8 pi kappa, %d vertices" % (law, count), energy)
        else:
            report.compare("%s: energy / 8 pi kappa, 642 vertices" % law, found[1][0], 1, relative=0.01)
            report.compare("%s: energy / 8 pi kappa, 1026 vertices, octahedral" % law, bent(law, "sphere", 4, 5.0)[0],
                           1, relative=0.01)
        if law == "cotangent":
            report.within("cotangent: order of convergence with the mesh",
                          order([4, 2, 1], [energy - 1 for energy, _, _ in found]), 1, 2.2)
        report.below("%s: change of the energy from radius 0.5 to 50 um" % law, sizes[1] / sizes[0] - 1, 1e-12)
        report.below("%s: power in a swelling, over the energy" % law, max(abs(power) for _, power, _ in found), 1e-12)
        for count, (_, _, rms) in zip(counts, found):
            report.measured("%s: rms normal force, %d vertices" % (law, count), rms, unit="kappa/R^3")
