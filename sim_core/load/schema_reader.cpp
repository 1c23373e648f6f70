// SPDX-License-Identifier: MIT
#include "sim_core/load/schema_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>

#include "sim_core/load/key_rules.h"

namespace sim {
namespace {

constexpr std::size_t kLongestQuote = 60;  // characters of a value that a message repeats

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

bool number_of(const toml::node& node, double& out) {
  if (const auto* i = node.as_integer()) {
    out = static_cast<double>(i->get());
    return true;
  }
  if (const auto* f = node.as_floating_point()) {
    out = f->get();
    return std::isfinite(out);
  }
  return false;
}

/// What reads files that have such a table, and are no worlds; null: nothing.
const char* reader_of(const std::string& table) {
  if (table == "fault" || table == "stimulus") return "run --faults";
  if (table == "function" || table == "interrupt" || table == "program") return "run --budgets";
  if (table == "exercise") return "lab --table";
  return table == "step" || table == "always" || table == "finally" ? "test" : nullptr;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

bool in_range(const KeySpec& k, double v) { return v >= k.least && v <= k.most; }

/// Reads a node into a value; false when its type or range is wrong.
bool read_value(const KeySpec& k, const toml::node& node, Value& v) {
  // A list of `count` numbers, 0: of any.
  const auto numbers = [&](const toml::node& list, std::vector<double>& out, std::size_t count, bool ranged) {
    const toml::array* a = list.as_array();
    if (!a || (count && a->size() != count)) return false;
    for (const toml::node& n : *a) {
      double x = 0;
      if (!number_of(n, x) || (ranged && !in_range(k, x))) return false;
      out.push_back(x);
    }
    return true;
  };
  switch (k.type) {
    case ValueType::Integer: {
      const auto* i = node.as_integer();
      // not as doubles, which pass over numbers this large
      if (!i || i->get() < static_cast<std::int64_t>(k.least) || i->get() > static_cast<std::int64_t>(k.most))
        return false;
      v.integer = i->get();
      return true;
    }
    case ValueType::Number:
      return number_of(node, v.number) && in_range(k, v.number);
    case ValueType::Text: {
      const auto* s = node.as_string();
      if (s) v.text = s->get();
      // names and titles go to terminals and into tables
      return s && std::none_of(v.text.begin(), v.text.end(), is_control);
    }
    case ValueType::Bytes: {
      const auto* s = node.as_string();
      if (s) v.text = s->get();
      return s != nullptr;
    }
    case ValueType::Choice: {
      const auto* s = node.as_string();
      if (!s || s->get().empty() || s->get().find('|') != std::string::npos) return false;
      v.text = s->get();
      return ("|" + std::string(k.choices) + "|").find("|" + v.text + "|") != std::string::npos;
    }
    case ValueType::Flag: {
      const auto* b = node.as_boolean();
      if (b) v.flag = b->get();
      return b != nullptr;
    }
    case ValueType::Pair:
      return numbers(node, v.numbers, 2, true);
    case ValueType::Triple:
    case ValueType::Colour:
      return numbers(node, v.numbers, 3, true);
    case ValueType::Numbers:
      return numbers(node, v.numbers, 0, true);
    case ValueType::Points:
    case ValueType::Colours:
    case ValueType::Rows: {
      const toml::array* a = node.as_array();
      if (!a) return false;
      for (const toml::node& row : *a) {
        v.rows.emplace_back();
        if (!numbers(row, v.rows.back(), k.type == ValueType::Points ? 2 : 3, true)) return false;
      }
      return true;
    }
  }
  return false;
}

}  // namespace

void sort_by_place(std::vector<WorldProblem>& problems) {
  std::stable_sort(problems.begin(), problems.end(), [](const WorldProblem& a, const WorldProblem& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  });
}

const toml::table* SchemaReader::parse(std::string_view text) {
  if (text.size() > kLongestWorld) {
    problem({}, fmt::format("got {} bytes, expected at most {}", text.size(), kLongestWorld));
    return nullptr;
  }
  if (const TomlTrap trap = find_toml_trap(text); trap.line > 0) {
    problems_.push_back({trap.line, trap.column, trap.text});
    return nullptr;
  }
  lines_ = split_lines(text);
  std::optional<toml::parse_error> error;
  const toml::table* const root = tree_->take(text, error);
  if (error) {
    // the library's sentence says what stands there; ours says what kind of file was wanted
    std::string what(error->description());
    std::replace(what.begin(), what.end(), '\n', ' ');
    problem(error->source(), "not TOML: " + what);
  }
  return root;
}

void SchemaReader::sort_problems() {
  more_ += problems_.size() > kMostProblems ? problems_.size() - kMostProblems : 0;
  if (problems_.size() > kMostProblems) problems_.resize(kMostProblems);
  sort_by_place(problems_);
  if (more_ > 0) problems_.push_back({0, 0, fmt::format("and {} mistakes more", more_)});
}

void SchemaReader::problem(const toml::source_region& where, std::string text) {
  problem({static_cast<int>(where.begin.line), static_cast<int>(where.begin.column), std::move(text)});
}

void SchemaReader::problem(WorldProblem one) {
  if (problems_.size() >= kMostProblems) {
    ++more_;
    return;
  }
  problems_.push_back(std::move(one));
}

std::string SchemaReader::written(const toml::node& node) const {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "several tables in [[ ]]";
  const toml::source_region& at = node.source();
  if (at.begin.line != at.end.line || at.begin.line < 1 || at.begin.line > lines_.size()) return "a list";
  const std::string_view line = lines_[at.begin.line - 1];
  if (at.begin.column < 1 || at.end.column < at.begin.column || at.end.column - 1 > line.size())
    return "this";
  std::string text(line.substr(at.begin.column - 1, at.end.column - at.begin.column));
  if (text.size() > kLongestQuote) text = text.substr(0, kLongestQuote - 3) + "...";
  return text;
}

void SchemaReader::read_table(const SectionSpec& spec, const std::vector<std::string>& inner,
                              const toml::table& table, void* target, const WorldDesc& draft) {
  const std::string path = spec.path;
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    const bool known =
        std::any_of(spec.keys.begin(), spec.keys.end(), [&](const KeySpec& k) { return name == k.key; });
    if (known || std::find(inner.begin(), inner.end(), name) != inner.end()) continue;
    std::vector<std::string> candidates = inner;
    for (const KeySpec& k : spec.keys) candidates.push_back(k.key);
    // a word that nobody can guess may have been meant for anything
    const std::string meant = did_you_mean(name, candidates);
    is_place_in_doubt_ |= meant.empty() || says_place(meant);
    if (path == "world" && name == "interrupts") {
      problem(key.source(),
              "the key 'interrupts' is gone: there is one model of interrupts now; delete the line");
      continue;
    }
    if (const char* reader = path.empty() ? reader_of(name) : nullptr) {
      problem(key.source(), fmt::format("unknown key '{}'; is this a file for `twinpuck {}`?", name, reader));
      continue;
    }
    std::string all;
    for (const std::string& c : candidates) all += (all.empty() ? "" : ", ") + c;
    problem(key.source(),
            fmt::format("unknown key '{}'{}{} (keys: {})", name.substr(0, 60),
                        path.empty() ? "" : " in " + path, did_you_mean_tail(name, candidates), all));
  }
  std::set<std::string> refused;  // a key is told once
  for (const KeySpec& k : spec.keys) {
    const toml::node* node = table.get(k.key);
    if (!node) {
      if (std::strcmp(k.fallback, "required") == 0) {
        is_place_in_doubt_ |= says_place(k.key);
        problem(table.source(), fmt::format("{}{}: missing, expected {}", prefix, k.key, expected_text(k)));
      }
      continue;
    }
    Value value;
    if (!read_value(k, *node, value)) {
      is_place_in_doubt_ |= says_place(k.key);
      refused.insert(k.key);
      std::string hint;
      if (k.type == ValueType::Text && node->is_string()) hint = " without control characters";
      if (k.type == ValueType::Choice && node->is_string()) hint = choice_hint(k, node->as_string()->get());
      problem(node->source(), fmt::format("{}{}: got {}, expected {}{}", prefix, k.key, written(*node),
                                          expected_text(k), hint));
      continue;
    }
    const std::string wrong = k.set(target, value, draft);
    if (wrong.empty()) continue;
    is_place_in_doubt_ |= says_place(k.key);
    refused.insert(k.key);
    problem(node->source(), fmt::format("{}{}: {}", prefix, k.key, wrong));
  }
  const auto value_of = [&](const char* key) -> std::optional<std::string> {
    const toml::node* node = table.get(key);
    if (!node) return std::nullopt;
    if (const auto* flag = node->as_boolean()) return flag->get() ? "true" : "false";
    return node->is_string() ? node->as_string()->get() : std::string();
  };
  for (const IdleKey& idle : idle_keys(spec, value_of))
    if (refused.count(idle.key) == 0)
      problem(table.get(idle.key)->source(), fmt::format("{}{}: {}", prefix, idle.key, idle.why));
}

std::string SchemaReader::choice_hint(const KeySpec& k, const std::string& got) {
  std::vector<std::string> words;
  std::istringstream in(k.choices);
  for (std::string w; std::getline(in, w, '|');) words.push_back(w);
  return did_you_mean_tail(got, words);
}

}  // namespace sim
