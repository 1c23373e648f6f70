// SPDX-License-Identifier: MIT
// Projects that carry the e-puck library along: whole, in parts, or as single files beside main.c.
#include <gtest/gtest.h>

#include "fake_host.h"
#include "hal_sim/cc/elf_reader.h"

using namespace fake;

namespace {
const char* kUsesBoth =
    "#include <p30F6014A.h>\n#include \"library/motor_led/advance_one_timer/e_motors.h\"\n"
    "int main(void) { e_init_motors(); e_set_speed_left(100); return 0; }";
}

TEST(library_copies, a_whole_copy_gives_way_to_ours_and_the_build_says_so) {
  Folder folder;
  // both variants of a driver under one name, which could not be linked together, and one in assembler
  folder.file("prog/library/motor_led/e_motors.c",
              "void e_init_motors(void) {} void e_set_speed_left(int v) {}");
  folder.file("prog/library/motor_led/advance_one_timer/e_motors.c",
              "void e_init_motors(void) {} void e_set_speed_left(int v) {}");
  folder.file("prog/library/codec/e_sound.c",
              "void e_close_sound(void) { __asm__ volatile(\"clr _e_flag\"); }");
  folder.file("prog/library/motor_led/advance_one_timer/e_motors.h",
              "#error a header of the copy was read\n");
  auto built = build(folder, kUsesBoth);
  EXPECT_TRUE(built.ok) << text_of(built);
  ASSERT_EQ(built.warnings.size(), 1u) << text_of(built);
  EXPECT_NE(built.warnings[0].find("library/codec/e_sound.c"), std::string::npos) << built.warnings[0];
  EXPECT_NE(built.warnings[0].find("Twinpuck's own library is used"), std::string::npos) << built.warnings[0];
}

TEST(library_copies, a_flat_copy_stays_unless_it_needs_registers_that_are_not_there) {
  Folder folder;
  folder.file("prog/e_motors.c", "int copies_here; void e_init_motors(void) { copies_here = 1; }");
  folder.file("prog/e_ad_conv.c",
              "#include <p30F6014A.h>\nvoid e_init_ad_scan(unsigned char a) { int *p = (int *)&ADCBUF0; "
              "ADCON1 = *p; }");
  // e_led.c speaks of a register in a comment only; copies_here links only if e_motors.c was compiled
  folder.file("prog/e_led.c", "/* never touches\n * ADCON1 */ void e_led_clear(void) {} int leds_here;");
  auto built = build(folder,
                     "extern int copies_here, leds_here;\nvoid e_init_ad_scan(unsigned char);\n"
                     "int main(void) { e_init_ad_scan(0); return copies_here + leds_here; }");
  EXPECT_TRUE(built.ok) << text_of(built);
  ASSERT_EQ(built.warnings.size(), 1u) << text_of(built);
  EXPECT_NE(built.warnings[0].find("got e_ad_conv.c, expected"), std::string::npos) << built.warnings[0];
}

TEST(library_copies, files_that_only_resemble_the_librarys_are_compiled) {
  Folder folder;
  folder.file("prog/utility/utility.c", "int mine(void) { return 1; }");
  folder.file("prog/my_e_sound.c", "int also_mine(void) { return 2; }");
  folder.file("prog/e_timers.c", "int e_timer(void) { return 4; }");  // a camera's only when it speaks of one
  auto built = build(folder,
                     "#include <stdio.h>\nint mine(void); int also_mine(void); int e_timer(void);\n"
                     "int main(void) { printf(\"%d\", mine() + also_mine() + e_timer()); return 0; }");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_TRUE(built.warnings.empty()) << text_of(built);
  EXPECT_EQ(Image(folder.path / "prog.so").run().console, "7");
}

TEST(library_copies, the_chips_header_is_always_ours) {
  Folder folder;
  folder.file("prog/inc/p30f6014A.h", "extern volatile unsigned char TBLPAG;\n#define PORTA 3\n");
  auto built = build(folder,
                     "#include \"inc/p30f6014A.h\"\n#include <motor_led/e_epuck_ports.h>\n"
                     "int main(void) { TBLPAG = 1; return PORTA; }");
  EXPECT_TRUE(built.ok) << text_of(built);
}

// --- the register way: a copy is an archive of the project's own drivers

