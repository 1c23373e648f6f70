// SPDX-License-Identifier: MIT
#include "hal_sim/chip/endless_wait.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <sstream>

#include "dspic30/memory/irqs.h"
#include "sim_core/base/input_file.h"
#include "sim_core/base/pattern.h"

namespace chip {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestSource = 4u << 20;  // bytes
constexpr std::size_t kMostSources = 200;
const std::string kHandlerEnd = "Interrupt";

std::vector<std::string> lines_of(const std::string& file) {
  std::string text, line;
  std::vector<std::string> lines;
  if (!sim::read_input_file(file, kLongestSource, text).empty()) return lines;
  for (std::istringstream in(text); std::getline(in, line);) lines.push_back(line);
  return lines;
}

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Words that a line of C begins to name something with.
std::vector<std::string> names_in(const std::string& line) {
  std::vector<std::string> names;
  for (std::size_t at = 0, end; at < line.size(); at = std::max(end, at + 1)) {
    for (end = at; end < line.size() && is_name(line[end]); ++end) continue;
    if (end > at && !std::isdigit(static_cast<unsigned char>(line[at])))
      names.push_back(line.substr(at, end - at));
  }
  return names;
}

/// What stands between the parentheses behind the last `while` of a line; empty: there is none.
std::string last_condition(const std::string& line) {
  static const sim::Pattern kWhile("\\bwhile\\s*\\(");
  std::size_t begin = std::string::npos;
  for (std::sregex_iterator it(line.begin(), line.end(), kWhile), end; it != end; ++it)
    begin = static_cast<std::size_t>(it->position() + it->length());
  if (begin == std::string::npos) return "";
  int depth = 1;
  std::size_t at = begin;
  for (; at < line.size() && depth > 0; ++at) depth += (line[at] == '(') - (line[at] == ')');
  return line.substr(begin, at - begin);
}

std::vector<fs::path> sources_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end && files.size() < kMostSources;
       it.increment(none))
    for (const char* kind : {".c", ".h", ".cpp", ".cc"})
      if (it->path().extension() == kind) files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Is there a line of the sources with that name, and of that kind?
template <class Test>
bool any_line(const fs::path& folder, const std::string& name, const Test& test) {
  for (const fs::path& file : sources_in(folder))
    for (const std::string& line : lines_of(file.string()))
      if (line.find(name) != std::string::npos && test(line)) return true;
  return false;
}

/// Is it given to the library's agendas, which timer 2 serves?
bool is_agenda(const std::string& function, const fs::path& folder) {
  const sim::Pattern given("\\be_activate_agenda\\s*\\(\\s*&?\\s*" + function + "\\b");
  return any_line(folder, function, [&](const std::string& line) { return std::regex_search(line, given); });
}

/// Is it one of the C sources' own? The library's variables, and those of assembler, have writers that no
/// text here shows.
bool is_defined_in(const fs::path& folder, const std::string& variable) {
  const sim::Pattern defines("^\\s*(\\w+[\\s*]+)+([^;=(){}]*,[\\s*]*)?" + variable +
                             "\\s*(=[^=]|[;,\\[]|__attribute__)");
  const sim::Pattern no_definition("\\b(extern|return|goto)\\b");
  return any_line(folder, variable, [&](const std::string& line) {
    return std::regex_search(line, defines) && !std::regex_search(line, no_definition);
  });
}

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i)
    out += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return out;
}

}  // namespace

std::vector<std::string> variables_in(const host::Runner& program, const host::Place& place) {
  const auto lines = lines_of(place.file);
  if (place.line < 1 || place.line > static_cast<int>(lines.size())) return {};
  const auto known = [&](const std::string& text) {
    std::vector<std::string> found;
    for (const std::string& name : names_in(text)) {
      std::string error;
      // images of the chip know names, but not their types
      if (std::find(found.begin(), found.end(), name) == found.end() &&
          (program.data().find_variable(name, error) || !program.data().read_variable(name, 1).empty()))
        found.push_back(name);
    }
    return found;
  };
  const std::string& line = lines[static_cast<std::size_t>(place.line - 1)];
  if (const std::string condition = last_condition(line); !condition.empty()) return known(condition);
  // a line without a condition: what it sets itself, it does not wait for
  std::vector<std::string> found = known(line);
  found.erase(std::remove_if(found.begin(), found.end(),
                             [&](const std::string& name) {
                               return std::regex_search(line, sim::Pattern("\\b" + name + "\\s*=(?!=)"));
                             }),
              found.end());
  return found;
}

bool Writer::is_handler() const {
  return function.size() > kHandlerEnd.size() && function[0] == '_' &&
         function.compare(function.size() - kHandlerEnd.size(), kHandlerEnd.size(), kHandlerEnd) == 0;
}

