#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The students' edition: Twinpuck without the solutions of the lab.

    scripts/students.py FOLDER            the tree, as a folder and as FOLDER.tar.gz
    scripts/students.py --prune PREFIX    takes them out of an installed product

Left out: the solutions, the answers, all of Twinpuck's own tests (they fly the solutions). In pages,
what stands between <!-- solution --> and <!-- /solution --> goes, and links to what is not there become text.
"""
import gzip
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SOLUTIONS = ["firmware/lab", "docs/lab-answers.md", "programs/supervisors/soccer_drop"]
LEFT_OUT = SOLUTIONS + ["tests", ".ci"]
TARGETS = "routines second test-view asan tsan fuzz levels mutants check chip-tables bench students".split()  # of the makers of Twinpuck
TEST = "\t@echo \"this edition has none of Twinpuck's own tests; 'twinpuck test' runs yours\" && false\n"


def is_left_out(name, left_out):
    return any(name == part or name.startswith(part + "/") for part in left_out) or \
        re.fullmatch(r"(firmware|programs/supervisors)/[^/]+/test\.cpp", name)


def tree_files():
    """The files of the tree, as git has them; of a tree without git, all but what is built."""
    git = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                         capture_output=True, text=True)
    if git.returncode == 0 and git.stdout:
        names = git.stdout.split("\0")
    else:
        names = [str(path.relative_to(ROOT)) for path in ROOT.rglob("*")]
        names = [name for name in names if not name.startswith(("build", ".git/")) and "node_modules" not in name]
    return sorted(name for name in names if name and (ROOT / name).is_file())


def without_solutions(text, page, exists):
    """A page of Markdown. `exists`: whether a link's target, seen from the page, is there."""
    text = re.sub(r"<!-- solution -->.*?<!-- /solution -->\n?", "", text, flags=re.S)
    text = re.sub(r"^\[[^\]]*\]\(lab-answers\.md[^)]*\)[.,]?\n", "", text, flags=re.M)
    text = re.sub(r" ?\[Answer\]\(lab-answers\.md[^)]*\)\.?", "", text)
    text = re.sub(r"\n{3,}", "\n\n", text)

    def link(match):
        label, target = match.groups()
        file = target.split("#")[0]
        return match.group(0) if not file or "://" in file or exists(page.parent / file) else label

    return re.sub(r"\[([^\]\[]*)\]\(([^)\s]+)\)", link, text)


def changed_makefile(text):
    """A first `make run` has a program; targets that need what is left out go."""
    changed = re.sub(r"^FW    \?= obstacle$", "FW    ?= braitenberg", text, flags=re.M)
    assert changed != text, "Makefile: got no 'FW ?= obstacle'"
    blocks = changed.split("\n\n")
    blocks = [block for block in blocks if not re.search(r"^## (%s):" % "|".join(TARGETS), block, re.M)]
    for i, block in enumerate(blocks):
        if re.search(r"^## test:", block, re.M):
            blocks[i] = "## test: Twinpuck's own tests are not in this edition\ntest:\n" + TEST.rstrip("\n")
    return "\n\n".join(blocks).rstrip("\n") + "\n"


def changed(name, text, exists):
    if name.endswith(".md"):
        text = without_solutions(text, pathlib.PurePosixPath(name), exists)
    if name == "README.md":
        text = text.replace("the controller obstacle in", "the controller braitenberg in")
    return changed_makefile(text) if name == "Makefile" else text


def write_tar(folder, archive):
    """The same bytes for the same files."""
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w", format=tarfile.PAX_FORMAT) as tar:
        for path in sorted(folder.rglob("*")):
            if not path.is_file():
                continue
            entry = tar.gettarinfo(path, str(pathlib.PurePath(folder.name) / path.relative_to(folder)))
            entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = 0, 0, 0, "", ""
            entry.mode = 0o755 if entry.mode & 0o100 else 0o644
            with open(path, "rb") as file:
                tar.addfile(entry, file)
    with open(archive, "wb") as out, gzip.GzipFile("", "wb", fileobj=out, mtime=0) as packed:
        packed.write(raw.getvalue())


def make_tree(folder):
    names = [name for name in tree_files() if not is_left_out(name, LEFT_OUT)]
    known = set(names) | {str(parent) for name in names for parent in pathlib.PurePosixPath(name).parents}

    def exists(path):
        parts = []
        for part in path.parts:
            if part == "..":
                parts[-1:] = []
            elif part != ".":
                parts.append(part)
        return "/".join(parts) in known

    # a folder that was made here before, and nothing else, is made anew
    mark = folder / ".students-edition"
    if folder.exists() and any(folder.iterdir()) and not mark.exists():
        sys.exit("%s: students: got a folder with files, expected a new one" % folder)
    shutil.rmtree(folder, ignore_errors=True)
    for name in names:
        source, target = ROOT / name, folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if name.endswith(".md") or name == "Makefile":
            target.write_text(changed(name, source.read_text(), exists))
        else:
            shutil.copyfile(source, target)
        shutil.copymode(source, target)
    mark.write_text("made by scripts/students.py\n")
    archive = folder.with_name(folder.name + ".tar.gz")
    write_tar(folder, archive)
    print("%s: %d files" % (archive, len(names) + 1))


def prune(prefix):
    homes = [prefix / "share/twinpuck", prefix / "share/doc/twinpuck"]
    if not (homes[0] / "firmware/include").is_dir():
        sys.exit("%s: --prune: got no share/twinpuck/firmware/include, expected an installed Twinpuck" % prefix)
    for home in homes:
        for part in SOLUTIONS + [part[len("docs/"):] for part in SOLUTIONS if part.startswith("docs/")]:
            path = home / part
            shutil.rmtree(path, ignore_errors=True) if path.is_dir() else path.unlink(missing_ok=True)
        for page in home.rglob("*.md"):
            text = page.read_text()
            # links between pages alone lead somewhere there
            new = without_solutions(text, pathlib.PurePosixPath(page), lambda target: True)
            if new != text:
                page.write_text(new)
    print("%s: without solutions" % prefix)


def main():
    arguments = sys.argv[1:]
    if len(arguments) == 2 and arguments[0] == "--prune":
        return prune(pathlib.Path(arguments[1]))
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    return make_tree(pathlib.Path(arguments[0]).absolute())


if __name__ == "__main__":
    sys.exit(main())
