// SPDX-License-Identifier: MIT
// A program of the native or register way for the debugger: its code is the PC's, stopped by a Stepper; its
// functions, lines and types are those of its file; registers are the chip's as far as the way has them.
//
// The program stands before one of its instructions, or between two windows in a call of the host (a wait, or
// the place of a trap): then it is within the instruction that calls. Time goes on by blocks, so several
// instructions have the same cycle.
#pragma once
#include <memory>

#include "hal_sim/debug/machine.h"
#include "hal_sim/debug/stepper.h"

namespace debug {

class PcMachine final : public Machine {
 public:
  /// The image's file is read for its debug information; what cannot be read of it is missing.
  explicit PcMachine(host::CompiledRunner& runner);

  host::CompiledRunner& runner() const override { return runner_; }
  const dspic::FirmwareFile& file() const override { return file_; }

  void watch(Watcher* watcher, bool on) override;
  void mark(const std::vector<std::uint32_t>& addresses) override;
  bool stands_between() override;

  Cycle now() const override { return in_code_ ? runner_.now_in_code() : runner_.cycles(); }
  std::uint32_t pc() const override { return relative(place_.pc); }
  Address base() override;
  int nesting() const override { return runner_.handler_depth(); }
  std::vector<Frame> frames() override;
  Cycle first_look_back() const override { return 2'000; }  // a look costs more than a cycle

  bool is_code(std::uint32_t address) const override { return file_.code.function_at(address) != nullptr; }
  std::uint32_t code_end() const override { return relative(runner_.copy().code_end()); }
  std::uint32_t body_of(std::uint32_t function) const override;
  bool begins_in_main() const override { return true; }
  std::string instruction(std::uint32_t address, std::uint32_t& next) const override;

  Address data_base() const override { return runner_.copy().base(); }
  bool read(const Data& data, void* to) const override;
  bool write(const Data& data, const void* from) override;
  Address register_value(int number) const override;
  std::optional<Data> find_register(const std::string& name) const override;

  std::string registers() const override;
  std::vector<std::pair<std::string, std::string>> register_list() const override;
  std::string why() override;
  std::string interrupts() override;

 private:
  std::uint32_t relative(std::uintptr_t address) const {
    return address ? static_cast<std::uint32_t>(address - runner_.copy().base()) : 0;
  }
  Look reached(const Stepper::Place& place, void* context);
  std::string told(int vector);

  host::CompiledRunner& runner_;
  dspic::FirmwareFile file_;
  Stepper stepper_;
  Watcher* watcher_ = nullptr;
  Stepper::Place place_;
  bool in_code_ = false;  // before an instruction
  void* context_ = nullptr;
  std::uint32_t last_ = 0;  // instruction before this one, 0: there was none
  std::uint32_t main_ = 0;  // its body; 0: it has none
  std::int64_t starts_;     // of the program, that have been told
};

/// Functions, lines, objects and types of a shared object of the PC. Addresses count from its load address.
dspic::FirmwareFile read_pc_program(const std::string& path);

}  // namespace debug
