// SPDX-License-Identifier: MIT
// What came of a build, with what it looked at (compiler/cache/inputs.h): as long as none of that has
// changed, the next build of the same program has nothing to do.
#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "compiler/cache/inputs.h"
#include "compiler/cache/options.h"

namespace cc {

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
