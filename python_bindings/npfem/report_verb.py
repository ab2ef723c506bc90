# SPDX-License-Identifier: MPL-2.0
"""`npfem report`: runs validation cases and writes the page that shows them."""
import json
import os
import platform
import sys

from ._files import require_writable, write_aside
from ._library import version
from .validation import TIERS, collection
from .validation.page import write_page


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser("report", help="run the validation cases and write their page",
                            description="Runs the validation cases of a tier and writes one HTML page: every number "
                                        "beside theory, measured blood and other codes.")
    verb.add_argument("--tier", choices=TIERS, default="ci",
                      help="ci: a minute; nightly: an hour; release: a day on two cores; each with the quicker ones "
                           "(default: ci)")
    verb.add_argument("--case", action="append", default=[], metavar="ID", help="this case only (may be repeated)")
    verb.add_argument("--cases", metavar="FOLDER", help="folder of the case files (default: those of npfem)")
    verb.add_argument("-o", "--output", default="report.html", metavar="FILE.html", help="(default: report.html)")
    verb.add_argument("--results", metavar="FOLDER",
                      help="keep the numbers of each case there as JSON, and show those of earlier runs that are there")
    verb.add_argument("--no-run", action="store_true", help="run nothing: draw the page from --results")
    verb.add_argument("--no-page", action="store_true", help="run, and write no page")
    verb.add_argument("--keep", metavar="FOLDER", help="keep the scenes and output of the cases there")
    verb.add_argument("--list", action="store_true", help="name the cases and end")
    verb.add_argument("--json", action="store_true", help="print the records as JSON")
    verb.set_defaults(run=run)


def machine_line():
    """Processor and number of cores."""
    name = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            name = next((line.split(":", 1)[1].strip() for line in stream if line.startswith("model name")), name)
    except OSError:
        pass
    return "%s, %d cores" % (name, os.cpu_count() or 1)


def _check(options):
    if not options.no_page:
        require_writable(options.output)
    if options.no_run and not options.results:
        raise ValueError("--no-run shows earlier results: name their folder with --results")


def _say(line):
    print(line, file=sys.stderr, flush=True)


def _run_cases(options, chosen):
    records = []
    for entry in chosen:
        keep = os.path.join(options.keep, entry.case.id) if options.keep else None
        _say("%-4s %s (about %g s)" % (entry.case.id, entry.case.title, entry.case.cost_s))
        record = collection.run_case(entry, _say, keep)
        if record["missing"] or record["failure"]:
            _say("%-4s %s" % (entry.case.id, record["missing"] or record["failure"]))
        if options.results:
            collection.save(record, options.results)
        records.append(record)
    return records


def run(options):
    """Runs, writes the page, prints where it is; the exit code says whether all is well."""
    _check(options)
    cases = collection.find_cases(options.cases or collection.default_folder())
    chosen = collection.choose(cases, options.tier, options.case)
    if options.list:
        for entry in chosen:
            print("%-4s %-8s %6g s  %s" % (entry.case.id, entry.case.tier, entry.case.cost_s, entry.case.title))
        return 0
    records = [] if options.no_run else _run_cases(options, chosen)
    shown = collection.load(options.results) if options.results else records
    if options.no_run:
        records = shown
    if not options.no_page:
        info = "npfem %s, %s" % (version(), os.environ.get("NPFEM_COMMIT", "commit unknown"))

        def write(aside):
            with open(aside, "w", encoding="utf-8") as stream:
                write_page(shown, stream, machine_line(), info)

        write_aside(options.output, write)
        _say("wrote %s" % options.output)
    if options.json:
        print(json.dumps(records, indent=1))
    return 0 if all(collection.passed(record) for record in records) else 1
