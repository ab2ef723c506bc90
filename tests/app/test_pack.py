# SPDX-License-Identifier: MPL-2.0
"""npfem pack: what it writes, what a run does with it, and what it refuses."""
import json
import os
import signal
import subprocess
import time

import pytest


@pytest.fixture
def crowded(tmp_path, scene):
    path = tmp_path / "crowded.toml"
    path.write_text(scene.read_text().replace("count = 2", "haematocrit = 0.3", 1).replace('["12 um", "10 um", "10 um"]',
                                                                                   '["14 um", "14 um", "14 um"]'))
    return path


def test_packs_a_scene_that_runs(program, crowded, tmp_path):
    packed = tmp_path / "packed.toml"
    result = program("pack", crowded, "-o", packed, "--json")
    assert result.returncode == 0, result.stderr
    summary = json.loads(result.stdout)
    assert summary == json.loads((tmp_path / "packed.json").read_text())
    one_cell = 94 / 14**3
    assert abs(summary["types"][0]["haematocrit"] - 0.3) <= one_cell / 2
    assert abs(summary["volume_fraction_delivered"] - summary["volume_fraction_asked"]) < 0.005
    assert summary["overlap_before_um"] > 0 and summary["overlap_after_um"] == 0 and summary["least_gap_um"] > 0
    assert summary["crossing_triangles"] == 0 and summary["worst_volume_error"] < 0.01
    assert summary["least_wall_gap_um"] > 0
    run = program("run", packed, "-o", tmp_path / "out", "--json")
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["cells"] == summary["cells"]


@pytest.mark.parametrize("ending", ["toml", "cells", "json"])
def test_refuses_what_it_would_replace(program, crowded, tmp_path, ending):
    mine = tmp_path / ("packed." + ending)
    mine.write_text("mine")
    result = program("pack", crowded, "-o", tmp_path / "packed.toml", "--quiet")
    assert result.returncode == 2 and "--overwrite" in result.stderr and mine.name in result.stderr
    assert mine.read_text() == "mine" and not [p for p in tmp_path.glob("packed.*") if p != mine]


@pytest.mark.parametrize("name", ["packed.json", "packed.cells", "packed", ".toml", "packed.toml.gz"])
def test_the_packed_scene_is_a_toml_file(program, crowded, tmp_path, name):
    """With another ending the scene, its cells and the summary could be one and the same file."""
    before = sorted(tmp_path.iterdir())
    result = program("pack", crowded, "-o", tmp_path / name, "--quiet", "--overwrite")
    assert result.returncode == 2 and "ends in .toml" in result.stderr
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("change, message", [
    ("cells[0].haematocrit=0.8", "it has reached haematocrit 0."),
    ('domain.size=["7 um", "7 um", "20 um"]', "is larger than the domain (7 x 7 x 20 um)"),
    ("cells[0].material=nothing", "nothing"),
])
def test_says_why_it_cannot(program, crowded, tmp_path, change, message):
    result = program("pack", crowded, "-o", tmp_path / "packed.toml", "--quiet", "--set", change)
    assert result.returncode == 2 and message in result.stderr, result.stderr
    assert not (tmp_path / "packed.toml").exists() and not (tmp_path / "packed.cells").exists()


def test_an_interrupt_writes_nothing(crowded, tmp_path):
    process = subprocess.Popen([os.environ["NPFEM_PROGRAM"], "pack", str(crowded), "-o", str(tmp_path / "packed.toml"),
                                "--set", "cells[0].haematocrit=0.75",
                                "--set", 'domain.size=["80 um", "80 um", "80 um"]'],
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while "overlap" not in process.stderr.readline():  # the first line of progress: at work for many seconds more
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 1 and "nothing was written" in errors
    assert not (tmp_path / "packed.toml").exists()
