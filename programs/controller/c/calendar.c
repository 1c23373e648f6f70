/* SPDX-License-Identifier: MIT
 * time() for programs: simulated seconds from a moment that is made of the robot's seed. Programs seed their random
 * numbers with it, and a run must repeat.
 */
#define _GNU_SOURCE
#include <stdlib.h>

#include "programs/controller/c/library.h"

#define FIRST_S 1000000000LL /* 2001-09-09 */
#define SPAN_S (3LL * 365 * 86400)

/* mixes the bits of a seed [splitmix64] */
static uint64_t mixed(uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

time_t time(time_t* to) {
  time_t now;
  const char* where = session.state == SESSION_NONE ? getenv("TWINPUCK_CONTROLLER") : 0;
  if (where && *where) session_begin(); /* srand(time(NULL)) stands before wb_robot_init() */
  if (session.state == SESSION_NONE) {
    struct timespec wall;
    clock_gettime(CLOCK_REALTIME, &wall);
    now = wall.tv_sec;
  } else {
    now = (time_t)(FIRST_S + (int64_t)(mixed((uint64_t)session.seed) % SPAN_S) + session.time_ns / 1000000000);
  }
  if (to) *to = now;
  return now;
}
