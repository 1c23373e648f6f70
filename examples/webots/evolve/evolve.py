#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Evolves the weights of controllers/candidate, with a simulation on every core. evolve.py --help"""
import argparse
import atexit
import os
import queue
import signal
import subprocess
import sys
import time
from multiprocessing.connection import Listener
from multiprocessing.pool import ThreadPool

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
WEIGHTS = 18

options = argparse.ArgumentParser(description=__doc__)
options.add_argument("--twinpuck", default="twinpuck", help="the simulator's command")
options.add_argument("--cores", type=int, default=len(os.sched_getaffinity(0)), help="simulations at once; all cores")
options.add_argument("--population", type=int, default=32)
options.add_argument("--generations", type=int, default=20)
options.add_argument("--seed", type=int, default=1)
options = options.parse_args()
BEST = os.path.join(HERE, "best.npy")
if not os.access(BEST if os.path.exists(BEST) else HERE, os.W_OK):
    sys.exit(f"evolve.py: {BEST}: got a place that cannot be written, expected one for the best weights; copy this folder")
chance = numpy.random.default_rng(options.seed)

# a simulation on every core; its candidate calls back
listener = Listener(family="AF_UNIX", backlog=options.cores)
command = [options.twinpuck, "run", os.path.join(HERE, "evolve.toml"), "--for", "1e6", "--speed", "max", "--quiet"]
signal.signal(signal.SIGCHLD, lambda *_: sys.exit("evolve.py: a simulation ended before it began: " + " ".join(command)))
runs = [subprocess.Popen(command, env=dict(os.environ, EVOLVE=listener.address, OMP_NUM_THREADS="1")) for _ in range(options.cores)]
atexit.register(lambda: [run.terminate() for run in runs])
free = queue.Queue()
for _ in runs:
    free.put(listener.accept())
signal.signal(signal.SIGCHLD, signal.SIG_DFL)


def judged(weights):
    """The fitness of a candidate, by whichever simulation is free."""
    line = free.get()
    try:
        line.send(weights)
        return line.recv()
    except (EOFError, OSError):
        raise SystemExit("evolve.py: a simulation ended early; its words are above") from None
    finally:
        free.put(line)


def children(parents, count):
    """Each of two parents, weight by weight, with a little chance."""
    pairs = parents[chance.integers(len(parents), size=(count, 2))]
    mixed = numpy.where(chance.random((count, WEIGHTS)) < 0.5, pairs[:, 0], pairs[:, 1])
    return mixed + chance.normal(0, 0.3, mixed.shape) * (chance.random(mixed.shape) < 0.3)


pool = ThreadPool(options.cores)
population = chance.normal(0, 1, (options.population, WEIGHTS))
began = time.monotonic()
for generation in range(options.generations):
    scores = numpy.array(pool.map(judged, population, chunksize=1))
    order = scores.argsort()[::-1]
    print("generation %2d: best %.3f, mean %.3f" % (generation, scores[order[0]], scores.mean()), flush=True)
    numpy.save(BEST, population[order[0]].reshape(2, 9))
    elite = population[order[:max(options.population // 4, 2)]]
    population = numpy.concatenate([elite[:2], children(elite, options.population - 2)])
trials = options.population * options.generations
print("%d trials in %.1f s on %d cores" % (trials, time.monotonic() - began, options.cores))

# without a line they quit
while not free.empty():
    free.get().close()
for run in runs:
    run.wait()
