# SPDX-License-Identifier: MPL-2.0
"""Cells that leave through an opening: what is told of them, on any number of ranks and when a run goes on."""
import csv
import json

import pytest

# Four platelets and a red cell between plates, the fluid in from the left and out to the right. The platelets leave at
# different times; the red cell stays.
SCENE = """schema_version = 1
[domain]
kind = "plates"
size = ["14 um", "9 um", "8 um"]
dx = "0.5 um"
[[openings]]
face = "x-"
kind = "velocity"
velocity = "100 mm/s"
[[openings]]
face = "x+"
kind = "pressure"
[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"
[[cells]]
name = "rbc"
material = "rbc"
level = 2
[[cells.positions]]
centre = ["4 um", "4.5 um", "4 um"]
rotate = ["0 deg", "90 deg", "0 deg"]
[[cells]]
name = "platelet"
material = "platelet"
level = 2
%s
[run]
steps = 200
[output]
cells_every = "2 us"
fluid_every = "10 us"
table_every = "2 us"
"""
PLATELETS = [(11.6, 4.5, 2), (10.9, 3.5, 6), (10.1, 5.5, 2.1), (9.7, 4.4, 6)]


@pytest.fixture
def outflow(tmp_path):
    path = tmp_path / "outflow.toml"
    places = "\n".join('[[cells.positions]]\ncentre = ["%g um", "%g um", "%g um"]\nrotate = ["0 deg", "90 deg", "0 deg"]'
                       % place for place in PLATELETS)
    path.write_text(SCENE % places)
    return path


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def rows_of(path):
    return list(csv.DictReader(path.open()))


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()
            if path.is_file() and path.name not in ("summary.json", "scene.toml", "cells.vtkhdf", "fluid.vtkhdf")}


def test_what_leaves_is_counted_and_named(program, outflow, tmp_path):
    folder = tmp_path / "out"
    result = program("run", outflow, "-o", folder)
    assert result.returncode == 0, result.stderr
    summary, left = summary_of(folder), rows_of(folder / "left.csv")
    count = len(left)
    assert 2 <= count <= 4 and summary["cells"] == 5 - count and summary["cells_left"] == count
    assert summary["cells_by_type"] == [1, 4 - count] and summary["cells_left_by_type"] == [0, count]
    volume = sum(float(row["volume_um3"]) for row in left)
    assert summary["volume_left_um3_by_type"] == [0, pytest.approx(volume, rel=1e-9)]
    assert "%d cells (%d platelet; %.4g um3) have left through openings" % (count, count, volume) in result.stdout
    assert summary["failed_cells"] == 0 and summary["momentum_error"] < 1e-10

    table = rows_of(folder / "cells.csv")
    times = sorted({int(row["step"]) for row in table})
    assert times == list(range(0, 201, 20))
    for row in left:
        assert row["type"] == "platelet" and row["opening"] == "x+" and int(row["cell_id"]) > 0
        seen = [line for line in table if line["cell_id"] == row["cell_id"]]
        assert [int(line["step"]) for line in seen] == [step for step in times if step < int(row["step"])]
        last = seen[-1]
        assert float(last["centre_x_um"]) < float(row["centre_x_um"]) < 14 - 1.25
        assert float(row["volume_um3"]) == pytest.approx(float(last["volume_um3"]), rel=0.01)
    assert [int(row["step"]) for row in left] == sorted(int(row["step"]) for row in left)

    rheology = rows_of(folder / "rheology.csv")
    for line in rheology:
        there = [row for row in table if row["step"] == line["step"]]
        expected = sum(float(row["volume_um3"]) for row in there) / (14 * 9 * 8)
        assert float(line["haematocrit"]) == pytest.approx(expected, rel=1e-9)
    assert float(rheology[-1]["haematocrit"]) < float(rheology[0]["haematocrit"])


def test_all_of_it_is_the_same_on_any_ranks_and_when_the_run_goes_on(program, outflow, tmp_path):
    def run(name, verb, *arguments, ranks=None):
        result = program(verb, *arguments, "--quiet", "--set", "output.checkpoint_every=100", ranks=ranks)
        assert result.returncode == 0, result.stderr
        return tmp_path / name

    straight = run("straight", "run", outflow, "-o", tmp_path / "straight")
    steps = [int(row["step"]) for row in rows_of(straight / "left.csv")]
    assert min(steps) <= 100 < max(steps), "the test is weak: %s" % steps
    shared = run("shared", "run", outflow, "-o", tmp_path / "shared", ranks=2)
    stopped = run("stopped", "run", outflow, "-o", tmp_path / "stopped", "--set", "run.steps=140")
    # a run that was killed later: the checkpoint of its last step is gone, the tables tell of more
    (stopped / "checkpoints" / "checkpoint_000000000140.npfem").unlink()
    resumed = run("stopped", "resume", stopped, "--set", "run.steps=200", ranks=2)
    for other in (shared, resumed):
        assert files_of(straight).items() <= files_of(other).items()  # at step 140 the stopped run wrote all it has
        for key in ("state_hash", "cells_left_by_type", "volume_left_um3_by_type", "haematocrit", "rheology"):
            assert summary_of(other)[key] == summary_of(straight)[key], key


