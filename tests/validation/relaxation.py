# SPDX-License-Identifier: MPL-2.0
"""A stretched red cell let go: the time constant of its recovery.

Proves the viscosity of the membrane. The shipped `rbc` is stretched by two rigid contacts to a ratio of length to width
of 2, let go, and followed for 0.6 s; the fluid is left out, as the membrane dissipates far more. The law of Hochmuth et
al. is fitted, L/W = r (K + exp(-t/t_c))/(K - exp(-t/t_c)), K = (L0/W0 + r)/(L0/W0 - r), with r the ratio of the cell at
rest. Where the material states no viscosity of its membrane, 0.5 uN s/m is taken, inside the band of 0.3 to 0.7; which it
was is the first number below.

Reference: t_c of single cells, 0.08 to 0.18 s around a mean of 0.13 s; cells 1 and 2 (0.110 and 0.105 s) are drawn.
Convergence in time: implicit Euler at 10 and 5 ms within 5 % of 2.5 ms, and BDF2 at 5 ms. Weakness:
the measured cells stop at a ratio of 1.11 and 1.23 where a perfect one ends near 1.0; that is not in this model.
"""
import math

import numpy

import npfem
from npfem.tweezers import contact_vertices
from npfem.validation import Case

CASE = Case(id="S13", title="Recovery of a stretched red cell", tier="nightly", cost_s=30,
            source="Hochmuth, Worthy & Evans, Biophys. J. 26 (1979) 101, fig. 5 (digitised)")

VISCOSITY = 0.5e6  # pN us/um, 0.5 uN s/m: where the material states none
# Without fluid nothing but mass resists a turn of the whole cell: light enough to leave inertia aside (its share of the
# stress is 1e-5), heavy enough that the solver's residual forces do not turn the cell out of the axes it is measured in.
DENSITY = 1e4  # fg/um2
RESIDUAL_PN = 1e-8
# Time (s) and length over width of two cells.
HOCHMUTH_1 = ((.0005, 2.005), (.012, 1.896), (.032, 1.732), (.047, 1.597), (.065, 1.525), (.081, 1.428), (.099, 1.396),
              (.132, 1.342), (.149, 1.310), (.184, 1.247), (.201, 1.241), (.249, 1.184), (.300, 1.157), (.350, 1.130),
              (.397, 1.112))
HOCHMUTH_2 = ((.002, 2.190), (.018, 1.969), (.034, 1.840), (.049, 1.741), (.067, 1.669), (.084, 1.590), (.100, 1.520),
              (.134, 1.452), (.151, 1.412), (.184, 1.381), (.201, 1.356), (.251, 1.291), (.303, 1.246), (.350, 1.249),
              (.401, 1.218))


def red_cell(level):
    """(batch, vertices of the two contacts, viscosity): the shipped cell, with viscosity and next to no mass."""
    with npfem.Material.preset("rbc") as cell:
        if cell["membrane_shear_viscosity"] == 0.0:
            cell["membrane_shear_viscosity"] = VISCOSITY
        cell["membrane_density"] = DENSITY
        with cell.mesh(level) as mesh, npfem.Model(mesh, cell) as model:
            return npfem.Batch(model), contact_vertices(mesh.positions), cell["membrane_shear_viscosity"]


def ratio(batch):
    """Length over width."""
    return batch.measure("extent_x")[0] / batch.measure("extent_y")[0]


def stretched(level):
    """(batch, ratio at rest, viscosity): a cell at rest under the force that makes its ratio 2."""
    batch, sides, viscosity = red_cell(level)
    batch.relax()
    at_rest = ratio(batch)
    for side in sides:
        batch.add_patch(side, 1000.0)
    low, high = 0.0, 100.0
    while high - low > 0.05:
        force_pN = 0.5 * (low + high)
        force = numpy.zeros((batch.vertex_count, 3))
        for side, sign in zip(sides, (-1, 1)):
            force[side, 0] = sign * force_pN / len(side)
        batch.external_force = force
        if batch.relax():
            raise RuntimeError(batch.status_text(0))
        low, high = (force_pN, high) if ratio(batch) < 2 else (low, force_pN)
    batch.external_force = 0.0 * force
    batch.clear_patches()
    return batch, at_rest, viscosity


def recover(step_us, integrator, level=3):
    """(times in s, ratios, t_c in s, viscosity): the cell let go."""
    batch, at_rest, viscosity = stretched(level)
    batch.update(time_step=step_us, integrator=integrator, tolerance=RESIDUAL_PN)
    times, ratios = [0.0], [ratio(batch)]
    while times[-1] < 0.6 - 1e-9:
        if batch.step():
            raise RuntimeError(batch.status_text(0))
        times.append(times[-1] + step_us / 1e6)
        ratios.append(ratio(batch))
    return times, ratios, hochmuth_time(times, ratios, at_rest), viscosity


def hochmuth_time(times, ratios, at_rest):
    """t_c of the law that is nearest to the curve, by least squares, the start as it was."""
    times, ratios = numpy.array(times), numpy.array(ratios)
    k = (ratios[0] + at_rest) / (ratios[0] - at_rest)

    def misfit(time):
        decay = numpy.exp(-times / time)
        return ((at_rest * (k + decay) / (k - decay) - ratios) ** 2).sum()

    low, high, golden = 0.01, 1.0, (math.sqrt(5) - 1) / 2
    while high - low > 1e-6:
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if misfit(a) < misfit(b) else (a, high)
    return 0.5 * (low + high)


def run(report):
    """The curve, and its convergence in time."""
    plot = report.plot("Recovery of a stretched red cell", "time (s)", "length / width")
    for name, points in (("cell 1", HOCHMUTH_1), ("cell 2", HOCHMUTH_2)):
        report.curve(plot, name + ", Hochmuth et al. 1979", *zip(*points), points=True)
    with npfem.Material.preset("rbc") as shipped:
        report.measured("membrane viscosity of the shipped rbc", shipped["membrane_shear_viscosity"] / 1e6, unit="uN s/m")
    found = {step: recover(step, 0) for step in (10e3, 5e3, 2.5e3)}
    times, ratios, fine, viscosity = found[2.5e3]
    report.measured("membrane viscosity used", viscosity / 1e6, unit="uN s/m")
    report.within("t_c, step 2.5 ms", fine, 0.08, 0.18, unit="s")
    for step in (10e3, 5e3):
        report.compare("t_c at a step of %g ms against 2.5 ms" % (step / 1e3), found[step][2], fine, relative=0.05,
                       unit="s")
    report.compare("t_c of BDF2 at a step of 5 ms against implicit Euler at 2.5 ms", recover(5e3, 1)[2], fine,
                   relative=0.05, unit="s")
    decay = numpy.interp([t for t, _ in HOCHMUTH_1], times, ratios) - [r for _, r in HOCHMUTH_1]
    report.measured("rms departure of L/W from cell 1", math.sqrt((decay**2).mean()))
    report.measured("ratio after 0.6 s", ratios[-1])
    report.curve(plot, "rbc, %g uN s/m" % (viscosity / 1e6), times, ratios)
