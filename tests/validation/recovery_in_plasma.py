# SPDX-License-Identifier: MPL-2.0
"""A stretched red cell let go in plasma at rest: its recovery is that without a fluid (S13), a little slower.

Stretched to twice its width by rigid contacts without a fluid, then set free in plasma, 26 x 13 x 13 um, dx = 0.5 um.
The viscosity of the membrane, 0.5 uN s/m where the material states none, dissipates far more than the plasma, so the
time constant must be at least that without fluid and at most 10 % above (Guglietta et al., Soft Matter 16 (2020) 6191,
find the membrane's part dominant). The plasma's density is 200 times the true one: steps of 17 us, and a viscous time
of the fluid of 3 ms, 2 % of the recovery's.
"""
import os

import npfem
from npfem import recovery
from npfem.validation import Case, read_csv, run_scene
from npfem.validation.cells_file import write_cells
from npfem.validation.scene_text import quantities, quantity
from npfem.vtk_files import read_pvd, read_vtu

CASE = Case(id="R7", title="Recovery of a red cell in plasma", tier="nightly", cost_s=120,
            source="Hochmuth, Worthy & Evans, Biophys. J. 26 (1979) 101; without fluid: case S13")

_BOX_UM = (26.0, 13.0, 13.0)
_DENSITY, _VISCOSITY, _DX_UM = 2.0e5, 1200.0, 0.5
_DURATION_US = 4.0e5


def _ratios(folder):
    """(times in s, length over width)."""
    times, ratios = [], []
    for time_us, path in read_pvd(os.path.join(folder, "cells.pvd")):
        points = read_vtu(path).points
        extent = points.max(0) - points.min(0)
        times.append(1e-6 * time_us)
        ratios.append(float(extent[0] / extent[1]))
    return times, ratios


def run(report):
    """Lets go with and without fluid."""
    material_path = os.path.join(report.folder, "rbc.toml")
    with npfem.Material.preset("rbc") as material:
        if material["membrane_shear_viscosity"] == 0.0:
            material["membrane_shear_viscosity"] = 0.5e6
        with open(material_path, "w", encoding="utf-8") as stream:
            stream.write(material.to_text())
        times, ratios, at_rest = recovery.recover(material, 3)
        alone = recovery.fit(times, ratios, at_rest)
        stretched = recovery.stretched(material, 3)
        with material.mesh(3) as mesh:
            triangles = mesh.triangles
    middle = [0.5 * length for length in _BOX_UM]
    flat = [float(x) for point in stretched for x in (point if hasattr(point, "__iter__") else (point,))]
    write_cells(os.path.join(report.folder, "stretched.cells"), "rbc",
                [int(v) for t in triangles for v in (t if hasattr(t, "__iter__") else (t,))],
                [[x + middle[n % 3] for n, x in enumerate(flat)]])
    dt = 0.5 * _DX_UM ** 2 * _DENSITY / (3 * _VISCOSITY)  # tau = 1
    folder = run_scene(report, "recovery", {
        "schema_version": 1, "title": "Recovery in plasma",
        "domain": {"kind": "periodic_box", "size": quantities(_BOX_UM, "um"), "dx": quantity(_DX_UM, "um")},
        "fluid": {"density": quantity(_DENSITY, "kg/m3"), "dynamic_viscosity": quantity(_VISCOSITY / 1000, "mPa s"),
                  "time_step": quantity(dt, "us")},
        "cells": [{"name": "rbc", "material": "rbc.toml", "level": 3}],
        "placement": {"file": "stretched.cells"},
        "run": {"steps": round(_DURATION_US / dt)},
        "output": {"fluid": False, "cells_every": "4000 us", "table_every": "4000 us", "into_box": False},
    })
    in_plasma_times, in_plasma = _ratios(folder)
    constant = recovery.fit(in_plasma_times, in_plasma, at_rest)
    report.measured("t_c without fluid", alone, unit="s")
    report.measured("t_c in plasma", constant, unit="s")
    report.within("t_c in plasma over that without fluid", constant / alone, 1.0, 1.10)
    report.within("t_c in plasma", constant, 0.08, 0.18, unit="s")
    volume = read_csv(os.path.join(folder, "cells.csv"))["volume_um3"]
    report.below("change of volume", 100 * (volume[-1] / volume[0] - 1), 1, unit="%")
    plot = report.plot("Recovery of a red cell", "time (s)", "length over width")
    report.curve(plot, "in plasma", in_plasma_times, in_plasma)
    report.curve(plot, "without fluid", times, ratios)
