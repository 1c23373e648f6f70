// SPDX-License-Identifier: MIT
// Faults through the command: files and lines, what is told at the end, exit codes, lists.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

namespace {

using namespace cli_test;

class FaultsOfARun : public CommandTest {
 protected:
  static Said run(const std::string& more) { return twinpuck("run maze --fw obstacle --for 3 " + more); }
};

TEST_F(FaultsOfARun, those_that_took_effect_are_in_the_summary) {
  const std::string file =
      write("f.toml",
            "[[fault]]\nkind = \"sensor_blocked\"\nrobot = \"puck\"\nsensor = 0\nat_s = 1\nfor_s = "
            "0.5\n[[stimulus]]\nturn = 3\nwhen = \"distance_m > 0.05\"\n");
  const Said said =
      run("--faults " + file + " --fault 'wheel_slip share=0.2 at=500ms' --summary " + path("s.json"));
  EXPECT_EQ(said.exit_code, 0) << said.text;
  EXPECT_NE(said.text.find("sensor_blocked sensor=0 of puck: from 1.000 s, took effect at 1.0"),
            std::string::npos)
      << said.text;
  const auto faults = nlohmann::json::parse(read(path("s.json"))).at("faults");
  ASSERT_EQ(faults.size(), 3u);
  EXPECT_EQ(faults[0].at("kind"), "sensor_blocked");
  EXPECT_EQ(faults[0].at("robot"), "puck");
  EXPECT_EQ(faults[0].at("where"), file + ":1:1");
  EXPECT_EQ(faults[0].at("begun_s"), 1.0);
  EXPECT_EQ(faults[0].at("ended_s"), 1.5);
  EXPECT_EQ(faults[2].at("begun_s"), 0.5);
  EXPECT_TRUE(faults[2].at("ended_s").is_null());
}

TEST_F(FaultsOfARun, one_that_never_began_is_in_the_summary_of_the_invalid_run) {
  const Said unheld = run("-q --fault \"bump when='x_m > 50'\" --summary " + path("s.json"));
  EXPECT_EQ(unheld.exit_code, 7);
  EXPECT_TRUE(nlohmann::json::parse(read(path("s.json"))).at("faults")[0].at("begun_s").is_null());
}

TEST_F(FaultsOfARun, the_same_with_any_number_of_threads) {
  const auto digest = [&](const std::string& more) {
    run("-q --fault 'steps_lost share=0.3 at=1s' --fault 'bump at=2s' --summary " + path("s.json") + " " +
        more);
    return nlohmann::json::parse(read(path("s.json"))).at("digest").get<std::string>();
  };
  const std::string one = digest("--threads 1");
  EXPECT_EQ(one, digest("--threads 4"));
  EXPECT_NE(one, digest("--seed 9"));
}

TEST_F(FaultsOfARun, without_any_the_summary_has_no_list) {
  EXPECT_EQ(run("-q --summary " + path("s.json")).exit_code, 0);
  EXPECT_FALSE(nlohmann::json::parse(read(path("s.json"))).contains("faults"));
}

}  // namespace
