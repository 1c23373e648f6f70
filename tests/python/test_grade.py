# SPDX-License-Identifier: MIT
"""twinpuck grade: a class of planted errors, its tables, and what programs may not do."""
import contextlib
import csv
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

import pytest

import twinpuck  # noqa: F401  the module must be there
from conftest import TWINPUCK, reads, wait_until

CAN_CONTAIN = subprocess.run(["bwrap", "--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--unshare-all", "true"],
                             stderr=subprocess.DEVNULL, check=False).returncode == 0
pytestmark = pytest.mark.skipif(not CAN_CONTAIN, reason="this machine lets nobody make namespaces")

WORLD = """twinpuck = 1
[arena]
size = [1.2, 1.2]
[[robot]]
name = "puck"
firmware = "."
position = [-0.3, 0]
"""

TESTS = """import pytest

@pytest.mark.points(2)
def test_says_ready(world, robot):
    robot.uart1.expect("ready\\r\\n", at_most=0.5)

def test_shows_led_4(world, robot):
    world.run(0.5)
    assert robot.leds == (False, False, False, False, True, False, False, False)

@pytest.mark.points(3)
def test_drives_ahead(world, robot):
    assert world.run_until("x_m > 0", at_most=4), f"x is {robot.x_m:.3f} m after {world.time_s:.1f} s"
    assert robot.collisions == 0

def test_counts(world, robot):
    world.run(1)
    assert 8 <= robot.variable("beats") <= 10
    assert robot.variable("total") == 45
"""

FAULTLESS = """#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <uart/e_uart_char.h>
#include <stdlib.h>
#include <string.h>

volatile int beats, due;
int total, values[10];
const char greeting[] = "ready\\r\\n";

static int sum(const int *from, int count)
{
  int i, all = 0;
  for (i = 0; i < count; i++)
    all += from[i];
  return all;
}

static void beat(void)
{
  beats++;
  due = 1;
}

int main(void)
{
  int i;
  e_init_port();
  e_init_uart1();
  e_init_motors();
  e_start_agendas_processing();
  e_activate_agenda(beat, 1000);
  for (i = 0; i < 10; i++)
    values[i] = i;
  e_send_uart1_char(greeting, 7);
  e_set_led(4, 1);
  e_set_speed_left(600);
  e_set_speed_right(600);
  while (1) {
    while (!due)
      ;
    due = 0;
    total = sum(values, 10);
  }
}
"""


