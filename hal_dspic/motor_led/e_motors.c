/* SPDX-License-Identifier: MIT
 * Motors, basic variant: Timer 5 steps the left wheel, Timer 4 the right one, each at its own period.
 * Kept from the original: no limit of the speed, and every call restarts the period.
 * Source: [lib: motor_led/e_motors.c], facts restated.
 */
#include "motor_led/e_motors.h"

#include "hal.h"
#include "motor_led/e_init_port.h"

#define LEFT 0
#define RIGHT 1
#define COUNTS_PER_SECOND (FCY / 256) /* 57600, a float */
#define PRESCALE_256 3
#define LONGEST_PERIOD 0xFFFFu

struct wheel {
  int speed;
  int steps;
  unsigned char phase;
};

static struct wheel left_wheel, right_wheel;

void e_init_motors(void) { e_init_port(); }

/* the step of one interrupt: rotor forward is phase back on the left, phase on on the right */
static void step(struct wheel *w, int which, int count, int turn) {
  w->steps += count;
  w->phase = (unsigned char)(w->phase + turn) & 3;
  hal_coils(which, hal_phase_coils[w->phase]);
}

void __attribute__((__interrupt__, __auto_psv__)) _T5Interrupt(void) {
  IFS1bits.T5IF = 0;
  if (left_wheel.speed > 0)
    step(&left_wheel, LEFT, 1, -1);
  else
    step(&left_wheel, LEFT, -1, 1);
}

void __attribute__((__interrupt__, __auto_psv__)) _T4Interrupt(void) {
  IFS1bits.T4IF = 0;
  if (right_wheel.speed < 0)
    step(&right_wheel, RIGHT, -1, -1);
  else
    step(&right_wheel, RIGHT, 1, 1);
}

/* the period register, by a division of floats as in the original; the magnitude of -32768 does not fit */
static unsigned int period_of(int speed) {
  if (speed == -32767 - 1) return LONGEST_PERIOD;
  return (unsigned int)(COUNTS_PER_SECOND / (speed < 0 ? -speed : speed));
}

void e_set_speed_left(int motor_speed) {
  if (motor_speed == 0) {
    T5CONbits.TON = 0;
    hal_coils(LEFT, 0);
    return;
  }
  T5CONbits.TON = 0;
  left_wheel.speed = motor_speed;
  T5CON = 0;
  T5CONbits.TCKPS = PRESCALE_256;
  TMR5 = 0;
  PR5 = period_of(motor_speed);
  IFS1bits.T5IF = 0;
  IEC1bits.T5IE = 1;
  T5CONbits.TON = 1;
}

void e_set_speed_right(int motor_speed) {
  if (motor_speed == 0) {
    T4CONbits.TON = 0;
    hal_coils(RIGHT, 0);
    return;
  }
  T4CONbits.TON = 0;
  right_wheel.speed = motor_speed;
  T4CON = 0;
  T4CONbits.TCKPS = PRESCALE_256;
  TMR4 = 0;
  PR4 = period_of(motor_speed);
  IFS1bits.T4IF = 0;
  IEC1bits.T4IE = 1;
  T4CONbits.TON = 1;
}

/* a word is read and written by one instruction */
int e_get_steps_left(void) { return left_wheel.steps; }

int e_get_steps_right(void) { return right_wheel.steps; }

void e_set_steps_left(int set_steps) { left_wheel.steps = set_steps; }

void e_set_steps_right(int set_steps) { right_wheel.steps = set_steps; }
