// SPDX-License-Identifier: MIT
// What earlier runs left: translations, and what they were warm with.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;

namespace fs = std::filesystem;

struct KeptTranslations : testing::Test {
  const fs::path folder = fs::temp_directory_path() / ("twinpuck_kept_" + std::to_string(getpid()));
  ~KeptTranslations() override { fs::remove_all(folder); }
  /// A run of its own; returns how much it compiled. `rounds`: below 0, 300 with all translated at once.
  int run(const fs::path& where, int rounds = -1) {
    dspic::translate::Translations translations(chip::translator_library(), where);
    const bool at_once = rounds < 0;
    if (at_once) rounds = 300;
    CoreBench b("__reset: mov #" + std::to_string(rounds) + R"(, w10
1:  rcall routine
    dec w10, w10
    bra nz, 1b
end: bra end
routine: mov #0x0A00, w1
    inc [w1], [w1]
    add w4, #3, w4
    btsc w4, #0
    inc w5, w5
    return)",
                {}, false);
    b.cpu->set_translator(&translations);
    if (at_once) b.cpu->translate_all();
    EXPECT_TRUE(b.run_to("end"));
    translated = b.cpu->cpu().table().translated();
    const auto n = static_cast<unsigned>(rounds);
    EXPECT_EQ(b.word(0x0A00), n);
    EXPECT_EQ(b.w(4), 3 * n);
    EXPECT_EQ(b.w(5), n / 2);
    return translations.compiled();
  }
  int translated = 0;  // of the latest run
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) all.push_back(entry.path());
    return all;
  }
};

TEST_F(KeptTranslations, serve_the_next_run) {
  const int compiled = run(folder);
  EXPECT_GE(compiled, 1);
  EXPECT_GE(translated, 1);
  EXPECT_EQ(files().size(), static_cast<std::size_t>(compiled));
  EXPECT_EQ(run(folder), 0);
}

// 4,096 jumps to a place are too few for the run itself; that the program is run again is worth it
TEST_F(KeptTranslations, are_of_what_the_run_before_was_warm_with) {
  EXPECT_EQ(run(folder, 7000), 0);
  EXPECT_EQ(translated, 0);
  EXPECT_GE(run(folder, 7000), 1);
  EXPECT_GE(translated, 1);
  EXPECT_EQ(run(folder, 7000), 0);
  EXPECT_GE(translated, 1);
}

TEST_F(KeptTranslations, are_not_of_what_is_soon_over) {
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(run(folder, 1000), 0);
    EXPECT_EQ(translated, 0);
  }
}

// notes that are none, or of other programs
TEST_F(KeptTranslations, go_on_where_the_notes_are_spoilt) {
  run(folder, 7000);
  ASSERT_EQ(files().size(), 1u);
  std::ofstream(files().front(), std::ios::app) << "0123456789abcdef\nno number\n";
  EXPECT_GE(run(folder, 7000), 1);
  EXPECT_EQ(run(folder, 7000), 0);
}

TEST_F(KeptTranslations, are_made_anew_when_spoilt) {
  const int compiled = run(folder);
  for (const bool cut : {true, false}) {
    for (const fs::path& file : files()) {
      const auto size = fs::file_size(file);
      if (cut) {
        fs::resize_file(file, size / 2);
      } else {
        std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
        out.seekg(static_cast<std::streamoff>(size / 2));
        const char one = static_cast<char>(out.get() ^ 1);
        out.seekp(static_cast<std::streamoff>(size / 2));
        out.put(one);
      }
    }
    EXPECT_EQ(run(folder), compiled) << "cut " << cut;
    EXPECT_EQ(run(folder), 0);
  }
}

// two versions of the product, and two runs at once, share a user's folder
TEST_F(KeptTranslations, of_another_translator_stay) {
  run(folder);
  const fs::path old = folder / "0123456789abcdef";
  fs::create_directories(old);
  std::ofstream(old / "0000000000000000") << "of an older translator";
  EXPECT_EQ(run(folder), 0);
  EXPECT_TRUE(fs::exists(old / "0000000000000000"));
}

// more than 4,000 of them, or notes of so many, are too many to look through: they begin anew
TEST_F(KeptTranslations, are_thrown_away_when_they_are_too_many) {
  const int compiled = run(folder);
  const fs::path home = files().front().parent_path();
  for (int i = 0; i < 4001; ++i) std::ofstream(home / std::to_string(1000000 + i));
  EXPECT_EQ(run(folder), compiled);
  EXPECT_EQ(files().size(), static_cast<std::size_t>(compiled));
  std::ofstream notes(home / "warm");
  for (int i = 0; i < 4001; ++i) notes << 1000000 + i << "\n";
  notes.close();
  EXPECT_EQ(run(folder), compiled);
  EXPECT_FALSE(fs::exists(home / "warm"));
  for (int i = compiled; i < 4000; ++i) std::ofstream(home / std::to_string(1000000 + i));
  EXPECT_EQ(run(folder), 0) << "4,000 are not";
}

TEST_F(KeptTranslations, are_not_kept_where_no_folder_can_be) {
  std::ofstream(folder) << "a file";
  EXPECT_GE(run(folder), 1);
  EXPECT_GE(run(folder), 1);
  EXPECT_GE(run({}), 1);
}

}  // namespace
