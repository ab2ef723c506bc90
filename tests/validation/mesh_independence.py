# SPDX-License-Identifier: MPL-2.0
"""The red cell in tweezers on three meshes with one set of parameters.

Proves that a material belongs to the cell and not to the mesh. The shipped `rbc`, rigid contacts 2 um across, on 258,
1026 and 4098 vertices, at five forces of Mills et al. (2004). Diameters on the coarser meshes are held against those on
4098 vertices: 1.5 % axial and 3 % transverse allowed at every force. A rigid contact keeps from straining the triangles
that lie within it whole. A disc of one size holds 2.05, 2.28 and 2.96 um2 of the three meshes, and the cell is the longer
the less of it is held: so the discs are 2, 1.8 and 1.7 um wide here, which hold the same area, printed below. Weakness: at
forces near zero the error is that of the size of the mesh itself, 0.8 % of the radius at 258 vertices.
"""
import npfem
from npfem.tweezers import contact_vertices, held_area
from npfem.validation import Case

CASE = Case(id="S12", title="Mesh independence of the red cell", tier="nightly", cost_s=120,
            source="our own finest mesh; the claim of mesh-independent parameters is that of npFEM (Kotsalos et al. 2019)")

FORCES_PN = (0.0, 31.0, 67.6, 109.0, 150.7, 193.0)
# Level of the mesh: (vertices, diameter of the contact in um).
LEVELS = {3: (258, 2.0), 4: (1026, 1.8), 5: (4098, 1.7)}


def run(report):
    """Three meshes."""
    plot = report.plot("The red cell in tweezers on three meshes", "force on each side (pN)", "diameter (um)")
    curves = {}
    for level, (count, contact_um) in LEVELS.items():
        with npfem.Material.preset("rbc") as cell, cell.mesh(level) as mesh:
            held = contact_vertices(mesh.positions, contact_um)[0]
            report.measured("membrane held by a contact %g um wide, %d vertices" % (contact_um, count),
                            held_area(mesh.positions, mesh.triangles, held), unit="um2")
        rows = npfem.stretch("rbc", FORCES_PN, level=level, contact_diameter_um=contact_um)
        if not rows[-1]["usable"]:
            raise RuntimeError("%d vertices, %g pN: %s" % (count, rows[-1]["force_pN"], rows[-1]["message"]))
        curves[count] = rows
        for key in ("axial_um", "transverse_um"):
            report.curve(plot, "%s, %d vertices" % (key.split("_")[0], count), FORCES_PN, [row[key] for row in rows])
    for count in (258, 1026):
        for key, tolerance in (("axial_um", 1.5), ("transverse_um", 3.0)):
            errors = [100 * (row[key] / fine[key] - 1) for row, fine in zip(curves[count], curves[4098])]
            report.below("%s diameter on %d vertices against 4098, largest over the forces"
                         % (key.split("_")[0], count), max(errors, key=abs), tolerance, unit="%")