def test_vtkhdf_shows_the_cells_that_are_there(program, outflow, tmp_path):
    h5py, meshio = pytest.importorskip("h5py"), pytest.importorskip("meshio")
    folder = tmp_path / "out"
    settings = ["--quiet", "--set", "output.format=both", "--set", "output.checkpoint_every=60", "--set",
                "output.checkpoint_keep=4"]
    result = program("run", outflow, "-o", folder, *settings)
    if "this build has no HDF5" in result.stderr:
        pytest.skip("this build has no HDF5")
    assert result.returncode == 0, result.stderr

    def contents():
        with h5py.File(folder / "cells.vtkhdf") as file:
            found = {}
            file.visititems(lambda name, item: found.update({name: item[()].tolist()} if hasattr(item, "shape") else {}))
            return found

    with h5py.File(folder / "cells.vtkhdf") as file:
        root, steps = file["VTKHDF"], file["VTKHDF/Steps"]
        assert steps.attrs["NSteps"] == 11 and len(root["NumberOfCells"]) > 1
        for number in range(11):
            mesh = meshio.read(folder / ("cells_%09d.vtu" % (20 * number)))
            part, cell = steps["PartOffsets"][number], steps["CellOffsets"][number]
            points, cells = root["NumberOfPoints"][part], root["NumberOfCells"][part]
            assert (points, cells) == (len(mesh.points), len(mesh.cells[0].data))
            begin = steps["PointOffsets"][number]
            assert (root["Points"][begin:begin + points] == mesh.points).all()
            begin = steps["ConnectivityIdOffsets"][number]
            assert root["NumberOfConnectivityIds"][part] == 3 * cells
            assert (root["Connectivity"][begin:begin + 3 * cells].reshape(-1, 3) == mesh.cells[0].data).all()
            # one more offset than triangles in every part
            assert list(root["Offsets"][cell + part:cell + part + cells + 1]) == list(range(0, 3 * cells + 1, 3))
            assert (root["Types"][cell:cell + cells] == 5).all()
            for name in ("cell_id", "cell_type", "larger_stretch", "smaller_stretch"):
                begin = steps["CellDataOffsets"][name][number]
                assert (root["CellData"][name][begin:begin + cells] == mesh.cell_data[name][0]).all()
    before = contents()
    for step in (120, 180, 200):
        (folder / "checkpoints" / ("checkpoint_%012d.npfem" % step)).unlink()
    assert program("resume", folder, "--quiet").returncode == 0
    assert contents() == before


def test_until_none_is_left(program, outflow, tmp_path):
    text = outflow.read_text()
    begin, end = text.index('[[cells]]\nname = "rbc"'), text.index('[[cells]]\nname = "platelet"')
    outflow.write_text(text[:begin] + text[end:])
    folder = tmp_path / "out"
    result = program("run", outflow, "-o", folder, "--set", "run.steps=400", "--set", "output.cells_every=10 us", ranks=2)
    assert result.returncode == 0, result.stderr
    summary = summary_of(folder)
    assert summary["cells"] == 0 and summary["cells_left"] == 4 and summary["haematocrit"] == 0
    assert "4 cells (4 platelet; " in result.stdout and "0 cells, haematocrit 0.0000, least gap none" in result.stdout
    assert summary["rheology"]["msd_platelet_x_um2"] is None
    last = rows_of(folder / "rheology.csv")[-1]
    assert last["step"] == "400" and last["haematocrit"] == "0" and last["msd_platelet_x_um2"] == ""
    assert 'NumberOfPoints="0"' in (folder / "cells_000000400.vtu").read_bytes().decode("latin-1")


def test_a_cell_that_starts_in_an_opening_is_bad_input(program, outflow, tmp_path):
    outflow.write_text(outflow.read_text().replace('"11.6 um"', '"12.4 um"'))
    result = program("run", outflow, "-o", tmp_path / "out")
    assert result.returncode == 2 and "outflow.toml" in result.stderr, result.stderr
    assert not (tmp_path / "out").exists()
