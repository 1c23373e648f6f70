// SPDX-License-Identifier: MIT
// The build driver: incremental builds, overriding, errors in the project's grammar, lint, costs.
#include <gtest/gtest.h>

#include "tests/cc/bench.h"

using namespace cc_test;

TEST(build, a_changed_header_recompiles_who_includes_it) {
  for (const std::string name : {"speed.h", "my speed.h", "a#b.h", "$x.h"}) {
    Folder folder;
    folder.file("prog/" + name, "#define SPEED 3\n");
    folder.file("prog/other.c", "int other(void) { return 1; }");
    const std::string text =
        "#include <stdio.h>\n#include \"" + name + "\"\nint main(void) { printf(\"%d\", SPEED); return 0; }";
    ASSERT_TRUE(build(folder, text).ok) << name;
    folder.file("prog/" + name, "#define SPEED 4\n");
    auto again = build(folder, text);
    EXPECT_EQ(again.compiled, 1) << name;
    EXPECT_EQ(output_of(folder.image()), "4") << name;
  }
}

TEST(build, the_programs_own_function_replaces_the_librarys) {
  EXPECT_EQ(printed_by("#include <stdio.h>\nint abs(int v) { return v + 1000; } int puts(const char *s) { "
                       "printf(\"mine\"); "
                       "return 0; }\nint main(void) { puts(\"x\"); return 0; }"),
            "mine");
}

TEST(build, missing_functions_are_named_with_file_and_caller) {
  Folder folder;
  auto built = build(folder, "int main(void) {\n  e_fly_to_the_moon(3);\n  return 0; }");
  EXPECT_FALSE(built.ok);
  EXPECT_TRUE(reads(folder, text_of(built),
                    "@/prog/main.c:2: error: main() calls e_fly_to_the_moon(): got no definition, expected "
                    "one in the program or the library; this function of the e-puck library is not simulated "
                    "yet, or its name is misspelt"));
  EXPECT_FALSE(std::filesystem::exists(folder.image()));
}

TEST(build, several_mains_and_none_are_said_clearly) {
  Folder folder;
  folder.file("prog/second.c", "int main(void) { return 2; }");
  auto two = build(folder, "int main(void) { return 1; }");
  EXPECT_FALSE(two.ok);
  EXPECT_TRUE(reads(folder, text_of(two),
                    "@/prog: main(): got 2 definitions (main.c, second.c), expected 1; give each program a "
                    "folder of its own"));
  Folder other;
  auto none = build(other, "int start(void) { return 1; }");
  EXPECT_TRUE(reads(other, text_of(none),
                    "@/prog: main(): got no definition, expected one; is this a controller's folder?"));
  cc::BuildOptions nowhere;
  nowhere.source_dir = other.path / "absent";
  nowhere.output = other.path / "x.elf";
  EXPECT_TRUE(reads(other, text_of(cc::build_image(nowhere)),
                    "@/absent: controller: got no such folder, expected one with a main.c"));
}

TEST(build, programs_that_are_no_firmware_are_named) {
  struct Case {
    const char *file, *text, *told;
  };
  const Case cases[] = {
      {"prog/mine.cpp", "#include <webots/Robot.hpp>\nint main() { return 0; }",
       "@/prog/mine.cpp: program: got C++, expected C; programs of the robot are in C, as XC16 has it"},
      {"prog/mine.py", "from controller import Robot",
       "@/prog: controller: got a program in Python, expected one in C; Python runs on the PC alone"},
  };
  for (const Case& c : cases) {
    Folder folder;
    folder.file(c.file, c.text);
    cc::BuildOptions options;
    options.source_dir = folder.path / "prog";
    options.output = folder.image();
    const auto built = cc::build_image(options);
    EXPECT_FALSE(built.ok) << c.file;
    EXPECT_TRUE(reads(folder, text_of(built), c.told));
  }
  // main() may be in C++ where the rest is in C; a test beside is no part of a program
  Folder folder;
  folder.file("prog/test.cpp", "#include \"tests/support/firmware_test.h\"\nint main(void) {}");
  EXPECT_TRUE(reads(folder, text_of(build(folder, "int part;")),
                    "@/prog: main(): got no definition, expected one; is this a controller's folder?"));
  folder.file("prog/start.cc", "int main() { return 0; }");
  const auto mixed = build(folder, "int part;");
  EXPECT_TRUE(
      reads(folder, text_of(mixed),
            "@/prog/start.cc: program: got C++, expected C; programs of the robot are in C, as XC16 has it"));
  EXPECT_TRUE(build(folder, "int main(void) { return 0; }").ok);
}

