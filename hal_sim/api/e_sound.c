/* SPDX-License-Identifier: MIT
 * Codec and loudspeaker. What is heard is the board's (hal_sim/board/codec.h); the interrupt handler is here, since
 * it keeps two variables that programs read and set. While a sound plays it really runs, 1800 times a second; while
 * none does, only its time is taken.
 * Source: [lib: codec/], facts restated.
 */
#include "codec/e_sound.h"

#include "hal.h"
#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins_sound.h"
#include "motor_led/e_epuck_ports.h"

#define POWER_UP_ROUNDS 6000 /* as hal_dspic's driver */
#define DCI_PRIORITY 4
#define GROUP 4  /* samples an interrupt */
#define SET (-1) /* what the instruction setm leaves */

/* variables of the driver that programs declare themselves */
__attribute__((weak)) int e_dci_unavailable; /* not 0 while a sound plays */
__attribute__((weak)) int e_stop_flag;       /* set to end it */

static unsigned int samples_left; /* counts down by four, in 16 bits */

TAKES(0) static void dci_interrupt(void) {
  if (e_stop_flag || samples_left == 0) {
    if (e_dci_unavailable && samples_left != 0) tp_codec_stop();
    e_dci_unavailable = 0;
    e_stop_flag = SET;
    tp_codec_idle(1);
    return;
  }
  samples_left -= GROUP;
  tp_spend(T_DCI_BUSY - T_DCI_IDLE);
  tp_irq_at(TP_V_DCI, tp_codec_next_group());
}

TAKES(T_DCI_INIT) void e_init_dci_master(void) { tp_codec_start(); }

TAKES(T_CODEC_INIT) void e_init_codec_slave(void) {
  tp_codec_configure();
  tp_irq_install(TP_V_DCI, dci_interrupt, DCI_PRIORITY, T_DCI_IDLE);
  tp_irq_at(TP_V_DCI, tp_codec_next_group());
}

void e_init_sound(void) {
  AUDIO_ON = 1;
  hal_pause(POWER_UP_ROUNDS);
  e_init_dci_master();
  e_init_codec_slave();
}

TAKES(T_SOUND_KICKOFF) void e_sub_dci_kickoff(int sound_offset, int sound_length) {
  samples_left = (unsigned int)sound_length - GROUP;
  tp_codec_play(sound_offset, sound_length);
  tp_codec_idle(0);
  tp_irq_at(TP_V_DCI, tp_codec_next_group());
}

void e_play_sound(int sound_offset, int sound_length) {
  e_dci_unavailable = SET;
  e_stop_flag = 0;
  e_sub_dci_kickoff(sound_offset, sound_length);
}

void e_close_sound(void) { AUDIO_ON = 0; }
