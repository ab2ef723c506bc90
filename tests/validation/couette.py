# SPDX-License-Identifier: MPL-2.0
"""Flow between plates that slide past each other: linear, and the same stress on both, at every relaxation time.

The fluid starts at rest and is sheared until nothing changes any more (26 times the slowest decay time). Half-way
bounce-back with the momentum of a moving wall is then exact at every tau, so the relative viscosity of the plain
fluid, measured as the force on the plates, is 1 to 1e-10: forces on walls are summed in multiples of 2^-50, the same
on any number of ranks, which leaves as much. Profiles are written in single precision, hence 1e-7 for them. Known
weakness: plates along the lattice only.
"""
import math
import os

import numpy

from npfem.validation import Case, read_csv, run_scene
from npfem.vtk_files import read_pvd, read_vti

CASE = Case(id="F2", title="Flow between sliding plates", tier="ci", cost_s=1, source="closed form: u = rate y")

SCENE = """schema_version = 1
[domain]
kind = "shear_box"
size = ["4 um", "%d um", "4 um"]
dx = "1 um"
[fluid]
density = "1000 kg/m3"
kinematic_viscosity = "1 mm2/s"
tau = %g
[flow]
shear_rate = "%.17g 1/us"
[run]
steps = %d
"""
SPEED = 1e-3  # of the plates against each other, lattice units


def run(report):
    """Three gaps, five relaxation times."""
    stress = profile = 0.0
    for height, taus in ((8, (0.55, 0.6, 1, 2, 4)), (16, (0.6, 1, 2)), (32, (1, 2))):
        for tau in taus:
            viscosity = (tau - 0.5) / 3
            steps = int(26 * height ** 2 / (viscosity * math.pi ** 2)) + 200
            speed = SPEED / viscosity  # um/us: the time step is that many us
            folder = run_scene(report, "gap_%d_%g" % (height, tau), SCENE % (height, tau, speed / height, steps),
                               threads=1)
            ratio = read_csv(os.path.join(folder, "rheology.csv"))["relative_viscosity"][-1]
            stress = max(stress, abs(ratio - 1))
            grid = read_vti(read_pvd(os.path.join(folder, "fluid.pvd"))[-1][1])
            exact = (numpy.arange(height) + 0.5) / height - 0.5
            profile = max(profile, numpy.abs(grid.data["velocity_um_per_us"][0, :, 0, 0] / speed - exact).max())
    report.below("force on the plates, largest error of 10 runs", stress, 1e-10)
    report.below("profile, largest error over the speed of the plates", profile, 1e-7)