// two variants of one function, of which the program includes a header; the chosen one counts
TEST(library_members, the_variant_whose_header_the_program_includes_is_linked) {
  for (const std::string chosen : {"a_d/e_accelerometer", "a_d/advance_ad_scan/e_acc"}) {
    Folder folder;
    folder.file("prog/lib/a_d/e_accelerometer.c", "int which = 1; int e_get_acc(int axis) { return which; }");
    folder.file("prog/lib/a_d/e_accelerometer.h", "int e_get_acc(int axis);");
    folder.file("prog/lib/a_d/advance_ad_scan/e_acc.c",
                "int which = 2; int e_get_acc(int axis) { return which; }");
    folder.file("prog/lib/a_d/advance_ad_scan/e_acc.h", "int e_get_acc(int axis);");
    const int expected = chosen == "a_d/e_accelerometer" ? 1 : 2;
    auto built = build(folder,
                       "#include \"lib/" + chosen + ".h\"\nint main(void) { if (e_get_acc(0) != " +
                           std::to_string(expected) + ") __asm__(\"reset\"); return 0; }",
                       "-O1", [](cc::BuildOptions& o) { o.register_way = true; });
    ASSERT_TRUE(built.ok) << text_of(built);
    Image image(folder.path / "prog.so");
    EXPECT_EQ(image.run().end, "return") << chosen;
  }
}

// a file that nobody asks for need not even compile, and of two files of one name one is enough
TEST(library_members, files_that_do_not_compile_are_left_out_with_a_warning) {
  Folder folder;
  folder.file("prog/motor_led/e_motors.c", "int e_init_motors(void) { return 7; }");
  folder.file("prog/old/e_motors.c", "int e_init_motors(void) { return nobody_declared_this; }");
  auto built = build(folder, "int e_init_motors(void); int main(void) { return e_init_motors(); }", "-O1",
                     [](cc::BuildOptions& o) { o.register_way = true; });
  EXPECT_TRUE(built.ok) << text_of(built);
  EXPECT_NE(text_of(built).find("old/e_motors.c: does not compile and is left out"), std::string::npos)
      << text_of(built);
}

// the fast camera driver: its C starts the timers, its assembler takes the lines
TEST(library_members, a_driver_of_which_one_half_is_assembler_is_ours_as_a_whole) {
  const char* const kTimers =
      "char *_poxxxx_buffer; void __attribute__((interrupt)) _T5Interrupt(void) {}\n"
      "int copied = 1; void e_poxxxx_launch_capture(char *b) { copied = 2; }";
  for (const std::string place : {"lib/camera/fast_2_timer/", ""}) {
    Folder folder;
    folder.file("prog/" + place + "e_timers.c", kTimers);
    folder.file("prog/" + place + "e_interrupt.s", ".global __T4Interrupt\n__T4Interrupt: retfie\n");
    folder.file("prog/lib/camera/slow_3_timer/e_timers.c",
                "int slow = 1; void __attribute__((interrupt)) _T4Interrupt(void) {} "
                "void e_poxxxx_launch_capture(char *b) { slow = 2; }");
    const std::string main_c =
        "void e_poxxxx_launch_capture(char *); char b[9];\n"
        "int main(void) { e_poxxxx_launch_capture(b); return 0; }";
    auto built = build(folder, main_c, "-O1", [](cc::BuildOptions& o) { o.register_way = true; });
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_NE(text_of(built).find("drivers whose other half is assembler"), std::string::npos)
        << text_of(built);
    bool has_handler = false;
    for (const auto& s : cc::read_elf(folder.path / "prog.so").symbols) {
      EXPECT_TRUE(s.name != "copied" && s.name != "slow") << place << s.name;
      has_handler = has_handler || (s.name == "_T4Interrupt" && s.is_defined);
    }
    EXPECT_TRUE(has_handler) << place;

    // with the handler in C it is whole, and stays
    folder.file("prog/" + place + "e_timers.c",
                std::string(kTimers) + "void __attribute__((interrupt)) _T4Interrupt(void) { copied++; }");
    built = build(folder, main_c, "-O1", [](cc::BuildOptions& o) { o.register_way = true; });
    ASSERT_TRUE(built.ok) << text_of(built);
    bool is_copied = false;
    for (const auto& s : cc::read_elf(folder.path / "prog.so").symbols)
      is_copied = is_copied || s.name == "copied";
    EXPECT_TRUE(is_copied) << place;
  }
}
