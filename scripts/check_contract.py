#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds firmware/include (the contract) against what implements it: firmware/library with hal_dspic.

    scripts/check_contract.py            exit 1 unless every prototype has exactly one definition

A prototype's linker name is its own name, or that with the prefix its header gives it (TP_VARIANT). A definition
takes the linker name of the first header that its file includes and that declares it, as the compiler does. What
webots/ and device/ declare is for programs of the PC: asked of build/libcontroller.so where that is built, and not of
firmware. What twinpuck/ declares is the simulator's own and not asked of the chip.
"""
import collections
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "firmware/include"
COMMON = ROOT / "firmware/library"
HAL = ROOT / "hal_dspic"
CONTROLLER = ROOT / "build/libcontroller.so"  # what programs of the PC link with

# headers without prototypes of the contract, or that only include others
NO_PROTOTYPES = {"p30F6014A.h",
                 "supervisor.h"}  # of programs of the PC; a few are firmware's as well
# declared by the original library's headers and contained in none of its versions: not linked there, nor here
ONLY_DECLARED = {"e_i2cp_read_string", "e_i2cp_write_string",
                 "e_po6030k_set_color_mode", "e_po8030d_set_color_mode"}
# of the vendor's libpic30 on the chip, of firmware/libc/src/eedata.c here
VENDORS_LIBRARY = {"_erase_eedata", "_erase_eedata_all", "_memcpy_p2d16", "_wait_eedata", "_write_eedata_row", "_write_eedata_word"}
# a header's own variant macro -> (switch, prefix with the switch, prefix without)
VARIANT_MACROS = {"TP_MOTORS": ("E_MOTORS_TIMER3", "tp_timer3_", "tp_basic_"),
                  "TP_PROX": ("E_PROX_TIMER2", "tp_t2_", "tp_basic_")}


def plain(text):
    """C without comments and preprocessor lines."""
    text = re.sub(r"/\*.*?\*/", " ", text, flags=re.S)
    text = re.sub(r"//[^\n]*", " ", text)
    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)


PROTOTYPE = re.compile(r"(?:^|[;}])\s*(?:extern\s+)*(?:[A-Za-z_]\w*[\s*]+)+?(\w+)\s*"
                       r"(\((?:[^()]|\([^()]*\))*\))\s*(?:(TP_\w+)\s*\(\s*(\w+)\s*(?:,\s*\w+\s*)?\)\s*)?(?=;)")


def prototypes(header):
    """{name: set of prefixes} of one header; a header with a switch has two."""
    text = re.sub(r"\{[^{}]*\}", "{}", plain(header.read_text()))
    found = {}
    for name, _, macro, prefix in PROTOTYPE.findall(text):
        if macro == "TP_VARIANT":
            found[name] = {None: prefix}
        elif macro in VARIANT_MACROS:
            switch, on, off = VARIANT_MACROS[macro]
            found[name] = {switch: on, None: off}
        else:
            found[name] = {None: ""}
    return found


def read_contract():
    contract = {}
    for header in sorted(INCLUDE.rglob("*.h")):
        if header.name not in NO_PROTOTYPES:
            contract[header.relative_to(INCLUDE).as_posix()] = prototypes(header)
    return contract


DEFINITION = re.compile(r"^(?!static\b|typedef\b|struct\s+\w+\s*\{)(?:[A-Za-z_]\w*[\s*]+)+?(\w+)\s*"
                        r"\((?:[^(){};]|\([^()]*\))*\)\s*\{", re.M)


def definitions(source, contract):
    """Linker names defined by one file of the API: [(linker name, line)]."""
    raw = source.read_text()
    if source.suffix == ".s":  # assembler: the names it makes global, without the underscore of C
        return [(match.group(1), raw.count("\n", 0, match.start()) + 1) for match in re.finditer(r"^\s*\.global\s+_(\w+)", raw, re.M)]
    # drivers written once for two units lie in a header beside their files
    own = [source.parent / name for name in re.findall(r'^#\s*include\s+"([\w.]+)"', raw, flags=re.M)]
    raw += "".join("\n" + header.read_text() for header in own if header.is_file())
    prefixes = {}
    switches = set()
    for directive, what in re.findall(r"^#\s*(include|define)\s+[\"<]?([\w./-]+)", raw, flags=re.M):
        if directive == "define":
            switches.add(what)
        for name, choices in contract.get(what, {}).items():
            chosen = next((p for switch, p in choices.items() if switch in switches), choices[None])
            prefixes.setdefault(name, chosen)
    found = []
    text = re.sub(r"__attribute__\(\(\w+\)\)\s*|\bTAKES\(\w+\)\s*", "", raw)
    blank = lambda match: re.sub(r"[^\n]", " ", match.group(0))  # keeps line numbers
    text = re.sub(r"/\*.*?\*/", blank, text, flags=re.S)
    code = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, text, flags=re.M)
    for match in DEFINITION.finditer(code):
        name = match.group(1)
        found.append((prefixes.get(name, "") + name, text.count("\n", 0, match.start()) + 1))
    return found


def main():
    if sys.argv[1:]:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    contract = read_contract()
    declared = {}
    for header, names in contract.items():
        for name, choices in names.items():
            for prefix in choices.values():
                declared.setdefault(prefix + name, header)
    problems = []
    defined = collections.defaultdict(list)
    for source in sorted(COMMON.glob("*.c")) + sorted(HAL.rglob("*.[cs]")):
        for name, line in definitions(source, contract):
            defined[name].append("%s:%d" % (source.relative_to(ROOT), line))
    asked = {name: header for name, header in declared.items()
             if name not in ONLY_DECLARED | VENDORS_LIBRARY and not header.startswith(("webots/", "device/", "twinpuck/"))}
    for name, header in sorted(asked.items()):
        if not defined[name]:
            problems.append("firmware/include/%s: %s: declared, but nothing of hal_dspic defines it" % (header, name))
    for name, places in sorted(defined.items()):
        # two drivers of one unit each have a handler; a program links one of them
        if len(places) > 1 and name in declared:
            problems.append("%s: %s: defined again, first in %s" % (places[1], name, places[0]))
    counts = ["chip %d of %d" % (sum(1 for name in asked if defined[name]), len(asked))]
    if CONTROLLER.exists():  # its functions come from macros, too: only the compiler knows them
        listing = subprocess.run(["nm", "-D", "--defined-only", CONTROLLER], capture_output=True, text=True, check=True)
        exported = {line.split()[-1] for line in listing.stdout.splitlines()}
        asked = {name: header for name, header in declared.items() if header.startswith(("webots/", "device/"))}
        for name, header in sorted(asked.items()):
            if name not in exported:
                problems.append("firmware/include/%s: %s: declared, but libcontroller.so has it not" % (header, name))
        counts.append("PC %d of %d" % (len(exported & set(asked)), len(asked)))
    else:
        counts.append("PC not built")

    for problem in problems:
        print(problem)
    print("contract: %d linker names declared; defined: %s; %d problems" % (len(declared), ", ".join(counts), len(problems)))
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
