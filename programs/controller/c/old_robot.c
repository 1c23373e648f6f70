/* SPDX-License-Identifier: MIT
 * The interface of 2005 to 2008: the robot itself, over the present one.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "programs/controller/c/library.h"

static void (*die_function)(void);

void robot_live(void (*reset)(void)) { wb_robot_live(reset); }
void robot_die(void (*die)(void)) { die_function = die; }

/* Until the end of the run, which is the program's end too. */
void robot_run(int (*run)(int ms)) {
  int passed = 0;
  session_ready();
  for (;;) {
    int next = run(passed);
    if (wb_robot_step(next > 0 ? next : (int)session.basic_step_ms) < 0) break;
    passed = (int)session.passed_ms;
  }
  if (die_function) die_function();
  wb_robot_cleanup();
  exit(0);
}

int robot_step(int ms) {
  int result = wb_robot_step(ms);
  if (result < 0 && die_function) {
    void (*die)(void) = die_function;
    die_function = 0;
    die();
  }
  return result;
}

DeviceTag robot_get_device(const char* name) { return find_device(name, "robot_get_device"); }
const char* robot_get_name(void) { return wb_robot_get_name(); }
double robot_get_time(void) { return wb_robot_get_time(); }
int robot_get_mode(void) { return wb_robot_get_mode(); }
int robot_get_synchronization(void) { return wb_robot_get_synchronization(); }
double robot_get_basic_time_step(void) { return wb_robot_get_basic_time_step(); }
const char* robot_get_project_path(void) { return wb_robot_get_project_path(); }

void robot_console_printf(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  fflush(stdout);
}

void robot_keyboard_enable(int ms) { wb_keyboard_enable(ms); }
void robot_keyboard_disable(void) { wb_keyboard_disable(); }
long robot_keyboard_get_key(void) { return next_key(0); }

void robot_battery_sensor_enable(int ms) { wb_robot_battery_sensor_enable(ms); }
void robot_battery_sensor_disable(void) { wb_robot_battery_sensor_disable(); }
float robot_battery_sensor_get_value(void) {
  double value = wb_robot_battery_sensor_get_value();
  return isnan(value) ? 0 : (float)value;
}
