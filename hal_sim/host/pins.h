/* SPDX-License-Identifier: MIT
 * Seam B as the e_* API sees it: pins, counts and time of the robot whose firmware is running. The API knows
 * no world. All quantities are tp_i64 (see image_abi.h). Cycles are instruction cycles of this robot's clock
 * since its last power-up (FCY = 14,745,600 Hz nominal).
 *
 * "Horizon": functions that read something say until when the value cannot change by itself; the host
 * collects the earliest of these to jump over polling loops. Functions that change something count as a
 * write.
 *
 * What the real library's interrupt handlers do by themselves (motor steps, ADC scan, UART bytes) is
 * evaluated in closed form on the host's side, in hal_sim/board; results equal the ticked evaluation exactly.
 */
#ifndef TWINPUCK_HOST_PINS_H
#define TWINPUCK_HOST_PINS_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/* --- time --------------------------------------------------------------------------------------------- */
/** Cycles now. Horizon: now (it always changes). */
tp_i64 tp_now(void);
/** Spends `cycles` here: the body of a library function whose own cost is known. Interrupts are delivered. */
void tp_spend(tp_i64 cycles);
/** Waits until the cycle `at` (returns at once when past); interrupts are delivered meanwhile. */
void tp_wait_until(tp_i64 at);

/* --- interrupts the API installs ---------------------------------------------------------------------- */
/** `handler` serves `vector` (natural order, TP_V_*) at `priority` 1..7; handler 0 disables it. entry_cycles:
 * cost of entry, context saving and RETFIE. */
void tp_irq_install(tp_i64 vector, void (*handler)(void), tp_i64 priority, tp_i64 entry_cycles);
/** The vector's flag rises at cycle `at` (replaces an earlier request); at < 0 cancels. */
void tp_irq_at(tp_i64 vector, tp_i64 at);
/** The same at `first` and every `period` cycles from then on, as a timer does. */
void tp_irq_every(tp_i64 vector, tp_i64 first, tp_i64 period);
enum {
#define IRQ(id, name) TP_V_##name,
#define UNUSED_IRQ(bit, handler) TP_V_UNUSED##bit,
#include "dspic30/memory/irqs.inc"
};

/** Work of a closed-form interrupt handler that steals `cost` cycles every `period` cycles from the program.
 *  slot 0..15 (TP_BG_*); cost 0 ends it. */
void tp_background(tp_i64 slot, tp_i64 period, tp_i64 cost);
#define TP_BG_MOTOR_LEFT 2
#define TP_BG_MOTOR_RIGHT 3
#define TP_BG_PROX 4

/* --- board (implemented in host/board_exports.cpp on hal_sim/board) ----------------------------------- */
/* Wheels: 0 left, 1 right. Ports: 'A' 'B' 'C' 'D' 'F' 'G'. Answers are whole numbers; nothing here blocks. */

/** Latches and directions as e_init_port() leaves them. Write. Source: [lib: motor_led/e_init_port.c]. */
void tp_init_ports(void);
/** One latch bit, 0 or 1. Horizon: next change by a driver. */
tp_i64 tp_latch_read(tp_i64 port, tp_i64 bit);
/** Sets one latch bit to level & 1. Write. */
void tp_latch_write(tp_i64 port, tp_i64 bit, tp_i64 level);
/** e_set_led() of all LEDs was called with this number: for diagnoses, takes no time. */
void tp_note_led(tp_i64 led);
/** Pin levels of a port, 16 bits. Horizon: next change by a driver. */
tp_i64 tp_pins_read(tp_i64 port);
/** Coils A to D of a wheel in bits 0 to 3; the motor follows. Write. */
void tp_coils_write(tp_i64 wheel, tp_i64 coils);

/** Timer 2 starts from 0 / stops. Write. Source: [lib: motor_led/advance_one_timer/e_agenda.c]. */
void tp_agenda_start(void);
void tp_agenda_stop(void);
/** The list; a function is known by its address. Answers 1 done, 2 not found. Write. */
tp_i64 tp_agenda_activate(const void* function, tp_i64 cycle);
tp_i64 tp_agenda_destroy(const void* function);
tp_i64 tp_agenda_set_cycle(const void* function, tp_i64 cycle);
tp_i64 tp_agenda_reset(const void* function);
tp_i64 tp_agenda_pause(const void* function);
tp_i64 tp_agenda_restart(const void* function);
/** The Timer 2 interrupt: begin, then call what next answers until it answers null, then end. The interrupt
 * is requested only for ticks at which a callback is due. next traps when a motor divides by zero. */
void tp_agenda_begin(void);
const void* tp_agenda_next(void);
void tp_agenda_end(void);

