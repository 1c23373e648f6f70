// SPDX-License-Identifier: MIT
// Old e-puck code as it is found: attributes, headers by any path and case, K&R, missing prototypes.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/cc/bench.h"
#include "twinpuck_paths.h"

using namespace cc_test;

namespace {
void compiles(const std::string& text) {
  Folder folder;
  auto built = build(folder, text);
  EXPECT_TRUE(built.ok) << text << "\n" << text_of(built);
}
void compiles_at(const std::string& level, const std::string& text) {
  Folder folder;
  auto built = build(folder, text, level);
  EXPECT_TRUE(built.ok) << level << "\n" << text << "\n" << text_of(built);
}
}  // namespace

TEST(tolerance, every_spelling_of_an_interrupt_handler) {
  for (const char* attribute :
       {"__attribute__((__interrupt__, auto_psv))", "__attribute__((interrupt, auto_psv))",
        "__attribute__((interrupt, auto_psv, shadow))", "__attribute__((interrupt, shadow))",
        "__attribute__((interrupt, no_auto_psv))", "__attribute__((__interrupt__))",
        "__attribute__ ((interrupt))", "__attribute__((interrupt(save(a, b)), no_auto_psv))",
        "__attribute__((__interrupt__(__preprologue__(\"nop\"))))"}) {
    Folder folder;
    auto built = build(folder, std::string("int a, b; void ") + attribute +
                                   " _T1Interrupt(void) { a++; } int main(void) { return 0; }");
    ASSERT_TRUE(built.ok) << attribute << text_of(built);
  }
  compiles(
      "#define _ISR __attribute__((interrupt))\n#define _ISRFAST __attribute__((interrupt, shadow))\nvoid "
      "_ISR _T2Interrupt(void) {} void _ISRFAST _T3Interrupt(void) {}\n"
      "void __attribute__((interrupt,\n auto_psv))\n_T4Interrupt(void) {} int interrupt = 3; int main(void) "
      "{ return interrupt; }");
}

// e_init_ad_scan() and e_init_uart2() had no argument in older versions, and have an address all the same
TEST(tolerance, functions_of_two_forms_are_called_and_pointed_at) {
  const std::string program =
      "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <uart/e_uart_char.h>\n"
      "void *all[] = {(void *)e_init_ad_scan, (void *)&e_init_uart2};\n"
      "void (*today)(unsigned char) = e_init_ad_scan; void (*rate)(int) = &e_init_uart2;\n"
      "int main(void) { e_init_ad_scan(); e_init_uart2(); e_init_ad_scan(ALL_ADC); e_init_uart2(95);\n"
      "  today(ALL_ADC); rate(95); return all[0] == (void *)today; }\n";
  for (const char* level : {"-O0", "-O1"}) {
    Folder folder;
    const auto built = build(folder, program, level);
    EXPECT_TRUE(built.ok) << text_of(built);
    EXPECT_EQ(text_of(built), "");
  }
}

// the C standard's math.h has no PI
TEST(tolerance, a_program_may_have_a_pi_of_its_own) {
  Folder folder;
  const auto own = build(folder, "#include <math.h>\n#define PI 3.14\nint main(void) { return PI > 3; }");
  EXPECT_EQ(text_of(own), "");
  const auto twice =
      build(folder, "#define PI 3.1\n#include <math.h>\n#define PI 3.14\nint main(void) { return PI > 3; }");
  EXPECT_NE(text_of(twice).find("'PI' macro redefined"), std::string::npos) << text_of(twice);
  EXPECT_NE(text_of(twice).find("previous definition"), std::string::npos) << text_of(twice);
  compiles("#include <math.h>\nint main(void) { return PI > 3; }");
}

// the optimiser makes one access of several by choosing between the registers' addresses
TEST(tolerance, registers_chosen_by_a_switch_or_a_condition) {
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"})
    compiles_at(
        level,
        "#include \"p30F6014A.h\"\n"
        "unsigned int port(int n) { switch (n) { case 0: return PORTA; case 1: return PORTC; case 2: "
        "return PORTF; default: return PORTG; } }\n"
        "void put(int n, unsigned int v) { switch (n) { case 0: LATA = v; break; case 1: LATC = v; break; "
        "default: LATG = v; } }\n"
        "int key(int n) { return n ? PORTFbits.RF6 : PORTGbits.RG6; }\n"
        "int wait(int n) { while (!(n ? _T1IF : _T2IF)); return n ? TMR1 : TMR2; }\n"
        "int main(void) { put(port(1), port(2)); return key(3) + wait(1); }");
}

