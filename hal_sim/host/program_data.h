// SPDX-License-Identifier: MIT
// A program's data and code, as somebody from outside reads and changes them. Addresses are those of its
// debug information. Reading changes nothing.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/host/place.h"
#include "hal_sim/host/variables.h"

namespace host {

class ProgramData {
 public:
  virtual ~ProgramData() = default;
  /// A variable, element or member by an expression in C (variables.h); null with `error` saying why.
  virtual const Variable* find_variable(const std::string& expression, std::string& error) const = 0;
  /// Bytes of a global object by its name; 0 `bytes`: all of it. Empty when unknown.
  virtual std::vector<char> read_variable(const std::string& name, std::size_t bytes) const = 0;
  virtual void read_memory(std::uintptr_t address, void* to, std::size_t bytes) const = 0;
  /// As a debugger would; a wait looks again.
  virtual void write_memory(std::uintptr_t address, const void* from, std::size_t bytes) = 0;
  /// Function, file and line of an instruction.
  virtual Place place_of(std::uintptr_t code) const = 0;
  /// Where the program stands, or was stopped; without a function: it has not begun.
  virtual Place place_now() const = 0;

  /// find_variable() of a number; null for an array or a struct, too.
  const Variable* find_number(const std::string& expression, std::string& error) const;
  /// What a variable of find_number() holds.
  double number(const Variable& variable) const;
  /// Gives it another value, cut to its width. True: its bytes are others now.
  bool set_number(const Variable& variable, double value);
};

}  // namespace host
