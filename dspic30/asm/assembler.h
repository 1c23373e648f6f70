// SPDX-License-Identifier: MIT
// Assembler text in XC16's syntax to an image of the chip: instructions, directives, macros, sections, placed
// and linked at once.
//
//   text --lines, macros, conditions--> statements --sizes--> sections placed --values--> words
//
// Sections: code and .const (psv) in flash from 0x100, data and bss in RAM from 0x800, .eedata, or at
// address(N). `__reset`, else the first instruction, is jumped to from 0; `__T1Interrupt` and the like fill
// the vectors, and __DefaultInterrupt the rest. Registers are known by name, with and without underscore;
// __SP_init and __SPLIM_init are where the stack begins and ends. Not supported: initialised .data (there is
// no start-up code), relocatable output.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dspic::assembly {

struct Message {
  std::string file;
  int line = 0;
  std::string text;  ///< "unknown symbol 'x'"
};

struct Image {
  std::map<std::uint32_t, std::uint32_t>
      program;  ///< word by program address; EEPROM and configuration included
  std::map<std::string, std::uint32_t> symbols;  ///< labels: program addresses, data addresses
  std::vector<Message> messages;                 ///< errors, in order; none: the image is whole

  bool is_whole() const { return messages.empty(); }
  /// All messages, a line each: "file:line: text".
  std::string report() const;
};

/// Text of an .include; none: there is no such file.
using Includes = std::function<std::optional<std::string>(const std::string& name)>;

Image assemble(const std::string& text, const std::string& file, const Includes& includes = nullptr);

}  // namespace dspic::assembly
