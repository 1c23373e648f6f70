// SPDX-License-Identifier: MIT
// The drivers at work: the same firmware, world and expectations with both HALs. Expectations are worked out
// from the library's numbers, not taken from either.
#include <fmt/format.h>

#include <cmath>

#include "tests/support/firmware_test.h"

namespace {

using firmware_test::Robot;

class BothHals : public firmware_test::FirmwareTest, public ::testing::WithParamInterface<const char*> {
 protected:
  BothHals() { options.hal = GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Drivers, BothHals, ::testing::Values("sim", "dspic"),
                         [](const auto& p) { return std::string(p.param); });

// --- agendas and motors

// 1475 cycles a tick: 9996.7 a second, so 99 or 100 calls of a cycle of 100 ticks in a second
TEST_P(BothHals, agendas_tick_every_1475_cycles) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
int fast, slow, order, first_of_two;
static void count_fast(void) { fast++; if (!first_of_two) first_of_two = 1; }
static void count_slow(void) { slow++; }
static void newest(void) { if (!first_of_two) first_of_two = 2; }
int main(void) {
  e_init_port();
  e_activate_agenda(count_fast, 100);
  e_activate_agenda(count_slow, 5000);
  e_activate_agenda(newest, 100);
  e_start_agendas_processing();
  while (1);
}
)");
  run_for(0.2);
  const int before = robot.variable("fast");
  run_for(2.0);
  EXPECT_NEAR(robot.variable("fast") - before, 200, 1);
  EXPECT_EQ(robot.variable("slow"), 4);
  EXPECT_EQ(robot.variable("first_of_two"), 2);  // the newest agenda runs first
  expect_no_traps();
}

// An agenda may end itself and its neighbour from inside; both are gone at once
TEST_P(BothHals, agendas_edit_the_list_from_inside) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
volatile int once, neighbour, still, gone;
static void older(void) { neighbour++; }
static void ends_itself(void) { once++; e_destroy_agenda(ends_itself); e_destroy_agenda(older); }
static void newest(void) { still++; }
int main(void) {
  e_init_port();
  e_activate_agenda(older, 200);
  e_activate_agenda(ends_itself, 200);
  e_activate_agenda(newest, 200);
  e_start_agendas_processing();
  while (still < 5);
  gone = e_reset_agenda(ends_itself);
  while (1);
}
)");
  run_for(0.5);
  EXPECT_EQ(robot.variable("once"), 1);
  EXPECT_EQ(robot.variable("neighbour"), 0);
  EXPECT_GE(robot.variable("still"), 5);
  EXPECT_EQ(robot.variable("gone"), 2);  // AG_NOT_FOUND
  expect_no_traps();
}

// 300 steps/s are agendas of 33 ticks: 9996.7 / 33 = 302.9 steps a second; 1000 are 10 ticks: 999.7
TEST_P(BothHals, agenda_motors_step_at_the_librarys_rates) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
int left_steps, right_steps;
int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_set_speed_left(300);
  e_set_speed_right(-1000);
  while (1) { left_steps = e_get_steps_left(); right_steps = e_get_steps_right(); }
}
)");
  run_for(0.5);
  const auto l = robot.left_steps(), r = robot.right_steps();
  run_for(2.0);
  EXPECT_NEAR(double(robot.left_steps() - l), 605.9, 2);
  EXPECT_NEAR(double(robot.right_steps() - r), -1999.3, 2);
  EXPECT_NEAR(robot.variable("left_steps"), double(robot.left_steps()), 2);
  EXPECT_NEAR(robot.variable("right_steps"), double(robot.right_steps()), 2);
  expect_no_traps();
}

struct Turns {
  int left, right, nops;
  int turns;  // of two seconds, as the chip's own code leaves them
};
class SpeedsInEachTurn : public firmware_test::FirmwareTest,
                         public ::testing::WithParamInterface<std::tuple<const char*, Turns>> {
 protected:
  SpeedsInEachTurn() { options.hal = std::get<0>(GetParam()); }
};
constexpr Turns kTurns[] = {{300, 300, 5600, 1229},
                            {300, -150, 2000, 3401},
                            {700, 610, 3000, 2273},
                            {90, 40, 9000, 770},
                            {400, 0, 50, 16194}};
INSTANTIATE_TEST_SUITE_P(Drivers, SpeedsInEachTurn,
                         ::testing::Combine(::testing::Values("sim", "dspic"), ::testing::ValuesIn(kTurns)));

