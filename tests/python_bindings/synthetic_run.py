# SPDX-License-Identifier: MPL-2.0
"""A made-up output folder of a run, for the readers and the renderer: red cells and platelets in a tube or a box.

Files as the program writes them: cells and fluid raw-appended with UInt64 lengths, series, scene.toml, summary.json.
"""
import json
import os

import numpy


def octahedral_sphere(level):
    """(points, triangles): the unit octahedron, halved `level` times, projected to the unit sphere."""
    points = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(level):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple(0.5 * (p + q) for p, q in zip(points[a], points[b])))
            return middles[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    points = numpy.array(points, dtype=float)
    return points / numpy.linalg.norm(points, axis=1)[:, None], numpy.array(triangles)


def red_cell(level=3):
    """The Evans-Fung red cell, 7.82 um wide."""
    sphere, triangles = octahedral_sphere(level)
    q = sphere[:, 0] ** 2 + sphere[:, 1] ** 2
    points = 3.91 * sphere
    points[:, 2] *= 0.5 * (0.207161 + 2.002558 * q - 1.122762 * q ** 2)
    return points, triangles


def platelet(level=2):
    sphere, triangles = octahedral_sphere(level)
    return sphere * (1.8, 1.8, 0.55), triangles


def _random_rotation(random):
    q, r = numpy.linalg.qr(random.standard_normal((3, 3)))
    q = q * numpy.sign(numpy.diag(r))
    return q if numpy.linalg.det(q) > 0 else -q


def place_cells(kind, size, counts, seed):
    """[(type, points, triangles)]: cells that do not touch, by trial and error; centroids inside the box."""
    random = numpy.random.default_rng(seed)
    shapes = (red_cell(), platelet())
    placed = []
    for cell_type, count in enumerate(counts):
        shape, triangles = shapes[cell_type]
        for _ in range(4000):
            if sum(item[0] == cell_type for item in placed) == count:
                break
            points = shape @ _random_rotation(random).T + random.uniform(0, 1, 3) * size
            if kind == "tube":
                outside = numpy.hypot(points[:, 0] - size[0] / 2, points[:, 1] - size[1] / 2).max() > size[0] / 2 - 0.3
            else:
                outside = points[:, 1].min() < 0.3 or points[:, 1].max() > size[1] - 0.3
            if outside or any(numpy.linalg.norm(points[:, None] - other[None], axis=2).min() < 0.75
                              for _, other, _ in placed
                              if numpy.linalg.norm(points.mean(0) - other.mean(0)) < 8.5):
                continue
            placed.append((cell_type, points, triangles))
    return placed


def fluid_velocity(kind, size, nodes, dx):
    """(velocity, solid) on the nodes: Poiseuille flow along z in a tube, Couette flow along x in a box."""
    x, y, z = numpy.meshgrid(*[(numpy.arange(count) + 0.5) * dx for count in nodes], indexing="ij")
    velocity = numpy.zeros(tuple(nodes) + (3,))
    if kind == "tube":
        squared = ((x - size[0] / 2) ** 2 + (y - size[1] / 2) ** 2) / (size[0] / 2) ** 2
        solid = squared > 1
        velocity[..., 2] = 0.03 * numpy.clip(1 - squared, 0, None)
    else:
        solid = numpy.zeros(tuple(nodes), dtype=bool)
        velocity[..., 0] = 0.01 * (y / size[1] - 0.5)
    return velocity, solid


class _Appended:
    """Collects raw-appended arrays and hands out their <DataArray> elements."""

    _NAMES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}

    def __init__(self):
        self.data = b""

    def element(self, name, values, dtype):
        values = numpy.ascontiguousarray(values, dtype="<" + dtype)
        components = ' NumberOfComponents="%d"' % values.shape[1] if values.ndim > 1 else ""
        text = '<DataArray type="%s" Name="%s"%s format="appended" offset="%d"/>' % (
            self._NAMES[dtype], name, components, len(self.data))
        self.data += numpy.uint64(values.nbytes).tobytes() + values.tobytes()
        return text

    def write(self, path, kind, body):
        head = '<?xml version="1.0"?>\n<VTKFile type="%s" byte_order="LittleEndian" header_type="UInt64">' % kind
        with open(path, "wb") as stream:
            stream.write((head + body + '<AppendedData encoding="raw">\n_').encode() + self.data
                         + b"\n</AppendedData></VTKFile>\n")


