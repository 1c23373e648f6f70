// SPDX-License-Identifier: MIT
#include "outputs/output_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

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

bool write_file(const std::string& path, std::string_view text, const char* option,
                std::vector<std::string>& problems) {
  if (path.empty()) return true;
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (out) return true;
  problems.push_back(path + ": " + option + ": cannot be written: " + std::strerror(errno ? errno : EIO));
  return false;
}

std::string output_file(const std::string& folder, const sim::WorldDesc& world, int robot) {
  std::string name = world.robots[static_cast<std::size_t>(robot)].name;
  if (name.find('/') != std::string::npos || name[0] == '.') {
    std::replace(name.begin(), name.end(), '/', '_');
    name = std::to_string(robot) + "_" + name;
    const auto is_taken = [&](const sim::RobotDesc& other) { return other.name == name; };
    while (std::any_of(world.robots.begin(), world.robots.end(), is_taken)) name += '_';
  }
  return folder + "/" + name;
}

}  // namespace outputs
