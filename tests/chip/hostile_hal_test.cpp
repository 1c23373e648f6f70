// SPDX-License-Identifier: MIT
// Programs that do what no program should, under hal_sim: each is contained, told, and the same whenever it
// runs; the robot beside it does not notice.
#include <cstdio>
#include <fstream>
#include <optional>

#include "tests/chip/hal_flight.h"

namespace {

constexpr double kHostileSeconds = 0.3;

const char* const kHostileHead = R"(#include <p30F6014A.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <math.h>
#include <setjmp.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
#include <I2C/e_I2C_protocol.h>
volatile int seen[16], zero, one = 1; volatile unsigned odd = 0x1001, far = 0x7000; volatile long big = 100000;
void *volatile nowhere; void (*volatile func)(void);
extern int e_mic_scan[3][MIC_SAMP_NB], e_acc_scan[3][ACC_SAMP_NB], e_ambient_ir[10];
extern unsigned int e_last_mic_scan_id, e_last_acc_scan_id, tickAdcIsr;
void start(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); e_set_speed(300, 0); }
void scan(void) { start(); e_init_ad_scan(ALL_ADC); }
void spend(unsigned n) { while (n--) __asm__ volatile("nop"); }
void tick(void) { seen[15]++; }
)";

#define MAIN(body) "int main(void) { " body " while (1) seen[14]++; }"

struct HostileProgram {
  const char* name;
  const char* program;
  // false: what it does is nothing that the robot could notice; none: as it falls out, by what lies there
  std::optional<bool> is_told = true;
};

void PrintTo(const HostileProgram& p, std::ostream* out) { *out << p.name; }

