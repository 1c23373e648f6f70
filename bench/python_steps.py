#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What Python costs: a world stepped tick by tick with a look at all poses and sensors after each, beside the same in C++
and beside a run that nobody looks at. Processor time, best of five, interleaved.

    PYTHONPATH=build/python bench/python_steps.py BUILD [WORLD [SECONDS]]
"""
import subprocess
import sys
import time

import twinpuck


def in_python(world_file, seconds):
    """Seconds of processor time, and the digest."""
    with twinpuck.World(world_file) as world:
        began, total = time.process_time(), 0.0
        while world.time_s < seconds:
            world.step()
            poses, proximity = world.poses, world.proximity
            total += poses[0, 0] + proximity[0, 0]
        return time.process_time() - began, world.digest


def unseen(world_file, seconds):
    """The same run, in one go."""
    with twinpuck.World(world_file) as world:
        began = time.process_time()
        world.run(seconds)
        return time.process_time() - began, world.digest


def in_cpp(build, world_file, seconds):
    words = subprocess.run([f"{build}/bin/bench_steps", world_file, str(seconds)], text=True, capture_output=True,
                           check=True).stdout.split()
    return float(words[0]), words[1]


def main():
    build = sys.argv[1]
    world_file = sys.argv[2] if len(sys.argv) > 2 else "bench/worlds/brait_100.toml"
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 20.0
    best, digests = {}, set()
    for _ in range(5):
        for name, run in (("C++", lambda: in_cpp(build, world_file, seconds)),
                          ("Python", lambda: in_python(world_file, seconds)), ("unseen", lambda: unseen(world_file, seconds))):
            took_s, digest = run()
            best[name] = min(took_s, best.get(name, 1e9))
            digests.add(digest)
    print(f"{world_file}, {seconds:g} s: C++ {best['C++']:.3f} s, Python {best['Python']:.3f} s, "
          f"{best['Python'] / best['C++']:.2f} times; the run that nobody looks at {best['unseen']:.3f} s")
    if len(digests) != 1:
        sys.exit("the digests differ")


main()
