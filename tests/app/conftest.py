# SPDX-License-Identifier: MPL-2.0
import os
import subprocess

import pytest

SCENE = """schema_version = 1
title = "test of the program"

[domain]
kind = "shear_box"
size = ["12 um", "10 um", "10 um"]
dx = "0.5 um"

[fluid]
dynamic_viscosity = "1.2 mPa s"
time_step = "0.1 us"

[flow]
shear_rate = "5000 1/s"
start = "developed"

[[cells]]
name = "rbc"
material = "rbc"
level = 2
count = 2

[[cells]]
name = "platelet"
material = "platelet"
level = 2
count = 1

[run]
steps = 12

[output]
cells_every = "0.5 us"
"""


@pytest.fixture
def program():
    """Runs npfem with these arguments; returns the finished process."""
    path = os.environ["NPFEM_PROGRAM"]

    def run(*arguments, ranks=None, **options):
        command = [path] + [str(a) for a in arguments]
        if ranks is not None:
            if "NPFEM_MPIEXEC" not in os.environ:
                pytest.skip("this build has no MPI")
            command = [os.environ["NPFEM_MPIEXEC"], "-n", str(ranks), "--oversubscribe", "--bind-to", "none"] + command
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=300,
                              **options)

    return run


@pytest.fixture
def scene(tmp_path):
    """A small scene of three cells in shear."""
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    return path
