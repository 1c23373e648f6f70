// SPDX-License-Identifier: MIT
// See cache_bound.h.
#include "install/cache_bound.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "install/places.h"

namespace places {

namespace fs = std::filesystem;

namespace {

constexpr std::time_t kInUseS = 600;       // longer than the longest step of a build
constexpr std::time_t kAbandonedS = 3600;  // of a build's unfinished files
constexpr std::time_t kBetweenS = 60;      // looks at the caches
constexpr std::time_t kUsedS = 3600;       // between two notes that a file is used

/// What goes or stays as a whole.
struct Entry {
  fs::path path;
  std::uint64_t bytes = 0;
  std::time_t used = 0;
};

bool is_unfinished(const std::string& name) {
  return name.find(".half") != std::string::npos || name.rfind("build.", 0) == 0;
}

void add(Entry& entry, const struct stat& s) {
  entry.bytes += std::uint64_t(s.st_blocks) * 512;
  entry.used = std::max({entry.used, s.st_mtime, s.st_atime});
}

void look_below(const fs::path& folder, std::vector<Entry>& entries) {
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end; it.increment(none)) {
    struct stat s;
    if (lstat(it->path().c_str(), &s) != 0) continue;  // somebody else has removed it
    const std::string name = it->path().filename().string();
    Entry entry{it->path(), 0, 0};
    if (!S_ISDIR(s.st_mode)) {
      add(entry, s);
      if (S_ISREG(s.st_mode)) entries.push_back(entry);
    } else if (it->path().extension() == ".classes" || is_unfinished(name)) {
      entry.used = s.st_mtime;
      std::error_code odd;
      for (fs::recursive_directory_iterator in(it->path(), odd), over; !odd && in != over; in.increment(odd))
        if (lstat(in->path().c_str(), &s) == 0) add(entry, s);
      entries.push_back(entry);
    } else {
      look_below(it->path(), entries);
    }
  }
}

}  // namespace

std::uint64_t keep_within(const fs::path& folder, std::uint64_t bytes) {
  std::vector<Entry> entries;
  look_below(folder, entries);
  const std::time_t now = std::time(nullptr);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.used != b.used ? a.used < b.used : a.path < b.path;
  });
  std::uint64_t all = 0;
  for (const Entry& entry : entries) all += entry.bytes;
  // some room for what comes next, or each build would look for what can go
  const std::uint64_t wanted = all > bytes ? bytes - bytes / 5 : bytes;
  for (const Entry& entry : entries) {
    const bool is_left = is_unfinished(entry.path.filename().string()) && now - entry.used > kAbandonedS;
    if (!is_left && (all <= wanted || now - entry.used < kInUseS)) continue;
    std::error_code failed;
    fs::remove_all(entry.path, failed);
    if (!failed) all -= entry.bytes;
  }
  return all;
}

/// MB, 0: not said, or what is said is none, which `wrong` says.
static std::uint64_t said_mb(std::string& wrong) {
  const char* const said = std::getenv("TWINPUCK_CACHE_MB");
  const std::string text = said ? said : "";
  const bool is_number = text.size() < 8 && text.find_first_not_of("0123456789") == std::string::npos;
  const std::uint64_t mb = is_number && !text.empty() ? std::stoull(text) : 0;
  if (!text.empty() && mb == 0) wrong = "TWINPUCK_CACHE_MB: got '" + text + "', expected 1 to 9999999 MB";
  return mb;
}

std::string wrong_cache_bound() {
  std::string wrong;
  said_mb(wrong);
  return wrong;
}

void keep_caches_within_bound() {
  const fs::path top = cache_folder("");
  const int stamp = open((top / "bounded").c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (stamp < 0) return;
  struct stat s;
  // an empty stamp has just been made; one that somebody holds is being seen to
  const bool is_due =
      fstat(stamp, &s) == 0 && (s.st_size == 0 || std::abs(std::time(nullptr) - s.st_mtime) >= kBetweenS);
  if (is_due && flock(stamp, LOCK_EX | LOCK_NB) == 0) {
    std::string wrong;
    const std::uint64_t mb = said_mb(wrong);
    if (pwrite(stamp, "\n", 1, 0) == 1) futimens(stamp, nullptr);
    keep_within(top, mb ? mb << 20 : kMostCacheBytes);
  }
  close(stamp);
}

void note_used(const fs::path& file) {
  struct stat s;
  if (stat(file.c_str(), &s) != 0 || std::time(nullptr) - std::max(s.st_atime, s.st_mtime) < kUsedS) return;
  utimensat(AT_FDCWD, file.c_str(), nullptr, 0);
}

}  // namespace places
