// SPDX-License-Identifier: MIT
// The folder of a controller, as the page sees it: its C files by plain names, and whether any of them has
// changed. No other file is read or written, whatever a name says.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace viewer {

class Sources {
 public:
  /// `folder` empty, or a file: there is nothing to edit.
  explicit Sources(std::string folder);

  const std::string& folder() const { return folder_; }
  /// Names of its C and C++ sources and headers, below it included, in order.
  std::vector<std::string> files() const;
  /// Throw std::runtime_error when the name is none of files(), or the file cannot be read or written.
  std::string read(const std::string& name) const;
  void write(const std::string& name, const std::string& text);
  /// True once after any of the files changed, came or went.
  bool has_changed();

 private:
  std::string path_of(const std::string& name) const;
  std::map<std::string, std::pair<long long, long long>> stamps() const;

  std::string folder_;
  std::map<std::string, std::pair<long long, long long>> stamps_;  // time, ns, and size
};

}  // namespace viewer
