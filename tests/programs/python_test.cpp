// SPDX-License-Identifier: MIT
// Programs in Python and Java against a simulator that Python plays: the package controller, and the classes
// where a JDK is, with the library of this build.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

#include "tests/support/shell.h"
#include "twinpuck_paths.h"

namespace {

/// What a test in Python said; empty when it passed.
std::string failed(const std::string& file, const std::string& words) {
  const std::string folder = TWINPUCK_SOURCE_DIR "/tests/programs";
  std::string environment = "TWINPUCK_LIBCONTROLLER='" TWINPUCK_BUILD_DIR "/libcontroller.so'";
#ifdef __SANITIZE_ADDRESS__
  environment += " ASAN_OPTIONS=detect_leaks=0 LD_PRELOAD=$(gcc -print-file-name=libasan.so)";
#endif
  const std::string command =
      "cd '" + folder + "' && " + environment + " python3 -B " + file + " " + words + " 2>&1";
  const shell::Said said = shell::run(command);
  return said.exit_code == 0 ? "" : said.text;
}

class PythonPrograms : public testing::TestWithParam<const char*> {};

TEST_P(PythonPrograms, of_robots) { EXPECT_EQ(failed("controller_test.py", GetParam()), ""); }
INSTANTIATE_TEST_SUITE_P(Of, PythonPrograms,
                         testing::Values("Beginning", "Devices", "Pictures", "Radio", "Ends"),
                         [](const auto& info) { return std::string(info.param); });

TEST(PythonController, supervisors) { EXPECT_EQ(failed("controller_supervisor_test.py", ""), ""); }
TEST(PythonController, calls_functions_as_the_headers_declare_them) {
  EXPECT_EQ(failed("functions_test.py", "'" TWINPUCK_SOURCE_DIR "'"), "");
}

TEST(ExamplePrograms, do_what_their_pages_say) {
  EXPECT_EQ(failed("examples_test.py", "'" TWINPUCK_BUILD_DIR "'"), "");
}

TEST(JavaPrograms, see_and_do_the_same) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "Java's machine brings its own memory";
#endif
  if (!std::filesystem::exists(TWINPUCK_BUILD_DIR "/Controller.jar"))
    GTEST_SKIP() << "no JDK was there when this was built; apt install default-jdk-headless";
  EXPECT_EQ(failed("java_test.py", "'" TWINPUCK_BUILD_DIR "'"), "");
}

}  // namespace
