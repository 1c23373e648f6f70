// SPDX-License-Identifier: MIT
// What agendas' functions and programs do to Timer 2's interrupt, which hal_sim knows by heart: the same
// program under hal_dspic is the yardstick for counts, traps, what is told, load and pose.
#include <algorithm>
#include <cmath>

#include "tests/chip/hal_flight.h"

namespace {

using hal_test::Flight;
using hal_test::world_with;

constexpr double kSecondsRun = 0.5, kSamePlace = 0.001, kSameLoad = 0.01;
constexpr std::size_t kSeen = 16;

enum Place {
  kAlike,      // a trap is told with the same place
  kElsewhere,  // the program has left its code: where it is found differs
  kTwice,  // ... and who runs there; a motor's tick is another; a handler that is left for another one counts
           // as work or not
  kOtherWay,  // it goes on with what is left of the handler's frame, which hal_sim has not
};

struct Injected {
  const char* name;
  const char* program;
  int off_by = 0;  // counts: what a handler known by heart is charged at once is one step
  Place place = kAlike;
};

void PrintTo(const Injected& c, std::ostream* out) { *out << c.name; }

const std::string kInjectedHead = R"(
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <setjmp.h>
volatile int seen[16]; volatile int zero; volatile unsigned odd = 0x1001;
void start(void) { e_init_port(); e_init_motors(); e_start_agendas_processing(); }
void spend(unsigned n) { while (n--) __asm__ volatile("nop"); }
)";
// bad() in assembler text: what is between, then RETURN
#define BAD(text)                                                                           \
  "void bad(void);\n__asm__(\".section .text,code\\n.global _bad\\n_bad: inc _seen\\n" text \
  "return\\n\");"                                                                           \
  "\n"
#define ENDS_IN_MAIN "int main(void) { start(); seen[9]++; e_activate_agenda(bad, 10); while (1) seen[8]++; }"

// sections that hold handlers off, over and over: rounds in sixteens, and steps
#define SECTIONS(more, begin, inside, end, outside)                                                     \
  "void count(void) { if (++seen[8] % 16 == 0) { seen[0]++; seen[1] = e_get_steps_left(); } }\n"        \
  "int main(void) { start(); " more "e_set_speed_left(500); e_set_speed_right(300); while (1) { " begin \
  " for (odd = 0; odd < " #inside "; odd++); " end " for (odd = 0; odd < " #outside "; odd++); count(); } }"

