/* SPDX-License-Identifier: MIT
 * Load of the register way's benchmark: every interrupt that an e-puck's library keeps running, written on
 * registers. Converter scan of 12 inputs at 16384 Hz with its handler (three microphones each time, the
 * proximity sensors in turns with their emitters), a 10 kHz tick of timer 2 that steps both motors, and a
 * main loop that waits.
 */
#include "p30F6014A.h"
#include "epuck_ports.h"

int microphone[3][100];
int dark[8], lit[8];
unsigned int scans, ticks, steps;
int left_period = 20, right_period = 20; /* ticks a step: 500 steps a second */

static const unsigned char phases[4] = {0x0A, 0x06, 0x05, 0x09};

static int buffer_of(int sensor)
{
  switch (sensor) {
  case 0: return ADCBUF4;
  case 1: return ADCBUF5;
  case 2: return ADCBUF6;
  case 3: return ADCBUF7;
  case 4: return ADCBUF8;
  case 5: return ADCBUF9;
  case 6: return ADCBUFA;
  default: return ADCBUFB;
  }
}

static void pulse(int pair, int on)
{
  switch (pair) {
  case 0: pulse_IR0 = on; break;
  case 1: pulse_IR1 = on; break;
  case 2: pulse_IR2 = on; break;
  default: pulse_IR3 = on; break;
  }
}

void _ISR _ADCInterrupt(void)
{
  static int at, pair, step;
  IFS0bits.ADIF = 0;
  microphone[0][at] = ADCBUF0;
  microphone[1][at] = ADCBUF1;
  microphone[2][at] = ADCBUF2;
  if (++at == 100) at = 0;
  if (step == 0) {
    dark[pair] = buffer_of(pair);
    dark[pair + 4] = buffer_of(pair + 4);
    pulse(pair, 1);
  } else if (step == 5) {
    lit[pair] = buffer_of(pair);
    lit[pair + 4] = buffer_of(pair + 4);
    pulse(pair, 0);
  }
  if (++step == 7) {
    step = 0;
    pair = (pair + 1) & 3;
  }
  scans++;
}

void _ISR _T2Interrupt(void)
{
  static int left_left = 1, right_left = 1, left_phase, right_phase;
  IFS0bits.T2IF = 0;
  if (--left_left == 0) {
    left_left = left_period;
    left_phase = (left_phase - 1) & 3;
    LATD = (LATD & 0xFFF0) | phases[left_phase];
    steps++;
  }
  if (--right_left == 0) {
    right_left = right_period;
    right_phase = (right_phase + 1) & 3;
    LATD = (LATD & 0xFF0F) | phases[right_phase] << 4;
  }
  ticks++;
}

int main(void)
{
  pulse_IR0_dir = pulse_IR1_dir = pulse_IR2_dir = pulse_IR3_dir = OUTPUT_PIN;
  LATD &= 0xFF00;
  TRISD &= 0xFF00;
  ADPCFG = 0;
  ADCON1 = 0x00E4;
  ADCON2 = 0x0400 | 11 << 2;
  ADCON3 = 0x0109; /* (1 + 14) TAD of 5 cycles, 12 inputs: 900 cycles */
  ADCSSL = 0xFF3C;
  PR2 = 1473; /* 10 kHz */
  T2CON = 0;
  IFS0 = 0;
  IEC0bits.ADIE = 1;
  IEC0bits.T2IE = 1;
  ADCON1bits.ADON = 1;
  T2CONbits.TON = 1;
  while (1);
}
