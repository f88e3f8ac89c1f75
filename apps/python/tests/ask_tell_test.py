#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests optimizers from Python: minima that SciPy also finds, options and error messages of the library, failures,
threads."""
import pickle
import unittest

import latsch
import numpy as np
import python_testing  # noqa: F401
import scipy.optimize

T = np.linspace(0, 4, 30)
MEASURED = 2.5 * np.exp(-0.8 * T) + 0.3 + 0.01 * np.sin(17 * T)


def residuals(x):
    return x[0] * np.exp(-x[1] * T) + x[2] - MEASURED


def jacobian(x):
    return np.stack([np.exp(-x[1] * T), -x[0] * T * np.exp(-x[1] * T), np.ones_like(T)], axis=1)


def space(**changed):
    variables = [dict(name="A", lower=0.1, upper=10, initial=1), dict(name="k", lower=0.01, upper=5, initial=2,
                 scale="logarithmic"), dict(name="c", lower=-1, upper=1, initial=0)]
    return latsch.DesignSpace([latsch.Variable(**{**one, **changed}) for one in variables])


def search(optimizer, evaluate, look_ahead=1, most=5000):
    """Runs the optimizer; returns the observed points in the order in which they were observed, and the best point."""
    path = []
    while not optimizer.converged and len(path) < most:
        point = optimizer.propose(look_ahead)[0]
        outcome = evaluate(point)
        optimizer.observe(point, outcome)
        path.append((point, np.inf if isinstance(outcome, latsch.Failure) else getattr(outcome, "value", outcome)))
    return np.array([point for point, _ in path]), min(path, key=lambda step: step[1])[0]


class AskTell(unittest.TestCase):
    def test_least_squares_end_where_scipys_do(self):
        found = scipy.optimize.least_squares(residuals, [1, 2, 0], jac=jacobian, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        # tolerances of the result for a step length of 1e-6 and of 1e-3
        for with_jacobian, tolerance in ((True, 1e-5), (False, 2e-3)):
            optimizer = latsch.optimizer(space(), residuals=True, jacobian=with_jacobian)
            self.assertEqual(optimizer.method, "levenberg_marquardt" if with_jacobian else "residual_trust_region")
            _, best = search(optimizer, lambda x: latsch.Score(
                residuals=residuals(x), jacobian=jacobian(x) if with_jacobian else None))
            np.testing.assert_allclose(best, found, rtol=tolerance)
            self.assertTrue(optimizer.ending)
            claim = optimizer.claims[0]
            self.assertTrue(optimizer.ending.startswith(claim["statement"]))
            self.assertEqual(set(claim), {"statement", "variables", "test", "numbers"})
            for number in claim["numbers"]:
                if number["at_most"] is not None:
                    self.assertLessEqual(number["value"], number["at_most"], number["name"])

    def test_several_minima_are_searched_for_and_named(self):
        # Freudenstein and Roth: 0 at (5, 4) and 48.98 at (11.41, -0.897)
        def two_minima(at):
            x, y = at
            return latsch.Score(residuals=np.array([-13 + x + ((5 - y) * y - 2) * y, -29 + x + ((y + 1) * y - 14) * y]))

        box = latsch.DesignSpace([latsch.Variable("x", lower=-20, upper=20, initial=15),
                                  latsch.Variable("y", lower=-6, upper=6, initial=-2)])
        optimizer = latsch.optimizer(box, residuals=True, global_="basins", budget=100)
        _, best = search(optimizer, two_minima)
        np.testing.assert_allclose(best, [5, 4], atol=0.02)
        self.assertIn("2 basins found", optimizer.ending)
        self.assertRegex(optimizer.ending, r"target 4(8\.9|9)")
        lowest, other = optimizer.minima
        self.assertEqual(lowest["place"], {"x": best[0], "y": best[1]})
        np.testing.assert_allclose(list(other["place"].values()), [11.41, -0.897], atol=0.05)
        self.assertAlmostEqual(other["value"], 48.98, delta=0.1)
        self.assertGreaterEqual(min(lowest["times_found"], other["times_found"]), 1)
        numbers = {number["name"]: number["value"] for number in optimizer.claims[0]["numbers"]}
        self.assertEqual(numbers["minima found"], 2)
        self.assertEqual(latsch.optimizer(box, residuals=True).minima, [])

    def test_every_method_finds_the_minimum_of_a_bowl(self):
        target = np.array([0.7, 0.6, 0.4])

        def bowl(x):
            return latsch.Score(residuals=x - target, jacobian=np.eye(3))

        box = latsch.DesignSpace([latsch.Variable(name, lower=0, upper=1, initial=0.2) for name in "abc"])
        for method in latsch.method_names():
            options = {"member": {"one": {"method": "gss"}, "two": {"method": "nelder_mead"}}} if method == "ensemble" else {}
            optimizer = latsch.optimizer(box, method, residuals=True, **options)
            _, best = search(optimizer, bowl)
            self.assertTrue(optimizer.converged or method == "genetic", method)
            np.testing.assert_allclose(best, target, atol=0.02, err_msg=method)

    def test_a_path_does_not_depend_on_how_far_it_looks_ahead(self):
        for method in ("gss", "residual_trust_region", "sqp"):
            paths = [search(latsch.optimizer(space(), method), lambda x: latsch.Score(residuals=residuals(x)), ahead)[0]
                     for ahead in (1, 8)]
            np.testing.assert_array_equal(*paths, err_msg=method)

    def test_constraints_hold(self):
        sum_at_most = latsch.LinearConstraint("sum", [1, 2], upper=1.2)
        box = latsch.DesignSpace([latsch.Variable("a"), latsch.Variable("b", initial=0.2)], [sum_at_most])
        path, best = search(latsch.optimizer(box, "gss"), lambda x: (x[0] - 1) ** 2 + (x[1] - 1) ** 2)
        self.assertTrue(np.all(path @ [1, 2] <= 1.2 + 1e-12))
        # the point nearest to (1, 1) on the line that the constraint allows
        np.testing.assert_allclose(best, [0.64, 0.28], atol=0.01)

        circle = latsch.DesignSpace([latsch.Variable("a", initial=0.3), latsch.Variable("b", initial=0.3)])
        optimizer = latsch.optimizer(circle, residuals=True, constraints=True)
        self.assertEqual(optimizer.method, "sqp")
        scores = {}

        def inside(x):
            score = latsch.Score(residuals=x - 1, constraints=[x @ x - 1])
            scores[tuple(x)] = score
            return score

        search(optimizer, inside)
        best = min(scores, key=lambda x: (max(scores[x].violation, 1e-4), scores[x].value))
        np.testing.assert_allclose(best, np.sqrt([0.5, 0.5]), atol=1e-3)

    def test_failures_are_outcomes(self):
        def fails_above(x):
            return latsch.Failure("no equilibrium at step 3") if x[0] > 0.5 else (x[0] - 0.6) ** 2 + x[1] ** 2
        box = latsch.DesignSpace([latsch.Variable("a", initial=0.1), latsch.Variable("b")])
        _, best = search(latsch.optimizer(box, "gss"), fails_above)
        self.assertLess(abs(best[0] - 0.5), 0.05)
        optimizer = latsch.optimizer(box, "gss")
        with self.assertWarnsRegex(RuntimeWarning, "counts as a failed trial; tell a failure as latsch.Failure"):
            optimizer.observe(optimizer.propose()[0], float("nan"))
        self.assertIsNone(optimizer.best)
        self.assertFalse(optimizer.converged)

    def test_outcomes_go_from_process_to_process(self):
        score = latsch.Score(residuals=[1.0, 2.0], jacobian=[[1, 2, 3], [4, 5, 6]], constraints=[0.1], stand_ins=1)
        same = pickle.loads(pickle.dumps(score))
        np.testing.assert_array_equal(same.jacobian, score.jacobian)
        self.assertEqual((same.value, same.violation), (5.0, 0.1))
        failure = pickle.loads(pickle.dumps(latsch.Failure("too long", "timeout")))
        self.assertEqual((failure.reason, failure.cause), ("too long", "timeout"))
        error = pickle.loads(pickle.dumps(latsch.InputError("tire.toml:3: is wrong", "tire.toml", 3)))
        self.assertEqual((str(error), error.file, error.line), ("tire.toml:3: is wrong", "tire.toml", 3))

    def test_runs_after_one_another(self):
        box = latsch.DesignSpace([latsch.Variable("a", initial=0.1), latsch.Variable("b", initial=0.1)])

        def hills(x):
            return (x[0] - 0.8) ** 2 + (x[1] - 0.3) ** 2 + 0.3 * np.sin(9 * x[0]) ** 2
        grid = latsch.full_factorial(box, [9, 9])
        lowest = [place for place, _, _ in latsch.basins_of_grid([hills(x) for x in grid], [9, 9])[0]]
        found = min((hills(x) for x in grid))
        _, best = search(latsch.multi_start(box, grid[lowest], "gss"), hills)
        self.assertLessEqual(hills(best), found)
        _, tight = search(latsch.cascade(box, "gss", stages=3), hills)
        self.assertLessEqual(hills(tight), hills(box.initial))

    def test_wrong_arguments_are_complained_of(self):
        def says(part, call):
            with self.assertRaises(latsch.InputError) as caught:
                call()
            self.assertIn(part, str(caught.exception))
        says('did you mean "contraction"', lambda: latsch.optimizer(space(), "gss", contractoin=0.3))
        says("residual_trust_region", lambda: latsch.optimizer(space(), "gss", restarts=3))
        says("expected one of", lambda: latsch.optimizer(space(), "newton"))
        says("(3,)", lambda: latsch.optimizer(space()).observe([1, 2], 0.0))
        says("columns", lambda: latsch.optimizer(space()).observe(
            [1, 1, 0], latsch.Score(residuals=[1.0], jacobian=[[1.0, 2.0]])))
        says("within its bounds", lambda: latsch.optimizer(space()).observe([1, 1, 1e9], 0.0))
        says("nan", lambda: latsch.optimizer(space()).observe([1, 1, float("nan")], 0.0))
        says("at least one", lambda: latsch.optimizer(space()).propose(0))
        says("lower", lambda: latsch.DesignSpace([latsch.Variable("a", lower=2, upper=1)]))
        says("outcome", lambda: latsch.optimizer(space()).observe([1, 1, 0], "bad"))
        says("levenberg_marquardt", lambda: latsch.optimizer(space(), "levenberg_marquardt", constraints=True))

    def test_outcomes_of_another_number_are_complained_of(self):
        def told_twice(first, second):
            optimizer = latsch.optimizer(space(), residuals=True)
            points = [optimizer.propose()[0]]
            optimizer.observe(points[0], first)
            # a failed trial has no value of the target
            optimizer.observe(points[0], latsch.Failure("no equilibrium"))
            with self.assertRaisesRegex(latsch.InputError, "but that of the first point has .* equally many"):
                optimizer.observe(optimizer.propose()[0], second)
        told_twice(latsch.Score(residuals=[1.0, 2.0, 3.0]), latsch.Score(residuals=[1.0, 2.0]))
        told_twice(latsch.Score(residuals=[1.0, 2.0, 3.0]), 4.0)
        told_twice(latsch.Score(residuals=[1.0], constraints=[0.1]), latsch.Score(residuals=[1.0]))
        told_twice(latsch.Score(residuals=[1.0], equations=[]), latsch.Score(residuals=[1.0], equations=[0.0]))

    def test_the_space_leads_to_the_unit_cube_and_back(self):
        points = latsch.latin_hypercube(space(), 12)
        unit = space().to_unit(points)
        np.testing.assert_allclose(unit[:, 1], np.log(points[:, 1] / 0.01) / np.log(500), rtol=1e-12)
        np.testing.assert_allclose(space().from_unit(unit), points, rtol=1e-12)
        np.testing.assert_allclose(space().from_unit(unit[0]), points[0], rtol=1e-12)


if __name__ == "__main__":
    unittest.main()
