/* SPDX-License-Identifier: MIT
 * What a mouse says, for C and C++.
 */
#ifndef WB_MOUSE_STATE_H
#define WB_MOUSE_STATE_H

#include <webots/types.h>

typedef struct {
  bool left, middle, right;
  double u, v;    /* on the window, 0 to 1; NaN outside */
  double x, y, z; /* m, what it points at; NaN where it is nothing */
} WbMouseState;

#endif
