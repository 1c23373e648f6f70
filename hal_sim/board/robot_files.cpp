// SPDX-License-Identifier: MIT
#include "hal_sim/board/robot_files.h"

namespace board {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostOpen = 20;                  // as small systems have
constexpr std::int64_t kMostBytes = 64 * 1024 * 1024;  // written in a run; a program may not fill the disk

/// The file of that name within a folder; empty: it lies outside, by its name or by a link.
fs::path within(const fs::path& folder, const fs::path& name) {
  std::error_code none;
  const fs::path inner = name.lexically_normal();
  if (folder.empty() || inner.empty() || inner.is_absolute() || *inner.begin() == "..") return {};
  const fs::path root = fs::weakly_canonical(folder, none), file = fs::weakly_canonical(root / inner, none);
  const fs::path below = file.lexically_relative(root);
  return none || below.empty() || *below.begin() == ".." || below == "." ? fs::path() : file;
}

}  // namespace

int RobotFiles::open(const std::string& name, const std::string& mode, std::string& why) {
  why.clear();
  const char kind = mode.empty() ? '?' : mode[0];
  if (kind != 'r' && kind != 'w' && kind != 'a') {
    why = "got mode \"" + mode + "\", expected one that begins with r, w or a";
    return 0;
  }
  if (own_.empty()) {
    why = "got a program that wants a file, expected a run with a folder for files";
    return 0;
  }
  const fs::path own = within(own_, name);
  if (own.empty()) {
    why = "got a path outside of the robot's folder, expected a name in it: programs write to " +
          own_.string() + " and read from there or from their controller's folder";
    return 0;
  }
  std::size_t slot = 0;
  while (slot < open_.size() && open_[slot].file) ++slot;
  if (slot >= kMostOpen) {
    why = "got a file more than 20 open, expected fclose()";
    return 0;
  }
  std::error_code none;
  const fs::path given = within(source_, name);
  const bool is_given = !given.empty() && fs::is_regular_file(given, none);
  const bool changes = kind != 'r' || mode.find('+') != std::string::npos;
  if (changes && (kind != 'r' || is_given || fs::exists(own, none))) {
    made_ = fs::create_directories(own.parent_path(), none) || made_;
    // what is changed begins as the controller's folder has it
    if (kind != 'w' && is_given) fs::copy_file(given, own, fs::copy_options::skip_existing, none);
  }
  const fs::path& file = changes || fs::exists(own, none) || !is_given ? own : given;
  if (fs::exists(file, none) && !fs::is_regular_file(file, none)) {
    why = "got a folder or a device, expected a file";
    return 0;
  }
  std::FILE* opened = std::fopen(
      file.c_str(),
      (std::string(1, kind) + (changes && mode.find('+') != std::string::npos ? "+b" : "b")).c_str());
  if (!opened) {
    if (kind != 'r') why = "cannot write " + file.string();
    return 0;
  }
  made_ = made_ || kind != 'r';
  if (slot == open_.size()) open_.emplace_back();
  open_[slot].file.reset(opened);
  open_[slot].last = 0;
  return static_cast<int>(slot) + 1;
}

std::FILE* RobotFiles::turn(int file, char direction) {
  if (file < 1 || static_cast<std::size_t>(file) > open_.size()) return nullptr;
  Open& open = open_[static_cast<std::size_t>(file) - 1];
  if (open.file && open.last != direction) {
    std::fseek(open.file.get(), 0, SEEK_CUR);
    open.last = direction;
  }
  return open.file.get();
}

void RobotFiles::close(int file) {
  if (turn(file, 0)) open_[static_cast<std::size_t>(file) - 1].file.reset();
}

std::int64_t RobotFiles::read(int file, void* to, std::int64_t bytes) {
  std::FILE* from = turn(file, 'r');
  if (!from || bytes < 0) return 0;
  return static_cast<std::int64_t>(std::fread(to, 1, static_cast<std::size_t>(bytes), from));
}

std::int64_t RobotFiles::write(int file, const void* from, std::int64_t bytes) {
  std::FILE* to = turn(file, 'w');
  if (!to || bytes < 0 || written_ + bytes > kMostBytes) return -1;
  written_ += bytes;
  return static_cast<std::int64_t>(std::fwrite(from, 1, static_cast<std::size_t>(bytes), to));
}

void RobotFiles::flush(int file) {
  if (std::FILE* open = turn(file, 'w')) std::fflush(open);
}

std::int64_t RobotFiles::seek(int file, std::int64_t offset, int from) {
  std::FILE* open = turn(file, 0);
  if (!open || std::fseek(open, static_cast<long>(offset),
                          from == 1   ? SEEK_CUR
                          : from == 2 ? SEEK_END
                                      : SEEK_SET))
    return -1;
  return std::ftell(open);
}

std::string RobotFiles::path_for_writing(const std::string& name) {
  std::error_code none;
  const fs::path own = own_.empty() ? fs::path() : within(own_, name);
  if (own.empty() || fs::is_directory(own, none)) return "";
  fs::create_directories(own.parent_path(), none);
  made_ = true;
  return own.string();
}

bool RobotFiles::remove(const std::string& name) {
  std::error_code none;
  const fs::path own = within(own_, name);
  return !own.empty() && fs::is_regular_file(own, none) && fs::remove(own, none);
}

}  // namespace board
