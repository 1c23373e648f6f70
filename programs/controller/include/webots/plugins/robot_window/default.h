/* SPDX-License-Identifier: MIT
 * Where versions from R2021 on have webots/utils/default_robot_window.h.
 */
#include <webots/utils/default_robot_window.h>
