# SPDX-License-Identifier: MPL-2.0
"""Does the membrane move with the fluid, however stiff it is and however seldom it is solved?

A capsule (neo-Hookean, radius 5 nodes, tau = 1, Re = 0.2) in shear, from Ca = 0.3, soft, to 3e-4, as good as rigid.
Beside its path the coupling `implicit` has an error that a tracer would show: over one step of the cells each vertex
moves by v delta, a tracer by the mean of the fluid's velocity at both ends. The largest difference over all vertices,
relative to rate times radius, is the slip; the scheme `peskin`, which moves the vertices with the fluid by
definition, is measured alike while it is stable. Both differ from the tracer by what the flow changes within half a
step, rate delta/4 or so (0.03 % at k = 1): where `implicit` is no worse than that, it has no slip of its own.

What moves with the fluid are the markers at which fluid and membrane meet: the vertices with inset = 0, and by default
points x - d n S0/S under the surface (npfem's theory, 7), whose slip is measured alike.

The slip that `implicit` does have is delta dF/m, dF what the force on a vertex of ambient mass m changes by in a
solve: it comes and goes with the force and adds up to nothing, unlike a leak.

Allowed: 0.1 % at k = 1, the figure of the prototype of this coupling (a scheme without the held force slips by 3.5 %
at once and loses 5.6 % of the volume); 0.5 % at k = 5, what is asked of direct forcing with five iterations of
its force. The volume lost to rate t = 1 may not exceed 0.2 % at k = 1: that is the compliance and the compressible
fluid, not a leak. Known weakness: a short run; the long one is C7.
"""
import os

import numpy

from npfem.validation import Case, read_csv, run_scene
from npfem.vtk_files import read_pvd, read_vti, read_vtu

CASE = Case(id="I3", title="Slip between membrane and fluid", tier="ci", cost_s=6,
            source="what the coupling promises; a tracer has no slip")

RADIUS, RATE = 5.0, 0.2 / 25  # um, 1/us; one node spacing is 1 um, nu 1 um2/us
TIME_STEP = 1 / 6  # us: tau = 1
DEFAULT_INSET = 0.485  # nodes: that of the 4-point kernel

MATERIAL = """schema_version = 1
name = "capsule"
[mesh]
shape = "icosphere"
level = 2
diameter = "10 um"
[parameters]
membrane_law = "neo_hookean"
shear_modulus = "%.9g uN/m"
[sources]
"""
SCENE = """schema_version = 1
[domain]
kind = "shear_box"
size = ["30 um", "30 um", "30 um"]
dx = "1 um"
[fluid]
density = "1000 kg/m3"
kinematic_viscosity = "1 mm2/s"
tau = 1
[flow]
shear_rate = "%.17g 1/us"
start = "developed"
[[cells]]
name = "capsule"
material = "capsule_%s.toml"
positions = [ { centre = ["15.21 um", "15.21 um", "15.21 um"] } ]
[coupling]
scheme = "%s"
cell_every = %d
inset = %g
[solver]
tolerance = "%.3g pN"
newton_iterations = 0
[output]
cells_every = "%.17g us"
fluid_every = "%.17g us"
table_every = "%.17g us"
[run]
steps = %d
"""
SOFT = ("a soft capsule still deforms at rate t = 1: the force on a vertex changes by dF in a solve and moves it past "
        "the fluid by delta dF/m, which the forces of the run make 0.75 % of the 0.83 %, and 0.04 of 0.06 % at k = 1")
SERIES = ("0.06 % is that of the vertices, which deform; the rest, it seems, the series from markers to vertices, "
          "which ends with the third order")


def weights(offset):
    """Of the 4-point kernel on the nodes -1, 0, 1, 2, for the share `offset` between 0 and 1 (Peskin 2002)."""
    near = lambda r: (3 - 2 * r + numpy.sqrt(1 + 4 * r - 4 * r * r)) / 8
    far = lambda r: (5 - 2 * r - numpy.sqrt(numpy.maximum(0, -7 + 12 * r - 4 * r * r))) / 8
    return numpy.array([far(1 + offset), near(offset), near(1 - offset), far(2 - offset)])


def fluid_at(grid, points):
    """Velocity of the fluid at points away from the faces of the box."""
    place = (points - grid.origin) / grid.spacing
    below = numpy.floor(place).astype(int)
    share = [weights(place[:, axis] - below[:, axis]) for axis in range(3)]
    velocity = numpy.zeros(points.shape)
    for i, j, k in numpy.ndindex(4, 4, 4):
        nodes = grid.data["velocity_um_per_us"][below[:, 0] + i - 1, below[:, 1] + j - 1, below[:, 2] + k - 1]
        velocity += (share[0][i] * share[1][j] * share[2][k])[:, None] * nodes
    return velocity


