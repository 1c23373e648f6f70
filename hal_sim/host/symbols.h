// SPDX-License-Identifier: MIT
// From an address in a firmware image to function, file and line, by the image's own debug information.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "hal_sim/host/variables.h"

namespace host {

struct Place {
  std::string function;  ///< C name; "?" when unknown
  std::string file;      ///< source file as compiled; empty when unknown
  int line = 0;          ///< 0 when unknown
};

/// "function (file:line)", as far as known.
std::string to_string(const Place& place);

class Symbols {
 public:
  /// Debug information of the ELF file at `path`; read when first asked. A file without any answers "?".
  explicit Symbols(std::string path);
  ~Symbols();

  /// `address` is relative to the image's load address.
  Place find(std::uintptr_t address) const;

  /// A variable, array element or struct member, by the debug information (host/variables.h); null, with
  /// `error` saying why, when there is none. Remembered.
  const Variable* find_variable(const std::string& expression, std::string& error) const;

  /// Address (relative to the load address) and size in bytes of a global or static object; false when
  /// unknown.
  bool find_object(const std::string& name, std::uintptr_t& address, std::size_t& bytes) const;

 private:
  struct Reader;
  std::string path_;
  mutable std::unique_ptr<Reader> reader_;
  mutable std::map<std::string, Variable> variables_;
};

}  // namespace host
