#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rules of the code that a compiler does not know. Prints one line a problem; exit 1 when there is one.

    scripts/check.py
    scripts/check.py --rooms PAGE     writes the table of rooms into docs/dev/inside.md

Rules: who may include whom (docs/dev/inside.md), and no rooms in a circle · pages and comments name what is there, by
links, anchors and paths (check_pages.py) · no word of what is gone · sim_core knows no robot by name · every number of a
*_params.h names its one source (docs/dev/sources.md) · no file above 700 lines, no file above 1 MB, nothing too large to
be read at once (check_sizes.py) · no path of somebody's machine, an SPDX line in every source · dspic30 uses the standard
library only · C++ formatted by .clang-format.
"""
import collections
import pathlib
import re
import shutil
import subprocess
import sys

import check_pages
import check_sizes
import generated
import rooms as descriptions

ROOT = pathlib.Path(__file__).resolve().parent.parent
LONGEST_FILE = 700      # lines
LARGEST_FILE = 1 << 20  # bytes

# rooms of the simulator core, each may include itself and those to its left
CORE = ["base", "random", "geometry", "physics", "world", "light", "camera", "sound", "radio", "record", "load"]
CHIP = ["memory", "periph", "device", "core", "routines", "asm", "load", "link", "llvm", "translate"]
# other rooms -> what they may include, as prefixes of the path (their own folder is always allowed)
MAY_INCLUDE = {
    "hal_sim/board": ["sim_core/base", "sim_core/world", "sim_core/light", "sim_core/camera", "sim_core/sound",
                      "sim_core/radio", "sim_core/random"],
    "hal_sim/drivers": ["hal_sim/board", "sim_core/base"],
    "hal_sim/host": ["hal_sim/board", "hal_sim/drivers", "sim_core/base", "sim_core/world/robot_mind.h", "sim_core/world/scene.h"],
    "hal_sim/api": ["hal_sim/drivers", "hal_sim/board", "dspic30/memory", "dspic30/core", "dspic30/periph/vectors.h", "sim_core/base"],
    "firmware/library": ["firmware/include"],
    "firmware/libc": ["hal_dspic/runtime"],
    "install": [],  # a leaf: where things lie
    "compiler/cache": ["sim_core/base", "install"],
    "compiler/projects": ["compiler/cache", "sim_core/base"],
    "compiler/build": ["compiler/cache", "compiler/projects", "hal_sim/api/host_table", "sim_core/base", "install"],
    "compiler/front": ["compiler/cache", "dspic30/memory", "dspic30/link", "dspic30/llvm", "sim_core/base", "install"],
    "hal_sim/trace": ["hal_sim/board", "hal_sim/drivers/driver_params.h", "hal_sim/host", "dspic30", "sim_core/base", "sim_core/load"],
    # ties board, host and world together
    "hal_sim/twin": ["hal_sim/", "compiler/", "sim_core/", "programs/build/build.h", "programs/puck/program_runner.h",
                     "install"],
    "hal_sim/debug": ["hal_sim/chip", "hal_sim/host", "hal_sim/twin", "dspic30", "sim_core"],
    "hal_sim/signals": ["hal_sim/board", "hal_sim/chip", "hal_sim/debug", "hal_sim/host", "hal_sim/trace", "hal_sim/twin", "sim_core"],
    "hal_sim/chip": ["hal_sim/api", "hal_sim/board", "hal_sim/drivers/driver_params.h", "hal_sim/host/runner.h", "hal_sim/host/program_data.h", "hal_sim/host/chip_view.h",
                     "dspic30", "sim_core/base", "install"],
    "hal_sim/faults": ["hal_sim/board", "hal_sim/host", "hal_sim/signals", "hal_sim/twin", "sim_core"],
    "hal_sim/inputs": ["hal_sim/", "sim_core/", "compiler/cache"],
    "hal_dspic": ["firmware/include", "firmware/library"],
    "programs/process": ["programs/link"],
    "programs/build": ["compiler/cache/child_process.h", "compiler/cache/memory_limit.h", "compiler/cache/readable_files.h", "sim_core/base", "install"],
    "programs/puck": ["hal_sim/board", "hal_sim/drivers", "hal_sim/host", "sim_core", "programs/link",
                      "firmware/include/webots/nodes.h"],
    "programs/world": ["hal_sim/", "sim_core/", "import/", "programs/link"],  # nodes of a whole twin
    "programs/team": ["hal_sim/", "sim_core/", "programs/", "firmware/include/webots/nodes.h"],
    # linked into programs, of which it knows the link
    "programs/controller": ["programs/link", "firmware/include"],
    "hal_sim/runs": ["hal_sim/", "sim_core/", "programs/team/team.h"],
    "outputs": ["hal_sim/", "sim_core/", "dspic30/periph/vectors.h", "viewer/report.h", "install"],
    "exercises": ["hal_sim/", "sim_core/", "outputs", "compiler/cache/child_process.h", "programs/build/build.h", "install"],
    "flash": ["dspic30"],
    "embed": ["hal_sim/", "sim_core/", "programs/team/team.h", "install"],  # a whole twin, for other people's programs
    "python": ["hal_sim/", "sim_core/", "programs/team/team.h", "install"],  # a whole twin, for a language
    "viewer": ["hal_sim/", "compiler/", "sim_core/", "programs/team/team.h", "install"],  # a whole twin, seen and touched from outside
    "import": ["sim_core/base", "sim_core/geometry", "sim_core/world", "sim_core/load"],  # it knows e-pucks by their nodes only
    "firmware": ["tests/support/firmware_test.h"],  # a controller brings its own test.cpp
}
# whose classes a namespace holds
NAMESPACE_ROOMS = {"board": "hal_sim/board", "drivers": "hal_sim/drivers", "host": "hal_sim/host",
                   "chip": "hal_sim/chip", "trace": "hal_sim/trace",
                   "twin": "hal_sim/twin", "api": "hal_sim/api", "debug": "hal_sim/debug", "signals": "hal_sim/signals", "faults": "hal_sim/faults", "inputs": "hal_sim/inputs", "runs": "hal_sim/runs", "dspic": "dspic30/device"}
# packages and the only room that may include them
PACKAGE_ROOMS = {
    "box2d/": ["sim_core/physics"], "Eigen/": ["sim_core/simulation.cpp", "import/affine.h"], "ccd/": ["sim_core/geometry"],
    "toml++/": ["sim_core/load/toml_parser.h"], "CLI/": ["tools"], "llvm/": ["compiler/front", "dspic30/link", "dspic30/llvm", "dspic30/translate"], "clang/": ["compiler/front"],
    "cairo": ["sim_core/record", "sim_core/load", "tools"], "enki/": ["bench"], "gelf.h": ["dspic30/load", "programs/team", "compiler/cache"], "dwarf.h": ["dspic30/load"], "elfutils/": ["dspic30/load", "programs/team"],
    "libelf.h": ["dspic30/load"], "vpx/": ["sim_core/record"], "sndfile.h": ["sim_core/sound"], "pugixml.hpp": ["compiler/projects"], "zlib.h": ["sim_core/record", "viewer/report.cpp"],
    "jpeglib.h": ["import", "programs/controller"], "png.h": ["programs/controller"],
    "civetweb.h": ["viewer"], "muParser": ["hal_sim/signals"],
}
LATE_LIBRARY = "sim_core/base/lazy_library.h"  # macros that know no world
FREE_ROOMS = ("tools", "tests", "bench")  # may include anything
UNTOLD = {"scripts", "examples", "editors", "worlds", "docs", "sim_core", "dspic30", "hal_sim", "compiler", "programs"}
VERBATIM = {"firmware/e-puck/e-puck.c"}  # kept byte for byte as the lab's text prints it
GENERATED = {"firmware/include/p30F6014A.h", "hal_dspic/codec/sound_samples.c"}

# of ways to run a program, and of folders, that there were once: whoever reads them looks for what is not there
GONE = re.compile(r"\b(?:native|register|chip) ways?\b|\bfibers?\b|\bdata model\b|\bsupervisor/programs\b", re.I)

problems = []
arrows = {}  # (room, room it includes) -> where


def problem(path, line, text):
    problems.append("%s:%d: %s" % (path, line, text) if line else "%s: %s" % (path, text))


def committed_files():
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout.split("\0")
    return [name for name in names if name and (ROOT / name).is_file()]


def room_of(path):
    parts = path.split("/")
    if path.startswith(("firmware/library/", "firmware/libc/", "programs/", "compiler/")):
        return "/".join(parts[:2])
    if parts[0] in ("sim_core", "dspic30", "hal_sim") and len(parts) > 2:
        return "/".join(parts[:2])
    return parts[0]


def may_include(path, target):
    """Whether the file may include the project file `target` (a path from the top)."""
    room = room_of(path)
    own = room_of(target)
    if room.startswith(FREE_ROOMS) or own == room or \
            re.fullmatch(r"(firmware|firmware/lab|programs/supervisors)/[^/]+/test\.cpp", path):
        return True  # a controller's own test is a test
    if room.startswith("sim_core"):
        if path.count("/") == 1:  # sim_core/simulation.*: the front door of all rooms
            return target.startswith("sim_core/")
        if not target.startswith("sim_core/"):
            return False
        here, there = room.split("/")[1], own.split("/")[-1]
        return there in CORE and here in CORE and CORE.index(there) <= CORE.index(here)
    if room.startswith("dspic30"):
        if target == LATE_LIBRARY:
            return path == "dspic30/load/lazy_dw.cpp"
        if not target.startswith("dspic30/") or path.count("/") == 1:
            return target.startswith("dspic30/")
        here, there = room.split("/")[1], own.split("/")[-1]
        return there in CHIP and here in CHIP and CHIP.index(there) <= CHIP.index(here)
    return any(target.startswith(allowed) for allowed in MAY_INCLUDE.get(room, []))


def check_includes(path, text):
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r'\s*#\s*include(?:_next)?\s*([<"])([^>"]+)[>"]', line)
        if not match:
            continue
        target = match.group(2)
        if "/" in target and (ROOT / target).exists():
            if not may_include(path, target):
                problem(path, number, "%s may not include %s" % (room_of(path), target))
            if room_of(path) != room_of(target) and not path.startswith(FREE_ROOMS) and not path.endswith("/test.cpp"):
                arrows.setdefault((room_of(path), room_of(target)), "%s:%d" % (path, number))
        if path.startswith("dspic30/") and not path.startswith(("dspic30/link/", "dspic30/llvm/", "dspic30/translate/")) and match.group(1) == "<" and re.search(r"[./]", target):
            if not (path.startswith("dspic30/load/") and target in ("dwarf.h", "elfutils/libdw.h", "gelf.h", "libelf.h")):
                problem(path, number, "dspic30 uses the standard library only, not <%s>" % target)
        for package, rooms in PACKAGE_ROOMS.items():
            if match.group(1) == "<" and target.startswith(package):
                if not path.startswith(tuple(rooms)) and not path.startswith(FREE_ROOMS):
                    problem(path, number, "<%s> belongs to %s" % (target, " or ".join(rooms)))


def check_forward_declarations(path, text):
    """A room that names another's class without including it leans on it all the same."""
    room = room_of(path)
    if path.startswith(FREE_ROOMS) or not path.endswith((".h", ".cpp")):
        return
    for match in re.finditer(r"^namespace (\w+) \{\n((?:(?:class|struct|enum class) [^\n{]*;\n)+)\}", text, re.M):
        there = NAMESPACE_ROOMS.get(match.group(1))
        if there and there != room and not may_include(path, there + "/x.h"):
            problem(path, text.count("\n", 0, match.start()) + 1, "%s may not name classes of %s" % (room, there))


