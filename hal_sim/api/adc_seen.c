/* SPDX-License-Identifier: MIT
 * What the compiler calls before a controller looks at the ADC driver's public variables (hal_sim/cc/
 * driver_arrays.cpp). They bring them to where the interrupt would have left them, and cost nothing: on the
 * robot that work is the interrupt's, which is charged by itself. Names with tp_image_ are not counted.
 * A program whose scan was never started keeps its variables.
 */
#include "hal.h"
#include "hal_sim/host/pins_sound.h"

#define ACC_COUNTER_MAX 64
#define TICK_COUNTER_MAX 65535u

void tp_image_see_counters(void);
void tp_image_see_mic_index(void);
void tp_image_see_mic(void);
void tp_image_see_acc_index(void);
void tp_image_see_acc(void);
void tp_image_see_ir(void);

void tp_image_see_counters(void) {
  unsigned long interrupts, news;
  if (!tp_scan_starts()) return;
  interrupts = (unsigned long)tp_scan_interrupts();
  news = interrupts - twinpuck_interrupts_seen;
  twinpuck_interrupts_seen = interrupts;
  tickAdcIsr = news > TICK_COUNTER_MAX - tickAdcIsr ? TICK_COUNTER_MAX : tickAdcIsr + (unsigned int)news;
  updateAccI2CCounter = news + updateAccI2CCounter > ACC_COUNTER_MAX
                            ? ACC_COUNTER_MAX
                            : (unsigned char)(updateAccI2CCounter + (unsigned int)news);
}

void tp_image_see_mic_index(void) {
  if (!tp_scan_starts()) return;
  tp_scan_interrupts(); /* until the next one the index stays */
  e_last_mic_scan_id = (unsigned int)tp_scan_mic_index();
}

void tp_image_see_mic(void) {
  if (!tp_scan_starts()) return;
  twinpuck_mic_filed = (unsigned long)tp_mic_scan(e_mic_scan, twinpuck_mic_filed);
  e_last_mic_scan_id = (unsigned int)tp_scan_mic_index();
}

void tp_image_see_acc_index(void) {
  if (tp_scan_starts()) e_last_acc_scan_id = (unsigned int)tp_scan_acc_index_until_next();
}

void tp_image_see_acc(void) {
  if (tp_scan_starts()) tp_scan_acc_values(e_acc_scan);
}

void tp_image_see_ir(void) {
  if (tp_scan_starts()) tp_scan_ir_values(e_ambient_ir, e_ambient_and_reflected_ir);
}
