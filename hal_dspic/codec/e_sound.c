/* SPDX-License-Identifier: MIT
 * Codec (Si3000) and loudspeaker by the data converter interface (DCI), which is the clock's master.
 *
 *   set-up: frames of 8 words, buffers of two: a word that asks for a control word, and the control word
 *   play:   frames of 16 words at 7200 Hz, buffers of four samples: an interrupt every 8192 cycles
 *
 * The lowest bit of a sample would ask for a control word, so it is cleared.
 * Kept from the original: the place in the bank moves before it is read, so a sound lacks its first sample; the length
 * counts down by four and meets zero only if it is a multiple of four.
 * Source: [lib: codec/], facts restated; [DS70143 18].
 */
#include "codec/e_sound.h"

#include "hal.h"
#include "sound_bank.h"

#define POWER_UP_ROUNDS 6000
#define RESET_ROUNDS 40 /* 5 us at least */
#define PRIORITY 4
#define GROUP 4
#define SET (-1)

#define CSDO_ONLY_IN_SLOT 0x0040 /* CSDOM */
#define SETUP_FRAMES 0x04EF      /* 2 buffers, 8 words of 16 bits */
#define PLAY_FRAMES 0x0DEF       /* 4 buffers, 16 words of 16 bits */
#define BIT_CLOCK 3              /* 8 cycles a bit: 256 bits at 7200 Hz */
#define FIRST_SLOT 0x0001
#define ASK_FOR_CONTROL 0x7FFF
#define CONTROLS 6

/* variables of the driver that programs declare themselves */
int e_dci_unavailable; /* not 0 while a sound plays */
int e_stop_flag;       /* set to end it */

static volatile unsigned int samples_left;
static volatile unsigned int place; /* in the bank */

/* control words, register in the high byte */
static const unsigned int controls[CONTROLS] = {
    0x0300, /* PLL divides by 1 */
    0x0413, /* PLL multiplies by 20 */
    0x0118, /* line and speaker drivers on */
    0x0200, /* control 2: nothing */
    0x0602, /* ADC volume: line out active */
    0x075F, /* DAC volume 0 dB, both speakers */
};

static unsigned int next_sample(void) {
  place++;
  return (unsigned int)hal_bank_sample(place) & 0xFFFEu;
}

static void load_group(void) {
  TXBUF0 = next_sample();
  TXBUF1 = next_sample();
  TXBUF2 = next_sample();
  TXBUF3 = next_sample();
}

void __attribute__((__interrupt__, __auto_psv__)) _DCIInterrupt(void) {
  IFS2bits.DCIIF = 0;
  /* what was received is read, or it counts as an overrun */
  (void)RXBUF0;
  (void)RXBUF1;
  (void)RXBUF2;
  (void)RXBUF3;
  if (e_stop_flag || samples_left == 0) {
    e_dci_unavailable = 0;
    e_stop_flag = SET;
    return;
  }
  load_group();
  samples_left -= GROUP;
}

void e_init_dci_master(void) {
  DCICON1 = 0;
  DCICON2 = 0;
  DCICON3 = 0;
  TSCON = 0;
  RSCON = 0;
  TRISGbits.TRISG12 = 1;
  TRISGbits.TRISG13 = 0;
  TRISGbits.TRISG14 = 0;
  TRISGbits.TRISG15 = 0;
  DCICON1 = CSDO_ONLY_IN_SLOT;
  DCICON2 = SETUP_FRAMES;
  DCICON3 = BIT_CLOCK;
  RSCON = FIRST_SLOT;
  TSCON = FIRST_SLOT;
  IFS2bits.DCIIF = 0;
  IEC2bits.DCIIE = 0;
}

static void wait_for_slot(unsigned char first) {
  while ((DCISTATbits.SLOT == 0) != first) continue;
}

void e_init_codec_slave(void) {
  int i;
  TXBUF0 = ASK_FOR_CONTROL;
  TXBUF1 = controls[0];
  AUDIO_ON = 0;
  hal_pause(RESET_ROUNDS);
  AUDIO_ON = 1;
  DCICON1bits.DCIEN = 1;
  for (i = 1; i < CONTROLS; i++) {
    while (!DCISTATbits.TMPTY) continue;
    TXBUF0 = ASK_FOR_CONTROL;
    TXBUF1 = controls[i];
  }
  while (!DCISTATbits.TMPTY) continue;
  /* the shadow registers still hold two words: two whole frames */
  for (i = 0; i < 2; i++) {
    wait_for_slot(1);
    wait_for_slot(0);
  }
  wait_for_slot(1);
  (void)RXBUF0;
  (void)RXBUF1;

  DCICON1bits.DCIEN = 0;
  DCICON2 = PLAY_FRAMES;
  /* what the buffers hold goes out when the module is switched on: silence, not the last control word */
  TXBUF0 = 0;
  TXBUF1 = 0;
  TXBUF2 = 0;
  TXBUF3 = 0;
  IFS2bits.DCIIF = 0;
  IPC10bits.DCIIP = PRIORITY;
  IEC2bits.DCIIE = 1;
  DCICON1bits.DCIEN = 1;
}

void e_init_sound(void) {
  AUDIO_ON = 1;
  hal_pause(POWER_UP_ROUNDS);
  e_init_dci_master();
  e_init_codec_slave();
}

void e_sub_dci_kickoff(int sound_offset, int sound_length) {
  IEC2bits.DCIIE = 0;
  place = (unsigned int)sound_offset;
  load_group();
  samples_left = (unsigned int)sound_length - GROUP;
  IFS2bits.DCIIF = 0;
  IEC2bits.DCIIE = 1;
}

void e_play_sound(int sound_offset, int sound_length) {
  e_dci_unavailable = SET;
  e_stop_flag = 0;
  e_sub_dci_kickoff(sound_offset, sound_length);
}

void e_close_sound(void) { AUDIO_ON = 0; }
