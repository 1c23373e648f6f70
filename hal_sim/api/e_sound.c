/* SPDX-License-Identifier: MIT
 * Codec and loudspeaker. What is heard is the board's (hal_sim/board/codec.h); the interrupt handler is here, since
 * it keeps two variables that programs read and set. While a sound plays it really runs, 1800 times a second; while
 * none does, only its time is taken.
 * Source: [lib: codec/], facts restated.
 */
#include "codec/e_sound.h"

#include "hal_sim/host/pins_sound.h"
#include "motor_led/e_epuck_ports.h"

#define POWER_UP_CYCLES 60000  /* [estimated: an empty loop of 10000 rounds of 6] */
#define DCI_SETUP_CYCLES 40    /* [estimated: 20 register and bit writes, call] */
#define REGISTER_CYCLES 8192   /* [estimated: one group of frames for each of the codec's registers] */
#define CODEC_REGISTERS 6
#define KICKOFF_CYCLES 75      /* [estimated: 8 saves and restores, set-up 15, 4 samples of 12] */
#define DCI_PRIORITY 4
#define GROUP 4                /* samples an interrupt */
#define SET (-1)               /* what the instruction setm leaves */

/* variables of the driver that programs declare themselves */
__attribute__((weak)) int e_dci_unavailable; /* not 0 while a sound plays */
__attribute__((weak)) int e_stop_flag;       /* set to end it */

static unsigned int samples_left; /* counts down by four, in 16 bits */

static void dci_interrupt(void) {
  if (e_stop_flag || samples_left == 0) {
    if (e_dci_unavailable && samples_left != 0) tp_codec_stop();
    e_dci_unavailable = 0;
    e_stop_flag = SET;
    tp_codec_idle(1);
    return;
  }
  samples_left -= GROUP;
  tp_irq_at(TP_V_DCI, tp_codec_next_group());
}

void e_init_dci_master(void) {
  tp_codec_start();
  tp_spend(DCI_SETUP_CYCLES);
}

void e_init_codec_slave(void) {
  tp_spend((tp_i64)CODEC_REGISTERS * REGISTER_CYCLES);
  tp_codec_configure();
  tp_irq_install(TP_V_DCI, dci_interrupt, DCI_PRIORITY, tp_codec_entry_cycles());
  tp_irq_at(TP_V_DCI, tp_codec_next_group());
}

void e_init_sound(void) {
  AUDIO_ON = 1;
  tp_spend(POWER_UP_CYCLES);
  e_init_dci_master();
  e_init_codec_slave();
}

void e_sub_dci_kickoff(int sound_offset, int sound_length) {
  tp_spend(KICKOFF_CYCLES);
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
