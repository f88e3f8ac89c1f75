#!/usr/bin/env python3
"""Writes what the rig recorded of the specimen: a cycle of every load, 2 um and 0.0005 deg of noise on every sample.

    python3 studies/compliance/rear_axle/record.py build/release/bin/latsch
"""
import csv
import math
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
TRAVEL_NOISE, ANGLE_NOISE = 2e-6, math.radians(5e-4)  # m, rad
QUARTER = 10  # samples from the middle of a load to its end
CYCLES = {  # mode, load, from, to (N, N m)
    "A": ("parallel", "Fz", 0.0, 5e3),
    "A_opposed": ("opposed", "Fz", -4e3, 4e3),
    "B": ("parallel", "Fy", -4e3, 4e3),
    "B_opposed": ("opposed", "Fy", -4e3, 4e3),
    "C": ("parallel", "Fx", -4e3, 4e3),
    "C_opposed": ("opposed", "Fx", -4e3, 4e3),
    "D": ("parallel", "Mz", -200.0, 200.0),
    "D_opposed": ("opposed", "Mz", -200.0, 200.0),
}
COMBINED = {"Fx_L": -2e3, "Fy_L": 3e3, "Fz_L": 5e3, "Mz_L": 60.0, "Fx_R": -1e3, "Fy_R": 1.5e3, "Fz_R": 2e3, "Mz_R": 40.0}  # N, N m


def cycle(low, high):
    """From the middle up, down, up ... and back to the middle, evenly."""
    middle, reach = 0.5 * (low + high), 0.5 * (high - low)
    shares = [i / QUARTER for i in range(QUARTER)] + [1.0 - i / QUARTER for i in range(2 * QUARTER)]
    shares += [-1.0 + i / QUARTER for i in range(QUARTER)]
    return [middle + reach * share for share in shares + [0.0]]


def listed(values, unit):
    return "[" + ", ".join(f'"{value:.6g} {unit}"' for value in values) + "]"


def unit_of(load):
    return "N m" if load.startswith("M") else "N"


def record(program, name, loads, mode, chance):
    """The rig tells loads, travel and angles of both wheels."""
    stated = ", ".join(f"{load} = {listed(values, unit_of(load))}" for load, values in loads.items())
    test = f'{{kind = "axle_kc", axle = "rear", springs = "locked", {mode}{stated}}}'
    whole = HERE / "measured" / "whole.csv"
    subprocess.run([program, "test", HERE / "specimen.toml", test, "-o", whole, "--quiet"], check=True)
    with open(whole) as file:
        rows = list(csv.DictReader(file))
    whole.unlink()
    moved = [column for column in rows[0] if column.startswith(("d", "c", "t"))]
    told = [f"{load} [{unit_of(load)}]" for load in loads]
    with open(HERE / "measured" / f"{name}.csv", "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(told + [c.replace("[m]", "[mm]").replace("[rad]", "[deg]") for c in moved])
        for row in rows:
            values = [f"{float(row[c]):.6g}" for c in told]
            for column in moved:
                if "[m]" in column:
                    values.append(f"{1e3 * (float(row[column]) + chance.gauss(0.0, TRAVEL_NOISE)):.5f}")
                else:
                    values.append(f"{math.degrees(float(row[column]) + chance.gauss(0.0, ANGLE_NOISE)):.6f}")
            table.writerow(values)


def main():
    program, chance = sys.argv[1], random.Random(15)
    (HERE / "measured").mkdir(exist_ok=True)
    for name, (mode, load, low, high) in CYCLES.items():
        record(program, name, {load: cycle(low, high)}, f'mode = "{mode}", ', chance)
    shares = cycle(0.0, 1.0)
    record(program, "E", {load: [share * most for share in shares] for load, most in COMBINED.items()}, "", chance)


if __name__ == "__main__":
    main()
