# SPDX-License-Identifier: MPL-2.0
"""Blood in a tube of 20 um: apparent viscosity and Fahraeus effect at 30 % tube haematocrit.

Packed in a core of 16.5 um, then driven at a pseudo-shear rate U/D of 300 1/s (of plasma) over several diameters;
cytoplasm of 6 mPa s. Pries' law takes the discharge haematocrit; a periodic tube fixes the tube haematocrit, and the
values below are by that (Pries' two formulas solved for it). Tolerance 15 % and 5 %: the law itself scatters so.
"""
from npfem.validation import Case
from npfem.validation.suspension import tube_blood

CASE = Case(id="B1", title="Apparent viscosity of blood in a tube of 20 um", tier="release", cost_s=500,
            source="Pries, Neuhaus & Gaehtgens, Am. J. Physiol. 263 (1992) H1770")

# tube haematocrit: relative apparent viscosity, D = 20 um
PRIES_20_UM = {0.15: 1.222, 0.30: 1.513, 0.45: 1.948}
# H_T/H_D at the same; by their formula with 0.415 and 0.011 in the exponents.
FAHRAEUS_20_UM = {0.30: 0.30 / 0.417}
_BLUNT = ("not known; the core moves as a plug, which with a cell-free layer of 2.6 um has 0.77 by itself; contacts "
          "that begin at half the distance change nothing. Cells leave the core for 25 diameters, this run has 12 of "
          "plasma's way, 8 of its own")


def run(report):
    """One haematocrit; the same run gives B2."""
    table, rheology, summary = tube_blood(report, "tube20", 0.30)
    report.compare("relative apparent viscosity, H_T = 0.30", rheology["relative_viscosity"], PRIES_20_UM[0.30],
                   relative=0.15)
    ratio = summary["haematocrit"] / rheology["discharge_haematocrit"]
    report.compare("H_T/H_D (B2)", ratio, FAHRAEUS_20_UM[0.30], relative=0.05, known_failure=_BLUNT)
    report.measured("cell-free layer", rheology["cell_free_layer_um"], unit="um")
    report.below("interpenetrating triangles at the end", summary["crossing_triangles"], 0)
    plot = report.plot("Blood in a tube of 20 um", "tube haematocrit", "relative apparent viscosity")
    report.curve(plot, "Pries et al. 1992", list(PRIES_20_UM), list(PRIES_20_UM.values()))
    report.curve(plot, "npfem", [summary["haematocrit"]], [rheology["relative_viscosity"]], points=True)
    settling = report.plot("Blood in a tube of 20 um: how it settles", "time (ms)", "relative apparent viscosity")
    report.curve(settling, "npfem", [time / 1000 for time in table["time_us"]], table["relative_viscosity"])