// the motors' agendas fire at other instants than with a speed that stays, and take time then
TEST_P(SpeedsInEachTurn, leave_the_program_its_time) {
  const Turns& row = std::get<1>(GetParam());
  Robot& robot = add_robot_with_source(fmt::format(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
volatile long turns;
int main(void) {{
  unsigned i;
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  while (1) {{
    e_set_speed_left({});
    e_set_speed_right({});
    ++turns;
    for (i = 0; i < {}; i++) asm volatile("nop");
  }}
}}
)",
                                                   row.left, row.right, row.nops));
  run_for(2);
  EXPECT_NEAR(robot.variable("turns"), row.turns, 1 + row.turns / 2000);
  expect_no_traps();
}

/// So many agendas of one period, and how often the first one comes in 300,000 rounds (hal_dspic's).
struct Callbacks {
  int agendas, period;
  bool scans;
  int times;
};
class Beside : public firmware_test::FirmwareTest,
               public ::testing::WithParamInterface<std::tuple<const char*, Callbacks>> {
 protected:
  Beside() { options.hal = std::get<0>(GetParam()); }
};
constexpr Callbacks kCallbacks[] = {{1, 1, true, 1286}, {1, 2, true, 639},   {1, 10, true, 127},
                                    {8, 3, false, 414}, {12, 7, false, 186}, {12, 1, false, 1493}};
INSTANTIATE_TEST_SUITE_P(Drivers, Beside,
                         ::testing::Combine(::testing::Values("sim", "dspic"),
                                            ::testing::ValuesIn(kCallbacks)));

// Ticks that call something, the others between them and the converter's frames take their time, however they fall
// together.
TEST_P(Beside, agendas_that_call_the_program_has_its_time) {
  const Callbacks& row = std::get<1>(GetParam());
  Robot& robot = add_robot_with_source(fmt::format(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#define F(k) static void f##k(void) {{ n##k++; }}
volatile unsigned n0, n1, n2, n3, n4, n5, n6, n7, n8, n9, n10, n11, times[6], laps;
F(0) F(1) F(2) F(3) F(4) F(5) F(6) F(7) F(8) F(9) F(10) F(11)
static void (*const all[])(void) = {{f0, f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11}};
int main(void) {{
  long i;
  int k;
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  if ({}) e_init_ad_scan(ALL_ADC);
  for (k = 0; k < {}; k++) e_activate_agenda(all[k], {});
  e_set_speed(300, 0);
  while (laps < 6) {{
    n0 = 0;
    for (i = 0; i < 300000; i++) asm volatile("nop");
    times[laps++] = n0;
  }}
  while (1);
}}
)",
                                                   row.scans ? 1 : 0, row.agendas, row.period));
  while (robot.variable("laps") < 6) run_for(0.1);
  for (const std::int16_t times : robot.variables<std::int16_t>("times", 6))
    EXPECT_NEAR(times, row.times, 1 + row.times / 250);
  expect_no_traps();
}

// Whoever counts how often it has looked at what the library says waits all the same.
class Polls : public firmware_test::FirmwareTest,
              public ::testing::WithParamInterface<std::tuple<const char*, const char*>> {
 protected:
  Polls() { options.hal = std::get<0>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Drivers, Polls,
                         ::testing::Combine(::testing::Values("sim", "dspic"),
                                            ::testing::Values("while (e_get_steps_left() < 3000) n++;",
                                                              "while (e_get_prox(0) < 3000) n++;",
                                                              "while (e_get_steps_left() < n + 3000) m--;",
                                                              "do m++; while (e_get_acc(0) > 0);")));

TEST_P(Polls, that_count_are_no_load) {
  add_robot_with_source(fmt::format(R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
int main(void) {{
  long n = 0, m = 0;
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  e_init_ad_scan(ALL_ADC);
  e_set_speed_left(300);
  {}
  while (n + m) ;
}}
)",
                                    std::get<1>(GetParam())));
  run_for(4);
  EXPECT_LT(twin().mind(0).runner()->cpu_load(), 0.25);
  expect_no_traps();
}

