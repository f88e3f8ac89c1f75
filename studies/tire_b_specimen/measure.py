#!/usr/bin/env python3
"""Writes what a laboratory measured of the three specimens, with noise: force 0.5 %, frequencies 0.3 %, shapes 0.01, patch 1.5 %, stiffnesses 2 %.

    python3 studies/tire_b_specimen/measure.py build/release/bin/latsch
"""
import csv
import math
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
FORCE, FREQUENCY, PATCH, STIFFNESS = 0.005, 0.003, 0.015, 0.02  # standard deviations, shares of the value
PRESSURES = ["2.0", "2.6", "3.2"]  # bar
MODE = ["frequency [Hz]", "n", "type", "phase"]
DEFLECTIONS = [5, 10, 15, 20, 25]  # mm
SHAPE = 0.01  # of about the largest displacement
# Reference modes of ../tire_b_stiffness_transfer: the belt as a rigid body (1), (3), and bent (5).
REFERENCE = [["0", "lateral", "s"], ["0", "torsional", "a"], ["1", "radial", "s"], ["2", "radial", "s"], ["3", "radial", "s"]]


class Rig:
    """Measures one specimen; tables go into a folder."""

    def __init__(self, program, tire, folder, noise=1.0):
        self.program, self.tire, self.folder = program, HERE / tire, HERE / folder
        self.noise = noise  # times that of the other rigs
        self.chance = random.Random(16)
        self.folder.mkdir(exist_ok=True)

    def noisy(self, text, share):
        return float(text) * (1.0 + self.chance.gauss(0.0, self.noise * share))

    def record(self, test):
        done = subprocess.run([self.program, "test", self.tire, test], check=True, capture_output=True, text=True)
        return list(csv.DictReader(done.stdout.splitlines()))

    def write(self, name, header, rows):
        with open(self.folder / (name + ".csv"), "w", newline="") as out:
            table = csv.writer(out, lineterminator="\n")
            table.writerow(header)
            table.writerows(rows)

    def press(self, pressure):
        depths = ", ".join(f'"{d} mm"' for d in DEFLECTIONS)
        rows = self.record(f'{{kind = "load_deflection", pressure = "{pressure} bar", deflections = [{depths}]}}')
        self.write(f"stiffness_{pressure.replace('.', '')}bar", ["deflection [mm]", "force [N]"],
                   [[d, f'{self.noisy(row["force [N]"], FORCE):.1f}'] for d, row in zip(DEFLECTIONS, rows)])

    def exported(self, name):
        with open(self.folder / (name + ".csv")) as file:
            return list(csv.reader(line for line in file if not line.startswith("#")))[1:]

    def vibrate(self):
        """Modes and shapes, of which every second section around the tire is kept; returns the modes."""
        study = HERE / "laboratory.tmp.toml"
        study.write_text((HERE / "laboratory.toml").read_text().replace("specimen.toml", self.tire.name)
                         .replace("measured/", self.folder.name + "/"))
        for name in ("modes", "mode_shapes"):
            (self.folder / (name + ".csv")).unlink(missing_ok=True)
        subprocess.run([self.program, "export", study, "--measurements", "--quiet"], check=True)
        study.unlink()
        modes = [[f"{self.noisy(frequency, FREQUENCY):.3f}", *label] for frequency, *label in self.exported("modes")]
        self.write("modes", MODE, modes)
        points = [[row[0]] + [float(x) for x in row[1:]] for row in self.exported("mode_shapes")]
        angle = lambda row: round(math.degrees(math.atan2(row[1], -row[3])) % 360.0, 1)
        kept = sorted({angle(row) for row in points})[::2]
        self.write("mode_shapes", ["mode", "x [mm]", "y [mm]", "z [mm]", "ux", "uy", "uz"],
                   [row[:1] + [f"{x + 0:.2f}" for x in row[1:4]] + [f"{u + self.chance.gauss(0.0, SHAPE):.3f}" for u in row[4:]]
                    for row in points if angle(row) in kept])
        return modes

    def vibrate_by_number(self):
        """Also as few reference modes as ../tire_b_stiffness_transfer asks for."""
        modes = self.vibrate()
        for count in (1, 3, 5):
            self.write(f"modes_{count}", MODE, [next(m for m in modes if m[1:] == label) for label in REFERENCE[:count]])

    def print_foot(self):
        rows = self.record('{kind = "footprint", loads = ["3 kN", "5 kN"]}')
        columns = (("length [m]", 1e3), ("width [m]", 1e3), ("area [m^2]", 1e4))
        self.write("footprint", ["load [N]", "length [mm]", "width [mm]", "area [cm^2]"],
                   [[f'{float(row["load [N]"]):.0f}'] + [f"{self.noisy(row[c], PATCH) * unit:.2f}" for c, unit in columns]
                    for row in rows])

    def pull(self):
        row = self.record('{kind = "static_stiffness", load = "4 kN", friction = 1.0, '
                          'directions = ["lateral", "longitudinal", "torsional"]}')[0]
        columns = (("lateral [N/m]", 1e-3), ("longitudinal [N/m]", 1e-3), ("torsional [N m/rad]", math.pi / 180.0))
        self.write("standing", ["lateral [N/mm]", "longitudinal [N/mm]", "torsional [N m/deg]"],
                   [[f"{self.noisy(row[c], STIFFNESS) * unit:.2f}" for c, unit in columns]])


def main():
    rig = Rig(sys.argv[1], "specimen.toml", "measured")
    for pressure in PRESSURES:
        rig.press(pressure)
    rig.vibrate_by_number()
    rig.print_foot()
    rig.pull()
    rig = Rig(sys.argv[1], "nearly_one_rubber.toml", "measured_nearly_one_rubber")
    rig.press("2.6")
    rig.vibrate()
    rig = Rig(sys.argv[1], "soft_sidewall.toml", "measured_soft_sidewall", noise=1 / 3)
    rig.press("2.6")
    rig.vibrate_by_number()


if __name__ == "__main__":
    main()
