// SPDX-License-Identifier: MIT
// What a build looked at, and what came of it: as long as none of that has changed, the next build of the
// same program has nothing to do. Looked at are files (sources, headers, the library, the compiler), folders
// (by the names in them) and names that were not there.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "build.h"

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
  /// By absolute path.
  std::map<std::string, Input> all;

 private:
  std::mutex mutex_;
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

/// The clock of FileState.
std::int64_t now_ns();

/// A file beside the cached objects, one per image.
class BuildRecord {
 public:
  explicit BuildRecord(const BuildOptions& options);
  /// The result of the last build with these options, when it would come out the same.
  std::optional<BuildResult> recall() const;
  std::filesystem::path lock_file() const { return file_.string() + ".lock"; }
  void keep(const BuildResult& result, const std::map<std::string, BuildInputs::Input>& inputs) const;

 private:
  std::string question_;  // all that the result hangs on beside the inputs
  std::filesystem::path file_;
};

}  // namespace cc