TEST(build, sixteen_bit_warnings_are_passed_on) {
  Folder folder;
  auto built = build(folder,
                     "#include <stdio.h>\nint a = 70000;\nint f(int i) { return i << 16; }\nint main(void) { "
                     "int i; for (i = 0; i < 100000; i++) printf(\"%ld\", i); return 0; }");
  ASSERT_TRUE(built.ok);
  std::string text = text_of(built);
  EXPECT_TRUE(reads(
      folder, text,
      "@/prog/main.c:2:9: warning: implicit conversion from 'long' to 'int' changes value from 70000 to 4464 "
      "[-Wconstant-conversion]\n@/prog/main.c:3:25: warning: shift count >= width of type "
      "[-Wshift-count-overflow]\n@/prog/main.c:4:68: warning: format specifies type 'long' but the argument "
      "has type 'int' [-Wformat]\n@/prog/main.c:4:39: warning: result of comparison of constant 100000 with "
      "expression of type 'int' is always true [-Wtautological-constant-out-of-range-compare]"));
}

// whoever shows one error only shows the first
TEST(build, an_error_in_a_header_comes_before_who_includes_it) {
  struct Row {
    const char *first, *second, *wanted;
  } const rows[] = {
      {"int f(void) { return x; }", "",
       "@/prog/first.h:1:22: error: use of undeclared identifier 'x'\nIn file included from "
       "@/prog/main.c:1:"},
      {"#include \"second.h\"\n", "int y = ;",
       "@/prog/second.h:1:9: error: expected expression\nIn file included from @/prog/main.c:1:\n"
       "In file included from @/prog/first.h:1:"},
      {"#include \"nothing_of_that_name.h\"\n", "",
       "@/prog/first.h:1:10: fatal error: 'nothing_of_that_name.h' file not found\nIn file included from "
       "@/prog/main.c:1:"},
      {"int f(void) { return 70000; }\nint g(void) { return z; }", "",
       "@/prog/first.h:2:22: error: use of undeclared identifier 'z'"},
  };
  for (const Row& row : rows) {
    Folder folder;
    folder.file("prog/first.h", row.first);
    folder.file("prog/second.h", row.second);
    const auto built = build(folder, "#include \"first.h\"\nint main(void) { return 0; }");
    EXPECT_FALSE(built.ok);
    ASSERT_FALSE(built.errors.empty());
    EXPECT_TRUE(reads(folder, built.errors.front(), row.wanted));
    for (const std::string& warning : built.warnings)
      EXPECT_EQ(warning.find("In file"), std::string::npos) << warning;
  }
}

TEST(build, syntax_errors_name_file_and_line) {
  Folder folder;
  auto built = build(folder, "int main(void) {\n  int x = ;\n}");
  EXPECT_FALSE(built.ok);
  ASSERT_EQ(built.errors.size(), 1u) << text_of(built);
  EXPECT_TRUE(reads(folder, built.errors[0], "@/prog/main.c:2:11: error: expected expression"));
}

TEST(build, too_much_data_has_no_room) {
  Folder folder;
  auto built = build(folder, "char picture[9000]; int main(void) { return picture[3]; }");
  EXPECT_FALSE(built.ok);
  EXPECT_TRUE(
      reads(folder, text_of(built),
            "link: error: RAM: no room for picture, 9000 bytes in 0x0800 to 0x27FF; largest: picture 9000"));
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
    EXPECT_TRUE(reads(folder, text_of(built),
                      "@/prog: warning: stack: got 3520 bytes at most, expected at most 3174, which is what "
                      "variables leave"));
  }
  const auto fits =
      build(folder, "char picture[5000]; volatile int n; int main(void) { return picture[n]; }");
  EXPECT_EQ(fits.no_room, "") << text_of(fits);
}

