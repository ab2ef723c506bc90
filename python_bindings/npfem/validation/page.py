# SPDX-License-Identifier: MPL-2.0
"""The page of a validation run: one HTML file with everything in it, curves as SVG. Needs matplotlib for the curves."""
import html
import io

from .case import Result, describe

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em; color: #222; }
h1 { font-size: 1.6em; } h2 { font-size: 1.15em; margin: 2em 0 .3em; }
table { border-collapse: collapse; width: 100%; font-size: 13px; }
th, td { text-align: left; padding: 3px 8px; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
td.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.pass { color: #176b2c; } .fail, .mended { color: #b3202c; font-weight: 600; } .known { color: #a05a00; }
.measured, .missing { color: #777; } pre { white-space: pre-wrap; font: inherit; color: #555; margin: .2em 0 .8em; }
svg { max-width: 100%; height: auto; }
"""

_WORDS = {"pass": "passes", "fail": "FAILS", "known": "fails, as known", "mended": "PASSES, MARKED AS FAILING",
          "measured": "measured"}
# What a record says of where it comes from; older ones do not.
_ORIGIN = ("version", "commit", "machine")
_COLOURS = ("#b3202c", "#1f5f8b", "#2f7d4f", "#8a4fa0", "#b07a1a", "#444444", "#d0608a", "#3aa0a0")


def _number(value, digits="%.4g"):
    return "" if value is None else digits % value


def _percent_or_number(result, value):
    if value is None:
        return ""
    return "%+.2g %%" % (100 * value) if result.relative else "%+.2g" % value


def _tolerance(result):
    if result.tolerance is None:
        return ""
    return "%.3g %%" % (100 * result.tolerance) if result.relative else "%.3g" % result.tolerance


def _row(record, result, first):
    case = record["case"]
    cells = ['<td>%s</td>' % ('<a href="#%s">%s</a>' % (case["id"], case["id"]) if first else ""),
             "<td>%s</td>" % html.escape(result.quantity + (" (%s)" % result.unit if result.unit else "")),
             '<td class="n">%s</td>' % _number(result.ours), '<td class="n">%s</td>' % _number(result.reference),
             '<td class="n">%s</td>' % _percent_or_number(result, result.error),
             '<td class="n">%s</td>' % _tolerance(result),
             '<td class="%s">%s</td>' % (result.verdict, _WORDS[result.verdict]),
             '<td class="n">%s</td>' % ("%.3g" % record["seconds"] if first else "")]
    return "<tr>%s</tr>" % "".join(cells)


def _trouble(record):
    if record["missing"]:
        return "missing", "could not run here: " + record["missing"]
    return "fail", "STOPPED: " + record["failure"]


def _table(records):
    lines = ["<table><tr><th>case</th><th>quantity</th><th>ours</th><th>reference</th><th>error</th><th>allowed</th>"
             "<th></th><th>s</th></tr>"]
    for record in records:
        results = [Result(**result) for result in record["results"]]
        lines += [_row(record, result, index == 0) for index, result in enumerate(results)]
        if record["missing"] or record["failure"]:
            kind, text = _trouble(record)
            lines.append('<tr><td><a href="#%s">%s</a></td><td class="%s" colspan="7">%s</td></tr>'
                         % (record["case"]["id"], record["case"]["id"], kind, html.escape(text)))
    return "\n".join(lines + ["</table>"])


def _draw(plot):
    """The plot as SVG, or a line where it cannot be drawn."""
    try:
        from matplotlib import rc_context
        from matplotlib.backends.backend_svg import FigureCanvasSVG
        from matplotlib.figure import Figure
    except ImportError:
        return '<p class="missing">%s: no picture without matplotlib</p>' % html.escape(plot["title"])
    with rc_context({"svg.hashsalt": "npfem", "svg.fonttype": "none", "font.family": "sans-serif"}):
        many = len(plot["curves"]) > 6  # then their names stand beside the picture, not over it
        figure = Figure(figsize=(9.6 if many else 7.2, 4.2))
        FigureCanvasSVG(figure)
        axes = figure.add_axes([0.08, 0.13, 0.66, 0.78] if many else [0.1, 0.13, 0.87, 0.78])
        for index, curve in enumerate(plot["curves"]):
            colour = _COLOURS[index % len(_COLOURS)]
            if curve["band"] is not None:
                axes.errorbar(curve["x"], curve["y"], yerr=curve["band"], fmt="o", color=colour, capsize=3,
                              markerfacecolor="white", label=curve["label"])
            elif curve["points"]:
                axes.plot(curve["x"], curve["y"], "o", color=colour, markerfacecolor="white", label=curve["label"])
            else:
                axes.plot(curve["x"], curve["y"], color=colour, linewidth=1.8, label=curve["label"])
        axes.set_xscale("log" if plot.get("x_log") else "linear")
        axes.set_yscale("log" if plot.get("y_log") else "linear")
        axes.set_xlabel(plot["x"])
        axes.set_ylabel(plot["y"])
        axes.set_title(plot["title"], loc="left", fontsize=11)
        axes.grid(True, color="#e6e6e6", linewidth=0.8)
        axes.set_axisbelow(True)
        beside = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0)} if many else {}
        axes.legend(frameon=False, fontsize=8, **beside)
        stream = io.StringIO()
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    text = stream.getvalue()
    return text[text.index("<svg"):]


def _origin(record):
    if not all(key in record for key in _ORIGIN):
        return ", code and machine not recorded"
    return " with npfem %s, commit %s, on %s" % tuple(record[key] or "unknown" for key in _ORIGIN)


def _origins(records):
    """The versions, commits and machines of all records."""
    lines = []
    for key, name, between in zip(_ORIGIN, ("npfem ", "commit ", "machine: "), (", ", ", ", "; ")):
        distinct = sorted({record[key] or "unknown" for record in records if key in record})
        if any(key not in record for record in records):
            distinct.append("not recorded")
        lines.append(name + between.join(distinct))
    return ". ".join(lines)


def _section(record):
    case = record["case"]
    parts = ['<h2 id="%s">%s. %s</h2>' % (case["id"], case["id"], html.escape(case["title"])),
             "<pre>%s</pre>" % html.escape(record["about"]),
             '<p class="measured">Source: %s. File: tests/validation/%s, tier %s, run on %s%s.</p>'
             % (html.escape(case["source"]), html.escape(record["file"]), case["tier"], record["date"],
                html.escape(_origin(record)))]
    for result in (Result(**result) for result in record["results"]):
        if result.known_failure:
            parts.append('<p class="%s">%s: %s</p>' % (result.verdict, html.escape(result.quantity),
                                                       html.escape(describe(result))))
    return "\n".join(parts + [_draw(plot) for plot in record["plots"]])


def _tally(records):
    verdicts = [Result(**result).verdict for record in records for result in record["results"]]
    words = ["%d numbers held against a reference" % sum(v != "measured" for v in verdicts)]
    for verdict, word in (("pass", "pass"), ("known", "fail as known"), ("fail", "fail"),
                          ("mended", "pass though marked as failing")):
        count = verdicts.count(verdict)
        if count or verdict in ("pass", "known", "fail"):
            words.append('<span class="%s">%d %s</span>' % (verdict, count, word))
    stopped = sum(bool(record["failure"]) for record in records)
    missing = sum(bool(record["missing"]) for record in records)
    if stopped:
        words.append('<span class="fail">%d cases stopped</span>' % stopped)
    if missing:
        words.append('<span class="missing">%d cases could not run here</span>' % missing)
    return ", ".join(words)


def write_page(records, stream):
    """Writes the page of the records of cases."""
    stream.write("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>npfem: validation</title>"
                 "<style>%s</style></head><body>\n<h1>npfem: validation</h1>\n" % _STYLE)
    stream.write("<p>%s. %d cases, %.3g s: %s.</p>\n" % (html.escape(_origins(records)), len(records),
                                                         sum(record["seconds"] for record in records), _tally(records)))
    stream.write(_table(records) + "\n")
    for record in records:
        stream.write(_section(record) + "\n")
    stream.write("</body></html>\n")
