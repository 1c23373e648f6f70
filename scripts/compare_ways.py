#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Do the ways give the same distributions? Runs worlds over many seeds in each (the chip way: fewer), each seed with
robots that differ a little (sensors' gain, wheels), and compares path, collisions and end of the first robot by the
two-sample Kolmogorov-Smirnov test.

  scripts/compare_ways.py BUILD [SEEDS] [SECONDS] > docs/ways.md
"""
import concurrent.futures
import glob
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

WORLDS = ["maze", "corridor", "lamp", "line", "flock", "soccer"]
CHIP_SEEDS = 30  # it takes 5 to 10 times as long
FIGURES = ["path (m)", "collisions", "end, from the origin (m)"]
SPREAD = "[robot.variation]\ngain_spread = 0.05\nwheel_spread = 0.01\n\n"


def with_spread(folder, world):
    """A copy of the world in which every robot differs from its model, another way with each seed."""
    text = open("worlds/%s.toml" % world).read()
    parts = re.split(r"(?m)^(?=\[\[)", text)
    parts = [part.rstrip() + "\n\n" + SPREAD if part.startswith("[[robot]]") else part for part in parts]
    for picture in glob.glob("worlds/*.png"):
        shutil.copy(picture, folder)
    path = os.path.join(folder, world + ".toml")
    open(path, "w").write("".join(parts))
    return path


def run(build, world, way, seed, seconds):
    with tempfile.NamedTemporaryFile(suffix=".json") as summary:
        done = subprocess.run([build + "/twinpuck", "run", world, "--way", way, "--seed", str(seed),
                               "--for", str(seconds), "-q", "--uart", "*=none", "--summary", summary.name],
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit("%s, %s, seed %d: %s" % (world, way, seed, done.stderr))
        robot = json.load(open(summary.name))["robots"][0]
    return robot["distance_m"], robot["collisions"], math.hypot(robot["x_m"], robot["y_m"])


def kolmogorov_smirnov(a, b):
    """p of the largest distance between two samples' distributions, by its limit for large samples."""
    values = sorted(set(a) | set(b))
    largest = max(abs(sum(x <= v for x in a) / len(a) - sum(x <= v for x in b) / len(b)) for v in values)
    n = math.sqrt(len(a) * len(b) / (len(a) + len(b)))
    z = (n + 0.12 + 0.11 / n) * largest
    return 1.0 if z < 0.2 else min(1.0, 2 * sum((-1) ** (k - 1) * math.exp(-2 * (k * z) ** 2) for k in range(1, 101)))


def main():
    build, seeds, seconds = sys.argv[1], int((sys.argv + [""] * 2)[2] or 100), float((sys.argv + [""] * 3)[3] or 60)
    ways = {"native": seeds, "register": seeds, "chip": min(seeds, CHIP_SEEDS)}
    print("# The ways compared\n")
    print("Each world runs %d seeds of %g s in the native and in the register way, %d in the chip way. `p` is that of the\n"
          "two-sample Kolmogorov-Smirnov test against the native way: below 0.01 the ways differ. Sensors' gains are spread by\n"
          "5 %%, wheels by 1 %%. Figures are mean ± standard deviation of the first robot.\n" % (seeds, seconds, ways["chip"]))
    print("Made by `scripts/compare_ways.py build > docs/ways.md`.\n")
    print("| world | figure | native | register | p | chip | p |\n|---|---|---|---|---|---|---|")
    least = 1.0
    with concurrent.futures.ThreadPoolExecutor() as pool, tempfile.TemporaryDirectory() as folder:
        for world in WORLDS:
            file = with_spread(folder, world)
            samples = {}
            for way, count in ways.items():
                samples[way] = list(zip(*pool.map(lambda seed: run(build, file, way, seed, seconds), range(1, count + 1))))
            for i, figure in enumerate(FIGURES):
                cells = [world, figure]
                for way in ways:
                    values = samples[way][i]
                    mean = sum(values) / len(values)
                    cells.append("%.3f ± %.3f" % (mean, math.sqrt(sum((v - mean) ** 2 for v in values) / len(values))))
                    if way == "native":
                        continue
                    p = kolmogorov_smirnov(samples["native"][i], values)
                    least = min(least, p)
                    cells.append("%.2g" % p)
                print("| %s |" % " | ".join(cells), flush=True)
    sys.exit(0 if least >= 0.01 else 1)


main()
