/* SPDX-License-Identifier: MIT
 * The ADC scan: the converter walks through its channels by itself, 900 cycles a frame (450 with MICRO_ONLY), and
 * interrupts at the end of each. Frames count from 0 to 64:
 *
 *   frame   2: the next one holds the pair too        61: the next one holds the accelerometer too
 *           3: lit pair arrives, IR LED off,          62: accelerometer arrives; the next one holds the pair
 *              next pair                              63: dark pair arrives, IR LED on
 *   all others: three microphones
 *
 * Channels are converted in the order of their numbers, so microphones (AN2 to AN4) come first, except before the
 * turret's pair (AN0, AN1), which joins the scan at selector position 10.
 * The converter must stand while its list changes. As in the original it stands in every frame, from the end of a
 * sequence until the list is written, so the scan is slower than the 16384 Hz of its header: docs/limits.md.
 * Source: [lib: a_d/advance_ad_scan/e_ad_conv.c], facts restated; [DS70143 20].
 */
#include "hal.h"
#include "utility/utility.h"

#define GUMSTIX_POSITION 10
#define GUMSTIX_PAIR 4
#define GUMSTIX_PRIORITY 6
#define ACC_COUNTER_MAX 64
#define TICK_COUNTER_MAX 65535u

#define LAST_FRAME 64
#define LIST_PAIR_LIT 2
#define TAKE_PAIR_LIT 3
#define LIST_ACC 61
#define TAKE_ACC 62
#define TAKE_PAIR_DARK 63

#define MIC_CHANNELS 0x001Cu
#define ACC_CHANNELS 0x00E0u
#define TURRET_CHANNELS 0x0003u
#define RING_PAIR(pair) (0x1100u << (pair))

#define AUTO_CONVERT 0x00E4 /* SSRC 7: after the sampling time; ASAM: sample again at once; whole numbers */
#define SCAN_INPUTS 0x0400  /* CSCNA */
#define SAMPLING_TAD 0x0100 /* SAMC 1 */

int e_mic_scan[3][MIC_SAMP_NB];
int e_acc_scan[3][ACC_SAMP_NB];
unsigned int e_last_mic_scan_id;
unsigned int e_last_acc_scan_id;
int e_ambient_ir[IR_CHANNELS];
int e_ambient_and_reflected_ir[IR_CHANNELS];
int selector;
unsigned int tickAdcIsr;
unsigned char updateAccI2CCounter;
unsigned int hal_starts;

static volatile unsigned char is_filled;
static volatile unsigned char is_completed;
static unsigned char is_micro_only;
static unsigned char frame;
static unsigned char pair;
static unsigned char pairs = 4;

/* What the next frame converts: so many channels, at a clock that makes each frame 900 cycles long. */
#define LIST_CHANNELS(channels, count, clock) \
  do {                                        \
    ADCSSL = (channels);                      \
    ADCON2bits.SMPI = (count) - 1;            \
    ADCON3bits.ADCS = (clock);                \
  } while (0)

/* Called while the converter stands, so each cycle here lengthens the frame. */
#define LIST_PAIR()                                             \
  do {                                                          \
    ADCON2bits.SMPI = 5 - 1;                                    \
    ADCON3bits.ADCS = ADCS_5_CHAN;                              \
    switch (pair) {                                             \
      case 0: ADCSSL = MIC_CHANNELS | RING_PAIR(0); break;      \
      case 1: ADCSSL = MIC_CHANNELS | RING_PAIR(1); break;      \
      case 2: ADCSSL = MIC_CHANNELS | RING_PAIR(2); break;      \
      case 3: ADCSSL = MIC_CHANNELS | RING_PAIR(3); break;      \
      default: ADCSSL = MIC_CHANNELS | TURRET_CHANNELS; break;  \
    }                                                           \
  } while (0)

static void light_pair(void) {
  switch (pair) {
    case 0: PULSE_IR0 = 1; break;
    case 1: PULSE_IR1 = 1; break;
    case 2: PULSE_IR2 = 1; break;
    case 3: PULSE_IR3 = 1; break;
    default:
      BODY_LED = 1;
      FRONT_LED = 1;
  }
}

static void darken_pair(void) {
  switch (pair) {
    case 0: PULSE_IR0 = 0; break;
    case 1: PULSE_IR1 = 0; break;
    case 2: PULSE_IR2 = 0; break;
    case 3: PULSE_IR3 = 0; break;
    default:
      BODY_LED = 0;
      FRONT_LED = 0;
  }
}

