# SPDX-License-Identifier: MPL-2.0
"""A dense suspension, packed and run: the same bits for any number of ranks and threads."""
import csv
import json
import os
import pathlib

import pytest

SCENE = """
schema_version = 1
title = "dense blood in shear"
[domain]
kind = "shear_box"
size = ["15 um", "15 um", "15 um"]
dx = "0.5 um"
[fluid]
kinematic_viscosity = "1e-6 m2/s"
tau = 2.0
[flow]
shear_rate = "2000 1/s"
start = "developed"
[[cells]]
name = "rbc"
material = "palabos-rbc"
haematocrit = 0.33
[[cells]]
name = "platelet"
material = "palabos-platelet"
ratio = 0.2
ratio_to = "rbc"
[coupling]
cell_every = 2
[run]
steps = 40
[output]
cells = false
fluid = false
"""


@pytest.fixture
def packed(program, tmp_path):
    folder = tmp_path
    (folder / "scene.toml").write_text(SCENE)
    result = program("pack", folder / "scene.toml", "-o", folder / "packed.toml", "--quiet")
    assert result.returncode == 0, result.stderr
    return folder / "packed.toml"


def summary_of(program, scene, folder, ranks=None, **environment):
    result = program("run", scene, "-o", folder, "--quiet", ranks=ranks, env=dict(os.environ, **environment))
    assert result.returncode == 0, result.stderr
    return json.loads((folder / "summary.json").read_text())


def test_the_same_bits_for_any_ranks_and_threads(program, packed, tmp_path):
    alone = summary_of(program, packed, tmp_path / "alone")
    assert alone["haematocrit"] > 0.3 and alone["failed_cells"] == 0
    # Cells lie across the faces, edges and corners of the blocks, and touch: without contacts the state is another.
    assert alone["minimum_gap_um"] < 0.3 and alone["crossing_triangles"] == 0
    assert alone["momentum_error"] < 1e-12 and alone["volume_error"] < 5e-3
    assert 0 < alone["least_gap_um"] < 0.5 and alone["worst_volume_error"] >= alone["volume_error"]
    untouched = program("run", packed, "-o", tmp_path / "untouched", "--quiet", "--set", 'contact.range="0 um"')
    assert untouched.returncode == 0
    assert json.loads((tmp_path / "untouched" / "summary.json").read_text())["state_hash"] != alone["state_hash"]
    threads = summary_of(program, packed, tmp_path / "threads", OMP_NUM_THREADS="2")
    assert threads["state_hash"] == alone["state_hash"]
    if "NPFEM_MPIEXEC" not in os.environ:
        pytest.skip("built without MPI")
    for ranks in (2, 3, 4, 8):
        several = summary_of(program, packed, tmp_path / str(ranks), ranks=ranks)
        for measure in ("state_hash", "least_gap_um", "worst_volume_error"):
            assert (several["ranks"], several[measure]) == (ranks, alone[measure])


def test_dense_shear_keeps_cells_apart_and_their_volume(program, tmp_path):
    """examples/dense_shear, in every step of the run and not only at its end."""
    steps = int(os.environ.get("NPFEM_DENSE_STEPS", "0"))
    if steps == 0:
        pytest.skip("for the night: NPFEM_DENSE_STEPS is not set")
    example = pathlib.Path(__file__).resolve().parents[2] / "examples" / "dense_shear" / "scene.toml"
    packed = tmp_path / "packed.toml"
    assert program("pack", example, "-o", packed, "--quiet").returncode == 0
    # resumed half-way: the worst so far goes on
    half = program("run", packed, "-o", tmp_path / "out", "--quiet", "--set", "run.steps=%d" % (steps // 2),
                   "--set", "output.cells=false", "--set", "output.fluid=false",
                   "--set", "output.checkpoint_every=%d" % (steps // 2))
    assert half.returncode == 0, half.stderr
    first = json.loads((tmp_path / "out" / "summary.json").read_text())
    rest = program("resume", tmp_path / "out", "--quiet", "--set", "run.steps=%d" % steps)
    assert rest.returncode == 0, rest.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["steps"] == steps and summary["failed_cells"] == 0
    assert abs(summary["haematocrit"] - 0.35) < 0.005
    assert summary["crossing_triangles"] == 0 and first["crossing_triangles"] == 0
    assert 0 < summary["least_gap_um"] <= first["least_gap_um"]
    assert first["worst_volume_error"] <= summary["worst_volume_error"] < 0.005
    with open(tmp_path / "out" / "rheology.csv") as table:
        gaps = [float(row["least_gap_um"]) for row in csv.DictReader(table)]
    assert gaps == sorted(gaps, reverse=True) and gaps[-1] == summary["least_gap_um"]
