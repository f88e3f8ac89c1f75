#!/usr/bin/env python3
"""Writes what the laboratory recorded: the specimen on its four posts, a sweep and a road, 2 N of noise on every sample of a
push-rod.

    python3 studies/four_post/record.py build/release/bin/latsch
"""
import csv
import math
import pathlib
import random
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
CORNERS = ("FL", "FR", "RL", "RR")
STEP, DURATION = 0.0025, 10.0  # s
NOISE = 2.0  # N
LOWEST, HIGHEST = 0.5, 20.0  # Hz
VELOCITY = 0.03  # m/s, root mean square of a post
SPEED, WHEELBASE = 20.0, 1.55  # m/s, m


def road(chance):
    """Heights over time of both tracks: velocity white over the band [ISO 8608: density of height by the power -2], half of it
    common to both tracks."""
    lines = round((HIGHEST - LOWEST) * DURATION)
    frequency = [LOWEST + i / DURATION for i in range(lines)]
    phases = [[chance.uniform(0.0, 2.0 * math.pi) for _ in frequency] for _ in range(3)]
    peak = VELOCITY * math.sqrt(2.0 / lines)

    def height(which, t):
        return sum(peak / (2.0 * math.pi * f) * math.sin(2.0 * math.pi * f * t + phase)
                   for f, phase in zip(frequency, phases[which]))

    return lambda left, t: math.sqrt(0.5) * (height(0, t) + height(1 if left else 2, t))


def write_heights(file, chance):
    """The rear axle meets the road later; the posts begin and end level."""
    height = road(chance)
    with open(file, "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(["time [s]"] + [f"post_{corner} [m]" for corner in CORNERS])
        for i in range(round(DURATION / STEP) + 1):
            t = i * STEP
            fade = min(1.0, t / 0.5, (DURATION - t) / 0.5)
            rear = t - WHEELBASE / SPEED
            row = [fade * height(left, at) for at in (t, rear) for left in (True, False)]
            table.writerow([f"{t:.4f}"] + [f"{h:.7f}" for h in row])


def record(program, test, to, chance):
    whole = HERE / "measured" / "whole.csv"
    subprocess.run([program, "test", HERE / "specimen.toml", HERE / test, "-o", whole, "--quiet"], check=True)
    with open(whole) as file:
        rows = list(csv.DictReader(file))
    whole.unlink()
    posts, rods = [f"post_{c} [m]" for c in CORNERS], [f"pushrod_{c} [N]" for c in CORNERS]
    with open(HERE / "measured" / to, "w", newline="") as out:
        table = csv.writer(out)
        table.writerow(["time [s]"] + posts + rods)
        for row in rows:
            table.writerow([f"{float(row['time [s]']):.4f}"] + [f"{float(row[p]):.7f}" for p in posts] +
                           [f"{float(row[r]) + chance.gauss(0.0, NOISE):.1f}" for r in rods])


def main():
    program, chance = sys.argv[1], random.Random(15)
    (HERE / "measured").mkdir(exist_ok=True)
    heights = HERE / "measured" / "heights.csv"
    write_heights(heights, chance)
    record(program, "sweep.toml", "sweep.csv", chance)
    record(program, "road.toml", "road.csv", chance)
    heights.unlink()


if __name__ == "__main__":
    main()
