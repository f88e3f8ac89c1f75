#!/usr/bin/env python3
"""What each measurement tells: sensitivities of all computed values to the logarithms of five moduli, in units of their noise, and
from them how uncertain a modulus is with one set of measurements or another. Writes sensitivities.csv, and table.md beside it.

    python3 studies/measurement_guideline/guideline.py build/release/bin/latsch
    python3 studies/measurement_guideline/guideline.py      # the table alone, of the sensitivities.csv there is

J = d(value / noise) / d ln E by central differences over +-25 %, 10 trials of twenty seconds; C = (J'J + P)^-1, P a prior of a factor of
three on each modulus (one standard deviation): what is known before anything is measured. 95 % of a modulus lie within a factor of
exp(1.96 sqrt(C_ii)); the smallest singular value of J is that of the least known direction.
"""
import csv
import json
import math
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
STUDY = HERE / "study.toml"
INITIAL = {"crown": 22.3, "upper_sidewall": 22.3, "lower_sidewall": 22.3, "carcass": 356.0, "belt": 5088.0}  # N/mm^2
# Shares of the value. Footprint: 1.5 % of the measurement and 1 % that the mesh of the computed patch leaves.
NOISE = {"force": 0.005, "modes": 0.003, "footprint": 0.018, "lateral": 0.02, "longitudinal": 0.02, "torsional": 0.02}
STEP, PRIOR = 0.25, math.log(3.0)
FOOT = ["footprint_length", "footprint_width", "footprint_area"]
GROUPS = {"force": ["force"], "modes": ["modes"], "footprint": FOOT, "lateral": ["lateral"],
          "longitudinal": ["longitudinal"], "torsional": ["torsional"]}
ALL = list(GROUPS)
SETS = ([[g] for g in ALL] + [["force", g] for g in ALL[1:]] + [["force", "modes", g] for g in ALL[2:]] +
        [ALL] + [[g for g in ALL if g != out] for out in ALL])


def errors(program, factors):
    """(measured - simulated) / measured, of every experiment."""
    command = [program, "simulate", STUDY, "--json"]
    for name, value in INITIAL.items():
        command += ["--set", f"{name}={value * factors.get(name, 1.0)!r} N/mm^2"]
    answer = json.JSONDecoder().raw_decode(subprocess.run(command, check=True, capture_output=True, text=True).stdout)[0]
    return {e["name"]: errors_of(e) for e in answer["result"]["experiments"]}


def errors_of(experiment):
    if "modes" in experiment:
        by_label = sorted(experiment["modes"], key=lambda m: m["measured_Hz"])
        return [m["error"] for m in by_label if m.get("simulated_Hz") is not None]
    return experiment["forces" if "forces" in experiment else "values"]["error"]


def sensitivities(program):
    """Of every experiment: a row a value, a column a modulus."""
    columns = []
    for name in INITIAL:
        high, low = errors(program, {name: 1.0 + STEP}), errors(program, {name: 1.0 / (1.0 + STEP)})
        span = 2.0 * math.log(1.0 + STEP)
        columns.append({e: [(b - a) / span for a, b in zip(high[e], low[e], strict=True)] for e in high})
    return {e: [list(row) for row in zip(*(c[e] for c in columns))] for e in columns[0]}


def solve(A, b):
    A, n = [row[:] + [x] for row, x in zip(A, b)], len(b)
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(A[i][k]))
        A[k], A[p] = A[p], A[k]
        for i in range(k + 1, n):
            f = A[i][k] / A[k][k]
            A[i] = [x - f * y for x, y in zip(A[i], A[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (A[k][n] - sum(A[k][j] * x[j] for j in range(k + 1, n))) / A[k][k]
    return x


def inverse(A):
    n = len(A)
    return list(zip(*[solve(A, [float(i == j) for i in range(n)]) for j in range(n)]))


def eigenvalues(A):
    """Of a symmetric matrix, by Jacobi's rotations."""
    A, n = [list(row) for row in A], len(A)
    for _ in range(60):
        for p in range(n):
            for q in range(p + 1, n):
                if abs(A[p][q]) < 1e-300:
                    continue
                t = 0.5 * math.atan2(2 * A[p][q], A[q][q] - A[p][p])
                c, s = math.cos(t), math.sin(t)
                for k in range(n):
                    A[k][p], A[k][q] = c * A[k][p] - s * A[k][q], s * A[k][p] + c * A[k][q]
                for k in range(n):
                    A[p][k], A[q][k] = c * A[p][k] - s * A[q][k], s * A[p][k] + c * A[q][k]
    return sorted(max(A[i][i], 0.0) for i in range(n))


def judged(J, groups):
    """Factor a modulus lies within, smallest singular value, condition."""
    rows = [[x / NOISE[g] for x in row] for g in groups for e in GROUPS[g] for row in J[e]]
    n = len(INITIAL)
    normal = [[sum(r[i] * r[j] for r in rows) for j in range(n)] for i in range(n)]
    prior = [[normal[i][j] + (i == j) / PRIOR**2 for j in range(n)] for i in range(n)]
    C = inverse(prior)
    values = eigenvalues(normal)
    determined = len(rows) >= n
    information = 0.5 * sum(math.log(x * PRIOR**2) for x in eigenvalues(prior))
    return ([math.exp(1.96 * math.sqrt(C[i][i])) for i in range(n)], math.sqrt(values[0]) if determined else 0.0,
            math.sqrt(values[-1] / values[0]) if determined and values[0] > 0 else math.inf, information / math.log(2.0))


def write(J):
    with open(HERE / "sensitivities.csv", "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["experiment"] + [f"d ln / d ln {name}" for name in INITIAL])
        table.writerows([[e] + [f"{x:.4f}" for x in row] for e, rows in J.items() for row in rows])


def read():
    J = {}
    with open(HERE / "sensitivities.csv") as file:
        for e, *row in list(csv.reader(file))[1:]:
            J.setdefault(e, []).append([float(x) for x in row])
    return J


def main():
    if len(sys.argv) > 1:
        write(sensitivities(sys.argv[1]))
    J = read()
    lines = ["| measured | " + " | ".join(INITIAL) + " | smallest singular value | condition | bits |", "| --- |" + " --- |" * 8]
    for groups in SETS:
        factors, least, condition, bits = judged(J, groups)
        left = [g for g in ALL if g not in groups]
        name = ("all" if not left else "all but " + left[0] if len(left) == 1 else " + ".join(groups))
        lines.append(f"| {name} | " + " | ".join(f"{f:.2f}" for f in factors) +
                     f" | {least:.2f} | {condition:.0f} | {bits:.1f} |".replace("inf", "–"))
    (HERE / "table.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
