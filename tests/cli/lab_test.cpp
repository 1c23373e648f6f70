// SPDX-License-Identifier: MIT
// twinpuck lab: one line an exercise, the same however many processes, and honest about what fails.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Lab : public CommandTest {
 protected:
  /// A table of one exercise about the robot of worlds/wall.toml, which runs nothing and stays where it is.
  std::string table(const std::string& bounds) const {
    return write(
        "lab.toml",
        "[[exercise]]\nid = \"X1\"\ntitle = \"stand\"\n[[exercise.step]]\nworlds = [\"wall\"]\nseconds = "
        "7\nseeds = [2, 3]\nsays = \"stand\"\n" +
            bounds);
  }
};

TEST_F(Lab, every_exercise_of_the_lab_has_a_line_and_passes) {
  const Said s = twinpuck("lab --seeds 3 --no-times --jobs 2");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  std::istringstream lines(s.text);
  std::vector<std::string> ids;
  for (std::string line; std::getline(lines, line);) ids.push_back(line.substr(0, line.find(' ')));
  for (const char* id : {"e-puck", "I1", "S2", "I3", "S4", "S5", "Q6", "Q7", "I8", "Q9", "S10", "S11", "S12",
                         "I13", "S14", "S15", "S16", "Q17"})
    EXPECT_NE(std::find(ids.begin(), ids.end(), id), ids.end()) << id;
}

TEST_F(Lab, the_number_of_processes_changes_nothing) {
  const Said one = twinpuck("lab I3 S15 --seeds 3 --no-times --csv " + path("1.csv"));
  const Said three = twinpuck("lab I3 S15 --seeds 3 --no-times --jobs 3 --csv " + path("3.csv"));
  EXPECT_EQ(one.exit_code, 0) << one.text;
  EXPECT_EQ(one.text, three.text);
  // rows agree but for the speed, which is the PC's: column 14 of 20
  const auto rows = [&](const std::string& file) {
    std::istringstream in(read(path(file)));
    std::string all;
    for (std::string line; std::getline(in, line);) {
      std::istringstream cells(line);
      std::string cell;
      for (int k = 0; std::getline(cells, cell, ','); ++k)
        if (k != 13) all += cell + ",";
      all += "\n";
    }
    return all;
  };
  EXPECT_EQ(rows("1.csv"), rows("3.csv"));
  EXPECT_NE(read(path("1.csv")).find("I3,u_obstacle,u_obstacle,,3,1,"), std::string::npos);
}

TEST_F(Lab, a_bound_that_is_not_kept_fails_with_exit_code_1) {
  const Said good = twinpuck("lab --table " + table("at_least = { standstill_s = 6.9 }\n"));
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_NE(good.text.find("X1     pass  stand: 2 of 2 stand"), std::string::npos) << good.text;
  const Said bad = twinpuck("lab --full --table " + table("at_most = { standstill_s = 6.9 }\n"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.text.find("X1     FAIL  stand: 0 of 3 stand"), std::string::npos) << bad.text;
}

TEST_F(Lab, mistakes_are_named_with_their_place) {
  EXPECT_NE(twinpuck("lab I2").text.find("got 'I2', expected one of e-puck I1 S2 I3"), std::string::npos);
  EXPECT_EQ(twinpuck("lab I2").exit_code, 2);
  const Said key = twinpuck("lab --table " + table("at_mots = { standstill_s = 1 }\n"));
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_NE(key.text.find("lab.toml:9:"), std::string::npos) << key.text;
  EXPECT_NE(key.text.find("unknown key 'at_mots'; did you mean 'at_most'?"), std::string::npos) << key.text;
  EXPECT_NE(twinpuck("lab --table " + table("at_most = { standstil_s = 1 }\n"))
                .text.find("did you mean 'standstill_s'?"),
            std::string::npos);
  EXPECT_NE(twinpuck("lab --table " + write("no.toml", "[[exercise]\n")).text.find("no.toml:1:"),
            std::string::npos);
  const Said world = twinpuck("lab --table " + write("w.toml",
                                                     "[[exercise]]\nid = \"X\"\n[[exercise.step]]\nworlds = "
                                                     "[\"nowhere\"]\n"));
  EXPECT_EQ(world.exit_code, 1);
  EXPECT_NE(world.text.find("nowhere.toml: cannot be read"), std::string::npos) << world.text;
  EXPECT_EQ(twinpuck("lab Q6 --plot " + path("p.png")).exit_code, 7);
}

TEST_F(Lab, the_share_against_noise_is_drawn) {
  EXPECT_EQ(twinpuck("lab S15 --seeds 1 --plot " + path("p.png")).exit_code, 0);
  EXPECT_EQ(read(path("p.png")).substr(1, 3), "PNG");
  EXPECT_EQ(twinpuck("lab S15 --seeds 1 --plot /nonexistent/p.png").exit_code, 7);
}

}  // namespace
