// SPDX-License-Identifier: MIT
// A robot whose program looks at everything that a fault may change, and keeps it in variables; and a bench
// that may be run several times in a test.
#pragma once
#include <string>

#include "hal_sim/faults/injector.h"
#include "tests/support/firmware_test.h"

namespace faults_test {

/// Says one byte after the other on UART 1, drives at 400 steps/s, looks in turns.
inline const char* const kLooker = R"(
#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <uart/e_uart_char.h>
int prox[8], ambient[8], acc_z, loud[3], battery_good, selector, remote_lows, goal = 7;
int left_counted, right_counted;
unsigned beats, received, odd_bytes, looks, starts;
char heard[64];
static void beat(void) { ++beats; }
int main(void) {
  int i;
  char c, out = 'a';
  ++starts;
  e_init_port();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);
  e_init_motors();
  e_activate_agenda(beat, 100);
  e_start_agendas_processing();
  e_set_led(3, 1);
  e_set_speed_left(400);
  e_set_speed_right(400);
  for (;;) {
    for (i = 0; i < 8; ++i) {
      prox[i] = e_get_prox(i);
      ambient[i] = e_get_ambient_light(i);
    }
    for (i = 0; i < 3; ++i) {
      loud[i] = e_get_micro_volume(i);
    }
    acc_z = e_get_acc(2);
    battery_good = BATT_LOW;
    selector = SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3;
    if (!REMOTE) ++remote_lows;
    left_counted = e_get_steps_left();
    right_counted = e_get_steps_right();
    while (e_getchar_uart1(&c)) {
      if (received < 64) heard[received] = c;
      ++received;
      if (c & 0x80) ++odd_bytes;
    }
    if (!e_uart1_sending()) {
      e_send_uart1_char(&out, 1);
      ++looks;
    }
  }
}
)";

class Bench : public firmware_test::FirmwareTest {
 public:
  void TestBody() override {}
  using FirmwareTest::box;
  using FirmwareTest::digest;
  using FirmwareTest::expect_no_traps;
  using FirmwareTest::faults;
  using FirmwareTest::now_s;
  using FirmwareTest::options;
  using FirmwareTest::run_for;
  using FirmwareTest::run_until;
  using FirmwareTest::twin;
  using FirmwareTest::wall;
  using FirmwareTest::world;

  /// One robot at the origin that looks along x.
  explicit Bench(const char* program = kLooker, int robots = 1) {
    for (int i = 0; i < robots; ++i)
      add_robot_with_source(program, "puck" + std::to_string(i)).at(0, 0.5 * i);
  }
  firmware_test::Robot& puck(int i = 0) { return robot(i); }
  int look(const std::string& variable) { return puck().variable(variable); }
  int look(const std::string& variable, int i) {
    return puck().variables(variable, static_cast<std::size_t>(i) + 1).back();
  }
  /// Adds one as the command line writes it. Fails the test when it is none.
  int add(const std::string& line) {
    faults::Fault fault;
    std::string error;
    EXPECT_TRUE(faults::parse_fault_line(line, fault, error)) << line << ": " << error;
    return faults().add(fault);
  }
  std::string added_wrongly(const std::string& line) {
    faults::Fault fault;
    std::string error;
    if (!faults::parse_fault_line(line, fault, error)) return error;
    try {
      faults().add(fault);
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  }
};

}  // namespace faults_test
