#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests intervals of fits with robust losses, against the formulas of M-estimation written in NumPy and against the
truth in 2000 synthetic data sets."""
import unittest

import latsch
import numpy as np
import python_testing  # noqa: F401
import scipy.optimize
import scipy.stats

SETS = 2000
# coverage of 95 % intervals; its standard deviation over 2000 sets is 0.5 %, and intervals that use the larger of two
# estimates cover more
NEAR = (0.93, 0.98)


def psi_of(loss, x, c):
    """Returns psi and psi', the derivatives of the loss [Huber, Robust Statistics, 1981]."""
    if loss == "huber":
        return np.clip(x, -c, c), (np.abs(x) <= c) * 1.0
    z = (x / c) ** 2
    return x / (1 + z), (1 - z) / (1 + z) ** 2


def common_covariance(loss, x, X, c):
    """Returns the covariance matrix according to equation (6.5) in section 7.6 of Huber's book: K^2 sum psi^2 / (N -
    n) / mean(psi')^2 (X'X)^-1."""
    psi, slope = psi_of(loss, x, c)
    N, n = X.shape
    factor = 1 + n / N * slope.var() / slope.mean() ** 2
    return factor ** 2 * np.sum(psi ** 2) / (N - n) / slope.mean() ** 2 * np.linalg.inv(X.T @ X)


def own_covariance(loss, x, X, c):
    """Returns the covariance A^-1 B A^-1. A uses psi' of every value; B uses the variance of the values within the
    scale of the loss, and psi itself beyond it."""
    psi, slope = psi_of(loss, x, c)
    inside = np.abs(x) <= c
    G = (slope[:, None] * X)[inside]
    left = psi[inside] - G @ np.linalg.lstsq(G, psi[inside], rcond=None)[0]
    squares = np.where(inside, left @ left / (inside.sum() - X.shape[1]), psi ** 2)
    A = np.linalg.inv(X.T @ (slope[:, None] * X))
    return A @ (X.T @ (squares[:, None] * X)) @ A


def larger(a, b):
    L = np.linalg.cholesky(a)
    values, Q = np.linalg.eigh(np.linalg.solve(L, np.linalg.solve(L, b).T))
    return L @ Q @ np.diag(np.maximum(values, 1)) @ Q.T @ L.T


def fitted(loss, f, J, start, y, c):
    """Returns the minimum of the sum of rho by iteratively reweighted least squares. Huber's loss, which has a single
    minimum, is used first."""
    p = np.array(start, float)
    for one in ("huber", loss):
        for _ in range(500):
            x, X = y - f(p), J(p)
            w = np.minimum(1, c / np.maximum(np.abs(x), 1e-300)) if one == "huber" else 1 / (1 + (x / c) ** 2)
            step = np.linalg.solve(X.T @ (w[:, None] * X), X.T @ (w * x))
            p += step
            if np.max(np.abs(step)) < 1e-11:
                break
    return p


def space_of(n):
    return latsch.DesignSpace([latsch.Variable(f"v{i}", lower=-1e3, upper=1e3, initial=0) for i in range(n)])


LINE = np.stack([np.ones(12), np.linspace(0, 1, 12)], axis=1)
PARABOLA = np.vander(np.linspace(0, 1, 20), 3)
T = np.linspace(0, 3, 30)
PROBLEMS = {"line": (lambda p: LINE @ p, lambda p: LINE, [0.3, -0.7], 1.0),
            "parabola": (lambda p: PARABOLA @ p, lambda p: PARABOLA, [0.5, 1, -2], 1.0),
            "decay": (lambda p: p[0] * np.exp(-p[1] * T), lambda p: np.stack([np.exp(-p[1] * T), -p[0] * T * np.exp(-p[1] * T)], 1),
                      [2.0, 0.8], 0.05)}


