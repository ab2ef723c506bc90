# SPDX-License-Identifier: MPL-2.0
"""Parameters of a material from measured cells: weighted least squares, and what the data can and cannot tell.

Minimised is the sum of squares of ((computed/measured - 1)/w) over all diameters, w = 3 % axially and 5 % across (the
wider scatter of the cells), and of ln(computed/measured)/w over the times of recovery, w = 20 % per cell (the scatter
between cells) over the square root of the number of cells. The parameters enter by their logarithms, so that none turns
negative and an interval of confidence is a factor. The intervals come from the slopes at the best values and the
variance of what is left: they hold for this model, contact and mesh, and know nothing of what those do wrong.
"""
import collections
import math

from . import literature, recovery, tweezers
from .least_squares import correlation, covariance, minimise, student_t
from .material import Material

AXIAL_WEIGHT, TRANSVERSE_WEIGHT, RECOVERY_WEIGHT = 0.03, 0.05, 0.2
_STRONG_CORRELATION = 0.95
# The interval of a parameter without a band that counts as unknown: its ends differ by this factor.
_WIDE_FACTOR = 2.0
_RECOVERY_STEP_MS = 20.0
_LEAST_HELD = 3

# How the cell is pulled, and on which mesh.
Setup = collections.namedtuple("Setup", "level load contact_diameter_um")
# What was measured: points (force_pN, axial_um, transverse_um), and (t_c in s, number of cells) of each recovery.
Measured = collections.namedtuple("Measured", "points recoveries")


def check_free(material, free, measured):
    """Raises ValueError where a parameter is not known, not used by the material or not touched by the data."""
    for key in free:
        if key not in literature.PARAMETERS:
            raise ValueError('--free: no parameter "%s" can be fitted; allowed: %s'
                             % (key, ", ".join(literature.PARAMETERS)))
        known = literature.PARAMETERS[key]
        if known.laws and material[known.law_key] not in known.laws:
            raise ValueError("--free: %s acts with %s = %s, this material has %s"
                             % (key, known.law_key, " or ".join(known.laws), material[known.law_key]))
    if not free or len(set(free)) != len(free):
        raise ValueError("--free: each parameter once, and at least one, is needed")
    fits_time = literature.FITTED_BY_RECOVERY in free
    if fits_time and not measured.recoveries:
        raise ValueError("--free: a cell at rest says nothing about %s; give --relaxation"
                         % literature.FITTED_BY_RECOVERY)
    if measured.recoveries and not fits_time and material[literature.FITTED_BY_RECOVERY] == 0.0:
        raise ValueError("--relaxation: the material has no %s; name it in --free" % literature.FITTED_BY_RECOVERY)
    count = 2 * len(measured.points) + len(measured.recoveries)
    if measured.points and count <= len(free):
        raise ValueError("%d numbers measured and %d parameters free: more data or fewer parameters are needed"
                         % (count, len(free)))
    if not measured.points and list(free) != [literature.FITTED_BY_RECOVERY]:
        raise ValueError("without points of stretching only %s can be fitted" % literature.FITTED_BY_RECOVERY)


def contact_on(mesh, contact_diameter_um):
    """(vertices, area in um2) that the contact holds on one side. ValueError where it is no disc on this mesh."""
    left, right = tweezers.contact_vertices(mesh.positions, contact_diameter_um)
    held = "%d of %d vertices on a side" % (min(len(left), len(right)), mesh.vertex_count)
    if min(len(left), len(right)) < _LEAST_HELD:
        raise ValueError("--contact %g: holds %s, %d at least are needed: use a wider contact or a finer mesh (--level)"
                         % (contact_diameter_um, held, _LEAST_HELD))
    width = float(mesh.positions[:, 1].max() - mesh.positions[:, 1].min())
    if contact_diameter_um >= width:
        raise ValueError("--contact %g: reaches over the whole cell, %.3g um wide, and holds %s: use a narrower one"
                         % (contact_diameter_um, width, held))
    return len(left), tweezers.held_area(mesh.positions, mesh.triangles, left)


