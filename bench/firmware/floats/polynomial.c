/* SPDX-License-Identifier: MIT
 * Polynomials of three terms, in a file of their own, so they are called.
 */
#include "polynomial.h"

static const float offset[4] = {0.25f, -1.5f, 2.0f, 0.125f};
static const float slope[4] = {1.5f, 0.75f, -0.5f, 3.0f};
static const float bend[4] = {-0.125f, 0.5f, 0.0625f, -0.25f};

float polynomial(int which, float x)
{
  return offset[which] + x * (slope[which] + x * bend[which]);
}
