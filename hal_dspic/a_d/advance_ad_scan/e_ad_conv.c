/* SPDX-License-Identifier: MIT
 * The ADC scan: the converter walks through its channels by itself and interrupts once a frame, 900 cycles after the
 * one before (450 with MICRO_ONLY). Frames count from 0 to 64:
 *
 *   frame   2: the next one holds the pair too        61: the next one holds the accelerometer too
 *           3: lit pair arrives, IR LED off,          62: accelerometer arrives; the next one holds the pair
 *              next pair; frames are short from here  63: dark pair arrives, IR LED on
 *          26: frames have their length again
 *   all others: three microphones
 *
 * Channels are converted in the order of their numbers, so microphones (AN2 to AN4) come first, except before the
 * turret's pair (AN0, AN1), which joins the scan at selector position 10.
 * The converter must stand while its list changes. It is stopped in the six frames of 65 in which the list changes, for
 * about 87 cycles each (latency, entry, first lines of the handler) [measured: register way, and XC16 -O1], and runs on in
 * the others. The 23 frames from 4 to 26 are 22.5 cycles shorter, which catches that up: 16384 Hz on average, as the header
 * says.
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
#define CAUGHT_UP 26
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

/** What the next frames convert: `count` channels, at a clock that makes the frame 900 cycles long. */
static void list_channels(unsigned int channels, unsigned int count, unsigned int clock) {
  ADCON1bits.ADON = 0;
  ADCSSL = channels;
  ADCON2 = SCAN_INPUTS | (count - 1) << 2;
  ADCON3 = SAMPLING_TAD | clock;
  NOP(); /* the six stops take as long as the short frames save */
  ADCON1bits.ADON = 1;
}

static void list_microphones(void) { list_channels(MIC_CHANNELS, 3, ADCS_3_CHAN); }

/* 877.5 cycles a frame */
static void list_short_microphones(void) { list_channels(MIC_CHANNELS, 3, ADCS_3_CHAN - 1); }

static void list_pair(void) {
  if (pair == GUMSTIX_PAIR)
    list_channels(MIC_CHANNELS | TURRET_CHANNELS, 5, ADCS_5_CHAN);
  else
    list_channels(MIC_CHANNELS | RING_PAIR(pair), 5, ADCS_5_CHAN);
}

static void light_pair(void) {
  switch (pair) {
    case 0: PULSE_IR0 = 1; break;
    case 1: PULSE_IR1 = 1; break;
    case 2: PULSE_IR2 = 1; break;
    case 3: PULSE_IR3 = 1; break;
    default:
      FRONT_LED = 1;
      BODY_LED = 1;
  }
}

static void darken_pair(void) {
  switch (pair) {
    case 0: PULSE_IR0 = 0; break;
    case 1: PULSE_IR1 = 0; break;
    case 2: PULSE_IR2 = 0; break;
    case 3: PULSE_IR3 = 0; break;
    default:
      FRONT_LED = 0;
      BODY_LED = 0;
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

/* The six frames in which something besides the microphones arrives or the list changes. The list first, since the
 * converter stands meanwhile; the next frame begins to overwrite the results 150 cycles later. */
static void __attribute__((__noinline__)) serve_special_frame(void) {
  unsigned int newest;
  switch (frame) {
    case LIST_PAIR_LIT:
      list_pair();
      break;
    case TAKE_PAIR_LIT:
      list_short_microphones();
      file_pair(e_ambient_and_reflected_ir);
      darken_pair();
      pair = pair + 1 < pairs ? pair + 1 : 0;
      break;
    case CAUGHT_UP:
      list_microphones();
      break;
    case LIST_ACC:
      list_channels(MIC_CHANNELS | ACC_CHANNELS, 6, ADCS_6_CHAN);
      break;
    case TAKE_ACC:
      list_pair();
      newest = e_last_acc_scan_id + 1 < ACC_SAMP_NB ? e_last_acc_scan_id + 1 : 0;
      e_acc_scan[0][newest] = (int)ADCBUF3;
      e_acc_scan[1][newest] = (int)ADCBUF4;
      e_acc_scan[2][newest] = (int)ADCBUF5;
      e_last_acc_scan_id = newest;
      break;
    case TAKE_PAIR_DARK:
      list_microphones();
      file_pair(e_ambient_ir);
      light_pair();
      break;
    default:
      break;
  }
}

void __attribute__((__interrupt__, __auto_psv__)) _ADCInterrupt(void) {
  unsigned int place = e_last_mic_scan_id;
  int first = (int)ADCBUF0, second = (int)ADCBUF1, third = (int)ADCBUF2;
  IFS0bits.ADIF = 0;
  is_completed = 0;
  is_filled = 0;
  if (!is_micro_only) {
    if (pair == GUMSTIX_PAIR && (frame == TAKE_PAIR_LIT || frame == TAKE_PAIR_DARK)) {
      first = (int)ADCBUF2;
      second = (int)ADCBUF3;
      third = (int)ADCBUF4;
    }
    /* early, since the converter stands while its list changes */
    if (frame >= LIST_ACC || (frame & 0xFE) == LIST_PAIR_LIT || frame == CAUGHT_UP) serve_special_frame();
    frame = frame < LAST_FRAME ? frame + 1 : 0;
  }
  e_mic_scan[0][place] = first;
  e_mic_scan[1][place] = second;
  e_mic_scan[2][place] = third;
  if (++place < MIC_SAMP_NB) {
    e_last_mic_scan_id = place;
  } else {
    e_last_mic_scan_id = 0;
    is_filled = 1;
  }
  if (tickAdcIsr < TICK_COUNTER_MAX) tickAdcIsr++;
  if (updateAccI2CCounter < ACC_COUNTER_MAX) updateAccI2CCounter++;
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
  if (is_micro_only)
    list_channels(MIC_CHANNELS, 3, ADCS_6_CHAN); /* twice as fast */
  else
    list_microphones();
  /* until the accelerometer's buffer has been filled once */
  if (!is_micro_only)
    while (*(volatile unsigned int *)&e_last_acc_scan_id < ACC_SAMP_NB - 1) continue;
}

unsigned char e_ad_is_array_filled(void) { return is_filled; }

unsigned char e_ad_is_acquisition_completed(void) { return is_completed; }

void e_ad_scan_on(void) { ADCON1bits.ADON = 1; }

void e_ad_scan_off(void) { ADCON1bits.ADON = 0; }
