# SPDX-License-Identifier: MPL-2.0
"""One linear mode in time: what implicit Euler and BDF2 do to amplitude and phase.

Proves the integrators themselves. A patch ties two opposite vertices of a light sphere to their common motion by a
linear spring, so that pulled apart and let go they swing as z = u + i v/w, dz/dt = -i w z, with w^2 = k/m. There is no
other stiffness: the sphere has a volume energy of 10^-15 Pa, for a model needs one.

Implicit Euler: z_{n+1} = z_n/(1 + i w h): the amplitude falls by (1 + w^2 h^2)^-1/2 a step, the phase grows by
atan(w h), to round-off at any step. BDF2 (first step by implicit Euler): its recursion with three terms, likewise.
Order: the error after 10 us against the exact swing, over a sequence of halved steps: 1 and 2 within 0.05. Weakness:
linear; the order on a red cell let go, viscous or not, is tested in tests/npfem/backend/test_time_integration.cpp.
"""
import cmath
import math

import numpy

from npfem.validation import Case
from npfem.validation.membranes import material, order, unit_sphere
import npfem

CASE = Case(id="S4", title="Order of the time integrators", tier="ci", cost_s=1,
            source="Hairer & Wanner, Solving Ordinary Differential Equations II (1996), ch. III and V")

AMPLITUDE_UM = 0.3
FREQUENCY = 0.7  # 1/us


class Swing:
    """The two vertices, at rest in space but for their swing."""

    def __init__(self, integrator, step_us):
        positions, triangles = unit_sphere("sphere", 1)
        with npfem.Mesh(positions, triangles) as mesh, \
                material(global_volume_modulus=1e-15, membrane_density=10.0) as membrane, \
                npfem.Model(mesh, membrane) as model:
            self.batch = npfem.Batch(model)
            self.rest = positions
            self.pair = [int(numpy.argmax(positions[:, 0])), int(numpy.argmin(positions[:, 0]))]
            masses = model.get("solid_mass")[self.pair]
        if abs(masses[0] / masses[1] - 1) > 1e-12:
            raise RuntimeError("the two vertices differ in mass")
        self.batch.update(integrator=integrator, time_step=step_us, tolerance=0.0)
        self.batch.add_patch(self.pair, masses[0] * FREQUENCY**2)
        start = positions.copy()
        start[self.pair, 0] += [AMPLITUDE_UM, -AMPLITUDE_UM]
        self.batch.position = start

    def states(self, steps):
        """z after each step."""
        found = [complex(AMPLITUDE_UM, 0.0)]
        for _ in range(steps):
            self.batch.step()
            vertex = self.pair[0]
            moved = self.batch.position[0, vertex, 0] - self.rest[vertex, 0]
            found.append(complex(moved, self.batch.velocity[0, vertex, 0] / FREQUENCY))
        return found


def recursion(integrator, step_us, steps):
    """What the scheme makes of the swing, in exact arithmetic."""
    # u' = v, v' = -w^2 u: with z = u + i v/w, z' = -i w z.
    rate = 1j * FREQUENCY * step_us
    found = [complex(AMPLITUDE_UM, 0.0)]
    for n in range(steps):
        if integrator == 0 or n == 0:
            found.append(found[-1] / (1 + rate))
        else:
            found.append((4 * found[-1] - found[-2]) / (3 + 2 * rate))
    return found


def run(report):
    """Amplitude and phase of a step, then the order."""
    plot = report.plot("Order of the time integrators", "step x frequency", "error after 10 us / amplitude", x_log=True,
                       y_log=True)
    for step in (0.1, 1.0, 10.0):
        ours = Swing(0, step).states(4)
        ratio, wh = ours[4] / ours[3], FREQUENCY * step
        report.compare("implicit Euler, w h = %.3g: amplitude ratio of a step" % wh, abs(ratio),
                       1 / math.sqrt(1 + wh * wh), relative=1e-8)
        report.compare("implicit Euler, w h = %.3g: phase of a step" % wh, -cmath.phase(ratio), math.atan(wh),
                       absolute=1e-8, unit="rad")
    for step in (0.1, 1.0):
        ours, expected = Swing(1, step).states(10), recursion(1, step, 10)
        report.below("BDF2, w h = %.3g: departure from its recursion in 10 steps, over the amplitude"
                     % (FREQUENCY * step), max(abs(a - b) for a, b in zip(ours, expected)) / AMPLITUDE_UM, 1e-8)
    duration, counts = 10.0, (500, 1000, 2000)
    exact = AMPLITUDE_UM * cmath.exp(-1j * FREQUENCY * duration)
    for integrator, name, expected in ((0, "implicit Euler", 1), (1, "BDF2", 2)):
        steps = [duration / count for count in counts]
        errors = [abs(Swing(integrator, duration / count).states(count)[-1] - exact) / AMPLITUDE_UM
                  for count in counts]
        report.compare("%s: order" % name, order(steps, errors), expected, absolute=0.05)
        report.curve(plot, name, [FREQUENCY * step for step in steps], errors)
