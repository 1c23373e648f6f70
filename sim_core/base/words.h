// SPDX-License-Identifier: MIT
// A text taken apart.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace sim {

/// What stands between separators, in order; nothing of it is empty.
inline std::vector<std::string> words_of(const std::string& text, const char* separators = " \t\r\n") {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace sim
