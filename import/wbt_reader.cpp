// SPDX-License-Identifier: MIT
#include "import/wbt_reader.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

namespace wbt {

const Field* Node::field(std::string_view name) const {
  for (const Field& f : fields) {
    if (f.name == name) return &f;
  }
  return nullptr;
}

double Node::number(std::string_view name, double otherwise, std::size_t i) const {
  const Field* f = field(name);
  return f && i < f->numbers.size() ? f->numbers[i] : otherwise;
}

std::string Node::text(std::string_view name, std::string otherwise) const {
  const Field* f = field(name);
  if (f && !f->strings.empty()) return f->strings.front();
  return otherwise;
}

bool Node::truth(std::string_view name, bool otherwise) const {
  const Field* f = field(name);
  return f && f->truth ? *f->truth : otherwise;
}

const Node* Node::node(std::string_view name) const {
  const Field* f = field(name);
  return f && !f->nodes.empty() ? f->nodes.front().get() : nullptr;
}

namespace {

enum class Kind { Word, Number, Text, Mark, End };  // Mark: one of { } [ ]

struct Token {
  Kind kind = Kind::End;
  std::string_view text;  // of a Text: what stands between the quotes, escapes and all
  double number = 0;
  int line = 1;
  int column = 1;
  std::size_t begin = 0;  // place in the whole text
};

// thrown and caught in this file only: reading ends at the first error
struct Broken {
  Remark remark;
};

std::string shown(const Token& t) {
  if (t.kind == Kind::End) return "the end of the file";
  std::string text;
  for (const char c : t.text.substr(0, 30)) text += c >= ' ' && c < 127 ? c : '?';
  return "'" + text + "'";
}

[[noreturn]] void fail(const Token& at, const std::string& expected) {
  throw Broken{{at.line, at.column, fmt::format("got {}, expected {}", shown(at), expected)}};
}

std::string unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size() && out.size() < kLongestText; ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    out += text[i];
  }
  return out;
}

// what a copy of a field costs, in nodes
std::size_t size_of(const Field& f) {
  std::size_t letters = 0;
  for (const std::string& s : f.strings) letters += s.size() + 32;
  return 1 + f.numbers.size() / 16 + letters / 64 + f.nodes.size() / 8;
}

class Lexer {
 public:
  explicit Lexer(std::string_view text) : text_(text) { read(); }

  const Token& now() const { return now_; }
  Token take() {
    const Token t = now_;
    read();
    return t;
  }
  std::string_view all() const { return text_; }
  std::size_t behind() const { return at_; }  // first place that is not read yet, behind now()
  /// Puts the reader behind a place further on.
  void jump(std::size_t to) {
    while (at_ < to) step();
    read();
  }

 private:
  void step() {
    if (text_[at_] == '\n') {
      ++line_;
      line_begin_ = at_ + 1;
    }
    ++at_;
  }

  void read() {
    for (;;) {
      while (at_ < text_.size() && is_gap(text_[at_])) step();
      if (at_ >= text_.size() || text_[at_] != '#') break;
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }
    now_ = Token{};
    now_.line = line_;
    now_.column = static_cast<int>(at_ - line_begin_) + 1;
    now_.begin = at_;
    if (at_ >= text_.size()) return;
    const char c = text_[at_];
    if (c == '"') {
      read_text();
    } else if (c == '{' || c == '}' || c == '[' || c == ']') {
      now_.kind = Kind::Mark;
      now_.text = text_.substr(at_++, 1);
    } else {
      read_word();
    }
  }

