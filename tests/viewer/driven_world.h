// SPDX-License-Identifier: MIT
// A folder with a world and a controller that drives in it, for tests of the view.
#pragma once
#include "tests/viewer/page_client.h"

namespace viewer_test {

inline const char* const kWorld = R"(# a driver and a wall
twinpuck = 1
[arena]
size = [2.0, 1.0]

[[box]] # the wall
name = "wall"
position = [0.80, 0.00]
size = [0.02, 0.50, 0.1]

[[robot]]
name = "puck"
firmware = "drive"
position = [-0.5, 0]
)";

// drives on, lights the LED of the selector's position, echoes bytes
inline const char* const kDrive = R"(#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <uart/e_uart_char.h>

volatile int rounds, speed = 500;
static int selector(void) { return SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3; }

int main(void) {
  char c;
  long i;
  e_init_port();
  e_init_uart1();
  e_init_motors();
  e_start_agendas_processing();
  while (1) {
    e_set_speed_left(speed);
    e_set_speed_right(speed);
    for (i = 0; i < 8; i++) e_set_led(i, i == selector());
    if (e_ischar_uart1()) {
      e_getchar_uart1(&c);
      e_send_uart1_char(&c, 1);
    }
    rounds++;
    for (i = 0; i < 10000; i++) asm("nop");
  }
}
)";

class DrivenWorld : public ViewTest {
 protected:
  DrivenWorld() {
    write("world.toml", kWorld);
    write("drive/main.c", kDrive);
  }
  /// Steps of 32 ms.
  static void steps(Page& page, int count) {
    page.good({{"do", "step"}, {"unit", "control"}, {"count", count}});
  }
  static int thing(const Json& world, const std::string& name) {
    for (const Json& t : world.at("things"))
      if (t.value("name", "") == name) return t.at("id");
    ADD_FAILURE() << "no thing " << name;
    return 0;
  }
};

}  // namespace viewer_test
