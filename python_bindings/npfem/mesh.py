# SPDX-License-Identifier: MPL-2.0
"""Closed triangulated surfaces, counter-clockwise seen from outside; lengths in um."""
import ctypes
import os

from ._arrays import Output, read_in
from ._handle import Handle
from ._library import call


class Mesh(Handle):
    """A closed surface.

    Mesh(positions, triangles): positions in um, (vertices, 3) or flat xyzxyz...; triangles 0-based, (triangles, 3) or
    flat. An open, inconsistently oriented or degenerate surface raises `npfem.Error`, which names the place.
    """

    def __init__(self, positions, triangles):
        xyz, xyz_length = read_in(positions, "d")
        corners, corners_length = read_in(triangles, "i")
        super().__init__(call("npfem_mesh_create", xyz, xyz_length, corners, corners_length))

    @classmethod
    def _adopt(cls, handle):
        mesh = cls.__new__(cls)
        Handle.__init__(mesh, handle)
        return mesh

    @classmethod
    def generate(cls, shape, level, size_um=0.0):
        """A red cell "rbc" (Evans-Fung), a "platelet" (oblate), a "sphere" (octahedral) or an "icosphere".

        Octahedral shapes have 66, 258, 1026, 4098 vertices at level 2, 3, 4, 5; the icosphere 162, 642, 2562 at level
        2, 3, 4. `size_um` is the largest diameter; 0 takes the natural one (7.82, 3.6, 1 um).
        """
        return cls._adopt(call("npfem_mesh_generate", shape.encode(), level, size_um))

    @classmethod
    def load(cls, path):
        """From a .off, .obj, .stl or .ply file; lengths in um."""
        return cls._adopt(call("npfem_mesh_load", os.fspath(path).encode()))

    def save(self, path):
        """To a .off, .obj, .stl or .ply file."""
        call("npfem_mesh_save", self.handle, os.fspath(path).encode())

    @property
    def vertex_count(self):
        return call("npfem_mesh_vertex_count", self.handle)

    @property
    def triangle_count(self):
        return call("npfem_mesh_triangle_count", self.handle)

    @property
    def positions(self):
        """Positions in um, (vertices, 3); a copy."""
        out = Output("d", self.vertex_count, 3)
        call("npfem_mesh_get_positions", self.handle, out.pointer, out.length)
        return out.values

    @property
    def triangles(self):
        """Corners of each triangle, 0-based, (triangles, 3); a copy."""
        out = Output("i", self.triangle_count, 3)
        call("npfem_mesh_get_triangles", self.handle, out.pointer, out.length)
        return out.values

    def measure(self, key):
        """"area" um2, "volume" um3, "reduced_volume" 1, "extent_x" "extent_y" "extent_z" um, "edge_min" "edge_mean"
        "edge_max" um."""
        value = ctypes.c_double()
        call("npfem_mesh_measure", self.handle, key.encode(), ctypes.byref(value))
        return value.value
