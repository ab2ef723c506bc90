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
from .origin import origin
from .programs import NotHere

_KEYS = ("case", "about", "file", "seconds", "date", "failure", "missing", "results", "plots")


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


def _load_module(path):
    """The module of a case file. ValueError, naming the file, where it cannot be loaded."""
    name = os.path.splitext(os.path.basename(path))[0]
    specification = importlib.util.spec_from_file_location("npfem_case_" + name, path)
    module = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("%s: %s" % (path, error), name=error.name) from None
    except Exception as error:  # noqa: BLE001: whatever is wrong with somebody's file
        raise ValueError("%s: %s: %s" % (path, type(error).__name__, error)) from None
    return module


def find_cases(folder):
    """All cases of a folder, in the order of their ids. ValueError where two share one, or a file is none."""
    if not os.path.isdir(folder):
        raise ValueError("%s: there is no such folder of validation cases" % folder)
    found = {}
    for path in sorted(glob.glob(os.path.join(folder, "*.py"))):
        module = _load_module(path)
        case = getattr(module, "CASE", None)
        if not isinstance(case, Case) or not callable(getattr(module, "run", None)):
            raise ValueError("%s: a validation case has CASE, a Case, and run(report)" % path)
        if case.id in found:
            raise ValueError("%s: %s has the same id, %s" % (path, found[case.id].path, case.id))
        found[case.id] = CaseFile(case, module, path)
    return [found[key] for key in sorted(found, key=_natural)]


def choose(known, folder, tier, ids=()):
    """Those with these ids, else those of the tier and of the quicker ones; all where `tier` is None.

    `known`: pairs of a `Case` and what is chosen with it; `folder`: where they are from.
    """
    if ids:
        by_id = {case.id: chosen for case, chosen in known}
        for name in ids:
            if name not in by_id:
                raise ValueError("no validation case %s in %s; there are: %s" % (name, folder, ", ".join(by_id)))
        return [by_id[name] for name in ids]
    return [chosen for case, chosen in known if tier is None or TIERS.index(case.tier) <= TIERS.index(tier)]


def run_case(entry, say=lambda line: None, keep=None):
    """Runs a case; returns its record: what `save` writes and the page shows. `keep`: folder for its files."""
    folder = keep or tempfile.mkdtemp(prefix="npfem-%s-" % entry.case.id)
    os.makedirs(folder, exist_ok=True)
    report = Report(entry.case, folder, say)
    came_from = origin()
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
            "date": datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d"), **came_from,
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


def _require_record(record):
    """Raises TypeError or ValueError where the page could not show it."""
    missing = [key for key in _KEYS if key not in record]
    if missing:
        raise ValueError("it has no %s" % ", ".join(missing))
    Case(**record["case"])
    for result in record["results"]:
        Result(**result)


def load(folder):
    """The records in a folder, in the order of the ids. ValueError, naming the file, where one is none."""
    records = []
    for path in sorted(glob.glob(os.path.join(folder, "*.json"))):
        with open(path, encoding="utf-8") as stream:
            try:
                record = json.load(stream)
            except ValueError as error:
                raise ValueError("%s is damaged: %s" % (path, error)) from None
        try:
            _require_record(record)
        except (TypeError, ValueError) as error:
            raise ValueError("%s is no record of a validation case: %s" % (path, error)) from None
        records.append(record)
    return sorted(records, key=lambda record: _natural(record["case"]["id"]))
