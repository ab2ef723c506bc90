# SPDX-License-Identifier: MPL-2.0
"""What the library refuses becomes `npfem.Error`, with the library's words."""
import gc

import numpy
import pytest

import npfem
from npfem import _library


def refused(name, attempt):
    with pytest.raises(npfem.Error) as caught:
        attempt()
    assert caught.value.name == name
    assert caught.value.status < 0
    assert str(caught.value)
    return str(caught.value)


def test_unknown_names_say_what_there_is():
    assert "rbc" in refused("NPFEM_ERROR_NAME", lambda: npfem.Material.preset("rcb"))
    assert "sphere" in refused("NPFEM_ERROR_NAME", lambda: npfem.Mesh.generate("spere", 2))


def test_missing_file_is_named():
    assert "/nowhere/cell.off" in refused("NPFEM_ERROR_IO", lambda: npfem.Mesh.load("/nowhere/cell.off"))


def test_unknown_back_end_lists_those_of_this_build(model):
    with pytest.raises(npfem.Error, match="reference"):
        npfem.Batch(model, backend="abacus")


def test_wrong_length_and_range(batch):
    assert "396" in refused("NPFEM_ERROR_ARGUMENT", lambda: batch.set("position", numpy.zeros(395)))
    refused("NPFEM_ERROR_ARGUMENT", lambda: batch.get("position", 1, 2))
    refused("NPFEM_ERROR_ARGUMENT", lambda: batch.remove(2))
    refused("NPFEM_ERROR_ARGUMENT", lambda: batch.add_patch([0, 66], 1.0))


def test_what_is_not_finite_is_refused_and_nothing_changes(batch):
    before = batch.state_hash
    positions = batch.position
    positions[1, 3, 2] = numpy.nan
    with pytest.raises(npfem.Error):
        batch.position = positions
    numpy.testing.assert_array_equal(batch.state_hash, before)


def test_unknown_field_and_measure(batch):
    assert "velocity" in refused("NPFEM_ERROR_NAME", lambda: batch.get("velocty"))
    assert "volume" in refused("NPFEM_ERROR_NAME", lambda: batch.measure("volum"))


def test_closed_objects_are_stale(sphere):
    mesh = npfem.Mesh.generate("sphere", 1)
    mesh.close()
    assert mesh.closed
    mesh.close()
    refused("NPFEM_ERROR_HANDLE", lambda: mesh.positions)
    # Its slot may be used again, its handle not.
    with npfem.Mesh.generate("sphere", 1):
        refused("NPFEM_ERROR_HANDLE", lambda: mesh.positions)
    assert not sphere.closed


def test_a_handle_of_another_kind_is_refused(sphere, model):
    refused("NPFEM_ERROR_HANDLE", lambda: npfem.Model(sphere, model))


def test_with_blocks_close():
    with npfem.Material.preset("rbc") as material:
        pass
    refused("NPFEM_ERROR_HANDLE", lambda: material["shear_modulus"])


def test_the_last_reference_releases():
    mesh = npfem.Mesh.generate("sphere", 1)
    handle = mesh.handle
    del mesh
    gc.collect()
    with pytest.raises(npfem.Error):
        _library.call("npfem_mesh_vertex_count", handle)


def test_a_failed_constructor_leaves_nothing_to_release():
    with pytest.raises(npfem.Error):
        npfem.Mesh([[0, 0, 0]], [[0, 0, 0]])
    gc.collect()