def check_circles():
    """Arrows between rooms go one way: no room is reached again from what it includes."""
    included = collections.defaultdict(set)
    for here, there in arrows:
        included[here].add(there)
    for (here, there), where in sorted(arrows.items()):
        seen, open_rooms = {there}, [there]
        while open_rooms:
            for room in included[open_rooms.pop()] - seen:
                seen.add(room)
                open_rooms.append(room)
        if here in seen:
            problem(where, 0, "%s includes %s, from which it is reached again" % (here, there))


def check_numbers(path, text):
    """Each line of a *_params.h that holds a number ends in, or follows, exactly one tag [..]."""
    tag = re.compile(r"\[[^\]\[]+\]")
    above = []
    for number, line in enumerate(text.split("\n"), 1):
        comment = re.search(r"//.*|/\*.*", line)
        code = line[:comment.start()] if comment else line
        tags = tag.findall(comment.group(0)) if comment else []
        if not code.strip():
            above = above + tags if comment else []  # a comment above speaks for the lines up to the next gap
            continue
        if re.search(r"[={(,\s][-+]?(?:0x[0-9a-fA-F]+|\d[\d.']*(?:e[-+]?\d+)?)", code) and re.search(r"[^=!<>]=[^=]", code):
            found = tags or above[-1:]
            if len(found) != 1:
                problem(path, number, "number without exactly one source tag, such as [DS 5.1]: " + code.strip())


