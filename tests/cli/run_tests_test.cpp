// SPDX-License-Identifier: MIT
// What the front door's scripts show: run_tests.py, progress.py, setup.sh.
#include "tests/cli/command.h"

namespace cli_test {
namespace {

class RunTests : public CommandTest {};

// a build folder with one program, which says what GoogleTest would
TEST_F(RunTests, a_failing_test_is_told_with_a_path_that_opens_from_here) {
  write("here/test.cpp", "");
  write("out/build.ninja", "build x_test: phony\n");
  write("out/tests/programs.txt", "x_test x_test\n");
  write("out/tests/x_test",
        "#!/bin/sh\necho '[ RUN      ] mine.drives'\necho '../here/test.cpp:12: Failure'\n"
        "echo 'C++ exception with description \"../here/test.cpp:9: cannot start\"'\n"
        "echo '[  FAILED  ] mine.drives (3 ms)'\necho '[  FAILED  ] 1 test, listed below:'\n"
        "echo '[  FAILED  ] mine.drives'\nexit 1\n");
  fs::permissions(folder / "out/tests/x_test", fs::perms::owner_all);
  const std::string file = path("said");
  const std::string line = "cd '" + folder.string() +
                           "' && '" TWINPUCK_SOURCE_DIR "/scripts/run_tests.py' out 1 >'" + file + "' 2>&1";
  const int status = std::system(line.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string said = read(file);
  // and at the end, where one looks first, once more by name
  EXPECT_TRUE(reads(
      said,
      "FAIL  x_test: mine.drives\n      here/test.cpp:12: Failure\n      C++ exception with description "
      "\"here/test.cpp:9: cannot start\"\nfailed: x_test: mine.drives\n0 passed, 1 failed"));
}

// what hangs is ended, and the tests behind it run: what a test waits for, or the program itself
TEST_F(RunTests, a_test_that_does_not_end_is_ended_and_fails) {
  write("out/build.ninja", "build x_test: phony\nbuild y_test: phony\n");
  write("out/tests/programs.txt", "x_test x_test\ny_test y_test\n");
  write("out/tests/x_test",
        "#!/bin/sh\necho '[ RUN      ] Mine.waits'\nsh -c 'sleep 1000; true'\n"
        "echo '[       OK ] Mine.waits (3 ms)'\necho '[ RUN      ] Mine.goes_on'\n"
        "echo '[       OK ] Mine.goes_on (2 ms)'\n");
  write("out/tests/y_test",
        "#!/usr/bin/python3\nprint('[ RUN      ] Mine.turns', flush=True)\nwhile True: pass\n");
  for (const char* name : {"x_test", "y_test"}) {
    fs::permissions(folder / "out/tests" / name, fs::perms::owner_all);
  }
  const int status =
      std::system(("cd '" + folder.string() +
                   "' && TWINPUCK_TEST_LIMIT=1 '" TWINPUCK_SOURCE_DIR "/scripts/run_tests.py' out 1 >'" +
                   path("said") + "' 2>&1")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string said = read(path("said"));
  for (const char* part : {"...   x_test: Mine.waits is ended, it has run for more than 1 s\n",
                           "\nFAIL  x_test: Mine.waits\n", "\nok    x_test: Mine.goes_on\n",
                           "\nfailed: x_test: Mine.waits\nfailed: y_test: ended with status -9 in "
                           "Mine.turns\n1 passed, 2 failed\n"})
    EXPECT_NE(said.find(part), std::string::npos) << part << "in:\n" << said;
}

// a program that runs a list of its tests, as firmware_register_test does, shows that list and nothing else
TEST_F(RunTests, a_filter_keeps_to_the_tests_that_a_program_lists) {
  write("out/build.ninja", "build x_test: phony\n");
  write("out/tests/programs.txt", "x_test x_test\n");
  write("out/tests/x_test",
        "#!/bin/sh\ncase $1 in\n--gtest_list_tests) printf 'Mine.\\n  drives\\n  stops\\n  drives_on  # "
        "GetParam()\\n';;\n"
        "--gtest_filter=Mine.drives:Mine.drives_on) for t in drives drives_on; do echo \"[ RUN      ] "
        "Mine.$t\"; "
        "echo \"[       OK ] Mine.$t (3 ms)\"; done;;\n*) exit 1;;\nesac\n");
  fs::permissions(folder / "out/tests/x_test", fs::perms::owner_all);
  const std::string run =
      "cd '" + folder.string() + "' && '" TWINPUCK_SOURCE_DIR "/scripts/run_tests.py' out 1 --filter ";
  const std::string to = " >'" + path("said") + "' 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system((run + "drives" + to).c_str())), 0);
  EXPECT_EQ(read(path("said")),
            "ok    x_test: Mine.drives\nok    x_test: Mine.drives_on\n2 passed, 0 failed\n");
  EXPECT_EQ(WEXITSTATUS(std::system((run + "flies" + to).c_str())), 5) << "nothing selected";
  EXPECT_EQ(read(path("said")),
            "make test: T: got 'flies', expected a part of a test's or a program's name\n");
}

TEST_F(RunTests, a_build_shows_counts_and_every_error) {
  write("bin/ninja",
        "#!/bin/sh\necho 'ninja: Entering directory'\necho '[0/2] Re-checking globbed directories...'\n"
        "echo '[1/3] Building CXX object sim_core/CMakeFiles/sim_core.dir/a.cpp.o'\necho 'a.cpp:1: error: "
        "no'\nexit 3\n");
  fs::permissions(folder / "bin/ninja", fs::perms::owner_all);
  const int status = std::system(
      ("PATH='" + path("bin") + "':$PATH python3 '" TWINPUCK_SOURCE_DIR "/scripts/progress.py' out 1 all >'" +
       path("said") + "' 2>&1")
          .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(read(path("said")), "[1/3] sim_core\na.cpp:1: error: no\n");
}

TEST_F(RunTests, without_root_the_whole_command_to_paste_is_shown) {
  write("bin/dpkg-query", "#!/bin/sh\necho 'installed cmake'\nexit 1\n");
  write("bin/id", "#!/bin/sh\necho 1000\n");
  for (const char* name : {"dpkg-query", "id"}) fs::permissions(folder / "bin" / name, fs::perms::owner_all);
  fs::create_symlink("/bin/sed", folder / "bin/sed");  // and no sudo
  const int status =
      std::system(("PATH='" + path("bin") + "' /bin/sh '" TWINPUCK_SOURCE_DIR "/scripts/setup.sh' >'" +
                   path("said") + "' 2>&1")
                      .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_EQ(read(path("said"))
                .rfind("setup.sh: packages are missing, and installing them needs root. As root, run:\n"
                       "  apt-get update && apt-get install -y --no-install-recommends g++ ninja-build ",
                       0),
            0u)
      << read(path("said"));
}

}  // namespace
}  // namespace cli_test
