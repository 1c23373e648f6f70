# SPDX-License-Identifier: MIT
"""A robot in Python: what it shows, senses, says, and what goes on in its program."""
import numpy
import pytest

import twinpuck
from conftest import IDLE, reads

ECHO = """
#include <uart/e_uart_char.h>
#include <motor_led/e_init_port.h>
int main(void)
{
  char c;
  e_init_port();
  e_init_uart1();
  e_init_uart2();
  e_send_uart1_char("ready\\r\\n", 7);
  while (1) {
    if (e_getchar_uart1(&c)) e_send_uart1_char(&c, 1);
    if (e_getchar_uart2(&c)) { c ^= 1; e_send_uart2_char(&c, 1); }
  }
}
"""

VALUES = """
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
struct motor { int speed; unsigned char mode : 3; signed char trim : 4; float gain; };
enum mode { IDLE, RUN = 7 };
volatile enum mode state = RUN;
volatile unsigned int wide = 65535u;
volatile long total = -100000L;
volatile unsigned long long most = 0xFFFFFFFFFFFFFFFFULL;
volatile float ratio = 0.25f;
volatile struct motor motors[2] = {{-300, 5, -2, 1.5f}, {300, 1, 7, -0.5f}};
volatile struct motor *volatile chosen = &motors[1];
volatile char name[8] = "puck";
volatile int grid[2][3] = {{1, 2, 3}, {4, 5, 6}};
int main(void) { e_init_port(); T1CON = 0x8010; while (1) state = state; }
"""

LEDS = """
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
int main(void)
{
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  e_set_led(2, 1);
  e_set_body_led(1);
  e_set_front_led(1);
  e_set_speed_left(500);
  e_set_speed_right(-250);
  while (1) ;
}
"""


@pytest.mark.parametrize("lit, shown", [("e_set_body_led(1)", (True, False)), ("e_set_front_led(1)", (False, True)), ("", (False, False))])
def test_each_of_its_two_other_leds(opened, lit, shown):
    world = opened(LEDS.replace("e_set_front_led(1)", "").replace("e_set_body_led(1)", lit))
    world.run(0.1)
    assert (world.robots[0].body_led, world.robots[0].front_led) == shown
    assert tuple(world.leds[0, 8:]) == shown and not any(world.robots[0].leds[3:])


def test_what_it_shows(opened):
    world = opened(LEDS)
    robot = world.robots[0]
    assert robot.leds == (False,) * 8 and not robot.body_led
    world.run(1)
    assert robot.leds == (False, False, True) + (False,) * 5 and robot.body_led and robot.front_led
    left, right = robot.steps
    world.run(1)
    assert robot.steps == (left + 500, right - 250)  # steps/s
    assert robot.pin("A9") is True and robot.pin("A6") is False  # LED 2, LED 0 (e_epuck_ports.h)
    assert -180 < robot.heading_deg <= 180
    assert robot.distance_m > 0 and robot.collisions == 0 and robot.longest_wall_touch_s == 0


@pytest.mark.parametrize("heading, told", [(0, 0), (90, 90), (180, 180), (-180, 180), (270, -90), (725, 5)])
def test_headings_are_within_a_turn(opened, heading, told):
    robot = opened(IDLE, more={"heading": heading}).robots[0]
    assert robot.heading_deg == pytest.approx(told)
    assert str(robot).endswith(f" {told} deg>")


def test_what_it_senses(opened):
    world = opened(IDLE, more={"position": [0.44, 0], "selector": 5, "battery": 3.7})
    robot = world.robots[0]
    world.run(0.1)
    assert len(robot.proximity) == 8 and robot.proximity[0] > 150 > robot.proximity[4]  # the wall is 2.5 cm ahead
    assert robot.selector == 5
    robot.selector = 15
    assert robot.selector == 15
    assert robot.battery_v == pytest.approx(3.7, abs=0.05)
    assert robot.camera is None


