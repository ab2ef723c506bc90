# SPDX-License-Identifier: MPL-2.0
"""Flow through a round tube, whose wall is a staircase of half-way links: does it carry what Poiseuille's law says?

From rest until nothing changes any more (12 times the slowest decay time). The flow rate pi R^4 f/(8 mu) feels an
error of the radius four times; a staircase has one of a fraction of a node spacing, which changes with the diameter
without a trend of its own, hence 5 % at 20 and 2 % at 40 nodes across. With two relaxation times the flow does not
depend on tau.
"""
import math
import os

import numpy

from npfem.validation import Case, run_scene
from npfem.vtk_files import read_pvd, read_vti

CASE = Case(id="F5", title="Flow through a round tube", tier="ci", cost_s=2, source="Hagen-Poiseuille, closed form")

SCENE = """schema_version = 1
[domain]
kind = "tube"
diameter = "%d um"
length = "4 um"
dx = "1 um"
[fluid]
density = "1000 kg/m3"
kinematic_viscosity = "1 mm2/s"
tau = %g
[flow]
mean_velocity = "%.17g um/us"
[run]
steps = %d
"""


def flow_rate(report, diameter, tau):
    """Over that of the law, and the speed along a diameter over that in the middle."""
    viscosity, radius = (tau - 0.5) / 3, 0.5 * diameter
    steps = int(12 * radius ** 2 / (5.783 * viscosity))
    speed = 1e-4 / viscosity
    folder = run_scene(report, "tube_%d_%g" % (diameter, tau), SCENE % (diameter, tau, speed, steps), threads=1)
    velocity = read_vti(read_pvd(os.path.join(folder, "fluid.pvd"))[-1][1]).data["velocity_um_per_us"][:, :, 0, 2]
    return float(velocity.sum(dtype=float)) / (math.pi * radius ** 2 * speed), velocity[:, diameter // 2] / speed


def run(report):
    """Diameters of 20 and 40 nodes, three relaxation times."""
    plot = report.plot("Speed along a diameter", "distance from the axis over the radius", "speed over the mean")
    fine = numpy.linspace(-1, 1, 100)
    report.curve(plot, "Poiseuille", fine, 2 * (1 - fine ** 2))
    for diameter, allowed in ((20, 0.05), (40, 0.02)):
        rate, profile = flow_rate(report, diameter, 0.8)
        report.compare("flow rate over Poiseuille's, %d nodes across" % diameter, rate, 1.0, relative=allowed)
        report.curve(plot, "%d nodes across" % diameter, (numpy.arange(diameter) + 0.5) / (0.5 * diameter) - 1, profile,
                     points=True)
    report.compare("flow rate at tau = 2 over that at tau = 0.6, 20 nodes across",
                   flow_rate(report, 20, 2)[0] / flow_rate(report, 20, 0.6)[0], 1.0, relative=1e-4)
