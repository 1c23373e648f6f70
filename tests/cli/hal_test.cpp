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
  Hal() {
    write("prog/main.c", kMotors);
    std::string owner = kMotors;
    write("owner/main.c", owner.replace(owner.find("  for"), 0, "  T2CON = 0;\n"));
  }
  Said build(const std::string& program, const std::string& options) const {
    return twinpuck("build " + path(program) + " " + options);
  }
  /// What a run's summary says of its robot.
  json robot(const std::string& options) const {
    twinpuck("run maze --for 0.001 --summary " + path("s.json") + " " + options);
    return json::parse(read(path("s.json")))["robots"][0];
  }
  bool is_there(const std::string& name) const { return cli_test::fs::exists(path(name)); }

  static constexpr const char* kMotors =
      "#include <p30F6014A.h>\n#include <motor_led/advance_one_timer/e_motors.h>\n"
      "#include <motor_led/advance_one_timer/e_agenda.h>\n"
      "int main(void) {\n  e_init_motors();\n  e_set_speed_left(100);\n  for (;;) ;\n}\n";
};

TEST_F(Hal, image_is_an_elf_and_for_the_robot_a_hex_too) {
  const Said sim = build("prog", "--hal sim -o " + path("x.elf"));
  EXPECT_EQ(sim.exit_code, 0) << sim.text;
  for (const char* line : {"x.elf: 1 files compiled", "\nflash ", "\nRAM ", "\nstack "})
    EXPECT_NE(sim.text.find(line), std::string::npos) << line << sim.text;
  EXPECT_TRUE(is_there("x.elf") && is_there("x.lst") && is_there("x.map"));
  EXPECT_FALSE(is_there("x.hex"));
  const Said dspic = build("prog", "--hal dspic -o " + path("x.elf"));
  EXPECT_TRUE(is_there("x.hex"));
  // the robot's sizes, whoever fills the drivers
  EXPECT_EQ(sim.text.substr(sim.text.find('\n')), dspic.text.substr(dspic.text.find('\n')));
  EXPECT_NE(dspic.text.find("0 files compiled"), std::string::npos) << dspic.text;
  // files of one image go together
  build("prog", "--hal sim -o " + path("x.elf"));
  EXPECT_FALSE(is_there("x.hex"));
  EXPECT_EQ(build("prog", "--hal dspic -o " + path("y.elf")).exit_code, 0);
  EXPECT_TRUE(is_there("y.hex"));
}

TEST_F(Hal, driver_that_is_not_filled_is_told_by_build_and_run) {
  const std::string told = "agenda: the chip's own driver, since " + path("owner/main.c") + ":7 uses T2CON\n";
  for (int again = 0; again < 2; ++again) {
    const Said built = build("owner", "--hal sim -o " + path("x.elf"));
    EXPECT_EQ(built.exit_code, 0) << built.text;
    EXPECT_NE(built.text.find(told), std::string::npos) << built.text;
    const Said run = twinpuck("run maze --for 0.001 --hal sim --fw " + path("owner"));
    EXPECT_NE(run.text.find(told), std::string::npos) << run.text;
  }
  EXPECT_EQ(build("owner", "--hal dspic -o " + path("x.elf")).text.find("agenda:"), std::string::npos);
  EXPECT_EQ(build("prog", "--hal sim -o " + path("x.elf")).text.find("agenda:"), std::string::npos);
}

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

TEST_F(Hal, image_of_the_simulator_is_refused_for_the_robot) {
  build("prog", "--hal sim -o " + path("x.elf"));
  const Said flash = twinpuck("flash " + path("x.elf") + " --port /dev/null");
  EXPECT_EQ(flash.exit_code, 2) << flash.text;
  EXPECT_NE(flash.text.find(path("x.elf") + ": image: got one linked with hal_sim"), std::string::npos)
      << flash.text;
  EXPECT_NE(flash.text.find("`twinpuck build DIR --hal dspic -o x.elf` makes it"), std::string::npos)
      << flash.text;
  const Said run = twinpuck("run maze --for 0.001 --hal dspic --fw " + path("x.elf"));
  EXPECT_EQ(run.exit_code, 2) << run.text;
  EXPECT_NE(
      run.text.find("hal: got dspic, but " + path("x.elf") + " was linked with hal_sim, expected an image"),
      std::string::npos)
      << run.text;
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
  EXPECT_NE(
      run.text.find("old.elf: image: got one linked with another hal_sim, expected one of this twinpuck"),
      std::string::npos)
      << run.text;
}

TEST_F(Hal, limits_of_the_chip_are_the_builds) {
  write("large/main.c", "char big[9000];\nint main(void) { return big[1]; }\n");
  const Said said = build("large", "--hal sim -o " + path("x.elf"));
  EXPECT_EQ(said.exit_code, 1) << said.text;
  EXPECT_NE(said.text.find("RAM: no room for big, 9000 bytes"), std::string::npos) << said.text;
  EXPECT_FALSE(is_there("x.elf"));
}

}  // namespace
