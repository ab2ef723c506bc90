# SPDX-License-Identifier: MPL-2.0
"""Jeffery's orbit (I4) with fluid and body meeting at markers under the surface, as scenes have it that say nothing.

A kernel makes a body larger, which turns faster, and strengthens its answer to strain, which turns it more slowly. At
the vertices the two cancel in part (+6.7 and -2.6 % with 4 points, of which 1.8 % are the box's). Markers under the
surface take away the first, which is of first order in dx, and leave the second: on spheres the excess of the radius in
a strain is c + 1.25 dx^2/R where that in translation is c (I7, I2), and R is half of the short axis here. So thin
bodies turn too slowly until their short axis is many nodes long. Tolerance: 5 %, as in I4.
"""
from npfem.validation import Case
from npfem.validation.spheroids import Orbit

CASE = Case(id="I4B", title="Spheroids turn in shear, markers under the surface", tier="nightly", cost_s=300,
            source="Jeffery, Proc. R. Soc. A 102 (1922) 161")

_STRAIN = "the kernel's answer to strain, of second order in dx over half the short axis; 1.8 % the box"

# name, semi-axes along flow, gradient, vorticity (dx), nodes, kernel
BODIES = (("prolate 2 : 1, short axis 6 dx", (6, 3, 3), (36, 36, 24), 4),
          ("prolate 2 : 1, short axis 6 dx, 2-point kernel", (6, 3, 3), (36, 36, 24), 2),
          ("platelet 3.6 : 1.1, short axis 4 dx", (6.545, 2, 6.545), (40, 40, 40), 4))


def run(report):
    """Three bodies."""
    for name, axes, box, kernel in BODIES:
        Orbit(report, name, axes, box, kernel).tell(report, name, _STRAIN)
