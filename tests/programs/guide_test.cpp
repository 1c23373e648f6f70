// SPDX-License-Identifier: MIT
// The example of a supervisor in docs/connecting.md, as it stands there.
#include <filesystem>

#include "tests/programs/process_watch.h"

namespace {

using namespace programs_test;

class Guide : public WatchedRuns {
 protected:
  /// What stands between the first fences of this kind in the page's section.
  static std::string block(const std::string& kind) {
    const std::string page = read(TWINPUCK_SOURCE_DIR "/docs/connecting.md"), fence = "```" + kind + "\n";
    const std::size_t begin = page.find(fence, page.find("\n## Supervisors\n"));
    if (begin == std::string::npos) return "";
    return page.substr(begin + fence.size(), page.find("```", begin + 3) - begin - fence.size());
  }
};

TEST_F(Guide, the_example_passes) {
  write("referee/referee.py", block("python"));
  write("w.toml", block("toml"));
  const Said said = run("--for 60 --record " + path("r.csv"));
  EXPECT_EQ(said.exit_code, 0) << said.text;
  EXPECT_NE(said.text.find("referee: half a metre in "), std::string::npos) << said.text;
  expect_whole(path("r.csv"), 1, "the example");
  // a name without a path is of the program's folder
  EXPECT_TRUE(fs::exists(path("referee/half_a_metre.png")));
}

}  // namespace