def check_text(path, text):
    lines = text.split("\n")
    is_data = path.endswith((".csv", ".toml", ".txt"))
    if len(check_pages.by_hand(text).split("\n") if path.endswith(".md") else lines) > LONGEST_FILE and path not in GENERATED and not is_data:
        problem(path, 0, "%d lines, expected at most %d; split it" % (len(lines), LONGEST_FILE))
    for number, line in enumerate(lines, 1):
        if re.search(r"(?<![\w.$])/(?:home|Users|root|work|tmp/bash_jobs)/\w", line) and path != "scripts/check.py":
            problem(path, number, "path of somebody's machine: " + line.strip()[:80])
        if GONE.search(line) and path not in ("scripts/check.py", "docs/changelog.md"):
            problem(path, number, "a word of what is gone: " + line.strip()[:80])
        if path.startswith("sim_core/") and re.search(r"e-?puck|po[368]03\d[kd]", line, re.I):
            problem(path, number, "sim_core knows no robot by name: " + line.strip()[:80])
    if path.endswith((".c", ".h", ".cpp", ".py", ".sh", ".cmake", ".s")) or path in ("Makefile", ".ci/run"):
        # the sources of the exact cycle counts stay as they were counted
        counted = path.startswith("tests/chip_cc/xc16-cycles/src/")
        if path not in VERBATIM and not counted and not any("SPDX-License-Identifier: MIT" in line for line in lines[:3]):
            problem(path, 1, "no SPDX-License-Identifier: MIT in the first three lines")


