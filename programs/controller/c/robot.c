/* SPDX-License-Identifier: MIT
 * The robot itself: its clock, its names, its battery, LEDs, and the console.
 */
#define _GNU_SOURCE
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "programs/controller/c/library.h"

double wb_robot_get_time(void) {
  session_ready();
  return (double)(session.time_ns / 1000) / 1e6; /* whole us: a sum of ms prints as such */
}
double wb_robot_get_basic_time_step(void) {
  session_ready();
  return session.basic_step_ms;
}

/* --- names */

static const char* text(char* const* what) {
  session_ready();
  return *what ? *what : "";
}
const char* wb_robot_get_name(void) { return text(&session.robot); }
const char* wb_robot_get_model(void) { return text(&session.model); }
const char* wb_robot_get_project_path(void) { return text(&session.project); }
const char* wb_robot_get_world_path(void) { return text(&session.world); }
const char* wb_robot_get_custom_data(void) { return text(&session.custom); }
const char* wb_robot_get_data(void) { return wb_robot_get_custom_data(); }
void wb_robot_set_data(const char* data) { wb_robot_set_custom_data(data); }

void wb_robot_set_custom_data(const char* data) {
  char* copy = copy_text(data ? data : "", data ? strlen(data) : 0);
  session_ready();
  free(session.custom);
  session.custom = copy;
  link_text(command(LINK_SET_CUSTOM), copy);
  command_end();
}

/* the folder's name is the controller's */
const char* wb_robot_get_controller_name(void) {
  static char name[NAME_MAX + 1];
  char folder[PATH_MAX];
  if (!name[0] && getcwd(folder, sizeof folder)) snprintf(name, sizeof name, "%s", strrchr(folder, '/') + 1);
  return name;
}

WbRobotMode wb_robot_get_mode(void) { return WB_MODE_SIMULATION; }
void wb_robot_set_mode(WbRobotMode mode, const char* arg) {
  (void)arg;
  if (mode != WB_MODE_SIMULATION) WARN("wb_robot_set_mode(): got mode %d, expected 0, the simulation", (int)mode);
}
bool wb_robot_get_synchronization(void) { return true; }
bool wb_robot_get_supervisor(void) {
  session_ready();
  return session.supervisor;
}
WbNodeType wb_robot_get_type(void) { return WB_NODE_ROBOT; }
const char* wb_robot_get_urdf(const char* prefix) {
  (void)prefix;
  WARN("wb_robot_get_urdf(): there is no URDF of this robot");
  return "";
}
void wb_robot_pin_to_static_environment(bool pin) { (void)pin; }

/* nobody is at a window: no event comes */
WbUserInputEvent wb_robot_wait_for_user_input_event(WbUserInputEvent event_type, int timeout) {
  (void)event_type, (void)timeout;
  session_ready();
  return WB_EVENT_NO_EVENT;
}

/* --- LEDs */

void wb_led_set(WbDeviceTag tag, long value) {
  struct device* d = device_of(tag, WB_NODE_LED, "wb_led_set");
  struct link_packet* out;
  if (!d) return;
  d->count = (int)value;
  out = command(LINK_LED);
  link_int(out, tag);
  link_int(out, (int)value);
  command_end();
}
int wb_led_get(WbDeviceTag tag) {
  const struct device* d = device_of(tag, WB_NODE_LED, "wb_led_get");
  return d ? d->count : 0;
}

/* --- battery */

static struct device* battery(void) {
  struct device* d = hidden_device("battery");
  if (!d) WARN("the battery sensor: this robot has no battery to ask");
  return d;
}
void wb_robot_battery_sensor_enable(int sampling_period) { device_enable(battery(), sampling_period); }
void wb_robot_battery_sensor_disable(void) { device_enable(battery(), 0); }
int wb_robot_battery_sensor_get_sampling_period(void) {
  const struct device* d = battery();
  return d ? d->period : 0;
}
double wb_robot_battery_sensor_get_value(void) {
  return device_value(battery(), "wb_robot_battery_sensor_get_value");
}

/* --- the console */

void wb_robot_console_printf(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vprintf(format, arguments);
  va_end(arguments);
  fflush(stdout);
}

void wb_console_print(const char* what, int stream) {
  FILE* to = stream == WB_STDERR ? stderr : stdout;
  if (what) fputs(what, to);
  fflush(to);
}

/* --- threads: the library itself is for one at a time */

struct task {
  void (*run)(void*);
  void* with;
};
static void* run_task(void* given) {
  struct task task = *(struct task*)given;
  free(given);
  task.run(task.with);
  return 0;
}
void wb_robot_task_new(void (*run)(void*), void* param) {
  struct task* task = grow(0, sizeof *task);
  pthread_t thread;
  task->run = run;
  task->with = param;
  if (pthread_create(&thread, 0, run_task, task) == 0)
    pthread_detach(thread);
  else
    WARN("wb_robot_task_new(): the system gives no thread");
}
WbMutexRef wb_robot_mutex_new(void) {
  pthread_mutex_t* mutex = grow(0, sizeof *mutex);
  pthread_mutex_init(mutex, 0);
  return mutex;
}
void wb_robot_mutex_lock(WbMutexRef mutex) {
  if (mutex) pthread_mutex_lock(mutex);
}
void wb_robot_mutex_unlock(WbMutexRef mutex) {
  if (mutex) pthread_mutex_unlock(mutex);
}
void wb_robot_mutex_delete(WbMutexRef mutex) {
  if (mutex) pthread_mutex_destroy(mutex);
  free(mutex);
}

/* --- names of versions 5 to 8 */

void wb_robot_live(void (*reset)(void)) {
  session_ready();
  if (reset) reset();
}
void wb_robot_run(int (*run)(int)) { robot_run(run); }
