# SPDX-License-Identifier: MPL-2.0
import json
import sys

import numpy
import pytest

import npfem
from npfem import __main__ as program
from npfem import curve_plot, fit_data, fitting, recovery

FORCES = (20.0, 50.0, 90.0, 140.0)
SETUP = fitting.Setup(level=2, load="rigid", contact_diameter_um=2.0)
TRUTH = {"shear_modulus": 4.2, "stress_free_reduced_volume": 0.93}


def write_points(path, points, header="force_pN,axial_um,transverse_um"):
    path.write_text("# made up\n%s\n" % header + "".join("%r,%r,%r\n" % tuple(point) for point in points))
    return str(path)


def with_noise(points, random):
    """Points off by 3 % axially and 5 % across, rms."""
    return [(force, axial * (1 + 0.03 * random.standard_normal()), across * (1 + 0.05 * random.standard_normal()))
            for force, axial, across in points]


@pytest.fixture(scope="module")
def truth():
    """Points of a cell with the parameters TRUTH."""
    with npfem.Material.preset("rbc") as material:
        material.update(**TRUTH)
        return [(row["force_pN"], row["axial_um"], row["transverse_um"])
                for row in npfem.stretch(material, FORCES, level=2)]


def run(arguments, capsys):
    code = program.main(["fit", "--level", "2"] + arguments)
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def test_made_up_data_give_their_parameters_back(truth, tmp_path, capsys):
    data = write_points(tmp_path / "mine.csv", truth)
    files = {"-o": tmp_path / "mine.toml", "--json": tmp_path / "fit.json", "--plot": tmp_path / "fit.png"}
    outputs = [str(part) for pair in files.items() for part in pair]
    code, out, err = run(["--data", data, "--free", ",".join(TRUTH)] + outputs, capsys)
    assert (code, err) == (0, "")
    assert "converged" in out and "rigid contact 2 um across (3 vertices" in out
    document = json.loads(files["--json"].read_text())
    assert document["rms_axial"] < 1e-3 and document["points"] == 4
    for row in document["parameters"]:
        assert row["value"] == pytest.approx(TRUTH[row["key"]], rel=5e-3)
        assert row["low"] <= row["value"] <= row["high"]
        assert row["identified"]
    axial, across = document["sensitivities"][1]["shear_modulus"]
    assert -0.5 < axial < -0.1 and 0.05 < across < 0.5
    text = files["-o"].read_text()
    assert 'name = "mine"' in text
    assert "Fitted by npfem fit to mine.csv; 95 % interval" in text and "mesh of 66 vertices" in text
    with npfem.Material.load(str(files["-o"])) as written:
        assert written["shear_modulus"] == pytest.approx(4.2, rel=5e-3)
        assert written["skalak_C"] == 10
    assert files["--plot"].read_bytes().startswith(b"\x89PNG")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["fit.json", "fit.png", "mine.csv", "mine.toml"]


def test_noise_gives_intervals_that_hold_the_truth(truth):
    # The 95 % interval of each of 6 sets; by chance 2 or more lie outside in 3 % of all cases.
    random, covered, widths = numpy.random.default_rng(2), 0, []
    with npfem.Material.preset("rbc") as material:
        material.update(**TRUTH)
        for _ in range(6):
            measured = fitting.Measured(with_noise(truth, random), [])
            row, = fitting.fit(material, ["shear_modulus"], measured, SETUP)["parameters"]
            covered += row["low"] <= TRUTH["shear_modulus"] <= row["high"]
            widths.append(row["high"] / row["low"] - 1)
    assert covered >= 5
    assert 0.05 < numpy.median(widths) < 0.4


def test_what_the_data_do_not_tell_is_said(truth, tmp_path, capsys):
    data = write_points(tmp_path / "a.csv", with_noise(truth, numpy.random.default_rng(3)))
    _, out, _ = run(["--data", data, "--free", "shear_modulus,bending_modulus"], capsys)
    assert "These data cannot identify bending_modulus: " in out
    assert "2 to 4: " in out and "2.4 to 2.75: outside" in out


