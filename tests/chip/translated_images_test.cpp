// SPDX-License-Identifier: MIT
// Every controller of the repository as an image of the chip, translated from its first jump on and
// interpreted: world, chip and processor are the same.
#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/chip/chip_fixture.h"

namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 1.0;

/// Folders under firmware/ with a program in them.
std::vector<std::string> controllers() {
  std::vector<std::string> all;
  for (const char* parent : {"firmware", "firmware/lab"})
    for (const auto& entry : fs::directory_iterator(fs::path(TWINPUCK_SOURCE_DIR) / parent)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_directory() || name == "libc" || name == "library" || name == "include" ||
          name == "webots")
        continue;
      const auto is_program = [](const auto& file) { return file.path().extension() == ".c"; };
      if (std::any_of(fs::directory_iterator(entry.path()), fs::directory_iterator(), is_program))
        all.push_back(name);
    }
  std::sort(all.begin(), all.end());
  return all;
}

struct Seen {
  std::uint64_t world = 0, chip = 0, processor = 0;
  dspic::Cycle cycles = 0;
  int translated = 0;
};

Seen run(const std::string& controller, bool translated) {
  struct Run : chip_test::ChipTest {
    void TestBody() override {}
    Seen go(const std::string& name, bool translates) {
      options.hal = "dspic";
      load_world("worlds/maze.toml");
      robot(0).settings().firmware = name;
      if (!translates) setenv("TWINPUCK_INTERPRET", "1", 1);
      twin();
      unsetenv("TWINPUCK_INTERPRET");
      if (translates) runner().processor().translate_all();
      run_for(kSeconds);
      Seen seen;
      seen.world = digest();
      seen.cycles = runner().processor().now();
      seen.chip = runner().device().state_hash(seen.cycles);
      seen.processor = runner().processor().state_hash();
      seen.translated = runner().processor().cpu().table().translated();
      return seen;
    }
  } one;
  return one.go(controller, translated);
}

TEST(TranslatedImages, are_what_they_are_interpreted) {
  const std::vector<std::string> all = controllers();
  EXPECT_GT(all.size(), 18u);
  for (const std::string& controller : all) {
    SCOPED_TRACE(controller);
    const Seen plain = run(controller, false), translated = run(controller, true);
    EXPECT_EQ(plain.translated, 0);
    EXPECT_GT(translated.translated, 3);
    EXPECT_EQ(plain.cycles, translated.cycles);
    EXPECT_EQ(plain.world, translated.world);
    EXPECT_EQ(plain.chip, translated.chip);
    EXPECT_EQ(plain.processor, translated.processor);
  }
}

}  // namespace
