# SPDX-License-Identifier: MPL-2.0
"""What a run writes for other programs: tables, VTKHDF, the script for ParaView."""
import csv
import json
import math
import shutil

import pytest

POISEUILLE = """schema_version = 1
[domain]
kind = "plates"
size = ["3 um", "5 um", "2 um"]
dx = "0.5 um"
[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"
[flow]
mean_velocity = "1 mm/s"
start = "developed"
[run]
steps = 600
[output]
table_every = "10 us"
"""


def rows_of(path):
    return list(csv.DictReader(path.open()))


def test_poiseuille_without_cells_has_the_viscosity_of_the_fluid(program, tmp_path):
    scene = tmp_path / "plates.toml"
    scene.write_text(POISEUILLE)
    folder = tmp_path / "out"
    assert program("run", scene, "-o", folder, "--quiet").returncode == 0
    rows = rows_of(folder / "rheology.csv")
    assert [row["step"] for row in rows] == ["100", "200", "300", "400", "500", "600"]
    assert abs(float(rows[-1]["relative_viscosity"]) - 1) < 1e-6
    assert rows[-1]["cell_free_layer_um"] == ""
    rheology = json.loads((folder / "summary.json").read_text())["rheology"]
    assert abs(rheology["apparent_viscosity_mPa_s"] - 1.2) < 1e-5 and rheology["from_us"] == 30
    # tau_w = f H / 2 with f = 12 mu U / H^2
    assert abs(rheology["wall_stress_Pa"] - 6 * 1200 * 1e-3 / 5) < 1e-4


def test_the_table_of_cells_is_complete(program, scene, tmp_path):
    folder = tmp_path / "out"
    assert program("run", scene, "-o", folder, "--quiet", "--set", "run.steps=60").returncode == 0
    first, last = rows_of(folder / "cells.csv")[0], rows_of(folder / "cells.csv")[-3]
    assert abs(float(first["largest_stretch"]) - 1) < 1e-6 < float(last["largest_stretch"]) - 1
    for row in (first, last):
        assert -90 < float(row["inclination_deg"]) <= 90
        normal = [float(row["normal_" + axis]) for axis in "xyz"]
        assert abs(sum(n * n for n in normal) - 1) < 1e-9
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["rheology"]["msd_rbc_x_um2"] > 0
    assert 1 < summary["rheology"]["relative_viscosity"] < 1.5


def test_the_script_for_paraview_is_python(program, scene, tmp_path):
    folder = tmp_path / "out"
    assert program("run", scene, "-o", folder, "--quiet", "--set", "run.steps=1").returncode == 0
    text = (folder / "view.py").read_text()
    compile(text, "view.py", "exec")
    assert str(tmp_path) not in text
    assert "cells.pvd" in text and "fluid.pvd" in text


@pytest.fixture
def hdf(program, scene, tmp_path):
    folder = tmp_path / "hdf"
    result = program("run", scene, "-o", folder, "--quiet", "--set", "output.format=both", "--set",
                     "output.checkpoint_every=7", "--set", "output.fluid_every=0.5 us")
    if "this build has no HDF5" in result.stderr:
        assert result.returncode == 2
        pytest.skip("this build has no HDF5")
    assert result.returncode == 0, result.stderr
    return folder


def test_vtkhdf_holds_what_the_vtu_files_hold(hdf):
    h5py = pytest.importorskip("h5py")
    meshio = pytest.importorskip("meshio")
    with h5py.File(hdf / "cells.vtkhdf") as file:
        root = file["VTKHDF"]
        assert root.attrs["Type"] == b"UnstructuredGrid" and list(root.attrs["Version"]) == [2, 0]
        steps = root["Steps"]
        assert steps.attrs["NSteps"] == 4 and list(steps["Values"]) == [0, 0.5, 1, pytest.approx(1.2)]
        points, cells = root["NumberOfPoints"][0], root["NumberOfCells"][0]
        assert len(root["Offsets"]) == cells + 1 and root["Offsets"][0] == 0
        assert root["Points"].shape == (4 * points, 3)
        for number, step in enumerate((0, 5, 10, 12)):
            mesh = meshio.read(hdf / ("cells_%09d.vtu" % step))
            begin = steps["PointOffsets"][number]
            assert (root["Points"][begin:begin + points] == mesh.points).all()
            triangles = root["Connectivity"][steps["ConnectivityIdOffsets"][number]:].reshape(-1, 3)
            assert (triangles == mesh.cells[0].data).all()
            for name in ("velocity_um_per_us", "force_pN"):
                begin = steps["PointDataOffsets"][name][number]
                assert (root["PointData"][name][begin:begin + points] == mesh.point_data[name]).all()
            for name in ("cell_id", "cell_type", "larger_stretch", "smaller_stretch"):
                begin = steps["CellDataOffsets"][name][number]
                assert (root["CellData"][name][begin:begin + cells] == mesh.cell_data[name][0]).all()
    with h5py.File(hdf / "fluid.vtkhdf") as file:
        root = file["VTKHDF"]
        assert root.attrs["Type"] == b"ImageData" and list(root.attrs["WholeExtent"]) == [0, 23, 0, 19, 0, 19]
        assert root["PointData"]["velocity_um_per_us"].shape == (4, 20, 20, 24, 3)
        assert root["PointData"]["flags"].shape == (1, 20, 20, 24)
        assert list(root["Steps"]["PointDataOffsets"]["flags"]) == [0, 0, 0, 0]
        # developed shear: -plate speed/2 below, +plate speed/2 above
        profile = root["PointData"]["velocity_um_per_us"][0, 3, :, 5, 0]
        assert math.isclose(profile[19], -profile[0], rel_tol=1e-5) and profile[19] > 0


def test_vtkhdf_goes_on_after_a_stop(program, hdf, tmp_path):
    h5py = pytest.importorskip("h5py")
    whole, stopped = tmp_path / "whole", tmp_path / "stopped"
    shutil.copytree(hdf, stopped)
    (stopped / "checkpoints" / "checkpoint_000000000012.npfem").unlink()  # goes on from step 7, before two of its times
    assert program("resume", stopped, "--quiet", ranks=2).returncode == 0
    shutil.copytree(hdf, whole)

    def contents(path):
        found = {}
        with h5py.File(path) as file:
            file.visititems(lambda name, item: found.update({name: item[()].tobytes()} if hasattr(item, "shape") else {}))
            found["NSteps"] = file["VTKHDF/Steps"].attrs["NSteps"]
        return found

    for name in ("cells.vtkhdf", "fluid.vtkhdf"):
        assert contents(stopped / name) == contents(whole / name)
    (stopped / "cells.vtkhdf").write_bytes(b"killed while it was written")
    assert program("resume", stopped, "--quiet", "--set", "run.steps=15").returncode == 0
    assert (stopped / "cells.vtkhdf.damaged").exists()
    with h5py.File(stopped / "cells.vtkhdf") as file:
        assert list(file["VTKHDF/Steps/Values"]) == [1.5]
