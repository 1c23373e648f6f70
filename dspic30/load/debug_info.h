// SPDX-License-Identifier: MIT
// Types of an image's variables, and its functions' local ones.
//
//   .debug_info and what it refers to, by libdw --> DebugInfo: find("state.speed[1]", pc)
//
// As our own compiler and XC16 write it. Not read: C++.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

struct Elf;  // libelf's

namespace dspic {

struct DebugInfo {
  enum class Kind : std::uint8_t { Signed, Unsigned, Float, Pointer, Array, Struct, Unknown };
  struct Member {
    std::string name;  ///< empty: its own members stand for it
    unsigned offset = 0;
    int type = 0;
    int bit = 0, width = 0;  ///< of a bit-field, from the lowest bit on; width 0: none
  };
  struct Type {
    Kind kind = Kind::Unknown;
    bool is_truth = false;  ///< _Bool: Unsigned, and 0 or 1
    unsigned bytes = 0;
    int element = 0;     ///< of an array, or what a pointer points to
    unsigned count = 0;  ///< its elements
    std::vector<Member> members;
  };
  /// Where a variable is while the program counter is in [begin, end).
  struct Place {
    std::uint32_t begin = 0, end = 0xFFFFFFFF;
    enum class In : std::uint8_t { Memory, Register, Frame, Value } in = In::Memory;
    int value = 0;  ///< address, register, offset from `base`, or the value itself
    int base = 14;  ///< register
  };
  struct Variable {
    std::string name, file;
    int type = 0;
    std::uint32_t begin = 0, end = 0;  ///< code of the scope of a local or static one; end 0: of the file
    bool is_static = true;             ///< one place, always
    std::vector<Place> places;
  };
  /// A function with code, or one that stands in others.
  struct Function {
    std::string name;
    std::uint32_t unit = 0;                 ///< LineTable::unit_files has its files,
    unsigned file = 0;                      ///< of which this one, from 1 on, holds its name; 0: not known
    int line = 0;                           ///< ... in this line
    std::uint32_t begin = 0, end = 0;       ///< 0: it has no code of its own
    bool is_left_out = false;               ///< it had, and the linker left it out
    std::vector<std::uint32_t> inlined_at;  ///< where copies of it begin
  };
  /// Part of a variable.
  struct Found {
    const Variable* variable = nullptr;
    int type = 0;
    unsigned offset = 0;
    int bit = 0, width = 0;
  };

  std::vector<Type> types{Type{}};  ///< 0: unknown
  std::vector<Variable> variables;
  std::vector<Function> functions;
  std::map<std::string, int> named;                 ///< types: "u8", "struct node" (of unions and enums too)
  std::map<std::string, std::int32_t> enumerators;  ///< constants that enums name

  /// "speed", "grid[2].x", seen from `pc`: locals of the innermost scope go before. False: `error` says why.
  /// `may_be`: which of the variables of that name are asked about; empty: all.
  bool find(const std::string& expression, std::uint32_t pc, Found& found, std::string& error,
            const std::function<bool(const Variable&)>& may_be = {}) const;
  /// On from `found`'s type and offset by one ".MEMBER" or "[INDEX]". False: `error` says why.
  bool follow(const std::string& step, Found& found, std::string& error) const;
  /// Where it is at `pc`; null: the optimiser keeps it nowhere there.
  static const Place* place_at(const Variable& variable, std::uint32_t pc);

  /// What cannot be read is left out: nothing depends on it.
  void add(Elf* elf);
  /// Where the compiler stood, by place in .debug_line.
  static std::map<std::uint32_t, std::string> folders_in(Elf* elf);

 private:
  bool step_into(const std::string& name, Found& found, int depth = 0) const;
};

/// For Late.
void read_elf(std::string& elf, DebugInfo& into);

}  // namespace dspic
