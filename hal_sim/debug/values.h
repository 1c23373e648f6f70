// SPDX-License-Identifier: MIT
// A program's variables and registers by the names and types of its sources, where it stands or,
// with `pc`, would stand.
#pragma once
#include <optional>
#include <string>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/debug/expression.h"

namespace debug {

class Values final : public Names {
 public:
  /// `runner` outlives it. With `pc` values are not the program's yet: nothing is refused for its value.
  explicit Values(const chip::ChipRunner& runner, std::optional<std::uint32_t> pc = {})
      : Values(runner, pc.value_or(runner.processor().pc()), pc.has_value()) {}
  /// ... in a level of calls: a caller's variables are where it goes on.
  Values(const chip::ChipRunner& runner, const Frame& frame) : Values(runner, frame.call, false) {
    frame_ = frame;
  }
  /// The same, said apart.
  Values(const chip::ChipRunner& runner, std::uint32_t pc, bool is_tried)
      : runner_(runner), pc_(pc), is_tried_(is_tried) {}

  /// An expression of C (expression.h): variables and their parts (motors[n].speed, m->speed, *p), registers
  /// (LATA, LATA.LATA6, w0, sr), pc, cycle, nesting. False: `error` says why.
  bool compute(const std::string& expression, Want want, CValue& value, std::string& error) const;
  /// The same as a whole number, a float cut to its whole part: an address, a count.
  bool evaluate(const std::string& expression, std::int64_t& value, std::string& error) const;
  /// Where it lies, if it lies somewhere.
  std::optional<Data> place_of(const CValue& value) const;
  /// A variable, a part of one, a register.
  std::optional<Data> find_data(const std::string& name) const;
  /// What `name = expression` would write, as C converts it. False: `error` says why it cannot.
  bool assignment(const std::string& name, const std::string& expression, Data& to, std::uint64_t& raw,
                  std::string& error) const;
  /// At most 8 bytes, or the bits of a field; 0 where nothing can be read.
  std::uint64_t read(const Data& data) const;

  /// A number or a pointer; none: it is kept nowhere, is an array or a struct, or of no known type.
  std::optional<CValue> number(const Part& part) const;
  /// Of what kind a variable's bits are, or a part's: one of debug_info().types, and bits of a bit-field, or 0.
  struct Shape {
    int type = 0, width = 0;
  };
  /// None: it is no number, or no variable.
  std::optional<Shape> shape_of(const std::string& name) const;
  /// "-5536", "1.5", "0x080a": bits by their kind; of no kind as a whole number.
  std::string brief(const std::optional<Shape>& shape, std::uint64_t raw) const;
  /// "-5536 (0xea60)", "1.5", "{mode = 1, speed = {-300, 300}}".
  std::string shown(const CValue& value) const;
  /// The same of a part.
  std::string typed(const Part& part) const;
  /// Parameters and variables of the function there, a line each.
  std::string locals() const;

  // --- Names
  const dspic::DebugInfo& debug_info() const override { return runner_.image()->file().debug.value(); }
  bool find_variable(const std::string& scope, const std::string& name, Part& part) const override;
  std::string function_of(const std::string& local) const override;
  bool find_other(const std::string& name, CValue& value) const override;
  std::optional<Address> address_of(const Part& part) const override;
  std::optional<std::uint64_t> raw_value(const Part& part) const override;
  std::optional<std::uint64_t> raw_value(const Data& data) const override;

 private:
  /// Symbols and registers, whatever the debug information says.
  std::optional<Data> find_untyped(const std::string& name) const;

  CValue value_of(int type, int width, std::uint64_t raw) const;
  /// Where a W register's value lies; none: it is lost.
  std::optional<Data> register_at(int n) const;

  std::optional<Frame> frame_;  // none: the registers are the processor's
  const chip::ChipRunner& runner_;
  const std::uint32_t pc_;
  const bool is_tried_;
};

/// A number by the names that are known everywhere, globals and statics, as the program has it
/// now. `is_tried`: it has not run yet, so its values mean nothing. False: `error` says why, "got
/// ..., expected ...".
bool number_of(const chip::ChipRunner& runner, const std::string& expression, bool is_tried, double& value,
               std::string& error);

}  // namespace debug
