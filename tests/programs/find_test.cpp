// SPDX-License-Identifier: MIT
// Where a program is looked for that a world names.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hal_sim/twin/twin.h"
#include "tests/support/wording.h"

namespace {

namespace fs = std::filesystem;

class FindTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/find-XXXXXX";
    home_ = mkdtemp(name);
    fs::create_directories(home_ / "worlds");
  }
  void TearDown() override { fs::remove_all(home_); }
  void program(const std::string& folder, const std::string& file, const std::string& text = "\n") {
    fs::create_directories(home_ / folder);
    std::ofstream(home_ / folder / file) << text;
  }
  std::string find(const std::string& name) {
    problems_.clear();
    const std::string found = twin::find_firmware(name, (home_ / "worlds").string(), problems_);
    return found.empty() ? "" : fs::path(found).lexically_normal().lexically_relative(home_).string();
  }
  fs::path home_;
  std::vector<std::string> problems_;
};

TEST_F(FindTest, a_project_of_webots_has_its_controllers_beside_its_worlds) {
  program("controllers/seek_it", "seek_it.py");
  EXPECT_EQ(find("seek_it"), "controllers/seek_it");
  program("worlds/controllers/seek_it", "seek_it.py");
  EXPECT_EQ(find("seek_it"), "worlds/controllers/seek_it");
  program("worlds/seek_it", "seek_it.c");
  EXPECT_EQ(find("seek_it"), "worlds/seek_it");  // beside the world goes before all
}

TEST_F(FindTest, a_folder_without_a_program_is_none) {
  program("controllers/empty_one", "notes.txt");
  EXPECT_EQ(find("empty_one"), "");
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_TRUE(
      wording::reads(problems_[0],
                     "empty_one: firmware: got a name that is neither a file nor a controller, expected an "
                     "image, a folder with C files, a program of the PC or a folder under firmware/"));
}

TEST_F(FindTest, a_controller_of_the_project_is_found_by_its_name) {
  program("controllers/braitenberg", "braitenberg.py");
  EXPECT_EQ(find("braitenberg"), "controllers/braitenberg");  // who makes a folder of the name has it run
  fs::remove_all(home_ / "controllers");
  EXPECT_NE(find("braitenberg").find("firmware/braitenberg"), std::string::npos);
}

}  // namespace
