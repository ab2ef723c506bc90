# SPDX-License-Identifier: MPL-2.0
"""A flat patch of membrane under uniaxial tension: the constitutive laws themselves.

Proves that a triangle evaluates its law and the force that follows from it exactly, whatever the triangulation. The
library takes closed surfaces only, so the patch is a flat bag: two square sheets, 10 um wide, triangulated at random,
sewn together along the rim. It is flat to one part in 10^9: nothing of that is left in the strain.

Prescribed: the bag is stretched by l1 along x and by the l2 across at which the law has no lateral tension. The
tension over a cut is the force on the rim; linear triangles reproduce a constant strain, so it must be exact to round-
off, and no force may be left on the vertices inside and on the lateral rims. Solved: the bag is pulled at two rims by
the force of that tension; the solver must find l1 and l2 by itself. Reference: the closed forms, T2 = 0 (Barthes-
Biesel, Diaz & Dhenin, J. Fluid Mech. 460 (2002) 211), which the digits of the published table confirm first. Weakness:
uniform strain only.
"""
import numpy

from npfem.validation import Case
from npfem.validation.membranes import random_rotation, single_cell

CASE = Case(id="S1", title="Uniaxial tension of a patch", tier="ci", cost_s=2,
            source="closed forms of the neo-Hookean and Skalak laws with a free lateral edge")

STRETCHES = (1.1, 1.2, 1.5, 2.0)
# T1/G_s and l2 at these stretches, five to six digits.
TABLE = {
    "neo-Hookean": ({"membrane_law": "neo_hookean"}, None, (0.286906, 0.553808, 1.29279, 2.47487),
                    (0.953463, 0.912871, 0.816497, 0.707107)),
    "Skalak C = 1": ({"membrane_law": "skalak", "skalak_C": 1}, 1, (0.3327, 0.74566, 2.7873, 11.2549),
                     (0.947037, 0.890987, 0.732177, 0.542326)),
    "Skalak C = 10": ({"membrane_law": "skalak", "skalak_C": 10}, 10, (0.387572, 0.831751, 3.0241, 12.0778),
                      (0.915173, 0.841726, 0.674689, 0.504637)),
    "Skalak C = 100": ({"membrane_law": "skalak", "skalak_C": 100}, 100, (0.39648, 0.844328, 3.05577, 12.1763),
                       (0.909738, 0.834213, 0.667488, 0.500468)),
}
WIDTH_UM = 10.0
SHEAR_MODULUS = 2.5  # uN/m
FLATNESS = 1e-9


def lateral_stretch(c, l1):
    """l2 without lateral tension; `c`: Skalak's C, None for the neo-Hookean law."""
    return l1 ** -0.5 if c is None else numpy.sqrt((1 + c * l1**2) / (1 + c * l1**4))


def tension(c, l1):
    """T1/G_s at that l2."""
    l2 = lateral_stretch(c, l1)
    if c is None:
        return (l1 - 1 / (l1**3 * l2**2)) / l2
    return l1 / l2 * (l1**2 - 1 + c * l2**2 * ((l1 * l2) ** 2 - 1))


def bag(cells, generator):
    """(positions, triangles) of two sheets of cells x cells squares, each cut at random, sewn along the rim."""
    line = numpy.arange(cells + 1)
    i, j = (axis.ravel() for axis in numpy.meshgrid(line, line, indexing="ij"))
    inside = (i > 0) & (i < cells) & (j > 0) & (j < cells)
    flat = numpy.column_stack([i, j]) / cells + inside[:, None] * generator.uniform(-0.25, 0.25, (i.size, 2)) / cells
    lower = numpy.arange(i.size)
    upper = lower.copy()
    upper[inside] = i.size + numpy.arange(inside.sum())
    flat_twice = WIDTH_UM * numpy.vstack([flat, flat[inside]])
    height = WIDTH_UM * FLATNESS * numpy.concatenate([-1.0 * inside, numpy.ones(inside.sum())])
    # A corner square must not be cut off its corner: that triangle would lie in the rim and have a twin below.
    triangles = []
    for a in range(cells):
        for b in range(cells):
            q = [a * (cells + 1) + b, (a + 1) * (cells + 1) + b, (a + 1) * (cells + 1) + b + 1, a * (cells + 1) + b + 1]
            corner = {(0, 0): 0, (cells - 1, 0): 1, (cells - 1, cells - 1): 2, (0, cells - 1): 3}.get((a, b))
            turn = generator.integers(2) if corner is None else corner % 2
            q = q[turn:] + q[:turn]
            for t in ((q[0], q[1], q[2]), (q[0], q[2], q[3])):
                triangles.append([upper[v] for v in t])
                triangles.append([lower[v] for v in reversed(t)])
    return numpy.column_stack([flat_twice, height]), numpy.array(triangles)