TEST(lint, finds_plain_flags_and_timer_conflicts) {
  Folder folder;
  folder.file("prog/main.c",
              "int flag; void __attribute__((interrupt)) _T5Interrupt(void) { flag = 1; }\n#include "
              "\"motor_led/e_motors.h\"\nint "
              "main(void) {\n  while (!flag);\n  return 0; }");
  folder.file("prog/motor_led/e_motors.h", "void e_init_motors(void);\n");
  cc::BuildOptions options;
  options.source_dir = folder.path / "prog";
  auto result = cc::lint_folder(options);
  EXPECT_FALSE(result.ok);
  EXPECT_TRUE(reads(folder, text_of(result),
                    "@/prog/main.c:4: warning: flag: written by _T5Interrupt(); got a plain variable, "
                    "expected volatile; XC16 may read it once at -O1 and wait for ever\nmain.c: warning: "
                    "Timer 5: got two owners (the basic motors and the program's own _T5Interrupt in "
                    "main.c), expected one; the later one silences the other"));
}

// clang names a file from the folder that it shares with the one where it runs
TEST(build, messages_name_files_wherever_the_build_runs) {
  Folder folder;
  const std::string mistake = "  register int s asm(\"A\");\n  s = __builtin_clr();\n  return s + 1;\n}\n",
                    told =
                        ":4:10: error: accumulator A is used like a number; only built-in functions of the "
                        "DSP unit take it, __builtin_sac() and __builtin_sacr() give its value";
  folder.file("prog/main.c", "int main(void) {\n" + mistake + "#include \"beside.h\"\n");
  folder.file("headers/beside.h", "int beside(void) {\n" + mistake);
  std::filesystem::create_directories(folder.path / "elsewhere");
  cc::BuildOptions options;
  options.include_dirs = {(folder.path / "headers").string()};
  options.cache_dir = folder.path / "cache";
  options.output = folder.path / "program.elf";
  struct Case {
    std::string from, source, main;
  };
  const std::string whole = (folder.path / "prog").string();
  const std::filesystem::path before = std::filesystem::current_path();
  for (const Case& c :
       {Case{"/", whole, "@/prog"}, Case{"elsewhere", whole, "@/prog"}, Case{"prog", whole, "@/prog"},
        Case{"elsewhere", "../prog", "../prog"}, Case{"", "prog", "prog"}}) {
    std::filesystem::current_path(folder.path / c.from);
    options.source_dir = c.source;
    std::string text = text_of(cc::build_image(options));
    // what lies below the folder may be told from there
    const std::string header = c.from.empty() ? "headers" : "@/headers";
    EXPECT_TRUE(reads(folder, text, c.main + "/main.c" + told + "\n" + header + "/beside.h" + told))
        << c.from;
  }
  std::filesystem::current_path(before);
}

// a handler of the program's own beside the library's: the robot's linker refuses it
TEST(build, two_owners_of_a_vector_are_refused_with_both_named) {
  Folder folder;
  const std::string program =
      "void e_init_ad_scan(unsigned char); void e_init_uart1(void);\n"
      "void __attribute__((interrupt, no_auto_psv)) _ADCInterrupt(void) {}\n"
      "int main(void) { e_init_ad_scan(0); e_init_uart1(); return 0; }\n";
  const auto built = build(folder, program);
  EXPECT_FALSE(built.ok);
  ASSERT_EQ(built.errors.size(), 1u) << text_of(built);
  EXPECT_TRUE(reads(folder, built.errors[0],
                    "@/prog/main.c: error: _ADCInterrupt(): got a second definition, expected one; the "
                    "library's a_d/advance_ad_scan/e_ad_conv.c has it too and is linked for "
                    "e_init_ad_scan(), which main.c calls: the robot's linker refuses that; define "
                    "e_init_ad_scan() as well, or give your function another name"));
  EXPECT_TRUE(build(folder,
                    "void e_init_ad_scan(unsigned char);\n"
                    "int main(void) { e_init_ad_scan(0); return 0; }")
                  .ok);
}
