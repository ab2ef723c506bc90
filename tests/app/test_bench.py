# SPDX-License-Identifier: MPL-2.0
"""npfem bench: what it measures, what it writes, what it refuses."""
import json
import math
import os
import signal
import subprocess
import xml.etree.ElementTree

CELL_FIELDS = {"material", "mesh", "method", "precision", "batch", "lone_cells", "threads", "clock", "time_step_us",
               "tolerance_pN", "us_per_cell_step", "wall_us_per_cell_step", "cell_steps_per_s_per_core", "iterations",
               "evaluations", "residual_pN", "failed_cells", "flops_per_cell_step", "gflops", "peak_gflops",
               "fraction_of_peak", "ratio_to_reference", "error_um", "bytes_per_cell"}


def bench(program, path, suite, *arguments):
    result = program("bench", "--suite", suite, "--quick", "--json", path, *arguments)
    assert result.returncode == 0, result.stderr
    report = json.loads(path.read_text())
    assert set(report) >= {"commit", "version", "compiler", "machine", "suite", "date", "results"}
    assert set(report["machine"]) >= {"cpu", "cores", "instruction_set", "load"}
    assert report["suite"] == suite and report["results"]
    assert all(row.get("failed_cells", 0) == 0 for row in report["results"])
    return report, result


def test_cells(program, tmp_path):
    report, result = bench(program, tmp_path / "cells.json", "cells")
    rows = report["results"]
    assert all(set(row) == CELL_FIELDS for row in rows)
    assert {row["method"] for row in rows} == {"lineage", "default"}
    assert {row["precision"] for row in rows} == {"double", "float"}
    assert {(row["batch"], row["lone_cells"]) for row in rows} == {(1, True), (1, False), (64, False)}
    for row in rows:
        assert row["us_per_cell_step"] > 0 and row["evaluations"] >= 1 and row["bytes_per_cell"] > 66 * 6 * 8
        assert math.isclose(row["gflops"], 1e-3 * row["flops_per_cell_step"] / row["us_per_cell_step"], rel_tol=1e-4)
        assert 0 < row["fraction_of_peak"] < 1.2
    # At equal or better error, as the tolerance is chosen, for every precision.
    errors = {(row["method"], row["precision"], row["batch"], row["lone_cells"]): row["error_um"] for row in rows}
    for precision in ("double", "float"):
        assert errors["default", precision, 64, False] <= errors["lineage", precision, 64, False]
    # More iterations give the lineage's own solution: its iterates are real, not those of another equation.
    assert 0 < errors["lineage", "double", 64, False] < 1e-4
    assert "us/c-step" in result.stdout and "%peak" in result.stdout


def test_cells_takes_a_chosen_few(program, tmp_path):
    report, _ = bench(program, tmp_path / "cells.json", "cells", "--mesh", "258", "--batch", "8", "--precision",
                      "mixed", "--threads", "1")
    rows = {row["method"]: row for row in report["results"] if not row["lone_cells"]}
    assert len(rows) == 2
    for row in rows.values():
        assert (row["mesh"], row["batch"], row["precision"], row["threads"]) == (258, 8, "mixed", 1)
    assert rows["default"]["error_um"] <= rows["lineage"]["error_um"]


def test_convergence(program, tmp_path):
    report, _ = bench(program, tmp_path / "convergence.json", "convergence")
    rows = {(row["time_step_us"], row["matrix"]): row for row in report["results"]}
    assert set(rows) == {(step, matrix) for step in (0.25, 1.0) for matrix in ("scalar", "hessian", "chosen")}
    for row in rows.values():
        assert set(row) >= {"state", "extent_um", "iterations", "evaluations", "us_per_cell_step", "error_um"}
        assert row["error_um"] < 1e-4
    for step in (0.25, 1.0):  # the Hessian of the rest shape is the better guide near rest
        assert 2 * rows[step, "hessian"]["iterations"] < rows[step, "scalar"]["iterations"]


def test_work_precision(program, tmp_path):
    plot = tmp_path / "plot.svg"
    report, result = bench(program, tmp_path / "work.json", "work-precision", "--plot", plot)
    timed = [row for row in report["results"] if row["study"] == "time"]
    assert {row["scenario"] for row in timed} == {"stretch", "shear"}
    assert {row["integrator"] for row in timed} == {"euler", "bdf2"}
    assert [row["mesh"] for row in report["results"] if row["study"] == "mesh"] == [66]

    def error(integrator, step):
        return next(row["relative_error"] for row in timed
                    if (row["scenario"], row["integrator"], row["time_step_us"], row["precision"],
                        row["tolerance_pN"]) == ("shear", integrator, step, "double", 1e-2))

    assert error("bdf2", 5) < error("bdf2", 10) < 1 and error("bdf2", 5) < error("euler", 5)
    assert "recommended" in report
    drawing = xml.etree.ElementTree.parse(plot).getroot()
    dots = [e for e in drawing.iter("{http://www.w3.org/2000/svg}circle") if e.get("fill-opacity")]
    assert len(dots) == len(timed)


