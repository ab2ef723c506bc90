# SPDX-License-Identifier: MPL-2.0
"""One instant of a run, read from its output folder: cells, fluid, and what the run says about itself. Needs numpy."""
import json
import os
import re

import numpy

from .vtk_files import FormatError, Surfaces, read_pvd, read_vti, read_vtu

# Directions (0 x, 1 y, 2 z) along the flow; the picture's vertical is y in every domain.
_FLOW_AXIS = {"tube": 2}
UP_AXIS = 1


class Snapshot:
    """points (n, 3) um, triangles (m, 3), cell_id and cell_type (m,), type_names, size (3,) um, velocity (x, y, z, 3)
    um/us and solid (nx, ny, nz) on the fluid's nodes, spacing (3,) um; kind, title, time_us, haematocrit or None."""

    def __init__(self, surfaces, grid, kind, summary, time_us):
        self.points = surfaces.points
        self.triangles = surfaces.triangles
        self.cell_id = numpy.asarray(surfaces.cell_data["cell_id"])
        self.cell_type = numpy.asarray(surfaces.cell_data["cell_type"])
        self.type_names = summary.get("cell_types", [])
        self.size = grid.nodes * grid.spacing
        self.spacing = grid.spacing
        self.velocity = numpy.asarray(grid.data["velocity_um_per_us"], dtype=float)
        self.solid = grid.data["flags"] != 0 if "flags" in grid.data else numpy.zeros(tuple(grid.nodes), dtype=bool)
        self.kind = kind
        self.title = summary.get("title", "")
        self.haematocrit = summary.get("haematocrit")
        self.time_us = time_us

    @property
    def flow_axis(self):
        return _FLOW_AXIS.get(self.kind, 0)

    @property
    def depth_axis(self):
        """The direction that is neither the flow's nor the vertical."""
        return 3 - self.flow_axis - UP_AXIS

    @property
    def tube_radius(self):
        """Radius (um) of a tube: it fills its box."""
        return 0.5 * self.size[UP_AXIS]

    def cell_count(self, cell_type):
        return len(numpy.unique(self.cell_id[self.cell_type == cell_type]))


def _scene_words(path):
    """{"title": [...], "domain.kind": [...], "cells.name": [...]}: the words in quotes of a scene, by table and key."""
    words, table = {}, ""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as stream:
            for line in stream:
                header = re.match(r"\s*\[+\s*([\w.]+)\s*\]", line)
                entry = re.match(r"\s*(\w+)\s*=\s*([\"'])(.*?)\2", line)
                if header:
                    table = header.group(1) + "."
                elif entry:
                    words.setdefault(table + entry.group(1), []).append(entry.group(3))
    return words


def _series(folder, name):
    path = os.path.join(folder, name)
    return read_pvd(path) if os.path.exists(path) else []


def _need(name, data, path):
    if name not in data:
        raise FormatError('%s has no array "%s"' % (path, name))


def _no_cells():
    none = numpy.zeros(0, dtype=int)
    return Surfaces(numpy.zeros((0, 3)), none.reshape(0, 3), {}, {"cell_id": none, "cell_type": none})


def read_run(folder, index=-1):
    """The instant number `index` of the run in `folder`, counted over its fluid files; negative: from the end."""
    fluid, cells = _series(folder, "fluid.pvd"), _series(folder, "cells.pvd")
    if not fluid:
        raise FormatError("%s has no fluid.pvd with an entry: is this the output folder of a run?" % folder)
    if not -len(fluid) <= index < len(fluid):
        raise FormatError("%s has %d instants, so number %d does not exist" % (folder, len(fluid), index))
    time_us, fluid_path = fluid[index]
    grid = read_vti(fluid_path)
    _need("velocity_um_per_us", grid.data, fluid_path)
    surfaces = _no_cells()
    if cells:
        _, cells_path = min(cells, key=lambda entry: abs(entry[0] - time_us))
        surfaces = read_vtu(cells_path)
        _need("cell_id", surfaces.cell_data, cells_path)
        _need("cell_type", surfaces.cell_data, cells_path)
    words = _scene_words(os.path.join(folder, "scene.toml"))
    # A run that goes on has no summary yet.
    summary = {"title": words.get("title", [""])[0], "cell_types": words.get("cells.name", [])}
    summary_path = os.path.join(folder, "summary.json")
    if os.path.exists(summary_path):
        try:
            with open(summary_path, encoding="utf-8") as stream:
                summary.update(json.load(stream))
        except ValueError as error:
            raise FormatError("%s is damaged: %s" % (summary_path, error)) from None
    return Snapshot(surfaces, grid, words.get("domain.kind", [""])[0], summary, time_us)
