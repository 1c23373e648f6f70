/* SPDX-License-Identifier: MIT
 * What a supervisor may do: a program of the PC, in C or C++, that belongs to the world and to no robot. It
 * sees and changes everything between two ticks, alone, so a run with it repeats exactly.
 *
 *     #include <supervisor.h>
 *     int main(void) {
 *       int robot = sv_find("alice");
 *       struct sv_pose pose;
 *       while (sv_step(0.1) > 0) {
 *         sv_get_pose(robot, &pose);
 *         if (pose.x > 1) sv_end(0, "alice is there after %.1f s", sv_time());
 *       }
 *       return 0;
 *     }
 *
 * Units: m, rad, s, V, W/m2; x east, y north, z up, headings counter-clockwise from +x. Things are robots and
 * objects (boxes, cylinders, balls, polygons) of the world file, each known by a number: robots from 0 on,
 * then objects, both in the file's order. Nothing blocks but sv_step(). Unless said otherwise a function
 * returns 0, or -1 after a mistake of the caller's, which is told once on stderr and kept for sv_error().
 *
 * Returned texts belong to Twinpuck and stay until the next call that returns a text. docs/supervisor.md is
 * the guide. Prefix sv_: the 2005 interface of other simulators owns supervisor_*. */
#ifndef TWINPUCK_SUPERVISOR_H
#define TWINPUCK_SUPERVISOR_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SV_NONE (-1) /* no such thing */
#define SV_ALL (-2)  /* every robot, where a function allows it */

#if defined(__GNUC__)
#define SV_PRINTF(text, first) __attribute__((format(printf, text, first)))
#else
#define SV_PRINTF(text, first)
#endif

/* --- time, chance, the end ------------------------------------------------------------------------------ */

/** Lets the world go on for `seconds`, at least one tick, at most up to the end of the run; 0: up to
 *  this program's next period (the world file's `period`, one tick if it says nothing). Returns the seconds
 * that have passed, or -1 when the run is over: the program has one more go, in which it may look and write
 * files, and should return from main. */
double sv_step(double seconds);
/** Simulated time since the world began, s. */
double sv_time(void);
/** Length of a tick, s. */
double sv_tick(void);
/** Period of this program, s. */
double sv_period(void);
/** Time step and axes (0 ENU, 1 NUE) that the world's [webots] gives to programs written for Webots; s. */
double sv_webots_time_step(void);
int sv_webots_axes(void);
/** Another period for sv_step(0), s; 0: every tick. */
int sv_set_period(double seconds);
/** Uniform in [0, 1), made of the world's seed and this program's place in the world: the same in every run.
 */
double sv_random(void);
/** Normal with mean 0 and standard deviation 1. */
double sv_random_normal(void);
/** The run is over when this program next steps or returns. `code` 0: passed; 1: failed (the command's exit
 *  code). The text, printf-like, is shown. The first call of all supervisors counts. */
void sv_end(int code, const char* format, ...) SV_PRINTF(2, 3);
/** A line on stderr with this program's name and the time; printf-like. */
void sv_log(const char* format, ...) SV_PRINTF(1, 2);
/** What was last wrong, "" if nothing. */
const char* sv_error(void);
/** Name of this supervisor; title and seed of the world. */
const char* sv_name(void);
const char* sv_title(void);
uint64_t sv_seed(void);

/* --- things ----------------------------------------------------------------------------------------------
 */

struct sv_pose {
  double x, y;    /* m */
  double z;       /* m, height of its underside */
  double heading; /* rad, not wrapped */
};

struct sv_velocity {
  double x, y; /* m/s, world frame */
  double z;    /* m/s, upwards */
  double spin; /* rad/s, counter-clockwise */
};

/** Number of the thing whose `def`, or else `name`, is that; SV_NONE without a message when there is none. */
int sv_find(const char* name);
/** How many robots; they are the things 0 to sv_robots() - 1. */
int sv_robots(void);
/** How many things. */
int sv_things(void);
/** Name of a thing as the world file has it; "" when it has none. */
const char* sv_thing_name(int thing);
/** From its underside to its top, m. */
double sv_height(int thing);
/** What the world file says that the robot runs; "" for nothing. */
const char* sv_firmware(int robot);
/** 1: it can move (robots and movable objects). */
int sv_is_movable(int thing);

int sv_get_pose(int thing, struct sv_pose* pose);
int sv_get_velocity(int thing, struct sv_velocity* velocity);
/** Puts a movable thing somewhere else, at rest. Above the floor an object falls; a robot stands on the floor
 *  whatever z says. */
int sv_set_pose(int thing, const struct sv_pose* pose);
/** Sets a movable thing going; it loses the speed again as physics wants. Engines without forces ignore all
 * but z. */
int sv_set_velocity(int thing, const struct sv_velocity* velocity);
/** Back to where it stood when the world began, at rest. Firmware goes on; see sv_restart(). Both at the same
 *  instant, in any order: the robot begins as when the world began, its steps and its noise as well; done to
 *  all robots that run programs, the world takes its first course again (docs/supervisor.md). */
int sv_reset(int thing);
/** Presses the robot's reset button: its program begins anew with its start-up values, also after a trap.
 *  Traps stay in the report. SV_ALL: every robot. */
int sv_restart(int robot);
/** Red, green, blue, 0 to 1. Proximity sensors then see the red part, whatever the material said before. */
int sv_set_colour(int thing, double red, double green, double blue);
int sv_get_colour(int thing, double rgb[3]);

