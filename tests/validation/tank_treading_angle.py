# SPDX-License-Identifier: MPL-2.0
"""Inclination of a tank-treading red cell: suspending fluid 55.9 mPa s, 38 1/s.

Cytoplasm 6 mPa s, the shipped material `rbc-viscous`, Re = 0.2 (see npfem.validation.tank_treading). Means over donors,
scatter 0.9 to 1.6 degrees; Mirheo is off by 1.4 to 3.3 degrees rms.
"""
from npfem.validation import Case
from npfem.validation.tank_treading import shear_red_cell

CASE = Case(id="R2", title="Inclination of a tank-treading red cell", tier="release", cost_s=250,
            source="Fischer & Korzeniewski, Biophys. J. 108 (2015) 1352")

# shear rate (1/s), inclination (degrees) in 55.9 mPa s
FISCHER_2015 = ((1.2, 16.4), (3.8, 18.9), (12.0, 17.6), (38.0, 16.1), (120.0, 14.3))


def run(report):
    """One shear rate."""
    ours = shear_red_cell(report, "rate38", 38.0, 55.9, strain=50.0)
    report.compare("inclination at 38 1/s, 55.9 mPa s", ours.mean_inclination(15.0), 16.1, absolute=3, unit="deg")
    report.measured("nu/gdot", ours.frequency(15.0))
    plot = report.plot("Inclination in 55.9 mPa s", "shear rate (1/s)", "inclination (degrees)", x_log=True)
    report.curve(plot, "Fischer & Korzeniewski 2015", [p[0] for p in FISCHER_2015], [p[1] for p in FISCHER_2015],
                 points=True)
    report.curve(plot, "npfem", [38.0], [ours.mean_inclination(15.0)], points=True)
