# SPDX-License-Identifier: MPL-2.0
"""npfem report: verdicts, what a page holds, and what it refuses."""
import dataclasses
import io
import json
import os
import shutil
import subprocess

import pytest

from npfem.__main__ import main
from npfem.validation import Case, Report, collection, origin, probe
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
    arguments = ["report", "--cases", str(cases), "-o", str(tmp_path / "page.html"), "--results",
                 str(tmp_path / "kept")]
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
    (["--case", "T9"], "no validation case T9 in "),
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


def record_of(report, **changes):
    """As files have it that were written before the code and the machine were."""
    return {"case": dataclasses.asdict(report.case), "about": "a < b", "file": "t.py", "seconds": 1.0,
            "date": "2026-01-01", "failure": "", "missing": "", "plots": report.plots,
            "results": [dataclasses.asdict(result) for result in report.results], **changes}


def page_of(*records):
    stream = io.StringIO()
    write_page(records, stream)
    return stream.getvalue()


def test_a_page_escapes_what_a_case_says(tmp_path):
    report = report_of(tmp_path)
    report.measured("<b>bold</b>", 1)
    plot = report.plot("Curves", "x", "y", x_log=True)
    report.curve(plot, "ours", [1, 2], [3, 4])
    report.curve(plot, "theirs", [1, 2], [3, 5], band=[0.1, 0.2])
    page = page_of(record_of(report))
    assert "&lt;b&gt;bold" in page and "<b>bold" not in page and "a &lt; b" in page and "<svg" in page


def test_a_page_says_what_its_numbers_come_from(tmp_path):
    report = report_of(tmp_path)
    report.measured("q", 1)
    here = {"version": "0.1.0", "commit": "0a1b2c3+", "machine": "one <CPU>, 2 cores"}
    page = page_of(record_of(report, **here), record_of(report, **here, date="2026-01-02"), record_of(report))
    head, cases = page.split("<table>")
    assert "npfem 0.1.0, not recorded" in head and "commit 0a1b2c3+, not recorded" in head
    assert "machine: one &lt;CPU&gt;, 2 cores; not recorded" in head
    assert "run on 2026-01-02 with npfem 0.1.0, commit 0a1b2c3+, on one &lt;CPU&gt;, 2 cores." in cases
    assert "run on 2026-01-01, code and machine not recorded." in cases


def test_records_name_code_and_machine(tmp_path, monkeypatch):
    cases = tmp_path / "cases"
    write_case(cases, "good", 'report.compare("q", 1, 1, relative=0.1)')
    entry, = collection.find_cases(str(cases))
    monkeypatch.setenv("NPFEM_COMMIT", "0a1b2c3")
    record = collection.run_case(entry)
    assert record["version"] and record["commit"] == "0a1b2c3" and " cores" in record["machine"]


@pytest.mark.skipif(not shutil.which("git"), reason="git is not installed")
def test_the_commit_is_that_of_the_checkout(tmp_path, monkeypatch):
    def git(*arguments):
        command = ("git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b") + arguments
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

    (tmp_path / "package").mkdir()
    monkeypatch.setattr(origin, "__file__", str(tmp_path / "package" / "origin.py"))
    monkeypatch.delenv("NPFEM_COMMIT", raising=False)
    assert origin.commit() == ""
    (tmp_path / "package" / "origin.py").write_text("first\n")
    git("init", "--quiet")
    assert origin.commit() == ""  # a checkout of something else
    git("add", ".")
    git("commit", "--quiet", "-m", "first")
    clean = origin.commit()
    assert 6 < len(clean) < 13 and "+" not in clean
    (tmp_path / "new.txt").write_text("not tracked\n")
    assert origin.commit() == clean
    (tmp_path / "package" / "origin.py").write_text("second\n")
    assert origin.commit() == clean + "+"
    monkeypatch.setenv("PATH", "")
    assert origin.commit() == ""


@pytest.fixture
def kept(tmp_path):
    """Records of T1, ci, and T2, nightly, which fails."""
    cases = tmp_path / "cases"
    write_case(cases, "good", 'report.compare("quick", 1, 1, relative=0.1)')
    write_case(cases, "slow", 'report.compare("slow", 2, 1, relative=0.1)', "T2", "nightly")
    assert main(["report", "--cases", str(cases), "--tier", "nightly", "--no-page", "--results",
                 str(tmp_path / "kept")]) == 1
    return str(tmp_path / "kept")


@pytest.mark.parametrize("arguments, ids, code", [
    ([], ["T1", "T2"], 1), (["--case", "T1"], ["T1"], 0), (["--tier", "ci"], ["T1"], 0),
    (["--tier", "release"], ["T1", "T2"], 1), (["--case", "T2", "--tier", "ci"], ["T2"], 1),
])
def test_kept_records_are_chosen_from(kept, tmp_path, arguments, ids, code):
    page = tmp_path / "page.html"
    assert main(["report", "--no-run", "--results", kept, "-o", str(page)] + arguments) == code
    assert [name for name in ("T1", "T2") if 'id="%s"' % name in page.read_text()] == ids


def test_a_tier_without_records_is_told(kept, tmp_path, capsys):
    os.remove(os.path.join(kept, "T1.json"))
    page = tmp_path / "page.html"
    assert main(["report", "--no-run", "--results", kept, "--tier", "ci", "-o", str(page)]) == 2
    assert "there is no record of a case of tier ci in it" in capsys.readouterr().err and not page.exists()


