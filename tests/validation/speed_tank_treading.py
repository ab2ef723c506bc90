# SPDX-License-Identifier: MPL-2.0
"""Speed against error: the frequency of a tank-treading red cell, over everything a scene can choose.

131.6 1/s in 28.9 mPa s, Re = 0.2, gdot t from 6 to 15. There is no exact answer: errors are against runs at dx = 0.25
and 0.4 um carried on to 0. Time: processor seconds per simulated millisecond, one thread. Choices as in Q1.
"""
from npfem.validation import Case
from npfem.validation.trade_off import TankTreadingTrial, report_trade_off

CASE = Case(id="Q2", title="Speed against error: tank-treading red cell", tier="release", cost_s=900,
            source="own runs, extrapolated to dx = 0")


def run(report):
    """All choices."""
    report_trade_off(report, TankTreadingTrial())
