// SPDX-License-Identifier: MIT
// What a build may take: compilers end with whoever started them, have bounded memory, and wait for no pipe.
#include <sys/stat.h>

#include <chrono>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Limits : public CommandTest {
 protected:
  /// Macros of macros: 8 to the power of `depth` ones, joined by `by`.
  static std::string macros(int depth, char by) {
    std::string text = "#define A0 (1)\n";
    for (int i = 1; i <= depth; ++i) {
      text += "#define A" + std::to_string(i);
      for (int k = 0; k < 8; ++k) text += std::string(k ? 1 : 0, by) + " A" + std::to_string(i - 1);
      text += "\n";
    }
    return text;
  }
  /// Takes a compiler of C a quarter of a minute, and one of C++ longer; on a machine that is at work, both longer.
  void write_slow() const {
    write("slow/main.c", macros(14, '+') + "#if A14 > 5\nint x;\n#endif\nint main(void) { while (1); }\n");
    write("referee.c", "#include <webots/robot.h>\n" + macros(12, '+') +
                           "#if A12 > 5\nint x;\n#endif\nint main(void) { return 0; }\n");
  }
  /// Compilers that work on this test's files.
  std::string compilers() const {
    return shell::run("pgrep -fa '([t]winpuck-cc|[c]c1).*" + path("") + "'").text;
  }
  /// `arguments` with the end asked for after a second and a half: seconds until it came.
  void expect_quick_end(const std::string& arguments, const std::string& signal) const {
    const std::string before = "sh -c '\"$@\" & p=$!; sleep 1.5; date +%s.%N >" + path("asked") +
                               "; kill -s " + signal + " $p; wait $p; r=$?; date +%s.%N >" + path("ended") +
                               "; exit $r' sh";
    const Said said = twinpuck(arguments, before);
    EXPECT_EQ(said.exit_code, 130) << arguments << said.text;
    EXPECT_LT(std::atof(read(path("ended")).c_str()) - std::atof(read(path("asked")).c_str()), 10)
        << arguments << " " << signal;
    usleep(100'000);
    EXPECT_EQ(compilers(), "") << arguments << " " << signal;
  }
};

