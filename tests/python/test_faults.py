# SPDX-License-Identifier: MIT
"""Faults and stimuli in Python and in tests. What each kind does is tested in tests/faults."""
import pytest

COUNTS = """#include <motor_led/e_init_port.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
volatile int near;
int main(void) { e_init_port(); e_init_ad_scan(ALL_ADC); while (1) near = e_get_prox(0); }
"""
NEAR_A_WALL = {"position": [0.43, 0]}


def test_a_fault_begins_takes_effect_and_ends(opened):
    world = opened(COUNTS, more=NEAR_A_WALL)
    robot = world.robots[0]
    world.run(0.3)  # e_init_ad_scan() takes more than half of it
    assert robot.variable("near") > 100
    fault = world.inject("sensor_dead", robot, sensor=0, at_s=0.4, for_s=0.2)
    assert fault.begun_s is None and len(world.faults) == 1
    world.run(0.2)
    assert fault.begun_s == pytest.approx(0.4, abs=0.003) and robot.variable("near") < 10
    world.run(0.2)
    assert fault.ended_s == pytest.approx(0.6, abs=0.003) and robot.variable("near") > 100
    assert fault.took_effect_s is not None
    world.check_faults()


def test_a_fault_by_condition_and_one_that_is_ended_by_hand(opened):
    world = opened(COUNTS, more=NEAR_A_WALL)
    robot = world.robots[0]
    dead = world.inject("sensor_dead", sensor=0, when="$near > 100")
    assert world.run_until(lambda: dead.begun_s is not None, at_most=0.5)
    world.run(0.1)
    assert robot.variable("near") < 10
    dead.end()
    world.run(0.1)
    assert robot.variable("near") > 100 and dead.ended_s is not None
    times = [f"{word} at {time_s:.3f} s" for word, time_s in
             (("begun", dead.begun_s), ("took effect", dead.took_effect_s), ("ended", dead.ended_s))]
    assert repr(dead) == f"<Fault sensor_dead sensor=0: {', '.join(times)}>"
    assert repr(world.inject("sensor_dead", sensor=1, at_s=9)) == "<Fault sensor_dead sensor=1: not begun>"


def test_faults_are_in_recordings(opened, command, tmp_path):
    world = opened(COUNTS, more=NEAR_A_WALL)
    world.run(0.1)
    fault = world.inject("sensor_dead", sensor=0)
    world.inject("robot_moved", "puck", to=[0.0, 0.1, 90], at_s=0.2)
    world.run(0.2)
    fault.end()
    world.run(0.1)
    world.save_replay(tmp_path / "run.inputs")
    done = command("run", "--replay", tmp_path / "run.inputs", "-q")
    assert done.returncode == 0, done.stderr


PINS = """#include <p30F6014A.h>
volatile unsigned a, c, f, rises0, rises1;
void __attribute__((interrupt, auto_psv)) _INT0Interrupt(void) { IFS0bits.INT0IF = 0; rises0++; }
void __attribute__((interrupt, auto_psv)) _INT1Interrupt(void) { IFS1bits.INT1IF = 0; rises1++; }
int main(void) { TRISA = TRISC = TRISF = 0xFFFF; IEC0bits.INT0IE = 1; IEC1bits.INT1IE = 1;
  while (1) { a = PORTA; c = PORTC; f = PORTF; } }
"""


@pytest.mark.parametrize("hal", ["sim", "dspic"])
@pytest.mark.parametrize("pin, port, bit", [("F6", "f", 6), ("A6", "a", 6), ("A12", "a", 12), ("C1", "c", 1), ("C2", "c", 2)])
def test_a_pin_that_is_held_is_read_and_felt(opened, hal, pin, port, bit):
    world = opened(PINS, hal=hal)
    robot = world.robots[0]
    world.run(0.05)
    usual, rises = robot.pin(pin), (robot.variable("rises0"), robot.variable("rises1"))
    for times in range(1, 4):
        world.inject("pin_forced", robot, pin=pin, level=int(not usual), for_s=0.01)
        world.run(0.005)
        assert robot.pin(pin) != usual and bool(robot.variable(port) >> bit & 1) != usual
        world.run(0.02)
        assert robot.pin(pin) == usual and bool(robot.variable(port) >> bit & 1) == usual
        expected = (rises[0] + times * (pin == "F6"), rises[1] + times * (pin == "A12"))
        assert (robot.variable("rises0"), robot.variable("rises1")) == expected


def test_a_fault_that_has_begun_meets_what_is_sent_behind_it(opened):
    world = opened("#include <uart/e_uart_char.h>\n#include <motor_led/e_init_port.h>\nvolatile int n;\n"
                   "int main(void) { char c; e_init_port(); e_init_uart1(); while (1) if (e_getchar_uart1(&c)) n++; }")
    robot = world.robots[0]
    world.run(0.05)
    robot.uart1.send(b"abc")
    world.inject("line_cut", robot, uart=1, direction="rx", for_s=0.05)
    robot.uart1.send(b"defgh")
    world.run(0.04)
    assert robot.variable("n") == 3
    world.run(0.04)
    robot.uart1.send(b"ij")
    world.run(0.02)
    assert robot.variable("n") == 5


def test_faults_of_a_file(opened, tmp_path):
    (tmp_path / "bench.toml").write_text('[[fault]]\nkind = "sensor_dead"\nsensor = 0\n[[stimulus]]\nturn = 3\nat_s = 0.1\n')
    world = opened(COUNTS, more=NEAR_A_WALL)
    assert len(world.load_faults(tmp_path / "bench.toml")) == 2
    world.run(0.2)
    assert world.robots[0].selector == 3


def test_a_test_with_a_fault_that_took_no_effect_does_not_pass(project, command):
    folder = project(world__toml='twinpuck = 1\n[[robot]]\nname = "puck"\nfirmware = "."\nposition = [0, 0]\n',
                     main__c="int main(void) { while (1) ; }",
                     test_a__py="def test_good(world): pass\n"
                                "def test_a(world):\n    world.inject('bytes_lost', uart=1, share=1)\n    world.run(0.1)\n",
                     b__test__toml='world = "world.toml"\nat_most_s = 0.1\n[[fault]]\nkind = "wheel_stuck"\nwheel = "left"\n')
    done = command("test", cwd=folder)
    assert done.returncode == 7 and "1 passed" in done.stdout and "2 failed" in done.stdout, done.stdout
    (folder / "test_a.py").write_text("def test_b(world): assert 0\n")
    assert command("test", cwd=folder).returncode == 1


def test_a_fault_of_the_run_before_is_none_of_this_one(opened):
    import twinpuck

    world = opened("int main(void) { while (1) ; }")
    old = world.inject("wheel_stuck", wheel="left")
    world.reset()
    assert repr(old) == "<Fault 0 of the run before reset()>"
    new = world.inject("wheel_stuck", wheel="right", at_s=1)
    for ask in (old.end, lambda: old.begun_s):
        with pytest.raises(twinpuck.TwinpuckError, match=r"^fault 0: belongs to the run before reset\(\), expected one of this run$"):
            ask()
    world.run(0.1)
    assert new.ended_s is None and len(world.faults) == 1
