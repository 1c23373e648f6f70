// SPDX-License-Identifier: MIT
#include "tools/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tools {

bool make_output_folder(const std::string& folder, const char* option, std::vector<std::string>& problems) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error && std::filesystem::is_directory(folder)) return true;
  problems.push_back(folder + ": " + option + ": got '" + (error ? error.message() : "Not a directory") +
                     "', expected a folder, or a place where one can be made");
  return false;
}

bool can_write(const std::string& path, const char* option, std::vector<std::string>& problems) {
  if (path.empty()) return true;
  const bool existed = std::filesystem::exists(path);
  std::ofstream out(path, std::ios::app);
  if (out) {
    out.close();
    if (!existed) std::filesystem::remove(path);
    return true;
  }
  problems.push_back(path + ": " + option + ": got '" + std::strerror(errno) +
                     "', expected a file that can be written");
  return false;
}

std::string output_file(const std::string& folder, const sim::WorldDesc& world, int robot) {
  std::string name = world.robots[static_cast<std::size_t>(robot)].name;
  if (name.find('/') != std::string::npos || name[0] == '.') {
    std::replace(name.begin(), name.end(), '/', '_');
    name = std::to_string(robot) + "_" + name;
  }
  return folder + "/" + name;
}

}  // namespace tools
