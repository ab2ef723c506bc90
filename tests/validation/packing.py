# SPDX-License-Identifier: MPL-2.0
"""Packing of cells at physiological haematocrit: no interpenetration, the volume that was asked for.

45 % in a box of 25 um between plates, red cells and platelets 5 : 1. What `npfem pack` reports is checked by the run
that starts from it.
"""
from npfem.validation import Case
from npfem.validation.suspension import packed_box

CASE = Case(id="B8", title="Packing of red cells and platelets", tier="ci", cost_s=5, source="geometry")


def run(report):
    """Packs and starts."""
    packed, summary = packed_box(report, "box", 25.0, 0.45, platelets_per_cell=0.2)
    report.below("interpenetrating triangles", packed["crossing_triangles"], 0)
    report.below("worst volume error of a cell", 100 * packed["worst_volume_error"], 1, unit="%")
    report.compare("haematocrit", packed["types"][0]["haematocrit"], 0.45, absolute=0.005)
    report.below("interpenetrating triangles when the run starts", summary["crossing_triangles"], 0)
    report.measured("overlap before", packed["overlap_before_um"], unit="um")
    report.measured("least gap after", packed["least_gap_um"], unit="um")
