# SPDX-License-Identifier: MPL-2.0
"""A red cell pulled to twice its width and let go: how long its membrane takes to recover.

The membrane's viscosity against its elasticity sets the time, t_c of about eta_s/G_s; the fluid is left out, as the
membrane dissipates far more. Measured by R. M. Hochmuth, P. R. Worthy, E. A. Evans, "Red cell extensional recovery and
the determination of membrane viscosity", Biophys. J. 26 (1979) 101-114, who pulled cells by their rims to about L/W = 2
and fitted the law of fit() below.
"""
import math

from .batch import Batch
from .material import Material
from .model import Model
from .tweezers import CONTACT_DIAMETER_UM, add_beads, contact_vertices, flat_numbers, pull_beads

# Cells 1 and 2 of fig. 5: time (s), length over width; digitised, reading error about 1 %.
HOCHMUTH_1979 = (
    ((.0005, 2.005), (.012, 1.896), (.032, 1.732), (.047, 1.597), (.065, 1.525), (.081, 1.428), (.099, 1.396),
     (.132, 1.342), (.149, 1.310), (.184, 1.247), (.201, 1.241), (.249, 1.184), (.300, 1.157), (.350, 1.130),
     (.397, 1.112)),
    ((.002, 2.190), (.018, 1.969), (.034, 1.840), (.049, 1.741), (.067, 1.669), (.084, 1.590), (.100, 1.520),
     (.134, 1.452), (.151, 1.412), (.184, 1.381), (.201, 1.356), (.251, 1.291), (.303, 1.246), (.350, 1.249),
     (.401, 1.218)),
)
HOCHMUTH_1979_TIME_S = 0.13  # mean of four cells; cells 1 and 2 have 0.110 and 0.105 s

STRETCHED_RATIO = 2.0
STEP_MS = 10.0
EULER, BDF2 = 0, 1
DURATION_S = 0.6

# Without fluid nothing but mass resists a turn of the whole cell: light enough to leave inertia aside (its share of the
# stress is 1e-5), heavy enough that the solver's residual forces do not turn the cell out of the axes of measurement.
_DENSITY_FG_PER_UM2 = 1e4
# The elastic forces that drive the last of the recovery are smaller than the default tolerance.
_TOLERANCE_PN = 1e-8
_LARGEST_FORCE_PN = 1000.0


def _ratio(batch):
    """Length over width."""
    return float(batch.measure("extent_x")[0]) / float(batch.measure("extent_y")[0])


def _relax(batch):
    if batch.relax():
        raise ArithmeticError("the cell finds no rest: " + batch.status_text(0))


def _pull_to(batch, sides, wanted):
    """Leaves the cell at rest under the force that gives it the ratio `wanted`, within 1e-4."""
    add_beads(batch, sides)
    low, high, force_pN = 0.0, None, 25.0
    while True:
        pull_beads(batch, sides, force_pN)
        _relax(batch)
        ratio = _ratio(batch)
        if abs(ratio - wanted) < 1e-4 or (high is not None and high - low < 1e-6 * high):
            break
        if ratio < wanted:
            low = force_pN
        else:
            high = force_pN
        if low > _LARGEST_FORCE_PN:
            raise ArithmeticError("%g pN do not pull the cell to a ratio of length to width of %g" % (low, wanted))
        force_pN = 2.0 * low if high is None else 0.5 * (low + high)
    batch.external_force = [0.0] * (3 * batch.vertex_count)
    batch.clear_patches()


def _cell(material, level, contact_diameter_um):
    """(batch at rest without load, vertices of the two contacts)."""
    with Material.parse(material.to_text()) as own:
        if own["membrane_density"] < _DENSITY_FG_PER_UM2:
            own["membrane_density"] = _DENSITY_FG_PER_UM2
        with own.mesh(level) as mesh, Model(mesh, own) as model:
            batch = Batch(model)
            _relax(batch)
            return batch, contact_vertices(mesh.positions, contact_diameter_um)


def stretched(material, level=-1, ratio=STRETCHED_RATIO, contact_diameter_um=CONTACT_DIAMETER_UM):
    """Vertices (x y z x y z ..., um) of the cell at rest, pulled along x by rigid contacts to this ratio of extents."""
    batch, sides = _cell(material, level, contact_diameter_um)
    with batch:
        _pull_to(batch, sides, ratio)
        return flat_numbers(batch.get("position", 0, 1))


def recover(material, level=-1, ratio=STRETCHED_RATIO, step_ms=STEP_MS, duration_s=DURATION_S, integrator=BDF2):
    """(times in s, length over width at each, that of the cell at rest): the stretched cell let go, without fluid.

    `material`: a `Material` with a membrane_shear_viscosity; it is not changed. The error of t_c
    by BDF2 is 0.5 % at steps of 10 ms and 2 % at 20 ms; by implicit Euler 2.4 % at 5 ms.
    """
    if not (math.isfinite(ratio) and ratio > 1.0):
        raise ValueError("the ratio of length to width must be finite and above 1, found %g" % ratio)
    if not (math.isfinite(duration_s) and 0.0 < step_ms <= 1e3 * duration_s):
        raise ValueError("a step above 0 and a duration no shorter are needed, found %g ms and %g s"
                         % (step_ms, duration_s))
    if material["membrane_shear_viscosity"] <= 0.0:
        raise ValueError("the material has no membrane_shear_viscosity: nothing resists the recovery")
    batch, sides = _cell(material, level, CONTACT_DIAMETER_UM)
    with batch:
        at_rest = _ratio(batch)
        _pull_to(batch, sides, ratio)
        batch.update(time_step=1e3 * step_ms, integrator=integrator, tolerance=_TOLERANCE_PN)
        times, ratios = [0.0], [_ratio(batch)]
        for step in range(1, round(1e3 * duration_s / step_ms) + 1):
            if batch.step():
                raise ArithmeticError("%g s after the release: %s" % (times[-1], batch.status_text(0)))
            times.append(1e-3 * step_ms * step)
            ratios.append(_ratio(batch))
    return times, ratios, at_rest


def law(time_s, time_constant_s, start, end):
    """L/W = end (K + e)/(K - e), e = exp(-t/t_c), K = (start + end)/(start - end): Hochmuth et al., eq. 10."""
    k, decay = (start + end) / (start - end), math.exp(-time_s / time_constant_s)
    return end * (k + decay) / (k - decay)


def _least(function, low, high):
    """Where the function of one variable is least between the two: golden section."""
    golden = 0.5 * (math.sqrt(5.0) - 1.0)
    while high - low > 1e-7 * high:
        a, b = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, b) if function(a) < function(b) else (a, high)
    return 0.5 * (low + high)


def _misfit(times, ratios, time_constant_s, end):
    return math.fsum((law(time - times[0], time_constant_s, ratios[0], end) - ratio) ** 2
                     for time, ratio in zip(times, ratios))


def fit(times, ratios, ratio_at_rest):
    """t_c (s) of the law nearest to the curve (least squares), which starts at the first point and ends at rest."""
    span = times[-1] - times[0]
    return _least(lambda time_constant: _misfit(times, ratios, time_constant, ratio_at_rest), 1e-3 * span, 10 * span)


def fit_with_end(times, ratios):
    """(t_c in s, last ratio) of the law nearest to a measured curve, which need not end where a perfect cell does."""
    least, largest = 0.8 * min(ratios), min(1.1 * min(ratios), 0.5 * (min(ratios) + ratios[0]))
    end = _least(lambda last: _misfit(times, ratios, fit(times, ratios, last), last), least, largest)
    return fit(times, ratios, end), end
