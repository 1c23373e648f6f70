// SPDX-License-Identifier: MIT
// The sources of the drivers for the chip: each compiles with 16-bit int and no warning, and the generated
// one is what its generator writes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/hal_dspic/sound_samples.h"
#include "tests/support/shell.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> sources() {
  std::vector<fs::path> found;
  for (const char* folder : {"/hal_dspic", "/firmware/library"})
    for (const auto& entry : fs::recursive_directory_iterator(std::string(TWINPUCK_SOURCE_DIR) + folder))
      if (entry.path().extension() == ".c") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// What twinpuck-cc says to one file of the library, warnings as strict as it has them.
std::string compile(const fs::path& source) {
  const std::string root = TWINPUCK_SOURCE_DIR, include = root + "/firmware/include";
  std::string line = std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc -O1 --library --strict -o /dev/null -I" +
                     root + "/hal_dspic -I" + root;
  for (const char* folder :
       {"", "/motor_led/advance_one_timer", "/motor_led", "/a_d/advance_ad_scan", "/a_d", "/uart", "/utility",
        "/camera/fast_2_timer", "/codec", "/bluetooth", "/I2C", "/fft", "/matlab", "/acc_gyro",
        "/contrib/LIS_sensors_turret", "/contrib/SWIS_com_module"})
    line += " -I" + include + folder;
  line += " -include " + root + "/firmware/libc/include/xc16_builtins.h";
  line += " -I" + root + "/firmware/libc/include '" + source.string() + "' 2>&1";
  const shell::Said said = shell::run(line);
  return said.exit_code != 0 && said.text.empty() ? "exit " + std::to_string(said.exit_code) : said.text;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(HalDspicSources, compile_without_a_warning) {
  const auto files = sources();
  ASSERT_GT(files.size(), 50u);
  // XC16's table instructions come with the device's header
  const bool has_tables =
      text_of(TWINPUCK_SOURCE_DIR "/firmware/include/p30F6014A.h").find("__builtin_tblrdl") !=
      std::string::npos;
  for (const auto& file : files) {
    if (!has_tables && text_of(file).find("__builtin_t") != std::string::npos) continue;
    EXPECT_EQ(compile(file), "") << file;
  }
}

TEST(HalDspicSources, sound_samples_are_the_boards) {
  const std::string committed = text_of(TWINPUCK_SOURCE_DIR "/hal_dspic/codec/sound_samples.c");
  EXPECT_TRUE(committed == hal_dspic_test::sound_samples_source())
      << "run build/sound_samples hal_dspic/codec/sound_samples.c";
}

}  // namespace
