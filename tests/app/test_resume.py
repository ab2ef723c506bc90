# SPDX-License-Identifier: MPL-2.0
"""npfem resume: a run that was stopped, in whatever way, goes on as if it had never stopped."""
import csv
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import time

import pytest

PIECES = ["--set", "output.checkpoint_every=10", "--set", "output.table_every=0.5 us", "--quiet"]


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def checkpoints_in(folder):
    return sorted(path.name for path in (folder / "checkpoints").iterdir())


def contents_of(folder):
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def steps_in_table(folder):
    return sorted({int(row["step"]) for row in csv.DictReader((folder / "cells.csv").open())})


@pytest.fixture
def straight(program, scene, tmp_path):
    """The hash after `steps` steps without a stop."""

    def run(steps, *settings):
        folder = tmp_path / ("straight%d" % steps)
        result = program("run", scene, "-o", folder, "--quiet", "--set", "run.steps=%d" % steps, *settings)
        assert result.returncode == 0, result.stderr
        return summary_of(folder)["state_hash"]

    return run


@pytest.fixture
def stopped(program, scene, tmp_path):
    """A run of 30 steps with a checkpoint every 10, of which the newest two are kept."""
    folder = tmp_path / "run"
    result = program("run", scene, "-o", folder, "--set", "run.steps=30", *PIECES)
    assert result.returncode == 0, result.stderr
    assert checkpoints_in(folder) == ["checkpoint_000000000020.npfem", "checkpoint_000000000030.npfem"]
    return folder


@pytest.mark.parametrize("every", [1, 2])
def test_200_steps_are_100_and_100_on_any_ranks(program, scene, tmp_path, straight, every):
    settings = ["--set", "coupling.cell_every=%d" % every]
    folder = tmp_path / "run"
    first = program("run", scene, "-o", folder, *PIECES, *settings, "--set", "run.steps=67")
    assert first.returncode == 0, first.stderr
    for steps, ranks in ((133, 2), (200, 4)):
        result = program("resume", folder, "--quiet", "--set", "run.steps=%d" % steps, ranks=ranks)
        assert result.returncode == 0, result.stderr
        assert summary_of(folder)["steps"] == steps and summary_of(folder)["ranks"] == ranks
    summary = summary_of(folder)
    assert summary["resumed_from"] == 133
    assert summary["state_hash"] == straight(200, *settings)
    assert summary["momentum_error"] < 1e-10
    assert 'steps = 200' in (folder / "scene.toml").read_text()


def test_output_goes_on_where_it_was(program, scene, tmp_path, stopped):
    whole = tmp_path / "whole"
    assert program("run", scene, "-o", whole, "--set", "run.steps=40", *PIECES).returncode == 0
    # what a run that died later has left: lines and files beyond the checkpoint, the last line cut short
    with (stopped / "cells.csv").open("a") as table:
        table.write("35,3.5,0,rbc,1,2,3\n35,3.5,1,rb")
    pvd = (stopped / "cells.pvd").read_text()
    (stopped / "cells_000000035.vtu").write_text("half a file")
    (stopped / "cells.pvd").write_text(pvd.replace(
        "</Collection>", '<DataSet timestep="3.5" part="0" file="cells_000000035.vtu"/>\n</Collection>'))
    result = program("resume", stopped, "--quiet", "--set", "run.steps=40")
    assert result.returncode == 0, result.stderr
    for name in ("cells.csv", "cells.pvd", "cells_000000035.vtu", "cells_000000040.vtu", "fluid_000000040.vti"):
        assert (stopped / name).read_bytes() == (whole / name).read_bytes(), name
    assert (stopped / "fluid.pvd").read_bytes() == (whole / "fluid.pvd").read_bytes()


def test_a_stop_between_outputs_leaves_no_trace(program, scene, tmp_path):
    settings = [*PIECES, "--set", "output.fluid_every=0.7 us", "--set", "output.format=both"]
    whole, folder = tmp_path / "whole", tmp_path / "run"
    assert program("run", scene, "-o", whole, "--set", "run.steps=40", *settings).returncode == 0
    assert program("run", scene, "-o", folder, "--set", "run.steps=13", *settings).returncode == 0
    assert steps_in_table(folder)[-1] == 13 and (folder / "cells_000000013.vtu").exists()
    for steps in (24, 40):
        result = program("resume", folder, "--quiet", "--set", "run.steps=%d" % steps)
        assert result.returncode == 0, result.stderr
    assert summary_of(folder)["rheology"] == summary_of(whole)["rheology"]

    def files_of(run):
        return {path.name: path.read_bytes() for path in run.iterdir()
                if path.is_file() and path.suffix in (".csv", ".pvd", ".vtu", ".vti")}

    assert sorted(files_of(folder)) == sorted(files_of(whole))
    assert files_of(folder) == files_of(whole)
    if shutil.which("h5dump"):
        for name in ("cells.vtkhdf", "fluid.vtkhdf"):
            times = [subprocess.run(["h5dump", "-d", "/VTKHDF/Steps/Values", run / name], stdout=subprocess.PIPE,
                                    check=True, text=True).stdout.splitlines()[1:] for run in (folder, whole)]
            assert times[0] == times[1]


