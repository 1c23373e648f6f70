# SPDX-License-Identifier: MIT
"""A world in Python: opened, run, looked at as a whole, touched, kept."""
import gc
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import threading

import numpy
import pytest

import twinpuck
from conftest import IDLE

ARENA = {"arena": {"size": [1, 1]}}


def test_a_world_of_twinpucks_runs_as_the_command_does(command, tmp_path):
    world = twinpuck.World("maze", firmware="obstacle", seed=7)
    world.run(5)
    command("run", "maze", "--fw", "obstacle", "--seed", 7, "--for", 5, "-q", "--summary", tmp_path / "s.json",
            "--record", tmp_path / "r.csv")
    summary = json.loads((tmp_path / "s.json").read_text())
    assert world.digest == summary["digest"]
    assert world.robots[0].x_m == summary["robots"][0]["x_m"]
    assert world.robots[0].cycles == summary["robots"][0]["cycles"]
    assert world.seed == 7
    rows = twinpuck.read_recording(tmp_path / "r.csv")
    assert len(rows) == 501 and rows["robot"][0] == "puck"
    assert rows["time_s"][-1] == pytest.approx(5, abs=0.002)


def test_file_text_and_dict_are_one_world(tmp_path, programs):
    table = {**ARENA, "robot": [{"name": "a b", "firmware": str(programs(IDLE)), "position": [0.25, -0.125],
                                 "heading": 90}]}
    text = ('twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\nname = "a b"\nposition = [0.25, -0.125]\nheading = 90\n'
            f'firmware = "{programs(IDLE)}"\n')
    (tmp_path / "w.toml").write_text(text)
    digests = []
    for source in (table, text, tmp_path / "w.toml", str(tmp_path / "w")):
        with twinpuck.World(source) as world:
            world.run(0.5)
            assert world.robots["a b"].position_m == (0.25, -0.125)
            assert world.robots["a b"].heading_deg == pytest.approx(90)
            digests.append(world.digest)
    assert len(set(digests)) == 1


