/* SPDX-License-Identifier: MIT
 * How a function of the contract says that its device is not simulated yet: it exists, so that programs link, and
 * its first call stops the robot with a sentence that names it. No such function ever returns a made-up value.
 *
 * Weak, so that a project with its own driver keeps its own.
 * scripts/check_contract.py reads these lines and lists them in docs/limits.md.
 */
#ifndef TWINPUCK_API_UNSIMULATED_H
#define TWINPUCK_API_UNSIMULATED_H

#include "hal_sim/host/image_abi.h"

/** `type name arguments` traps; DEVICE names what is missing and must be defined by the file. */
#define UNSIMULATED(type, name, arguments)                                                          \
  __attribute__((weak)) type name arguments {                                                       \
    tp_trap_message(TP_TRAP_UNSIMULATED, #name ": the " DEVICE " is not simulated yet");            \
    return (type)0;                                                                                 \
  }

/** The same for functions without a result. */
#define UNSIMULATED_VOID(name, arguments)                                                           \
  __attribute__((weak)) void name arguments {                                                       \
    tp_trap_message(TP_TRAP_UNSIMULATED, #name ": the " DEVICE " is not simulated yet");            \
  }

/** The same for functions that return a structure. */
#define UNSIMULATED_STRUCT(type, name, arguments)                                                   \
  __attribute__((weak)) type name arguments {                                                       \
    type none = {0};                                                                                \
    tp_trap_message(TP_TRAP_UNSIMULATED, #name ": the " DEVICE " is not simulated yet");            \
    return none;                                                                                    \
  }

#endif
