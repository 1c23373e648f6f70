/* SPDX-License-Identifier: MIT
 * S16 of the lab, solved: the ball falls from 10 cm above the middle.
 */
#define KICK_OFF_M 0.10
#include "../soccer/soccer.c"
