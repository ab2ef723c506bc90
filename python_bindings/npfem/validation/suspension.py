# SPDX-License-Identifier: MPL-2.0
"""Blood of a validation case: packed, then run."""
import json
import os

from .cells_file import shift_cells
from .programs import run_program, run_scene, summary_of
from .scene_text import quantities, quantity, toml
from .tables import read_csv

_CELL_RADIUS_UM = 3.91
_VISCOSITY = 1200.0  # of plasma, fg/(um us)
_INTERIOR_RATIO = 5.0  # cytoplasm of 6 mPa s


def _cells(haematocrit, platelets_per_cell=0.0):
    """[[cells]] of a scene; haematocrit None: as many as a file has."""
    cells = [{"name": "rbc", "material": "rbc", "level": 3, "interior_viscosity_ratio": _INTERIOR_RATIO}]
    if haematocrit:
        cells[0]["haematocrit"] = haematocrit
    if platelets_per_cell:
        cells.append({"name": "platelet", "material": "platelet", "level": 2, "ratio": platelets_per_cell,
                      "ratio_to": "rbc"})
    return cells


def _fluid(density, dx_um, relaxation_time):
    dt = (relaxation_time - 0.5) * dx_um ** 2 * density / (3 * _VISCOSITY)
    return {"density": quantity(density, "kg/m3"), "dynamic_viscosity": quantity(_VISCOSITY / 1000, "mPa s"),
            "time_step": quantity(dt, "us")}, dt


def _pack(report, name, scene):
    """Packs a scene; returns (summary, path of the packed scene)."""
    path = os.path.join(report.folder, name + "_asked.toml")
    packed = os.path.join(report.folder, name + "_packed.toml")
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(toml(scene))
    return json.loads(run_program(report, "pack", path, "-o", packed, "--overwrite", "--quiet", "--json")), packed


def pack_and_run(report, name, scene):
    """Packs the scene and runs what came of it; returns (summary of the packing, output folder of the run)."""
    summary, packed = _pack(report, name, scene)
    with open(packed, encoding="utf-8") as stream:
        return summary, run_scene(report, name, stream.read())


def packed_box(report, name, side_um, haematocrit, platelets_per_cell):
    """(summary of the packing, summary of a run of two steps)."""
    fluid, _ = _fluid(1025.0, 0.5, 1.0)
    packed, folder = pack_and_run(report, name, {
        "schema_version": 1, "title": "Packing",
        "domain": {"kind": "shear_box", "size": quantities([side_um] * 3, "um"), "dx": "0.5 um"}, "fluid": fluid,
        "flow": {"shear_rate": "100 1/s"}, "cells": _cells(haematocrit, platelets_per_cell), "run": {"steps": 2},
    })
    return packed, summary_of(folder)


def _last_part(folder, share):
    """Means of the columns of rheology.csv over the last `share` of the time."""
    table = read_csv(os.path.join(folder, "rheology.csv"))
    first = int((1 - share) * len(table["time_us"]))
    return {name: sum(values[first:]) / len(values[first:]) for name, values in table.items()
            if not isinstance(values[0], str)}


def sheared_blood(report, name, rate_per_s, haematocrit, strain, side_um=20.0, dx_um=0.5, reynolds_number=0.05,
                  relaxation_time=2.0):
    """(relative viscosity over the last third, summary) of blood between two plates."""
    rate = rate_per_s * 1e-6
    density = reynolds_number * _VISCOSITY / (rate * _CELL_RADIUS_UM ** 2)
    fluid, dt = _fluid(density, dx_um, relaxation_time)
    _, folder = pack_and_run(report, name, {
        "schema_version": 1, "title": "Sheared blood", "quality": "balanced",
        "domain": {"kind": "shear_box", "size": quantities([side_um] * 3, "um"), "dx": quantity(dx_um, "um")},
        "fluid": fluid, "flow": {"shear_rate": quantity(rate_per_s, "1/s"), "start": "developed"},
        "cells": _cells(haematocrit), "run": {"steps": round(strain / (rate * dt))},
        "output": {"table_every": quantity(0.02 / rate, "us"), "fluid": False},
    })
    return _last_part(folder, 1 / 3)["relative_viscosity"], summary_of(folder)


def tube_blood(report, name, haematocrit, diameter_um=20.0, length_um=40.0, dx_um=0.5, pseudo_shear_per_s=300.0,
               diameters=12.0, reynolds_number=1.0, relaxation_time=2.0, layer_um=1.75):
    """(table of the rheology, means over its last third, summary) of blood driven along a tube over some diameters of
    plasma's way.

    Cells drift away from the wall in 25 to 50 diameters; to spare most of that, they start packed in a core that leaves
    `layer_um` at the wall to plasma.
    """
    speed = pseudo_shear_per_s * 1e-6 * diameter_um  # um/us
    density = reynolds_number * _VISCOSITY / (speed * diameter_um)
    fluid, dt = _fluid(density, dx_um, relaxation_time)
    time = diameters * diameter_um / speed
    core_um = diameter_um - 2 * layer_um
    scene = {
        "schema_version": 1, "title": "Blood in a tube", "quality": "balanced",
        "domain": {"kind": "tube", "diameter": quantity(core_um, "um"), "length": quantity(length_um, "um"),
                   "dx": quantity(dx_um, "um")},
        "fluid": fluid, "flow": {"mean_velocity": quantity(speed * 1000, "mm/s"), "start": "developed"},
        "cells": _cells(haematocrit * (diameter_um / core_um) ** 2), "run": {"steps": round(time / dt)},
        "output": {"table_every": quantity(time / 500, "us"), "fluid": False},
    }
    _, packed = _pack(report, name, scene)
    shift_cells(packed.replace(".toml", ".cells"), os.path.join(report.folder, name + ".cells"),
                (layer_um, layer_um, 0))
    scene["domain"]["diameter"] = quantity(diameter_um, "um")
    scene["cells"] = _cells(None)
    scene["placement"] = {"file": name + ".cells"}
    folder = run_scene(report, name, scene)
    return read_csv(os.path.join(folder, "rheology.csv")), _last_part(folder, 1 / 3), summary_of(folder)