def test_fluid(program, tmp_path):
    report, result = bench(program, tmp_path / "fluid.json", "fluid")
    rows = report["results"]
    assert {(row["precision"], row["node_force"]) for row in rows} == {(p, f) for p in ("double", "float")
                                                                       for f in (True, False)}
    for row in rows:
        bytes_per_node = (4 if row["precision"] == "float" else 8) * (38 + 3 * row["node_force"])
        assert math.isclose(row["gb_per_s"], 1e-3 * bytes_per_node * row["mlups"], rel_tol=1e-3)
        assert math.isclose(row["share_of_in_place"], row["gb_per_s"] / row["in_place_gb_per_s"], rel_tol=1e-3)
        assert 0 < row["error"] < (1e-3 if row["precision"] == "double" else 2e-3)
    assert "MLUPS" in result.stdout


def test_ibm(program, tmp_path):
    report, _ = bench(program, tmp_path / "ibm.json", "ibm")
    rows = {(row["points"], row["precision"]): row for row in report["results"]}
    assert set(rows) == {(points, precision) for points in (2, 3, 4) for precision in ("double", "float")}
    for (_, precision), row in rows.items():
        both = row["interpolate_ns_per_vertex"] + row["spread_ns_per_vertex"]
        assert math.isclose(row["us_per_vertex"], 1e-3 * both, rel_tol=1e-3)
        assert row["error"] < (1e-14 if precision == "double" else 1e-6)


def test_coupled(program, tmp_path):
    report, _ = bench(program, tmp_path / "coupled.json", "coupled")
    assert {row["precision"] for row in report["results"]} == {"double", "float"}
    for row in report["results"]:
        assert (row["scene"], row["threads"], row["ranks"]) == ("shear20_ht20", 1, 1)
        assert set(row["phases_ms"]) == {"exchange", "velocity", "interpolation", "contacts", "cells", "spreading",
                                         "fluid"}
        assert 0 < sum(row["phases_ms"].values()) < 3 * row["ms_per_step"]
        assert math.isclose(row["seconds_per_simulated_ms"], row["ms_per_step"] / 0.125, rel_tol=1e-3)
        # Of the way cells go by themselves, against a step four times finer: 0.076 measured, half of it in the contacts
        # of cells that start nearer to each other than contacts reach.
        assert 0 < row["error"] < 0.09


def test_bad_options_say_what_is_allowed(program, tmp_path):
    def refused(message, *arguments):
        result = program("bench", *arguments)
        assert result.returncode == 2 and result.stdout == ""
        assert message in result.stderr, result.stderr

    refused("--suite is required", "--quick")
    refused('--suite "cell" does not exist; did you mean "cells"?', "--suite", "cell")
    refused('--precision "doubel" does not exist; did you mean "double"?', "--suite", "cells", "--precision", "doubel")
    refused("--mesh 100: allowed are 66, 258, 1026, 4098", "--suite", "cells", "--mesh", "100")
    refused("--batch 0: allowed are whole numbers from 1 to 1000000", "--suite", "cells", "--batch", "8,0")
    refused("--threads -1: allowed", "--suite", "cells", "--threads=-1")
    refused("--plot is for --suite work-precision", "--suite", "cells", "--plot", tmp_path / "a.svg")
    refused("--mesh and --batch are for --suite cells", "--suite", "convergence", "--batch", "8")


def test_a_file_that_cannot_be_written_is_found_first(program, tmp_path):
    missing = program("bench", "--suite", "cells", "--json", tmp_path / "no" / "such.json")
    assert missing.returncode == 2 and "there is no folder" in missing.stderr
    folder = program("bench", "--suite", "cells", "--json", tmp_path)
    assert folder.returncode == 2 and "it is a folder" in folder.stderr
    assert all(len(run.stderr.splitlines()) == 1 and not run.stdout for run in (missing, folder)), "nothing is measured"


def test_an_interrupt_leaves_the_old_file(tmp_path):
    path = tmp_path / "cells.json"
    path.write_text("old")
    process = subprocess.Popen([os.environ["NPFEM_PROGRAM"], "bench", "--suite", "cells", "--json", str(path)],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    process.stderr.readline()  # it measures
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 1 and "interrupted; nothing was written" in errors
    assert path.read_text() == "old" and sorted(os.listdir(tmp_path)) == ["cells.json"]
