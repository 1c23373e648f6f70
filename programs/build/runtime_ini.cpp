// SPDX-License-Identifier: MIT
// See runtime_ini.h.
#include "runtime_ini.h"

#include <cstdlib>
#include <sstream>

#include "sim_core/base/words.h"

namespace programs {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// Without quotes around it, and what follows a blank and ";".
std::string value_of(std::string text) {
  text = trimmed(text);
  if (!text.empty() && text[0] == '"')
    if (const std::size_t end = text.find('"', 1); end != std::string::npos) return text.substr(1, end - 1);
  if (const std::size_t comment = text.find(" ;"); comment != std::string::npos) text.resize(comment);
  return trimmed(text);
}

std::string replaced(const std::string& text, const RuntimeIni& known) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find("$(", at), end = text.find(')', std::min(begin, text.size()));
    if (begin == std::string::npos || end == std::string::npos) return out + text.substr(at);
    out += text.substr(at, begin - at);
    const std::string name = text.substr(begin + 2, end - begin - 2);
    const char* value = std::getenv(name.c_str());
    std::string kept = value ? value : "";
    for (const auto& [other, set] : known.environment)
      if (other == name) kept = set;
    out += kept;
    at = end + 1;
  }
  return out;
}

/// "lib::../../library" with its parts absolute; empty ones, of a variable that nobody set, are left out.
std::string absolute_paths(const std::string& text, const fs::path& folder) {
  std::string out;
  for (const std::string& part : sim::words_of(text, ":"))
    out += (out.empty() ? "" : ":") + (folder / trimmed(part)).lexically_normal().string();
  return out;
}

}  // namespace

RuntimeIni read_runtime_ini(const fs::path& folder, std::vector<std::string>& warnings) {
  RuntimeIni ini;
  const fs::path file = folder / "runtime.ini";
  std::istringstream lines(text_of(file));
  std::string section;
  int number = 0;
  for (std::string raw; std::getline(lines, raw);) {
    ++number;
    const auto warn = [&](const std::string& what) {
      warnings.push_back(file.string() + ":" + std::to_string(number) + ": " + what);
    };
    if (number == 1 && raw.rfind("\xef\xbb\xbf", 0) == 0) raw.erase(0, 3);  // the mark of Windows' editors
    const std::string line = trimmed(raw);
    if (line.empty() || line[0] == ';' || line[0] == '#') continue;
    if (line[0] == '[') {
      section = lower_case(trimmed(line.substr(1, line.find(']') - 1)));
      if (section != "python" && section != "java" && section != "matlab" &&
          section.rfind("environment variables", 0) != 0)
        warn("got section [" + section + "], expected environment variables, python, java or matlab");
      continue;
    }
    // A setting: of the environment, or of one language.
    const std::size_t sign = line.find('=');
    if (sign == std::string::npos) {
      warn("got a line without =, expected NAME = VALUE");
      continue;
    }
    const std::string name = trimmed(line.substr(0, sign)), value = value_of(line.substr(sign + 1));
    const bool is_path = section == "environment variables with paths";
    if (is_path || section == "environment variables" || section == "environment variables for linux" ||
        section == "environment variables for linux 64") {
      const std::string whole = replaced(value, ini);
      ini.environment.emplace_back(name, is_path ? absolute_paths(whole, folder) : whole);
    } else if (section == "python" || section == "java" || section == "matlab") {
      if (name == "COMMAND")
        ini.commands[section] = replaced(value, ini);
      else if (name == "OPTIONS")
        ini.options[section] = sim::words_of(replaced(value, ini));
      else
        warn("got " + name + ", expected COMMAND or OPTIONS");
    }
  }
  return ini;
}

}  // namespace programs
