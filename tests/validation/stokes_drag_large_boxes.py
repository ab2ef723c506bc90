# SPDX-License-Identifier: MPL-2.0
"""The drag of spheres of many sizes in large periodic boxes: is the excess of the radius the same for all?

As in I2, with the default kernel of 4 points and shares a/L from 1/20 to 1/8, radii from 3 to 8 nodes. The excess
measured at a = 4, L = 32 must give every drag within 3 %, and the raw error must fall as dx/a: its logarithm has the
slope -1, to 0.15 for the curvature of (a + excess)/a itself.
"""
import math

from npfem.validation import Case, probe
from npfem.validation.sphere_drag import effective_radius, hasimoto, raw_error

CASE = Case(id="I2B", title="Drag of spheres in large boxes", tier="release", cost_s=600,
            source="Hasimoto, J. Fluid Mech. 5 (1959) 317")


def run(report):
    """Sizes at a/L = 1/10, then shares at a = 5."""
    def drag(radius, box):
        return probe(report, "immersed_boundary", "drag", 4, radius, box, 4, 0)["force_over_viscosity_speed"]

    excess = effective_radius(drag(4, 32), 32) - 4
    report.measured("excess of the radius at a = 4, L = 32", excess, unit="dx")
    plot = report.plot("Drag of a sphere, 4-point kernel", "radius a (node spacings)", "raw error of the drag (%)",
                       x_log=True, y_log=True)
    raw = {}
    for radius, box in ((3, 30), (4, 40), (6, 60), (8, 80), (5, 100), (5, 80)):
        found = drag(radius, box)
        name = "a = %d dx, L = %d dx" % (radius, box)
        report.below("drag with that excess, " + name, 100 * raw_error(found, radius + excess, box), 3, unit="%")
        report.measured("excess of the radius, " + name, effective_radius(found, box) - radius, unit="dx")
        if box == 10 * radius:
            raw[radius] = 100 * raw_error(found, radius, box)
    report.compare("order of the raw error in dx/a, from a = 3 to 8 at a/L = 0.1",
                   -math.log(raw[8] / raw[3]) / math.log(8 / 3), 1.0, absolute=0.15)
    report.curve(plot, "ours, a/L = 0.1", raw.keys(), raw.values(), points=True)
    report.curve(plot, "a sphere larger by the excess", raw.keys(),
                 [100 * ((a + excess) * hasimoto((a + excess) / (10 * a)) / (a * hasimoto(0.1)) - 1) for a in raw])
