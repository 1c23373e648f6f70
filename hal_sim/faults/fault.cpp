// SPDX-License-Identifier: MIT
#include "hal_sim/faults/fault.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>

#include "hal_sim/faults/kinds.h"
#include "sim_core/base/did_you_mean.h"
#include "sim_core/base/input_file.h"
#include "sim_core/load/schema_reader.h"

namespace faults {

namespace {

constexpr double kLongest = 1e7;  // s
constexpr std::size_t kLongestFile = 1u << 20;

using sim::KeySpec;
using sim::ValueType;

sim::Setter into_value(const std::string& name) {
  return [name](void* target, const sim::Value& value, const sim::WorldDesc&) {
    static_cast<Fault*>(target)->values[name] = value;
    return std::string();
  };
}

template <typename F>
sim::Setter into_fault(F assign) {
  return [assign](void* target, const sim::Value& value, const sim::WorldDesc&) {
    assign(*static_cast<Fault*>(target), value);
    return std::string();
  };
}

/// What a table of one kind may say. `path`: "fault" or "stimulus".
sim::SectionSpec section_of(const Kind& kind, const char* path) {
  const bool is_stimulus = std::strcmp(path, "stimulus") == 0;
  sim::SectionSpec spec{path, true, kind.does, {}};
  const auto nothing = [](void*, const sim::Value&, const sim::WorldDesc&) { return std::string(); };
  if (!is_stimulus)
    spec.keys.push_back({"kind", ValueType::Text, "", 0, 0, "", "required", "what is done", nothing});
  if (is_stimulus && kind.parameters.empty())
    spec.keys.push_back({kind.key, ValueType::Flag, "", 0, 0, "", "required", kind.does,
                         [](void*, const sim::Value& v, const sim::WorldDesc&) {
                           return v.flag ? std::string()
                                         : "got false, expected true; without it nothing is done";
                         }});
  for (std::size_t i = 0; i < kind.parameters.size(); ++i) {
    const Parameter& p = kind.parameters[i];
    spec.keys.push_back({is_stimulus && i == 0 ? kind.key : p.name, p.type, p.unit, p.least, p.most,
                         p.choices, p.usual, p.does, into_value(p.name)});
  }
  spec.keys.push_back({"robot", ValueType::Text, "", 0, 0, "", "\"*\"", "whom it befalls; * is every robot",
                       into_fault([](Fault& f, const sim::Value& v) { f.robot = v.text; })});
  spec.keys.push_back({"at_s", ValueType::Number, "s", 0, kLongest, "", "0", "when it begins",
                       into_fault([](Fault& f, const sim::Value& v) { f.at_s = v.number; })});
  spec.keys.push_back({"when", ValueType::Text, "", 0, 0, "", "", "condition at which it begins",
                       into_fault([](Fault& f, const sim::Value& v) { f.when = v.text; })});
  if (kind.lasts)
    spec.keys.push_back({"for_s", ValueType::Number, "s", 1e-6, kLongest, "", "",
                         "for how long; it stays without it",
                         into_fault([](Fault& f, const sim::Value& v) { f.for_s = v.number; })});
  return spec;
}

class Reader : private sim::SchemaReader {
 public:
  LoadedFaults read(std::string_view text, const std::string& path) {
    path_ = path;
    LoadedFaults out;
    if (const auto root = parse(text)) {
      read_table({"", false, "", {}}, {"fault", "stimulus"}, *root, nullptr, {});
      read_many("fault", *root, "fault", [&](const toml::table& t) { read_fault(t, out.faults); });
      read_many("stimulus", *root, "stimulus", [&](const toml::table& t) { read_stimulus(t, out.faults); });
    }
    sort_problems();
    out.problems = std::move(problems_);
    return out;
  }

 private:
  void read_fault(const toml::table& table, std::vector<Fault>& faults) {
    const toml::node* written_kind = table.get("kind");
    const std::string name =
        written_kind && written_kind->is_string() ? written_kind->as_string()->get() : std::string();
    const Kind* kind = find_kind(name);
    if (!kind)
      return problem(written_kind ? written_kind->source() : table.source(),
                     fmt::format("fault.kind: {}, expected one of twinpuck list faults{}",
                                 written_kind ? "got " + written(*written_kind) : std::string("missing"),
                                 sim::did_you_mean_tail(name, kind_names())));
    read_as(*kind, "fault", table, faults);
  }

  void read_stimulus(const toml::table& table, std::vector<Fault>& faults) {
    const Kind* kind = nullptr;
    std::vector<std::string> words;
    std::string all;
    for (const Kind& k : kinds()) {
      if (!k.is_stimulus()) continue;
      words.push_back(k.key);
      all += (all.empty() ? "" : ", ") + words.back();
      if (!table.get(k.key)) continue;
      if (kind)
        return problem(
            table.source(),
            fmt::format("stimulus: got {} and {}, expected one of them; write two tables", kind->key, k.key));
      kind = &k;
    }
    if (kind) return read_as(*kind, "stimulus", table, faults);
    // whichever key is the least like the others'
    std::string meant;
    for (const auto& [key, node] : table)
      if (meant.empty()) meant = sim::did_you_mean_tail(std::string(key.str()), words);
    problem(table.source(), fmt::format("stimulus: got none of {}, expected one{}", all, meant));
  }

  void read_as(const Kind& kind, const char* path, const toml::table& table, std::vector<Fault>& faults) {
    Fault fault;
    fault.kind = kind.name;
    fault.where = fmt::format("{}:{}:{}", path_, table.source().begin.line, table.source().begin.column);
    read_table(section_of(kind, path), {}, table, &fault, {});
    faults.push_back(std::move(fault));
  }

