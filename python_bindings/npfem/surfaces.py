# SPDX-License-Identifier: MPL-2.0
"""Triangulated surfaces for the eye: vertex normals, smooth refinement, cuts by a plane. Needs numpy."""
import numpy


def vertex_normals(points, triangles):
    """Unit normals at the vertices.

    A triangle weighs 1/(a^2 b^2) at the corner between its edges a and b, which is exact on a sphere (N. Max, "Weights
    for computing vertex normals from facet normals", 1999).
    """
    corners = points[triangles]
    squares = numpy.sum((corners - numpy.roll(corners, -1, axis=1)) ** 2, axis=2)
    faces = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    weights = 1 / (squares * numpy.roll(squares, 1, axis=1))
    normals = numpy.empty_like(points)
    for axis in range(3):
        normals[:, axis] = numpy.bincount(triangles.ravel(), (weights * faces[:, axis, None]).ravel(), len(points))
    return normals / numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]


def refine(points, triangles, labels):
    """Splits every triangle into four; the vertices stay, new ones lie on the curved surface.

    A new vertex is the middle of the cubic that leaves both ends of its edge in their tangent planes (A. Vlachos et
    al., "Curved PN triangles", 2001). `labels`: one per triangle, carried along.
    """
    normals = vertex_normals(points, triangles)
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    keys = edges[:, 0] * numpy.int64(len(points)) + edges[:, 1]
    unique, which = numpy.unique(keys, return_inverse=True)
    start, end = unique // len(points), unique % len(points)
    along = points[end] - points[start]
    leaving, arriving = (along - numpy.sum(along * normals[vertex], axis=1)[:, None] * normals[vertex]
                         for vertex in (start, end))
    middles = 0.5 * (points[start] + points[end]) + 0.125 * (leaving - arriving)
    ab, bc, ca = (which + len(points)).reshape(3, -1)
    a, b, c = triangles.T
    finer = numpy.stack([numpy.stack(corners, axis=1)
                         for corners in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))], axis=1)
    return numpy.concatenate([points, middles]), finer.reshape(-1, 3), numpy.repeat(labels, 4)


def cut(points, triangles, axis, level):
    """Closed outlines of the section of one closed surface with the plane x[axis] = level: a list of (n, 3) arrays."""
    heights = points[:, axis] - level
    above = heights > 0
    corners = above[triangles]
    crossing = triangles[corners.any(axis=1) & ~corners.all(axis=1)]
    follow, place = {}, {}
    for triangle in crossing.tolist():
        ends = {}
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            if above[a] != above[b]:
                key = (min(a, b), max(a, b))
                t = heights[a] / (heights[a] - heights[b])
                place[key] = points[a] + t * (points[b] - points[a])
                ends["leaves" if above[a] else "enters"] = key
        # One edge leads down through the plane and one up: their order gives every outline one direction.
        follow[ends["leaves"]] = ends["enters"]
    outlines = []
    while follow:
        first, key = follow.popitem()
        outline = [place[first]]
        while key != first and key in follow:
            outline.append(place[key])
            key = follow.pop(key)
        outlines.append(numpy.array(outline))
    return outlines