const HostileProgram kHostile[] = {
    {"recursion",
     "int down(int n) { volatile int a[20]; a[0] = n; return down(n + 1) + a[0]; } int main(void) { start(); "
     "seen[0] = down(0); while (1); }"},
    {"recursion_in_callback",
     "int down(int n) { volatile int a[20]; a[0] = n; return down(n + 1) + a[0]; } void bad(void) { seen[0] "
     "= down(0); } int main(void) { start(); e_activate_agenda(bad, 20); while (1); }"},
    {"recursion_with_scan",
     "int down(int n) { volatile int a[9]; a[0] = n + e_get_prox(n & 7); return down(n + 1) + a[0]; } int "
     "main(void) { scan(); seen[0] = down(0); while (1); }"},
    {"large_frame",
     "int deep(void) { volatile char a[9000]; a[8999] = 1; e_set_led(0, 1); return a[8999]; } int main(void) "
     "{ start(); seen[0] = deep(); while (1); }",
     false},
    {"frame_near_limit",
     "int deep(int n) { volatile char a[40]; a[0] = n; e_set_speed_left(n); return n ? deep(n - 1) + a[0] : "
     "0; } int main(void) { start(); e_activate_agenda(tick, 1); seen[0] = deep(130); seen[1]++; while (1); "
     "}",
     false},
    {"alloca_loop", MAIN("start(); for (;;) nowhere = __builtin_alloca(100);")},
    {"w15_low", MAIN("start(); __asm__ volatile(\"mov #0x100, w15\"); func = tick; func();")},
    {"w15_high", MAIN("start(); __asm__ volatile(\"mov #0x7000, w15\"); func = tick; func();")},
    {"w15_served", MAIN("scan(); __asm__ volatile(\"mov #0x810, w15\"); tick(); tick();")},
    {"w15_odd", MAIN("start(); __asm__ volatile(\"mov #0x1235, w15\"); tick();"), false},
    {"splim_zero", MAIN("start(); SPLIM = 0x0800; tick();")},
    {"splim_near", MAIN("start(); SPLIM = WREG15 + 8; e_activate_agenda(tick, 1); e_set_speed(500, 3);")},
    {"stack_pop",
     "void f(void) { __asm__ volatile(\"sub w15, #8, w15\"); } int main(void) { start(); f(); while (1); }",
     false},
    {"frame_wrecked",
     "void f(void) { volatile int a[2]; int i; a[0] = 1; for (i = -9; i < 9; i++) a[i] = 0x4141; } int "
     "main(void) { start(); f(); while (1); }",
     false},
    {"callback_wrecks_frame",
     "void f(void) { volatile int a[2]; int i; a[0] = 1; for (i = -30; i < 2; i++) a[i] = 0x1111; } int "
     "main(void) { start(); e_activate_agenda(f, 10); while (1); }"},
    {"null_read", MAIN("start(); seen[0] = *(int *)nowhere;"), false},
    {"null_write", MAIN("start(); memset(nowhere, 0xFF, 40);")},
    {"odd_read", MAIN("start(); seen[0] = *(int *)odd;")},
    {"odd_write", MAIN("start(); *(int *)odd = 5;")},
    {"far_read", MAIN("start(); seen[0] = *(int *)far;")},
    {"far_write", MAIN("start(); *(int *)far = 5;")},
    {"psv_write", MAIN("start(); *(int *)(0x8000u + zero) = 1;")},
    {"ram_end", MAIN("start(); { char *p = (char *)0x2700; for (;;) *p++ = 7; }")},
    {"all_ram",
     MAIN("start(); { unsigned *p = (unsigned *)0x800; while (p < (unsigned *)0x2800) *p++ = 0xDEAD; }")},
    {"all_ram_scan",
     MAIN("scan(); e_activate_agenda(tick, 10); { unsigned *p = (unsigned *)0x800; while (p "
          "< (unsigned *)0x2800) *p++ = 0; }"),
     false},
    {"below_global", MAIN("start(); { int i; for (i = 0; i > -4000; i--) seen[i] = i; }")},
    {"const_write", MAIN("start(); *(char *)nowhere = 1; ((char *)\"text\")[one] = 3;"), true},
    {"all_sfrs_ff",
     MAIN("start(); { unsigned *p = (unsigned *)0x0020; while (p < (unsigned *)0x0800) *p++ = 0xFFFF; }")},
    {"all_sfrs_00",
     MAIN("scan(); { unsigned *p = (unsigned *)0x0020; while (p < (unsigned *)0x0800) *p++ = 0; }")},
    {"all_sfrs_walk", MAIN("scan(); { unsigned i, *p; for (i = 1; i; i <<= 1) for (p = (unsigned *)0x0060; p "
                           "< (unsigned *)0x07F0; p++) *p = i; }")},
    {"sfrs_by_byte", MAIN("scan(); { char *p = (char *)0x0080; while (p < (char *)0x0700) *p++ = 0x5A; }")},
    {"all_ie", MAIN("start(); IEC0 = 0xFFFF; IEC1 = 0xFFFF; IEC2 = 0xFFFF; IFS1 = 0xFFFF;")},
    {"ifs_all", MAIN("scan(); for (;;) { IFS0 = 0xFFFF; IFS1 = 0; }")},
    {"nstdis", MAIN("scan(); INTCON1bits.NSTDIS = 1; e_activate_agenda(tick, 1);"), false},
    {"altivt", MAIN("scan(); INTCON2bits.ALTIVT = 1; e_activate_agenda(tick, 10);")},
    {"trap_flags", MAIN("start(); INTCON1 = 0x001E;")},
    {"osc_switch", MAIN("start(); OSCCON = 0x0101;")},
    {"t2_by_pointer",
     MAIN("start(); *(volatile unsigned *)((unsigned)&TMR1 + 6 + zero) = 3; *(volatile "
          "unsigned *)(0x10C + zero) = 5; *(volatile unsigned *)(0x110 + zero) = 0;"),
     false},
    {"adcon_by_pointer",
     MAIN("scan(); *(volatile unsigned *)(0x2A0 + zero) = 0; *(volatile unsigned *)(0x2AA + zero) = 0xFFFF;"),
     false},
    {"watchdog", MAIN("start(); RCONbits.SWDTEN = 1; for (;;) seen[0]++;"), false},
    {"modulo",
     MAIN("scan(); XMODSRT = 0x1000; XMODEND = 0x100F; MODCON = 0x8FF1; { char *p = (char *)seen; "
          "int i; for (i = 0; i < 30; i++) *p++ = i; }"),
     false},
    {"bit_reversed",
     MAIN("scan(); XBREV = 0x8010; MODCON = 0x0F0F; { int *p = (int *)seen, i; for (i = 0; i "
          "< 30; i++) *p++ = i; }"),
     false},
    {"pmd_off", MAIN("scan(); PMD1 = 0xFFFF; PMD2 = 0xFFFF; e_activate_agenda(tick, 10);")},
    {"tris_all",
     MAIN("scan(); TRISD = 0; LATD = 0xFFFF; TRISG = 0; LATG = 0xFFFF; TRISF = 0; LATF = 0xFFFF;"), false},
    {"ipl7_forever", MAIN("scan(); e_activate_agenda(tick, 10); SRbits.IPL = 7;")},
    {"ipl7_host_calls", MAIN("scan(); SRbits.IPL = 7; for (;;) { e_set_speed_left(seen[0]++); "
                             "e_activate_agenda(tick, 3); e_destroy_agenda(tick); }")},
    {"disi_forever", MAIN("scan(); for (;;) __asm__ volatile(\"disi #0x3FFF\");")},
    {"init_scan_masked", MAIN("start(); SRbits.IPL = 7; e_init_ad_scan(ALL_ADC);")},
    {"init_scan_disabled",
     MAIN("start(); IEC0bits.T2IE = 0; e_init_ad_scan(ALL_ADC); IEC0bits.ADIE = 0; "
          "e_init_ad_scan(ALL_ADC); IEC0 = 0; while (e_ad_is_array_filled() == 0);"),
     false},
    {"host_in_own_handler",
     "void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; "
     "e_set_speed(seen[0]++, 1); e_activate_agenda(tick, 5); e_destroy_agenda(tick); } int main(void) { "
     "scan(); PR1 = 200; IPC0bits.T1IP = 7; IEC0bits.T1IE = 1; T1CONbits.TON = 1; while (1) { "
     "e_set_speed_left(100); e_activate_agenda(tick, 2); } }"},
    {"scan_in_own_handler",
     "void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; "
     "e_init_ad_scan(ALL_ADC); } int main(void) { scan(); PR1 = 30000; IPC0bits.T1IP = 6; IEC0bits.T1IE = 1; "
     "T1CONbits.TON = 1; while (1) seen[0]++; }"},
    {"flag_never_cleared",
     "void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { seen[0]++; } int main(void) { "
     "scan(); PR1 = 3000; IEC0bits.T1IE = 1; T1CONbits.TON = 1; while (1) seen[1]++; }"},
    {"handler_nests_itself",
     "void __attribute__((interrupt, no_auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 1; SRbits.IPL = 0; "
     "spend(10); } int main(void) { start(); PR1 = 3000; IEC0bits.T1IE = 1; T1CONbits.TON = 1; while (1) "
     "seen[1]++; }"},
    {"trap_in_trap",
     "void __attribute__((interrupt, no_auto_psv)) _AddressError(void) { seen[0] += *(int *)odd; } int "
     "main(void) { start(); seen[1] = *(int *)odd; while (1); }"},
    {"trap_not_cleared",
     "void __attribute__((interrupt, no_auto_psv)) _MathError(void) { seen[0]++; } int main(void) { start(); "
     "seen[1] = 5 / zero; while (1); }"},
    {"stack_trap_returns",
     "void __attribute__((interrupt, no_auto_psv)) _StackError(void) { INTCON1bits.STKERR = 0; seen[0]++; } "
     "int down(int n) { volatile int a[20]; a[0] = n; return down(n + 1) + a[0]; } int main(void) { start(); "
     "seen[1] = down(0); while (1); }"},
    {"jump_data", MAIN("start(); func = (void (*)(void))seen; func();")},
    {"jump_erased", MAIN("start(); func = (void (*)(void))0x4000; func();")},
    {"jump_vector_table", MAIN("start(); func = (void (*)(void))0x0010; func();")},
    {"jump_zero", MAIN("start(); func = 0; func();")},
    {"jump_odd", MAIN("start(); func = (void (*)(void))((unsigned)tick + 1); func();"), false},
    {"jump_end_of_flash", MAIN("start(); func = (void (*)(void))0xFFFE; func();")},
    {"goto_host", MAIN("start(); __asm__ volatile(\"goto 0x400004\");")},
    {"call_host", MAIN("start(); __asm__ volatile(\"mov #5, w0\\n mov #6, w1\\n call 0x400008\");"), false},
    {"call_host_last", MAIN("scan(); __asm__ volatile(\"call 0x4001FE\");")},
    {"goto_handler_return", MAIN("start(); __asm__ volatile(\"goto 0x400200\");")},
    {"call_handler_return", MAIN("start(); __asm__ volatile(\"call 0x400200\");")},
    {"goto_beyond", MAIN("start(); __asm__ volatile(\"goto 0x400300\");")},
    {"ret_to_host",
     MAIN("start(); __asm__ volatile(\"mov #0x14, w0\\n push w0\\n mov #0x40, w0\\n push w0\\n return\");")},
    {"ret_to_handler_return",
     MAIN("start(); __asm__ volatile(\"mov #0x200, w0\\n push w0\\n mov #0x40, w0\\n push w0\\n return\");")},
    {"retfie_to_host",
     MAIN("start(); __asm__ volatile(\"mov #0x1E, w0\\n push w0\\n mov #0x40, w0\\n push w0\\n retfie\");")},
    {"retfie_to_handler_return",
     MAIN("start(); __asm__ volatile(\"mov #0x200, w0\\n push w0\\n mov #0x40, w0\\n push w0\\n retfie\");")},
    {"handler_return_in_callback",
     "void bad(void) { seen[0]++; __asm__ volatile(\"goto 0x400200\"); } int main(void) { start(); "
     "e_activate_agenda(bad, 10); while (1); }"},
    {"return_twice",
     "void bad(void) { seen[0]++; __asm__ volatile(\"mov #0x200, w0\\n push w0\\n mov #0x40, w0\\n push "
     "w0\"); } int main(void) { start(); e_activate_agenda(bad, 10); while (1); }"},
    {"uninitialised_pointer", MAIN("start(); __asm__ volatile(\"call w13\");")},
    {"computed_goto", MAIN("start(); __asm__ volatile(\"mov #0x6543, w0\\n goto w0\");")},
    {"retfie_bare", MAIN("start(); __asm__ volatile(\"retfie\");")},
    {"return_bare", MAIN("start(); __asm__ volatile(\"ulnk\\n return\");")},
    {"illegal", MAIN("start(); __asm__ volatile(\".pword 0xFFFFFE\\n .pword 0x018001\");")},
    {"longjmp_dead", MAIN("start(); { static jmp_buf b; longjmp(b, 1); }")},
    {"do_loop_wild",
     MAIN("start(); DCOUNT = 5; __asm__ volatile(\"do #100, 1f\\n nop\\n 1: nop\");  DOENDL "
          "= 0x100; DOSTARTL = 0x200;"),
     false},
    {"repeat_division", MAIN("start(); __asm__ volatile(\"mov #0, w2\\n repeat #17\\n div.ud w0, w2\");")},
    {"erase_own_row",
     MAIN("start(); TBLPAG = 0; NVMADRU = 0; NVMADR = (unsigned)main & 0xFFC0; NVMCON = "
          "0x4041; NVMKEY = 0x55; NVMKEY = 0xAA; NVMCONbits.WR = 1; spend(3000);"),
     std::nullopt},
    {"erase_vectors",
     MAIN("start(); e_activate_agenda(tick, 10); NVMADRU = 0; NVMADR = 0; NVMCON = 0x4041; "
          "NVMKEY = 0x55; NVMKEY = 0xAA; NVMCONbits.WR = 1; spend(3000);"),
     false},
    {"write_row_of_handles",
     MAIN("scan(); NVMADRU = 0; NVMADR = (unsigned)e_set_speed_left & 0xFFC0; NVMCON = 0x4041; NVMKEY = "
          "0x55; NVMKEY = 0xAA; NVMCONbits.WR = 1; spend(3000); e_set_speed_left(5);"),
     false},
    {"nvm_without_key", MAIN("start(); NVMADR = 0x1000; NVMCON = 0x4041; NVMCONbits.WR = 1; spend(3000);")},
    {"tblwt_everywhere",
     MAIN("start(); { unsigned i; for (i = 0; i < 60000; i += 2) __asm__ volatile(\"tblwtl w1, [w0]\"); }"),
     false},
    {"agenda_wild", MAIN("start(); e_activate_agenda((void (*)(void))0x1234, 10);")},
    {"agenda_host", MAIN("start(); e_activate_agenda(e_init_motors, 10);"), false},
    {"agenda_set_speed", MAIN("start(); e_activate_agenda((void (*)(void))e_set_speed_left, 1);"), false},
    {"agenda_init_scan", MAIN("start(); e_activate_agenda((void (*)(void))e_init_ad_scan, 100);"), false},
    {"agenda_main", MAIN("start(); e_activate_agenda((void (*)(void))main, 10);")},
    {"agenda_run_motor",
     MAIN("start(); { void run_left_motor(void); e_activate_agenda(run_left_motor, 1); "
          "e_set_agenda_cycle(run_left_motor, 1); e_set_speed_left(0); }"),
     false},
    {"agenda_negative",
     MAIN("start(); e_activate_agenda(tick, -1); e_set_agenda_cycle(tick, -30000); "
          "e_set_agenda_cycle(0, 5); e_destroy_agenda((void (*)(void))0x77);"),
     false},
    {"agendas_without_end",
     MAIN("start(); { unsigned i; for (i = 2; ; i += 2) e_activate_agenda((void (*)(void))i, 0); }")},
    {"agenda_heap_wrecked",
     "int main(void) { char *p; start(); e_activate_agenda(tick, 10); p = malloc(10); { int i; for (i = -60; "
     "i < 60; i++) p[i] = 0x33; } e_activate_agenda(start, 1000); e_destroy_agenda(tick); "
     "e_activate_agenda(spend == 0 ? start : tick, 5); while (1); }"},
    {"speed_extremes", MAIN("start(); for (;;) { e_set_speed_left(32767); e_set_speed_right(-32768); "
                            "e_set_speed(-32768, 32767); e_set_steps_left(-1); }")},
    {"prox_out_of_range", MAIN("scan(); for (;;) { seen[0] += e_get_prox(32000) + e_get_calibrated_prox(255) "
                               "+ e_get_ambient_light(9999); }")},
    {"acc_out_of_range", MAIN("scan(); seen[0] = e_get_acc(1000); seen[1] = e_get_micro_average(500, 30000); "
                              "seen[2] = e_get_micro(77);")},
    {"led_out_of_range", MAIN("start(); for (;;) { e_set_led(200, 7); e_set_led(9999, 2); }")},
    {"uart_dead",
     MAIN("start(); e_init_uart1(); e_send_uart1_char((char *)nowhere, 30000); while (e_uart1_sending());"),
     false},
    {"uart_odd_huge", MAIN("start(); e_init_uart1(); e_send_uart1_char((char *)0x27FF, -1); seen[0] = "
                           "e_getchar_uart1((char *)0x2801);")},
    {"printf_wild", MAIN("start(); { char b[10]; sprintf(b, \"%s %n %d\", (char *)odd, (int *)nowhere, 5); "
                         "sprintf(b, \"%100d\", 3); }")},
    {"memcpy_huge", MAIN("start(); memcpy((void *)seen, (void *)0x1000, 65535u);")},
    {"strlen_unended", MAIN("start(); { char *p = (char *)0x1000; memset(p, 65, 0x1800); seen[0] = "
                            "strlen(p); strcpy((char *)0x2000, p); }")},
    {"memset_served",
     MAIN("scan(); for (;;) memset((void *)e_mic_scan, one++, sizeof(int) * 3 * MIC_SAMP_NB);"), false},
    {"served_indices",
     MAIN("scan(); for (;;) { e_last_mic_scan_id = 60000u; e_last_acc_scan_id = 30000; tickAdcIsr = 65535u; "
          "e_ambient_ir[seen[0]++ & 7] = -1; seen[1] = e_get_acc(0); }")},
    {"served_as_code", MAIN("scan(); func = (void (*)(void))e_mic_scan; func();"), std::nullopt},
    {"served_byte_odd", MAIN("scan(); { volatile char *p = (volatile char *)e_acc_scan; int i; for (i = 0; i "
                             "< 300; i++) p[i] ^= p[299 - i]; } *(int *)((char *)e_acc_scan + one) = 3;")},
    {"free_twice", MAIN("start(); { char *p = malloc(20); free(p); free(p); free((void *)odd); p = "
                        "malloc(30); memset(p - 8, 0xFF, 60); free(p); malloc(5); }")},
    {"malloc_all", MAIN("start(); for (;;) { char *p = malloc(100); *p = 1; }"), false},
    {"divide_zero", MAIN("start(); seen[0] = 100 / zero;")},
    {"modulo_zero", MAIN("start(); seen[0] = 100 % zero;")},
    {"long_divide_zero", MAIN("start(); seen[0] = 100000L / (long)zero;")},
    {"divide_min",
     MAIN("start(); seen[0] = -32768 / (-one); seen[1] = (int)((-2147483647L - 1) / -(long)one);"), false},
    {"float_nonsense",
     MAIN("start(); { volatile float x = 0; seen[0] = 1 / x; seen[1] = (int)(1e30f * one); "
          "seen[2] = (int)sqrtf(-one); seen[3] = (int)(x / x); }"),
     false},
    {"acc_overflow",
     MAIN("start(); CORCONbits.SATA = 0; INTCON1bits.COVTE = 1; INTCON1bits.OVATE = 1; __asm__ "
          "volatile(\"mov #0x7FFF, w4\\n mpy w4*w4, a\\n repeat #600\\n mac w4*w4, a\");")},
    {"sleep_forever", MAIN("scan(); IEC0 = 0; IEC1 = 0; IEC2 = 0; Sleep();"), false},
    {"idle_forever", MAIN("scan(); IEC0 = 0; IEC1 = 0; IEC2 = 0; Idle();"), false},
    {"idle_masked", MAIN("scan(); SRbits.IPL = 7; for (;;) Idle();")},
    {"wait_never", MAIN("scan(); while (!seen[3]);"), false},
    {"reset_forever", MAIN("start(); __asm__ volatile(\"reset\");"), true},
    {"main_returns", "int main(void) { scan(); return 7; }"},
    {"exit_failure", "int main(void) { scan(); exit(3); }"},
    {"abort", "int main(void) { scan(); abort(); }"},
    {"callback_endless",
     "void bad(void) { while (1) seen[0]++; } int main(void) { scan(); e_activate_agenda(bad, 10); while "
     "(1); }"},
    {"callback_resets_agendas",
     "void bad(void) { e_end_agendas_processing(); e_start_agendas_processing(); e_destroy_agenda(bad); "
     "e_activate_agenda(bad, 1); seen[0]++; } int main(void) { scan(); e_activate_agenda(bad, 1); while (1); "
     "}",
     false},
    {"callback_inits",
     "void bad(void) { e_init_motors(); e_init_ad_scan(ALL_ADC); seen[0]++; } int main(void) { scan(); "
     "e_activate_agenda(bad, 1000); while (1); }",
     false},
};

