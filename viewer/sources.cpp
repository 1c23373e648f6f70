// SPDX-License-Identifier: MIT
#include "viewer/sources.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "sim_core/base/input_file.h"

namespace viewer {

namespace fs = std::filesystem;

namespace {
constexpr std::size_t kLongestSource = 4u << 20;  // bytes
constexpr int kDeepest = 3;                       // folders below the controller's
constexpr std::size_t kMostFiles = 500;
}  // namespace

Sources::Sources(std::string folder) : folder_(std::move(folder)) {
  std::error_code none;
  if (!fs::is_directory(folder_, none)) folder_.clear();
  stamps_ = stamps();
  for (const auto& [name, stamp] : stamps_) seen_.insert(name);
}

std::vector<std::string> Sources::files() const {
  std::vector<std::string> names;
  if (folder_.empty()) return names;
  std::error_code none;
  for (fs::recursive_directory_iterator it(folder_, fs::directory_options::skip_permission_denied, none), end;
       !none && it != end && names.size() < kMostFiles; it.increment(none)) {
    if (it.depth() >= kDeepest) it.disable_recursion_pending();
    if (it->is_symlink(none) || !it->is_regular_file(none)) continue;  // a link may lead anywhere
    const std::string kind = it->path().extension().string();
    for (const char* known : {".c", ".h", ".cpp", ".hpp", ".cc", ".s", ".inc"})
      if (kind == known) names.push_back(it->path().lexically_relative(folder_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string Sources::path_of(const std::string& name) const {
  const std::vector<std::string> known = files();
  if (!std::binary_search(known.begin(), known.end(), name) && seen_.count(name) == 0)
    throw std::runtime_error("file: got '" + name + "', expected one of the controller's sources");
  return (fs::path(folder_) / name).string();
}

SourceText Sources::read(const std::string& name) const {
  std::string bytes;
  const std::string path = path_of(name), wrong = sim::read_input_file(path, kLongestSource, bytes);
  if (!wrong.empty()) throw std::runtime_error(name + ": " + wrong);
  PlainText plain = plain_text(bytes);
  return {std::move(plain.text), base_of(bytes), is_writable(path), plain.is_latin};
}

std::string Sources::write(const std::string& name, const std::string& text, const std::string& base,
                           bool overwrite) {
  const std::string path = path_of(name);
  const std::string fresh = bytes_like(bytes_at(path, kLongestSource).value_or(""), text);
  replace_known(path, fresh, base, overwrite);
  return base_of(fresh);
}

std::map<std::string, Stamp> Sources::stamps() const {
  std::map<std::string, Stamp> out;
  for (const std::string& name : files())
    if (const Stamp stamp = stamp_of((fs::path(folder_) / name).string()); stamp.first >= 0)
      out[name] = stamp;
  return out;
}

std::vector<std::pair<std::string, std::string>> Sources::changes() {
  std::vector<std::pair<std::string, std::string>> out;
  auto now = stamps();
  const auto note = [&](const std::string& name) {
    const auto bytes = bytes_at((fs::path(folder_) / name).string(), kLongestSource);
    out.emplace_back(name, bytes ? base_of(*bytes) : "");
  };
  if (now == stamps_) return out;
  for (const auto& [name, stamp] : now)
    if (const auto was = stamps_.find(name); was == stamps_.end() || was->second != stamp) {
      note(name);
      seen_.insert(name);
    }
  for (const auto& [name, stamp] : stamps_)
    if (now.find(name) == now.end()) note(name);
  stamps_ = std::move(now);
  return out;
}

}  // namespace viewer
