# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest

import npfem

TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def test_from_arrays_and_back():
    with npfem.Mesh(*TETRAHEDRON) as mesh:
        assert (mesh.vertex_count, mesh.triangle_count) == (4, 4)
        numpy.testing.assert_array_equal(mesh.positions, TETRAHEDRON[0])
        numpy.testing.assert_array_equal(mesh.triangles, TETRAHEDRON[1])
        assert mesh.measure("volume") == pytest.approx(1 / 6, rel=1e-14)


def test_an_open_surface_is_refused_with_its_place():
    with pytest.raises(npfem.Error) as caught:
        npfem.Mesh(TETRAHEDRON[0], TETRAHEDRON[1][:3])
    assert caught.value.name == "NPFEM_ERROR_INPUT"
    assert "edge" in str(caught.value)


def test_generated_red_cell_has_the_known_size():
    # Evans-Fung with 258 vertices: validation.md, S8.
    with npfem.Mesh.generate("rbc", 3) as mesh:
        assert mesh.vertex_count == 258
        assert mesh.measure("area") == pytest.approx(131.87, abs=0.01)
        assert mesh.measure("volume") == pytest.approx(91.80, abs=0.01)
        assert mesh.measure("extent_x") == pytest.approx(7.82, abs=1e-12)


@pytest.mark.parametrize("ending", ["off", "obj", "stl", "ply"])
def test_saved_and_loaded(sphere, tmp_path, ending):
    path = tmp_path / ("é sphere." + ending)
    sphere.save(path)
    with npfem.Mesh.load(path) as loaded:
        assert (loaded.vertex_count, loaded.triangle_count) == (66, 128)
        # STL and PLY may keep single precision.
        assert loaded.measure("volume") == pytest.approx(sphere.measure("volume"), rel=1e-6)


def test_size_scales_the_shape(sphere):
    assert sphere.measure("extent_z") == pytest.approx(6.0, rel=1e-14)
