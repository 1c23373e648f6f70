/* SPDX-License-Identifier: MIT
 * The robot itself, its clock and its list of devices, as Webots' controllers know them, on the e-puck's
 * library.
 *
 * wb_robot_init() starts the library: ports, agendas, motors, ADC scan. All functions below need it. Only
 * wb_robot_init() and wb_robot_step() block.
 * Sensors hold the value they had at the end of the last step; see docs/webots.md.
 * Supervisor programs (docs/supervisor.md) include this header too.
 */
#ifndef WB_ROBOT_H
#define WB_ROBOT_H

#define WB_USING_C_API
#include "nodes.h"
#include "types.h"

typedef enum { WB_MODE_SIMULATION = 0, WB_MODE_CROSS_COMPILATION, WB_MODE_REMOTE_CONTROL } WbRobotMode;

typedef enum {
  WB_EVENT_QUIT = -1,
  WB_EVENT_NO_EVENT = 0,
  WB_EVENT_MOUSE_CLICK = 1,
  WB_EVENT_MOUSE_MOVE = 2,
  WB_EVENT_KEYBOARD = 4,
  WB_EVENT_JOYSTICK_BUTTON = 8,
  WB_EVENT_JOYSTICK_AXIS = 16,
  WB_EVENT_JOYSTICK_POV = 32
} WbUserInputEvent;

typedef void* WbMutexRef;

TP_C_BEGIN

/** Starts the library and the clock. Blocks for about 0.2 s, until the ADC scan has filled its buffers.
 *  Repeating it does nothing. Returns 1. */
int wb_robot_init(void);

/** Waits for the end of the next step and samples the sensors that are due. Steps are multiples of
 *  `duration` ms (1 to 32767) since the step before; a program that took longer than a step skips what it
 *  missed. 0 samples nothing and returns at once. Returns 0; -1 at the end of the simulation, which firmware
 *  does not live to see. Blocks for up to `duration`. */
int wb_robot_step(int duration);

/** The two halves of wb_robot_step(): the first remembers `duration` (ms), the second waits. */
int wb_robot_step_begin(int duration);
int wb_robot_step_end(void);

/** Nothing is left to do: the program ends when main() returns. Wheels keep their speed. */
void wb_robot_cleanup(void);

/** Seconds since wb_robot_init(), by the robot's clock: the sum of all steps. */
double wb_robot_get_time(void);

/** Name of the robot in the world; "e-puck" on the robot. */
const char* wb_robot_get_name(void);

/** "GCtronic e-puck". */
const char* wb_robot_get_model(void);

/** A text the program may keep, up to 63 characters; empty at the start. */
const char* wb_robot_get_custom_data(void);
void wb_robot_set_custom_data(const char* data);
const char* wb_robot_get_data(void);
void wb_robot_set_data(const char* data);

/** WB_MODE_SIMULATION in the simulator, WB_MODE_CROSS_COMPILATION on the robot. Setting it does nothing. */
WbRobotMode wb_robot_get_mode(void);
void wb_robot_set_mode(WbRobotMode mode, const char* arg);

/** Always 1: world and program wait for each other. */
bool wb_robot_get_synchronization(void);

/** 1: programs may look at the world through webots/supervisor.h; 0 on the robot. */
bool wb_robot_get_supervisor(void);

/** Folders do not exist for firmware: empty texts. */
const char* wb_robot_get_project_path(void);
const char* wb_robot_get_world_path(void);
const char* wb_robot_get_controller_name(void);

/** The world's time step, ms: the key time_step of [webots]; 32 on the robot. */
double wb_robot_get_basic_time_step(void);

/** The device of that name, and a warning on the console and 0 when there is none. Names: docs/webots.md. */
WbDeviceTag wb_robot_get_device(const char* name);

/** Devices of this robot and the one of index 0 to n-1; 0 beyond. */
int wb_robot_get_number_of_devices(void);
WbDeviceTag wb_robot_get_device_by_index(int index);

/** WB_NODE_ROBOT. */
WbNodeType wb_robot_get_type(void);

/** Battery. Period in ms. Value: charge left in J by the voltage, revision 1.3 only; NaN elsewhere, and
 * before the first period is over. */
void wb_robot_battery_sensor_enable(int sampling_period);
void wb_robot_battery_sensor_disable(void);
int wb_robot_battery_sensor_get_sampling_period(void);
double wb_robot_battery_sensor_get_value(void);

/* --- programs of the PC */

/** Nobody is at a window: WB_EVENT_NO_EVENT, at once. */
WbUserInputEvent wb_robot_wait_for_user_input_event(WbUserInputEvent event_type, int timeout);
/** There is no URDF: an empty text, and a warning. */
const char* wb_robot_get_urdf(const char* prefix);
/** Does nothing. */
void wb_robot_pin_to_static_environment(bool pin);
/** A thread, and locks for threads. Only one thread at a time may call functions of this interface. */
void wb_robot_task_new(void (*task)(void*), void* param);
WbMutexRef wb_robot_mutex_new(void);
void wb_robot_mutex_lock(WbMutexRef mutex);
void wb_robot_mutex_unlock(WbMutexRef mutex);
void wb_robot_mutex_delete(WbMutexRef mutex);

/* names of versions 5 to 8 */
void wb_robot_live(void (*reset)(void));
void wb_robot_run(int (*run)(int));
void wb_robot_keyboard_enable(int ms);
void wb_robot_keyboard_disable(void);
long wb_robot_keyboard_get_key(void);

/** Writes to the simulator's console, as printf() does; nothing on the robot. */
#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
void wb_robot_console_printf(const char *format, ...);

TP_C_END

#include "keyboard.h"

#endif
