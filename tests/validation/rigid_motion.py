# SPDX-License-Identifier: MPL-2.0
"""Rigid motion and free flight: nothing but deformation may store energy, and momentum may go nowhere.

Proves that every law is blind to rotation and translation, that the forces of a deformed cell turn with it, and that a
cell left alone keeps its momentum. A red cell of 258 vertices, each law alone, turned at random and carried up to 8 um
away; energies and forces are held against those of the same cell stretched by 30 %, for zero must be measured against
something. The round-off of the positions is then worth 10^-13 to 10^-12 of it, most for bending.

Flight: a stretched cell with mass of its own, spinning and drifting, 200 steps of 0.5 us. Linear momentum stays to
round-off by construction. Implicit Euler does not keep angular momentum, L_{n+1} - L_n = d sum(m v_{n+1} x v_n): what
it loses must be of first order in the step (validation by the order, not by a bound), and of BDF2 of second order. The
lineage's damping (Calpha) removes velocity that is not that of a rigid body; it must take no momentum of either kind:
steps of its method with and without are compared. Weakness: the lineage laws without an energy are left out.
"""
import numpy

import npfem
from npfem.validation import Case
from npfem.validation.membranes import evans_fung, material, order, random_rotation, single_cell, unit_sphere

CASE = Case(id="S3", title="Rigid motion and free flight", tier="ci", cost_s=2, source="objectivity; Newton's laws")

LAWS = {
    "skalak": {"membrane_law": "skalak", "shear_modulus": 2.5, "skalak_C": 10},
    "neo_hookean": {"membrane_law": "neo_hookean", "shear_modulus": 2.5},
    "yeoh": {"membrane_law": "yeoh", "shear_modulus": 2.5, "yeoh_c3": 0.25},
    "wlc": {"membrane_law": "wlc", "shear_modulus": 2.5},
    "local area": {"local_area_form": "smooth", "local_area_modulus": 100},
    "global area": {"global_area_modulus": 2500},
    "global volume": {"global_volume_modulus": 2000},
    "dihedral": {"bending_law": "dihedral", "bending_modulus": 0.3},
    "juelicher": {"bending_law": "juelicher", "bending_modulus": 0.3},
    "cotangent": {"bending_law": "cotangent", "bending_modulus": 0.3},
    "lineage bending": {"bending_law": "lineage", "lineage_bending_weight": 0.1},
}


def objectivity(report, name, parameters, shape, triangles):
    """A turned cell at rest; a turned cell that is stretched."""
    generator = numpy.random.default_rng(3)
    batch = single_cell(shape, triangles, **parameters)

    def evaluate(positions):
        batch.position = positions
        batch.evaluate()
        return batch.measure("energy")[0], batch.elastic_force[0]

    stretched = shape * [1.3, 1.0, 1.15]
    energy, force = evaluate(stretched)
    largest = abs(force).max()
    at_rest = turned = 0.0
    for _ in range(5):
        turn, shift = random_rotation(generator), generator.uniform(-5, 5, 3)
        rest_energy, rest_force = evaluate(shape @ turn.T + shift)
        at_rest = max(at_rest, abs(rest_energy / energy), abs(rest_force).max() / largest)
        turned_energy, turned_force = evaluate(stretched @ turn.T + shift)
        turned = max(turned, abs(turned_energy / energy - 1), abs(turned_force - force @ turn.T).max() / largest)
    report.below("%s: energy and force of a turned cell at rest" % name, at_rest, 1e-12)
    report.below("%s: change of energy and force of a stretched cell as it turns" % name, turned, 1e-12)


def tumble(x):
    """Velocities of a cell that spins, drifts and stretches, um/us."""
    return numpy.cross([0.02, -0.01, 0.03], x) + [0.1, 0.2, -0.05] + 0.01 * x * [1, -1, 0]


class Flight:
    """A stretched, spinning, drifting red cell with mass; momenta relative to the centre."""

    def __init__(self, **options):
        with npfem.Material.preset("rbc") as cell:
            cell.update(membrane_density=500.0, stress_free_reduced_volume=0.0)
            with cell.mesh(2) as mesh, npfem.Model(mesh, cell) as model:
                self.batch = npfem.Batch(model)
                self.mass = model.get("solid_mass")[:, None]
        self.batch["tolerance"] = 1e-7
        for key, value in options.items():
            self.batch[key] = value
        x = self.batch.position[0] * [1.05, 1.0, 0.97]
        self.batch.position = x
        self.batch.velocity = tumble(x)

    def momenta(self):
        """Linear and angular momentum, fg um/us and fg um2/us."""
        x, p = self.batch.position[0], self.mass * self.batch.velocity[0]
        middle = (self.mass * x).sum(axis=0) / self.mass.sum()
        return p.sum(axis=0), numpy.cross(x - middle, p).sum(axis=0)

    def fly(self, duration_us, step_us):
        """Relative changes of linear and angular momentum."""
        self.batch["time_step"] = step_us
        linear, angular = self.momenta()
        if self.batch.step(round(duration_us / step_us)):
            raise RuntimeError(self.batch.status_text(0))
        later_linear, later_angular = self.momenta()
        norm = numpy.linalg.norm
        return norm(later_linear - linear) / norm(linear), norm(later_angular - angular) / norm(angular)


def lineage_damping(report):
    """What Calpha takes in one step: momenta with it against those without, at the positions where it acts."""
    momenta = []
    for alpha in (0.0, 0.9):
        with material(membrane_density=5.0, global_area_modulus=1e-9) as membrane, \
                npfem.Mesh.generate("rbc", 2) as mesh, npfem.Model(mesh, membrane) as model, \
                npfem.Batch(model) as batch:
            x, mass = batch.position[0], model.get("solid_mass")[:, None]
            batch.velocity = tumble(x)
            batch.update(method="lineage", lineage_alpha=alpha, time_step=0.25)
            batch.step()
            # Without damping the step ends where the damping of the other one acts.
            acts = batch.position[0] if alpha == 0.0 else acts
            momenta.append((mass * batch.velocity[0], numpy.cross(acts, mass * batch.velocity[0])))
    for index, name in enumerate(("linear", "angular")):
        without, damped = (pair[index].sum(axis=0) for pair in momenta)
        report.below("damping Calpha 0.9 of the lineage: relative change of the %s momentum in a step" % name,
                     numpy.linalg.norm(damped - without) / numpy.linalg.norm(without), 1e-10)


def run(report):
    """All laws, then flights."""
    sphere, triangles = unit_sphere("sphere", 3)
    shape = evans_fung(sphere)
    for name, parameters in LAWS.items():
        objectivity(report, name, parameters, shape, triangles)
    steps = (0.5, 0.25, 0.125)
    for integrator, name, expected in ((0, "implicit Euler", 1), (1, "BDF2", 2)):
        drifts = [Flight(integrator=integrator).fly(25.0, step) for step in steps]
        report.below("%s: relative change of the linear momentum, largest of three runs" % name,
                     max(linear for linear, _ in drifts), 1e-12)
        report.measured("%s: relative change of the angular momentum in 25 us, step 0.5 us" % name, drifts[0][1])
        report.measured("%s: the same, step 0.125 us" % name, drifts[-1][1])
        report.compare("%s: order of the change of angular momentum" % name,
                       order(steps, [angular for _, angular in drifts]), expected, absolute=0.2)
    lineage_damping(report)
