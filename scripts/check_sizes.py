#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Sizes that a reader can hold: no function over 100 lines, no header over 300 lines, no class over 30 public functions.

Part of scripts/check.py. A function's rows of a table do not count: lines inside a
braced list of values, and cases that only return or call. `scripts/check_sizes.py --test` tries the scan itself.
"""
import ast
import pathlib
import re
import sys

LONGEST_FUNCTION, LONGEST_HEADER, MOST_PUBLIC = 100, 300, 30
FACADES = {("hal_sim/board/board.h", "Board")}  # the one class that may have more
CONTROL = {"if", "for", "while", "switch", "catch", "else", "do", "try", "return", "sizeof", "alignas"}
QUALIFIERS = r"(?:const|noexcept|override|final|mutable|constexpr|volatile|&&?|\s)"


def blank(text, script=False):
    """The text with comments, strings and preprocessor lines as spaces; lines stay where they are."""
    def spaces(match):
        return re.sub(r"[^\n]", " ", match.group(0))

    quote = r"`(?:\\.|[^`\\])*`|" if script else r'R"(\w*)\((?:.|\n)*?\)\1"|'
    text = re.sub(r"//[^\n]*|/\*(?:.|\n)*?\*/|" + quote + r'"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])*\'', spaces, text)
    return re.sub(r"^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", spaces, text, flags=re.M)


class Scan:
    """Walks the braces of a file. After: functions [(name, line, length)], classes [(name, line, public functions)]."""

    def __init__(self, text, script=False):
        self.text, self.lines, self.script = blank(text, script), text.split("\n"), script
        self.functions, self.classes = [], []
        self._scope(0, len(self.text), "")

    def _line(self, at):
        return self.text.count("\n", 0, at) + 1

    def _close(self, at):
        """Where the brace or parenthesis opened at `at` closes."""
        depth = 0
        for match in re.compile(r"[{}()\[\]]").finditer(self.text, at):
            depth += 1 if match.group(0) in "{([" else -1
            if depth == 0:
                return match.start()
        return len(self.text)

    def _scope(self, begin, end, class_name):
        """Declarations between two places: of a namespace or of a class."""
        at, start = begin, begin  # start: of the declaration at hand
        public, public_functions = not class_name or class_name.startswith("struct"), 0
        seek = re.compile(r"[{}();]|\b(?:public|private|protected)\s*:(?!:)")
        head = ""
        while True:
            match = seek.search(self.text, at)
            if not match or match.start() >= end:
                break
            word = match.group(0)
            if word[-1] == ":":
                public, at, start, head = word.startswith("public"), match.end(), match.end(), ""
            elif word == "(":
                head = head or self.text[start:match.start()]
                at = self._close(match.start()) + 1
            elif word == ";":
                if class_name and public and head and self._declares(head, self.text[start:match.start()]):
                    public_functions += 1
                at, start, head = match.end(), match.end(), ""
            elif word == "{":
                close = self._close(match.start())
                before = self.text[start:match.start()]
                kind = self._kind(before, head)
                if kind == "initialiser":  # of a constructor's member, or a value: the declaration goes on
                    at = close + 1
                    continue
                if kind == "function":
                    if class_name and public and self._declares(head, before):
                        public_functions += 1
                    self._function(start, match.start(), close, head)
                elif kind == "namespace":
                    self._scope(match.start() + 1, close, "")
                elif kind:  # a class
                    count = self._scope(match.start() + 1, close, kind)
                    self.classes.append((kind.split()[1], self._line(match.start()), count))
                at, start, head = close + 1, close + 1, ""
            else:
                at = match.end()
        return public_functions

    @staticmethod
    def _declares(head, whole):
        """Whether a declaration is of a function somebody calls by name."""
        tail = whole[len(head):]
        if re.search(r"=\s*(?:delete|default)\s*$", tail) or "operator" in head or "~" in head:
            return False
        if re.match(r"\s*(?:friend|using|typedef|static_assert|enum)\b", head) or "=" in head:
            return False
        name = re.search(r"(\w+)\s*$", head)
        return bool(name) and name.group(1) not in ("function", "alignas", "decltype")

    def _kind(self, before, head):
        """What a brace opens, by what stands before it since the last declaration ended."""
        if re.search(r"\bnamespace\b[\w\s:]*$", before) or re.search(r"\bextern\s*$", before.strip()):
            return "namespace"
        found = re.search(r"\b(class|struct|union|interface)\s+(?:[A-Z_]+\s+)?(\w+)[^;(){}=]*$", before)
        if found and not head:
            return ("class " if found.group(1) == "class" else "struct ") + found.group(2)
        if head and not self.script and re.search(r"\)\s*(?:noexcept\s*)?:(?!:)(?:.|\n)*[\w>]\s*$", before):
            return "initialiser"  # a member that a constructor sets in braces
        if head and "=" not in head.replace("operator=", "").replace("==", "").replace("<=", "").replace(">=", ""):
            return "function"
        if "=" in before or head == "" and re.search(r"[\w>\]]\s*$", before) and not re.search(r"\benum\b", before):
            return "initialiser"
        return ""

    def _function(self, start, open_brace, close, head):
        name = re.search(r"([\w:~]+)\s*$", head)
        first = start + len(self.text[start:]) - len(self.text[start:].lstrip())
        length = self._line(close) - self._line(first) + 1 - self._rows(open_brace, close)
        arguments = re.match(r"[\w:~]*\s*\(([^()]*)\)", self.text[start + len(head) - len(name.group(1)):]) if name else None
        told = name.group(1) if name else "?"
        if re.fullmatch(r"TEST(?:_F|_P)?|FIRMWARE_TEST\w*", told) and arguments:
            told += "(" + " ".join(arguments.group(1).split()) + ")"
        self.functions.append((told, self._line(first), length))

    def _rows(self, begin, end):
        """Lines between two places that are rows of a table."""
        rows, at, seek = set(), begin + 1, re.compile(r"[{]")
        while True:
            match = seek.search(self.text, at)
            if not match or match.start() >= end:
                break
            before = self.text[begin:match.start()].rstrip()
            if re.search(r"(?:[=(,{]|\breturn|\w>|\]\s*\w*)$", before) and not re.search(r"\)\s*->\s*[\w:<>]+$", before):
                close = self._close(match.start())
                if not re.search(r"[;]", self.text[match.start():close]):  # values, no statements
                    rows |= set(range(self._line(match.start()) + 1, self._line(close)))
                    at = close
                    continue
            at = match.end()
        for number in range(self._line(begin), self._line(end) + 1):
            if re.match(r"\s*case [^?]*:\s*(?:\w.*;|)\s*(?://.*|break;)?$", self.lines[number - 1]):
                rows.add(number)
        return len(rows)


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.lineno, node.end_lineno - node.lineno + 1


def offenders(path, text):
    """Lines of the list for one file."""
    found, functions, classes = [], [], []
    if path.endswith(".py"):
        functions = list(python_functions(text))
    elif path.endswith((".c", ".h", ".cpp", ".ts", ".mjs")):
        scan = Scan(text, path.endswith((".ts", ".mjs")))
        functions, classes = scan.functions, scan.classes
    for name, line, length in functions:
        if length > LONGEST_FUNCTION:
            found.append("%s:%d: %s() has %d lines, expected at most %d" % (path, line, name, length, LONGEST_FUNCTION))
    for name, line, count in classes:
        if count > MOST_PUBLIC and (path, name) not in FACADES and path.endswith(".h"):
            found.append("%s:%d: %s has %d public functions, expected at most %d" % (path, line, name, count, MOST_PUBLIC))
    lines = text.count("\n")
    if path.endswith(".h") and lines > LONGEST_HEADER:
        found.append("%s: %d lines, expected at most %d in a header" % (path, lines, LONGEST_HEADER))
    return found


def test():
    body = "  step();\n"
    source = ("namespace a {\nclass B {\n public:\n  B();\n  explicit B(int x) : x_{x}, y_(1) {}\n  ~B();\n  int f() const;\n"
              "  void g(std::function<int(int)> h = {}) noexcept override { go(); }\n  bool operator==(const B&) const = default;\n"
              " private:\n  void hidden();\n  std::function<void()> call_;\n  int x_ = 0;\n};\n"
              "struct S { int n = 0; int all() const; std::vector<int> v{1, 2}; };\n"
              "B::B() : x_{1} {\n" + body * 3 + "}\n"
              "template <typename T>\nstatic T long_one(const char* s) {\n  // }\n  auto l = [&](int i) {\n    return i;\n  };\n  s = \"}\";\n" + body * 2 + "}\n"
              "int table() {\n  static const Row rows[] = {\n    {1, 2},\n    {3, 4},\n  };\n  switch (x) {\n    case 1: return 2;\n    case 2: return 3;\n  }\n}\n"
              "}  // namespace a\n")
    scan = Scan(source)
    wanted = {"B": 1, "B::B": 5, "long_one": 10, "table": 6, "g": 1}
    got = {name: length for name, _, length in scan.functions}
    assert got == wanted, (got, wanted)
    assert [(name, count) for name, _, count in scan.classes] == [("B", 4), ("S", 1)], scan.classes
    script = "class P {\n  private a = 1;\n  go(x: number): string {\n    return `}${x}`;\n  }\n}\nfunction f(): void {\n  g();\n}\n"
    got = [(name, length) for name, _, length in Scan(script, True).functions]
    assert got == [("go", 3), ("f", 3)], got
    assert list(python_functions("def f():\n  pass\n  pass\n")) == [("f", 1, 3)]
    assert offenders("x.h", "\n" * 301) == ["x.h: 301 lines, expected at most 300 in a header"]
    many = "class C {\n public:\n" + "".join("  int f%d();\n" % n for n in range(31)) + "};\n"
    assert offenders("x.h", many) == ["x.h:1: C has 31 public functions, expected at most 30"]
    print("check_sizes: the scan holds")


if __name__ == "__main__":
    if sys.argv[1:] != ["--test"]:
        sys.exit(__doc__.strip())
    test()
