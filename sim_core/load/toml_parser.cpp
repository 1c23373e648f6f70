// SPDX-License-Identifier: MIT
#include "sim_core/load/toml_parser.h"

#include <algorithm>
#include <utility>

#include "sim_core/base/common_ends.h"

namespace sim {
namespace {
constexpr int kMostDots = 7;  // in one key; the longest of ours has one
}  // namespace

const toml::table* TomlTree::take(std::string_view text, std::optional<toml::parse_error>& error) {
  if (!is_known_ || !take_one_table(text)) {
    is_known_ = false;
    toml::parse_result result = toml::parse(text);
    if (!result) {
      error = result.error();
      return nullptr;
    }
    root_ = std::move(result).table();
  }
  text_ = text;
  is_known_ = true;
  return &root_;
}

/// False, with nothing changed, where it takes more than that.
bool TomlTree::take_one_table(std::string_view text) {
  const std::string_view before = text_;
  if (before == text) return true;
  const auto [head, tail] = common_ends(before, text);
  // from its heading, which stays as it is, up to the next heading of any kind
  const std::size_t break_above = text.rfind("\n[[", head);
  if (break_above == std::string_view::npos) return false;
  const std::size_t begin = break_above + 1;
  if (text.find('\n', begin) >= head) return false;
  const std::size_t end = std::min(text.find("\n[", text.size() - tail), text.size());
  const std::size_t end_before = end + before.size() - text.size();
  if (text.find("\n[", begin) < end || before.find("\n[", begin) < end_before) return false;
  const auto breaks = [](std::string_view lines) { return std::count(lines.begin(), lines.end(), '\n'); };
  const std::string_view lines = text.substr(begin, end - begin);
  if (breaks(lines) != breaks(before.substr(begin, end_before - begin))) return false;
  // It is parsed where it stands, so that what is in it knows its lines.
  const auto above = breaks(text.substr(0, begin));
  toml::parse_result result = toml::parse(std::string(static_cast<std::size_t>(above), '\n').append(lines));
  if (!result || result.table().size() != 1) return false;
  toml::node& fresh_node = result.table().begin()->second;
  toml::array* const fresh = fresh_node.as_array();
  toml::array* const known = root_.get_as<toml::array>(result.table().begin()->first.str());
  if (!fresh || !known || fresh->size() != 1 || !fresh->get_as<toml::table>(0)) return false;
  // The one that stood there, if nothing of it stands elsewhere.
  const auto first = static_cast<toml::source_index>(above + 1);
  for (std::size_t i = 0; i < known->size(); ++i) {
    const toml::table* table = known->get_as<toml::table>(i);
    if (!table || table->source().begin.line != first) continue;
    for (const auto& [key, value] : *table)
      if (value.source().begin.line < first || value.source().end.line > first + breaks(lines)) return false;
    known->replace(known->cbegin() + static_cast<std::ptrdiff_t>(i),
                   std::move(*fresh->get_as<toml::table>(0)));
    return true;
  }
  return false;
}

TomlTrap find_toml_trap(std::string_view text) {
  enum class In { Plain, Comment, Basic, Literal, LongBasic, LongLiteral } in = In::Plain;
  int line = 1, column = 1;
  int dots = 0;  // since the key began
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool basic = in == In::Basic || in == In::LongBasic;
    const bool triple =
        (c == '"' || c == '\'') && text.substr(i, 3) == std::string_view(c == '"' ? "\"\"\"" : "'''");
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
