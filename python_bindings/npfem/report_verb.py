# SPDX-License-Identifier: MPL-2.0
"""`npfem report`: runs validation cases and writes the page that shows them."""
import json
import os
import sys

from ._files import require_writable, require_writable_folder, write_aside
from .validation import TIERS, Case, collection
from .validation.page import write_page


_DESCRIPTION = (
    "Runs the validation cases of a tier and writes one HTML page: every number beside theory, measured blood and "
    "other codes. Exit code 0: every number is within what is allowed, or misses it for a cause that its case names; "
    "1: one is not, or nothing ran; 2: bad input. A case whose programs are not installed says so and does not count.")


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser("report", help="run the validation cases and write their page",
                            description=_DESCRIPTION)
    verb.add_argument("--tier", choices=TIERS,
                      help="ci: a minute; nightly: an hour; release: a day on two cores; each with the quicker ones "
                           "(default: ci; with --no-run: all that --results holds)")
    verb.add_argument("--case", action="append", default=[], metavar="ID", help="this case only (may be repeated)")
    verb.add_argument("--cases", metavar="FOLDER", help="folder of the case files (default: those of npfem)")
    verb.add_argument("-o", "--output", default="report.html", metavar="FILE.html", help="(default: report.html)")
    verb.add_argument("--results", metavar="FOLDER",
                      help="keep the numbers of each case there as JSON, and show those of earlier runs that are there")
    verb.add_argument("--no-run", action="store_true",
                      help="run nothing: draw the page from --results, of those that --case or --tier names")
    verb.add_argument("--no-page", action="store_true", help="run, and write no page")
    verb.add_argument("--keep", metavar="FOLDER", help="keep the scenes and output of the cases there")
    verb.add_argument("--list", action="store_true", help="name the cases and end")
    verb.add_argument("--json", action="store_true", help="print the records as JSON")
    verb.set_defaults(run=run)


def _check(options):
    if options.no_run and not options.results:
        raise ValueError("--no-run shows earlier results: name their folder with --results")
    if not options.no_page:
        require_writable(options.output)
    if not options.no_run:
        for folder in filter(None, (options.results, options.keep)):
            require_writable_folder(folder)


def _say(line):
    print(line, file=sys.stderr, flush=True)


def _chosen_cases(options):
    folder = options.cases or collection.default_folder()
    known = [(entry.case, entry) for entry in collection.find_cases(folder)]
    return collection.choose(known, folder, options.tier or TIERS[0], options.case)


def _kept_records(options):
    if not os.path.isdir(options.results):
        raise ValueError("--results %s: there is no such folder" % options.results)
    known = [(Case(**record["case"]), record) for record in collection.load(options.results)]
    chosen = collection.choose(known, options.results, options.tier, options.case)
    if not chosen:
        tier = " of tier " + options.tier if options.tier else ""
        raise ValueError("--results %s: there is no record of a case%s in it" % (options.results, tier))
    return chosen


def _run_cases(options):
    chosen = _chosen_cases(options)
    if options.results:
        collection.load(options.results)  # what is damaged there is told before the work
    records = []
    for entry in chosen:
        keep = os.path.join(options.keep, entry.case.id) if options.keep else None
        _say("%-4s %s (about %g s)" % (entry.case.id, entry.case.title, entry.case.cost_s))
        record = collection.run_case(entry, _say, keep)
        if record["missing"]:
            _say("%-4s could not run here: %s" % (entry.case.id, record["missing"]))
        if record["failure"]:
            _say("%-4s %s" % (entry.case.id, record["failure"]))
        if options.results:
            collection.save(record, options.results)
        records.append(record)
    return records


def _exit_code(records):
    ran = [record for record in records if not record["missing"]]
    return 0 if ran and all(collection.passed(record) for record in ran) else 1


def run(options):
    """Runs, writes the page, prints where it is; the exit code says whether all is well."""
    if options.list:
        for entry in _chosen_cases(options):
            print("%-4s %-8s %6g s  %s" % (entry.case.id, entry.case.tier, entry.case.cost_s, entry.case.title))
        return 0
    _check(options)
    records = _kept_records(options) if options.no_run else _run_cases(options)
    if not options.no_page:
        shown = records if options.no_run or not options.results else collection.load(options.results)

        def write(aside):
            with open(aside, "w", encoding="utf-8") as stream:
                write_page(shown, stream)

        write_aside(options.output, write)
        _say("wrote %s" % options.output)
    if options.json:
        print(json.dumps(records, indent=1))
    return _exit_code(records)
