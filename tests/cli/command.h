// SPDX-License-Identifier: MIT
// Runs the `twinpuck` command as a user would and keeps what it said.
#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/shell.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace cli_test {

namespace fs = std::filesystem;

using shell::Said;

inline std::string executable() { return std::string(TWINPUCK_BUILD_DIR) + "/twinpuck"; }

/// `arguments` go through the shell; the current folder is the project's.
inline Said twinpuck(const std::string& arguments, const std::string& before = "") {
  return shell::run("cd '" TWINPUCK_SOURCE_DIR "' && " + before + " '" + executable() + "' " + arguments +
                    " 2>&1 </dev/null");
}

/// For twinpuck(..., before): sends `signal` so many seconds after `file` has come and grown to `bytes`,
/// however long a busy PC takes until then; kills what has not ended ten seconds later.
inline std::string signal_once(const std::string& signal, const std::string& file, int bytes,
                               const std::string& seconds = "0.5") {
  return "sh -c '\"$@\" & p=$!; n=0; "
         "until [ $n = 1200 ] || [ \"$(stat -c %s \"" +
         file + "\" 2>/dev/null || echo -1)\" -ge " + std::to_string(bytes) +
         " ]; do sleep 0.05; n=$((n + 1)); done; sleep " + seconds + "; kill -s " + signal +
         " $p; { sleep 10; kill -s KILL $p; } >/dev/null 2>&1 & q=$!; "
         "wait $p; r=$?; kill $q 2>/dev/null; exit $r' sh";
}

/// A folder of this test's own, empty at the start.
class CommandTest : public ::testing::Test {
 protected:
  CommandTest()
      : folder(fs::path(::testing::TempDir()) / ("twinpuck-" + std::to_string(getpid()) + "-" + name())) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~CommandTest() override { fs::remove_all(folder); }

  std::string path(const std::string& name) const { return (folder / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
    return path(name);
  }
  static std::string read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// A line of the shell in this test's folder, where `twinpuck` is found.
  Said in_folder(const std::string& line) const {
    return twinpuck("", "cd '" + folder.string() +
                            "' && export PATH='" TWINPUCK_BUILD_DIR "':\"$PATH\" && { " + line +
                            "\n} 2>&1 </dev/null #");
  }
  /// For EXPECT_TRUE(reads(said, wanted)), as in messages.txt: @ is this test's folder, ~ the project's.
  testing::AssertionResult reads(const std::string& said, const std::string& wanted) const {
    return wording::reads(
        said, wanted, {{folder.string(), "@"}, {TWINPUCK_BUILD_DIR, "~/build"}, {TWINPUCK_SOURCE_DIR, "~"}});
  }

  const fs::path folder;

 private:
  static std::string name() {
    std::string text = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(text.begin(), text.end(), '/', '-');  // before a parameter
    return text;
  }
};

}  // namespace cli_test
