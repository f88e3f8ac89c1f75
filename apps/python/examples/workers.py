#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Uses ask and tell with several processes. Points that the optimizer will probably request are evaluated ahead, and
the search takes the same path to the last bit as with one process.

   python3 workers.py [PROCESSES]"""
import concurrent.futures
import math
import sys

import latsch

SPACE = latsch.DesignSpace([latsch.Variable(name, lower=-2, upper=2, initial=-1) for name in "abc"])


def evaluate(point):
    """Returns the Score of a model that takes a long time and fails in a corner of its design space."""
    a, b, c = point
    if a + b > 3:
        return latsch.Failure("no equilibrium: a + b is above 3")
    return latsch.Score(residuals=[a - 0.5, b - a * a, 3 * (c - math.sin(b))])


def search(pool, look_ahead):
    optimizer, begun, steps = latsch.optimizer(SPACE, residuals=True), {}, []
    while not optimizer.converged:
        plan = optimizer.propose(look_ahead)
        for point in plan:
            if point.tobytes() not in begun:
                begun[point.tobytes()] = pool.submit(evaluate, point)
        # Only the outcome of the first point is used. Points that are evaluated in advance affect only the computing
        # time.
        outcome = begun[plan[0].tobytes()].result()
        optimizer.observe(plan[0], outcome)
        steps.append((plan[0].tolist(), getattr(outcome, "value", math.inf)))
    return steps, len(begun)


if __name__ == "__main__":
    processes = int(sys.argv[1]) if len(sys.argv) > 1 else 4
    with concurrent.futures.ProcessPoolExecutor(processes) as pool:
        alone, _ = search(pool, 1)
        together, evaluated = search(pool, processes)
    best, least = min(together, key=lambda step: step[1])
    print(f"{len(together)} steps, {evaluated} evaluated; at {', '.join(f'{value:.4f}' for value in best)}: {least:.1e}")
    print("the path of one process:", "the same" if alone == together else "another one")
