// SPDX-License-Identifier: MIT
#include "readable_files.h"

#include <cstdlib>

namespace cc {
namespace fs = std::filesystem;

fs::path submission() {
  const char* const said = std::getenv("TWINPUCK_SUBMISSION");
  return said ? said : "";
}

bool is_named_below(const fs::path& place, const fs::path& folder) {
  const fs::path rest = fs::absolute(place).lexically_normal().lexically_relative(folder);
  return !rest.empty() && *rest.begin() != "..";
}

ReadableFiles::ReadableFiles(const std::vector<std::string>& places) {
  std::error_code none;
  for (const std::string& place : places) {
    std::string real = fs::weakly_canonical(place, none).string();
    while (real.size() > 1 && real.back() == '/') real.pop_back();
    places_.push_back(std::move(real));
  }
}

bool ReadableFiles::has(const fs::path& file) const {
  if (places_.empty()) return true;
  std::error_code wrong;
  const std::string real = fs::canonical(file, wrong).string();
  if (wrong) return true;
  for (const std::string& place : places_)
    if (real.rfind(place, 0) == 0 && (real.size() == place.size() || real[place.size()] == '/')) return true;
  return false;
}

std::string ReadableFiles::refusal(const std::string& what, const std::string& name) const {
  return what + ": got '" + name + "', which lies outside " + (places_.empty() ? "" : places_.front()) +
         ", expected a file below it; a submission is built of its own files";
}

}  // namespace cc
