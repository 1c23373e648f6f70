# SPDX-License-Identifier: MIT
"""The pytest plug-in and twinpuck test, as a user has them: a folder of one's own, the command, its text and files."""
import json
import pathlib
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree

import pytest

from conftest import TWINPUCK, reads, wait_until

WORLD = """twinpuck = 1
[arena]
size = [1, 1]
[[robot]]
name = "puck"
firmware = "."
position = [0, 0]
"""

MAIN = """#include <uart/e_uart_char.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <stdio.h>
volatile int position;
int main(void)
{
  char text[30];
  e_init_port();
  e_init_uart1();
  position = SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3;
  e_send_uart1_char(text, sprintf(text, "selector %d\\r\\n", position));
  e_set_led(0, 1);
  while (1) ;
}
"""


@pytest.fixture
def mine(project):
    """A folder with a program, its world and this text of tests."""
    def make(tests="", **more):
        return project(**{"world__toml": WORLD, "main__c": MAIN, "test_mine__py": tests, **more})

    return make


SAYS = """from controller import Supervisor
robot = Supervisor()
print("WORD", flush=True)
while robot.step(32) != -1:
    pass
"""


def names(output):
    """Tests that were run, with how they ended."""
    return dict(re.findall(r"^(\S+::.+?) (PASSED|FAILED|ERROR)", output, re.M))


def test_a_world_beside_the_test_is_a_fixture(mine, command):
    folder = mine("def test_lights(world, robot):\n    world.run(0.2)\n    assert robot.leds[0]\n"
                  "def test_is_fresh(world):\n    assert world.time_s == 0 and world.robots['puck'].steps == (0, 0)\n"
                  "def test_firmware(firmware):\n    assert (firmware / 'main.c').exists()\n")
    done = command("test", "-v", cwd=folder)
    assert done.returncode == 0, done.stdout + done.stderr
    assert names(done.stdout) == {"test_mine.py::test_lights": "PASSED", "test_mine.py::test_is_fresh": "PASSED",
                                  "test_mine.py::test_firmware": "PASSED"}
    assert command("test", folder / "test_mine.py", "-k", "lights", cwd="/").returncode == 0


def test_seeds_hals_and_selectors_are_in_the_tests_names(mine, command):
    folder = mine("def test_reads(world, robot, request):\n    robot.uart1.expect(f'selector {robot.selector}\\r')\n    for word in (f'seed={world.seed}', f'hal={robot.hal}', f'selector={robot.selector}'):\n        assert word in request.node.name\n"
                  "def test_plain():\n    pass\n")
    done = command("test", "-v", "--seeds", "1..2", "--hal", "sim,dspic", "--selector", "0,15", cwd=folder)
    expected = {f"test_mine.py::test_reads[{a}-{b}-{c}]": "PASSED" for a in ("seed=1", "seed=2")
                for b in ("hal=sim", "hal=dspic") for c in ("selector=0", "selector=15")}
    found = names(done.stdout)
    # which axis comes first in a name is pytest's to say
    same = {re.sub(r"\[.*", "", name) + str(sorted(re.findall(r"\w+=\w+", name))): how for name, how in found.items()}
    wanted = {re.sub(r"\[.*", "", name) + str(sorted(re.findall(r"\w+=\w+", name))): how for name, how in expected.items()}
    assert same == {**wanted, "test_mine.py::test_plain[]": "PASSED"}


def test_markers_say_what_a_test_runs_over(mine, command):
    folder = mine("import pytest\n@pytest.mark.seeds('3..4', 9)\n@pytest.mark.selectors(range(2))\n"
                  "def test_seeds(world):\n    assert world.seed in (3, 4, 9)\n"
                  "@pytest.mark.world('maze', firmware='blink')\n@pytest.mark.robot('puck')\n"
                  "def test_maze(world, robot):\n    assert robot.name == 'puck' and world.bodies == {}\n"
                  "def test_two(make_world):\n    a, b = make_world(), make_world('maze', firmware='.', seed=3)\n"
                  "    b.run(0.1)\n    assert a.time_s == 0 and b.robots[0].leds[0]\n")
    done = command("test", "-v", cwd=folder)
    assert done.returncode == 0, done.stdout
    assert sum("test_seeds" in name for name in names(done.stdout)) == 6
    # the command line goes before
    assert sum("test_seeds" in name for name in names(command("test", "-v", "--seeds", "3", cwd=folder).stdout)) == 2


