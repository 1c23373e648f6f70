/* SPDX-License-Identifier: MIT
 * The robot itself, by either interface.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core.h"
#include "device/robot.h"
#include "utility/utility.h"
#include "webots/console.h"
#include "webots/device.h"
#include "webots/robot.h"

#define FULL_BATTERY_J 18000.0f /* 5 Wh [e-puck.org] */
#define CUSTOM_SIZE 64

static int step_begun;              /* ms, between wb_robot_step_begin() and its end */
static char custom_data[CUSTOM_SIZE];
static struct webots_device* battery; /* null until a program wants it */

static int step(int ms) {
  webots_step(ms);
  return 0;
}

static const char* name(void) { return "e-puck"; }

/* sums of whole ms; a float counts them to 16,777 s */
static double seconds(void) { return (double)webots_time_ms() / 1000; }

static double basic_step(void) { return twin_time_step_ms(); }

static void run_for_ever(int (*run)(int)) {
  int passed = 0;
  webots_init();
  for (;;) {
    int next = run(passed);
    passed = webots_step(next > 0 ? next : (int)basic_step());
  }
}

static void live(void (*reset)(void)) {
  webots_init();
  if (reset) reset();
}

static void sample_battery(struct webots_device* device) {
  int percent = (int)getBatteryValuePercentage(); /* below 0 when nearly empty */
  device->value = percent > 0 ? FULL_BATTERY_J / 100 * percent : 0;
}

static void enable_battery(int period) {
  webots_init();
  if (!battery) battery = webots_add("", WB_NODE_NO_NODE, 1, WEBOTS_ROBOT);
  if (battery) webots_enable(battery, period, sample_battery);
}

static int mode(void) {
  return WB_MODE_CROSS_COMPILATION;
}

static void write_text(const char* format, va_list list) { vprintf(format, list); }

/* --- webots/robot.h */

int wb_robot_init(void) {
  webots_init();
  return 1;
}
int wb_robot_step(int duration) { return step(duration); }
int wb_robot_step_begin(int duration) {
  step_begun = duration;
  return 0;
}
int wb_robot_step_end(void) { return step(step_begun); }
void wb_robot_cleanup(void) {}
double wb_robot_get_time(void) { return seconds(); }
const char* wb_robot_get_name(void) { return name(); }
const char* wb_robot_get_model(void) { return "GCtronic e-puck"; }
const char* wb_robot_get_custom_data(void) { return custom_data; }
void wb_robot_set_custom_data(const char* data) { strncpy(custom_data, data, CUSTOM_SIZE - 1); }
const char* wb_robot_get_data(void) { return custom_data; }
void wb_robot_set_data(const char* data) { wb_robot_set_custom_data(data); }
WbRobotMode wb_robot_get_mode(void) { return (WbRobotMode)mode(); }
void wb_robot_set_mode(WbRobotMode wanted, const char* arg) { (void)wanted, (void)arg; }
bool wb_robot_get_synchronization(void) { return 1; }
bool wb_robot_get_supervisor(void) { return mode() == WB_MODE_SIMULATION; }
const char* wb_robot_get_project_path(void) { return ""; }
const char* wb_robot_get_world_path(void) { return ""; }
const char* wb_robot_get_controller_name(void) { return ""; }
double wb_robot_get_basic_time_step(void) { return basic_step(); }
WbDeviceTag wb_robot_get_device(const char* wanted) { return webots_find(wanted, "wb_robot_get_device"); }
WbNodeType wb_robot_get_type(void) { return WB_NODE_ROBOT; }

void wb_robot_battery_sensor_enable(int sampling_period) { enable_battery(sampling_period); }
void wb_robot_battery_sensor_disable(void) { enable_battery(0); }
int wb_robot_battery_sensor_get_sampling_period(void) { return battery ? battery->period : 0; }
double wb_robot_battery_sensor_get_value(void) {
  return battery && battery->fresh && getBatteryValueRaw() ? battery->value : NAN;
}

void wb_robot_live(void (*reset)(void)) { live(reset); }
void wb_robot_run(int (*run)(int)) { run_for_ever(run); }

/* --- console */

void wb_robot_console_printf(const char* format, ...) {
  va_list list;
  va_start(list, format);
  write_text(format, list);
  va_end(list);
}

void wb_console_print(const char* text, int stream) {
  (void)stream;
  wb_robot_console_printf("%s", text);
}

/* --- device/robot.h */

void robot_live(void (*reset)(void)) {
  webots_begin_2005();
  live(reset);
}
void robot_run(int (*run)(int ms)) { run_for_ever(run); }
void robot_die(void (*die)(void)) { (void)die; }
int robot_step(int ms) { return step(ms); }
DeviceTag robot_get_device(const char* wanted) { return webots_find(wanted, "robot_get_device"); }
const char* robot_get_name(void) { return name(); }
double robot_get_time(void) { return seconds(); }
int robot_get_mode(void) { return mode(); }
int robot_get_synchronization(void) { return 1; }
double robot_get_basic_time_step(void) { return basic_step(); }
const char* robot_get_project_path(void) { return ""; }

void robot_console_printf(const char* format, ...) {
  va_list list;
  va_start(list, format);
  write_text(format, list);
  va_end(list);
}

void robot_battery_sensor_enable(int ms) { enable_battery(ms); }
void robot_battery_sensor_disable(void) { enable_battery(0); }
float robot_battery_sensor_get_value(void) { return battery && battery->fresh ? battery->value : 0; }
