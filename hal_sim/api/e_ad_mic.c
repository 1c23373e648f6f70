/* SPDX-License-Identifier: MIT
 * The ADC scan's samples of the microphones; alone, since what a robot's memory holds is copied whenever another
 * robot runs.
 */
#include "hal.h"
#include "hal_sim/host/pins_sound.h"

int e_mic_scan[3][MIC_SAMP_NB];
unsigned long twinpuck_mic_filed;

void twinpuck_refresh_mic(void) {
  twinpuck_mic_filed = (unsigned long)tp_mic_scan(e_mic_scan, twinpuck_mic_filed);
  e_last_mic_scan_id = (unsigned int)(twinpuck_mic_filed % MIC_SAMP_NB);
}
