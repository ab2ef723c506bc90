#!/usr/bin/env python3
# SPDX-License-Identifier: MPL-2.0
"""Writes vessel.stl: a tube along x that winds once and narrows in the middle, um. It ends at x = 0 and x = 32 um."""
import math
import pathlib
import struct

LENGTH, AROUND, ALONG = 32.0, 24, 32


def point(i, k):
    """Vertex i around the axis, ring k along it."""
    phase = 2 * math.pi * k / ALONG
    radius = 5.5 - 0.75 * (1 - math.cos(phase))
    angle = 2 * math.pi * (i % AROUND) / AROUND
    return (LENGTH * k / ALONG, 10 + 3 * math.sin(phase) + radius * math.cos(angle), 7 + radius * math.sin(angle))


def triangles():
    """Counter-clockwise seen from outside."""
    for k in range(ALONG):
        for i in range(AROUND):
            a, b, c, d = point(i, k), point(i + 1, k), point(i, k + 1), point(i + 1, k + 1)
            yield a, c, b
            yield b, c, d


faces = list(triangles())
with open(pathlib.Path(__file__).with_name("vessel.stl"), "wb") as file:
    file.write(b"winding vessel, um".ljust(80) + struct.pack("<I", len(faces)))
    for face in faces:
        file.write(struct.pack("<3f", 0, 0, 0))
        for vertex in face:
            file.write(struct.pack("<3f", *vertex))
        file.write(struct.pack("<H", 0))
