# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest
import synthetic_run

from npfem.rasteriser import Camera, barycentric, rasterise


def parallel(width=200, height=160, scale=50.0):
    return Camera([0, 0, 10], [0, 0, 0], [0, 1, 0], scale, width, height, perspective=False)


def test_projection_of_known_points():
    place = parallel().project([[0, 0, 0], [1, 0, 0], [0, 1, 2]])
    numpy.testing.assert_allclose(place, [[100, 80, 10], [150, 80, 10], [100, 30, 8]])
    near = Camera([0, 0, 10], [0, 0, 0], [0, 1, 0], 50.0, 200, 160).project([[1, 0, 0], [1, 0, 5]])
    numpy.testing.assert_allclose(near[:, 0], [150, 200])


def test_a_sphere_covers_a_disc_of_its_depth():
    points, triangles = synthetic_run.octahedral_sphere(5)
    camera = parallel()
    visible = rasterise(camera.project(points), triangles, camera.width, camera.height)
    rows, columns = numpy.nonzero(visible.triangle >= 0)
    assert len(rows) == pytest.approx(numpy.pi * 50 ** 2, rel=0.005)
    across = numpy.hypot(columns + 0.5 - 100, rows + 0.5 - 80) / 50
    expected = 10 - numpy.sqrt(numpy.clip(1 - across ** 2, 0, None))
    inner = across < 0.9
    assert numpy.abs(visible.depth[rows, columns] - expected)[inner].max() < 0.01
    assert (visible.triangle >= 0).sum() == numpy.isfinite(visible.depth).sum()


def test_no_gaps_and_the_nearest_wins():
    # Two squares, the second nearer and smaller; both facing the camera.
    def square(half, z):
        return [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]]

    points = numpy.array(square(1.0, 0.0) + square(0.5, 1.0))
    triangles = numpy.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    camera = parallel()
    for order in ([0, 1, 2, 3], [2, 3, 0, 1]):
        visible = rasterise(camera.project(points), triangles[order], 200, 160)
        assert (visible.triangle >= 0).sum() == 100 * 100
        assert numpy.isin(numpy.array(order)[visible.triangle[55:105, 75:125]], (2, 3)).all()


def test_back_faces_and_what_is_outside_are_not_seen():
    points = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [50, 50, 0], [51, 50, 0], [50, 51, 0]], dtype=float)
    camera = parallel()
    visible = rasterise(camera.project(points), numpy.array([[0, 2, 1], [3, 4, 5]]), 200, 160)
    assert (visible.triangle == -1).all()


def test_weights_of_the_corners():
    corners = numpy.array([[[0, 0, 1], [4, 0, 2], [0, 4, 3]]], dtype=float)
    numpy.testing.assert_allclose(barycentric(corners, numpy.array([1.0]), numpy.array([2.0])), [[0.25, 0.25, 0.5]])
