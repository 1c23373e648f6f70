# SPDX-License-Identifier: MIT
"""A file that is written from a table, and the check that the committed one is what the table gives."""
import sys


def main(doc, script, table, file, generate):
    """Arguments of the command line: none writes `file`, --check compares. Returns the exit code."""
    text = generate()
    if sys.argv[1:] == ["--check"]:
        if not file.exists() or file.read_text() != text:
            print("%s: differs from what %s gives; run %s" % (file.name, table.name, script))
            return 1
        return 0
    if sys.argv[1:]:
        print(doc.strip(), file=sys.stderr)
        return 2
    file.write_text(text)
    return 0
