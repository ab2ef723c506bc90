# SPDX-License-Identifier: MPL-2.0
"""Speed against error: how far a tank-treading red cell has gone round, over everything a scene can choose.

131.6 1/s in 28.9 mPa s, Re = 0.2, from the shape at rest to gdot t = 15, a third of a turn. There is no exact answer:
errors are against the run with the quality "accurate" (dx = 0.25 um, 1026 vertices). The cell swings as it treads, so
the frequency of a part of a turn scatters by 8 % with any change; the way as a whole does by 2 to 3 %. Time: processor
seconds per simulated millisecond, one thread. Choices as in Q1.
"""
from npfem.validation import Case
from npfem.validation.trade_off import TankTreadingTrial, report_trade_off

CASE = Case(id="Q2", title="Speed against error: tank-treading red cell", tier="release", cost_s=900,
            source="own run with the quality accurate")


def run(report):
    """All choices."""
    report_trade_off(report, TankTreadingTrial())
