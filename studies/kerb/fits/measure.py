#!/usr/bin/env python3
"""Writes what rigs measured of the parts of the track's car, with noise: its corners on a K&C rig (0.005 mm, 0.001 deg), its tire
over cleats on a drum (20 N, 10 N).

    python3 studies/kerb/fits/measure.py build/release/bin/latsch
"""
import csv
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
NOISE = {"dx [m]": 5e-6, "dy [m]": 5e-6, "dz [m]": 5e-6, "camber [rad]": 1.745e-5, "toe [rad]": 1.745e-5,
         "caster [rad]": 1.745e-5, "Fz [N]": 20.0, "Fx [N]": 10.0}
DIGITS = {"m": 7, "rad": 7, "N": 1}
CORNERS = {"front": "track_front.toml", "rear": "track_rear.toml"}
KC = [["dz [m]", "camber [rad]", "toe [rad]", "caster [rad]"], ["kc_Fz", "kc_Fy", "kc_Fx"]]
DRUM = [["Fz [N]", "Fx [N]"], ["drum_slow", "drum_fast", "drum_high"]]


def record(program, model, test, name, columns, chance):
    whole = HERE / "measured" / "whole.csv"
    subprocess.run([program, "test", HERE.parent / model, HERE / "tests" / (test + ".toml"), "-o", whole, "--quiet"], check=True)
    with open(whole) as file:
        rows = list(csv.DictReader(file))
    whole.unlink()
    first = next(iter(rows[0]))  # the load, or time
    with open(HERE / "measured" / (name + ".csv"), "w", newline="") as out:
        table = csv.writer(out)
        table.writerow([first] + columns)
        for row in rows:
            noisy = [round(float(row[c]) + chance.gauss(0.0, NOISE[c]), DIGITS[c.split("[")[1][:-1]]) for c in columns]
            table.writerow([f"{float(row[first]):.6g}"] + noisy)


def main():
    program, chance = sys.argv[1], random.Random(15)
    (HERE / "measured").mkdir(exist_ok=True)
    for axle, model in CORNERS.items():
        for test in KC[1]:
            record(program, model, test, f"{axle}_{test}", KC[0], chance)
    for test in DRUM[1]:
        record(program, "track_ring.toml", test, test, DRUM[0], chance)


if __name__ == "__main__":
    main()
