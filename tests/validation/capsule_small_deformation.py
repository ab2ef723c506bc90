# SPDX-License-Identifier: MPL-2.0
"""Slope of the deformation of a capsule at small capillary number: D = 25/12 Ca for neo-Hookean and Skalak C = 1.

At Ca = 0.02 the answer is known exactly, and what is left is the error of the coupling, told apart from the box by one
of 16 radii. With fluid and cells meeting at markers under the surface (the default) it falls with the square of dx/a;
with markers at the vertices a surface that is smeared over 4 nodes drags like that of a sphere larger by 0.485 dx (case
I2), the capillary number grows with it, and the error falls with dx/a.
"""
import math

from npfem.validation import Case
from npfem.validation.capsule_scene import shear_capsule

CASE = Case(id="C3", title="Capsule at small deformation", tier="nightly", cost_s=240,
            source="Barthes-Biesel & Rallison, J. Fluid Mech. 113 (1981) 251")

_CAPILLARY = 0.02
_SECOND_ORDER = "second order in the width of the kernel: 5.4, 3.2 and 2.2 (dx/a)^2 for 4, 3 and 2 points"


def run(report):
    """Radii, boxes, kernels, markers, laws."""
    slope = {}

    def measure(radius, box=8, kernel=4, law="neo_hookean", tau=2.0, inset=None, **parameters):
        key = "a%d_box%d_k%d_%s_%s" % (radius, box, kernel, law, "vertices" if inset == 0 else "markers")
        ours = shear_capsule(report, key, _CAPILLARY, 0.6, radius=radius, box=(box, box, box), kernel=kernel, law=law,
                             relaxation_time=tau, inset=inset, **parameters)
        slope[key] = ours.deformation[-1] / _CAPILLARY
        return slope[key]

    exact = 25 / 12
    # The share of the box falls with its volume: an eighth of it is left at 16 radii.
    box_share = (measure(6) - measure(6, 16)) * 8 / 7
    report.measured("share of the box of 8 radii in D/Ca", 100 * box_share / exact, unit="%")
    error = {}
    for radius, kernel, tau in ((6, 4, 2.0), (8, 4, 2.0), (12, 4, 4.0), (8, 3, 2.0), (8, 2, 2.0), (12, 2, 4.0)):
        ours = measure(radius, kernel=kernel, tau=tau) - box_share
        error[radius, kernel] = ours / exact - 1
        report.compare("D/Ca less the share of the box, a = %d dx, %d points" % (radius, kernel), ours, exact,
                       relative=0.03, known_failure=_SECOND_ORDER if (radius, kernel) not in ((12, 2),) else "")
    report.compare("order of the error in dx/a, 4 points, a = 6 to 12 dx", math.log2(error[6, 4] / error[12, 4]), 2,
                   absolute=0.3)
    at_vertices = {radius: (measure(radius, tau=tau, inset=0) - box_share) / exact - 1
                   for radius, tau in ((6, 2.0), (12, 4.0))}
    for radius, value in at_vertices.items():
        report.measured("error with markers at the vertices, a = %d dx, 4 points" % radius, 100 * value, unit="%")
    report.measured("its order", math.log2(at_vertices[6] / at_vertices[12]))
    report.compare("Skalak C = 1 over neo-Hookean, a = 6 dx", measure(6, law="skalak", skalak_C=1)
                   / slope["a6_box8_k4_neo_hookean_markers"], 1.0, relative=0.01)
