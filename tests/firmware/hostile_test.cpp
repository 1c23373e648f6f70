// SPDX-License-Identifier: MIT
// Programs that do what no program should. Whatever it is, the robot that runs it is named with the line at
// fault (marked HERE), and the other robots go on.
#include <algorithm>

#include "hal_sim/host/image_abi.h"
#include "tests/support/firmware_test.h"

namespace {

using firmware_test::FirmwareTest;
using firmware_test::Robot;

struct Hostile {
  const char* name;
  int kind;             ///< TP_TRAP_*
  const char* says;     ///< part of the message
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

TEST_P(HostileProgram, stops_its_robot_and_no_other) {
  is_native();
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer ends the process at what these programs do on purpose";
#endif
#if defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory of firmware lies beside other memory there, and an overrun meets that";
#endif
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
  run_for(2.0);
  EXPECT_TRUE(good.traps().empty());
  EXPECT_GT(good.cycles(), 2 * 14'000'000);
  ASSERT_FALSE(bad.traps().empty());
  const host::TrapReport& t = bad.traps().front();
  EXPECT_EQ(t.robot, "bad");
  EXPECT_EQ(t.kind, h.kind) << t.message;
  EXPECT_NE(t.message.find(h.says), std::string::npos) << t.message;
  EXPECT_EQ(t.place.line, line_of(source, "HERE")) << t.message << " at " << to_string(t.place);
  EXPECT_NE(t.place.file.find("main.c"), std::string::npos) << to_string(t.place);
}

const Hostile kPrograms[] = {
    {"global_overrun_upwards", TP_TRAP_ADDRESS, "left the program's memory",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i < 10240; i++)\n a[i] = i; /* HERE */\n while (1); }"},
    {"global_overrun_read", TP_TRAP_ADDRESS,
     "read through a pointer or index that has left the program's memory",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i < 10240; i++)\n sink += a[i]; /* HERE */\n while (1); }"},
    {"global_overrun_downwards", TP_TRAP_ADDRESS, "left the program's memory",
     "char a[100];\n"
     "int main(void) { int i; for (i = 0; i > -10240; i--)\n a[i] = i; /* HERE */\n while (1); }"},
    {"global_index_far_beyond", TP_TRAP_ADDRESS, "left the program's memory",
     "long a[100];\n"
     "int main(void) {\n a[32767 * one] = 1; /* HERE */\n while (1); }"},
    {"global_index_far_below", TP_TRAP_ADDRESS, "write",
     "long a[100];\n"
     "int main(void) {\n a[-32767 * one] = 1; /* HERE */\n while (1); }"},
    {"global_memset_too_long", TP_TRAP_ADDRESS, "write through a pointer or index that has left",
     "char a[100];\n"
     "int main(void) {\n memset(a, 1, 30000 * one); /* HERE */\n while (1); }"},
    {"copy_of_too_much", TP_TRAP_ADDRESS, "left the program's memory",
     "char a[100], b[100];\n"
     "int main(void) {\n memmove(a, b, 30000 * one); /* HERE */\n while (1); }"},
    {"heap_overrun", TP_TRAP_ADDRESS, "left the program's memory",
     "int main(void) { char *p = malloc(10); int i; for (i = 0; i < 20000; i++)\n p[i] = 1; /* HERE */\n "
     "while (1); }"},
    {"malloc_that_failed", TP_TRAP_ADDRESS, "write through a null pointer",
     "int main(void) { char *p = malloc(30000);\n p[0] = 1; /* HERE */\n while (1); }"},
    {"local_overrun_upwards", TP_TRAP_ADDRESS, "left the stack",
     "int main(void) { volatile char a[100]; long i; for (i = 0; i < far; i++)\n a[i] = 0; /* HERE */\n "
     "while (1); }"},
    {"local_index_far_below", TP_TRAP_STACK, "stack overflow",
     "int main(void) { volatile long a[10];\n a[-far] = 0; /* HERE */\n while (1); }"},
    {"endless_recursion", TP_TRAP_STACK, "stack overflow",
     "int down(int n) {\n volatile char a[50]; a[0] = n; return down(n + 1) + a[0]; } /* HERE */\n"
     "int main(void) { sink = down(0); while (1); }"},
    {"recursion_with_large_frames", TP_TRAP_STACK, "stack overflow",
     "int down(int n) {\n volatile char a[20000]; a[10] = n; return down(n + 1) + a[0]; } /* HERE */\n"
     "int main(void) { sink = down(0); while (1); }"},
    {"huge_alloca", TP_TRAP_STACK, "stack overflow",
     "char *volatile p;\n"
     "int main(void) { int i; for (i = 0; i < 20; i++)\n p = __builtin_alloca(50000u); /* HERE */\n while "
     "(1); }"},
    {"null_read", TP_TRAP_ADDRESS, "read through a null pointer",
     "int main(void) {\n sink = *(int *)nowhere; /* HERE */\n while (1); }"},
    {"null_write", TP_TRAP_ADDRESS, "write through a null pointer",
     "struct s { int a[20]; };\n"
     "int main(void) {\n ((struct s *)nowhere)->a[7] = 1; /* HERE */\n while (1); }"},
    {"wild_write", TP_TRAP_ADDRESS, "write through a wild pointer (address 4660)",
     "int main(void) {\n *(volatile char *)(0x1234 + zero) = 1; /* HERE */\n while (1); }"},
    {"null_call", TP_TRAP_ADDRESS, "call through a null pointer",
     "int main(void) {\n ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"wild_call", TP_TRAP_ADDRESS, "call through a wild pointer",
     "int main(void) {\n ((void (*)(void))(0x4321 + zero))(); /* HERE */\n while (1); }"},
    {"call_of_data", TP_TRAP_ADDRESS, "there is no code",
     "char code[16] = {(char)0xC3};\n"
     "int main(void) {\n ((void (*)(void))code)(); /* HERE */\n while (1); }"},
    {"call_of_a_constant", TP_TRAP_ADDRESS, "there is no code",
     "const char code[16] = {(char)0xC3};\n"
     "int main(void) { nowhere = (void *)code;\n ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"call_of_the_stack", TP_TRAP_ADDRESS, "there is no code",
     "int main(void) { volatile char code[16]; code[0] = (char)0xC3; nowhere = (void *)code;\n"
     " ((void (*)(void))nowhere)(); /* HERE */\n while (1); }"},
    {"write_to_a_constant", TP_TRAP_ADDRESS, "write to a constant",
     "const int table[4] = {1, 2, 3, 4};\n"
     "int main(void) { nowhere = (void *)table;\n *(int *)nowhere = 5; /* HERE */\n while (1); }"},
    {"write_to_a_string", TP_TRAP_ADDRESS, "write to a constant",
     "char *volatile text = \"hello\";\n"
     "int main(void) {\n text[0] = 'H'; /* HERE */\n while (1); }"},
    {"write_into_code", TP_TRAP_ADDRESS, "write to a constant or to the program itself",
     "void f(void) { sink++; }\n"
     "int main(void) { nowhere = (void *)f;\n *(char *)nowhere = 0; /* HERE */\n while (1); }"},
    {"return_address_overwritten", TP_TRAP_ADDRESS, "return address was overwritten",
     "__attribute__((noinline)) void smash(void) { volatile long a[4]; int i;\n"
     " for (i = 0; i < 40; i++) a[i] = 0x4141; }\n"
     "int main(void) { /* HERE */\n volatile long room[100]; room[0] = 0;\n smash();\n while (1); }"},
    {"return_address_from_memcpy", TP_TRAP_ADDRESS, "call through a null pointer",
     "char big[200];\n"
     "__attribute__((noinline)) void smash(void) { char a[8];\n"
     " memcpy(a, big, 100 * one); sink = a[0]; } /* HERE */\n"
     "int main(void) { volatile long room[100]; room[0] = 0;\n smash();\n while (1); }"},
    {"division_by_zero", TP_TRAP_MATH, "division by zero",
     "int main(void) {\n sink = 10 / zero; /* HERE */\n while (1); }"},
    {"long_remainder_of_zero", TP_TRAP_MATH, "division by zero",
     "int main(void) { long z = zero;\n sink = (int)(100000L % z); /* HERE */\n while (1); }"},
    {"unreachable_reached", TP_TRAP_ILLEGAL, "never reach",
     "__attribute__((noinline)) int f(int n) { if (n == 0) return 1;\n"
     " __builtin_unreachable(); /* HERE */\n }\n"
     "int main(void) { sink = f(one); while (1); }"},
    {"builtin_trap", TP_TRAP_ILLEGAL, "illegal instruction",
     "int main(void) {\n __builtin_trap(); /* HERE */\n }"},
    {"debug_trap", TP_TRAP_ILLEGAL, "illegal instruction",
     "int main(void) {\n __builtin_debugtrap(); /* HERE */\n while (1); }"},
    {"abort_called", TP_TRAP_ABORT, "abort", "int main(void) {\n abort(); /* HERE */\n }"},
    {"comparator_that_jumps_away", TP_TRAP_ADDRESS, "write through a null pointer",
     "int a[10];\n"
     "int worse(const void *x, const void *y) {\n *(int *)nowhere = 1; return 1; } /* HERE */\n"
     "int main(void) { qsort(a, 10, sizeof a[0], worse); while (1); }"},
    {"comparator_that_is_none", TP_TRAP_ADDRESS, "call through a null pointer",
     "int a[10];\n"
     "int main(void) {\n qsort(a, 10, sizeof a[0], (int (*)(const void *, const void *))nowhere); /* HERE "
     "*/\n while (1); }"},
    {"sort_of_too_much", TP_TRAP_ADDRESS, "",
     "int a[10];\n"
     "int worse(const void *x, const void *y) { return 1; }\n"
     "int main(void) {\n qsort(a, 30000, 2, worse); /* HERE */\n while (1); }"},
    {"text_from_nowhere", TP_TRAP_ADDRESS, "read through a wild pointer",
     "char out[50];\n"
     "int main(void) {\n sprintf(out, \"%s\", (char *)(5000 + zero)); /* HERE */\n while (1); }"},

