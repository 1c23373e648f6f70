// SPDX-License-Identifier: MIT
// The build driver: incremental builds, overriding, errors in the project's grammar, lint, costs.
#include <gtest/gtest.h>

#include "fake_host.h"

using namespace fake;

TEST(build, a_changed_header_recompiles_who_includes_it) {
  Folder folder;
  folder.file("prog/speed.h", "#define SPEED 3\n");
  folder.file("prog/other.c", "int other(void) { return 1; }");
  const char* text =
      "#include <stdio.h>\n#include \"speed.h\"\nint main(void) { printf(\"%d\", SPEED); return 0; }";
  ASSERT_TRUE(build(folder, text).ok);
  folder.file("prog/speed.h", "#define SPEED 4\n");
  auto again = build(folder, text);
  EXPECT_EQ(again.compiled, 1);
  Image image(folder.path / "prog.so");
  EXPECT_EQ(image.run().console, "4");
}

TEST(build, the_programs_own_function_replaces_the_librarys) {
  auto run = run_c(
      "#include <stdio.h>\nint abs(int v) { return v + 1000; } int puts(const char *s) { printf(\"mine\"); "
      "return 0; }\nint main(void) { puts(\"x\"); return 0; }");
  EXPECT_EQ(run.console, "mine");
}

TEST(build, missing_functions_are_named_with_file_and_caller) {
  Folder folder;
  auto built = build(folder, "int main(void) {\n  e_fly_to_the_moon(3);\n  return 0; }");
  EXPECT_FALSE(built.ok);
  EXPECT_NE(text_of(built).find("main.c:2"), std::string::npos) << text_of(built);
  EXPECT_NE(text_of(built).find("e_fly_to_the_moon"), std::string::npos) << text_of(built);
  EXPECT_NE(text_of(built).find("main()"), std::string::npos) << text_of(built);
  EXPECT_FALSE(std::filesystem::exists(folder.path / "prog.so"));
}

TEST(build, several_mains_and_none_are_said_clearly) {
  Folder folder;
  folder.file("prog/second.c", "int main(void) { return 2; }");
  auto two = build(folder, "int main(void) { return 1; }");
  EXPECT_FALSE(two.ok);
  EXPECT_NE(text_of(two).find("got 2 definitions (main.c, second.c), expected 1"), std::string::npos)
      << text_of(two);
  Folder other;
  auto none = build(other, "int start(void) { return 1; }");
  EXPECT_NE(text_of(none).find("main(): got no definition"), std::string::npos) << text_of(none);
  cc::BuildOptions nowhere;
  nowhere.source_dir = other.path / "absent";
  nowhere.output = other.path / "x.so";
  EXPECT_NE(text_of(cc::build_image(nowhere)).find("got no such folder"), std::string::npos);
}

TEST(build, programs_that_are_no_firmware_are_named) {
  struct Case {
    const char *file, *text, *told;
  };
  const Case cases[] = {
      {"prog/mine.cpp", "#include <webots/Robot.hpp>\nint main() { return 0; }",
       "prog/mine.cpp: program: got C++, expected C"},
      {"prog/mine.py", "from controller import Robot",
       "prog: controller: got a program in Python, expected one in C"},
      {"prog/mine.c", "#include <webots/robot.h>\nint main(void) { wb_robot_init(); return 0; }",
       "prog: program: got one for Webots' interfaces, expected one for the e-puck's library"}};
  for (const Case& c : cases) {
    Folder folder;
    folder.file(c.file, c.text);
    cc::BuildOptions options;
    options.source_dir = folder.path / "prog";
    options.output = folder.path / "prog.so";
    const auto built = cc::build_image(options);
    EXPECT_FALSE(built.ok) << c.file;
    EXPECT_NE(text_of(built).find(c.told), std::string::npos) << text_of(built);
  }
  // main() may be in C++ where the rest is in C; a test beside is no part of a program
  Folder folder;
  folder.file("prog/test.cpp", "#include \"tests/support/firmware_test.h\"\nint main(void) {}");
  EXPECT_NE(text_of(build(folder, "int part;")).find("main(): got no definition"), std::string::npos);
  folder.file("prog/start.cc", "int main() { return 0; }");
  const auto mixed = build(folder, "int part;");
  EXPECT_NE(text_of(mixed).find("start.cc: program: got C++"), std::string::npos) << text_of(mixed);
  EXPECT_TRUE(build(folder, "int main(void) { return 0; }").ok);
}

