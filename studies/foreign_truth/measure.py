#!/usr/bin/env python3
"""Writes what CalculiX computes of a tire: forces at three pressures; modes at one, off the
ground and standing, with shapes.

    python3 studies/foreign_truth/measure.py build/release/bin/latsch linear
    python3 studies/foreign_truth/measure.py build/release/bin/latsch quadratic

The decks are those of latsch export, cords smeared: `linear` as they are, C3D8; `quadratic`, of shipped_tire.toml, refined and with
nodes amid the edges, C3D20R: off the ground alone. Needs ccx on the path (Debian: calculix-ccx).
"""
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TIRE, SHIPPED_TIRE = HERE / "tire.toml", HERE / "shipped_tire.toml"
REFINED = {"meridional": 50, "rows_inside": 2}  # the mesh of the quadratic deck
PRESSURES = ["2.6", "2.2", "3.0"]  # bar, modes at the first
DEFLECTIONS = [5, 10, 15, 20, 25]  # mm
FREE, STANDING = 20, 12  # modes
AROUND = 12  # sections of the tire with sensors
FIRST_AMID = 100000  # number of the first node amid an edge, above those of the deck
EDGES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]  # of C3D20


class Deck:
    """Cards with the lines below them."""

    def __init__(self, text):
        self.cards = []
        for line in text.splitlines():
            if line.startswith("*") and not line.startswith("**"):
                self.cards.append((line, []))
            elif self.cards:
                self.cards[-1][1].append(line)

    def numbers(self, card):
        """Of all lines below the first card of this beginning, row by row."""
        return [[float(x) for x in line.split(",") if x.strip()] for line in self.below(card)]

    def below(self, card):
        return next(lines for name, lines in self.cards if name.startswith(card))

    def text(self):
        return "\n".join("\n".join([name] + lines) for name, lines in self.cards) + "\n"


def amid(a, b):
    """Halfway around the spin axis z from a to b, on the mean radius."""
    mean = [(p + q) / 2 for p, q in zip(a, b)]
    stretch = (math.hypot(a[0], a[1]) + math.hypot(b[0], b[1])) / 2 / math.hypot(mean[0], mean[1])
    return [mean[0] * stretch, mean[1] * stretch, mean[2]]


def make_quadratic(deck):
    at = {int(n): x for n, *x in deck.numbers("*NODE,NSET=TIRENODES")}
    held = {int(n) for row in deck.numbers("*NSET,NSET=RIM") for n in row}
    number = FIRST_AMID - 1
    middle, nodes, elements, rim = {}, [], [], []
    for element, *corners in ([int(x) for x in row] for row in deck.numbers("*ELEMENT,TYPE=C3D8,ELSET=TIRE")):
        edges = [tuple(sorted((corners[i], corners[j]))) for i, j in EDGES]
        for edge in edges:
            if edge in middle:
                continue
            number += 1
            middle[edge] = number
            nodes.append(f"{number}," + ",".join(f"{x:.12g}" for x in amid(at[edge[0]], at[edge[1]])))
            if set(edge) <= held:
                rim.append(f"{number},")
        mids = [str(middle[edge]) for edge in edges]
        elements += [",".join(map(str, [element] + corners)) + ",", ",".join(mids)]
    for k, (name, lines) in enumerate(deck.cards):
        if name.startswith("*NODE,NSET=TIRENODES"):
            lines += nodes
        elif name.startswith("*ELEMENT,TYPE=C3D8,ELSET=TIRE"):
            deck.cards[k] = (name.replace("C3D8", "C3D20R"), elements)
        elif name.startswith("*NSET,NSET=RIM"):
            lines += rim


def refined_tire(file):
    text = SHIPPED_TIRE.read_text()
    for key, value in REFINED.items():
        text = re.sub(rf"\n{key} = \d+", f"\n{key} = {value}", text)
    file.write_text(text.replace("\ncords =", '\nelement = "full_integration"\ncords ='))
    return file


def compute(program, kind, pressure, pressed, folder):
    """The deck, with forces printed at every fifth of the way, after CalculiX ran it in the folder."""
    ground = ["--deflection", f"{DEFLECTIONS[-1]} mm"] if pressed else []
    modes = ["--modes", str(0 if pressure != PRESSURES[0] else STANDING if pressed else FREE)]
    tire = TIRE if kind == "linear" else refined_tire(folder / "tire.toml")
    subprocess.run([program, "export", tire, "--ccx", folder / "tire.inp", "--pressure", pressure + " bar", "--quiet"] + ground +
                   modes, check=True)
    deck = Deck((folder / "tire.inp").read_text())
    if kind == "quadratic":
        make_quadratic(deck)
    (folder / "tire.inp").write_text(deck.text().replace("*NODE FILE,FREQUENCY=100", "*NODE FILE,FREQUENCY=1"))
    with open(folder / "tire.log", "w") as log:
        subprocess.run(["ccx", "-i", "tire"], cwd=folder, stdout=log, check=True, env=dict(os.environ, OMP_NUM_THREADS="1"))
    return deck


