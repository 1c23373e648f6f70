// SPDX-License-Identifier: MIT
#include "exercises/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim_core/base/input_file.h"
#include "sim_core/load/toml_parser.h"
#include "sim_core/load/world_loader.h"

namespace lab {

namespace {

constexpr std::size_t kLongestFile = 1u << 20;  // bytes

constexpr const char* kMeasureNames[kMeasures] = {
    "standstill_s", "wall_touch_s", "touch_s",   "collisions",  "distance_m",  "escape_s",
    "slip_m",       "speed",        "rows",      "range_m",     "detection_m", "centre_weight",
    "outer_weight", "restarts",     "restart_m", "straightness"};

// --- what a key's value may be

bool is_text(const toml::node& n) { return n.is_string(); }
bool is_number(const toml::node& n) { return n.is_number(); }
bool is_flag(const toml::node& n) { return n.is_boolean(); }
bool is_list(const toml::node& n) { return n.is_array(); }
bool is_table(const toml::node& n) { return n.is_table(); }
bool is_number_or_list(const toml::node& n) { return n.is_number() || n.is_array(); }
bool is_place(const toml::node& n) { return n.is_table() || n.value_or(std::string()) == "anywhere"; }

const char* kind_of(const toml::node& n) {
  return n.is_string()    ? "text"
         : n.is_number()  ? "a number"
         : n.is_boolean() ? "true or false"
         : n.is_array()   ? "a list"
         : n.is_table()   ? "a table"
                          : "a date or time";
}

struct Key {
  const char* name;
  bool (*fits)(const toml::node&);
  const char* expected;
};
constexpr Key kOfTable[] = {{"exercise", is_list, "tables [[exercise]]"}};
constexpr Key kOfExercise[] = {
    {"id", is_text, "text"}, {"title", is_text, "text"}, {"step", is_list, "tables [[exercise.step]]"}};
constexpr Key kOfStep[] = {{"says", is_text, "text"},
                           {"worlds", is_list, "a list of names"},
                           {"firmware", is_text, "text"},
                           {"supervisor", is_text, "text"},
                           {"seconds", is_number_or_list, "a number or [quick, full]"},
                           {"seeds", is_list, "[quick, full]"},
                           {"noise_scales", is_list, "a list of numbers"},
                           {"share", is_list, "[lowest, highest]"},
                           {"spread", is_table, "a table"},
                           {"start", is_place, "\"anywhere\" or a table"},
                           {"region", is_list, "a list of four numbers"},
                           {"at_most", is_table, "a table of measures"},
                           {"at_least", is_table, "a table of measures"},
                           {"show", is_list, "a list of texts"},
                           {"by_world", is_flag, "true or false"},
                           {"answer", is_text, "text"},
                           {"sensor", is_flag, "true or false"}};
constexpr Key kOfSpread[] = {
    {"gain", is_number, "a number"}, {"offset", is_number, "a number"}, {"wheel", is_number, "a number"}};
constexpr Key kOfStart[] = {{"x", is_list, "[lowest, highest]"},
                            {"y", is_list, "[lowest, highest]"},
                            {"heading", is_list, "[lowest, highest]"}};

class Reader {
 public:
  Reader(const std::string& file, std::vector<std::string>& problems) : file_(file), problems_(problems) {}

  std::vector<Exercise> exercises(const toml::table& root) {
    only(root, kOfTable);
    std::vector<Exercise> all;
    each_table(root, "exercise", [&](const toml::table& t) {
      only(t, kOfExercise);
      Exercise e{text(t, "id"), text(t, "title"), {}};
      each_table(t, "step", [&](const toml::table& s) { e.steps.push_back(step(s)); });
      if (e.id.empty()) problem(t, "exercise: got no id, expected one such as \"I1\"");
      if (e.steps.empty()) problem(t, "exercise: got no steps, expected one or more");
      all.push_back(std::move(e));
    });
    return all;
  }

 private:
  void problem(const toml::node& where, const std::string& what) {
    const auto& at = where.source().begin;
    problems_.push_back(fmt::format("{}:{}:{}: {}", file_, at.line, at.column, what));
  }

