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
  twinpuck("build " + slow + " -o " + path("o.so"),
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
    EXPECT_NE(said.text.find("host time: got more than 1.5 s, expected at most 1.5 s"), std::string::npos)
        << said.text;
    usleep(100'000);
    EXPECT_EQ(compilers(), "") << what;
  }
}

TEST_F(Limits, what_grows_without_end_ends_with_a_message) {
  const std::string main = "int main(void) { while (1); }\n";
  struct Case {
    const char *name, *file;
    std::string text;
    const char* message;
  };
  for (const Case& c : {
           Case{"macros", "main.c", macros(10, ',') + "const char v[] = { A10 };\n" + main,
                "memory: got more than"},
           Case{"space", "part.s", ".section .text,code\n.global _f\n_f: .space 0x7fffffff\n return\n",
                "output: got more than"},
           Case{"inline_space", "main.c", "int main(void) { asm(\".space 0x7fffffff\"); while (1); }\n",
                "output: got more than"},
           Case{"array", "main.c", "char v[2000000000L];\nint main(void) { return v[70000L]; }\n",
                "too large"},
       }) {
    write(std::string(c.name) + "/main.c", main);
    write(std::string(c.name) + "/" + c.file, c.text);
    const Said said = twinpuck("build '" + path(c.name) + "' --hal dspic -o " + path("o.elf"), "timeout 900");
    EXPECT_EQ(said.exit_code, 1) << c.name << said.text;
    EXPECT_NE(said.text.find(c.message), std::string::npos) << c.name << ": " << said.text;
    EXPECT_NE(said.text.find(c.file), std::string::npos) << c.name << ": " << said.text;
    EXPECT_FALSE(fs::exists(path("o.elf"))) << c.name;
  }
  write("grows.s", ".text\n.macro a x\n a \\x\\x\n.endm\n a 1234567890123456789012345678901234567890\n");
  const Said assembled = twinpuck("asm '" + path("grows.s") + "' -o " + path("o.hex"), "timeout 900");
  EXPECT_EQ(assembled.exit_code, 1) << assembled.text;
  EXPECT_NE(assembled.text.find("grows.s: memory: got more than"), std::string::npos) << assembled.text;
}

TEST_F(Limits, nothing_waits_for_a_pipe) {
  const std::string main = "int main(void) { while (1); }\n";
  write("header/main.c", "#include \"pipe.h\"\n" + main);
  write("beside/main.c", "#include \"../header/pipe.h\"\n" + main);
  write("source/main.c", main);
  write("assembler/main.c", main);
  write("referee/referee.c",
        "#include <webots/robot.h>\n#include \"pipe.h\"\nint main(void) { return 0; }\n");
  for (const char* pipe : {"header/pipe.h", "source/more.c", "assembler/more.s", "referee/pipe.h", "alone.s"})
    ASSERT_EQ(mkfifo(path(pipe).c_str(), 0600), 0);
  struct Case {
    std::string arguments;
    const char* message;
    int exit_code;
  };
  for (const Case& c :
       {Case{"build '" + path("header") + "' -o " + path("o"), "pipe.h: source: got a pipe", 1},
        Case{"build '" + path("beside") + "' -o " + path("o"), "pipe.h", 1},
        Case{"build '" + path("source") + "' -o " + path("o"), "more.c: source: got a pipe", 1},
        Case{"build '" + path("assembler") + "' -o " + path("o"), "more.s: source: got a pipe", 1},
        Case{"run maze --for 1 --fw '" + path("header") + "'", "pipe.h: source: got a pipe", 2},
        Case{"lint '" + path("header") + "'", "pipe.h: source: got a pipe", 1},
        Case{"run maze --for 1 --supervisor '" + path("referee") + "'", "pipe.h: controller: got a pipe", 2},
        Case{"asm '" + path("alone.s") + "' -o " + path("o.hex"), "", 0}}) {
    const Said said = twinpuck(c.arguments, "timeout 600");
    EXPECT_EQ(said.exit_code, c.exit_code) << c.arguments << ": " << said.text;
    EXPECT_NE(said.text.find(c.message), std::string::npos) << c.arguments << ": " << said.text;
  }
}

// within .s files as well, and within what those include
TEST_F(Limits, assembler_that_includes_a_pipe_ends) {
  const std::string main = "int main(void) { for (;;) ; }\n";
  ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
  struct Case {
    const char *folder, *statement, *message;
  };
  for (const Case& c :
       {Case{"plain", ".include \"../pipe\"\n", "pipe: got a pipe, a device or a folder, expected a file"},
        Case{"binary", ".incbin \"../pipe\"\n", ".incbin: "},
        Case{"inner", ".include \"inner.inc\"\n", "inner.inc:2:"},
        Case{"device", ".include \"/dev/zero\"\n", "/dev/zero: got a pipe"},
        Case{"macro", ".macro m name\n.include \"../\\name\"\n.endm\nm pipe\n", "pipe: got a pipe"}}) {
    const std::string folder = c.folder;
    write(folder + "/main.c", main);
    write(folder + "/more.s", c.statement);
    write(folder + "/inner.inc", "\n.include \"../pipe\"\n");
    const Said built =
        twinpuck("build '" + path(folder) + "' --hal dspic -o " + path("o.elf"), "timeout 600");
    EXPECT_EQ(built.exit_code, 1) << built.text;
    EXPECT_NE(built.text.find(c.message), std::string::npos) << c.statement << built.text;
    if (folder == "binary") continue;
    const Said made = twinpuck("asm '" + path(folder + "/more.s") + "' -o " + path("o.hex"), "timeout 600");
    EXPECT_EQ(made.exit_code, folder == "macro" ? made.exit_code : 2) << made.text;
    EXPECT_NE(made.exit_code, 124) << made.text;
  }
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
