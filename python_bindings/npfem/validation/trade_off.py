# SPDX-License-Identifier: MPL-2.0
"""Speed against error of a scene over the choices it can make: the diagrams from which the qualities of a scene come.

Needs numpy. Times are processor seconds of this machine: what a run takes on one thread, whatever else goes on.
"""
import dataclasses
import os
import re

import numpy

from .boundary_integral import Capsule
from .programs import RunFailed, run_scene, summary_of
from .scene_text import quantities, quantity, toml
from .tables import read_csv
from .tank_treading import shear_red_cell

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
    # Nodes under the surface at which fluid and cells meet; None: what the kernel adds to a sphere.
    inset: float = None
    # With mass and a penalty on the volume of its own, which the lineage's coupling needs: nothing else carries its
    # loads.
    filled: bool = False
    # With the lineage's coupling: the damping that it ships with (Calpha 0.9, Cbeta 0.01 us), or none.
    damped: bool = True
    # The scene names this quality and leaves dx, tau, precision, kernel and cell_every to it.
    quality: str = ""

    def label(self, base):
        """What differs from another choice."""
        changed = ["%s %s" % (field.name.replace("_um", "").replace("_", " "), getattr(self, field.name))
                   for field in dataclasses.fields(self) if getattr(self, field.name) != getattr(base, field.name)]
        if self.quality:
            return 'quality "%s"' % self.quality
        return ", ".join(changed) or "base"


BASE = Choice()

# One thing at a time.
VARIATIONS = (
    ("dx", [Choice(dx_um=dx) for dx in (1.0, 0.5, 0.4)]),
    ("tau", [Choice(tau=tau) for tau in (0.8, 1.0, 2.0, 4.0, 8.0, 12.0)]),
    ("cell_every", [Choice(cell_every=every) for every in (1, 2, 3, 5)]),
    ("kernel", [Choice(kernel=kernel) for kernel in (2, 3, 4)]),
    ("inset", [Choice(kernel=kernel, inset=0.0) for kernel in (2, 3, 4)]),
    ("level", [Choice(level=level) for level in (2, 3, 4)]),
    ("precision", [Choice(precision=precision) for precision in ("double", "float")]),
    ("scheme", [Choice(tau=1.0, scheme=scheme) for scheme in ("implicit", "peskin")]),
)

# The lineage's coupling beside ours on a capsule that it can move.
FILLED = [Choice(tau=1.0, filled=True)] + [Choice(tau=1.0, scheme="lineage", filled=True, damped=damped)
                                           for damped in (True, False)]

# What the qualities that a scene can name stand for (scene/quality.cpp); every run of one is checked against it.
QUALITIES = (
    Choice(tau=4.0, cell_every=2, kernel=3, precision="float", quality="fast"),
    Choice(cell_every=2, kernel=3, quality="balanced"),
    # Vertices must be as near to each other as the kernel is wide.
    Choice(dx_um=0.25, cell_every=2, kernel=4, level=4, quality="accurate"),
)


def _fluid(choice, viscosity, density):
    """([fluid] of a scene, time step in us)."""
    dt = (choice.tau - 0.5) * choice.dx_um ** 2 * density / (3 * viscosity)
    fluid = {"density": quantity(density, "kg/m3"), "dynamic_viscosity": quantity(viscosity / 1000, "mPa s")}
    if not choice.quality:
        fluid.update(time_step=quantity(dt, "us"), precision=choice.precision)
    return fluid, dt


def _spacing(choice):
    """What [domain] says of it."""
    return {} if choice.quality else {"dx": quantity(choice.dx_um, "um")}


def _coupling(choice):
    if choice.quality:
        return {}
    coupling = {"scheme": choice.scheme, "kernel": choice.kernel, "cell_every": choice.cell_every}
    return coupling if choice.inset is None else {**coupling, "inset": choice.inset}


def _named_quality(choice):
    return {"quality": choice.quality} if choice.quality else {}


def _require_meant(folder, choice):
    """RunFailed where a scene that named a quality was not run with what the quality stands for here."""
    if not choice.quality:
        return
    with open(os.path.join(folder, "scene.toml"), encoding="utf-8") as stream:
        lines = re.findall(r'^(\w+) = "?([^"\n]*)"?$', stream.read(), re.MULTILINE)
    run = dict(reversed(lines))  # the first of each name: the precision of the fluid comes before that of the solver
    meant = {"dx": quantity(choice.dx_um, "um"), "tau": "%g" % choice.tau, "precision": choice.precision,
             "kernel": str(choice.kernel), "cell_every": str(choice.cell_every)}
    for key, value in meant.items():
        if run.get(key) != value:
            raise RunFailed('quality "%s" was run with %s = %s, not %s' % (choice.quality, key, run.get(key), value))


