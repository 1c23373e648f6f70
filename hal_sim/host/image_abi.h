/* SPDX-License-Identifier: MIT
 * The seam between a firmware image (a .so made by twinpuck-cc) and the host that runs it.
 *
 * Included by C that is compiled with the robot's data model (16-bit int, 32-bit long) and by C++ compiled
 * for the PC. Therefore every quantity that crosses is a tp_i64 (long long: 64 bits on both sides) or a
 * pointer; nothing narrower may be a parameter, a result or a field (float results of tp_m_* excepted:
 * registers agree).
 *
 * What the image offers: `tp_image` below, found by dlsym.
 * What the image needs: the functions declared here and in pins.h, exported by the host's executable.
 *
 * twinpuck-cc inserts calls to tp_event, tp_poll, tp_delay, tp_trap, tp_sfr_*; nobody writes them by hand.
 */
#ifndef TWINPUCK_HOST_IMAGE_ABI_H
#define TWINPUCK_HOST_IMAGE_ABI_H

#ifdef __cplusplus
extern "C" {
#endif

typedef long long tp_i64;
/* a float of the robot's memory, whose words begin at even addresses */
typedef float tp_f32 __attribute__((aligned(2)));

#define TP_IMAGE_MAGIC 0x54575049 /* "TWPI": tells an image from any other .so */
#define TP_IMAGE_ABI 4            /* raised whenever a line of this file changes its meaning */

/** Shared by compiled code and host, never part of a robot's private data. One per loaded copy of the image.
 *  Section "tpctl"; the compiler pass knows the offsets. */
struct tp_control {
  tp_i64 budget; /* estimated cycles left until the host wants control; compiled code subtracts a block's cost
                    before the block and calls tp_event() when it falls below 0 */
  tp_i64
      writes;  /* grows whenever the running loop may have changed anything: the poll detector compares it */
  tp_i64 fill; /* low byte: what local variables hold before the program writes them */
};

/** One function of the image with its cost, for `twinpuck cycles` (array in section "tpfunc"). */
struct tp_function {
  const char* name;    /* C name */
  const char* file;    /* source file as compiled */
  tp_i64 line;         /* line of the definition */
  const void* address; /* entry point */
  tp_i64
      min_cycles; /* cheapest path through the function, callees' cheapest included when known; -1 unknown */
  tp_i64 straight_cycles; /* cost of every block once */
};

/** One counted block for --coverage (array in section "tpcovmap", counter in "tpcov"). */
struct tp_coverage_line {
  const char* file;
  tp_i64 line;
  tp_i64* count;
};

#define TP_VECTORS 54     /* interrupt vectors of the dsPIC30F6014A in natural order [DS70143 table 5-1] */
#define TP_TRAP_VECTORS 4 /* oscillator fail, address error, stack error, math error */

/** The image's self-description: `const struct tp_image tp_image`. */
struct tp_image {
  tp_i64 magic;      /* TP_IMAGE_MAGIC */
  tp_i64 abi;        /* TP_IMAGE_ABI */
  const char* name;  /* controller's name (its folder) */
  const char* flags; /* words: "sanitize", "coverage" */
  struct tp_control* control;
  void (*start)(void); /* runs the controller's main(); returns when main returns */
  /* private data of a robot: everything writable but the control and coverage sections; start-up values are
     what memory holds right after loading */
  char* data_begin;
  char* data_end;
  char* hole_begin; /* [hole_begin, hole_end) inside data is shared, not private (tpctl, tpcov) */
  char* hole_end;
  void (*vectors[TP_VECTORS])(void); /* the controller's _XxxInterrupt functions; 0 where undefined */
  void (*trap_vectors[TP_TRAP_VECTORS])(void); /* its _OscillatorFail _AddressError _StackError _MathError */
  const struct tp_function* functions;
  const struct tp_function* functions_end;
  const struct tp_coverage_line* coverage; /* 0 without --coverage */
  const struct tp_coverage_line* coverage_end;
  /* configuration words of the program, 16 bits each; 0 where it has none */
  const void* fosc;
  const void* fwdt;
  /* its _AltXxxInterrupt functions, for INTCON2.ALTIVT = 1 */
  void (*alternate_vectors[TP_VECTORS])(void);
  void (*alternate_trap_vectors[TP_TRAP_VECTORS])(void);
  void (*default_vector)(
      void);                /* its _DefaultInterrupt, for every vector without a function of its own; or 0 */
  const char* eedata_begin; /* what data EEPROM holds from its first word on when the robot is delivered */
  const char* eedata_end;
};

/** Budget spent: the host delivers what is due and gives a new budget, or lets other robots run meanwhile. */
void tp_event(void);

/** Called at the back edge of a loop whose last round changed nothing (no loop-carried value differs and
 *  control.writes did not move). `loop` is unique in the image. The host may jump the clock over rounds that
 *  would find exactly what this one found. */
void tp_poll(tp_i64 loop);

/** tp_poll() of a loop without an end in which nothing stands: only interrupts happen any more, and each
 * round takes as long as the one before. */
void tp_rest(tp_i64 loop);

/** A counted delay loop that does nothing: `rounds` rounds (0 or more) of `cycles` each. Interrupts are
 *  delivered inside. */
void tp_delay(tp_i64 rounds, tp_i64 cycles);

/** A trap found by inserted checks. Does not return. kind: TP_TRAP_*. */
void tp_trap(tp_i64 kind);
#define TP_TRAP_MATH 1    /* integer division by zero */
#define TP_TRAP_ADDRESS 2 /* null, wild or misaligned pointer */
#define TP_TRAP_STACK 3   /* stack overflow */
#define TP_TRAP_ABORT 4   /* abort(), failed assert(), exit() with a failure */
#define TP_TRAP_INTERRUPT                                                                                    \
  5                           /* endless loop with interrupts off, or an enabled interrupt without a handler \
                               */
#define TP_TRAP_ILLEGAL 6     /* illegal instruction, unreachable code reached */
#define TP_TRAP_SANITIZER 7   /* --sanitize found an overflow or a bad access */
#define TP_TRAP_UNSIMULATED 8 /* a device or register that is not simulated yet */

/** Same, with a sentence for the report (copied). Does not return. */
void tp_trap_message(tp_i64 kind, const char* message);

/** asm("reset"), RESET(), exit(0): restarts the program with its start-up values. Does not return. */
void tp_reset(void);
/** asm("disi #n"): priorities 1 to 6 wait for `cycles` cycles [DS70143 5.5]. */
void tp_disi(tp_i64 cycles);
/** asm("pwrsav #0/#1"), asm("clrwdt"). mode 0 sleep, 1 idle: time passes until the next interrupt. */
void tp_power_save(tp_i64 mode);
void tp_clear_watchdog(void);

/** Access to a special-function register: 16-bit address (even), width 8 or 16 at byte address. Value in the
 * low bits. */
tp_i64 tp_sfr_read(tp_i64 address, tp_i64 bits);
void tp_sfr_write(tp_i64 address, tp_i64 value, tp_i64 bits);
/** A word becomes (word & keep) ^ flip: tp_sfr_read() and tp_sfr_write() with nothing in between. */
void tp_sfr_modify(tp_i64 address, tp_i64 keep, tp_i64 flip);

/** TBLRDL and TBLWTL at a 24-bit program address: the data EEPROM. */
tp_i64 tp_table_read(tp_i64 address);
void tp_table_write(tp_i64 address, tp_i64 value);

/** Per-robot, seeded: next value of rand(), 0..32767; srand. Source: own generator, the libc of XC16 promises
 * no sequence. */
tp_i64 tp_rand(void);
void tp_srand(tp_i64 seed);

/** printf() of firmware: goes to UART `uart`, 1 or 2, as XC16's does; the UART needs no set-up. */
void tp_console(const char* bytes, tp_i64 length, tp_i64 uart);

#ifdef __cplusplus
}
#endif
#endif
