# SPDX-License-Identifier: MPL-2.0
"""Finding and checking the shared library."""
import ctypes.util
import json
import os
import subprocess
import sys

import pytest

import npfem
from npfem import _library


class FakeFunction:
    def __init__(self, answer):
        self.answer = answer

    def __call__(self):
        return self.answer


class FakeLibrary:
    """Every function of the table but those left out; of version `version`."""

    def __init__(self, version, left_out=()):
        for name in _library.SIGNATURES:
            if name not in left_out:
                setattr(self, name, FakeFunction(version))


def import_error(**environment):
    """What `npfem.version()` prints in a new process."""
    done = subprocess.run([sys.executable, "-c", "import npfem; npfem.version()"], capture_output=True, text=True,
                          env={**os.environ, **environment})
    assert done.returncode == 1
    return done.stderr.splitlines()[-1]


def test_version_and_build_info():
    assert npfem.version().count(".") == 2
    assert json.loads(npfem.build_info())["version"] == npfem.version()


def test_a_named_library_that_is_missing_is_an_error_and_nothing_else_is_tried():
    message = import_error(NPFEM_LIBRARY="/nowhere/libnpfem.so")
    assert "looked at: /nowhere/libnpfem.so." in message
    assert "NPFEM_LIBRARY" in message


def test_another_library_is_refused():
    message = import_error(NPFEM_LIBRARY=ctypes.util.find_library("m"))
    assert "is not the npfem library" in message


def test_a_file_that_is_no_library_is_refused(tmp_path):
    path = tmp_path / "libnpfem.so"
    path.write_text("no library")
    assert str(path) in import_error(NPFEM_LIBRARY=str(path))
    assert "cannot be loaded" in import_error(NPFEM_LIBRARY=str(path))


def test_another_version_of_the_interface_is_refused():
    with pytest.raises(ImportError, match="has version 7 of the interface, this package needs version 1"):
        _library._declare(FakeLibrary(7), "/lib/libnpfem.so")


def test_an_older_library_is_refused_by_what_it_lacks():
    with pytest.raises(ImportError, match="lacks npfem_batch_relax"):
        _library._declare(FakeLibrary(_library.ABI_VERSION, {"npfem_batch_relax"}), "/lib/libnpfem.so")


def test_the_build_tree_beside_the_source_is_looked_at(monkeypatch):
    monkeypatch.delenv("NPFEM_LIBRARY")
    assert any(path.endswith(os.path.join("build", "release", "lib", "libnpfem.so")) for path in _library.candidates())


def test_text_longer_than_the_first_buffer_is_whole():
    with npfem.Material.preset("rbc") as material:
        assert len(material.to_text()) > 256