  void read_text() {
    const std::size_t begin = ++at_;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) step();
      step();
    }
    if (at_ >= text_.size()) fail(now_, "a text that ends in a quote");
    now_.kind = Kind::Text;
    now_.text = text_.substr(begin, at_ - begin);
    ++at_;
  }

  void read_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_gap(text_[at_]) && !is_end(text_[at_])) ++at_;
    now_.kind = Kind::Word;
    now_.text = text_.substr(begin, at_ - begin);
    std::string_view digits = now_.text;
    if (digits[0] == '+') digits.remove_prefix(1);
    if (digits.empty() ||
        !(std::isdigit(static_cast<unsigned char>(digits[0])) || digits[0] == '-' || digits[0] == '.'))
      return;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size()) return;
    if (error == std::errc::result_out_of_range) value = 0;  // as good as nothing, or too large to be meant
    if (!std::isfinite(value)) return;
    now_.kind = Kind::Number;
    now_.number = value;
  }

  static bool is_gap(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ','; }
  static bool is_end(char c) { return c == '{' || c == '}' || c == '[' || c == ']' || c == '"' || c == '#'; }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  Token now_;
};

class Reader {
 public:
  Reader(std::string_view text, std::size_t budget) : lexer_(text), budget_(budget) {}

  void world(WorldText& out) {
    while (lexer_.now().kind != Kind::End) {
      const Token t = lexer_.now();
      if (is_word("EXTERNPROTO") || is_word("IMPORTABLE")) {
        if (lexer_.take().text == "IMPORTABLE") continue;
        if (lexer_.now().kind != Kind::Text) fail(lexer_.now(), "the address of a PROTO in quotes");
        out.extern_protos.push_back(unescaped(lexer_.take().text));
      } else if (is_word("PROTO")) {
        lexer_.take();
        const std::string name = word("the name of a PROTO");
        out.protos[name] = proto(true);
      } else if (t.kind == Kind::Word) {
        if (const NodePtr n = node(0)) out.nodes.push_back(n);
      } else {
        fail(t, "a node such as `Solid {`");
      }
    }
    out.remarks = std::move(remarks_);
  }

  /// From behind the word PROTO and its name. `skip_body`: read on behind its closing brace.
  Proto proto(bool skip_body) {
    Proto out;
    // Its fields, with their defaults.
    mark("[", "a list of fields");
    while (!is_mark("]")) {
      word("`field`");
      word("the type of a field");
      if (is_mark("{")) {  // the values it may take
        while (!is_mark("}")) {
          if (lexer_.take().kind == Kind::End) fail(lexer_.now(), "'}'");
        }
        lexer_.take();
      }
      Field f;
      f.line = lexer_.now().line;
      f.name = word("the name of a field");
      if (!is_mark("]") && !is_word("field") && !is_word("vrmlField")) value(f, 0);
      out.defaults.push_back(std::move(f));
    }
    lexer_.take();
    if (!is_mark("{")) fail(lexer_.now(), "'{'");
    // Its body, kept as text.
    const std::size_t begin = lexer_.behind();
    std::size_t end = lexer_.all().size();
    if (skip_body) {
      int depth = 0;
      do {
        const Token t = lexer_.take();
        if (t.kind == Kind::End) fail(t, "'}' at the end of a PROTO");
        if (t.kind == Kind::Mark && t.text == "{") ++depth;
        if (t.kind == Kind::Mark && t.text == "}" && --depth == 0) end = t.begin;
      } while (depth > 0);
    }
    out.body = std::string(lexer_.all().substr(begin, end - begin));
    unscript(out);
    return out;
  }

  /// The first node of a PROTO's body, its IS filled from `values`; all its lines are `line`.
  NodePtr body(const std::vector<Field>& values, int line) {
    values_ = &values;
    line_ = line;
    return node(0);
  }

  /// Reads on to the next `PROTO Name`. False at the end.
  bool find_proto() {
    while (lexer_.now().kind != Kind::End) {
      if (lexer_.take().text == "PROTO" && lexer_.now().kind == Kind::Word) {
        lexer_.take();
        return true;
      }
    }
    return false;
  }

  std::size_t used() const { return used_; }
  /// What USE may name before any DEF.
  void know(const std::map<std::string, NodePtr>& defs) { defs_ = defs; }

