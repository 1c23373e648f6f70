// SPDX-License-Identifier: MIT
// Folders of C for the compiler, and a bare chip that runs what it makes of them: no robot, no world.
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "compiler/build/build.h"
#include "tests/support/wording.h"

namespace cc_test {

/// A folder below the system's temporary one, removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  std::filesystem::path path;
  /// Writes a file; folders of `name` are made.
  std::filesystem::path file(const std::string& name, const std::string& text) const;
  /// The image that build() makes.
  std::filesystem::path image() const { return path / "prog.elf"; }
};

using Change = std::function<void(cc::BuildOptions&)>;

/// One main.c, in the folder prog/; messages in the result.
cc::BuildResult build(const Folder& folder, const std::string& main_c, const std::string& level = "-O1",
                      const Change& change = {});

/// A folder below it, with the defaults; the image is out.elf. What the program prints then.
cc::BuildResult build_folder(const Folder& folder, const std::string& name);
std::string said(const Folder& folder);

/// What an image prints over UART 1, which is on, until its main() returns or resets, for
/// some seconds at most.
std::string output_of(const std::filesystem::path& image);
/// Of a program that is built first, and must be.
std::string printed_by(const std::string& main_c, const std::string& level = "-O1");

/// All errors, conflicts and warnings as one text.
std::string text_of(const cc::BuildResult& result);
/// wording::reads() where @ is the folder.
inline testing::AssertionResult reads(const Folder& folder, const std::string& said,
                                      const std::string& wanted) {
  return wording::reads(said, wanted, {{folder.path.string(), "@"}});
}

}  // namespace cc_test