def starting_value(material, key):
    """The material's own value (in the unit of the parameter), or a usual one where it has none; inside the search."""
    known = literature.PARAMETERS[key]
    value = material[key] / known.scale
    return min(max(value, known.least), known.largest) if value > 0.0 else known.start


class Experiment:
    """The experiments on the computer, at given values of the free parameters."""

    def __init__(self, material, free, measured, setup):
        self.material = Material.parse(material.to_text())
        self.free = list(free)
        self.measured = measured
        self.setup = setup
        self._times = {}

    def values(self, x):
        """{key: value in its unit} at the coordinates x."""
        return {key: literature.from_coordinate(key, float(coordinate)) for key, coordinate in zip(self.free, x)}

    def apply(self, x):
        """Gives the material the values at x."""
        for key, value in self.values(x).items():
            self.material[key] = value * literature.PARAMETERS[key].scale

    def rows(self, x):
        """The rows of stretch() at the measured forces."""
        if not self.measured.points:
            return []
        self.apply(x)
        rows = tweezers.stretch(self.material, [point[0] for point in self.measured.points], self.setup.level,
                                self.setup.load, self.setup.contact_diameter_um)
        if not rows[-1]["usable"]:
            raise ArithmeticError("no equilibrium found under %g pN: %s" % (rows[-1]["force_pN"], rows[-1]["message"]))
        return rows

    def recovery_time(self, x):
        """t_c (s). It is proportional to the viscosity, so each set of other parameters is computed once."""
        self.apply(x)
        viscosity = self.material[literature.FITTED_BY_RECOVERY]
        usual = literature.PARAMETERS[literature.FITTED_BY_RECOVERY]
        others = tuple(float(v) for key, v in zip(self.free, x) if key != literature.FITTED_BY_RECOVERY)
        if others not in self._times:
            self.material[literature.FITTED_BY_RECOVERY] = usual.start * usual.scale
            curve = recovery.recover(self.material, self.setup.level, step_ms=_RECOVERY_STEP_MS)
            self._times[others] = recovery.fit(*curve)
            self.material[literature.FITTED_BY_RECOVERY] = viscosity
        return self._times[others] * viscosity / (usual.start * usual.scale)

    def residuals(self, x):
        """Weighted departures: axial, transverse of each point, then each recovery."""
        import numpy

        by_force = {row["force_pN"]: row for row in self.rows(x)}
        out = []
        for force, axial, transverse in self.measured.points:
            out.append((by_force[force]["axial_um"] / axial - 1.0) / AXIAL_WEIGHT)
            out.append((by_force[force]["transverse_um"] / transverse - 1.0) / TRANSVERSE_WEIGHT)
        for time_s, cells in self.measured.recoveries:
            out.append(math.log(self.recovery_time(x) / time_s) * math.sqrt(cells) / RECOVERY_WEIGHT)
        return numpy.array(out)


def _rms(values, weight):
    return weight * math.sqrt(math.fsum(float(v) ** 2 for v in values) / len(values)) if len(values) else None


def _interval(key, coordinate, half_width):
    def value(at):
        return literature.from_coordinate(key, min(max(at, -30.0), 30.0))

    return sorted((value(coordinate - half_width), value(coordinate + half_width)))


def _width(key, low, high):
    """Of an interval, in the coordinate that is fitted: the logarithm of a factor."""
    return abs(literature.to_coordinate(key, high) - literature.to_coordinate(key, low))


def _verdict(key, row, law):
    """Adds band, inside_band, identified and why_not to the row of a parameter."""
    band = literature.band_of(key, law)
    reasons = []
    if row["at_bound"]:
        reasons.append("it stands at the end of the search, %g %s" % (row["value"], row["unit"]))
    elif band and _width(key, row["low"], row["high"]) > _width(key, *band):
        reasons.append("its interval is wider than the literature's band")
    elif not band and row["high"] > _WIDE_FACTOR * row["low"]:
        reasons.append("the ends of its interval differ by more than a factor of %g" % _WIDE_FACTOR)
    for other, value in row["correlations"].items():
        if other != key and abs(value) > _STRONG_CORRELATION:
            reasons.append("it goes with %s (correlation %.3f)" % (other, value))
    row.update(band=band, inside_band=None if band is None else band[0] <= row["value"] <= band[1],
               identified=not reasons, why_not="; ".join(reasons))


