#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Pages and comments name what is there: links with their anchors, paths of the tree, names of headers and sources; in
pages functions and options too.

Part of scripts/check.py. `scripts/check_pages.py --test` tries the rules themselves.
"""
import fnmatch
import io
import posixpath
import re
import sys
import tokenize

ENDINGS = "h|hpp|cpp|c|inc|csv|def|td|py|sh|md|toml|ts|js|mjs|json|txt|s|png|gif|cmake|in|supp|java"
NAMED = "h|hpp|cpp|inc|def|td|md"  # a bare name of these has to be in the tree
# of compilers, libraries and other people's projects, which comments and pages name
OTHERS = {
    "assert.h", "ctype.h", "errno.h", "float.h", "inttypes.h", "limits.h", "locale.h", "math.h", "setjmp.h", "signal.h", "stdarg.h",
    "stdbool.h", "stddef.h", "stdint.h", "stdio.h", "stdlib.h", "string.h", "time.h", "unistd.h", "IRSensor.cpp", "p30f6014A.inc",
    "natives.inc",  # written into build/
}
# what users make, and where the lab's files lie in Webots
USERS = {"worlds/mymaze.toml", "firmware/obstacle", "firmware/x", "worlds/*.wbt"}
MADE_UP = re.compile(r"NAME|PAGE|FILE|KIND|SET\b|_N\b|CMakeFiles|[<>{}$@%]|\.\.\.|\bmine\b|\b[a-z]\.\w+$")
OTHERS_OPTIONS = {"--user", "--branch-coverage", "--twinpuck-seeds"}  # of Docker, genhtml; put together by the plug-in
WORDS, README_LINES = 22000, 100  # of all pages that are written by hand; of the front page


def comments(path, text):
    """(line, text) of the comments of a source, of all lines of a page."""
    if path.endswith(".md"):
        yield from enumerate(text.split("\n"), 1)
    elif path.endswith((".c", ".h", ".cpp", ".ts", ".mjs", ".inc", ".def", ".java", ".td")):
        for match in re.finditer(r'"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'|//[^\n]*|/\*(?:.|\n)*?\*/', text):
            if match.group(0)[0] == "/":
                first = text.count("\n", 0, match.start()) + 1
                yield from enumerate(match.group(0).split("\n"), first)
    elif path.endswith(".py"):
        try:
            for token in tokenize.generate_tokens(io.StringIO(text).readline):
                if token.type == tokenize.COMMENT or token.type == tokenize.STRING and token.string.startswith('"""'):
                    yield from enumerate(token.string.split("\n"), token.start[0])
        except (tokenize.TokenError, IndentationError):
            return
    elif path.endswith((".sh", ".cmake", ".toml", ".yaml", ".yml")) or posixpath.basename(path) in ("Makefile", "CMakeLists.txt"):
        for number, line in enumerate(text.split("\n"), 1):
            match = re.search(r"(?:^|\s)#\s.*", line)
            if match:
                yield number, match.group(0)