def test_values_of_c(opened):
    world = opened(VALUES)
    robot = world.robots[0]
    world.run(0.01)
    assert robot.variable("state") == 7 and robot.variable("state == RUN") == 1
    assert robot.variable("wide") == 65535 and robot.variable("wide + 1") == 0  # 16 bits
    assert robot.variable("total") == -100000 and robot.variable("most") == 2**64 - 1
    assert robot.variable("ratio") == 0.25
    assert robot.variable("motors[1]") == {"speed": 300, "mode": 1, "trim": 7, "gain": -0.5}
    assert robot.variable("motors")[0] == {"speed": -300, "mode": 5, "trim": -2, "gain": 1.5}
    assert robot.variable("chosen->speed") == 300 and robot.variable("*chosen")["gain"] == -0.5
    assert robot.variable("chosen") == robot.variable("&motors[1]") >= 0x800
    assert robot.variable("grid") == [[1, 2, 3], [4, 5, 6]] and robot.variable("grid[1][2] * 2") == 12
    assert robot.text_variable("name") == "puck"
    assert robot.register("T1CON") == robot.variable("T1CON") == 0x8010
    assert robot.variable("T1CON.TON") == 1


def test_what_is_read_can_be_written_back(opened):
    world = opened("volatile long double exact; volatile float coarse; volatile int same;\n"
                   "int main(void) { while (1) same = exact == 0.1L; }")
    robot = world.robots[0]
    world.run(0.01)
    robot.set_variable("exact", 0.1)
    robot.set_variable("coarse", 0.1)
    world.run(0.01)
    assert robot.variable("exact") == 0.1 and robot.variable("same") == 1
    assert robot.variable("coarse") == numpy.float32(0.1)


def test_values_are_changed_as_c_does(opened):
    world = opened(VALUES)
    robot = world.robots[0]
    world.run(0.01)
    robot.set_variable("state", 70000)  # cut to 16 bits
    robot.set_variable("motors[0].trim", -8)
    robot.set_variable("motors[1]", {"speed": 12, "gain": 2.5, "mode": 9})  # three bits
    robot.set_variable("grid", numpy.arange(6).reshape(2, 3))
    robot.set_variable("name", b"bot\0")
    robot.set_variable("total", numpy.int32(-5))
    robot.set_variable("ratio", 3)
    robot.set_variable("T1CON.TON", 0)
    world.run(0.01)
    assert robot.variable("state") == 70000 - 65536
    assert robot.variable("motors[0]") == {"speed": -300, "mode": 5, "trim": -8, "gain": 1.5}
    assert robot.variable("motors[1]") == {"speed": 12, "mode": 1, "trim": 7, "gain": 2.5}
    assert robot.variable("grid") == [[0, 1, 2], [3, 4, 5]]
    assert robot.text_variable("name") == "bot" and robot.variable("total") == -5 and robot.variable("ratio") == 3.0
    assert robot.register("T1CON") == 0x0010
    with pytest.raises(ValueError):
        robot.set_variable("motors[0]", {"speed": 1, "gain": "x"})
    assert robot.variable("motors[0].speed") == -300  # all or nothing


def test_serial_lines_by_text_and_by_bytes(opened):
    world = opened(ECHO)
    robot = world.robots[0]
    assert robot.uart1.expect("rea(dy)").group(1) == "dy"
    robot.uart1.send("one two\r")
    robot.uart1.expect(r"o\w+ ")
    assert robot.uart1.expect(r"\w+").group() == "two"
    robot.uart1.send(b"\x00\xff\x80")
    assert robot.uart1.expect(rb"[\x80-\xff]+").group() == b"\xff\x80"
    robot.uart2.send("abc")
    robot.uart2.expect("`cb")
    assert robot.uart1.lines[:2] == ["ready", "one two"] and robot.uart2.data == b"`cb"
    began = world.time_s
    with pytest.raises(AssertionError):
        robot.uart1.expect("never", at_most=0.25)
    assert world.time_s - began == pytest.approx(0.25, abs=0.002)


def test_what_came_instead_is_shown_up_to_400_characters(opened):
    world = opened(ECHO)
    robot = world.robots[0]
    robot.uart1.expect("ready")
    robot.uart1.send("y" + "x" * 400)
    world.run(0.1)
    with pytest.raises(AssertionError) as wrong:
        robot.uart1.expect("never", at_most=0.01)
    assert f"got {'x' * 400!r} behind the last match" in str(wrong.value)