// of work that interrupts cut again and again, nothing belongs to the wait before it
TEST_P(BothHals, work_between_waits_is_load) {
  add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <fft/e_fft.h>
#include <fft/e_fft_utilities.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
extern int e_mic_scan[3][MIC_SAMP_NB];
extern fractcomplex sigCmpx[FFT_BLOCK_LENGTH];
int main(void) {
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  e_init_ad_scan(MICRO_ONLY);
  e_set_speed(400, 0);
  while (1) {
    while (!e_ad_is_array_filled()) continue;
    e_fast_copy(e_mic_scan[0], (int *)sigCmpx, 256);
    e_doFFT_asm(sigCmpx);
  }
}
)");
  run_for(2);
  EXPECT_NEAR(twin().mind(0).runner()->cpu_load(), 0.929, 0.003);
  expect_no_traps();
}

// 57600 / 500 = 115: (115 + 1) x 256 cycles, 496.6 steps/s
TEST_P(BothHals, timer_motors_step_at_their_periods) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_motors.h>
int main(void) {
  e_init_motors();
  e_set_speed_left(500);
  e_set_speed_right(100);
  while (1);
}
)");
  run_for(0.5);
  const auto l = robot.left_steps(), r = robot.right_steps();
  run_for(2.0);
  EXPECT_NEAR(double(robot.left_steps() - l), 2 * 14745600.0 / (116 * 256), 2);
  EXPECT_NEAR(double(robot.right_steps() - r), 2 * 14745600.0 / (577 * 256), 2);
  expect_no_traps();
}

// two of a wheel's four coils carry current while it steps, none at rest
TEST_P(BothHals, timer_motors_at_rest_carry_no_current) {
  const std::string program = R"(
#include <p30F6014A.h>
#include <motor_led/e_motors.h>
int turning, left_rests, both_rest;
static void pause(void) { long i; for (i = 0; i < 100000; i++) Nop(); }
int main(void) {
  e_init_motors();
  e_set_speed_left(500);
  e_set_speed_right(-500);
  pause();
  turning = LATD & 0xFF;
  e_set_speed_left(0);
  pause();
  left_rests = LATD & 0xFF;
  e_set_speed_right(0);
  pause();
  both_rest = LATD & 0xFF;
  while (1);
}
)";
  Robot& two_timers = add_robot_with_source(program);
  Robot& one_timer = add_robot_with_source("#define E_MOTORS_TIMER3\n" + program);
  run_for(1);
  for (Robot* robot : {&two_timers, &one_timer}) {
    EXPECT_EQ(__builtin_popcount(robot->variable("turning") & 0x0F), 2);
    EXPECT_EQ(__builtin_popcount(robot->variable("turning") & 0xF0), 2);
    EXPECT_EQ(robot->variable("left_rests") & 0x0F, 0);
    EXPECT_EQ(__builtin_popcount(robot->variable("left_rests") & 0xF0), 2);
    EXPECT_EQ(robot->variable("both_rest"), 0);
  }
  expect_no_traps();
}

// --- LEDs, selector

TEST_P(BothHals, leds_and_selector) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <utility/utility.h>
int position;
int main(void) {
  e_init_port();
  position = getselector();
  e_set_led(3, 1);
  e_set_led(4, 2);
  e_set_body_led(1);
  while (1);
}
)")
                     .selector(11);
  run_for(0.5);
  EXPECT_EQ(robot.variable("position"), 11);
  EXPECT_EQ(robot.leds(), (1u << 3) | (1u << 4) | (1u << 8));
  expect_no_traps();
}

// --- serial lines

TEST_P(BothHals, serial_lines_echo_what_they_get) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
static char c;
int main(void) {
  e_init_port();
  e_init_uart1();
  e_init_uart2(BAUD230400);
  e_send_uart1_char("hello, this is more than a FIFO\r\n", 33);
  while (1)
    if (e_getchar_uart1(&c)) {
      while (e_uart2_sending());
      e_send_uart2_char(&c, 1);
    }
}
)");
  run_for(0.5);
  EXPECT_EQ(robot.uart(1).text(), "hello, this is more than a FIFO\r\n");
  robot.uart(1).send("0123456789abcdefghijklmnopqrstuvwxyz");
  run_for(0.1);
  EXPECT_EQ(robot.uart(2).text(), "0123456789abcdefghijklmnopqrstuvwxyz");
  expect_no_traps();
}

// --- the scan

