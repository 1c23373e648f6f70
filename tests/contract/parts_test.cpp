// SPDX-License-Identifier: MIT
// The parts of the contract: every program of parts/ with both HALs in every way to run it, against the text
// beside it. (tests/python/test_parts.py has the ways of Python, the command and the view.) A line of the text: name, value, tolerance, why. The world: a white wall 40 mm
// before the robot's rim, no noise of light; selector 5.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;
const fs::path kParts = fs::path(TWINPUCK_SOURCE_DIR) / "tests/contract/parts";

struct Line {
  std::string name;
  long value = 0, tolerance = 0;
};

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lines "name value [tolerance ...]"; others, as the robot's greeting, are left out.
std::vector<Line> lines_of(const std::string& text) {
  std::vector<Line> lines;
  std::istringstream in(text);
  for (std::string row; std::getline(in, row);) {
    std::istringstream words(row);
    Line line;
    if (row.empty() || row[0] == '#' || !(words >> line.name >> line.value)) continue;
    words >> line.tolerance;
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> parts() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kParts))
    if (entry.path().extension() == ".c") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Parts : public firmware_test::FirmwareTest,
              public ::testing::WithParamInterface<std::tuple<std::string, std::string, std::string>> {
 protected:
  ~Parts() override { unsetenv("TWINPUCK_INTERPRET"); }
  void choose(const std::string& way, firmware_test::Robot& robot) {
    if (way == "interpreted") setenv("TWINPUCK_INTERPRET", "1", 1);
    if (way == "sanitized") options.sanitize = true;
    if (way == "measured") robot.measured();
    if (way == "supervised")
      add_supervisor_with_source(
          "#include <webots/robot.h>\nint main(void) { wb_robot_init(); while (wb_robot_step(32) != -1) "
          "continue; "
          "wb_robot_cleanup(); return 0; }\n",
          "c");
  }
};
const std::vector<std::string> kWays = {"run", "interpreted", "sanitized", "measured", "supervised"};

TEST_P(Parts, says_what_is_expected) {
  const auto& [part, hal, way] = GetParam();
  options.hal = hal;
  wall(0.0775, -0.5, 0.0775, 0.5);
  std::string source = text_of(kParts / (part + ".c"));
  const std::string include = "#include \"say.h\"\n";
  const std::size_t at = source.find(include);
  ASSERT_NE(at, std::string::npos);
  source.replace(at, include.size(), text_of(kParts / "say.h"));
  auto& robot = add_robot_with_source(source).selector(5);
  choose(way, robot);
  world.proximity.noise_scale = 0;
  const auto ended = [&] { return robot.uart(1).text().find("end\n") != std::string::npos; };
  EXPECT_TRUE(run_until(ended, 10)) << robot.uart(1).text();
  const auto expected = lines_of(text_of(kParts / (part + ".txt")));
  const auto said = lines_of(robot.uart(1).text());
  ASSERT_FALSE(expected.empty());
  ASSERT_EQ(said.size(), expected.size()) << robot.uart(1).text();
  for (std::size_t i = 0; i < said.size(); ++i) {
    EXPECT_EQ(said[i].name, expected[i].name);
    EXPECT_LE(std::labs(said[i].value - expected[i].value), expected[i].tolerance)
        << said[i].name << ": got " << said[i].value << ", expected " << expected[i].value;
  }
  expect_no_traps();
}

INSTANTIATE_TEST_SUITE_P(Contract, Parts,
                         ::testing::Combine(::testing::ValuesIn(parts()),
                                            ::testing::Values(std::string("sim"), std::string("dspic")),
                                            ::testing::ValuesIn(kWays)),
                         [](const auto& p) {
                           return std::get<0>(p.param) + "_" + std::get<1>(p.param) + "_" +
                                  std::get<2>(p.param);
                         });

}  // namespace