class RobustIntervals(unittest.TestCase):
    def found(self, loss, c, f, J, p, y, **options):
        return latsch.confidence(space_of(len(p)), p, f(p) - y, J(p), loss=loss, loss_scale=c, **options)

    def test_the_covariance_is_that_of_m_estimation(self):
        random = np.random.default_rng(3)
        for loss in ("huber", "cauchy"):
            for name, (f, J, truth, sigma) in PROBLEMS.items():
                with self.subTest(f"{loss}, {name}"):
                    y = f(truth) + sigma * random.normal(size=len(f(truth)))
                    y[[3, 8]] += [15 * sigma, -9 * sigma]
                    c = 1.5 * sigma
                    p = fitted(loss, f, J, truth, y, c)
                    x, X = y - f(p), J(p)
                    C = larger(common_covariance(loss, x, X, c), own_covariance(loss, x, X, c))
                    found = self.found(loss, c, f, J, p, y)
                    np.testing.assert_allclose(found.covariance * 2000 ** 2, C, rtol=1e-6)
                    half = scipy.stats.t.ppf(0.975, len(y) - len(p)) * np.sqrt(np.diag(C))
                    np.testing.assert_allclose(found.intervals, np.stack([p - half, p + half], 1), rtol=1e-6)
                    self.assertEqual(found.beyond, int(np.sum(np.abs(x) > c)))

    def test_inside_the_corner_huber_is_least_squares_to_the_last_digit(self):
        f, J, truth, _ = PROBLEMS["parabola"]
        y = f(truth) + np.random.default_rng(1).normal(size=20)
        p = np.linalg.lstsq(PARABOLA, y, rcond=None)[0]
        for sigma in (None, 0.9):
            one = self.found("huber", 100.0, f, J, p, y, sigma=sigma)
            other = latsch.confidence(space_of(3), p, f(p) - y, J(p), sigma=sigma)
            self.assertTrue(np.array_equal(one.intervals, other.intervals))
            self.assertTrue(np.array_equal(one.covariance, other.covariance))

    def coverage(self, loss, corner, problem, draw, **options):
        f, J, truth, sigma = PROBLEMS[problem]
        random = np.random.default_rng(11)
        hits = np.zeros(len(truth))
        for _ in range(SETS):
            y = f(truth) + sigma * draw(random, len(f(truth)))
            p = fitted(loss, f, J, truth, y, corner * sigma)
            ends = self.found(loss, corner * sigma, f, J, p, y, **options).intervals
            hits += (ends[:, 0] <= truth) & (ends[:, 1] >= truth)
        return hits / SETS

    def test_intervals_contain_the_truth_as_often_as_they_say(self):
        def gaussian(random, n):
            return random.normal(size=n)

        def contaminated(random, n):
            return np.where(random.random(n) < 0.1, 10, 1) * random.normal(size=n)

        for loss, corner, problem, draw, options in (
                ("huber", 1.345, "line", gaussian, {}), ("huber", 1.345, "parabola", contaminated, {}),
                ("cauchy", 2.385, "decay", contaminated, {}), ("huber", 0.5, "decay", gaussian, {}),
                ("huber", 1.345, "parabola", gaussian, {"sigma": 1.0}), ("cauchy", 2.385, "line", gaussian, {"sigma": 1.0})):
            with self.subTest(f"{loss} {corner}, {problem}, {draw.__name__}, {options}"):
                for share in self.coverage(loss, corner, problem, draw, **options):
                    self.assertGreater(share, NEAR[0])
                    self.assertLess(share, NEAR[1])

    def test_exact_values_beside_one_far_off_anywhere(self):
        """Checks with one wrong value, any of them and of any size: the interval contains the truth, and its width is
        limited by the scale of the loss."""
        for loss in ("huber", "cauchy"):
            for problem in ("line", "parabola", "decay"):
                f, J, truth, _ = PROBLEMS[problem]
                c = 0.01
                inverse = np.sqrt(np.diag(np.linalg.inv(J(np.array(truth)).T @ J(np.array(truth)))))
                for wrong in range(len(f(np.array(truth)))):
                    for off in (0.3, -50.0, 1e6):
                        with self.subTest(f"{loss}, {problem}, value {wrong} off by {off}"):
                            y = f(np.array(truth))
                            y[wrong] += off
                            p = fitted(loss, f, J, truth, y, c)
                            found = self.found(loss, c, f, J, p, y)
                            self.assertEqual(found.beyond, 1)
                            slack = 1e-9  # rounding errors of the fit
                            self.assertTrue(np.all(found.intervals[:, 0] <= np.array(truth) + slack))
                            self.assertTrue(np.all(found.intervals[:, 1] >= np.array(truth) - slack))
                            half = (found.intervals[:, 1] - found.intervals[:, 0]) / 2
                            self.assertTrue(np.all(half < 6 * c * inverse), half / (c * inverse))

    def test_a_scale_that_is_no_scale_is_refused(self):
        f, J, truth, _ = PROBLEMS["line"]
        for loss, c in (("huber", None), ("huber", -1.0), ("tukey", 1.0), ("squares", 1.0), ("cauchy", float("nan"))):
            with self.subTest(f"{loss} {c}"), self.assertRaises(latsch.InputError):
                self.found(loss, c, f, J, np.array(truth), f(np.array(truth)))


if __name__ == "__main__":
    unittest.main()
