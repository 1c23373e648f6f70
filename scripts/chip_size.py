#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What a program takes of the chip: flash and RAM from the linker's report, the stack from the disassembly.

    scripts/chip_size.py LINKER_REPORT DISASSEMBLY FLASH_BYTES RAM_BYTES HEAP_BYTES     exit 1 when it does not fit

The stack's estimate is the deepest chain of calls from main, plus, for each interrupt priority that nests, the deepest
chain of any handler. Priorities are not known here, so every handler is counted as if it nested: an upper bound, except
for calls through pointers (agendas' callbacks are added once, as the deepest function whose address nobody calls
directly) and recursion, both of which are told.
"""
import re
import sys

CALL_BYTES = 4        # return address
INTERRUPT_BYTES = 4   # return address and status


def used(report, kind):
    match = re.search(r"Total %s memory used \(bytes\):\s*0x[0-9a-f]+\s*\((\d+)\)" % kind, report, re.I)
    return int(match.group(1)) if match else None


def functions(listing):
    """{name: (bytes of its own frame, [names it calls], calls through a pointer?)}"""
    found = {}
    # the disassembler names targets in other sections only; the others are addresses
    starts = {int(a, 16): n for a, n in re.findall(r"^([0-9a-f]+) <([^>.][^>]*)>:", listing, re.M)}
    name = None
    for line in listing.splitlines():
        head = re.match(r"^[0-9a-f]+ <([^>]+)>:", line)
        if head:
            if not head.group(1).startswith("."):
                name = head.group(1)
                found.setdefault(name, [0, [], False])
            continue
        if name is None:
            continue
        code = re.sub(r"^\s*[0-9a-f]+:\s*(?:[0-9a-f]{2} ){3,}\s*", "", line).strip().lower()
        entry = found[name]
        frame = re.match(r"lnk\s+#0x([0-9a-f]+)", code)
        if frame:
            entry[0] += 2 + int(frame.group(1), 16)
        elif re.match(r"push\.d|mov\.d\s+w\d+,\s*\[w15\+\+\]", code):
            entry[0] += 4
        elif re.match(r"push(\.w)?\s|mov(\.w)?\s+\S+,\s*\[w15\+\+\]", code):
            entry[0] += 2
        call = re.match(r"r?call\S*\s+(.*)", code)
        if call:
            target = re.search(r"<([^>+]+)>", line)
            address = re.match(r"0x([0-9a-f]+)", call.group(1))
            if target:
                entry[1].append(target.group(1))
            elif address and int(address.group(1), 16) in starts:
                entry[1].append(starts[int(address.group(1), 16)])
            else:
                entry[2] = True
    return found


def depth(name, table, notes, path=()):
    if name in path:
        notes.add("recursion through %s, counted once" % name.lstrip("_"))
        return 0
    own, callees, by_pointer = table.get(name, (0, [], False))
    deepest = max([depth(c, table, notes, path + (name,)) + CALL_BYTES for c in callees], default=0)
    if by_pointer:
        notes.add("%s calls through a pointer" % name.lstrip("_"))
    return own + deepest


def main():
    if len(sys.argv) != 6:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    report = open(sys.argv[1]).read()
    listing = open(sys.argv[2]).read()
    flash_bytes, ram_bytes, heap_bytes = (int(a) for a in sys.argv[3:])
    flash, data = used(report, "program"), used(report, "data")
    if flash is None or data is None:
        print("size: the linker's report has no totals; see %s" % sys.argv[1])
        return 0
    print("flash  %6d of %d bytes (%d %%)" % (flash, flash_bytes, 100 * flash // flash_bytes))
    print("RAM    %6d of %d bytes (%d %%), %d of them the heap" % (data, ram_bytes, 100 * data // ram_bytes, heap_bytes))
    left = ram_bytes - data  # the linker counts the heap as data
    fits = flash <= flash_bytes and left > 0
    table = functions(listing)
    if "_main" in table:
        notes = set()
        need = depth("_main", table, notes)
        called = {c for _, callees, _ in table.values() for c in callees}
        handlers = [n for n in table if re.match(r"__\w+Interrupt$", n)]
        for handler in handlers:
            need += INTERRUPT_BYTES + depth(handler, table, notes)
        if any(by_pointer for _, _, by_pointer in table.values()):
            apart = [n for n in table if n not in called and n not in handlers and n != "_main" and n.startswith("_")]
            need += max([depth(n, table, notes) for n in apart], default=0)
        print("stack  %6d bytes at most, %d left for it" % (need, left))
        for note in sorted(notes):
            print("       %s" % note)
        fits = fits and need <= left
    else:
        print("stack  not known: no disassembly; %d bytes left for it" % left)
    if not fits:
        print("make dspic: chip: got a program that does not fit, expected one within its flash, RAM and stack", file=sys.stderr)
    return 0 if fits else 1


if __name__ == "__main__":
    sys.exit(main())
