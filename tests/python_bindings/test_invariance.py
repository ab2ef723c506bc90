# SPDX-License-Identifier: MPL-2.0
"""A rigid motion changes no energy and turns the forces with the cell."""
import math

import numpy
import pytest
from hypothesis import given, settings, strategies

import npfem

angles = strategies.floats(-math.pi, math.pi)
shifts = strategies.floats(-100.0, 100.0)


def rotation(alpha, beta, gamma):
    def about(axis, angle):
        c, s = math.cos(angle), math.sin(angle)
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        matrix = numpy.eye(3)
        matrix[i, i] = matrix[j, j] = c
        matrix[i, j], matrix[j, i] = -s, s
        return matrix

    return about(2, alpha) @ about(0, beta) @ about(2, gamma)


@pytest.fixture(scope="module", params=["rbc", "platelet", "palabos-rbc"])
def strained(request):
    """A batch of two, and a strained shape."""
    with npfem.Material.preset(request.param) as material, material.mesh(2) as mesh, \
            npfem.Model(mesh, material) as model, npfem.Batch(model, cells=2) as batch:
        noise = numpy.random.default_rng(3).uniform(-0.05, 0.05, (66, 3))
        yield batch, mesh.positions * [1.08, 0.96, 1.03] + noise


@settings(max_examples=25)
@given(angles, strategies.floats(0, math.pi), angles, shifts, shifts, shifts)
def test_rigid_motion(strained, alpha, beta, gamma, dx, dy, dz):
    batch, shape = strained
    turn = rotation(alpha, beta, gamma)
    batch.position = numpy.stack([shape, shape @ turn.T + [dx, dy, dz]])
    batch.evaluate()
    for name in batch.energies:
        here, there = batch.measure("energy:" + name)
        assert there == pytest.approx(here, rel=1e-8, abs=1e-9), name
    force = batch.elastic_force
    largest = numpy.abs(force[0]).max()
    assert largest > 0.01
    # Shifting by 100 um costs the last digits of the edge vectors.
    numpy.testing.assert_allclose(force[1], force[0] @ turn.T, atol=1e-8 * largest)
    numpy.testing.assert_allclose(force.sum(axis=1), 0, atol=1e-9 * largest)
