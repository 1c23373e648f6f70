// SPDX-License-Identifier: MIT
// See makefile_project.h.
#include "makefile_project.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "compiler/cache/inputs.h"
#include "compiler/cache/object_cache.h"
#include "library_copies.h"
#include "program_files.h"
#include "sim_core/base/pattern.h"
#include "sim_core/base/words.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

bool ends_with(const std::string& text, const char* tail) {
  const std::size_t length = std::char_traits<char>::length(tail);
  return text.size() >= length && lower(text.substr(text.size() - length)) == tail;
}

constexpr std::size_t kLongestName = 4096;  // bytes of a path, as Linux takes it

class Makefile {
 public:
  explicit Makefile(const fs::path& file) : home_(file.parent_path()) { read(file); }

  /// The value of a variable, with all others in it replaced.
  std::string value(const std::string& name) const { return expand(raw(name), 0); }
  const std::map<std::string, std::string>& variables() const { return variables_; }
  const std::string& source_folders() const { return source_folders_; }  ///< of `vpath` lines
  /// What each target that is linked is made of, in the order of the file: words of its rules.
  std::vector<std::vector<std::string>> linked() const {
    std::vector<std::vector<std::string>> lists;
    for (const auto& [target, sources] : rules_) {
      const std::string made = expand(target, 0);
      const bool is_step = made.find('%') != std::string::npos || ends_with(made, ".o") || made[0] == '.';
      if (!is_step) lists.push_back(sim::words_of(expand(sources, 0)));
    }
    return lists;
  }

 private:
  static constexpr int kDeepest = 20;              // variables in variables
  static constexpr std::size_t kMost = 1'000'000;  // characters that all values may grow to, each $( one more
  static constexpr std::size_t kLongestReference = 20'000;  // characters between $( and )
  static constexpr std::size_t kFolder = 100;  // a folder read for $(wildcard) counts like so many

  std::string raw(const std::string& name) const {
    const auto found = variables_.find(name);
    return found == variables_.end() ? "" : found->second;
  }