sim::WorldDesc two_robots(const std::string& name, const std::string& program) {
  sim::WorldDesc world = hal_test::world_with("hostile-" + name, program);
  world.robots.resize(2);
  world.robots[0].name = "bad";
  world.robots[1].name = "good";
  world.robots[1].firmware = "braitenberg";
  world.robots[1].pose.x_m = 0.6;
  return world;
}

struct Outcome {
  std::uint64_t bad = 0, good = 0;
  std::size_t told = 0;
};
Outcome outcome_of(const sim::WorldDesc& world) {
  const hal_test::Flight flight(world, "sim", "-O1", kHostileSeconds);
  if (!flight.is_there()) return {};
  host::Runner& bad = *flight.twin().mind(0).runner();
  EXPECT_TRUE(flight.twin().mind(1).runner()->traps().empty());
  // so few are kept, whatever it does
  EXPECT_LE(bad.traps().size(), 64u);
  EXPECT_LE(bad.diagnoses().size(), 2000u);
  return {flight.twin().mind(0).state_hash(), flight.twin().mind(1).state_hash(),
          bad.traps().size() + bad.diagnoses().size()};
}

class HostileHalTest : public ::testing::TestWithParam<HostileProgram> {};

TEST_P(HostileHalTest, is_contained_told_and_repeated) {
  static const std::uint64_t alone = outcome_of(two_robots("none", "int main(void) { while (1); }")).good;
  const HostileProgram& p = GetParam();
  const sim::WorldDesc world = two_robots(p.name, std::string(kHostileHead) + p.program);
  const Outcome first = outcome_of(world), again = outcome_of(world);
  EXPECT_EQ(first.good, alone) << "the robot beside it has noticed";
  EXPECT_EQ(first.bad, again.bad);
  EXPECT_EQ(first.told, again.told);
  EXPECT_EQ(first.told > 0, p.is_told.value_or(first.told > 0));
}

