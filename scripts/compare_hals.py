#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Do both HALs give the same distributions? Runs worlds over many seeds with hal_sim and hal_dspic, each seed with robots
that differ a little (sensors' gain, wheels), and compares path, collisions and end of the first robot by the two-sample
Kolmogorov-Smirnov test. Writes the table of docs/time.md; exit 1 when a p is below 0.01.

  scripts/compare_hals.py BUILD [SEEDS] [SECONDS]
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

import generated

WORLDS = ["maze", "corridor", "lamp", "line", "flock", "soccer"]
IN_COMPANY = {"flock": 30, "soccer": 30}  # seeds at most: a run of hal_dspic takes seconds
PAGE = "docs/time.md"
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


def run(build, world, hal, seed, seconds):
    with tempfile.NamedTemporaryFile(suffix=".json") as summary:
        done = subprocess.run([build + "/twinpuck", "run", world, "--hal", hal, "--seed", str(seed),
                               "--for", str(seconds), "-q", "--uart", "*=none", "--summary", summary.name],
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit("%s, %s, seed %d: %s" % (world, hal, seed, done.stderr))
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
    lines = ["%d seeds (flock and soccer: 30) of %g s with each HAL; mean ± standard deviation of the first robot. Sensors' gains are spread by 5 %%, wheels "
             "by 1 %%.\n" % (seeds, seconds), "| world | figure | hal_sim | hal_dspic | p |", "|---|---|---|---|---|"]
    least = 1.0
    with concurrent.futures.ThreadPoolExecutor() as pool, tempfile.TemporaryDirectory() as folder:
        for world in WORLDS:
            file, count = with_spread(folder, world), min(seeds, IN_COMPANY.get(world, seeds))
            samples = [list(zip(*pool.map(lambda seed: run(build, file, hal, seed, seconds), range(1, count + 1))))
                       for hal in ("sim", "dspic")]
            for i, figure in enumerate(FIGURES):
                cells = [world, figure]
                for sample in samples:
                    mean = sum(sample[i]) / count
                    cells.append("%.3f ± %.3f" % (mean, math.sqrt(sum((v - mean) ** 2 for v in sample[i]) / count)))
                p = kolmogorov_smirnov(samples[0][i], samples[1][i])
                least = min(least, p)
                lines.append("| %s | %.2g |" % (" | ".join(cells), p))
                print(lines[-1], flush=True)
    page = open(PAGE).read()
    begin, end = generated.part(page, "hals")
    open(PAGE, "w").write(page[:begin] + "\n".join(lines) + "\n" + page[end:])
    sys.exit(0 if least >= 0.01 else 1)


main()