TEST(build, sixteen_bit_warnings_are_passed_on) {
  Folder folder;
  auto built = build(folder,
                     "#include <stdio.h>\nint a = 70000;\nint f(int i) { return i << 16; }\nint main(void) { "
                     "int i; for (i = 0; i < 100000; i++) printf(\"%ld\", i); return 0; }");
  ASSERT_TRUE(built.ok);
  std::string text = text_of(built);
  EXPECT_NE(text.find("main.c:2"), std::string::npos) << text;
  EXPECT_NE(text.find("70000"), std::string::npos) << text;
  EXPECT_NE(text.find("shift count"), std::string::npos) << text;
  EXPECT_NE(text.find("100000"), std::string::npos) << text;
  EXPECT_NE(text.find("format specifies type 'long'"), std::string::npos) << text;
}

TEST(build, syntax_errors_name_file_and_line) {
  Folder folder;
  auto built = build(folder, "int main(void) {\n  int x = ;\n}");
  EXPECT_FALSE(built.ok);
  ASSERT_EQ(built.errors.size(), 1u) << text_of(built);
  EXPECT_NE(built.errors[0].find("main.c:2"), std::string::npos) << built.errors[0];
}

TEST(build, too_much_data_is_warned_of) {
  Folder folder;
  auto built = build(folder, "char picture[9000]; int main(void) { return picture[3]; }");
  EXPECT_TRUE(built.ok);
  EXPECT_NE(text_of(built).find("expected at most 8192 (bytes)"), std::string::npos) << text_of(built);
}

// 14 bytes a function [estimated: hal_sim/cc/account.cpp], 48 for what interrupts. main 14, deep 14 + 2 x 300
TEST(build, stack_is_the_deepest_way_from_main_and_the_deepest_interrupt) {
  Folder folder;
  const std::string functions =
      "void use(int *p);\n__attribute__((noinline)) void use(int *p) { p[0]++; }\n"
      "__attribute__((noinline)) void deep(void) { int k[300]; use(k); }\n"
      "__attribute__((noinline)) void flat(void) { int k[20]; use(k); }\n";
  const auto plain = build(folder, functions + "int main(void) { deep(); flat(); return 0; }");
  ASSERT_TRUE(plain.ok) << text_of(plain);
  EXPECT_EQ(plain.stack_bytes, 14 + (14 + 600) + 14 + 48);
  EXPECT_EQ(plain.recursive, "");
  // a handler: 20 more, and what it calls
  const auto handled =
      build(folder, functions +
                        "void __attribute__((interrupt, auto_psv)) _T1Interrupt(void) { flat(); }\n"
                        "int main(void) { deep(); return 0; }");
  EXPECT_EQ(handled.stack_bytes, plain.stack_bytes + (14 + 20) + (14 + 40) + 14) << text_of(handled);
  // an agenda is called by pointer; pointers have two bytes
  const auto agenda =
      build(folder, functions +
                        "void (*volatile due)(void); __attribute__((noinline)) void keep(char **p) { "
                        "p[1] = p[0]; }\nvoid step(void) { char *all[10]; keep(all); }\n"
                        "int main(void) { due = step; deep(); return 0; }");
  EXPECT_EQ(agenda.stack_bytes, plain.stack_bytes + (14 + 20) + 14) << text_of(agenda);
}

// pointers have two bytes, constants are in flash, and the gaps of --sanitize are none of the chip's
TEST(build, data_counts_as_on_the_chip) {
  Folder folder;
  const std::string program =
      "char *names[10]; const char *const fixed[] = {\"a\", \"b\"}; const int table[50] = {1}; char "
      "three[3];\n"
      "struct { char c; int *p; long l; } both; static int hidden = 3; volatile int n;\n"
      "int main(void) { static long kept; kept += n; names[n] = (char *)fixed[n]; three[n] = both.c;\n"
      "  return hidden++ + table[n] + (int)kept; }";
  for (const bool sanitize : {false, true}) {
    const auto built = build(folder, program, "-O0", [&](cc::BuildOptions& o) { o.sanitize = sanitize; });
    ASSERT_TRUE(built.ok) << text_of(built);
    EXPECT_EQ(built.ram_bytes, 20 + 4 + 8 + 2 + 2 + 4) << sanitize;  // names three both hidden n kept
  }
}

TEST(build, recursion_has_no_bound_and_says_of_what) {
  Folder folder;
  const auto built =
      build(folder,
            "volatile int n;\nint down(int k) { return k ? down(k - 1) + n * down(k - 2) : 1; }\n"
            "int main(void) { return down(n); }");
  EXPECT_EQ(built.recursive, "down") << text_of(built);
}

