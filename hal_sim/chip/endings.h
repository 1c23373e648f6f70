// SPDX-License-Identifier: MIT
// Why a program on the chip began anew without having asked for it, in words:
//
//   a RESET in the default handler    an interrupt, or a trap, that has no handler
//   a RESET behind the start-up code's call of main()    main() has returned
//   a reset of the chip               watchdog, illegal opcode, trap in a trap
//   address 0 by a call or a jump     a null pointer, or a weak function that is not there; nothing is reset
//
// Any other RESET is the program's own wish. Recognised by structure, so it holds for images of others as
// well: XC16's default handler and start-up code, with or without symbols. docs/controllers.md says the same.
#pragma once
#include <map>
#include <optional>
#include <string>

#include "dspic30/core/trap_record.h"
#include "hal_sim/chip/program_places.h"

namespace chip {

struct Ending {
  int kind = 0;        ///< host::TrapKind
  std::string vector;  ///< "MathError", "T1", "Reset"
  std::string message;
  unsigned place = 0;  ///< the program's own instruction that led to it
};

class Endings final {
 public:
  /// All of them outlive this.
  Endings(const dspic::FirmwareFile& file, const dspic::ProgramMemory& program,
          const dspic::Processor& processor, SolderedChip& chip, const ProgramPlaces& places)
      : file_(file), program_(program), processor_(processor), chip_(chip), places_(places) {}

  /// An instruction leads to a trap, which has not been raised yet.
  void note_trap(const dspic::TrapRecord& trap);
  /// The chip resets, with the processor still as it was. None: the program asked for it.
  std::optional<Ending> of_reset(dspic::ResetKind kind) const;
  /// exit() with a failure, where a function of the host does that.
  Ending of_giving_up() const;
  /// The instruction at `from` leads to address 0.
  Ending of_null_pointer(unsigned from) const;
  /// The program comes to its first instruction. None: behind a reset, or a jump to address 0 at `null_at`.
  std::optional<Ending> of_start(unsigned at, Cycle null_at) const;

 private:
  std::optional<Ending> of_instruction(unsigned at) const;
  std::optional<Ending> of_giving_up(unsigned at) const;
  bool is_default_handler(int vector, unsigned reset_at) const;
  bool resets_at_once(int vector, unsigned reset_at) const;
  unsigned called_main(unsigned reset_at) const;
  Ending of_trap(dspic::Trap trap, const std::string& then, bool is_of_noted) const;
  Ending of_interrupt(int vector, unsigned place) const;
  std::string handler_like(const std::string& wanted) const;
  unsigned cut_off() const;

  const dspic::FirmwareFile& file_;
  const dspic::ProgramMemory& program_;
  const dspic::Processor& processor_;
  SolderedChip& chip_;
  const ProgramPlaces& places_;
  mutable std::map<int, std::string> meant_;  // by vector: what may be its handler
  // the trap whose handler runs, or comes next: traps while it does not count
  struct Noted {
    dspic::TrapRecord record;
    unsigned place = 0;
    bool overflows = false;   // it is the stack that went too far
    bool underflows = false;  // ... or came below RAM
    int missing = -1;         // the vector that led nowhere
  } noted_;
};

}  // namespace chip
