# SPDX-License-Identifier: MPL-2.0
"""What `npfem fit` has found: as lines to read, as JSON, as a material file."""
import json
import re

from . import literature


def _number(value):
    return "%.4g" % value


def _parameter_lines(fit):
    yield "%-28s %10s %-8s %-24s %s" % ("parameter", "value", "unit", "95 % interval", "literature")
    for row in fit["parameters"]:
        band = "no band"
        if row["band"]:
            band = "%g to %g: %s" % (row["band"] + ("inside" if row["inside_band"] else "outside",))
        yield "%-28s %10s %-8s %-24s %s" % (row["key"], _number(row["value"]), row["unit"],
                                            "%s to %s" % (_number(row["low"]), _number(row["high"])), band)


def _correlation_lines(fit):
    keys = [row["key"] for row in fit["parameters"]]
    if len(keys) < 2:
        return
    yield "correlations, in the order above"
    for row in fit["parameters"]:
        yield "%-28s %s" % (row["key"], " ".join("%+6.2f" % row["correlations"][key] for key in keys))


def _sensitivity_lines(fit):
    rows = fit["sensitivities"]
    if not rows:
        return
    ordered = sorted(rows, key=lambda row: row["force_pN"])
    shown = {row["force_pN"]: row for row in (ordered[0], ordered[len(ordered) // 2], ordered[-1])}
    yield "sensitivities d ln D / d ln p, axial/transverse, at %s pN" % ", ".join("%g" % force for force in shown)
    for parameter in fit["parameters"]:
        yield "%-28s %s" % (parameter["key"],
                            "  ".join("%+.3f/%+.3f" % row[parameter["key"]] for row in shown.values()))


def _identification_lines(fit):
    for row in fit["parameters"]:
        if not row["identified"]:
            yield "These data cannot identify %s: %s." % (row["key"], row["why_not"])
    for row in fit["parameters"]:
        if row["band"] and not row["inside_band"]:
            yield "%s lies outside what is known (%s)." % (row["key"], literature.PARAMETERS[row["key"]].source)


def lines(fit, setup):
    """The report, line by line."""
    yield from _parameter_lines(fit)
    yield from _correlation_lines(fit)
    yield from _sensitivity_lines(fit)
    if fit["points"]:
        yield "rms departure over %d points: axial %.2f %%, transverse %.2f %%" % (
            fit["points"], 100 * fit["rms_axial"], 100 * fit["rms_transverse"])
    if fit["recovery_s"] is not None:
        yield "time of recovery: %.3f s" % fit["recovery_s"]
    yield "%d iterations, %s" % (fit["iterations"], "converged" if fit["converged"] else "not converged")
    yield from _identification_lines(fit)
    if fit["points"]:
        yield ("The moduli hold for a %s contact %g um across (%d vertices, %.2f um2 of membrane, on each side): a "
               "wider one gives softer ones." % (setup.load, setup.contact_diameter_um, fit["contact_vertices"],
                                           fit["contact_area_um2"]))


def document(fit, setup, data):
    """The same as numbers."""
    kept = {key: value for key, value in fit.items() if key != "material"}
    return {"data": data, "load": setup.load, "contact_diameter_um": setup.contact_diameter_um, "level": setup.level,
            **kept}


def _source(row, fit, setup, data):
    text = "Fitted by npfem fit to %s; 95 %% interval %s to %s %s" % (data, _number(row["low"]), _number(row["high"]),
                                                                     row["unit"])
    text = text.rstrip()
    if fit["points"]:
        text += "; %s contact %g um across; rms error %.1f %% axial, %.1f %% transverse" % (
            setup.load, setup.contact_diameter_um, 100 * fit["rms_axial"], 100 * fit["rms_transverse"])
    text += "; mesh of %d vertices." % fit["mesh_vertices"]
    if row["band"]:
        text += " Literature: %s (%s)." % (("%g to %g " % row["band"] + row["unit"]).rstrip(),
                                         literature.PARAMETERS[row["key"]].source)
    if not row["identified"]:
        text += " Not identified by these data: %s." % row["why_not"]
    return text


def material_text(fit, setup, data, name):
    """The fitted material as a file, the reason of each fitted value under [sources]."""
    head, sources = fit["material"].to_text().split("\n[sources]\n")
    head = re.sub(r"(?m)^name = .*$", lambda _: "name = " + json.dumps(name, ensure_ascii=False), head, count=1)
    kept = [line for line in sources.splitlines()
            if line.split(" = ")[0] not in {row["key"] for row in fit["parameters"]}]
    own = ["%s = %s" % (row["key"], json.dumps(_source(row, fit, setup, data), ensure_ascii=False))
           for row in fit["parameters"]]
    return head + "\n[sources]\n" + "\n".join(own + kept) + "\n"
