// SPDX-License-Identifier: MIT
// The linker: objects to an image of the chip.
//
//   read.cpp     objects and archives in; what is undefined is looked for in the libraries
//   vendor.cpp   objects of XC16 and the older C30, made what ours are
//   where.cpp    function and line of code, for messages
//   place.cpp    what is used gets its place: near, X, Y and other RAM; constants in one PSV page; code;
//                start-up table
//   debug.cpp    debugging information in the chip's own addresses
//   fill.cpp     addresses into instructions, data and debugging information; vectors
//   host.cpp     what the host stands in for
//   stack.cpp    how deep the stack can grow
//   report.cpp   sizes against the chip's
//   write.cpp    .elf, .hex
//   listing.cpp  .lst
//   map.cpp      .map
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "dspic30/load/code_map.h"
#include "dspic30/memory/host_places.h"

namespace dspic::link {

/// A driver of the library that the host can stand in for. Names as in C.
struct HostDriver {
  std::string name;
  std::map<std::string, unsigned> functions;  ///< and their places (host_places.h)
  /// Of other files, which only read its variables: filled with it where they are the library's.
  std::map<std::string, unsigned> shortcuts;
  std::vector<std::pair<std::string, unsigned>> registers;  ///< public variables, in order, and their bytes
  std::set<std::string> owned;  ///< registers, flags, handlers: "T2CON", "IFS0_T2IF", "T2Interrupt"
};

struct Options {
  std::vector<std::string> inputs;   ///< .o: all of it; .a: members that somebody needs
  std::vector<std::string> drivers;  ///< .o that somebody needs, or with a handler of a driver that is linked
  std::vector<std::string> libraries;  ///< .o and .a, of which only what somebody needs
  std::string output;  ///< x.elf; beside it x.hex, unless the host fills it, and with_texts x.lst and x.map
  bool with_texts = true;
  /// What objects outside of archives ask for by the first name is the second, both as in C.
  std::map<std::string, std::string> renames;
  std::map<std::string, std::string> library_renames;  ///< the same for what archives ask for
  unsigned heap_bytes = kHeapBytes;                    ///< for malloc(), if it is used
  unsigned gap_bytes = 0;  ///< behind each variable, where there is room; not 0: of an image to be checked
  /// Object to source, archive to its name for people. Line tables may have been written
  /// for a copy elsewhere.
  std::map<std::string, std::string> sources;
  std::function<bool(const std::string&)> may_quote;  ///< of x.lst: a source file; empty: all
  std::string moved_from, moved_to;                   ///< as in LineTable: sources of the library
  std::string host_library;                           ///< of `libraries` the archive with the drivers below
  std::vector<HostDriver> host;  ///< their variables come first in RAM, whether the host fills them or not
  bool is_filled_by_host = false;
  std::uint32_t host_table = 0;     ///< value of kHostTableSymbol
  std::uint32_t library_level = 1;  ///< of kLibraryLevelSymbol
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
  bool is_hal = false;      ///< of Options::host_library
  bool is_program = false;  ///< of an object of Options::inputs
  std::string from;         ///< the module that defines it: "main.c", "libmotor.a(step.o)"
};

struct Relocation {
  std::uint32_t offset;
  unsigned type;  ///< fixups.h
  Symbol* symbol;
  std::int32_t addend;
};

struct Section {
  std::string name;
  std::string from;  ///< its module
  int module = 0;    ///< the same, of all that were read
  Kind kind = Kind::Ram;
  std::uint32_t flags = 0;  ///< memory_spaces.h
  std::uint32_t size = 0, align = 1;
  bool zeroed = false, used = false;
  bool is_program = false;  ///< of an object of Options::inputs
  bool is_hal = false;      ///< of Options::host_library
  std::vector<std::uint8_t> bytes;
  std::vector<Relocation> relocations;
  std::uint32_t address = 0;  ///< as the program sees it: bytes of data, program address of code
  std::uint32_t load = 0;     ///< of constants: program address
};

/// A driver that the program uses, and what keeps the host from filling it; empty: nothing.
struct HostChoice {
  const HostDriver* driver;
  bool is_linked;  ///< false: all that is used of it is the program's own
  std::string why_not;
};

struct Program {
  std::deque<Section> sections;
  std::deque<Symbol> symbols;
  std::map<std::string, Symbol*> globals;
  /// "main.c:12: error: ..." where a place is known.
  std::vector<std::string> errors, warnings;
  std::string unread;  ///< an archive of a format that is not read, for what stays undefined
  std::vector<std::pair<Symbol, Symbol>> twice;    ///< two definitions of one name, the first one first
  std::vector<std::pair<Symbol, Symbol>> rivals;   ///< the same of the library's handlers: of two drivers
  std::map<std::string, std::string> sources;      ///< of Options
  std::string moved_from, moved_to;                ///< of Options
  std::map<std::uint32_t, std::uint32_t> words;    ///< the image: program address to word
  std::map<std::uint32_t, std::uint32_t> handles;  ///< function beyond 16 bits to its GOTO
  std::uint32_t dinit = 0, dinit_words = 0;        ///< start-up table
  std::uint32_t handles_at = 0;                    ///< where the GOTOs lie
  std::uint32_t stack_begin = 0, stack_end = 0;    ///< from bound_stack() on without the guard: SPLIM + 2
  std::uint32_t stack_bytes = 0;                   ///< at most, if nothing is recursive
  std::string recursive;                           ///< a function that calls itself
  std::uint32_t ram_bytes = 0;
  std::string sizes;  ///< report(), of the image with all drivers
  std::vector<HostChoice> host;
  std::uint32_t served_end = 0x0800;  ///< behind the variables that the host serves