def test_bytes_come_at_the_lines_rate(opened):
    world = opened(ECHO)
    robot = world.robots[0]
    robot.uart1.expect("ready")
    began = world.time_s
    robot.uart1.send("x" * 1152)  # 10 bits each, at 115,200 bits a second: 0.1 s
    robot.uart1.expect("x{1152}", at_most=0.5)
    assert 0.1 <= world.time_s - began <= 0.108


TRAP = """
#include <motor_led/e_init_port.h>
volatile int zero, result;
static void divide(void)
{
  result = 100 / zero;
}
int main(void)
{
  volatile long i;
  e_init_port();
  for (i = 0; i < 1000; i++) ;
  divide();
  while (1) ;
}
"""


def test_a_trap_is_an_exception_or_a_report(opened):
    world = opened(TRAP, optimise="-O0")
    with pytest.raises(twinpuck.FirmwareFault) as fault:
        world.run(1)
    trap = fault.value.trap
    assert trap.robot == "puck" and trap.kind == "math error" and trap.vector == "MathError"
    assert trap.place.function == "divide" and trap.place.line == 6 and trap.place.file.endswith("main.c")
    assert world.time_s - trap.time_s < 1 / 64 + 1 / 512
    told = opened(TRAP, optimise="-O0", traps="report")
    told.run(0.5)
    assert told.robots[0].traps and told.time_s == 0.5
    assert told.robots[0].traps[0].place == trap.place


def test_sanitize_tells_what_goes_beyond(opened):
    source = ("#include <motor_led/e_init_port.h>\nint few[4]; volatile int n = 4;\n"
              "int main(void) { e_init_port(); few[n] = 1; while (1) ; }\n")
    opened(source).run(0.1)
    with pytest.raises(twinpuck.FirmwareFault):
        opened(source, sanitize=True).run(0.1)


def test_reset_begins_the_program_anew(opened):
    world = opened("#include <motor_led/e_init_port.h>\nvolatile int n;\n"
                   "int main(void) { e_init_port(); while (1) n++; }\n")
    robot = world.robots[0]
    world.run(0.01)
    before = robot.variable("n")
    assert before > 100
    robot.press_reset()
    world.step()
    assert robot.variable("n") < before


def test_diagnoses_are_told(opened):
    world = opened("#include <p30F6014A.h>\nint main(void) { TRISDbits.TRISD0 = 0; T1CON = 0x8000; IEC0bits.T1IE = 0;\n"
                   "  while (1) LATD = (LATD & ~15) | (LATD + 1 & 15); }\n")
    world.run(0.2)
    found = world.robots[0].diagnoses
    assert all(d.cause and d.place and d.count >= 1 and 0 <= d.time_s <= 0.2 for d in found)
    assert all(str(d).startswith(f"{d.time_s:.6f} s: {d.place}: {d.cause}") for d in found)


WORK = """
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
volatile int out, ticks;
volatile long turns;
int straight(int x) { return x + 3; }
int loops(int n) { int s = 0; while (n-- > 0) s += n * s + 1; return s; }
static void tick(void) { ticks++; }
int main(void)
{
  e_init_port();
  e_start_agendas_processing();
  e_activate_agenda(tick, 100);
  while (1) { out = straight(out) + loops(10); turns++; }
}
"""


def test_cycles_of_functions(opened):
    world = opened(WORK, measured=["puck"], optimise="-O0")
    robot = world.robots[0]
    by_code = robot.cost_of("straight")
    assert by_code.count == 0 and by_code.min == by_code.max == by_code.mean > 0
    world.run(0.1)
    by_run = robot.cost_of("straight")
    assert by_run.count > 100 and by_run.min == by_run.max == by_code.min
    assert by_run.total == by_run.count * by_run.min
    profile = robot.profile()
    assert profile.functions["loops"].min == profile.functions["loops"].max > by_code.max
    assert 0.6 < profile.load <= 1 and profile.stack_bytes > 0 and profile.stack_free > 0
    assert profile.cycles == pytest.approx(0.1 * 14745600, rel=0.15)  # less the start


