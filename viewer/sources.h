// SPDX-License-Identifier: MIT
// The folder of a controller, as the page sees it: its C files by plain names, and which of them have changed
// on the disk. No other file is read or written, whatever a name says.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "viewer/text_file.h"

namespace viewer {

/// A source as it was read.
struct SourceText {
  std::string text;       ///< lines end with LF
  std::string base;       ///< names what was read
  bool writable = false;  ///< it has the permission
  bool is_latin = false;  ///< it is kept in Latin-1
};

class Sources {
 public:
  /// `folder` empty, or a file: there is nothing to edit.
  explicit Sources(std::string folder);

  const std::string& folder() const { return folder_; }
  /// Names of its C and C++ sources and headers, below it included, in order.
  std::vector<std::string> files() const;
  /// Throw std::runtime_error when the name is none of files(), or the file cannot be read or written.
  SourceText read(const std::string& name) const;
  /// Over what `base` names, else Refusal (text_file.h). Returns the new base.
  std::string write(const std::string& name, const std::string& text, const std::string& base,
                    bool overwrite);
  /// Files that changed, came or went since the call before, each once, and the base of what is there now;
  /// empty: it is gone.
  std::vector<std::pair<std::string, std::string>> changes();

 private:
  std::string path_of(const std::string& name) const;
  std::map<std::string, Stamp> stamps() const;

  std::string folder_;
  std::map<std::string, Stamp> stamps_;  // time, ns, and size
  std::set<std::string> seen_;           // files that there are or were
};

}  // namespace viewer