def test_zero_robots_and_a_thousand():
    with twinpuck.World(ARENA) as world:
        world.run(1)
        assert world.time_s == pytest.approx(1, abs=0.002)
        assert world.poses.shape == (0, 3)
    robots = [{"name": f"r{i}", "firmware": "blink", "position": [0.1 * (i % 40), 0.1 * (i // 40)]} for i in range(1000)]
    with twinpuck.World({"robot": robots}) as world:
        world.run(0.1)
        assert world.poses.shape == (1000, 3) and world.leds.shape == (1000, 10)
        assert world.poses[999, 0] == pytest.approx(3.9)


def test_time_goes_in_ticks(opened):
    world = opened(IDLE)
    assert world.time_s == 0 and world.tick_s == 1 / 512
    world.step()
    assert world.time_s == 1 / 512
    world.step(3)
    assert world.time_s == 4 / 512
    world.run(0.0011)  # up to a tick's end
    assert world.time_s == 5 / 512
    world.run(0)
    assert world.time_s == 5 / 512


def test_run_until_asks_before_and_after_each_tick(opened):
    world = opened(IDLE)
    times = []

    def look():
        times.append(world.time_s)
        return len(times) == 4

    assert world.run_until(look, at_most=1)
    assert times == [0, 1 / 512, 2 / 512, 3 / 512]
    assert not world.run_until(lambda: False, at_most=0.1)
    assert world.run_until("time_s >= 0.2", at_most=1)
    assert world.time_s == pytest.approx(0.2, abs=0.002)


def test_what_a_condition_raises_passes(opened):
    world = opened(IDLE)
    with pytest.raises(ZeroDivisionError):
        world.run_until(lambda: 1 / 0, at_most=1)
    with pytest.raises(ZeroDivisionError):
        world.run_until(lambda: world.time_s > 0.01 and 1 / 0, at_most=1)
    world.run(0.1)  # it goes on


def test_callables_look_each_tick_and_may_move_things(opened):
    world = opened(IDLE, more={"position": [0.3, 0]})
    seen = []

    @world.on_tick
    def shove(w):
        seen.append(w.time_s)
        if len(seen) == 10:
            w.robots[0].move(0.1, 0.2, 45)

    world.run(0.1)
    assert len(seen) == 52  # 0.1 s in ticks of 1/512 s, up to a tick's end
    assert world.robots[0].position_m == pytest.approx((0.1, 0.2))
    world.off_tick(shove)
    world.run(0.1)
    assert len(seen) == 52


def test_reset_is_a_fresh_start():
    world = twinpuck.World("maze", firmware="obstacle")
    robot = world.robots[0]
    world.run(3)
    first = world.digest, robot.x_m
    world.reset()
    assert world.time_s == 0 and robot.distance_m == 0
    world.run(3)
    assert (world.digest, robot.x_m) == first
    world.reset(seed=2)
    world.run(3)
    assert world.seed == 2 and world.digest != first[0]
    with twinpuck.World("maze", firmware="obstacle", seed=2) as other:
        other.run(3)
        assert other.digest == world.digest


def test_nothing_depends_on_who_looks_or_how_it_is_run():
    def digest(drive, **options):
        with twinpuck.World("maze", firmware="obstacle", **options) as world:
            drive(world)
            return world.digest

    def looking(world):
        for _ in range(1024):
            world.step()
            world.poses, world.proximity, world.robots[0].variable("control_due"), world.robots[0].why()

    plain = digest(lambda w: w.run(2))
    assert digest(looking) == plain
    assert digest(lambda w: w.run(2), threads=4) == plain
    assert digest(lambda w: w.run(2), measured=["*"]) == plain
    assert digest(lambda w: [w.record(0.01), w.run(2)]) == plain


def test_worlds_live_side_by_side_and_in_threads():
    worlds = [twinpuck.World("maze", firmware="obstacle", seed=s) for s in (1, 2, 1)]
    threads = [threading.Thread(target=w.run, args=(20,)) for w in worlds]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    digests = [w.digest for w in worlds]
    assert digests[0] == digests[2] != digests[1]


THREADS = """
import sys, threading, twinpuck
sys.setswitchinterval(1e-6)
world, told, begin = twinpuck.World("flock"), set(), threading.Barrier(4)
def ask():
    begin.wait()
    world.poses.sum()
    for i in range(20):
        try:
            world.run(0.01)
            world.poses.sum(), world.leds.sum()
            world.reset(i)
        except RuntimeError as wrong:
            told.add(str(wrong).split(":")[0])
threads = [threading.Thread(target=ask) for _ in range(4)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print(*told)
"""


# a thread that waited for numpy to be imported by another one kept the interpreter's lock
def test_threads_on_one_world_are_refused_and_end():
    for _ in range(5):
        done = subprocess.run([sys.executable, "-c", THREADS], timeout=60, capture_output=True, text=True, check=False)
        assert done.returncode == 0 and set(done.stdout.split()) <= {"run", "world"}, done.stdout + done.stderr


def test_the_interpreter_goes_on_while_a_world_runs():
    world = twinpuck.World("maze", firmware="obstacle")
    counted, over = [0], threading.Event()
    thread = threading.Thread(target=lambda: (world.run(120), over.set()))
    thread.start()
    refused = None
    while not over.is_set():
        counted[0] += 1
        try:
            world.robots[0].x_m
        except RuntimeError as wrong:
            refused = str(wrong)
    thread.join()
    assert counted[0] > 10
    assert refused in (None, "world: got a question while it runs in another thread, expected it when run() has returned")


def test_ctrl_c_ends_a_run_at_a_tick_and_the_world_goes_on():
    program = """
import os, signal, threading, twinpuck
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background ignores it
world = twinpuck.World("maze", firmware="obstacle")
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
try:
    world.run(1e6)
except KeyboardInterrupt:
    at = world.time_s
    world.run(1)
    print("interrupted", 0 < at < 1e6, world.time_s - at)
"""
    done = subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, timeout=600, check=True)
    assert done.stdout.split()[:2] == ["interrupted", "True"]


def test_arrays_are_views_that_each_look_brings_up_to_now():
    world = twinpuck.World("maze", firmware="obstacle")
    poses = world.poses
    before = poses.copy()
    world.run(2)
    assert (poses == before).all()  # nobody has looked
    again = world.poses
    assert numpy.shares_memory(poses, again) and not (poses == before).all()
    robot = world.robots[0]
    assert tuple(again[0, :2]) == robot.position_m and again[0, 2] == robot.heading_rad
    assert tuple(world.proximity[0]) == robot.proximity
    assert tuple(world.steps[0]) == robot.steps
    assert tuple(world.leds[0, :8] != 0) == robot.leds
    assert world.batteries_v[0] == robot.battery_v
    with pytest.raises(ValueError):
        again[0, 0] = 1
    world.close()
    assert again.shape == (1, 3)  # the numbers outlive the world
    del world, robot
    gc.collect()
    assert again[0, 0] == poses[0, 0]


def test_a_closed_world_says_so(opened):
    world = opened(IDLE)
    world.close()
    world.close()
    assert repr(world) == "<World, closed>"


def test_a_recording_has_rows_at_multiples_of_its_time():
    world = twinpuck.World("maze", firmware="obstacle")
    recording = world.record(0.1)
    world.run(1)
    array = recording.array
    assert len(array) == 11
    assert array["time_s"] == pytest.approx(numpy.arange(11) / 10, abs=0.002)
    robot = world.robots[0]
    assert array["left_steps"][-1] == robot.steps[0] and array["ir3"][-1] == robot.proximity[3]
    assert array["x_m"][-1] == robot.x_m and array["battery_v"][-1] == robot.battery_v
    assert (recording.of("puck") == array).all()


def test_pictures_are_png_or_svg(opened, tmp_path):
    world = opened(IDLE)
    png = world.picture(tmp_path / "a.png", width_px=300)
    assert png[:8] == b"\x89PNG\r\n\x1a\n" and (tmp_path / "a.png").read_bytes() == png
    assert world.picture()[:4] == b"\x89PNG" and world._repr_png_()[:4] == b"\x89PNG"
    assert b"<svg" in world.picture(tmp_path / "a.svg", rays=True)


def test_every_touch_is_in_the_recording_that_run_repeats(command, tmp_path, programs):
    echo = programs("#include <uart/e_uart_char.h>\n#include <motor_led/e_init_port.h>\nchar got[40]; int n; long sum;\n"
                    "int main(void) { char c; e_init_port(); e_init_uart1();\n"
                    "  while (1) if (e_getchar_uart1(&c)) { got[n++ % 40] = c; e_send_uart1_char(&c, 1); } }\n")
    (tmp_path / "w.toml").write_text('twinpuck = 1\n[arena]\nsize = [1, 1]\n[[box]]\nname = "crate"\nmovable = true\n'
                                     'mass = 0.1\nsize = [0.05, 0.05, 0.05]\nposition = [0.3, 0.3]\n[[lamp]]\n'
                                     'position = [0, 0, 1]\n[[robot]]\nname = "puck"\nposition = [0, 0]\n')
    with twinpuck.World(tmp_path / "w.toml", firmware=echo, seed=5) as world:
        robot = world.robots["puck"]
        world.run(0.1)
        robot.uart1.send(bytes(range(1, 256)))
        world.run(0.2)
        robot.selector = 9
        robot.battery_v = 3.5
        robot.set_variable("sum", -123456)
        world.bodies["crate"].move(-0.3, 0.3, 30)
        world.lamps["lamp 0"].switch(False)
        robot.press_key(3)
        robot.define_sensor("beacon", 2.5)
        world.run(0.1)
        robot.move(0.2, 0.2, 180)
        world.run(0.1)
        assert robot.uart1.data == bytes(range(1, 256))
        assert robot.selector == 9 and robot.variable("sum") == -123456
        assert world.bodies["crate"].pose == pytest.approx((-0.3, 0.3, 30))
        world.save_replay(tmp_path / "run.inputs")
        digest = world.digest
    done = command("run", "--replay", tmp_path / "run.inputs", "--summary", tmp_path / "s.json", "-q", cwd="/")
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "s.json").read_text())["digest"] == digest
    # another course is told: exit code 7
    other = (tmp_path / "run.inputs").read_text().replace('"position":9', '"position":8')
    (tmp_path / "other.inputs").write_text(other)
    assert command("run", "--replay", tmp_path / "other.inputs", "-q").returncode == 7


OUT_OF_BOUNDS = ("#include <p30F6014A.h>\nvolatile int a[4], n;\n"
                 "int main(void) { TRISA = 0; while (1) { a[n & 7] = n; n++; LATAbits.LATA6 ^= 1; } }")


@pytest.mark.parametrize("options", [{"sanitize": True}, {"coverage": "lines.info"}, {"optimise": "-O2"}, {"hal": "dspic"}])
def test_a_recording_repeats_the_very_run_whatever_becomes_of_the_sources(command, tmp_path, programs, monkeypatch, options):
    monkeypatch.chdir(tmp_path)
    folder = programs(OUT_OF_BOUNDS)
    (tmp_path / "w.toml").write_text('twinpuck = 1\n[arena]\nsize = [1, 1]\n[[robot]]\nname = "puck"\nposition = [0, 0]\n')
    with twinpuck.World("w.toml", firmware=folder, traps="report", **options) as world:
        world.run(0.1)
        world.save_replay("run.inputs")
        traps = [trap.kind for trap in world.robots[0].traps]
    for source in folder.glob("*.c"):
        source.write_text(OUT_OF_BOUNDS.replace("n++", "n += 3"))
    done = command("run", "--replay", "run.inputs", "-q", "--summary", "s.json", cwd=tmp_path)
    assert done.returncode == (3 if traps else 0), done.stderr
    assert json.loads((tmp_path / "s.json").read_text())["robots"][0]["traps"] != [] or not traps
    assert bool(traps) == ("sanitize" in options)


def test_a_fault_is_the_first_one(opened):
    world = opened(OUT_OF_BOUNDS, sanitize=True)
    with pytest.raises(twinpuck.FirmwareFault) as fault:
        world.run(0.5)
    times = [trap.time_s for trap in world.robots[0].traps]
    assert len(times) > 1 and f"{fault.value}" == f"{world.robots[0].traps[times.index(min(times))]}"


def test_a_world_that_cannot_be_reset_is_reset_later(tmp_path, programs):
    folder = programs(IDLE)
    source = next(folder.glob("*.c"))
    world = twinpuck.World({"arena": {"size": [1, 1]}, "robot": [{"name": "puck", "firmware": str(folder), "position": [0, 0]}]})
    world.run(0.1)
    source.write_text("int main(void) { nonsense }")
    for _ in range(2):
        with pytest.raises(twinpuck.WorldError, match="nonsense"):
            world.reset()
    source.write_text(IDLE)
    world.reset()
    world.run(0.1)
    assert world.time_s == pytest.approx(0.1, abs=0.01)
    world.close()


@pytest.mark.parametrize("ticks", [-1, 10**30])
def test_steps_have_bounds(opened, ticks):
    with pytest.raises(ValueError, match="step: ticks: got"):
        opened(IDLE).step(ticks)


@pytest.mark.parametrize("touch", [
    lambda w: w.robots[0].uart1.send("\u0100"), lambda w: setattr(w.robots[0], "selector", 16),
    lambda w: setattr(w.robots[0], "battery_v", 12), lambda w: w.robots[0].move(float("nan"), 0),
    lambda w: w.robots[0].press_key(64), lambda w: w.robots[0].move(1e9, 0)])
def test_what_cannot_be_done_to_a_world_is_an_error_and_nothing_changes(opened, touch):
    world, other = opened(IDLE), opened(IDLE)
    with pytest.raises(ValueError):
        touch(world)
    world.run(0.1), other.run(0.1)
    assert world.digest == other.digest


def test_supervisors_end_runs_and_programs_of_the_pc_run(tmp_path):
    (tmp_path / "judge.py").write_text("from controller import Supervisor\ns = Supervisor()\nprint('hello', flush=True)\n"
                                       "s.step(200)\ns.simulationQuit(0)\ns.step(32)\n")
    with twinpuck.World("empty", firmware="blink", supervisors=[str(tmp_path / "judge.py")]) as world:
        world.run(5)
        assert world.ended is not None and world.time_s < 1
        assert any("hello" in line for line in world.supervisor_lines)


def test_robots_have_names_and_numbers():
    world = twinpuck.World("maze", firmware="blink")
    assert world.robots.names == ["puck"] and "puck" in world.robots and len(world.robots) == 1
    assert world.robots[0] is world.robots["puck"] is list(world.robots)[0] is world.robots[-1]


def test_signals_by_name(opened):
    world = opened("volatile int state = 7; int main(void) { while (1) state = 7; }", more={"position": [0.2, 0.1]})
    world.run(0.1)
    assert world.signal("puck.x_m") == world.robots[0].signal("x_m") == pytest.approx(0.2)
    assert world.signal("time_s") == world.time_s
    assert world.robots[0].signal("$state") == 7
    condition = world.condition("x_m > 0.1 && $state == 7")
    assert condition() and condition.value == 1
    world.robots[0].move(0, 0)
    world.step()
    assert not condition()
    world.reset()
    assert condition.value in (0, 1)  # it is of the new run


def test_help_reads_like_a_manual():
    for name in twinpuck.__all__:
        thing = getattr(twinpuck, name)
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert (value.fget if isinstance(value, property) else value).__doc__, f"{name}.{member}"


def test_a_program_that_an_interpreter_leaves_open_does_not_hold_it():
    program = "import twinpuck; w = twinpuck.World('maze', firmware='blink'); w.run(1); print(w.time_s)"
    done = subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, timeout=600, check=True)
    assert done.stdout.strip() == "1.0" and done.stderr == ""
    assert os.getpid() and signal.getsignal(signal.SIGINT)


