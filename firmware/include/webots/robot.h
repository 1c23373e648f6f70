/* SPDX-License-Identifier: MIT
 * The robot itself, its clock and its list of devices, as Webots' controllers know them.
 *
 * In a program of the PC wb_robot_init() connects to the simulation, and the program's code takes no simulated time.
 * On the robot it starts the e-puck's library: ports, agendas, motors, ADC scan. Only wb_robot_init() and
 * wb_robot_step() block. Sensors hold the value they had at the end of the last step; see docs/webots.md.
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

/** Begins. Repeating it does nothing. Returns 1; a program of the PC that no simulation waits for ends here, with a
 *  message and status 1. On the robot it blocks for about 0.2 s, until the ADC scan has filled its buffers. */
int wb_robot_init(void);

/** What has been commanded is done, the world goes on for `duration` ms, and sensors that are due are sampled. 0 passes
 *  no time and returns at once. Returns 0; -1 when the run is over: the program may still ask and write files, and
 *  should end within a second; a program that steps once more ends there, with status 0.
 *  On the robot it waits for the end of the step: steps are multiples of `duration` ms (1 to 32767) since the step
 *  before, and a program that took longer than a step skips what it missed. */
int wb_robot_step(int duration);

/** The two halves of wb_robot_step(): the first says `duration` (ms), the second waits. Between them nothing can be
 *  asked. */
int wb_robot_step_begin(int duration);
int wb_robot_step_end(void);

/** Sends what has been commanded and leaves the simulation; the program should end soon. Wheels keep their speed. On
 *  the robot: nothing. */
void wb_robot_cleanup(void);

/** Seconds since the program began, simulated: the sum of all steps. On the robot by its clock. */
double wb_robot_get_time(void);

/** Name of the robot in the world; "e-puck" on the robot. */
const char* wb_robot_get_name(void);

/** "GCtronic e-puck". */
const char* wb_robot_get_model(void);

/** The robot's customData, which supervisors see and set as well. On the robot a text of its own, up to 63
 *  characters, empty at the start. Valid until the next step. */
const char* wb_robot_get_custom_data(void);
void wb_robot_set_custom_data(const char* data);
const char* wb_robot_get_data(void);
void wb_robot_set_data(const char* data);

/** WB_MODE_SIMULATION in the simulator, WB_MODE_CROSS_COMPILATION on the robot. Setting it does nothing. */
WbRobotMode wb_robot_get_mode(void);
void wb_robot_set_mode(WbRobotMode mode, const char* arg);

/** Always 1: world and program wait for each other. */
bool wb_robot_get_synchronization(void);

/** Whether the robot is a supervisor in the world (webots/supervisor.h); 0 on the robot. */
bool wb_robot_get_supervisor(void);

/** The project's folder, the world's file, the name of the controller's folder; empty on the robot. */
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

/** Battery. Period in ms. Value: charge left in J; NaN before the first period is over. On the robot by the voltage,
 *  revision 1.3 only; NaN elsewhere. */
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
