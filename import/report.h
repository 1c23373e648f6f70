// SPDX-License-Identifier: MIT
// What could not be carried, in the order in which it was met.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "import/import_params.h"
#include "import/wbt_node.h"

namespace wbt {

/// Text from a file, fit for a message: no control characters, not endless.
inline std::string printable(const std::string& text, std::size_t longest = 60) {
  std::string out;
  for (const char c : text.substr(0, longest)) out += c >= ' ' && c < 127 ? c : '?';
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
