#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants small faults in the product's C++ sources and tells which of them no test notices.

    scripts/mutants.py FOLDER plant [--sites N] [--seed N] [--rooms A,B]  chooses N sites, as many in each room, plants all
                                        of them in a copy of the last commit and builds it; each sleeps until it is named
    scripts/mutants.py FOLDER reach     which suite of tests comes past which site, and how long each suite takes
    scripts/mutants.py FOLDER run [NUMBER...]    wakes one mutant after the other, until a suite that passes it fails;
                                        then lists those that lived, and counts by room

Needs libclang for Python (Debian: python3-clang-14). FOLDER keeps everything: the copy in tree/, sites.json, suites.json,
results.json. A fault with which its file does not compile is not chosen. Headers, constant expressions and what ends
processes of others are left alone.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import each_file
from mutant_sites import choose_in_room
from rooms import HOLDS
from run_tests import listed

ROOT = each_file.ROOT
BUDGET_S = 90  # for a mutant that no suite notices
LONGEST_S = 90  # a suite that takes longer by itself is not run on mutants
HANGS = 4  # a suite that takes so many times as long as usual, and ten seconds, has noticed
# files that signal processes or look for them, where a fault may end any process of the user's
DANGEROUS = ("programs/process/partner.cpp", "compiler/cache/child_process.cpp")


