// SPDX-License-Identifier: MIT
#include "outputs/budgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "dspic30/periph/vectors.h"
#include "hal_sim/board/cycle.h"
#include "hal_sim/chip/named_functions.h"
#include "sim_core/base/input_file.h"
#include "sim_core/load/toml_parser.h"
#include "sim_core/load/world_loader.h"

namespace outputs {

namespace {

constexpr std::size_t kLongestBudgets = 1u << 20;  // bytes

// keys with _cycles or _us behind them, and keys with a unit of their own
const std::vector<std::string> kOfFunctions{"max_cycles", "max_us", "mean_cycles", "mean_us"};
const std::vector<std::string> kOfInterrupts{
    "max_cycles",     "max_us",        "mean_cycles",        "mean_us",
    "max_latency_us", "max_jitter_us", "max_latency_cycles", "max_jitter_cycles",
    "merged",         "missed"};
const std::vector<std::string> kOfProgram{"max_turn_us",      "max_turn_cycles", "mean_turn_us",
                                          "mean_turn_cycles", "max_stack",       "max_load"};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string hint(const std::string& word, const std::vector<std::string>& known) {
  const std::string guess = sim::did_you_mean(word, known);
  return guess.empty() ? fmt::format(", expected one of {}", fmt::join(known, ", "))
                       : "; did you mean '" + guess + "'?";
}

}  // namespace

bool Budgets::read(const std::string& file, std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  const auto problem = [&](const toml::source_region& at, const std::string& what) {
    problems.push_back(fmt::format("{}:{}:{}: {}", file, at.begin.line, at.begin.column, what));
  };
  std::string text;
  if (const std::string wrong = sim::read_input_file(file, kLongestBudgets, text); !wrong.empty()) {
    problems.push_back(file + ": --budgets: " + wrong);
    return false;
  }
  if (const sim::TomlTrap trap = sim::find_toml_trap(text); trap.line > 0) {
    problems.push_back(fmt::format("{}:{}:{}: {}", file, trap.line, trap.column, trap.text));
    return false;
  }
  const toml::parse_result parsed = toml::parse(text, file);
  if (!parsed) {
    problem(parsed.error().source(), std::string(parsed.error().description()));
    return false;
  }
  const auto keys = [&](Of of, const std::string& name, const toml::table& table,
                        const std::vector<std::string>& known) {
    for (const auto& [key, node] : table) {
      Budget budget{of, name, std::string(key.str()), 0, ""};
      const double limit = node.is_boolean() ? -1 : node.value<double>().value_or(-1);
      if (std::find(known.begin(), known.end(), budget.key) == known.end()) {
        problem(key.source(), "unknown key '" + budget.key + "'" + hint(budget.key, known));
      } else if (!(limit >= 0 && limit < 1e15)) {
        std::ostringstream got;
        got << toml::node_view<const toml::node>(node);
        problem(node.source(), budget.key + ": got " + got.str() + ", expected a number, 0 or more");
      } else {
        budget.limit = limit;
        budget.place = fmt::format("{}:{}:{}", file, key.source().begin.line, key.source().begin.column);
        for (const std::string unit : {"_us", "_cycles"})
          if (ends_with(budget.key, unit)) budget.key.resize(budget.key.size() - unit.size());
        if (ends_with(std::string(key.str()), "_us"))
          budget.limit *= static_cast<double>(board::kFcyHz) * 1e-6;
        budgets_.push_back(std::move(budget));
      }
    }
  };
  for (const auto& [key, node] : parsed.table()) {
    const std::string section(key.str());
    const toml::table* table = node.as_table();
    const bool is_program = section == "program";
    if (!is_program && section != "function" && section != "interrupt") {
      problem(key.source(),
              "unknown section '" + section + "'" + hint(section, {"function", "interrupt", "program"}));
    } else if (!table) {
      problem(node.source(), section + ": expected a table");
    } else if (is_program) {
      keys(Of::Program, "program", *table, kOfProgram);
    } else {
      const bool is_function = section == "function";
      for (const auto& [name, inner] : *table)
        if (const toml::table* of_one = inner.as_table())
          keys(is_function ? Of::Function : Of::Interrupt, std::string(name.str()), *of_one,
               is_function ? kOfFunctions : kOfInterrupts);
        else
          problem(inner.source(), fmt::format("got a value, expected a section such as [{}.{}]", section,
                                              is_function ? "control" : "T1"));
    }
  }
  if (problems.size() == before && budgets_.empty())
    problems.push_back(
        file + ": --budgets: there is no budget in it, expected a section such as [function.control]");
  return problems.size() == before;
}

bool Budgets::add(const std::string& budget, std::vector<std::string>& problems) {
  const std::size_t equals = budget.find('=');
  char* end = nullptr;
  const double limit = equals == std::string::npos ? -1 : std::strtod(budget.c_str() + equals + 1, &end);
  const bool is_number = end && *end == 0 && end > budget.c_str() + equals + 1;
  if (equals == 0 || !is_number || !(limit >= 0 && limit < 1e15)) {
    problems.push_back("command line: --budget: got '" + budget + "', expected NAME=CYCLES");
    return false;
  }
  budgets_.push_back({Of::Function, budget.substr(0, equals), "max", limit, "command line: --budget"});
  return true;
}

std::vector<std::string> Budgets::unknown(const dspic::FirmwareFile& program) const {
  std::vector<std::string> problems, vectors;
  for (int v = 1; v < dspic::kVectors; ++v) vectors.push_back(dspic::vector_name(v));
  for (const Budget& b : budgets_) {
    if (b.of == Of::Function) {
      const std::string why = chip::why_no_code(program, b.name);
      if (!why.empty())
        problems.push_back(fmt::format("{}: got function '{}', which {}", b.place, b.name, why));
    }
    if (b.of != Of::Interrupt || std::find(vectors.begin(), vectors.end(), b.name) != vectors.end()) continue;
    problems.push_back(fmt::format("{}: got interrupt '{}', which the program has not{}", b.place, b.name,
                                   sim::did_you_mean_tail(b.name, vectors)));
  }
  return problems;
}

std::vector<Budgets::Verdict> Budgets::judge(const chip::ProfileReport& report,
                                             const dspic::FirmwareFile& program,
                                             const std::map<std::string, double>& most) const {
  std::vector<Verdict> all;
  for (const Budget& budget : budgets_) {
    all.push_back(judge(budget, report, most));
    if (budget.of == Of::Function) all.back().text += chip::copies_note(program, budget.name);
  }
  return all;
}

Budgets::Verdict Budgets::judge(const Budget& budget, const chip::ProfileReport& report,
                                const std::map<std::string, double>& most) const {
  double got = 0;
  const char* unit = " cycles";
  std::string missing;
  const auto of_spread = [&](const chip::Spread& s, const char* none) {
    if (s.count == 0) missing = none;
    got = budget.key.rfind("mean", 0) == 0 ? s.mean() : static_cast<double>(s.max);
  };
  if (budget.of == Of::Function) {
    missing = "was never called";
    for (const auto& f : report.functions)
      if (f.name == budget.name) {
        missing.clear();
        of_spread(f.cycles, "never returned");
      }
    if (const auto by_code = most.find(budget.name); !missing.empty() && by_code != most.end()) {
      missing.clear();
      got = by_code->second;
      unit = " cycles, by its code";
    }
  } else if (budget.of == Of::Interrupt &&
             std::count(report.by_heart.begin(), report.by_heart.end(), budget.name)) {
    missing = "is known by heart and not measured; use --hal dspic";
  } else if (budget.of == Of::Interrupt) {
    missing = "was never served";
    for (const auto& i : report.interrupts) {
      if (i.name != budget.name) continue;
      missing.clear();
      if (budget.key == "merged" || budget.key == "missed") {
        got = static_cast<double>(budget.key == "merged" ? i.merged : i.missed);
        unit = " times";
      } else if (budget.key == "max_latency") {
        of_spread(i.latency, "was never served");
      } else if (budget.key == "max_jitter") {
        of_spread(i.latency, "was never served");
        got = static_cast<double>(i.latency.max - i.latency.min);
      } else {
        of_spread(i.cycles, "never returned");
      }
    }
  } else if (budget.key == "max_stack") {
    got = report.stack_bytes;
    unit = " bytes";
  } else if (budget.key == "max_load") {
    got = report.load();
    unit = "";
  } else {
    of_spread(report.turn, "has no main loop");
  }
  const bool passes = missing.empty() && got <= budget.limit;
  const int decimals = budget.key == "max_load" ? 3 : 0;
  const std::string what = fmt::format("{}  {}: {}", passes ? "pass" : "FAIL", budget.name, budget.key);
  return {passes, missing.empty() ? fmt::format("{} {:.{}f} of {:.{}f}{}", what, got, decimals, budget.limit,
                                                decimals, unit)
                                  : what + ": it " + missing};
}

}  // namespace outputs
