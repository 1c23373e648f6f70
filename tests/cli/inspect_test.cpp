// SPDX-License-Identifier: MIT
// twinpuck inspect: what it says of a reading, its curves, its pictures, and what it says of bad input.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class Inspect : public CommandTest {
 protected:
  /// ps5 (straight to the left, 31 mm from the middle) looks at a wall `gap_mm` away; its red is 0.5.
  std::string side_wall(double gap_mm, const std::string& more = "") const {
    return write("side.toml",
                 "twinpuck = 1\n[world]\nambient = 0.5\n[proximity]\nprofile = \"webots-old\"\n" + more +
                     "\n[[lamp]]\nname = \"bulb\"\nposition = [0, 1.031, 0.033]\nintensity = 2\n"
                     "[[box]]\nname = \"red wall\"\nposition = [0, " +
                     std::to_string(0.031 + gap_mm / 1000 + 0.01) +
                     "]\nsize = [0.5, 0.02, 0.1]\ncolour = [0.5, 0, 0]\n"
                     "[[robot]]\nname = \"puck\"\nfirmware = \"obstacle\"\n"
                     "[robot.variation]\nsensor_gain = [1, 1, 1, 1, 1, 1.5, 1, 1]\n"
                     "sensor_offset = [0, 0, 0, 0, 0, 7, 0, 0]\n");
  }
};

TEST_F(Inspect, a_reading_from_the_wall_to_the_counts) {
  // 12 mm / 0.6 = 20 mm: 676 counts, x 1.5 + 7 = 1021; ambient 0.5 W/m2 takes 200 counts, the lamp is shaded
  const Said s = twinpuck("inspect " + side_wall(12) + " --robot puck --sensor 5 --json");
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const json j = json::parse(s.text);
  EXPECT_EQ(j["rays"][0]["what"], "box 'red wall'");
  EXPECT_NEAR(j["rays"][0]["factor"].get<double>(), 0.6, 1e-9);
  EXPECT_NEAR(j["apparent_distance_m"].get<double>(), 0.02, 1e-6);
  EXPECT_NEAR(j["value_counts"].get<double>(), 676, 0.05);
  EXPECT_EQ(j["dark"]["counts"], 4095 - 200);
  EXPECT_EQ(j["lit"]["counts"], 4095 - 200 - 1021);
  EXPECT_EQ(j["prox_counts"], 1021);
  EXPECT_NEAR(j["dark"]["volts"].get<double>(), 3.3 * 3895 / 4095, 1e-6);
  EXPECT_EQ(j["light"]["lamps"][0]["blocked_by"], "box 'red wall'");
  // gaussian: 10.5 % of 676 * 1.5
  EXPECT_NEAR(j["noise"]["counts"].get<double>(), 0.105 * 676 * 1.5, 0.2);
  EXPECT_FALSE(j.contains("held"));  // no program has run yet
}

TEST_F(Inspect, without_a_wall_the_lamp_pulls_the_dark_sample_down) {
  // straight before ps5 at 1 m, 2 W/m2, unattenuated: 800 counts, and 200 of the ambient light
  const std::string world =
      write("lamp.toml",
            "twinpuck = 1\n[world]\nambient = 0.5\n[[lamp]]\nposition = [0, 1.031, 0.033]\n"
            "intensity = 2\n[[robot]]\n");
  const json lit = json::parse(twinpuck("inspect " + world + " --sensor 5 --json").text);
  EXPECT_EQ(lit["dark"]["counts"], 4095 - 800 - 200);
  const json away = json::parse(twinpuck("inspect " + world + " --sensor 2 --json").text);
  EXPECT_EQ(away["dark"]["counts"], 4095 - 200);
  // no light at all: dark is 4095; far too much: 0, and nothing is left for the reflection
  const std::string night = write("night.toml", "twinpuck = 1\n[[robot]]\n");
  EXPECT_EQ(json::parse(twinpuck("inspect " + night + " --sensor 0 --json").text)["dark"]["counts"], 4095);
  const std::string noon = write("noon.toml", "twinpuck = 1\n[world]\nambient = 50\n[[robot]]\n");
  const json sun = json::parse(twinpuck("inspect " + noon + " --sensor 0 --json").text);
  EXPECT_EQ(sun["dark"]["counts"], 0);
  EXPECT_EQ(sun["prox_counts"], 0);
}

TEST_F(Inspect, a_running_program_holds_what_it_will_read) {
  write("still/main.c",
        "#include <a_d/advance_ad_scan/e_ad_conv.h>\n#include <motor_led/e_init_port.h>\n"
        "int main(void) {\n  e_init_port();\n  e_init_ad_scan(ALL_ADC);\n  while (1);\n}\n");
  const std::string moving = side_wall(12, "noise_scale = 0");
  std::string text = read(moving);
  text.replace(text.find("\"obstacle\""), 10, "\"still\"");
  const Said s = twinpuck("inspect " + write("still.toml", text) + " --sensor 5 --at 0.4 --json");
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const json j = json::parse(s.text);
  ASSERT_TRUE(j.contains("held")) << s.text;
  EXPECT_EQ(j["at_s"].get<double>(), 0.400390625);  // the first tick of 1/512 s from then on
  EXPECT_EQ(j["held"]["prox"], 1021);               // a robot that stands, and no noise: what is explained
  EXPECT_EQ(j["prox_counts"], 1021);
  EXPECT_EQ(j["held"]["dark"], 4095 - 200);
}

TEST_F(Inspect, all_sensors_in_one_table) {
  EXPECT_EQ(json::parse(twinpuck("inspect " + side_wall(12) + " --json").text).size(), 8u);
}

TEST_F(Inspect, curves_of_profiles) {
  const Said s = twinpuck("inspect --profile webots-old --json --plot " + path("c.png"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const json j = json::parse(s.text)[0];
  EXPECT_EQ(j["rows"], 9);  // lab S12
  EXPECT_EQ(j["range_m"], 0.07);
  EXPECT_EQ(j["points"].size(), 9u);
  EXPECT_NEAR(j["points"][3]["counts"].get<double>(), 676, 1e-9);
  EXPECT_NEAR(j["points"][3]["noise_counts"].get<double>(), 676 * 0.105, 1e-9);
  EXPECT_EQ(read(path("c.png")).substr(1, 3), "PNG");
  // lab S4: before black walls the range of 70 mm shrinks to 14
  const json black = json::parse(twinpuck("inspect --profile webots-old --colour 0,0,0 --json").text)[0];
  EXPECT_NEAR(black["seen_until_m"].get<double>(), 0.014, 0.0005);
}

}  // namespace
