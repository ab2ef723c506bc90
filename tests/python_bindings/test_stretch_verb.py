# SPDX-License-Identifier: MPL-2.0
import json

import pytest

import npfem
from npfem import __main__ as program
from npfem.stretch_verb import parse_forces


@pytest.mark.parametrize("text, forces", [("0:200:25", [0, 25, 50, 75, 100, 125, 150, 175, 200]), ("0:0.3:0.1", None),
                                          ("50", [50]), ("100,0,50,50", [0, 50, 100]), ("5:5:1", [5])])
def test_forces(text, forces):
    parsed = parse_forces(text)
    if forces is None:
        assert parsed == pytest.approx([0, 0.1, 0.2, 0.3])
    else:
        assert parsed == forces


@pytest.mark.parametrize("text", ["", "a", "0:10", "0:10:0", "10:0:1", "0:10:-1", "-5", "nan", "0:inf:1", "0:1e9:1e-3",
                                  "1,,2", "0:10:2:3"])
def test_forces_that_make_no_sense(text):
    with pytest.raises(ValueError, match="--force"):
        parse_forces(text)


def run(arguments, capsys):
    code = program.main(arguments)
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def test_table_json_and_picture(tmp_path, capsys):
    result, picture = tmp_path / "out.json", tmp_path / "curve.png"
    code, out, err = run(["stretch", "--material", "rbc", "--force", "0:40:20", "--level", "2", "--json", str(result),
                          "--plot", str(picture)], capsys)
    assert (code, err) == (0, "")
    assert "rms departure from Mills et al. 2004 over 4 points" in out
    table = [line.split() for line in out.splitlines()[1:4]]
    document = json.loads(result.read_text())
    assert [row["force_pN"] for row in document["results"]] == [0.0, 20.0, 40.0]
    for row, line in zip(document["results"], table):
        assert {"force_pN", "axial_um", "transverse_um"} <= set(row)
        assert float(line[1]) == pytest.approx(row["axial_um"], abs=1e-3)
        assert float(line[2]) == pytest.approx(row["transverse_um"], abs=1e-3)
    assert document["mills_2004"]["points"] == 4
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["curve.png", "out.json"]


def test_without_the_measurement(tmp_path, capsys):
    result = tmp_path / "out.json"
    code, out, _ = run(["stretch", "--material", "platelet", "--force", "0,5", "--no-measured", "--no-plot", "--json",
                        str(result), "--load", "shared"], capsys)
    assert code == 0
    assert "Mills" not in out
    assert "mills_2004" not in json.loads(result.read_text())


def test_a_cell_that_finds_no_rest_is_told(tmp_path, capsys, monkeypatch):
    relax = npfem.Batch.relax

    def relax_in_two_iterations(batch):
        batch["relax_iterations"] = 2
        batch["newton_iterations"] = 0
        batch["residual_bound"] = 1e-3
        return relax(batch)

    monkeypatch.setattr(npfem.Batch, "relax", relax_in_two_iterations)
    result = tmp_path / "out.json"
    code, out, err = run(["stretch", "--material", "palabos-rbc", "--force", "0:40:20", "--level", "2", "--json",
                          str(result), "--plot", str(tmp_path / "curve.png")], capsys)
    assert code == 1
    assert "no equilibrium found under 16 pN" in err
    assert [row["status"] for row in json.loads(result.read_text())["results"]] == ["converged", "not converged"]
    assert (tmp_path / "curve.png").exists()


@pytest.mark.parametrize("arguments, words", [
    (["--material", "rcb"], "rbc"),
    (["--material", "/nowhere/rbc.toml"], "/nowhere/rbc.toml"),
    (["--force", "ten"], '--force "ten"'),
    (["--json", "/nowhere/out.json"], "/nowhere/out.json"),
    (["--plot", "/nowhere/out.png"], "/nowhere/out.png"),
    (["--plot", "curve.xyz"], ".png"),
    (["--contact", "-1"], "contact"),
    (["--level", "99"], "level"),
])
def test_bad_input_is_told_and_nothing_is_written(arguments, words, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(["stretch"] + arguments, capsys)
    assert code == 2
    assert words in err
    assert len(err.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", [[], ["stretc"], ["stretch", "--load", "glued"], ["stretch", "--level", "x"],
                                       ["preview"]])
def test_bad_command_lines_exit_with_2(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        program.main(arguments)
    assert caught.value.code == 2


def test_help(capsys):
    with pytest.raises(SystemExit) as caught:
        program.main(["stretch", "--help"])
    assert caught.value.code == 0
    assert "start:stop:step" in capsys.readouterr().out
