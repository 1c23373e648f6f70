// SPDX-License-Identifier: MIT
// Coverage of a run: counts what the chip's code of all robots does, and adds it to an lcov file.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace chip {
class ChipRunner;
class StepCounts;
}  // namespace chip

namespace twin {

class CoverageRun {
 public:
  /// Counts from here on. Null, with lines in `problems`, when no robot runs code of the chip, or when `file`
  /// holds counts of other sources, or none. The twin outlives it.
  static std::unique_ptr<CoverageRun> open(Twin& twin, const std::string& file,
                                           std::vector<std::string>& problems);
  ~CoverageRun();
  /// Robots that were flashed since are counted, too: between ticks.
  void look();
  /// Adds the counts to the file, once; other processes may do so at the same time.
  void finish(std::vector<std::string>& problems);

 private:
  struct Counted;
  CoverageRun(Twin& twin, std::string file);
  Twin& twin_;
  const std::string file_;
  std::vector<std::unique_ptr<Counted>> counted_;  // flashed ones, too
  std::map<int, Counted*> now_;                    // by robot
};

}  // namespace twin
