# SPDX-License-Identifier: MPL-2.0
"""To and from meshio (an optional package), for every file format it knows."""
from .batch import Batch
from .mesh import Mesh


def _rows(values, width):
    """Nested rows of a flat or nested sequence."""
    if len(values) and hasattr(values[0], "__len__"):
        return values
    return [list(values[start:start + width]) for start in range(0, len(values), width)]


def to_meshio(source, cell=0):
    """A meshio.Mesh of a `Mesh`, or of one cell of a `Batch` with its velocity (um/us) and external force (pN).

    Positions in um.
    """
    import meshio

    if isinstance(source, Mesh):
        return meshio.Mesh(_rows(source.positions, 3), [("triangle", _rows(source.triangles, 3))])
    if not isinstance(source, Batch):
        raise TypeError("a Mesh or a Batch expected, found %s" % type(source).__name__)
    fields = {name: _rows(source.get(name, cell, 1).reshape(-1), 3)
              for name in ("position", "velocity", "external_force")}
    return meshio.Mesh(fields["position"], [("triangle", _rows(source.triangles, 3))],
                       point_data={"velocity_um_per_us": fields["velocity"],
                                   "external_force_pN": fields["external_force"]})


def from_meshio(mesh):
    """A `Mesh` of the triangles of a meshio.Mesh; positions in um. Other cell types are refused."""
    blocks = [block.data for block in mesh.cells if block.type == "triangle"]
    others = sorted({block.type for block in mesh.cells} - {"triangle", "vertex", "line"})
    if others or not blocks:
        raise ValueError("a closed surface of triangles expected, found cells of type %s"
                         % ", ".join(others or [block.type for block in mesh.cells] or ["none"]))
    return Mesh(mesh.points, [corner for block in blocks for corner in block])
