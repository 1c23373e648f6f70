/* SPDX-License-Identifier: MIT
 * Seam B as the e_* API sees it: pins, counts and time of the robot whose firmware is running. The API knows no
 * world. All quantities are tp_i64 (see image_abi.h). Cycles are instruction cycles of this robot's clock since
 * its last power-up (FCY = 14,745,600 Hz nominal).
 *
 * "Horizon": functions that read something say until when the value cannot change by itself; the host collects
 * the earliest of these to jump over polling loops. Functions that change something count as a write.
 *
 * What the real library's interrupt handlers do by themselves (motor steps, ADC scan, UART bytes) is evaluated
 * in closed form on the host's side, in hal_sim/board; results equal the ticked evaluation exactly.
 */
#ifndef TWINPUCK_HOST_PINS_H
#define TWINPUCK_HOST_PINS_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/* --- time ------------------------------------------------------------------------------------------------- */
/** Cycles now. Horizon: now (it always changes). */
tp_i64 tp_now(void);
/** Spends `cycles` here: the body of a library function whose own cost is known. Interrupts are delivered. */
void tp_spend(tp_i64 cycles);
/** Waits until the cycle `at` (returns at once when past); interrupts are delivered meanwhile. */
void tp_wait_until(tp_i64 at);

/* --- interrupts the API installs --------------------------------------------------------------------------- */
/** `handler` serves `vector` (natural order, TP_V_*) at `priority` 1..7; handler 0 disables it. entry_cycles: cost of entry,
 *  context saving and RETFIE. */
void tp_irq_install(tp_i64 vector, void (*handler)(void), tp_i64 priority, tp_i64 entry_cycles);
/** The vector's flag rises at cycle `at` (replaces an earlier request); at < 0 cancels. */
void tp_irq_at(tp_i64 vector, tp_i64 at);
#define TP_V_INT0 0
#define TP_V_T1 3
#define TP_V_T2 6
#define TP_V_T3 7
#define TP_V_U1RX 9
#define TP_V_U1TX 10
#define TP_V_ADC 11
#define TP_V_MI2C 14
#define TP_V_T4 21
#define TP_V_T5 22
#define TP_V_U2RX 24
#define TP_V_U2TX 25
#define TP_V_DCI 41

/** Work of a closed-form interrupt handler that steals `cost` cycles every `period` cycles from the program.
 *  slot 0..15 (TP_BG_*); cost 0 ends it. */
void tp_background(tp_i64 slot, tp_i64 period, tp_i64 cost);
#define TP_BG_AGENDA 0
#define TP_BG_ADC 1
#define TP_BG_MOTOR_LEFT 2
#define TP_BG_MOTOR_RIGHT 3
#define TP_BG_PROX 4
#define TP_BG_UART1 5
#define TP_BG_UART2 6

/* Further functions (motors, ADC scan, LEDs, UART, selector, battery) are declared in their own sections below
   by the board room; each states unit, horizon and source. */

#ifdef __cplusplus
}
#endif
#endif
