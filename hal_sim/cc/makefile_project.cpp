// SPDX-License-Identifier: MIT
// See makefile_project.h.
#include "makefile_project.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "build_record.h"
#include "library_copies.h"
#include "object_cache.h"
#include "sim_core/base/pattern.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> words_of(const std::string& text, const std::string& separators = " \t") {
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(separators, at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

constexpr std::size_t kLongestName = 4096;  // bytes of a path, as Linux takes it

class Makefile {
 public:
  explicit Makefile(const fs::path& file) : home_(file.parent_path()) { read(file); }

  /// The value of a variable, with all others in it replaced.
  std::string value(const std::string& name) const { return expand(raw(name), 0); }
  const std::map<std::string, std::string>& variables() const { return variables_; }
  const std::string& source_folders() const { return source_folders_; }  ///< of `vpath` lines

 private:
  static constexpr int kDeepest = 20;              // variables in variables
  static constexpr std::size_t kMost = 1'000'000;  // characters that all values may grow to, each $( one more
  static constexpr std::size_t kFolder = 100;      // a folder read for $(wildcard) counts like so many

  std::string raw(const std::string& name) const {
    const auto found = variables_.find(name);
    return found == variables_.end() ? "" : found->second;
  }

  /// Reads a file, but none twice: one that includes itself would never end.
  void read(const fs::path& file) {
    std::error_code ec;
    look_at(file);
    if (!fs::is_regular_file(file, ec) || !read_.insert(fs::canonical(file, ec)).second) return;
    static const sim::Pattern kAssignment(R"(^\s*(?:export\s+|override\s+)?([\w.-]+)\s*([:?+]?:?=)\s*(.*)$)");
    static const sim::Pattern kContinued(R"(\\\r?\n[ \t]*)"), kComment(R"((^|[^\\])#.*$)");
    std::istringstream lines(std::regex_replace(read_text(file), kContinued, " "));
    for (std::string line; std::getline(lines, line);) {
      if (!line.empty() && line[0] == '\t' && line.find('=') == std::string::npos) continue;  // of a recipe
      line = std::regex_replace(line, kComment, "$1");
      while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back()))) line.pop_back();
      std::smatch m;
      if (std::regex_match(line, m, kAssignment)) {
        std::string& kept = variables_[m[1]];
        if (m[2] == "+=")
          kept += " " + m[3].str();
        else if (m[2] == ":=")
          kept = expand(m[3], 0);
        else if (m[2] != "?=" || kept.empty())
          kept = m[3];
      } else if (line.rfind("vpath ", 0) == 0) {
        const auto words = words_of(expand(line, 0));
        for (std::size_t i = 2; i < words.size(); ++i) source_folders_ += words[i] + " ";
      } else if (line.rfind("include ", 0) == 0 || line.rfind("-include ", 0) == 0) {
        for (const std::string& name : words_of(expand(line.substr(line.find(' ')), 0))) read(home_ / name);
      }
    }
  }

  std::string expand(const std::string& text, int depth) const {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] != '$' || i + 1 == text.size()) {
        out += text[i];
        continue;
      }
      const char open = text[++i];
      if (open != '(' && open != '{') continue;  // $@ and the like, of recipes
      int level = 1;
      std::size_t end = i + 1;
      for (; end < text.size() && level; ++end)
        level += text[end] == open ? 1 : text[end] == (open == '(' ? ')' : '}') ? -1 : 0;
      if (depth < kDeepest && ++grown_ < kMost) out += reference(text.substr(i + 1, end - i - 2), depth);
      i = end - 1;
    }
    grown_ += out.size();
    return out;
  }

  /// What stands between $( and ).
  std::string reference(const std::string& inside, int depth) const {
    if (inside.rfind("wildcard ", 0) == 0) return wildcard(expand(inside.substr(9), depth + 1));
    static const sim::Pattern kReplaced(R"(^([\w.-]+):(%?)(\.\w+)=(%?)(\.\w+)$)");
    std::smatch m;
    if (!std::regex_match(inside, m, kReplaced)) return expand(raw(inside), depth + 1);
    std::string out;
    for (std::string word : words_of(expand(raw(m[1]), depth + 1))) {
      const std::string from = m[3];
      if (word.size() >= from.size() && word.compare(word.size() - from.size(), from.size(), from) == 0)
        word.replace(word.size() - from.size(), from.size(), m[5]);
      out += word + " ";
    }
    return out;
  }

  /// Files of a pattern with * in its last part.
  std::string wildcard(const std::string& patterns) const {
    std::string out;
    for (const std::string& pattern : words_of(patterns)) {
      if ((grown_ += kFolder) > kMost || pattern.size() > kLongestName) continue;
      const fs::path folder = fs::path(pattern).parent_path();
      std::string form;
      for (char c : fs::path(pattern).filename().string())
        form += c == '*'                                      ? std::string(".*")
                : std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c)
                                                              : std::string("\\") + c;
      const sim::Pattern matches(form);
      std::vector<std::string> names;
      std::error_code ec;
      look_at(home_ / folder);
      for (fs::directory_iterator it(home_ / folder, ec), end; !ec && it != end; it.increment(ec))
        if (const std::string name = it->path().filename().string(); std::regex_match(name, matches))
          names.push_back((folder / name).string());
      std::sort(names.begin(), names.end());
      for (const std::string& name : names) out += name + " ";
    }
    return out;
  }

  fs::path home_;
  std::map<std::string, std::string> variables_;
  std::string source_folders_;
  std::set<fs::path> read_;
  mutable std::size_t grown_ = 0;
};

}  // namespace

