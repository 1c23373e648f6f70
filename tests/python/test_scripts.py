# SPDX-License-Identifier: MIT
"""The scripts that hold the project's rules: each rule finds what breaks it and nothing else, and what a script wrote is there."""
import importlib
import os
import pathlib
import re
import subprocess
import sys

import pytest

from conftest import reads

ROOT = pathlib.Path(__file__).parents[2]
SCRIPTS = ROOT / "scripts"


def script(name):
    """A script as a module."""
    if str(SCRIPTS) not in sys.path:
        sys.path.insert(0, str(SCRIPTS))
    return importlib.import_module(name)


def run(*words, **settings):
    return subprocess.run([*map(str, words)], cwd=ROOT, text=True, capture_output=True, check=False, **settings)


@pytest.mark.parametrize("words", ["check_pages.py --test", "check_sizes.py --test", "check_contract.py", "gen_sfr_header.py --check",
                                   "gen_sfr_table.py --check", "gen_configuration.py --check", "gen_instruction_table.py --check",
                                   "instruction_coverage.py --check"])
def test_a_script_finds_the_tree_in_order(words):
    done = run(sys.executable, *[SCRIPTS / words.split()[0], *words.split()[1:]])
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("drawer, picture", [("draw_line.py", "worlds/line.png"), ("draw_field.py", "worlds/soccer.png")])
def test_a_floor_is_what_its_script_draws(drawer, picture, tmp_path):
    done = run(sys.executable, SCRIPTS / drawer, tmp_path / "drawn.png")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "drawn.png").read_bytes() == (ROOT / picture).read_bytes()


# --- check.py

OK: list[str] = []
BOARD, CPU, CLOCK = '#include "hal_sim/board/board.h"', '#include "dspic30/core/cpu.h"', '#include "sim_core/base/clock.h"'
MACHINE = "// /" + "home/somebody/x"
INCLUDES = [
    ("sim_core/light/x.h", '#include "sim_core/world/scene.h"', OK),
    ("sim_core/world/x.h", '#include "sim_core/light/proximity.h"', ["sim_core/world may not include sim_core/light/proximity.h"]),
    ("sim_core/base/x.h", BOARD, ["sim_core/base may not include hal_sim/board/board.h"]),
    ("sim_core/simulation.cpp", '#include "sim_core/load/schema.h"', OK),
    ("sim_core/simulation.cpp", BOARD, ["sim_core may not include hal_sim/board/board.h"]),
    ("hal_sim/drivers/x.h", BOARD, OK),
    ("hal_sim/board/x.h", '#include "hal_sim/drivers/drivers.h"', ["hal_sim/board may not include hal_sim/drivers/drivers.h"]),
    ("dspic30/core/x.h", '#include "dspic30/periph/adc.h"', OK),
    ("dspic30/periph/x.h", CPU, ["dspic30/periph may not include dspic30/core/cpu.h"]),
    ("dspic30/core/x.h", CLOCK, ["dspic30/core may not include sim_core/base/clock.h"]),
    ("dspic30/load/lazy_dw.cpp", '#include "sim_core/base/lazy_library.h"', OK),
    ("dspic30/core/x.h", "#include <algorithm>", OK),
    ("dspic30/core/x.h", "#include <fmt/format.h>", ["dspic30 uses the standard library only, not <fmt/format.h>"]),
    ("dspic30/load/x.cpp", "#include <gelf.h>", OK),
    ("outputs/x.cpp", "#include <cairo.h>", ["<cairo.h> belongs to sim_core/record or sim_core/load or tools"]),
    ("tools/x.cpp", f"{BOARD}\n{CPU}\n#include <cairo.h>", OK),
    ("firmware/blink/test.cpp", BOARD, OK),
    ("firmware/blink/main.c", BOARD, ["firmware may not include hal_sim/board/board.h"]),
]
NAMES = [
    ("sim_core/base/x.h", "namespace board {\nclass Board;\n}", ["sim_core/base may not name classes of hal_sim/board"]),
    ("hal_sim/drivers/x.h", "namespace board {\nclass Board;\n}", OK),
    ("tools/x.h", "namespace board {\nclass Board;\n}", OK),
]
NUMBERS = [
    ("x_params.h", "constexpr double kA = 1.5;  // [DS 5.1]", OK),
    ("x_params.h", "constexpr double kA = 1.5;", ["number without exactly one source tag, such as [DS 5.1]: constexpr double kA = 1.5;"]),
    ("x_params.h", "constexpr double kA = 1.5;  // [DS 5.1] [DS 5.2]",
     ["number without exactly one source tag, such as [DS 5.1]: constexpr double kA = 1.5;"]),
    ("x_params.h", "// of both [DS 5.1]\nint kA = 1;\nint kB = 2;", OK),
    ("x_params.h", "// of the first [DS 5.1]\nint kA = 1;\n\nint kB = 2;",
     ["number without exactly one source tag, such as [DS 5.1]: int kB = 2;"]),
    ("x_params.h", "double twice(double x);\nint kB = kA;", OK),
]
TEXTS = [
    ("tools/x.cpp", "// SPDX-License-Identifier: MIT", OK),
    ("tools/x.cpp", "\n\n\n// SPDX-License-Identifier: MIT", ["no SPDX-License-Identifier: MIT in the first three lines"]),
    ("docs/x.md", "", OK),
    ("docs/x.md", MACHINE, ["path of somebody's machine: " + MACHINE]),
    ("docs/x.md", "the native" + " way", ["a word of what is gone: the native" + " way"]),
    ("docs/x.md", "in supervisor" + "/programs", ["a word of what is gone: in supervisor" + "/programs"]),
    ("docs/x.md", "an e-puck", OK),
    ("sim_core/x.txt", "an e-puck", ["sim_core knows no robot by name: an e-puck"]),
    ("tools/x.txt", "\n" * 800, OK),
    ("docs/x.md", "\n" * 699, OK),
    ("docs/x.md", "\n" * 700, ["701 lines, expected at most 700; split it"]),
]


