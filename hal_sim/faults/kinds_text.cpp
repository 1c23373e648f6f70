// SPDX-License-Identifier: MIT
// The table for people: twinpuck list faults, and the tables in docs/testing.md (tools/dev/pages.cpp).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "hal_sim/faults/kinds.h"
#include "hal_sim/signals/signals.h"

namespace faults {

namespace {

std::string choices_text(const Parameter& p) {
  std::string text = p.choices;
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 4)
    text.replace(at, 1, " or ");
  return text;
}

/// "0 to 1", "left or right or both", "text".
std::string range_text(const Parameter& p) {
  switch (p.type) {
    case sim::ValueType::Choice:
      return choices_text(p);
    case sim::ValueType::Text:
    case sim::ValueType::Bytes:
      return "text";
    case sim::ValueType::Triple:
      return "three numbers";
    default:
      return std::fabs(p.most) >= 1e12 ? "a number" : fmt::format("{} to {}", p.least, p.most);
  }
}

std::string unit_text(const Parameter& p) { return *p.unit ? std::string(" ") + p.unit : ""; }

bool is_required(const Parameter& p) { return std::strcmp(p.usual, "required") == 0; }

void add_kind(std::string& text, const Kind& kind) {
  text +=
      fmt::format("\n#### `{}`\n\n{}{}. {}\n\nIt took effect when {}.{}\n", kind.name,
                  static_cast<char>(std::toupper(static_cast<unsigned char>(kind.does[0]))), kind.does + 1,
                  kind.meaning, kind.noticed, kind.lasts ? "" : " It is over when it is done: no `for_s`.");
  if (kind.is_stimulus())
    text += fmt::format(
        "\nIn `[[stimulus]]`: `{}`{}.\n", kind.key,
        kind.parameters.empty() ? " = true" : fmt::format(" stands for `{}`", kind.parameters[0].name));
  if (kind.parameters.empty()) return;
  text += "\n| parameter | range | usual | |\n|---|---|---|---|\n";
  for (const Parameter& p : kind.parameters)
    text += fmt::format("| `{}` | {}{} | {} | {} |\n", p.name, range_text(p), unit_text(p),
                        is_required(p) ? "needed"
                        : *p.usual     ? "`" + std::string(p.usual) + "`"
                                       : "",
                        p.does);
}

}  // namespace

std::string text_table() {
  std::string text;
  for (const Kind& kind : kinds()) {
    text += fmt::format("  {:<20} {}\n", kind.name, kind.does);
    for (const Parameter& p : kind.parameters)
      text += fmt::format("  {:<20}   {}: {}{}{}; {}\n", "", p.name, range_text(p), unit_text(p),
                          is_required(p) ? ""
                          : *p.usual     ? fmt::format(", usually {}", p.usual)
                                         : "",
                          p.does);
  }
  return text;
}

std::string page() {
  std::string text = "\n### Signals\n\n";
  text += signals::page_table();
  text += "\n### Kinds\n\n| kind | what is done |\n|---|---|\n";
  for (const Kind& kind : kinds()) text += fmt::format("| [`{0}`](#{0}) | {1} |\n", kind.name, kind.does);
  for (const Kind& kind : kinds()) add_kind(text, kind);
  return text;
}

}  // namespace faults
