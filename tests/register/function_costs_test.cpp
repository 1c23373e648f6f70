// SPDX-License-Identifier: MIT
// What a call of a library function costs the caller, in both ways: the drivers' C code on the chip, and what
// the native way charges for its closed forms. A thousand calls each without interrupts, timed by the program
// with Timer 4 (64 cycles a count). Where they differ, a loop that calls them drifts away from its twin.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/register/register_fixture.h"

namespace register_test {
namespace {

constexpr double kCount = 64, kCalls = 1000;

struct Call {
  const char* name;
  const char* code;
  double tolerance = 4;  // cycles a call, or 7 % of them: a list of agendas is searched node by node
};

const Call kCallsTried[] = {
    {"e_get_prox", "sink = e_get_prox(i & 7);"},
    {"e_get_calibrated_prox", "sink = e_get_calibrated_prox(i & 7);"},
    {"e_get_ambient_light", "sink = e_get_ambient_light(i & 7);"},
    {"e_set_speed_left", "e_set_speed_left(i);"},
    {"e_set_speed_right", "e_set_speed_right(500);"},
    {"e_set_speed_right, 0", "e_set_speed_right(0);"},
    {"e_set_speed", "e_set_speed(300, 50);"},
    {"e_get_steps_left", "sink = e_get_steps_left();"},
    {"e_set_steps_left", "e_set_steps_left(i);"},
    {"e_set_led", "e_set_led(i & 7, i & 8);"},
    {"e_set_led, all", "e_set_led(8, i & 1);", 45},  // eight LEDs
    {"e_set_body_led", "e_set_body_led(i & 1);"},
    {"e_set_front_led", "e_set_front_led(i & 1);"},
    {"e_get_acc", "sink = e_get_acc(0);"},
    {"e_get_micro", "sink = e_get_micro(0);"},
    {"e_set_agenda_cycle", "e_set_agenda_cycle(second, i);"},
    {"e_set_agenda_cycle, further down", "e_set_agenda_cycle(first, i);"},
    {"e_pause_agenda", "e_pause_agenda(second);"},
    {"e_activate_agenda, known", "e_activate_agenda(second, 0);"},
    {"e_activate_agenda and e_destroy_agenda", "e_activate_agenda(third, 9); e_destroy_agenda(third);"},
    {"e_destroy_agenda, unknown", "e_destroy_agenda(third);"},
    {"e_ischar_uart1", "sink = e_ischar_uart1();"},
    {"getselector", "sink = getselector();", 10},
};

/// Calls that a program makes once, at its start. What they cost is the phase between the handlers of Timer 2
/// and of the converter from then on.
const Call kSetUpTried[] = {
    {"e_init_port", "e_init_port();"},
    {"e_init_uart1", "e_init_uart1();"},
    {"e_activate_agenda before Timer 2 runs", "e_activate_agenda(third, 0);"},
    {"e_start_agendas_processing", "e_start_agendas_processing();"},
    {"e_end_agendas_processing", "e_end_agendas_processing();"},
    {"e_init_motors", "e_init_motors();"},
    {"e_init_motors again", "e_init_motors();"},
    {"e_activate_agenda, first", "e_activate_agenda(first, 5);",
     8},  // malloc() and free() know more than a list
    {"e_activate_agenda, second", "e_activate_agenda(second, 0);", 8},
    {"e_destroy_agenda, oldest", "e_destroy_agenda(third);", 8},
    {"e_destroy_agenda, unknown", "e_destroy_agenda(third);"},
    {"e_init_ad_scan, microphones", "e_init_ad_scan(MICRO_ONLY);", 8},
    // natively its frames come at nominal instants; single ones are up to a quarter longer or shorter
    {"e_init_ad_scan, to its first full buffer", "e_init_ad_scan(ALL_ADC);", 250},
    {"e_ad_scan_off", "e_ad_scan_off();"},
    {"e_ad_scan_on", "e_ad_scan_on();"},
    {"e_ad_scan_off again", "e_ad_scan_off();"},
    {"e_calibrate_ir", "e_calibrate_ir();"},
    {"wait, 1000 rounds", "wait(1000);"},
};

/// A program that makes calls one by one, and how it measures each.
struct Trial {
  const Call* calls;
  std::size_t count;
  const char* parameter;  // of the functions that make them
  const char* nothing;    // body of one that makes none
  const char* measure;    // body of the function that has one made and leaves its count in took[which]
  const char* set_up;
};

constexpr std::size_t kNothing = 39;  // place of the call of nothing; the others have their own

/// What Timer 4 has counted for each call, in this way of running the program.
std::vector<std::uint16_t> counts_of(const Trial& trial, const std::string& way) {
  struct Run : RegisterTest {
    void TestBody() override {}
    std::vector<std::uint16_t> go(const Trial& t, const std::string& chosen_way) {
      std::ostringstream text;
      text << "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <a_d/advance_ad_scan/e_acc.h>\n"
              "#include <a_d/advance_ad_scan/e_micro.h>\n#include <a_d/advance_ad_scan/e_prox.h>\n"
              "#include <motor_led/advance_one_timer/e_agenda.h>\n"
              "#include <motor_led/advance_one_timer/e_led.h>\n"
              "#include <motor_led/advance_one_timer/e_motors.h>\n#include <motor_led/e_epuck_ports.h>\n"
              "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n"
              "#include <utility/utility.h>\n"
              "#define APART static void __attribute__((noinline))\n"
              "volatile int sink, done; unsigned int took[40];\n"
              "static void first(void) {}\nstatic void second(void) {}\nstatic void third(void) {}\n"
           << "APART nothing(" << t.parameter << ") { " << t.nothing << " }\n";
      for (std::size_t i = 0; i < t.count; ++i)
        text << "APART f" << i << "(" << t.parameter << ") { " << t.calls[i].code << " }\n";
      text << "APART measure(int which, void (*f)(" << t.parameter << ")) { " << t.measure << " }\n"
           << "int main(void) { " << t.set_up << " PR4 = 0xFFFF; measure(" << kNothing << ", nothing);\n";
      for (std::size_t i = 0; i < t.count; ++i) text << " measure(" << i << ", f" << i << ");\n";
      text << " done = 1; for (;;); }\n";
      options.way = chosen_way;
      Robot& robot = add_robot_with_source(text.str());
      for (int i = 0; i < 40 && robot.variable("done") == 0; ++i) run_for(0.1);
      EXPECT_EQ(robot.variable("done"), 1) << chosen_way;
      return robot.variables<std::uint16_t>("took", 40);
    }
  } one;
  return one.go(trial, way);
}

TEST(FunctionCosts, a_call_costs_the_same_in_both_ways) {
  const Trial trial{
      kCallsTried,
      std::size(kCallsTried),
      "int i",
      "sink = i;",
      "int i; TMR4 = 0; T4CONbits.TON = 1; for (i = 0; i < 1000; i++) f(i); T4CONbits.TON = 0; took[which] = "
      "TMR4;",
      "e_init_port(); e_start_agendas_processing(); e_init_motors(); e_init_uart1(); e_init_ad_scan(ALL_ADC);"
      " e_activate_agenda(first, 0); e_activate_agenda(second, 0); e_end_agendas_processing();"
      " e_ad_scan_off(); T4CON = 0; T4CONbits.TCKPS = 2;"};
  const auto chip_counts = counts_of(trial, "register"), native_counts = counts_of(trial, "native");
  const auto cycles = [](std::uint16_t counts) { return counts * kCount / kCalls; };
  EXPECT_NEAR(cycles(native_counts[kNothing]), cycles(chip_counts[kNothing]), 0.1)
      << "a call that stores its argument";
  for (std::size_t i = 0; i < trial.count; ++i) {
    const double chip = cycles(chip_counts[i]), native = cycles(native_counts[i]);
    EXPECT_GT(chip, 5) << kCallsTried[i].name;
    EXPECT_NEAR(native, chip, std::max(kCallsTried[i].tolerance, 0.07 * chip)) << kCallsTried[i].name;
  }
}

// in cycles; of a call that takes longer than Timer 4 counts, the last 16 bits
TEST(SetUpCosts, setting_up_costs_the_same_in_both_ways) {
  const Trial trial{kSetUpTried,
                    std::size(kSetUpTried),
                    "void",
                    "",
                    "TMR4 = 0; T4CONbits.TON = 1; f(); T4CONbits.TON = 0; took[which] = TMR4;",
                    "T4CON = 0;"};
  const auto chip = counts_of(trial, "register"), native = counts_of(trial, "native");
  EXPECT_EQ(native[kNothing], chip[kNothing]) << "a call of nothing";
  for (std::size_t i = 0; i < trial.count; ++i) {
    EXPECT_GT(chip[i], 5) << kSetUpTried[i].name;
    EXPECT_NEAR(native[i], chip[i], kSetUpTried[i].tolerance) << kSetUpTried[i].name;
  }
}

}  // namespace
}  // namespace register_test