@pytest.mark.parametrize("rule, path, text, expected", [
    (rule, *row) for rule, rows in (("check_includes", INCLUDES), ("check_forward_declarations", NAMES), ("check_numbers", NUMBERS),
                                    ("check_text", TEXTS)) for row in rows])
def test_a_rule_finds_what_breaks_it(rule, path, text, expected):
    check = script("check")
    check.problems.clear()
    getattr(check, rule)(path, text)
    assert [re.sub(r"^[\w./-]+(?::\d+)?: ", "", line) for line in check.problems] == expected


def test_rooms_in_a_circle_are_found():
    check = script("check")
    check.problems.clear()
    check.arrows.clear()
    check.arrows.update({("a", "b"): "a/x.h:1", ("b", "c"): "b/x.h:1", ("d", "a"): "d/x.h:1"})
    check.check_circles()
    assert check.problems == []
    check.arrows["c", "a"] = "c/x.h:1"
    check.check_circles()
    assert sorted(check.problems) == ["a/x.h:1: a includes b, from which it is reached again",
                                      "b/x.h:1: b includes c, from which it is reached again",
                                      "c/x.h:1: c includes a, from which it is reached again"]
    check.arrows.clear()


def test_a_room_that_is_new_or_gone_is_found():
    check = script("check")
    files = check.committed_files()
    for there, expected in ((files, []), (files + ["attic/x.py"], ["scripts/rooms.py: attic: got no line, expected what this room holds"]),
                            ([f for f in files if not f.startswith("flash/")], ["scripts/rooms.py: flash: there is no such room"])):
        check.problems.clear()
        check.check_rooms(there)
        assert check.problems == expected


# --- check_contract.py

HEADERS = {
    "a.h": "/* int commented(void); */\n#define TWICE(x) \\\n  twice(x)\nvoid plain(int a, char *b);\nunsigned long more(int (*call)(int), int n);\n"
           "int given(void) TP_VARIANT(tp_fast_, given);\nstruct point { int x; int (*no)(void); };\nextern int counter;\n"
           "typedef int (*handler)(int);\nvoid made(void);\nvoid e_i2cp_read_string(void);\n",
    "motors.h": "void e_go(int speed) TP_MOTORS(e_go);\n",
    "webots/robot.h": "int wb_robot_init(void);\n", "twinpuck/tell.h": "void tell(void);\n",
}
SOURCES = {
    "library/a.c": '#include "a.h"\nstatic int helper(void) {\n}\nvoid plain(int a, char *b) {\n  if (a) {\n  }\n}\n'
                   "unsigned long more(int (*call)(int), int n) {\n}\nint given(void) {\n}\n",
    "hal/a/motors.c": '#include "motors.h"\nvoid e_go(int speed) {\n}\n',
    "hal/a/motors3.c": '#define E_MOTORS_TIMER3\n#include "motors.h"\nvoid e_go(int speed) {\n}\n', "hal/x.s": "  .global _made\n_made: return\n",
}


