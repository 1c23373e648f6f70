// SPDX-License-Identifier: MIT
// Where in the program's own text something that the chip noticed comes from: the function and line that a
// student wrote, not the library's or the start-up code's. By the image's lines; what calls led there is read
// from the stack, where each return address stands behind a call. Looks only, and only when asked.
#pragma once
#include <string>

#include "dspic30/core/processor.h"
#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/soldered_chip.h"
#include "hal_sim/host/runner.h"

namespace chip {

class ProgramPlaces final {
 public:
  /// All of them outlive this. `shared`: of the image, shared_handler().
  ProgramPlaces(const dspic::FirmwareFile& file, const dspic::ProgramMemory& program, unsigned shared,
                const dspic::Processor& processor, SolderedChip& chip)
      : file_(file), program_(program), processor_(processor), chip_(chip), shared_(shared) {}

  /// Function, file and line of an instruction; "?" where there is none.
  host::Place place_of(unsigned address) const;
  /// "control() (main.c:98)" as far as known.
  std::string text_of(unsigned address) const { return file_.code.describe(address); }
  /// Of the instruction at `address`, or of the call that led to it: the innermost one that is the program's
  /// own. `stack`: W15. The instruction itself, where nothing is.
  unsigned own(unsigned address, unsigned stack) const;
  unsigned own(unsigned address) const { return own(address, processor_.w(15)); }
  /// The call whose return address lies on the stack last, as at a function's first instruction; 0: none.
  unsigned caller() const;
  bool is_own(unsigned address) const { return is_own(file_, address); }
  static bool is_own(const dspic::FirmwareFile& file, unsigned address);
  /// Is it of the file, or a static of the function, of that name?
  static bool is_of(const dspic::FirmwareFile& file, const std::string& scope,
                    const dspic::DebugInfo::Variable& variable);
  /// What many vectors of an image lead to: the default handler; 0: nothing.
  static unsigned shared_handler(const dspic::FirmwareFile& file, const dspic::ProgramMemory& program);
  /// Where a vector leads.
  unsigned handler(int vector) const;
  /// What that handler is called in C: "_T1Interrupt", or "_AltT1Interrupt" while the second table serves.
  std::string handler_name(int vector) const;
  /// Does the handler of `vector` belong to it alone?
  bool has_handler(int vector) const;
  /// The vector whose handler runs, the innermost; kNoVector: none.
  int open_vector() const;
  /// "; meanwhile f() (main.c:12) ran, called by the handler of T2": who has the processor now.
  std::string who_runs() const;
  /// A word of RAM; 0 where there is none.
  unsigned stack_word(unsigned address) const;
  /// The call that stands in front of an address; 0: there is none.
  unsigned call_before(unsigned address) const;
  /// Where the call or jump at an address leads, if it says so itself; else 0.
  unsigned target(unsigned at) const;
  /// The calls in the program's own code that led to `own` from `address`, which runs now, the innermost
  /// first; `own` itself is none of them. Up to the frame of an interrupt; at most `most`.
  std::vector<unsigned> callers(unsigned address, unsigned own, std::size_t most) const;

 private:
  bool has_alternate_table() const;
  int beginning_vector(unsigned here) const;
  /// The return address that ends below `top` of the stack; 0: what lies there is none.
  unsigned stack_address(unsigned top) const;
  unsigned last_jump(unsigned call, unsigned to) const;
  /// The vector that leads to the function of an address; kNoVector: none does.
  int vector_of(unsigned address) const;
  bool is_handler_code(unsigned address) const { return vector_of(address) != dspic::kNoVector; }

  const dspic::FirmwareFile& file_;
  const dspic::ProgramMemory& program_;
  const dspic::Processor& processor_;
  SolderedChip& chip_;
  const unsigned shared_;
};

/// Where the GOTO at a program address leads; 0: there is none.
unsigned goto_target(const dspic::FirmwareFile& file, unsigned address);
/// Where the CALL, RCALL, GOTO or BRA at an address of an image leads; 0: it is none.
unsigned destination(const dspic::FirmwareFile& file, unsigned address);

/// "__T1Interrupt"'s name in C: "_T1Interrupt", "_MathError".
std::string handler_of(int vector);

}  // namespace chip
