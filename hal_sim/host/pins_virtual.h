/* SPDX-License-Identifier: MIT
 * What exists only in the simulator: the console, packets between robots, devices that tell the truth, and
 * sensors that a supervisor defines. Programs written for Webots' interfaces use it (firmware/webots/); the
 * robot's own library does not. Conventions as in pins.h; texts end with 0, numbers with a fraction are
 * 32-bit floats at addresses.
 */
#ifndef TWINPUCK_HOST_PINS_VIRTUAL_H
#define TWINPUCK_HOST_PINS_VIRTUAL_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Text for the simulator's console; takes no time. Write. */
void tp_virtual_console(const char* bytes, tp_i64 length);

/** Settings of [webots]: time step in us; speed unit in rad/s at `unit`, 0 the usual one; 1 when sensors are
 * numbered as in the lab; 1 when axes are nue. Horizon: none. */
tp_i64 tp_virtual_time_step_us(void);
void tp_virtual_speed_unit(tp_f32* unit);
tp_i64 tp_virtual_lab_order(void);
tp_i64 tp_virtual_nue(void);
/** The robot's name, cut to `size` characters with the 0. */
void tp_virtual_robot_name(char* name, tp_i64 size);
/** Seconds of a calendar that begins at a moment of the robot's own, made of its seed. Horizon: now. */
tp_i64 tp_virtual_calendar_s(void);

/** Memory of the robot's own outside its data, for a heap; always the same address for the same size. */
char* tp_virtual_heap(tp_i64 bytes);

/** Device `index` from 0 of those that [[robot.device]] lists, and its name: 0 there is none, or a kind. */
tp_i64 tp_virtual_device(tp_i64 index, char* name, tp_i64 size);
#define TP_DEVICE_GPS 1
#define TP_DEVICE_COMPASS 2
#define TP_DEVICE_INERTIAL 3
#define TP_DEVICE_GYRO 4
#define TP_DEVICE_EMITTER 5
#define TP_DEVICE_RECEIVER 6
#define TP_DEVICE_DISTANCE 7
#define TP_DEVICE_DISPLAY 8

/** Value of the sensor that a supervisor defined under that name; 0: it has not. Horizon: now. */
tp_i64 tp_virtual_sensor(const char* name, tp_f32* value);

/** Truth, three numbers each, axes of the world file; m, m/s, unit vector, rad (roll, pitch, yaw), rad/s.
 * Horizon: now. */
void tp_virtual_position(tp_f32* xyz, tp_f32* velocity);
void tp_virtual_north(tp_f32* xyz);
void tp_virtual_attitude(tp_f32* angles);
void tp_virtual_rates(tp_f32* xyz);
/** The same for a robot or object with that name or def, in world axes: position (an object's middle) and
 * heading (of a nue world the angle about its y axis). 0: nothing of the name. */
tp_i64 tp_virtual_find(const char* name);
void tp_virtual_pose_of(tp_i64 found, tp_f32* xyz, tp_f32* angle);

/** Key `index` from 0 of those that are down on the keyboard, by Webots' number; 0: there is none. Horizon:
 * now. */
tp_i64 tp_virtual_key(tp_i64 index);

/** Files of the robot's own (board/robot_files.h). Open: a handle from 1; 0, and a line on the console: not
 * to be had. Others: bytes or place, -1 for a failure. Take no time. Writes. */
tp_i64 tp_file_open(const char* name, const char* mode);
void tp_file_close(tp_i64 file);
tp_i64 tp_file_read(tp_i64 file, void* to, tp_i64 bytes);
tp_i64 tp_file_write(tp_i64 file, const void* from, tp_i64 bytes);
void tp_file_flush(tp_i64 file);
/** `from` as of fseek(): 0 beginning, 1 here, 2 end; the place from the beginning. */
tp_i64 tp_file_seek(tp_i64 file, tp_i64 offset, tp_i64 from);
tp_i64 tp_file_remove(const char* name);

/** Displays by their number among [[robot.device]] (board/displays.h); others than displays do nothing. Take
 * no time. Writes. Pictures by number from 1, 0 for none and for the whole display. */
tp_i64 tp_display_width(tp_i64 display);
tp_i64 tp_display_height(tp_i64 display);
void tp_display_colour(tp_i64 display, tp_i64 rgb);
void tp_display_solid(tp_i64 display, tp_i64 alpha_percent, tp_i64 opacity_percent);
/** Lines from point to point, or the inside of a polygon. */
void tp_display_shape(tp_i64 display, tp_i64 filled, const short* x, const short* y, tp_i64 points);
tp_i64 tp_display_copy(tp_i64 display, tp_i64 x, tp_i64 y, tp_i64 width, tp_i64 height);
tp_i64 tp_display_make(tp_i64 display, tp_i64 width, tp_i64 height, const void* bytes, tp_i64 format);
void tp_display_paste(tp_i64 display, tp_i64 image, tp_i64 x, tp_i64 y, tp_i64 blend);
void tp_display_remove(tp_i64 display, tp_i64 image);
/** 1 when it was written. */
tp_i64 tp_display_save(tp_i64 display, tp_i64 image, const char* name);

/** Emitters and receivers by number from 0; -1 when there is none of the name. */
tp_i64 tp_emitter_find(const char* name);
/** 1, or 0 when the queue is full. Write. */
tp_i64 tp_emitter_send(tp_i64 emitter, const void* data, tp_i64 bytes);
tp_i64 tp_emitter_channel(tp_i64 emitter);
void tp_emitter_set_channel(tp_i64 emitter, tp_i64 channel);
/** m; negative: unlimited. */
void tp_emitter_range(tp_i64 emitter, tp_f32* range);
void tp_emitter_set_range(tp_i64 emitter, const tp_f32* range);

tp_i64 tp_receiver_find(const char* name);
void tp_receiver_switch(tp_i64 receiver, tp_i64 on);
/** What has arrived becomes visible. Write. */
void tp_receiver_latch(tp_i64 receiver);
/** Visible packets; size and address of the first, 0 and null without one; strength and direction (unit, in
 * the robot's axes of the world file). The address holds until the packet is dropped. */
tp_i64 tp_receiver_visible(tp_i64 receiver);
tp_i64 tp_receiver_size(tp_i64 receiver);
const void* tp_receiver_data(tp_i64 receiver);
void tp_receiver_origin(tp_i64 receiver, tp_f32* strength, tp_f32* direction);
void tp_receiver_drop(tp_i64 receiver);
tp_i64 tp_receiver_channel(tp_i64 receiver);
void tp_receiver_set_channel(tp_i64 receiver, tp_i64 channel);

#ifdef __cplusplus
}
#endif
#endif