def write_vtu(path, cells):
    offsets = numpy.cumsum([0] + [len(points) for _, points, _ in cells])
    points = numpy.concatenate([points for _, points, _ in cells])
    triangles = numpy.concatenate([triangles + start for (_, _, triangles), start in zip(cells, offsets)])
    ids = numpy.concatenate([numpy.full(len(cell[2]), index) for index, cell in enumerate(cells)])
    types = numpy.concatenate([numpy.full(len(cell[2]), cell[0]) for cell in cells])
    out = _Appended()
    body = '<UnstructuredGrid><Piece NumberOfPoints="%d" NumberOfCells="%d">' % (len(points), len(triangles))
    body += "<Points>" + out.element("Points", points, "f8") + "</Points><Cells>"
    body += out.element("connectivity", triangles.ravel(), "i8")
    body += out.element("offsets", 3 * numpy.arange(1, len(triangles) + 1), "i8")
    body += out.element("types", numpy.full(len(triangles), 5), "u1") + "</Cells><PointData>"
    body += out.element("velocity_um_per_us", numpy.zeros_like(points), "f4")
    body += out.element("force_pN", numpy.zeros_like(points), "f4") + "</PointData><CellData>"
    body += out.element("cell_id", ids, "i4") + out.element("cell_type", types, "i4")
    out.write(path, "UnstructuredGrid", body + "</CellData></Piece></UnstructuredGrid>")


def write_vti(path, velocity, solid, dx):
    nodes = solid.shape
    extent = "0 %d 0 %d 0 %d" % tuple(count - 1 for count in nodes)
    out = _Appended()
    body = '<ImageData WholeExtent="%s" Origin="%g %g %g" Spacing="%g %g %g"><Piece Extent="%s"><PointData>' % (
        (extent,) + (dx / 2,) * 3 + (dx,) * 3 + (extent,))
    body += out.element("velocity_um_per_us", velocity.transpose(2, 1, 0, 3).reshape(-1, 3), "f4")
    body += out.element("pressure_Pa", numpy.zeros(solid.size), "f4")
    body += out.element("flags", solid.transpose(2, 1, 0).ravel(), "u1")
    out.write(path, "ImageData", body + "</PointData></Piece></ImageData>")


def write_run(folder, kind="tube", size=(20.0, 20.0, 30.0), dx=0.5, counts=(18, 12), seed=1):
    """Writes the whole output folder of a made-up run; returns its path."""
    os.makedirs(folder, exist_ok=True)
    size = numpy.array(size)
    nodes = numpy.round(size / dx).astype(int)
    cells = place_cells(kind, size, counts, seed)
    velocity, solid = fluid_velocity(kind, size, nodes, dx)
    for step, time in ((0, 0.0), (400, 1500.0)):
        write_vtu(os.path.join(folder, "cells_%08d.vtu" % step), cells)
        write_vti(os.path.join(folder, "fluid_%08d.vti" % step), velocity, solid, dx)
    for name, ending in (("cells", "vtu"), ("fluid", "vti")):
        entries = "".join('<DataSet timestep="%g" file="%s_%08d.%s"/>' % (time, name, step, ending)
                          for step, time in ((0, 0.0), (400, 1500.0)))
        with open(os.path.join(folder, name + ".pvd"), "w") as stream:
            stream.write('<VTKFile type="Collection" version="1.0"><Collection>%s</Collection></VTKFile>' % entries)
    with open(os.path.join(folder, "scene.toml"), "w") as stream:
        stream.write('title = "A made-up arteriole"\n[domain]\nkind = "%s"\n[run]\nsteps = 400\n'
                     '[[cells]]\nname = "rbc"\n[[cells]]\nname = "platelet"\n' % kind)
    with open(os.path.join(folder, "summary.json"), "w") as stream:
        json.dump({"steps": 400, "haematocrit": 0.196, "title": "A made-up arteriole",
                   "cell_types": ["rbc", "platelet"]}, stream)
    return folder
