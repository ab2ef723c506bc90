# SPDX-License-Identifier: MPL-2.0
"""Drag of a sphere in a simple cubic array, after H. Hasimoto, J. Fluid Mech. 5 (1959) 317."""
import math


def hasimoto(a_over_length):
    """F / (6 pi mu a U); U relative to the mean of fluid and spheres.

    His table: 1.1646 at 0.05, 1.3881 at 0.1, 1.5304 at 0.125.
    """
    c = 4 / 3 * math.pi * a_over_length ** 3
    return 1 / (1 - 1.7601 * c ** (1 / 3) + c - 1.5593 * c * c)


def raw_error(force_over_viscosity_speed, radius, length):
    """Of a drag F/(mu U), relative to that of a sphere of this radius."""
    return force_over_viscosity_speed / (6 * math.pi * radius * hasimoto(radius / length)) - 1


def effective_radius(force_over_viscosity_speed, length):
    """Radius of the sphere with this drag F/(mu U), by bisection: the drag grows with the radius."""
    low, high = 0.0, 0.4 * length
    for _ in range(60):
        middle = 0.5 * (low + high)
        if raw_error(force_over_viscosity_speed, middle, length) > 0:
            low = middle
        else:
            high = middle
    return low