@pytest.mark.parametrize("arguments, message", [
    (["--results", "TYPO"], "--results TYPO: there is no such folder"),
    (["--results", "empty"], "--results empty: there is no record of a case in it"),
    (["--results", "kept", "--case", "T9"], "no validation case T9 in kept; there are: T1, T2"),
])
def test_without_records_a_page_stays_as_it_is(kept, tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    os.mkdir("empty")
    (tmp_path / "page.html").write_text("the old page")
    assert main(["report", "--no-run", "-o", "page.html"] + arguments) == 2
    assert message in capsys.readouterr().err
    assert (tmp_path / "page.html").read_text() == "the old page" and not os.path.exists("TYPO")


@pytest.mark.parametrize("content", ["{}", "[1]", "3", "{", "\0\xff", '{"case": {}}',
                                     '{"case": {"id": "T1", "title": "", "tier": "ci", "source": "", "cost_s": 1}}'])
@pytest.mark.parametrize("run", [["--no-run"], []])
def test_what_is_no_record_is_told_before_the_work(kept, tmp_path, capsys, content, run):
    with open(os.path.join(kept, "T3.json"), "w", encoding="latin-1") as stream:
        stream.write(content)
    capsys.readouterr()
    arguments = ["report", "--cases", str(tmp_path / "cases"), "--results", kept, "-o", str(tmp_path / "page.html")]
    assert main(arguments + run) == 2
    err = capsys.readouterr().err
    assert "T3.json" in err and len(err.splitlines()) == 1


@pytest.mark.parametrize("option", ["--results", "--keep"])
def test_folders_are_checked_before_the_work(tmp_path, capsys, option):
    cases = tmp_path / "cases"
    write_case(cases, "good", 'report.compare("q", 1, 1, relative=0.1)')
    (tmp_path / "file").write_text("")
    for path in (tmp_path / "file", tmp_path / "file" / "below"):
        assert main(["report", "--cases", str(cases), "--no-page", option, str(path)]) == 2
        err = capsys.readouterr().err
        assert str(path) in err and "is not a folder" in err and len(err.splitlines()) == 1


@pytest.mark.parametrize("text, words", [
    ("x = = 1\n", "SyntaxError"), ("x = y\n", "NameError: name 'y'"), ("import nosuchmodule\n", "nosuchmodule"),
    ("from npfem.validation import nosuch\n", "nosuch"),
    (CASE_FILE % {"id": "T3", "tier": "weekly", "body": "pass"}, 'tier "weekly" is not known'),
])
def test_a_case_file_with_a_mistake_is_named(tmp_path, capsys, text, words):
    (tmp_path / "broken.py").write_text(text)
    assert main(["report", "--cases", str(tmp_path), "--list"]) == 2
    err = capsys.readouterr().err
    assert "broken.py: " in err and words in err and len(err.splitlines()) == 1


def test_a_case_that_lacks_a_program_counts_only_where_nothing_ran(tmp_path, capsys, monkeypatch):
    cases = tmp_path / "cases"
    write_case(cases, "probing", 'from npfem.validation import probe; probe(report, "nothing")')
    monkeypatch.setenv("NPFEM_PROGRAM", str(tmp_path / "bin" / "npfem"))
    arguments = ["report", "--cases", str(cases), "-o", str(tmp_path / "page.html")]
    assert main(arguments) == 1
    assert "T1   could not run here: validate_nothing is not in " in capsys.readouterr().err
    write_case(cases, "good", 'report.compare("q", 1, 1, relative=0.1)', "T2")
    assert main(arguments) == 0
    page = (tmp_path / "page.html").read_text()
    assert "could not run here: validate_nothing" in page and "1 cases could not run here" in page


@pytest.mark.parametrize("folder, path", [("bin", ""), ("libexec/npfem", ""), ("elsewhere", "elsewhere")])
def test_probes_are_found(tmp_path, monkeypatch, folder, path):
    (tmp_path / "bin").mkdir()
    (tmp_path / folder).mkdir(parents=True, exist_ok=True)
    program = tmp_path / folder / "validate_echo"
    program.write_text("#!/bin/sh\necho \"[$1]\"\n")
    program.chmod(0o755)
    monkeypatch.setenv("NPFEM_PROGRAM", str(tmp_path / "bin" / "npfem"))
    monkeypatch.setenv("PATH", os.pathsep.join(([str(tmp_path / path)] if path else []) + [os.environ["PATH"]]))
    assert probe(report_of(tmp_path), "echo", 3) == [3]


def test_scenes_as_dictionaries():
    from npfem.validation.scene_text import quantities, quantity, toml
    text = toml({"schema_version": 1, "domain": {"dx": quantity(0.1, "um"), "size": quantities((1, 2), "um")},
                 "cells": [{"name": "a", "on": True, "positions": [{"centre": ["0.0 um"]}]},
                           {"name": 'b"', "count": 3}]})
    assert text == ('schema_version = 1\n\n[domain]\ndx = "0.1 um"\nsize = ["1.0 um", "2.0 um"]\n\n[[cells]]\n'
                    'name = "a"\non = true\npositions = [{ centre = ["0.0 um"] }]\n\n[[cells]]\nname = "b\\""\n'
                    'count = 3\n')
