# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest

import npfem

meshio = pytest.importorskip("meshio")


def test_a_mesh_there_and_back(sphere):
    with npfem.from_meshio(npfem.to_meshio(sphere)) as again:
        numpy.testing.assert_array_equal(again.positions, sphere.positions)
        numpy.testing.assert_array_equal(again.triangles, sphere.triangles)


def test_a_cell_of_a_batch_through_a_file(batch, tmp_path):
    batch.position = batch.position + numpy.array([0.0, 9.0])[:, None, None]
    batch.velocity = numpy.random.default_rng(7).uniform(size=(2, 66, 3))
    meshio.write(tmp_path / "cell.vtu", npfem.to_meshio(batch, cell=1))
    read = meshio.read(tmp_path / "cell.vtu")
    numpy.testing.assert_array_equal(read.points, batch.position[1])
    numpy.testing.assert_array_equal(read.point_data["velocity_um_per_us"], batch.velocity[1])
    npfem.from_meshio(read).close()


def test_other_than_triangles_is_refused():
    with pytest.raises(ValueError, match="quad"):
        npfem.from_meshio(meshio.Mesh(numpy.zeros((4, 3)), [("quad", [[0, 1, 2, 3]])]))
    with pytest.raises(TypeError):
        npfem.to_meshio("rbc")
