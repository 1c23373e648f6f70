// SPDX-License-Identifier: MIT
// The chip way's program for the debugger: everything is read from the model of the chip and the image's
// code.
#pragma once
#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/debug/code.h"
#include "hal_sim/debug/machine.h"

namespace debug {

class ChipMachine final : public Machine {
 public:
  explicit ChipMachine(chip::ChipRunner& runner) : runner_(runner), code_(runner.file()) {}

  chip::ChipRunner& runner() const override { return runner_; }
  const dspic::FirmwareFile& file() const override { return runner_.file(); }
  Code& code() { return code_; }

  void watch(Watcher* watcher, bool on) override;

  Cycle now() const override { return runner_.processor().now(); }
  std::uint32_t pc() const override { return runner_.processor().pc(); }
  Address base() override;
  int nesting() const override { return runner_.device().nesting(); }
  std::vector<Frame> frames() override;
  Cycle first_look_back() const override { return 50'000; }
  bool is_starting_up() override;
  bool repeats(const chip::Step& step) const override;

  bool is_code(std::uint32_t address) const override;
  std::uint32_t code_end() const override;
  std::string instruction(std::uint32_t address, std::uint32_t& next) const override;

  Address address_mask() const override { return 0xFFFF; }
  bool read(const Data& data, void* to) const override;
  bool write(const Data& data, const void* from) override;
  std::optional<Data> register_data(int number) const override;
  Address register_value(int number) const override { return word(2 * static_cast<unsigned>(number)); }
  std::optional<Data> find_register(const std::string& name) const override;

  std::string registers() const override;
  std::vector<std::pair<std::string, std::string>> register_list() const override;
  std::string why() override;
  std::string interrupts() override;

  unsigned word(Address address) const;

 private:
  chip::ChipRunner& runner_;
  Code code_;
  bool is_watched_ = false;
};

}  // namespace debug
