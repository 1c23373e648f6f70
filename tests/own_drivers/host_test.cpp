// SPDX-License-Identifier: MIT
// Robots side by side: a trap is its robot's alone, runs repeat, robots of one image are apart.
#include "tests/own_drivers/fixture.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace own_drivers {
namespace {

// selector position as step; waits without reading registers
const std::string kStepper = program(R"(
static int getstep(void) { return PORTG >> 6 & 15; }
unsigned int count;
void _ISR _T1Interrupt(void) { _T1IF = 0; LED0 = !LED0; count += getstep(); }
int main(void)
{
  LED0_dir = 0;
  PR1 = 575;
  T1CON = 0x8030;
  _T1IE = 1;
  while (1);
}
)");

// Both interrupts have the priority of a reset, 4, as in the library: while an agenda's callback runs, the
// scan waits, and of the frames that end meanwhile one is kept. 475 us also hold off 3 of Timer 2's ticks, so
// the callback comes every 1.3 ms, 769 times a second. The 825 us between hold 12.5 frames of 66 us; and the
// one that waited: 13 each time, half a one more or less.
TEST_F(OwnDrivers, a_long_callback_costs_the_scan_its_frames) {
  Robot& robot = add_robot_with_source(R"(
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
extern unsigned int tickAdcIsr;
static void long_one(void) {
  T5CON = 0; TMR5 = 0; T5CONbits.TON = 1;
  while (TMR5 < 7000);
}
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  e_start_agendas_processing();
  e_activate_agenda(long_one, 10);
  while (1);
}
)");
  run_for(0.5);
  const int before = robot.variable("tickAdcIsr");
  run_for(1.0);
  EXPECT_NEAR(robot.variable("tickAdcIsr") - before, 769 * 13, 769 / 2);
}

TEST_F(OwnDrivers, robots_of_one_image_have_chips_of_their_own) {
  Robot& one = add_robot_with_source(kStepper).selector(1);
  Robot& three = add_robot_with_source(kStepper).at(0.5, 0).selector(3);
  run_for(0.505);
  EXPECT_EQ(one.variable<std::uint16_t>("count"), 50);
  EXPECT_EQ(three.variable<std::uint16_t>("count"), 150);
  three.turn_selector(0);
  run_for(0.1);
  EXPECT_EQ(one.variable<std::uint16_t>("count"), 60);
  EXPECT_EQ(three.variable<std::uint16_t>("count"), 150);
  expect_no_traps();
}

TEST_F(OwnDrivers, runs_repeat_whatever_the_number_of_threads) {
  std::uint64_t digests[2];
  for (int run = 0; run < 2; ++run) {
    struct Run : OwnDrivers {
      void TestBody() override {}
      std::uint64_t digest_with(int threads) {
        options.threads = threads;
        for (int i = 0; i < 4; ++i) add_robot_with_source(kStepper).at(0.3 * i, 0).selector(i + 1);
        run_for(0.3);
        return digest();
      }
    } other;
    digests[run] = other.digest_with(run == 0 ? 1 : 3);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST_F(OwnDrivers, traps_stop_their_robot_alone) {
  Robot& bad = add_robot_with_source(program(R"(
volatile int zero;
int result;
int main(void) { LED1_dir = 0; LED1 = 1; result = 5 / zero; while (1); }
)"));
  Robot& deep = add_robot_with_source(program(R"(
int depth(int n) { volatile char room[200]; room[0] = n; return depth(n + 1) + room[0]; }
int main(void) { return depth(0); }
)"))
                    .at(0.3, 0);
  Robot& good = add_robot_with_source(kStepper).at(0.6, 0).selector(1);
  run_for(0.505);
  ASSERT_EQ(bad.traps().size(), 1u);
  EXPECT_TRUE(wording::reads(bad.traps()[0].message,
                             "division by zero, or an overflow of an accumulator; the program has no "
                             "_MathError(), so the processor resets"));
  EXPECT_FALSE(bad.led(1));  // its pins are released
  ASSERT_EQ(deep.traps().size(), 1u);
  EXPECT_TRUE(
      wording::reads(deep.traps()[0].message,
                     "stack overflow in depth(); the program has no _StackError(), so the processor resets"));
  EXPECT_EQ(good.variable<std::uint16_t>("count"), 50);
}

TEST_F(OwnDrivers, an_enabled_interrupt_without_handler_is_named) {
  Robot& robot = add_robot_with_source(program(R"(
int main(void) { PR3 = 1000; T3CON = 0x8000; _T3IE = 1; while (1); }
)"));
  run_for(0.1);
  ASSERT_EQ(robot.traps().size(), 1u);
  EXPECT_TRUE(wording::reads(
      robot.traps()[0].message,
      "the interrupt of T3 is enabled, but the program has no _T3Interrupt(), so the processor resets"));
}

TEST_F(OwnDrivers, a_flag_that_is_never_cleared_is_named) {
  add_robot_with_source(program(R"(
void _ISR _T1Interrupt(void) { LATA ^= 0x40; }
int main(void) { PR1 = 10000; T1CON = 0x8000; _T1IE = 1; while (1); }
)"));
  run_for(0.05);
  EXPECT_TRUE(wording::reads(
      this->robot(0).diagnoses_text(),
      "T1: flag never cleared: the handler of T1 returns without clearing IFS0.T1IF, so it is entered again "
      "at once and the main program hardly runs; clear the flag in the handler\nTRISA6: input driven: LATA6 "
      "is "
      "written again and again, but TRISA6 = 1 makes the pin an input: nothing reaches it; clear the TRIS "
      "bit, or call e_init_port() first\nT1: missed interrupt: T1: an event came while its flag was still "
      "set and enabled; the handler runs once for several (too slow, or held off too long); meanwhile "
      "_T1Interrupt() (main.c:9) ran; make the handler shorter, raise its priority, or allow nesting "
      "(INTCON1.NSTDIS = 0)"));
}

TEST_F(OwnDrivers, the_watchdog_resets_a_program_that_forgets_it) {
  Robot& robot = add_robot_with_source(program(R"(
int main(void)
{
  if (RCONbits.WDTO) { LED2_dir = 0; LED2 = 1; while (1); }
  RCONbits.SWDTEN = 1;
  while (1);
}
)"));
  run_for(0.5);
  EXPECT_FALSE(robot.led(2));
  // 512 x 16 x 2 ms = 16 s
  run_for(17);
  EXPECT_TRUE(robot.led(2));
}

}  // namespace
}  // namespace own_drivers
