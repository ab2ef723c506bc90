# SPDX-License-Identifier: MPL-2.0
"""A red cell in a glass capillary of 6.6 um, narrower than the cell: its speed and length under a pressure gradient.

The cell starts squeezed to a drum that fits and takes the shape of a parachute or bullet. Saline of 1.003 mPa s,
cytoplasm six times as viscous. Measured: v = 0.0219 cm/s per mmHg/mm (28 cells, linear), length 7.9 um at 0.12 cm/s
with a scatter of 0.5 to 0.8 um. In a capillary of millimetres one cell does not change the flow, whose mean velocity is
that of saline alone, U = G R^2/(8 mu); our tube is periodic, one cell in every 18 um, and at the same gradient flows
slower. So it is driven twice: at 5 mmHg/mm, which gives its resistance, to be held against Pries' law for a tube full
of such cells; then by so much more. The speed is that at which, between the two runs, the fluid flows as saline does at
5 mmHg/mm; the length is the second run's. Tolerance 10 % and 15 %; Mirheo is off by 6 % in the mean and 9.6 % rms in
speed. The density is ten times the true one; Re = 0.1. Known weakness: after 30 ms the cell still lengthens.
"""
import math
import os

import npfem
import numpy
from npfem.validation import Case, read_csv, run_scene
from npfem.validation.cells_file import write_cells
from npfem.validation.scene_text import quantity
from npfem.vtk_files import read_pvd, read_vtu

CASE = Case(id="R5", title="Red cell in a capillary of 6.6 um", tier="nightly", cost_s=500,
            source="Tomaiuolo, Simeone, Martinelli, Rotoli & Guido, Soft Matter 5 (2009) 3736")

_DIAMETER_UM, _LENGTH_UM, _DX_UM = 6.6, 18.0, 0.3
_LEVEL = 4  # vertices as near to each other as the kernel is wide
_GRADIENT_MMHG_PER_MM = 5.0
_PASCAL_PER_M = 133.322e3 * _GRADIENT_MMHG_PER_MM
_CELL_UM3 = 92.0
_RESISTANCE = ("Pries' laws have cells 1.5 times as fast as the fluid in this tube, those measured here 1.21 times as "
               "fast: a plug that moves so, c^2 = 0.65 of the section, resists 1.26 times as much as saline already "
               "where it is as long as our cell, 1/(1 - c^4) over its length")
# speed (cm/s), length (um)
TOMAIUOLO_LENGTH = ((0.019, 7.19), (0.12, 7.88), (0.44, 9.01), (0.86, 8.84), (1.56, 9.53))


def _squeezed():
    """Triangles and positions of the cell, its axis along the tube, narrowed to fit at the same volume."""
    with npfem.Material.preset("rbc") as material, material.mesh(_LEVEL) as mesh:
        points = numpy.array(mesh.positions, dtype=float).reshape(-1, 3)
        triangles = numpy.array(mesh.triangles).ravel()
    narrowing = (0.5 * _DIAMETER_UM - 0.6) / numpy.hypot(points[:, 0], points[:, 1]).max()
    points *= numpy.array([narrowing, narrowing, narrowing ** -2])
    return triangles, points + numpy.array([0.5 * _DIAMETER_UM, 0.5 * _DIAMETER_UM, 0.5 * _LENGTH_UM])


def pries(diameter_um, tube_haematocrit):
    """Relative apparent viscosity of a tube full of blood, by its tube haematocrit (Pries et al. 1992)."""
    d = diameter_um
    low, high = 0.0, 1.0
    for _ in range(60):
        discharge = 0.5 * (low + high)
        share = discharge + (1 - discharge) * (1 + 1.7 * math.exp(-0.415 * d) - 0.6 * math.exp(-0.011 * d))
        low, high = (discharge, high) if discharge * share < tube_haematocrit else (low, discharge)
    steep = 1 / (1 + 1e-11 * d**12)
    power = (0.8 + math.exp(-0.075 * d)) * (steep - 1) + steep
    at_45 = 220 * math.exp(-1.3 * d) + 3.2 - 2.44 * math.exp(-0.06 * d**0.645)
    return 1 + (at_45 - 1) * ((1 - discharge) ** power - 1) / (0.55**power - 1)


