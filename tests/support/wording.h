// SPDX-License-Identifier: MIT
// Texts held word for word, where some words depend on the PC, the day or the compiler.
#pragma once
#include <cctype>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>

namespace wording {

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Whether `said` is `wanted`, in which each … stands for one or more characters without a space.
inline bool is_as(const char* said, const char* wanted) {
  constexpr std::size_t kBytes = sizeof "…" - 1;
  for (; *wanted; ++said, ++wanted) {
    if (std::strncmp(wanted, "…", kBytes) == 0) {
      while (*said && !std::isspace(static_cast<unsigned char>(*said)))
        if (is_as(++said, wanted + kBytes)) return true;
      return false;
    }
    if (*said != *wanted) return false;
  }
  return !*said;
}

/// For EXPECT_EQ(as(wanted, said), wanted): what was said, or `wanted` where it is that. Each pair's first text, such
/// as a test's folder, is seen as its second.
inline std::string as(const std::string& wanted, std::string said,
                      std::initializer_list<std::pair<std::string, std::string>> names = {}) {
  for (const auto& [what, by] : names) said = replaced(said, what, by);
  return is_as(said.c_str(), wanted.c_str()) ? wanted : said;
}

}  // namespace wording
