# SPDX-License-Identifier: MPL-2.0
"""Flow between plates, driven by a body force: do walls stand where they should, at every relaxation time?

A fluid at rest is driven until nothing changes any more (22 times the slowest decay time). On the lattice the steady
flow is known in closed form: the parabola shifted everywhere by the slip (16 L - 3)/(3 H^2) of the speed in the middle,
H the distance of the plates in nodes and L the product of the two relaxation times less a half each (Ginzburg &
d'Humieres, Phys. Rev. E 68 (2003) 066614). Two relaxation times with L = 3/16, the default, make it zero; with one, L =
(tau - 1/2)^2, the walls slip by 17 % of the speed at tau = 2 and H = 8.

1e-8 of the mean flow is what is left of the start; profiles are written in single precision, hence 1e-7 for them. The
speed is 1e-5 of the lattice's, for the equilibrium is quadratic in it. Known weakness: plates along the lattice only;
a staircase wall is in the tube (F5).
"""
import math
import os

import numpy

from npfem.validation import Case, read_csv, run_scene
from npfem.vtk_files import read_pvd, read_vti

CASE = Case(id="F1", title="Flow between plates", tier="ci", cost_s=4,
            source="closed form; Ginzburg & d'Humieres, Phys. Rev. E 68 (2003) 066614")

SCENE = """schema_version = 1
[domain]
kind = "plates"
size = ["4 um", "%d um", "4 um"]
dx = "1 um"
[fluid]
density = "1000 kg/m3"
kinematic_viscosity = "1 mm2/s"
tau = %g
collision = "%s"
[flow]
centre_velocity = "%.17g um/us"
[run]
steps = %d
"""
SPEED = 1e-5  # in the middle, lattice units
TAUS = (0.6, 0.933, 1, 1.5, 2)


def steady_errors(report, height, tau, collision):
    """Of the mean flow and of the profile, relative to the speed in the middle, against the closed form."""
    viscosity = (tau - 0.5) / 3
    speed = SPEED / viscosity  # um/us: the time step is that many us
    steps = int(22 * height ** 2 / (viscosity * math.pi ** 2)) + 200
    name = "%s_%d_%g" % (collision, height, tau)
    folder = run_scene(report, name, SCENE % (height, tau, collision, speed, steps), threads=1)
    magic = 3 / 16 if collision == "trt" else (tau - 0.5) ** 2
    y = (numpy.arange(height) + 0.5) / height
    exact = 4 * y * (1 - y) + (16 * magic - 3) / (3 * height ** 2)
    mean = read_csv(os.path.join(folder, "rheology.csv"))["mean_velocity_um_per_us"][-1] / speed
    grid = read_vti(read_pvd(os.path.join(folder, "fluid.pvd"))[-1][1])
    profile = grid.data["velocity_um_per_us"][0, :, 0, 0] / speed
    return mean - exact.mean(), numpy.abs(profile - exact).max(), profile


def run(report):
    """Every gap at every relaxation time, with two and with one."""
    exact_mean = exact_profile = bgk_mean = bgk_profile = 0.0
    plot = report.plot("Slip at the walls, gap of 8 nodes", "relaxation time tau", "slip / speed in the middle")
    slips = {"trt": [], "bgk": []}
    for tau in TAUS:
        for height in (8, 16) if tau < 1 else (8, 16, 32):
            mean, profile, values = steady_errors(report, height, tau, "trt")
            exact_mean, exact_profile = max(exact_mean, abs(mean)), max(exact_profile, profile)
            if height == 8:
                slips["trt"].append(values[0] - 15 / 64)
        for height in (8, 16):
            mean, profile, values = steady_errors(report, height, tau, "bgk")
            bgk_mean, bgk_profile = max(bgk_mean, abs(mean)), max(bgk_profile, profile)
            if height == 8:
                slips["bgk"].append(values[0] - 15 / 64)
    report.below("two relaxation times: mean flow, largest error of 13 runs", exact_mean, 1e-8)
    report.below("two relaxation times: profile, largest error", exact_profile, 1e-7)
    report.below("one relaxation time: mean flow against the slip formula, 10 runs", bgk_mean, 1e-6)
    report.below("one relaxation time: profile against the slip formula", bgk_profile, 1e-6)
    report.compare("slip with one relaxation time at tau = 2, 8 nodes", slips["bgk"][-1], 33 / 192, relative=1e-5)
    fine = numpy.linspace(0.6, 2, 60)
    report.curve(plot, "formula, one relaxation time", fine, (16 * (fine - 0.5) ** 2 - 3) / 192)
    report.curve(plot, "one relaxation time", TAUS, slips["bgk"], points=True)
    report.curve(plot, "two relaxation times, the default", TAUS, slips["trt"], points=True)