def forces(folder):
    """N, by the deflection in mm."""
    found = {}
    for time, force in re.findall(r"set GROUND and time +(\S+)\s+\S+ +(\S+)", (folder / "tire.dat").read_text()):
        found.setdefault(round((float(time) - 1.0) * DEFLECTIONS[-1], 6), float(force))
    return [found[d] for d in DEFLECTIONS]


def inflated_sizes(deck, folder, pressure):
    """Of every increment of the inflation: its pressure in the unit of `pressure`; mm, growth of the middle of the tread and
    section width, of corner nodes, as Latsch tells them."""
    at = {int(n): x for n, *x in deck.numbers("*NODE,NSET=TIRENODES") if n < FIRST_AMID}
    middle = max(at, key=lambda n: math.hypot(*at[n][:2]))  # where the crown is highest
    sizes = []
    for time, u in displacements(folder, at):
        moved = {n: [a + b for a, b in zip(at[n], u[n])] for n in at}
        across = [x[2] for x in moved.values()]
        sizes.append((time * pressure, math.hypot(*moved[middle][:2]) - math.hypot(*at[middle][:2]), max(across) - min(across)))
    return sizes


def displacements(folder, nodes):
    """Time and displacements of these nodes, of every static increment."""
    increments, time, has_displacements = [], None, False
    for line in open(folder / "tire.frd"):
        if line.startswith("  100CL"):
            time = None if "MODAL" in line else float(line[12:24])
        elif line.startswith(" -4"):
            has_displacements = time is not None and line.split()[1] == "DISP"
            if has_displacements:
                increments.append((time, {}))
        elif has_displacements and line.startswith(" -1") and int(line[3:13]) in nodes:
            increments[-1][1][int(line[3:13])] = [float(line[13 + 12 * i : 25 + 12 * i]) for i in range(3)]
    return increments


def shapes(folder, nodes):
    """Frequency and displacements of these nodes, of every mode."""
    modes, frequency = [], None
    for line in open(folder / "tire.frd"):
        if line.startswith("  100CL"):
            frequency = float(line[12:24]) if "MODAL" in line else None
            if frequency is not None:
                modes.append((frequency, {}))
        elif frequency is not None and line.startswith(" -1") and int(line[3:13]) in nodes:
            modes[-1][1][int(line[3:13])] = [float(line[13 + 12 * i : 25 + 12 * i]) for i in range(3)]
    return modes


def write(kind, name, header, rows):
    folder = HERE / kind
    folder.mkdir(exist_ok=True)
    with open(folder / (name + ".csv"), "w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(header)
        table.writerows(rows)


def write_modes(kind, prefix, deck, folder):
    at = {int(n): x for n, *x in deck.numbers("*NODE,NSET=TIRENODES") if n < FIRST_AMID}
    sensors = [int(n) for n in deck.numbers("*NSET,NSET=SENSORS")[0]]
    alike = lambda x, y: abs(x[2] - y[2]) < 1e-6 and abs(math.hypot(*x[:2]) - math.hypot(*y[:2])) < 1e-6
    sectors = sum(alike(x, at[sensors[0]]) for x in at.values())
    per_sector = len(at) // sectors
    nodes = [n + per_sector * s for s in range(0, sectors, sectors // AROUND) for n in sensors[::2]]
    modes = shapes(folder, set(nodes))
    write(kind, prefix + "modes", ["frequency [Hz]"], [[f"{f:.5f}"] for f, _ in modes])
    wheel = lambda v: [v[0], -v[2], v[1]]  # the deck has y up and z along -y of the wheel
    rows = []
    for k, (_, shape) in enumerate(modes):
        largest = max(abs(x) for u in shape.values() for x in u)
        rows += [[k + 1] + [f"{x + 0:.3f}" for x in wheel(at[n])] + [f"{x / largest + 0:.4f}" for x in wheel(shape[n])]
                 for n in nodes]
    write(kind, prefix + "mode_shapes", ["mode", "x [mm]", "y [mm]", "z [mm]", "ux", "uy", "uz"], rows)


def main():
    program, kind = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    def computed(pressure, pressed, write_results):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_results(compute(program, kind, pressure, pressed, folder), folder)

    def write_forces(pressure, folder):
        write(kind, f"stiffness_{pressure.replace('.', '')}bar", ["deflection [mm]", "force [N]"],
              [[d, f"{F:.3f}"] for d, F in zip(DEFLECTIONS, forces(folder))])

    def write_standing(deck, folder):
        write_forces(PRESSURES[0], folder)
        write_modes(kind, "standing_", deck, folder)

    def write_free(deck, folder):
        write_modes(kind, "free_", deck, folder)
        sizes = inflated_sizes(deck, folder, float(PRESSURES[0]))
        write(kind, "inflated", ["pressure [bar]", "growth [mm]", "section_width [mm]"],
              [[f"{p:.6g}", f"{growth:.6f}", f"{width:.6f}"] for p, growth, width in sizes])

    computed(PRESSURES[0], False, write_free)
    if kind == "quadratic":  # contact of quadratic elements takes long
        return
    computed(PRESSURES[0], True, write_standing)
    for pressure in PRESSURES[1:]:
        computed(pressure, True, lambda deck, folder: write_forces(pressure, folder))


if __name__ == "__main__":
    main()