  /// Reads a file, but none twice: one that includes itself would never end.
  void read(const fs::path& file) {
    std::error_code ec;
    look_at(file);
    if (!fs::is_regular_file(file, ec) || !read_.insert(fs::canonical(file, ec)).second) return;
    if (!may_read(file)) return inputs_of_build()->refuse(file, "makefile");
    // Line by line: assignments, rules, search paths and other Makefiles count; recipes do not.
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
      } else if (const std::size_t colon = line.find(':'); is_rule(line, colon)) {
        const std::size_t begin = line.find_first_not_of(": \t", colon);
        if (begin != std::string::npos)
          rules_.emplace_back(line.substr(0, colon), line.substr(begin, line.find_first_of(";|") - begin));
      } else if (line.rfind("vpath ", 0) == 0) {
        const auto words = sim::words_of(expand(line, 0));
        for (std::size_t i = 2; i < words.size(); ++i) source_folders_ += words[i] + " ";
      } else if (line.rfind("include ", 0) == 0 || line.rfind("-include ", 0) == 0) {
        for (const std::string& name : sim::words_of(expand(line.substr(line.find(' ')), 0)))
          read(home_ / name);
      }
    }
  }

  static bool is_rule(const std::string& line, std::size_t colon) {
    if (line.empty() || line[0] == '\t' || colon == 0 || colon == std::string::npos) return false;
    const std::size_t sign = line.find('=');
    if (sign != std::string::npos && line.find("$(") == std::string::npos) return false;
    return line.rfind("vpath", 0) != 0 && line.rfind("include", 0) != 0 && line.rfind("export", 0) != 0;
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

  /// What stands between $( and ): a function, a variable with its ends replaced, a variable.
  std::string reference(const std::string& inside, int depth) const {
    if (inside.size() > kLongestReference) return "";
    // a name of small letters with something behind it is a function
    const std::size_t begin = std::min(inside.find_first_not_of(" \t"), inside.size());
    const std::size_t end =
        std::min(inside.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", begin), inside.size());
    if (end > begin && end < inside.size() && (inside[end] == ' ' || inside[end] == '\t'))
      return call(inside.substr(begin, end - begin),
                  inside.substr(std::min(inside.find_first_not_of(" \t", end), inside.size())), depth + 1);
    const std::size_t colon = inside.find(':'), sign = inside.find('=', std::min(colon, inside.size()));
    if (sign == std::string::npos) return expand(raw(expand(inside, depth + 1)), depth + 1);
    std::string from = expand(inside.substr(colon + 1, sign - colon - 1), depth + 1),
                to = expand(inside.substr(sign + 1), depth + 1);
    if (from.find('%') == std::string::npos) from = "%" + from, to = "%" + to;
    return each(expand(raw(inside.substr(0, colon)), depth + 1),
                [&](const std::string& w) { return patsubst(from, to, w); });
  }

  /// `act` of each word, the results with blanks between.
  template <typename Act>
  std::string each(const std::string& words, const Act& act) const {
    std::string out;
    for (const std::string& word : sim::words_of(words)) {
      if (grown_ > kMost) break;
      const std::string made = act(word);
      grown_ += made.size() + 1;
      if (!made.empty()) out += made + " ";
    }
    return out;
  }

  /// A function of make; of those that are not known nothing.
  std::string call(const std::string& name, const std::string& text, int depth) const {
    // commas outside of parentheses separate
    std::vector<std::string> raw_parts(1);
    int level = 0;
    for (const char c : text) {
      level += c == '(' || c == '{' ? 1 : c == ')' || c == '}' ? -1 : 0;
      if (c == ',' && level == 0)
        raw_parts.emplace_back();
      else
        raw_parts.back() += c;
    }
    if (name == "foreach" && raw_parts.size() >= 3) return for_each_word(raw_parts, depth);
    std::vector<std::string> parts;
    for (const std::string& part : raw_parts) parts.push_back(expand(part, depth));
    // the last one takes what is left: $(notdir a,b)
    const auto last = [&](std::size_t from) {
      std::string joined;
      for (std::size_t i = from; i < parts.size(); ++i) joined += (i > from ? "," : "") + parts[i];
      return joined;
    };
    const auto trimmed = [](std::string word) {
      word.erase(0, std::min(word.find_first_not_of(" \t"), word.size()));
      while (!word.empty() && std::isspace(static_cast<unsigned char>(word.back()))) word.pop_back();
      return word;
    };
    // Functions of one argument, then of two, then of three.
    if (name == "wildcard") return wildcard(last(0));
    if (name == "sort" || name == "strip" || name == "realpath") return last(0);
    if (name == "abspath") return last(0);
    if (name == "notdir")
      return each(last(0), [](const std::string& w) { return w.substr(w.rfind('/') + 1); });
    if (name == "dir")
      return each(last(0), [](const std::string& w) {
        return w.find('/') == std::string::npos ? std::string("./") : w.substr(0, w.rfind('/') + 1);
      });
    if (name == "basename" || name == "suffix")
      return each(last(0), [&](const std::string& w) {
        const std::size_t dot = w.rfind('.'), slash = w.rfind('/');
        const bool has = dot != std::string::npos && (slash == std::string::npos || dot > slash);
        return name == "suffix" ? (has ? w.substr(dot) : std::string()) : has ? w.substr(0, dot) : w;
      });
    if (parts.size() < 2) return "";
    if (name == "addprefix")
      return each(last(1), [&](const std::string& w) { return trimmed(parts[0]) + w; });
    if (name == "addsuffix")
      return each(last(1), [&](const std::string& w) { return w + trimmed(parts[0]); });
    if (name == "filter" || name == "filter-out") return filter(parts[0], last(1), name == "filter");
    if (name == "if") return parts[trimmed(parts[0]).empty() && parts.size() > 2 ? 2 : 1];
    if (parts.size() < 3) return "";
    if (name == "patsubst") {
      const std::string from = trimmed(parts[0]), to = trimmed(parts[1]);
      return each(last(2), [&](const std::string& w) { return patsubst(from, to, w); });
    }
    if (name == "subst") return subst(parts[0], parts[1], last(2));
    return "";
  }

  static std::string patsubst(const std::string& from, const std::string& to, const std::string& word) {
    std::string stem;
    if (!matches(from, word, stem)) return word;
    const std::size_t percent = to.find('%');
    return percent == std::string::npos || from.find('%') == std::string::npos
               ? to
               : to.substr(0, percent) + stem + to.substr(percent + 1);
  }
  /// A word of a pattern with one %; `stem`: what that stands for.
  static bool matches(const std::string& pattern, const std::string& word, std::string& stem) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string::npos) return pattern == word;
    const std::string head = pattern.substr(0, percent), tail = pattern.substr(percent + 1);
    if (word.size() < head.size() + tail.size() || word.compare(0, head.size(), head) != 0 ||
        word.compare(word.size() - tail.size(), tail.size(), tail) != 0)
      return false;
    stem = word.substr(head.size(), word.size() - head.size() - tail.size());
    return true;
  }
  std::string filter(const std::string& patterns, const std::string& words, bool keeps) const {
    return each(words, [&](const std::string& word) {
      bool is_one = false;
      std::string stem;
      for (const std::string& pattern : sim::words_of(patterns))
        is_one = is_one || matches(pattern, word, stem);
      return is_one == keeps ? word : std::string();
    });
  }
  std::string subst(const std::string& from, const std::string& to, const std::string& text) const {
    std::string out;
    for (std::size_t at = 0; at < text.size() && !from.empty();) {
      const std::size_t next = std::min(text.find(from, at), text.size());
      out += text.substr(at, next - at);
      at = next;
      if (next == text.size()) break;
      out += to;
      at += from.size();
      if ((grown_ += to.size()) > kMost) break;
    }
    return from.empty() ? text : out;
  }
  std::string for_each_word(const std::vector<std::string>& parts, int depth) const {
    const std::string name =
        sim::words_of(expand(parts[0], depth)).empty() ? "" : sim::words_of(expand(parts[0], depth))[0];
    std::string body;
    for (std::size_t i = 2; i < parts.size(); ++i) body += (i > 2 ? "," : "") + parts[i];
    const auto before = variables_.find(name);
    const std::optional<std::string> kept =
        before == variables_.end() ? std::nullopt : std::optional<std::string>(before->second);
    std::string out = each(expand(parts[1], depth), [&](const std::string& word) {
      variables_[name] = word;
      return expand(body, depth);
    });
    if (kept)
      variables_[name] = *kept;
    else
      variables_.erase(name);
    return out;
  }

  /// Files of patterns with * and ? in any part: "camera/*/*.c". Of objects those that would be there once
  /// their sources were compiled.
  std::string wildcard(const std::string& patterns) const {
    std::string out;
    for (const std::string& pattern : sim::words_of(patterns)) {
      if (pattern.size() > kLongestName) continue;
      if (ends_with(pattern, ".o")) {
        const std::string stem = pattern.substr(0, pattern.size() - 2);
        for (const char* kind : {".c", ".s"})
          for (const std::string& source : sim::words_of(wildcard(stem + kind)))
            out += source.substr(0, source.size() - 2) + ".o ";
      }
      std::vector<fs::path> found = {""};
      for (const fs::path& part : fs::path(pattern)) {
        std::vector<fs::path> next;
        for (const fs::path& folder : found)
          for (const std::string& name : entries(folder, part.string())) next.push_back(folder / name);
        found = std::move(next);
      }
      for (const fs::path& file : found) out += file.string() + " ";
    }
    return out;
  }
  /// What `part` of a pattern means in a folder.
  std::vector<std::string> entries(const fs::path& folder, const std::string& part) const {
    std::error_code ec;
    if (!may_read(home_ / folder)) return {};
    if (part.find_first_of("*?") == std::string::npos) {
      look_at(home_ / folder / part);
      return fs::exists(home_ / folder / part, ec) ? std::vector<std::string>{part}
                                                   : std::vector<std::string>();
    }
    if ((grown_ += kFolder) > kMost) return {};
    std::string form;
    for (const char c : part)
      form += c == '*'                                      ? std::string(".*")
              : c == '?'                                    ? std::string(".")
              : std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c)
                                                            : std::string("\\") + c;
    const sim::Pattern matches(form);
    std::vector<std::string> names;
    look_at(home_ / folder);
    for (fs::directory_iterator it(home_ / folder, ec), end; !ec && it != end; it.increment(ec))
      if (const std::string name = it->path().filename().string();
          (name[0] != '.' || part[0] == '.') && std::regex_match(name, matches))
        names.push_back(name);
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path home_;
  mutable std::map<std::string, std::string> variables_;  // foreach has one for a while
  std::string source_folders_;
  std::vector<std::pair<std::string, std::string>> rules_;  // target, what it is made of
  std::set<fs::path> read_;
  mutable std::size_t grown_ = 0;
};

}  // namespace

