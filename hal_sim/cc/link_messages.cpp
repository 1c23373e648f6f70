// SPDX-License-Identifier: MIT
// See link_messages.h. Every object that calls the simulator gives lines here, hundreds a link, so they are
// taken apart by hand. They look like this:
//   /usr/bin/ld: main.o: in function `f':
//   main.c:12: warning: undefined reference to `g'
#include "link_messages.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <sstream>

#include "object_cache.h"
#include "robot_lacks.h"

namespace cc {
namespace fs = std::filesystem;
namespace {

bool is_of_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

bool starts_with(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }

/// The functions tp_... that a header declares or a macro calls.
void add_exports(const std::string& header, std::set<std::string>& names) {
  for (std::size_t at = 0; (at = header.find("tp_", at)) != std::string::npos;) {
    const bool is_whole = at == 0 || !is_of_name(header[at - 1]);
    std::size_t end = at;
    while (end < header.size() && is_of_name(header[end])) ++end;
    const std::size_t next = header.find_first_not_of(" \t\n", end);
    if (is_whole && next != std::string::npos && header[next] == '(')
      names.insert(header.substr(at, end - at));
    at = end;
  }
}

/// Everything the host exports: named in the headers of the seam, and in host_exports.def.
std::set<std::string> host_exports(const fs::path& root) {
  std::set<std::string> names;
  for (const auto& header : files_below(root / "hal_sim/host", ".h")) {
    const std::string file = header.filename().string();
    if (file == "image_abi.h" || starts_with(file, "pins")) add_exports(read_text(header), names);
  }
  std::istringstream lines(read_text(root / "hal_sim/cc/host_exports.def"));
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#') names.insert(line);
  return names;
}

/// What stands in `text` between `before` and a closing quote; "" for nothing.
std::string quoted_after(const std::string& text, const char* before) {
  const std::size_t at = text.find(before);
  if (at == std::string::npos) return "";
  const std::size_t begin = at + std::char_traits<char>::length(before), end = text.find('\'', begin);
  return end == std::string::npos ? "" : text.substr(begin, end - begin);
}

/// "main.c:12" in front of "undefined reference"; "" where the linker knows no line.
std::string source_line(const std::string& line) {
  std::string before = line.substr(0, line.find("undefined reference"));
  const auto drop_tail = [&](const std::string& tail) {
    if (before.size() >= tail.size() && before.compare(before.size() - tail.size(), tail.size(), tail) == 0)
      before.resize(before.size() - tail.size());
  };
  drop_tail("warning: ");
  drop_tail(": ");
  if (const std::size_t colon = before.rfind(": "); colon != std::string::npos) before.erase(0, colon + 2);
  while (starts_with(before, "../")) before.erase(0, 3);
  const std::size_t colon = before.rfind(':');
  const bool has_line = colon != std::string::npos && colon > 0 && colon + 1 < before.size() &&
                        std::all_of(before.begin() + std::ptrdiff_t(colon) + 1, before.end(),
                                    [](unsigned char c) { return std::isdigit(c) != 0; });
  return has_line ? before : "";
}

bool is_of_webots(const std::string& name) {
  static constexpr std::array kPrefixes = {
      "wb_",        "wbu_", "supervisor_",         "robot_", "camera_", "speaker_", "display_", "servo_",
      "connector_", "pen_", "differential_wheels_"};
  return std::any_of(kPrefixes.begin(), kPrefixes.end(), [&](const char* p) { return starts_with(name, p); });
}

/// What may be the matter with a name that nobody defines.
std::string hint_for(const std::string& name) {
  if (is_of_webots(name))
    return "a controller runs on the robot and has not this function of Webots; docs/webots.md lists what "
           "there "
           "is, and supervisors are programs of their own";
  if (starts_with(name, "e_"))
    return "this function of the e-puck library is not simulated yet, or its name is misspelt";
  return "is a .c file missing from the folder, or the name misspelt?";
}

}  // namespace

std::string with_hints(const std::string& text) {
  static const std::string kMissing = ": got no definition, expected one in the program or the library";
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(kMissing);
    if (at != std::string::npos && at + kMissing.size() == line.size()) {
      const std::size_t begin = line.rfind(' ', at) + 1;
      std::string name = line.substr(begin, at - begin);
      if (name.size() > 2 && name.compare(name.size() - 2, 2, "()") == 0) name.resize(name.size() - 2);
      if (const std::string lack = what_the_robot_lacks(name); !lack.empty())
        line.replace(at, std::string::npos, ": " + lack);
      else
        line += "; " + hint_for(name);
    }
    out += line + "\n";
  }
  return out;
}

void sort_linker_messages(const std::string& text, const Program& program, const fs::path& root,
                          BuildResult& result) {
  std::map<std::string, fs::path> in_assembler;
  for (const fs::path& file : program.assembler)
    for (const std::string& name : functions_in_assembler(file)) in_assembler.emplace(name, file);
  const auto exports = host_exports(root);
  std::string function;
  std::set<std::string> told;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const std::string in = quoted_after(line, "in function `"); !in.empty()) function = in;
    if (const std::string name = quoted_after(line, "undefined reference to `"); !name.empty()) {
      if (exports.count(name) || !told.insert(function + " " + name).second) continue;
      std::string where = source_line(line);
      if (where.empty()) where = function.empty() ? "link" : function + "()";
      const std::string hint =
          in_assembler.count(name) ? "it is in " + in_assembler[name].filename().string() +
                                         ", and only the chip way assembles: --way chip, or write it in C"
          : !program.objects.empty() ? program.objects.front().filename().string() +
                                           " is code of the chip, which only the chip way links: --way chip"
                                     : hint_for(name);
      result.errors.push_back(where + ": " + (function.empty() ? "" : function + "() calls ") + name +
                              "(): got no definition, expected one in the project or the library; " + hint);
    } else if (const std::string twice = quoted_after(line, "multiple definition of `"); !twice.empty()) {
      if (told.insert("twice " + twice).second)
        result.errors.push_back("link: " + twice + ": got two definitions, expected one: " + line);
    } else if (line.find("error: ") != std::string::npos || line.find("cannot ") != std::string::npos ||
               line.find("No space") != std::string::npos) {
      result.errors.push_back("link: " + line);
    }
  }
}

/// Splits what a compiler printed into errors and warnings; notes stay with the line before them.
void sort_messages(const std::string& text, BuildResult& result, bool failed) {
  std::istringstream lines(text);
  std::vector<std::string>* last = nullptr;
  for (std::string line; std::getline(lines, line);) {
    const bool is_summary = line.size() > 11 && line.compare(line.size() - 11, 11, " generated.") == 0;
    if (line.empty() || is_summary) continue;
    bool is_error =
        line.find(" error: ") != std::string::npos || line.find("fatal error: ") != std::string::npos;
    bool is_warning = line.find("warning: ") != std::string::npos;
    if (is_error || is_warning) {
      last = is_error ? &result.errors : &result.warnings;
      if (std::find(last->begin(), last->end(), line) == last->end()) last->push_back(line);
    } else if (last && !last->empty() && line.find("note: ") != std::string::npos) {
      last->back() += "\n" + line;
    } else if (failed) {
      last = &result.errors;
      last->push_back(line);
    }
  }
}

}  // namespace cc
