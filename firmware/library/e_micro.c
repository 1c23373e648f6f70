/* SPDX-License-Identifier: MIT
 * Microphones, usual variant: samples come from the ADC scan.
 * Source: [lib: a_d/advance_ad_scan/e_micro.c], facts restated, its slips included.
 */
#include "a_d/advance_ad_scan/e_micro.h"

#include "hal.h"

#define MICROPHONES 3
#define ABOVE_ALL_SAMPLES 4999 /* where the search for the lowest sample starts */

/* in the library's object, in none of its headers */
void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb);

int e_get_micro(unsigned int micro_id) {
  return e_mic_scan[micro_id][e_last_mic_scan_id];
}

int e_get_micro_average(unsigned int micro_id, unsigned int filter_size) {
  long sum = 0;
  unsigned int i, place;
  if (micro_id < MICROPHONES && filter_size > 0 && filter_size <= MIC_SAMP_NB) {
    place = (e_last_mic_scan_id + 1 + MIC_SAMP_NB - filter_size) % MIC_SAMP_NB;
    for (i = 0; i < filter_size; i++) {
      sum += e_mic_scan[micro_id][place];
      place = (place + 1) % MIC_SAMP_NB;
    }
  }
  return (int)(sum / (long)filter_size);
}

int e_get_micro_volume(unsigned int micro_id) {
  int highest = 0, lowest = ABOVE_ALL_SAMPLES;
  int i;
  for (i = 0; i < MIC_SAMP_NB; i++) {
    int sample = e_mic_scan[micro_id][i];
    if (sample > highest)
      highest = sample;
    else if (sample < lowest) /* a sample that is a new highest is not looked at for the lowest */
      lowest = sample;
  }
  return highest - lowest;
}

void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb) {
  unsigned int i;
  if (samples_nb == 0 || samples_nb > MIC_SAMP_NB) return;
  /* begins with the oldest, whatever the number, and files it last */
  for (i = 0; i < samples_nb; i++)
    result[samples_nb - 1 - i] = e_mic_scan[micro_id][(e_last_mic_scan_id + i) % MIC_SAMP_NB];
}
