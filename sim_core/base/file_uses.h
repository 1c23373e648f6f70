// SPDX-License-Identifier: MIT
// All files that a command reads and writes, gathered before any of them is opened: what is written is neither
// read nor written by another option. Two spellings, links and names of files to come are one file where they
// mean one. Not looked at: devices and pipes.
#pragma once
#include <string>
#include <vector>

namespace sim {

class FileUses {
 public:
  /// `path` is read, by what people call `what`: "the world", "--faults". Empty paths are none.
  void reads(const std::string& path, const std::string& what) { inputs_.push_back({path, what}); }
  /// A program: a file, or a folder whose files are its sources, but for kinds that are left behind by runs.
  void reads_program(const std::string& path);
  /// `path` is written, because of `option`.
  void writes(const std::string& path, const std::string& option) {
    if (!path.empty()) outputs_.push_back({path, option});
  }
  /// Files FOLDER/STEM_<number>.png are written.
  void writes_pictures(const std::string& stem, const std::string& option) {
    pictures_.push_back({stem, option});
  }
  /// A line for each file that is written and used besides.
  void check(std::vector<std::string>& problems) const;

 private:
  struct Use {
    std::string path, what;
  };
  std::vector<Use> inputs_, outputs_, pictures_;
  std::vector<std::string> programs_;  // folders
};

}  // namespace sim
