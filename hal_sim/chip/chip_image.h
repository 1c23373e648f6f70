// SPDX-License-Identifier: MIT
// A program of the chip, loaded once for all robots that run it, on whatever thread: its file, and what is
// made of it on the way.
#pragma once
#include <memory>
#include <mutex>
#include <utility>

#include "dspic30/core/code_store.h"
#include "dspic30/load/firmware_file.h"

namespace chip {

class ChipImage final {
 public:
  explicit ChipImage(dspic::FirmwareFile file) : file_(std::move(file)) {
    for (const auto& [address, word] : file_.words) program_.write(address, word);
  }

  const dspic::FirmwareFile& file() const { return file_; }
  /// What a programmer writes: flash and configuration words.
  const dspic::ProgramMemory& program() const { return program_; }
  /// Its words, ready to run.
  const std::shared_ptr<dspic::CodeStore>& code() const { return code_; }
  /// Its routines that are known by heart. `program` holds its words. Null: nothing shall be, as the
  /// environment (TWINPUCK_INTERPRET) says.
  std::shared_ptr<const dspic::KnownCalls> known(const dspic::ProgramMemory& program) const;

 private:
  const dspic::FirmwareFile file_;
  dspic::ProgramMemory program_;
  const std::shared_ptr<dspic::CodeStore> code_ = std::make_shared<dspic::CodeStore>();
  mutable std::once_flag looked_for_;
  mutable std::shared_ptr<const dspic::KnownCalls> known_;
};

}  // namespace chip
