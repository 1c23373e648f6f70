// SPDX-License-Identifier: MIT
// Inside programs/build: runtime.ini beside a controller, as Webots' guide describes it: sections, NAME =
// VALUE, comments after ";". Sections of other systems are left out.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "files.h"

namespace programs {

struct RuntimeIni {
  /// In the order of the file; $(NAME) is replaced, relative paths begin in the folder.
  std::vector<std::pair<std::string, std::string>> environment;
  std::map<std::string, std::string> commands;              ///< "python" -> COMMAND
  std::map<std::string, std::vector<std::string>> options;  ///< "python" -> words of OPTIONS
};

/// Reads the folder's runtime.ini; empty when there is none. What is not understood is told in `warnings`.
RuntimeIni read_runtime_ini(const fs::path& folder, std::vector<std::string>& warnings);

}  // namespace programs
