#!/usr/bin/env python3
"""Writes what a laboratory measured of the specimen, with noise: force 0.5 % at three pressures, 20 unloaded
frequencies 0.3 %, their shapes 0.01.

    python3 studies/tire_a/measure.py build/release/bin/latsch
"""
import csv
import math
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FORCE, FREQUENCY = 0.005, 0.003  # standard deviations, shares of the value
PRESSURES = ["2.1", "2.5", "2.9"]  # bar
DEFLECTIONS = [5, 10, 15, 20, 25]  # mm
SHAPE = 0.01  # of about the largest displacement


def record(program, test):
    text = subprocess.run([program, "test", HERE / "specimen.toml", test], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(text.splitlines()))


def exported(name):
    with open(HERE / "measured" / (name + ".csv")) as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))[1:]


def write(name, header, rows):
    with open(HERE / "measured" / (name + ".csv"), "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)


def main():
    program, chance = sys.argv[1], random.Random(16)
    noisy = lambda text, share: float(text) * (1.0 + chance.gauss(0.0, share))
    (HERE / "measured").mkdir(exist_ok=True)
    depths = ", ".join(f'"{d} mm"' for d in DEFLECTIONS)
    for pressure in PRESSURES:
        rows = record(program, f'{{kind = "load_deflection", pressure = "{pressure} bar", deflections = [{depths}]}}')
        write(f"stiffness_{pressure.replace('.', '')}bar", ["deflection [mm]", "force [N]"],
              [[d, f'{noisy(row["force [N]"], FORCE):.1f}'] for d, row in zip(DEFLECTIONS, rows)])
    for name in ("modes", "mode_shapes"):
        (HERE / "measured" / (name + ".csv")).unlink(missing_ok=True)
    subprocess.run([program, "export", HERE / "laboratory.toml", "--measurements", "--quiet"], check=True)
    modes = [[f"{noisy(frequency, FREQUENCY):.3f}", *label] for frequency, *label in exported("modes")]
    write("modes", ["frequency [Hz]", "n", "type"], [mode[:3] for mode in modes])
    points = [[row[0]] + [float(x) for x in row[1:]] for row in exported("mode_shapes")]
    angles = sorted({round(math.degrees(math.atan2(row[1], -row[3])) % 360.0, 1) for row in points})
    kept = [row for row in points if angles.index(round(math.degrees(math.atan2(row[1], -row[3])) % 360.0, 1)) % 2 == 0]
    write("mode_shapes", ["mode", "x [mm]", "y [mm]", "z [mm]", "ux", "uy", "uz"],
          [row[:1] + [f"{x + 0:.2f}" for x in row[1:4]] + [f"{u + chance.gauss(0.0, SHAPE):.3f}" for u in row[4:]] for row in kept])


if __name__ == "__main__":
    main()
