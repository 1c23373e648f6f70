/* SPDX-License-Identifier: MIT
 * Timers 1 to 3 for the fast agenda (firmware/library/e_agenda_fast.c, its only includer), on registers.
 * A timer without tasks has its interrupt switched off; the original leaves its flag set and interrupts for ever.
 */
#ifndef HAL_DSPIC_FAST_TIMERS_H
#define HAL_DSPIC_FAST_TIMERS_H

/* each timer's accesses in functions of their own: a register has to be named where it is used */
#define ONE_TIMER(n)                                                                     \
  static void __attribute__((__noinline__)) start_##n(void) { T##n##CONbits.TON = 1; }  \
  static void __attribute__((__noinline__)) stop_##n(void) { T##n##CONbits.TON = 0; }   \
  static char __attribute__((__noinline__)) runs_##n(void) { return T##n##CONbits.TON; } \
  static void __attribute__((__noinline__)) write_##n(unsigned char code, unsigned int period) { \
    T##n##CONbits.TCKPS = code;                                                          \
    PR##n = period;                                                                      \
  }                                                                                      \
  static void __attribute__((__noinline__)) configure_##n(void) {                        \
    T##n##CON = 0;                                                                       \
    TMR##n = 0;                                                                          \
    IFS0bits.T##n##IF = 0;                                                               \
    IEC0bits.T##n##IE = 1;                                                               \
  }

ONE_TIMER(1)
ONE_TIMER(2)
ONE_TIMER(3)

static void start_timer(int index) {
  switch (index) {
    case 0: start_1(); break;
    case 1: start_2(); break;
    default: start_3();
  }
}

static void stop_timer(int index) {
  switch (index) {
    case 0: stop_1(); break;
    case 1: stop_2(); break;
    default: stop_3();
  }
}

static char timer_runs(int index) { return index == 0 ? runs_1() : index == 1 ? runs_2() : runs_3(); }

/** `shift`: prescaler as a power of two, 0, 3, 6 or 8. */
static void write_period(int index, unsigned char shift, unsigned int period) {
  unsigned char code = shift == 8 ? 3 : shift / 3;
  switch (index) {
    case 0: write_1(code, period); break;
    case 1: write_2(code, period); break;
    default: write_3(code, period);
  }
}

/** Stopped, prescaler 1, count 0, 0.1 ms, interrupt on. */
static void configure(int index) {
  switch (index) {
    case 0: configure_1(); break;
    case 1: configure_2(); break;
    default: configure_3();
  }
  write_period(index, 0, (unsigned int)UNIT_CYCLES);
}

void __attribute__((__interrupt__, __auto_psv__)) _T1Interrupt(void) {
  IFS0bits.T1IF = 0;
  run_tasks(0);
}

void __attribute__((__interrupt__, __auto_psv__)) _T2Interrupt(void) {
  IFS0bits.T2IF = 0;
  run_tasks(1);
}

void __attribute__((__interrupt__, __auto_psv__)) _T3Interrupt(void) {
  IFS0bits.T3IF = 0;
  run_tasks(2);
}

#endif
