/* SPDX-License-Identifier: MIT
 * Keyboard, mouse and joystick. Keys come from the command; nobody has a mouse or a joystick.
 */
#include <math.h>
#include <string.h>

#include "programs/controller/c/library.h"

/* --- keyboard */

#define MOST_KEYS 8

static int keys[MOST_KEYS], key_count, key_at;
static int keyboard_period;

static void enable(int period) {
  struct device* d = hidden_device("keyboard");
  keyboard_period = period > 0 ? period : 0;
  if (keyboard_period == 0) key_count = 0;
  device_enable(d, keyboard_period);
}

void take_keys(const struct link_record* record) {
  size_t i, count = record->lists[0].count;
  key_count = key_at = 0;
  for (i = 0; i < count && key_count < MOST_KEYS; i++) keys[key_count++] = (int)record->lists[0].values[i];
}

/* a sample is for the step that brought it */
void keyboard_step(void) { key_count = key_at = 0; }

long next_key(long none) {
  session_ready();
  if (keyboard_period == 0) WARN("the keyboard is not enabled, expected wb_keyboard_enable() before");
  return key_at < key_count ? keys[key_at++] : none;
}

void wb_keyboard_enable(int sampling_period) { enable(sampling_period); }
void wb_keyboard_disable(void) { enable(0); }
int wb_keyboard_get_sampling_period(void) { return keyboard_period; }
long wb_keyboard_get_key(void) { return next_key(-1); }
void wb_robot_keyboard_enable(int ms) { enable(ms); }
void wb_robot_keyboard_disable(void) { enable(0); }
long wb_robot_keyboard_get_key(void) { return next_key(0); }

/* --- mouse: it is nowhere */

static int mouse_period;
static bool mouse_3d;

void wb_mouse_enable(int sampling_period) { mouse_period = sampling_period > 0 ? sampling_period : 0; }
void wb_mouse_disable(void) { mouse_period = 0; }
int wb_mouse_get_sampling_period(void) { return mouse_period; }
void wb_mouse_enable_3d_position(void) { mouse_3d = true; }
void wb_mouse_disable_3d_position(void) { mouse_3d = false; }
bool wb_mouse_is_3d_position_enabled(void) { return mouse_3d; }
WbMouseState* wb_mouse_get_state_pointer(void) {
  static WbMouseState state;
  memset(&state, 0, sizeof state);
  state.u = state.v = state.x = state.y = state.z = NAN;
  return &state;
}
WbMouseState wb_mouse_get_state(void) { return *wb_mouse_get_state_pointer(); }

/* --- joystick: none is connected */

static int joystick_period;

void wb_joystick_enable(int sampling_period) { joystick_period = sampling_period > 0 ? sampling_period : 0; }
void wb_joystick_disable(void) { joystick_period = 0; }
int wb_joystick_get_sampling_period(void) { return joystick_period; }
bool wb_joystick_is_connected(void) { return false; }
const char* wb_joystick_get_model(void) { return 0; }
int wb_joystick_get_number_of_axes(void) { return 0; }
int wb_joystick_get_axis_value(int axis) { return (void)axis, 0; }
int wb_joystick_get_number_of_povs(void) { return 0; }
int wb_joystick_get_pov_value(int pov) { return (void)pov, 0; }
int wb_joystick_get_pressed_button(void) { return -1; }
void wb_joystick_set_constant_force(int level) { (void)level; }
void wb_joystick_set_constant_force_duration(double duration) { (void)duration; }
void wb_joystick_set_auto_centering_gain(double gain) { (void)gain; }
void wb_joystick_set_resistance_gain(double gain) { (void)gain; }
void wb_joystick_set_force_axis(int axis) { (void)axis; }
