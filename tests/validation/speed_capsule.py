# SPDX-License-Identifier: MPL-2.0
"""Speed against error: a capsule the size of a red cell in shear, over everything a scene can choose.

Radius 4 um, Ca = 0.15, 10 000 1/s, plasma, box 8 radii, to gdot t = 1.5. Error: of D against the boundary integral,
less the share of the box (C4). Time: processor seconds per simulated millisecond, one thread. One choice at a time is
changed from dx = 0.5 um, tau = 2, cells every step, 4 points, level 3 (642 vertices), double, implicit.
The lineage's coupling needs cells with mass and a volume energy of their own; it is compared on such a capsule, as it
ships (Calpha = 0.9, Cbeta = 0.01 us) and without its damping. Then the qualities that a scene can name.
"""
from npfem.validation import Case
from npfem.validation.trade_off import CapsuleTrial, report_trade_off

CASE = Case(id="Q1", title="Speed against error: capsule", tier="release", cost_s=500,
            source="own boundary integral")


def run(report):
    """All choices."""
    report_trade_off(report, CapsuleTrial())
