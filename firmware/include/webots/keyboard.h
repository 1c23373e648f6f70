/* SPDX-License-Identifier: MIT
 * Keys that somebody presses, which the command says (`--key`, docs/webots.md).
 */
#ifndef WB_KEYBOARD_H
#define WB_KEYBOARD_H

#include "types.h"

enum {
  WB_KEYBOARD_END = 312,
  WB_KEYBOARD_HOME,
  WB_KEYBOARD_LEFT,
  WB_KEYBOARD_UP,
  WB_KEYBOARD_RIGHT,
  WB_KEYBOARD_DOWN,
  WB_KEYBOARD_PAGEUP = 366,
  WB_KEYBOARD_PAGEDOWN,
  WB_KEYBOARD_NUMPAD_HOME = 375,
  WB_KEYBOARD_NUMPAD_LEFT,
  WB_KEYBOARD_NUMPAD_UP,
  WB_KEYBOARD_NUMPAD_RIGHT,
  WB_KEYBOARD_NUMPAD_DOWN,
  WB_KEYBOARD_NUMPAD_END = 382
};
#define WB_KEYBOARD_KEY 0x0000ffffL
#define WB_KEYBOARD_SHIFT 0x00010000L
#define WB_KEYBOARD_CONTROL 0x00020000L
#define WB_KEYBOARD_ALT 0x00040000L

/* names of versions 5 to 8 */
#define WB_ROBOT_KEYBOARD_END WB_KEYBOARD_END
#define WB_ROBOT_KEYBOARD_HOME WB_KEYBOARD_HOME
#define WB_ROBOT_KEYBOARD_LEFT WB_KEYBOARD_LEFT
#define WB_ROBOT_KEYBOARD_UP WB_KEYBOARD_UP
#define WB_ROBOT_KEYBOARD_RIGHT WB_KEYBOARD_RIGHT
#define WB_ROBOT_KEYBOARD_DOWN WB_KEYBOARD_DOWN
#define WB_ROBOT_KEYBOARD_PAGEUP WB_KEYBOARD_PAGEUP
#define WB_ROBOT_KEYBOARD_PAGEDOWN WB_KEYBOARD_PAGEDOWN
#define WB_ROBOT_KEYBOARD_KEY WB_KEYBOARD_KEY
#define WB_ROBOT_KEYBOARD_SHIFT WB_KEYBOARD_SHIFT
#define WB_ROBOT_KEYBOARD_CONTROL WB_KEYBOARD_CONTROL
#define WB_ROBOT_KEYBOARD_ALT WB_KEYBOARD_ALT

TP_C_BEGIN

/** Period in ms. */
void wb_keyboard_enable(int sampling_period);
void wb_keyboard_disable(void);
int wb_keyboard_get_sampling_period(void);

/** Next key that is down, once a step each; -1: no more. Keys are those of `--key ROBOT=keyboard:UP@TIME`
 * (docs/webots.md): letters as capitals, arrows as above. The robot has no keyboard: it does not link there. */
long wb_keyboard_get_key(void);

TP_C_END

#endif