def test_a_run_that_is_complete_stays_so(program, stopped):
    before = contents_of(stopped)
    result = program("resume", stopped, "--quiet")
    assert result.returncode == 0, result.stderr
    after = contents_of(stopped)
    changed = {path.name for path in after if after[path] != before.get(path)}
    assert changed <= {"summary.json"} and len(after) == len(before)
    beyond = program("resume", stopped, "--set", "run.steps=25")
    assert beyond.returncode == 2 and "beyond the 25 that are asked for" in beyond.stderr


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty"])
def test_a_damaged_checkpoint_is_refused_and_the_one_before_taken(program, stopped, straight, damage):
    newest = stopped / "checkpoints" / "checkpoint_000000000030.npfem"
    content = bytearray(newest.read_bytes())
    content[len(content) // 3] ^= 16
    newest.write_bytes({"cut": content[:len(content) // 2], "flipped": content, "empty": b""}[damage])
    result = program("resume", stopped, "--quiet", "--set", "run.steps=40")
    assert result.returncode == 0, result.stderr
    assert "refused: " + str(newest) in result.stderr
    assert "resumes after step 20 from" in result.stderr
    assert summary_of(stopped)["resumed_from"] == 20
    assert summary_of(stopped)["state_hash"] == straight(40)


def test_without_a_whole_checkpoint_there_is_nothing_to_resume(program, stopped, tmp_path):
    for path in (stopped / "checkpoints").iterdir():
        path.write_bytes(path.read_bytes()[:-1])
    before = contents_of(stopped)
    result = program("resume", stopped, ranks=2)
    assert result.returncode == 2
    assert "no checkpoint to go on from" in result.stderr and "checkpoint_000000000020.npfem: damaged" in result.stderr
    assert contents_of(stopped) == before
    missing = program("resume", tmp_path / "nowhere")
    assert missing.returncode == 2 and "nowhere/scene.toml" in missing.stderr


@pytest.mark.parametrize("old, new, table, ranks", [('"1.2 mPa s"', '"1.3 mPa s"', "[fluid]", 2),
                                                    ("count = 2", "count = 1", "[cells]", None),
                                                    ('"developed"', '"rest"', "[flow]", None)])
def test_a_checkpoint_of_another_scene_is_refused(program, stopped, old, new, table, ranks):
    scene_file = stopped / "scene.toml"
    text = scene_file.read_text()
    assert old in text
    scene_file.write_text(text.replace(old, new, 1))
    before = contents_of(stopped)
    result = program("resume", stopped, "--set", "run.steps=40", ranks=ranks)
    assert result.returncode == 2
    assert result.stderr.count("is of another scene") == 1 and "not the same in " + table in result.stderr
    assert contents_of(stopped) == before


def test_a_changed_material_is_refused(program, scene, tmp_path):
    material = tmp_path / "soft.toml"
    source = os.path.join(os.path.dirname(__file__), "..", "..", "materials", "rbc.toml")
    material.write_text(open(source).read())
    scene.write_text(scene.read_text().replace('material = "rbc"', 'material = "soft.toml"'))
    folder = tmp_path / "run"
    assert program("run", scene, "-o", folder, *PIECES).returncode == 0
    changed, count = re.subn('"3.25 uN/m"', '"3.5 uN/m"', material.read_text())
    assert count == 1
    material.write_text(changed)
    result = program("resume", folder, "--set", "run.steps=20")
    assert result.returncode == 2 and "the material, mesh or body of the cells [rbc] is not what it was" in result.stderr


def test_a_changed_body_is_refused(program, tmp_path):
    """Of Palabos-npFEM: only its constraints.csv knows how stiff it is."""
    shared = pathlib.Path(os.environ.get("NPFEM_SHARED", "/nowhere")) / "data" / "palabos-npfem"
    if not shared.exists():
        pytest.skip("no files of the lineage in %s" % shared)
    lineage, folder = tmp_path / "lineage", tmp_path / "run"
    shutil.copytree(shared, lineage, ignore=shutil.ignore_patterns("*.tar.gz", "reference_runs"))
    assert program("import", lineage / "obstacle_params.xml", "-o", lineage / "obstacle.toml").returncode == 0
    run = program("run", lineage / "obstacle.toml", "-o", folder, "--quiet", "--set", "run.steps=2", "--set",
                  "output.checkpoint_every=2", "--set", "output.fluid=false")
    assert run.returncode == 0, run.stderr
    body = pathlib.Path(re.search(r'body_folder = "(.*)"', (folder / "scene.toml").read_text()).group(1))
    rows = (body / "constraints.csv").read_text().splitlines(keepends=True)
    stiffer = [re.sub(r"^(Bending,[^,]*,)[^,]*", r"\g<1>50", row) for row in rows]
    assert stiffer != rows
    (body / "constraints.csv").write_text("".join(stiffer))
    result = program("resume", folder, "--set", "run.steps=4")
    assert result.returncode == 2 and "material, mesh or body of the cells [" in result.stderr, result.stderr
    (body / "constraints.csv").write_text("".join(rows))
    assert program("resume", folder, "--set", "run.steps=4", "--quiet").returncode == 0


def test_a_changed_wall_is_refused(program, scene, tmp_path):
    def ball(size):
        assert program("mesh", "sphere", "--level", "2", "--size", size, "-o", tmp_path / "ball.stl").returncode == 0

    ball("2 um")
    wall = '[[domain.solids]]\nshape = "surface"\nsurface = "ball.stl"\nsurface_shift = ["6 um", "5 um", "5 um"]\n'
    scene.write_text(scene.read_text().replace("[fluid]", wall + "\n[fluid]").replace('start = "developed"\n', ""))
    folder = tmp_path / "run"
    run = program("run", scene, "-o", folder, *PIECES)
    assert run.returncode == 0, run.stderr
    ball("2.2 um")
    before = contents_of(folder)
    result = program("resume", folder, "--set", "run.steps=20")
    assert result.returncode == 2 and "not the same in [domain.solids[0].surface]" in result.stderr, result.stderr
    assert contents_of(folder) == before
    ball("2 um")
    assert program("resume", folder, "--set", "run.steps=20", "--quiet").returncode == 0


def test_only_run_and_output_can_be_set(program, stopped):
    before = contents_of(stopped)
    result = program("resume", stopped, "--set", "flow.shear_rate=1 1/s")
    assert result.returncode == 2
    assert "only [run] and [output] of a run can be changed when it goes on" in result.stderr
    assert contents_of(stopped) == before


def start(scene, folder, *arguments, ranks=None):
    command = [os.environ["NPFEM_PROGRAM"], "run", str(scene), "-o", str(folder), "--quiet", *arguments]
    if ranks:
        command = [os.environ["NPFEM_MPIEXEC"], "-n", str(ranks), "--oversubscribe", "--bind-to", "none"] + command
    return subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)


def wait_for(path):
    deadline = time.monotonic() + 60
    while not path.exists() and time.monotonic() < deadline:
        time.sleep(0.02)


@pytest.mark.parametrize("ranks", [None, 2])
def test_a_folder_belongs_to_one_job_at_a_time(program, scene, tmp_path, straight, ranks):
    folder = tmp_path / "run"
    job = start(scene, folder, "--set", "run.steps=1000000", *PIECES[:2])
    try:
        wait_for(folder / "checkpoints" / "checkpoint_000000000010.npfem")
        for verb in (["resume", folder], ["run", scene, "-o", folder, "--overwrite"], ["run", scene, "-o", folder]):
            second = program(*verb, "--quiet", ranks=ranks)
            assert second.returncode == 2 and second.stderr.count("another npfem is at work in the folder") == 1
            assert str(folder) in second.stderr
    finally:
        job.terminate()
        _, errors = job.communicate(timeout=60)
    assert job.returncode == 75, errors
    steps = summary_of(folder)["steps"]
    assert not (folder / "run.lock").exists()
    (folder / "run.lock").write_text("")  # of a job that was killed: it locks nobody out
    result = program("resume", folder, "--quiet", "--set", "run.steps=%d" % (steps + 5), ranks=ranks)
    assert result.returncode == 0, result.stderr
    assert summary_of(folder)["state_hash"] == straight(steps + 5)


@pytest.mark.parametrize("which, ranks, code", [(signal.SIGTERM, None, 75),
                                                (signal.SIGINT, None, 1), (signal.SIGUSR1, 2, 75)])
def test_a_signal_saves_the_state(program, scene, tmp_path, straight, which, ranks, code):
    if ranks and "NPFEM_MPIEXEC" not in os.environ:
        pytest.skip("this build has no MPI")
    folder = tmp_path / "run"
    run = start(scene, folder, "--set", "run.steps=1000000", ranks=ranks)
    wait_for(folder / "cells_000000005.vtu")
    run.send_signal(which)
    _, errors = run.communicate(timeout=60)
    assert run.returncode == code, errors
    assert "to go on: npfem resume " + str(folder) in errors
    steps = summary_of(folder)["steps"]
    assert checkpoints_in(folder) == ["checkpoint_%012d.npfem" % steps]
    result = program("resume", folder, "--quiet", "--set", "run.steps=%d" % (steps + 10))
    assert result.returncode == 0, result.stderr
    assert summary_of(folder)["state_hash"] == straight(steps + 10)


def test_the_wall_time_is_kept(program, scene, tmp_path):
    folder = tmp_path / "run"
    result = program("run", scene, "-o", folder, "--quiet", "--walltime", "3s", "--set", "run.steps=1000000")
    assert result.returncode == 75 and "stopped after step" in result.stderr
    first = summary_of(folder)
    assert first["steps"] > 10 and first["interrupted"] is True
    assert 1 < first["wall_s"] < 3, "of the time loop with the last output and the checkpoint"
    again = program("resume", folder, "--quiet", "--walltime", "0:02")
    assert again.returncode == 75
    second = summary_of(folder)
    assert second["resumed_from"] == first["steps"] < second["steps"]
    assert second["wall_s"] > first["wall_s"]


@pytest.mark.parametrize("time_text", ["3", "3h30", "1:2:3:4", "-3h", "0s", "3 weeks"])
def test_a_wall_time_that_is_none(program, scene, tmp_path, time_text):
    result = program("run", scene, "-o", tmp_path / "run", "--walltime=" + time_text)
    assert result.returncode == 2 and "--walltime" in result.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("time_text", ["1.5 h", "2d 4h 3min 2s", "90min", "1-00:00:00"])
def test_wall_times(program, scene, tmp_path, time_text):
    result = program("run", scene, "-o", tmp_path / "run", "--walltime=" + time_text, "--set", "run.steps=1", "--quiet")
    assert result.returncode == 0, result.stderr


def test_a_checkpoint_that_finds_no_room(program, scene, tmp_path):
    """The run goes on, the checkpoint before is kept, and the exit code tells."""
    folder = tmp_path / "run"
    assert program("run", scene, "-o", folder, *PIECES, "--set", "run.steps=20").returncode == 0
    before = contents_of(folder / "checkpoints")

    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (1000000, 1000000))

    result = program("resume", folder, "--set", "run.steps=40", "--quiet", preexec_fn=limit)
    assert result.returncode == 1
    assert "no checkpoint after step 30: cannot write" in result.stderr and "step 40" in result.stderr
    assert contents_of(folder / "checkpoints") == before
    assert summary_of(folder)["steps"] == 40 and (folder / "cells_000000040.vtu").exists()


def test_an_unstable_state_is_kept_apart(program, scene, tmp_path):
    folder = tmp_path / "run"
    result = program("run", scene, "-o", folder, *PIECES, "--set", "solver.max_iterations=1", "--set",
                     "solver.tolerance=1e-9 pN", "--set", "solver.residual_bound=1e-9 pN", "--set",
                     "solver.newton_iterations=0")
    assert result.returncode == 3
    assert checkpoints_in(folder) == ["failed_%012d.npfem" % summary_of(folder)["steps"]]
    assert program("resume", folder).returncode == 2


def rewrite_header(path, old, new):
    """Replaces a word in the text of a checkpoint and puts its checksum right."""
    mask = (1 << 64) - 1

    def mix(x):
        x = ((x ^ (x >> 30)) * 0xbf58476d1ce4e5b9) & mask
        x = ((x ^ (x >> 27)) * 0x94d049bb133111eb) & mask
        return x ^ (x >> 31)

    content = path.read_bytes()
    offset, length, _ = struct.unpack("<3Q", content[-32:-8])
    text = content[offset:offset + length]
    assert text.count(old) >= 1
    text = text.replace(old, new, 1)
    checksum = sum(mix((byte + mix(place + 1)) & mask) for place, byte in enumerate(text)) & mask
    path.write_bytes(content[:offset] + text + struct.pack("<3Q", offset, len(text), checksum) + content[-8:])


def test_another_instruction_set_must_be_asked_for(program, stopped):
    newest = stopped / "checkpoints" / "checkpoint_000000000030.npfem"
    rewrite_header(newest, b'"backend": "cpu-', b'"backend": "cpu-new-')
    before = contents_of(stopped)
    result = program("resume", stopped, "--set", "run.steps=35", ranks=2)
    assert result.returncode == 2
    assert "an instruction set that is not here" in result.stderr and "cpu-baseline" in result.stderr
    assert contents_of(stopped) == before
    result = program("resume", stopped, "--set", "run.steps=35", "--quiet", "--allow-other-instruction-set")
    assert result.returncode == 0 and "the last bits may differ" in result.stderr
    assert summary_of(stopped)["steps"] == 35


def test_the_instruction_set_of_the_checkpoint_is_used(program, stopped):
    newest = stopped / "checkpoints" / "checkpoint_000000000030.npfem"
    text = newest.read_bytes()
    own = text[text.rindex(b'"backend": "') + 12:]
    rewrite_header(newest, b'"backend": "' + own[:own.index(b'"')], b'"backend": "cpu-baseline')
    result = program("resume", stopped, "--set", "run.steps=35", "--quiet")
    assert result.returncode == 0, result.stderr
    saved = (stopped / "checkpoints" / "checkpoint_000000000035.npfem").read_bytes()
    assert b'"backend": "cpu-baseline"' in saved


def newest_checkpoint(folder):
    """Its step; 0 where none was written yet."""
    if not (folder / "checkpoints").exists():
        return 0
    return max((int(name[11:23]) for name in checkpoints_in(folder) if name.endswith(".npfem")), default=0)


def test_kill_at_random_moments(program, scene, tmp_path):
    """No more is lost than the steps since the last checkpoint, and what goes on is right."""
    kills = int(os.environ.get("NPFEM_KILLS", "3"))
    steps, every = 100 * kills, 15
    settings = ["--set", "run.steps=%d" % steps, "--set", "output.checkpoint_every=%d" % every, "--set",
                "output.table_every=1 us"]

    def seconds_of(name, *more):
        begin = time.monotonic()
        result = program("run", scene, "-o", tmp_path / name, "--quiet", *settings, *more)
        assert result.returncode == 0, result.stderr
        return time.monotonic() - begin

    whole = tmp_path / "whole"
    start_up = seconds_of("short", "--set", "run.steps=1")
    between_checkpoints = max(0.001, seconds_of("whole") - start_up) * every / steps
    folder = tmp_path / "run"
    choose = random.Random(4)
    done = 0
    # The first kill may come while the run starts, each later one once the run has gone on to a step chosen by chance:
    # how fast the machine is at the moment decides nothing.
    for goal in [0] + sorted(choose.randrange(every, steps - 2 * every) for _ in range(kills - 1)):
        if newest_checkpoint(folder):
            command = ["resume", str(folder), "--quiet"]
        else:
            command = ["run", str(scene), "-o", str(folder), "--quiet", "--overwrite", *settings]
        run = subprocess.Popen([os.environ["NPFEM_PROGRAM"], *command], stderr=subprocess.PIPE, text=True)
        while newest_checkpoint(folder) < goal and run.poll() is None:
            time.sleep(0.001)
        time.sleep(choose.uniform(0, 1.5) * (between_checkpoints if goal else start_up))
        run.kill()
        _, errors = run.communicate()
        assert "refused" not in errors, "a kill never leaves a checkpoint that is damaged"
        written = newest_checkpoint(folder)
        seen = steps_in_table(folder) if (folder / "cells.csv").exists() else []
        assert not seen or seen[-1] - written <= every
        assert written >= max(done, goal), errors
        done = written
    result = program("resume", folder, "--quiet")
    assert result.returncode == 0, result.stderr
    assert summary_of(folder)["state_hash"] == summary_of(whole)["state_hash"]
    assert steps_in_table(folder) == steps_in_table(whole)
    assert (folder / "cells.csv").read_bytes() == (whole / "cells.csv").read_bytes()
    assert (folder / "cells.pvd").read_bytes() == (whole / "cells.pvd").read_bytes()
