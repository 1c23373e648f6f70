// SPDX-License-Identifier: MIT
// The functions of pins_bluetooth.h.
#include "hal_sim/board/board.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_bluetooth.h"

extern "C" {

void tp_uart_break(tp_i64 number, tp_i64 cycles) {
  host::Context& context = host::Context::current();
  context.board().uart(number == 2 ? 2 : 1).send_break(cycles > 0 ? cycles : 0, context.now());
  context.irq_at(number == 2 ? TP_V_U2TX : TP_V_U1TX, -1);
  context.note_write();
}

}  // extern "C"
