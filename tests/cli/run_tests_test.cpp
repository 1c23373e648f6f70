// SPDX-License-Identifier: MIT
// scripts/run_tests.py: what a user sees of a failing test.
#include "tests/cli/command.h"

namespace cli_test {
namespace {

class RunTests : public CommandTest {};

// a build folder with one program, which says what GoogleTest would
TEST_F(RunTests, a_failing_test_is_told_once_with_a_path_that_opens_from_here) {
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
  EXPECT_NE(said.find("FAIL  x_test: mine.drives\n      here/test.cpp:12: Failure\n"), std::string::npos)
      << said;
  EXPECT_NE(said.find("\"here/test.cpp:9: cannot start\""), std::string::npos) << said;
  EXPECT_EQ(said.find("mine.drives"), said.rfind("mine.drives")) << said;
}

}  // namespace
}  // namespace cli_test
