# SPDX-License-Identifier: MIT
"""functions_test.py ROOT: the table of controller/functions.py says of each function what the headers of C say."""
import re
import subprocess
import sys
import unittest

ROOT = sys.argv.pop(1)
sys.path.insert(0, ROOT + "/programs/controller/python")
from controller.functions import FUNCTIONS  # noqa: E402

HEADERS = ["-I" + ROOT, "-I" + ROOT + "/programs/controller/include", "-I" + ROOT + "/firmware/include"]


def letters(kind):
    """What a type of C may be in the table."""
    kind = re.sub(r"\s+", " ", kind.replace("*", " * ")).strip()
    kind = re.sub(r"^const ", "", kind)
    if "*" in kind:
        return {"char *": "s", "double *": "D", "int *": "Ip", "char * const *": "p"}.get(kind, "pB")
    if kind.endswith("Ref"):
        return "p"
    return {"void": "v", "int": "i", "long": "l", "double": "d", "bool": "b", "_Bool": "b", "WbDeviceTag": "t"}.get(kind, "i")


def prototypes():
    text = subprocess.run(["gcc", "-E", "-P", *HEADERS, "-include", "programs/controller/c/public.h", "-x", "c", "/dev/null"],
                          capture_output=True, text=True, check=True).stdout
    found = {}
    for result, name, arguments in re.findall(r"([\w\s*]+?)\b((?:wb|twinpuck)_\w+)\s*\(([^()]*)\)\s*;", text):
        kinds = []
        for argument in arguments.split(","):
            array = "[" in argument
            words = re.sub(r"\[.*\]", "", argument).strip()
            words = re.sub(r"(?<=[\s*])\w+$", "", words).strip() if words != "void" else words
            kinds.append(words + " *" if array else words)
        result = re.sub(r"\b(extern|static|inline)\b", "", result)
        found[name.replace("wb_", "", 1)] = (letters(result), [letters(k) for k in kinds if k not in ("void", "")])
    return found


class Functions(unittest.TestCase):
    def test_table_is_that_of_the_headers(self):
        c = prototypes()
        self.assertGreater(len(c), 300)
        for name, (result, arguments) in FUNCTIONS.items():
            with self.subTest(name):
                self.assertIn(name, c)
                self.assertIn(result, c[name][0])
                self.assertEqual(len(arguments), len(c[name][1]))
                for mine, theirs in zip(arguments, c[name][1]):
                    self.assertIn(mine, theirs)


if __name__ == "__main__":
    unittest.main()