  Symbol* global(const std::string& name);
  /// Where the program sees it; of code its program address.
  std::uint32_t address_of(const Symbol& symbol, std::int32_t addend = 0) const;
  void define(const std::string& name, std::uint32_t value);
};

/// A name of C, without XC16's underscore.
std::string in_c(const std::string& name);

/// Where code stands, before and after it has its place.
class Whereabouts {
 public:
  explicit Whereabouts(const Program& program);
  /// "src/main.c:12", or the module where no line is known. `offset`: octets from the section's start.
  std::string line(const Section& section, std::uint32_t offset) const;
  std::string line(const Symbol& symbol) const;
  /// "main"; empty: no function is known there.
  std::string function(const Section& section, std::uint32_t offset) const;

 private:
  const Program& program_;
  std::map<const Section*, std::uint32_t> begins_;  // in octets; nothing begins at 0
  LineTable lines_;
};

/// "T1Interrupt", "MathError": what a handler is called, without underscores.
std::string handler_name(int vector);

bool read_all(Program& program, const Options& options);
/// Of an object of XC16 or C30: each byte of data has an octet behind it that says nothing.
void drop_phantom_octets(Section& section);
/// printf() and its like are called __printf_cdn there; the name of ours, or the name as it is.
std::string name_of_library(const std::string& name);
/// False: that type is not known. `offset` as the object has it.
bool add_vendor_relocation(Section& section, std::uint32_t offset, unsigned type, Symbol& symbol);
void keep_used(Program& program);
/// Which drivers the host can fill. Before anything has its place.
void choose_filled(Program& program, const Options& options);
/// Puts the host in their place. The last thing, when all is filled and measured.
void fill_by_host(Program& program, const Options& options);
/// The address after '@' in a section's name.
bool fixed_address(const Section& section, std::uint32_t& address);
/// No address, and neither X nor Y memory, is asked for.
bool can_lie_anywhere(const Section& section);
void place_all(Program& program, const Options& options);
void fill_all(Program& program);
/// The words of a section.
void put_section(Program& program, const Section& section);
void put_vectors(Program& program);
/// Debugging information, of sections that are used by now.
void refill_debug(Program& program);
/// Once more where `symbol` is asked for, which has another value now.
void fill_for(Program& program, const Symbol& symbol);
void bound_stack(Program& program);
bool write_all(Program& program, const Options& options);
/// "flash N of M words (...)", "RAM N of M bytes", "stack N bytes at most", "host DRIVER", "host
/// DRIVER chip: why" or "host DRIVER own: why", a line each: the build reads them.
std::string report(const Program& program);
std::string listing(const Program& program, const Options& options);
std::string map_file(const Program& program);
/// A line a symbol, by memory and address.
std::string symbol_table(const Program& program);
/// Which of the sources a name in a line table means: that whose path ends most like it; else the name.
std::string source_named(const std::string& name, const std::map<std::string, std::string>& sources);
/// Is that the name of a handler, as vectors look for it?
bool is_handler(const std::string& name);

/// All of it; messages to stderr, the report to stdout. False after an error.
bool run(const Options& options);

}  // namespace dspic::link
