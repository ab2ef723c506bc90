# SPDX-License-Identifier: MPL-2.0
"""A capsule in unbounded simple shear by the boundary integral method: a yardstick for the coupled code that shares
nothing with it, neither the fluid nor the membrane. Needs numpy.

Stokes flow, the same viscosity inside and outside, so that the single layer alone remains (Pozrikidis, Boundary
Integral and Singularity Methods, Cambridge 1992): u(x) = gdot y e_x + 1/(8 pi mu) sum over vertices of G(x - x_j) F_j,
G = 1/r + rr/r^3. The membrane forces F_j are those of linear triangles. What a vertex does to itself is the integral of
G over its share A of the surface less the part that a punctured sum over a triangular lattice already has: with the
lattice constant 3.921 of the two-dimensional Wigner crystal, (3.921 I + 1.9605 (I - nn)) F / sqrt(A).

Everything is in units of radius, shear rate and viscosity; the capillary number is mu gdot a / G_s. Linear theory for a
neo-Hookean sphere, D = 25/12 Ca (Barthes-Biesel & Rallison, J. Fluid Mech. 113 (1981) 251), is met within 0.3 % with
642 vertices; from 162 to 642 vertices D changes by 0.6 % at Ca = 0.3 and 0.5 % at 0.6.
"""
import math

import numpy

from ..mesh import Mesh

_SELF_ISOTROPIC, _SELF_IN_PLANE = 3.9210, 1.9605


def neo_hookean(trace, dilation):
    """Derivatives of W/G_s = (trace - 2 + 1/dilation)/2; trace = l1^2 + l2^2, dilation = (l1 l2)^2."""
    return 0.5 * numpy.ones_like(trace), -0.5 / dilation ** 2


def zero_thickness(trace, dilation):
    """Of W/G_s = (trace - ln dilation + (ln dilation)^2 / 2)/2, the thin shell of Ramanujan & Pozrikidis 1998."""
    return 0.5 * numpy.ones_like(trace), 0.5 * (numpy.log(dilation) - 1) / dilation


def skalak(stiffness_of_area):
    """Of W/G_s = (I1^2 + 2 I1 - 2 I2 + C I2^2)/4."""
    return lambda trace, dilation: (0.5 * (trace - 2) + 0.5, -0.5 + 0.5 * stiffness_of_area * (dilation - 1))


def moments_of(points, triangles):
    """(semi-axes of the ellipsoid with the body's second moments, rising; their directions in columns; volume)."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    part = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6
    volume = part.sum()
    centre = ((a + b + c) * part[:, None] / 4).sum(0) / volume
    a, b, c = a - centre, b - centre, c - centre
    whole = a + b + c
    second = sum(numpy.einsum("i,ij,ik->jk", part, q, q) for q in (whole, a, b, c)) / 20
    squares, directions = numpy.linalg.eigh(second)
    return numpy.sqrt(5 * squares / volume), directions, volume


class Capsule:
    """A capsule, a sphere of radius 1 at rest; `level` of the icosphere: 2, 3 have 162, 642 vertices."""

    def __init__(self, capillary_number, law=neo_hookean, level=3):
        with Mesh.generate("icosphere", level, 2.0) as mesh:
            self.points = numpy.array(mesh.positions, dtype=float).reshape(-1, 3)
            self.triangles = numpy.array(mesh.triangles, dtype=int).reshape(-1, 3)
        self._law, self._stiffness = law, 1 / capillary_number
        rest = self._metric(self.points)
        self._inverse = numpy.linalg.inv(rest)
        self._determinant = numpy.linalg.det(rest)
        self._area = 0.5 * numpy.sqrt(self._determinant)

    def _edges(self, points):
        corner = points[self.triangles]
        return corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]

    def _metric(self, points):
        edges = self._edges(points)
        return numpy.stack([numpy.stack([(p * q).sum(1) for q in edges], -1) for p in edges], 1)

    def _scatter(self, values):
        """Sums (corner, triangle, ...) over the triangles of each vertex."""
        total = numpy.zeros((len(self.points),) + values.shape[2:])
        for corner in range(3):
            numpy.add.at(total, self.triangles[:, corner], values[corner])
        return total

    def forces(self, points):
        """Of the membrane on the fluid, by vertex: minus the gradient of the elastic energy."""
        metric = self._metric(points)
        dilation = numpy.linalg.det(metric) / self._determinant
        by_trace, by_dilation = self._law(numpy.einsum("nij,nji->n", self._inverse, metric), dilation)
        stress = by_trace[:, None, None] * self._inverse
        stress = stress + (by_dilation * dilation)[:, None, None] * numpy.linalg.inv(metric)
        first, second = self._edges(points)
        weight = -2 * self._stiffness * self._area[:, None]
        pull = [weight * (stress[:, k, 0, None] * first + stress[:, k, 1, None] * second) for k in range(2)]
        return self._scatter(numpy.stack([-pull[0] - pull[1], pull[0], pull[1]]))

    def velocities(self, points):
        """Of the vertices, carried by the fluid."""
        force = self.forces(points)
        first, second = self._edges(points)
        normal = numpy.cross(first, second)
        area = self._scatter(numpy.repeat(numpy.linalg.norm(normal, axis=1)[None] / 6, 3, 0))
        normal = self._scatter(numpy.repeat(normal[None], 3, 0))
        normal /= numpy.linalg.norm(normal, axis=1)[:, None]
        apart = points[:, None] - points[None]
        square = (apart ** 2).sum(-1)
        numpy.fill_diagonal(square, 1)
        inverse = 1 / numpy.sqrt(square)
        numpy.fill_diagonal(inverse, 0)
        along = inverse ** 3 * numpy.einsum("ijk,jk->ij", apart, force)
        velocity = inverse @ force + numpy.einsum("ij,ijk->ik", along, apart)
        own = (_SELF_ISOTROPIC + _SELF_IN_PLANE) * force - _SELF_IN_PLANE * (force * normal).sum(1)[:, None] * normal
        velocity = (velocity + own / numpy.sqrt(area)[:, None]) / (8 * math.pi)
        velocity[:, 0] += points[:, 1]
        return velocity

    def shear(self, strain, step=0.01):
        """Goes on until gdot t = `strain` (midpoint rule); yields (gdot t, D, inclination in degrees) each step."""
        for count in range(1, round(strain / step) + 1):
            half = self.points + 0.5 * step * self.velocities(self.points)
            self.points = self.points + step * self.velocities(half)
            axes, directions, _ = moments_of(self.points, self.triangles)
            longest = directions[:, 2]
            angle = math.degrees(math.atan2(longest[1], longest[0])) % 180
            yield count * step, (axes[2] - axes[0]) / (axes[2] + axes[0]), angle
