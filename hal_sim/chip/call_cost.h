// SPDX-License-Identifier: MIT
// What a call of a function takes, for tests: of a run that was measured, else by its code.
#pragma once
#include <string>

#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/profile.h"

namespace chip {

/// In cycles, callees included, handlers not.
struct CallCost {
  std::int64_t calls = 0;             ///< 0: by its code alone
  Cycle total = 0;                    ///< of all calls
  double min = 0, mean = 0, max = 0;  ///< mean: -1 when only the code is known and has several ways
};

/// `profile`: of the run so far; null: it was not measured. False: there is no such function, or only a run
/// tells; `error` says which, and what to do.
bool cost_of_call(const dspic::FirmwareFile& file, const Profile* profile, const std::string& function,
                  CallCost& cost, std::string& error);

}  // namespace chip
