// SPDX-License-Identifier: MIT
// The files that `new` and `init` write: tools/templates/SET/..., real files of the product. In their texts
// and names NAME's place is taken by the name that was chosen; "dot_x" becomes ".x", so that the product's
// own tools do not take them for theirs. Lines of licence are left out: what is made belongs to whoever has
// it made.
#pragma once
#include <string>
#include <vector>

namespace tools {

struct TemplateFile {
  std::string name;  ///< below the new folder: ".vscode/tasks.json"
  std::string text;
};

/// The files of a set ("project"), by name; empty, with a line in `problems`, when it cannot be read. `name`
/// stands for @NAME@ in texts and for NAME in names of files; the product's folder for @ROOT@, as in a string
/// of JSON.
std::vector<TemplateFile> read_templates(const std::string& set, const std::string& name,
                                         std::vector<std::string>& problems);

}  // namespace tools