TEST(tolerance, data_attributes) {
  compiles(
      "int __attribute__((near)) a; int b __attribute__((far)); int c[4] __attribute__((space(xmemory), "
      "aligned(8)));\n"
      "int d[4] __attribute__((section(\".ydata, data, ymemory\"), aligned(16))) = {1}; const int e[2] "
      "__attribute__((space(auto_psv), aligned(4))) = {1, 2};\n"
      "int f __attribute__((persistent)); int g __attribute__((address(0x900))); static int h "
      "__attribute__((unused)); unsigned char i __attribute__((packed));\n"
      "int main(void) { d[1] = 2; return a + b + c[0] + d[0] + e[1] + f + g + i; }");
}

TEST(tolerance, old_c) {
  compiles("main() { undeclared_here(); return 0; } undeclared_here() { int x = 0b1010; return x; }");
  compiles("int add(a, b) int a; int b; { return a + b; } int main() { add(1, 2); }");
  compiles(
      "void scan(); inline int twice(int v) { return v * 2; } int main() { scan(3); scan(); return twice(2); "
      "} void scan(int all) { }");
  compiles(
      "int shared; int main() { extern int other(); { extern int shared; shared = 2; } for (int i = 0; i < "
      "3; i++) other(); } int other() { }");
  compiles("static int tick = 0; void main(void) { int i; i = 3; int late = i; tick = late; while (1); }");
  compiles(
      "enum { A, B, }; struct p { int x, y; } q = { x: 1, y: 2 }; int t[] = { [2] = 5 }; // comment\nint "
      "main() { char *s = \"a\"; unsigned char *u = s; return u[0] + q.x + t[2]; }");
  compiles(
      "extern int counter; int counter; int counter; int f(void) { return; } int main() { return f() + "
      "counter; }");
}

TEST(tolerance, common_variables_of_several_files_are_one) {
  Folder folder;
  folder.file("prog/globals.h", "int speed; int table[4];\n");
  folder.file("prog/a.c", "#include \"globals.h\"\nvoid set(void) { speed = 5; table[3] = 7; }");
  auto built = build(folder,
                     "#include <stdio.h>\n#include \"globals.h\"\nvoid set(void); int main(void) { set(); "
                     "printf(\"%d %d\", speed, table[3]); return 0; }");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_EQ(output_of(folder.image()), "5 7");
}

TEST(tolerance, headers_are_found_by_any_case_slash_and_path) {
  Folder folder;
  // headers of a folder of ours, each marked
  std::filesystem::copy(TWINPUCK_SOURCE_DIR "/firmware/include", folder.path / "include",
                        std::filesystem::copy_options::recursive);
  const auto mark = [&](const char* header, const char* text) {
    std::ofstream(folder.path / "include" / header, std::ios::app) << text;
  };
  mark("p30F6014A.h", "#define DEVICE 6014\n");
  mark("motor_led/e_motors.h", "#define BASIC_MOTORS 1\n");
  mark("motor_led/advance_one_timer/e_motors.h", "#define AGENDA_MOTORS 1\n");
  mark("a_d/e_prox.h", "#define PROX 1\n");
  folder.file("prog/Sub/Own.h", "#define OWN 1\n");
  auto use = [&](const std::string& includes, const std::string& value) {
    auto built = build(
        folder, includes + "\nint result[" + value + " == 1 ? 1 : -1]; int main(void) { return result[0]; }",
        "-O1", [&](cc::BuildOptions& o) { o.include_root = folder.path / "include"; });
    EXPECT_TRUE(built.ok) << includes << "\n" << text_of(built);
  };
  for (const char* name : {"<p30F6014A.h>", "\"p30f6014A.h\"", "<p30f6014a.h>", "\"P30F6014A.H\"",
                           "\"C:\\Program Files (x86)\\Microchip\\MPLAB C30\\support\\h\\p30F6014A.h\""})
    use(std::string("#include ") + name, "DEVICE - 6013");
  use("#include <e_motors.h>", "AGENDA_MOTORS");
  use("#include <motor_led/e_motors.h>", "BASIC_MOTORS");
  use("#include \"../../library/motor_led/e_motors.h\"", "BASIC_MOTORS");
  use("#include <motor_LED/advance_one_timer/e_motors.h>", "AGENDA_MOTORS");
  use("#include \"..\\..\\library\\motor_led\\advance_one_timer\\e_motors.h\"", "AGENDA_MOTORS");
  use("#include <..\\a_d\\e_prox.h>", "PROX");
  use("#include \"sub\\own.h\"", "OWN");
  use("#include \"own.h\"", "OWN");
  folder.file("prog/e_motors.h", "#define MINE 1\n");
  use("#include \"e_motors.h\"", "MINE");
}

