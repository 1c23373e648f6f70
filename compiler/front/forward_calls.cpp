// SPDX-License-Identifier: MIT
#include "forward_calls.h"
#include "sim_core/base/pattern.h"

#include <set>

namespace cc {

namespace {
// comments and literals would confuse the search for definitions; line structure does not matter
std::string without_comments(const std::string& source) {
  std::string text;
  for (std::size_t i = 0; i < source.size();) {
    if (source.compare(i, 2, "//") == 0) {
      i = source.find('\n', i);
    } else if (source.compare(i, 2, "/*") == 0) {
      i = source.find("*/", i + 2);
      if (i != std::string::npos) i += 2;
      text += ' ';
    } else {
      text += source[i++];
    }
    if (i == std::string::npos) break;
  }
  return text;
}
}  // namespace

std::string forward_declarations(const std::string& messages, const std::string& source) {
  std::set<std::string> names;
  const sim::Pattern conflict("error: conflicting types for '(\\w+)'");
  for (std::sregex_iterator it(messages.begin(), messages.end(), conflict), end; it != end; ++it)
    names.insert((*it)[1]);
  if (names.empty()) return "";
  const std::string text = without_comments(source);
  std::string declarations;
  for (const std::string& name : names) {
    const sim::Pattern definition(
        "(?:^|[;}\\n])\\s*((?:(?:void|char|short|int|long|unsigned|signed|float|double)\\b[\\s*]*)+)" + name +
        "\\s*\\(([^;{}()]*)\\)\\s*\\{");
    // parameters narrower than an int agree with a full prototype only
    static const sim::Pattern narrow(
        R"(\s*((void|char|short|int|long|unsigned|signed|float|double)\b[\s*]*)+\w*\s*(,\s*((void|char|short|int|long|unsigned|signed|float|double)\b[\s*]*)+\w*\s*)*)");
    static const sim::Pattern short_parameter(R"(\b(char|short|float)\b[^*,]*(,|$))");
    std::smatch found;
    if (!std::regex_search(text, found, definition)) continue;
    const std::string parameters = found[2].str();
    const bool is_full =
        std::regex_match(parameters, narrow) && std::regex_search(parameters, short_parameter);
    declarations += found[1].str() + " " + name + "(" + (is_full ? parameters : "") + ");\n";
  }
  return declarations;
}

}  // namespace cc