    {"length_of_nothing", TP_TRAP_ADDRESS, "read through a null pointer",
     "int main(void) {\n sink = strlen(nowhere); /* HERE */\n while (1); }"},
    {"copy_to_nowhere", TP_TRAP_ADDRESS, "write through a null pointer",
     "int main(void) {\n strcpy(nowhere, \"abc\"); /* HERE */\n while (1); }"},
    {"null_agenda", TP_TRAP_ADDRESS, "null pointer",
     "int main(void) { e_init_port();\n e_activate_agenda((void (*)(void))nowhere, 10); /* HERE */\n"
     " e_start_agendas_processing(); while (1); }"},
    {"agenda_that_faults", TP_TRAP_ADDRESS, "write through a null pointer",
     "void bad(void) {\n *(int *)nowhere = 1; } /* HERE */\n"
     "int main(void) { e_init_port(); e_activate_agenda(bad, 10); e_start_agendas_processing(); while (1); "
     "}"},
    {"interrupt_that_faults", TP_TRAP_MATH, "division by zero",
     "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) {\n IFS0bits.T1IF = 0; sink = 1 / zero; } "
     "/* HERE */\n"
     "int main(void) { PR1 = 1000; T1CON = 0x8000; IEC0bits.T1IE = 1; while (1); }"},

