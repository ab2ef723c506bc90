# SPDX-License-Identifier: MPL-2.0
import os
import shutil

import numpy
import pytest
import synthetic_run

from npfem import vtk_files
from npfem.run_output import read_run


@pytest.fixture
def cells():
    return synthetic_run.place_cells("tube", numpy.array([12.0, 12.0, 16.0]), (2, 2), seed=4)


def test_cells(tmp_path, cells):
    path = str(tmp_path / "cells.vtu")
    synthetic_run.write_vtu(path, cells)
    read = vtk_files.read_vtu(path)
    numpy.testing.assert_array_equal(read.points, numpy.concatenate([points for _, points, _ in cells]))
    assert read.triangles.shape == (2 * 512 + 2 * 128, 3)
    assert read.triangles.max() == len(read.points) - 1
    numpy.testing.assert_array_equal(read.cell_data["cell_id"], numpy.repeat([0, 1, 2, 3], [512, 512, 128, 128]))
    numpy.testing.assert_array_equal(read.cell_data["cell_type"], numpy.repeat([0, 1], [1024, 256]))
    assert read.point_data["force_pN"].shape == (len(read.points), 3)


def test_meshio_reads_the_same(tmp_path, cells):
    meshio = pytest.importorskip("meshio")
    path = str(tmp_path / "cells.vtu")
    synthetic_run.write_vtu(path, cells)
    ours, theirs = vtk_files.read_vtu(path), meshio.read(path)
    numpy.testing.assert_array_equal(ours.points, theirs.points)
    numpy.testing.assert_array_equal(ours.triangles, theirs.cells[0].data)
    numpy.testing.assert_array_equal(ours.cell_data["cell_id"], theirs.cell_data["cell_id"][0])


def test_fluid_counts_x_fastest(tmp_path):
    path = str(tmp_path / "fluid.vti")
    nodes = (3, 4, 5)
    velocity = numpy.random.default_rng(5).uniform(size=nodes + (3,)).astype("f4")
    solid = numpy.zeros(nodes, dtype=bool)
    solid[2, 0, 1] = True
    synthetic_run.write_vti(path, velocity, solid, 0.5)
    read = vtk_files.read_vti(path)
    numpy.testing.assert_array_equal(read.data["velocity_um_per_us"], velocity)
    numpy.testing.assert_array_equal(read.data["flags"] != 0, solid)
    numpy.testing.assert_allclose(read.origin, 0.25)
    numpy.testing.assert_array_equal(read.nodes, nodes)


def test_ascii_arrays(tmp_path):
    path = tmp_path / "one.vtu"
    path.write_text("""<VTKFile type="UnstructuredGrid" byte_order="LittleEndian"><UnstructuredGrid>
        <Piece NumberOfPoints="3" NumberOfCells="1"><Points>
        <DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points><Cells>
        <DataArray type="Int32" Name="connectivity" format="ascii">0 1 2</DataArray>
        <DataArray type="Int32" Name="offsets" format="ascii">3</DataArray>
        <DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid>
        </VTKFile>""")
    read = vtk_files.read_vtu(str(path))
    numpy.testing.assert_array_equal(read.points, [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
    numpy.testing.assert_array_equal(read.triangles, [[0, 1, 2]])


def damaged(content, random):
    """The content cut short, or with a few bytes of its first part replaced."""
    if random.uniform() < 0.2:
        return content[:random.integers(len(content))]
    changed = bytearray(content)
    for _ in range(random.integers(1, 6)):
        changed[random.integers(min(1500, len(content)))] = random.choice(list(b'0123456789<>"=/ -abcUIF8\xff'))
    return bytes(changed)


@pytest.mark.parametrize("reader", [vtk_files.read_vtu, vtk_files.read_vti])
def test_damaged_files_are_errors_that_name_the_file(tmp_path, cells, reader):
    path = str(tmp_path / "file")
    if reader is vtk_files.read_vtu:
        synthetic_run.write_vtu(path, cells)
    else:
        synthetic_run.write_vti(path, numpy.zeros((3, 3, 3, 3)), numpy.zeros((3, 3, 3), dtype=bool), 0.5)
    with open(path, "rb") as stream:
        content = stream.read()
    random = numpy.random.default_rng(6)
    refused = 0
    for _ in range(600):
        with open(path, "wb") as stream:
            stream.write(damaged(content, random))
        try:
            reader(path)
        except vtk_files.FormatError as error:
            refused += 1
            assert path in str(error)
    assert refused > 200


def test_a_file_of_another_kind_is_refused(tmp_path):
    path = str(tmp_path / "fluid.vti")
    synthetic_run.write_vti(path, numpy.zeros((2, 2, 2, 3)), numpy.zeros((2, 2, 2), dtype=bool), 1.0)
    with pytest.raises(vtk_files.FormatError, match="UnstructuredGrid expected, found ImageData"):
        vtk_files.read_vtu(path)


def test_a_run(tube_run):
    snapshot = read_run(tube_run)
    assert (snapshot.kind, snapshot.time_us, snapshot.title) == ("tube", 1500.0, "A made-up arteriole")
    numpy.testing.assert_allclose(snapshot.size, [12, 12, 16])
    assert snapshot.type_names == ["rbc", "platelet"]
    assert snapshot.tube_radius == pytest.approx(6.0)
    assert read_run(tube_run, 0).time_us == 0.0
    with pytest.raises(vtk_files.FormatError, match="number 2 does not exist"):
        read_run(tube_run, 2)


def test_a_run_that_goes_on_is_known_from_its_scene(tube_run, tmp_path):
    run = shutil.copytree(tube_run, tmp_path / "run")
    (run / "summary.json").unlink()
    snapshot = read_run(str(run))
    assert (snapshot.title, snapshot.type_names) == ("A made-up arteriole", ["rbc", "platelet"])
    assert snapshot.haematocrit is None


def test_a_damaged_summary_is_named(tube_run, tmp_path):
    run = shutil.copytree(tube_run, tmp_path / "run")
    (run / "summary.json").write_text("{")
    with pytest.raises(vtk_files.FormatError, match="summary.json is damaged"):
        read_run(str(run))


def test_a_folder_that_is_no_run(tmp_path):
    with pytest.raises(vtk_files.FormatError, match="is this the output folder of a run"):
        read_run(str(tmp_path))
    assert os.listdir(tmp_path) == []
