// SPDX-License-Identifier: MIT
// Texts held word for word, where some words depend on the PC, the day or the compiler.
#pragma once
#include <gtest/gtest.h>

#include <cctype>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

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

using Names = std::vector<std::pair<std::string, std::string>>;

/// For EXPECT_TRUE(reads(said, wanted)): that it is said word for word, but for a line end behind it. Each pair's first
/// text, such as a test's folder, is read as its second.
inline testing::AssertionResult reads(std::string said, const std::string& wanted, const Names& names = {}) {
  for (const auto& [what, by] : names) said = replaced(said, what, by);
  if (!said.empty() && said.back() == '\n') said.pop_back();
  if (is_as(said.c_str(), wanted.c_str())) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "got\n  " << testing::PrintToString(said) << "\nexpected\n  "
                                     << testing::PrintToString(wanted) << "\n";
}

}  // namespace wording