def test_a_robot_that_is_named_has_its_own_program_wherever_the_others_stand(programs):
    mine, others = programs("int who = 1; int main(void) { while (1) ; }"), programs("int who = 2; int main(void) { while (1) ; }")
    table = {**ARENA, "robot": [{"name": "a", "position": [0, 0]}, {"name": "b", "position": [0.2, 0]}]}
    for firmware in ({"a": mine, "*": others}, {"*": others, "a": mine}):
        with twinpuck.World(table, firmware=firmware) as world:
            world.run(0.1)
            assert [robot.variable("who") for robot in world.robots] == [1, 2]


def test_a_copy_of_the_module_elsewhere_belongs_to_the_command_on_path(tmp_path):
    shutil.copytree(pathlib.Path(twinpuck.__file__).parent, tmp_path / "library" / "twinpuck")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "twinpuck").write_text("a file that is no program\n")
    program = "import twinpuck; w = twinpuck.World('maze', firmware='blink'); w.run(1); print(w.time_s)"
    beside = pathlib.Path(os.environ["TWINPUCK"]).parent

    def said(path):
        return subprocess.run([sys.executable, "-c", program], text=True, capture_output=True, timeout=600, check=False,
                              env={**os.environ, "PATH": path, "PYTHONPATH": str(tmp_path / "library")}, cwd=tmp_path)

    found = said(f":{tmp_path / 'nosuch'}::{tmp_path / 'other'}:{beside}:{tmp_path}")
    assert (found.stdout, found.stderr) == ("1.0\n", "")
    alone = said(f"{tmp_path / 'other'}:")
    assert alone.returncode == 1
    assert alone.stderr.splitlines()[-1].startswith("twinpuck.WorldError: maze: world: got a name that is neither a file")


