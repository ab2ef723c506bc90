# SPDX-License-Identifier: MPL-2.0
"""`npfem stretch`: the optical-tweezers experiment, as a table, JSON and a picture over the measured points."""
import math
import sys

from ._arguments import add_level
from ._files import require_png, require_writable, write_aside, write_json
from .tweezers import CONTACT_DIAMETER_UM, LOADS, pull
from .tweezers_data import MILLS_2004, loaded_forces, rms_errors

_MOST_FORCES = 10000
_COLUMNS = ("force_pN", "axial_um", "transverse_um", "volume_error", "area_error", "residual_pN", "iterations",
            "status")


def parse_forces(text):
    """Forces of "start:stop:step" (the stop included) or "0,25,50", in pN."""
    try:
        if ":" in text:
            start, stop, step = (float(part) for part in text.split(":"))
            if not (math.isfinite(start + stop + step) and step > 0 and 0 <= start <= stop):
                raise ValueError
            # The tolerance keeps the stop where the step does not divide the range exactly in binary.
            count = math.floor((stop - start) / step + 1e-9) + 1
            forces = [start + index * step for index in range(min(count, _MOST_FORCES + 1))]
        else:
            forces = [float(part) for part in text.split(",")]
        if len(forces) > _MOST_FORCES or not all(math.isfinite(force) and force >= 0 for force in forces):
            raise ValueError
    except ValueError:
        raise ValueError('--force "%s": expected start:stop:step, for example 0:200:25, or a list, for example '
                         "0,50,100; in pN, not negative, at most %d of them" % (text, _MOST_FORCES)) from None
    return sorted(set(forces))


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser("stretch", help="pull a cell apart as optical tweezers do",
                            description="Pulls one cell along x by two beads and prints its diameters at rest under "
                                        "each force, beside the red cells measured by Mills et al. 2004.")
    verb.add_argument("--material", default="rbc", help="a preset or a material file (.toml); default: rbc")
    verb.add_argument("--force", default="0:200:25", metavar="FORCES",
                      help="start:stop:step, the stop included, or a comma-separated list, pN (default: 0:200:25)")
    add_level(verb)
    verb.add_argument("--load", choices=LOADS, default="rigid",
                      help="rigid: beads hold their contact together; shared: the force is split over free vertices")
    verb.add_argument("--contact", type=float, default=CONTACT_DIAMETER_UM, metavar="UM",
                      help="diameter of a bead's contact, um (default: 2)")
    verb.add_argument("--no-measured", action="store_true",
                      help="leave out the measured red cells and their forces")
    verb.add_argument("--json", metavar="FILE", help="write the results as JSON")
    verb.add_argument("--plot", metavar="FILE.png", default="stretch.png",
                      help="picture of the curve (default: stretch.png)")
    verb.add_argument("--no-plot", action="store_true", help="draw no picture")
    verb.set_defaults(run=run)


def _table_line(row):
    shape = "         -               -           -         -"
    if row["usable"]:
        shape = "%10.3f %15.3f %11.3f %9.3f" % (row["axial_um"], row["transverse_um"], 100 * row["volume_error"],
                                                100 * row["area_error"])
    return "%9.2f %s %13.2e %11d  %s" % (row["force_pN"], shape, row["residual_pN"], row["iterations"], row["status"])


def _compute(options, asked):
    """All rows, at the forces asked for and the measured ones; those asked for are printed as they come."""
    forces = asked if options.no_measured else asked + loaded_forces(asked[-1])
    rows = []
    for row in pull(options.material, forces, options.level, options.load, options.contact):
        if not rows:
            print("force(pN)  axial(um)  transverse(um)  volume(%)  area(%)  residual(pN)  iterations  status")
        rows.append(row)
        if row["force_pN"] in asked or not row["usable"]:
            print(_table_line(row), flush=True)
    return rows


def _document(options, asked, rows, errors):
    def picked(chosen):
        return [{key: row[key] for key in _COLUMNS} for row in chosen]

    document = {
        "material": options.material,
        "load": options.load,
        "contact_diameter_um": options.contact,
        "results": picked([row for row in rows if row["force_pN"] in asked or not row["usable"]]),
    }
    if errors:
        measured = loaded_forces(asked[-1])
        document["mills_2004"] = {"rms_axial": errors[0], "rms_transverse": errors[1], "points": errors[2],
                                  "results": picked([row for row in rows if row["force_pN"] in measured])}
    return document


def _draw(options, rows):
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        print("no picture: matplotlib is not installed for %s" % sys.executable)
        return
    from .curve_plot import plot_stretch

    title = "%s, %s load, contact %g µm" % (options.material, options.load, options.contact)
    write_aside(options.plot, lambda aside: plot_stretch(rows, aside, title, () if options.no_measured else MILLS_2004))
    print("wrote %s" % options.plot)


def run(options):
    """Computes, prints, writes; returns the exit code."""
    asked = parse_forces(options.force)
    if options.json:
        require_writable(options.json)
    if not options.no_plot:
        require_png(options.plot)
    rows = _compute(options, asked)
    errors = None if options.no_measured else rms_errors(rows)
    if errors:
        print("rms departure from Mills et al. 2004 over %d points: axial %.1f %%, transverse %.1f %%"
              % (errors[2], 100 * errors[0], 100 * errors[1]))
    if options.json:
        write_json(options.json, _document(options, asked, rows, errors))
    if not options.no_plot:
        _draw(options, rows)
    if not rows[-1]["usable"]:
        print("npfem stretch: no equilibrium found under %g pN: %s" % (rows[-1]["force_pN"], rows[-1]["message"]),
              file=sys.stderr)
        return 1
    return 0
