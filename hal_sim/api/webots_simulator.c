/* SPDX-License-Identifier: MIT
 * What exists only in the simulator, for the library in firmware/webots: numbers of the seam (pins_virtual.h) to
 * those of the robot's C.
 */
#include "firmware/webots/simulator.h"

#include "hal_sim/host/pins_virtual.h"

double twin_time_step_ms(void) { return (double)tp_virtual_time_step_us() / 1000; }

float twin_speed_unit(void) {
  float unit;
  tp_virtual_speed_unit(&unit);
  return unit;
}

int twin_lab_order(void) { return (int)tp_virtual_lab_order(); }
int twin_nue(void) { return (int)tp_virtual_nue(); }
void twin_robot_name(char* name, int size) { tp_virtual_robot_name(name, size); }
int twin_device(int index, char* name, int size) { return (int)tp_virtual_device(index, name, size); }
int twin_virtual_sensor(const char* name, float* value) { return (int)tp_virtual_sensor(name, value); }
int twin_key(int index) { return (int)tp_virtual_key(index); }

int twin_display_width(int display) { return (int)tp_display_width(display); }
int twin_display_height(int display) { return (int)tp_display_height(display); }
void twin_display_colour(int display, long rgb) { tp_display_colour(display, rgb); }
void twin_display_solid(int display, int alpha, int opacity) { tp_display_solid(display, alpha, opacity); }
void twin_display_shape(int display, int filled, const int* x, const int* y, int points) {
  tp_display_shape(display, filled, (const short*)x, (const short*)y, points);
}
int twin_display_copy(int display, int x, int y, int width, int height) {
  return (int)tp_display_copy(display, x, y, width, height);
}
int twin_display_make(int display, int width, int height, const void* bytes, int format) {
  return (int)tp_display_make(display, width, height, bytes, format);
}
void twin_display_paste(int display, int image, int x, int y, int blend) {
  tp_display_paste(display, image, x, y, blend);
}
void twin_display_remove(int display, int image) { tp_display_remove(display, image); }
int twin_display_save(int display, int image, const char* name) {
  return (int)tp_display_save(display, image, name);
}

void twin_position(float* xyz, float* velocity) { tp_virtual_position(xyz, velocity); }
void twin_north(float* xyz) { tp_virtual_north(xyz); }
void twin_attitude(float* angles) { tp_virtual_attitude(angles); }
void twin_rates(float* xyz) { tp_virtual_rates(xyz); }
int twin_find(const char* name) { return (int)tp_virtual_find(name); }
void twin_pose_of(int found, float* xyz, float* angle) { tp_virtual_pose_of(found, xyz, angle); }

int twin_emitter_find(const char* name) { return (int)tp_emitter_find(name); }
int twin_emitter_send(int emitter, const void* data, int bytes) { return (int)tp_emitter_send(emitter, data, bytes); }
int twin_emitter_channel(int emitter) { return (int)tp_emitter_channel(emitter); }
void twin_emitter_set_channel(int emitter, int channel) { tp_emitter_set_channel(emitter, channel); }

float twin_emitter_range(int emitter) {
  float range;
  tp_emitter_range(emitter, &range);
  return range;
}

void twin_emitter_set_range(int emitter, float range) { tp_emitter_set_range(emitter, &range); }

int twin_receiver_find(const char* name) { return (int)tp_receiver_find(name); }
void twin_receiver_switch(int receiver, int on) { tp_receiver_switch(receiver, on); }
void twin_receiver_latch(int receiver) { tp_receiver_latch(receiver); }
int twin_receiver_visible(int receiver) { return (int)tp_receiver_visible(receiver); }
int twin_receiver_size(int receiver) { return (int)tp_receiver_size(receiver); }
const void* twin_receiver_data(int receiver) { return tp_receiver_data(receiver); }

float twin_receiver_origin(int receiver, float* direction) {
  float strength;
  tp_receiver_origin(receiver, &strength, direction);
  return strength;
}

void twin_receiver_drop(int receiver) { tp_receiver_drop(receiver); }
int twin_receiver_channel(int receiver) { return (int)tp_receiver_channel(receiver); }
void twin_receiver_set_channel(int receiver, int channel) { tp_receiver_set_channel(receiver, channel); }
