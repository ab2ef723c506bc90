# SPDX-License-Identifier: MPL-2.0
import numpy
import pytest

from npfem.least_squares import correlation, covariance, minimise, student_t

TIMES = numpy.linspace(0.0, 2.0, 12)
WIDE = (numpy.full(2, -5.0), numpy.full(2, 5.0))


def decay(x):
    """Amplitude exp(x0), rate exp(x1)."""
    return numpy.exp(x[0] - numpy.exp(x[1]) * TIMES)


def fit(measured, start=(0.3, -0.4), low=WIDE[0], high=WIDE[1]):
    return minimise(lambda x: decay(x) - measured, start, low, high)


@pytest.mark.parametrize("freedom, expected", [(1, 12.7062), (2, 4.3027), (5, 2.5706), (22, 2.0739), (100, 1.9840)])
def test_students_t(freedom, expected):
    assert student_t(freedom) == pytest.approx(expected, abs=1e-4)


def test_the_normal_distribution_where_nothing_is_left_over():
    assert student_t(0) == pytest.approx(1.95996, abs=1e-4)


def test_exact_data_give_the_parameters_back():
    x, residuals, _, _, converged = fit(decay((0.7, 0.5)))
    assert converged and x == pytest.approx([0.7, 0.5], abs=1e-3)
    assert abs(residuals).max() < 1e-3


def test_intervals_cover_as_often_as_they_say():
    # 300 sets of data with the same noise: 95 % of the intervals hold the truth, give or take three deviations (3.8 %).
    random, truth, covered = numpy.random.default_rng(1), numpy.array([0.7, 0.5]), numpy.zeros(2)
    for _ in range(300):
        x, residuals, slopes, _, _ = fit(decay(truth) + 0.02 * random.standard_normal(len(TIMES)))
        half = student_t(len(TIMES) - 2) * numpy.sqrt(numpy.diag(covariance(residuals, slopes)))
        covered += abs(x - truth) <= half
    assert covered / 300 == pytest.approx(0.95, abs=0.038)


def test_a_parameter_that_does_nothing_is_not_known():
    def residuals(x):
        return decay((x[0], 0.5)) - decay((0.7, 0.5)) + 0.01 * numpy.cos(7.0 * TIMES)

    x, left, slopes, _, converged = minimise(residuals, (0.3, 1.0), *WIDE)
    spread = covariance(left, slopes)
    assert converged and x[0] == pytest.approx(0.7, abs=0.01) and x[1] == 1.0
    assert numpy.isfinite(spread[0, 0]) and spread[1, 1] == numpy.inf
    assert (correlation(spread) == numpy.eye(2)).all()


def test_two_parameters_that_act_alike_are_told():
    def residuals(x):
        nearly_alike = decay((x[0] + x[1], 0.5)) * (1.0 + 1e-3 * x[1] * TIMES)
        return nearly_alike - decay((0.7, 0.5)) + 0.01 * numpy.cos(7.0 * TIMES)

    _, left, slopes, _, _ = minimise(residuals, (0.3, 0.1), *WIDE)
    found = covariance(left, slopes)
    assert correlation(found)[0, 1] < -0.99
    assert numpy.sqrt(numpy.diag(found)).min() > 1.0


def test_the_search_stays_within_its_bounds():
    x, _, _, _, converged = fit(decay((0.7, 0.5)), high=numpy.array([5.0, 0.2]))
    assert converged and x[1] == 0.2 and x[0] < 0.7


def test_a_step_into_the_impossible_is_shortened():
    def residuals(x):
        if x[0] > 1.5:
            raise ArithmeticError("no equilibrium")
        return decay(x) - decay((1.2, 0.5))

    assert minimise(residuals, (-1.0, 1.5), *WIDE)[0] == pytest.approx([1.2, 0.5], abs=1e-2)