std::optional<MplabProject> read_makefile(const fs::path& folder) {
  const fs::path home = fs::absolute(folder).lexically_normal();
  std::error_code ec;
  look_at(home);
  fs::path file;
  for (const char* name : {"Makefile", "makefile", "GNUmakefile"})
    if (file.empty() && fs::is_regular_file(home / name, ec)) file = home / name;
  if (file.empty()) return std::nullopt;
  const Makefile makefile(file);
  MplabProject project;
  project.file = file;

  std::vector<fs::path> places = {home};
  for (const std::string& name : words_of(makefile.value("VPATH") + " " + makefile.source_folders(), " \t:;"))
    if (const fs::path found = resolve_path(home, name).lexically_normal();
        fs::is_directory(found, ec) && std::find(places.begin(), places.end(), found) == places.end())
      places.push_back(found);
  static const sim::Pattern kSources(R"((C_?)?(SRCS?|SOURCES?)(_C|_FILES)?|\w*OBJ(S|ECTS)?)",
                                     std::regex::icase);
  static const sim::Pattern kOptions(R"(\w*(C(PP)?FLAGS|INCLUDES?|INC|DEFS|DEFINES)\w*)", std::regex::icase);
  static const sim::Pattern kFolders("INC_?DIRS?|INCLUDE_?DIRS?", std::regex::icase);  // without -I
  std::string options;
  std::set<std::string> words;  // of all lists of sources
  for (const auto& [name, raw] : makefile.variables()) {
    if (std::regex_match(name, kFolders))
      for (const std::string& word : words_of(makefile.value(name)))
        if (word[0] != '-') options += "-I" + word + " ";
    if (std::regex_match(name, kOptions)) options += makefile.value(name) + " ";
    if (!std::regex_match(name, kSources)) continue;
    for (std::string word : words_of(makefile.value(name))) {
      if (!words.insert(word).second) continue;
      if (word.size() > 2 && word.compare(word.size() - 2, 2, ".o") == 0) word.back() = 'c';
      if (word.size() <= 2 || word.compare(word.size() - 2, 2, ".c") != 0) continue;
      const auto known = [&](const fs::path& source) {
        return std::find(project.sources.begin(), project.sources.end(), source) != project.sources.end();
      };
      bool is_found = false;
      for (const fs::path& place : places) {
        const fs::path found = resolve_path(place, word).lexically_normal();
        if (is_found || found.empty() || !fs::is_regular_file(found, ec)) continue;
        is_found = true;
        if (!known(found)) project.sources.push_back(found);
      }
      if (!is_found && !library_place(word).empty()) project.library_places.push_back(library_place(word));
    }
  }
  const CompilerOptions found = compiler_options(options);
  project.defines = found.defines;
  project.standard = found.standard;
  for (const std::string& name : found.include_dirs)
    if (const fs::path at = resolve_path(home, name).lexically_normal(); fs::is_directory(at, ec))
      if (std::find(project.include_dirs.begin(), project.include_dirs.end(), at) ==
          project.include_dirs.end())
        project.include_dirs.push_back(at);
  return project;
}

}  // namespace cc
