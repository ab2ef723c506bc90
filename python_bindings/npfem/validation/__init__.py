# SPDX-License-Identifier: MPL-2.0
"""Validation: how far the software is from theory, from measured blood and from its peers.

A case is a Python file with `CASE`, a `Case`, and `run(report)`, which computes and tells `report`, a `Report`, each
number beside its reference. The cases of the project are in tests/validation; `npfem report` runs them and draws the
page.
"""
from .case import TIERS, Case, Report, Result
from .programs import NotHere, probe, run_scene, summary_of
from .tables import read_csv

__all__ = ["TIERS", "Case", "NotHere", "Report", "Result", "probe", "read_csv", "run_scene", "summary_of"]
