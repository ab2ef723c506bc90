# SPDX-License-Identifier: MPL-2.0
"""Jeffery's orbit (I4) with fluid and body meeting at markers under the surface, as scenes have it that say nothing.

The prolate spheroid whose short axis is 6 nodes long misses Jeffery's period by 6.7 % with markers at the vertices, of
which 1.8 % are the box's; the platelet's 3.6 to 1.1 with a short axis of 4 nodes is the least that 5 % is asked of. The
2-point kernel is the narrowest. Tolerance: 5 %, as there.
"""
from npfem.validation import Case
from npfem.validation.spheroids import Orbit

CASE = Case(id="I4B", title="Spheroids turn in shear, markers under the surface", tier="nightly", cost_s=300,
            source="Jeffery, Proc. R. Soc. A 102 (1922) 161")

# name, semi-axes along flow, gradient, vorticity (dx), nodes, kernel
BODIES = (("prolate 2 : 1, short axis 6 dx", (6, 3, 3), (36, 36, 24), 4),
          ("prolate 2 : 1, short axis 6 dx, 2-point kernel", (6, 3, 3), (36, 36, 24), 2),
          ("platelet 3.6 : 1.1, short axis 4 dx", (6.545, 2, 6.545), (40, 40, 40), 4))


def run(report):
    """Three bodies."""
    for name, axes, box, kernel in BODIES:
        Orbit(report, name, axes, box, kernel).tell(report, name)
