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

using Words = std::array<std::uint16_t, 15>;  ///< W0 to W14

/// What a routine finds or leaves.
struct State {
  std::array<std::uint16_t, 16> w{};
  unsigned sr = 0, rcount = 0;
  std::array<std::uint8_t, 512> stack{};  ///< from a little below W15 on
  std::array<std::uint8_t, 256> data{};   ///< RAM from RoutineProgram::kData on
  dspic::Cycle cycles = 0;                ///< from the routine's first instruction to behind RETURN
};
/// "" or the first thing that differs.
std::string difference(const State& by_heart, const State& on_the_core);

/// C, compiled and linked for the chip at -O1; false: `error` says why not.
bool build(const std::string& source, dspic::FirmwareFile& file, std::string& error);

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
  /// Address of a text among the constants, in the PSV window.
  unsigned constants() const;
  dspic::Cpu& cpu() { return *cpu_; }

  /// RAM is filled, so that what a routine leaves alone is seen.
  void fill_ram(std::uint32_t seed);
  /// The routine itself runs, as if it was called with these registers and flags.
  void call(unsigned address, const Words& w, unsigned flags);
  /// The same by heart; false: it is not known, and nothing has changed but what the call does. Something else
  /// may happen at `deadline`, counted from the routine's first instruction.
  bool recall(const dspic::KnownRoutine& routine, unsigned address, const Words& w, unsigned flags,
              dspic::Cycle deadline = dspic::kNever);
  /// Behind a call.
  void look(State& state) const;
  /// RAM as it was.
  void restore(const State& state);
  static constexpr unsigned kStack = 0x2000;  ///< W15 as it is called, behind the return address
  static constexpr unsigned kData = 0x1000;   ///< where memory is copied and compared

 private:
  static constexpr unsigned kBelow = 32;  // bytes of the caller's that are looked at
  void begin(const Words& w, unsigned flags);

  std::string error_;
  dspic::FirmwareFile file_;
  dspic::ProgramMemory program_;
  bench::FakeOutside outside_;
  bench::Notes notes_;
  std::unique_ptr<dspic::Dspic30f6014a> chip_;
  std::unique_ptr<dspic::Cpu> cpu_;
};

}  // namespace routines_test