def test_a_world_that_nobody_uses_ends_and_a_robot_keeps_it():
    import weakref

    world = twinpuck.World("maze", firmware="blink")
    robot = world.robots[0]
    assert robot is world.robots["puck"] and robot in world.robots and "puck" in world.robots
    gone = weakref.ref(world)
    world.run(0.1)
    del world
    robot.world.run(0.1)
    assert robot.leds[0] and gone() is not None
    del robot
    assert gone() is None, "without the collector"
    assert twinpuck.World("maze").robots[0].x_m == pytest.approx(twinpuck.World("maze").robots[0].x_m)


def test_what_expect_has_found_stays_found_whoever_keeps_the_line():
    with twinpuck.World("empty", firmware="serial_echo") as world:
        world.robots[0].uart1.expect("ready")
        with pytest.raises(twinpuck.ExpectTimeout):
            world.robots[0].uart1.expect("ready", at_most=0.1)


@pytest.mark.parametrize("touch", ["robot.selecter = 3", "world.robots = []", "world.sede = 1", "robot.uart1.baud = 9600", "robot.x_m = 1",
                                   "world.bodies['box'].posee = 1", "world.lamps['l'].intensity = float('nan')", "fault.at_s = 3"])
def test_attributes_that_are_none_cannot_be_set(touch):
    with twinpuck.World({"lamp": [{"name": "l", "position": [0, 0, 1]}], "ball": [{"name": "box", "radius": 0.02, "position": [0.3, 0.3], "movable": True, "mass": 0.01}],
                         "robot": [{"name": "puck", "position": [0, 0]}]}) as world:
        fault = world.inject("wheel_stuck", wheel="left")
        with pytest.raises(AttributeError):
            exec(touch, {"world": world, "robot": world.robots[0], "fault": fault})