  // unknown keys, and values of another kind than theirs
  template <std::size_t N>
  void only(const toml::table& t, const Key (&known)[N]) {
    for (const auto& [key, node] : t) {
      const std::string name(key.str());
      const Key* const found =
          std::find_if(std::begin(known), std::end(known), [&](const Key& k) { return name == k.name; });
      if (found == std::end(known)) {
        std::vector<std::string> names;
        for (const Key& k : known) names.push_back(k.name);
        problem(node, "unknown key '" + name + "'" + sim::did_you_mean_tail(name, names));
      } else if (!found->fits(node)) {
        problem(node, fmt::format("{}: got {}, expected {}", name, kind_of(node), found->expected));
      }
    }
  }

  template <typename F>
  void each_table(const toml::table& t, const char* key, F each) {
    const toml::array* list = t[key].as_array();
    if (!list) return;
    for (const toml::node& n : *list) {
      if (const toml::table* item = n.as_table())
        each(*item);
      else
        problem(n, std::string(key) + ": got a value, expected a table");
    }
  }

  std::string text(const toml::table& t, const char* key) { return t[key].value_or(std::string()); }
  double number(const toml::table& t, const char* key, double otherwise) {
    return t[key].value_or(otherwise);
  }

  std::vector<double> numbers(const toml::table& t, const char* key, std::size_t count = 0) {
    std::vector<double> out;
    const toml::array* list = t[key].as_array();
    if (!list) return out;
    for (const toml::node& n : *list)
      if (const auto v = n.value<double>()) out.push_back(*v);
    if (out.size() != list->size() || (count && out.size() != count))
      problem(*list, fmt::format("{}: got {} numbers in {} places, expected {}", key, out.size(),
                                 list->size(), count ? std::to_string(count) : "numbers alone"));
    return out;
  }

  Span span(const toml::table& t, const char* key, Span otherwise) {
    const auto v = numbers(t, key, 2);
    return v.size() == 2 ? Span{v[0], v[1]} : otherwise;
  }

  Measure measure(const toml::node& where, const std::string& name) {
    const std::vector<std::string> known(std::begin(kMeasureNames), std::end(kMeasureNames));
    for (std::size_t i = 0; i < known.size(); ++i)
      if (known[i] == name) return static_cast<Measure>(i);
    problem(where,
            "got measure '" + name + "', expected one that is known" + sim::did_you_mean_tail(name, known));
    return Measure::Count;
  }

  void bounds(const toml::table& t, const char* key, Step& s) {
    const double none = std::numeric_limits<double>::infinity();
    const toml::table* list = t[key].as_table();
    if (!list) return;
    for (const auto& [name_of, node] : *list) {
      const std::string name(name_of.str());
      const Measure m = measure(node, name);
      const double limit = node.value<double>().value_or(0);
      if (!node.is_number()) problem(node, fmt::format("{}: got {}, expected a number", name, kind_of(node)));
      if (m == Measure::Count) continue;
      const bool most = std::string(key) == "at_most";
      s.bounds.push_back({m, most ? -none : limit, most ? limit : none});
    }
  }

  void shown(const toml::table& t, Step& s) {
    const toml::array* list = t["show"].as_array();
    if (!list) return;
    const std::vector<std::string> hows{"max", "min", "mean", "median"};
    for (const toml::node& n : *list) {
      const std::string words = n.value_or(std::string());
      const auto gap = words.find(' ');
      const auto how = std::find(hows.begin(), hows.end(), words.substr(0, gap));
      if (gap == std::string::npos || how == hows.end()) {
        problem(n, "show: got '" + words + "', expected max, min, mean or median and a measure");
        continue;
      }
      const Measure m = measure(n, words.substr(gap + 1));
      if (m != Measure::Count) s.shown.push_back({static_cast<Shown::How>(how - hows.begin()), m});
    }
  }

