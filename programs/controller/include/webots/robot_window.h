/* SPDX-License-Identifier: MIT
 * The robot's window, in a library of its own. There is none: NULL.
 */
#ifndef WB_ROBOT_WINDOW_H
#define WB_ROBOT_WINDOW_H

#include <webots/types.h>

TP_C_BEGIN

void* wb_robot_window_custom_function(void* argument);

TP_C_END

#endif
