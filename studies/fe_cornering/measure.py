#!/usr/bin/env python3
"""Writes what a laboratory would measure of tire.toml, with noise: the files of measured/.

    python3 studies/fe_cornering/measure.py build/release/bin/latsch

Standard deviations are shares of the value: loads 1 %, frequencies 0.5 %, slip and cornering stiffness 2 %, trail 3 %. Those of
the side forces are 1.5 % of the largest side force of the file.
"""
import csv
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
DEFLECTIONS = [8, 14, 20, 26, 32]  # mm
MODES = 10
TYPES = {"0": "torsional", "1": "lateral", "2": "radial"}


def record(program, test):
    """Returns the rows of a test of the tire, as the program prints them."""
    text = subprocess.run([program, "test", HERE / "tire.toml", test, "--quiet"], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(text.splitlines()))


def write(name, header, rows):
    """Writes one file of measured/."""
    with open(HERE / "measured" / (name + ".csv"), "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)


def side_forces(program, name, chance):
    """Writes the states of a table with the side forces that the tire has there."""
    with open(HERE / f"{name}_states.csv") as file:
        states = list(csv.DictReader(file))
    forces = [float(row["Fy [N]"]) for row in record(program, f'{{kind = "steady_states", states = "{HERE}/{name}_states.csv"}}')]
    noise = 0.015 * max(abs(force) for force in forces)
    write(name, [*states[0], "Fy [N]"],
          [[*state.values(), f"{force + chance.gauss(0.0, noise):.0f}"] for state, force in zip(states, forces)])


def main():
    program, chance = sys.argv[1], random.Random(50)
    noisy = lambda text, share: float(text) * (1.0 + chance.gauss(0.0, share))
    (HERE / "measured").mkdir(exist_ok=True)
    depths = ", ".join(f'"{depth} mm"' for depth in DEFLECTIONS)
    rows = record(program, f'{{kind = "load_deflection", deflections = [{depths}]}}')
    write("loads", ["deflection [mm]", "force [N]"],
          [[depth, f'{noisy(row["force [N]"], 0.01):.0f}'] for depth, row in zip(DEFLECTIONS, rows)])
    rows = record(program, f'{{kind = "modes", count = {MODES}}}')
    lowest = {(row["n [1]"], TYPES[row["type [1]"]]): row["frequency [Hz]"] for row in reversed(rows)}  # one of each pair
    write("modes", ["frequency [Hz]", "n", "type"],
          [[f"{noisy(frequency, 0.005):.2f}", *name] for name, frequency in sorted(lowest.items(), key=lambda mode: float(mode[1]))])
    row = record(program, '{kind = "rolling_stiffness", load = "4 kN", measures = ["slip", "cornering"]}')[0]
    write("rolling", ["slip_stiffness [N]", "cornering_stiffness [N/rad]", "pneumatic_trail [mm]"],
          [[f'{noisy(row["slip_stiffness [N]"], 0.02):.0f}', f'{noisy(row["cornering_stiffness [N/rad]"], 0.02):.0f}',
            f'{1e3 * noisy(row["pneumatic_trail [m]"], 0.03):.2f}']])
    side_forces(program, "cornering", chance)
    side_forces(program, "held_out", chance)


if __name__ == "__main__":
    main()
