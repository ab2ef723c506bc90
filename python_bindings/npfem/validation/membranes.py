# SPDX-License-Identifier: MPL-2.0
"""Membranes that validation cases of the cell solver share: materials, surfaces, and what is computed on them."""
import math

import numpy

from ..batch import Batch
from ..material import Material
from ..mesh import Mesh
from ..model import Model

# Evans & Fung, Microvasc. Res. 4 (1972) 335: thickness of the mean red cell over its radius,
# t = R0 sqrt(1 - s^2) (c0 + c1 s^2 + c2 s^4), s = r/R0.
EVANS_FUNG_RADIUS_UM = 3.91
EVANS_FUNG = (0.207161, 2.002558, -1.122762)


def material(**parameters):
    """A membrane of nothing but these parameters."""
    blank = Material.parse('schema_version = 1\nname = "validation"\n')
    blank.update(**parameters)
    return blank


def single_cell(positions, triangles, options=None, backend="cpu", **parameters):
    """A batch of one cell of such a membrane; `options`: of the batch, by key."""
    with Mesh(positions, triangles) as mesh, material(**parameters) as membrane, Model(mesh, membrane) as model:
        batch = Batch(model, backend=backend)
    for key, value in (options or {}).items():
        batch[key] = value
    return batch


def unit_sphere(shape, level):
    """(positions, triangles) of a "sphere" or an "icosphere" of radius 1 um."""
    with Mesh.generate(shape, level, 2.0) as mesh:
        positions = mesh.positions
        return positions / numpy.linalg.norm(positions, axis=1)[:, None], mesh.triangles


def evans_fung(sphere, radius_um=EVANS_FUNG_RADIUS_UM, coefficients=EVANS_FUNG):
    """The points of a unit sphere carried onto the Evans-Fung cell."""
    c0, c1, c2 = coefficients
    q = sphere[:, 0] ** 2 + sphere[:, 1] ** 2
    height = 0.5 * sphere[:, 2] * (c0 + c1 * q + c2 * q * q)
    return radius_um * numpy.column_stack([sphere[:, 0], sphere[:, 1], height])


def area_and_volume(positions, triangles):
    """Of a closed surface, um2 and um3."""
    a, b, c = (positions[triangles[:, corner]] for corner in range(3))
    normals = numpy.cross(b - a, c - a)
    return 0.5 * numpy.linalg.norm(normals, axis=1).sum(), (a * normals).sum() / 6.0


def pressure_directions(positions, triangles):
    """Slope of the volume by each vertex, um2: the force of a unit pressure inside."""
    a, b, c = (positions[triangles[:, corner]] for corner in range(3))
    slopes = numpy.zeros_like(positions)
    for corner, normal in enumerate((numpy.cross(b, c), numpy.cross(c, a), numpy.cross(a, b))):
        numpy.add.at(slopes, triangles[:, corner], normal / 6.0)
    return slopes


def vertex_areas(positions, triangles):
    """A third of the triangles around each vertex, um2."""
    a, b, c = (positions[triangles[:, corner]] for corner in range(3))
    areas = 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    return numpy.bincount(triangles.ravel(), numpy.repeat(areas / 3.0, 3), len(positions))


def random_rotation(generator):
    """A rotation matrix, uniform over all of them."""
    q, r = numpy.linalg.qr(generator.normal(size=(3, 3)))
    q = q * numpy.sign(numpy.diag(r))
    return q if numpy.linalg.det(q) > 0 else -q


def order(steps, errors):
    """Slope of log(error) by log(step): the order of convergence."""
    return float(numpy.polyfit(numpy.log(steps), numpy.log(numpy.abs(errors)), 1)[0])


def sphere_energy(bending_modulus):
    """Helfrich's bending energy of any sphere, 8 pi kappa, pN um."""
    return 8.0 * math.pi * bending_modulus