/** `function` is run_left_motor or run_right_motor: its agenda is evaluated by the board. */
void tp_motor_agenda(tp_i64 wheel, const void* function);
/** Speed in steps/s as e_set_speed_left/right() of the agenda driver do it: coils off, clamped to +-1000.
 * Write. */
void tp_motor_speed(tp_i64 wheel, tp_i64 speed_steps_s);
/** One firing of the motor's agenda, now. Write. */
void tp_motor_run(tp_i64 wheel);
/** Steps commanded by the agenda driver since reset, forward positive, not wrapped. Horizon: next step. */
tp_i64 tp_motor_steps(tp_i64 wheel);

/** Drivers with their own timers: 0 basic (Timers 5 and 4), 1 Timer 3. Speed in steps/s. Write.
 *  Source: [lib: motor_led/e_motors.c], [lib: motor_led/e_motors_timer3.c]. */
void tp_timer_motor_speed(tp_i64 driver, tp_i64 wheel, tp_i64 speed_steps_s);
/** Steps commanded by such a driver since reset. Horizon: next step. */
tp_i64 tp_timer_motor_steps(tp_i64 driver, tp_i64 wheel);
/** Timer 3 starts with both speeds 0. Write. */
void tp_timer3_motors_start(void);

/** The converter and its interrupt start: three microphones only, or everything; five_pairs for selector 10.
 * Write. Source: [lib: a_d/advance_ad_scan/e_ad_conv.c]. */
void tp_scan_start(tp_i64 micro_only, tp_i64 five_pairs);
/** ADON off or on. Write. */
void tp_scan_switch(tp_i64 on);
/** Cycle at which the accelerometer index is 49 (where e_init_ad_scan() returns); now if it is. */
tp_i64 tp_scan_filled_at(void);
/** Interrupts since reset. Horizon: the next one. */
tp_i64 tp_scan_interrupts(void);
/** 1 between the interrupt that wrapped the microphone index and the next. Horizon: its next change. */
tp_i64 tp_scan_array_filled(void);
/** The driver's indices: next microphone sample 0 to 99, newest accelerometer sample 0 to 49. Horizon: none.
 */
tp_i64 tp_scan_mic_index(void);
tp_i64 tp_scan_acc_index(void);
/** Accelerometer samples since reset. Horizon: next interrupt. */
tp_i64 tp_scan_acc_samples(void);
/** Newest dark / lit sample of a sensor 0 to 9, counts 0 to 4095; 0 before the first. Horizon: the next of
 * either. */
tp_i64 tp_scan_dark(tp_i64 sensor);
tp_i64 tp_scan_lit(tp_i64 sensor);

/** All ten dark and lit samples at once, into two arrays of ten 16-bit words. Horizon: none. */
void tp_scan_values(void* dark, void* lit);

/** The basic proximity driver starts / stops. Write. Source: [lib: a_d/e_prox.c]. */
void tp_basic_prox_start(void);
void tp_basic_prox_stop(void);
/** T1CONbits.TON = 0 and = 1 as the basic accelerometer and microphone drivers set it: the proximity driver
 * stands still in between. The second starts it even after e_stop_prox(). Write.
 * Source: [lib: a_d/e_accelerometer.c]. */
void tp_basic_prox_hold(void);
void tp_basic_prox_release(void);
/** Its newest dark sample / dark minus lit of a sensor 0 to 7, counts. Horizon: its next interrupt. */
tp_i64 tp_basic_prox_ambient(tp_i64 sensor);
tp_i64 tp_basic_prox_reflected(tp_i64 sensor);
/** One conversion of input AN`channel` now, counts. */
tp_i64 tp_convert(tp_i64 channel);

/** UART `number` 1 or 2: enabled at BRG `brg`, the library's receive ring emptied. Write. Source: [lib:
 * uart/]. */
void tp_uart_init(tp_i64 number, tp_i64 brg);
/** Writes the transmit register (the byte is lost when the buffer is full or the UART is off) and requests
 * the transmit interrupt for the cycle at which the buffer is empty again. Write. */
void tp_uart_load(tp_i64 number, tp_i64 byte);
/** Library ring: bytes received minus bytes read, as 16 bits. Horizon: next byte known to be on the wire. */
tp_i64 tp_uart_unread(tp_i64 number);
/** Next byte 0 to 255 of the ring, or -1 when there is none. Horizon as above; taking one is a write. */
tp_i64 tp_uart_take(tp_i64 number);

/** 1 on hardware revision 1.3. */
tp_i64 tp_revision_1_3(void);
/** Battery as converted on AN7 of revision 1.3, counts; 0 on others. */
tp_i64 tp_battery_counts(void);

#ifdef __cplusplus
}
#endif
#endif
