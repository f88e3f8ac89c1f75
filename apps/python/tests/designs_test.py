#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests designs of experiments as arrays, compared with SciPy's Sobol sequence and closed forms."""
import itertools
import unittest

import latsch
import numpy as np
import scipy.stats.qmc
from python_testing import Meanwhile


def cube(n):
    return latsch.DesignSpace([latsch.Variable(f"x{i}", lower=0, upper=1, initial=0.5) for i in range(n)])


class Designs(unittest.TestCase):
    def test_sobols_sequence_is_scipys(self):
        for n in (1, 5, 21):
            theirs = scipy.stats.qmc.Sobol(n, scramble=False).random(256)
            np.testing.assert_array_equal(latsch.sobol(cube(n), 256), theirs)

    def test_a_factorial_design_is_the_product_of_its_levels(self):
        space = latsch.DesignSpace([latsch.Variable("a", lower=0, upper=2, initial=1),
                                    latsch.Variable("b", lower=1, upper=100, initial=10, scale="logarithmic")])
        theirs = list(itertools.product([0, 1, 2], [1, 10, 100]))
        np.testing.assert_allclose(latsch.full_factorial(space, [3, 3]), theirs, rtol=1e-14)

    def test_a_latin_hypercube_has_a_point_in_every_share(self):
        points = latsch.latin_hypercube(cube(4), 20, seed=3)
        middles = (np.arange(20) + 0.5) / 20
        for column in np.sort(points, axis=0).T:
            np.testing.assert_allclose(column, middles, rtol=1e-12)
        np.testing.assert_array_equal(points, latsch.latin_hypercube(cube(4), 20, seed=3))

    def test_other_threads_run_beside_a_large_one(self):
        with Meanwhile() as other:
            latsch.latin_hypercube(cube(6), 60)
        self.assertGreater(other.turns, 3)

    def test_effects_of_a_plane_are_its_coefficients(self):
        screening = latsch.Morris(cube(3), 6, seed=1)
        self.assertEqual(screening.trajectories.shape, (6, 4, 3))
        coefficients = np.array([3.0, -1.0, 0.0])
        values = screening.trajectories @ coefficients
        values[2, 1] = np.nan  # a failed point removes two effects
        effects = screening.effects(values)
        np.testing.assert_allclose(effects["mu"], coefficients, atol=1e-12)
        np.testing.assert_allclose(effects["mu_star"], abs(coefficients), atol=1e-12)
        np.testing.assert_allclose(effects["sigma"], 0, atol=1e-12)
        self.assertEqual(effects["effects"].sum(), 6 * 3 - 2)
        self.assertEqual(len(np.unique(screening.points, axis=0)), len(screening.points))

    def test_basins_of_a_grid(self):
        x = np.linspace(0, 1, 21)
        basins, doubt = latsch.basins_of_grid(np.cos(4 * np.pi * x) + 0.1 * x, [21])
        self.assertEqual([place for place, _, _ in basins], [5, 15])
        self.assertEqual(doubt, "")

    def test_too_much_is_refused(self):
        for call in (lambda: latsch.sobol(cube(22), 8), lambda: latsch.latin_hypercube(cube(2), 1),
                     lambda: latsch.full_factorial(cube(2), [3]), lambda: latsch.Morris(cube(2), 1),
                     lambda: latsch.basins_of_grid([1, 2, 3], [2, 2])):
            with self.assertRaises(latsch.InputError):
                call()


if __name__ == "__main__":
    unittest.main()
