# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest
import synthetic_run

from npfem.surfaces import cut, refine, vertex_normals


def test_normals_of_a_sphere_are_exact():
    points, triangles = synthetic_run.octahedral_sphere(3)
    assert numpy.sum(vertex_normals(points, triangles) * points, axis=1).min() > 1 - 1e-12


def test_refinement_keeps_vertices_and_rounds_a_sphere():
    points, triangles = synthetic_run.octahedral_sphere(2)
    finer, split, labels = refine(points, triangles, numpy.arange(len(triangles)))
    numpy.testing.assert_array_equal(finer[:len(points)], points)
    assert len(finer) == 258 and len(split) == 4 * len(triangles)
    numpy.testing.assert_array_equal(numpy.bincount(labels), 4)
    # Over the middle of an edge that spans the angle 2 t an arc rises by 1 - cos t, the cubic by (sin t)^2 (cos t) / 2:
    # here 4.3 % and 4.0 % of the radius for the longest edges, t = 0.29.
    radii = numpy.linalg.norm(finer[len(points):], axis=1)
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    start, end = points[numpy.unique(edges, axis=0)].transpose(1, 0, 2)
    t = 0.5 * numpy.arccos(numpy.sum(start * end, axis=1))
    numpy.testing.assert_allclose(radii, numpy.cos(t) + 0.5 * numpy.sin(t) ** 2 * numpy.cos(t), rtol=1e-12)
    edges = numpy.sort(numpy.concatenate([split[:, [0, 1]], split[:, [1, 2]], split[:, [2, 0]]]), axis=1)
    assert (numpy.unique(edges, axis=0, return_counts=True)[1] == 2).all()


def test_refinement_keeps_a_flat_surface_flat():
    points = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]], dtype=float)
    finer, _, _ = refine(points, numpy.array([[0, 1, 2], [1, 3, 2]]), numpy.zeros(2))
    numpy.testing.assert_array_equal(finer[:, 2], 0)
    assert sorted(map(tuple, finer[4:, :2])) == [(0, 0.5), (0.5, 0), (0.5, 0.5), (0.5, 1), (1, 0.5)]


def test_section_of_a_sphere_is_one_circle():
    points, triangles = synthetic_run.octahedral_sphere(4)
    outline, = cut(points, triangles, 2, 0.31)
    assert numpy.abs(outline[:, 2] - 0.31).max() < 1e-12
    assert numpy.hypot(outline[:, 0], outline[:, 1]) == pytest.approx(numpy.sqrt(1 - 0.31 ** 2), abs=0.005)
    angles = numpy.unwrap(numpy.arctan2(outline[:, 1], outline[:, 0]))
    assert abs(angles[-1] - angles[0]) > 2 * numpy.pi * 0.95


def test_section_of_a_red_cell_across_its_rim_has_two_parts():
    points, triangles = synthetic_run.red_cell(4)
    assert len(cut(points, triangles, 2, 1.0)) == 2
    assert len(cut(points, triangles, 0, 0.05)) == 1
    assert cut(points, triangles, 2, 5.0) == []
