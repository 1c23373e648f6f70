// SPDX-License-Identifier: MIT
#include "sim_core/base/file_uses.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace sim {

namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // from one to the next, as Linux has it

/// The name of a file that may not exist yet, whole and without links.
fs::path whole_path(const std::string& path) {
  std::error_code none;
  fs::path at = fs::absolute(path, none);
  // of a link whose file is still to come weakly_canonical() makes nothing
  for (int links = 0; links < kMostLinks && fs::is_symlink(fs::symlink_status(at, none)); ++links)
    at = at.parent_path() / fs::read_symlink(at, none);
  const fs::path whole = fs::weakly_canonical(at, none);
  return whole.empty() ? at.lexically_normal() : whole;
}

/// What two names of one file have in common; empty: a device, a pipe, or no name.
std::string identity(const std::string& path) {
  if (path.empty() || path.rfind("/dev/", 0) == 0) return "";
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0) return whole_path(path).string();
  if (!S_ISREG(info.st_mode)) return "";
  return std::to_string(info.st_dev) + ":" + std::to_string(info.st_ino);
}

/// Of what runs leave behind, in the folder of a program, too; the next run may write it again.
bool is_left_behind(const fs::path& file) {
  std::error_code none;
  const std::string name = file.filename().string(), ending = file.extension().string();
  if (name == "configurations.xml") return false;  // a project of MPLAB X
  if (ending.empty())
    return name != "Makefile" && name != "makefile" &&
           (fs::status(file, none).permissions() & fs::perms::owner_exec) == fs::perms::none;
  for (const char* kind :
       {".csv",  ".json", ".png", ".apng", ".svg", ".webm", ".vcd",   ".html",   ".txt", ".log", ".out",
        ".info", ".lcov", ".wav", ".bin",  ".dat", ".xml",  ".trace", ".inputs", ".elf", ".hex"})
    if (ending == kind) return true;
  return false;
}

bool is_under(const fs::path& file, const fs::path& folder) {
  const fs::path rest = file.lexically_relative(folder);
  return !rest.empty() && rest != "." && *rest.begin() != "..";
}

/// Whether one of the files in the folder is `file` under another name, a hard link.
bool holds(const fs::path& folder, const fs::path& file) {
  std::error_code none;
  if (fs::hard_link_count(file, none) < 2 || none) return false;
  const auto skip = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator it(folder, skip, none), end; !none && it != end; it.increment(none))
    if (std::error_code gone; !is_left_behind(it->path()) && fs::equivalent(it->path(), file, gone))
      return true;
  return false;
}

}  // namespace

void FileUses::reads_program(const std::string& path) {
  std::error_code none;
  if (fs::is_directory(path, none))
    programs_.push_back(path);
  else
    reads(path, "a program");
}

void FileUses::check(std::vector<std::string>& problems) const {
  if (outputs_.empty() && pictures_.empty()) return;
  std::error_code none;
  const auto refuse = [&](const Use& use, const std::string& got) {
    problems.push_back(use.path + ": " + use.what + ": got " + got +
                       ", expected another; give them different names");
  };
  std::map<std::string, std::string> taken;
  for (const Use& use : inputs_)
    if (const std::string file = identity(use.path); !file.empty()) taken.emplace(file, use.what);
  for (const Use& use : outputs_) {
    const std::string file = identity(use.path);
    if (file.empty()) continue;
    const auto [it, fresh] = taken.emplace(file, use.what);
    if (!fresh) {
      refuse(use, "the file of " + it->second);
      continue;
    }
    if (!fs::exists(use.path, none)) continue;
    // a source may be a link to a file elsewhere
    const fs::path whole = whole_path(use.path), named = fs::absolute(use.path, none).lexically_normal();
    for (const std::string& folder : programs_)
      if (((is_under(whole, whole_path(folder)) ||
            is_under(named, fs::absolute(folder, none).lexically_normal())) &&
           !is_left_behind(whole)) ||
          holds(folder, use.path)) {
        refuse(use, "a file of the program " + folder);
        break;
      }
  }
  for (const Use& use : pictures_)
    for (const Use& input : inputs_) {
      const std::string file = whole_path(input.path).string(), stem = whole_path(use.path).string() + "_";
      const fs::path rest = file.rfind(stem, 0) == 0 ? file.substr(stem.size()) : "";
      const std::string number = rest.stem().string();
      if (!input.path.empty() && rest.extension() == ".png" && number.size() >= 6 &&
          number.find_first_not_of("0123456789") == std::string::npos)
        refuse({input.path, use.what}, "the file of " + input.what);
    }
}

}  // namespace sim
