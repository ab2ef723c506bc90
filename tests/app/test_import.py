# SPDX-License-Identifier: MPL-2.0
"""npfem import: inputs of Palabos-npFEM as scenes."""
import os
import pathlib
import shutil

import pytest

SHARED = pathlib.Path(os.environ.get("NPFEM_SHARED", "/nowhere")) / "data" / "palabos-npfem"


@pytest.fixture
def lineage(tmp_path):
    """A copy of the lineage's files, without its start set."""
    if not SHARED.exists():
        pytest.skip("no files of the lineage in %s" % SHARED)
    folder = tmp_path / "lineage"
    shutil.copytree(SHARED, folder, ignore=shutil.ignore_patterns("*.tar.gz", "reference_runs"))
    return folder


def test_imported_scene_is_valid_and_runs(program, lineage):
    scene = lineage / "obstacle.toml"
    result = program("import", lineage / "obstacle_params.xml", "-o", scene)
    assert result.returncode == 0, result.stderr
    assert "what differs from the run of Palabos-npFEM" in result.stdout
    for note in result.stdout.splitlines()[1:]:
        assert "# " + note in scene.read_text()
    assert program("validate", scene).returncode == 0
    run = program("run", scene, "-o", lineage / "out", "--set", "run.steps=4", "--quiet")
    assert run.returncode == 0, run.stderr


def test_nothing_is_overwritten_or_half_written(program, lineage):
    scene = lineage / "scene.toml"
    scene.write_text("mine")
    refused = program("import", lineage / "obstacle_params.xml", "-o", scene)
    assert refused.returncode == 2 and "exists already" in refused.stderr
    assert scene.read_text() == "mine"
    missing = program("import", lineage / "shear_params.xml", "-o", lineage / "shear.toml")
    assert missing.returncode == 2
    assert "CheckPointing/CP_OutputDir: there is no folder" in missing.stderr
    assert not list(lineage.glob("shear.toml*")) and not list(lineage.glob("*.cells*"))


def test_bad_arguments(program, lineage):
    assert program("import", lineage / "obstacle_params.xml").returncode == 2
    wrong = program("import", lineage / "obstacle_params.xml", "-o", lineage / "a.toml", "--coupling", "magic")
    assert wrong.returncode == 2
    assert program("import", lineage / "no.xml", "-o", lineage / "a.toml").returncode == 2
