// SPDX-License-Identifier: MIT
#include "tools/timing_programs.h"

#include <fmt/format.h>

#include "hal_sim/api/timings.h"

namespace tools::timing {
namespace {

/// Gaps of a handler that runs in the native way, too.
constexpr Gaps natively(int count) { return {count, kLeastGap, 1, 0, true}; }

#define ROW(name) #name, T_##name
std::vector<Row> usual_rows() {
  return {
      {"", 0, "", "sink = 1;", {}, "no call", 0},
      // the program's start: nothing runs, the list is empty
      {"", 0, "", "e_init_port();", {}, "e_init_port()"},
      {ROW(INIT_UART), "", "e_init_uart1();", {}, "e_init_uart1(), e_init_uart2()"},
      {"", 0, "", "sink = e_ischar_uart1();", {}, "e_ischar_uart1()", 4},
      {ROW(GETSELECTOR), "", "sink = getselector();", {}, "getselector()"},
      {ROW(WAIT), "", "wait(0);", {}, "wait()"},
      {ROW(WAIT_ROUND), "", "wait(1000);", {{"WAIT"}}, "each of its rounds", 0, {}, 1000},
      {ROW(PAUSE), "", "hal_pause(0);", {}, "pause inside the library"},
      {ROW(PAUSE_ROUND), "", "hal_pause(1000);", {{"PAUSE"}}, "each of its rounds", 0, {}, 1000},
      {ROW(RING_OFF), "", "hal_set_ring(3, 0);", {}, "a ring LED, off"},
      {ROW(RING_ON), "", "hal_set_ring(3, 1);", {}, "on"},
      {ROW(RING_TOGGLE), "", "hal_set_ring(3, 2);", {}, "toggled"},
      {ROW(RINGS_OFF), "", "hal_set_rings(0);", {}, "all eight, off"},
      {ROW(RINGS_ON), "", "hal_set_rings(1);", {}, "on"},
      {ROW(RINGS_TOGGLE), "", "hal_set_rings(2);", {}, "toggled"},
      {"", 0, "", "e_set_led(8, 1);", {}, "e_set_led(8, 1)", 4},
      {ROW(LED_OFF), "", "e_set_front_led(0);", {}, "front or body LED, off"},
      {ROW(LED_ON), "", "e_set_front_led(1);", {}, "on"},
      {ROW(LED_TOGGLE), "", "e_set_front_led(2);", {}, "toggled"},
      {"", 0, "", "e_set_body_led(1);", {}, "e_set_body_led()"},
      {ROW(AGENDA_ACTIVATE), "", "e_activate_agenda(first, 0);", {}, "e_activate_agenda(), empty list", 8},
      {ROW(AGENDA_FOUND), "", "e_pause_agenda(first);", {}, "pause, restart, reset: the newest of the list"},
      {ROW(AGENDA_CYCLE), "", "e_set_agenda_cycle(first, 0);", {}, "e_set_agenda_cycle(), the newest"},
      {ROW(AGENDA_KNOWN), "", "e_activate_agenda(first, 0);", {}, "e_activate_agenda(), the newest again"},
      {ROW(AGENDA_ACTIVATE_PASSED),
       "",
       "e_activate_agenda(second, 0);",
       {{"AGENDA_ACTIVATE"}},
       "each agenda that it finds",
       8},
      {ROW(AGENDA_PASSED),
       "",
       "e_pause_agenda(first);",
       {{"AGENDA_FOUND"}},
       "each newer agenda that a search passes"},
      {ROW(AGENDA_DESTROY),
       "e_destroy_agenda(first); e_destroy_agenda(second);",
       "e_destroy_agenda(third);",
       {},
       "e_destroy_agenda(), empty list"},
      {ROW(AGENDA_DESTROY_PASSED),
       "e_activate_agenda(first, 0);",
       "e_destroy_agenda(third);",
       {{"AGENDA_DESTROY"}},
       "each newer agenda that it passes",
       8},
      {ROW(AGENDA_FREE), "", "e_destroy_agenda(first);", {{"AGENDA_DESTROY"}}, "an agenda that it finds", 8},
      {ROW(AGENDAS_START), "", "e_start_agendas_processing();", {}, "e_start_agendas_processing()"},
      {ROW(TICK), "", "", {}, "Timer 2's handler, entry and RETFIE included: empty list", 1, {8}},
      {ROW(TICK_FIRST), "e_activate_agenda(first, 0);", "", {{"TICK"}}, "an agenda", 1, {8}},
      {ROW(TICK_NODE),
       "e_activate_agenda(second, 0);",
       "",
       {{"TICK"}, {"TICK_FIRST"}},
       "each further one",
       1,
       {8}},
      {ROW(TICK_COUNT),
       "e_set_agenda_cycle(first, 30000);",
       "",
       {{"TICK"}, {"TICK_FIRST"}, {"TICK_NODE"}},
       "each that counts",
       1,
       {8}},
      {ROW(AGENDAS_STOP),
       "e_destroy_agenda(first); e_destroy_agenda(second);",
       "e_end_agendas_processing();",
       {},
       "e_end_agendas_processing()"},
      {"", 0, "", "e_init_motors();", {}, "e_init_motors(), malloc() and all", 16},
      {ROW(INIT_MOTORS),
       "",
       "e_init_motors();",
       {{"AGENDA_KNOWN", 2}, {"AGENDA_PASSED"}},
       "e_init_motors()",
       4},
      {ROW(SPEED), "", "e_set_speed_right(0);", {}, "e_set_speed_left(), _right(): 0, the newest agenda", 4},
      {ROW(SPEED_DIVISION), "", "e_set_speed_right(500);", {{"SPEED"}}, "another speed"},
      {"", 0, "", "e_set_speed_left(500);", {}, "e_set_speed_left(500)", 4},
      {"", 0, "", "e_set_speed(300, 50);", {}, "e_set_speed()", 8},
      {ROW(GET_STEPS), "", "sink = e_get_steps_left();", {}, "e_get_steps_left(), _right()"},
      {ROW(SET_STEPS), "", "e_set_steps_left(7);", {}, "e_set_steps_left(), _right()"},
      {ROW(SCAN_INIT), "", "e_init_ad_scan(MICRO_ONLY);", {{"GETSELECTOR"}}, "e_init_ad_scan(), no wait", 8},
      {ROW(SCAN_OFF), "e_init_ad_scan(ALL_ADC);", "e_ad_scan_off();", {}, "e_ad_scan_off()"},
      {ROW(SCAN_ON), "", "e_ad_scan_on();", {}, "e_ad_scan_on()"},
      {"", 0, "e_ad_scan_off();", "sink = e_get_prox(3);", {}, "e_get_prox()", 4},
      {"", 0, "", "sink = e_get_calibrated_prox(3);", {}, "e_get_calibrated_prox()", 4},
      {"", 0, "", "sink = e_get_ambient_light(3);", {}, "e_get_ambient_light()", 4},
      {"", 0, "", "sink = e_get_acc(0);", {}, "e_get_acc()", 4},
      {"", 0, "", "sink = e_get_micro(0);", {}, "e_get_micro()", 4},
      // a thousand pauses, each a cycle off at most
      {"", 0, "", "e_calibrate_ir();", {}, "e_calibrate_ir()", 1008},
      // beside the time on the wires
      {ROW(I2C_ENABLE), "", "e_i2c_enable();", {}, "e_i2c_enable(), e_i2c_disable()"},
      {ROW(I2C_START),
       "",
       "e_i2c_start();",
       {},
       "e_i2c_start(), beside the time on the wires, as the following"},
      {ROW(I2C_WRITE), "", "e_i2c_write(0);", {}, "e_i2c_write()"},
      {ROW(I2C_RESTART), "", "e_i2c_restart();", {}, "e_i2c_restart()"},
      {ROW(I2C_READ), "e_i2c_write(1);", "e_i2c_read(&byte);", {}, "e_i2c_read()"},
      {ROW(I2C_ACKNOWLEDGE), "", "e_i2c_nack();", {}, "e_i2c_ack(), e_i2c_nack()"},
      {ROW(I2C_STOP), "", "e_i2c_stop();", {}, "e_i2c_stop()"},
      // handlers, entry and RETFIE included; the list has the motors only
      {ROW(SCAN_ROUND), "e_ad_scan_on();", "", {}, "converter: 65 frames, one round", 10, {65}, 65},
      {ROW(SCAN_ACC), "", "", {}, "of these, the frame with the accelerometer", 2, {4, 150}},
      {ROW(SCAN_MICRO), "e_init_ad_scan(MICRO_ONLY);", "", {}, "converter: a frame of MICRO_ONLY", 2, {8}},
      {ROW(MOTOR_HALF),
       "e_ad_scan_off(); e_start_agendas_processing(); e_set_speed(0, 0); e_set_speed_left(500);",
       "",
       {{"TICK"}, {"TICK_FIRST"}, {"TICK_NODE"}, {"TICK_COUNT"}},
       "motor below 601: coils on",
       4,
       {8, 120, 2, 0}},
      {ROW(MOTOR_OFF),
       "",
       "",
       {{"TICK"}, {"TICK_FIRST"}, {"TICK_NODE"}, {"TICK_COUNT"}},
       "coils off",
       4,
       {8, 120, 2, 1}},
      {ROW(MOTOR_STEP),
       "e_set_speed_left(800);",
       "",
       {{"TICK"}, {"TICK_FIRST"}, {"TICK_NODE"}, {"TICK_COUNT"}},
       "motor above 600: coils on",
       4,
       {8, 120, 1, 0}},
      // handlers that run in the native way, too
      {ROW(UART_END),
       "e_set_speed(0, 0); e_end_agendas_processing(); e_send_uart1_char(text, 5);",
       "",
       {},
       "UART's transmit handler: nothing left",
       2,
       natively(1)},
      {ROW(UART_BURST), "e_send_uart1_char(text, 41);", "", {}, "four bytes", 3, natively(8)},
      {ROW(CAMERA_LAUNCH),
       "while (e_uart1_sending()); e_poxxxx_init_cam(); "
       "e_poxxxx_config_cam(240, 160, 160, 160, 4, 4, RGB_565_MODE); e_poxxxx_write_cam_registers();",
       "e_poxxxx_launch_capture(text);",
       {},
       "e_poxxxx_launch_capture()",
       4},
      {ROW(CAMERA_FRAME), "", "", {}, "fast camera: a frame begins", 2, natively(1)},
      {ROW(CAMERA_LINE), "", "", {}, "a line, beside 8 cycles a byte", 2, natively(8)},
      {ROW(DCI_INIT),
       "while (!e_poxxxx_is_img_ready()); AUDIO_ON = 1;",
       "e_init_dci_master();",
       {},
       "e_init_dci_master()"},
      {ROW(CODEC_INIT), "", "e_init_codec_slave();", {}, "e_init_codec_slave()", 100},
      {ROW(DCI_IDLE), "", "", {}, "codec: four samples of silence", 2, {8}},
      {ROW(SOUND_KICKOFF),
       "e_dci_unavailable = -1; e_stop_flag = 0;",
       "e_sub_dci_kickoff(0, 2000);",
       {},
       "e_sub_dci_kickoff()",
       4},
      {ROW(DCI_BUSY), "", "", {}, "codec: four samples", 2, natively(8)},
      // longer than the timer counts, in both ways
      {"", 0, "while (e_dci_unavailable);", "e_init_sound();", {}, "e_init_sound()", 100},
  };
}

std::vector<Row> basic_rows() {
  return {
      {ROW(INIT_AD), "e_init_port();", "e_init_ad();", {}, "e_init_ad()"},
      {"", 0, "", "sink = e_read_ad(4);", {}, "e_read_ad()", 4},
      {ROW(BASIC_STEP), "e_set_speed_left(500);", "", {}, "basic motors: a step of one wheel", 2, {8}},
      {ROW(BASIC_PROX),
       "e_set_speed_left(0); e_init_prox();",
       "",
       {},
       "basic proximity sensors: a pair",
       4,
       {8}},
  };
}

std::vector<Row> fast_agenda_rows() {
  return {
      {ROW(FAST_TIMER),
       "e_configure_timer(0); e_activate_agenda(first, 10); e_start_timer_processing(0);",
       "",
       {},
       "fast agenda: a timer's handler, beside its tasks",
       2,
       natively(8)},
  };
}

// a line's bytes: two that are taken, two that are skipped, and so on
std::vector<Row> slow_camera_rows() {
  return {
      {ROW(SLOW_LAUNCH),
       "e_init_port(); e_po3030k_init_cam(); e_po3030k_config_cam(240, 160, 160, 160, 8, 8, RGB_565_MODE); "
       "e_po3030k_write_cam_registers();",
       "e_po3030k_launch_capture(image);",
       {},
       "e_po3030k_launch_capture(), slow camera",
       4},
      {ROW(SLOW_FRAME), "", "", {}, "a frame begins", 2, {1}},
      {ROW(SLOW_LINE), "", "", {}, "a line begins", 2, {1}},
      {ROW(SLOW_BYTE), "", "", {}, "a byte that is taken", 2, {8, kLeastGap, 4}},
      {ROW(SLOW_SKIPPED), "", "", {}, "one that is skipped", 2, {8, kLeastGap, 4, 1}},
  };
}
#undef ROW

const char* const kHarness = R"(
#include <motor_led/e_epuck_ports.h>
#ifndef WITH_TIMER
#define WITH_TIMER 3
#endif
#define STOPWATCH(a, b) NAMED(a, WITH_TIMER, b)
#define NAMED(a, n, b) PASTED(a, n, b)
#define PASTED(a, n, b) a##n##b
#define CALM 40
#define APART static void __attribute__((noinline))
volatile int sink, done;
unsigned int took[100];
APART measure(int row, void (*call)(void)) {
  STOPWATCH(TMR, ) = 0; STOPWATCH(T, CONbits).TON = 1; call(); STOPWATCH(T, CONbits).TON = 0; took[row] = STOPWATCH(TMR, );
}
APART watch(int row, int count, unsigned int above, int every, int skip) {
  unsigned int now, last, gap, calm = 0, sum = 0;
  int seen = 0, left = count;
  STOPWATCH(T, CONbits).TON = 1;
  last = STOPWATCH(TMR, );
  while (left > 0) {
    now = STOPWATCH(TMR, );
    gap = now - last;
    last = now;
    if (gap > above) {
      if (seen >= skip && (seen - skip) % every == 0) { sum += gap; left--; }
      seen++;
      last = STOPWATCH(TMR, );
    } else if (gap < CALM) {
      calm = gap; /* a round without a handler */
    }
  }
  STOPWATCH(T, CONbits).TON = 0;
  took[row] = sum - count * calm;
}
)";

const char* const kUsualHead = R"(
#include <I2C/e_I2C_master_module.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <camera/fast_2_timer/e_poxxxx.h>
#include <codec/e_sound.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
#include <utility/utility.h>
void hal_pause(unsigned int rounds);
void hal_set_ring(unsigned int led, unsigned int value);
void hal_set_rings(unsigned int value);
extern volatile int e_dci_unavailable, e_stop_flag;
char byte, text[3200];
static void first(void) {}
static void second(void) {}
static void third(void) {}
)";