std::vector<Writer> writers_of(const std::string& variable, const host::Place& place) {
  const fs::path folder = fs::path(place.file).parent_path();
  // assigned, counted up or down, or its address taken
  const sim::Pattern writes("(\\+\\+|--|(^|[^&])&)\\s*" + variable + "\\b|\\b" + variable +
                            "\\b(\\s*(\\[[^\\]]*\\]|\\.\\w+))*\\s*(\\+\\+|--|(<<|>>|[-+*/%&|^])?=(?!=))");
  std::vector<Writer> writers;
  for (const fs::path& file : sources_in(folder)) {
    std::string function;
    // Line by line, with a count of braces that says in which function a line is.
    int depth = 0, number = 0;
    for (const std::string& line : lines_of(file.string())) {
      ++number;
      // the last word before the last parenthesis that opens: of a definition, its name
      const std::size_t body = line.find('{');
      if (const std::size_t open = line.substr(0, body).rfind('('); depth == 0 && open != std::string::npos) {
        const auto names = names_in(line.substr(0, open));
        if (!names.empty()) function = names.back();
      }
      const bool is_inside = depth > 0 || body != std::string::npos;
      if (is_inside && !function.empty() && line.find(variable) != std::string::npos &&
          std::regex_search(line, writes))
        writers.push_back({function, file.filename().string() + ":" + std::to_string(number), ""});
      depth += static_cast<int>(std::count(line.begin(), line.end(), '{') -
                                std::count(line.begin(), line.end(), '}'));
      if (depth <= 0 && line.find('}') != std::string::npos) function.clear();
      depth = std::max(depth, 0);
    }
  }
  // "_T1Interrupt" is of T1
  for (Writer& w : writers)
    w.vector = w.is_handler() ? w.function.substr(1, w.function.size() - kHandlerEnd.size() - 1)
               : is_agenda(w.function, folder) ? "T2"
                                               : "";
  return writers;
}

bool is_written_by_none(const host::Runner& program, const host::Place& place, const IsEnabled& is_enabled) {
  const auto names = variables_in(program, place);
  for (const std::string& name : names) {
    if (!is_defined_in(fs::path(place.file).parent_path(), name)) return false;
    for (const Writer& w : writers_of(name, place)) {
      // what the line itself writes, as `x = f();`, is not what it waits for
      if (w.place == fs::path(place.file).filename().string() + ":" + std::to_string(place.line))
        return false;
      if (w.function == place.function) continue;
      if (w.vector.empty() || is_enabled(w.vector)) return false;
    }
  }
  return !names.empty();
}

board::Diagnosis endless_wait(const host::Runner& program, const host::Place& place, board::Cycle since) {
  board::Diagnosis wait{"endless wait", to_string(place), "", "", since};
  wait.hint = "start the agendas or the timer, or enable the interrupt whose handler ends the wait";
  std::vector<std::string> names = variables_in(program, place);
  if (names.empty()) {
    wait.message =
        "the program waits here for ever: nothing that it looks at can change, for no "
        "interrupt is enabled";
    return wait;
  }
  // who would end it, but for the function that waits
  std::vector<std::string> handlers, others;
  std::set<std::string> told;
  for (const std::string& name : names)
    for (const Writer& w : writers_of(name, place)) {
      if (w.function == place.function || !told.insert(w.function).second) continue;
      (w.is_handler() ? handlers : others).push_back(w.function + "() (" + w.place + ")");
    }
  for (std::string& name : names) name = "`" + name + "`";
  // Handlers come first: what is missing is their interrupt. Then what a handler may call.
  wait.message = "the program waits here for " + joined(names) + "; nothing will ever set it: ";
  const auto only = [](const std::vector<std::string>& functions) {
    return "only " + joined(functions) + " could, and ";
  };
  if (!handlers.empty())
    wait.message +=
        only(handlers) + (handlers.size() > 1 ? "their interrupts are" : "its interrupt is") + " not enabled";
  else if (!others.empty())
    wait.message +=
        only(others) + "no interrupt is enabled that calls " + (others.size() > 1 ? "them" : "it");
  else {
    wait.message += "no function but this one writes it";
    wait.hint = "write it in a handler or an agenda, and see that it is volatile";
  }
  return wait;
}

board::Diagnosis endless_sleep(const std::string& place, std::uint64_t enabled, board::Cycle since) {
  std::vector<std::string> sources;
  for (int irq = 0; irq < dspic::kIrqs; ++irq)
    if (enabled >> irq & 1) sources.push_back(dspic::irq_name(irq));
  return {
      "endless wait", place,
      "the program sleeps here for ever: Sleep stops the clock of " + joined(sources) +
          ", and no interrupt is enabled that needs none",
      "use Idle(), which leaves peripherals their clock, or enable what wakes from Sleep, such as INT0 or CN",
      since};
}

}  // namespace chip