def flags_by_source(build):
    """What each source of the product, by its name from the top, is compiled with. A room's files are compiled together."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        file, words = pathlib.Path(entry["file"]), shlex.split(entry["command"])
        flags = [w for before, w in zip([""] + words, words) if w.startswith(("-I", "-D", "-std")) or "-isystem" in (before, w)]
        together = re.findall(r'#include "(.*\.cpp)"', file.read_text()) if file.name.startswith("unity_") else [str(file)]
        for name in (os.path.relpath(source, build.parent) for source in together):
            if name.endswith(".cpp") and not name.startswith((*each_file.OTHERS, "..", "examples/")) and name not in DANGEROUS:
                found[name] = flags
    return found


def write_planted(tree, sites):
    """Writes the sources of all sites anew from the commit, with the mutants in them."""
    for name in sorted({s["file"] for s in sites}):
        text = subprocess.run(["git", "show", f"HEAD:{name}"], cwd=tree, stdout=subprocess.PIPE, check=True).stdout
        for site in sorted((s for s in sites if s["file"] == name), key=lambda s: -s["begin"]):
            instead = site["instead"].replace("mutant(N)", f"mutant({site['number']})")
            text = text[:site["begin"]] + instead.encode() + text[site["end"]:]
        new = f'#include "{tree.parent}/mutant.h"\n#line 1 "{tree / name}"\n'.encode() + text
        if (tree / name).read_bytes() != new:
            (tree / name).write_bytes(new)


def plant(folder, options):
    tree, build = folder / "tree", folder / "tree" / "build"
    folder.mkdir(exist_ok=True)
    for file in ("suites.json", "results.json"):
        (folder / file).unlink(missing_ok=True)  # of other sites
    shutil.copy(ROOT / "scripts" / "mutant.h.in", folder / "mutant.h")
    if not tree.exists():
        subprocess.run(["git", "clone", "-q", "--shared", ROOT, tree], check=True)
    for words in (["git", "fetch", "-q", ROOT, "HEAD"], ["git", "checkout", "-qf", "FETCH_HEAD"],
                  ["cmake", "-G", "Ninja", "-S", ".", "-B", "build"]):
        subprocess.run(words, cwd=tree, stdout=subprocess.DEVNULL, check=True)
    each_file.make_generated(build)
    rooms = {}
    for name, flags in flags_by_source(build).items():
        room = max((r for r in HOLDS if name.startswith(r + "/")), key=len, default=os.path.dirname(name))
        if not options.rooms or room in options.rooms.split(","):
            rooms.setdefault(room, {})[name] = flags
    shares = [options.sites // len(rooms) + (i < options.sites % len(rooms)) for i in range(len(rooms))]
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        chosen = pool.map(choose_in_room, [tree] * len(rooms), rooms.values(), shares, [options.seed] * len(rooms))
        sites = [dict(site, room=room) for room, some in zip(rooms, chosen) for site in some]
    for number, site in enumerate(sites, 1):
        site["number"] = number
    write_planted(tree, sites)
    (folder / "sites.json").write_text(json.dumps(sites, indent=1))
    return subprocess.run(["ninja", "-C", build, "--quiet", "-j", str(options.jobs)], check=False).returncode


def suites_of(build):
    """By name: the command that runs a suite of tests."""
    found = {}
    programs = [line.split()[0] for line in (build / "tests" / "programs.txt").read_text().splitlines() if line.count(" ") == 1]
    for name in programs:  # those that are asked for have a third word
        program = str(build / "tests" / name)
        tests = listed(program)
        for suite in dict.fromkeys(test.rsplit(".", 1)[0] for test in tests):
            own = ":".join(test for test in tests if test.rsplit(".", 1)[0] == suite)
            found[f"{name} {suite}"] = [program, f"--gtest_filter={own}"]
    return found


def passes(folder, command, seconds, **environment):
    """Whether a suite passes in its time, and how long it took."""
    since = time.monotonic()
    process = subprocess.Popen(command, cwd=folder / "tree", stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, start_new_session=True,
                               env=dict(os.environ, XDG_CACHE_HOME=str(folder / "cache"), **environment))
    try:
        status = process.wait(seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        status = process.wait()
    return status == 0, time.monotonic() - since


def reach(folder, options):
    def look(suite):
        with tempfile.TemporaryDirectory() as notes:
            passed, seconds = passes(folder, suite[1], LONGEST_S, MUTANT="-1", MUTANTS_REACHED=notes)
            reached = [int(number) for number in os.listdir(notes)]
        if not passed:
            print(f"not run on mutants, for it fails or takes too long without one: {suite[0]}", flush=True)
        return {"name": suite[0], "command": suite[1], "passed": passed, "seconds": seconds, "reached": reached}

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        suites = list(pool.map(look, suites_of(folder / "tree" / "build").items()))
    suites.sort(key=lambda s: len(s["reached"]) * (s["seconds"] + 2))  # quick ones that come past little are likely to notice
    (folder / "suites.json").write_text(json.dumps(suites, indent=1))
    return 0


def run(folder, options):
    suites = [s for s in json.loads((folder / "suites.json").read_text()) if s["passed"]]
    file = folder / "results.json"
    results = json.loads(file.read_text()) if file.exists() else {}

    def wake(site):
        give_up, result = time.monotonic() + BUDGET_S, "no suite comes past it"
        for suite in (s for s in suites if site["number"] in s["reached"]):
            if time.monotonic() > give_up:
                return "lived, up to its time"
            if not passes(folder, suite["command"], HANGS * suite["seconds"] + 10, MUTANT=str(site["number"]))[0]:
                return f"killed by {suite['name']}"
            result = "lived"
        return result

    sites = [s for s in json.loads((folder / "sites.json").read_text()) if
             s["number"] in options.numbers or not options.numbers and str(s["number"]) not in results]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for site, result in zip(sites, pool.map(wake, sites)):
            results[str(site["number"])] = result
            file.write_text(json.dumps(results, indent=1))
            print(f"{site['number']} {site['file']}:{site['line']}: {result}", flush=True)
    by_room = {}
    for site in json.loads((folder / "sites.json").read_text()):
        if result := results.get(str(site["number"])):
            by_room.setdefault(site["room"], []).append(result.startswith("killed"))
            if not result.startswith("killed"):
                print(f"{site['number']} {site['file']}:{site['line']}: {site['kind']}: {result}\n    {site['original']}")
    for room, killed in by_room.items():
        print(f"{room}: {sum(killed)} of {len(killed)} killed")
    print(f"{sum(map(sum, by_room.values()))} of {sum(map(len, by_room.values()))} killed")
    return 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder", type=lambda f: pathlib.Path(f).resolve())
    parser.add_argument("verb", choices=("plant", "reach", "run"))
    parser.add_argument("numbers", nargs="*", type=int)
    for name, kind, usual in (("sites", int, 100), ("seed", int, 1), ("rooms", str, ""), ("jobs", int, os.cpu_count())):
        parser.add_argument(f"--{name}", type=kind, default=usual)
    options = parser.parse_args()
    return {"plant": plant, "reach": reach, "run": run}[options.verb](options.folder, options)


if __name__ == "__main__":
    sys.exit(main())
