// SPDX-License-Identifier: MIT
// The life cycle, clock, devices and keyboard of supervisor programs, in both interfaces. Nobody presses
// keys.
#include <device/robot.h>
#include <webots/device.h>
#include <webots/robot.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "supervisor/webots/shared.h"

namespace webots {
unsigned short find_device(const char* name);
const char* device_name(unsigned short tag);
bool device_receives(unsigned short tag);
int device_count();

namespace {

void (*at_end)() = nullptr;
std::string custom_data;
int begun_ms = 0;

/// robot_run(): calls `run` until the run is over, and does not come back.
[[noreturn]] void run_for_ever(int (*run)(int)) {
  for (int elapsed_ms = 0;;) {
    const int basic_ms = static_cast<int>(sv_webots_time_step() * 1000 + 0.5);
    int ms = run(elapsed_ms);
    if (ms <= 0) ms = basic_ms;
    if (!step(ms)) break;
    elapsed_ms = ms;
  }
  if (at_end) at_end();
  std::exit(0);
}

void print(const char* format, va_list arguments) {
  std::string text(1024, '\0');
  text.resize(static_cast<std::size_t>(std::vsnprintf(text.data(), text.size(), format, arguments)) <
                      text.size()
                  ? std::string(text.c_str()).size()
                  : text.size());
  std::string shown;
  for (char c : text)
    if (c != '\f') shown += c;  // it cleared Webots' console
  std::fputs(shown.c_str(), stdout);
  std::fflush(stdout);
}

}  // namespace
}  // namespace webots

extern "C" {

// --- since 2008

int wb_robot_init(void) { return 1; }
int wb_robot_step(int duration) { return webots::step(duration) ? 0 : -1; }
int wb_robot_step_begin(int duration) {
  webots::begun_ms = duration;
  return 0;
}
int wb_robot_step_end(void) { return wb_robot_step(webots::begun_ms); }
void wb_robot_cleanup(void) {}
double wb_robot_get_time(void) { return webots::time_s(); }
const char* wb_robot_get_name(void) { return sv_name(); }
const char* wb_robot_get_model(void) { return ""; }
const char* wb_robot_get_custom_data(void) { return webots::custom_data.c_str(); }
void wb_robot_set_custom_data(const char* data) { webots::custom_data = data ? data : ""; }
const char* wb_robot_get_data(void) { return wb_robot_get_custom_data(); }
void wb_robot_set_data(const char* data) { wb_robot_set_custom_data(data); }
WbRobotMode wb_robot_get_mode(void) { return WB_MODE_SIMULATION; }
void wb_robot_set_mode(WbRobotMode, const char*) {}
bool wb_robot_get_synchronization(void) { return true; }
bool wb_robot_get_supervisor(void) { return true; }
const char* wb_robot_get_project_path(void) { return ""; }
const char* wb_robot_get_world_path(void) { return ""; }
const char* wb_robot_get_controller_name(void) { return sv_name(); }
double wb_robot_get_basic_time_step(void) { return 1000 * sv_webots_time_step(); }
WbDeviceTag wb_robot_get_device(const char* name) { return webots::find_device(name); }
int wb_robot_get_number_of_devices(void) { return webots::device_count(); }
WbDeviceTag wb_robot_get_device_by_index(int index) {
  return index >= 0 && index < webots::device_count() ? static_cast<WbDeviceTag>(index + 1) : WbDeviceTag{0};
}
WbNodeType wb_robot_get_type(void) { return WB_NODE_ROBOT; }
void wb_robot_live(void (*reset)(void)) {
  if (reset) reset();
}
void wb_robot_run(int (*run)(int)) { webots::run_for_ever(run); }

const char* wb_device_get_name(WbDeviceTag tag) { return webots::device_name(tag); }
const char* wb_device_get_model(WbDeviceTag tag) { return webots::device_name(tag); }
WbNodeType wb_device_get_node_type(WbDeviceTag tag) {
  return tag == 0 ? WB_NODE_NO_NODE : webots::device_receives(tag) ? WB_NODE_RECEIVER : WB_NODE_EMITTER;
}
WbNodeType wb_device_get_type(WbDeviceTag tag) { return wb_device_get_node_type(tag); }

void wb_keyboard_enable(int) {}
void wb_keyboard_disable(void) {}
int wb_keyboard_get_sampling_period(void) { return 0; }
long wb_keyboard_get_key(void) { return -1; }
void wb_robot_keyboard_enable(int) {}
void wb_robot_keyboard_disable(void) {}
long wb_robot_keyboard_get_key(void) { return 0; }

void wb_robot_console_printf(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  webots::print(format, arguments);
  va_end(arguments);
}

// --- 2005

void robot_live(void (*reset)(void)) {
  if (reset) reset();
}
void robot_run(int (*run)(int)) { webots::run_for_ever(run); }
void robot_die(void (*die)(void)) { webots::at_end = die; }
int robot_step(int ms) {
  if (ms == 0) return 0;
  return webots::step(ms) ? 0 : -1;
}
DeviceTag robot_get_device(const char* name) { return webots::find_device(name); }
const char* robot_get_name(void) { return sv_name(); }
double robot_get_time(void) { return webots::time_s(); }
int robot_get_mode(void) { return ROBOT_MODE_SIMULATION; }
int robot_get_synchronization(void) { return 1; }
double robot_get_basic_time_step(void) { return 1000 * sv_webots_time_step(); }
const char* robot_get_project_path(void) { return ""; }
void robot_keyboard_enable(int) {}
void robot_keyboard_disable(void) {}
long robot_keyboard_get_key(void) { return 0; }
void robot_console_printf(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  webots::print(format, arguments);
  va_end(arguments);
}
}
