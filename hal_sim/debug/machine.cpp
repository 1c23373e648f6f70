// SPDX-License-Identifier: MIT
#include "hal_sim/debug/machine.h"

#include <fmt/format.h>

#include "dspic30/memory/sfr_table.h"

namespace debug {

std::optional<Data> find_sfr(const std::string& name) {
  const std::size_t dot = name.find('.');
  std::string of = name.substr(0, dot);
  if (dot != std::string::npos && of.size() > 4 && of.compare(of.size() - 4, 4, "bits") == 0)
    of.resize(of.size() - 4);
  const dspic::SfrInfo* info = dspic::sfr_named(of);
  if (!info) return {};
  if (dot == std::string::npos) return Data{info->address};
  for (const dspic::SfrField& field : dspic::fields_of(*info))
    if (field.name == name.substr(dot + 1)) return Data{info->address, 2, field.bit, field.width};
  return {};
}

std::string told_interrupt(const std::string& name, bool flag, bool enabled, int priority, int level,
                           bool is_held_by_disi) {
  std::string held;
  if (!enabled)
    held = "not enabled";
  else if (priority <= level)
    held = fmt::format("held off: priority {}, the processor is at {}", priority, level);
  else if (is_held_by_disi && priority < 7)
    held = "held off by DISI";
  else
    held = fmt::format("enabled, priority {} above the processor's {}", priority, level);
  return fmt::format("{}: {}, flag {}", name, held, flag ? "set" : "clear");
}

std::string told_timer(const std::string& name, const std::function<unsigned(unsigned address)>& word) {
  if (name.size() != 2 || name[0] != 'T') return "";
  const auto* control = dspic::sfr_named(name + "CON");
  const bool is_on = control && (word(control->address) & 0x8000);
  return is_on ? "" : fmt::format("; timer {} is off ({}CON.TON = 0)", name[1], name);
}

}  // namespace debug