def _parameter_rows(experiment, x, residuals, slopes):
    covariances = covariance(residuals, slopes)
    correlations = correlation(covariances)
    factor = student_t(len(residuals) - len(x))
    values, rows = experiment.values(x), []
    for index, key in enumerate(experiment.free):
        known, value = literature.PARAMETERS[key], values[key]
        low, high = _interval(key, float(x[index]), factor * math.sqrt(covariances[index, index]))
        row = {"key": key, "unit": known.unit, "value": value, "low": low, "high": high,
               "at_bound": min(abs(value / known.least - 1), abs(value / known.largest - 1)) < 1e-6,
               "correlations": dict(zip(experiment.free, (float(v) for v in correlations[index])))}
        _verdict(key, row, experiment.material["membrane_law"])
        rows.append(row)
    return rows


def _sensitivities(experiment, x, slopes):
    """d ln D / d ln p at each measured point, as [{"force_pN", parameter: (axial, transverse)}]."""
    scales = [literature.coordinate_slope(key, value) for key, value in experiment.values(x).items()]
    out = []
    for index, (force, _, _) in enumerate(experiment.measured.points):
        row = {"force_pN": force}
        for column, key in enumerate(experiment.free):
            row[key] = (float(AXIAL_WEIGHT * slopes[2 * index, column] * scales[column]),
                        float(TRANSVERSE_WEIGHT * slopes[2 * index + 1, column] * scales[column]))
        out.append(row)
    return out


def fit(material, free, measured, setup, say=lambda iteration, values, sum_of_squares: None):
    """Fits the parameters `free` of the material (not changed) to what was measured.

    Returns a dict: parameters (one dict each: key, unit, value, low, high of the 95 % interval, band, inside_band,
    identified, why_not, at_bound, correlations), sensitivities, rms_axial, rms_transverse, recovery_s, points,
    contact_vertices and contact_area_um2 (of one side), mesh_vertices, iterations, converged, rows (of stretch() at the
    best values) and material (a `Material` with them).
    """
    check_free(material, free, measured)
    experiment = Experiment(material, free, measured, setup)
    with material.mesh(setup.level) as mesh:
        held, area = contact_on(mesh, setup.contact_diameter_um)
        vertices = mesh.vertex_count

    # The logarithm of 1 - v falls with v, so the ends of that search change places.
    ends = [sorted((literature.to_coordinate(key, literature.PARAMETERS[key].least),
                    literature.to_coordinate(key, literature.PARAMETERS[key].largest))) for key in free]
    start = [literature.to_coordinate(key, starting_value(material, key)) for key in free]
    x, residuals, slopes, iterations, converged = minimise(
        experiment.residuals, start, [low for low, _ in ends], [high for _, high in ends],
        lambda iteration, at, left: say(iteration, experiment.values(at), float(left @ left)))
    stretching = residuals[:2 * len(measured.points)]
    rows = experiment.rows(x)
    experiment.apply(x)
    return {
        "parameters": _parameter_rows(experiment, x, residuals, slopes),
        "sensitivities": _sensitivities(experiment, x, slopes),
        "rms_axial": _rms(stretching[0::2], AXIAL_WEIGHT),
        "rms_transverse": _rms(stretching[1::2], TRANSVERSE_WEIGHT),
        "recovery_s": experiment.recovery_time(x) if measured.recoveries else None,
        "points": len(measured.points),
        "contact_vertices": held,
        "contact_area_um2": area,
        "mesh_vertices": vertices,
        "iterations": iterations,
        "converged": converged,
        "rows": rows,
        "material": experiment.material,
    }
