/* SPDX-License-Identifier: MIT
 * Firmware libc: where printf() of programs written for Webots' interfaces goes. It takes the place of the host's
 * function of that name, which writes to UART 1. */
#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/pins_virtual.h"

void tp_console(const char *bytes, tp_i64 length, tp_i64 uart) { tp_virtual_console(bytes, length); }
