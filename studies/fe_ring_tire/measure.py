#!/usr/bin/env python3
"""Writes what the finite-element tire tire.toml shows while it stands, vibrates, rolls and crosses every cleat of tests/: the
measurements of this study, some 17 minutes of processor time.

    python3 studies/fe_ring_tire/measure.py build/release/bin/latsch studies/fe_ring_tire/measured [standing | CLEAT ...]

With names it writes those alone: `standing`, or cleats such as held_3. Nothing is added: no noise, no rounding beyond the
digits written. Modes are those of the moduli at each frequency, with damping; loads and stiffnesses those of relaxed moduli.
The step over a cleat is STEP, whatever the test states for the ring; with STEP=0.25 in the environment it is 0.25 ms.
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
STEP = os.environ.get("STEP", "0.5")  # ms
DEFLECTIONS = [5, 10, 15, 20, 25]  # mm
# As in the studies, in the same order: what a cleat excites, and the lateral motions beside it.
MODES = ["torsional n=0", "radial n=1", "radial n=2", "radial n=3", "lateral n=0", "lateral n=1", "lateral n=2"]
TYPES = ["torsional", "lateral", "radial"]  # index: the code of the type in the channel


def record(program, test):
    """Returns the rows of a test of the tire, as the program prints them."""
    text = subprocess.run([program, "test", HERE / "tire.toml", test, "--quiet"], check=True, capture_output=True, text=True).stdout
    return list(csv.DictReader(text.splitlines()))


def write(folder, name, columns, rows):
    """Writes one file of the folder."""
    with open(folder / (name + ".csv"), "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns)
        table.writerows([[f"{float(row[column]):.7g}" for column in columns] for row in rows])


def standing(program, folder):
    """Writes loads, stiffnesses, modes and stiffnesses of free rolling."""
    depths = ", ".join(f'"{depth} mm"' for depth in DEFLECTIONS)
    write(folder, "loads", ["deflection [m]", "force [N]"], record(program, f'{{kind = "load_deflection", deflections = [{depths}]}}'))
    write(folder, "stiffness", ["longitudinal [N/m]", "lateral [N/m]", "torsional [N m/rad]"],
          record(program, '{kind = "static_stiffness", load = "4 kN", friction = 1, '
                          'directions = ["longitudinal", "lateral", "torsional"]}'))
    lowest = {}
    for row in record(program, '{kind = "modes", count = 40, damping = true}'):
        if int(float(row["type [1]"])) < len(TYPES):
            lowest.setdefault(f'{TYPES[int(float(row["type [1]"]))]} n={int(float(row["n [1]"]))}', row)
    write(folder, "modes", ["frequency [Hz]", "damping [1]"], [lowest[mode] for mode in MODES])
    write(folder, "rolling", ["slip_stiffness [N]", "cornering_stiffness [N/rad]", "pneumatic_trail [m]"],
          record(program, '{kind = "rolling_stiffness", load = "4 kN", measures = ["slip", "cornering"]}'))


def cleats(program, folder, names):
    """Writes the forces over cleats: those of the specimen of a comparison in which the ring takes no part."""
    text = (f'channels = ["Fx", "Fy", "Fz", "Mx", "My", "Mz"]\n[specimen]\nkind = "fe_tire"\nfile = "{HERE}/tire.toml"\n'
            f'step = "{STEP} ms"\n[tire.ring]\nkind = "ring_tire"\nfile = "{HERE}/ring.toml"\n')
    for name in names:
        text += f'[test.{name}]\nfile = "{HERE}/tests/{name}.toml"\n'
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as comparison:
        comparison.write(text)
        comparison.flush()
        subprocess.run([program, "compare", comparison.name, "--write-measurements", folder], check=True)


def main():
    program, folder, names = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3:]
    folder.mkdir(exist_ok=True)
    if not names or "standing" in names:
        standing(program, folder)
    chosen = [name for name in names if name != "standing"] if names else sorted(file.stem for file in (HERE / "tests").glob("*.toml"))
    if chosen:
        cleats(program, folder, chosen)


if __name__ == "__main__":
    main()
