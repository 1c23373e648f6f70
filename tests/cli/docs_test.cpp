// SPDX-License-Identifier: MIT
// The pages show what the program prints.
#include "tests/cli/command.h"

using namespace cli_test;

namespace {

TEST(Docs, samples_of_the_pages_are_what_the_program_prints) {
  const std::string line =
      "cd '" TWINPUCK_SOURCE_DIR "' && python3 scripts/doc_samples.py '" TWINPUCK_BUILD_DIR "' --check 2>&1";
  FILE* pipe = popen(line.c_str(), "r");
  std::string said;
  for (int c; (c = fgetc(pipe)) != EOF;) said.push_back(static_cast<char>(c));
  EXPECT_EQ(pclose(pipe), 0) << said;
}

}  // namespace
