/* SPDX-License-Identifier: MIT
 * The robot itself and its clock, as Webots' controllers of 2005 to 2008 (versions 5.x) know them. The present
 * interface is webots/robot.h, which says more; a program may use either.
 *
 * robot_live() begins, as wb_robot_init() does. Only robot_live(), robot_run() and robot_step() block. Sensors hold
 * the value they had at the end of the last step; see docs/webots.md. Source: programs of that time, and the change
 * log of versions 5.
 */
#ifndef DEVICE_ROBOT_H
#define DEVICE_ROBOT_H

#include "robot_types.h"

#define ROBOT_MODE_SIMULATION 0
#define ROBOT_MODE_CROSS_COMPILATION 1
#define ROBOT_MODE_REMOTE_CONTROL 2

#define ROBOT_KEYBOARD_END 312
#define ROBOT_KEYBOARD_HOME 313
#define ROBOT_KEYBOARD_LEFT 314
#define ROBOT_KEYBOARD_UP 315
#define ROBOT_KEYBOARD_RIGHT 316
#define ROBOT_KEYBOARD_DOWN 317
#define ROBOT_KEYBOARD_PAGEUP 366
#define ROBOT_KEYBOARD_PAGEDOWN 367
#define ROBOT_KEYBOARD_KEY 0x0000ffffL
#define ROBOT_KEYBOARD_SHIFT 0x00010000L
#define ROBOT_KEYBOARD_CONTROL 0x00020000L
#define ROBOT_KEYBOARD_ALT 0x00040000L

TP_C_BEGIN

/** Begins, then calls `reset` (may be null) once. */
void robot_live(void (*reset)(void));

/** Calls `run` until the run is over; then what robot_die() was given, and the program ends with status 0. The
 *  argument of `run` is the time since its call before, ms (0 the first time); its result the time until its next
 *  call, ms, 1 to 32767 (0 or less: one world time step). Does not return. */
void robot_run(int (*run)(int ms));

/** `die` is called at the end of the run, which the robot does not live to see. */
void robot_die(void (*die)(void));

/** As wb_robot_step(): the world goes on for `ms`, and sensors that are due are sampled. 0 returns at once. Returns
 *  0; -1 when the run is over. */
int robot_step(int ms);

/** The device of that name, and a warning on the console and 0 when there is none. Names: docs/webots.md. */
DeviceTag robot_get_device(const char* name);

/** Name of the robot in the world; "e-puck" on the robot. */
const char* robot_get_name(void);

/** Seconds since the program began: the sum of all steps. */
double robot_get_time(void);

/** ROBOT_MODE_SIMULATION in the simulator, ROBOT_MODE_CROSS_COMPILATION on the robot. */
int robot_get_mode(void);

/** Always 1: world and program wait for each other. */
int robot_get_synchronization(void);

/** The world's time step, ms: the key time_step of [webots]; 32 on the robot. */
double robot_get_basic_time_step(void);

/** The project's folder; empty on the robot. */
const char* robot_get_project_path(void);

/** Writes to the simulator's console, formatted as printf() does; nothing on the robot. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void robot_console_printf(const char *format, ...);

/** Keys that are down, once a step each (`--key`, docs/webots.md); 0: no more. Period in ms. */
void robot_keyboard_enable(int ms);
void robot_keyboard_disable(void);
long robot_keyboard_get_key(void);

/** Battery, period in ms. J left, 0 before the first period is over. On the robot by the voltage, revision 1.3 only. */
void robot_battery_sensor_enable(int ms);
void robot_battery_sensor_disable(void);
float robot_battery_sensor_get_value(void);

TP_C_END

#endif
