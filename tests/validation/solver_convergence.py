# SPDX-License-Identifier: MPL-2.0
"""A red cell under 200 pN: every way of solving must end in the same shape.

Proves that an equilibrium is a property of the cell and not of the solver. The cell `rbc` of 258 vertices is pulled by
two rigid contacts 2 um across, by Newton's method alone, by quasi-Newton steps alone (histories of two lengths), on
both back ends, in one jump or in eight forces, and in time: steps of 1 s of a membrane with mass, which implicit Euler
brings to rest. Reference: the diameters by Newton's method to 10^-8 pN. Tolerance: 10^-6 of the diameter for all that
stop at 10^-6 pN; at the default tolerance of 10^-4 pN too.

Weakness: one load, on a branch without a second stable shape. The lineage's own stop, on the scatter of the objective
after at most 30 iterations, is no equilibrium and is not compared here.
"""
import numpy

import npfem
from npfem.tweezers import contact_vertices
from npfem.validation import Case

CASE = Case(id="S5", title="The same equilibrium by every solver", tier="ci", cost_s=3,
            source="Newton's method with exact second derivatives")

FORCE_PN = 200.0
BEAD_STIFFNESS = 1000.0  # pN/um, ties the vertices of a contact
NEWTON = {"relax_iterations": 1, "newton_iterations": 1000}
QUASI_NEWTON = {"relax_iterations": 100000, "newton_iterations": 0}
WAYS = (
    ("Newton's method, one jump", "cpu", 1, dict(NEWTON, tolerance=1e-6)),
    ("quasi-Newton, history 7", "cpu", 8, dict(QUASI_NEWTON, tolerance=1e-6)),
    ("quasi-Newton, history 30", "cpu", 8, dict(QUASI_NEWTON, tolerance=1e-6, history=30)),
    ("quasi-Newton, reference", "reference", 8, dict(QUASI_NEWTON, tolerance=1e-6)),
    ("default settings, one jump", "cpu", 1, {}),
    ("default settings, eight forces", "cpu", 8, {}),
)


class Pull:
    """The cell between its contacts."""

    def __init__(self, backend, options):
        with npfem.Material.preset("rbc") as cell:
            cell["membrane_density"] = 1.0
            with cell.mesh(3) as mesh, npfem.Model(mesh, cell) as model:
                self.batch = npfem.Batch(model, backend=backend)
                self.sides = contact_vertices(mesh.positions)
        # All are tied in one shape, to the last digit.
        self.batch.update(tolerance=1e-8)
        self.batch.relax()
        for side in self.sides:
            self.batch.add_patch(side, BEAD_STIFFNESS)
        self.batch.update(tolerance=1e-4)
        self.batch.update(**options)

    def load(self, force_pN):
        """Half of it on each side's vertices, left and right."""
        force = numpy.zeros((self.batch.vertex_count, 3))
        for side, sign in zip(self.sides, (-1, 1)):
            force[side, 0] = sign * force_pN / len(side)
        self.batch.external_force = force

    def to_rest(self, forces):
        """Axial and transverse diameter under the whole force, um."""
        for number in range(1, forces + 1):
            self.load(FORCE_PN * number / forces)
            if self.batch.relax():
                raise RuntimeError(self.batch.status_text(0))
        return self.diameters()

    def in_time(self, steps, step_us):
        """The same by time steps from the shape without load."""
        self.batch["time_step"] = step_us
        self.load(FORCE_PN)
        if self.batch.step(steps):
            raise RuntimeError(self.batch.status_text(0))
        return self.diameters()

    def diameters(self):
        """Axial and transverse, um."""
        return numpy.array([self.batch.measure("extent_x")[0], self.batch.measure("extent_y")[0]])


def run(report):
    """All ways beside Newton's."""
    reference = Pull("cpu", dict(NEWTON, tolerance=1e-8)).to_rest(8)
    report.measured("axial diameter by Newton's method", reference[0], unit="um")
    report.measured("transverse diameter by Newton's method", reference[1], unit="um")
    for name, backend, forces, options in WAYS:
        pull = Pull(backend, options)
        error = abs(pull.to_rest(forces) / reference - 1).max()
        report.below("%s: relative difference of the diameters" % name, error, 1e-6)
        report.measured("its iterations under the last force", pull.batch.iterations[0])
    settled = Pull("cpu", {"tolerance": 1e-6}).in_time(40, 1e6)
    report.below("in time, 40 steps of 1 s: relative difference of the diameters", abs(settled / reference - 1).max(),
                 1e-6)
