// SPDX-License-Identifier: MIT
// Reads a program's instructions: which way they lead, what they do to the stack, which places in data they
// read and write by address. For back-traces and for telling what a program waits for.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dspic30/core/instruction_table.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/cycle.h"
#include "dspic30/memory/host_places.h"

namespace debug {

using dspic::Cycle;
using Address = std::uint64_t;

inline constexpr Address kLost = ~Address{0};

/// One level of calls.
struct Frame {
  std::uint32_t pc = 0;
  std::uint32_t call = 0;  ///< of the instruction that is under way: pc, or the call before it
  Address base = 0;        ///< grows with each call
  unsigned sp = 0;         ///< W15 at that instruction
  /// Where the values of W0 to W14 lie that it has, or goes on with; kLost: nobody has kept it.
  std::array<Address, 15> registers{};
  const dspic::CodeMap::Function* function = nullptr;
  bool is_handler = false;
};

/// A place in data.
struct Data {
  Address address = 0;
  unsigned bytes = 2;
  int bit = 0, width = 0;  ///< of a register's field or a bit-field; width 0: all of it
};

/// An instruction as far as it concerns its surroundings.
struct Instruction {
  std::uint32_t address = 0;
  const dspic::Row* row = nullptr;
  dspic::Fields fields;

  std::uint32_t next() const { return address + 2 * static_cast<std::uint32_t>(row->words); }
  bool is_return() const;
  bool is_call() const;  ///< direct or by register
  bool is_skip() const;
  bool is_branch() const;               ///< direct; conditional or not
  std::optional<std::uint32_t> target;  ///< of a direct branch, jump or call
  bool goes_on = true;                  ///< may the next one follow?
  /// A place in data that its text names.
  struct Access {
    unsigned address = 0;
    int bit = -1;  ///< -1: all of it
    bool reads = false, writes = false;
  };
  std::optional<Access> access;
};

class Code {
 public:
  /// `file` outlives this.
  explicit Code(const dspic::FirmwareFile& file);

  const dspic::FirmwareFile& file() const { return file_; }
  std::optional<Instruction> at(std::uint32_t address) const;
  /// All of a function.
  std::vector<Instruction> of(const dspic::CodeMap::Function& function) const;
  /// Vectors that lead to an address; empty: it begins no handler.
  std::vector<int> vectors_of(std::uint32_t address) const;
  bool is_handler(const dspic::CodeMap::Function& function) const {
    return !vectors_of(function.begin).empty();
  }
  /// The function at an address; of one that the simulator plays, at its place beyond the flash. Null: none.
  const dspic::CodeMap::Function* function_at(std::uint32_t address) const;
  /// "drive() (main.c:42)", "e_set_speed_left()"
  std::string describe(std::uint32_t address) const;
  /// Does the instruction at `address` call a function that the simulator plays? Where that begins for the
  /// program: the linker's handle; 0: it does not.
  std::uint32_t host_function_called(std::uint32_t address) const;

  /// The stack of a function at an instruction, as bytes since the function began.
  struct Depth {
    int bytes = 0, frame = 0;  ///< by which it has grown; ... behind LNK's word
    /// Where the first push of W0 to W14 went: the value that its caller has. -1: none was pushed.
    std::array<std::int16_t, 15> saved{-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
    bool shadows = false;  ///< PUSH.S has taken W0 to W3
  };
  /// Found by following every way; null where no way leads.
  const Depth* stack_at(std::uint32_t pc);

 private:
  void follow(const dspic::CodeMap::Function& function);
  static void note_push(const Instruction& i, Depth& depth);

  const dspic::FirmwareFile& file_;
  std::multimap<std::uint32_t, int> vectors_;
  std::map<std::uint32_t, const dspic::CodeMap::Function*> host_functions_;  // by their place
  std::map<std::uint32_t, std::map<std::uint32_t, Depth>> depths_;           // by function, by address
};

/// From the innermost outwards. `word`: a word of RAM at an address; `saved_bytes`: what a handler that is
/// known by heart saves behind the address that it returns to.
template <typename ReadWord>
std::vector<Frame> trace_back(Code& code, std::uint32_t pc, unsigned sp, unsigned saved_bytes,
                              ReadWord word) {
  constexpr std::size_t kMostFrames = 64;
  constexpr unsigned kRamStart = 0x800;
  std::vector<Frame> frames;
  std::uint32_t call = pc;
  std::array<Address, 15> registers{};
  for (std::size_t n = 0; n < registers.size(); ++n) registers[n] = 2 * n;  // in data memory
  while (frames.size() < kMostFrames) {
    const auto* function = code.function_at(pc);
    const bool is_by_heart = pc == dspic::kHostHandlerReturn;  // it has called the function before it
    const auto* const stack = is_by_heart || dspic::is_host_place(pc) ? nullptr : code.stack_at(pc);
    const auto depth = is_by_heart                ? std::optional<int>(static_cast<int>(saved_bytes))
                       : dspic::is_host_place(pc) ? std::optional<int>(0)
                       : stack                    ? std::optional<int>(stack->bytes)
                                                  : std::nullopt;
    Frame frame{pc,        call,     depth ? sp - static_cast<unsigned>(*depth) : 0,         sp,
                registers, function, is_by_heart || (function && code.is_handler(*function))};
    frames.push_back(frame);
    const auto first = code.at(0);  // what a reset jumps to was called by nobody
    if (!depth || frame.base < kRamStart + 4 ||
        (function && first && first->target && code.file().code.function_at(*first->target) == function))
      break;
    const auto base = static_cast<unsigned>(frame.base);
    // its caller's registers: what it has saved, or left alone
    constexpr std::size_t kFirstKept = 8, kShadowed = 4;
    for (std::size_t n = 0; n < registers.size(); ++n) {
      const bool is_saved = stack && stack->saved[n] >= 0 && stack->saved[n] < stack->bytes;
      const bool is_lost = frame.is_handler
                               ? is_by_heart ? n < kFirstKept : stack && stack->shadows && n < kShadowed
                               : n < kFirstKept;
      registers[n] = is_saved  ? base + static_cast<unsigned>(stack->saved[n])
                     : is_lost ? kLost
                               : registers[n];
    }
    const unsigned low = word(base - 4), high = word(base - 2);
    pc = (high & 0x7F) << 16 | (low & 0xFFFE);
    sp = base - 4;
    // a handler goes on with an instruction, a function behind one
    call = pc;
    if (!frame.is_handler && pc != dspic::kHostHandlerReturn) {
      const auto before = code.at(pc - 4);
      call = before && before->is_call() && before->row->words == 2 ? pc - 4 : pc - 2;
      const auto caller = code.at(call);
      if (!caller || !caller->is_call()) break;
    }
  }
  return frames;
}

}  // namespace debug
