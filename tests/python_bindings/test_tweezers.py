# SPDX-License-Identifier: MPL-2.0
import math

import pytest

import npfem
from npfem import tweezers
from npfem.tweezers_data import MILLS_2004, loaded_forces, rms_errors


def test_contact_of_the_258_vertex_red_cell():
    # rbc_material.md: a disc 2 um wide holds 11 vertices on each side, 1.5 um 3, 2.5 um 19.
    with npfem.Mesh.generate("rbc", 3) as mesh:
        for diameter, count in ((1.5, 3), (2.0, 11), (2.5, 19)):
            left, right = tweezers.contact_vertices(mesh.positions, diameter)
            assert (len(left), len(right)) == (count, count)
            assert not set(left) & set(right)


def test_contacts_that_hold_the_same_membrane():
    # A unit square of two triangles, and the membrane within the contacts of docs/materials.md.
    square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert tweezers.held_area(square, [[0, 1, 2], [0, 2, 3]], [0, 1, 2]) == pytest.approx(0.5)
    assert tweezers.held_area(square, [[0, 1, 2], [0, 2, 3]], range(4)) == pytest.approx(1.0)
    for level, diameter, area in ((3, 2.0, 2.05), (4, 1.8, 2.06), (5, 1.7, 2.03)):
        with npfem.Mesh.generate("rbc", level) as mesh:
            for side in tweezers.contact_vertices(mesh.positions, diameter):
                assert tweezers.held_area(mesh.positions, mesh.triangles, side) == pytest.approx(area, abs=0.01)


def test_contact_ignores_where_the_cell_is_and_takes_flat_arrays():
    with npfem.Mesh.generate("rbc", 2) as mesh:
        here = tweezers.contact_vertices(mesh.positions)
        assert tweezers.contact_vertices(mesh.positions + [5.0, -3.0, 2.0]) == here
        assert tweezers.contact_vertices(mesh.positions.ravel().tolist()) == here


def test_a_contact_without_a_vertex_is_refused():
    cube = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    with pytest.raises(ValueError, match="no vertex lies under a contact 2 um wide"):
        tweezers.contact_vertices(cube)


def test_a_contact_of_one_vertex_needs_no_tie():
    rigid, shared = (npfem.stretch(level=2, forces_pN=[5], load=load, contact_diameter_um=0.1)[0]["axial_um"]
                     for load in tweezers.LOADS)
    assert rigid == shared


def test_force_path_rises_in_steps_of_at_most_25():
    path = tweezers.force_path([100.0, 10.0])
    assert path[:2] == [0.0, 10.0] and path[-1] == 100.0
    assert all(0 < after - before <= 25.0 for before, after in zip(path, path[1:]))
    assert tweezers.force_path([0.0]) == [0.0]
    assert tweezers.force_path([25.0, 50.0]) == [0.0, 25.0, 50.0]


@pytest.mark.parametrize("changes", [{"load": "glued"}, {"contact_diameter_um": 0.0}, {"contact_diameter_um": math.nan},
                                     {"forces_pN": []}, {"forces_pN": [-1.0]}, {"forces_pN": [math.inf]}])
def test_bad_input(changes):
    with pytest.raises(ValueError):
        npfem.stretch(**{"level": 2, "forces_pN": [0.0], **changes})


def test_rms_errors_of_known_departures():
    rows = [{"force_pN": force, "axial_um": 1.02 * axial, "transverse_um": 0.9 * transverse}
            for force, axial, transverse in MILLS_2004]
    axial, transverse, points = rms_errors(rows)
    assert (axial, transverse, points) == (pytest.approx(0.02), pytest.approx(0.1), 12)
    assert rms_errors([{"force_pN": 1.0, "axial_um": 1.0, "transverse_um": 1.0}]) is None


def test_measured_forces():
    assert loaded_forces(40.0) == [16.0, 20.0, 31.0, 38.5]


@pytest.mark.parametrize("load", tweezers.LOADS)
def test_a_coarse_cell_lengthens_and_narrows(load):
    rows = npfem.stretch(level=2, forces_pN=[0, 40, 80], load=load)
    assert [row["force_pN"] for row in rows] == [0.0, 40.0, 80.0]
    assert all(row["status"] == "converged" for row in rows)
    axial = [row["axial_um"] for row in rows]
    transverse = [row["transverse_um"] for row in rows]
    assert axial == sorted(axial) and axial[2] > axial[0] + 2
    assert transverse == sorted(transverse, reverse=True)
    assert rows[0]["axial_um"] == pytest.approx(rows[0]["transverse_um"], rel=0.02)
    assert max(abs(row["volume_error"]) for row in rows) < 0.02


def test_a_row_does_not_depend_on_the_others():
    alone, = npfem.stretch(level=2, forces_pN=[100])
    among = npfem.stretch(level=2, forces_pN=range(0, 101, 5))
    assert among[-1]["axial_um"] == pytest.approx(alone["axial_um"], abs=1e-3)
    assert among[-1]["transverse_um"] == pytest.approx(alone["transverse_um"], abs=1e-3)


def test_a_force_without_equilibrium_ends_the_experiment(monkeypatch):
    relax = npfem.Batch.relax

    def relax_in_two_iterations(batch):
        batch["relax_iterations"] = 2
        batch["newton_iterations"] = 0
        batch["residual_bound"] = 1e-3
        return relax(batch)

    monkeypatch.setattr(npfem.Batch, "relax", relax_in_two_iterations)
    rows = npfem.stretch("palabos-rbc", [0, 20, 40], level=2)
    assert [row["force_pN"] for row in rows] == [0.0, 20.0]
    assert (rows[0]["usable"], rows[1]["usable"]) == (True, False)
    assert rows[1]["axial_um"] is None and rows[1]["message"]


def test_free_vertices_give_way_more_than_a_rigid_contact():
    rigid, shared = (npfem.stretch(level=3, forces_pN=[50], load=load)[0]["axial_um"] for load in tweezers.LOADS)
    assert shared > rigid + 0.3


def test_a_material_object_can_be_tuned():
    with npfem.Material.preset("rbc") as material:
        soft = npfem.stretch(material, [40], level=2)[0]["axial_um"]
        material["shear_modulus"] = 2 * material["shear_modulus"]
        assert npfem.stretch(material, [40], level=2)[0]["axial_um"] < soft - 0.3


def test_red_cell_of_258_vertices_follows_the_measurement():
    # rbc_material.md, table "Recommended material" (fitted by another program): 10.04/6.21 and 13.31/4.84 um; Mills et
    # al. 2004 within 3 % axial and 5 % transverse.
    rows = npfem.stretch("rbc", [25.0, 100.0] + loaded_forces(200.0))
    by_force = {row["force_pN"]: row for row in rows}
    for force, axial, transverse in ((25.0, 10.04, 6.21), (100.0, 13.31, 4.84), (193.0, 15.34, 3.99)):
        assert by_force[force]["axial_um"] == pytest.approx(axial, rel=0.01)
        assert by_force[force]["transverse_um"] == pytest.approx(transverse, rel=0.02)
    axial, transverse, points = rms_errors(rows)
    assert points == 12
    assert axial < 0.03 and transverse < 0.05
    assert max(abs(row["volume_error"]) for row in rows) < 0.005
    assert max(abs(row["area_error"]) for row in rows) < 0.005
