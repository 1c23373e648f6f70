// SPDX-License-Identifier: MIT
// The fast agenda beside the other drivers of a program: what its interrupts leave to the main program.
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class FastAgenda : public FirmwareTest {};

// While the motors rest, their timer interrupts every 0.1 ms for nothing. The interrupt walks a list of two
// tasks, some hundred of 1474 cycles; with the converter's tenth more than half is left to the main program.
TEST_F(FastAgenda, main_program_gets_most_of_the_time_beside_motors_and_converter) {
  Robot& r = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
#include <motor_led/advance_one_timer/fast_agenda/e_motors.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
volatile int tenths;
long alone, beside;
static void tick(void) { tenths++; }
static long work_for(unsigned int ticks) {
  long rounds = 0;
  volatile int sink = 0;
  TMR5 = 0;
  while (TMR5 < ticks) { sink++; rounds++; }
  return rounds;
}
int main(void) {
  e_init_port();
  T5CON = 0; PR5 = 0xFFFF; T5CONbits.TCKPS = 3; T5CONbits.TON = 1; /* 17.36 us a tick */
  alone = work_for(5760);
  e_init_ad_scan(ALL_ADC);
  e_configure_timer(0);
  e_start_timer_processing(0);
  e_start_agendas_processing();
  e_init_motors();
  e_activate_agenda(tick, 1000);
  tenths = 0;
  beside = work_for(57600);
  while (1);
}
)");
  run_for(2.0);
  EXPECT_GT(r.variable<std::int32_t>("alone"), 1000);
  EXPECT_GT(r.variable<std::int32_t>("beside"), 5 * r.variable<std::int32_t>("alone"));  // of 10
  EXPECT_GE(r.variable("tenths"), 10);
  expect_no_traps();
}

// the period stays right over stops in between, and pausing keeps the count
TEST_F(FastAgenda, periods_are_exact_over_stops_of_the_timer) {
  Robot& r = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
volatile int fast, slow;
static void quick(void) { fast++; }
static void lazy(void) { slow++; }
int main(void) {
  int i;
  e_init_port();
  e_configure_timer(0);
  e_start_agendas_processing();
  e_activate_agenda(quick, 20);
  for (i = 0; i < 50; i++) { e_end_agendas_processing(0); e_start_timer_processing(0); }
  e_activate_agenda(lazy, 250);
  while (1);
}
)");
  run_for(0.1);
  const int fast = r.variable("fast"), slow = r.variable("slow");
  run_for(1.0);
  EXPECT_NEAR(r.variable("fast") - fast, 500, 1);
  EXPECT_NEAR(r.variable("slow") - slow, 40, 1);
  expect_no_traps();
}

// 25 periods of 0.1 ms a step, and what the handler holds the timer up each time it changes the period: 368
// steps/s. The right wheel's 300 follow, for both wheels share one timer and its
// driver confuses the periods, as the original does.
TEST_F(FastAgenda, motors_step_slower_by_what_the_handler_takes) {
  Robot& r = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
#include <motor_led/advance_one_timer/fast_agenda/e_motors.h>
int main(void) {
  e_init_port();
  e_configure_timer(0);
  e_start_agendas_processing();
  e_init_motors();
  e_set_speed_left(400);
  e_set_speed_right(300);
  while (1);
}
)");
  run_for(1.0);
  const auto left = r.left_steps(), right = r.right_steps();
  run_for(4.0);
  EXPECT_NEAR(static_cast<double>(r.left_steps() - left), 4 * 368, 15);
  EXPECT_NEAR(static_cast<double>(r.right_steps() - right), 4 * 368, 15);
}

// Three tasks take a timer each: 13, 11 and 7 units of 1474.56 cycles. What shares a divisor with one goes there, and that
// timer counts by it; what shares none goes to the timer with the shortest period, which then counts units.
TEST_F(FastAgenda, a_fourth_task_goes_where_it_fits) {
  struct {
    int cycle;
    std::vector<std::uint16_t> periods;  // of timers 1 to 3
  } const kRows[] = {{22, {19169, 16220, 10321}}, {39, {19169, 16220, 10321}}, {17, {19169, 16220, 1474}}};
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    Robot& r = add_robot_with_source("#define CYCLE " + std::to_string(kRows[i].cycle) + R"(
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
unsigned int periods[3];
volatile int counts[4];
static void a(void) { counts[0]++; }
static void b(void) { counts[1]++; }
static void c(void) { counts[2]++; }
static void d(void) { counts[3]++; }
int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_activate_agenda(a, 13);
  e_activate_agenda(b, 11);
  e_activate_agenda(c, 7);
  e_activate_agenda(d, CYCLE);
  e_start_timer_processing(0);
  e_start_timer_processing(1);
  e_start_timer_processing(2);
  periods[0] = PR1; periods[1] = PR2; periods[2] = PR3;
  while (1);
}
)",
                                     "r" + std::to_string(i));
    r.at(0, static_cast<double>(i));
  }
  run_for(0.1);
  std::vector<std::vector<std::int16_t>> before;
  for (std::size_t i = 0; i < std::size(kRows); ++i)
    before.push_back(robot(static_cast<int>(i)).variables("counts", 4));
  run_for(1);
  for (std::size_t i = 0; i < std::size(kRows); ++i) {
    const Robot& r = robot(static_cast<int>(i));
    EXPECT_EQ(r.variables<std::uint16_t>("periods", 3), kRows[i].periods) << kRows[i].cycle;
    const auto counts = r.variables("counts", 4);
    const int cycles[] = {13, 11, 7, kRows[i].cycle};
    for (std::size_t t = 0; t < 4; ++t) EXPECT_NEAR(counts[t] - before[i][t], 10000 / cycles[t], 1) << t;
  }
  expect_no_traps();
}

}  // namespace
