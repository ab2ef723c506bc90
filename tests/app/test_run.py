# SPDX-License-Identifier: MPL-2.0
"""npfem run: what it writes, what it answers, and that it does so the same on any number of ranks."""
import csv
import json
import os
import resource
import signal
import subprocess
import time

import pytest

SUMMARY_KEYS = {"steps", "wall_s", "mlups", "cell_steps_per_s", "haematocrit", "momentum_error", "volume_error",
                "worst_residual_pN", "failed_cells", "state_hash", "minimum_gap_um", "ranks", "title", "version",
                "cell_types", "interrupted"}


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture
def finished(program, scene, tmp_path):
    folder = tmp_path / "out"
    result = program("run", scene, "-o", folder)
    assert result.returncode == 0, result.stderr
    return folder, result


def test_writes_everything(finished):
    folder, result = finished
    names = sorted(path.name for path in folder.iterdir())
    assert names == (["cells.csv", "cells.pvd"] + ["cells_%09d.vtu" % step for step in (0, 5, 10, 12)] +
                     ["fluid.pvd", "fluid_000000000.vti", "fluid_000000012.vti", "rheology.csv", "scene.toml",
                      "summary.json", "view.py"])
    summary = summary_of(folder)
    assert SUMMARY_KEYS <= set(summary)
    assert summary["steps"] == 12 and summary["failed_cells"] == 0 and summary["interrupted"] is False
    assert summary["cell_types"] == ["rbc", "platelet"]
    assert abs(summary["momentum_error"]) < 1e-10
    assert len(summary["state_hash"]) == 16 and summary["state_hash"] in result.stdout
    assert "step 12/12" in result.stderr and "MLUPS" in result.stderr


def test_collections_name_files_that_exist(finished):
    folder, _ = finished
    for name, count in (("cells.pvd", 4), ("fluid.pvd", 2)):
        lines = [line for line in (folder / name).read_text().splitlines() if "<DataSet" in line]
        files = [line.split('file="')[1].split('"')[0] for line in lines]
        assert len(files) == count
        assert all((folder / file).is_file() for file in files)


def test_cell_files_are_read_by_meshio(finished):
    meshio = pytest.importorskip("meshio")
    folder, _ = finished
    mesh = meshio.read(folder / "cells_000000012.vtu")
    assert mesh.points.shape == (3 * 66, 3)
    assert mesh.cells[0].type == "triangle" and len(mesh.cells[0].data) == 3 * 128
    assert mesh.point_data["velocity_um_per_us"].shape == (3 * 66, 3)
    assert mesh.point_data["force_pN"].shape == (3 * 66, 3)
    assert sorted(set(mesh.cell_data["cell_id"][0])) == [0, 1, 2]
    assert sorted(set(mesh.cell_data["cell_type"][0])) == [0, 1]


def test_table_has_a_line_per_cell_and_time(finished):
    folder, _ = finished
    rows = list(csv.DictReader((folder / "cells.csv").open()))
    assert [(row["step"], row["cell_id"], row["type"]) for row in rows] == [
        (step, cell, "platelet" if cell == "2" else "rbc") for step in ("0", "12") for cell in ("0", "1", "2")]
    for row in rows:
        assert 0 < float(row["volume_um3"]) < 100
        assert float(row["long_semi_axis_um"]) >= float(row["short_semi_axis_um"]) > 0
        assert row["status"] == "0"


def test_resolved_scene_gives_the_same_bits(program, finished, tmp_path):
    folder, _ = finished
    again = tmp_path / "again"
    assert program("run", folder / "scene.toml", "-o", again, "--quiet").returncode == 0
    assert summary_of(again)["state_hash"] == summary_of(folder)["state_hash"]
    assert (again / "scene.toml").read_bytes() == (folder / "scene.toml").read_bytes()


@pytest.mark.parametrize("ranks", [1, 2, 3, 4])
def test_any_number_of_ranks_gives_the_same_files(program, scene, finished, tmp_path, ranks):
    folder, _ = finished
    parallel = tmp_path / "parallel"
    result = program("run", scene, "-o", parallel, ranks=ranks)
    assert result.returncode == 0, result.stderr
    assert summary_of(parallel)["ranks"] == ranks
    assert summary_of(parallel)["state_hash"] == summary_of(folder)["state_hash"]
    assert result.stdout.count("steps,") == 1, "only one rank prints"
    for path in folder.iterdir():
        if path.name != "summary.json":
            assert (parallel / path.name).read_bytes() == path.read_bytes(), path.name


def test_sets_and_prints_json(program, scene, tmp_path):
    result = program("run", scene, "-o", tmp_path / "out", "--set", "run.steps=2", "--set", "cells[1].count=0",
                     "--json", "--quiet")
    assert result.returncode == 0 and result.stderr == ""
    summary = json.loads(result.stdout)
    assert summary["steps"] == 2 and summary["cells"] == 2


