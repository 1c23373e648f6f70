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

class FunctionCosts : public RegisterTest {
 protected:
  std::vector<double> cycles(const char* way) {
    std::ostringstream text;
    text
        << "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <a_d/advance_ad_scan/e_acc.h>\n"
           "#include <a_d/advance_ad_scan/e_micro.h>\n#include <a_d/advance_ad_scan/e_prox.h>\n"
           "#include <motor_led/advance_one_timer/e_agenda.h>\n#include "
           "<motor_led/advance_one_timer/e_led.h>\n"
           "#include <motor_led/advance_one_timer/e_motors.h>\n#include <motor_led/e_epuck_ports.h>\n"
           "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n#include <utility/utility.h>\n"
           "volatile int sink, done; unsigned int took[40];\n"
           "static void first(void) {}\nstatic void second(void) {}\nstatic void third(void) {}\n"
           "static void __attribute__((noinline)) nothing(int i) { sink = i; }\n";
    int n = 0;
    for (const Call& c : kCallsTried)
      text << "static void __attribute__((noinline)) f" << n++ << "(int i) { " << c.code << " }\n";
    text << "static void measure(int which, void (*f)(int)) { int i; TMR4 = 0; T4CONbits.TON = 1;\n"
            " for (i = 0; i < 1000; i++) f(i);\n T4CONbits.TON = 0; took[which] = TMR4; }\n"
            "int main(void) { e_init_port(); e_start_agendas_processing(); e_init_motors(); e_init_uart1();\n"
            " e_init_ad_scan(ALL_ADC); e_activate_agenda(first, 0); e_activate_agenda(second, 0);\n"
            " e_end_agendas_processing(); e_ad_scan_off(); T4CON = 0; T4CONbits.TCKPS = 2; PR4 = 0xFFFF;\n"
            " measure(39, nothing);\n";
    for (int i = 0; i < n; ++i) text << " measure(" << i << ", f" << i << ");\n";
    text << " done = 1; for (;;); }\n";
    options.way = way;
    Robot& robot = add_robot_with_source(text.str());
    for (int i = 0; i < 40 && robot.variable("done") == 0; ++i) run_for(0.1);
    EXPECT_EQ(robot.variable("done"), 1) << way;
    std::vector<double> result;
    for (std::uint16_t counts : robot.variables<std::uint16_t>("took", 40))
      result.push_back(counts * kCount / kCalls);
    return result;
  }
};

TEST_F(FunctionCosts, a_call_costs_the_same_in_both_ways) {
  const std::vector<double> chip = cycles("register");
  struct Native : FunctionCosts {
    void TestBody() override {}
    using FunctionCosts::cycles;
  } twin;
  const std::vector<double> native = twin.cycles("native");
  EXPECT_NEAR(native[39], chip[39], 0.1) << "a call that stores its argument";
  for (std::size_t i = 0; i < std::size(kCallsTried); ++i) {
    EXPECT_GT(chip[i], 5) << kCallsTried[i].name;
    EXPECT_NEAR(native[i], chip[i], std::max(kCallsTried[i].tolerance, 0.07 * chip[i]))
        << kCallsTried[i].name;
  }
}

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
    {"e_init_ad_scan, microphones", "e_init_ad_scan(MICRO_ONLY);"},
    {"e_init_ad_scan, to its first full buffer", "e_init_ad_scan(ALL_ADC);"},
    {"e_ad_scan_off", "e_ad_scan_off();"},
    {"e_ad_scan_on", "e_ad_scan_on();"},
    {"e_ad_scan_off again", "e_ad_scan_off();"},
    {"e_calibrate_ir", "e_calibrate_ir();"},
    {"wait, 1000 rounds", "wait(1000);"},
};

class SetUpCosts : public RegisterTest {
 protected:
  /// In cycles; of a call that takes longer than Timer 4 counts, the last 16 bits.
  std::vector<int> cycles(const char* way) {
    std::ostringstream text;
    text << "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <motor_led/advance_one_timer/e_agenda.h>\n"
            "#include <motor_led/advance_one_timer/e_motors.h>\n#include <motor_led/e_epuck_ports.h>\n"
            "#include <motor_led/e_init_port.h>\n#include <uart/e_uart_char.h>\n"
            "#include <a_d/advance_ad_scan/e_prox.h>\n#include <utility/utility.h>\n"
            "volatile int done; unsigned int took[30];\n"
            "static void first(void) {}\nstatic void second(void) {}\nstatic void third(void) {}\n"
            "static void __attribute__((noinline)) nothing(void) {}\n";
    int n = 0;
    for (const Call& c : kSetUpTried)
      text << "static void __attribute__((noinline)) f" << n++ << "(void) { " << c.code << " }\n";
    text << "static void __attribute__((noinline)) measure(int which, void (*f)(void)) { TMR4 = 0;\n"
            " T4CONbits.TON = 1; f(); T4CONbits.TON = 0; took[which] = TMR4; }\n"
            "int main(void) { T4CON = 0; PR4 = 0xFFFF; measure(29, nothing);\n";
    for (int i = 0; i < n; ++i) text << " measure(" << i << ", f" << i << ");\n";
    text << " done = 1; for (;;); }\n";
    options.way = way;
    Robot& robot = add_robot_with_source(text.str());
    for (int i = 0; i < 40 && robot.variable("done") == 0; ++i) run_for(0.1);
    EXPECT_EQ(robot.variable("done"), 1) << way;
    std::vector<int> result;
    for (std::uint16_t counts : robot.variables<std::uint16_t>("took", 30)) result.push_back(counts);
    return result;
  }
};

TEST_F(SetUpCosts, setting_up_costs_the_same_in_both_ways) {
  const std::vector<int> chip = cycles("register");
  struct Native : SetUpCosts {
    void TestBody() override {}
    using SetUpCosts::cycles;
  } twin;
  const std::vector<int> native = twin.cycles("native");
  EXPECT_EQ(native[29], chip[29]) << "a call of nothing";
  for (std::size_t i = 0; i < std::size(kSetUpTried); ++i) {
    EXPECT_GT(chip[i], 5) << kSetUpTried[i].name;
    EXPECT_NEAR(native[i], chip[i], kSetUpTried[i].tolerance) << kSetUpTried[i].name;
  }
}

}  // namespace
}  // namespace register_test
