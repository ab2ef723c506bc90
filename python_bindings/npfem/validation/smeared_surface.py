# SPDX-License-Identifier: MPL-2.0
"""A rigid body whose surface is smeared by a kernel, in unbounded Stokes flow: what an immersed boundary aims at.

Forces of the vertices are spread by the kernel and the velocity is averaged by it again, so that two vertices feel each
other by the Stokeslet smeared twice. A Gaussian of the kernel's variance stands for it. With B(r) the mean of |r + n|
over the Gaussian n of variance s^2 per axis,
    B = (r + s^2/r) erf(r/(s sqrt 2)) + s sqrt(2/pi) exp(-r^2/(2 s^2)),   G = (I lap B - grad grad B)/(8 pi mu).
"""
import math

import numpy

import npfem

# Variance per axis of the kernels by points, mean over the places of a vertex between the nodes (dx^2).
VARIANCE = {2: 1 / 6, 4: 0.52397}


def _mobility(points, variance):
    """Velocities of the vertices by their forces, mu = 1."""
    arm = points[:, None] - points[None]
    r = numpy.sqrt((arm ** 2).sum(axis=2))
    numpy.fill_diagonal(r, 1)
    s = math.sqrt(variance)
    error = numpy.vectorize(math.erf)(r / (math.sqrt(2) * s))
    bell = math.sqrt(2 / math.pi) / s * numpy.exp(-r * r / (2 * variance))
    slope = ((1 - variance / r ** 2) * error + variance / r * bell) / r  # B'/r
    bend = 2 * variance / r ** 3 * error - 2 * variance / r ** 2 * bell  # B''
    for derivative in (slope, bend):
        numpy.fill_diagonal(derivative, 2 / 3 * math.sqrt(2 / math.pi) / s)
    along = arm / r[..., None]
    blocks = ((bend + slope)[..., None, None] * numpy.eye(3)
              + (slope - bend)[..., None, None] * along[..., :, None] * along[..., None, :])
    size = 3 * len(points)
    return blocks.transpose(0, 2, 1, 3).reshape(size, size) / (8 * math.pi)


def in_shear(semi_axes, kernel):
    """Of a spheroid of 642 vertices: the duration of its turn times the shear rate, for an axis in the plane of the
    flow, and the stresslet by mu, rate and its volume: the intrinsic viscosity of a sphere.

    A body without torque turns by phi' = rate/2 (1 + beta cos 2 phi), beta = (r^2 - 1)/(r^2 + 1) for Jeffery's
    spheroid; here beta comes from the torques of turning and of strain.
    """
    sphere = npfem.Mesh.generate("icosphere", 3, 2.0)
    points = numpy.array([[x * a for x, a in zip(point, semi_axes)] for point in sphere.positions])
    x, y, zero = points[:, 0], points[:, 1], numpy.zeros(len(points))
    turning, strain = numpy.stack([-y, x, zero], 1), 0.5 * numpy.stack([y, x, zero], 1)
    forces = numpy.linalg.solve(_mobility(points, 2 * VARIANCE[kernel]),
                                numpy.stack([turning.ravel(), strain.ravel()], 1))
    by_turning, by_strain = (forces[:, i].reshape(-1, 3) for i in range(2))

    def torque(force):
        return (x * force[:, 1] - y * force[:, 0]).sum()

    beta = 2 * abs(torque(by_strain) / torque(by_turning))
    stresslet = 0.5 * (x * by_strain[:, 1] + y * by_strain[:, 0]).sum()
    volume = 4 / 3 * math.pi * math.prod(semi_axes)
    return 4 * math.pi / math.sqrt(1 - beta ** 2), stresslet / volume
