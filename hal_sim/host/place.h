// SPDX-License-Identifier: MIT
// A place in a program's sources.
#pragma once
#include <string>

namespace host {

struct Place {
  std::string function;  ///< C name; "?" when unknown
  std::string file;      ///< source file as compiled; empty when unknown
  int line = 0;          ///< 0 when unknown
};

/// "function (file:line)", as far as known.
std::string to_string(const Place& place);

}  // namespace host
