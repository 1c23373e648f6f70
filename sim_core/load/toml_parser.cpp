// SPDX-License-Identifier: MIT
#include "sim_core/load/toml_parser.h"

namespace sim {
namespace {
constexpr int kMostDots = 7;  // in one key; the longest of ours has one
}  // namespace

TomlTrap find_toml_trap(std::string_view text) {
  enum class In { Plain, Comment, Basic, Literal, LongBasic, LongLiteral } in = In::Plain;
  int line = 1, column = 1;
  int dots = 0;  // since the key began
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool basic = in == In::Basic || in == In::LongBasic;
    const bool triple = text.substr(i, 3) == "\"\"\"" || text.substr(i, 3) == "'''";
    std::size_t skip = 0;  // characters of the same line to leave out
    // Outside of strings: what the parser cannot take. Inside, only the string's end matters.
    if (in == In::Plain) {
      // a byte order mark at the very beginning is all right
      if (static_cast<unsigned char>(c) >= 0x80 && !(i < 3 && text.substr(0, 3) == "\xEF\xBB\xBF"))
        return {line, column,
                "not TOML: got a character beyond ASCII, expected those in quotes or comments only"};
      if (c == '.' && ++dots > kMostDots)
        return {line, column, "got a key of more than 8 parts, expected two at most"};
      if (std::string_view("[]{}=,\n").find(c) != std::string_view::npos) dots = 0;
      if (c == '#') in = In::Comment;
      if (c == '"') in = triple ? In::LongBasic : In::Basic;
      if (c == '\'') in = triple ? In::LongLiteral : In::Literal;
      if (triple) skip = 2;
    } else if (basic && c == '\\' && i + 1 < text.size() && text[i + 1] != '\n') {
      skip = 1;
    } else if ((in == In::Basic && c == '"') || (in == In::Literal && c == '\'')) {
      in = In::Plain;
    } else if (triple && ((in == In::LongBasic && c == '"') || (in == In::LongLiteral && c == '\''))) {
      in = In::Plain;
      skip = 2;
    }
    // a line's end ends comments and short strings
    if (c == '\n') {
      if (in == In::Comment || in == In::Basic || in == In::Literal) in = In::Plain;
      ++line;
      column = 0;
    }
    i += skip;
    column += 1 + static_cast<int>(skip);
  }
  return {};
}

}  // namespace sim
