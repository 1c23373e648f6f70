#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Error of the cycle estimate against exact counts of XC16 code, and the fit of its numbers.

Compiles tests/cc/xc16-cycles/src with twinpuck-cc, counts how often each segment ran, and prints the error of own
cycles per function. --folds N also fits the "xc16-cycles: fit" numbers of cost_params.h N times without a share of
the files and predicts those; --fit prints the numbers fitted to all files. Needs gcc and the Python library only.

  scripts/fit_cycles.py [--build build] [--level=-O1] [--list] [--folds 6] [--fit] [--data DIR]
"""
import argparse
import concurrent.futures
import csv
import ctypes
import os
import re
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HOST = ("struct { long long a, b; } tp_ctl __attribute__((visibility(\"hidden\")));\n"
        "long long tp_bench_counts[4096]; unsigned short LATG, PORTG, TRISG;\n"
        "void tp_poll(long long id) {}\nvoid tp_trap(long long kind) {}\n")


def rules():
    """name -> (cycles, is fitted), from cost_params.h."""
    text = open(os.path.join(ROOT, "hal_sim/cc/cost_params.h")).read()
    found = re.findall(r"R\((\w+), (-?[\d.]+), \"\[(.*?)\]", text)
    return {name: (float(cycles), tag == "xc16-cycles: fit") for name, cycles, tag in found}


def measure(args, source, work):
    """function -> {rule: occurrences while bench_run() ran once}"""
    base = os.path.join(work, os.path.basename(source)[:-2])
    subprocess.run([os.path.join(args.build, "twinpuck-cc"), "-c", source, "-o", base + ".o", args.level,
                    "-fvisibility=default", "--cost-dump", base + ".dump"], check=True)
    subprocess.run(["gcc", "-shared", "-fPIC", base + ".o", os.path.join(work, "host.c"), "-o", base + ".so"], check=True)
    image = ctypes.CDLL(base + ".so")
    image.bench_run()
    counts = (ctypes.c_longlong * 4096).in_dll(image, "tp_bench_counts")
    functions = {}
    table = rules()
    for line, count in zip(open(base + ".dump"), counts):
        name, *pairs = line.split()
        features = functions.setdefault(name, {})
        whole = round(sum(table[p.split("=")[0]][0] * float(p.split("=")[1]) for p in pairs))
        features["rounded"] = features.get("rounded", 0) + whole * count
        for pair in pairs:
            rule, times = pair.split("=")
            features[rule] = features.get(rule, 0) + float(times) * count
    return functions


def samples(args):
    """(function, file, exact own cycles, features) of every row of cycles.csv."""
    rows = [r for r in csv.DictReader(open(os.path.join(args.data, "cycles.csv"))) if r["opt"] == args.level]
    files = sorted({r["file"] for r in rows})
    with tempfile.TemporaryDirectory() as work, concurrent.futures.ThreadPoolExecutor(2) as pool:
        open(os.path.join(work, "host.c"), "w").write(HOST)
        sources = [os.path.join(args.data, "src", f) for f in files]
        measured = dict(zip(files, pool.map(lambda s: measure(args, s, work), sources)))
    result = []
    for r in rows:
        helper = r["role"] == "helper"
        total = {}
        for name, features in measured[r["file"]].items():
            if name == r["function"] if helper else name != "bench_run":
                for rule, times in features.items():
                    total[rule] = total.get(rule, 0) + times
        result.append((r["function"], r["file"], float(r["cycles_self" if helper else "cycles_own"]), total))
    return result


def predict(cycles, features):
    return sum(cycles[rule] * times for rule, times in features.items() if rule in cycles)


def fit(data, expected, fitted, pull):
    """Coordinate descent on a robust relative error, every number drawn to its expected value."""
    cycles = dict(expected)
    for _ in range(40):
        # least absolute errors by reweighting: a function that no rule describes must not bend them all
        weights, residues = [], []
        for _, _, exact, features in data:
            e = (predict(cycles, features) - exact) / exact
            residues.append(e)
            weights.append(1 / max(abs(e), 0.04))
        for rule in fitted:
            top = bottom = 0.0
            for n, (_, _, exact, features) in enumerate(data):
                if rule not in features:
                    continue
                share = features[rule] / exact
                top -= weights[n] * share * residues[n]
                bottom += weights[n] * share * share
            # the pull counts like `pull` functions in which the rule makes up a tenth of the time
            strength = pull * 0.01 / 0.1
            change = (top + strength * (expected[rule] - cycles[rule]) / max(expected[rule], 0.5) ** 2) / (
                bottom + strength / max(expected[rule], 0.5) ** 2)
            change = max(change, -cycles[rule])
            if change == 0:
                continue
            cycles[rule] += change
            for n, (_, _, exact, features) in enumerate(data):
                if rule in features:
                    residues[n] += features[rule] * change / exact
    return cycles


def summary(title, errors):
    errors = sorted(errors, key=lambda e: abs(e[0]))
    n = len(errors)
    ninth = errors[min(n - 1, -(-n * 9 // 10) - 1)][0]
    print("%-26s median %.1f %%, nine in ten within %.1f %%, worst %.1f %% (%s)" % (
        title, abs(errors[n // 2][0]) * 100, abs(ninth) * 100, abs(errors[-1][0]) * 100, errors[-1][1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=os.path.join(ROOT, "build"))
    parser.add_argument("--data", default=os.path.join(ROOT, "tests/cc/xc16-cycles"))
    parser.add_argument("--level", default="-O1")
    parser.add_argument("--list", action="store_true", help="one line per function, best first")
    parser.add_argument("--folds", type=int, default=0)
    parser.add_argument("--fit", action="store_true")
    parser.add_argument("--pull", type=float, default=1.0, help="strength of the pull to the expected values")
    args = parser.parse_args()
    table = rules()
    cycles = {name: value for name, (value, _) in table.items()}
    fitted = [name for name, (_, is_fitted) in table.items() if is_fitted]
    data = samples(args)
    errors = [(predict(cycles, features) / exact - 1, name) for name, _, exact, features in data]
    if args.list:
        for (error, name), (_, _, exact, features) in sorted(zip(errors, data), key=lambda e: abs(e[0][0])):
            parts = " ".join("%s=%g" % p for p in sorted(features.items()))
            print("%6.1f %%  exact %6.0f  estimate %8.1f  %-20s %s" % (error * 100, exact, predict(cycles, features), name, parts))
    summary("%d functions, %s:" % (len(data), args.level), errors)
    summary("rounded by segment:", [(f["rounded"] / exact - 1, name) for name, _, exact, f in data])
    if args.folds:
        files = sorted({d[1] for d in data})
        left_out = []
        for k in range(args.folds):
            away = set(files[k::args.folds])
            numbers = fit([d for d in data if d[1] not in away], cycles, fitted, args.pull)
            left_out += [(predict(numbers, d[3]) / d[2] - 1, d[0]) for d in data if d[1] in away]
        summary("left out, %d folds:" % args.folds, left_out)
    if args.fit:
        numbers = fit(data, cycles, fitted, args.pull)
        summary("fitted:", [(predict(numbers, d[3]) / d[2] - 1, d[0]) for d in data])
        for rule in fitted:
            print("  %-20s %6.2f -> %6.2f" % (rule, cycles[rule], numbers[rule]))
    return 0


if __name__ == "__main__":
    sys.exit(main())
