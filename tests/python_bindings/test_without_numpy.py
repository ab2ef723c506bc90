# SPDX-License-Identifier: MPL-2.0
"""The package where numpy and matplotlib cannot be imported: a CAD program's Python."""
import json
import os
import subprocess
import sys

BLOCKER = """
import sys
class Blocker:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in ("numpy", "matplotlib", "meshio", "scipy"):
            raise ImportError(name + " is blocked")
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


def test_fit_says_what_it_needs(tmp_path):
    done = run("""
from npfem.__main__ import main
raise SystemExit(main(["fit", "--level", "2"]))
""", tmp_path)
    assert done.returncode == 1 and "numpy" in done.stderr and "Traceback" not in done.stderr


def test_preview_says_what_it_needs(tmp_path):
    done = run("""
from npfem.__main__ import main
raise SystemExit(main(["preview", "."]))
""", tmp_path)
    assert done.returncode == 1
    assert "numpy" in done.stderr
