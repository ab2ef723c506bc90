# SPDX-License-Identifier: MPL-2.0
import json

import pytest

import npfem
from npfem import __main__ as program
from npfem import recovery


@pytest.fixture(scope="module")
def viscous():
    """The shipped cell with viscosity."""
    with npfem.Material.preset("rbc-viscous") as material:
        yield material


def run(arguments, capsys):
    code = program.main(["relax"] + arguments)
    printed = capsys.readouterr()
    return code, printed.out, printed.err


def test_the_law_gives_its_time_back():
    times = [0.02 * step for step in range(25)]
    ratios = [recovery.law(time, 0.11, 2.0, 1.1) for time in times]
    assert (ratios[0], ratios[-1]) == (pytest.approx(2.0), pytest.approx(1.1, abs=0.02))
    assert recovery.fit(times, ratios, 1.1) == pytest.approx(0.11, rel=1e-4)
    assert recovery.fit([time + 5.0 for time in times], ratios, 1.1) == pytest.approx(0.11, rel=1e-4)
    time, end = recovery.fit_with_end(times, ratios)
    assert (time, end) == (pytest.approx(0.11, rel=1e-3), pytest.approx(1.1, abs=1e-3))


@pytest.mark.parametrize("cell, time_s, end", [(0, 0.110, 1.11), (1, 0.105, 1.225)])
def test_measured_cells(cell, time_s, end):
    # The authors' own fits of cells 1 and 2, with another weight on the first points.
    found = recovery.fit_with_end(*zip(*recovery.HOCHMUTH_1979[cell]))
    assert found == (pytest.approx(time_s, rel=0.03), pytest.approx(end, abs=0.01))


def test_the_stretched_cell_has_the_ratio_asked_for(viscous):
    flat = recovery.stretched(viscous, level=2, ratio=1.7)
    assert len(flat) == 3 * 66
    length, width = (max(flat[axis::3]) - min(flat[axis::3]) for axis in (0, 1))
    assert length / width == pytest.approx(1.7, abs=1e-3)


def test_the_time_of_recovery_is_proportional_to_the_viscosity_over_the_shear_modulus(viscous):
    usual = recovery.fit(*recovery.recover(viscous, level=2, step_ms=20))
    assert 0.09 < usual < 0.16
    with npfem.Material.preset("rbc-viscous") as other:
        # Twice the viscosity, seen at twice the step for twice as long.
        other["membrane_shear_viscosity"] = 2 * viscous["membrane_shear_viscosity"]
        slow = recovery.fit(*recovery.recover(other, level=2, step_ms=40, duration_s=1.2))
        assert slow == pytest.approx(2 * usual, rel=1e-3)
    assert viscous["membrane_density"] == 0.0


@pytest.mark.parametrize("integrator, ratio", [(recovery.BDF2, 4.0), (recovery.EULER, 2.0)])
def test_order_of_the_steps(integrator, ratio, viscous):
    # Halving the step quarters the change of t_c in second order, and halves it in first.
    at = {step: recovery.fit(*recovery.recover(viscous, level=2, step_ms=step, integrator=integrator))
          for step in (20, 10, 5)}
    assert (at[20] - at[10]) / (at[10] - at[5]) == pytest.approx(ratio, rel=0.12)
    if integrator == recovery.BDF2:
        assert at[10] == pytest.approx(at[5], rel=0.01)


def test_table_json_and_picture(tmp_path, capsys):
    result, picture = tmp_path / "out.json", tmp_path / "curve.png"
    code, out, err = run(["--material", "rbc", "--viscosity", "0.5", "--level", "2", "--step", "20",
                          "--json", str(result), "--plot", str(picture)], capsys)
    assert (code, err) == (0, "")
    document = json.loads(result.read_text())
    assert "t_c = %.4f s" % document["time_constant_s"] in out
    assert document["membrane_shear_viscosity_uN_s_per_m"] == pytest.approx(0.5)
    assert document["length_over_width"][0] == pytest.approx(2.0, abs=1e-3)
    assert document["length_over_width"] == sorted(document["length_over_width"], reverse=True)
    assert picture.read_bytes().startswith(b"\x89PNG")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["curve.png", "out.json"]


@pytest.mark.parametrize("arguments, words", [
    (["--material", "rbc"], "no membrane_shear_viscosity: give --viscosity"),
    (["--viscosity", "-1"], "--viscosity -1"),
    (["--viscosity", "nan"], "--viscosity nan"),
    (["--ratio", "1"], "above 1, found 1"),
    (["--ratio", "inf"], "found inf"),
    (["--step", "0"], "found 0 ms"),
    (["--step", "700"], "found 700 ms"),
    (["--duration", "nan"], "nan s"),
    (["--plot", "a.jpg"], "ends in .png"),
    (["--json", "/no/such/folder/a.json"], "there is no folder"),
])
def test_bad_input(arguments, words, capsys):
    extra = [] if "--plot" in arguments else ["--no-plot"]
    code, _, err = run(["--level", "2"] + arguments + extra, capsys)
    assert code == 2 and words in err


def test_a_ratio_out_of_reach_is_told(capsys):
    code, _, err = run(["--level", "2", "--ratio", "9", "--no-plot"], capsys)
    assert code == 1 and ("do not pull the cell to a ratio" in err or "finds no rest" in err)
