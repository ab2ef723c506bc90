# SPDX-License-Identifier: MPL-2.0
"""npfem report: verdicts, what a page holds, and what it refuses."""
import json

import pytest

from npfem.__main__ import main
from npfem.validation import Case, Report, collection
from npfem.validation.page import write_page

CASE_FILE = '''"""A case of the test."""
from npfem.validation import Case
CASE = Case(id="%(id)s", title="A title", tier="%(tier)s", source="nobody", cost_s=1)
def run(report):
    %(body)s
'''


def write_case(folder, name, body, case_id="T1", tier="ci"):
    folder.mkdir(exist_ok=True)
    (folder / (name + ".py")).write_text(CASE_FILE % {"id": case_id, "tier": tier, "body": body})


def report_of(tmp_path):
    return Report(Case("T1", "title", "ci", "source", 1), str(tmp_path))


@pytest.mark.parametrize("ours, known, verdict, good", [
    (1.02, "", "pass", True), (1.04, "", "fail", False), (0.96, "", "fail", False), (float("nan"), "", "fail", False),
    (1.04, "cause", "known", True), (1.02, "cause", "mended", False), (float("nan"), "cause", "known", True),
])
def test_verdicts(tmp_path, ours, known, verdict, good):
    result = report_of(tmp_path).compare("q", ours, 1.0, relative=0.03, known_failure=known)
    assert (result.verdict, result.good) == (verdict, good)


def test_absolute_limits_and_bands(tmp_path):
    report = report_of(tmp_path)
    assert report.compare("angle", 26.0, 24.9, absolute=2, unit="deg").verdict == "pass"
    assert report.compare("angle", 27.0, 24.9, absolute=2, unit="deg").verdict == "fail"
    assert report.below("residual", -2e-3, 1e-3).verdict == "fail"
    assert report.within("band", 0.164, 0.13, 0.165).verdict == "pass"
    assert report.within("band", 0.166, 0.13, 0.165).verdict == "fail"
    with pytest.raises(ValueError, match="one of relative and absolute"):
        report.compare("q", 1, 1)


def test_exit_codes_and_records(tmp_path, capsys):
    cases = tmp_path / "cases"
    write_case(cases, "good", 'report.compare("q", 1.01, 1.0, relative=0.02)')
    write_case(cases, "slow", 'report.compare("q", 2.0, 1.0, relative=0.02)', "T2", "nightly")
    arguments = ["report", "--cases", str(cases), "-o", str(tmp_path / "page.html"), "--results", str(tmp_path / "kept")]
    assert main(arguments) == 0
    assert main(arguments + ["--tier", "nightly"]) == 1
    assert main(arguments + ["--case", "T2"]) == 1
    record = json.loads((tmp_path / "kept" / "T2.json").read_text())
    assert record["results"][0]["verdict"] == "fail" and record["results"][0]["error"] == 1.0
    page = (tmp_path / "page.html").read_text()
    assert "T1" in page and "T2" in page and "FAILS" in page and "1 pass" in page
    assert "http" not in page.replace("http://www.w3.org", "").replace("https://matplotlib.org", "")


def test_a_case_that_stops_is_a_failure_and_keeps_its_numbers(tmp_path):
    cases = tmp_path / "cases"
    write_case(cases, "bad", 'report.measured("before", 1.0); raise RuntimeError("out of blood")')
    assert main(["report", "--cases", str(cases), "--no-page", "--results", str(tmp_path / "kept")]) == 1
    record = json.loads((tmp_path / "kept" / "T1.json").read_text())
    assert "out of blood" in record["failure"] and record["results"][0]["quantity"] == "before"


def test_a_case_without_numbers_does_not_pass(tmp_path):
    cases = tmp_path / "cases"
    write_case(cases, "empty", "pass")
    assert main(["report", "--cases", str(cases), "--no-page"]) == 1


@pytest.mark.parametrize("arguments, message", [
    (["--case", "T9"], "no validation case T9; there are: T1"),
    (["--no-run"], "name their folder with --results"),
    (["-o", "/nowhere/page.html"], "there is no folder /nowhere"),
])
def test_refusals(tmp_path, capsys, arguments, message):
    cases = tmp_path / "cases"
    write_case(cases, "good", 'report.compare("q", 1, 1, relative=0.1)')
    assert main(["report", "--cases", str(cases)] + arguments) == 2
    assert message in capsys.readouterr().err


def test_refuses_what_is_no_case(tmp_path, capsys):
    cases = tmp_path / "cases"
    write_case(cases, "a", "pass")
    write_case(cases, "b", "pass")
    assert main(["report", "--cases", str(cases), "--no-page"]) == 2
    assert "has the same id, T1" in capsys.readouterr().err
    (cases / "b.py").write_text("x = 1\n")
    assert main(["report", "--cases", str(cases), "--no-page"]) == 2
    assert "a validation case has CASE" in capsys.readouterr().err


def test_the_projects_own_cases_can_be_found():
    cases = collection.find_cases(collection.default_folder())
    assert "S11" in [entry.case.id for entry in cases]
    assert all(entry.module.__doc__ and entry.case.source for entry in cases)


def test_a_page_escapes_what_a_case_says(tmp_path):
    import io
    report = report_of(tmp_path)
    report.measured("<b>bold</b>", 1)
    plot = report.plot("Curves", "x", "y", x_log=True)
    report.curve(plot, "ours", [1, 2], [3, 4])
    report.curve(plot, "theirs", [1, 2], [3, 5], band=[0.1, 0.2])
    stream = io.StringIO()
    import dataclasses
    write_page([{"case": dataclasses.asdict(report.case), "about": "a < b", "file": "t.py", "seconds": 1.0,
                 "date": "2026-01-01", "failure": "", "missing": "", "plots": report.plots,
                 "results": [dataclasses.asdict(result) for result in report.results]}], stream, "machine", "version")
    page = stream.getvalue()
    assert "&lt;b&gt;bold" in page and "<b>bold" not in page and "a &lt; b" in page and "<svg" in page


def test_scenes_as_dictionaries():
    from npfem.validation.scene_text import quantities, quantity, toml
    text = toml({"schema_version": 1, "domain": {"dx": quantity(0.1, "um"), "size": quantities((1, 2), "um")},
                 "cells": [{"name": "a", "on": True, "positions": [{"centre": ["0.0 um"]}]}, {"name": 'b"', "count": 3}]})
    assert text == ('schema_version = 1\n\n[domain]\ndx = "0.1 um"\nsize = ["1.0 um", "2.0 um"]\n\n[[cells]]\nname = "a"\n'
                    'on = true\npositions = [{ centre = ["0.0 um"] }]\n\n[[cells]]\nname = "b\\""\ncount = 3\n')
