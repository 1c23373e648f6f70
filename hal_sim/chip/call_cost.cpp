// SPDX-License-Identifier: MIT
#include "hal_sim/chip/call_cost.h"

#include "hal_sim/chip/code_cycles.h"
#include "hal_sim/chip/named_functions.h"

namespace chip {

bool cost_of_call(const dspic::FirmwareFile& file, const Profile* profile, const std::string& function,
                  CallCost& cost, std::string& error) {
  if (profile) {
    const ProfileReport report = profile->report();
    for (const auto& f : report.functions)
      if (f.name == function && f.cycles.count > 0) {
        cost = {f.cycles.count, f.cycles.sum, static_cast<double>(f.cycles.min), f.cycles.mean(),
                static_cast<double>(f.cycles.max)};
        return true;
      }
  }
  const auto* const known = file.code.function_named(function);
  if (!known) {
    error = "no function '" + function + "' in the firmware: it " + why_no_code(file, function);
    return false;
  }
  const PathCycles code = CodeCycles(file).of_function(known->begin);
  if (!code.is_known()) {
    error = function + "(): only a run tells what it takes: it " + code.why_not +
            (profile ? "; it was not called" : "; have the robot measured, from before the first run") +
            copies_note(file, function);
    return false;
  }
  const auto least = static_cast<double>(code.least), most = static_cast<double>(code.most);
  cost = {0, 0, least, code.least == code.most ? least : -1, most};
  return true;
}

}  // namespace chip
