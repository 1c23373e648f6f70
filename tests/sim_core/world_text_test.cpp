// SPDX-License-Identifier: MIT
// Editing a world file in place: what was not asked to change stays byte for byte.
#include "sim_core/load/world_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "twinpuck_paths.h"

namespace {

using sim::WorldText;

const char* const kWorld = R"(# two boxes
twinpuck = 1

# the first
[[box]]
position = [0.10,  0.20]  # metres
size = [0.1, 0.1, 0.1]

[[robot]]
name = "a"
position = [0, 0]
[robot.proximity]
noise_scale = 0

# the second
[[box]]
position = [
  -0.3, # x
  1     # y
]
)";

int id_of(const WorldText& text, const std::string& path, int n = 0) {
  for (const auto& e : text.elements())
    if (e.path == path && n-- == 0) return e.id;
  return 0;
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(WorldText, elements_are_tables_with_what_belongs_to_them) {
  const WorldText text(kWorld);
  ASSERT_EQ(text.elements().size(), 4u);
  EXPECT_EQ(text.elements()[0].path, "");
  EXPECT_EQ(text.elements()[1].path, "box");
  EXPECT_EQ(text.at_line(6)->id, id_of(text, "box"));
  EXPECT_EQ(text.at_line(13)->id, id_of(text, "robot"));  // [robot.proximity]
  EXPECT_EQ(text.at_line(19)->id, id_of(text, "box", 1));
}

TEST(WorldText, a_number_keeps_its_style_and_its_neighbours) {
  WorldText text(kWorld);
  ASSERT_TRUE(text.set(id_of(text, "box"), "position", "[0.1, 0.3]"));
  EXPECT_EQ(text.text(), changed(kWorld, "[0.10,  0.20]", "[0.10,  0.30]"));
}

TEST(WorldText, comments_within_a_list_stay) {
  WorldText text(kWorld);
  ASSERT_TRUE(text.set(id_of(text, "box", 1), "position", "[-0.35, 2]"));
  EXPECT_EQ(text.text(), changed(changed(kWorld, "-0.3,", "-0.35,"), "1     # y", "2     # y"));
}

TEST(WorldText, a_key_comes_and_goes) {
  WorldText text(kWorld);
  const int robot = id_of(text, "robot");
  ASSERT_TRUE(text.set(robot, "heading", "90"));
  EXPECT_EQ(text.text(), changed(kWorld, "position = [0, 0]\n", "position = [0, 0]\nheading = 90\n"));
  ASSERT_TRUE(text.set(robot, "heading", ""));
  EXPECT_EQ(text.text(), kWorld);
}

TEST(WorldText, an_element_goes_with_its_comment_and_its_tables) {
  WorldText text(kWorld);
  ASSERT_TRUE(text.remove(id_of(text, "robot")));
  EXPECT_EQ(
      text.text(),
      changed(kWorld, "[[robot]]\nname = \"a\"\nposition = [0, 0]\n[robot.proximity]\nnoise_scale = 0\n\n",
              ""));
  EXPECT_EQ(text.elements().size(), 3u);
}

TEST(WorldText, ids_outlive_edits) {
  WorldText text(kWorld);
  const int second = id_of(text, "box", 1);
  const int added = text.add("lamp", {{"position", "[0, 0, 1]"}});
  const int copied = text.copy(id_of(text, "box"));
  text.remove(id_of(text, "box"));
  ASSERT_TRUE(text.find(second));
  EXPECT_EQ(text.value(second, "position").substr(0, 1), "[");
  EXPECT_EQ(text.value(added, "position"), "[0, 0, 1]");
  EXPECT_EQ(text.value(copied, "size"), "[0.1, 0.1, 0.1]");
  EXPECT_EQ(text.find(copied)->path, "box");
}

TEST(WorldText, brackets_in_strings_and_lists_are_no_tables) {
  const WorldText text("twinpuck = 1\ntitle = \"[[box]] # not\"\n[[wall]]\npoints = [\n[0, 0],\n[1, 1]\n]\n");
  ASSERT_EQ(text.elements().size(), 2u);
  EXPECT_EQ(text.value(id_of(text, "wall"), "points"), "[\n[0, 0],\n[1, 1]\n]");
}

// every world of the project: removing what was copied, and setting what is there, changes nothing
TEST(WorldText, all_worlds_survive_edits_that_cancel_out) {
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TWINPUCK_SOURCE_DIR "/worlds")) {
    if (entry.path().extension() != ".toml") continue;
    std::stringstream all;
    all << std::ifstream(entry.path()).rdbuf();
    WorldText text(all.str());
    for (const auto& e : std::vector<WorldText::Element>(text.elements())) {
      if (!e.many) continue;
      const int copied = text.copy(e.id);
      ASSERT_GT(copied, 0);
      text.set(e.id, "position", text.value(e.id, "position"));
      text.remove(copied);
    }
    ++worlds;
    std::string now = text.text(), was = all.str();
    // a copy at the end of the file leaves the blank line above it
    while (!now.empty() && now.back() == '\n') now.pop_back();
    while (!was.empty() && was.back() == '\n') was.pop_back();
    EXPECT_EQ(now, was) << entry.path();
  }
  EXPECT_GT(worlds, 30);
}

}  // namespace
