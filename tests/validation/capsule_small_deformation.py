# SPDX-License-Identifier: MPL-2.0
"""Slope of the deformation of a capsule at small capillary number: D = 25/12 Ca for neo-Hookean and Skalak C = 1.

At Ca = 0.02 the answer is known exactly, and what is left is the error of the coupling. It is large and has two causes,
told apart here by resolution (radius 6 and 12 nodes) and box (8 and 16 radii): the box, whose share falls with its
volume, and the kernel: a surface that is smeared over 4 nodes drags like that of a sphere larger by 0.485 dx (case I2),
and the capillary number grows with it. What remains after both falls with the square of dx/a.
"""
from npfem.validation import Case
from npfem.validation.capsule_scene import shear_capsule

CASE = Case(id="C3", title="Capsule at small deformation", tier="nightly", cost_s=200,
            source="Barthes-Biesel & Rallison, J. Fluid Mech. 113 (1981) 251")

_CAPILLARY = 0.02
_EXCESS = {4: 0.485, 3: 0.365, 2: 0.277}  # of the radius, in node spacings, of the kernels of 4, 3, 2 points (case I2)
_KERNEL = "the kernel's excess of radius, 0.485 dx for 4 points, enters the capillary number"
_SECOND_ORDER = "second order in the width of the kernel: 1.4 (dx/a)^2"


def run(report):
    """Radii, boxes, kernels, laws."""
    slope = {}

    def measure(radius, box, kernel=4, law="neo_hookean", tau=2.0, **parameters):
        key = "a%d_box%d_k%d_%s" % (radius, box, kernel, law)
        ours = shear_capsule(report, key, _CAPILLARY, 0.6, radius=radius, box=(box, box, box), kernel=kernel, law=law,
                             relaxation_time=tau, **parameters)
        slope[key] = ours.deformation[-1] / _CAPILLARY
        return slope[key]

    exact = 25 / 12
    confined = measure(6, 8) - measure(6, 16)
    # The share of the box falls with its volume: an eighth of it is left at 16 radii.
    box_share = confined * 8 / 7
    for radius, tau in ((6, 2.0), (8, 2.0), (12, 4.0)):
        raw = measure(radius, 8, tau=tau)
        report.compare("D/Ca, a = %d dx, box 8 a" % radius, raw, exact, relative=0.03, known_failure=_KERNEL)
        corrected = (raw - box_share) / (1 + _EXCESS[4] / radius)
        report.compare("the same without box and excess of radius, a = %d dx" % radius, corrected, exact, relative=0.03,
                       known_failure=_SECOND_ORDER if radius < 8 else "")
    for kernel in (3, 2):
        corrected = (measure(8, 8, kernel) - box_share) / (1 + _EXCESS[kernel] / 8)
        report.compare("without box and excess of radius, kernel of %d points, a = 8 dx" % kernel, corrected, exact,
                       relative=0.03)
    report.compare("Skalak C = 1 over neo-Hookean, a = 6 dx", measure(6, 8, law="skalak", skalak_C=1)
                   / slope["a6_box8_k4_neo_hookean"], 1.0, relative=0.01)
    report.measured("share of the box of 8 radii in D/Ca", 100 * box_share / exact, unit="%")
