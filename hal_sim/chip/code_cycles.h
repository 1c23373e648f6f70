// SPDX-License-Identifier: MIT
// What code takes by itself, without a run: exact where it is straight, least and most over its ways where it
// branches. Where it loops, sleeps or goes where a register says, only a run tells.
//
//   FirmwareFile --decode_word--> cycles of each instruction --ways from an entry to RETURN--> PathCycles
//
// As Profile counts a call: from the first instruction up to RETURN, its own three cycles included, what is
// called included, the CALL itself not, handlers not; of a handler with its entry. RETURN is a cycle shorter
// where an interrupt comes next.
#pragma once
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dspic30/core/code_store.h"
#include "dspic30/core/instruction_table.h"
#include "dspic30/load/firmware_file.h"
#include "dspic30/memory/cycle.h"
#include "dspic30/memory/program_memory.h"

namespace chip {

struct PathCycles {
  dspic::Cycle least = 0, most = 0;
  std::string why_not;  ///< "loops (main.c:12)": there is no bound; empty: there is
  bool is_known() const { return why_not.empty(); }
};

class CodeCycles {
 public:
  /// `file` outlives this.
  explicit CodeCycles(const dspic::FirmwareFile& file);

  /// Of a call of the function that begins at a program address.
  PathCycles of_function(std::uint32_t begin);

  /// The instructions of a source line within a function.
  struct Line {
    std::string file;
    int line = 0;
    int instructions = 0;
    dspic::Cycle least = 0,
                 most = 0;           ///< once through all of them; most: all branches taken, all tables read
    std::vector<std::string> calls;  ///< functions whose own cycles are not in it; "a pointer"
    bool repeats = false;            ///< by a REPEAT whose count a register says
  };
  /// By line. `end`: behind the function's last word.
  std::vector<Line> lines(std::uint32_t begin, std::uint32_t end) const;

 private:
  /// An instruction with all that its cycles depend on.
  struct Instruction {
    const dspic::Row* row = nullptr;  // null: it is none
    dspic::Decoded decoded;
    dspic::Cycle least = 0, most = 0;  // without a stall, a branch that is taken, a skip, further iterations
    std::uint32_t target = 0;          // of a jump or call
    unsigned repeats = 0;              // further iterations of the next one
  };
  /// What registers may point to, as far as the code since the last jump says.
  struct Pointers {
    std::uint16_t ram = kFrames, table = 0;  // a bit a register
    static constexpr std::uint16_t kFrames = 0xC000;
  };
  Instruction at(std::uint32_t address) const;
  static dspic::Cycle iterations(const Instruction& repeat, const Instruction& repeated);
  void add_table_reads(Instruction& instruction, const Pointers& pointers) const;
  static void follow(const Instruction& instruction, Pointers& pointers);
  PathCycles from(std::uint32_t address, bool jumped, int depth);
  PathCycles walk(std::uint32_t address, bool jumped, int depth);
  PathCycles without_bound(const std::string& why, std::uint32_t address) const;

  const dspic::FirmwareFile& file_;
  dspic::ProgramMemory program_;
  std::map<std::pair<std::uint32_t, bool>, PathCycles> known_;  // by address, and whether it was jumped to
  std::set<std::pair<std::uint32_t, bool>> open_;               // on the way
};

}  // namespace chip
