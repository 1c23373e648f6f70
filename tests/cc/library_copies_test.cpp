// SPDX-License-Identifier: MIT
// Projects that carry the e-puck library along: whole, in parts, or as single files beside main.c.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/cc/bench.h"

using namespace cc_test;

namespace {
const char* kUsesBoth =
    "#include <p30F6014A.h>\n#include \"library/motor_led/advance_one_timer/e_motors.h\"\n"
    "#include <stdio.h>\n"
    "int main(void) { e_init_motors(); e_set_speed_left(100); printf(\"%d\", copies_here); return 0; }";
}

// its headers and its drivers are the project's own; the codec's other half is assembler, which is not there
TEST(library_copies, a_whole_copy_is_used_but_for_drivers_of_which_one_half_is_missing) {
  Folder folder;
  folder.file("prog/library/motor_led/e_motors.c",
              "void e_init_motors(void) {} void e_set_speed_left(int v) {}");
  folder.file(
      "prog/library/motor_led/advance_one_timer/e_motors.c",
      "int copies_here; void e_init_motors(void) {} void e_set_speed_left(int v) { copies_here = v; }");
  folder.file("prog/library/codec/e_sound.c",
              "void e_close_sound(void) { __asm__ volatile(\"clr _e_flag\"); }");
  folder.file("prog/library/motor_led/advance_one_timer/e_motors.h",
              "extern int copies_here; void e_init_motors(void); void e_set_speed_left(int v);\n");
  auto built = build(folder, kUsesBoth);
  EXPECT_TRUE(built.ok) << text_of(built);
  ASSERT_EQ(built.warnings.size(), 1u) << text_of(built);
  EXPECT_TRUE(reads(folder, built.warnings[0],
                    "@/prog: copy of the e-puck library: got library/codec/e_sound.c, drivers whose other "
                    "half is assembler, which the project does not have; Twinpuck's own drivers are used in "
                    "their place, changes made in them have no effect"));
  EXPECT_EQ(output_of(folder.image()), "100");
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
  EXPECT_EQ(output_of(folder.image()), "7");
}

TEST(library_copies, the_chips_header_is_always_ours) {
  Folder folder;
  folder.file("prog/inc/p30f6014A.h", "extern volatile unsigned char TBLPAG;\n#define PORTA 3\n");
  auto built = build(folder,
                     "#include \"inc/p30f6014A.h\"\n#include <motor_led/e_epuck_ports.h>\n"
                     "int main(void) { TBLPAG = 1; return PORTA; }");
  EXPECT_TRUE(built.ok) << text_of(built);
}

// --- a copy is an archive of the project's own drivers; the map says what was linked

static std::string map_of(const Folder& folder) {
  std::ifstream in(folder.path / "prog.map");
  return {std::istreambuf_iterator<char>(in), {}};
}

// two variants of one function, of which the program includes a header; the chosen one counts
TEST(library_members, the_variant_whose_header_the_program_includes_is_linked) {
  for (const std::string chosen : {"a_d/e_accelerometer", "a_d/advance_ad_scan/e_acc", "a_d\\e_accelerometer",
                                   "a_d\\advance_ad_scan\\e_acc"}) {
    std::string named = chosen;
    std::replace(named.begin(), named.end(), '\\', '/');
    Folder folder;
    folder.file("prog/lib/a_d/e_accelerometer.c", "int which = 1; int e_get_acc(int axis) { return which; }");
    folder.file("prog/lib/a_d/e_accelerometer.h", "int e_get_acc(int axis);");
    folder.file("prog/lib/a_d/advance_ad_scan/e_acc.c",
                "int which = 2; int e_get_acc(int axis) { return which; }");
    folder.file("prog/lib/a_d/advance_ad_scan/e_acc.h", "int e_get_acc(int axis);");
    auto built = build(folder,
                       "#include \"lib/" + chosen +
                           ".h\"\nvolatile int got;\n"
                           "int main(void) { got = e_get_acc(0); return 0; }",
                       "-O1");
    ASSERT_TRUE(built.ok) << text_of(built);
    for (const char* which : {"a_d/e_accelerometer", "a_d/advance_ad_scan/e_acc"})
      EXPECT_EQ(map_of(folder).find(std::string("lib/") + which + ".c") != std::string::npos, which == named)
          << which << map_of(folder);
  }
}

// a file that nobody asks for need not even compile, and of two files of one name one is enough
TEST(library_members, files_that_do_not_compile_are_left_out_with_a_warning) {
  Folder folder;
  folder.file("prog/motor_led/e_motors.c", "int e_init_motors(void) { return 7; }");
  folder.file("prog/old/e_motors.c", "#include \"e_motors.h\"\nint e_init_motors(void) { return 1; }");
  folder.file("prog/old/e_motors.h", "int i = nobody_declared_this;\n");
  auto built = build(folder, "int e_init_motors(void); int main(void) { return e_init_motors(); }");
  EXPECT_TRUE(built.ok) << text_of(built);
  EXPECT_TRUE(
      reads(folder, text_of(built),
            "@/prog/old/e_motors.c: does not compile and is left out, as a file of a copy of the library: "
            "@/prog/old/e_motors.h:1:9: error: use of undeclared identifier 'nobody_declared_this'"));
}
