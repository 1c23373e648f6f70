/* SPDX-License-Identifier: MIT
 * Calendar and processor time for programs written for Webots' interfaces, which call srand(time(NULL)). Simulated
 * seconds from a moment that is made of the robot's seed: other robots and other seeds have other moments, and
 * a run repeats. In other firmware both count cycles.
 */
#include <time.h>
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_virtual.h"
#include "motor_led/e_epuck_ports.h"

time_t time(time_t *to)
{
  time_t now = (time_t)tp_virtual_calendar_s();
  if (to) *to = now;
  return now;
}

double difftime(time_t later, time_t earlier) { return (double)(later - earlier); }

clock_t clock(void) { return (clock_t)(tp_now() * CLOCKS_PER_SEC / (tp_i64)FCY); }
