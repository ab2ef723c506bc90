# SPDX-License-Identifier: MPL-2.0
"""Materials: named parameters, from a preset, a TOML file or TOML text."""
import os

from ._handle import Parameterised
from ._library import call, call_for_text
from .mesh import Mesh


class Material(Parameterised):
    """The moduli of a membrane, by key and in base units (uN/m, pN um, Pa):

        material = Material.preset("rbc")
        material["shear_modulus"] = 2.5      # uN/m
        for parameter in material.parameters(): print(parameter.name, parameter.unit, parameter.doc)
    """

    @classmethod
    def preset(cls, name):
        """One of the materials shipped with the library; `Material.presets()` lists them."""
        return cls(call("npfem_material_preset", name.encode()))

    @classmethod
    def load(cls, path):
        """From a TOML file."""
        return cls(call("npfem_material_load", os.fspath(path).encode()))

    @classmethod
    def parse(cls, toml_text):
        """From TOML text."""
        return cls(call("npfem_material_parse", toml_text.encode()))

    @classmethod
    def named(cls, preset_or_path):
        """A file where the name ends in .toml or holds a folder, else a preset."""
        name = os.fspath(preset_or_path)
        is_path = name.endswith(".toml") or os.path.basename(name) != name
        return cls.load(name) if is_path else cls.preset(name)

    @staticmethod
    def presets():
        """Names of the materials shipped with the library."""
        return [call_for_text("npfem_material_preset_name", index)
                for index in range(call("npfem_material_preset_count"))]

    def to_text(self):
        """The material as TOML text that `Material.parse` reads back."""
        return call_for_text("npfem_material_to_text", self.handle)

    def mesh(self, level=-1):
        """The mesh that the material recommends; a negative level takes the level it states."""
        return Mesh._adopt(call("npfem_material_mesh", self.handle, level))