# name -> what is changed to what, and what the message of a test that fails says, in its first line
PLANTED = {
    "semicolon": ("int i;\n  e_init_port", "int i\n  e_init_port", "…/main.c:29:8: error: expected ';' at end of declaration"),
    "typo": ("due = 1;", "deu = 1;", "…/main.c:24:3: error: use of undeclared identifier 'deu'"),
    "no_function": ("beats++;", "count_beats();",
                    "…/main.c:23: error: beat() calls count_beats(): got no definition, expected one in the program or the library; is a .c file missing from the folder, or the name misspelt?"),
    "no_header": ("#include <stdlib.h>", "#include <stdlip.h>", "…/main.c:6:10: fatal error: 'stdlip.h' file not found"),
    "wrong_type": ("int total, values[10];", "int total, values[10]; int *p = 3.5;",
                   "…/main.c:10:29: error: initializing 'int *' with an expression of incompatible type 'double'"),
    "two_mains": ("int main(void)", "int main(void) { return 0; }\nint main(void)",
                  "…/main.c:28:5: error: redefinition of 'main'"),
    "too_large": ("int total,", "int large[5000];\nint total,",
                  "link: error: RAM: no room for large, 10000 bytes in 0x0800 to 0x27FF; largest: large 10000, … …, … …, … …, … …, … …, … …, … …"),
    "zero_division": ("total = sum(values, 10);", "total = 45 / (beats - beats);",
                      "puck: main (…/main.c:45): math error: division by zero, or an overflow of an accumulator; the program has no _MathError(), so the processor resets"),
    "beyond_array": ("i < 10; i++)\n    values", "i < 12; i++)\n    values",
                     "puck: main (…/main.c:36): sanitizer: array index out of bounds (… times)"),
    "null": ("values[i] = i;", "*(int *)(i - i) = i;",
             "puck: main (…/main.c:36): sanitizer: write through a null pointer, at 0x0000"),
    "no_value": ("int i, all = 0;", "int i, all;",
                 "puck: main (…/main.c:17): sanitizer: all is read, and nobody has written it; a branch depends on it"),
    "overflow": ("all += from[i];", "all += from[i] + 32767;",
                 "puck: main (…/main.c:17): sanitizer: integer overflow in an addition (… times)"),
    "recursion": ("total = sum(values, 10);", "total = main();", "AssertionError: assert 0 == 45"),
    "odd_address": ("due = 0;", "*(volatile int *)((char *)values + 1) = 0; due = 0;",
                    "…/main.c:44: error: values: got address …, expected even and below 0x2000: a near variable"),
    "long_copy": ("due = 0;", "{ char few[4]; memcpy(few, greeting, 8); due = few[0] - few[0]; }",
                  "puck: main (…/main.c:44): sanitizer: in memcpy(): write out of bounds of the local variable few: got byte 4, expected 0 to 3"),
    "freed": ("due = 0;", "{ int *p = malloc(4); free(p); *p = 0; due = 0; }",
              "puck: main (…/main.c:44): sanitizer: use of freed heap memory: write of a heap block: got byte 1, expected 0 to 3"),
    "abort": ("due = 0;", "abort();", "puck: main (…/main.c:44): abort: abort(), or exit() with a failure, resets the processor"),
    "stuck": ("e_send_uart1_char(greeting, 7);", "while (i) ;\n  e_send_uart1_char(greeting, 7);",
              "robot 'puck' uart1: expected 'ready\\r\\n' within 0.5 s, nothing came; at 0.500 s the program stands in main (…/main.c:37)"),
    "waits_for_nobody": ("due = 1;", "due = 0;", "AssertionError: assert 0 == 45"),
    "no_agenda": ("e_start_agendas_processing();", "", "AssertionError: x is -0.300 m after 4.0 s"),
    "slow_beat": ("e_activate_agenda(beat, 1000);", "e_activate_agenda(beat, 5000);", "AssertionError: assert 8 <= …"),
    "fast_beat": ("e_activate_agenda(beat, 1000);", "e_activate_agenda(beat, 100);", "AssertionError: assert … <= 10"),
    "wrong_led": ("e_set_led(4, 1);", "e_set_led(3, 1);", "assert (False, … False, ...) == (False, … False, ...)"),
    "no_ports": ("e_init_port();", "", "assert (False, … False, ...) == (False, … False, ...)"),
    "no_motors": ("e_init_motors();", "", "AssertionError: x is -0.300 m after 4.0 s"),
    "backwards": ("e_set_speed_left(600);\n  e_set_speed_right(600);", "e_set_speed_left(-600);\n  e_set_speed_right(-600);",
                  "AssertionError: x is -0.… m after 4.0 s"),
    "turns": ("e_set_speed_right(600);", "e_set_speed_right(-600);", "AssertionError: x is -0.300 m after 4.0 s"),
    "slow": ("e_set_speed_left(600);\n  e_set_speed_right(600);", "e_set_speed_left(300);\n  e_set_speed_right(300);",
             "AssertionError: x is -0.… m after 4.0 s"),
    "no_line_end": ('"ready\\r\\n";', '"ready\\n\\n";',
                    "robot 'puck' uart1: expected 'ready\\r\\n' within 0.5 s, got 'ready\\n\\n' behind the last match; at 0.500 s the program stands in main (…/main.c:42)"),
    "wrong_text": ('"ready\\r\\n";', '"raedy\\r\\n";',
                   "robot 'puck' uart1: expected 'ready\\r\\n' within 0.5 s, got 'raedy\\r\\n' behind the last match; at 0.500 s the program stands in main (…/main.c:42)"),
    "wrong_sum": ("i = 0; i < count", "i = 1; i < count - 1", "AssertionError: assert 36 == 45"),
    "returns": ("while (1) {\n    while", "while (beats < 3) {\n    while",
                "puck: main (…/main.c:47): unexpected reset: main() returned: there is nothing to return to, so the processor resets"),
}


