# SPDX-License-Identifier: Apache-2.0
"""Measures the seconds per turn of ask and tell from Python, for bench_python, with the search methods of that
benchmark.

    ask_tell_turns.py METHOD VARIABLES    prints seconds per turn, the number of turns, and the last point in
                                          hexadecimal floating point"""
import sys
import time

import latsch

MOST_TURNS, REPEATS = 400, 5


def valley(x):
    residuals = []
    for i, value in enumerate(x):
        residuals.append(value - 0.6)
        if i > 0:
            residuals.append(value - x[i - 1] * x[i - 1] - 0.2)
    return residuals


def slopes(x):
    rows = []
    for i in range(len(x)):
        rows.append([float(j == i) for j in range(len(x))])
        if i > 0:
            rows.append([float(j == i) - 2 * x[j] * (j == i - 1) for j in range(len(x))])
    return rows


def main(method, n):
    space = latsch.DesignSpace([latsch.Variable(f"x{i}", lower=0, upper=1, initial=0.2) for i in range(n)])
    optimizer, outcomes, point = latsch.optimizer(space, method), [], None
    while not optimizer.converged and len(outcomes) < MOST_TURNS:
        point = optimizer.propose()[0]
        x = point.tolist()
        outcomes.append(latsch.Score(residuals=valley(x), jacobian=slopes(x) if method == "levenberg_marquardt" else None))
        optimizer.observe(point, outcomes[-1])
    best = float("inf")
    for _ in range(REPEATS):
        again = latsch.optimizer(space, method)
        begin = time.perf_counter()
        for outcome in outcomes:
            again.observe(again.propose()[0], outcome)
        best = min(best, time.perf_counter() - begin)
    print(best / len(outcomes), len(outcomes), *(value.hex() for value in point.tolist()))


main(sys.argv[1], int(sys.argv[2]))
