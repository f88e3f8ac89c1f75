#!/usr/bin/env python3
"""Writes what a drum rig recorded whose load cell and clock are off: the recordings of ../cleat_fit, with gains and delays.

    python3 studies/drum_nuisance/measure.py
"""
import csv
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
GAIN = {"Fx [N]": 0.025, "Fz [N]": -0.015}      # the cell shows 2.5 % too much and 1.5 % too little
DELAY = {"slow": 2.3e-3, "fast": -0.9e-3}       # s; positive: recorded later than it happened


def main():
    for name, delay in DELAY.items():
        with open(HERE.parent / "cleat_fit" / "measured" / (name + ".csv")) as file:
            rows = list(csv.DictReader(file))
        with open(HERE / "measured" / (name + ".csv"), "w", newline="") as out:
            table = csv.writer(out, lineterminator="\n")
            table.writerow(["time [s]"] + list(GAIN))
            for row in rows:
                forces = [f"{(1.0 + gain) * float(row[channel]):.1f}" for channel, gain in GAIN.items()]
                table.writerow([f"{float(row['time [s]']) + delay:.4f}"] + forces)


if __name__ == "__main__":
    main()