def test_a_value_at_the_end_of_the_search_is_no_result(tmp_path, capsys):
    stiff = [(force, 7.8 + 1e-3 * force, 7.7 - 1e-3 * force) for force in FORCES]
    code, out, err = run(["--data", write_points(tmp_path / "a.csv", stiff), "-o", str(tmp_path / "a.toml")], capsys)
    assert code == 1
    assert "cannot identify shear_modulus: it stands at the end of the search, 50 uN/m" in out
    assert "shear_modulus ended at the limit of the search" in err and "no material is written" in err
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_viscosity_from_the_recovery_of_one_cell(tmp_path, capsys):
    # t_c is proportional to the viscosity: 0.2 s need 0.2/0.1268 of the 0.5 uN s/m that give 0.1268 s (66 vertices).
    times = numpy.linspace(0.0, 0.5, 20)
    lines = ["%r,%r" % (float(time), recovery.law(time, 0.2, 2.0, 1.15)) for time in times]
    (tmp_path / "cell.csv").write_text("time_s,length_over_width\n" + "\n".join(lines) + "\n")
    code, out, _ = run(["--data", "--relaxation", str(tmp_path / "cell.csv"), "-o", str(tmp_path / "a.toml")], capsys)
    assert code == 0 and "time of recovery: 0.200 s" in out
    with npfem.Material.load(str(tmp_path / "a.toml")) as fitted:
        assert fitted["membrane_shear_viscosity"] / 1e6 == pytest.approx(0.5 * 0.2 / 0.1268, rel=0.03)


@pytest.mark.parametrize("calls", [1, 4])
def test_interrupted_it_leaves_nothing(calls, tmp_path, capsys, monkeypatch):
    pull, made = fitting.tweezers.stretch, []

    def interrupted(*arguments):
        made.append(arguments)
        if len(made) == calls:
            raise KeyboardInterrupt
        return pull(*arguments)

    monkeypatch.setattr(fitting.tweezers, "stretch", interrupted)
    code, _, err = run(["-o", str(tmp_path / "a.toml"), "--json", str(tmp_path / "a.json")], capsys)
    assert code == 130 and "interrupted" in err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments, words", [
    (["--free", "stiffness"], 'no parameter "stiffness" can be fitted; allowed: shear_modulus, skalak_C'),
    (["--free", ""], "--free"),
    (["--free", "shear_modulus,shear_modulus"], "each parameter once"),
    (["--free", "yeoh_c3"], "yeoh_c3 acts with membrane_law = yeoh, this material has skalak"),
    (["--free", "membrane_shear_viscosity"], "give --relaxation"),
    (["--free", "shear_modulus", "--relaxation", "hochmuth1979"], "name it in --free"),
    (["--data", "mills2005"], 'mills2004 or a file that ends in .csv'),
    (["--data", "/no/such.csv"], "/no/such.csv"),
    (["--data"], "--data: name what was measured: mills2004 or files that end in .csv"),
    (["--data", "--relaxation", "hochmuth1979", "--free", "shear_modulus,membrane_shear_viscosity"],
     "only membrane_shear_viscosity can be fitted"),
    (["--relaxation", "hochmuth"], "hochmuth1979 or a file"),
    (["--contact", "0"], "--contact 0"),
    (["--contact", "nan"], "--contact nan"),
    (["--contact", "0.01"], "--contact 0.01: holds 1 of 66 vertices on a side, 3 at least are needed"),
    (["--contact", "20"], "--contact 20: reaches over the whole cell, 7.82 um wide, and holds 13 of 66 vertices"),
    (["-o", "fitted.json"], "ends in .toml"),
    (["-o", "/no/folder/a.toml"], "there is no folder"),
    (["--plot", "a.jpg"], "ends in .png"),
    (["--material", "nosuch"], "nosuch"),
    (["--level", "99"], "99"),
])
def test_bad_options(arguments, words, capsys):
    code, _, err = run(arguments, capsys)
    assert code == 2 and words in err


