// SPDX-License-Identifier: MIT
// PROTOs that a world can use: those in its own file and those in files beside it.
#pragma once
#include <map>
#include <set>
#include <string>

#include "import/wbt_reader.h"

namespace wbt {

class ProtoFiles {
 public:
  /// `folder`: of the world; empty: no file is read. `text` outlives this.
  ProtoFiles(const WorldText& text, std::string folder) : text_(text), folder_(std::move(folder)) {}

  /// In the world's file, where EXTERNPROTO says, in ../protos or beside it; null: nowhere. Stays good.
  const Proto* find(const std::string& type);

 private:
  const WorldText& text_;
  const std::string folder_;
  std::map<std::string, Proto> files_;
  std::set<std::string> missing_;
};

}  // namespace wbt