// seen[8] counts rounds of the main loop: not compared
const Injected kInjected[] = {
    // --- returns that lead elsewhere
    {"ret_erased", BAD("mov #0x2000, w0\\nmov w0, [w15-4]\\nmov #1, w0\\nmov w0,[w15-2]\\n") ENDS_IN_MAIN, 0,
     kElsewhere},
    {"ret_beyond", BAD("mov #0x2000, w0\\nmov w0, [w15-4]\\nmov #0x11, w0\\nmov w0,[w15-2]\\n") ENDS_IN_MAIN,
     0, kElsewhere},
    {"ret_zero", BAD("clr w0\\nmov w0, [w15-4]\\nmov w0,[w15-2]\\n") ENDS_IN_MAIN, 0, kElsewhere},
    {"ret_ffff", BAD("setm w0\\nmov w0, [w15-4]\\nmov w0,[w15-2]\\n") ENDS_IN_MAIN, 0, kElsewhere},
    {"ret_host", BAD("mov #0x10, w0\\nmov w0, [w15-4]\\nmov #0x40,w0\\nmov w0,[w15-2]\\n") ENDS_IN_MAIN, 0,
     kElsewhere},
    {"ret_low_only", BAD("mov #0x3000, w0\\nmov w0, [w15-4]\\n") ENDS_IN_MAIN, 0, kOtherWay},
    {"ret_high_only", BAD("mov #0x1, w0\\nmov w0, [w15-2]\\n") ENDS_IN_MAIN, 0, kElsewhere},
    {"ret_popped_one", BAD("sub w15,#2,w15\\n") ENDS_IN_MAIN, 0, kOtherWay},
    {"ret_pushed_one", BAD("push w0\\n") ENDS_IN_MAIN, 0, kOtherWay},
    {"ret_retfie", BAD("retfie\\n") ENDS_IN_MAIN},
    {"ret_to_main",
     "jmp_buf back; void bad(void){ seen[0]++; longjmp(back, 1); }\nint main(void){ if (setjmp(back)) { "
     "seen[1] = SRbits.IPL; seen[2]++; while(1) seen[8]++; } start(); e_activate_agenda(bad, 10); while(1) "
     "seen[8]++; }"},
    {"stack_wrecked",
     "void bad(void){ volatile int a[2]; int i; a[0]=1; for(i=-12;i<0;i++) a[i]=0x5a5a; seen[0]++; "
     "}\n" ENDS_IN_MAIN,
     0, kElsewhere},
    // --- traps within
    {"trap_odd_none", "void bad(void){ seen[0]++; seen[3] += *(int*)odd; }" ENDS_IN_MAIN},
    {"trap_div_none", "void bad(void){ seen[0]++; seen[3] = 100 / zero; }" ENDS_IN_MAIN},
    {"trap_stk_none",
     "int down(int n){ volatile int a[30]; a[0]=n; return down(n+1)+a[0]; } void bad(void){ seen[0]++; "
     "seen[4]=down(0); }" ENDS_IN_MAIN},
    {"trap_odd_own",
     "void __attribute__((interrupt,no_auto_psv)) _AddressError(void){ INTCON1bits.ADDRERR=0; seen[1]++; "
     "odd=0x1000; }void bad(void){ seen[0]++; seen[3] += *(int*)odd; }" ENDS_IN_MAIN},
    {"trap_div_own",
     "void __attribute__((interrupt,no_auto_psv)) _MathError(void){ INTCON1bits.MATHERR=0; seen[1]++; "
     "zero=1; }void bad(void){ seen[0]++; seen[3] = 100 / zero; }" ENDS_IN_MAIN},
    {"trap_stk_own",
     "void __attribute__((interrupt,no_auto_psv)) _StackError(void){ INTCON1bits.STKERR=0; seen[1]++; "
     "while(1) seen[2]++; }int down(int n){ volatile int a[30]; a[0]=n; return down(n+1)+a[0]; } void "
     "bad(void){ seen[0]++; seen[4]=down(0); }" ENDS_IN_MAIN},
    {"trap_host", "void bad(void){ seen[0]++; ((void(*)(void))0x1234)(); }" ENDS_IN_MAIN, 0, kElsewhere},
    {"data_agenda",
     "int data[4]; int main(void){ start(); e_activate_agenda((void(*)(void))data, 10); while(1) seen[8]++; "
     "}",
     0, kElsewhere},
    {"odd_agenda",
     "void bad(void){seen[0]++;} int main(void){ start(); "
     "e_activate_agenda((void(*)(void))((unsigned)bad+1), 10); while(1); }"},
    {"t2_vector_flag_in_trap",
     "void __attribute__((interrupt,no_auto_psv)) _MathError(void){ INTCON1bits.MATHERR=0; seen[1]++; "
     "seen[2]=SRbits.IPL; zero=1; } void bad(void){ seen[0]++; seen[3]=7/zero; zero=0; } int main(void){ "
     "start(); e_activate_agenda(bad,10); while(1); }"},
    {"div_main_motor",
     "void run_left_motor(void); void bad(void){ seen[0]++; run_left_motor(); } int main(void){ start(); "
     "e_activate_agenda(bad,50); while(1); }",
     0, kElsewhere},
    {"motor_zero",
     "void run_left_motor(void); int main(void){ start(); e_set_agenda_cycle(run_left_motor, 50); while(1); "
     "}",
     0, kElsewhere},
    {"reset_in", "void bad(void){ seen[0]++; Reset(); } " ENDS_IN_MAIN},
    {"null_agenda", "int main(void){ seen[5]++; start(); e_activate_agenda(0, 10); while(1) seen[8]++; }", 0,
     kElsewhere},
    {"null_call", "void bad(void){ void (*volatile f)(void)=0; seen[0]++; f(); }" ENDS_IN_MAIN},
    // --- levels and flags
    {"nstdis",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; seen[5]=SRbits.IPL; spend(800); } int "
     "main(void){ INTCON1bits.NSTDIS=1; start(); t1(6); e_activate_agenda(bad,10); while(1); }",
     20},
    {"nesting_above",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; seen[5]=SRbits.IPL; spend(800); } int "
     "main(void){ start(); t1(6); e_activate_agenda(bad,10); while(1); }",
     100},
    {"nesting_below",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; seen[5]=SRbits.IPL; spend(800); } int "
     "main(void){ start(); t1(3); e_activate_agenda(bad,10); while(1); }",
     20},
    {"nesting_equal",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; seen[5]=SRbits.IPL; spend(800); } int "
     "main(void){ start(); t1(4); e_activate_agenda(bad,10); while(1); }",
     20},
    {"ipl_3",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,7); for(i=0;i<20;i++){ SRbits.IPL=3; seen[1]=seen[0]; spend(9000); "
     "seen[2]+=seen[0]-seen[1]; SRbits.IPL=0; spend(20000);} while(1); }",
     1},
    {"ipl_4",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,7); for(i=0;i<20;i++){ SRbits.IPL=4; seen[1]=seen[0]; spend(9000); "
     "seen[2]+=seen[0]-seen[1]; SRbits.IPL=0; spend(20000);} while(1); }",
     1},
    {"ipl_7",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,7); for(i=0;i<20;i++){ SRbits.IPL=7; seen[1]=seen[0]; spend(9000); "
     "seen[2]+=seen[0]-seen[1]; SRbits.IPL=0; spend(20000);} while(1); }",
     1},
    {"disi",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,7); for(i=0;i<20;i++){ __asm__ volatile(\"disi #0x3FFF\"); seen[1]=seen[0]; "
     "spend(3000); seen[2]+=seen[0]-seen[1]; spend(20000);} while(1); }",
     2},
    {"t2ie_off",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,7); for(i=0;i<20;i++){ IEC0bits.T2IE=0; seen[1]=seen[0]; spend(9000); "
     "seen[2]+=seen[0]-seen[1]; IEC0bits.T2IE=1; spend(20000);} while(1); }"},
    {"t2ie_off_cleared",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,1); for(i=0;i<20;i++){ IEC0bits.T2IE=0; spend(300); IFS0bits.T2IF=0; "
     "seen[1]=seen[0]; IEC0bits.T2IE=1; seen[2]+=seen[0]-seen[1]; spend(4000);} while(1); }"},
    {"t2if_polled",
     "int main(void){ int i; start(); IEC0bits.T2IE=0; IFS0bits.T2IF=0; for(i=0;i<100;i++){ "
     "while(!IFS0bits.T2IF); IFS0bits.T2IF=0; seen[0]++; } seen[1]=1; while(1); }"},
    {"t2ip_0",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,7); spend(20000); "
     "seen[1]=seen[0]; IPC1bits.T2IP=0; spend(20000); seen[2]=seen[0]; IPC1bits.T2IP=6; spend(20000); "
     "seen[3]=seen[0]; while(1); }"},
    {"t2ip_6",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; seen[5]=SRbits.IPL; spend(800); } int "
     "main(void){ IPC1bits.T2IP=6; start(); t1(5); e_activate_agenda(bad,10); while(1); }",
     20},
    {"t2if_set",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_activate_agenda(bad,1000); "
     "for(i=0;i<999;i++) { IFS0bits.T2IF=1; spend(50);} seen[1]=seen[0]; while(1); }"},
    {"t2if_set_fast",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,1); while(1) { "
     "IFS0bits.T2IF=1; spend(300); seen[1]++; } }",
     100},
    {"t2if_set_within",
     "void bad(void){ seen[0]++; if (seen[0] < 50) IFS0bits.T2IF=1; } int main(void){ start(); "
     "e_set_speed_left(300); e_activate_agenda(bad,10); while(1); }"},
    {"t2if_set_unstarted",
     "void bad(void){ seen[0]++; } int main(void){ int i; e_init_motors(); e_activate_agenda(bad,3); "
     "IEC0bits.T2IE=1; for(i=0;i<30;i++){ IFS0bits.T2IF=1; spend(10);} while(1); }"},
    {"adif_set",
     "extern unsigned tickAdcIsr; int main(void){ int i; unsigned t; e_init_port(); e_init_ad_scan(0); "
     "t=tickAdcIsr; for(i=0;i<100;i++){ IFS0bits.ADIF=1; spend(50);} seen[0]=(tickAdcIsr-t)/8; while(1); }",
     20},
    {"adie_off",
     "extern unsigned tickAdcIsr; int main(void){ unsigned t; e_init_port(); e_init_ad_scan(0); "
     "IEC0bits.ADIE=0; t=tickAdcIsr; spend(20000); seen[0]=tickAdcIsr-t; IEC0bits.ADIE=1; spend(20000); "
     "seen[1]=tickAdcIsr-t; while(1); }"},
    {"remote_nested",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ unsigned t=TMR1; IFS0bits.T1IF=0; "
     "seen[1]++; if ((int)t > seen[2]) seen[2]=t; }\nvoid t1(int level){ PR1=5000; IPC0bits.T1IP=level; "
     "IEC0bits.T1IE=1; T1CONbits.TON=1; }\nvoid bad(void){ seen[0]++; IPC1bits.T2IP=0; seen[1]=SRbits.IPL; } "
     "int main(void){ start(); e_activate_agenda(bad,50); while(1); }"},
    {"own_level_in",
     "void bad(void){ seen[0]++; SRbits.IPL=0; spend(1000); } int main(void){ start(); "
     "e_set_speed_left(500); e_activate_agenda(bad,10); while(1); }",
     1, kTwice},
    // --- longer than a tick, than several
    {"long_1",
     "void bad(void){ seen[0]++; spend(500); } int main(void){ start(); e_set_speed_left(900); "
     "e_activate_agenda(bad,1); while(1) seen[8]++; }",
     50},
    {"long_3",
     "void bad(void){ seen[0]++; spend(1500); } int main(void){ start(); e_set_speed_left(900); "
     "e_activate_agenda(bad,5); while(1); }"},
    {"long_20",
     "void bad(void){ seen[0]++; spend(9000); } int main(void){ start(); e_set_speed_left(900); "
     "e_activate_agenda(bad,100); while(1); }"},
    {"long_scan",
     "void bad(void){ seen[0]++; spend(1500); } int main(void){ start(); e_init_ad_scan(0); "
     "e_set_speed_left(900); e_activate_agenda(bad,5); while(1); }"},
    {"endless_in_callback",
     "void bad(void){ seen[0]++; while(1) seen[1]=1; } int main(void){ start(); e_set_speed_left(900); "
     "e_activate_agenda(bad,5); while(1); }"},
    {"masked_for_good",
     "int main(void){ start(); e_init_ad_scan(0); e_set_speed_left(900); spend(20000); SRbits.IPL = 7; "
     "while(1) seen[8]++; }"},
    // --- callbacks that change the list
    {"destroy_self",
     "void bad(void){ seen[0]++; if (seen[0]==5) seen[1]=e_destroy_agenda(bad); } void other(void){ "
     "seen[2]++; } int main(void){ start(); e_activate_agenda(other,3); e_activate_agenda(bad,5); while(1); "
     "}"},
    {"destroy_next",
     "void other(void){ seen[2]++; } void third(void){ seen[3]++; } void bad(void){ seen[0]++; if "
     "(seen[0]==5) seen[1]=e_destroy_agenda(other); } int main(void){ start(); e_activate_agenda(third,5); "
     "e_activate_agenda(other,5); e_activate_agenda(bad,5); while(1); }"},
    {"pause_self",
     "void bad(void){ seen[0]++; if (seen[0]==5) e_pause_agenda(bad); } void other(void){ if "
     "(++seen[2]==100) e_restart_agenda(bad); } int main(void){ start(); e_activate_agenda(other,3); "
     "e_activate_agenda(bad,5); while(1); }"},
    {"activate_in",
     "void other(void){ seen[2]++; } void bad(void){ seen[0]++; if (seen[0]%4==0) "
     "e_activate_agenda(other,2); if (seen[0]%4==2) e_destroy_agenda(other); } int main(void){ start(); "
     "e_activate_agenda(bad,5); while(1); }"},
    {"recycle_self",
     "void bad(void){ seen[0]++; e_destroy_agenda(bad); e_activate_agenda(bad, 4); } int main(void){ "
     "start(); e_activate_agenda(bad,5); while(1); }"},
    {"cycle_self",
     "void bad(void){ seen[0]++; e_set_agenda_cycle(bad, 3 + (seen[0] & 15)); e_reset_agenda(bad); } int "
     "main(void){ start(); e_activate_agenda(bad,5); while(1); }"},
    {"stop_in",
     "void bad(void){ seen[0]++; if (seen[0]==9) e_end_agendas_processing(); } int main(void){ start(); "
     "e_activate_agenda(bad,5); spend(60000); seen[1]=seen[0]; e_start_agendas_processing(); spend(60000); "
     "while(1); }"},
    {"restart_in",
     "void bad(void){ seen[0]++; if (seen[0]%3==0) e_start_agendas_processing(); } int main(void){ start(); "
     "e_set_speed_left(400); e_activate_agenda(bad,5); while(1); }"},
    {"speed_in",
     "void bad(void){ seen[0]++; e_set_speed_left((seen[0]&1)?800:-300); e_set_speed_right(200); "
     "seen[1]=e_get_steps_left(); } int main(void){ start(); e_activate_agenda(bad,500); while(1); }"},
    {"motor_as_agenda",
     "void run_left_motor(void); int main(void){ start(); e_set_speed_left(400); "
     "e_set_agenda_cycle(run_left_motor, 50); while(1) seen[0]=e_get_steps_left(); }"},
    // --- Idle and Sleep
    {"idle_count",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,50); while(1) { Idle(); "
     "seen[1]++; } }",
     2},
    {"idle_scan",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_init_ad_scan(0); e_activate_agenda(bad,50); "
     "while(1) { Idle(); seen[1]++; } }",
     5000},
    {"idle_delay",
     "void bad(void){ seen[0]++; } int main(void){ int i; start(); e_activate_agenda(bad,1000); while(1) { "
     "for(i=0;i<500;i++) Idle(); seen[1]++; } }"},
    {"idle_masked",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,50); SRbits.IPL=5; Idle(); "
     "seen[1]++; Idle(); seen[1]++; SRbits.IPL=0; while(1); }"},
    {"idle_disi",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,50); spend(20000); __asm__ "
     "volatile(\"disi #0x3FFF\"); Idle(); seen[1]++; seen[2]=seen[0]; while(1); }"},
    {"idle_no_agenda", "int main(void){ start(); while(1) { Idle(); seen[1]++; } }"},
    {"sleep",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_activate_agenda(bad,50); spend(20000); "
     "Sleep(); seen[1]++; while(1); }"},
    {"sleep_t2",
     "void bad(void){ seen[0]++; } int main(void){ start(); e_set_speed_left(500); "
     "e_activate_agenda(bad,50); spend(20000); IEC0bits.T2IE=0; spend(3000); Sleep(); seen[1]++; while(1); "
     "}"},
    {"sleep_over_and_over",
     "int main(void){ start(); e_set_speed_left(500); while(1) { Sleep(); seen[0]=e_get_steps_left(); } }"},
    // --- sections held off, shorter than a tick, about as long, and longer: how ticks and frames fall on them
    {"sections_50_200", SECTIONS("", "SRbits.IPL = 7;", 50, "SRbits.IPL = 0;", 200), 2},
    {"sections_300_40", SECTIONS("", "SRbits.IPL = 7;", 300, "SRbits.IPL = 0;", 40), 3},
    {"sections_300_5", SECTIONS("", "__asm__ volatile(\"disi #0x3FFF\");", 300, "DISICNT = 0;", 5), 3},
    {"sections_300_200", SECTIONS("", "IEC0bits.T2IE = 0;", 300, "IEC0bits.T2IE = 1;", 200), 3},
    {"sections_700_40", SECTIONS("", "SRbits.IPL = 7;", 700, "SRbits.IPL = 0;", 40), 3},
    {"sections_scan_50_200", SECTIONS("e_init_ad_scan(0);", "SRbits.IPL = 7;", 50, "SRbits.IPL = 0;", 200),
     3},
    {"sections_scan_150_40", SECTIONS("e_init_ad_scan(0);", "SRbits.IPL = 7;", 150, "SRbits.IPL = 0;", 40),
     3},
    {"sections_scan_300_40", SECTIONS("e_init_ad_scan(0);", "SRbits.IPL = 7;", 300, "SRbits.IPL = 0;", 40),
     3},
    // a callback of 500 cycles at each tick: a frame comes once a tick, when it lets it in
    {"frames_between_callbacks_of_each_tick",
     "void spin(void){ for (odd = 0; odd < 100; odd++); } int main(void){ start(); e_init_ad_scan(0); "
     "e_activate_agenda(spin, 1); while (1) if (++seen[8] % 256 == 0) seen[0]++; }",
     6},
    // delay loops in a handler that takes half of the time
    {"handler_that_counts",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ IFS0bits.T1IF=0; "
     "for (odd = 0; odd < 100; odd++); } int main(void){ start(); e_init_ad_scan(1); PR1=2107; "
     "IPC0bits.T1IP=4; IEC0bits.T1IE=1; "
     "T1CONbits.TON=1; e_set_speed_left(300); while (1) seen[8]++; }"},
    {"short_delays_beside_the_scan",
     "int main(void){ int i; e_init_port(); e_init_ad_scan(0); while(1) { for(i=0;i<250;i++) __asm__ "
     "volatile(\"nop\"); seen[8]++; } }"},
    {"scan_begins_beside_a_long_handler",
     "void __attribute__((interrupt,no_auto_psv)) _T1Interrupt(void){ IFS0bits.T1IF=0; spend(150); } int "
     "main(void){ start(); PR1=9000; IPC0bits.T1IP=6; IEC0bits.T1IE=1; T1CONbits.TON=1; seen[0]=1; "
     "e_init_ad_scan(0); seen[1]=1; while(1); }",
     0, kTwice},
    // --- what a callback sees, and leaves alone
    {"sees",
     "void bad(void){ seen[0]++; seen[1]=SRbits.IPL; seen[2]=INTTREG; seen[3]=IFS0bits.T2IF; "
     "seen[4]=IEC0bits.T2IE; seen[5]=WREG15; seen[6]=CORCON; seen[7]=PR2; seen[10]=T2CON; } int main(void){ "
     "start(); e_activate_agenda(bad,50); while(1); }"},
    {"regs_kept",
     BAD("mov #0x1111,w0\\nmov w0,w1\\nmov w0,w2\\nmov w0,w3\\nmov w0,w4\\nmov w0,w5\\nmov w0,w6\\nmov "
         "w0,w7\\nmov w0, RCOUNT\\n") "int main(void){ start(); e_activate_agenda(bad,1); while(1){ register "
                                      "unsigned a=zero+1,b=zero+2,c=zero+3,d=zero+4,e=zero+5; int i; "
                                      "for(i=0;i<200;i++){a+=b;b+=c;c+=d;d+=e;} if (a!=seen[2]) {seen[1]++; "
                                      "seen[2]=a;} } }"},
};

