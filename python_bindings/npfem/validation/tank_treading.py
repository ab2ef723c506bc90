# SPDX-License-Identifier: MPL-2.0
"""A red cell that tank-treads in shear: a scene, and what is measured in its output. Needs numpy."""
import math
import os

import numpy

from ..vtk_files import read_pvd, read_vtu
from .boundary_integral import moments_of
from .programs import run_scene
from .scene_text import quantities, quantity

CELL_RADIUS_UM = 3.91


class TankTreading:
    """strain: gdot t; inclination: of the long axis to the flow, degrees; phase: mean angle (radians) by which the
    membrane has gone round, counted along the cell's own ellipse."""

    def __init__(self, folder, rate_per_us):
        self.strain, self.inclination, phases = [], [], []
        for time_us, path in read_pvd(os.path.join(folder, "cells.pvd")):
            surfaces = read_vtu(path)
            points = numpy.asarray(surfaces.points, dtype=float)
            triangles = numpy.asarray(surfaces.triangles)
            axes, directions, _ = moments_of(points, triangles)
            middle = points - points.mean(0)
            longest = directions[:, 2]
            angle = math.atan2(longest[1], longest[0])
            angle = (angle + 0.5 * math.pi) % math.pi - 0.5 * math.pi
            along = middle[:, 0] * math.cos(angle) + middle[:, 1] * math.sin(angle)
            across = -middle[:, 0] * math.sin(angle) + middle[:, 1] * math.cos(angle)
            self.strain.append(rate_per_us * time_us)
            self.inclination.append(math.degrees(angle))
            phases.append(numpy.arctan2(across / axes[0], along / axes[2]))
            if len(phases) == 1:
                # Vertices near the rim of the shear plane go round; those near the vorticity axis hardly do.
                self._chosen = numpy.abs(middle[:, 2]) < 0.25 * CELL_RADIUS_UM
        unwrapped = numpy.unwrap(numpy.array(phases)[:, self._chosen], axis=0)
        self.phase = (unwrapped - unwrapped[0]).mean(1)

    def frequency(self, start):
        """Cycles per unit of strain (nu / gdot) after gdot t = `start`."""
        chosen = [index for index, strain in enumerate(self.strain) if strain >= start]
        slope = numpy.polyfit([self.strain[i] for i in chosen], self.phase[chosen], 1)[0]
        return abs(slope) / (2 * math.pi)

    def turned(self, strain):
        """Cycles that the membrane has gone round by gdot t = `strain`."""
        return abs(float(numpy.interp(strain, self.strain, self.phase))) / (2 * math.pi)

    def mean_inclination(self, start):
        """Degrees, after gdot t = `start`."""
        return float(numpy.mean([a for a, strain in zip(self.inclination, self.strain) if strain >= start]))


def shear_red_cell(report, name, rate_per_s, outside_mPa_s, inside_mPa_s=6.0, strain=60.0, reynolds_number=0.2,
                   dx_um=0.5, relaxation_time=3.0, box_um=(20.0, 16.0, 14.0), material="rbc-viscous", level=3,
                   coupling=None, precision="double", quality="", threads=None):
    """Runs one red cell in a viscous fluid; returns a TankTreading.

    The fluid's density is chosen so that gdot a^2 / nu is `reynolds_number`: the true one, some 1e-4, would take a
    thousand times the steps. `inside_mPa_s`: viscosity of the haemoglobin solution. `quality`: the scene names it, and
    says nothing of dx, time step and precision, which must be those of that quality.
    """
    viscosity = outside_mPa_s * 1000  # fg/(um us)
    rate = rate_per_s * 1e-6  # 1/us
    density = reynolds_number * viscosity / (rate * CELL_RADIUS_UM ** 2)  # fg/um3 = kg/m3
    dt = (relaxation_time - 0.5) * dx_um ** 2 / (3 * viscosity / density)
    folder = run_scene(report, name, {
        "schema_version": 1, "title": "Red cell tank-treading", **({"quality": quality} if quality else {}),
        "domain": {"kind": "shear_box", "size": quantities(box_um, "um"),
                   **({} if quality else {"dx": quantity(dx_um, "um")})},
        "fluid": {"density": quantity(density, "kg/m3"), "dynamic_viscosity": quantity(outside_mPa_s, "mPa s"),
                  **({} if quality else {"time_step": quantity(dt, "us"), "precision": precision})},
        "coupling": coupling or {},
        # The viscosity of the membrane bears forces of many pN on a vertex: a looser tolerance than the default 1e-4
        # halves the iterations and changes the inclination by 1e-4 degrees.
        "solver": {"tolerance": "0.01 pN"},
        "flow": {"shear_rate": quantity(rate_per_s, "1/s"), "start": "developed"},
        "cells": [{"name": "rbc", "material": material, "level": level,
                   "interior_viscosity_ratio": inside_mPa_s / outside_mPa_s,
                   "positions": [{"centre": quantities([0.5 * length for length in box_um], "um"),
                                  "rotate": ["90 deg", "0 deg", "20 deg"]}]}],
        "run": {"steps": round(strain / (rate * dt))},
        "output": {"cells_every": quantity(0.25 / rate, "us"), "table_every": quantity(0.25 / rate, "us"),
                   "fluid": False, "into_box": False},
    }, threads=threads)
    return TankTreading(folder, rate)