def anchors(text):
    """Anchors of a page's headings, as GitHub makes them, and of HTML."""
    found, count = set(re.findall(r'<a (?:id|name)="([^"]+)"', text)), {}
    for heading in re.findall(r"^#{1,6} (.*?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
        slug = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        found.add(slug if slug not in count else "%s-%d" % (slug, count[slug]))
        count[slug] = count.get(slug, 0) + 1
    return found


def by_hand(text):
    """A page without the parts and samples that programs write."""
    text = re.sub(r"<!-- [\w ]+: [^\n]*-->\n.*?<!-- end -->", "", text, flags=re.S)
    text = re.sub(r"<!-- protocol -->\n.*?<!-- end -->", "", text, flags=re.S)
    return re.sub(r"^```\w*\n\$ (?:build/)?twinpuck .*?^```$", "", text, flags=re.M | re.S)  # by doc_samples.py


def words(text):
    return sum(1 for word in text.split() if re.search(r"\w", word))


class Pages:
    def __init__(self, names, read):
        """`names`: files of the tree; `read(name)`: the text of one."""
        self._names, self._read = set(names), read
        self._folders = {""}
        for name in names:
            while "/" in name:
                name = name.rpartition("/")[0]
                self._folders.add(name)
        self._tops = sorted({name.split("/")[0] for name in names if "/" in name and not name.startswith(".")}, key=len, reverse=True)
        self._bare = {name.rpartition("/")[2] for name in names}
        self._anchors = {}
        self._words, self._options = set(), set()
        # a path: a folder at the top or a room's own name before a slash, to the end of the word
        self._path = re.compile(r"(?<![\w./<$~-])((?:%s)/[\w./*\[\]-]*[\w*])" % "|".join(map(re.escape, self._tops)))
        self._name = re.compile(r"(?<![\w./*<>$~%%-])(\w[\w-]*\.(?:%s))\b(?![\w/]|\.\w)" % NAMED)

    def learn(self, path, text):
        """What pages may name: words and options of sources. All sources come before the first page is looked at."""
        if not path.endswith(".md") and not path.startswith("docs/"):
            self._words.update(re.findall(r"\w+", text))
            if not path.startswith("tests/"):
                self._options.update(re.findall(r"(?<![\w-])--[a-z][\w-]+", text))

    def has(self, path):
        path = path.rstrip("/")
        if path in self._names or path in self._folders:
            return True
        if "*" in path:
            return any(fnmatch.fnmatch(name, path) for name in self._names | self._folders)
        # a file without its ending, such as scripts/setup or tools/lab_*
        return any(name.rsplit(".", 1)[0] == path for name in self._names)

    def _has_anchor(self, page, anchor):
        if page not in self._anchors:
            self._anchors[page] = anchors(self._read(page))
        return anchor in self._anchors[page]

    def problems(self, path, text):
        """(line, what is wrong) of one file."""
        here = posixpath.dirname(path)
        if path.endswith(".md"):
            plain = re.sub(r"^```.*?^```", lambda m: re.sub(r"[^\n]", " ", m.group(0)), text, flags=re.M | re.S)
            for match in re.finditer(r"\]\(([^)\s]+)\)", plain):
                target, line = match.group(1), plain.count("\n", 0, match.start()) + 1
                if re.match(r"[a-z]+:", target):
                    continue
                file, _, anchor = target.partition("#")
                whole = posixpath.normpath(posixpath.join(here, file)) if file else path
                if not self.has(whole):
                    yield line, "dead link: " + target
                elif anchor and whole.endswith(".md") and not self._has_anchor(whole, anchor):
                    yield line, "dead anchor: " + target
            for line, name in self._strangers(text):
                yield line, "no such function or option: " + name
        seen = set()
        for line, comment in comments(path, text):
            yield from self._names_in(path, here, line, comment, seen)
        # what a program prints leads readers to pages, too
        for match in () if path.endswith(".md") else re.finditer(r"docs/[\w/.-]*\.md(#[\w-]+)?", text):
            file = match.group(0).partition("#")[0]
            line = text.count("\n", 0, match.start()) + 1
            if file not in self._names and (line, file) not in seen and not MADE_UP.search(file):
                yield line, "no such file: " + file

    def _strangers(self, text):
        """Functions in backquotes and options that no source knows."""
        for number, line in enumerate(text.split("\n"), 1):
            for name in re.findall(r"`[\w:>.-]*?(\w+)\(", line):
                if name not in self._words and not MADE_UP.search(name):
                    yield number, name + "()"
            for option in re.findall(r"(?<![\w-])--[a-z][\w-]+", line):
                if option not in self._options | OTHERS_OPTIONS:
                    yield number, option

    def _names_in(self, path, here, line, comment, seen):
        comment = re.sub(r"https?://\S+|\[[^\]]*\]\([^)\s]+\)", "", comment)  # links are looked at as such
        comment = re.sub(r"#\s*include\s*[<\"][^>\"]*[>\"]|<[\w/]+\.\w+>", "", comment)
        comment = re.sub(r"\[[^\]]*(?:lib|Webots|Enki|TinyOS)[^\]]*\]", "", comment)  # sources of numbers: files of others
        for match in self._path.finditer(comment):
            name = match.group(1)
            if MADE_UP.search(name) or name in USERS or (line, name) in seen:
                continue
            if not self.has(name) and not self.has(posixpath.normpath(posixpath.join(here, name))):
                seen.add((line, name))
                yield line, "no such file: " + name
        for match in self._name.finditer(comment):
            name = match.group(1)
            if name not in self._bare and name not in OTHERS and not MADE_UP.search(name):
                seen.add((line, name))
                yield line, "no such file: " + name

    def sizes(self):
        """(page, what is wrong): words and lines of all pages."""
        pages = [name for name in self._names if name.endswith(".md") and (name.startswith("docs/") or name == "README.md")]
        count = sum(words(by_hand(self._read(name))) for name in pages if name != "docs/lab-answers.md")
        if count > WORDS:
            yield "docs", "%d words by hand, expected at most %d" % (count, WORDS)
        lines = self._read("README.md").count("\n")
        if lines >= README_LINES:
            yield "README.md", "%d lines, expected fewer than %d" % (lines, README_LINES)


def test():
    tree = {"docs/a.md": "# A b `c`: d\n\n## Twice\n\n## Twice\n", "room/x.h": "", "README.md": "a [b](docs/a.md#twice-1)\n", "room/part/y.cpp": ""}
    pages = Pages(tree, tree.__getitem__)
    assert anchors(tree["docs/a.md"]) == {"a-b-c-d", "twice", "twice-1"}, anchors(tree["docs/a.md"])

    def wrong(path, text):
        return list(pages.problems(path, text))

    assert wrong("docs/b.md", "[x](a.md) [y](a.md#a-b-c-d) [z](../room/x.h) [t](https://x.y/z.md)\n") == []
    assert wrong("docs/b.md", "\n[x](b2.md) zz.md") == [(2, "dead link: b2.md"), (2, "no such file: zz.md")]
    assert (1, "dead anchor: a.md#no") in wrong("docs/b.md", "[x](a.md#no)")
    assert wrong("room/x.h", "// see room/x.h, part/y.cpp and y.cpp; room/part/*.cpp\nint a; // room/NAME.h\n") == []
    assert wrong("room/x.h", "int a;  // see room/zz.h\n") == [(1, "no such file: room/zz.h")]
    assert wrong("room/x.h", "/* see\n zz.h */\n") == [(2, "no such file: zz.h")]
    assert wrong("room/x.h", "const char* a = \"z.h\";\n") == []
    assert wrong("room/x.cpp", "say(\"docs/gone.md\");\n") == [(1, "no such file: docs/gone.md")]
    assert wrong("room/x.py", "a = 1  # see zz.cpp\n") == [(1, "no such file: zz.cpp")]
    pages.learn("room/x.h", "int known(); // --knob")
    assert wrong("docs/b.md", "`known()`, `a.known(1)`, --knob\n") == []
    assert wrong("docs/b.md", "\n`strange()`, `a.strange`, --lever\n") == [
        (2, "no such function or option: strange()"), (2, "no such function or option: --lever")]
    assert words(by_hand("a b\n<!-- rooms: who -->\nc d\n<!-- end -->\n| e |\n")) == 3
    print("check_pages: the rules hold")


if __name__ == "__main__":
    if sys.argv[1:] != ["--test"]:
        sys.exit(__doc__.strip())
    test()
