// SPDX-License-Identifier: MIT
#include "dspic30/asm/source_lines.h"

#include <algorithm>

#include "dspic30/asm/device_names.h"
#include "dspic30/asm/instruction_text.h"

namespace dspic::assembly {

namespace {

constexpr int kDeepestMacros = 30;        // macros and includes within one another
constexpr long long kMostLines = 200000;  // after expansion, blocks that are repeated or defined included
constexpr std::int64_t kMostRepeats = 65536;

// ";" to the end of the line, "//" too, outside quotes; "#" only where nothing stands before it
std::string without_comment(const std::string& text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote) {
      if (c == '\\')
        ++i;
      else if (c == quote)
        quote = 0;
    } else if (c == '"') {
      quote = c;
    } else if (c == '\'' && i + 1 < text.size()) {
      i += text[i + 1] == '\\' ? 2 : 1;  // 'c', '\n' and gas's 'c
      if (i + 1 < text.size() && text[i + 1] == '\'') ++i;
    } else if (c == ';' || text.compare(i, 2, "//") == 0) {
      return text.substr(0, i);
    } else if (c == '#' && trimmed(text.substr(0, i)).empty()) {
      return "";
    }
  }
  return text;
}

// /* */ become blanks, line breaks stay
std::string without_block_comments(std::string text) {
  bool inside = false;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (inside) {
      if (text.compare(i, 2, "*/") == 0) {
        text[i] = text[i + 1] = ' ';
        inside = false;
      } else if (text[i] != '\n') {
        text[i] = ' ';
      }
    } else if (quote) {
      if (text[i] == '\\')
        ++i;
      else if (text[i] == quote || text[i] == '\n')
        quote = 0;
    } else if (text[i] == '"') {
      quote = '"';
    } else if (text[i] == ';') {
      while (i < text.size() && text[i] != '\n') ++i;
    } else if (text.compare(i, 2, "/*") == 0) {
      text[i] = text[i + 1] = ' ';
      inside = true;
    }
  }
  return text;
}

std::string word_at(const std::string& text, std::size_t from) {
  std::size_t end = from;
  while (end < text.size() && text[end] != ' ' && text[end] != '\t') ++end;
  return text.substr(from, end - from);
}

std::string unquoted(const std::string& text) {
  return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2)
                                                                       : text;
}

// \name, \@ and \() within a macro's line
std::string substituted(const std::string& text, const std::map<std::string, std::string>& values,
                        int number) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    if (text[i + 1] == '@') {
      out += std::to_string(number);
      ++i;
      continue;
    }
    if (text.compare(i + 1, 2, "()") == 0) {
      i += 2;
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && continues_name(text[end]) && text[end] != '.') ++end;
    const auto found = values.find(text.substr(i + 1, end - i - 1));
    if (found == values.end()) {
      out += text[i];
      continue;
    }
    out += found->second;
    i = end - 1;
  }
  return out;
}

}  // namespace

void SourceLines::read(const std::string& text, const std::string& file) {
  std::vector<Line> lines;
  const std::string clean = without_block_comments(text);
  std::size_t from = 0;
  for (int number = 1; from <= clean.size(); ++number) {
    const std::size_t end = std::min(clean.find('\n', from), clean.size());
    lines.push_back({trimmed(without_comment(clean.substr(from, end - from))), number});
    from = end + 1;
  }
  const std::size_t open = conditions_.size();
  run(lines, file);
  if (conditions_.size() > open && !ended_)
    listener_.complain(file, static_cast<int>(lines.size()), ".if without .endif");
  conditions_.resize(std::min(open, conditions_.size()));
}

Statement SourceLines::parse(const Line& line, const std::string& file) const {
  Statement s;
  s.file = file;
  s.line = line.number;
  std::string rest = line.text;
  while (true) {  // labels
    std::size_t end = 0;
    while (end < rest.size() && continues_name(rest[end])) ++end;
    std::size_t colon = end;
    while (colon < rest.size() && (rest[colon] == ' ' || rest[colon] == '\t')) ++colon;
    if (end == 0 || colon >= rest.size() || rest[colon] != ':') break;
    s.labels.push_back(rest.substr(0, end));
    rest = trimmed(rest.substr(colon + 1));
  }
  const std::string first = word_at(rest, 0);
  const std::size_t equals = rest.find('=');
  if (equals != std::string::npos && equals > 0 && rest.compare(equals, 2, "==") != 0) {
    const std::string name = trimmed(rest.substr(0, equals));
    if (!name.empty() && begins_name(name[0]) && std::all_of(name.begin(), name.end(), continues_name)) {
      s.name = ".equ";
      s.operands = name + ", " + trimmed(rest.substr(equals + 1));
      return s;
    }
  }
  s.name = lower(first);
  s.operands = trimmed(rest.substr(first.size()));
  return s;
}

bool SourceLines::is_skipping() const {
  return !conditions_.empty() && !(conditions_.back().holds && !conditions_.back().outer_skips);
}

void SourceLines::run(const std::vector<Line>& lines, const std::string& file) {
  if (++depth_ > kDeepestMacros) {
    listener_.complain(file, lines.empty() ? 0 : lines[0].number, "macros or includes are nested too deeply");
    ended_ = true;
  }
  for (std::size_t at = 0; at < lines.size() && !ended_; ++at) {
    if (++lines_ > kMostLines) {
      listener_.complain(file, lines[at].number, "the text grows too long: a macro without end?");
      ended_ = true;
      break;
    }
    Statement s = parse(lines[at], file);
    if (!s.labels.empty() && !is_skipping()) {  // they stand before whatever follows, a block too
      Statement labels = s;
      labels.name.clear();
      listener_.statement(labels);
      s.labels.clear();
    }
    if (conditional(s) || open_block(s, lines, at) || is_skipping()) continue;
    const auto macro = macros_.find(s.name);
    if (s.name == ".end") {
      ended_ = true;
    } else if (s.name == ".include") {
      include(s);
    } else if (macro != macros_.end()) {
      const Macro body = macro->second;
      expand(body, s);
    } else if (!s.name.empty()) {
      listener_.statement(s);
    }
  }
  --depth_;
}

