# SPDX-License-Identifier: MPL-2.0
"""Models: a mesh and a material, prepared once, never changed, shared by every cell of a type."""
import ctypes
import os

from ._arrays import Output
from ._handle import Handle
from ._library import call, call_for_text

_COMPONENTS = {"rest_position": 3}


class Model(Handle):
    """A kind of cell: Model(mesh, material). Editing the mesh or the material afterwards does not change it."""

    def __init__(self, mesh, material):
        super().__init__(call("npfem_model_create", mesh.handle, material.handle))

    @classmethod
    def from_lineage(cls, folder, solid_density, volume_weight):
        """From a lineage body folder (points.csv, surface_connectivity.csv, constraints.csv, onSurfaceParticle.csv).

        `solid_density` in fg/um3, `volume_weight` in pN/um.
        """
        model = cls.__new__(cls)
        Handle.__init__(model, call("npfem_model_load_lineage", os.fspath(folder).encode(), solid_density,
                                    volume_weight))
        return model

    @property
    def vertex_count(self):
        return call("npfem_model_vertex_count", self.handle)

    @property
    def triangle_count(self):
        return call("npfem_model_triangle_count", self.handle)

    @property
    def triangles(self):
        """Corners of each triangle, 0-based, (triangles, 3); a copy."""
        out = Output("i", self.triangle_count, 3)
        call("npfem_model_get_triangles", self.handle, out.pointer, out.length)
        return out.values

    def get(self, field):
        """Per vertex: "rest_position" (vertices, 3) um, "rest_area" (vertices,) um2, "solid_mass" (vertices,) fg."""
        components = _COMPONENTS.get(field, 1)
        out = Output("d", self.vertex_count, components) if components > 1 else Output("d", self.vertex_count)
        call("npfem_model_get", self.handle, field.encode(), out.pointer, out.length)
        return out.values

    def measure(self, key):
        """"rest_area" um2, "rest_volume" um3, "largest_modulus" and "shear_modulus" uN/m (small strain)."""
        value = ctypes.c_double()
        call("npfem_model_measure", self.handle, key.encode(), ctypes.byref(value))
        return value.value

    @property
    def energies(self):
        """Names of the energies that this model evaluates; those of zero weight are not."""
        return [call_for_text("npfem_model_energy_name", self.handle, index)
                for index in range(call("npfem_model_energy_count", self.handle))]
