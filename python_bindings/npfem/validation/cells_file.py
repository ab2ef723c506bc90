# SPDX-License-Identifier: MPL-2.0
"""A file of cells as they stand, deformed, from which a scene starts (`placement.file`): format in the C++ header
placement/cells_file.h."""
import struct


def _fnv1a(data):
    value = 0xcbf29ce484222325
    for byte in data:
        value = ((value ^ byte) * 0x100000001b3) & 0xffffffffffffffff
    return value


def write_cells(path, name, triangles, cells):
    """Writes cells of one type. `triangles`: flat vertex ids; `cells`: for each its flat positions, um."""
    mesh_hash = _fnv1a(struct.pack("<%di" % len(triangles), *(int(vertex) for vertex in triangles)))
    vertices = len(cells[0]) // 3
    content = "npfem cells 1\ntype %s count %d vertices %d mesh_hash %016x\nend\n" % (name, len(cells), vertices,
                                                                                      mesh_hash)
    content = content.encode()
    for positions in cells:
        content += struct.pack("<%dd" % len(positions), *(float(x) for x in positions))
    _write(path, content)


def shift_cells(source, target, shift):
    """Copies such a file with every vertex moved by `shift`, um."""
    with open(source, "rb") as stream:
        content = stream.read()[:-8]
    start = content.index(b"\nend\n") + 5
    numbers = struct.unpack("<%dd" % ((len(content) - start) // 8), content[start:])
    moved = [x + shift[index % 3] for index, x in enumerate(numbers)]
    _write(target, content[:start] + struct.pack("<%dd" % len(moved), *moved))


def _write(path, content):
    with open(path, "wb") as stream:
        stream.write(content + struct.pack("<Q", _fnv1a(content)))
