# SPDX-License-Identifier: MPL-2.0
import pytest

import npfem


@pytest.fixture
def material():
    with npfem.Material.preset("rbc") as made:
        yield made


def test_presets_are_listed_and_open():
    assert {"rbc", "rbc-viscous", "platelet", "palabos-rbc", "palabos-platelet"} <= set(npfem.Material.presets())
    for name in npfem.Material.presets():
        npfem.Material.preset(name).close()


def test_numbers_and_words_by_key(material):
    material["shear_modulus"] = 2.5
    assert material["shear_modulus"] == 2.5
    material["membrane_law"] = "neo_hookean"
    assert material["membrane_law"] == "neo_hookean"
    material.update(shear_modulus=3, bending_modulus=0.2)
    assert (material["shear_modulus"], material["bending_modulus"]) == (3.0, 0.2)


def test_parameters_describe_themselves(material):
    by_name = {parameter.name: parameter for parameter in material.parameters()}
    assert list(by_name) == material.keys() == list(material)
    shear = by_name["shear_modulus"]
    assert (shear.unit, shear.kind) == ("uN/m", "number")
    assert shear.least <= shear.default <= shear.largest
    assert by_name["membrane_law"].kind == "word"
    assert "skalak" in by_name["membrane_law"].doc
    assert all(parameter.doc for parameter in by_name.values())


def test_behaves_like_a_mapping(material):
    assert "shear_modulus" in material
    assert "no_such_key" not in material
    assert dict(material)["shear_modulus"] == material["shear_modulus"]


def test_unknown_key_names_the_nearest(material):
    for attempt in (lambda: material["shear_modulos"], lambda: material.update(shear_modulos=1.0)):
        with pytest.raises(npfem.Error, match="shear_modulus") as caught:
            attempt()
        assert caught.value.name == "NPFEM_ERROR_NAME"


def test_a_number_out_of_range_leaves_the_value(material):
    before = material["shear_modulus"]
    for wrong in (-1.0, float("nan"), float("inf")):
        with pytest.raises(npfem.Error):
            material["shear_modulus"] = wrong
    assert material["shear_modulus"] == before


def test_text_round_trip(material, tmp_path):
    material["shear_modulus"] = 2.25
    with npfem.Material.parse(material.to_text()) as again:
        assert dict(again) == dict(material)
    path = tmp_path / "soft.toml"
    path.write_text(material.to_text())
    with npfem.Material.named(path) as loaded:
        assert loaded["shear_modulus"] == 2.25


def test_recommended_mesh(material):
    with material.mesh() as mesh, material.mesh(2) as coarse:
        assert (mesh.vertex_count, coarse.vertex_count) == (258, 66)
