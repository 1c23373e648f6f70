#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at sources of the product one by one, by the commands that a build folder compiles them with.

    scripts/each_file.py BUILD alone        compiles every file by itself, syntax only: does it include what it uses?
    scripts/each_file.py BUILD tidy [all]   clang-tidy (.clang-tidy) on what changed last, or on every file
    scripts/each_file.py --test             tries the choice

What changed last: what is not committed, then the latest commits, at most COMMITS and FILES; of a header that file which
goes with it, or one that includes it. Where the history is cut off (a shallow clone) and tells nothing, FILES of all that
there are, which ones by the commit's name. A file that is not begun after TIDY_S is left out, and said.

Prints what compiler or clang-tidy say. Exit code: 0 nothing, 1 something.
"""
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
COMMITS = 30
FILES = 40
TIDY_S = 240  # the last file that is begun may take 20 s more
# code of the robot's and of other people's programs, and tests, which are compiled file by file anyway
OTHERS = ("tests/", "bench/", "firmware/", "programs/controller/", "programs/supervisors/", "build")


def output(*command):
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False).stdout


def ninja(build, *targets):
    run = subprocess.run(["ninja", "-C", build, *targets], cwd=ROOT, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(run.stdout + run.stderr)


def without_pch(command):
    """A compiler's own form of headers, which no other reads."""
    words = shlex.split(command)
    pch = [i for i, word in enumerate(words) if word.endswith("cmake_pch.hxx")]
    return [word for i, word in enumerate(words) if word != "-Winvalid-pch" and i not in pch and i + 1 not in pch]