def markers(cell, at_rest, inset):
    """Where fluid and membrane meet: `inset` under the vertices, by as much more as the surface there has shrunk."""
    def areas(points):
        a, b, c = (points[cell.triangles[:, corner]] for corner in range(3))
        sums = numpy.zeros(points.shape)
        for corner in range(3):
            numpy.add.at(sums, cell.triangles[:, corner], numpy.cross(b - a, c - a))
        return sums

    area = areas(cell.points)
    swelling = numpy.linalg.norm(areas(at_rest.points), axis=1) / (area**2).sum(axis=1)
    return cell.points - inset * swelling[:, None] * area


def slip_and_volume(report, scheme, every, capillary, inset=0.0):
    """Largest slip in the last step of the cells, and change of volume until then, both in %; None where it is lost."""
    modulus = 1000 * RATE * RADIUS / capillary
    with open(os.path.join(report.folder, "capsule_%g.toml" % capillary), "w", encoding="utf-8") as stream:
        stream.write(MATERIAL % modulus)
    before = round(1 / RATE / TIME_STEP / every) * every
    time = before * TIME_STEP
    tolerance = max(1e-4 * 1000 * RATE, 1e-9 * modulus * RADIUS)
    scene = SCENE % (RATE, "%g" % capillary, scheme, every, inset, tolerance, time, time, time, before + every)
    folder = run_scene(report, "%s_%d_%g_%g" % (scheme, every, capillary, inset), scene, accept=(0, 3), threads=1)
    cells = [read_vtu(path) for _, path in read_pvd(os.path.join(folder, "cells.pvd"))]
    fluid = [read_vti(path) for _, path in read_pvd(os.path.join(folder, "fluid.pvd"))]
    if len(cells) != 3 or not numpy.isfinite(cells[-1].points).all():
        return None
    before_step, after_step = (markers(cell, cells[0], inset) for cell in cells[1:])
    moved = (after_step - before_step) / (every * TIME_STEP)
    tracer = 0.5 * (fluid_at(fluid[1], before_step) + fluid_at(fluid[2], after_step))
    slip = numpy.linalg.norm(moved - tracer, axis=1).max() / (RATE * RADIUS)
    volume = read_csv(os.path.join(folder, "cells.csv"))["volume_um3"]
    return 100 * slip, 100 * (volume[-1] / volume[0] - 1)


def run(report):
    """Stiffnesses and steps per solve, then the yardstick."""
    stiffness = (0.3, 0.03, 0.0003)
    plot = report.plot("Slip of the vertices", "Ca = mu rate a / G_s", "largest slip / (rate a) (%)", x_log=True,
                       y_log=True)
    for every, allowed in ((1, 0.1), (5, 0.5)):
        slips = []
        for capillary in stiffness:
            slip, volume = slip_and_volume(report, "implicit", every, capillary)
            slips.append(slip)
            report.below("slip, implicit, Ca %g, k = %d" % (capillary, every), slip, allowed, unit="%",
                         known_failure=SOFT if (every, capillary) == (5, 0.3) else "")
            if every == 1:
                report.below("change of volume, implicit, Ca %g, k = 1" % capillary, volume, 0.2, unit="%")
            else:
                report.measured("change of volume, implicit, Ca %g, k = %d" % (capillary, every), volume, unit="%")
        report.curve(plot, "implicit, k = %d" % every, stiffness, slips)
    for capillary in stiffness:
        slip, volume = slip_and_volume(report, "implicit", 1, capillary, DEFAULT_INSET)
        report.below("slip of markers under the surface, implicit, Ca %g, k = 1" % capillary, slip, 0.1, unit="%",
                     known_failure=SERIES if capillary == 0.3 else "")
        report.below("change of volume with them, Ca %g, k = 1" % capillary, volume, 0.2, unit="%")
    for every in (1, 5):
        found = [(capillary, slip_and_volume(report, "peskin", every, capillary)) for capillary in stiffness]
        kept = [(capillary, both) for capillary, both in found if both is not None]
        for capillary, (slip, volume) in kept:
            report.measured("slip, peskin, Ca %g, k = %d" % (capillary, every), slip, unit="%")
            report.measured("change of volume, peskin, Ca %g, k = %d" % (capillary, every), volume, unit="%")
        report.measured("runs of peskin that were lost, k = %d" % every, len(found) - len(kept))
        report.curve(plot, "peskin, k = %d" % every, [c for c, _ in kept], [both[0] for _, both in kept], points=True)