TEST(tolerance, predefined_macros_are_the_chips) {
  compiles(
      "#if !defined(__dsPIC30F__) || !defined(__dsPIC30F6014A__) || !defined(__C30__) || __XC16_VERSION__ < "
      "1000\n#error chip\n#endif\n"
      "#if defined(__x86_64__) || defined(__linux__) || defined(unix)\n#error pc\n#endif\n#if 32767 + 1 < "
      "0\n#endif\nint main(void) { return 0; }");
  compiles(
      "#define FCY 14745600UL\n#include <dsp.h>\n#include <libpic30.h>\n#include <limits.h>\n#include "
      "<float.h>\n#include <stdint.h>\n#include <stdbool.h>\nfractional t[INT_MAX == 32767 ? 2 : -1]; "
      "fractcomplex c;\n"
      "int main(void) { uint32_t a = UINT32_MAX; bool b = true; __delay32(100); __delay_ms(2); "
      "__delay_us(50); return t[0] + c.real + b + (int)a; }");
}

// called before its definition, and its parameter is narrower than an int
TEST(tolerance, functions_used_before_their_definition_may_take_shorts) {
  compiles(
      "int main(void) { put(3); mix(1, 'a', 2.5); return 0; }\n"
      "void put(unsigned short value) { volatile unsigned short v = value; }\n"
      "void mix(int n, char c, float x) { volatile float y = n + c + x; }\n");
}

// XC16 takes these with -std=gnu99; nobody's options say so in a bare folder
TEST(tolerance, each_loop_may_declare_the_same_counter) {
  EXPECT_EQ(
      printed_by("#include <stdint.h>\n#include <stdio.h>\nint main(void) { int s = 0; for (uint16_t i = 0; "
                 "i < 3; i++) s "
                 "+= i; for (uint16_t i = 0; i < 3; i++) s += i; printf(\"%d\", s); return 0; }"),
      "6");
}

TEST(tolerance, arithmetic_of_the_compilers_built_in_functions_needs_no_header) {
  EXPECT_EQ(
      printed_by(
          "#include <stdio.h>\nint main(void) { int r; unsigned u; volatile long a = -100007; volatile "
          "unsigned long b = "
          "100007;\n"
          "printf(\"%d \", __builtin_divmodsd(a, 1000, &r)); printf(\"%d \", r);\n"
          "printf(\"%u \", __builtin_divmodud(b, 1000, &u)); printf(\"%u \", u);\n"
          "printf(\"%d %d %u %u \", __builtin_divsd(a, 7), __builtin_modsd(a, 7), __builtin_divud(b, 7), "
          "__builtin_modud(b, 7));\n"
          "printf(\"%ld %ld %ld %lu \", __builtin_mulss(-300, 300), __builtin_mulsu(-1, 65535), "
          "__builtin_mulus(65535, -1), __builtin_muluu(65535, 65535));\n"
          "printf(\"%d %d %d %d %d\", __builtin_divf(1, 4), __builtin_ff1l(0x0400), __builtin_ff1r(0x0400), "
          "__builtin_fbcl(0x0400), __builtin_fbcl(-1)); __builtin_disi(3); return 0; }"),
      // by hand: 100007 = 7 x 14286 + 5; 0x0400 is bit 10, the 6th from the left and the 11th from the right,
      // behind five bits 0, four of which only repeat the sign
      "-100 -7 100 7 -14286 -5 14286 5 -90000 -65535 -65535 4294836225 8192 6 11 -4 -15");
}

TEST(tolerance, time_and_clock_count_cycles) {
  Folder folder;
  auto built = build(
      folder,
      "#include <time.h>\n#include <stdlib.h>\nlong t; int main(void) { srand(time(NULL)); t = clock(); "
      "return (int)difftime(t, 0) < 0; }");
  EXPECT_TRUE(built.ok) << text_of(built);
}

