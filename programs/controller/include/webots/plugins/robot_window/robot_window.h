/* SPDX-License-Identifier: MIT
 * Where versions from R2021 on have webots/robot_window.h.
 */
#include <webots/robot_window.h>
