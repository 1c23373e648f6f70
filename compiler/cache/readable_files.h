// SPDX-License-Identifier: MIT
// Which files a build may read. A submission, such as a student's, is built of its own files: what it names
// elsewhere, by a path or a link, would come into its program, and from there to whoever wrote it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cc {

/// The folder of the submission that is graded, by TWINPUCK_SUBMISSION; empty: there is none.
std::filesystem::path submission();
/// Whether `place` is named below `folder`, or is it; where links lead does not matter.
bool is_named_below(const std::filesystem::path& place, const std::filesystem::path& folder);

class ReadableFiles {
 public:
  /// All.
  ReadableFiles() = default;
  /// Those whose real path is one of `places` or lies below one. The first is the submission's folder; none:
  /// all files.
  explicit ReadableFiles(const std::vector<std::string>& places);

  /// Whether it may be read; also of what is not there.
  bool has(const std::filesystem::path& file) const;
  /// "include: got 'x.h', which lies outside DIR, expected ...", of a file that may not.
  std::string refusal(const std::string& what, const std::string& name) const;
  /// What they were made of.
  const std::vector<std::string>& places() const { return places_; }

 private:
  std::vector<std::string> places_;  // real paths
};

}  // namespace cc