TEST(tolerance, libpic30_names_what_nvmcon_takes) {
  compiles(
      "#include <p30F6014A.h>\n#include <libpic30.h>\nint main(void) { NVMCON = _EE_ERASE_ROW_CODE; NVMCON = "
      "_FLASH_ERASE_CODE; "
      "NVMCON = _EE_WORD_WRITE_CODE | _EE_ROW_WRITE_CODE | _EE_ERASE_WORD_CODE | _FLASH_WRITE_ROW_CODE | "
      "_EE_ERASE_ALL_CODE; "
      "_erase_eedata_all(); return _FLASH_PAGE + _FLASH_ROW + _EE_ROW + _EE_WORD; }");
}

// XC16: quotes look beside the including file, then in the folders of -I, then among the compiler's headers;
// angles leave out the first. A program's folder that nobody named comes after all of them.
TEST(tolerance, headers_lie_where_xc16_looks_for_them) {
  Folder folder;
  folder.file("prog/math.h", "#define WHERE 1\n");
  folder.file("prog/timer.h", "#define WHERE_TIMER 1\n");
  folder.file("prog/part/part.c",
              "#include \"math.h\"\n#include \"own.h\"\n#ifdef WHERE\n#error not beside this file\n#endif\n"
              "float part(void) { return sin(OWN); }");
  folder.file("prog/tools/own.h", "#define OWN 2\n");
  folder.file("named/timer.h", "#define WHERE_TIMER 3\n");
  auto built = build(
      folder,
      "#include <math.h>\n#include <timer.h>\n#if defined(WHERE) || defined(WHERE_TIMER)\n#error angles\n"
      "#endif\n#include \"math.h\"\n#if WHERE != 1\n#error quotes\n#endif\nint main(void) { return 0; }");
  EXPECT_TRUE(built.ok) << text_of(built);
  built = build(folder,
                "#include <timer.h>\n#if WHERE_TIMER != 3\n#error -I\n#endif\nint main(void) { return 0; }",
                "-O1", [&](cc::BuildOptions& o) { o.include_dirs = {folder.path / "named"}; });
  EXPECT_TRUE(built.ok) << text_of(built);
}

TEST(tolerance, the_standard_of_c_can_be_given) {
  Folder folder;
  const char* const kLoop = "int s; int main(void) { for (int i = 0; i < 3; i++) s += i; return i; }";
  const char* const kLoops =
      "int s; int main(void) { for (int i = 0; i < 3; i++) s += i; for (int i = 0; i < 3; i++) s += i; "
      "return s; }";
  EXPECT_FALSE(build(folder, kLoop, "-O1", [](cc::BuildOptions& o) { o.standard = "gnu99"; }).ok);
  EXPECT_FALSE(build(folder, kLoops, "-O1", [](cc::BuildOptions& o) { o.standard = "gnu89"; }).ok);
  EXPECT_TRUE(build(folder, kLoops, "-O1", [](cc::BuildOptions& o) { o.standard = "gnu99"; }).ok);
}

TEST(tolerance, a_header_that_is_nowhere_is_guessed) {
  for (const auto& [written, meant] :
       {std::pair("<motor_led/e_motor.h>", "motor_led/e_motors.h"),
        std::pair("\"e_proxx.h\"", "a_d/e_prox.h"),
        std::pair("<a_d/advanced_ad_scan/e_porx.h>", "a_d/advance_ad_scan/e_prox.h"),
        std::pair("\"behavior.h\"", "tools/behaviour.h")}) {
    Folder folder;
    folder.file("prog/tools/behaviour.h", "");
    auto built = build(folder, std::string("#include ") + written + "\nint main(void) { return 0; }");
    EXPECT_FALSE(built.ok);
    ASSERT_EQ(built.errors.size(), 1u) << text_of(built);
    EXPECT_TRUE(reads(folder, built.errors[0],
                      std::string("@/prog/main.c:1:10: fatal error: '") +
                          std::string(written, 1, std::strlen(written) - 2) +
                          "' file not found\n@/prog/main.c:1:10: note: did you mean '" + meant + "'?"));
  }
  Folder folder;
  EXPECT_TRUE(reads(folder,
                    text_of(build(folder, "#include <robotics/quaternions.h>\nint main(void) { return 0; }")),
                    "@/prog/main.c:1:10: fatal error: 'robotics/quaternions.h' file not found"));
}
