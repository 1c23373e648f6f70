// SPDX-License-Identifier: MIT
// How often each instruction of a robot's program ran, and each condition held: what coverage is made of.
#pragma once
#include <cstdint>
#include <vector>

#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/step_watch.h"

namespace chip {

class StepCounts final : public StepWatch {
 public:
  explicit StepCounts(const dspic::FirmwareFile& file);
  void after(const Step& step) override;
  void led_to_reset(unsigned pc) override {
    if (pc / 2 < ran_.size()) ++ran_[pc / 2];
  }

  /// Of the instruction at a program address; all iterations of a REPEAT are one.
  std::uint64_t ran(std::uint32_t address) const { return count(ran_, address); }
  /// How often it did not go on with the word behind it: a branch taken, an instruction skipped.
  std::uint64_t jumped(std::uint32_t address) const { return count(jumped_, address); }

 private:
  static std::uint64_t count(const std::vector<std::uint64_t>& of, std::uint32_t address) {
    return address / 2 < of.size() ? of[address / 2] : 0;
  }
  std::vector<std::uint64_t> ran_, jumped_;  // by word, up to the last of the program
  std::vector<bool> is_jump_;
};

/// Is the word a branch with a condition, or an instruction that may skip the next?
bool is_conditional(std::uint32_t word);

}  // namespace chip
