/* SPDX-License-Identifier: MIT
 * The window that robots have by default. There is none: nothing happens.
 */
#ifndef WBU_DEFAULT_ROBOT_WINDOW_H
#define WBU_DEFAULT_ROBOT_WINDOW_H

#include <webots/robot_wwi.h>

TP_C_BEGIN

void wbu_default_robot_window_configure(void);
void wbu_default_robot_window_update(void);
void wbu_default_robot_window_set_images_max_size(int max_width, int max_height);

TP_C_END

#endif
