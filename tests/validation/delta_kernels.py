# SPDX-License-Identifier: MPL-2.0
"""What the immersed boundary keeps when it passes velocities and forces between vertices and nodes.

For the kernels of 2, 3 and 4 points (linear; Roma, Peskin & Berger, J. Comput. Phys. 153 (1999) 509; Peskin, Acta
Numerica 11 (2002) 479) and 1000 vertices at random places: a uniform flow and a linear one are interpolated exactly
(sum of the weights 1, first moment 0); spreading keeps force and torque; the power of the forces is the same on both
sides, so that the coupling itself neither makes nor destroys energy. All to 1e-12 of the sum of the sizes: round-off.
"""
from npfem.validation import Case, probe

CASE = Case(id="I1", title="What the kernels keep", tier="ci", cost_s=1,
            source="theory; Peskin, Acta Numerica 11 (2002) 479")

NAMES = (("uniform_flow", "interpolation of a uniform flow"), ("shear_flow", "interpolation of a linear flow"),
         ("force", "total force"), ("torque", "total torque"), ("power", "power"))


def run(report):
    """All kernels."""
    for points in (2, 3, 4):
        found = probe(report, "immersed_boundary", "kernel", points)
        for key, name in NAMES:
            report.below("%s, %d points: error" % (name, points), found[key], 1e-12)
