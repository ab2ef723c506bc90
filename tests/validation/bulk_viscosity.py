# SPDX-License-Identifier: MPL-2.0
"""Viscosity of blood against the shear rate: 35 % red cells in a box of 20 um, at 100 and 500 1/s.

Packed, then sheared for gdot t = 12; cytoplasm of 6 mPa s; relative viscosity from the stress on the plates over the
last third. The plates are 20 um apart, four cells: a small box, and its walls leave layers without cells, which lower
the stress. The reference holds for aggregating blood without walls (Quemada's fit) and, in the limit of large tubes,
for Pries' law; so 20 % is allowed and only rates from 50 1/s on are compared. Density raised so that gdot a^2/nu =
0.05.
"""
from npfem.validation import Case
from npfem.validation.suspension import sheared_blood

CASE = Case(id="B4", title="Viscosity of sheared blood", tier="release", cost_s=500,
            source="Quemada, Rheol. Acta 17 (1978) 632, coefficients for blood; Pries, Neuhaus & Gaehtgens, Am. J. "
                   "Physiol. 263 (1992) H1770")

# shear rate (1/s): mu/mu_plasma at 35 %
QUEMADA_35 = {50: 2.94, 100: 2.79, 200: 2.68, 500: 2.58}

_FILMS = ("at 100 1/s the viscosity is 16 % too high, at 500 1/s, where cells give way, 2 %: films between cells of "
          "one or two nodes of 0.5 um")


def run(report):
    """Two shear rates."""
    plot = report.plot("Blood at 35 %", "shear rate (1/s)", "viscosity over that of plasma", x_log=True)
    report.curve(plot, "Quemada", list(QUEMADA_35), list(QUEMADA_35.values()), points=True)
    found = {}
    for rate in (100, 500):
        viscosity, summary = sheared_blood(report, "rate%d" % rate, rate, haematocrit=0.35, strain=12.0)
        found[rate] = viscosity
        report.compare("relative viscosity at %d 1/s, 35 %%" % rate, viscosity, QUEMADA_35[rate], relative=0.2)
        report.below("interpenetrating triangles at the end, %d 1/s" % rate, summary["crossing_triangles"], 0)
        report.below("volume error, %d 1/s" % rate, 100 * summary["volume_error"], 1, unit="%")
    report.compare("thinning from 100 to 500 1/s", found[100] / found[500], QUEMADA_35[100] / QUEMADA_35[500],
                   relative=0.1, known_failure=_FILMS)
    report.curve(plot, "npfem, 20 um between the plates", list(found), list(found.values()))
