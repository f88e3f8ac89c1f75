#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests intervals of fits whose groups of values have spreads that are estimated, against the formulas of Kenward and
Roger (Biometrics 53 (1997) 983) written in NumPy with full matrices, and against the truth in synthetic data sets."""
import unittest

import latsch
import numpy as np
import python_testing  # noqa: F401
import scipy.optimize
import scipy.stats

SETS = 1000


def line(count, at=1.0):
    return np.stack([np.linspace(-1, 1, count), np.full(count, at)], 1)


def space_of(n):
    return latsch.DesignSpace([latsch.Variable(f"v{i}", lower=-1e3, upper=1e3, initial=0) for i in range(n)])


class Restricted:
    """The restricted likelihood of spreads, and the covariance of the variables that follows from it."""

    def __init__(self, X, y, groups):
        self.X, self.y, self.groups, self.count = X, y, groups, max(groups) + 1

    def P(self, theta):
        inverse = np.diag(1 / theta[self.groups])
        Phi = np.linalg.inv(self.X.T @ inverse @ self.X)
        return inverse - inverse @ self.X @ Phi @ self.X.T @ inverse, Phi

    def deviance(self, logs):
        P, Phi = self.P(np.exp(logs))
        return np.sum(logs[self.groups]) - np.linalg.slogdet(Phi)[1] + self.y @ P @ self.y

    def spreads(self):
        start = np.log([np.var(self.y[self.groups == g]) for g in range(self.count)])
        found = scipy.optimize.minimize(self.deviance, start, method="Nelder-Mead",
                                        options={"xatol": 1e-9, "fatol": 1e-12, "maxiter": 4000})
        return np.exp(found.x)

    def intervals(self, theta):
        """Returns the variables and the half widths of their 95 % intervals."""
        P, Phi = self.P(theta)
        V = np.diag(theta[self.groups])
        own = [np.diag((self.groups == g) * theta[g]) for g in range(self.count)]
        information = np.array([[0.5 * np.trace(P @ a @ P @ b) for b in own] for a in own])
        W = np.linalg.inv(information)  # covariance of the logarithms
        F = np.linalg.inv(V) @ self.X @ Phi
        more = sum(W[a, b] * F.T @ own[a] @ P @ own[b] @ F for a in range(self.count) for b in range(self.count))
        C = Phi + 2 * more
        half = []
        for i in range(self.X.shape[1]):
            parts = np.array([F[:, i] @ one @ F[:, i] for one in own])
            freedom = 2 * Phi[i, i] ** 2 / (parts @ W @ parts)
            half.append(scipy.stats.t.ppf(0.975, freedom) * np.sqrt(C[i, i]))
        return Phi @ self.X.T @ np.diag(1 / theta[self.groups]) @ self.y, np.array(half)


class EstimatedSpreads(unittest.TestCase):
    def test_intervals_are_those_of_kenward_and_roger(self):
        random = np.random.default_rng(23)
        for sizes, noise in (([7, 9], [1, 3]), ([5, 30], [0.4, 1]), ([6, 10, 40], [2, 1, 0.5])):
            with self.subTest(f"{sizes} {noise}"):
                X = np.vstack([line(n, 1 + 0.2 * k) for k, n in enumerate(sizes)])
                groups = np.repeat(np.arange(len(sizes)), sizes)
                y = X @ [1.0, 2.0] + np.array(noise)[groups] * random.normal(size=len(X))
                restricted = Restricted(X, y, groups)
                theta = restricted.spreads()
                p, half = restricted.intervals(theta)
                # The residuals of a fit by these spreads, as a study passes them.
                scale = np.sqrt(theta[groups])
                found = latsch.confidence(space_of(2), p, (X @ p - y) / scale, X / scale[:, None], groups=list(groups))
                np.testing.assert_allclose(found.intervals, np.stack([p - half, p + half], 1), rtol=2e-5)

    def test_one_group_is_least_squares(self):
        X = line(6)
        y = np.array([0.3, 1.1, 1.6, 2.2, 2.9, 3.1])
        p = np.linalg.lstsq(X, y, rcond=None)[0]
        for groups in ([0] * 6, [-1] * 6, []):
            found = latsch.confidence(space_of(2), p, X @ p - y, X, groups=groups)
            half = scipy.stats.t.ppf(0.975, 4) * np.sqrt(np.sum((X @ p - y) ** 2) / 4 * np.diag(np.linalg.inv(X.T @ X)))
            np.testing.assert_allclose(found.intervals, np.stack([p - half, p + half], 1), rtol=1e-9)

    def test_intervals_of_few_values_contain_the_truth(self):
        """With one spread for all these cases held 84 to 92 %."""
        truth = np.array([1.0, 2.0])
        for sizes, noise, least in (([4, 4], [1, 3], 0.91), ([4, 100], [0.1, 1], 0.92), ([10, 10], [1, 3], 0.93)):
            with self.subTest(f"{sizes} {noise}"):
                random = np.random.default_rng(1009)
                X = np.vstack([line(n) for n in sizes])
                groups = np.repeat(np.arange(len(sizes)), sizes)
                held = np.zeros(2)
                for _ in range(SETS):
                    y = X @ truth + np.array(noise)[groups] * random.normal(size=len(X))
                    scale = np.ones(len(X))
                    for _ in range(3):
                        p = np.linalg.lstsq(X / scale[:, None], y / scale, rcond=None)[0]
                        r = X @ p - y
                        own = [np.sqrt(np.mean(r[groups == g] ** 2) / (1 - 2 / len(X))) for g in range(len(sizes))]
                        last, scale = scale, np.array(own)[groups]
                    ends = latsch.confidence(space_of(2), p, r / last, X / last[:, None], groups=list(groups)).intervals
                    held += (ends[:, 0] <= truth) & (truth <= ends[:, 1])
                self.assertTrue(np.all(held / SETS >= least), held / SETS)
                self.assertTrue(np.all(held / SETS <= 0.97), held / SETS)

    def test_groups_are_checked(self):
        X, y = line(6), np.arange(6.0)
        for options in ({"groups": [0, 1]}, {"groups": [0, 0, 0, 1, 1, 1], "sigma": 1.0}):
            with self.subTest(options), self.assertRaises(latsch.InputError):
                latsch.confidence(space_of(2), [0, 0], y, X, **options)


if __name__ == "__main__":
    unittest.main()
