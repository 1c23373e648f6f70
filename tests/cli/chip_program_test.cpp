// SPDX-License-Identifier: MIT
// twinpuck asm and dis, and a run of what they made: docs/chip-core.md's sample blinks.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

constexpr const char* kBlink = R"(
__reset: mov #__SP_init, w15
    bclr TRISA, #6
1:  btg LATA, #6
    repeat #16383
    nop
    bra 1b
)";

class ChipProgram : public CommandTest {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    const std::string at = (folder / name).string();
    std::ofstream(at) << text;
    return at;
  }
};

TEST_F(ChipProgram, text_becomes_a_program_that_is_shown_and_runs) {
  const std::string source = file("blink.s", kBlink), hex = (folder / "blink.hex").string();
  const auto made = twinpuck("asm '" + source + "' -o '" + hex + "'");
  ASSERT_EQ(made.exit_code, 0) << made.text;
  const auto shown = twinpuck("dis '" + hex + "'");
  EXPECT_EQ(shown.exit_code, 0);
  for (const char* part : {"000000  040100  goto 0x000100\n000002  000000\n", "mov #0x800, w15",
                           "bclr.b 0x02c0, #6", "btg.b 0x02c4, #6", "repeat #0x3fff", "bra 0x000104"})
    EXPECT_NE(shown.text.find(part), std::string::npos) << part << " in:\n" << shown.text;
  const std::string summary = (folder / "run.json").string();
  const auto run = twinpuck("run maze --fw '*=" + hex + "' --for 0.1 --summary '" + summary + "'");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  std::ifstream in(summary);
  const std::string json((std::istreambuf_iterator<char>(in)), {});
  EXPECT_NE(json.find("\"way\": \"chip\""), std::string::npos) << json;
}

TEST_F(ChipProgram, controllers_source_becomes_an_image_and_drives) {
  const std::string elf = (folder / "obstacle.elf").string();
  const auto built = twinpuck("build obstacle --way chip -o '" + elf + "'");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  EXPECT_NE(built.text.find("of 49152 words"), std::string::npos) << built.text;
  for (const char* kind : {"elf", "hex", "lst", "map"})
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("obstacle.") + kind))) << kind;
  const auto shown = twinpuck("dis '" + elf + "'");
  EXPECT_NE(shown.text.find("\nmain:\n"), std::string::npos);
  EXPECT_NE(shown.text.find("firmware/lab/obstacle/main.c:"), std::string::npos) << "lines are named";
  // the image and the source give the same run, to the last bit
  const auto digest = [](const std::string& text) { return text.substr(text.find("digest "), 23); };
  const auto of_image = twinpuck("run maze --fw '*=" + elf + "' --for 2");
  const auto of_source = twinpuck("run maze --fw '*=obstacle' --way chip --for 2");
  ASSERT_EQ(of_image.exit_code, 0) << of_image.text;
  EXPECT_EQ(digest(of_image.text), digest(of_source.text));
  EXPECT_NE(of_image.text.find(" 0.1"), std::string::npos) << "it drives some 0.1 m: " << of_image.text;
}

TEST_F(ChipProgram, mistakes_are_named_with_file_and_line) {
  const std::string source = file("wrong.s", "start:\n  mov #1, w16\n  bra nowhere\n");
  const auto said = twinpuck("asm '" + source + "' -o '" + (folder / "x.hex").string() + "'");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_NE(said.text.find("wrong.s:2: mov: operands '#1, w16' fit none of"), std::string::npos) << said.text;
  EXPECT_EQ(twinpuck("dis '" + source + "'").exit_code, 2);
  EXPECT_EQ(twinpuck("dis /nonexistent.hex").exit_code, 2);
}

TEST_F(ChipProgram, every_controller_becomes_an_image_that_drives_as_natively) {
  namespace fs = std::filesystem;
  int controllers = 0;
  for (const auto& entry : fs::directory_iterator(TWINPUCK_SOURCE_DIR "/firmware")) {
    if (!fs::exists(entry.path() / "main.c")) continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    ++controllers;
    double x[2] = {}, y[2] = {}, heading[2] = {};
    for (int way = 0; way < 2; ++way) {
      const std::string summary = (folder / "run.json").string();
      const auto run = twinpuck("run maze --fw '*=" + name + "' --way " + (way ? "chip" : "native") +
                                " --for 2 --summary '" + summary + "'");
      ASSERT_EQ(run.exit_code, 0) << run.text;
      std::ifstream in(summary);
      const auto robot = nlohmann::json::parse(in)["robots"][0];
      x[way] = robot["x_m"];
      y[way] = robot["y_m"];
      heading[way] = robot["heading_rad"];
    }
    // a sample of the infrared sensors taken beside another decides the turn of `braitenberg`: 4 mm
    EXPECT_NEAR(x[0], x[1], 0.005);
    EXPECT_NEAR(y[0], y[1], 0.005);
    EXPECT_NEAR(heading[0], heading[1], 0.07);
  }
  EXPECT_GE(controllers, 19);
}

}  // namespace
