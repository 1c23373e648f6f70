// SPDX-License-Identifier: MIT
// twinpuck import: from a .wbt file to a world that runs, and what it says of files that are none.
#include "tests/cli/command.h"
#include "twinpuck_paths.h"

using namespace cli_test;

namespace {

class Import : public CommandTest {
 protected:
  std::string wbt(const std::string& name) const {
    return std::string(TWINPUCK_SOURCE_DIR) + "/tests/import/worlds/" + name;
  }
};

TEST_F(Import, both_conventions_of_axes_make_a_world_that_runs) {
  for (const char* name : {"old_axes.wbt", "new_axes.wbt"}) {
    const std::string world = path("imported.toml");
    const Said made = twinpuck("import " + wbt(name) + " --without-firmware -o " + world);
    ASSERT_EQ(made.exit_code, 0) << made.text;
    const Said ran = twinpuck("run " + world + " --for 0.1");
    EXPECT_EQ(ran.exit_code, 0) << name << ": " << ran.text;
  }
}

TEST_F(Import, what_is_not_carried_is_named_with_its_line) {
  const std::string file = write("odd.wbt",
                                 "#VRML_SIM R2022b utf8\n"
                                 "WorldInfo { }\n"
                                 "RectangleArena { }\n"
                                 "Track { }\n");
  const Said said = twinpuck("import " + file);
  EXPECT_EQ(said.exit_code, 0) << said.text;
  EXPECT_NE(said.text.find("odd.wbt:4: Track: not carried"), std::string::npos) << said.text;
}

}  // namespace
