# SPDX-License-Identifier: MPL-2.0
"""The other verbs, and how verbs are found."""
import json
import os
import pathlib
import re
import stat

import pytest


def test_version_and_help(program):
    assert program("version").stdout.startswith("npfem 0.")
    help_text = program("--help")
    assert help_text.returncode == 0
    for verb in ("run", "plan", "validate", "mesh", "inspect", "bench", "keys", "version", "stretch"):
        assert verb in help_text.stdout


def test_wrong_arguments_are_bad_input(program, scene):
    assert program().returncode == 2
    assert program("run", scene).returncode == 2  # no output folder
    assert program("plan", scene, "--no-such-option").returncode == 2


def test_unknown_verb_names_the_nearest(program):
    result = program("vaildate")
    assert result.returncode == 2
    assert result.stderr.startswith('npfem: unknown verb "vaildate"; did you mean "validate"?')


def test_a_program_on_the_path_is_a_verb(program, tmp_path):
    script = tmp_path / "npfem-hello"
    script.write_text('#!/bin/sh\necho "hello $1"\nexit 7\n')
    script.chmod(script.stat().st_mode | stat.S_IXUSR)
    result = program("hello", "world", env=dict(os.environ, PATH="%s:%s" % (tmp_path, os.environ["PATH"])))
    assert result.returncode == 7 and result.stdout == "hello world\n"


def test_verbs_written_in_python(program):
    result = program("stretch", "--help")
    assert result.returncode == 0 and "--force" in result.stdout


def test_plan_says_what_is_active(program, scene):
    text = program("plan", scene)
    assert text.returncode == 0
    for word in ("shear_box", "2 x rbc", "implicit, 4-point kernel", "kappa_shear rbc", "MB fluid", "s per step"):
        assert word in text.stdout
    plan = json.loads(program("plan", scene, "--json").stdout)
    assert plan["domain"]["fluid_nodes"] == 24 * 20 * 20
    assert [cells["cells"] for cells in plan["cells"]] == [2, 1]
    assert plan["contact"] == {"between_cells": True, "with_walls": True}
    assert {limit["name"] for limit in plan["limits"]} >= {"tau", "Ma", "gdot_T", "kappa_shear rbc"}
    no_cells = json.loads(program("plan", scene, "--json", "--set", "cells[0].count=0", "--set",
                                  "cells[1].count=0").stdout)
    assert no_cells["coupling"]["active"] is False


@pytest.mark.parametrize("box", ["", 'kind = "tube"\ndiameter = "4000 um"\nlength = "4000 um"'])
def test_an_absurd_size_is_planned_at_once_and_not_run(program, scene, tmp_path, box):
    text = scene.read_text().replace('["12 um", "10 um", "10 um"]', '["4000 um", "4000 um", "4000 um"]')
    if box:
        text = re.sub(r'kind = "shear_box"\nsize = .*', box, text).replace('shear_rate = "5000 1/s"', '')
    scene.write_text(text.replace("5000 1/s", "1 1/s"))
    plan = program("plan", scene)  # to fill memory with such a size would take far longer than a test may
    assert plan.returncode == 0, plan.stderr
    assert "too little for it" in plan.stdout
    assert ("about 40" in plan.stdout) == bool(box), "nodes of a large tube are estimated"
    run = program("run", scene, "-o", tmp_path / "out")
    assert run.returncode == 2
    assert re.search(r"scene.toml:[78]:6: domain.dx: 80\d\d x 80\d\d x 8000 nodes need about .* larger dx", run.stderr)
    assert not (tmp_path / "out").exists()


def test_plan_estimates_the_flow_of_a_narrow_place(program):
    scene = pathlib.Path(__file__).resolve().parents[2] / "examples" / "constriction" / "scene.toml"
    text = program("plan", scene).stdout
    assert "an estimate by the narrowest section" in text
    plan = json.loads(program("plan", scene, "--json").stdout)
    assert plan["flow"]["estimated"] is True
    # 4 mm/s in 16 um is 16 mm/s in 8 um: 32 mm/s on the axis, 4 U/R at the wall
    assert abs(plan["flow"]["largest_velocity_um_per_us"] / 0.032 - 1) < 0.1
    assert abs(plan["flow"]["largest_shear_rate_per_us"] / 0.016 - 1) < 0.15


def test_a_mean_velocity_with_solids_is_warned_of(program, tmp_path):
    slit = pathlib.Path(__file__).resolve().parents[2] / "examples" / "slit" / "scene.toml"
    scene = tmp_path / "slit.toml"
    scene.write_text(slit.read_text().replace('pressure_gradient = "4 MPa/m"', 'mean_velocity = "1 mm/s"'))
    warning = "flow.mean_velocity: the force, 0.1 MPa/m, is that of the channel without the solids in it"
    assert warning in program("plan", scene).stdout
    assert warning in program("validate", scene).stdout
    run = program("run", scene, "-o", tmp_path / "out", "--quiet", "--set", "run.steps=0")
    assert run.returncode == 0 and warning in run.stderr


def test_validate(program, scene):
    assert "valid; 3 cells placed" in program("validate", scene).stdout
    valid = json.loads(program("validate", scene, "--json").stdout)
    assert valid["valid"] is True and valid["cells"] == 3
    bad = program("validate", scene, "--json", "--set", "domain.dx=0.7 um")
    assert bad.returncode == 2
    refused = json.loads(bad.stdout)
    assert refused["valid"] is False and "not a whole number of node spacings" in refused["error"]
    coarse = program("validate", scene, "--set", "fluid.time_step=1 us")
    assert coarse.returncode == 0 and "bounds exceeded" in coarse.stdout


def test_mesh_makes_and_checks(program, tmp_path):
    path = tmp_path / "rbc.off"
    made = program("mesh", "rbc", "--level", "3", "-o", path)
    assert made.returncode == 0 and "258 vertices, 512 triangles" in made.stdout
    checked = program("mesh", "check", path)
    assert checked.returncode == 0 and "closed" in checked.stdout
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-1]).replace("258 512", "258 511") + "\n")
    open_mesh = program("mesh", "check", path)
    assert open_mesh.returncode == 2 and "rbc.off" in open_mesh.stderr
    assert program("mesh", "rcb").returncode == 2
    sized = program("mesh", "sphere", "--size", "4 um")
    assert "extents 4 x 4 x 4 um" in sized.stdout
    assert program("mesh", "sphere", "--size", "4").returncode == 2


def test_inspect(program, scene, tmp_path):
    assert "shear_modulus" in program("inspect", "rbc").stdout
    assert "scene" in program("inspect", scene).stdout
    path = tmp_path / "ball.stl"
    program("mesh", "sphere", "--level", "2", "-o", path)
    assert "66 vertices" in program("inspect", path).stdout
    unknown = program("inspect", "rcb")
    assert unknown.returncode == 2 and 'did you mean "rbc"?' in unknown.stderr


def test_keys_prints_the_reference(program):
    page = program("keys").stdout
    assert page.startswith("# Scene files") and "`shear_rate`" in page


def test_docs_hold_the_readers_own_table(program):
    page = pathlib.Path(__file__).resolve().parents[2] / "docs" / "scene.md"
    assert page.read_text(encoding="utf-8") == program("keys").stdout, "docs/scene.md: write it anew with npfem keys"
