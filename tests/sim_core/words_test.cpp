// SPDX-License-Identifier: MIT
// Words that messages guess, and candidates that a grid gives.
#include <gtest/gtest.h>

#include "sim_core/base/did_you_mean.h"
#include "sim_core/base/utf8.h"
#include "sim_core/geometry/neighbours.h"
#include "sim_core/world/layout.h"
#include "tests/sim_core/fixture.h"

namespace {

TEST(DidYouMean, a_third_of_the_letters_may_be_wrong_and_one_of_the_shortest) {
  const std::vector<std::string> words = {"wall",    "ball", "robot",
                                          "heading", "to",   std::string(40, 'x') + "y"};
  const struct {
    std::string word, guess;
  } rows[] = {{"wall", "wall"},
              {"walk", "wall"},
              {"wlal", "wall"},
              {"wa", ""},
              {"bal", "ball"},
              {"walls", "wall"},
              {"t", "to"},
              {"q", ""},
              {"hedding", "heading"},
              {"haedign", "heading"},
              {"hxadxxg", ""},
              {"robtoo", "robot"},
              {"ro", "to"},
              {std::string(40, 'x'), words.back()},
              {std::string(41, 'x'), ""},
              {words.back(), ""}};
  for (const auto& row : rows) EXPECT_EQ(sim::did_you_mean(row.word, words), row.guess) << row.word;
  EXPECT_EQ(sim::did_you_mean_tail("walk", words), "; did you mean 'wall'?");
  EXPECT_EQ(sim::did_you_mean_tail("zzzzzz", words), "");
  EXPECT_EQ(sim::did_you_mean("wall", {}), "");
}

// walls through many cells, listed out of order by the rows of the grid
TEST(Neighbours, what_is_near_a_point_is_gathered_once_and_in_order) {
  const auto world = sim_test::world_of(
      "twinpuck = 1\n[[box]]\nposition = [0, 0.3]\nsize = [2, 0.05, 0.1]\n[[box]]\nposition = [0, -0.3]\n"
      "size = [2, 0.05, 0.1]\n[[box]]\nposition = [0.35, 0]\nsize = [0.05, 2, 0.1]\n"
      "[[box]]\nposition = [0.9, 0.9]\nsize = [0.02, 0.02, 0.1]\n");
  const sim::Layout layout = sim::build_layout(world);
  sim::Neighbours neighbours(layout.fixed, {}, 0, {});
  neighbours.rebuild({}, 0, 0, 0);
  const struct {
    sim::Vec2 at;
    double radius_m;
    std::vector<int> found;
  } rows[] = {{{0, 0}, 0.5, {0, 1, 2}},
              {{0.35, 0}, 0.05, {2}},
              {{0.9, 0.9}, 0.05, {3}},
              {{-0.9, 0.3}, 0.05, {0}},
              {{0.5, 0.5}, 0.7, {0, 2, 3}}};
  for (const auto& row : rows) {
    std::vector<sim::Candidate> got;
    neighbours.gather(row.at, row.radius_m, got);
    std::vector<int> indices;
    for (const auto& c : got) indices.push_back(c.index);
    for (const int index : row.found)
      EXPECT_EQ(std::count(indices.begin(), indices.end(), index), 1) << index << " at " << row.at.x;
    EXPECT_TRUE(std::is_sorted(indices.begin(), indices.end())) << row.at.x;
    EXPECT_EQ(std::adjacent_find(indices.begin(), indices.end()), indices.end()) << row.at.x;
  }
}

// every beginning: what RFC 3629 has of each length, and nothing else
TEST(Utf8, each_character_has_its_length) {
  int of_length[5] = {};
  const auto count = [&](std::initializer_list<int> bytes) {
    std::string text;
    for (const int b : bytes) text += static_cast<char>(b);
    const std::size_t length = sim::utf8_length(text, 0);
    ++of_length[length];
    // cut short it is none
    if (length > 1) {
      EXPECT_EQ(sim::utf8_length(text.substr(0, length - 1), 0), 0u);
    }
  };
  for (int first = 0; first < 0x80; ++first) count({first});
  EXPECT_EQ(of_length[1], 0x80);
  for (int first = 0x80; first < 0xE0; ++first)
    for (int second = 0; second < 256; ++second) count({first, second});
  EXPECT_EQ(of_length[2], 0x800 - 0x80);
  for (int first = 0xE0; first < 0xF0; ++first)
    for (int second = 0; second < 256; ++second)
      for (int third = 0; third < 256; ++third) count({first, second, third});
  EXPECT_EQ(of_length[3], 0x10000 - 0x800 - 0x800);  // but for surrogates
  // the last two at the ends of what they may be
  for (int first = 0xF0; first < 0x100; ++first)
    for (int second = 0; second < 256; ++second)
      for (const int third : {0x7F, 0x80, 0xBF, 0xC0})
        for (const int fourth : {0x7F, 0x80, 0xBF, 0xC0}) count({first, second, third, fourth});
  EXPECT_EQ(of_length[4], (0x100000 >> 12) * 2 * 2);
  EXPECT_EQ(sim::utf8_length("", 0), 0u);
  EXPECT_EQ(sim::utf8_length("a\xC3\xA9", 1), 2u);
  EXPECT_EQ(sim::utf8_length("a\xC3\xA9", 2), 0u);
}

}  // namespace
