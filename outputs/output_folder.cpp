// SPDX-License-Identifier: MIT
#include "outputs/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "sim_core/world/world_desc.h"

namespace outputs {

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
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  const bool existed = std::filesystem::exists(status);
  std::string wrong;
  // one that the shell made is open already; opening another would wait for its reader
  if (std::filesystem::is_fifo(status) && path.rfind("/dev/", 0) != 0) {
    wrong = "a pipe";
  } else {
    std::ofstream out(path, std::ios::app);
    if (out) {
      out.close();
      if (!existed) std::filesystem::remove(path, none);
      return true;
    }
    wrong = std::strerror(errno);
  }
  problems.push_back(path + ": " + option + ": got '" + wrong + "', expected a file that can be written");
  return false;
}

void check_files_differ(const std::vector<std::pair<std::string, std::string>>& files,
                        std::vector<std::string>& problems) {
  std::error_code none;
  std::map<std::string, std::string> taken;
  for (const auto& [path, option] : files) {
    if (path.empty() || path.rfind("/dev/", 0) == 0) continue;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(path, none);
    const auto [it, fresh] = taken.emplace(whole.empty() ? path : whole.string(), option);
    if (!fresh)
      problems.push_back(path + ": " + option + ": got the file of " + it->second +
                         ", expected another; give them different names");
  }
}

std::string output_file(const std::string& folder, const sim::WorldDesc& world, int robot) {
  std::string name = world.robots[static_cast<std::size_t>(robot)].name;
  if (name.find('/') != std::string::npos || name[0] == '.') {
    std::replace(name.begin(), name.end(), '/', '_');
    name = std::to_string(robot) + "_" + name;
  }
  return folder + "/" + name;
}

}  // namespace outputs