 private:
  bool is_word(std::string_view w) const { return lexer_.now().kind == Kind::Word && lexer_.now().text == w; }
  bool is_mark(std::string_view m) const { return lexer_.now().kind == Kind::Mark && lexer_.now().text == m; }

  std::string word(const char* expected) {
    if (lexer_.now().kind != Kind::Word) fail(lexer_.now(), expected);
    return std::string(lexer_.take().text);
  }

  void mark(const char* m, const char* expected) {
    if (!is_mark(m)) fail(lexer_.now(), expected);
    lexer_.take();
  }

  // `%{= fields.length.value }%` and `%<= fields.length.value >%` become `IS length`. Of any other script
  // what it decides is unknown: it is left out, and both its branches stay
  static void unscript(Proto& p) {
    std::string plain;
    std::size_t done = 0;  // of the body, in `plain`
    for (std::size_t at = p.body.find('%'); at != std::string::npos; at = p.body.find('%', at + 1)) {
      if (at + 2 >= p.body.size() || (p.body[at + 1] != '{' && p.body[at + 1] != '<')) continue;
      const std::size_t end = p.body.find(p.body[at + 1] == '{' ? "}%" : ">%", at + 2);
      plain += p.body.substr(done, at - done);
      if (end == std::string::npos) {
        p.has_script = true;
        done = p.body.size();
        break;
      }
      if (p.body[at + 2] == '=') {
        const std::string_view script = std::string_view(p.body).substr(at + 3, end - at - 3);
        const std::string field = field_of(script);
        const bool alone =
            !field.empty() && script.find_first_not_of(" \t") == script.find("fields.") &&
            script.find_first_not_of(" \t", script.find(".value") + 6) == std::string_view::npos;
        const std::string joined = alone ? "" : joined_text(script);
        plain += !joined.empty() ? joined : field.empty() ? "0" : " IS " + field + " ";
        if (!alone) p.has_script = true;
      } else {
        p.has_script = true;
        plain += ' ';
      }
      done = end + 2;
      at = end + 1;
    }
    p.body = plain + p.body.substr(done);
  }

  // "length" of `... fields.length.value ...`; empty: it names none
  static std::string field_of(std::string_view script) {
    const std::size_t fields = script.find("fields.");
    if (fields == std::string_view::npos) return {};
    const std::size_t from = fields + 7, to = script.find(".value", from);
    if (to == std::string_view::npos || to == from) return {};
    for (const char c : script.substr(from, to - from))
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return {};
    return std::string(script.substr(from, to - from));
  }

  // `'"' + fields.name.value + '_motor"'`, and the same with `..`: a text of literals and one field, which
  // becomes `JOIN name "" "_motor"`; empty: it is something else
  static std::string joined_text(std::string_view script) {
    std::string parts[2], field;
    for (std::size_t at = 0; at < script.size();) {
      const char c = script[at];
      if (c == '"' || c == '\'') {
        std::string& part = parts[field.empty() ? 0 : 1];
        for (++at; at < script.size() && script[at] != c; ++at) {
          if (script[at] == '\\' && at + 1 < script.size()) ++at;
          part += script[at];
        }
        ++at;
      } else if (c == ' ' || c == '\t' || c == '+' || c == '.') {
        ++at;
      } else {
        const std::string name = field_of(script.substr(at));
        if (!field.empty() || name.empty() || script.substr(at, 7) != "fields.") return {};
        field = name;
        at = script.find(".value", at) + 6;
      }
    }
    if (field.empty() || parts[0].empty() || parts[1].empty() || parts[0].front() != '"' ||
        parts[1].back() != '"')
      return {};
    parts[0].erase(0, 1);
    parts[1].pop_back();
    for (const std::string& part : parts)
      if (part.find_first_of("\"\\") != std::string::npos) return {};
    return " JOIN " + field + " \"" + parts[0] + "\" \"" + parts[1] + "\" ";
  }

