# SPDX-License-Identifier: MPL-2.0
"""A sphere in a periodic box: how large does the fluid think it is, and is that one number enough?

The sphere is a surface of 642 vertices under uniform traction, the fluid holds the opposite body force, and the drag
is that of a simple cubic array, for which Hasimoto's series holds. A kernel smears the surface over its width, so
that a sphere drags like a slightly larger one. The excess of its radius is measured in one box, taken as a property
of the kernel and held against the drag of other spheres in other boxes, within 3 %. It must lie between 0 and 0.5
node spacings: further out the kernels hardly reach. Without it the raw drag misses the 5 % that one would like at a
radius of 5 nodes.

Scenes let fluid and cells meet that much under the surface unless they say otherwise: the same sphere with its markers
there must miss Hasimoto's drag by 5 % at most without any correction.

Known weakness: a rigid translation; uniform traction stands for a rigid sphere, whose traction is not quite uniform
in an array. Larger boxes and the first order in dx/a are in I2B.
"""
from npfem.validation import Case, probe
from npfem.validation.sphere_drag import effective_radius, raw_error

CASE = Case(id="I2", title="Drag of a sphere and its effective radius", tier="ci", cost_s=3,
            source="Hasimoto, J. Fluid Mech. 5 (1959) 317")

OTHERS = {4: ((5, 32), (3, 36), (5, 40)), 3: ((3, 30), (5, 40)), 2: ((3, 30), (5, 40))}
SMEARED = ("the kernel smears the surface: the sphere is larger by the excess of its radius, an error of first order "
           "in dx/a")
SECOND_ORDER = "a kernel of 4 nodes on a sphere of 6: second order in dx/a, 2.6 % at a = 5 dx"


def run(report):
    """Three kernels, calibrated at a = 4 in a box of 32."""
    def drag(points, radius, box, tau=4, inset=0):
        return probe(report, "immersed_boundary", "drag", points, radius, box, tau, inset)["force_over_viscosity_speed"]

    for points, others in OTHERS.items():
        excess = effective_radius(drag(points, 4, 32), 32) - 4
        report.within("excess of the radius, %d points" % points, excess, 0, 0.5, unit="dx")
        for radius, box in others:
            found = drag(points, radius, box)
            report.below("drag with that excess, %d points, a = %d dx, L = %d dx" % (points, radius, box),
                         100 * raw_error(found, radius + excess, box), 3, unit="%")
            if radius == 5 and box == 40:
                report.below("raw drag, %d points, a = 5 dx, L = 40 dx" % points,
                             100 * raw_error(found, radius, box), 5, unit="%", known_failure=SMEARED)
            under = drag(points, radius, box, inset=1)
            report.below("raw drag with markers under the surface, %d points, a = %d dx, L = %d dx"
                         % (points, radius, box), 100 * raw_error(under, radius, box), 5, unit="%",
                         known_failure=SECOND_ORDER if (points, radius) == (4, 3) else "")
    # Steady Stokes flow depends on the product of the relaxation times only (d'Humieres & Ginzburg 2009).
    report.compare("drag at tau = 1 over that at tau = 4", drag(4, 3, 18, 1) / drag(4, 3, 18, 4), 1.0, relative=1e-3)