@pytest.fixture(scope="module")
def graded(tmp_path_factory):
    """A class of faultless and planted programs, graded once: the command's result and its folder."""
    base = tmp_path_factory.mktemp("class")
    (base / "tests").mkdir()
    (base / "tests" / "world.toml").write_text(WORLD)
    (base / "tests" / "test_all.py").write_text(TESTS)
    programs = {"faultless": FAULTLESS}
    for name, (what, other, _) in PLANTED.items():
        assert FAULTLESS.count(what) == 1, name
        programs[name] = FAULTLESS.replace(what, other)
    for name, source in programs.items():
        (base / "class" / name).mkdir(parents=True)
        (base / "class" / name / "main.c").write_text(source)
    (base / "class" / "nothing").mkdir()
    done = subprocess.run([TWINPUCK, "grade", "tests", "--submissions", "class", "--sanitize", "--csv", "g.csv", "--html",
                           "g.html", "--junitxml", "g.xml"], cwd=base, text=True, capture_output=True, timeout=1800, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done, base


def messages(base, name):
    """The first lines of a submission's failures."""
    suite = next(s for s in xml.etree.ElementTree.parse(base / "g.xml").iter("testsuite") if s.get("name") == name)
    return [f.get("message") for kind in ("failure", "error") for f in suite.iter(kind)]


def test_the_faultless_program_has_all_points(graded):
    done, base = graded
    rows = {row["submission"]: row for row in csv.DictReader(open(base / "g.csv", encoding="utf-8"))}
    assert len(rows) == len(PLANTED) + 2
    assert (rows["faultless"]["points"], rows["faultless"]["of"], rows["faultless"]["problem"]) == ("7", "7", ""), done.stdout
    assert rows["nothing"]["points"] == "0"
    assert rows["wrong_led"]["points"] == "6" and rows["slow"]["points"] == "4"
    for name in ("semicolon", "too_large"):  # who reads the table alone knows why there are no points
        reads(rows[name]["problem"], PLANTED[name][2])
    assert done.stdout.count("error: expected ';' at end of declaration") == 1, "not once a test"
    assert rows["null"]["problem"] == rows["recursion"]["problem"] == "", "a program that fails its tests was graded"
    assert re.search(r"^faultless +pass +pass +pass +pass +7$", done.stdout, re.M)


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_error_fails_a_test_whose_message_names_it(graded, name):
    _, base = graded
    reads(messages(base, name)[0], PLANTED[name][2])


def test_the_page_holds_what_was_said(graded):
    _, base = graded
    page = (base / "g.html").read_text()
    assert page.count("<tr>") == len(PLANTED) + 3 and "undeclared identifier &#x27;deu&#x27;" in page
    assert "<script" not in page


SPY = """import os, socket
from controller import Robot
seen = [p for p in ("{others}", "{tests}", "/home", "/root", "/etc/passwd", "/var/log") if os.path.exists(p)]
for name in ("{mine}/left_behind", "/usr/left_behind"):
    try:
        open(name, "w").write("x"); seen.append("wrote " + name)
    except OSError:
        pass
try:
    socket.create_connection(("127.0.0.1", {port}), 1); seen.append("network")
except OSError:
    pass
print("seen", seen, flush=True)
robot = Robot()
while robot.step(32) != -1:
    pass
"""


def test_programs_see_no_files_but_their_own_and_no_network(tmp_path, command):
    import socket

    listening = socket.create_server(("127.0.0.1", 0))
    tests, mine, other = tmp_path / "tests", tmp_path / "class" / "spy", tmp_path / "class" / "other"
    for folder in (tests, mine, other):
        folder.mkdir(parents=True)
    (tests / "world.toml").write_text(WORLD)
    (tests / "test_a.py").write_text("def test_a(world, robot):\n    world.run(0.5)\n"
                                     "    assert any(line == 'seen []' for line in robot.console), robot.console\n"
                                     "    import os\n    assert os.listdir(os.path.dirname(robot.program)) == ['spy']\n"
                                     "import pytest\n@pytest.mark.skip\ndef test_b():\n    pass\n")
    (mine / "spy.py").write_text(SPY.format(others=other, tests=tests, mine=mine, port=listening.getsockname()[1]))
    (other / "main.c").write_text("int main(void) { while (1) ; }")
    done = command("grade", tests, "--submissions", tmp_path / "class", "--junitxml", tmp_path / "g.xml")
    assert done.returncode == 0, done.stderr
    assert re.search(r"^submission +a +b +of 1\n", done.stdout), "nobody can get points for what is skipped for all"
    assert re.search(r"^spy +pass +skip +1$", done.stdout, re.M), messages(tmp_path, "spy")
    assert not (mine / "left_behind").exists()
    suites = {s.get("name"): s for s in xml.etree.ElementTree.parse(tmp_path / "g.xml").iter("testsuite")}
    assert (suites["spy"].get("tests"), suites["spy"].get("failures")) == ("2", "0"), "what is skipped has not failed"
    listening.close()


READER = """#include <uart/e_uart_char.h>
__asm__(".pushsection .const, code\\n .global _stolen\\n_stolen: .incbin \\"{}\\"\\n .popsection");
int main(void) {{ while (1) ; }}
"""


def test_what_is_compiled_sees_no_tests_and_no_other_submission(small, command):
    hidden = small / "tests" / "test_a.py"
    webots = "#include <webots/robot.h>\nint main() { wb_robot_init(); return 0; }\n"
    for name, file, text in (("bytes", "main.c", READER.format(hidden)), ("header", "main.c", f'#include "{hidden}"\n'),
                             ("other", "main.c", '#include "../good/good.h"\n'),
                             ("webots", "webots.c", f'#include "{hidden}"\n' + webots),
                             ("webots_bytes", "webots_bytes.c",
                              f'__asm__(".section .rodata\\n.global s\\ns: .incbin \\"{hidden}\\"\\n.text");\n' + webots)):
        (small / "class" / name).mkdir()
        (small / "class" / name / file).write_text(text)
    (small / "class" / "good" / "good.h").write_text("int main(void) { while (1) ; }")
    for name, to in (("link", hidden), ("link_to_other", small / "class" / "good" / "main.c"), ("link_to_none", "gone.c")):
        (small / "class" / name).mkdir()
        (small / "class" / name / "main.c").symlink_to(to)
    done = command("grade", "tests", "--submissions", "class", *TABLES, cwd=small)
    assert done.returncode == 0 and re.search(r"^good +pass", done.stdout, re.M), done.stdout + done.stderr
    said = {name: "\n".join(messages(small, name)) for name in ("bytes", "header", "other", "webots", "webots_bytes", "link", "link_to_other", "link_to_none")}
    outside = f"which lies outside {small}/class/"
    for name in ("bytes", "header", "link", "link_to_other"):
        assert outside + name in said[name], said[name]
    assert "got a link to" in said["link_to_other"] and "gone.c, where nothing is" in said["link_to_none"], said
    assert "'../good/good.h' file not found" in said["other"], said["other"]
    assert "does not compile" in said["webots"] and "does not compile" in said["webots_bytes"], said
    assert "world.run(0.1)" not in "".join(said.values()), "the hidden test's text"


def test_a_program_may_share_files_of_its_submission_and_is_no_link_out_of_it(small, command):
    for name, below in (("shares", "#include \"../common/n.h\"\n"), ("far", "#include \"../../good/n.h\"\n")):
        for folder in ("p", "common"):
            (small / "class" / name / folder).mkdir(parents=True)
        (small / "class" / name / "common" / "n.h").write_text("volatile int n = 1;\n")
        (small / "class" / name / "p" / "main.c").write_text(below + "int main(void) { while (1) ; }\n")
    (small / "class" / "leads_out").mkdir()
    (small / "class" / "leads_out" / "p").symlink_to(small / "tests")
    done = command("grade", "tests", "--submissions", "class", "--program", "p", cwd=small)
    assert re.search(r"^shares +pass +1$", done.stdout, re.M) and re.search(r"^far +FAIL +0$", done.stdout, re.M), done.stdout + done.stderr
    assert f"leads_out: got a link to {small}/tests for 'p', expected a folder of the submission" in done.stdout


def test_hidden_seeds_give_parts_of_points_and_time_is_limited(tmp_path, command):
    tests = tmp_path / "tests"
    tests.mkdir()
    (tests / "world.toml").write_text(WORLD)
    (tests / "test_a.py").write_text("import pytest, time\n@pytest.mark.points(4)\ndef test_half(world):\n"
                                     "    assert world.seed % 2\ndef test_waits(robot):\n"
                                     "    robot.world.run(0.1)\n    time.sleep(600 if robot.variable('slow') else 0)\n")
    for name, slow in (("quick", 0), ("slow", 1)):
        (tmp_path / "class" / name).mkdir(parents=True)
        (tmp_path / "class" / name / "main.c").write_text(f"volatile int slow = {slow}; int main(void) {{ while (1) ; }}")
    began = time.monotonic()
    done = command("grade", tests, "--submissions", tmp_path / "class", "--seeds", "1..4", "--limit", 20, "--csv", tmp_path / "g.csv")
    assert time.monotonic() - began < 400 and done.returncode == 0
    rows = {row["submission"]: row for row in csv.DictReader(open(tmp_path / "g.csv", encoding="utf-8"))}
    assert rows["quick"]["points"] == "3" and re.search(r"^quick +50 % +pass +3$", done.stdout, re.M)
    reads(rows["slow"]["problem"], "got no end after 20 s, expected one (--limit)")
    assert rows["slow"]["points"] == "2" and re.search(r"^slow +50 % +- +2$", done.stdout, re.M)  # earned before


def is_named_by_a_process(text):
    """Is it in some process's command line?"""
    for line in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        with contextlib.suppress(OSError):
            if text.encode() in line.read_bytes():
                return True
    return False


def wait_until_named(path):
    """Returns when a process has begun that works on it."""
    wait_until(lambda: is_named_by_a_process(str(path)), path)


def test_who_was_graded_before_ctrl_c_stands_in_the_tables(tmp_path):
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "test_a.py").write_text(
        "import time\ndef test_a(firmware):\n    time.sleep(61.25 if firmware.name == 'b_slow' else 0)\n")
    for name in ("a_quick", "b_slow", "c_late"):
        (tmp_path / "class" / name).mkdir(parents=True)
    with subprocess.Popen([TWINPUCK, "grade", "tests", "--submissions", "class", "--jobs", "1", "--csv", "g.csv"], cwd=tmp_path,
                          text=True, stdout=subprocess.PIPE) as child:
        wait_until_named(tmp_path / "class" / "b_slow")
        child.send_signal(signal.SIGINT)
        said = child.communicate(timeout=20)[0]
    assert child.returncode == 130
    rows = {row["submission"]: (row["points"], row["problem"]) for row in csv.DictReader(open(tmp_path / "g.csv", encoding="utf-8"))}
    stopped = ("0", "not graded to its end: interrupted")
    assert rows == {"a_quick": ("1", ""), "b_slow": stopped, "c_late": stopped}, said
    assert re.search(r"^a_quick +pass +1$", said, re.M) and "c_late: not graded to its end: interrupted" in said


