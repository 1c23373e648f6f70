// SPDX-License-Identifier: MIT
// The names of a robot's program, for expressions in C (expression.h): variables by their symbols and types,
// registers by the chip's table. Reads the program as it is between two windows, with or without a debugger.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/debug/expression.h"

namespace debug {

class ProgramNames final : public Names {
 public:
  /// `runner` outlives it. Variables are those known at `pc`; without it, where the program stands.
  explicit ProgramNames(const chip::ChipRunner& runner, std::optional<std::uint32_t> pc = {});

  const dspic::DebugInfo& debug_info() const override;
  bool find_variable(const std::string& name, Part& part) const override;
  bool find_other(const std::string& name, CValue& value) const override;
  std::optional<Address> address_of(const Part& part) const override;
  std::optional<std::uint64_t> raw_value(const Part& part) const override;
  std::optional<std::uint64_t> raw_value(const Data& data) const override;

  /// Symbols and registers, whatever the debug information says.
  std::optional<Data> find_untyped(const std::string& name) const;
  /// At most 8 bytes; 0 where nothing can be read.
  std::uint64_t read(const Data& data) const;

 private:
  const chip::ChipRunner& runner_;
  std::uint32_t pc_;
};

/// The bits that a part of a variable has, and the bytes that hold them: a bit-field may reach beyond the
/// type that it was declared with.
unsigned bits_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found);
unsigned bytes_of(const dspic::DebugInfo::Type& type, const dspic::DebugInfo::Found& found);

/// As compute() in expression.h; refuses what is nested too deep.
bool compute_in(const ProgramNames& names, const std::string& expression, Want want, bool is_tried,
                CValue& value, std::string& error);

/// A number, as the program has it now. `is_tried`: it has not run yet, so its values mean nothing. False:
/// `error` says why, "got ..., expected ...".
bool number_of(const chip::ChipRunner& runner, const std::string& expression, bool is_tried, double& value,
               std::string& error);

}  // namespace debug