def _whole(length_um, dx_um):
    return round(length_um / dx_um) * dx_um


def _processor_seconds():
    """Of all programs that were run and have ended."""
    times = os.times()
    return times.children_user + times.children_system


def _seconds_per_ms(folder, started_at):
    """Processor seconds since `started_at` per simulated millisecond of the run in `folder`."""
    return (_processor_seconds() - started_at) / (summary_of(folder)["time_us"] / 1000)


class CapsuleTrial:
    """A capsule of radius 4 um in shear, against the boundary integral."""

    name, unit, filled = "capsule", "% of D", FILLED
    # Allowed with each quality (docs/speed_and_error.md), and what is known not to run.
    allowed = {"fast": 4.5, "balanced": 3.0, "accurate": 2.0}
    unstable = {Choice(tau=12.0): "gdot T = 0.09 at 10 000 1/s, of 0.02 that npfem plan allows"}
    radius_um, rate, capillary, strain = 4.0, 1e-2, 0.15, 1.5  # um, 1/us
    # Of the box of 8 radii in D, per cent: 0.65 with 6, 0.70 with 4 nodes a radius, by runs in a box of 16 (C4).
    box_share = 0.65

    def prepare(self, report):
        """The yardstick."""
        del report
        for _, self.exact, _ in Capsule(self.capillary).shear(self.strain, 0.005):
            pass

    def run(self, report, choice, name):
        """(error, processor seconds per simulated ms)."""
        modulus = VISCOSITY * self.rate * self.radius_um / self.capillary
        length = _whole(8 * self.radius_um, choice.dx_um)
        fluid, dt = _fluid(choice, VISCOSITY, DENSITY)
        parameters = {"membrane_law": "neo_hookean", "shear_modulus": quantity(modulus, "uN/m")}
        if choice.filled:
            parameters.update(solid_density=quantity(DENSITY, "kg/m3"), global_volume_modulus="2 kPa",
                              global_volume_form="exact")
        with open(os.path.join(report.folder, name + "_capsule.toml"), "w", encoding="utf-8") as stream:
            stream.write(toml({
                "schema_version": 1, "name": "capsule", "description": "Capsule of a validation case.",
                "mesh": {"shape": "icosphere", "level": choice.level, "diameter": quantity(2 * self.radius_um, "um")},
                "parameters": parameters, "sources": {key: "Of the case." for key in parameters}}))
        started_at = _processor_seconds()
        folder = run_scene(report, name, {
            "schema_version": 1, "title": name, **_named_quality(choice),
            "domain": {"kind": "shear_box", "size": quantities([length] * 3, "um"), **_spacing(choice)},
            "fluid": fluid, "flow": {"shear_rate": quantity(self.rate * 1e6, "1/s"), "start": "developed"},
            "coupling": _coupling(choice), **({} if choice.damped else {"lineage": {"alpha": 0, "beta": "0 us"}}),
            "cells": [{"name": "capsule", "material": name + "_capsule.toml",
                       "positions": [{"centre": quantities([0.5 * length] * 3, "um")}]}],
            "run": {"steps": round(self.strain / (self.rate * dt))},
            "output": {"fluid": False, "cells": False, "table_every": quantity(0.1 / self.rate, "us")},
        }, threads=1)
        table = read_csv(os.path.join(folder, "cells.csv"))
        deformation = float(numpy.interp(self.strain / self.rate, table["time_us"], table["taylor_deformation"]))
        _require_meant(folder, choice)
        return 100 * (deformation / self.exact - 1) - self.box_share, _seconds_per_ms(folder, started_at)


class AgainstFiner:
    """A trial without an exact answer: errors are against its own run with the quality "accurate"."""

    filled, unstable = [], {}

    def prepare(self, report):
        """The value that the others are held against."""
        self.known = {QUALITIES[-1]: self.observe(report, QUALITIES[-1], "accurate")}
        self.exact = self.known[QUALITIES[-1]][0]
        report.measured("value that errors are held against", self.exact)

    def run(self, report, choice, name):
        """(error, processor seconds per simulated ms)."""
        value, seconds = self.known.get(choice) or self.observe(report, choice, name)
        return 100 * (value / self.exact - 1), seconds


class Extrapolated(AgainstFiner):
    """Errors are against runs at 0.25 and 0.4 um, carried on to dx = 0 with the square of dx."""

    def prepare(self, report):
        """The value that the others are held against."""
        fine = QUALITIES[-1]
        coarse = dataclasses.replace(fine, dx_um=0.4, quality="")
        self.known = {choice: self.observe(report, choice, "dx%g" % choice.dx_um) for choice in (fine, coarse)}
        near, far = self.known[fine][0], self.known[coarse][0]
        self.exact = near + (near - far) * fine.dx_um ** 2 / (coarse.dx_um ** 2 - fine.dx_um ** 2)
        report.measured("value extrapolated to dx = 0", self.exact)