TEST(build, data_and_stack_that_do_not_fit_together_are_warned_of) {
  Folder folder;
  const std::string program =
      "char picture[5000]; volatile int n;\n__attribute__((noinline)) void keep(char *p) { p[n] = 1; }\n"
      "void work(void) { char copy[3500]; keep(copy); }\nint main(void) { picture[n] = 1; work(); return 0; "
      "}";
  // also when all of it lies in the cache
  for (int time = 0; time < 2; ++time) {
    const auto built = build(folder, program, "-O0");
    EXPECT_TRUE(built.ok);
    EXPECT_NE(built.no_room, "");
    EXPECT_NE(text_of(built).find("static data and stack: got 5002 and about 3"), std::string::npos)
        << text_of(built);
    EXPECT_NE(text_of(built).find("deepest in main() > work() > keep()"), std::string::npos)
        << text_of(built);
  }
  const auto fits =
      build(folder, "char picture[5000]; volatile int n; int main(void) { return picture[n]; }");
  EXPECT_EQ(fits.no_room, "") << text_of(fits);
}

TEST(lint, finds_plain_flags_and_timer_conflicts) {
  Folder folder;
  folder.file("prog/main.c",
              "int flag; void _T5Interrupt(void) { flag = 1; }\n#include \"motor_led/e_motors.h\"\nint "
              "main(void) {\n  while (!flag);\n  return 0; }");
  folder.file("prog/motor_led/e_motors.h", "void e_init_motors(void);\n");
  cc::BuildOptions options;
  options.source_dir = folder.path / "prog";
  auto result = cc::lint_folder(options);
  EXPECT_FALSE(result.ok);
  EXPECT_NE(text_of(result).find("flag: polled in a loop"), std::string::npos) << text_of(result);
  EXPECT_NE(text_of(result).find("Timer 5: got two owners"), std::string::npos) << text_of(result);
}

TEST(build, two_owners_of_a_vector_are_named_at_each_start) {
  Folder folder;
  const std::string program =
      "void e_init_ad_scan(unsigned char); void e_init_uart1(void);\n"
      "void _U2RXInterrupt(void) {}\n"
      "void __attribute__((interrupt, no_auto_psv)) _ADCInterrupt(void) {}\n"
      "int main(void) { e_init_ad_scan(0); e_init_uart1(); return 0; }\n";
  for (int start = 0; start < 2; ++start) {
    const auto built = build(folder, program);
    ASSERT_EQ(built.conflicts.size(), 1u) << text_of(built);
    EXPECT_NE(built.conflicts[0].find("vector ADC: got two owners"), std::string::npos) << built.conflicts[0];
    EXPECT_NE(built.conflicts[0].find("the ADC scan"), std::string::npos) << built.conflicts[0];
    EXPECT_NE(built.conflicts[0].find("_ADCInterrupt"), std::string::npos) << built.conflicts[0];
  }
  EXPECT_TRUE(build(folder,
                    "void e_init_ad_scan(unsigned char);\n"
                    "int main(void) { e_init_ad_scan(0); return 0; }")
                  .conflicts.empty());
}

TEST(costs, callees_are_included_and_loops_bounded_when_known) {
  Folder folder;
  auto built = build(
      folder,
      "volatile int n, s; __attribute__((noinline)) int leaf(int a) { return a + 1; }\n"
      "__attribute__((noinline)) int ten(void) { int i; for (i = 0; i < 10; i++) s = leaf(i); return s; }\n"
      "__attribute__((noinline)) void unknown(void) { int i; for (i = 0; i < n; i++) s += i; }\n"
      "void _T1Interrupt(void) { s++; }\nint main(void) { ten(); unknown(); return 0; }");
  ASSERT_TRUE(built.ok) << text_of(built);
  double leaf = 0, ten = 0;
  for (const auto& f : cc::function_costs(folder.path / "prog.so")) {
    if (f.name == "leaf") {
      leaf = f.mean;
      EXPECT_EQ(f.min, f.max);
    }
    if (f.name == "ten") ten = f.max;
    if (f.name == "unknown") {
      EXPECT_EQ(f.max, -1);
    }
    if (f.name == "_T1Interrupt") {
      EXPECT_TRUE(f.is_interrupt);
      EXPECT_GT(f.cpu_load(0.001), 0.0005);
      EXPECT_LT(f.cpu_load(0.001), 0.01);
    }
  }
  EXPECT_GE(leaf, 4);
  EXPECT_LE(leaf, 6);
  EXPECT_GE(ten, 10 * (leaf + 2));
  EXPECT_LE(ten, 10 * (leaf + 12) + 20);
}
