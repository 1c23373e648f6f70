// SPDX-License-Identifier: MIT
// The example of docs/supervisor.md, as it stands there.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace {

using firmware_test::FirmwareTest;
namespace fs = std::filesystem;

class GuideTest : public FirmwareTest {
 protected:
  static std::string block(const std::string& kind) {
    std::ifstream in(TWINPUCK_SOURCE_DIR "/docs/supervisor.md");
    std::ostringstream text;
    text << in.rdbuf();
    const std::string page = text.str(), fence = "```" + kind + "\n";
    const std::size_t begin = page.find(fence) + fence.size();
    return page.substr(begin, page.find("```", begin) - begin);
  }
};

TEST_F(GuideTest, the_example_passes) {
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "guide";
  fs::create_directories(folder);
  fs::remove(folder / "half_a_metre.png");
  std::ofstream(folder / "referee.c") << block("c");
  std::ofstream(folder / "referee.toml") << block("toml");
  load_world((folder / "referee.toml").string());
  options.world_folder = folder.string();
  const fs::path before = fs::current_path();
  fs::current_path(folder);  // the picture goes there
  run_for(60);
  fs::current_path(before);
  EXPECT_EQ(finish().code, 0) << finish().text;
  EXPECT_NE(finish().text.find("passed: half a metre in "), std::string::npos) << finish().text;
  EXPECT_GT(fs::file_size(folder / "half_a_metre.png"), 1000u);
  EXPECT_GT(robot(0).distance_m(), 0.5);
}

}  // namespace