@pytest.mark.parametrize("content, words", [
    ("", "an empty file"),
    ("F,D\n1,2\n", "no column force_pN and axial_um and transverse_um"),
    ("force_N,axial_um,transverse_um\n1e-12,8,7\n",
     "no column force_pN; needed are force_pN, axial_um, transverse_um (the unit"),
    ("force_pN,axial_um,transverse_um\n5000,8,7\n", 'line 2: force_pN is "5000"; a number from 0 to 1000'),
    ("force_pN,axial_um,transverse_um\n-5,8,7\n", 'force_pN is "-5"'),
    ("# x\nforce_pN,axial_um,transverse_um\n\n50,8e-6,7\n", 'line 4: axial_um is "8e-6"'),
    ("force_pN,axial_um,transverse_um\n50,nan,7\n", 'axial_um is "nan"'),
    ("force_pN,axial_um,transverse_um\n50,8\n", 'transverse_um is ""'),
    ("force_pN,axial_um,transverse_um\n0,7.8,7.8\n", "no point with a force above 0"),
])
def test_bad_points(content, words, tmp_path, capsys):
    (tmp_path / "a.csv").write_text(content)
    code, _, err = run(["--data", str(tmp_path / "a.csv")], capsys)
    assert code == 2 and words in err


@pytest.mark.parametrize("content, words", [
    ("time,ratio\n0,2\n", "no column time_s and length_over_width"),
    ("time_s,length_over_width\n0,2\n.1,1.5\n.2,1.2\n", "at least 4 points"),
    ("time_s,length_over_width\n0,2\n.1,1.5\n.1,1.2\n.3,1.1\n", "rising times"),
    ("time_s,length_over_width\n0,1.1\n.1,1.5\n.2,1.2\n.3,1.1\n", "the first point must be the most stretched"),
])
def test_bad_recoveries(content, words, tmp_path):
    (tmp_path / "a.csv").write_text(content)
    with pytest.raises(ValueError, match=words):
        fit_data.recovery_time(str(tmp_path / "a.csv"))


@pytest.mark.parametrize("content", [b"\x89PNG\r\n\x1a\n\xff\xfe", b"force_pN,axial_um,transverse_um\n1,2\xe9,3\n",
                                     b"force_pN,axial_um\rtransverse_um\n", b"\0\0\0"])
def test_data_that_are_no_text(content, tmp_path, capsys):
    (tmp_path / "binary.csv").write_bytes(content)
    code, _, err = run(["--data", str(tmp_path / "binary.csv")], capsys)
    assert code == 2 and "binary.csv" in err and len(err.splitlines()) == 1


def test_a_picture_that_cannot_be_drawn_is_told_before_the_work(tmp_path, capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    code, out, err = run(["-o", str(tmp_path / "a.toml"), "--plot", str(tmp_path / "a.png")], capsys)
    assert (code, out) == (2, "") and "matplotlib" in err and "python3-matplotlib" in err
    assert list(tmp_path.iterdir()) == []


def test_the_material_is_written_before_the_picture(truth, tmp_path, capsys, monkeypatch):
    def fails(*arguments):
        raise OSError("disk full")

    monkeypatch.setattr(curve_plot, "plot_stretch", fails)
    data = write_points(tmp_path / "mine.csv", truth)
    code, _, err = run(["--data", data, "-o", str(tmp_path / "a.toml"), "--plot", str(tmp_path / "a.png")], capsys)
    assert code == 2 and "disk full" in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.toml", "mine.csv"]


@pytest.mark.parametrize("verb", ["fit", "relax", "stretch"])
def test_no_mesh_has_a_negative_level(verb, capsys):
    with pytest.raises(SystemExit) as ended:
        program.main([verb, "--level", "-5"])
    assert ended.value.code == 2
    assert "--level: -5: no mesh has a negative level; 2, 3, 4 have 66, 258, 1026 vertices" in capsys.readouterr().err


def test_too_few_points(tmp_path, capsys):
    data = write_points(tmp_path / "a.csv", [(50.0, 11.4, 5.5)])
    code, _, err = run(["--data", data, "--free", "shear_modulus,bending_modulus"], capsys)
    assert code == 2 and "2 numbers measured and 2 parameters free" in err
