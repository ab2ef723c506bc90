# SPDX-License-Identifier: MPL-2.0
"""A spherical capsule in the middle of a shear box, as a scene; sizes in node spacings, times in strains."""
import os

from .programs import run_scene
from .scene_text import quantities, quantity, toml
from .tables import read_csv

_DX_UM, _VISCOSITY, _DENSITY = 0.5, 1200.0, 1000.0  # um, fg/(um us), fg/um3 = kg/m3


class CapsuleRun:
    """gdot t, Taylor's D, inclination (degrees) and volume over the first, by time; the summary's wall time."""

    def __init__(self, table, rate):
        self.strain = [rate * time for time in table["time_us"]]
        self.deformation = table["taylor_deformation"]
        self.inclination = table["inclination_deg"]
        self.volume = [volume / table["volume_um3"][0] for volume in table["volume_um3"]]

    def at(self, strain):
        """Index of the line nearest to gdot t = `strain`."""
        return min(range(len(self.strain)), key=lambda index: abs(self.strain[index] - strain))

    def mean(self, values, start):
        """Of the values from gdot t = `start` on."""
        chosen = [value for value, strain in zip(values, self.strain) if strain >= start - 1e-9]
        return sum(chosen) / len(chosen)


def shear_capsule(report, name, capillary_number, strain, radius=8, box=(8, 8, 8), level=3, law="neo_hookean",
                  reynolds_number=0.1, relaxation_time=2.0, scheme="implicit", kernel=4, cell_every=1,
                  inset=None, bending=0.0, precision="double", **parameters):
    """Runs it; returns a CapsuleRun.

    `radius`: in nodes; `box`: in radii; capillary number mu gdot a / G_s; Reynolds number gdot a^2 / nu;
    `relaxation_time`: tau of the lattice, which sets the time step; `inset`: None for the kernel's own; `bending`:
    kappa_b / (G_s a^2);
    `parameters`: further ones of the material.
    """
    viscosity = _VISCOSITY / _DENSITY
    a = radius * _DX_UM
    rate = reynolds_number * viscosity / a ** 2  # 1/us
    modulus = _VISCOSITY * rate * a / capillary_number
    dt = (relaxation_time - 0.5) * _DX_UM ** 2 / (3 * viscosity)
    lengths = [round(radius * length) * _DX_UM for length in box]
    parameters = {"membrane_law": law, "shear_modulus": quantity(modulus, "uN/m"), **parameters}
    if bending:
        parameters["bending_law"] = "cotangent"
        parameters["bending_modulus"] = quantity(bending * modulus * a ** 2, "pN um")
    material = {"schema_version": 1, "name": "capsule", "description": "Capsule of a validation case.",
                "mesh": {"shape": "icosphere", "level": level, "diameter": quantity(2 * a, "um")},
                "parameters": parameters, "sources": {"membrane_law": "Of the case."}}
    with open(os.path.join(report.folder, "capsule.toml"), "w", encoding="utf-8") as stream:
        stream.write(toml(material))
    folder = run_scene(report, name, {
        "schema_version": 1, "title": "Capsule in shear",
        "domain": {"kind": "shear_box", "size": quantities(lengths, "um"), "dx": quantity(_DX_UM, "um")},
        "fluid": {"density": quantity(_DENSITY, "kg/m3"), "dynamic_viscosity": quantity(_VISCOSITY / 1000, "mPa s"),
                  "time_step": quantity(dt, "us"), "precision": precision},
        "flow": {"shear_rate": quantity(rate * 1e6, "1/s"), "start": "developed"},
        "coupling": {"scheme": scheme, "kernel": kernel, "cell_every": cell_every,
                     **({} if inset is None else {"inset": inset})},
        "cells": [{"name": "capsule", "material": "capsule.toml",
                   "positions": [{"centre": quantities([0.5 * length for length in lengths], "um")}]}],
        "run": {"steps": round(strain / (rate * dt))},
        "output": {"table_every": quantity(0.05 / rate, "us"), "fluid": False},
    })
    return CapsuleRun(read_csv(os.path.join(folder, "cells.csv")), rate)
