/* SPDX-License-Identifier: MIT
 * Microphones, codec and loudspeaker as the e_* API sees them; conventions as in pins.h.
 */
#ifndef TWINPUCK_HOST_PINS_SOUND_H
#define TWINPUCK_HOST_PINS_SOUND_H
#include "pins.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Files the microphone samples from number `from` (0: the first since reset) up to now, of these the last
 * 100 at most, into `scan`, three times 100 16-bit words: sample n of microphone m is word 100 m + n % 100.
 * Counts 0 to 4095. Answers how many samples each microphone has made since reset. Horizon: the next. */
tp_i64 tp_mic_scan(void* scan, tp_i64 from);

/** The data converter interface starts; frames of 2048 cycles, four to an interrupt. Write. Source: [lib:
 * codec/e_init_dci_master.s]. */
void tp_codec_start(void);
/** The codec's registers are written; without AUDIO_ON (latch F0) nothing happens. Write. */
void tp_codec_configure(void);
/** `length` samples from `offset` of the library's bank, from the next group of four on, instead of what
 * plays. Write. Source: [lib: codec/e_sub_dci_kickoff.s]. */
void tp_codec_play(tp_i64 offset, tp_i64 length);
/** Silence after the group of four that is on its way. Write. */
void tp_codec_stop(void);
/** Cycle of the next interrupt of the data converter interface; -1 while it is off. Horizon: none. */
tp_i64 tp_codec_next_group(void);
/** What its handler costs while no sound plays is stolen from now on (1), or no longer (0). */
void tp_codec_idle(tp_i64 idle);
#define TP_BG_DCI 12

#ifdef __cplusplus
}
#endif
#endif
