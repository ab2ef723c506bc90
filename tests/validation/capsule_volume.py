# SPDX-License-Identifier: MPL-2.0
"""Volume of a capsule over a long time in shear: what leaks through the membrane.

Ca = 0.3, radius 5 nodes, to gdot t = 50, no constraint on the volume. A membrane that is only compliant, in a fluid that
is slightly compressible, loses some volume once; one that slips through the fluid goes on losing. So the slope after
gdot t = 3 counts, per gdot t = 50.
"""
import numpy

from npfem.validation import Case
from npfem.validation.capsule_scene import shear_capsule

CASE = Case(id="C7", title="Capsule: volume over gdot t = 50", tier="nightly", cost_s=120,
            source="conservation; leakage of immersed boundaries: Peskin & Printz, J. Comput. Phys. 105 (1993) 33")


def run(report):
    """Without and with a penalty on the volume, and with a narrower kernel."""
    plot = report.plot("Capsule: volume", "gdot t", "change of volume (%)")
    for name, options, limit in (("4 points", {}, 0.5), ("2 points", {"kernel": 2}, 0.5),
                                 ("4 points, penalty on the volume", {"global_volume_modulus": "1 Pa"}, 0.1)):
        ours = shear_capsule(report, name.replace(" ", "_").replace(",", ""), 0.3, 50.0, radius=5, **options)
        start = ours.at(3)
        slope = numpy.polyfit(ours.strain[start:], ours.volume[start:], 1)[0]
        report.below("drift of the volume per gdot t = 50 after gdot t = 3, %s" % name, 100 * 50 * slope, limit, unit="%")
        report.measured("change of volume at gdot t = 3, %s" % name, 100 * (ours.volume[start] - 1), unit="%")
        report.curve(plot, name, ours.strain, [100 * (volume - 1) for volume in ours.volume])
