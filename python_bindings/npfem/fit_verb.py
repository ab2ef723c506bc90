# SPDX-License-Identifier: MPL-2.0
"""`npfem fit`: parameters of a material from measured cells, with what the data cannot tell."""
import math
import os
import sys

from . import fit_data, fit_report, literature
from ._arguments import add_level
from ._files import require_png, require_writable, write_aside, write_json
from .material import Material
from .tweezers import CONTACT_DIAMETER_UM, LOADS


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser(
        "fit", help="fit a material to measured cells",
        description="Varies parameters of a material until one cell, pulled by two beads and let go, follows measured "
                    "cells; prints intervals of confidence, correlations, and what the data cannot identify.")
    verb.add_argument("--material", default="rbc", help="a preset or a material file (.toml); default: rbc")
    verb.add_argument("--free", metavar="KEY,KEY", help="parameters to fit, of: %s; default: shear_modulus, and "
                      "%s with --relaxation" % (", ".join(literature.PARAMETERS), literature.FITTED_BY_RECOVERY))
    verb.add_argument("--data", nargs="*", default=["mills2004"], metavar="DATA",
                      help="points of stretching: mills2004 (default), or files with the columns "
                           + ", ".join(fit_data.STRETCHING_COLUMNS))
    verb.add_argument("--relaxation", nargs="+", default=[], metavar="DATA",
                      help="recoveries: hochmuth1979, or files, one per cell, with the columns "
                           + ", ".join(fit_data.RECOVERY_COLUMNS))
    add_level(verb)
    verb.add_argument("--load", choices=LOADS, default="rigid",
                      help="rigid: beads hold their contact together; shared: the force is split over free vertices")
    verb.add_argument("--contact", type=float, default=CONTACT_DIAMETER_UM, metavar="UM",
                      help="diameter of a bead's contact, um (default: 2)")
    verb.add_argument("-o", "--output", metavar="FILE.toml", help="write the fitted material")
    verb.add_argument("--plot", metavar="FILE.png", help="draw the fitted curve over the points")
    verb.add_argument("--json", metavar="FILE", help="write the results as JSON")
    verb.set_defaults(run=run)


def _check(options):
    if not options.data and not options.relaxation:
        raise ValueError("--data: name what was measured: mills2004 or files that end in .csv; only with --relaxation "
                         "may it be empty")
    if not (math.isfinite(options.contact) and options.contact > 0):
        raise ValueError("--contact %g: a positive diameter is needed, um" % options.contact)
    if options.output:
        if not options.output.endswith(".toml"):
            raise ValueError("-o %s: a name that ends in .toml is needed" % options.output)
        require_writable(options.output)
    if options.json:
        require_writable(options.json)
    if options.plot:
        require_png(options.plot)
        import matplotlib  # noqa: F401: what is missing is told before the work


def _free(options):
    if options.free is not None:
        return [key.strip() for key in options.free.split(",")]
    return (["shear_modulus"] if options.data else []) + ([literature.FITTED_BY_RECOVERY] if options.relaxation else [])


def _progress(iteration, values, sum_of_squares):
    shown = ", ".join("%s %.4g" % pair for pair in values.items())
    print("iteration %d: %s; weighted sum of squares %.4g" % (iteration, shown, sum_of_squares), flush=True)


def _write_material(path, found, setup, data):
    text = fit_report.material_text(found, setup, data, os.path.splitext(os.path.basename(path))[0])
    Material.parse(text).close()

    def write(aside):
        with open(aside, "w", encoding="utf-8") as stream:
            stream.write(text)

    write_aside(path, write)
    print("wrote %s" % path)


def _draw(options, found, measured):
    from .curve_plot import plot_stretch

    title = "fitted %s, %s load, contact %g µm" % (options.material, options.load, options.contact)
    write_aside(options.plot, lambda aside: plot_stretch(found["rows"], aside, title, measured.points, "measured"))
    print("wrote %s" % options.plot)


def _failure(found):
    """Why the result must not be used, or ""."""
    stopped = [row["key"] for row in found["parameters"] if row["at_bound"]]
    if stopped:
        return "%s ended at the limit of the search: leave it out of --free, or give other data" % " and ".join(stopped)
    return "" if found["converged"] else "the search has not converged"


def run(options):
    """Fits, prints, writes; returns the exit code."""
    from .fitting import Measured, Setup, fit  # needs numpy, which the other verbs do without

    _check(options)
    measured = Measured([point for name in options.data for point in fit_data.stretching(name)],
                        [fit_data.recovery_time(name) for name in options.relaxation])
    setup = Setup(options.level, options.load, options.contact)
    data = " and ".join([os.path.basename(name) for name in options.data + options.relaxation])
    with Material.named(options.material) as material:
        found = fit(material, _free(options), measured, setup, _progress)
    for line in fit_report.lines(found, setup):
        print(line)
    if options.json:
        write_json(options.json, fit_report.document(found, setup, data))
    failure = _failure(found)
    if options.output and not failure:
        _write_material(options.output, found, setup, data)
    if options.plot and measured.points:
        _draw(options, found, measured)
    if failure:
        print("npfem fit: %s%s" % (failure, "; no material is written" if options.output else ""), file=sys.stderr)
        return 1
    return 0