@pytest.mark.parametrize("changes, problems, counts", [
    ({}, [], "9 linker names declared; defined: chip 6 of 6, PC not built"),
    ({"hal/x.s": ""}, ["firmware/include/a.h: made: declared, but nothing of hal_dspic defines it"], "chip 5 of 6"),
    ({"hal/a/motors3.c": ""}, ["firmware/include/motors.h: tp_timer3_e_go: declared, but nothing of hal_dspic defines it"], "chip 5 of 6"),
    ({"library/b.c": '#include "a.h"\n/*\n*/\nvoid plain(int a, char *b) {\n}\n'}, ["library/b.c:4: plain: defined again, first in library/a.c:4"], ""),
    ({"library/b.c": "static void plain(int a, char *b) {\n}\nvoid own(void) {\n}\n"}, [], "chip 6 of 6"),
    ({"include/b.h": "int late(int a[3]);\n"}, ["firmware/include/b.h: late: declared, but nothing of hal_dspic defines it"], "chip 6 of 7"),
    ({"include/p30F6014A.h": "int late(void);\n"}, [], "9 linker names"),
    ({"none.so": "", "nm": "#!/bin/sh\necho 0123 T wb_robot_init\n"}, [], "chip 6 of 6, PC 1 of 1"),
    ({"none.so": "", "nm": "#!/bin/sh\n"}, ["firmware/include/webots/robot.h: wb_robot_init: declared, but libcontroller.so has it not"], "PC 0 of 1"),
])
def test_what_breaks_the_contract_is_found(changes, problems, counts, tmp_path, monkeypatch, capsys):
    contract = script("check_contract")
    for name, text in ({"include/" + header: text for header, text in HEADERS.items()} | SOURCES | changes).items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
        (tmp_path / name).chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    for name, place in (("ROOT", ""), ("INCLUDE", "include"), ("COMMON", "library"), ("HAL", "hal"), ("CONTROLLER", "none.so")):
        monkeypatch.setattr(contract, name, tmp_path / place)
    monkeypatch.setattr(sys, "argv", ["check_contract.py"])
    assert contract.main() == (1 if problems else 0)
    *said, last = capsys.readouterr().out.splitlines()
    assert said == problems
    assert counts in last and last.endswith(f"{len(problems)} problems")


# --- the others

def test_a_part_of_a_page_is_found():
    generated = script("generated")
    page = "a\n<!-- b: who -->\nold\n<!-- end -->\n<!-- c: who -->\nx\n<!-- end -->\n"
    begin, end = generated.part(page, "b")
    assert page[begin:end] == "old\n"
    begin, end = generated.part(page, "c")
    assert page[begin:end] == "x\n"
    for broken in (page.replace("<!-- b", "<!-- d"), page[:30]):
        with pytest.raises(SystemExit) as wrong:
            generated.part(broken, "b")
        reads(str(wrong.value), "got no part '<!-- b: ... -->' to '<!-- end -->' in the page, expected one")


def test_a_generated_file_that_differs_is_found(tmp_path, monkeypatch, capsys):
    generated = script("generated")
    table, file = tmp_path / "table", tmp_path / "file"

    def main(*words):
        monkeypatch.setattr(sys, "argv", ["gen.py", *words])
        return generated.main("doc", "gen.py", table, file, lambda: "new\n")

    assert main("--check") == 1
    reads(capsys.readouterr().out, "file: differs from what table gives; run gen.py")
    assert main() == 0 and file.read_text() == "new\n"
    assert main("--check") == 0
    file.write_text("old\n")
    assert main("--check") == 1 and file.read_text() == "old\n"
    assert main("--chek") == 2 and file.read_text() == "old\n"


def test_each_long_check_has_its_turn(tmp_path):
    """Seven turns, which fuzz every kind of input between them."""
    (tmp_path / "make").write_text("#!/bin/sh\necho \"$FUZZ_SECONDS\" \"$@\"\n")
    (tmp_path / "make").chmod(0o755)
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}
    said = [run("sh", SCRIPTS / "in_turn.sh", turn, env=environment).stdout.splitlines()[-1] for turn in range(7)]
    assert said[0] == "60 tsan TSAN=golden_test" and said[1] == "60 levels"
    kinds = re.findall(r'\{"(\w+)", \1\}', (ROOT / "tests/fuzz/kinds.h").read_text())
    assert sorted(" ".join(line.partition("FUZZ_KINDS=")[2] for line in said[2:]).split()) == sorted(kinds)
    assert run("sh", SCRIPTS / "in_turn.sh", 7, env=environment).returncode == 2
