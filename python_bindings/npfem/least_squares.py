# SPDX-License-Identifier: MPL-2.0
"""Nonlinear least squares with bounds (Levenberg, Marquardt), and what its result is worth. Needs numpy."""
import math
import statistics

import numpy

_STEP = 0.03  # of the central differences; the coordinates are logarithms
_MOST_ITERATIONS = 30
_SMALLEST_STEP = 1e-3


def jacobian(residuals, x):
    """d residuals / d x, by central differences."""
    columns = []
    for index in range(len(x)):
        shift = numpy.zeros(len(x))
        shift[index] = _STEP
        columns.append((residuals(x + shift) - residuals(x - shift)) / (2.0 * _STEP))
    return numpy.array(columns).T


def _downhill(residuals, x, present, slopes, damping, bounds):
    """(x, residuals, damping) of a step that lowers the sum of squares, or x itself where none does."""
    low, high = bounds
    gradient = slopes.T @ present
    free = ~(((x <= low) & (gradient > 0)) | ((x >= high) & (gradient < 0)))
    while damping < 1e6 and free.any():
        normal = slopes[:, free].T @ slopes[:, free]
        normal[numpy.diag_indices_from(normal)] *= 1.0 + damping
        step = numpy.zeros(len(x))
        # pinv and not solve: data that say nothing about a parameter leave it where it is.
        step[free] = -numpy.linalg.pinv(normal) @ gradient[free]
        trial = numpy.clip(x + numpy.clip(step, -0.7, 0.7), low, high)
        try:
            found = residuals(trial)
        except ArithmeticError:  # no equilibrium there: too far
            found = None
        if found is not None and found @ found < present @ present:
            return trial, found, 0.1 * damping
        if abs(trial - x).max() < 0.1 * _SMALLEST_STEP:
            break
        damping *= 10.0
    return x, present, damping


def minimise(residuals, x, low, high, say=lambda iteration, x, residuals: None):
    """(x, residuals, jacobian, iterations, converged) at the least sum of squares within [low, high]."""
    x = numpy.clip(numpy.array(x, float), low, high)
    present, damping = residuals(x), 1e-3
    for iteration in range(1, _MOST_ITERATIONS + 1):
        slopes = jacobian(residuals, x)
        after, found, damping = _downhill(residuals, x, present, slopes, damping, (low, high))
        moved, gain = abs(after - x).max(), present @ present - found @ found
        x, present = after, found
        say(iteration, x, present)
        if moved < _SMALLEST_STEP or gain <= 1e-4 * (present @ present):
            if moved > 0.0:
                slopes = jacobian(residuals, x)
            return x, present, slopes, iteration, True
    return x, present, jacobian(residuals, x), _MOST_ITERATIONS, False


def covariance(residuals, slopes):
    """Of the coordinates, from the slopes and the variance of the residuals; infinite where the data say nothing.

    As many numbers as unknowns leave no residuals: their variance is then taken to be 1, that of the weights.
    """
    count, unknowns = slopes.shape
    freedom = count - unknowns
    left, sizes, right = numpy.linalg.svd(slopes, full_matrices=False)
    with numpy.errstate(divide="ignore", invalid="ignore"):
        inverse = numpy.where(sizes > 1e-9 * max(sizes.max(), 1e-300), 1.0 / sizes**2, numpy.inf)
        parts = numpy.where(right == 0.0, 0.0, inverse[:, None] * right**2)
    found = (right.T * numpy.where(numpy.isfinite(inverse), inverse, 0.0)) @ right
    found[numpy.diag_indices(unknowns)] = parts.sum(axis=0)
    return found * ((residuals @ residuals) / freedom if freedom else 1.0)


def correlation(covariances):
    """The matrix of correlations; 0 where a variance is infinite or zero."""
    spread = numpy.sqrt(numpy.diag(covariances))
    known = numpy.isfinite(spread) & (spread > 0)
    out = numpy.eye(len(spread))
    for i in range(len(spread)):
        for j in range(len(spread)):
            if i != j:
                out[i, j] = covariances[i, j] / (spread[i] * spread[j]) if known[i] and known[j] else 0.0
    return out


def student_t(freedom, probability=0.95):
    """The t within which Student's distribution holds this probability: Simpson's rule, and bisection."""
    if freedom == 0:  # the variance is then not estimated, and the distribution normal
        return statistics.NormalDist().inv_cdf(0.5 + 0.5 * probability)
    scale = math.exp(math.lgamma(0.5 * (freedom + 1)) - math.lgamma(0.5 * freedom)) / math.sqrt(freedom * math.pi)

    def inside(t):
        # In the angle atan(t/sqrt(freedom)) the density is a power of the cosine: smooth and bounded.
        angle, pieces = math.atan(t / math.sqrt(freedom)), 200
        values = [math.cos(angle * k / pieces) ** (freedom - 1) for k in range(pieces + 1)]
        total = values[0] + values[-1] + 4 * sum(values[1:-1:2]) + 2 * sum(values[2:-1:2])
        return 2 * scale * math.sqrt(freedom) * total * angle / pieces / 3

    low, high = 0.0, 1000.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if inside(middle) < probability else (low, middle)
    return 0.5 * (low + high)