/* sensors 0 to 3 and their partners 4 to 7; the turret's 8 is on AN1, 9 on AN0, converted before the microphones */
static void file_pair(int *samples) {
  if (pair == GUMSTIX_PAIR) {
    samples[9] = (int)ADCBUF0;
    samples[8] = (int)ADCBUF1;
  } else {
    samples[pair] = (int)ADCBUF3;
    samples[pair + 4] = (int)ADCBUF4;
  }
}

void __attribute__((__interrupt__, __auto_psv__)) _ADCInterrupt(void) {
  is_completed = 0;
  is_filled = 0;
  IFS0bits.ADIF = 0;
  if (updateAccI2CCounter < ACC_COUNTER_MAX) updateAccI2CCounter++;
  if (tickAdcIsr < TICK_COUNTER_MAX) tickAdcIsr++;

  if (!is_micro_only) {
    /* the converter stands from here ... */
    ADCON1bits.ADON = 0;
    LIST_CHANNELS(MIC_CHANNELS, 3, ADCS_3_CHAN);
    if (frame == LIST_ACC)
      LIST_CHANNELS(MIC_CHANNELS | ACC_CHANNELS, 6, ADCS_6_CHAN);
    else if (frame == TAKE_ACC)
      LIST_PAIR();
    else if (frame == LIST_PAIR_LIT)
      LIST_PAIR();
    ADCON1bits.ADON = 1; /* ... to here; the next frame overwrites the first result 300 cycles later */
  }

  if (pair == GUMSTIX_PAIR && (frame == TAKE_PAIR_LIT || frame == TAKE_PAIR_DARK)) {
    e_mic_scan[0][e_last_mic_scan_id] = (int)ADCBUF2;
    e_mic_scan[1][e_last_mic_scan_id] = (int)ADCBUF3;
    e_mic_scan[2][e_last_mic_scan_id] = (int)ADCBUF4;
  } else {
    e_mic_scan[0][e_last_mic_scan_id] = (int)ADCBUF0;
    e_mic_scan[1][e_last_mic_scan_id] = (int)ADCBUF1;
    e_mic_scan[2][e_last_mic_scan_id] = (int)ADCBUF2;
  }
  if (++e_last_mic_scan_id >= MIC_SAMP_NB) {
    e_last_mic_scan_id = 0;
    is_filled = 1;
  }

  if (!is_micro_only) {
    if (frame == TAKE_ACC) {
      if (++e_last_acc_scan_id >= ACC_SAMP_NB) e_last_acc_scan_id = 0;
      e_acc_scan[0][e_last_acc_scan_id] = (int)ADCBUF3;
      e_acc_scan[1][e_last_acc_scan_id] = (int)ADCBUF4;
      e_acc_scan[2][e_last_acc_scan_id] = (int)ADCBUF5;
    } else if (frame == TAKE_PAIR_DARK) {
      file_pair(e_ambient_ir);
      light_pair();
    } else if (frame == TAKE_PAIR_LIT) {
      file_pair(e_ambient_and_reflected_ir);
      darken_pair();
      pair = pair + 1 < pairs ? pair + 1 : 0;
    }
    if (frame++ >= LAST_FRAME) frame = 0;
  }
  is_completed = 1;
}

void e_init_ad_scan(unsigned char only_micro) {
  ADCON1 = 0;
  IEC0bits.ADIE = 0;
  selector = getselector();
  hal_starts++;
  is_micro_only = only_micro == MICRO_ONLY;
  pairs = selector == GUMSTIX_POSITION ? 5 : 4;
  if (pair >= pairs) pair = 0;
  ADPCFG = selector == GUMSTIX_POSITION ? 0x0000 : 0x0003; /* AN0 and AN1 are the debugger's otherwise */
  if (selector == GUMSTIX_POSITION) IPC2bits.ADIP = GUMSTIX_PRIORITY; /* else as after a reset, 4 */
  ADCHS = 0;
  ADCON1 = AUTO_CONVERT;
  IFS0bits.ADIF = 0;
  IEC0bits.ADIE = 1;
  ADCON2 = SCAN_INPUTS;
  ADCON3 = SAMPLING_TAD;
  LIST_CHANNELS(MIC_CHANNELS, 3, is_micro_only ? ADCS_6_CHAN : ADCS_3_CHAN); /* 6 channels' clock: twice as fast */
  ADCON1bits.ADON = 1;
  /* until the accelerometer's buffer has been filled once */
  if (!is_micro_only)
    while (*(volatile unsigned int *)&e_last_acc_scan_id < ACC_SAMP_NB - 1) continue;
}

unsigned char e_ad_is_array_filled(void) { return is_filled; }

unsigned char e_ad_is_acquisition_completed(void) { return is_completed; }

void e_ad_scan_on(void) { ADCON1bits.ADON = 1; }

void e_ad_scan_off(void) { ADCON1bits.ADON = 0; }
