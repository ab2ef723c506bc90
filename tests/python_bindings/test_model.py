# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest

import npfem


def test_rest_state(model):
    assert (model.vertex_count, model.triangle_count) == (66, 128)
    assert model.get("rest_position").shape == (66, 3)
    assert model.get("rest_area").sum() == pytest.approx(model.measure("rest_area"), rel=1e-12)
    assert model.triangles.shape == (128, 3)


def test_energies_of_zero_weight_are_not_evaluated():
    with npfem.Material.preset("rbc") as material, material.mesh(2) as mesh:
        with npfem.Model(mesh, material) as whole:
            names = whole.energies
        material["bending_modulus"] = 0.0
        with npfem.Model(mesh, material) as without_bending:
            assert len(without_bending.energies) == len(names) - 1


def test_a_model_does_not_follow_its_material():
    with npfem.Material.preset("rbc") as material, material.mesh(2) as mesh, npfem.Model(mesh, material) as model:
        before = model.measure("shear_modulus")
        material["shear_modulus"] = 2 * before
        assert model.measure("shear_modulus") == before


def test_outlives_mesh_and_material_and_is_outlived_by_its_batch():
    material = npfem.Material.preset("rbc")
    mesh = material.mesh(2)
    model = npfem.Model(mesh, material)
    material.close()
    mesh.close()
    batch = npfem.Batch(model)
    model.close()
    batch.evaluate()
    assert numpy.isfinite(batch.elastic_force).all()
    batch.close()