def rim_shares(positions, axis):
    """Of each vertex in the rim at the largest coordinate of `axis`: its share of that rim's length."""
    rim = numpy.flatnonzero(positions[:, axis] > WIDTH_UM * (1 - 1e-12))
    rim = rim[numpy.argsort(positions[rim, 1 - axis])]
    gaps = numpy.diff(positions[rim, 1 - axis])
    shares = numpy.zeros(len(positions))
    shares[rim] = (numpy.append(gaps, 0) + numpy.append(0, gaps)) / (2 * WIDTH_UM)
    return shares


def prescribed(report, name, parameters, c):
    """Largest errors of the tension and of forces that must vanish, over the stretches, turned in space."""
    generator = numpy.random.default_rng(1)
    positions, triangles = bag(6, generator)
    batch = single_cell(positions, triangles, shear_modulus=SHEAR_MODULUS, **parameters)
    right, left = rim_shares(positions, 0) > 0, positions[:, 0] < 1e-12
    worst, left_over = 0.0, 0.0
    for l1 in STRETCHES:
        l2 = lateral_stretch(c, l1)
        turn = random_rotation(generator)
        batch.position = (positions * [l1, l2, 1.0]) @ turn.T
        batch.evaluate()
        force = batch.elastic_force[0] @ turn
        ours = -force[right, 0].sum() / (2 * WIDTH_UM * l2) / SHEAR_MODULUS
        worst = max(worst, abs(ours / tension(c, l1) - 1))
        left_over = max(left_over, abs(force[~(right | left), :2]).max() / (SHEAR_MODULUS * WIDTH_UM))
    report.below("%s, prescribed: relative error of the tension" % name, worst, 1e-12)
    report.below("%s, prescribed: force in the plane left inside and on the free edges, over G_s x width" % name,
                 left_over, 1e-12)


def solved(report, name, parameters, c):
    """Largest errors of the stretches that the solver finds."""
    positions, triangles = bag(6, numpy.random.default_rng(2))
    shares = rim_shares(positions, 0)
    other = rim_shares(positions * [-1, 1, 1] + [WIDTH_UM, 0, 0], 0)
    batch = single_cell(positions, triangles, {"tolerance": 1e-9, "relax_iterations": 5000},
                        shear_modulus=SHEAR_MODULUS, **parameters)
    worst = 0.0
    found = []
    for l1 in STRETCHES:
        l2 = lateral_stretch(c, l1)
        force = numpy.zeros_like(positions)
        force[:, 0] = 2 * WIDTH_UM * l2 * SHEAR_MODULUS * tension(c, l1) * (shares - other)
        batch.external_force = force
        failed = batch.relax()
        ours = [batch.measure("extent_x")[0] / WIDTH_UM, batch.measure("extent_y")[0] / WIDTH_UM]
        worst = max(worst, abs(ours[0] / l1 - 1), abs(ours[1] / l2 - 1), 1.0 if failed else 0.0)
        found.append(ours[0])
    report.below("%s, solved: relative error of both stretches" % name, worst, 1e-6)
    return found


def run(report):
    """Every law, prescribed and solved."""
    plot = report.plot("Uniaxial tension of a patch", "stretch along the pull", "tension / G_s", y_log=True)
    fine = numpy.linspace(1.02, 2.0, 50)
    for name, (parameters, c, tensions, laterals) in TABLE.items():
        digits = max(max(abs(tension(c, l1) / t - 1), abs(lateral_stretch(c, l1) / l2 - 1))
                     for l1, t, l2 in zip(STRETCHES, tensions, laterals))
        report.below("%s: closed form against the digits of the table" % name, digits, 1e-5)
        prescribed(report, name, parameters, c)
        found = solved(report, name, parameters, c)
        report.curve(plot, name, fine, [tension(c, l1) for l1 in fine])
        report.curve(plot, name + ", solved", found, [tension(c, l1) for l1 in STRETCHES], points=True)