class TankTreadingTrial(AgainstFiner):
    """A red cell that tank-treads in a viscous fluid: how far its membrane has gone round."""

    name, unit = "tank-treading red cell", "% of the turn"
    strain = 15.0
    unstable = {Choice(tau=12.0): "refused: the plates would move at Mach 0.35, 0.3 is allowed",
                Choice(tau=1.0, scheme="peskin"): "refused: it knows no viscosity of the membrane"}
    allowed = {"fast": 10.0, "balanced": 10.0}

    def observe(self, report, choice, name):
        """(cycles by the end, processor seconds per simulated ms)."""
        folder, started_at = os.path.join(report.folder, name), _processor_seconds()
        ours = shear_red_cell(report, name, 131.6, 28.9, strain=self.strain, dx_um=choice.dx_um,
                              relaxation_time=choice.tau, level=choice.level, box_um=(16.0, 16.0, 12.0),
                              coupling=_coupling(choice), precision=choice.precision, quality=choice.quality, threads=1)
        _require_meant(folder, choice)
        return ours.turned(self.strain), _seconds_per_ms(folder, started_at)


class TubeTrial(Extrapolated):
    """Red cells in a tube of 10 um: the flow they let through."""

    name, unit = "blood in a tube", "% of the flow rate"
    allowed = {"fast": 10.0, "balanced": 10.0, "accurate": 5.0}

    def observe(self, report, choice, name):
        """(mean flow rate over the last half, processor seconds per simulated ms)."""
        fluid, dt = _fluid(choice, VISCOSITY, 10 * DENSITY)
        started_at = _processor_seconds()
        centres = [(5.0, 5.0, 2.5 + 5.0 * n) for n in range(4)]
        folder = run_scene(report, name, {
            "schema_version": 1, "title": name, **_named_quality(choice),
            "domain": {"kind": "tube", "diameter": "10 um", "length": "20 um", **_spacing(choice)},
            "fluid": fluid, "flow": {"mean_velocity": "2 mm/s", "start": "developed"}, "coupling": _coupling(choice),
            "cells": [{"name": "rbc", "material": "rbc", "level": choice.level,
                       "positions": [{"centre": quantities(centre, "um")} for centre in centres]}],
            "run": {"steps": round(8000.0 / dt)},
            "output": {"fluid": False, "cells": False, "table_every": "100 us"},
        }, threads=1)
        _require_meant(folder, choice)
        flow = read_csv(os.path.join(folder, "rheology.csv"))["flow_rate_um3_per_us"]
        return sum(flow[len(flow) // 2:]) / len(flow[len(flow) // 2:]), _seconds_per_ms(folder, started_at)


def report_trade_off(report, trial):
    """Runs every variation, then the qualities that a scene can name; a diagram and a number for each."""
    plot = report.plot("Speed against error: %s" % trial.name, "processor s per simulated ms",
                       "size of the error (%s)" % trial.unit, x_log=True, y_log=True)
    known = {}
    trial.prepare(report)

    def measure(choice):
        if choice not in known:
            try:
                known[choice] = trial.run(report, choice, "run%d" % len(known))
            except RunFailed as failure:
                report.say("%-4s %s: %s" % (report.case.id, choice.label(BASE), failure))
                known[choice] = None
        return known[choice]

    def tell(choice, result):
        label = choice.label(BASE)
        if result is None:
            report.below("error with %s: the run failed" % label, float("nan"), 0, unit=trial.unit,
                         known_failure=trial.unstable.get(choice, ""))
            return
        if choice.quality:
            report.below("error with %s" % label, result[0], trial.allowed[choice.quality], unit=trial.unit)
        else:
            report.measured("error with %s" % label, result[0], unit=trial.unit)
        report.measured("time with %s" % label, result[1], unit="s/ms")

    series = list(VARIATIONS) + ([("filled", trial.filled)] if trial.filled else [])
    for name, choices in series:
        found = [(choice, measure(choice)) for choice in choices]
        good = [result for _, result in found if result]
        report.curve(plot, name, [seconds for _, seconds in good], [max(abs(error), 0.01) for error, _ in good],
                     points=name == "filled")
        for choice, result in found:
            tell(choice, result)
    for choice in QUALITIES:
        result = measure(choice)
        if choice.quality not in trial.allowed:  # the yardstick itself
            report.measured("time with %s" % choice.label(BASE), result[1], unit="s/ms")
            continue
        tell(choice, result)
        if result:
            report.curve(plot, choice.quality, [result[1]], [max(abs(result[0]), 0.01)], points=True)
