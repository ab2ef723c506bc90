# SPDX-License-Identifier: MPL-2.0
"""`npfem relax`: a stretched cell let go, its time of recovery beside the cells of Hochmuth et al. 1979."""
import math
import sys

from . import recovery
from ._arguments import add_level
from ._files import require_png, require_writable, write_aside, write_json
from .material import Material

_SHOWN_S = (0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6)
_VISCOSITY = "membrane_shear_viscosity"


def add_to(verbs):
    """Adds the verb to the command line."""
    verb = verbs.add_parser(
        "relax", help="let a stretched cell go and time its recovery",
        description="Pulls one cell along x to a ratio of length to width, lets it go without fluid, and fits the law "
                    "of Hochmuth et al. 1979 to its recovery.")
    verb.add_argument("--material", default="rbc-viscous",
                      help="a preset or a material file (.toml); default: rbc-viscous")
    verb.add_argument("--viscosity", type=float, metavar="UN_S_PER_M",
                      help="shear viscosity of the membrane, uN s/m (default: the material's own)")
    verb.add_argument("--ratio", type=float, default=recovery.STRETCHED_RATIO,
                      help="length over width at the release (default: 2)")
    add_level(verb)
    verb.add_argument("--step", type=float, default=recovery.STEP_MS, metavar="MS", help="time step, ms (default: 10)")
    verb.add_argument("--duration", type=float, default=recovery.DURATION_S, metavar="S",
                      help="how long the cell is followed, s (default: 0.6)")
    verb.add_argument("--json", metavar="FILE", help="write the results as JSON")
    verb.add_argument("--plot", metavar="FILE.png", default="relax.png",
                      help="picture of the recovery (default: relax.png)")
    verb.add_argument("--no-plot", action="store_true", help="draw no picture")
    verb.set_defaults(run=run)


def _compute(options):
    """(viscosity in uN s/m, times, ratios, ratio at rest)."""
    with Material.named(options.material) as material:
        if options.viscosity is not None:
            if not (math.isfinite(options.viscosity) and options.viscosity > 0):
                raise ValueError("--viscosity %g: a positive number is needed, uN s/m" % options.viscosity)
            material[_VISCOSITY] = 1e6 * options.viscosity
        if material[_VISCOSITY] == 0.0:
            raise ValueError("the material %s has no %s: give --viscosity, for example 0.5 (uN s/m)"
                             % (options.material, _VISCOSITY))
        return (1e-6 * material[_VISCOSITY],) + recovery.recover(
            material, options.level, options.ratio, options.step, options.duration)


def _draw(options, times, ratios, time_constant_s):
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        print("no picture: matplotlib is not installed for %s" % sys.executable)
        return
    from .curve_plot import plot_recovery

    title = "%s, t_c = %.3f s" % (options.material, time_constant_s)
    write_aside(options.plot, lambda aside: plot_recovery(times, ratios, aside, title))
    print("wrote %s" % options.plot)


def run(options):
    """Computes, prints, writes; returns the exit code."""
    if options.json:
        require_writable(options.json)
    if not options.no_plot:
        require_png(options.plot)
    viscosity, times, ratios, at_rest = _compute(options)
    time_constant_s = recovery.fit(times, ratios, at_rest)
    print("time(s)  length/width")
    step_s = times[1] - times[0]
    for shown in _SHOWN_S:
        nearest = round(shown / step_s)
        if nearest < len(times):
            print("%7.3f %13.4f" % (times[nearest], ratios[nearest]))
    print("membrane viscosity %g uN s/m: t_c = %.4f s; measured (Hochmuth et al. 1979): %g s, mean of four cells, "
          "0.110 and 0.105 s of cells 1 and 2" % (viscosity, time_constant_s, recovery.HOCHMUTH_1979_TIME_S))
    if options.json:
        write_json(options.json, {"material": options.material, "membrane_shear_viscosity_uN_s_per_m": viscosity,
                                  "time_constant_s": time_constant_s, "ratio_at_rest": at_rest, "time_s": times,
                                  "length_over_width": ratios})
    if not options.no_plot:
        _draw(options, times, ratios, time_constant_s)
    return 0
