// SPDX-License-Identifier: MIT
// A program of the chip that refers to every routine of the runtime, and calls of single ones.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "dspic30/core/cpu.h"
#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/load/firmware_file.h"
#include "tests/dspic30/bench.h"

namespace routines_test {

using Words = std::array<std::uint16_t, 8>;  ///< W0 to W7

struct Outcome {
  Words w{};
  dspic::Cycle cycles = 0;  ///< from the routine's first instruction to behind RETURN
};

class RoutineProgram {
 public:
  /// `source`: C of the program.
  explicit RoutineProgram(const std::string& source);
  bool is_whole() const { return error_.empty(); }
  const std::string& error() const { return error_; }
  const std::map<std::string, std::uint32_t>& functions() const { return file_.functions; }
  const dspic::ProgramMemory& program() const { return program_; }
  const dspic::FirmwareFile& file() const { return file_; }
  unsigned address_of(const std::string& function) const;
  dspic::Cpu& cpu() { return *cpu_; }

  /// The routine itself runs, as if it was called.
  Outcome call(unsigned address, const Words& w);
  static constexpr unsigned kStack = 0x2000;  ///< W15 as it is called, behind the return address

 private:
  std::string error_;
  dspic::FirmwareFile file_;
  dspic::ProgramMemory program_;
  bench::FakeOutside outside_;
  bench::Notes notes_;
  std::unique_ptr<dspic::Dspic30f6014a> chip_;
  std::unique_ptr<dspic::Cpu> cpu_;
};

}  // namespace routines_test
