// SPDX-License-Identifier: MIT
// Objects kept between builds. An object is reused when its source, every header it read, its flags and the
// compiler are what they were.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "child_process.h"

namespace cc {

/// A short name for a content; equal contents give equal names.
std::string content_hash(const std::string& bytes);
std::string bytes_of(const std::filesystem::path& path);
/// The same, noted as an input of this thread's build.
std::string read_text(const std::filesystem::path& path);
/// A name beside `path` that no other thread or process writes to, for what is not whole yet.
std::filesystem::path unfinished(const std::filesystem::path& path);

/// One at a time, among threads and processes: the file is made, and stays.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& file);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  /// Whether the file was removed since, as with its whole folder; then others may hold another.
  bool is_gone() const;

 private:
  int file_;
};

/// Through a temporary file, so that a reader never sees half of it. False when the disk refuses.
bool write_text(const std::filesystem::path& path, const std::string& text);

struct CompileJob {
  std::filesystem::path source;
  std::vector<std::string> flags;
  std::string salt = {};          // anything else the result hangs on
  std::string listed_below = {};  // a folder of which the salt says which headers there are
  /// A folder that may lie elsewhere when the object is used: what is below it is told, in the object
  /// too, as below `called`.
  std::string home = {}, called = {};
  bool has_facts = false;  // the compiler tells what the file does with addresses (shared_variables.h)
};

struct CompileOutcome {
  bool ok = false, reused = false;
  std::filesystem::path source, object;  ///< an object's name tells its content: no other comes in its place
  std::string messages;
  std::string facts;
};

/// Where objects are looked for.
struct ObjectFolders {
  std::filesystem::path cache;  ///< and where those are put that are compiled; it is made if need be
  std::filesystem::path ready;  ///< first, and never written to; empty: none
};

/// All jobs, at most `parallel` at once; outcomes in the order of the jobs. Within a build (build_record.h).
std::vector<CompileOutcome> compile_all(const std::vector<CompileJob>& jobs,
                                        const std::filesystem::path& compiler, const ObjectFolders& folders,
                                        int parallel);

}  // namespace cc
