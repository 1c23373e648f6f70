// SPDX-License-Identifier: MIT
// The pages show what the program prints.
#include "tests/cli/command.h"

using namespace cli_test;

namespace {

TEST(Docs, samples_of_the_pages_are_what_the_program_prints) {
  const std::string line =
      "cd '" TWINPUCK_SOURCE_DIR "' && python3 scripts/doc_samples.py '" TWINPUCK_BUILD_DIR "' --check 2>&1";
  const Said said = shell::run(line);
  EXPECT_EQ(said.exit_code, 0) << said.text;
}

}  // namespace
