// SPDX-License-Identifier: MIT
// Which form of a driver is linked: what the program's files, its project file and its headers say together.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "tests/cc/bench.h"

using namespace cc_test;

namespace {

bool has_function(const Folder& folder, const std::string& name) {
  std::ifstream in(folder.path / "out.map");
  const std::string map{std::istreambuf_iterator<char>(in), {}};
  return std::regex_search(map, std::regex("\\b_" + name + "\\b"));
}

std::string mcp(const std::string& files) {
  return "[PATH_INFO]\r\ndir_inc=..\\..\\library\r\n[FILE_INFO]\r\n" + files + "[SUITE_INFO]\r\n";
}

const std::string kBasicHeader = "#include <motor_led/e_motors.h>\n";
const std::string kAgendaHeader = "#include <motor_led/advance_one_timer/e_motors.h>\n";
const std::string kDrive = "int main(void) { e_init_motors(); e_set_speed_left(100); return 0; }";

}  // namespace

// the library's sources lie in no folder here: their listing is enough
TEST(driver_variants, what_the_project_lists_wins_over_what_a_header_suggests) {
  {
    Folder folder;
    folder.file("prog/main.c", kBasicHeader + kDrive);
    folder.file(
        "prog/a.mcp",
        mcp("file_000=main.c\r\nfile_001=..\\..\\library\\motor_led\\advance_one_timer\\e_motors.c\r\n"));
    auto built = build_folder(folder, "prog");
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_TRUE(has_function(folder, "e_set_speed_left"));
    EXPECT_FALSE(has_function(folder, "tp_basic_e_set_speed_left"));

    Folder other;
    other.file("prog/main.c", kAgendaHeader + kDrive);
    other.file("prog/a.mcp", mcp("file_000=main.c\r\nfile_001=..\\..\\library\\motor_led\\e_motors.c\r\n"));
    built = build_folder(other, "prog");
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_TRUE(has_function(other, "tp_basic_e_set_speed_left"));
    EXPECT_FALSE(has_function(other, "e_set_speed_left"));
  }
}

// the basic motors would take the camera's timers
TEST(driver_variants, a_driver_that_is_not_linked_owns_no_timer) {
  Folder folder;
  folder.file("prog/main.c", kBasicHeader + "#include <camera/fast_2_timer/e_poxxxx.h>\n" + kDrive);
  auto built = build_folder(folder, "prog");
  ASSERT_EQ(built.conflicts.size(), 2u);
  EXPECT_TRUE(reads(folder, built.conflicts[0],
                    "main.c: warning: Timer 4: got two owners (the basic motors and the camera), expected "
                    "one; the later one silences the other"));
  folder.file("prog/a.mcp",
              mcp("file_000=main.c\r\nfile_001=C:\\lib\\motor_led\\advance_one_timer\\e_motors.c\r\n"));
  built = build_folder(folder, "prog");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_TRUE(built.conflicts.empty());
}

TEST(driver_variants, files_that_include_headers_of_two_forms_share_one_driver) {
  Folder folder;
  folder.file("prog/main.c",
              kAgendaHeader + "void other(void);\nint main(void) { e_init_motors(); other(); return 0; }");
  folder.file("prog/other.c", kBasicHeader + "void other(void) { e_set_speed_left(100); }");
  auto built = build_folder(folder, "prog");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_TRUE(has_function(folder, "e_set_speed_left"));
  EXPECT_FALSE(has_function(folder, "tp_basic_e_set_speed_left"));
  ASSERT_EQ(built.conflicts.size(), 1u);
  EXPECT_TRUE(reads(folder, built.conflicts[0],
                    "@/prog: warning: motors: got headers of several drivers "
                    "(motor_led/advance_one_timer/e_motors.h and motor_led/e_motors.h), expected one; "
                    "motor_led/advance_one_timer/e_motors.c is linked for the whole program"));
}

// main.c has the library's header by its path, which labels the function; the program brings
// its own all the same
TEST(driver_variants, a_function_of_the_programs_own_is_called_whatever_header_declares_it) {
  Folder folder;
  folder.file("prog/main.c", kBasicHeader + kDrive);
  folder.file("prog/drive.c",
              "int own; void e_init_motors(void) { own = 1; } void e_set_speed_left(int v) { own = v; }");
  auto built = build_folder(folder, "prog");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_FALSE(has_function(folder, "tp_basic_e_set_speed_left"));
}

TEST(driver_variants, functions_of_a_form_link_without_a_header) {
  for (const std::string calls :
       {"e_init_ad(); e_read_ad(3);", "e_init_prox(); e_get_prox(0); e_stop_prox();", "e_init_acc();",
        "e_init_micro();", "e_start_timer_processing(1); e_configure_timer(1);"}) {
    Folder folder;
    folder.file("prog/main.c", "int main() { " + calls + " return 0; }");
    auto built = build_folder(folder, "prog");
    EXPECT_TRUE(built.ok) << calls << text_of(built);
    // one driver, not the beginning of one and the rest of another
    if (calls.find("prox") != std::string::npos) {
      EXPECT_TRUE(has_function(folder, "tp_basic_e_get_prox"));
      EXPECT_FALSE(has_function(folder, "e_get_prox"));
    }
  }
}

// the two take different arguments; each file calls what its header declares
TEST(driver_variants, forms_with_other_arguments_are_not_exchanged) {
  Folder folder;
  folder.file("prog/main.c",
              "#include <a_d/e_accelerometer.h>\nint other(void);\n"
              "int main(void) { int x, y, z; e_get_acc(&x, &y, &z); return other(); }");
  folder.file("prog/other.c",
              "#include <a_d/advance_ad_scan/e_acc.h>\nint other(void) { return e_get_acc(0); }");
  auto built = build_folder(folder, "prog");
  ASSERT_TRUE(built.ok) << text_of(built);
  EXPECT_TRUE(has_function(folder, "e_get_acc"));
  EXPECT_TRUE(has_function(folder, "tp_basic_e_get_acc"));
}