const char* const kBasicHead = R"(
#include <a_d/e_ad_conv.h>
#include <a_d/e_prox.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_motors.h>
)";

const char* const kFastAgendaHead = R"(
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
#define WITH_TIMER 4 /* the agenda has the first three */
static void first(void) {}
)";

const char* const kSlowCameraHead = R"(
#include <camera/slow_3_timer/e_po3030k.h>
#include <motor_led/e_init_port.h>
char image[3200];
)";

}  // namespace

const std::vector<Program>& programs() {
  static const std::vector<Program> all = {{"usual", kUsualHead, usual_rows()},
                                           {"basic", kBasicHead, basic_rows()},
                                           {"fast-agenda", kFastAgendaHead, fast_agenda_rows()},
                                           {"slow-camera", kSlowCameraHead, slow_camera_rows(), "po3030k"}};
  return all;
}

std::string source(const Program& program, bool with_shares) {
  std::string text = std::string(program.head) + kHarness;
  std::string main = "int main(void) {\n  STOPWATCH(T, CON) = 0; STOPWATCH(PR, ) = 0xFFFF;\n";
  int n = 0;
  for (const Row& row : program.rows) {
    text += fmt::format("APART f{}(void) {{ {} }}\n", n, row.call);
    const Gaps& g = row.gaps;
    main += fmt::format("  {}\n", row.before);
    if (g.count == 0)
      main += fmt::format("  measure({}, f{});\n", n, n);
    else if (with_shares || g.runs_natively)
      main += fmt::format("  watch({}, {}, {}, {}, {});\n", n, g.count, g.above, g.every, g.skip);
    ++n;
  }
  return text + main + "  done = 1;\n  for (;;);\n}\n";
}

}  // namespace tools::timing
