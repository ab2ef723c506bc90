# SPDX-License-Identifier: MPL-2.0
"""Finds cases, runs them, and keeps what they found: one JSON file per case, so that a long tier can be interrupted."""
import dataclasses
import datetime
import glob
import importlib.util
import json
import os
import re
import shutil
import tempfile
import time

from .case import TIERS, Case, Report, Result
from .programs import NotHere


@dataclasses.dataclass
class CaseFile:
    """A case, the module it is in, and the file."""
    case: Case
    module: object
    path: str


def default_folder():
    """Of the cases: beside the package in an installation, else in the source tree."""
    here = os.path.dirname(os.path.abspath(__file__))
    for folder in (os.path.join(here, "..", "..", "validation"),
                   os.path.join(here, "..", "..", "..", "tests", "validation")):
        if os.path.isdir(folder):
            return os.path.normpath(folder)
    raise ValueError("no folder of validation cases beside %s; name one with --cases" % here)


def _natural(text):
    """S2 before S10."""
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text)]


def find_cases(folder):
    """All cases of a folder, in the order of their ids. ValueError where two share one, or a file is none."""
    if not os.path.isdir(folder):
        raise ValueError("%s: there is no such folder of validation cases" % folder)
    found = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.py"))):
        name = os.path.splitext(os.path.basename(path))[0]
        specification = importlib.util.spec_from_file_location("npfem_case_" + name, path)
        module = importlib.util.module_from_spec(specification)
        specification.loader.exec_module(module)
        case = getattr(module, "CASE", None)
        if not isinstance(case, Case) or not callable(getattr(module, "run", None)):
            raise ValueError("%s: a validation case has CASE, a Case, and run(report)" % path)
        if case.id in found:
            raise ValueError("%s: %s has the same id, %s" % (path, found[case.id].path, case.id))
        found[case.id] = CaseFile(case, module, path)
    return [found[key] for key in sorted(found, key=_natural)]


def choose(cases, tier=None, ids=()):
    """Those with these ids, else those of the tier and of the quicker ones."""
    if ids:
        known = {entry.case.id: entry for entry in cases}
        for name in ids:
            if name not in known:
                raise ValueError("no validation case %s; there are: %s" % (name, ", ".join(known)))
        return [known[name] for name in ids]
    return [entry for entry in cases if TIERS.index(entry.case.tier) <= TIERS.index(tier)]


def run_case(entry, say=lambda line: None, keep=None):
    """Runs a case; returns its record: what `save` writes and the page shows. `keep`: folder for its files."""
    folder = keep or tempfile.mkdtemp(prefix="npfem-%s-" % entry.case.id)
    os.makedirs(folder, exist_ok=True)
    report = Report(entry.case, folder, say)
    start = time.monotonic()
    failure = missing = ""
    try:
        entry.module.run(report)
    except NotHere as error:
        missing = str(error)
    except Exception as error:  # noqa: BLE001: whatever stops a case is its result
        failure = "%s: %s" % (type(error).__name__, error)
    finally:
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)
    return {"case": dataclasses.asdict(entry.case), "about": (entry.module.__doc__ or "").strip(),
            "file": os.path.basename(entry.path), "seconds": time.monotonic() - start,
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"),
            "failure": failure, "missing": missing,
            "results": [dataclasses.asdict(result) for result in report.results], "plots": report.plots}


def passed(record):
    """Whether a test of it may pass. A case that could not run here has not."""
    if record["failure"] or record["missing"]:
        return False
    return bool(record["results"]) and all(Result(**result).good for result in record["results"])


def save(record, folder):
    """Writes the record of a case beside those of the others."""
    os.makedirs(folder, exist_ok=True)
    path = os.path.join(folder, record["case"]["id"] + ".json")
    aside = path + ".part"
    with open(aside, "w", encoding="utf-8") as stream:
        json.dump(record, stream, indent=1)
        stream.write("\n")
    os.replace(aside, path)


def load(folder):
    """The records in a folder, in the order of the ids."""
    records = []
    for path in glob.glob(os.path.join(folder, "*.json")):
        with open(path, encoding="utf-8") as stream:
            try:
                records.append(json.load(stream))
            except ValueError as error:
                raise ValueError("%s is damaged: %s" % (path, error)) from None
    return sorted(records, key=lambda record: _natural(record["case"]["id"]))