def commands(build, apart=True):
    """By source, from the top: the words that compile it, and where. Those of a room compiled together have its words;
    where they are not to be told apart, the file that includes them is named."""
    all_of_them = {}
    for entry in json.loads((ROOT / build / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["file"])
        together = re.findall(r'^#include "(.+)"$', file.read_text(), re.MULTILINE) if file.parent.name == "Unity" else [file]
        together = [s for s in (os.path.relpath(source, ROOT) for source in together) if not s.startswith((*OTHERS, ".."))]
        for source in together if apart else [os.path.relpath(file, ROOT)] if together else []:
            words = [str(ROOT / source) if word == entry["file"] else word for word in without_pch(entry["command"])]
            all_of_them.setdefault(source, (words, entry["directory"]))
    return all_of_them


def make_generated(build):
    """What sources include and the build writes."""
    lines = output("ninja", "-C", build, "-t", "targets", "rule", "CUSTOM_COMMAND").split("\n")
    made = [line for line in lines if line.endswith((".inc", ".h"))]
    ninja(build, *made)


def flags(command):
    """What a file is compiled with, without its result."""
    words = iter(command[command[0].endswith("ccache"):])
    return [word for word in words if word != "-c" and not (word == "-o" and next(words))]


def compiled_alone(command, directory):
    return subprocess.run([*flags(command), "-fsyntax-only"], cwd=directory, capture_output=True, text=True, check=False)


def changed():
    """Names, the newest first, and what they changed since."""
    names = output("git", "diff", "--name-only", "HEAD") + output("git", "ls-files", "--others", "--exclude-standard")
    shallow = ROOT / output("git", "rev-parse", "--git-path", "shallow").strip()
    ends = shallow.read_text().split() if shallow.exists() else []  # theirs is the whole tree
    commits = [c for c in output("git", "rev-list", f"--max-count={COMMITS}", "HEAD").split() if c not in ends]
    for commit in commits:
        names += output("git", "diff-tree", "--no-commit-id", "--name-only", "-r", commit)  # nothing of a merge
    return list(dict.fromkeys(names.split())), f"of the last {len(commits)} commits"


def read_with(header, sources):
    """The source that goes with a header, or the first in its room, then anywhere, that includes it."""
    own = header.removesuffix(".h") + ".cpp"
    if own in sources:
        return own
    includes = re.compile(rf'^#include "{re.escape(header)}"$', re.MULTILINE)
    room = os.path.dirname(header) + "/"
    near_first = sorted(sources, key=lambda s: (not s.startswith(room), s))
    return next((s for s in near_first if includes.search((ROOT / s).read_text())), None)


def chosen(sources):
    """Sources to look at, all names that count as changed, and a word on the choice."""
    names, since = changed()
    present = [n for n in names if (ROOT / n).exists()]
    read = [n if n in sources else read_with(n, sources) if n.endswith(".h") else None for n in present]
    files = [s for s in dict.fromkeys(read) if s]
    if not names:
        every = collections.deque(sorted(sources))
        every.rotate(-int(output("git", "rev-parse", "HEAD")[:8], 16))
        files, names, since = list(every), list(every), f"from {every[0]} on: no history tells what changed"
    return files[:FILES], set(names), since + (f", the first {FILES} of {len(files)}" if len(files) > FILES else "")


def tidied(command, directory, names):
    """What clang-tidy says of a source and of those among `names` that it includes: who includes an old header is not told
    of it."""
    compiler, *words = flags(command)
    told = "|".join(re.escape(name) for name in sorted(names))
    run = subprocess.run(["clang-tidy", "--quiet", f"--header-filter=^{re.escape(str(ROOT))}/({told})",
                          "--checks=-bugprone-suspicious-include", words[-1], "--", compiler, *words[:-1]],
                         cwd=directory, capture_output=True, text=True, check=False)
    run.stderr = run.stdout  # stderr counts what was left out
    return run


def test():
    """The choice in a small history, and in clones that are cut off."""
    global ROOT
    with tempfile.TemporaryDirectory() as scratch:
        ROOT = pathlib.Path(scratch) / "whole"

        def commit(**texts):
            for name, text in texts.items():
                file = ROOT / "room" / name.replace("_", ".")
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(text)
            output("git", "add", ".")
            output("git", "-c", "user.name=a", "-c", "user.email=a", "commit", "-qm", "one")

        ROOT.mkdir()
        output("git", "init", "-q")
        commit(a_cpp="", a_h="", b_cpp='#include "room/b.h"\n', b_h="", c_cpp='#include "room/lone.h"\n', lone_h="", d_md="")
        for n in range(COMMITS - 2):
            commit(d_md=f"{n}")
        commit(a_h="1", lone_h="1")
        commit(b_cpp='#include "room/b.h"\n\n')
        sources = {f"room/{n}.cpp": None for n in "abc"}
        last = ["room/b.cpp", "room/a.cpp", "room/c.cpp"]
        names = {"room/b.cpp", "room/a.h", "room/lone.h", "room/d.md"}
        assert chosen(sources) == (last, names, f"of the last {COMMITS} commits"), chosen(sources)
        (ROOT / "room/a.cpp").write_text("1")
        assert chosen(sources)[0] == ["room/a.cpp", "room/b.cpp", "room/c.cpp"], chosen(sources)
        many = {f"room/{n}.cpp": None for n in range(FILES + 1)}
        for name in many:
            (ROOT / name).write_text("")
        files, _, since = chosen(many)
        assert len(files) == FILES and since.endswith(f", the first {FILES} of {FILES + 1}"), since
        for depth, files in ((2, last[:1]), (1, None)):
            clone = pathlib.Path(scratch) / f"clone{depth}"
            output("git", "clone", "-q", f"--depth={depth}", f"file://{scratch}/whole", str(clone))
            ROOT = clone
            got, names, since = chosen(sources)
            assert got == files if files else sorted(got) == sorted(sources), got
            assert since == (f"of the last {depth - 1} commits" if files else f"from {got[0]} on: no history tells what changed")
            ROOT = pathlib.Path(scratch) / "whole"
    print("each_file: the choice holds")


def main():
    if sys.argv[1:] == ["--test"]:
        return test()
    if sys.argv[2:] not in (["alone"], ["tidy"], ["tidy", "all"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    build, what = sys.argv[1:3]
    ninja(build, "build.ninja")  # files that are new
    every = commands(build)
    sources, since, give_up = list(every), "", float("inf")
    if sys.argv[2:] == ["tidy"]:
        sources, names, since = chosen(every)
        give_up = time.monotonic() + TIDY_S
    elif what == "tidy":
        every = commands(build, apart=False)
        sources, names = list(every), {source.split("/")[0] + "/" for source in sources}
    if sources:
        make_generated(build)
    look = (lambda s: compiled_alone(*every[s])) if what == "alone" else (lambda s: tidied(*every[s], names))

    def in_time(source):
        return look(source) if time.monotonic() < give_up else None

    bad = left_out = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for source, run in zip(sources, pool.map(in_time, sources)):
            if run is None:
                left_out += 1
            elif run.returncode != 0 or run.stderr.strip():
                bad += 1
                print(f"{source}:\n{run.stderr.strip()}", flush=True)
    print(f"{what}: {len(sources) - left_out} files{since and ' ' + since}, {bad} with something to say"
          + (f"; no time for {left_out}" if left_out else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
