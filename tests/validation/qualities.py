# SPDX-License-Identifier: MPL-2.0
"""The qualities that a scene can name, measured: error and time of `fast`, `balanced` and `accurate` in three scenes.

The scenes of Q1, Q2 and Q3, with resolution, time step, kernel, steps of the cells and precision of each quality; times per
simulated millisecond on this machine.
"""
from npfem.validation import Case
from npfem.validation.trade_off import CapsuleTrial, TankTreadingTrial, TubeTrial, report_qualities

CASE = Case(id="Q4", title="Qualities of a scene", tier="release", cost_s=900,
            source="own boundary integral; own runs, extrapolated to dx = 0")


def run(report):
    """Three scenes, three qualities each."""
    for trial in (CapsuleTrial(), TankTreadingTrial(), TubeTrial()):
        report_qualities(report, trial)