  NodePtr node(int depth) {
    if (depth > kDeepestNode)
      fail(lexer_.now(), fmt::format("at most {} nodes in one another", kDeepestNode));
    const Token first = lexer_.now();
    // No node, or one that was defined before.
    if (is_word("NULL")) {
      lexer_.take();
      return nullptr;
    }
    if (is_word("USE")) {
      lexer_.take();
      const std::string name = word("the name that a DEF gave");
      const auto found = defs_.find(name);
      if (found != defs_.end()) return found->second;
      remarks_.push_back(
          {first.line, first.column, "USE " + name + ": not carried: no DEF of that name above"});
      return nullptr;
    }
    // A node: its name, its type, its fields.
    auto out = std::make_shared<Node>();
    if (is_word("DEF")) {
      lexer_.take();
      out->def = word("a name behind DEF");
    }
    out->line = line_ > 0 ? line_ : lexer_.now().line;
    out->type = word("the type of a node");
    mark("{", "'{' behind the type of a node");
    spend(1, first);
    while (!is_mark("}")) {
      const bool hidden = is_word("hidden");
      if (hidden) lexer_.take();
      Field f;
      f.line = line_ > 0 ? line_ : lexer_.now().line;
      f.name = word("the name of a field, or '}'");
      spend(1, first);
      if (out->fields.size() == kMostFields) fail(first, fmt::format("at most {} fields", kMostFields));
      value(f, depth + 1);
      if (!hidden) out->fields.push_back(std::move(f));
    }
    lexer_.take();
    if (!out->def.empty()) defs_[out->def] = out;
    return out;
  }

  void spend(std::size_t cost, const Token& at) {
    used_ += cost;
    if (used_ > budget_) fail(at, fmt::format("at most {} nodes and fields", budget_));
  }

  void value(Field& f, int depth) {
    const Token t = lexer_.now();
    if (is_mark("[")) {
      lexer_.take();
      while (!is_mark("]")) element(f, depth);
      lexer_.take();
    } else if (t.kind == Kind::Number || is_word("IS")) {  // numbers and filled-in ones may be mixed
      while (lexer_.now().kind == Kind::Number || is_word("IS")) element(f, depth);
    } else {
      element(f, depth);
    }
  }

  void element(Field& f, int depth) {
    const Token t = lexer_.now();
    if (t.kind == Kind::Number) {
      f.numbers.push_back(lexer_.take().number);
    } else if (t.kind == Kind::Text) {
      f.strings.push_back(unescaped(lexer_.take().text));
      spend(f.strings.back().size() / 64, t);
    } else if (is_word("TRUE") || is_word("FALSE")) {
      f.truth = lexer_.take().text == "TRUE";
    } else if (is_word("IS")) {
      lexer_.take();
      const std::string name = word("the name of a PROTO's field");
      for (std::size_t i = 0; values_ && i < values_->size(); ++i) {
        const Field& given = (*values_)[i];
        if (given.name != name) continue;
        spend(size_of(given), t);
        f.numbers.insert(f.numbers.end(), given.numbers.begin(), given.numbers.end());
        f.strings.insert(f.strings.end(), given.strings.begin(), given.strings.end());
        f.nodes.insert(f.nodes.end(), given.nodes.begin(), given.nodes.end());
        if (given.truth) f.truth = given.truth;
        break;
      }
    } else if (values_ && is_word("JOIN")) {  // of joined_text()
      lexer_.take();
      const std::string name = word("the name of a PROTO's field");
      std::string text = unescaped(lexer_.take().text);
      for (const Field& given : *values_)
        if (given.name == name)
          text += !given.strings.empty()  ? given.strings.front()
                  : given.numbers.empty() ? ""
                                          : fmt::format("{}", given.numbers[0]);
      f.strings.push_back(text + unescaped(lexer_.take().text));
      spend(f.strings.back().size() / 64, t);
    } else if (t.kind == Kind::Word) {
      if (const NodePtr n = node(depth)) f.nodes.push_back(n);
    } else {
      fail(t, "a value");
    }
  }

