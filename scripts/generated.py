# SPDX-License-Identifier: MIT
"""A file, or a part of a page, that is written from a table, and the check that it is what the table gives."""
import re
import sys


def part(page, name):
    """Where the part of a page lies: its text is page[begin:end]. It stands between two comments of HTML."""
    found = re.search(r"^<!-- %s: .*-->\n" % re.escape(name), page, re.M)
    end = page.find("<!-- end -->\n", found.end()) if found else -1
    if end < 0:
        sys.exit("got no part '<!-- %s: ... -->' to '<!-- end -->' in the page, expected one" % name)
    return found.end(), end


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
