#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes dspic30/core/instruction_rows.inc from dspic30/core/instructions.csv: the table that decoder, disassembler and
assembler read.

    scripts/gen_instruction_table.py            write the table
    scripts/gen_instruction_table.py --check    exit 1 when the committed table is not what instructions.csv gives

A row: name, mnemonic, operand text, mask and match of the first word, words, cycles, whether REPEAT may run it,
fields {member, mask}, operands, constraint. Bits x of NOP and its like belong to no field. A division's cycles are those of one iteration. Second names
of a row (alias) are the assembler's.
"""
import csv
import pathlib
import re
import sys

import generated

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "dspic30/core/instructions.csv"
ROWS = ROOT / "dspic30/core/instruction_rows.inc"

# an operand of the table -> its kinds; "Wn" and "Wnd" depend on the field that holds them
OPERANDS = {
    "f {,WREG}": ["File", "WregOption"], "f": ["File"], "WREG": ["Wreg"], "#bit": ["FileBit"], "#bit4": ["Bit"],
    "#Slit4": ["Shift4"], "#Slit6": ["Shift6"], "Wb": ["Wb"], "Ws": ["Source"], "Wd": ["Destination"],
    "[Ws]": ["Source"], "[Wd]": ["Destination"], "Wso": ["SourceOffset"], "Wdo": ["DestinationOffset"],
    "[Ws+Slit10]": ["SourceLiteral"], "[Wd+Slit10]": ["DestinationLiteral"], "Acc": ["Accumulator"],
    "Wm*Wn": ["Product"], "Wm*Wm": ["Square"],
}


def operands(row, pattern):
    """Operand kinds of a row in the order in which they are written."""
    text, name = row["operands"], row["mnemonic"]
    if name in ("CLR", "MOVSAC") and "Wx" in text:
        return ["Accumulator", "Prefetch", "WriteBack"]
    if name in ("ED", "EDAC"):
        return ["Square", "Accumulator", "Distance"]
    if "*" in text:
        return ["Product" if "Wn" in text else "Square", "Accumulator", "Prefetch"] + ["WriteBack"] * ("a" in pattern)
    if name.startswith("DIV"):
        return ["DividendF" if name == "DIVF" else "DividendLong" if "32" in text else "Dividend", "Rs"]
    kinds = []
    text = text.replace("f {,WREG}", "f WREG")
    for part in filter(None, text.split(",")):
        part = {"f WREG": "f {,WREG}"}.get(part, part)
        if name == "SFTAC" and part == "Wb":
            kinds.append("Rs")
        elif part in OPERANDS:
            kinds += OPERANDS[part]
            if part == "f" and pattern.count("f") == 15:
                kinds[-1] = "FileWord"  # the field holds half the address
        elif part in ("Wn", "Wns", "Wnd", "Wb,Wn"):
            field = "d" if part == "Wnd" or (part == "Wn" and "d" in pattern) else "s"
            kinds.append("R" + field + ("Pair" if pattern.count(field) == 3 else ""))
        elif part == "Expr":
            kinds.append("DoEnd" if name == "DO" else "Target" if pattern.endswith("0") else "Branch")
        elif part.startswith("#lit"):
            kinds.append("LiteralTwice" if pattern.count("k") == 13 else "Literal")
        else:
            sys.exit("instructions.csv: unknown operand %r of %s" % (part, name))
    return kinds


def identifier(row):
    name = row["mnemonic"].replace(".", "_")
    name = "_".join(word if word.isupper() and i else word.capitalize() for i, word in enumerate(re.split(r"[ _]", name)))
    text = row["operands"].replace("f {,WREG}", "f").replace("(32/16)", ",long").replace("*", "").replace("Slit", "slit")
    text = "Acc_prefetch" if "Acc {" in text and row["mnemonic"] in ("CLR", "MOVSAC") else text.split("{")[0]
    parts = [re.sub(r"\W", "", p) for p in text.split(",")]
    return "_".join([name] + [p for p in parts if p])


def generate():
    lines = []
    with TABLE.open(newline="") as table:
        for row in csv.DictReader(table):
            if row["kind"] == "alias":
                continue
            pattern = row["word1"].replace(" ", "")
            whole = row["mnemonic"].startswith("NOP") or row["kind"] == "debug"
            mask = int("".join("1" if c in "01" else "0" for c in pattern), 2)
            match = int("".join("1" if c == "1" else "0" for c in pattern), 2)
            fields = {}
            for i, letter in enumerate(pattern):
                if letter not in "01" and not whole:
                    fields[letter] = fields.get(letter, 0) | 1 << (23 - i)
            names = ", ".join("{&Fields::%s, 0x%06X}" % (k, m) for k, m in sorted(fields.items()))
            condition = row["constraints"].replace("|", " || ").replace(";", " && ")
            condition = re.sub(r"\b([a-zA-Z])\b", r"f.\1", condition) or "true"
            if condition == "true":
                test = "nullptr"
            else:
                condition = re.sub(r"(\S+ \|\| \S+)(?= &&|$)", r"(\1)", condition) if "&&" in condition else condition
                test = "+[](const Fields& f) { return %s; }" % re.sub(r"(==|!=|>=|<|>(?!=)|%|\+)", r" \1 ", condition)
            kinds = operands(row, pattern)
            cycles = "1" if "per iteration" in row["cycles"] else re.match(r"\d+", row["cycles"]).group(0)
            lines.append('ROW(%s, "%s", "%s", 0x%06X, 0x%06X, %s, %s, %s, (FieldList{%s}), (Operands{%s}), %s)' % (
                identifier(row), row["mnemonic"], row["operands"], mask, match, row["words"], cycles, "true" if row["repeatable"] == "y" else "false",
                names, ", ".join("Operand::" + k for k in kinds), test))
    head = "// SPDX-License-Identifier: MIT\n// GENERATED by scripts/gen_instruction_table.py from " \
           "dspic30/core/instructions.csv; change the table, not this file.\n"
    return head + "\n".join(lines) + "\n"


if __name__ == "__main__":
    sys.exit(generated.main(__doc__, "scripts/gen_instruction_table.py", TABLE, ROWS, generate))
