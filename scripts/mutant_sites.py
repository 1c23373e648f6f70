# SPDX-License-Identifier: MIT
"""Where scripts/mutants.py may plant a fault, and which: read from the sources by libclang (Debian: python3-clang-14)."""
import random
import re

SWAPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-", "-": "+",
         "*": "/", "/": "*", "&": "|", "|": "&", "<<": ">>", ">>": "<<", "+=": "-=", "-=": "+="}


def sites_of_node(clang, node, text):
    """The faults that a node offers: (kind, begin, end, what stands there instead, with "mutant(N)" for its number)."""
    def said(first, last):
        return text[first:last].decode()

    kinds, children = clang.CursorKind, list(node.get_children())
    begin, end = node.extent.start.offset, node.extent.end.offset
    edges = [(c.extent.start.offset, c.extent.end.offset) for c in children]
    own = said(begin, end)
    if node.kind == kinds.COMPOUND_STMT:
        for child, (first, last) in zip(children, edges):
            if child.kind.is_expression() and text[last:last + 1] == b";" and not re.match(r"[A-Z_]+\(", said(first, last)):
                yield "left out", first, last, f"if (!mutant(N)) {said(first, last)}"
    elif node.kind in (kinds.BINARY_OPERATOR, kinds.COMPOUND_ASSIGNMENT_OPERATOR) and len(children) == 2:
        operator = said(edges[0][1], edges[1][0]).strip()
        if operator in SWAPS:
            swapped = f"{said(begin, edges[0][1])} {SWAPS[operator]} {said(edges[1][0], end)}"
            yield f"{operator} to {SWAPS[operator]}", begin, end, f"(mutant(N) ? ({swapped}) : ({own}))"
    elif node.kind == kinds.INTEGER_LITERAL and re.fullmatch(r"\d+u?|0x[0-9a-fA-F]+u?", own):
        yield "one more", begin, end, f"(mutant(N) ? {own} + 1 : {own})"
    elif node.kind == kinds.FLOATING_LITERAL and re.fullmatch(r"[\d.e-]+f?", own):
        yield "twice and one", begin, end, f"(mutant(N) ? {own} * 2 + 1 : {own})"
    elif node.kind == kinds.IF_STMT and children and children[0].kind.is_expression():
        condition = said(*edges[0])
        yield "turned", *edges[0], f"(mutant(N) ? !({condition}) : bool({condition}))"
        yield "always", *edges[0], f"(mutant(N) || ({condition}))"
        yield "never", *edges[0], f"(!mutant(N) && ({condition}))"
    elif node.kind == kinds.RETURN_STMT and children and children[0].type.kind != clang.TypeKind.VOID:
        instead = f"!({said(edges[0][0], end)})" if children[0].type.kind == clang.TypeKind.BOOL else "{}"
        yield "returned", begin, end, f"{{ if (mutant(N)) return {instead}; {own}; }}"


def sites_of_file(tree, name, flags):
    """Sites in bodies of functions, outside macros and constant expressions, and whether a file compiles with one."""
    import clang.cindex as clang  # planting alone needs it
    path, text, sites = str(tree / name), (tree / name).read_bytes(), []
    unit = clang.Index.create().parse(path, [*flags, "-include", str(tree.parent / "mutant.h"), "-w"], options=4)  # headers once

    def visit(node, inside):
        kinds = clang.CursorKind
        if node.kind in (kinds.VAR_DECL, kinds.FUNCTION_DECL, kinds.CXX_METHOD) and \
                b"constexpr" in text[node.extent.start.offset:node.extent.end.offset].split(b"{")[0]:
            return
        inside = inside or node.kind == kinds.COMPOUND_STMT
        if inside:
            sites.extend(sites_of_node(clang, node, text))
        for i, child in enumerate(node.get_children()):
            if node.kind != kinds.CASE_STMT or i > 0:
                visit(child, inside)

    def compiles(site):
        changed = text[:site[1]] + site[3].replace("mutant(N)", "mutant(1)").encode() + text[site[2]:]
        unit.reparse([(path, changed.decode())], options=4)
        return not any(d.severity >= clang.Diagnostic.Error for d in unit.diagnostics)

    for node in unit.cursor.get_children():
        if node.location.file and node.location.file.name == path:
            visit(node, False)
    return text, sites, compiles


def choose_in_room(tree, files, wanted, seed):
    """`wanted` sites of a room, in files chosen by chance, of kinds chosen by chance; at most three files if they do."""
    names = sorted(files)
    chance = random.Random(f"{seed} {names[0]}")
    chance.shuffle(names)
    chosen = []
    for i, name in enumerate(names):
        text, sites, compiles = sites_of_file(tree, name, files[name])
        here = -(-(wanted - len(chosen)) // min(max(3 - i, 1), len(names) - i))
        while here and sites:
            kind = chance.choice(sorted({s[0] for s in sites}))
            site = chance.choice([s for s in sites if s[0] == kind])
            sites.remove(site)
            if compiles(site):
                what, begin, end, instead = site
                sites = [s for s in sites if s[2] <= begin or s[1] >= end]
                chosen.append({"file": name, "line": text[:begin].count(b"\n") + 1, "kind": what, "begin": begin, "end": end,
                               "original": text[begin:end].decode(), "instead": instead})
                here -= 1
        if len(chosen) >= wanted:
            break
    return chosen
