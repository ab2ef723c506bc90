# SPDX-License-Identifier: MPL-2.0
"""Reads the VTK files that a run writes: cells (.vtu), fluid (.vti), series (.pvd). Needs numpy.

Binary arrays are raw-appended: after the underscore of <AppendedData encoding="raw"> each array is its length in bytes
(UInt32 or UInt64, the file's header_type) followed by the numbers. Inline ascii arrays are read too.
"""
import contextlib
import os
import re
import xml.etree.ElementTree as ElementTree

import numpy

_TYPES = {"Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2", "Int32": "i4", "UInt32": "u4", "Int64": "i8",
          "UInt64": "u8", "Float32": "f4", "Float64": "f8"}
_TRIANGLE = 5


class FormatError(ValueError):
    """A file that is not what its name says; the message names the file and what was found."""


@contextlib.contextmanager
def _reading(path):
    """Names the file in whatever a damaged one leads to."""
    try:
        yield
    except FormatError:
        raise
    except (ValueError, KeyError, TypeError) as error:
        raise FormatError("%s is damaged: %s: %s" % (path, type(error).__name__, error)) from None


class _VtkXml:
    """One VTK XML file: its element tree and its arrays."""

    def __init__(self, path, kind):
        self.path = path
        with open(path, "rb") as stream:
            content = stream.read()
        start = re.search(rb"<AppendedData[^>]*>\s*_", content)
        text, self.appended = (content, b"") if start is None else (content[:start.start()], content[start.end():])
        if start is not None:
            text += b"</VTKFile>"
        try:
            self.root = ElementTree.fromstring(text)
        except ElementTree.ParseError as error:
            raise FormatError("%s is not a VTK XML file: %s" % (path, error)) from None
        if self.root.tag != "VTKFile" or self.root.get("type") != kind:
            raise FormatError("%s: a VTKFile of type %s expected, found %s" % (path, kind, self.root.get("type")))
        if self.root.get("compressor"):
            raise FormatError("%s is compressed; only raw data can be read" % path)
        self.order = ">" if self.root.get("byte_order") == "BigEndian" else "<"
        self.header = self.order + _TYPES[self.root.get("header_type", "UInt32")]

    def array(self, element):
        """The numbers of a <DataArray>, as (tuples, components) or (tuples,)."""
        name, type_name = element.get("Name"), element.get("type")
        if type_name not in _TYPES:
            raise FormatError('%s: array "%s" has the type %s, which cannot be read' % (self.path, name, type_name))
        dtype = numpy.dtype(self.order + _TYPES[type_name])
        layout = element.get("format")
        if layout == "appended":
            values = self._appended(name, dtype, int(element.get("offset", "0")))
        elif layout == "ascii":
            values = numpy.array((element.text or "").split(), dtype=dtype)
        else:
            raise FormatError('%s: array "%s" is stored as %s; raw-appended or ascii can be read'
                              % (self.path, name, layout))
        components = int(element.get("NumberOfComponents", "1"))
        return values.reshape(-1, components) if components > 1 else values

    def _appended(self, name, dtype, offset):
        header_size = numpy.dtype(self.header).itemsize
        if offset < 0 or offset + header_size > len(self.appended):
            raise FormatError('%s is cut short: array "%s" should start at byte %d' % (self.path, name, offset))
        size = int(numpy.frombuffer(self.appended, self.header, 1, offset)[0])
        begin = offset + header_size
        if size % dtype.itemsize or begin + size > len(self.appended):
            raise FormatError('%s is cut short: array "%s" should have %d bytes' % (self.path, name, size))
        return numpy.frombuffer(self.appended, dtype, size // dtype.itemsize, begin)

    def arrays(self, parent):
        """{name: numbers} of the data arrays under an element; empty where there is none."""
        return {} if parent is None else {item.get("Name"): self.array(item) for item in parent.findall("DataArray")}

    def need(self, where):
        element = self.root.find(where)
        if element is None:
            raise FormatError("%s has no <%s>" % (self.path, where))
        return element


class Surfaces:
    """The cells of a .vtu: points (n, 3) um, triangles (m, 3), point_data, cell_data (one entry per triangle)."""

    def __init__(self, points, triangles, point_data, cell_data):
        self.points = points
        self.triangles = triangles
        self.point_data = point_data
        self.cell_data = cell_data


def read_vtu(path):
    """Triangulated surfaces of an unstructured-grid file."""
    with _reading(path):
        file = _VtkXml(path, "UnstructuredGrid")
        piece = file.need("UnstructuredGrid/Piece")
        points = file.arrays(file.need("UnstructuredGrid/Piece/Points"))
        topology = file.arrays(file.need("UnstructuredGrid/Piece/Cells"))
        if not points or not {"connectivity", "offsets", "types"} <= set(topology):
            raise FormatError("%s lacks its points or the arrays connectivity, offsets, types" % path)
        coordinates = numpy.array(next(iter(points.values())), dtype=float).reshape(-1, 3)
        if numpy.any(topology["types"] != _TRIANGLE):
            raise FormatError("%s holds other things than triangles" % path)
        triangles = numpy.array(topology["connectivity"], dtype=numpy.int64)
        if triangles.size != 3 * topology["types"].size:
            raise FormatError("%s has %d triangles with %d corners" % (path, topology["types"].size, triangles.size))
        if triangles.size and not 0 <= triangles.min() <= triangles.max() < len(coordinates):
            raise FormatError("%s: its triangles refer to points that are not there" % path)
        surfaces = Surfaces(coordinates, triangles.reshape(-1, 3), file.arrays(piece.find("PointData")),
                            file.arrays(piece.find("CellData")))
        for data, count in ((surfaces.point_data, len(coordinates)), (surfaces.cell_data, topology["types"].size)):
            for name, values in data.items():
                if len(values) != count:
                    raise FormatError('%s: array "%s" has %d entries, not %d' % (path, name, len(values), count))
        return surfaces


class Grid:
    """The fluid of a .vti: origin (3,) um, spacing (3,) um, nodes (3,) and data {name: (nx, ny, nz[, components])}."""

    def __init__(self, origin, spacing, nodes, data):
        self.origin = origin
        self.spacing = spacing
        self.nodes = nodes
        self.data = data


def read_vti(path):
    """Arrays on the points of an image-data file."""
    with _reading(path):
        file = _VtkXml(path, "ImageData")
        image = file.need("ImageData")
        extent = [int(number) for number in image.get("WholeExtent", "").split()]
        if len(extent) != 6:
            raise FormatError("%s has no WholeExtent of six numbers" % path)
        nodes = numpy.array([extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in range(3)])
        data = {}
        for name, values in file.arrays(file.need("ImageData/Piece").find("PointData")).items():
            if len(values) != nodes.prod():
                raise FormatError('%s: array "%s" has %d entries, not %d' % (path, name, len(values), nodes.prod()))
            tail = values.shape[1:]
            # VTK counts x fastest.
            data[name] = values.reshape(tuple(nodes[::-1]) + tail).transpose((2, 1, 0) + (3,) * len(tail))
        origin, spacing = (numpy.array([float(number) for number in image.get(key, default).split()]).reshape(3)
                           for key, default in (("Origin", "0 0 0"), ("Spacing", "1 1 1")))
        return Grid(origin + spacing * extent[0::2], spacing, nodes, data)


def read_pvd(path):
    """[(time, path of the file)] of a series, in the order written."""
    with _reading(path):
        root = _VtkXml(path, "Collection").root
        folder = os.path.dirname(os.path.abspath(path))
        return [(float(item.get("timestep", "0")), os.path.join(folder, item.get("file", "")))
                for item in root.findall("Collection/DataSet")]
