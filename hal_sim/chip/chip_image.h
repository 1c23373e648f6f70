// SPDX-License-Identifier: MIT
// A program of the chip, loaded once for all robots that run it, on whatever thread: its file, and what is
// made of it on the way.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "dspic30/core/code_store.h"
#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/library_calls.h"
#include "hal_sim/chip/program_places.h"

namespace chip {

class ChipImage final {
 public:
  explicit ChipImage(dspic::FirmwareFile file) : file_(std::move(file)), functions_(file_) {
    for (const auto& [address, word] : file_.words) program_.write(address, word);
    shared_handler_ = ProgramPlaces::shared_handler(file_, program_);
  }

  const dspic::FirmwareFile& file() const { return file_; }
  /// What a programmer writes: flash and configuration words.
  const dspic::ProgramMemory& program() const { return program_; }
  const LibraryCalls::Functions& functions() const { return functions_; }
  unsigned shared_handler() const { return shared_handler_; }
  /// Its words, ready to run.
  const std::shared_ptr<dspic::CodeStore>& code() const { return code_; }
  /// Its routines that are known by heart. `program` holds its words. Null: nothing shall be, as the
  /// environment (TWINPUCK_INTERPRET) says.
  std::shared_ptr<const dspic::KnownCalls> known(const dspic::ProgramMemory& program) const;
  /// What `find` says of a wait at a line while these interrupts are enabled, a bit a vector; asked once for
  /// all robots, since it reads sources.
  bool is_endless(const std::string& line, std::uint64_t enabled, const std::function<bool()>& find) const;

 private:
  const dspic::FirmwareFile file_;
  const LibraryCalls::Functions functions_;
  dspic::ProgramMemory program_;
  unsigned shared_handler_ = 0;
  const std::shared_ptr<dspic::CodeStore> code_ = std::make_shared<dspic::CodeStore>();
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::string, std::uint64_t>, bool> endless_;
  mutable std::once_flag looked_for_;
  mutable std::shared_ptr<const dspic::KnownCalls> known_;
};

}  // namespace chip