def test_refuses_a_folder_that_is_not_empty(program, scene, finished):
    folder, _ = finished
    before = (folder / "summary.json").read_bytes()
    result = program("run", scene, "-o", folder)
    assert result.returncode == 2
    assert "is not empty; choose another one, or add --overwrite" in result.stderr
    assert (folder / "summary.json").read_bytes() == before
    (folder / "notes.txt").write_text("mine")
    assert program("run", scene, "-o", folder, "--overwrite", "--set", "run.steps=1").returncode == 0
    assert summary_of(folder)["steps"] == 1
    assert not (folder / "cells_000000012.vtu").exists() and (folder / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize("ranks", [None, 2])
@pytest.mark.parametrize("setting, message", [
    ("flow.shear_rat=1 1/s", 'unknown key "shear_rat" in [flow]; did you mean "shear_rate"?'),
    ("domain.dx=0.5", "0.5 has no unit"),
    ("cells[0].material=rcb", 'did you mean "rbc"?'),
    ("cells[0].count=50", "no room for 51 cells"),
])
def test_bad_input_leaves_nothing_behind(program, scene, tmp_path, setting, message, ranks):
    result = program("run", scene, "-o", tmp_path / "out", "--set", setting, ranks=ranks)
    assert result.returncode == 2
    assert result.stderr.count(message) == 1
    assert not (tmp_path / "out").exists()


def test_missing_scene_and_unwritable_output(program, scene, tmp_path):
    missing = program("run", tmp_path / "no.toml", "-o", tmp_path / "out")
    assert missing.returncode == 2 and "no.toml" in missing.stderr and not (tmp_path / "out").exists()
    unwritable = program("run", scene, "-o", "/proc/out")
    assert unwritable.returncode == 2 and "/proc/out" in unwritable.stderr


def test_more_ranks_than_the_grid_can_hold_is_bad_input(program, scene, tmp_path):
    small = ["--set", 'domain.size=["2 um","2 um","2 um"]', "--set", "cells[0].count=0", "--set", "cells[1].count=0"]
    result = program("run", scene, "-o", tmp_path / "out", *small, ranks=9)
    assert result.returncode == 2
    assert not (tmp_path / "out").exists()


def test_a_cell_that_cannot_be_solved_is_named(program, scene, tmp_path):
    folder = tmp_path / "out"
    result = program("run", scene, "-o", folder, "--set", "solver.max_iterations=1", "--set",
                     "solver.tolerance=1e-9 pN", "--set", "solver.residual_bound=1e-9 pN", "--set",
                     "solver.newton_iterations=0")
    assert result.returncode == 3, result.stderr
    assert "npfem: cell 0 (rbc) failed in step" in result.stderr
    summary = summary_of(folder)
    assert summary["failed_cells"] == len(summary["failures"]) > 0
    assert summary["failures"][0]["cell_id"] == 0 and summary["failures"][0]["reason"]
    assert (folder / ("cells_%09d.vtu" % summary["steps"])).exists(), "the last state is saved"


def test_a_fluid_that_blows_up_is_unstable(program, scene, tmp_path):
    scene.write_text("""schema_version = 1
[domain]
kind = "tube"
diameter = "6 um"
length = "4 um"
dx = "0.5 um"
[fluid]
kinematic_viscosity = "1e-6 m2/s"
tau = 0.5005
[flow]
centre_velocity = "2000 m/s"
start = "developed"
[run]
steps = 10000
""")
    result = program("run", scene, "-o", tmp_path / "out", "--quiet")
    assert result.returncode == 3 and "the fluid is no longer finite" in result.stderr
    summary = summary_of(tmp_path / "out")
    assert summary["fluid_failed"] is True and summary["steps"] < 10000


def test_a_signal_ends_the_run_in_order(scene, tmp_path):
    folder = tmp_path / "out"
    run = subprocess.Popen([os.environ["NPFEM_PROGRAM"], "run", str(scene), "-o", str(folder), "--set",
                            "run.steps=1000000"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    deadline = time.monotonic() + 60
    while not (folder / "cells_000000005.vtu").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    run.send_signal(signal.SIGTERM)
    _, errors = run.communicate(timeout=60)
    assert run.returncode == 75 and "stopped after step" in errors
    summary = summary_of(folder)
    assert summary["interrupted"] is True and 5 <= summary["steps"] < 1000000
    assert (folder / ("cells_%09d.vtu" % summary["steps"])).exists()


def test_a_full_disk_is_an_error_that_names_the_file(program, scene, tmp_path):
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

    folder = tmp_path / "out"
    result = program("run", scene, "-o", folder, preexec_fn=limit)
    assert result.returncode == 1
    assert "cannot write" in result.stderr and "cells_000000000.vtu" in result.stderr
    assert not list(folder.glob("*.vtu")) and not list(folder.glob("*.part"))


def test_overwrite_spares_what_no_run_wrote(program, scene, tmp_path):
    table = tmp_path / "mine" / "cells.csv"
    table.parent.mkdir()
    table.write_text("my own table\n")
    result = program("run", scene, "-o", table.parent, "--overwrite")
    assert result.returncode == 2
    assert "holds files but no run that could be replaced" in result.stderr
    assert table.read_text() == "my own table\n"


def test_a_run_does_not_replace_its_own_scene(program, scene):
    before = scene.read_text()
    result = program("run", scene, "-o", scene.parent, "--overwrite")
    assert result.returncode == 2
    assert "is the one the scene lies in" in result.stderr
    assert scene.read_text() == before


def test_a_haematocrit_below_one_cell_is_an_error(program, scene, tmp_path):
    scene.write_text(scene.read_text().replace("count = 1", "haematocrit = 1e-6"))
    result = program("run", scene, "-o", tmp_path / "out")
    assert result.returncode == 2
    assert "is less than half a cell in this domain" in result.stderr
    assert not (tmp_path / "out").exists()