@pytest.fixture
def small(tmp_path):
    """A folder with a test that one of two submissions passes."""
    (tmp_path / "tests").mkdir()
    (tmp_path / "tests" / "world.toml").write_text(WORLD)
    (tmp_path / "tests" / "test_a.py").write_text("def test_a(world, robot):\n    world.run(0.1)\n    assert robot.variable('n') == 1\n")
    for name, n in (("good", 1), ("bad", 0)):
        (tmp_path / "class" / name).mkdir(parents=True)
        (tmp_path / "class" / name / "main.c").write_text(f"volatile int n = {n}; int main(void) {{ while (1) ; }}")
    return tmp_path


TABLES = ["--csv", "g.csv", "--html", "g.html", "--junitxml", "g.xml"]


def test_an_output_that_is_lost_takes_no_other_with_it(small, command):
    (small / "class" / "none").mkdir()
    for name in ("good", "bad"):
        (small / "class" / name / "p").mkdir()
        (small / "class" / name / "main.c").rename(small / "class" / name / "p" / "main.c")
    done = command("grade", "tests", "--submissions", "class", *TABLES, "--keep", "kept", "--program", "p", cwd=small)
    assert done.returncode == 0 and "\nnone: got no folder 'p', expected the program there" in done.stdout, done.stderr
    assert [place.name for place in (small / "kept").iterdir()] == ["bad"] and len(list((small / "kept").rglob("run.inputs"))) == 1
    for file in TABLES[1::2]:
        assert (small / file).stat().st_size > 0
        (small / file).unlink()
    (small / "kept" / "bad").rename(small / "old")
    (small / "kept" / "bad").write_text("a file")
    with open("/dev/full", "w") as full:
        lost = subprocess.run([TWINPUCK, "grade", "tests", "--submissions", "class", *TABLES[:2], "--html", "/dev/full", *TABLES[4:],
                               "--keep", "kept", "--program", "p"], cwd=small, text=True, stdout=full, stderr=subprocess.PIPE, timeout=600, check=False)
    reads(lost.stderr, "standard output: cannot be written: No space left on device\n"
                       "/dev/full: cannot be written: No space left on device\nkept/bad: cannot be written: File exists")
    assert lost.returncode == 7 and (small / "g.csv").exists() and (small / "g.xml").exists()