class InjectedTest : public ::testing::TestWithParam<Injected> {};

/// What is told of the interrupt: who misses events, and who ran meanwhile.
std::string told(const Flight& flight, bool with_who) {
  std::string all;
  for (const board::Diagnosis& d : flight.twin().mind(0).runner()->diagnoses()) {
    if (d.cause != "missed interrupt") continue;
    all += with_who ? d.message : d.place;
    all += "\n";
  }
  return all;
}

TEST_P(InjectedTest, as_on_the_chip) {
  const Injected& c = GetParam();
  const sim::WorldDesc world = world_with(std::string("injected-") + c.name, kInjectedHead + c.program);
  const Flight sim(world, "sim", "-O1", kSecondsRun), dspic(world, "dspic", "-O1", kSecondsRun);
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  const auto here = sim.words("seen", kSeen), there = dspic.words("seen", kSeen);
  host::Runner &a = *sim.twin().mind(0).runner(), &b = *dspic.twin().mind(0).runner();
  // traps, each told with its place and counted
  if (c.place == kOtherWay) {
    EXPECT_FALSE(a.traps().empty());
    EXPECT_FALSE(b.traps().empty());
    return;
  }
  for (std::size_t i = 0; i < kSeen; ++i)
    if (i != 8) {
      EXPECT_NEAR(here[i], there[i], c.off_by) << "seen[" << i << "]";
    }
  ASSERT_EQ(a.traps().size(), b.traps().size());
  for (std::size_t i = 0; i < a.traps().size(); ++i) {
    EXPECT_EQ(a.traps()[i].vector, b.traps()[i].vector);
    EXPECT_EQ(a.traps()[i].kind, b.traps()[i].kind);
    if (c.place != kTwice) {
      EXPECT_EQ(a.traps()[i].message, b.traps()[i].message);
    }
    EXPECT_NEAR(static_cast<double>(a.traps()[i].count), static_cast<double>(b.traps()[i].count), 1);
    if (c.place == kAlike) {
      EXPECT_EQ(to_string(a.traps()[i].place), to_string(b.traps()[i].place));
    }
    EXPECT_NE(a.traps()[i].place.function, "?");
  }
  if (c.place == kTwice) return;
  EXPECT_NEAR(a.cpu_load(), b.cpu_load(), kSameLoad);
  const sim::Pose2 p = sim.twin().simulation().pose(0), q = dspic.twin().simulation().pose(0);
  EXPECT_LT(std::hypot(p.x_m - q.x_m, p.y_m - q.y_m), kSamePlace);
}

