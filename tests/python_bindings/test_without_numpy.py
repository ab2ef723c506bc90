# SPDX-License-Identifier: MPL-2.0
"""The package where numpy and matplotlib cannot be imported: a CAD program's Python."""
import json
import os
import subprocess
import sys

import pytest

BLOCKER = """
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("numpy", "matplotlib", "meshio", "scipy"):
            raise ModuleNotFoundError("No module named %r" % name, name=name)
sys.meta_path.insert(0, Blocker())
"""


def run(script, cwd):
    return subprocess.run([sys.executable, "-c", BLOCKER + script], capture_output=True, text=True, cwd=cwd,
                          env=dict(os.environ))


def test_objects(tmp_path):
    done = run("""
import array, npfem
tetrahedron = npfem.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
assert list(tetrahedron.triangles) == [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
with npfem.Material.preset("rbc") as material, material.mesh(2) as mesh, npfem.Model(mesh, material) as model:
    with npfem.Batch(model, cells=2) as batch:
        positions = batch.position
        assert type(positions) is array.array and len(positions) == 2 * 66 * 3
        positions[0] += 1.0
        batch.position = positions
        assert batch.get("position", 0, 1)[0] == positions[0]
        batch.set("position", [[[1.5] * 3] * 66], 1, 1)
        assert list(batch.get("position", 1, 1)) == [1.5] * 198
        batch.position = list(mesh.positions) * 2
        assert batch.relax() == 0 and list(batch.status) == [0, 0]
        assert batch.measure("volume")[0] > 50
        batch.unpack(0, batch.pack(1))
        assert batch.state_hash[0] == batch.state_hash[1]
try:
    npfem.Mesh(["a"], [0])
except TypeError:
    print("done")
""", tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (0, "done\n", "")


def test_stretch_verb_writes_table_and_json_and_says_why_there_is_no_picture(tmp_path):
    done = run("""
from npfem.__main__ import main
raise SystemExit(main(["stretch", "--level", "2", "--force", "0,20", "--json", "out.json"]))
""", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "no picture: matplotlib is not installed" in done.stdout
    assert "transverse" in done.stdout
    assert os.listdir(tmp_path) == ["out.json"]
    assert len(json.loads((tmp_path / "out.json").read_text())["results"]) == 2


def test_relax_verb_and_the_contacts(tmp_path):
    done = run("""
from npfem import Mesh, recovery, tweezers
from npfem.__main__ import main
with Mesh.generate("rbc", 3) as mesh:
    held = tweezers.contact_vertices(mesh.positions)[0]
    assert abs(tweezers.held_area(mesh.positions, mesh.triangles, held) - 2.05) < 0.01
from npfem import Material
with Material.preset("rbc-viscous") as material:
    assert len(recovery.stretched(material, 2)) == 66 * 3
raise SystemExit(main(["relax", "--level", "2", "--step", "20", "--duration", "0.1"]))
""", tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert "t_c = " in done.stdout and "no picture: matplotlib is not installed" in done.stdout


@pytest.mark.parametrize("arguments", [["fit", "--level", "2"], ["preview", "."], ["report", "--list"]])
def test_what_is_needed_is_said(tmp_path, arguments):
    done = run("from npfem.__main__ import main\nraise SystemExit(main(%r))" % arguments, tmp_path)
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert "No module named 'numpy'" in done.stderr and "python3-numpy" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_page_of_kept_records_needs_nothing(tmp_path):
    (tmp_path / "kept").mkdir()
    (tmp_path / "kept" / "T1.json").write_text(json.dumps({
        "case": {"id": "T1", "title": "A title", "tier": "ci", "source": "nobody", "cost_s": 1},
        "about": "", "plots": [], "file": "t.py", "seconds": 1.0, "date": "2026-01-01", "failure": "", "missing": "",
        "results": [{"quantity": "q", "ours": 1.0}]}))
    done = run("""
from npfem.__main__ import main
raise SystemExit(main(["report", "--no-run", "--results", "kept", "-o", "page.html"]))
""", tmp_path)
    assert (done.returncode, done.stderr) == (0, "wrote page.html\n")
