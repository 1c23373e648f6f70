/* SPDX-License-Identifier: MIT
 * The ADC scan, usual variant. Schedule and samples are the board's (hal_sim/board/adc_scan.h); see
 * hal.h for the driver's public variables.
 * Source: [lib: a_d/advance_ad_scan/e_ad_conv.c], facts restated.
 */
#include "hal.h"
#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins_sound.h"
#include "utility/utility.h"

#define GUMSTIX_POSITION 10  /* selector position that scans the turret's pair too */
#define ACC_COUNTER_MAX 64   /* where updateAccI2CCounter stops */
#define TICK_COUNTER_MAX 65535u
/* of the set-up, after the converter's start; the last look at the buffer's index [measured: register way] */
#define STARTED_CYCLES 24
#define FILLED_CYCLES 7

unsigned int e_last_mic_scan_id;
unsigned int e_last_acc_scan_id;
int e_ambient_ir[IR_CHANNELS];
int e_ambient_and_reflected_ir[IR_CHANNELS];
int selector;
unsigned int tickAdcIsr;
unsigned char updateAccI2CCounter;

unsigned long twinpuck_interrupts_seen;

void twinpuck_refresh_adc_counters(void) {
  /* 32 bits: the robot would find anything longer slow */
  unsigned long interrupts = (unsigned long)tp_scan_interrupts();
  unsigned long news = interrupts - twinpuck_interrupts_seen;
  if (news == 0) return;
  twinpuck_interrupts_seen = interrupts;
  tickAdcIsr = news > TICK_COUNTER_MAX - tickAdcIsr ? TICK_COUNTER_MAX : tickAdcIsr + (unsigned int)news;
  updateAccI2CCounter = news + updateAccI2CCounter > ACC_COUNTER_MAX
                            ? ACC_COUNTER_MAX
                            : (unsigned char)(updateAccI2CCounter + (unsigned int)news);
  e_last_mic_scan_id = (unsigned int)tp_scan_mic_index();
  e_last_acc_scan_id = (unsigned int)tp_scan_acc_index();
}

void twinpuck_refresh_ir(unsigned int sensor) {
  unsigned long counts = (unsigned long)tp_scan_pair(sensor);
  e_ambient_ir[sensor] = (int)(counts & 0xFFFF);
  e_ambient_and_reflected_ir[sensor] = (int)(counts >> 16);
}

/* e_mic_scan and what fills it are there in programs that name them (e_ad_mic.c) */
extern void twinpuck_refresh_mic(void) __attribute__((weak));
TAKES(0) static void refresh_mic_if_wanted(void) {
  if (twinpuck_refresh_mic) twinpuck_refresh_mic();
}

TAKES(0) static void refresh_all(void) {
  unsigned long before = twinpuck_interrupts_seen;
  twinpuck_refresh_adc_counters();
  if (twinpuck_interrupts_seen != before) tp_scan_values(e_ambient_ir, e_ambient_and_reflected_ir);
}

TAKES(0) void e_init_ad_scan(unsigned char only_micro) {
  selector = getselector();
  tp_spend(T_SCAN_INIT - STARTED_CYCLES);
  tp_scan_start(only_micro == MICRO_ONLY, selector == GUMSTIX_POSITION);
  if (only_micro == MICRO_ONLY) {
    tp_spend(STARTED_CYCLES);
  } else { /* blocks until the accelerometer's buffer is full once */
    tp_wait_until(tp_scan_filled_at());
    tp_spend(FILLED_CYCLES);
  }
  refresh_all();
}

unsigned char e_ad_is_array_filled(void) {
  if (!tp_scan_array_filled()) return 0;
  refresh_all();
  refresh_mic_if_wanted();
  return 1;
}

/* the program never runs inside the interrupt, so after the first sample it always sees 1 */
unsigned char e_ad_is_acquisition_completed(void) {
  refresh_all();
  refresh_mic_if_wanted();
  return twinpuck_interrupts_seen > 0;
}

TAKES(T_SCAN_ON) void e_ad_scan_on(void) { tp_scan_switch(1); }

TAKES(T_SCAN_OFF) void e_ad_scan_off(void) {
  tp_scan_switch(0);
  refresh_all();
  refresh_mic_if_wanted(); /* later the past is forgotten */
}
