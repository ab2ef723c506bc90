# SPDX-License-Identifier: MPL-2.0
"""A red cell pulled apart in plasma at rest: in the end the shape of the quasi-static experiment without a fluid.

Once nothing moves the fluid does nothing, so the diameters must be those of `npfem stretch` with the same force shared
by the same free vertices; a difference would be a force that coupling, lattice or immersed boundary leave behind. 50
and 150 pN, box 26 x 13 x 13 um, dx = 0.5 um. The density is 200 times the true one, which only makes the steps longer;
the approach to rest is that of the membrane and the plasma.
"""
import os

import npfem
from npfem.validation import Case, read_csv, run_scene, summary_of
from npfem.validation.scene_text import quantities, quantity
from npfem.vtk_files import read_pvd, read_vtu

CASE = Case(id="R6", title="Red cell in optical tweezers, in plasma", tier="nightly", cost_s=60,
            source="case S11; the fluid at rest exerts no force")

_BOX_UM = (26.0, 13.0, 13.0)
_DENSITY, _VISCOSITY, _DX_UM = 2.0e5, 1200.0, 0.5


def run(report):
    """Two forces."""
    dt = 0.5 * _DX_UM ** 2 * _DENSITY / (3 * _VISCOSITY)  # tau = 1
    for force in (50.0, 150.0):
        folder = run_scene(report, "pull%g" % force, {
            "schema_version": 1, "title": "Tweezers in plasma",
            "domain": {"kind": "periodic_box", "size": quantities(_BOX_UM, "um"), "dx": quantity(_DX_UM, "um")},
            "fluid": {"density": quantity(_DENSITY, "kg/m3"), "dynamic_viscosity": quantity(_VISCOSITY / 1000, "mPa s"),
                      "time_step": quantity(dt, "us")},
            "cells": [{"name": "rbc", "material": "rbc", "level": 3, "pull": quantity(force, "pN"),
                       "positions": [{"centre": quantities([0.5 * length for length in _BOX_UM], "um")}]}],
            "run": {"steps": round(2.0e5 / dt)},
            "output": {"fluid": False, "table_every": "2000 us", "cells_every": "200000 us", "into_box": False},
        })
        points = read_vtu(read_pvd(os.path.join(folder, "cells.pvd"))[-1][1]).points
        extent = points.max(0) - points.min(0)
        row = npfem.stretch("rbc", [force], level=3, load="shared")[-1]
        report.compare("axial diameter at %g pN" % force, extent[0], row["axial_um"], relative=0.02, unit="um")
        report.compare("transverse diameter at %g pN" % force, extent[1], row["transverse_um"], relative=0.02,
                       unit="um")
        table = read_csv(os.path.join(folder, "cells.csv"))
        report.below("change of volume at %g pN" % force, 100 * (table["volume_um3"][-1] / table["volume_um3"][0] - 1), 1,
                     unit="%")
        report.below("drift of the centre at %g pN" % force, table["centre_x_um"][-1] - table["centre_x_um"][0], 0.01,
                     unit="um")
        report.below("momentum error at %g pN" % force, summary_of(folder)["momentum_error"], 1e-9)
