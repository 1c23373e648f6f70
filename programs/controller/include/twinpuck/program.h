/* SPDX-License-Identifier: MIT
 * What libcontroller has beside Webots' interfaces.
 *
 * A program's calendar: libcontroller has a time() of its own. It counts simulated seconds from a moment made
 * of the robot's seed (between 2001-09-09 and three years later), so that srand(time(NULL)) gives each robot
 * and each --seed its own numbers, and a run repeats. clock_gettime() and gettimeofday() tell the PC's time.
 *
 * On SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT the simulator is told where the program was, unless the
 * program has a handler of its own; then the program dies of the signal.
 */
#ifndef TWINPUCK_PROGRAM_H
#define TWINPUCK_PROGRAM_H

#include <webots/types.h>

TP_C_BEGIN

/** Who links the library, for the simulator's messages: 0 C, 1 C++, 2 Python, 3 Java (which keeps its own
 * handlers of signals); and the program's name, null: the process's. Before wb_robot_init(). */
void twinpuck_language(int language, const char* program);

/** Blocks from wb_robot_step_begin() until wb_robot_step_end() would not have to wait. 1: it would not; 0: a
 * signal came. It changes nothing, so other threads may call the library meanwhile, one at a time. */
int twinpuck_wait(void);

TP_C_END

#endif