INSTANTIATE_TEST_SUITE_P(Callbacks, InjectedTest, ::testing::ValuesIn(kInjected),
                         [](const auto& info) { return std::string(info.param.name); });

// functions that take several ticks lose the same ones, and the same is told
TEST(Injected, lost_ticks_are_counted_and_told_as_on_the_chip) {
  for (const Injected& c : kInjected) {
    const std::string name = c.name;
    if (name != "long_3" && name != "long_20" && name != "long_scan" && name != "endless_in_callback" &&
        name != "ipl_7" && name != "masked_for_good")
      continue;
    SCOPED_TRACE(name);
    const sim::WorldDesc world = world_with("injected-" + name, kInjectedHead + c.program);
    const Flight sim(world, "sim", "-O1", kSecondsRun), dspic(world, "dspic", "-O1", kSecondsRun);
    EXPECT_NE(told(sim, true), "");
    const auto count = [](const Flight& flight, const char* vector) {
      double all = 0;
      for (const board::Diagnosis& d : flight.twin().mind(0).runner()->diagnoses())
        if (d.cause == "missed interrupt" && d.place == vector) all += static_cast<double>(d.count);
      return all;
    };
    // where an event falls just before or behind what holds the handler off, one in some
    // hundreds is another's
    for (const char* vector : {"T2", "ADC"})
      EXPECT_NEAR(count(sim, vector), count(dspic, vector), 1 + 0.005 * count(dspic, vector)) << vector;
    const auto sorted = [](std::string text) {
      std::vector<std::string> lines;
      for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
        lines.push_back(text.substr(0, end));
      std::sort(lines.begin(), lines.end());
      return lines;
    };
    EXPECT_EQ(sorted(told(sim, true)), sorted(told(dspic, true)));
    // what is held off for good is counted up to now: 10,000 ticks a second
    if (name == "masked_for_good" || name == "endless_in_callback") {
      EXPECT_GT(count(sim, "T2"), 9000 * (kSecondsRun - 0.25));
    }
  }
}

}  // namespace