def test_exit_codes(mine, command):
    folder = mine("def test_good(): pass\ndef test_bad(): assert 0\n")
    assert command("test", "-k", "good", cwd=folder).returncode == 0
    assert command("test", cwd=folder).returncode == 1
    assert command("test", "-k", "none", cwd=folder).returncode == 5
    help_text = command("test", "--help")
    assert help_text.returncode == 0 and "--seeds 1..50" in help_text.stdout


def test_a_failure_shows_what_it_can_and_leaves_a_run_to_look_at(mine, command):
    folder = mine("def test_dark(world, robot):\n    world.run(0.25)\n    robot.selector = 7\n    world.run(0.25)\n"
                  "    assert not robot.leds[0]\n")
    done = command("test", "--seeds", "4", "--junitxml", "out.xml", cwd=folder)
    assert done.returncode == 1
    # inside of twinpuck nobody wants to see
    assert "_world.py" not in done.stdout
    case = xml.etree.ElementTree.parse(folder / "out.xml").find(".//testcase")
    properties = {p.get("name"): p.get("value") for p in case.iter("property")}
    assert properties["twinpuck_seed"] == "4" and properties["twinpuck_time_s"] == "0.5"
    left = ".twinpuck/failures/test_mine.py_test_dark[seed=4]/"
    reads(case.find("system-out").text.partition("\n")[2],
          "at 0.500 s, seed 4\npuck: at (0.000, 0.000) m, 0 deg, selector 7, battery 4.00 V\n"
          "  its program (…, hal sim) stands in main (…/main.c:15)\n"
          "  it goes round in main() (main.c:15), … to …, and reads nothing by its address\n"
          f"  last lines of uart1:\n    selector 0\npicture: {left}picture.png\n"
          f"again:   twinpuck view --replay '{left}run.inputs'\n"
          f"[[ATTACHMENT|{folder}/{left}picture.png]]\n[[ATTACHMENT|{folder}/{left}run.inputs]]")
    with open(properties["twinpuck_picture"], "rb") as picture:
        assert picture.read(4) == b"\x89PNG"
    again = command("run", "--replay", properties["twinpuck_recording"], "--summary", "s.json", "-q", cwd=folder)
    assert again.returncode == 0, again.stderr
    assert json.loads((folder / "s.json").read_text())["simulated_s"] == 0.5


def test_a_failure_is_told_where_nothing_can_be_written(mine, command):
    folder = mine("def test_dark(world, robot):\n    world.run(0.25)\n    assert not robot.leds[0]\n")
    done = command("test", "--failures", "/proc/nowhere", cwd=folder)
    assert done.returncode == 1 and "last lines of uart1:" in done.stdout
    assert "\nno picture and no recording: " in done.stdout and "again:" not in done.stdout


def test_pytests_own_notes_that_are_lost_are_told(mine, command):
    folder = mine("def test_bad():\n    assert 0\n", conftest__py="import _pytest.cacheprovider\ndef full(*what):\n"
                  "    raise OSError(28, 'No space left on device')\n_pytest.cacheprovider.Cache.set = full\n")
    done = command("test", cwd=folder)
    assert done.returncode == 7 and "Traceback" not in done.stdout + done.stderr
    assert ".pytest_cache: cache_dir: cannot be written: No space left on device" in done.stdout


