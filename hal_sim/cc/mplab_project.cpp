// SPDX-License-Identifier: MIT
#include "mplab_project.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>
#include <string>

#include "library_copies.h"
#include "object_cache.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What `name` is called in `folder` whatever its case, or an empty path.
fs::path entry_of(const fs::path& folder, const std::string& name) {
  std::error_code ec;
  if (name == "." || name == "..") return folder / name;
  if (fs::exists(folder / name, ec)) return folder / name;
  for (fs::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec))
    if (lower_case(it->path().filename().string()) == lower_case(name)) return it->path();
  return {};
}

fs::path below(const fs::path& folder, const std::vector<std::string>& parts, std::size_t first) {
  fs::path at = folder;
  for (std::size_t i = first; i < parts.size() && !at.empty(); ++i) at = entry_of(at, parts[i]);
  return at;
}

/// The file or folder that a project in `home` means by `text`, or an empty path.
fs::path resolve(const fs::path& home, std::string text) {
  std::replace(text.begin(), text.end(), '\\', '/');
  const bool is_absolute = text.size() > 1 && (text[0] == '/' || text[1] == ':');
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, '/');)
    if (!part.empty() && part.back() != ':') parts.push_back(part);
  if (parts.empty()) return {};
  if (!is_absolute) return below(home, parts, 0);
  constexpr int kAncestors = 3;
  for (std::size_t first = 0; first < parts.size(); ++first) {
    fs::path at = home;
    for (int up = 0; up <= kAncestors; ++up, at = at.parent_path())
      if (fs::path found = below(at, parts, first); !found.empty()) return found;
  }
  return {};
}

/// The values of "key=value" lines of one section.
std::vector<std::string> values_of(const std::string& text, const std::string& section,
                                   const std::string& key) {
  std::vector<std::string> values;
  std::istringstream lines(text);
  bool is_inside = false;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
    if (line.rfind("[", 0) == 0) is_inside = line == "[" + section + "]";
    const std::size_t sign = line.find('=');
    if (is_inside && sign != std::string::npos && line.rfind(key, 0) == 0)
      values.push_back(line.substr(sign + 1));
  }
  return values;
}

struct Listed {
  std::vector<std::string> files, include_dirs;  // as written; folders separated by ';'
};

Listed read_mcp(const std::string& text) {
  return {values_of(text, "FILE_INFO", "file_"), values_of(text, "PATH_INFO", "dir_inc")};
}

Listed read_configurations(const std::string& text) {
  Listed listed;
  static const std::regex kItem(R"(<itemPath>([^<]+)</itemPath>)");
  static const std::regex kExcluded(R"re(<item path="([^"]+)" ex="true")re");
  static const std::regex kInclude(R"re(key="extra-include-directories"\s+value="([^"]*)")re");
  std::vector<std::string> excluded;
  for (std::sregex_iterator it(text.begin(), text.end(), kExcluded), end; it != end; ++it)
    excluded.push_back((*it)[1]);
  for (std::sregex_iterator it(text.begin(), text.end(), kItem), end; it != end; ++it)
    if (std::find(excluded.begin(), excluded.end(), (*it)[1]) == excluded.end())
      listed.files.push_back((*it)[1]);
  for (std::sregex_iterator it(text.begin(), text.end(), kInclude), end; it != end; ++it)
    listed.include_dirs.push_back((*it)[1]);
  return listed;
}

/// A project and its home: the folder that its relative paths start from.
std::optional<MplabProject> read_project(const fs::path& file, const fs::path& home) {
  const std::string text = read_text(file);
  const Listed listed =
      lower_case(file.extension().string()) == ".mcp" ? read_mcp(text) : read_configurations(text);
  MplabProject project{file, {}, {}};
  bool has_main = false;
  std::error_code ec;
  for (const std::string& name : listed.files) {
    const fs::path found = resolve(home, name).lexically_normal();
    if (lower_case(found.extension().string()) != ".c" || !fs::is_regular_file(found, ec)) continue;
    if (std::find(project.sources.begin(), project.sources.end(), found) != project.sources.end()) continue;
    project.sources.push_back(found);
    has_main = has_main || defines_main(found);
  }
  if (!has_main) return std::nullopt;
  for (const std::string& list : listed.include_dirs) {
    std::istringstream in(list);
    for (std::string name; std::getline(in, name, ';');) {
      const fs::path found = resolve(home, name).lexically_normal();
      if (!found.empty() && fs::is_directory(found, ec)) project.include_dirs.push_back(found);
    }
  }
  return project;
}

}  // namespace

bool defines_main(const fs::path& source) {
  static const std::regex kMain(R"(\bmain\s*\([^;{)]*\)\s*\{)");
  return std::regex_search(without_comments(read_text(source)), kMain);
}

std::optional<MplabProject> find_mplab_project(const fs::path& folder) {
  const fs::path home = fs::absolute(folder).lexically_normal();
  std::vector<std::pair<fs::path, fs::path>> files;  // project, its home
  const auto add_configurations = [&](const fs::path& place) {
    const fs::path file = place / "nbproject/configurations.xml";
    std::error_code ec;
    if (fs::is_regular_file(file, ec)) files.emplace_back(file, place);
  };
  add_configurations(home);
  std::error_code ec;
  for (fs::directory_iterator it(home, ec), end; !ec && it != end; it.increment(ec)) {
    const std::string extension = lower_case(it->path().extension().string());
    if (extension == ".mcp" && it->is_regular_file()) files.emplace_back(it->path(), home);
    if (extension == ".x" && it->is_directory()) add_configurations(it->path());
  }
  std::sort(files.begin(), files.end());
  std::optional<MplabProject> only;
  for (const auto& [file, at] : files) {
    auto project = read_project(file, at);
    if (!project) continue;
    auto sorted = [](std::vector<fs::path> list) {
      std::sort(list.begin(), list.end());
      return list;
    };
    // one program may have a project for each version of MPLAB
    if (only && sorted(only->sources) != sorted(project->sources)) return std::nullopt;
    if (!only) only = project;
  }
  return only;
}

}  // namespace cc
