// SPDX-License-Identifier: MIT
#include "sim_core/world/world_desc.h"

namespace sim {

std::vector<std::string> argument_words(const std::string& args) {
  std::vector<std::string> words;
  char quote = 0;
  bool inside = false;  // a word has begun
  for (const char c : args) {
    if (quote ? c == quote : c == '"' || c == '\'') {
      quote = quote ? 0 : c;
      if (!inside) words.emplace_back();
      inside = true;
    } else if (!quote && (c == ' ' || c == '\t')) {
      inside = false;
    } else {
      if (!inside) words.emplace_back();
      inside = true;
      words.back() += c;
    }
  }
  return words;
}

}  // namespace sim
