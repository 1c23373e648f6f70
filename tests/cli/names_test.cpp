// SPDX-License-Identifier: MIT
// What a name means, and that it is said: programs and worlds, here, beside the world and in the project.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class NamedThings : public CommandTest {};

TEST_F(NamedThings, summary_names_the_program_that_ran) {
  write("here/obstacle/main.c", "int main(void) { while (1); }\n");
  write("here/obstacle/more.c", "int more(void) { return 1; }\n");
  for (const char* hal : {"sim", "dspic"}) {
    in_folder(std::string("cd here && twinpuck run maze --for 0.01 --fw obstacle --summary s.json --hal ") +
              hal);
    const json robot = json::parse(read(path("here/s.json")))["robots"][0];
    EXPECT_EQ(robot["program"], fs::canonical(path("here/obstacle")).string());
    EXPECT_EQ(robot["files"], 2);
  }
}

}  // namespace