  Lexer lexer_;
  std::size_t budget_;
  std::size_t used_ = 0;
  std::map<std::string, NodePtr> defs_;
  std::vector<Remark> remarks_;
  const std::vector<Field>* values_ = nullptr;
  int line_ = 0;
};

// "#VRML_SIM R2023b utf8"; false when the file is something else
bool read_header(std::string_view text, WorldText& out) {
  const std::string_view start = "#VRML_SIM ";
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  if (text.substr(0, start.size()) != start) return false;
  text.remove_prefix(start.size());
  text = text.substr(0, std::min<std::size_t>(text.find_first_of(" \t\r\n"), 12));
  if (text.size() < 2 || (text[0] != 'V' && text[0] != 'R')) return false;
  for (const char c : text) {
    if (c <= ' ' || c >= 127) return false;
  }
  out.version = std::string(text);
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + 1, end, number);
  if (read.ec != std::errc() || number < 1) return false;
  (text[0] == 'V' ? out.major : out.year) = number;
  if (text[0] == 'R' && read.ptr != end && *read.ptr >= 'a' && *read.ptr <= 'z') out.letter = *read.ptr;
  return true;
}

}  // namespace

WorldText read_world_text(std::string_view text) {
  WorldText out;
  if (text.size() > kLongestFile) {
    out.errors.push_back({1, 1, fmt::format("got {} bytes, expected at most {}", text.size(), kLongestFile)});
    return out;
  }
  if (!read_header(text, out)) {
    out.errors.push_back(
        {1, 1, "got another first line, expected `#VRML_SIM`, a version such as V6.0 or R2023b, and `utf8`"});
    return out;
  }
  try {
    Reader(text, kMostNodes).world(out);
  } catch (const Broken& broken) {
    out.errors.push_back(broken.remark);
  }
  return out;
}

WorldText read_nodes_text(std::string_view text, const WorldText& of,
                          const std::map<std::string, NodePtr>& defs) {
  WorldText out;
  out.version = of.version;
  out.year = of.year;
  out.letter = of.letter;
  out.major = of.major;
  if (text.size() > kLongestFile) {
    out.errors.push_back({1, 1, fmt::format("got {} bytes, expected at most {}", text.size(), kLongestFile)});
    return out;
  }
  try {
    Reader reader(text, kMostNodes);
    reader.know(defs);
    reader.world(out);
  } catch (const Broken& broken) {
    out.errors.push_back(broken.remark);
  }
  return out;
}

bool read_proto_text(std::string_view text, Proto& proto) {
  if (text.size() > kLongestFile) return false;
  try {
    Reader reader(text, kMostNodes);
    if (!reader.find_proto()) return false;
    proto = reader.proto(false);
    return true;
  } catch (const Broken&) {
    return false;
  }
}

NodePtr unfold(const Proto& proto, const Node& instance, std::size_t& budget, bool without_script) {
  if (proto.has_script && !without_script) return nullptr;
  std::vector<Field> values = proto.defaults;
  for (Field& v : values) {
    if (const Field* given = instance.field(v.name)) v = *given;
  }
  std::size_t copied = 0;
  for (const Field& v : values) copied += size_of(v);
  if (copied >= budget) return budget = 0, nullptr;
  budget -= copied;
  try {
    Reader reader(proto.body, budget);
    NodePtr out = reader.body(values, instance.line);
    // its text has to be read even when it makes few nodes
    const std::size_t cost = reader.used() + proto.body.size() / 64 + 1;
    budget = budget > cost ? budget - cost : 0;
    return out;
  } catch (const Broken&) {
    budget = budget > 1000 + proto.body.size() / 64 ? budget - 1000 - proto.body.size() / 64 : 0;
    return nullptr;
  }
}

}  // namespace wbt