def check_format(paths):
    if not shutil.which("clang-format"):
        problem(".clang-format", 0, "clang-format is not installed; run scripts/setup.sh check")
        return
    if not paths:
        return
    run = subprocess.run(["clang-format", "--dry-run", *paths], cwd=ROOT, capture_output=True, text=True)
    seen = set()
    for line in run.stderr.split("\n"):
        match = re.match(r"(.+?):(\d+):\d+: warning: code should be clang-formatted", line)
        if match and match.group(1) not in seen:
            seen.add(match.group(1))
            problem(match.group(1), int(match.group(2)), "not formatted as .clang-format says; run make format")


def table_of_rooms():
    return descriptions.table(MAY_INCLUDE, CORE, CHIP, FREE_ROOMS)


def check_rooms(files):
    """Each room is described, and the page has the table that this file makes."""
    there = {room_of(path) for path in files if path.endswith((".c", ".h", ".cpp", ".py", ".ts")) and "/" in path}
    there |= {"%s/%s" % (top, name) for top, row in (("sim_core", CORE), ("dspic30", CHIP)) for name in row}
    without, gone = descriptions.missing({room for room in there if room not in UNTOLD})
    for room in without:
        problem("scripts/rooms.py", 0, "%s: got no line, expected what this room holds" % room)
    for room in gone:
        problem("scripts/rooms.py", 0, "%s: there is no such room" % room)
    page = (ROOT / "docs/dev/inside.md").read_text()
    begin, end = generated.part(page, "rooms")
    if page[begin:end] != table_of_rooms():
        problem("docs/dev/inside.md", 0, "the table of rooms is stale; run scripts/check.py --rooms docs/dev/inside.md")


def print_arrows():
    """Who includes whom, a line a room."""
    included = collections.defaultdict(list)
    for here, there in sorted(arrows):
        included[here].append(there)
    for here in sorted(included):
        print("%s -> %s" % (here, ", ".join(included[here])))


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "--rooms":
        page = pathlib.Path(sys.argv[2])
        begin, end = generated.part(page.read_text(), "rooms")
        page.write_text(page.read_text()[:begin] + table_of_rooms() + page.read_text()[end:])
        return 0
    if sys.argv[1:]:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    files = committed_files()
    cpp = []
    texts = {}
    for path in files:
        whole = ROOT / path
        if whole.stat().st_size > LARGEST_FILE:
            problem(path, 0, "%d bytes, expected at most %d" % (whole.stat().st_size, LARGEST_FILE))
            continue
        try:
            texts[path] = whole.read_text()
        except UnicodeDecodeError:
            continue  # a picture
    pages = check_pages.Pages(files, texts.__getitem__)
    for path, text in texts.items():
        pages.learn(path, text)
    for path, text in texts.items():
        check_text(path, text)
        if path not in GENERATED | VERBATIM:
            problems.extend(check_sizes.offenders(path, text))
        if not path.startswith("scripts/check_pages"):
            for line, what in pages.problems(path, text):
                problem(path, line, what)
        if path.endswith((".c", ".h", ".cpp")):
            check_includes(path, text)
            check_forward_declarations(path, text)
            # C of the contract, the API and the controllers follows K&R by hand, not .clang-format
            if not path.startswith(("firmware/", "hal_sim/api/", "hal_dspic/", "firmware/library/")) and not path.endswith(".c"):
                cpp.append(path)
        if path.endswith("_params.h"):
            check_numbers(path, text)
    check_circles()
    check_rooms(files)
    for page, what in pages.sizes():
        problem(page, 0, what)
    check_format(cpp)
    print_arrows()
    for line in problems:
        print(line)
    print("check: %d files, %d problems" % (len(files), len(problems)))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
