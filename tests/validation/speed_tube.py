# SPDX-License-Identifier: MPL-2.0
"""Speed against error: the flow through a tube of 10 um with four red cells, over everything a scene can choose.

The cells fold to parachutes in 8 ms under the force that drives plasma at 2 mm/s; density ten times the true one.
Error: of the mean flow rate over the last 4 ms against runs at dx = 0.25 and 0.4 um carried on to 0. Choices
and times as in Q1.
"""
from npfem.validation import Case
from npfem.validation.trade_off import TubeTrial, report_trade_off

CASE = Case(id="Q3", title="Speed against error: blood in a tube of 10 um", tier="release", cost_s=900,
            source="own runs, extrapolated to dx = 0")


def run(report):
    """All choices."""
    report_trade_off(report, TubeTrial())
