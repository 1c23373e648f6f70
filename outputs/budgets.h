// SPDX-License-Identifier: MIT
// Budgets: what functions, interrupts and the whole program may take, held against a profile.
//
//   [function.control]      max_us = 200        mean_cycles = 1500
//   [interrupt.T2]          max_cycles = 120    max_latency_us = 20    merged = 0    missed = 0
//   [program]               max_turn_us = 5000  max_stack = 512        max_load = 0.5
//
// All are optional; each gives a line "pass" or "FAIL". A function that was never called fails, unless its
// code tells what it takes: nothing is known about it.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hal_sim/chip/profile.h"

namespace outputs {

class Budgets {
 public:
  /// False: lines in `problems`, "budgets.toml:3:1: unknown key ...".
  bool read(const std::string& file, std::vector<std::string>& problems);
  /// "control=1000": what a call of a function may take at most, in cycles. False: a line in `problems`.
  bool add(const std::string& budget, std::vector<std::string>& problems);
  /// Names that the program has not, and functions without code of their own, and how they are measured;
  /// empty: there are none.
  std::vector<std::string> unknown(const dspic::FirmwareFile& program) const;

  struct Verdict {
    bool passes = true;
    std::string text;  ///< "pass  control: max 1,204 of 2,949 cycles"
  };
  /// `program`: what was measured. `most`: what functions take at most by their code, for those
  /// that were not called.
  std::vector<Verdict> judge(const chip::ProfileReport& report, const dspic::FirmwareFile& program,
                             const std::map<std::string, double>& most = {}) const;

 private:
  enum class Of { Function, Interrupt, Program };
  struct Budget {
    Of of;
    std::string name, key;  ///< key without its unit
    double limit = 0;       ///< cycles, bytes, times or a share
    std::string place;      ///< "budgets.toml:3:1"
  };
  Verdict judge(const Budget& budget, const chip::ProfileReport& report,
                const std::map<std::string, double>& most) const;
  std::vector<Budget> budgets_;
};

}  // namespace outputs