/* --- the world's settings --------------------------------------------------------------------------------
 */

struct sv_lamp {
  int on;           /* 0 dark */
  double intensity; /* W/m2, on a surface that faces it, before attenuation; 0 to 10000 */
  double x, y, z;   /* m */
};

/** Number of the lamp of that name; SV_NONE when there is none. */
int sv_find_lamp(const char* name);
int sv_lamps(void);
int sv_get_lamp(int lamp, struct sv_lamp* state);
int sv_set_lamp(int lamp, const struct sv_lamp* state);
/** Factor on the noise of the proximity sensors' lookup tables, 0 to 1000; 0: none. robot or SV_ALL. */
int sv_set_proximity_noise(int robot, double scale);
/** Each wheel's way is multiplied by a number drawn between 1 - n and 1 + n, 0 to 1. robot or SV_ALL. */
int sv_set_wheel_noise(int robot, double n);

/* --- robots' devices -------------------------------------------------------------------------------------
 */

/** Counts of proximity sensor 0 to 7 as firmware's library gives them, dark minus lit. No robot or no such
 *  sensor: 0, and a message. So do the others below. */
int sv_proximity(int robot, int sensor);
/** Motor steps since power-up, forward positive; 1000 are one turn of the wheel. */
int64_t sv_left_steps(int robot);
int64_t sv_right_steps(int robot);
/** Bits 0 to 7 the ring, 8 body, 9 front. */
unsigned sv_leds(int robot);
/** Position of the selector, 0 to 15. */
int sv_selector(int robot);
int sv_set_selector(int robot, int position);
/** Voltage at the battery's terminals, V. */
double sv_battery(int robot);
/** 3.0 to 4.2 V. */
int sv_set_battery(int robot, double volts);
/** Way over the floor since the world began, m; moves by hand do not count. */
double sv_distance(int robot);
/** Touches begun since the world began. */
int sv_collisions(int robot);
/** Longest touch of a wall so far, s. */
double sv_longest_wall_touch(int robot);
/** Share of its cycles that the processor did not spend waiting, 0 to 1. */
double sv_cpu_load(int robot);
/** Traps and unexpected resets so far; the text of one, "" when there is none of that number. */
int sv_traps(int robot);
const char* sv_trap(int robot, int number);

/* --- firmware's variables --------------------------------------------------------------------------------
 */

/** Value of a variable of the robot's firmware by name, through the image's debug information: any integer,
 *  char, enum, bool, bit-field, pointer or floating number. `expression`: `count`, `speed[1]`, `state.mode`,
 *  `grid[2][3].x`; `main.c:count` for a static of one file, `tick:count` for a static inside function tick().
 */
int sv_get_variable(int robot, const char* expression, double* value);
/** Changes it as a debugger would; a firmware that waits looks again. Values are cut to the variable's width.
 */
int sv_set_variable(int robot, const char* expression, double value);
/** The bytes of a variable, array or struct, in the robot's layout (int is 2 bytes, little endian; pointers
 * are the PC's). Copies at most `size`; returns how many bytes the variable has, -1 when there is none. */
int sv_read_variable(int robot, const char* expression, void* to, int size);
/** Overwrites its first `size` bytes. */
int sv_write_variable(int robot, const char* expression, const void* from, int size);

/* --- virtual sensors, messages ---------------------------------------------------------------------------
 */

/** Defines or changes a sensor that the robot does not have; its firmware reads the number by this name from
 * the next tick on. robot or SV_ALL. */
int sv_set_sensor(int robot, const char* name, double value);

struct sv_message {
  int channel;
  int robot;        /* who sent it; SV_NONE: another supervisor */
  int size;         /* bytes */
  const void* data; /* until the next sv_receive() or sv_step() */
  double time;      /* s, when it arrived */
};

/** Messages are the packets of the robots' emitters and receivers. */
#define SV_ALL_CHANNELS (-1)
/** From now on packets on `channel` are kept for sv_receive(); SV_ALL_CHANNELS: all. May be called for
 * several. */
int sv_listen(int channel);
/** Sends to every receiver on `channel`, wherever it is; it arrives at the end of the next tick. */
int sv_send(int channel, const void* data, int size);
/** The oldest packet that is waiting. Returns 1, or 0 when there is none. */
int sv_receive(struct sv_message* message);
/** How many are waiting. */
int sv_waiting(void);

/* --- what it keeps and shows -----------------------------------------------------------------------------
 */

/** Notes where a thing is every `seconds` from now on (0: every tick). Call it again to begin anew. */
int sv_track(int thing, double seconds);
/** Way along the notes so far, m, moves by sv_set_pose() and sv_reset() left out. */
double sv_track_length(int thing);
/** How many notes. */
int sv_track_points(int thing);
/** One note; time in s. */
int sv_track_point(int thing, int index, double* time, struct sv_pose* pose);
/** All tracks as CSV: time_s,thing,x_m,y_m,z_m,heading_rad, one row a note, thing by thing. */
int sv_save_tracks(const char* file);
/** The world as it is now, with the tracks' ways, as PNG or SVG by the file's ending. */
int sv_picture(const char* file);
/** Text laid over sv_picture() and the command's --picture: left and top edge as fractions of the picture,
 *  size: height of a line as a fraction of its height, rgb 0xRRGGBB, transparency 0 solid to 1. A later label
 * of the same id replaces it; an empty text takes it away. */
int sv_label(int id, const char* text, double x, double y, double size, uint32_t rgb, double transparency);

#ifdef __cplusplus
}
#endif
#endif
