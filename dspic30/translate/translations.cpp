// SPDX-License-Identifier: MIT
// What is translated when changes no result, so neither does what earlier runs left.
#include "dspic30/translate/translations.h"

#include <dirent.h>
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <functional>
#include <utility>

#include "dspic30/memory/hex.h"

namespace dspic::translate {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostKept = 4000;  // about 40 MB

std::string name_of(std::uint64_t hash) { return hex(hash, 16).substr(2); }
std::uint64_t hash_of(const std::string& text) { return std::hash<std::string>{}(text); }

// The first 16 bits of a translation's name are of its opening, two words, and tell at once of most places that
// there is none.
constexpr unsigned kOpeningAt = 48;
unsigned opening_of(const Cpu& cpu, const Decoded* head) {
  constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15u;
  const unsigned address = cpu.address_of(head);
  const std::uint64_t words = std::uint64_t{cpu.program.read(address + 2)} << 24 | cpu.program.read(address);
  return static_cast<unsigned>(words * kMix >> kOpeningAt);
}
std::uint64_t hash_of(unsigned opening, const std::string& key) {
  return std::uint64_t{opening} << kOpeningAt | hash_of(key) >> (64 - kOpeningAt);
}

/// What the files of a folder are named by, in order. There may be thousands, and each run looks.
std::vector<std::uint64_t> hashes_in(const fs::path& folder) {
  std::vector<std::uint64_t> hashes;
  DIR* const open = opendir(folder.c_str());
  if (!open) return hashes;
  while (const dirent* entry = readdir(open)) {
    const char* const end = entry->d_name + std::strlen(entry->d_name);
    std::uint64_t hash = 0;
    const auto [read, error] = std::from_chars(entry->d_name, end, hash, 16);
    if (error == std::errc() && read == end) hashes.push_back(hash);
  }
  closedir(open);
  std::sort(hashes.begin(), hashes.end());
  return hashes;
}

/// A line each, appended by any number of runs at once.
constexpr const char* kWarmFile = "warm";
std::vector<std::uint64_t> warm_in(const fs::path& folder) {
  std::vector<std::uint64_t> hashes;
  std::ifstream in(folder / kWarmFile);
  for (std::uint64_t hash; in >> std::hex >> hash;) hashes.push_back(hash);
  std::sort(hashes.begin(), hashes.end());
  return hashes;
}

/// False: the file is not what it should be. Each run reads some twenty: by a stream that takes four times as
/// long.
bool load(const fs::path& file, const std::string& key, MachineCode& code) {
  std::FILE* const in = std::fopen(file.c_str(), "rb");
  if (!in) return false;
  std::string text;
  std::array<char, 16384> block;
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), in))
    text.append(block.data(), size);
  std::fclose(in);
  return read_text(text, key, code);
}

}  // namespace

// a library that was built anew has another time or size; those of others may be in use
void Translations::open() {
  is_open_ = true;
  const fs::path all = std::exchange(folder_, {});
  std::error_code failed;
  const auto time = fs::last_write_time(library_, failed).time_since_epoch().count();
  if (failed || all.empty()) return;
  folder_ =
      all / name_of(hash_of(std::to_string(time) + " " + std::to_string(fs::file_size(library_, failed))));
  kept_ = hashes_in(folder_);
  warm_ = warm_in(folder_);
  if (std::max(kept_.size(), warm_.size()) > kMostKept) {
    kept_.clear();
    warm_.clear();
    fs::remove_all(folder_, failed);
  }
  fs::create_directories(folder_, failed);
  if (failed) folder_.clear();
  note_openings(kept_);
  note_openings(warm_);
}

void Translations::note_openings(const std::vector<std::uint64_t>& names) {
  for (const std::uint64_t name : names) openings_.set(name >> kOpeningAt);
}

Translation Translations::translate(const Cpu& cpu, const Decoded* head, bool only_ready) {
  const std::lock_guard lock(mutex_);
  if (!is_open_) open();
  const unsigned opening = opening_of(cpu, head);
  if (only_ready && !openings_.test(opening)) return {};
  const std::vector<Item> items = stretch(cpu, head);
  if (items.empty()) return {};
  const std::string key = key_of(cpu, items);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const std::uint64_t hash = hash_of(opening, key);
  const std::string name = name_of(hash);
  const bool is_kept = std::binary_search(kept_.begin(), kept_.end(), hash);
  if (only_ready && !is_kept && !std::binary_search(warm_.begin(), warm_.end(), hash)) return {};
  MachineCode code;
  if (!is_kept || !load(folder_ / name, key, code)) {
    if (!has_compiler()) return {};
    compile_(cpu, items, code);
    ++compiled_;
    keep(folder_ / name, text_of(key, code));
  }
  Translation made;
  if (!code.bytes.empty()) made.run = placed(code, items);
  for (const Item& item : items) {
    made.first = std::min(made.first, item.place);
    made.last = std::max(made.last, item.place);
  }
  openings_.set(opening);
  return known_[key] = made;
}

void Translations::note_warm(const Cpu& cpu, const Decoded* head) {
  const std::lock_guard lock(mutex_);
  if (!is_open_) open();
  const std::vector<Item> items = stretch(cpu, head);
  if (items.empty()) return;
  const unsigned opening = opening_of(cpu, head);
  const std::uint64_t hash = hash_of(opening, key_of(cpu, items));
  // another world of this run may come there, too
  openings_.set(opening);
  warm_.insert(std::lower_bound(warm_.begin(), warm_.end(), hash), hash);
  if (!folder_.empty())
    std::ofstream(folder_ / kWarmFile, std::ios::app) << name_of(hash) + "\n" << std::flush;
}

bool Translations::has_compiler() {
  if (!is_loaded_) {
    is_loaded_ = true;
    find_own_functions();
    void* const library = dlopen(library_.c_str(), RTLD_LAZY | RTLD_LOCAL);
    const auto* const cpu_bytes =
        library ? static_cast<const std::size_t*>(dlsym(library, "dspic_translate_cpu_bytes")) : nullptr;
    if (cpu_bytes && *cpu_bytes == sizeof(Cpu))  // else it is of another build
      compile_ = reinterpret_cast<Compile>(dlsym(library, "dspic_translate"));
  }
  return compile_ != nullptr;
}

void Translations::keep(const fs::path& file, const std::string& text) const {
  if (folder_.empty()) return;
  const fs::path half = file.string() + "." + std::to_string(getpid());  // another process may look
  std::error_code failed;
  if (std::ofstream out(half, std::ios::binary); out << text << std::flush)
    fs::rename(half, file, failed);
  else
    failed = std::make_error_code(std::errc::io_error);
  if (!failed) {
    if (tell_kept_) tell_kept_();
    return;
  }
  fs::remove(half, failed);
}

}  // namespace dspic::translate
