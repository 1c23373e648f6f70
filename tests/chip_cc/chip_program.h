// SPDX-License-Identifier: MIT
// A C program, compiled and linked for the chip, on a bench. Its main() is ours: it calls bench_run(), keeps
// the result and stops.
#pragma once
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dspic30/core/processor.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/periph/nvm.h"
#include "tests/dspic30/bench.h"

namespace chip_cc {

class ChipProgram {
 public:
  /// Compiles `source`; `name` is that of the files made. Without a program is_whole() is false, error() says
  /// why.
  /// `others`: further files of the program.
  ChipProgram(const std::string& name, const std::string& source, const std::string& level = "-O1",
              const std::vector<std::string>& others = {});

  bool is_whole() const { return error_.empty(); }
  const std::string& error() const { return error_; }
  /// Of the build.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Runs to the end: what bench_run() returned, 32 bits. A program that does not end within `most` cycles
  /// fails.
  std::uint32_t run(dspic::Cycle most = 20'000'000);
  /// Runs as far, instruction by instruction, and counts what `function` takes: callees included, the
  /// runtime's routines (their names begin with two underscores) left out, as xc16-cycles/README.md defines
  /// cycles_own.
  std::uint32_t run_counting(const std::string& function, dspic::Cycle& own, bool with_runtime = false);

  /// Runs until the variable, an int, is not 0.
  void run_until(const std::string& variable, dspic::Cycle most = 20'000'000);

  void run_for(dspic::Cycle cycles) { step(cpu_->now() + cycles); }
  /// So long, or to a reset: which.
  std::optional<dspic::ResetKind> run_to_reset(dspic::Cycle cycles) {
    return cpu_->run(cpu_->now() + cycles);
  }

  unsigned address_of(const std::string& variable) const;
  std::uint64_t peek(unsigned address, unsigned bytes) const;
  void poke(unsigned address, std::uint64_t value, unsigned bytes);

  const dspic::FirmwareFile& file() const { return file_; }
  const dspic::Processor& processor() const { return *cpu_; }
  /// What is in a register of that name.
  unsigned sfr(const std::string& name) const;

 private:
  bool has_ended() const { return peek(done_, 2) != 0; }
  void step(dspic::Cycle until);

  std::string error_;
  std::vector<std::string> warnings_;
  dspic::FirmwareFile file_;
  bench::FakeOutside outside_;
  bench::Notes notes_;
  dspic::ProgramMemory program_;
  dspic::OwnEeprom eeprom_;
  std::unique_ptr<dspic::Dspic30f6014a> chip_;
  std::unique_ptr<dspic::Processor> cpu_;
  unsigned done_ = 0, result_ = 0;
};

}  // namespace chip_cc
