// SPDX-License-Identifier: MIT
#include "tools/templates.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "install/places.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

std::string replace_all(std::string text, const std::string& key, const std::string& value) {
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size()))
    text.replace(at, key.size(), value);
  return text;
}

/// As it stands between the quotes of a string of JSON or YAML.
std::string quoted(const std::string& text) {
  return replace_all(replace_all(text, "\\", "\\\\"), "\"", "\\\"");
}

std::string text_for(std::istream& in, const std::string& name, const std::string& root) {
  std::string text;
  for (std::string line; std::getline(in, line);)
    if (line.find("SPDX-License-Identifier") == std::string::npos) text += line + "\n";
  return replace_all(replace_all(text, "@NAME@", name), "@ROOT@", root);
}

std::string name_for(const fs::path& path, const std::string& name) {
  fs::path made;
  for (const fs::path& part : path) {
    const std::string word = replace_all(part.string(), "NAME", name);
    made /= word.rfind("dot_", 0) == 0 ? "." + word.substr(4) : word;
  }
  return made.string();
}

}  // namespace

std::vector<TemplateFile> read_templates(const std::string& set, const std::string& name,
                                         std::vector<std::string>& problems) {
  std::error_code none;
  const fs::path root = fs::weakly_canonical(places::share_root(), none),
                 home = root / "tools" / "templates" / set;
  std::vector<TemplateFile> files;
  std::error_code wrong;
  for (fs::recursive_directory_iterator it(home, wrong), end; !wrong && it != end; it.increment(wrong)) {
    if (!it->is_regular_file(none)) continue;
    std::ifstream in(it->path());
    files.push_back(
        {name_for(it->path().lexically_relative(home), name), text_for(in, name, quoted(root.string()))});
  }
  if (files.empty())
    problems.push_back(home.string() + ": templates: cannot be read" + (wrong ? ": " + wrong.message() : "") +
                       "; is Twinpuck installed as a whole?");
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return files;
}

}  // namespace tools