INSTANTIATE_TEST_SUITE_P(Programs, HostileHalTest, ::testing::ValuesIn(kHostile),
                         [](const auto& info) { return std::string(info.param.name); });

/// Output of a command but for the time that it took.
std::string said_by(const std::string& command) {
  std::string all;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "";
  char line[4096];
  while (std::fgets(line, sizeof line, pipe)) {
    std::string text = line;
    if (const auto at = text.find(" simulated in "); at != std::string::npos)
      text.erase(at, text.find("seed", at) - at);
    all += text;
  }
  return all + std::to_string(pclose(pipe));
}

// all of them at once, each time in a process that lies elsewhere in memory
TEST(HostileHal, has_one_digest_wherever_memory_lies) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "it runs the command, which is not built there";
#endif
  const std::filesystem::path tests = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests";
  const std::string world = (tests / "hostile.toml").string();
  std::ofstream file(world);
  file << "twinpuck = 1\n";
  int count = 0;
  for (const HostileProgram& p : kHostile) {
    hal_test::world_with(std::string("hostile-") + p.name, std::string(kHostileHead) + p.program);
    file << "[[robot]]\nname = \"" << p.name << "\"\nfirmware = \""
         << (tests / (std::string("hal-hostile-") + p.name)).string() << "\"\nposition = ["
         << 0.3 * (count % 12) << ", " << 0.3 * (count / 12) << "]\n";
    ++count;
  }
  file.close();
  const std::string command =
      std::string(TWINPUCK_BUILD_DIR) + "/twinpuck run " + world + " --hal sim --for 0.2 2>&1";
  const std::string first = said_by(command);
  EXPECT_NE(first.find("digest"), std::string::npos) << first;
  EXPECT_EQ(first.back(), '8') << "exit code 3: " << first.substr(0, 2000);
  for (int again = 0; again < 3; ++again) EXPECT_EQ(said_by(command), first);
}

}  // namespace
