// SPDX-License-Identifier: MIT
// Every kind of input, without libFuzzer: what crashed once, and seeds that are changed at random, the same
// in every run. TWINPUCK_MUTATIONS=10000 asks for more of them. The input at work lies in
// build/tests/scratch/fuzz-KIND, for when the program dies.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sim_core/base/hash.h"
#include "tests/fuzz/kinds.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

constexpr int kMutations = 300;
constexpr std::size_t kLongest = 20000;  // bytes

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<fs::path> names;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (entry.is_regular_file()) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<std::string> all;
  for (const fs::path& name : names) {
    std::ifstream in(name, std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return all;
}

std::vector<std::string> seeds_of(const std::string& kind) {
  const fs::path source = TWINPUCK_SOURCE_DIR;
  std::vector<std::string> all = files_in(source / "tests/fuzz/seeds" / kind);
  const fs::path more = kind == "world" ? source / "worlds"
                        : kind == "wbt" ? source / "tests/import/worlds"
                                        : "";
  if (!more.empty())
    for (std::string& text : files_in(more)) all.push_back(std::move(text));
  if (kind == "lab") {
    std::ifstream in(source / "docs/lab.toml", std::ios::binary);
    all.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return all;
}

// words of a dictionary: one a line, in quotes, \xNN for bytes
std::vector<std::string> words_of(const std::string& kind) {
  std::vector<std::string> words{"nan",
                                 "-1",
                                 "1e308",
                                 "99999999999",
                                 "\"",
                                 "[",
                                 "]",
                                 "{",
                                 "}",
                                 "=",
                                 "\n",
                                 ".",
                                 "\\",
                                 std::string(1, '\0'),
                                 "\xff\xff\xff\xff",
                                 "\x1b[2J",
                                 "/"};
  std::ifstream in(fs::path(TWINPUCK_SOURCE_DIR) / "tests/fuzz/dict" / (kind + ".dict"));
  for (std::string line; std::getline(in, line);) {
    if (line.size() < 2 || line[0] != '"') continue;
    std::string word;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] == '\\' && line[i + 1] == 'x' && i + 3 < line.size())
        word += static_cast<char>(std::strtol(line.substr(i + 2, 2).c_str(), nullptr, 16)), i += 3;
      else if (line[i] == '\\')
        word += line[++i];
      else
        word += line[i];
    }
    words.push_back(word);
  }
  return words;
}

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t end) {
    return end ? static_cast<std::size_t>((state_ = sim::mix64(state_ + 1)) % end) : 0;
  }

 private:
  std::uint64_t state_;
};

std::string changed(const std::vector<std::string>& seeds, const std::vector<std::string>& words,
                    Chance& chance) {
  std::string text = seeds[chance.below(seeds.size())];
  if (text.size() > kLongest) text = text.substr(chance.below(text.size() - kLongest), kLongest);
  for (std::size_t left = 1 + chance.below(6); left > 0; --left) {
    const std::size_t at = chance.below(text.size() + 1);
    const std::size_t length = std::min(chance.below(chance.below(4) ? 16 : 400), text.size() - at);
    switch (chance.below(7)) {
      case 0:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ 1 << chance.below(8));
        break;
      case 1:
        if (at < text.size()) text[at] = static_cast<char>(chance.below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      case 4:
        text.insert(at, words[chance.below(words.size())]);
        break;
      case 5:
        text.resize(at);
        break;
      default: {
        const std::string& other = seeds[chance.below(seeds.size())];
        text.insert(at, other.substr(chance.below(other.size() + 1), chance.below(200)));
      }
    }
  }
  return text;
}

class Fuzz : public ::testing::TestWithParam<fuzz::Kind> {
 protected:
  void feed(const std::string& bytes) {
    std::ofstream(scratch_, std::ios::binary) << bytes;
    GetParam().run(bytes);
  }
  void SetUp() override {
    ::mkdir(TWINPUCK_BUILD_DIR "/tests/scratch", 0777);
    scratch_ = std::string(TWINPUCK_BUILD_DIR "/tests/scratch/fuzz-") + GetParam().name;
  }
  std::string scratch_;
};

TEST_P(Fuzz, what_crashed_once_does_not_any_more) {
  for (const std::string& bytes :
       files_in(fs::path(TWINPUCK_SOURCE_DIR) / "tests/fuzz/crashed" / GetParam().name))
    feed(bytes);
}

TEST_P(Fuzz, changed_seeds_have_an_answer) {
  const auto seeds = seeds_of(GetParam().name);
  ASSERT_FALSE(seeds.empty());
  for (const std::string& seed : seeds) feed(seed);
  const auto words = words_of(GetParam().name);
  const char* asked = std::getenv("TWINPUCK_MUTATIONS");
  const int count = asked ? std::atoi(asked) : kMutations;
  Chance chance(7);
  for (int i = 0; i < count; ++i) feed(changed(seeds, words, chance));
}

INSTANTIATE_TEST_SUITE_P(Kind, Fuzz, ::testing::ValuesIn(fuzz::kKinds),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
