// SPDX-License-Identifier: MIT
// See sources.h.
#include "sources.h"

#include <algorithm>
#include <set>

namespace programs {
namespace {

struct Source {
  fs::path file;  // absolute
  bool has_main = false;
};

/// main() in the text itself, or in C that it includes as text, here or elsewhere.
bool has_main(const fs::path& file, const std::string& text, int depth = 0) {
  constexpr int kDeepest = 4;
  if (defines_main(without_comments(text))) return true;
  if (depth == kDeepest) return false;
  for (const std::string& name : includes_of(text))
    if (const fs::path other = resolve(file.parent_path(), name);
        !other.empty() && (is_c(other) || is_cxx(other)) && other != file &&
        has_main(other, text_of(other), depth + 1))
      return true;
  return false;
}

/// All sources below a folder, but for those that another one includes as text.
std::vector<Source> sources_below(const fs::path& folder) {
  std::vector<Source> sources;
  std::set<fs::path> included;
  for (const fs::path& file : files_below(folder)) {
    const bool is_source = is_c(file) || is_cxx(file);
    if (!is_source && !is_header(file)) continue;
    const std::string text = text_of(file);
    if (is_source && text.find("tests/support/firmware_test.h") != std::string::npos) continue;
    for (const std::string& name : includes_of(text))
      if (const fs::path other = resolve(file.parent_path(), name);
          !other.empty() && (is_c(other) || is_cxx(other)) && other.lexically_normal() != file)
        included.insert(other.lexically_normal());
    if (is_source) sources.push_back({file, has_main(file, text)});
  }
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                               [&](const Source& s) { return included.count(s.file) != 0; }),
                sources.end());
  return sources;
}

/// The file with main() that is the folder's program.
const Source* main_of(const std::vector<Source>& sources, const fs::path& folder) {
  std::vector<const Source*> mains;
  for (const Source& source : sources)
    if (source.has_main) mains.push_back(&source);
  if (mains.size() == 1) return mains[0];
  auto names = names_of(folder);
  names.insert(names.end(), {"main", "controller"});
  for (const std::string& name : names) {
    const Source* found = nullptr;
    for (const Source* main : mains)
      if (lower_case(main->file.stem().string()) == lower_case(name) &&
          (!found || std::distance(main->file.begin(), main->file.end()) <
                         std::distance(found->file.begin(), found->file.end())))
        found = main;
    if (found) return found;
  }
  // the one that lies nearest to the folder
  const auto depth = [](const Source* s) { return std::distance(s->file.begin(), s->file.end()); };
  std::stable_sort(mains.begin(), mains.end(), [&](auto a, auto b) { return depth(a) < depth(b); });
  return mains.size() > 1 && depth(mains[0]) < depth(mains[1]) ? mains[0] : nullptr;
}

}  // namespace

std::vector<std::vector<fs::path>> source_lists(const Found& found, const MakeSays& says,
                                                const std::string& said, std::vector<std::string>& problems) {
  if (!found.main.empty()) return {{found.main.filename()}};
  const auto from_folder = [&](const fs::path& file) { return file.lexically_relative(found.folder); };
  if (!says.sources.empty()) {
    std::vector<fs::path> named;
    for (const std::string& word : says.sources) {
      const fs::path file = resolve(found.folder, word);
      if (file.empty())
        problems.push_back(makefile_of(found.folder).string() + ": sources: got " + word +
                           ", which is not there, expected a file");
      else
        named.push_back(from_folder(file.lexically_normal()));
    }
    if (!problems.empty()) return {};
    return {named};
  }
  const auto sources = sources_below(found.folder);
  const Source* main = main_of(sources, found.folder);
  if (!main) {
    std::string names;
    for (const Source& source : sources)
      if (source.has_main) names += (names.empty() ? "" : ", ") + from_folder(source.file).string();
    problems.push_back(
        said + ": controller: got " + (names.empty() ? "no main()" : "main() in each of " + names) +
        ", expected one, in a file that is named as the folder: " + names_of(found.folder)[0] + ".c");
    return {};
  }
  std::vector<fs::path> all, alone = {from_folder(main->file)};
  for (const Source& source : sources)
    if (&source == main || !source.has_main) all.push_back(from_folder(source.file));
  if (all.size() == 1) return {all};
  const auto names = names_of(found.folder);
  const bool is_named = std::find(names.begin(), names.end(), main->file.stem().string()) != names.end();
  if (says.is_webots && is_named) return {alone, all};
  return is_named ? std::vector<std::vector<fs::path>>{all, alone} : std::vector<std::vector<fs::path>>{all};
}

}  // namespace programs