def test_names_are_bytes_whatever_the_locale(small, command):
    (small / "class" / "good").rename(small / "class" / "dö rte")
    done = command("grade", "tests", "--submissions", "class", cwd=small,
                   env={"LC_ALL": "POSIX", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"})
    assert done.returncode == 0 and re.search(r"^dö rte +pass +1$", done.stdout, re.M), done.stdout + done.stderr


@pytest.mark.parametrize("words, says", [
    (["--csv", "g.csv", "--html", "./x/../g.csv"], "./x/../g.csv: --html: got the file of --csv, expected another; give them different names"),
    (["--csv", "g", "--keep", "g/"], "g: --keep: got the file of --csv, expected another; give them different names"),
    (["--csv", "tests/test_a.py"], "tests/test_a.py: --csv: got what is there already for the run to read, expected another place"),
    (["--junitxml", "link.c"], "link.c: --junitxml: got what is there already for the run to read, expected another place"),
    (["--keep", "class"], "class: --keep: got what is there already for the run to read, expected another place"),
    (["--html", "pipe"], "pipe: --html: got 'a pipe', expected a file that can be written"),
    (["--html", "x"], "x: --html: got 'Is a directory', expected a file that can be written"),
    (["--csv", "no/g.csv"], "no/g.csv: --csv: got 'No such file or directory', expected a file that can be written"),
    (["--keep", "pipe"], "pipe: --keep: got 'File exists', expected a folder, or a place where one can be made"),
    (["--program", "nope"], "…/class: --program: got no folder 'nope' in any submission, expected the program there"),
])
def test_outputs_that_cannot_be_are_refused_before_anything_runs(small, command, words, says):
    (small / "x").mkdir()
    os.mkfifo(small / "pipe")
    (small / "link.c").symlink_to(small / "class" / "good" / "main.c")
    done = command("grade", "tests", "--submissions", "class", *words, cwd=small, timeout=60)
    assert done.returncode == 2 and done.stdout == ""
    reads(done.stderr, says)
    assert not (small / "g.csv").exists() and "volatile" in (small / "link.c").read_text()


def test_a_table_beside_the_tests_is_written_again(small, command):
    for content in ("", "of the last time"):
        (small / "tests" / "g.csv").write_text(content)
        done = command("grade", "tests", "--submissions", "class", "--csv", "tests/g.csv", cwd=small)
        assert done.returncode == 0 and (small / "tests" / "g.csv").read_text().startswith("submission,"), done.stderr
    (small / "class" / "good" / "g.csv").write_text("measured")
    done = command("grade", "tests", "--submissions", "class", "--csv", "class/good/g.csv", cwd=small)
    assert done.returncode == 2 and (small / "class" / "good" / "g.csv").read_text() == "measured"


@pytest.mark.parametrize("tests, says", [
    ("import nothing_of_that_name\n", "No module named 'nothing_of_that_name'"), ("x = 1\n", "/tests: tests: got none, expected one or more"),
    ("import pytest\n@pytest.mark.seeds('x')\ndef test_a(world): pass\n", "seeds: got 'x', expected numbers")])
def test_tests_that_nobody_can_pass_are_bad_input(small, command, tests, says):
    (small / "tests" / "test_a.py").write_text(tests)
    done = command("grade", "tests", "--submissions", "class", "--csv", "g.csv", cwd=small)
    assert done.returncode == 2 and says in done.stderr and done.stdout == "" and not (small / "g.csv").exists(), done.stderr


@pytest.mark.parametrize("hook, tests, says", [
    ("def pytest_runtest_makereport(item):\n    raise ValueError('a hook')\n", "def test_b(): pass\n",
     "the tests broke (pytest's exit code 3): ValueError: a hook"),
    ("", "open('{small}/data.txt')\ndef test_b(): pass\n", "test_b.py: the test cannot be read: "),
    ("", "import os\ndef test_b(): os._exit(0)\n", "the tests broke (pytest's exit code 0)")])
def test_who_was_not_graded_is_told_by_the_exit_code(small, command, hook, tests, says):
    (small / "data.txt").write_text("which nobody sees who is contained")
    (small / "tests" / "conftest.py").write_text(hook)
    (small / "tests" / "test_b.py").write_text(tests.replace("{small}", str(small)))
    done = command("grade", "tests", "--submissions", "class", "--csv", "g.csv", cwd=small)
    assert done.returncode == 6, done.stdout + done.stderr
    rows = list(csv.DictReader(open(small / "g.csv", encoding="utf-8")))
    assert [row["problem"][:len(says)] for row in rows] == [says] * 2, rows
    assert f"\nbad: {says}" in done.stdout and f"\ngood: {says}" in done.stdout


def test_a_world_that_a_test_closes_costs_nobody_points(small, command):
    (small / "tests" / "test_a.py").write_text(
        "def test_a(make_world):\n    with make_world() as world:\n        world.run(0.1)\n"
        "        assert world.robots[0].variable('n') == 1\ndef test_b(world): pass\n")
    (small / "class" / "none").mkdir()
    (small / "class" / "none" / "main.c").write_text('#include "nothing_of_that_name.h"\n')
    done = command("grade", "tests", "--submissions", "class", cwd=small)
    assert done.returncode == 0 and re.search(r"^good +pass +pass +2$", done.stdout, re.M), done.stdout + done.stderr
    assert re.search(r"^bad +FAIL +pass +1$", done.stdout, re.M), done.stdout
    assert re.search(r"^none: .*/none/main.c:1:10: fatal error: 'nothing_of_that_name.h' file not found$", done.stdout, re.M), done.stdout


# each process takes a second to begin
SLOWLY = """import signal, subprocess, time
from twinpuck import _ending, _grade
class Slow(subprocess.Popen):
    def __init__(self, *words, **more):
        super().__init__(*words, **more)
        time.sleep(1)
subprocess.Popen = Slow
signal.signal(signal.SIGINT, signal.SIG_DFL)  # which a shell's background ignores, and the command does not
_ending.run(_grade.main)
"""


# a process that had just begun stayed behind; and between two steps the signal waited for all of them
@pytest.mark.parametrize("begin", [[TWINPUCK, "grade"], [sys.executable, "-c", SLOWLY]], ids=["usual", "slowly"])
@pytest.mark.parametrize("after_s", [0, 0.5, 1.5])
@pytest.mark.parametrize("tests, number", [("time.sleep(62.25)", signal.SIGTERM), ("def test_a(): time.sleep(62.25)", signal.SIGINT)],
                         ids=["reads", "runs"])
def test_a_signal_leaves_nothing_behind(small, tests, number, after_s, begin):
    (small / "tests" / "test_a.py").write_text(f"import time\n{tests}\n")
    before = set(os.listdir("/var/tmp"))
    child = subprocess.Popen([*begin, "tests", "--submissions", "class", "--jobs", "2"], cwd=small)
    wait_until_named(small / "tests")
    time.sleep(after_s)
    child.send_signal(number)
    assert child.wait(20) == 130
    # bubblewrap's own are ended by the system once it is gone
    wait_until(lambda: not is_named_by_a_process(str(small)), "a process that stays behind")
    assert not [name for name in set(os.listdir("/var/tmp")) - before if os.path.exists(f"/var/tmp/{name}/good")]
