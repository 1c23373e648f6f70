/* SPDX-License-Identifier: MIT
 * Where versions from R2021 on have webots/robot_wwi.h.
 */
#include <webots/robot_wwi.h>
