#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests intervals against SciPy's least squares and Student's quantile, and profiles against intervals."""
import unittest

import latsch
import numpy as np
import python_testing  # noqa: F401
import scipy.optimize
import scipy.stats

T = np.linspace(0, 4, 30)
MEASURED = 2.5 * np.exp(-0.8 * T) + 0.01 * np.random.default_rng(5).normal(size=30)
SPACE = latsch.DesignSpace([latsch.Variable("A", lower=0.1, upper=10, initial=1),
                            latsch.Variable("k", lower=0.01, upper=5, initial=1)])


def residuals(x):
    return x[0] * np.exp(-x[1] * T) - MEASURED


def jacobian(x):
    return np.stack([np.exp(-x[1] * T), -x[0] * T * np.exp(-x[1] * T)], axis=1)


class Identifiability(unittest.TestCase):
    def setUp(self):
        self.fit = scipy.optimize.least_squares(residuals, [1, 1], jac=jacobian, xtol=1e-15, ftol=1e-15, gtol=1e-15)

    def intervals_of_scipy(self, sigma=None):
        J, r = self.fit.jac, self.fit.fun
        variance = sigma ** 2 if sigma else r @ r / (len(r) - 2)
        # With a stated sigma, the quantile is that of the normal distribution, because no variance is estimated.
        t = scipy.stats.norm.ppf(0.975) if sigma else scipy.stats.t.ppf(0.975, len(r) - 2)
        half = t * np.sqrt(np.diag(np.linalg.inv(J.T @ J) * variance))
        return np.stack([self.fit.x - half, self.fit.x + half], axis=1)

    def test_intervals_are_students(self):
        for sigma in (None, 0.01):
            found = latsch.confidence(SPACE, self.fit.x, residuals(self.fit.x), jacobian(self.fit.x), sigma=sigma)
            np.testing.assert_allclose(found.intervals, self.intervals_of_scipy(sigma), rtol=1e-6)
        self.assertEqual(found.held, ["", ""])
        C = np.linalg.inv(self.fit.jac.T @ self.fit.jac)
        self.assertAlmostEqual(found.correlation[0, 1], C[0, 1] / np.sqrt(C[0, 0] * C[1, 1]), places=9)

    def test_a_logarithmic_scale_has_the_same_deviation_there(self):
        space = latsch.DesignSpace([SPACE[0], latsch.Variable("k", lower=0.01, upper=5, initial=1, scale="logarithmic")])
        found = latsch.confidence(space, self.fit.x, residuals(self.fit.x), jacobian(self.fit.x))
        lower, upper = self.intervals_of_scipy()[1]
        half = (upper - lower) / 2 / self.fit.x[1]  # relative, for ln k
        np.testing.assert_allclose(np.log(found.intervals[1] / self.fit.x[1]), [-half, half], rtol=1e-6)

    def test_profiles_of_a_nearly_linear_model_are_its_intervals(self):
        for with_slopes in (False, True):
            what = latsch.Identification(SPACE, self.fit.x)
            while len(what.wanted):
                what.observe([(residuals(x), jacobian(x)) if with_slopes else residuals(x) for x in what.wanted])
            for profile, interval in zip(what.profiles, self.intervals_of_scipy()):
                self.assertEqual(profile.verdict, "identifiable")
                np.testing.assert_allclose(profile.interval, interval, rtol=0.01)
                self.assertEqual(len(profile.values), len(profile.rise))
            self.assertTrue(np.all(np.diff(what.profiles[0].values) > 0))

    def test_what_no_residual_feels_is_flat(self):
        space = latsch.DesignSpace([SPACE[0], SPACE[1], latsch.Variable("unfelt")])
        what = latsch.Identification(space, [*self.fit.x, 0.5])
        while len(what.wanted):
            what.observe([residuals(x) for x in what.wanted])
        self.assertEqual(what.profiles[2].verdict, "flat")
        lower, upper = what.confidence.intervals[2]
        self.assertGreater(upper - lower, 1000)  # in units of the range: only rounding limits it

    def test_failures_and_wrong_shapes(self):
        what = latsch.Identification(SPACE, self.fit.x)
        with self.assertRaises(latsch.InputError):
            what.observe([residuals(self.fit.x)] * (len(what.wanted) + 1))
        with self.assertRaisesRegex(latsch.InputError, "found 5 values, but 30 at the first point"):
            what.observe([residuals(x)[: None if k == 0 else 5] for k, x in enumerate(what.wanted)])
        what = latsch.Identification(SPACE, self.fit.x)
        what.observe([latsch.Failure("solver gave up")] * len(what.wanted))
        with self.assertRaises(latsch.Failure) as caught:
            what.confidence
        self.assertIn("solver gave up", str(caught.exception))
        for J in (jacobian(self.fit.x)[:5], jacobian(self.fit.x)[:, :1], np.full((30, 2), np.nan)):
            with self.assertRaises(latsch.InputError):
                latsch.confidence(SPACE, self.fit.x, residuals(self.fit.x), J)
        with self.assertRaises(latsch.InputError):
            latsch.confidence(SPACE, self.fit.x, residuals(self.fit.x), jacobian(self.fit.x), level=95)


if __name__ == "__main__":
    unittest.main()
