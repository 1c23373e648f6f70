// SPDX-License-Identifier: MIT
// [[robot.part]]: kinds come from the caller, their keys are checked like all others. An invented kind stands
// for real ones: sim_core knows none.
#include <gtest/gtest.h>

#include "sim_core/load/world_loader.h"

namespace {

const std::vector<sim::PartKind> kKinds{
    {"antenna",
     "It hums.",
     {{"length", sim::OwnKeyType::Number, "m", 0.01, 0.5, "", "0.1", "how long"},
      {"mood", sim::OwnKeyType::Choice, "", 0, 0, "calm|wild", "\"calm\"", "how it hums"},
      {"tips", sim::OwnKeyType::Integer, "", 1, 9, "", "required", "how many"},
      {"at", sim::OwnKeyType::Pair, "m", -1, 1, "", "[0, 0]", "where"}}},
    {"wheelbarrow", "It rolls.", {}}};

sim::LoadedWorld read(const std::string& part) {
  sim::RobotModel model;
  model.name = "cart";
  return sim::parse_world("twinpuck = 1\n[[robot]]\n[[robot.part]]\n" + part, "w.toml", {model}, kKinds);
}

TEST(PartKeys, values_arrive_under_their_names) {
  const auto loaded = read(
      "kind = \"antenna\"\nlength = 0.25\ntips = 3\nat = [0.01, -0.02]\n[[robot.part]]\nkind = "
      "\"wheelbarrow\"\n");
  ASSERT_TRUE(loaded.world) << loaded.report("w");
  const auto& parts = loaded.world->robots[0].parts;
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].kind, "antenna");
  EXPECT_EQ(parts[0].values.at("length").numbers, std::vector<double>{0.25});
  EXPECT_EQ(parts[0].values.at("tips").numbers, std::vector<double>{3});
  EXPECT_EQ(parts[0].values.at("at").numbers, (std::vector<double>{0.01, -0.02}));
  EXPECT_EQ(parts[0].values.count("mood"), 0u);  // not written: the part takes its default
  EXPECT_EQ(parts[1].kind, "wheelbarrow");
}

TEST(PartKeys, a_kind_that_nobody_knows_is_refused_with_a_guess) {
  EXPECT_EQ(read("kind = \"antena\"\n").report("w"),
            "w:4:8: robot.part.kind: got \"antena\", expected one of antenna, wheelbarrow; did you mean "
            "'antenna'?");
  EXPECT_EQ(read("length = 1\n").report("w"),
            "w:3:1: robot.part.kind: missing, expected one of antenna, wheelbarrow");
  EXPECT_EQ(read("kind = 7\n").report("w"),
            "w:4:8: robot.part.kind: got 7, expected one of antenna, wheelbarrow");
}

TEST(PartKeys, keys_are_checked_as_everywhere) {
  EXPECT_EQ(read("kind = \"antenna\"\ntips = 3\nlenght = 0.2\n").report("w"),
            "w:6:1: unknown key 'lenght' in robot.part; did you mean 'length'? (keys: kind, length, mood, "
            "tips, at)");
  EXPECT_EQ(read("kind = \"antenna\"\ntips = 3\nlength = 2\n").report("w"),
            "w:6:10: robot.part.length: got 2, expected number from 0.01 to 0.5 m");
  EXPECT_EQ(read("kind = \"antenna\"\ntips = 3\nmood = \"mild\"\n").report("w"),
            "w:6:8: robot.part.mood: got \"mild\", expected one of calm, wild; did you mean 'wild'?");
  EXPECT_EQ(read("kind = \"antenna\"\n").report("w"),
            "w:3:1: robot.part.tips: missing, expected whole number from 1 to 9");
  // another kind's key
  EXPECT_NE(
      read("kind = \"wheelbarrow\"\nlength = 0.2\n").report("w").find("unknown key 'length' in robot.part"),
      std::string::npos);
}

TEST(PartKeys, a_single_bracket_is_named) {
  sim::RobotModel model;
  model.name = "cart";
  const auto loaded = sim::parse_world("twinpuck = 1\n[[robot]]\n[robot.part]\nkind = \"antenna\"\n",
                                       "w.toml", {model}, kKinds);
  EXPECT_EQ(loaded.report("w"),
            "w:3:1: robot.part: got a table, expected [[robot.part]] with double brackets");
}

}  // namespace
