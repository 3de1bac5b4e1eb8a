#!/usr/bin/env python3
"""Writes a tool path that opens the mastoid cortex of a case of one ear.

usage: mastoid-path.py PETROUS LIBRARY CASE OUT.csv

The cortex is found by asking the case itself (`petrous probe`): rays run from the lateral
border towards the middle until they meet tissue. The path then sweeps a window behind the ear
canal in layers, the burr's centre a little deeper each time, the shaft pointing laterally and up. Each
layer is one stroke. All positions are patient LPS, mm.
"""
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

BEHIND, ABOVE = 8.0, 5.0  # centre of the window from the centre of the scan: +y, +z
WINDOW = 9.0               # edge of the window
ROW, STEP = 1.5, 0.5       # between rows, and between points of a row
RADIUS = 2.0               # of the burr: the command's default
DEPTHS = (1.5, 3.0, 4.5)   # of the burr's tip below the cortex, one per layer
LIFT = 6.0                 # above the cortex between layers
FEED = 6.0                 # mm/s
TILT = math.radians(40.0)  # of the shaft above the horizontal: a burr cuts with its side
RAY_STEP = 0.25


def petrous(program, *arguments):
    return subprocess.run([program, *arguments], check=True, stdout=subprocess.PIPE, text=True).stdout


def corners(ct):
    """Patient positions of the grid's eight corners."""
    axes = [[ct["direction"][3 * row + column] for row in range(3)] for column in range(3)]
    reach = [(n - 1) * s for n, s in zip(ct["dims"], ct["spacing_mm"])]
    for chosen in range(8):
        yield [ct["origin_mm"][row]
               + sum(axes[a][row] * reach[a] for a in range(3) if chosen >> a & 1)
               for row in range(3)]


def cortex(program, library, case, lateral, depth, columns):
    """x of the first tissue from the lateral side for each (y, z); None where there is none."""
    count = int(depth / RAY_STEP)
    with tempfile.TemporaryDirectory() as folder:
        points, values = Path(folder, "points.csv"), Path(folder, "values.csv")
        with points.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["x_mm", "y_mm", "z_mm"])
            for y, z in columns:
                for i in range(count):
                    x = lateral - math.copysign(i * RAY_STEP, lateral)
                    writer.writerow([f"{x:.4f}", f"{y:.4f}", f"{z:.4f}"])
        petrous(program, "probe", case, "--library", library, "--points", str(points),
                "--out", str(values))
        with values.open(newline="") as file:
            field = [float(row["f"]) for row in csv.DictReader(file)]
    found = []
    for column in range(len(columns)):
        ray = field[column * count:(column + 1) * count]
        hit = next((i for i, f in enumerate(ray) if f > 0), None)
        found.append(None if hit is None else lateral - math.copysign(hit * RAY_STEP, lateral))
    return found


def window_columns(centre):
    """(y, z) of the sweep, to and fro."""
    rows = int(WINDOW / ROW) + 1
    steps = int(WINDOW / STEP) + 1
    for r in range(rows):
        y = [centre[1] + BEHIND - WINDOW / 2 + s * STEP for s in range(steps)]
        for value in (y if r % 2 == 0 else reversed(y)):
            yield value, centre[2] + ABOVE - WINDOW / 2 + r * ROW


def main(program, library, case, out):
    ct = json.loads(petrous(program, "info", case, "--library", library, "--json"))["ct"]
    box = list(corners(ct))
    centre = [sum(c[a] for c in box) / 8 for a in range(3)]
    side = math.copysign(1.0, centre[0])  # +1: left ear
    lateral = max((c[0] for c in box), key=lambda x: side * x)
    columns = list(window_columns(centre))
    surface = cortex(program, library, case, lateral, abs(lateral - centre[0]), columns)
    sweep = [(x, y, z) for x, (y, z) in zip(surface, columns) if x is not None]
    if not sweep:
        sys.exit(f"mastoid-path: {case}: no bone behind the ear canal")

    turn = math.pi / 4 - TILT / 2
    # Rotates the shaft's +z to lateral and up.
    heading = [math.cos(turn), 0.0, side * math.sin(turn), 0.0]
    time, previous, rows = 0.0, None, []

    def move(x, y, z, drill):
        nonlocal time, previous
        if previous is not None:
            time += max(math.dist(previous, (x, y, z)) / FEED, 1e-3)
        previous = (x, y, z)
        rows.append([f"{time:.4f}", f"{x:.4f}", f"{y:.4f}", f"{z:.4f}",
                     *(f"{q:.9f}" for q in heading), drill])

    for depth in DEPTHS:
        height = RADIUS - depth  # of the burr's centre above the cortex
        first, last = sweep[0], sweep[-1]
        move(first[0] + side * LIFT, first[1], first[2], 0)
        for x, y, z in sweep:
            move(x + side * height, y, z, 1)
        move(last[0] + side * LIFT, last[1], last[2], 0)

    with open(out, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow("t_s x_mm y_mm z_mm qw qx qy qz drill".split())
        writer.writerows(rows)


if __name__ == "__main__":
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    try:
        main(*sys.argv[1:])
    except subprocess.CalledProcessError as error:  # the program has printed the error
        sys.exit(error.returncode)