  // one pair for all noise scales, or one each
  void shares(const toml::table& t, Step& s) {
    s.shares = {{1, 1}};
    const toml::array* list = t["share"].as_array();
    if (!list || list->empty()) return;
    if (!list->get(0)->is_array()) {
      s.shares = {span(t, "share", {1, 1})};
      return;
    }
    s.shares.clear();
    for (const toml::node& n : *list) {
      const toml::array* pair = n.as_array();
      if (!pair || pair->size() != 2 || !pair->get(0)->is_number() || !pair->get(1)->is_number())
        problem(n, "share: got something else, expected [lowest, highest]");
      else
        s.shares.push_back({pair->get(0)->value_or(0.0), pair->get(1)->value_or(1.0)});
    }
    if (s.shares.size() != s.noise_scales.size())
      problem(*list, fmt::format("share: got {} pairs, expected {}, one per noise scale", s.shares.size(),
                                 s.noise_scales.size()));
  }

  Step step(const toml::table& t) {
    only(t, kOfStep);
    Step s;
    s.says = text(t, "says");
    s.answer = text(t, "answer");
    if (!s.answer.empty()) s.kind = Step::Kind::Answer;
    if (t["sensor"].value_or(false)) s.kind = Step::Kind::Sensor;
    if (const toml::array* list = t["worlds"].as_array())
      for (const toml::node& n : *list) {
        if (!n.is_string()) problem(n, fmt::format("worlds: got {}, expected a world's name", kind_of(n)));
        s.worlds.push_back(n.value_or(std::string()));
      }
    const bool is_told = t.contains("worlds") && !t["worlds"].is_array();  // as no list
    if (s.kind != Step::Kind::Answer && s.worlds.empty() && !is_told)
      problem(t, "step: got no worlds, expected one or more");
    s.firmware = text(t, "firmware");
    s.supervisor = text(t, "supervisor");
    s.seconds = s.full_seconds = number(t, "seconds", 60);
    if (t["seconds"].is_array()) {
      const Span both = span(t, "seconds", {60, 60});
      s.seconds = both.low, s.full_seconds = both.high;
    }
    const auto seeds = numbers(t, "seeds", 2);
    if (seeds.size() == 2)
      s.quick_seeds = static_cast<int>(seeds[0]), s.full_seeds = static_cast<int>(seeds[1]);
    s.noise_scales = numbers(t, "noise_scales");
    shares(t, s);
    if (const toml::table* spread = t["spread"].as_table()) {
      only(*spread, kOfSpread);
      s.gain_spread = number(*spread, "gain", 0);
      s.offset_spread_counts = number(*spread, "offset", 0);
      s.wheel_spread = number(*spread, "wheel", 0);
    }
    s.start.anywhere = text(t, "start") == "anywhere";
    if (const toml::table* start = t["start"].as_table()) {
      only(*start, kOfStart);
      s.start.x_m = span(*start, "x", {});
      s.start.y_m = span(*start, "y", {});
      s.start.heading_deg = span(*start, "heading", {});
    }
    if (t.contains("region")) s.region = numbers(t, "region", 4);
    bounds(t, "at_most", s);
    bounds(t, "at_least", s);
    shown(t, s);
    s.by_world = t["by_world"].value_or(false);
    return s;
  }

  const std::string& file_;
  std::vector<std::string>& problems_;
};

}  // namespace

std::string own_program(const Step& step) {
  return step.firmware.rfind("lab/", 0) == 0 ? step.firmware.substr(4) : "";
}

const char* measure_name(Measure m) { return kMeasureNames[static_cast<std::size_t>(m)]; }

std::vector<Exercise> read_table(const std::string& file, std::vector<std::string>& problems) {
  std::string text;
  const std::string wrong = sim::read_input_file(file, kLongestFile, text);
  if (wrong.empty()) return parse_table(text, file, problems);
  problems.push_back(file + ": " + wrong);
  return {};
}

std::vector<Exercise> parse_table(const std::string& text, const std::string& file,
                                  std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  if (const sim::TomlTrap trap = sim::find_toml_trap(text); trap.line > 0) {
    problems.push_back(fmt::format("{}:{}:{}: {}", file, trap.line, trap.column, trap.text));
    return {};
  }
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    const auto& at = parsed.error().source().begin;
    problems.push_back(fmt::format("{}:{}:{}: {}", file, at.line, at.column, parsed.error().description()));
    return {};
  }
  auto all = Reader(file, problems).exercises(parsed.table());
  if (problems.size() == before && all.empty())
    problems.push_back(file + ": exercise: got none, expected one or more");
  return problems.size() == before ? all : std::vector<Exercise>();
}

}  // namespace lab