// 65 frames of 965 cycles: an accelerometer sample every 4.26 ms, 49 of them before e_init_ad_scan returns
TEST_P(BothHals, scan_fills_its_arrays_at_the_librarys_rate) {
  wall(0.05, -0.2, 0.05, 0.2);  // a centimetre before it
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <utility/utility.h>
int prox[8], light[8], x, y, z, volume, started;
float elapsed;
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  resetTime();
  started = 1;
  while (1) {
    int i;
    for (i = 0; i < 8; i++) { prox[i] = e_get_prox(i); light[i] = e_get_ambient_light(i); }
    x = e_get_acc(0);
    y = e_get_acc(1);
    z = e_get_acc(2);
    volume = e_get_micro_volume(0);
    elapsed = getDiffTimeMs();
  }
}
)");
  for (int i = 0; i < 100 && !robot.variable("started"); ++i) run_for(0.01);
  run_for(1.0);
  // the library reckons 0.061 ms a frame; 1 s has 15,280 of 965 cycles
  EXPECT_NEAR(robot.variable<float>("elapsed"), 932.1, 9);
  const auto prox = robot.variables("prox", 8);
  EXPECT_GT(prox[0], 300);
  EXPECT_GT(prox[7], 300);
  EXPECT_LT(std::abs(prox[3]), 100);
  // what is recorded is what the program has read, noise and all
  for (int i = 0; i < 8; ++i) EXPECT_EQ(prox[i], robot.proximity(i)) << i;
  // 0 g is 2048 counts; z counts from 2000 and 1 g is about 800
  EXPECT_NEAR(robot.variable("x"), 2048, 100);
  EXPECT_NEAR(robot.variable("z"), 848, 150);
  expect_no_traps();
}

TEST_P(BothHals, basic_proximity_sees_the_wall) {
  wall(0.05, -0.2, 0.05, 0.2);
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <a_d/e_prox.h>
int prox[8];
int main(void) {
  int i;
  e_init_port();
  e_init_prox();
  while (1) for (i = 0; i < 8; i++) prox[i] = e_get_prox(i);
}
)");
  run_for(0.5);
  const auto prox = robot.variables("prox", 8);
  EXPECT_GT(prox[0], 300);
  EXPECT_GT(prox[7], 300);
  EXPECT_LT(std::abs(prox[3]), 100);
  expect_no_traps();
}

// --- camera, codec, EEPROM, transform

TEST_P(BothHals, camera_takes_a_picture) {
  wall(0.2, -0.3, 0.2, 0, {0, 0, 0});
  wall(0.2, 0, 0.2, 0.3, {1, 1, 1});
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <camera/fast_2_timer/e_poxxxx.h>
char picture[800];
int id, answer, pictures;
int main(void) {
  e_init_port();
  id = e_poxxxx_init_cam();
  answer = e_poxxxx_config_cam(160, 160, 320, 160, 8, 8, GREY_SCALE_MODE);
  e_poxxxx_write_cam_registers();
  while (1) {
    e_poxxxx_launch_capture(picture);
    while (!e_poxxxx_is_img_ready());
    pictures++;
  }
}
)");
  run_for(2.0);
  EXPECT_EQ(robot.variable("id"), 0x3030);
  EXPECT_EQ(robot.variable("answer"), 0);
  EXPECT_GE(robot.variable("pictures"), 4);
  const auto picture = robot.variables<std::uint8_t>("picture", 800);
  // a black wall on one side, a white one on the other
  int lowest = 255, highest = 0;
  for (const int p : picture) lowest = std::min(lowest, p), highest = std::max(highest, p);
  EXPECT_GT(highest - lowest, 60);
  expect_no_traps();
}

// Two bytes a pixel: a line that is read a byte too early or late has its colours' halves exchanged. A red
// wall is RRRRRGGG GGGBBBBB with more red than anything else, in every pixel.
TEST_P(BothHals, camera_takes_colours_in_step_with_the_bytes) {
  wall(0.15, -0.4, 0.15, 0.4, {0.9, 0.05, 0.05});
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <camera/fast_2_timer/e_poxxxx.h>
char picture[800];
int pictures;
int main(void) {
  e_init_port();
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(160, 240, 320, 80, 16, 4, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  while (1) {
    e_poxxxx_launch_capture(picture);
    while (!e_poxxxx_is_img_ready());
    pictures++;
  }
}
)");
  run_for(2.0);
  ASSERT_GE(robot.variable("pictures"), 2);
  const auto picture = robot.variables<std::uint8_t>("picture", 800);
  int red_ones = 0;
  for (int i = 0; i < 400; ++i) {
    const int red = picture[2 * i] >> 3, green = (picture[2 * i] & 7) << 2 | picture[2 * i + 1] >> 6;
    const int blue = picture[2 * i + 1] & 31;
    if (red > green + 3 && red > blue + 3) ++red_ones;
  }
  EXPECT_GT(red_ones, 300);
  expect_no_traps();
}

