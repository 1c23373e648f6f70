// SPDX-License-Identifier: MIT
// What could not be carried, in the order in which it was met.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "import/import_params.h"
#include "import/wbt_node.h"
#include "sim_core/base/utf8.h"

namespace wbt {

/// Text from a file, fit for a message: characters of UTF-8, no control characters, not endless (bytes).
inline std::string printable(const std::string& text, std::size_t longest = 60) {
  std::string out;
  for (std::size_t at = 0; at < std::min(text.size(), longest);) {
    const std::size_t length = sim::utf8_length(text, at);
    const bool is_shown = length > 1 || (length == 1 && text[at] >= ' ' && text[at] < 127);
    out += is_shown ? text.substr(at, length) : "?";
    at += std::max<std::size_t>(length, 1);
  }
  return out;
}

class Report {
 public:
  /// `node`: what is said about it; `instead`: what was done, may be empty.
  void add(int line, const std::string& node, const std::string& why, const std::string& instead = {}) {
    const std::string text =
        printable(node) + ": not carried: " + why + (instead.empty() ? "" : "; " + instead);
    if (static_cast<int>(lines_.size()) < kMostLines)
      lines_.push_back({line, 0, text});
    else
      ++more_;
  }
  void add(const Node& node, const std::string& why, const std::string& instead = {}) {
    add(node.line, title(node), why, instead);
  }
  void add(const Node& node, const Field& f, const std::string& why, const std::string& instead = {}) {
    add(f.line, title(node) + "." + f.name, why, instead);
  }

  int size() const { return static_cast<int>(lines_.size()) + more_; }

  /// Sorted by line.
  std::vector<Remark> lines() const {
    auto out = lines_;
    std::stable_sort(out.begin(), out.end(),
                     [](const Remark& a, const Remark& b) { return a.line < b.line; });
    if (more_ > 0) out.push_back({0, 0, std::to_string(more_) + " further things: not carried"});
    return out;
  }

  static std::string title(const Node& n) { return (n.def.empty() ? "" : n.def + " ") + n.type; }

 private:
  std::vector<Remark> lines_;
  int more_ = 0;
};

}  // namespace wbt
