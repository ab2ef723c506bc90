# SPDX-License-Identifier: MPL-2.0
import threading

import numpy
import pytest

import npfem


@pytest.mark.parametrize("field, components", [("position", 3), ("velocity", 3), ("external_force", 3),
                                               ("contact_stiffness", 1), ("ambient_velocity", 3),
                                               ("ambient_mass", 1), ("held_force", 3),
                                               ("lag_velocity", 3), ("lag_acceleration", 3)])
def test_fields_are_kept(batch, field, components):
    shape = (2, 66, 3) if components == 3 else (2, 66)
    values = numpy.random.default_rng(1).uniform(0.5, 1.5, shape)
    setattr(batch, field, values)
    numpy.testing.assert_array_equal(getattr(batch, field), values)
    numpy.testing.assert_array_equal(batch.get(field, 1, 1), values[1:])
    numpy.testing.assert_array_equal(batch.get(field, single=True), values.astype("f4"))
    batch.set(field, (2 * values[0]).tolist(), 0, 1)
    numpy.testing.assert_array_equal(getattr(batch, field), [2 * values[0], values[1]])


def test_elastic_force_is_read_only(batch):
    with pytest.raises(AttributeError):
        batch.elastic_force = batch.position
    with pytest.raises(npfem.Error):
        batch.set("elastic_force", batch.position)


def test_options_by_key(batch):
    batch["time_step"] = 0.25
    assert batch["time_step"] == 0.25
    assert {"time_step"} <= {parameter.name for parameter in batch.parameters()}


def test_relax_finds_the_free_shape_and_stays_there(batch):
    assert batch.relax() == 0
    assert (batch.status == npfem.CONVERGED).all()
    batch.evaluate()
    energy = batch.measure("energy")
    assert numpy.abs(batch.elastic_force).max() <= batch.residual_pN.max() * (1 + 1e-6) + 1e-12
    shape = batch.position
    batch.relax()
    batch.evaluate()
    numpy.testing.assert_allclose(batch.position, shape, atol=1e-3)
    numpy.testing.assert_allclose(batch.measure("energy"), energy, rtol=1e-6)


def test_energies_add_up(batch):
    batch.position = batch.position * [1.1, 0.95, 1.02]
    batch.evaluate()
    parts = sum(batch.measure("energy:" + name) for name in batch.energies)
    numpy.testing.assert_allclose(parts, batch.measure("energy"), rtol=1e-12)
    assert (batch.measure("energy") > 0).all()


def test_measures(batch):
    batch.position = batch.position + [10.0, 20.0, 30.0]
    numpy.testing.assert_allclose([batch.measure("centre_" + axis)[1] for axis in "xyz"], [10, 20, 30], atol=1e-9)
    assert batch.measure("extent_x")[0] == pytest.approx(7.82)


def test_steps_under_a_load_move_the_cells(batch):
    batch["time_step"] = 1.0
    batch.ambient_mass = numpy.full((2, 66), 100.0)
    load = numpy.zeros((2, 66, 3))
    load[1, :33, 0] = 2.0
    batch.external_force = load
    assert batch.step() == 0
    assert batch.iterations[1] >= 1
    assert batch.step(4) == 0
    assert batch.measure("centre_x")[1] > 1e-3
    assert batch.measure("centre_x")[0] == pytest.approx(0, abs=1e-6)
    assert batch.step_for_ms(1.0) >= 1


def test_a_failed_cell_is_data(batch):
    batch["time_step"] = 1.0
    batch.ambient_mass = numpy.full((2, 66), 100.0)
    before = batch.position
    load = numpy.zeros((2, 66, 3))
    # Finite each, infinite in sum: passes the border, fails in the step.
    load[1] = 1e308 * numpy.sign(before[1])
    batch.external_force = load
    assert batch.step() == 1
    assert batch.status[0] == npfem.CONVERGED
    assert batch.status[1] >= npfem.NOT_FINITE
    assert "failed" in batch.status_text(1)
    numpy.testing.assert_array_equal(batch.position[1], before[1])


def test_cells_come_and_go(batch):
    assert batch.add(3) == 2
    assert batch.cell_count == 5
    moved = batch.position
    moved += numpy.arange(5)[:, None, None]
    batch.position = moved
    batch.remove(1)
    numpy.testing.assert_array_equal(batch.position, moved[[0, 2, 3, 4]])


def test_packed_state_is_bit_for_bit(batch):
    batch.position = batch.position + numpy.random.default_rng(2).uniform(-0.1, 0.1, (2, 66, 3))
    assert batch.state_hash[0] != batch.state_hash[1]
    batch.unpack(0, batch.pack(1))
    assert batch.state_hash[0] == batch.state_hash[1]
    numpy.testing.assert_array_equal(batch.position[0], batch.position[1])


def test_patch_moves_as_one_body(batch):
    batch.relax()
    rest = batch.position
    patch = numpy.argsort(rest[0, :, 0])[-5:]
    batch.add_patch(patch, 1e5)
    opposite = numpy.argsort(rest[0, :, 0])[:5]
    load = numpy.zeros((2, 66, 3))
    load[:, patch[0], 0] = 20.0
    load[:, opposite, 0] = -4.0
    batch.external_force = load
    assert batch.relax() == 0
    moved = (batch.position - rest)[0]
    assert numpy.ptp(moved[patch, 0]) < 1e-3
    batch.clear_patches()
    assert batch.relax() == 0
    assert numpy.ptp((batch.position - rest)[0, patch, 0]) > 1e-2


def test_stop_from_another_thread(batch):
    batch["time_step"] = 1.0
    batch.ambient_mass = numpy.full((2, 66), 100.0)
    timer = threading.Timer(0.2, batch.request_stop)
    timer.start()
    done = batch.step_for_ms(60000.0)
    timer.join()
    assert done >= 1