def test_interrupts_and_their_latency(opened):
    world = opened(WORK, measured=["*"], hal="dspic")
    world.run(0.1)
    interrupts = world.robots[0].profile().interrupts
    timer = interrupts["T2"]  # of the agenda, each 0.1 ms
    assert 880 < timer.cycles.count < 1000  # less the start
    assert timer.period.mean == pytest.approx(1475, abs=1)  # 14,745,600 cycles a second
    assert timer.latency.min >= 4 and timer.merged == 0 and timer.missed == 0
    assert world.robots[0].interrupts_served == sum(i.cycles.count for i in interrupts.values())


def test_where_a_program_waits(opened):
    world = opened("#include <p30F6014A.h>\nvolatile int flag;\nint main(void)\n{\n  while (!flag) ;\n  while (1) ;\n}\n")
    robot = world.robots[0]
    world.run(0.01)
    assert robot.place.function == "main" and robot.place.line == 5
    reads(str(robot.place), "main (…/main.c:5)")
    reads(robot.why(), "it goes round in main() (main.c:5), … to …, and reads\n  flag = 0x0\n    no instruction writes it by its address")
    assert not robot.has_stopped
    robot.set_variable("flag", 1)
    world.run(0.01)
    assert robot.place.line == 6


def test_a_camera_picture_is_an_array():
    world = twinpuck.World("red_ball")
    robot = world.robots[0]
    assert robot.camera is None
    assert world.run_until(lambda: robot.camera is not None, at_most=3)
    picture = robot.camera
    assert picture.number >= 1 and picture.rgb.dtype == numpy.uint8 and picture.rgb.ndim == 3
    assert picture.rgb.shape[2] == 3 and picture.rgb.max() > picture.rgb.min()
    first = picture.rgb.copy()
    world.run(1)
    assert robot.camera.number > picture.number and (picture.rgb == first).all()


def test_keys_of_a_remote_control_arrive(opened):
    world = opened("#include <motor_led/e_init_port.h>\n#include <motor_led/advance_one_timer/e_agenda.h>\n"
                   "#include <motor_led/advance_one_timer/e_remote_control.h>\nvolatile int key = -1;\n"
                   "int main(void) { e_init_port(); e_init_remote_control(); e_start_agendas_processing();\n"
                   "  while (1) key = e_get_data(); }\n")  # e_get_check() is the toggle bit, 0 the first time
    robot = world.robots[0]
    world.run(0.1)
    robot.press_key(16)
    assert world.run_until(lambda: robot.variable("key") == 16, at_most=0.5)


def test_a_robot_without_a_program():
    with twinpuck.World({"robot": [{"name": "still", "position": [0, 0]}]}) as world:
        robot = world.robots[0]
        world.run(0.1)
        assert robot.load == 0 and robot.traps == [] and robot.diagnoses == [] and robot.program == "" and robot.hal == ""
        assert robot.place == twinpuck.Place("", "", 0)


def test_what_it_runs_is_told(opened, tmp_path, command):
    robot = opened(IDLE, hal="dspic").robots[0]
    assert robot.hal == "dspic" and robot.image.endswith(".elf")
    with twinpuck.World("empty", firmware=robot.image) as world:
        assert world.robots[0].hal == "dspic" and world.robots[0].program == robot.image
        world.run(0.01)


def test_numbers_and_bytes_of_numpy_are_numbers_and_bytes(opened):
    world = opened("volatile unsigned char uc; volatile float f; int main(void) { while (1) uc += (int)f & 0; }")
    robot = world.robots[0]
    robot.selector = numpy.int64(3)
    robot.press_key(numpy.int8(3), hold_s=numpy.float32(0.5))
    robot.battery_v = numpy.float32(4)
    robot.move(numpy.float32(0.25), numpy.int16(0))
    for data in (numpy.array([65, 66], dtype=numpy.uint8), memoryview(b"AB"), bytearray(b"AB")):
        robot.uart1.send(data)
    world.step(numpy.int32(2))
    world.run(numpy.float32(0.25))
    assert robot.selector == 3 and robot.x_m == 0.25 and robot.signal("uart1_received") in (0, 6)
    # as C converts them, and floats hold more than 64 bits
    for value, held in ((300, 44), (-1, 255), (1.75, 1), (numpy.uint8(7), 7)):
        robot.set_variable("uc", value)
        assert robot.variable("uc") == held
    robot.set_variable("f", 2**70)
    assert robot.variable("f") == 2**70
