#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Turns the peers' scene files (cm, rad: `L side`, `B x y angle side`, `R x y theta`) into bench/worlds/brait_N.toml.

usage: make_bench_worlds.py SCENE_DIR OUT_DIR
"""
import math
import pathlib
import sys

HEAD = """\
# SPDX-License-Identifier: MIT
# The common workload of docs/dev/performance.md: {robots} robot(s), made by scripts/make_bench_worlds.py from scene_{n}.txt.
twinpuck = 1
title = "braitenberg {n}"

[world]
physics_hz = 96

[arena]
size = [{side}, {side}]
centre = [{half}, {half}]

[proximity]
profile = "enki"
rays = 3
aperture = 30
noise_scale = 0
"""


def number(value):
    return f"{value:.8g}"


def convert(scene, n):
    boxes, robots, side = [], [], 0.0
    for line in scene.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        values = [float(w) for w in words[1:]]
        if words[0] == "L":
            side = values[0] / 100
        elif words[0] == "B":
            x, y, angle, size = values
            boxes.append((x / 100, y / 100, math.degrees(angle), size / 100))
        elif words[0] == "R":
            x, y, angle = values
            robots.append((x / 100, y / 100, math.degrees(angle)))
        else:
            sys.exit(f"{scene}: unknown line: got '{line}', expected L, B or R")
    out = [HEAD.format(robots=len(robots), n=n, side=number(side), half=number(side / 2))]
    for x, y, angle, size in boxes:
        out.append(f"[[box]]\nposition = [{number(x)}, {number(y)}]\nheading = {number(angle)}\n"
                   f"size = [{number(size)}, {number(size)}, {number(size)}]\n")
    for i, (x, y, angle) in enumerate(robots):
        out.append(f'[[robot]]\nname = "r{i}"\nfirmware = "bench_braitenberg"\n'
                   f"position = [{number(x)}, {number(y)}]\nheading = {number(angle)}\n")
    return "\n".join(out)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    source, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    for n in (1, 5, 10, 100, 1000):
        (target / f"brait_{n}.toml").write_text(convert(source / f"scene_{n}.txt", n))


if __name__ == "__main__":
    main()
