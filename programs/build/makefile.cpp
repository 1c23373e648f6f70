// SPDX-License-Identifier: MIT
// See makefile.h.
#include "makefile.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "build.h"
#include "compiler/cache/child_process.h"
#include "containment.h"
#include "kinds.h"
#include "sim_core/base/words.h"

namespace programs {
namespace {

constexpr const char* kMakeSeconds = "60";  // make may run programs: pkg-config and the like

constexpr int kKilled = 128 + 9;

// in the order of a command line; of Webots' Makefile.include, of older ones, and of hand-written Makefiles
constexpr const char* kSources[] = {"C_SOURCES", "CXX_SOURCES", "CC_SOURCES", "CPP_SOURCES"};
constexpr const char* kOtherSources[] = {"SOURCES", "SRCS", "SRC", "SOURCE", "OBJECTS", "OBJS", "OBJ"};
constexpr const char* kOptions[] = {"CPPFLAGS", "DEFINES", "DEFS", "CFLAGS", "INCLUDE", "INCLUDES"};
constexpr const char* kLibraries[] = {"LFLAGS", "LDFLAGS", "LIBRARIES",
                                      "LIBS",   "LDLIBS",  "DYNAMIC_LIBRARIES"};

/// The Makefile with includes that may be missing: Webots' own is not here, and on no path that it names.
std::string lenient(const std::string& text, bool& is_webots) {
  std::ostringstream out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find("Makefile.include") != std::string::npos) is_webots = true;
    const std::size_t at = line.find_first_not_of(' ');
    const bool includes = at != std::string::npos && line.compare(at, 8, "include ") == 0;
    out << (includes ? line.substr(0, at) + "-" + line.substr(at) : line) << '\n';
  }
  return out.str();
}

void ask(std::ostream& out, const std::string& variable) {
  out << "\t-@printf '%s\\n' '@" << variable << "' 2>/dev/null\n"
      << "\t-@printf '=%s\\n' $(strip $(" << variable << ")) 2>/dev/null\n";
}

/// A place where Makefiles find what they include of Webots: nothing is in these files, for
/// only variables count.
void make_home(const fs::path& home) {
  std::error_code none;
  for (const char* folder :
       {"resources", "projects/default/controllers", "resources/projects/default/controllers"})
    for (const char* name : {"Makefile.include", "Makefile.os.include"}) {
      const fs::path file = home / folder / name;
      if (fs::exists(file, none)) continue;
      fs::create_directories(file.parent_path(), none);
      std::ofstream(file, std::ios::app).flush();
    }
}

template <typename Names>
std::vector<std::string> values_of(const std::map<std::string, std::vector<std::string>>& values,
                                   const Names& names) {
  std::vector<std::string> all;
  for (const char* name : names)
    if (const auto found = values.find(name); found != values.end())
      all.insert(all.end(), found->second.begin(), found->second.end());
  return all;
}

/// Options of a hand-written rule: "gcc -o avoid avoid.c -lController -lgsl".
void add_rule_libraries(const std::string& text, std::vector<std::string>& libraries) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] == '\t')
      for (const std::string& word : sim::words_of(line))
        if (word.rfind("-l", 0) == 0 && word.size() > 2 && word.find('$') == std::string::npos)
          libraries.push_back(word);
}

}  // namespace

MakeSays ask_makefile(const fs::path& folder, const fs::path& scratch,
                      const std::function<void(const std::string&)>& tell) {
  MakeSays says;
  const fs::path makefile = makefile_of(folder);
  if (makefile.empty()) return says;
  const std::string text = text_of(makefile);
  const fs::path copy = scratch / "asked.mk";
  {
    std::ofstream out(copy, std::ios::binary);
    out << "OSTYPE := linux\nNAME = $(notdir $(CURDIR))\n" << lenient(text, says.is_webots);
    out << "\n.RECIPEPREFIX =\n.PHONY: twinpuck-asks\ntwinpuck-asks:\n";
    for (const char* name : kSources) ask(out, name);
    for (const char* name : kOtherSources) ask(out, name);
    for (const char* name : kOptions) ask(out, name);
    for (const char* name : kLibraries) ask(out, name);
    ask(out, "CXXFLAGS");
  }
  const fs::path home = scratch.parent_path() / "webots";
  make_home(home);
  std::vector<std::string> words{"env",
                                 "--chdir=" + folder.string(),
                                 "-u",
                                 "MAKEFLAGS",
                                 "-u",
                                 "MFLAGS",
                                 "-u",
                                 "MAKELEVEL",
                                 "LC_ALL=C",
                                 "timeout",
                                 "-s",
                                 "KILL",
                                 kMakeSeconds,
                                 "make",
                                 "-r",
                                 "-s",
                                 "--no-print-directory",
                                 "-f",
                                 copy.string(),
                                 "SHELL=/bin/sh",
                                 "WEBOTS_HOME=" + home.string(),
                                 "WEBOTS_HOME_PATH=" + home.string(),
                                 "twinpuck-asks"};
  // its $(shell ...) runs whatever it says
  if (is_contained())
    words = contained(words, folder.string(), {folder.string()}, {scratch.parent_path().string()});
  if (words.empty()) return says;
  const cc::ProcessResult done = cc::run_process(words);
  std::map<std::string, std::vector<std::string>> values;
  std::vector<std::string>* current = nullptr;
  std::vector<std::string> complaints;
  std::istringstream lines(done.output);
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '@')
      current = &values[line.substr(1)];
    else if (line[0] == '=' && current && line.size() > 1)
      current->push_back(line.substr(1));
    else if (!line.empty() && line[0] != '=')
      complaints.push_back(line);
  }
  says.is_read = !values.empty();
  if (tell && !says.is_read && done.status == kKilled)
    tell(makefile.string() + ": make: got no end after " + kMakeSeconds +
         " s, expected one; the folder's files are taken");
  // a package that pkg-config misses is said here, where it is known; of make's words one is enough
  for (const std::string& line : complaints)
    if (tell && (!package_hint(line).empty() || (!says.is_read && &line == &complaints.front())))
      tell(makefile.string() + ": " + (package_hint(line).empty() ? line : package_hint(line)));
  if (!says.is_read) return says;

  says.sources = values_of(values, kSources);
  if (says.sources.empty()) {
    for (std::string word : values_of(values, kOtherSources)) {
      if (word.size() > 2 && word.compare(word.size() - 2, 2, ".o") == 0) {
        // an object is made of the source with its name
        word.resize(word.size() - 2);
        for (const char* ending : {".c", ".cpp", ".cc", ".cxx"})
          if (const fs::path source = resolve(folder, word + ending); !source.empty()) {
            word = source.lexically_relative(folder).string();
            break;
          }
      }
      if ((is_c(word) || is_cxx(word)) && !resolve(folder, word).empty()) says.sources.push_back(word);
    }
  }
  std::set<std::string> seen;
  says.sources.erase(std::remove_if(says.sources.begin(), says.sources.end(),
                                    [&](const std::string& word) { return !seen.insert(word).second; }),
                     says.sources.end());
  says.options = values_of(values, kOptions);
  says.cxx_options = values["CXXFLAGS"];
  says.libraries = values_of(values, kLibraries);
  if (!says.is_webots) add_rule_libraries(text, says.libraries);
  return says;
}

}  // namespace programs
