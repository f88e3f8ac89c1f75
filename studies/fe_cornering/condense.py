#!/usr/bin/env python3
"""Condenses the cornering record of ../race_tire_mf to the few states of which measured/race_*.csv consist.

    python3 studies/fe_cornering/condense.py

A finite-element tire takes a second a state, and the record has 1200 of them, each at its own load and pressure. At each load
and slip angle the samples around it, of both signs of the slip angle, give side force and aligning moment per load by least
squares: a parabola in the size of the slip angle and an offset of the two signs, with weights that fall to zero at the width. The
offset, the force that this tire has when it runs straight (ply steer, conicity), is dropped: a model whose sectors are all
alike and whose plies mirror each other has next to none. The force by camber is that at 3 degrees less that without camber.
"""
import csv
import math
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
RECORD = HERE.parent / "race_tire_mf" / "cornering.csv"
WIDTH = 1.6  # deg
PRESSURE = 83  # kPa
HEAD = "# Condensed by condense.py from ../race_tire_mf/cornering.csv, whose head names the source. ISO-W.\n"


def solve(matrix, right):
    """Returns the solution of a small system by Gauss' elimination with pivots."""
    n = len(right)
    rows = [row[:] + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    result = [0.0] * n
    for k in reversed(range(n)):
        result[k] = (rows[k][n] - sum(rows[k][j] * result[j] for j in range(k + 1, n))) / rows[k][k]
    return result


def fitted(bases, values, weights):
    """Returns the coefficients of the weighted least squares of values on the functions in bases."""
    count = len(bases[0])
    normal = [[sum(w * b[i] * b[j] for b, w in zip(bases, weights)) for j in range(count)] for i in range(count)]
    return solve(normal, [sum(w * b[i] * v for b, v, w in zip(bases, values, weights)) for i in range(count)])


def near(record, load, camber):
    return [row for row in record if abs(row["Fz"] / load - 1) < 0.1 and abs(row["gamma"] - camber) < 0.3 and abs(row["p"] - PRESSURE) < 4]


def at_slip(record, load, alpha):
    """Returns Fy and Mz at a slip angle above zero, half the difference of both signs."""
    rows = [row for row in near(record, load, 0) if abs(abs(row["alpha"]) - alpha) < WIDTH]
    offsets = [abs(row["alpha"]) - alpha for row in rows]
    signs = [math.copysign(1, row["alpha"]) for row in rows]
    weights = [1 - (x / WIDTH) ** 2 for x in offsets]
    bases = [[1, x, x * x, sign] for x, sign in zip(offsets, signs)]
    return [load * fitted(bases, [sign * row[name] / row["Fz"] for sign, row in zip(signs, rows)], weights)[0] for name in ("Fy", "Mz")]


def straight(record, load, camber):
    """Returns Fy and Mz of a wheel that runs straight."""
    rows = [row for row in near(record, load, camber) if abs(row["alpha"]) < WIDTH]
    weights = [1 - (row["alpha"] / WIDTH) ** 2 for row in rows]
    bases = [[1, row["alpha"]] for row in rows]
    return [load * fitted(bases, [row[name] / row["Fz"] for row in rows], weights)[0] for name in ("Fy", "Mz")]


def write(name, states):
    with open(HERE / "measured" / name, "w", newline="") as out:
        out.write(HEAD)
        table = csv.writer(out, lineterminator="\n")
        table.writerow(["Fz [N]", "alpha [deg]", "gamma [deg]", "p [kPa]", "Vx [km/h]", "Fy [N]", "Mz [N m]"])
        for load, alpha, camber, (side_force, moment) in states:
            table.writerow([load, alpha, camber, PRESSURE, 40.2, f"{side_force:.0f}", f"{moment:.1f}"])


def main():
    with open(RECORD) as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        record = [{name.split(" ")[0]: float(value) for name, value in row.items()} for row in rows]
    slips = lambda loads, angles: [(load, alpha, 0, at_slip(record, load, alpha)) for load in loads for alpha in angles]
    write("race_cornering.csv", slips((1080, 2210), (1, 3, 7)))
    write("race_other_loads.csv", slips((500, 2740), (1, 3, 7)))
    leaning = [a - b for a, b in zip(straight(record, 2210, 3), straight(record, 2210, 0))]
    write("race_camber.csv", [(2210, 0, 3, leaning)])


if __name__ == "__main__":
    main()
