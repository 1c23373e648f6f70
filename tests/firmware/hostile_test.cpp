// SPDX-License-Identifier: MIT
// Programs that do what no program should, built with --sanitize. Whatever it is, it is told with the line at
// fault (marked HERE, where it has one), and the other robots go on.
#include <algorithm>

#include "tests/support/firmware_test.h"

namespace {

using firmware_test::FirmwareTest;
using firmware_test::Robot;

struct Hostile {
  const char* name;
  const char* says;     ///< part of what is told
  const char* program;  ///< between the includes and the end; has a main()
};

void PrintTo(const Hostile& h, std::ostream* out) { *out << h.name; }

class HostileProgram : public FirmwareTest, public ::testing::WithParamInterface<Hostile> {};

int line_of(const std::string& text, const std::string& mark) {
  const std::size_t at = text.find(mark);
  return at == std::string::npos
             ? 0
             : 1 + static_cast<int>(
                       std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

TEST_P(HostileProgram, is_told_and_harms_no_other) {
  options.sanitize = true;
  const Hostile& h = GetParam();
  const std::string source = std::string(
                                 "#include <p30F6014A.h>\n"
                                 "#include <stdio.h>\n"
                                 "#include <stdlib.h>\n"
                                 "#include <string.h>\n"
                                 "#include <math.h>\n"
                                 "#include <motor_led/e_init_port.h>\n"
                                 "#include <motor_led/advance_one_timer/e_agenda.h>\n"
                                 "#include <motor_led/advance_one_timer/e_motors.h>\n"
                                 "#include <a_d/advance_ad_scan/e_ad_conv.h>\n"
                                 "#include <a_d/advance_ad_scan/e_prox.h>\n"
                                 "#include <a_d/advance_ad_scan/e_micro.h>\n"
                                 "#include <camera/fast_2_timer/e_poxxxx.h>\n"
                                 "#include <fft/e_fft.h>\n"
                                 "#include <fft/e_fft_utilities.h>\n"
                                 "#include <assert.h>\n"
                                 "#include <setjmp.h>\n"
                                 "#include <dsp.h>\n"
                                 "#include <twinpuck/virtual.h>\n"
                                 "#include <uart/e_uart_char.h>\n"
                                 "volatile int one = 1, zero = 0, sink; volatile long far = 100000;\n"
                                 "void *volatile nowhere;\n") +
                             h.program + "\n";
  Robot& bad = add_robot_with_source(source, "bad").at(0, 0.5);
  Robot& good = add_robot("blink", "good").at(0.5, 0);
  run_for(0.5);
  EXPECT_TRUE(good.traps().empty());
  EXPECT_GT(good.cycles(), 7'000'000);
  const int line = line_of(source, "HERE");
  std::string all = bad.diagnoses_text();
  bool is_told = line == 0 && all.find(h.says) != std::string::npos;
  for (const host::TrapReport& trap : bad.traps()) {
    all += trap.message + " at " + to_string(trap.place) + "\n";
    is_told |= trap.message.find(h.says) != std::string::npos && (line == 0 || trap.place.line == line);
  }
  EXPECT_TRUE(is_told) << "line " << line << ": " << all;
}

const Hostile kPrograms[] = {
    {"global_overrun_upwards", "write out of bounds of a: got byte 100, expected 0 to 99",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i < 10240; i++)\n a[i] = i; /* HERE */\n while (1); }"},
    {"global_overrun_read", "read out of bounds of a: got byte 100, expected 0 to 99",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i < 10240; i++)\n sink += a[i]; /* HERE */\n while (1); }"},
    {"global_overrun_downwards", "write out of bounds of a: got byte -1",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i > -10240; i--)\n a[i] = i; /* HERE */\n while (1); }"},
    {"global_index_far_beyond", "array index out of bounds",
     "long a[100];\n"
     "int main(void) {\n a[32767 * one] = 1; /* HERE */\n while (1); }"},
    {"global_index_far_below", "array index out of bounds",
     "long a[100];\n"
     "int main(void) {\n a[-32767 * one] = 1; /* HERE */\n while (1); }"},
    {"global_memset_too_long", "in memset(): write out of bounds of a: got byte 100, expected 0 to 99",
     "char a[100];\n"
     "int main(void) {\n memset(a, 1, 30000 * one); /* HERE */\n while (1); }"},
    {"copy_of_too_much", "in memmove(): read out of bounds of b",
     "char a[100], b[100];\n"
     "int main(void) {\n memmove(a, b, 30000 * one); /* HERE */\n while (1); }"},
    {"heap_overrun", "write out of the bounds of a heap block: got byte 10, expected 0 to 9",
     "int main(void) { char *p = malloc(10); int i; for (i = 0; i < 20000; i++)\n p[i] = 1; /* HERE */\n "
     "while (1); }"},
    {"malloc_that_failed", "write through a null pointer",
     "int main(void) { char *p = malloc(30000);\n p[0] = 1; /* HERE */\n while (1); }"},
    {"local_overrun_upwards", "write out of bounds of the local variable a: got byte 100",
     "int main(void) { volatile char a[100]; long i; for (i = 0; i < far; i++)\n a[i] = 0; /* HERE */\n "
     "while (1); }"},
    {"local_index_far_below", "array index out of bounds",
     "int main(void) { volatile long a[10];\n a[-far] = 0; /* HERE */\n while (1); }"},
    {"endless_recursion", "stack overflow in down()",
     "int down(int n) { /* HERE */\n volatile char a[50]; a[0] = n; return down(n + 1) + a[0]; }\n"
     "int main(void) { sink = down(0); while (1); }"},
    {"recursion_with_large_frames", "stack overflow in down()",
     "int down(int n) { /* HERE */\n volatile char a[3000]; a[2900] = n; return down(n + 1) + a[2900]; }\n"
     "int main(void) { sink = down(0); while (1); }"},
    {"huge_alloca", "write beyond the top of the stack",
     "char *volatile p;\n"
     "int main(void) { int i; for (i = 0; i < 20; i++)\n p = __builtin_alloca(50000u); /* HERE */\n while "
     "(1); }"},
    {"null_read", "read through a null pointer",
     "int main(void) {\n sink = *(int *)nowhere; /* HERE */\n while (1); }"},
    {"null_write", "write through a null pointer",
     "struct s { int a[20]; };\n"
     "int main(void) {\n ((struct s *)nowhere)->a[7] = 1; /* HERE */\n while (1); }"},
    {"wild_write", "write beyond the top of the stack",
     "int main(void) {\n *(volatile char *)(0x1234 + zero) = 1; /* HERE */\n while (1); }"},
    {"null_call", "a call through a null pointer leads to address 0",
     "int main(void) {\n ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"wild_call", "0x018000, where there is no flash",
     "int main(void) {\n ((void (*)(void))(0x4321 + zero))(); /* HERE */\n while (1); }"},
    {"call_of_data", "where there is no flash",
     "char code[16] = {(char)0xC3};\n"
     "int main(void) {\n ((void (*)(void))code)(); /* HERE */\n while (1); }"},
    {"call_of_a_constant", "where there is no flash",
     "const char code[16] = {(char)0xC3};\n"
     "int main(void) { nowhere = (void *)code;\n ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"call_of_the_stack", "where there is no flash",
     "int main(void) { volatile char code[16]; code[0] = (char)0xC3; nowhere = (void *)code;\n"
     " ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"write_to_a_constant", "is written, where nothing is; constants of the flash are read there",
     "const int table[4] = {1, 2, 3, 4};\n"
     "int main(void) { nowhere = (void *)table;\n *(int *)nowhere = 5; /* HERE */\n while (1); }"},
    {"write_to_a_string", "is written, where nothing is; constants of the flash are read there",
     "char *volatile text = \"hello\";\n"
     "int main(void) {\n text[0] = 'H'; /* HERE */\n while (1); }"},
    {"return_address_overwritten", "write out of bounds of the local variable a: got byte",
     "__attribute__((noinline)) void smash(void) { volatile long a[4]; int i;\n"
     " for (i = 0; i < 40; i++) a[i] = 0x4141; } /* HERE */\n"
     "int main(void) {\n volatile long room[100]; room[0] = 0;\n smash();\n while (1); }"},
    {"return_address_from_memcpy", "in memcpy(): write out of bounds of the local variable a: got byte 8",
     "char big[200];\n"
     "__attribute__((noinline)) void smash(void) { char a[8];\n"
     " memcpy(a, big, 100 * one); sink = a[0]; } /* HERE */\n"
     "int main(void) { volatile long room[100]; room[0] = 0;\n smash();\n while (1); }"},
    {"division_by_zero", "division by zero",
     "int main(void) {\n sink = 10 / zero; /* HERE */\n while (1); }"},
    {"long_remainder_of_zero", "division by zero",
     "int main(void) { long z = zero;\n sink = (int)(100000L % z); /* HERE */\n while (1); }"},
    {"wide_quotient_of_zero", "division by zero",
     "int main(void) { long long z = zero;\n sink = (int)(5LL / z); /* HERE */\n while (1); }"},
    {"wide_remainder_of_zero", "division by zero",
     "int main(void) { long long z = zero;\n sink = (int)(-5000000000LL % z); /* HERE */\n while (1); }"},
    {"wide_unsigned_quotient_of_zero", "division by zero",
     "int main(void) { unsigned long long z = zero;\n sink = (int)(5000000000ULL / z); /* HERE */\n while "
     "(1); }"},
    {"wide_unsigned_remainder_of_zero", "division by zero",
     "int main(void) { unsigned long long z = zero;\n sink = (int)(5ULL % z); /* HERE */\n while (1); }"},
    {"unreachable_reached", "the program does what C leaves undefined",
     "__attribute__((noinline)) int f(int n) { if (n == 0) return 1;\n"
     " __builtin_unreachable(); /* HERE */\n }\n"
     "int main(void) { sink = f(one); while (1); }"},
    {"builtin_trap", "abort()", "int main(void) {\n __builtin_trap(); /* HERE */\n }"},
    {"abort_called", "abort()", "int main(void) {\n abort(); /* HERE */\n }"},
    {"comparator_that_jumps_away", "write through a null pointer",
     "int a[10];\n"
     "int worse(const void *x, const void *y) {\n *(int *)nowhere = 1; return 1; } /* HERE */\n"
     "int main(void) { qsort(a, 10, sizeof a[0], worse); while (1); }"},
    {"comparator_that_is_none", "a call through a null pointer",
     "int a[10];\n"
     "int main(void) {\n qsort(a, 10, sizeof a[0], (int (*)(const void *, const void *))nowhere); /* HERE "
     "*/\n while (1); }"},
    {"sort_of_too_much", "",
     "int a[10];\n"
     "int worse(const void *x, const void *y) { return 1; }\n"
     "int main(void) {\n qsort(a, 30000, 2, worse); /* HERE */\n while (1); }"},
    {"text_from_nowhere", "in format_into(): read beyond the top of the stack",
     "char out[50];\n"
     "int main(void) {\n sprintf(out, \"%s\", (char *)(5000 + zero)); /* HERE */\n while (1); }"},
    {"length_of_nothing", "read through a null pointer",
     "int main(void) {\n sink = strlen(nowhere); /* HERE */\n while (1); }"},
    {"copy_to_nowhere", "write through a null pointer",
     "int main(void) {\n strcpy(nowhere, \"abc\"); /* HERE */\n while (1); }"},
    {"null_agenda", "agenda without a function",
     "int main(void) { e_init_port();\n e_activate_agenda((void (*)(void))nowhere, 10);\n"
     " e_start_agendas_processing(); while (1); }"},
    {"agenda_that_faults", "write through a null pointer",
     "void bad(void) {\n *(int *)nowhere = 1; } /* HERE */\n"
     "int main(void) { e_init_port(); e_activate_agenda(bad, 10); e_start_agendas_processing(); while (1); "
     "}"},
    {"interrupt_that_faults", "division by zero",
     "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {\n IFS0bits.T1IF = 0; sink = 1 / zero; } "
     "/* HERE */\n"
     "int main(void) { PR1 = 1000; T1CON = 0x8000; IEC0bits.T1IE = 1; while (1); }"},
    {"interrupts_off_for_ever", "integer overflow in an addition",
     "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; }\n"
     "int main(void) { PR1 = 1000; T1CON = 0x8000; IEC0bits.T1IE = 1; SRbits.IPL = 7;\n while (1) sink++; /* "
     "HERE */\n }"},
    {"picture_to_nowhere", ", where nothing is",
     "int main(void) { e_init_port(); e_poxxxx_init_cam(); e_poxxxx_config_cam(0, 0, 640, 480, 8, 8, "
     "RGB_565_MODE);\n"
     " e_poxxxx_write_cam_registers(); e_poxxxx_launch_capture((char *)nowhere);\n"
     " while (!e_poxxxx_is_img_ready());\n while (1); }"},
    {"uart_text_from_nowhere", "read through a null pointer",
     "int main(void) { e_init_uart1();\n e_send_uart1_char(nowhere, 10); /* HERE */\n while (1); }"},
    {"mean_of_too_much", "in e_subtract_mean(): read out of bounds of few",
     "int few[4];\n"
     "int main(void) {\n e_subtract_mean(few, 30000, 8); /* HERE */\n while (1); }"},
    {"squares_of_too_much", "in SquareMagnitudeCplx(): read out of bounds of few",
     "fractcomplex few[4]; fractional out[4];\n"
     "int main(void) {\n SquareMagnitudeCplx(30000, few, out); /* HERE */\n while (1); }"},
    {"transform_of_nothing", "a word at the odd address 0x010d is read",
     "int main(void) {\n FFTComplexIP(8, nowhere, (fractcomplex *)nowhere, 0); /* HERE */\n while (1); }"},
    {"jump_out_of_nowhere", "stack underflow",
     "jmp_buf never_set;\n"
     "int main(void) {\n longjmp(never_set, 1);\n }"},
    {"assertion", "an assert() failed", "int main(void) {\n assert(zero); /* HERE */\n while (1); }"},
    {"free_of_nonsense", "free() of what malloc() did not give",
     "int main(void) {\n free((void *)(5000 + zero)); /* HERE */\n while (1); }"},
    {"exit_with_a_failure", "exit() with a failure", "int main(void) {\n exit(3); /* HERE */\n }"},
    {"pointer_in_a_local_struct_never_set",
     "local is read, and nobody has written it; an address is made of it",
     "struct s { int n; int *p; };\n"
     "__attribute__((noinline)) void use(struct s *s) {\n *s->p = 3; } /* HERE */\n"
     "int main(void) { struct s local; local.n = 1; use(&local); while (1); }"},
    {"pointer_in_the_heap_never_set",
     "a heap block is read, and nobody has written it; an address is made of it",
     "struct s { int n; int *p; };\n"
     "int main(void) { struct s *s = malloc(sizeof *s);\n *s->p = 3; /* HERE */\n while (1); }"},
};

INSTANTIATE_TEST_SUITE_P(Every, HostileProgram, ::testing::ValuesIn(kPrograms),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
