/* SPDX-License-Identifier: MIT
 * The keyboard, by either interface: the simulator's. Empty on the robot, which has none.
 */
#ifdef __TWINPUCK_PC__
#include "core.h"
#include "device/robot.h"
#include "webots/keyboard.h"
#include "webots/robot.h"

static int keyboard_period;
static int next_key;              /* of those that are down, since the last step */
static unsigned long asked_in_ms; /* the step in which a key was asked for last */

/* each key that is down once a step; then `none`, which was 0 in versions 5 to 8 */
static long key(long none) {
  int found;
  if (asked_in_ms != webots_time_ms()) next_key = 0;
  asked_in_ms = webots_time_ms();
  found = keyboard_period > 0 ? twin_key(next_key) : 0;
  if (!found) return none;
  next_key++;
  return found;
}

void wb_keyboard_enable(int sampling_period) { keyboard_period = sampling_period; }
void wb_keyboard_disable(void) { keyboard_period = 0; }
int wb_keyboard_get_sampling_period(void) { return keyboard_period; }
long wb_keyboard_get_key(void) { return key(-1); }
void wb_robot_keyboard_enable(int ms) { keyboard_period = ms; }
void wb_robot_keyboard_disable(void) { keyboard_period = 0; }
long wb_robot_keyboard_get_key(void) { return key(0); }

void robot_keyboard_enable(int ms) { keyboard_period = ms; }
void robot_keyboard_disable(void) { keyboard_period = 0; }
long robot_keyboard_get_key(void) { return key(0); }
#endif
