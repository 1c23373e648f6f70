// SPDX-License-Identifier: MIT
// What is translated when changes no result, so neither does what earlier runs left.
#include "dspic30/translate/translations.h"

#include <dlfcn.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <utility>

#include "dspic30/memory/hex.h"

namespace dspic::translate {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostKept = 4000;  // about 40 MB

std::string name_of(const std::string& text) { return hex(std::hash<std::string>{}(text), 16).substr(2); }

/// False: the file is not what it should be.
bool load(const fs::path& file, const std::string& key, MachineCode& code) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return read_text(text, key, code);
}

}  // namespace

// a library that was built anew has another time or size
void Translations::open() {
  is_open_ = true;
  const fs::path all = std::exchange(folder_, {});
  std::error_code failed;
  const auto time = fs::last_write_time(library_, failed).time_since_epoch().count();
  if (failed || all.empty()) return;
  folder_ = all / name_of(std::to_string(time) + " " + std::to_string(fs::file_size(library_, failed)));
  for (fs::directory_iterator it(all, failed), end; !failed && it != end; it.increment(failed)) {
    std::error_code none;
    if (it->path() != folder_) fs::remove_all(it->path(), none);
  }
  for (fs::directory_iterator it(folder_, failed), end; !failed && it != end; it.increment(failed))
    kept_.insert(it->path().filename().string());
  if (kept_.size() > kMostKept) {
    kept_.clear();
    fs::remove_all(folder_, failed);
  }
  fs::create_directories(folder_, failed);
  if (failed) folder_.clear();
}

Translation Translations::translate(const Cpu& cpu, const Decoded* head, bool only_ready) {
  const std::lock_guard lock(mutex_);
  if (!is_open_) open();
  if (only_ready && kept_.empty() && known_.empty()) return {};
  const std::vector<Item> items = stretch(cpu, head);
  if (items.empty()) return {};
  const std::string key = key_of(cpu, items);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  const std::string name = name_of(key);
  const bool is_kept = kept_.count(name) > 0;
  if (only_ready && !is_kept) return {};
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
  return known_[key] = made;
}

bool Translations::has_compiler() {
  if (!is_loaded_) {
    is_loaded_ = true;
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
    fs::remove(half, failed);
}

}  // namespace dspic::translate