// 1800 interrupts a second of four samples: 2112 samples last 293 ms
TEST_P(BothHals, codec_plays_a_sound_to_its_end) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <codec/e_sound.h>
extern volatile int e_dci_unavailable;
int begun, over;
int main(void) {
  e_init_port();
  e_init_sound();
  e_play_sound(0, 2112);
  begun = 1;
  while (e_dci_unavailable);
  over = 1;
  while (1);
}
)");
  for (int i = 0; i < 100 && !robot.variable("begun"); ++i) run_for(0.01);
  ASSERT_EQ(robot.variable("begun"), 1);
  run_for(0.27);
  EXPECT_EQ(robot.variable("over"), 0);
  run_for(0.05);
  EXPECT_EQ(robot.variable("over"), 1);
  expect_no_traps();
}

TEST_P(BothHals, eeprom_keeps_what_is_written) {
  Robot& robot = add_robot_with_source(R"(
#include "DataEEPROM.h"
int before, erased, after, row[16], back[16], bad;
int main(void) {
  int i, word = 0x1234;
  for (i = 0; i < 16; i++) row[i] = 100 * i;
  EraseEE(0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &erased, WORD);
  WriteEE(&word, 0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &after, WORD);
  EraseEE(0x7F, 0xF040, ROW);
  WriteEE(row, 0x7F, 0xF040, ROW);
  ReadEE(0x7F, 0xF040, back, ROW);
  bad = ReadEE(0x7E, 0xF020, &before, WORD);
  while (1);
}
)");
  run_for(0.1);
  EXPECT_EQ(robot.variable("erased"), -1);
  EXPECT_EQ(robot.variable("after"), 0x1234);
  const auto back = robot.variables("back", 16);
  for (int i = 0; i < 16; ++i) EXPECT_EQ(back[i], 100 * i);
  EXPECT_EQ(robot.variable("bad"), -1);
  expect_no_traps();
}

// An impulse of 0.25 at 0 transforms to 0.25 / 256 at every frequency: 8192 / 256 = 32
TEST_P(BothHals, transform_of_an_impulse_is_flat) {
  Robot& robot = add_robot_with_source(R"(
#include <fft/e_fft.h>
extern fractcomplex sigCmpx[FFT_BLOCK_LENGTH];
int done;
int main(void) {
  sigCmpx[0].real = 8192;
  e_doFFT_asm(sigCmpx);
  done = 1;
  while (1);
}
)");
  run_for(0.5);
  ASSERT_EQ(robot.variable("done"), 1);
  const auto points = robot.variables("sigCmpx", 512);
  for (int i = 0; i < 256; ++i) {
    EXPECT_EQ(points[2 * i], 32) << i;
    EXPECT_EQ(points[2 * i + 1], 0) << i;
  }
  expect_no_traps();
}

// --- what has no test elsewhere that runs with both HALs (tests/firmware/both_hals.txt)

// on a level floor x and y are in the middle of 12 bits, z 768 counts above it; AN5 to AN7;
// noise of some counts
TEST_P(BothHals, basic_converter_reads_single_channels) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <a_d/e_ad_conv.h>
int x, y, z;
int main(void) {
  e_init_port();
  e_init_ad();
  x = e_read_ad(5);
  y = e_read_ad(6);
  z = e_read_ad(7);
  while (1);
}
)");
  run_for(0.1);
  EXPECT_NEAR(robot.variable("x"), 2048, 20);
  EXPECT_NEAR(robot.variable("y"), 2048, 20);
  EXPECT_NEAR(robot.variable("z"), 2048 + 768, 20);
  expect_no_traps();
}

// 1474560 cycles are 0.1 s; the port's initialisation takes 21 ms
TEST_P(BothHals, delays_last_their_cycles) {
  Robot& robot = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <libpic30.h>
int main(void) {
  e_init_port();
  LED0 = 1;
  __delay32(1474560);
  LED0 = 0;
  while (1);
}
)");
  ASSERT_TRUE(run_until([&] { return robot.led(0); }, 0.1));
  const double lit_s = now_s();
  ASSERT_TRUE(run_until([&] { return !robot.led(0); }, 0.2));
  EXPECT_NEAR(now_s() - lit_s, 0.1, 0.003);  // looked at every 2 ms
  expect_no_traps();
}

}  // namespace
