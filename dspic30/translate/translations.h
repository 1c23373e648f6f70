// SPDX-License-Identifier: MIT
// The translator's front door: one for all robots of a process. Robots that run the same program share its
// code, and what was translated once is kept in files for later runs.
#pragma once
#include <bitset>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "dspic30/translate/machine_code.h"
#include "dspic30/translate/stretch.h"

namespace dspic::translate {

class Translations final : public Translator {
 public:
  /// `library`: the one with the compiler, loaded when it is first needed; without it, nothing is translated.
  /// `folder`: where translations are kept, each library's below it; more than 4000 of this one's are removed
  /// when one is first asked for. Empty, or one that cannot be written: they are not kept. `kept` is called
  /// behind each one that was put there; null: nobody hears of it.
  Translations(std::filesystem::path library, std::filesystem::path folder, void (*kept)() = nullptr)
      : library_(std::move(library)), folder_(std::move(folder)), tell_kept_(kept) {}
  Translation translate(const Cpu& cpu, const Decoded* head, bool only_ready) override;
  void note_warm(const Cpu& cpu, const Decoded* head) override;
  int compiled() const { return compiled_; }  ///< not taken from a file

 private:
  void open();
  void note_openings(const std::vector<std::uint64_t>& names);
  bool has_compiler();
  void keep(const std::filesystem::path& file, const std::string& text) const;

  using Compile = void (*)(const Cpu& cpu, const std::vector<Item>& items, MachineCode& code);
  std::filesystem::path library_, folder_;  // once open: the one of this library
  void (*tell_kept_)();
  std::mutex mutex_;
  bool is_open_ = false, is_loaded_ = false;
  Compile compile_ = nullptr;
  std::map<std::string, Translation> known_;
  std::vector<std::uint64_t> kept_;  // what the files are named by, in order
  std::vector<std::uint64_t> warm_;  // noted by earlier runs, in order
  // what all of these begin with, and all known ones: nearly every place that is only asked for is in none
  std::bitset<1 << 16> openings_;
  int compiled_ = 0;
};

}  // namespace dspic::translate