namespace {

/// Files that words of a Makefile name: sources, or objects that are made of them.
struct NamedFiles {
  NamedFiles(const fs::path& home_folder, const std::vector<fs::path>& all_places)
      : home(home_folder), places(all_places) {}

  void add(const std::vector<std::string>& words) {
    for (const std::string& word : words) {
      const bool is_object = ends_with(word, ".o");
      if (word.size() <= 2 || !known_words.insert(word).second) continue;
      if (!is_object && !ends_with(word, ".c") && !ends_with(word, ".s")) continue;
      const std::string stem = word.substr(0, word.size() - 2);
      bool is_found = false;
      for (const char* kind : {".c", ".s"})
        if (!is_found && (is_object || ends_with(word, kind))) is_found = add_file(stem + kind);
      if (const std::string place = library_place(stem + ".c"); !is_found && !place.empty())
        library_places.push_back(place);
    }
  }
  int mains() const { return int(std::count_if(sources.begin(), sources.end(), defines_main)); }
  bool has_main_of(const NamedFiles& other) const {
    return std::any_of(other.sources.begin(), other.sources.end(), [&](const fs::path& source) {
      return defines_main(source) && std::find(sources.begin(), sources.end(), source) != sources.end();
    });
  }

  std::vector<fs::path> sources, assembler;
  std::vector<std::string> library_places;