// .if and its kin; true: it was one of them
bool SourceLines::conditional(const Statement& s) {
  const bool skips = is_skipping();
  const auto open = [&](bool holds) { conditions_.push_back({holds, holds, skips}); };
  if (s.name == ".if") {
    open(!skips && listener_.value_now(s.operands) != 0);
  } else if (s.name == ".ifdef" || s.name == ".ifndef") {
    open(!skips && listener_.is_defined(s.operands) == (s.name == ".ifdef"));
  } else if (s.name == ".else" || s.name == ".elseif" || s.name == ".endif") {
    if (conditions_.empty()) {
      complain(s, s.name + " without .if");
      return true;
    }
    Condition& c = conditions_.back();
    if (s.name == ".endif") {
      conditions_.pop_back();
    } else {
      const bool holds =
          !c.was_true && !c.outer_skips && (s.name == ".else" || listener_.value_now(s.operands) != 0);
      c.holds = holds;
      c.was_true |= holds;
    }
  } else {
    return false;
  }
  return true;
}

// takes the lines up to the block's end with it; true: there was one
bool SourceLines::open_block(const Statement& s, const std::vector<Line>& lines, std::size_t& at) {
  const bool is_macro = s.name == ".macro";
  if (!is_macro && s.name != ".rept" && s.name != ".irp") return false;
  std::vector<Line> body;
  int depth = 1;
  std::size_t i = at + 1;
  for (; i < lines.size(); ++i) {
    const std::string name = lower(word_at(lines[i].text, 0));
    if (is_macro ? name == ".macro" : name == ".rept" || name == ".irp") ++depth;
    if ((is_macro ? name == ".endm" : name == ".endr") && --depth == 0) break;
    body.push_back(lines[i]);
  }
  if (i == lines.size()) complain(s, s.name + (is_macro ? " without .endm" : " without .endr"));
  at = i;
  lines_ += static_cast<long long>(body.size());
  if (is_skipping()) return true;
  if (is_macro)
    define_macro(s, std::move(body));
  else
    repeat(s, body);
  return true;
}

void SourceLines::define_macro(const Statement& s, std::vector<Line> body) {
  const std::string name = lower(word_at(s.operands, 0));
  Macro macro{{}, std::move(body)};
  std::string parameters = s.operands.substr(word_at(s.operands, 0).size());
  std::replace(parameters.begin(), parameters.end(), ',', ' ');
  for (std::size_t i = 0; i < parameters.size();) {
    if (parameters[i] == ' ' || parameters[i] == '\t') {
      ++i;
      continue;
    }
    const std::string word = word_at(parameters, i);
    const std::size_t equals = word.find('=');
    macro.parameters.emplace_back(word.substr(0, equals),
                                  equals == std::string::npos ? "" : word.substr(equals + 1));
    i += word.size();
  }
  if (name.empty()) return complain(s, ".macro needs a name");
  macros_[name] = std::move(macro);
}

void SourceLines::expand(const Macro& macro, const Statement& s) {
  std::map<std::string, std::string> values;
  for (const auto& [name, standard] : macro.parameters) values[name] = standard;
  const std::vector<std::string> given = split(s.operands);
  if (given.size() > macro.parameters.size())
    return complain(s, s.name + ": got " + std::to_string(given.size()) + " arguments, expected at most " +
                           std::to_string(macro.parameters.size()));
  for (std::size_t i = 0; i < given.size(); ++i) {
    const std::size_t equals = given[i].find('=');
    const std::string key = equals == std::string::npos ? "" : trimmed(given[i].substr(0, equals));
    if (values.count(key))
      values[key] = trimmed(given[i].substr(equals + 1));
    else
      values[macro.parameters[i].first] = given[i];
  }
  std::vector<Line> lines;
  const int number = expansions_++;
  for (const Line& line : macro.body) lines.push_back({substituted(line.text, values, number), s.line});
  run(lines, s.file);
}

void SourceLines::repeat(const Statement& s, const std::vector<Line>& body) {
  if (s.name == ".irp") {
    std::vector<std::string> values = split(s.operands);
    for (std::size_t i = 1; i < values.size() && !ended_; ++i) {
      std::vector<Line> lines;
      for (const Line& line : body)
        lines.push_back({substituted(line.text, {{values[0], values[i]}}, 0), line.number});
      run(lines, s.file);
    }
    return;
  }
  const std::int64_t count = listener_.value_now(s.operands);
  if (count < 0 || count > kMostRepeats)
    return complain(
        s, ".rept: got " + std::to_string(count) + ", expected 0 to " + std::to_string(kMostRepeats));
  for (std::int64_t i = 0; i < count && !ended_; ++i) run(body, s.file);
}

void SourceLines::include(const Statement& s) {
  const std::string name = unquoted(s.operands);
  if (is_device_file(name)) return;  // what it defines is known
  const std::optional<std::string> text = includes_ ? includes_(name) : std::nullopt;
  if (!text) return complain(s, ".include: there is no file '" + name + "'");
  if (depth_ >= kDeepestMacros) return complain(s, "macros or includes are nested too deeply");
  read(*text, name);
}

}  // namespace dspic::assembly
