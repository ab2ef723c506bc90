# SPDX-License-Identifier: MPL-2.0
"""Speed against error of a scene over the choices it can make: the diagrams from which the qualities of a scene come."""
import dataclasses
import os

import numpy

from .boundary_integral import Capsule
from .programs import RunFailed, run_scene, summary_of
from .scene_text import quantities, quantity, toml
from .tables import read_csv

VISCOSITY = 1200.0  # of plasma, fg/(um us)
DENSITY = 1025.0


@dataclasses.dataclass(frozen=True)
class Choice:
    """What a scene may choose."""
    dx_um: float = 0.5
    tau: float = 2.0
    cell_every: int = 1
    kernel: int = 4
    level: int = 3
    precision: str = "double"
    scheme: str = "implicit"

    def label(self, base):
        """What differs from another choice."""
        changed = ["%s %s" % (field.name.replace("_um", "").replace("_", " "), getattr(self, field.name))
                   for field in dataclasses.fields(self) if getattr(self, field.name) != getattr(base, field.name)]
        return ", ".join(changed) or "base"


BASE = Choice()

# One thing at a time.
VARIATIONS = (
    ("dx", [Choice(dx_um=dx) for dx in (1.0, 0.8, 0.5, 0.4)]),
    ("tau", [Choice(tau=tau) for tau in (0.8, 1.0, 2.0, 4.0, 8.0, 12.0)]),
    ("cell_every", [Choice(cell_every=every) for every in (1, 2, 3, 5)]),
    ("kernel", [Choice(kernel=kernel) for kernel in (2, 3, 4)]),
    ("level", [Choice(level=level) for level in (2, 3, 4)]),
    ("precision", [Choice(precision=precision) for precision in ("double", "float")]),
    ("scheme", [Choice(tau=1.0, scheme=scheme) for scheme in ("implicit", "peskin", "lineage")]),
)

# The qualities that a scene can name (scene/quality.h).
QUALITIES = {
    "fast": Choice(dx_um=0.625, tau=4.0, kernel=3, level=2, precision="float"),
    "balanced": Choice(dx_um=0.5, tau=2.0, kernel=3),
    "accurate": Choice(dx_um=0.3125, tau=2.0, kernel=3),
}


class CapsuleTrial:
    """A capsule of radius 4 um in shear."""

    name, unit = "capsule", "% of D"
    radius_um, rate, capillary, strain = 4.0, 5e-3, 0.15, 1.5  # um, 1/us
    # Of the box of 8 radii, measured with one of 16 (case C4), per cent of D.
    box_share = 0.9

    def __init__(self):
        for _, self.exact, _ in Capsule(self.capillary).shear(self.strain, 0.005):
            pass

    def run(self, report, choice, name):
        """(error, seconds per simulated ms)."""
        modulus = VISCOSITY * self.rate * self.radius_um / self.capillary
        length = round(8 * self.radius_um / choice.dx_um) * choice.dx_um
        dt = (choice.tau - 0.5) * choice.dx_um ** 2 * DENSITY / (3 * VISCOSITY)
        with open(os.path.join(report.folder, "capsule.toml"), "w", encoding="utf-8") as stream:
            stream.write(toml({
                "schema_version": 1, "name": "capsule", "description": "Capsule of a validation case.",
                "mesh": {"shape": "icosphere", "level": choice.level, "diameter": quantity(2 * self.radius_um, "um")},
                "parameters": {"membrane_law": "neo_hookean", "shear_modulus": quantity(modulus, "uN/m")},
                "sources": {"membrane_law": "Of the case."}}))
        folder = run_scene(report, name, {
            "schema_version": 1, "title": name,
            "domain": {"kind": "shear_box", "size": quantities([length] * 3, "um"), "dx": quantity(choice.dx_um, "um")},
            "fluid": {"density": quantity(DENSITY, "kg/m3"), "dynamic_viscosity": quantity(VISCOSITY / 1000, "mPa s"),
                      "time_step": quantity(dt, "us"), "precision": choice.precision},
            "flow": {"shear_rate": quantity(self.rate * 1e6, "1/s"), "start": "developed"},
            "coupling": {"scheme": choice.scheme, "kernel": choice.kernel, "cell_every": choice.cell_every},
            "cells": [{"name": "capsule", "material": "capsule.toml",
                       "positions": [{"centre": quantities([0.5 * length] * 3, "um")}]}],
            "run": {"steps": round(self.strain / (self.rate * dt))},
            "output": {"fluid": False, "cells": False, "table_every": quantity(0.1 / self.rate, "us")},
        })
        table, summary = read_csv(os.path.join(folder, "cells.csv")), summary_of(folder)
        deformation = float(numpy.interp(self.strain / self.rate, table["time_us"], table["taylor_deformation"]))
        error = 100 * (deformation / self.exact - 1) - self.box_share
        return error, summary["wall_s"] / (summary["time_us"] / 1000)


def report_trade_off(report, trial):
    """Runs every variation and the qualities; a diagram and a number for each."""
    plot = report.plot("Speed against error: %s" % trial.name, "s per simulated ms", "size of the error (%s)" % trial.unit,
                       x_log=True, y_log=True)
    known = {}

    def measure(choice):
        if choice not in known:
            try:
                known[choice] = trial.run(report, choice, "run%d" % len(known))
            except RunFailed as failure:
                report.say("%-4s %s: %s" % (report.case.id, choice.label(BASE), failure))
                known[choice] = None
        return known[choice]

    for name, choices in VARIATIONS:
        found = [(choice, measure(choice)) for choice in choices]
        good = [result for _, result in found if result]
        report.curve(plot, name, [seconds for _, seconds in good], [max(abs(error), 0.01) for error, _ in good])
        for choice, result in found:
            if result is None:
                report.measured("%s: no result (unstable)" % choice.label(BASE), float("nan"))
                continue
            report.measured("error with %s" % choice.label(BASE), result[0], unit=trial.unit)
            report.measured("time with %s" % choice.label(BASE), result[1], unit="s/ms")
    for name, choice in QUALITIES.items():
        result = measure(choice)
        if result is None:
            continue
        report.measured('error of quality "%s"' % name, result[0], unit=trial.unit)
        report.measured('time of quality "%s"' % name, result[1], unit="s/ms")
        report.curve(plot, name, [result[1]], [max(abs(result[0]), 0.01)], points=True)