def test_plain_pytest_has_long_options_and_takes_no_short_ones_away(mine):
    folder = mine("def test_a(world, hal):\n    assert hal == 'mine' and world.seed == 3\n",
                  conftest__py="import pytest\ndef pytest_addoption(parser):\n    parser.addoption('--hal')\n"
                               "    parser.addoption('--seeds')\n@pytest.fixture\ndef hal(request):\n"
                               "    return request.config.getoption('--hal')\n")
    words = [sys.executable, "-m", "pytest", "-p", "twinpuck.pytest_plugin", "--hal", "mine", "--twinpuck-seeds", "3"]
    done = subprocess.run(words, cwd=folder, text=True, capture_output=True, timeout=600, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_firmware_of_the_command_line_goes_before(mine, command, programs):
    folder = mine("def test_dark(world, robot):\n    world.run(0.1)\n    assert not robot.leds[0]\n")
    assert command("test", cwd=folder).returncode == 1
    assert command("test", "--firmware", programs("int main(void) { while (1) ; }"), cwd=folder).returncode == 0
    assert command("test", "--firmware", "nowhere", cwd=folder).returncode == 2


def test_coverage_and_sanitize(mine, command):
    folder = mine("def test_a(world):\n    world.run(0.1)\n")
    assert command("test", "--coverage", "c.info", cwd=folder).returncode == 0
    assert f"SF:{folder / 'main.c'}" in (folder / "c.info").read_text()
    (folder / "main.c").write_text("int few[2]; volatile int n = 3;\nint main(void) { few[n] = 1; while (1) ; }\n")
    assert command("test", cwd=folder).returncode == 0
    assert command("test", "--sanitize", cwd=folder).returncode == 1


def test_two_shells_and_four_cores_share_a_cache(mine, command, tmp_path, tmp_path_factory):
    """Programs are built side by side by many processes, each once or more, and nothing is in another one's way."""
    import threading

    (tmp_path / "world.toml").write_text(WORLD)
    text = ("import pytest\n@pytest.mark.parametrize('n', range(12))\ndef test_n(make_world, tmp_path, n):\n"
            "    (tmp_path / 'main.c').write_text(f'volatile int n = {n % 5}; int main(void) {{ while (1) ; }}')\n"
            "    w = make_world({'robot': [{'name': 'p', 'position': [0, 0], 'firmware': str(tmp_path)}]})\n"
            "    w.run(0.05)\n    assert w.robots[0].variable('n') == n % 5\n")
    folder = mine(text)
    done = []
    # not below the tests: pytest looks for them in each folder, also in those that come and go while it does
    environment = {"XDG_CACHE_HOME": str(tmp_path_factory.mktemp("cache"))}
    shells = [threading.Thread(target=lambda: done.append(command("test", "-q", "-n", 4, cwd=folder, env=environment)))
              for _ in range(2)]
    for shell in shells:
        shell.start()
    for shell in shells:
        shell.join()
    assert [d.returncode for d in done] == [0, 0], done[0].stdout + done[1].stdout


def test_an_edit_is_seen(mine, command):
    folder = mine("def test_led(world, robot):\n    world.run(0.2)\n    assert robot.leds[0]\n")
    command("test", cwd=folder)
    (folder / "main.c").write_text(MAIN.replace("e_set_led(0, 1)", "e_set_led(1, 1)"))
    assert command("test", cwd=folder).returncode == 1


# --- tests without a program

def test_a_test_file(mine, command):
    folder = mine(robot__test__toml="""
world = "world.toml"
title = "says its selector"
at_most_s = 2
selectors = "0..2"
[[step]]
expect = 'selector \\d+'
[[step]]
wait = "led0"
[[step]]
wait = 0.25
[[always]]
that = "collisions == 0"
[[never]]
that = "led1"
[[finally]]
that = "led0 && $position == selector && time_s > 0.25"
""")
    done = command("test", "-v", cwd=folder)
    assert done.returncode == 0, done.stdout
    assert {f"robot.test.toml::says its selector[selector={i}]" for i in range(3)} <= set(names(done.stdout))


def test_steps_touch_the_robot(mine, command):
    folder = mine(robot__test__toml="""
world = "world.toml"
[[step]]
turn = 5
[[step]]
reset = 1
[[step]]
expect = "selector 5"
[[step]]
move = [0.2, 0.1, 90]
[[step]]
wait = "abs(x_m - 0.2) < 0.001 && abs(heading_deg - 90) < 0.1"
within_s = 0.1
[[step]]
set = "position = 3 * 4"
[[step]]
battery = 3.5
[[step]]
wait = 0.1
[[finally]]
that = "$position == 12 && battery_v < 3.6"
""")
    assert command("test", cwd=folder).returncode == 0


def test_the_page_of_test_files_is_made_of_the_table():
    import pathlib

    from twinpuck import _declarative

    page = pathlib.Path(__file__).parents[2] / "docs" / "testing.md"
    assert page.read_text() == _declarative.with_page(page.read_text()), \
        "run PYTHONPATH=build/python python3 -m twinpuck._declarative docs/testing.md"


def test_only_what_its_failure_left_is_removed_and_only_when_the_test_runs(mine, command):
    folder = mine("def test_dark(world):\n    assert 0\ndef test_dark_too(world):\n    assert 0\n", mine__txt="mine",
                  **{"kept/run.inputs": "mine", "test_a.py_notes/notes.txt": "mine"})
    left, too = folder / "test_mine.py_test_dark", folder / "test_mine.py_test_dark_too"
    assert command("test", "--failures", ".", cwd=folder).returncode == 1
    assert {file.name for file in left.iterdir()} == {"picture.png", "run.inputs", "run.inputs.images"}
    assert command("test", "--failures", ".", "--collect-only", cwd=folder).returncode == 0
    assert command("test", "--failures", ".", "-k", "nothing", cwd=folder).returncode == 5
    assert (left / "run.inputs").exists() and (too / "run.inputs").exists()
    (folder / "test_mine.py").write_text("def test_dark(world):\n    pass\ndef test_dark_too(world):\n    pass\n")
    assert command("test", "--failures", ".", "-k", "test_dark and not too", cwd=folder).returncode == 0
    assert not left.exists() and (too / "run.inputs").exists(), "another test's stays"
    # what somebody put beside ours stays
    (too / "notes.txt").write_text("mine")
    assert command("test", "--failures", ".", cwd=folder).returncode == 0
    assert [file.name for file in too.iterdir()] == ["notes.txt"]
    for file in ("mine.txt", "kept/run.inputs", "test_a.py_notes/notes.txt", "main.c", "world.toml", "test_mine.py"):
        assert (folder / file).exists(), file


# what pytest shows of the world that could not be made is no fault of its own
def test_a_world_that_was_not_opened_can_be_shown(mine, command):
    folder = mine("def test_dark(make_world):\n    make_world()\n", main__c="int main(void) { no }\n")
    told = command("test", "-l", cwd=folder).stdout
    assert "main.c:1" in told and "raised in repr" not in told and "_kept_world" not in told, told


def test_each_failure_has_a_folder_of_its_own(mine, command):
    folder = mine("import pytest\n@pytest.mark.parametrize('n', ['a/b', 'a_b', 'a b', 'a:b', 'x' * 300, 'x' * 299])\n"
                  "def test_n(world, n):\n    assert 0\n"
                  "class TestA:\n    def test_b(self, world):\n        assert 0\nclass TestA_test:\n    def test_b(self, world):\n        assert 0\n")
    done = command("test", cwd=folder)
    assert done.returncode == 1 and "nothing more can be shown" not in done.stdout, done.stdout
    left = [place for place in (folder / ".twinpuck" / "failures").iterdir() if (place / "run.inputs").exists()]
    assert len(left) == 8 and "test_mine.py_test_n[a_b]" in {place.name for place in left}


CLOSES = {
    "with": "with make_world() as world:\n        world.run(0.25)",
    "close": "world = make_world()\n    world.run(0.25)\n    world.close()",
    "twice": "world = make_world()\n    world.run(0.25)\n    world.close()\n    world.close()",
    "reset": "world = make_world()\n    world.run(9)\n    world.reset()\n    world.run(0.25)\n    world.close()",
    "anew": "world = make_world()\n    world.close()\n    world.reset()\n    world.run(0.25)",
    "several": "with make_world() as world, make_world(seed=2) as other:\n        world.run(0.25)",
    "same_place": "for _ in range(2):\n        with make_world(uart1={'*': 'pty:line'}, uart2={'*': 'file:heard'}) as world:\n"
                  "            world.run(0.25)",
    "no_program": "world = make_world(firmware=str(tmp_path / 'p'))\n    world.run(0.25)\n    (tmp_path / 'p').rename(tmp_path / 'q')\n"
                  "    with pytest.raises(twinpuck.WorldError):\n        world.reset()\n    (tmp_path / 'q').rename(tmp_path / 'p')",
}


# a world that its test closed was asked all the same, and no other test ran any more
@pytest.mark.parametrize("how", CLOSES)
def test_a_world_that_a_test_closes_is_as_any_other_to_the_plugin(mine, command, how):
    begin = ("(make_world, tmp_path):\n    (tmp_path / 'p').mkdir()\n"
             f"    (tmp_path / 'p/main.c').write_text('int main(void) {{ while (1) ; }}')\n    {CLOSES[how]}\n")
    closed = "" if how == "anew" else "    with pytest.raises(RuntimeError, match='behind close'):\n        world.time_s\n"
    late = begin.replace("world.run(0.25)", "world.inject('bump', at_s=5); world.run(0.25)")
    folder = mine(f"import pytest, twinpuck\ndef test_good{begin}{closed}def test_bad{begin}    assert 0\n"
                  f"def test_late{late}def test_last(world):\n    world.run(0.1)\n")
    done = command("test", "-v", "--seeds", "4", "--junitxml", "out.xml", cwd=folder)
    ended = {re.sub(r".*::test_(\w+).*", r"\1", name): end for name, end in names(done.stdout).items()}
    assert ended == {"good": "PASSED", "bad": "FAILED", "late": "FAILED", "last": "PASSED"}, done.stdout + done.stderr
    assert done.returncode == 1 and "bump at_s" not in done.stderr
    cases = {re.sub(r"\W.*", "", c.get("name")): c for c in xml.etree.ElementTree.parse(folder / "out.xml").iter("testcase")}
    for name in ("test_bad", "test_late"):
        properties = [(p.get("name"), p.get("value")) for p in cases[name].iter("property")]
        assert ("twinpuck_seed", "4") in properties and ("twinpuck_time_s", "0.25") in properties, properties
        assert "puck: at (0.000, 0.000) m" in cases[name].find("system-out").text
        recording = next(value for key, value in properties if key == "twinpuck_recording")
        again = command("run", "--replay", recording, "-q", "--summary", "s.json", cwd=folder)
        assert again.returncode == (7 if name == "test_late" else 0) and json.loads((folder / "s.json").read_text())["simulated_s"] == 0.25
    assert "never began" in cases["test_late"].find("failure").text


def test_a_world_that_a_test_closes_adds_its_counts_once_and_its_own_world_is_its_own(mine, command):
    closed = "        world.run(0.1)\n        world.reset()\n        world.run(0.1)\n    world.close()\n"
    folder = mine(f"import twinpuck\ndef test_once(make_world):\n    with make_world() as world:\n{closed}"
                  f"def test_mine():\n    with twinpuck.World('world.toml') as world:\n        world.inject('bump', at_s=5)\n{closed}"
                  f"def test_bad():\n    with twinpuck.World('world.toml') as world:\n{closed}    assert 0\n")
    done = command("test", "-v", "--coverage", "c.info", cwd=folder)
    assert list(names(done.stdout).values()) == ["PASSED", "PASSED", "FAILED"], done.stdout
    led = MAIN.splitlines().index("  e_set_led(0, 1);") + 1
    assert f"DA:{led},2\n" in (folder / "c.info").read_text(), "a count for each run"


def test_a_world_that_cannot_be_asked_takes_no_other_test_with_it(mine, command):
    folder = mine("import threading, time\ndef test_runs_on(make_world):\n    world = make_world()\n"
                  "    threading.Thread(target=world.run, args=(1e6,), daemon=True).start()\n    time.sleep(0.2)\n"
                  "def test_last(world):\n    world.run(0.1)\n")
    done = command("test", "-v", cwd=folder)
    assert names(done.stdout)["test_mine.py::test_last"] == "PASSED" and "while it runs in another thread" in done.stdout


def test_names_of_failures_differ():
    from twinpuck import _failures

    names = ["a.py::t[x]", "a.py::t[x y]", "a.py::t[x_y]", "a.py::T::t", "a.py::T_t", "b/a.py::t", "b_a.py::t", "a.py::t[x.py_y]",
             "a.py_t[x.py::y]", "a.test.toml::x", "a.test.toml::x~2", "a.py::t[ä]", "a.py::t[" + "ä" * 150 + "]", "a.py::t[" + "ä" * 149 + "]"]
    folders = [_failures.name_of(name, number) for name in names for number in range(3)]
    assert len(set(folders)) == len(folders) and max(len(name.encode()) for name in folders) < 256
    assert folders[0] == "a.py_t[x]"


def test_names_in_a_world_of_a_test_begin_in_the_tests_folder(mine, command, tmp_path):
    """Also where the folder that the command is called in holds other programs."""
    dark = MAIN.replace("e_set_led(0, 1);", "")
    world = '{"robot": [{"name": "puck", "firmware": FW, "position": [0, 0]}]}'
    folder = mine(main__c=dark, **{"sub/other/main.c": MAIN, "other/main.c": dark, "sub/main.c": MAIN, "sub/test_a.py": f'''
import pytest
from twinpuck._worldtext import toml_text
def lit(world):
    world.run(0.2)
    assert world.robots[0].leds[0]
@pytest.mark.parametrize("fw", [".", "other", "../sub"])
def test_dict_and_text(make_world, fw):
    lit(make_world({world.replace("FW", "fw")}))
    lit(make_world(toml_text({world.replace("FW", "fw")})))
    lit(make_world("empty", firmware=fw))
    lit(make_world("empty", firmware={{"*": fw}}))
@pytest.mark.world("mine")
def test_name(world):
    assert world.robots.names == ["mine"]
@pytest.mark.world({world.replace("FW", '"."')})
def test_marker(world):
    lit(world)
def test_supervisor(make_world):
    world = make_world({{**{world.replace("FW", '"."')}, "supervisor": [{{"name": "s", "program": "says.py"}}]}})
    world.run(0.2)
    assert world.supervisor_lines == ["s: right"]
    world = make_world({world.replace("FW", '"."')}, supervisors=["s=says.py"])
    world.run(0.2)
    assert world.supervisor_lines == ["s: right"]
''', "sub/says.py": SAYS.replace("WORD", "right"), "says.py": SAYS.replace("WORD", "wrong"),
        "sub/mine.toml": WORLD.replace("puck\"", "mine\""), "mine.toml": WORLD,
        "sub/b.test.toml": 'world = "empty"\nfirmware = "."\nat_most_s = 0.2\n[[finally]]\nthat = "led0"\n'})
    done = command("test", "-v", "sub", cwd=folder)
    assert done.returncode == 0, done.stdout
    # a script's begin where it is called
    script = f'import twinpuck\nw = twinpuck.World({world.replace("FW", repr("."))})\nw.run(0.2)\nassert not w.robots[0].leds[0]\n'
    (folder / "sub" / "script.py").write_text(script)
    subprocess.run([sys.executable, "sub/script.py"], cwd=folder, check=True, timeout=600)


#: words, exit code, what is said in one line of its own, behind "ERROR: " where nothing has run
OUTPUTS = [
    (["--junitxml", "/dev/full"], 7, "/dev/full: --junitxml: cannot be written: No space left on device"),
    (["--junitxml", "/dev/full", "-n", "2"], 7, "/dev/full: --junitxml: cannot be written: No space left on device"),
    (["--coverage", "/dev/full"], 7, "/dev/full: --coverage: cannot be written: No space left on device"),
    (["--coverage", "/dev/full", "-n", "2"], 7, "/dev/full: --coverage: cannot be written: No space left on device"),
    (["--junitxml", "main.c/x.xml"], 2, "ERROR: main.c: --junitxml: got 'File exists', expected a folder, or a place where one can be made"),
    (["--coverage", "no/c.info"], 2, "ERROR: no/c.info: --coverage: got 'No such file or directory', expected a file that can be written"),
    (["--coverage", "main.c/c.info"], 2, "ERROR: main.c/c.info: --coverage: got 'Not a directory', expected a file that can be written"),
    (["--coverage", "pipe"], 2, "ERROR: pipe: --coverage: got 'a pipe', expected a file that can be written"),
    (["--coverage", "x", "--junitxml", "./x"], 2, "…/x: --junitxml: got the file of --coverage, expected another; give them different names"),
    (["--failures", "main.c"], 2, "ERROR: main.c: --failures: got 'File exists', expected a folder, or a place where one can be made"),
    (["--firmware", "no"], 2, "ERROR: no: --firmware: got nothing, expected a folder of C files, an image or a program of the PC"),
]


@pytest.mark.parametrize("words, code, says", OUTPUTS, ids=range(len(OUTPUTS)))
def test_outputs_that_cannot_be_written(mine, command, words, code, says):
    import os

    folder = mine("def test_a(world): world.run(0.1)\ndef test_b(world): world.run(0.1)\n")
    os.mkfifo(folder / "pipe")
    done = command("test", *words, cwd=folder, timeout=120)
    said = done.stdout + done.stderr
    assert done.returncode == code and "Traceback" not in said and "INTERNALERROR" not in said, said
    assert said.count(says.removeprefix("…")) == 1 and ("2 passed" in said) == (code == 7), said


FILES = [
    ('world = "nope"\n', 2, "a.test.toml: test.world: nope: world: got a name that is neither"),
    ('world = "bad.toml"\n', 2, "bad.toml:1:1: unknown key 'x'"),
    ('world = "world.toml"\nfirmware = "nope"\n', 2, "a.test.toml: test.firmware: nope: firmware: got a name"),
    ('world = "world.toml"\n[[always]]\nthat = "lde0"\n', 2, "a.test.toml:2: always: condition 'lde0': got 'lde0'"),
    ('world = "world.toml"\n[[step]]\nset = "nosuch = 3"\n', 2, "a.test.toml:2: step.set: nosuch: got"),
    ('world = "world.toml"\n[[step]]\nexpect = "("\n', 2, "a.test.toml:2: step.expect: got '('"),
    ('world = "world.toml"\nat_most_s = 0.1\n[[always]]\nthat = "x_m > 9"\nfrom_s = 50\n', 7, "a.test.toml:3: always: never looked at"),
    ('world = "world.toml"\nat_most_s = 0.1\n[[finally]]\nthat = "x_m > 9"\n', 1, "a.test.toml:3: finally: expected"),
]


@pytest.mark.parametrize("text, code, says", FILES, ids=range(len(FILES)))
def test_what_is_wrong_with_a_test_file_is_no_failure(mine, command, text, code, says):
    done = command("test", cwd=mine(a__test__toml=text, bad__toml="x = 1\n"))
    assert done.returncode == code and says in done.stdout and "Traceback" not in done.stdout, done.stdout


MARKERS = [
    ("points(-1)", "points: got -1, expected a number from 0 to 1e6"), ("points(float('nan'))", "points: got nan, expected a number from"),
    ("points('x')", "points: got 'x', expected a number"), ("points()", "points: got none, expected a number"),
    ("seeds()", "seeds: got none, expected one or more"), ("seeds([])", "seeds: got none, expected one or more"),
    ("seeds('x')", "seeds: got 'x', expected numbers from"), ("hals()", "hals: got none, expected one or more"),
    ("world()", "world: got no source, expected a file, a name, a text or a dict"), ("robot()", "robot: got [], expected a name or a number"),
    ("wrold('maze')", "unknown marker 'wrold'; did you mean 'world'?"), ("seed(1)", "unknown marker 'seed'; did you mean 'seeds'?")]


@pytest.mark.parametrize("marker, says", MARKERS, ids=range(len(MARKERS)))
def test_markers_that_mean_nothing_are_bad_input(mine, command, marker, says):
    done = command("test", cwd=mine(f"import pytest\n@pytest.mark.{marker}\ndef test_a(world): pass\n"))
    assert done.returncode == 2 and "test_mine.py::test_a: " + says in done.stdout and "Traceback" not in done.stdout, done.stdout


def test_markers_of_somebody_else_are_theirs(mine, command):
    folder = mine("import pytest\n@pytest.mark.slow\n@pytest.mark.point\n@pytest.mark.points(2.5)\ndef test_a(world): pass\n",
                  pytest__ini="[pytest]\nmarkers =\n  point: mine\n")
    assert command("test", cwd=folder).returncode == 0


def wait_until_handled(process, number):
    """Returns when `process` catches or holds back the signal; before that the system's way to end it is all there is."""
    def is_handled():
        masks = re.findall(r"^Sig(?:Blk|Cgt):\s*(\w+)$", pathlib.Path(f"/proc/{process}/status").read_text(), re.M)
        return any(int(mask, 16) >> (number - 1) & 1 for mask in masks)

    wait_until(is_handled, f"process {process}, signal {number}")


# what came while Python was beginning was told with a traceback, and ended the process by the signal
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT"])
def test_a_signal_at_any_time_is_130_without_a_traceback(mine, name):
    folder = mine("def test_long(world):\n    world.run(1e6)\n")
    for after_s in (0, 0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 2):
        with open(folder / "said", "w+", encoding="utf-8") as said, \
                subprocess.Popen([TWINPUCK, "test", "-q"], cwd=folder, stdout=said, stderr=said) as child:
            wait_until_handled(child.pid, getattr(signal, name))
            time.sleep(after_s)
            child.send_signal(getattr(signal, name))
            code = child.wait(60)
            said.seek(0)
            text = said.read()
        assert code == 130 and "Traceback" not in text, f"{after_s} s: {code}: {text}"


# Python ended by SIGINT, and went on for ever
@pytest.mark.parametrize("where", ["module", "test"])
@pytest.mark.parametrize("place", ["exec('os.kill(os.getpid(), 2)\\nfor _ in range(9): pass')", "Swallowing(); time.sleep(120)"],
                         ids=["exec", "del"])
def test_a_signal_where_python_does_not_pass_it_on_is_130(mine, command, place, where):
    body = f"def test_a():\n    {place}\n" if where == "test" else f"{place}\ndef test_a(): pass\n"
    done = command("test", "-q", timeout=60, cwd=mine(
        "import os, signal, time\nclass Swallowing:\n    def __del__(self):\n        signal.signal(signal.SIGALRM, signal.SIG_DFL)\n"
        "        os.kill(os.getpid(), 15)\n"
        "        for _ in range(9): pass\n" + body))
    assert done.returncode == 130, done.stdout + done.stderr


@pytest.mark.parametrize("to, why", [("/dev/full", "No space left on device"), ("&-", "Bad file descriptor")], ids=["full", "closed"])
def test_what_cannot_be_said_is_lost(mine, to, why):
    folder = mine("def test_short(): pass\n")
    done = subprocess.run(f"{TWINPUCK} test >{to}", shell=True, cwd=folder, timeout=60, stderr=subprocess.PIPE, text=True)
    assert (done.returncode, done.stderr) == (7, f"standard output: cannot be written: {why}\n")


def test_who_reads_no_further_ends_the_tests(mine):
    folder = mine("import pytest\n@pytest.mark.parametrize('i', range(500))\ndef test_short(i): pass\n")
    done = subprocess.run(f"{{ {TWINPUCK} test -v; echo $? >code; }} | head -1", shell=True, cwd=folder, timeout=60,
                          capture_output=True, text=True, check=True)
    assert done.stderr == "standard output: cannot be written any more; it ended there\n"
    assert (folder / "code").read_text() == "7\n"
