// SPDX-License-Identifier: MIT
// The linker: objects to an image of the chip.
//
//   link_read.cpp    objects and archives in; what is undefined is looked for in the libraries
//   link_vendor.cpp  objects of XC16, made what ours are
//   link_place.cpp   what is used gets its place: near, X, Y and other RAM; constants in one PSV page; code;
//   start-up table link_fill.cpp    addresses into instructions, data and debugging information; vectors
//   link_stack.cpp   how deep the stack can grow
//   link_write.cpp   .elf, .hex, .map; link_listing.cpp .lst
//   link_report.cpp  sizes against the chip's, and what is largest
#pragma once
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace dspic::link {

struct Options {
  std::vector<std::string> inputs;     ///< .o: all of it; .a: members that somebody needs
  std::vector<std::string> libraries;  ///< .o and .a, of which only what somebody needs
  std::string output;                  ///< x.elf; x.hex, x.lst and x.map lie beside it
  std::map<std::string, std::string>
      renames;                ///< what `inputs` ask for by the first name is the second, both as in C
  unsigned heap_bytes = 512;  ///< for malloc(), if it is used
};

/// What memory a section goes to.
enum class Kind { Code, Constant, Table, Ram, Eeprom, Configuration, Debug };

struct Section;

struct Symbol {
  std::string name;
  Section* section = nullptr;  ///< null with is_defined: an absolute value
  std::uint32_t value = 0;     ///< octets from the section's start
  std::uint32_t size = 0, align = 1;
  bool is_defined = false, is_weak = false, is_common = false, is_function = false;
  std::string from;  ///< the object that defines it
};

struct Relocation {
  std::uint32_t offset;
  unsigned type;  ///< fixups.h
  Symbol* symbol;
  std::int32_t addend;
};

struct Section {
  std::string name, from;
  Kind kind = Kind::Ram;
  std::uint32_t flags = 0;  ///< memory_spaces.h
  std::uint32_t size = 0, align = 1;
  bool zeroed = false, used = false;
  std::vector<std::uint8_t> bytes;
  std::vector<Relocation> relocations;
  std::uint32_t address = 0;  ///< as the program sees it: bytes of data, program address of code
  std::uint32_t load = 0;     ///< of constants: program address
};

struct Program {
  std::deque<Section> sections;
  std::deque<Symbol> symbols;
  std::map<std::string, Symbol*> globals;
  std::vector<std::string> errors, warnings;
  std::map<std::uint32_t, std::uint32_t> words;    ///< the image: program address to word
  std::map<std::uint32_t, std::uint32_t> handles;  ///< function beyond 16 bits to its GOTO
  std::uint32_t dinit = 0, dinit_words = 0;        ///< start-up table
  std::uint32_t handles_at = 0;                    ///< where the GOTOs lie
  std::uint32_t stack_begin = 0, stack_end = 0;    ///< from bound_stack() on without the guard: SPLIM + 2
  std::uint32_t stack_bytes = 0;                   ///< at most, if nothing is recursive
  std::string recursive;                           ///< a function that calls itself
  std::uint32_t code_words = 0, constant_words = 0, ram_bytes = 0;

  Symbol* global(const std::string& name);
  /// Where the program sees it; of code its program address.
  std::uint32_t address_of(const Symbol& symbol, std::int32_t addend = 0) const;
  void define(const std::string& name, std::uint32_t value);
};

/// "T1Interrupt", "MathError": what a handler is called, without underscores.
std::string handler_name(int vector);

bool read_all(Program& program, const Options& options);
/// Of an object of XC16: each byte of data has an octet behind it that says nothing.
void drop_phantom_octets(Section& section);
/// printf() and its like are called __printf_cdn there; the name of ours, or the name as it is.
std::string name_of_library(const std::string& name);
/// False: that type is not known. `offset` as the object has it.
bool add_vendor_relocation(Section& section, std::uint32_t offset, unsigned type, Symbol& symbol);
void keep_used(Program& program);
void place_all(Program& program, const Options& options);
void fill_all(Program& program);
/// Once more where `symbol` is asked for, which has another value now.
void fill_for(Program& program, const Symbol& symbol);
void bound_stack(Program& program);
bool write_all(Program& program, const Options& options);
std::string report(const Program& program);
std::string listing(const Program& program);
/// Is that the name of a handler, as vectors look for it?
bool is_handler(const std::string& name);

/// All of it; messages to stderr, the report to stdout. False after an error.
bool run(const Options& options);

}  // namespace dspic::link
