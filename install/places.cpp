// SPDX-License-Identifier: MIT
// See places.h.
#include "install/places.h"

#include <fcntl.h>
#include <link.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace places {

namespace fs = std::filesystem;

namespace {

constexpr int kDeepest = 5;  // folders between a program and the top of its tree, at most
constexpr std::uint64_t kLeastFreeBytes = std::uint64_t{16} << 20;  // of a disk that is taken for a cache
constexpr std::uint64_t kFullBytes = std::uint64_t{1} << 20;        // less than any build leaves

/// The file that holds this code: a program, or a library that another program has loaded.
fs::path own_file() {
  struct Asked {
    std::uintptr_t address;
    std::string name;
  } asked{reinterpret_cast<std::uintptr_t>(&own_file), ""};
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* data) {
        auto& a = *static_cast<Asked*>(data);
        for (int i = 0; i < object->dlpi_phnum; ++i) {
          const auto& part = object->dlpi_phdr[i];
          const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
          if (part.p_type != PT_LOAD || a.address < begin || a.address >= begin + part.p_memsz) continue;
          a.name = object->dlpi_name;
          return 1;
        }
        return 0;
      },
      &asked);
  std::error_code none;
  if (asked.name.empty()) return fs::read_symlink("/proc/self/exe", none);
  return fs::canonical(asked.name, none);
}

struct Tree {
  fs::path share, tools, command;
  bool is_installed = false;
};

bool is_share(const fs::path& folder) {
  std::error_code none;
  return fs::is_directory(folder / "firmware" / "include", none);
}

/// The tree that a file is part of; `share` is empty when it is part of none.
Tree tree_of(const fs::path& file) {
  fs::path at = file.parent_path();
  for (int depth = 0; depth < kDeepest && at.has_relative_path(); ++depth, at = at.parent_path()) {
    std::string clone;
    if (std::ifstream said(at / "clone.txt"); std::getline(said, clone))
      if (const fs::path share = (at / clone).lexically_normal(); is_share(share))
        return {share.has_filename() ? share : share.parent_path(), at, at / "twinpuck", false};
    std::error_code none;
    if (is_share(at / "share" / "twinpuck") && fs::exists(at / "lib" / "twinpuck" / "twinpuck-cc", none))
      return {at / "share" / "twinpuck", at / "lib" / "twinpuck", at / "bin" / "twinpuck", true};
  }
  return {};
}

/// The file that `twinpuck` means on PATH.
fs::path command_on_path() {
  const char* const path = std::getenv("PATH");
  std::string folders = path ? path : "/usr/local/bin:/usr/bin";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const fs::path file = fs::path(folders.substr(begin, end - begin)) / "twinpuck";
    std::error_code none;
    if (end > begin && fs::is_regular_file(file, none) && access(file.c_str(), X_OK) == 0)
      return fs::canonical(file, none);
    begin = end + 1;
  }
  return {};
}

const Tree& tree() {
  static const Tree found = [] {
    Tree own = tree_of(own_file());
    // a copy of the library elsewhere, as in a virtual environment of Python
    return own.share.empty() ? tree_of(command_on_path()) : own;
  }();
  return found;
}

bool make_folder(const fs::path& folder) {
  std::error_code none;
  if (fs::is_directory(folder, none)) return true;
  if (folder.has_relative_path() && !make_folder(folder.parent_path())) return false;
  return mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST;
}

std::uint64_t free_bytes(const fs::path& folder) {
  struct statvfs disk;
  return statvfs(folder.c_str(), &disk) == 0 ? std::uint64_t(disk.f_bavail) * disk.f_frsize : UINT64_MAX;
}

/// Whether the user owns `folder`, which is made if need be, may write there, and has room there.
bool is_ours(const fs::path& folder, bool among_others) {
  struct stat s;
  // root with a user's HOME, as under sudo, leaves nothing behind there that the user cannot write to
  if (geteuid() == 0 && !among_others) {
    fs::path at = folder;
    while (stat(at.c_str(), &s) != 0 && at.has_relative_path()) at = at.parent_path();
    if (stat(at.c_str(), &s) != 0 || s.st_uid != 0) return false;
  }
  if (!make_folder(folder)) return false;
  // what lies where everybody may write can be somebody else's link
  if ((among_others ? lstat(folder.c_str(), &s) : stat(folder.c_str(), &s)) != 0) return false;
  if (!S_ISDIR(s.st_mode) || s.st_uid != geteuid()) return false;
  if (among_others && (s.st_mode & 022) != 0) return false;
  if (free_bytes(folder) < kLeastFreeBytes) return false;
  return faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0;
}

}  // namespace

fs::path share_root() {
  const char* const root = std::getenv("TWINPUCK_ROOT");
  return root && *root ? fs::path(root) : tree().share;
}

fs::path product_share() { return tree().share; }
fs::path tools_folder() { return tree().tools; }
fs::path page_folder() { return tree().tools / "page"; }
fs::path command_file() { return tree().command; }
bool is_installed() { return tree().is_installed; }

fs::path cache_folder(const std::string& name) {
  const char* const xdg = std::getenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  std::error_code none;
  fs::path temporary = fs::temp_directory_path(none);
  if (none) temporary = "/tmp";  // TMPDIR says a folder that is not there
  std::vector<fs::path> candidates;
  if (xdg && *xdg == '/') candidates.push_back(fs::path(xdg) / "twinpuck");
  if (home && *home == '/') candidates.push_back(fs::path(home) / ".cache" / "twinpuck");
  candidates.push_back(temporary / ("twinpuck-" + std::to_string(geteuid())));
  for (const fs::path& candidate : candidates)
    if (is_ours(candidate, candidate == candidates.back()) && make_folder(candidate / name))
      return candidate / name;
  return candidates.front() / name;
}

std::string why_not_writable(const fs::path& folder) {
  errno = 0;
  const bool is_writable =
      make_folder(folder) && faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) == 0;
  const std::string got = !is_writable                      ? std::strerror(errno ? errno : ENOTDIR)
                          : free_bytes(folder) < kFullBytes ? std::strerror(ENOSPC)
                                                            : "";
  if (got.empty()) return "";
  return folder.string() + ": cache: got " + got +
         ", expected a folder that can be written; set XDG_CACHE_HOME to one";
}

}  // namespace places
