// SPDX-License-Identifier: MIT
#include "hal_sim/chip/named_functions.h"

#include <algorithm>

#include "hal_sim/api/host_index.h"
#include "hal_sim/chip/program_places.h"
#include "sim_core/base/did_you_mean.h"

namespace chip {

const char* const kMeasureAlone =
    "; to measure it alone, declare it __attribute__((noinline)), or build with --opt -O0, which takes "
    "longer";

std::vector<std::uint32_t> copies_of(const dspic::FirmwareFile& file, const std::string& function) {
  std::vector<std::uint32_t> copies;
  for (const auto& f : file.debug.value().functions)
    if (f.name == function) copies.insert(copies.end(), f.inlined_at.begin(), f.inlined_at.end());
  // of a function of the program's own none that the library happens to name alike
  const auto label = file.functions.find(function);
  if (label != file.functions.end() && ProgramPlaces::is_own(file, label->second))
    copies.erase(std::remove_if(copies.begin(), copies.end(),
                                [&](std::uint32_t copy) { return !ProgramPlaces::is_own(file, copy); }),
                 copies.end());
  std::sort(copies.begin(), copies.end());
  copies.erase(std::unique(copies.begin(), copies.end()), copies.end());
  return copies;
}

std::set<std::string> holders_of(const dspic::FirmwareFile& file, const std::string& function) {
  std::set<std::string> holders;
  for (const std::uint32_t address : copies_of(file, function))
    if (const auto* in = file.code.function_at(address)) holders.insert(in->name);
  return holders;
}

namespace {

/// "main(), step()".
std::string list_of(const std::set<std::string>& holders) {
  std::string list;
  for (const std::string& holder : holders) list += (list.empty() ? "" : ", ") + holder + "()";
  return list;
}

}  // namespace

std::string copies_note(const dspic::FirmwareFile& file, const std::string& function) {
  const std::string list = list_of(holders_of(file, function));
  return list.empty() ? "" : "; its copies in " + list + " are not counted" + kMeasureAlone;
}

std::string why_no_code(const dspic::FirmwareFile& file, const std::string& function) {
  if (file.code.function_named(function)) return "";
  const std::string list = list_of(holders_of(file, function));
  if (!list.empty()) return "is part of " + list + kMeasureAlone;
  const auto label = file.functions.find(function);
  if (label != file.functions.end() && label->second >= dspic::kHostStart)
    return "is played by the simulator; with --hal dspic it is the robot's own code";
  std::vector<std::string> known;
  for (const auto& f : file.code.functions) known.push_back(f.name);
  for (const auto& f : file.debug.value().functions) {
    if (!f.inlined_at.empty()) known.push_back(f.name);
    if (f.name == function) return "has no code: nothing calls it, so the linker left it out";
  }
  return "is not in the program" + sim::did_you_mean_tail(function, known);
}

}  // namespace chip
