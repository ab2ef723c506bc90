# SPDX-License-Identifier: MPL-2.0
"""Order in time of the coupling: D of a capsule at gdot t = 1 over the time step, that is over tau.

Ca = 0.3, radius 5 nodes, Re = 0.02, tau from 0.875 to 6.5. With TRT the steady flow does not depend on tau, so what is
left is the coupling in time, of first order (implicit Euler, forces held over a step), and the compressibility of the
lattice, of second. Each halving of the step must take the change of D down by 2^0.8 at least.
"""
import math

from npfem.validation import Case
from npfem.validation.capsule_scene import shear_capsule

CASE = Case(id="C6", title="Capsule: order in time", tier="nightly", cost_s=60,
            source="order of the scheme: docs/theory.md")


def run(report):
    """Halves the time step four times."""
    steps = [8, 4, 2, 1]
    result = [shear_capsule(report, "step%d" % step, 0.3, 1.0, radius=5, reynolds_number=0.02,
                            relaxation_time=0.5 + 0.375 * step).deformation[-1] for step in [16] + steps]
    changes = [abs(coarse - fine) for coarse, fine in zip(result, result[1:])]
    order = math.log2(changes[0] / changes[-1]) / (len(changes) - 1)
    report.below("ratio of the changes of D from one halving of the step to the next", 2 ** -order, 2 ** -0.8)
    report.measured("order in time", order)
    report.below("D at tau = 2 against the limit of small steps", 100 * (result[2] / result[-1] - 1), 2, unit="%")
    plot = report.plot("Capsule: D at gdot t = 1 over the time step", "time step (tau - 1/2)", "D", x_log=True)
    report.curve(plot, "implicit coupling", [0.375 * step for step in [16] + steps], result)
