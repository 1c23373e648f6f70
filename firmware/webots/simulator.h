/* SPDX-License-Identifier: MIT
 * What the library behind webots/ and device/ takes from the simulator: settings of the world, the console, and
 * devices that no e-puck has. Implemented in hal_sim/api/webots_simulator.c.
 * On the robot a program of 2005 has the settings of the lab's worlds and others the usual ones, and text goes to
 * UART 1; display.c, keyboard.c, truth.c and world.c are empty there, so a program that needs them does not link.
 */
#ifndef WEBOTS_SIMULATOR_H
#define WEBOTS_SIMULATOR_H

#include "twinpuck.h"

enum twin_kind {
  TWIN_NONE,
  TWIN_GPS,
  TWIN_COMPASS,
  TWIN_INERTIAL,
  TWIN_GYRO,
  TWIN_EMITTER,
  TWIN_RECEIVER,
  TWIN_DISTANCE,
  TWIN_DISPLAY
};

#ifdef __TWINPUCK_PC__

/** [webots] of the world: ms; rad/s a unit, 0 for the usual one; whether sensors are numbered as in the lab; whether
 *  axes are nue. */
double twin_time_step_ms(void);
float twin_speed_unit(void);
int twin_lab_order(void);
int twin_nue(void);
void twin_robot_name(char* name, int size);

/** Device `index` of [[robot.device]] and its name; TWIN_NONE beyond. */
int twin_device(int index, char* name, int size);

/** Value of a sensor that a supervisor defined; 0: it has not. */
int twin_virtual_sensor(const char* name, float* value);

/** Key `index` of those that are down on the keyboard; 0: none. */
int twin_key(int index);

/** Truth, three numbers each; m, m/s, unit vector, rad, rad/s in the world file's axes. */
void twin_position(float* xyz, float* velocity);
void twin_north(float* xyz);
void twin_attitude(float* angles);
void twin_rates(float* xyz);

/** A robot or object by def or name, 0 for none; its place and its angle about the upward axis. */
int twin_find(const char* name);
void twin_pose_of(int found, float* xyz, float* angle);

/** Displays by their number among the devices; negative: nothing happens. As in pins_virtual.h. */
int twin_display_width(int display);
int twin_display_height(int display);
void twin_display_colour(int display, long rgb);
void twin_display_solid(int display, int alpha_percent, int opacity_percent);
void twin_display_shape(int display, int filled, const int* x, const int* y, int points);
int twin_display_copy(int display, int x, int y, int width, int height);
int twin_display_make(int display, int width, int height, const void* bytes, int format);
void twin_display_paste(int display, int image, int x, int y, int blend);
void twin_display_remove(int display, int image);
int twin_display_save(int display, int image, const char* name);

/** Ends of packets, by number; -1 for none of the name. */
int twin_emitter_find(const char* name);
int twin_emitter_send(int emitter, const void* data, int bytes);
int twin_emitter_channel(int emitter);
void twin_emitter_set_channel(int emitter, int channel);
float twin_emitter_range(int emitter);
void twin_emitter_set_range(int emitter, float range);
int twin_receiver_find(const char* name);
void twin_receiver_switch(int receiver, int on);
void twin_receiver_latch(int receiver);
int twin_receiver_visible(int receiver);
int twin_receiver_size(int receiver);
const void* twin_receiver_data(int receiver);
float twin_receiver_origin(int receiver, float* direction);
void twin_receiver_drop(int receiver);
int twin_receiver_channel(int receiver);
void twin_receiver_set_channel(int receiver, int channel);

#else

/** Whether the program began with robot_live(), of 2005. */
int webots_is_of_2005(void);
void webots_begin_2005(void);

extern const float webots_world_speed_unit;
extern const int webots_world_lab_order, webots_world_nue, webots_world_step_ms;

/* rad/s a unit, as worlds/obstacle.toml has it */
#define OF_2005_SPEED_UNIT 0.1f
#define twin_time_step_ms() ((double)webots_world_step_ms)
#define twin_speed_unit()                                  \
  (webots_world_speed_unit > 0   ? webots_world_speed_unit \
   : webots_is_of_2005() ? OF_2005_SPEED_UNIT              \
                         : 0.0f)
#define twin_lab_order() (webots_world_lab_order >= 0 ? webots_world_lab_order : webots_is_of_2005())
#define twin_nue() webots_world_nue
#define twin_robot_name(name, size) ((void)(size), (name)[0] = 0)
#define twin_virtual_sensor(name, value) 0

#endif

#endif