 private:
  bool add_file(const std::string& name) {
    std::error_code ec;
    fs::path found;
    for (const fs::path& place : places)
      if (const fs::path at = resolve_path(place, name).lexically_normal();
          found.empty() && !at.empty() && fs::is_regular_file(at, ec))
        found = at;
    // objects may lie in a folder of their own: "obj/main.o"
    if (found.empty()) {
      std::vector<fs::path> same;
      for (const fs::path& file : files_below(home, ends_with(name, ".c") ? ".c" : ".s"))
        if (lower(file.filename().string()) == lower(fs::path(name).filename().string()))
          same.push_back(file);
      if (same.size() == 1) found = same[0].lexically_normal();
    }
    if (found.empty()) return false;
    auto& list = ends_with(name, ".c") ? sources : assembler;
    if (std::find(list.begin(), list.end(), found) == list.end()) list.push_back(found);
    return true;
  }
  const fs::path& home;
  const std::vector<fs::path>& places;
  std::set<std::string> known_words;
};

/// Empty: none.
fs::path makefile_in(const fs::path& folder) {
  std::error_code ec;
  for (const char* name : {"Makefile", "makefile", "GNUmakefile"})
    if (fs::is_regular_file(folder / name, ec)) return folder / name;
  return {};
}

/// What it gives to the compiler.
CompilerOptions options_in(const Makefile& makefile) {
  static const sim::Pattern kOptions(R"(\w*(C(PP)?FLAGS|INCLUDES?|INC|DEFS|DEFINES)\w*)", std::regex::icase);
  static const sim::Pattern kFolders("INC_?DIRS?|INCLUDE_?DIRS?", std::regex::icase);  // without -I
  std::string options;
  for (const auto& [name, raw] : makefile.variables()) {
    if (std::regex_match(name, kFolders))
      for (const std::string& word : sim::words_of(makefile.value(name)))
        if (word[0] != '-') options += "-I" + word + " ";
    if (std::regex_match(name, kOptions)) options += makefile.value(name) + " ";
  }
  return compiler_options(options);
}

/// Folders of headers, as a Makefile in `home` names them, behind those that are known.
void add_folders(const fs::path& home, const CompilerOptions& options, std::vector<fs::path>& folders) {
  std::error_code ec;
  for (const std::string& name : options.include_dirs)
    if (const fs::path at = resolve_path(home, name).lexically_normal(); fs::is_directory(at, ec))
      if (std::find(folders.begin(), folders.end(), at) == folders.end()) folders.push_back(at);
}

}  // namespace

std::optional<MplabProject> read_makefile(const fs::path& folder) {
  const fs::path home = fs::absolute(folder).lexically_normal();
  std::error_code ec;
  look_at(home);
  const fs::path file = makefile_in(home);
  if (file.empty()) return std::nullopt;
  const Makefile makefile(file);
  MplabProject project;
  project.file = file;

  // Where sources may lie.
  std::vector<fs::path> places = {home};
  for (const std::string& name :
       sim::words_of(makefile.value("VPATH") + " " + makefile.source_folders(), " \t:;"))
    if (const fs::path found = resolve_path(home, name).lexically_normal();
        fs::is_directory(found, ec) && std::find(places.begin(), places.end(), found) == places.end())
      places.push_back(found);
  // What the lists of sources and objects name.
  static const sim::Pattern kSources(R"((C_?)?(SRCS?|SOURCES?)(_C|_FILES)?|\w*OBJ(S|ECTS|_?FILES)?)",
                                     std::regex::icase);
  std::vector<std::string> words;  // of all lists of sources
  for (const auto& [name, raw] : makefile.variables())
    if (std::regex_match(name, kSources))
      for (const std::string& word : sim::words_of(makefile.value(name))) words.push_back(word);
  NamedFiles listed(home, places);
  listed.add(words);
  // lists of any name that a target is linked of; of several programs the first one
  for (const auto& list : makefile.linked()) {
    NamedFiles of_target(home, places);
    of_target.add(list);
    if (of_target.mains() != 1 || (listed.mains() > 0 && !listed.has_main_of(of_target))) continue;
    listed.add(list);
    break;
  }
  project.sources = listed.sources;
  project.assembler = listed.assembler;
  project.library_places = listed.library_places;
  // The compiler's options.
  const CompilerOptions found = options_in(makefile);
  project.defines = found.defines;
  project.standard = found.standard;
  project.level = found.level;
  add_folders(home, found, project.include_dirs);
  // files of other folders are compiled by the Makefiles there
  std::set<fs::path> others;
  for (const fs::path& source : project.sources)
    if (const fs::path other = source.parent_path(); other != home && others.insert(other).second)
      if (const fs::path theirs = makefile_in(other); !theirs.empty())
        add_folders(other, options_in(Makefile(theirs)), project.include_dirs);
  return project;
}

}  // namespace cc
