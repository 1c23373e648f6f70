// SPDX-License-Identifier: MIT
// --hal sim|dspic: what build says and leaves, what a given image is taken for, what is refused.
#include <nlohmann/json.hpp>

#include "hal_sim/api/host_table.h"
#include "tests/cli/command.h"

namespace {

using cli_test::Said;
using cli_test::twinpuck;
using nlohmann::json;

class Hal : public cli_test::CommandTest {
 protected:
  Hal() { write("prog/main.c", kMotors); }
  Said build(const std::string& program, const std::string& options) const {
    return twinpuck("build " + path(program) + " " + options);
  }
  /// What a run's summary says of its robot.
  json robot(const std::string& options) const {
    twinpuck("run maze --for 0.001 --summary " + path("s.json") + " " + options);
    return json::parse(read(path("s.json")))["robots"][0];
  }

  static constexpr const char* kMotors =
      "#include <p30F6014A.h>\n#include <motor_led/advance_one_timer/e_motors.h>\n"
      "#include <motor_led/advance_one_timer/e_agenda.h>\n"
      "int main(void) {\n  e_init_motors();\n  e_set_speed_left(100);\n  for (;;) ;\n}\n";
};

TEST_F(Hal, given_image_says_what_it_was_linked_with) {
  build("prog", "--hal sim -o " + path("sim.elf"));
  build("prog", "--hal dspic -o " + path("dspic.elf"));
  EXPECT_EQ(robot("--fw " + path("sim.elf"))["hal"], "sim");
  EXPECT_EQ(robot("--fw " + path("dspic.elf"))["hal"], "dspic");
  EXPECT_EQ(robot("--fw " + path("dspic.elf") + " --hal sim")["hal"], "dspic");
  EXPECT_EQ(robot("--fw " + path("dspic.hex"))["hal"], "own");
  EXPECT_EQ(robot("--fw " + path("prog") + " --hal dspic")["hal"], "dspic");
}

TEST_F(Hal, worlds_say_it_robot_by_robot) {
  const std::string arena = "twinpuck = 1\n[arena]\nsize = [1, 1]\n";
  const auto world = [&](const std::string& keys) {
    return write("w.toml",
                 arena + "[[robot]]\nname = \"a\"\nfirmware = \"prog\"\nposition = [0, 0]\n" + keys);
  };
  const auto hal = [&](const std::string& keys, const std::string& options = "") {
    const Said said =
        twinpuck("run " + world(keys) + " --for 0.001 --summary " + path("s.json") + " " + options);
    return json::parse(read(path("s.json")))["robots"][0]["hal"];
  };
  EXPECT_EQ(hal("hal = \"dspic\"\n"), "dspic");
  EXPECT_EQ(hal("hal = \"sim\"\n"), "sim");
  EXPECT_EQ(hal("hal = \"dspic\"\n", "--hal sim"), "sim");
  EXPECT_EQ(hal(""), "sim");
}

TEST_F(Hal, image_for_another_table_of_functions_is_refused) {
  build("prog", "--hal sim -o " + path("x.elf"));
  std::string bytes = read(path("x.elf"));
  const std::uint32_t sum = api::host_table_sum();
  std::string mark, other;
  for (int i = 0; i < 4; ++i) mark += char(sum >> 8 * i), other += char((sum + 1) >> 8 * i);
  const std::size_t at = bytes.find(mark);
  ASSERT_NE(at, std::string::npos);
  write("old.elf", bytes.replace(at, 4, other));
  const Said run = twinpuck("run maze --for 0.001 --fw " + path("old.elf"));
  EXPECT_EQ(run.exit_code, 2) << run.text;
  EXPECT_TRUE(reads(run.text,
                    "@/old.elf: image: got one linked with another hal_sim, expected one of this twinpuck; "
                    "build it again"));
}

}  // namespace