TEST_F(Limits, compilers_end_with_the_verb_that_started_them) {
  write_slow();
  const std::string slow = "'" + path("slow") + "'", referee = "'" + path("referee.c") + "'";
  for (const char* signal : {"TERM", "INT"})
    for (const std::string& arguments : {"build " + slow + " -o " + path("o.elf"), "run maze --fw " + slow,
                                         "lint " + slow, "run maze --supervisor " + referee})
      expect_quick_end(arguments, signal);
  expect_quick_end("view maze --port 0 --fw " + slow, "TERM");
  expect_quick_end("debug maze --fw " + slow, "TERM");
  // and of one that cannot react
  twinpuck("build " + slow + " -o " + path("o.elf"),
           "sh -c '\"$@\" & p=$!; sleep 1; kill -s KILL $p; wait $p' sh");
  usleep(200'000);
  EXPECT_EQ(compilers(), "");
}

TEST_F(Limits, the_host_limit_counts_the_building_too) {
  write_slow();
  for (const std::string& what :
       {"--fw '" + path("slow") + "'", "--supervisor '" + path("referee.c") + "'"}) {
    const Said said = twinpuck("run maze --host-limit 1.5 " + what);
    EXPECT_EQ(said.exit_code, 124) << said.text;
    EXPECT_TRUE(reads(said.text, "\ntwinpuck: host time: got more than 1.5 s, expected at most 1.5 s"));
    usleep(100'000);
    EXPECT_EQ(compilers(), "") << what;
  }
}

constexpr const char* kTooDeep =
    "error: compiler: got a program that it cannot take (signal 11, Segmentation fault), expected shorter, "
    "or "
    "less deeply nested, expressions and blocks; split the longest";

/// Each of these once ended the compiler with "status 139".
TEST_F(Limits, what_is_too_deep_for_the_compiler_is_told_with_its_line) {
  const auto many = [](int times, const std::string& text) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const std::string head = "int x;\n\nint main(void) {\n  ";
  write("terms/main.c", head + "x = x" + many(100000, " + x") + ";\n}\n");
  write("stars/main.c", head + "x = " + many(100000, "*") + "x;\n}\n");
  write("signs/main.c", head + "x = " + many(100000, "- ") + "x;\n}\n");
  for (const char* name : {"terms", "stars", "signs"}) {
    const Said said = in_folder("twinpuck build " + std::string(name) + " -o o.elf");
    EXPECT_EQ(said.exit_code, 1) << said.text;
    // whichever stage it ends in: the statement, or what comes behind it
    const std::string line = name == std::string("terms") ? "/main.c:5:1: " : "/main.c:4:3: ";
    EXPECT_TRUE(reads(said.text, name + line + kTooDeep));
  }
  const std::string brackets = many(100000, "(") + "1" + many(100000, ")");
  const std::string in_asm =
      "expression: got brackets or signs more than 250 within one another, expected at most that";
  write("asm/main.c", "int main(void) {\n  __asm__(\"mov #" + brackets + ", w0\");\n  return 0;\n}\n");
  write("word/main.c", "\n__asm__(\".word " + brackets + "\");\nint main(void) { while (1); }\n");
  write("s/a.s", "\n .word " + brackets + "\n");
  write("equal/a.s", "\n x = " + brackets + "\n");
  const auto says = [&](const std::string& name, const std::string& wanted) {
    const Said said = in_folder("twinpuck build " + name + " -o o.elf");
    EXPECT_EQ(said.exit_code, 1);
    EXPECT_EQ(said.text.rfind(wanted, 0), 0u) << said.text.substr(0, 300);
    EXPECT_LT(said.text.size(), 300000u);
  };
  says("asm", "asm/main.c:2:11: error: " + in_asm + "; in asm(\"mov #((((");
  says("word", "word/main.c:2:9: error: " + in_asm + "; in asm(\".word ((((");
  says("s", "s/a.s:2:2: error: " + in_asm);
  says("equal", std::string("equal/a.s: ") + kTooDeep);
  // brackets and signs in texts and comments are none
  write("good/a.s", " .ascii \"" + many(300, "-") + "\"\n nop ; " + many(300, "-") + "\n nop // " +
                        many(300, "(") + "\n");
  write("good/main.c", "int main(void) { while (1); }\n");
  EXPECT_EQ(in_folder("twinpuck build good -o o.elf").exit_code, 0);
}

/// A switch of 60,000 cases took more than ten minutes.
TEST_F(Limits, compilers_have_so_much_processor_time_and_projects_so_many_files) {
  std::string cases;
  for (int i = 0; i < 60000; ++i)
    cases += "case " + std::to_string(7919L * i) + ": return " + std::to_string(i % 10000) + ";\n";
  write("switch/main.c", "int f(long x) {\n  switch (x) {\n" + cases +
                             "  }\n  return 0;\n}\nint main(void) { return f(1); }\n");
  const Said slow = in_folder("ulimit -S -t 4; timeout 500 twinpuck build switch -o o.elf");
  EXPECT_EQ(slow.exit_code, 1);
  EXPECT_TRUE(reads(slow.text,
                    "switch/main.c: compile time: got more than 4 s of processor time, expected at most "
                    "that; does a macro "
                    "grow without end, or is a function or a switch huge? split it"));
  for (int i = 0; i <= 2000; ++i) write("many/f" + std::to_string(i) + ".c", "");
  const Said many = in_folder("twinpuck build many -o o.elf");
  EXPECT_EQ(many.exit_code, 2);
  EXPECT_TRUE(reads(many.text,
                    "many: project: got 2001 files in C and assembler, expected at most 2000; is it one "
                    "program's folder?"));
}

/// A look at full caches takes longer than many runs.
TEST_F(Limits, a_run_that_puts_nothing_into_the_caches_does_not_look_through_them) {
  const std::string cache = "env XDG_CACHE_HOME=" + path("cache"), stamp = path("cache/twinpuck/bounded");
  const auto ages_ago = fs::file_time_type::clock::now() - std::chrono::hours(2);
  for (const bool builds : {true, false}) {
    if (!builds) fs::last_write_time(stamp, ages_ago);
    const Said said = twinpuck("run maze --for 0.01", cache);
    ASSERT_EQ(said.exit_code, 0) << said.text;
    EXPECT_EQ(fs::last_write_time(stamp) > ages_ago + std::chrono::hours(1), builds);
  }
}

/// Each library that is loaded with the program costs every call up to a millisecond.
TEST_F(Limits, a_start_loads_nothing_that_few_runs_need) {
  const Said loaded = twinpuck("", "env LD_TRACE_LOADED_OBJECTS=1");
  EXPECT_NE(loaded.text.find("libbox2d"), std::string::npos) << loaded.text;
  for (const char* late :
       {"cairo", "civetweb", "dw.so", "gomp", "jpeg", "LLVM", "muparser", "sndfile", "vpx"})
    EXPECT_EQ(loaded.text.find(late), std::string::npos) << late << '\n' << loaded.text;
}

}  // namespace