class _Driven:
    """speed, mean: of cell and fluid over the last third, um/us; length: um; volume: of the cell over the first."""

    def __init__(self, folder):
        table = read_csv(os.path.join(folder, "cells.csv"))
        late = len(table["time_us"]) * 2 // 3
        self.speed = (table["centre_z_um"][-1] - table["centre_z_um"][late]) / (table["time_us"][-1]
                                                                                - table["time_us"][late])
        self.volume = table["volume_um3"][-1] / table["volume_um3"][0]
        self.lengths = [float(numpy.ptp(numpy.asarray(read_vtu(path).points)[:, 2]))
                        for _, path in read_pvd(os.path.join(folder, "cells.pvd"))]
        flow = read_csv(os.path.join(folder, "rheology.csv"))["mean_velocity_um_per_us"]
        self.mean = sum(flow[2 * len(flow) // 3:]) / len(flow[2 * len(flow) // 3:])


def _drive(report, name, pascal_per_m):
    """The squeezed cell from rest under that gradient for 30 ms."""
    density, viscosity = 10000.0, 1003.0
    dt = 1.5 * _DX_UM ** 2 * density / (3 * viscosity)
    time_us = 30000.0
    return _Driven(run_scene(report, name, {
        "schema_version": 1, "title": "Red cell in a capillary",
        "domain": {"kind": "tube", "diameter": quantity(_DIAMETER_UM, "um"), "length": quantity(_LENGTH_UM, "um"),
                   "dx": quantity(_DX_UM, "um")},
        "fluid": {"density": quantity(density, "kg/m3"), "dynamic_viscosity": quantity(viscosity / 1000, "mPa s"),
                  "time_step": quantity(dt, "us")},
        "coupling": {"cell_every": 2},
        "flow": {"pressure_gradient": quantity(pascal_per_m, "Pa/m"), "start": "rest"},
        "cells": [{"name": "rbc", "material": "rbc", "level": _LEVEL, "interior_viscosity_ratio": 6.0}],
        "placement": {"file": "squeezed.cells"},
        "run": {"steps": round(time_us / dt)},
        "output": {"table_every": "300 us", "cells_every": "3000 us", "fluid": False, "into_box": False},
    }))


def run(report):
    """At the gradient of the measurement, then beyond its flow."""
    triangles, points = _squeezed()
    write_cells(os.path.join(report.folder, "squeezed.cells"), "rbc", triangles, [points.ravel()])
    saline = 1e-12 * _PASCAL_PER_M * _DIAMETER_UM**2 / (32 * 1.003e-3)  # mean velocity, um/us
    measured = 0.0219 * _GRADIENT_MMHG_PER_MM  # cm/s
    same_gradient = _drive(report, "same_gradient", _PASCAL_PER_M)
    haematocrit = _CELL_UM3 / (math.pi / 4 * _DIAMETER_UM**2 * _LENGTH_UM)
    resistance = saline / same_gradient.mean
    report.compare("resistance of the tube over that without cells", resistance, pries(_DIAMETER_UM, haematocrit),
                   relative=0.15, known_failure=_RESISTANCE)
    ours = _drive(report, "same_flow", _PASCAL_PER_M * resistance)
    share = (saline - same_gradient.mean) / (ours.mean - same_gradient.mean)
    speed = same_gradient.speed + share * (ours.speed - same_gradient.speed)
    report.measured("place of that flow between the two runs", share)
    report.compare("speed", 100 * speed, measured, relative=0.10, unit="cm/s")  # 1 um/us = 100 cm/s
    report.compare("speed over the mean velocity of the fluid", speed / saline, measured / (100 * saline),
                   relative=0.10)
    report.compare("length", ours.lengths[-1], 7.8, relative=0.15, unit="um")
    report.measured("change of the length in the last 3 ms", 100 * (ours.lengths[-1] / ours.lengths[-2] - 1), unit="%")
    report.below("change of volume", 100 * (ours.volume - 1), 1, unit="%")
    plot = report.plot("Red cell in a capillary of 6.6 um", "speed (cm/s)", "length (um)", x_log=True)
    report.curve(plot, "Tomaiuolo et al. 2009", [p[0] for p in TOMAIUOLO_LENGTH], [p[1] for p in TOMAIUOLO_LENGTH],
                 band=[0.6] * len(TOMAIUOLO_LENGTH))
    report.curve(plot, "npfem", [100 * run.speed for run in (same_gradient, ours)],
                 [run.lengths[-1] for run in (same_gradient, ours)], points=True)
