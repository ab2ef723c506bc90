# SPDX-License-Identifier: MPL-2.0
"""What the tests share. Random tests draw the same examples in every run."""
import os
import sys

import hypothesis
import pytest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PACKAGES = os.path.join(ROOT, "python_bindings")
sys.path.insert(0, PACKAGES)
# For the tests that start another Python.
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [PACKAGES, os.environ.get("PYTHONPATH")]))
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

hypothesis.settings.register_profile("repeatable", derandomize=True, database=None, deadline=None)
hypothesis.settings.load_profile("repeatable")


@pytest.fixture
def sphere():
    """A sphere of 66 vertices, 6 um wide."""
    import npfem

    with npfem.Mesh.generate("sphere", 2, 6.0) as mesh:
        yield mesh


@pytest.fixture
def model():
    """A red cell of 66 vertices."""
    import npfem

    with npfem.Material.preset("rbc") as material, material.mesh(2) as mesh, npfem.Model(mesh, material) as made:
        yield made


@pytest.fixture
def batch(model):
    """Two red cells of 66 vertices."""
    import npfem

    with npfem.Batch(model, cells=2) as made:
        yield made


@pytest.fixture(scope="session")
def tube_run(tmp_path_factory):
    """Output folder of a made-up run in a tube."""
    import synthetic_run

    return synthetic_run.write_run(str(tmp_path_factory.mktemp("tube")), size=(12.0, 12.0, 16.0), counts=(4, 3))