    {"interrupts_off_for_ever", TP_TRAP_INTERRUPT, "interrupts off",
     "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { IFS0bits.T1IF = 0; }\n"
     "int main(void) { PR1 = 1000; T1CON = 0x8000; IEC0bits.T1IE = 1; SRbits.IPL = 7;\n while (1) sink++; /* "
     "HERE */\n }"},
    {"picture_to_nowhere", TP_TRAP_ADDRESS, "null pointer",
     "int main(void) { e_init_port(); e_poxxxx_init_cam(); e_poxxxx_config_cam(0, 0, 640, 480, 8, 8, "
     "RGB_565_MODE);\n"
     " e_poxxxx_write_cam_registers(); e_poxxxx_launch_capture((char *)nowhere);\n"
     " while (!e_poxxxx_is_img_ready()); /* HERE */\n while (1); }"},
    {"uart_text_from_nowhere", TP_TRAP_ADDRESS, "read through",
     "int main(void) { e_init_uart1();\n e_send_uart1_char(nowhere, 10); /* HERE */\n while (1); }"},
    {"mean_of_too_much", TP_TRAP_ADDRESS, "left the program's memory",
     "int few[4];\n"
     "int main(void) {\n e_subtract_mean(few, 30000, 8); /* HERE */\n while (1); }"},
    {"squares_of_too_much", TP_TRAP_ADDRESS, "left the program's memory",
     "fractcomplex few[4]; fractional out[4];\n"
     "int main(void) {\n SquareMagnitudeCplx(30000, few, out); /* HERE */\n while (1); }"},
    {"transform_of_nothing", TP_TRAP_ADDRESS, "null pointer",
     "int main(void) {\n FFTComplexIP(8, nowhere, (fractcomplex *)nowhere, 0); /* HERE */\n while (1); }"},
    {"virtual_sensor_without_a_name", TP_TRAP_ADDRESS,
     "a function of the library was to read through a null pointer",
     "float value;\n"
     "int main(void) {\n twinpuck_virtual_sensor(nowhere, &value); /* HERE */\n while (1); }"},
    {"jump_out_of_nowhere", TP_TRAP_UNSIMULATED, "longjmp()",
     "jmp_buf never_set;\n"
     "int main(void) {\n longjmp(never_set, 1); /* HERE */\n }"},
    {"assertion", TP_TRAP_ABORT, "", "int main(void) {\n assert(zero); /* HERE */\n while (1); }"},
    {"free_of_nonsense", TP_TRAP_ADDRESS, "write through a wild pointer",
     "int main(void) {\n free((void *)(5000 + zero)); /* HERE */\n while (1); }"},
    {"exit_with_a_failure", TP_TRAP_ABORT, "", "int main(void) {\n exit(3); /* HERE */\n }"},
    {"pointer_in_a_local_struct_never_set", TP_TRAP_ADDRESS, "wild pointer",
     "struct s { int n; int *p; };\n"
     "__attribute__((noinline)) void use(struct s *s) {\n *s->p = 3; } /* HERE */\n"
     "int main(void) { struct s local; local.n = 1; use(&local); while (1); }"},
    {"pointer_in_the_heap_never_set", TP_TRAP_ADDRESS, "wild pointer",
     "struct s { int n; int *p; };\n"
     "int main(void) { struct s *s = malloc(sizeof *s);\n *s->p = 3; /* HERE */\n while (1); }"},
};

INSTANTIATE_TEST_SUITE_P(Every, HostileProgram, ::testing::ValuesIn(kPrograms),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