  std::string path_;
};

/// "2s", "1500ms", "2": seconds, as TOML writes a number; otherwise as it is.
std::string seconds_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = end ? end : "";
  if (end == text.c_str() || !std::isfinite(value)) return text;
  if (unit == "s" || unit.empty()) return fmt::format("{}", value);
  if (unit == "ms") return fmt::format("{}", value / 1000);
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') out += '\\';
    if (text[i] == '\\' && i + 1 < text.size()) out += text[i++];
    out += text[i];
  }
  return out + "\"";
}

/// Of these even "true" and "1" are words.
bool is_text_key(const Kind& kind, const std::string& key) {
  return key == "when" || key == "robot" ||
         std::any_of(kind.parameters.begin(), kind.parameters.end(),
                     [&](const Parameter& p) { return p.name == key && p.type == ValueType::Text; });
}

bool is_plain_toml(const std::string& text) {
  if (text == "true" || text == "false" || (!text.empty() && text[0] == '[')) return true;
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && end && *end == 0 && std::isfinite(value) &&
         text.find_first_of("xX") == std::string::npos;
}

/// Words of a line; quotes hold one together, and are marked as gone by `is_quoted`.
struct Word {
  std::string key, value;
  bool is_quoted = false, has_value = false;
};

bool split(const std::string& line, std::vector<Word>& words, std::string& error) {
  for (std::size_t i = 0; i < line.size();) {
    if (line[i] == ' ') {
      ++i;
      continue;
    }
    Word word;
    // A key, then perhaps a value: quoted, or up to the next space outside of brackets.
    while (i < line.size() && line[i] != ' ' && line[i] != '=') word.key += line[i++];
    if (i < line.size() && line[i] == '=') {
      word.has_value = true;
      ++i;
      if (i < line.size() && (line[i] == '"' || line[i] == '\'')) {
        const char quote = line[i++];
        word.is_quoted = true;
        while (i < line.size() && line[i] != quote) {
          // an escaped quotation mark of these is one; other escapes are TOML's
          if (line[i] == '\\' && i + 1 < line.size() && line[++i] != quote) word.value += '\\';
          word.value += line[i++];
        }
        if (i++ >= line.size()) {
          error = fmt::format("got {} without its closing quotation mark", word.key);
          return false;
        }
      } else {
        int depth = 0;
        while (i < line.size() && (line[i] != ' ' || depth > 0)) {
          depth += (line[i] == '[') - (line[i] == ']');
          word.value += line[i++];
        }
      }
    }
    words.push_back(std::move(word));
  }
  return true;
}

}  // namespace

Fault& Fault::set(const std::string& parameter, double value) {
  sim::Value& v = values[parameter];
  v.number = value;
  v.integer = static_cast<std::int64_t>(value);
  return *this;
}

Fault& Fault::set(const std::string& parameter, const std::string& value) {
  values[parameter].text = value;
  return *this;
}

std::string LoadedFaults::report(std::string_view file) const {
  std::string out;
  for (const sim::WorldProblem& p : problems)
    out +=
        (out.empty() ? "" : "\n") + (p.line > 0 ? fmt::format("{}:{}:{}: {}", file, p.line, p.column, p.text)
                                                : fmt::format("{}: {}", file, p.text));
  return out;
}

LoadedFaults load_faults(const std::string& path) {
  std::string text;
  const std::string wrong = sim::read_input_file(path, kLongestFile, text);
  if (wrong.empty()) return parse_faults(text, path);
  LoadedFaults out;
  out.problems.push_back({0, 0, wrong});
  return out;
}

LoadedFaults parse_faults(std::string_view text, const std::string& path) {
  return Reader().read(text, path);
}

bool parse_fault_line(const std::string& line, Fault& fault, std::string& error) {
  std::vector<Word> words;
  if (!split(line, words, error)) return false;
  if (words.empty() || words[0].has_value) {
    error = fmt::format(
        "got '{}', expected KIND [PARAMETER=VALUE]... [at=SECONDS] [for=SECONDS] [when=CONDITION]", line);
    return false;
  }
  if (!find_kind(words[0].key)) {
    error = fmt::format("got '{}', expected a kind of twinpuck list faults{}", words[0].key,
                        sim::did_you_mean_tail(words[0].key, kind_names()));
    return false;
  }
  // The line becomes a file of one fault, so both are read, and refused, by one reader.
  std::string text = "[[fault]]\nkind = " + quoted(words[0].key) + "\n";
  for (std::size_t i = 1; i < words.size(); ++i) {
    Word& w = words[i];
    if (!w.has_value || w.key.empty() ||
        w.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos) {
      error = fmt::format("got '{}', expected PARAMETER=VALUE", w.key);
      return false;
    }
    if (w.key == "at" || w.key == "for") w.key += "_s";
    if (w.key == "at_s" || w.key == "for_s") w.value = seconds_of(w.value);
    const bool is_text = is_text_key(*find_kind(words[0].key), w.key);
    text += w.key + " = " + (!is_text && !w.is_quoted && is_plain_toml(w.value) ? w.value : quoted(w.value)) +
            "\n";
  }
  const LoadedFaults read = parse_faults(text, "");
  if (!read.problems.empty()) {
    for (const auto& problem : read.problems) error += (error.empty() ? "" : "; ") + problem.text;
    return false;
  }
  fault = read.faults.at(0);
  fault.where.clear();
  return true;
}

}  // namespace faults
