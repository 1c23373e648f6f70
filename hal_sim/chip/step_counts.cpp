// SPDX-License-Identifier: MIT
#include "hal_sim/chip/step_counts.h"

#include <string_view>

#include "dspic30/core/instruction_table.h"
#include "dspic30/memory/program_memory.h"

namespace chip {

namespace {

bool begins(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

// a jump may lead to itself; what else is followed by itself is being repeated
bool is_plain_jump(std::uint32_t word) {
  const dspic::Row* const row = dspic::find_row(word);
  if (!row) return false;
  for (const char* jump : {"BRA", "GOTO", "CALL", "RCALL", "RET"})
    if (begins(row->mnemonic, jump)) return true;
  return false;
}

}  // namespace

bool is_conditional(std::uint32_t word) {
  const dspic::Row* const row = dspic::find_row(word);
  if (!row) return false;
  for (const char* condition : {"BRA ", "BTSS", "BTSC", "CPSEQ", "CPSNE", "CPSGT", "CPSLT"})
    if (begins(row->mnemonic, condition)) return true;
  return false;
}

StepCounts::StepCounts(const dspic::FirmwareFile& file) {
  for (const auto& [address, word] : file.words) {
    if (address >= dspic::kFlashEnd) break;
    ran_.resize(address / 2 + 1);
    is_jump_.resize(address / 2 + 1);
    is_jump_[address / 2] = is_plain_jump(word);
  }
  jumped_.resize(ran_.size());
}

void StepCounts::after(const Step& step) {
  const std::size_t word = step.pc / 2;
  // a handler's entry puts the instruction off
  if (step.slept || step.served || step.entered != dspic::kNoVector || word >= ran_.size()) return;
  if (step.next == step.pc && !is_jump_[word]) return;
  ++ran_[word];
  if (step.next != step.pc + 2) ++jumped_[word];
}

}  // namespace chip
