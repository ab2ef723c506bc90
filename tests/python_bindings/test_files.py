# SPDX-License-Identifier: MPL-2.0
import os

import pytest

from npfem._files import require_writable, write_aside


def test_a_failed_write_leaves_the_old_file_and_no_other(tmp_path):
    path = tmp_path / "result.json"
    path.write_text("old")

    def fail(aside):
        with open(aside, "w") as stream:
            stream.write("half")
        raise RuntimeError("disk full")

    with pytest.raises(RuntimeError):
        write_aside(str(path), fail)
    assert path.read_text() == "old"
    assert [item.name for item in tmp_path.iterdir()] == ["result.json"]


def test_what_cannot_be_written_is_named(tmp_path):
    for path in (tmp_path / "no" / "file.json", tmp_path):
        with pytest.raises(OSError, match=str(path)):
            require_writable(str(path))
    require_writable(str(tmp_path / "file.json"))


def test_the_file_appears_at_once_by_renaming(tmp_path):
    written = []

    def write(aside):
        with open(aside, "w") as stream:
            stream.write("new")
        written.append(os.stat(aside).st_ino)

    path = tmp_path / "result.json"
    write_aside(str(path), write)
    assert (path.read_text(), os.stat(path).st_ino) == ("new", written[0])
    assert [item.name for item in tmp_path.iterdir()] == ["result.json"]
