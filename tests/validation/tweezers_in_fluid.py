# SPDX-License-Identifier: MPL-2.0
"""A red cell pulled apart in plasma at rest: in the end the shape of the quasi-static experiment without a fluid.

Once nothing moves the fluid does nothing, so the diameters must be those of `npfem stretch` with the same force shared
by the same free vertices; a difference would be a force that coupling, lattice or immersed boundary leave behind. 50
and 150 pN, box 26 x 13 x 13 um, dx = 0.5 um. The density is 200 times the true one, which only makes the steps longer;
the approach to rest is that of the membrane and the plasma, with a time of 0.14 s in the end (bending against plasma).
"""
import os

import npfem
import numpy
from npfem.validation import Case, read_csv, run_scene, summary_of
from npfem.validation.scene_text import quantities, quantity
from npfem.vtk_files import read_pvd, read_vtu

CASE = Case(id="R6", title="Red cell in optical tweezers, in plasma", tier="nightly", cost_s=250,
            source="case S11; the fluid at rest exerts no force")

_BOX_UM = (26.0, 13.0, 13.0)
_DENSITY, _VISCOSITY, _DX_UM = 2.0e5, 1200.0, 0.5


def run(report):
    """Two forces."""
    plot = report.plot("Red cell pulled in plasma", "time (s)", "axial diameter (um)")
    dt = 0.5 * _DX_UM ** 2 * _DENSITY / (3 * _VISCOSITY)  # tau = 1
    for force in (50.0, 150.0):
        folder = run_scene(report, "pull%g" % force, {
            "schema_version": 1, "title": "Tweezers in plasma",
            "domain": {"kind": "periodic_box", "size": quantities(_BOX_UM, "um"), "dx": quantity(_DX_UM, "um")},
            "fluid": {"density": quantity(_DENSITY, "kg/m3"), "dynamic_viscosity": quantity(_VISCOSITY / 1000, "mPa s"),
                      "time_step": quantity(dt, "us")},
            "cells": [{"name": "rbc", "material": "rbc", "level": 3, "pull": quantity(force, "pN"),
                       "positions": [{"centre": quantities([0.5 * length for length in _BOX_UM], "um")}]}],
            "run": {"steps": round(6.0e5 / dt)},
            "output": {"fluid": False, "table_every": "2000 us", "cells_every": "50000 us", "into_box": False},
        })
        extents = [numpy.ptp(read_vtu(path).points, axis=0) for _, path in read_pvd(os.path.join(folder, "cells.pvd"))]
        extent = extents[-1]
        report.below("growth of the axial diameter in the last 50 ms at %g pN" % force,
                     100 * (extent[0] / extents[-2][0] - 1), 0.1, unit="%")
        report.curve(plot, "in plasma, %g pN" % force, [0.05 * n for n in range(len(extents))], [e[0] for e in extents])
        row = npfem.stretch("rbc", [force], level=3, load="shared")[-1]
        report.curve(plot, "without fluid, %g pN" % force, [0.05 * (len(extents) - 1)], [row["axial_um"]], points=True)
        report.compare("axial diameter at %g pN" % force, extent[0], row["axial_um"], relative=0.02, unit="um")
        report.compare("transverse diameter at %g pN" % force, extent[1], row["transverse_um"], relative=0.02,
                       unit="um")
        table = read_csv(os.path.join(folder, "cells.csv"))
        change = table["volume_um3"][-1] / table["volume_um3"][0] - 1
        report.below("change of volume at %g pN" % force, 100 * change, 1, unit="%")
        report.below("drift of the centre at %g pN" % force, table["centre_x_um"][-1] - table["centre_x_um"][0], 0.01,
                     unit="um")
        report.below("momentum error at %g pN" % force, summary_of(folder)["momentum_error"], 1e-9)
