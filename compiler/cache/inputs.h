// SPDX-License-Identifier: MIT
// What a build looks at: files (sources, headers, the library, the compiler), folders (by the names in them)
// and names that were not there.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "readable_files.h"

namespace cc {

/// What is compared first: it changes with every write, whatever the program that writes does to the times.
struct FileState {
  std::int64_t changed_ns = 0;  ///< time of the last change of content or of the entry (ctime); 0: unknown
  std::uint64_t bytes = 0, number = 0;  ///< inode; 0: no such file
  bool operator==(const FileState& o) const {
    return changed_ns == o.changed_ns && bytes == o.bytes && number == o.number;
  }
};

/// Everything that a build looks at, each as it was when it was first looked at. For several threads.
class BuildInputs {
 public:
  struct Input {
    FileState state;   ///< changed_ns is 0 where a change in the same instant would not show
    std::string hash;  ///< of the content, of a folder's names; "gone": there is nothing
  };

  /// Hash of what lies at `path`. `since_ns`: when its reader began; what changed after that, nobody knows.
  std::string look_at(const std::filesystem::path& path, std::int64_t since_ns = INT64_MAX);
  /// Content of a file.
  std::string read(const std::filesystem::path& path);
  /// What may be read; of other files there is no content.
  ReadableFiles readable;
  /// A file that the build needs and may not read.
  void refuse(const std::filesystem::path& file, const std::string& what);
  /// What was said of them.
  std::vector<std::string> refusals() const;

  /// By absolute path.
  std::map<std::string, Input> all;

  /// An object or archive of a cache that the build goes on with.
  void take(const std::filesystem::path& file);
  /// Whether one of them is gone, as when a user removes the cache while builds run.
  bool has_lost_one() const;

 private:
  std::vector<std::filesystem::path> taken_;
  std::vector<std::string> refusals_;
  mutable std::mutex mutex_;
};

/// While this lives, what its thread looks at is noted in `inputs`.
class NotingInputs {
 public:
  explicit NotingInputs(BuildInputs& inputs);
  ~NotingInputs();
  NotingInputs(const NotingInputs&) = delete;

 private:
  BuildInputs* before_;
};
/// The inputs of this thread's build; null outside of builds.
BuildInputs* inputs_of_build();
/// Notes a file, a folder or a name that may not be there.
void look_at(const std::filesystem::path& path);
/// Whether this thread's build may read what lies there.
bool may_read(const std::filesystem::path& path);

/// The clock of FileState.
std::int64_t now_ns();

/// What lies at `path` now, 0 where nothing does.
FileState state_of(const std::string& path);
/// Its hash: of a folder that of the names in it, "gone" where nothing is.
std::string hash_at(const std::string& path, const FileState& state);
/// The state, without its time when the file is so young that the time does not tell two contents apart.
FileState settled(FileState state);

}  // namespace cc
