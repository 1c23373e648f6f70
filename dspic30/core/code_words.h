// SPDX-License-Identifier: MIT
// The decoded words that a robot's program runs on, and where they lie in flash. They are in a CodeTable
// (code_store.h), which robots with the same image share until one of them writes its flash.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "dspic30/core/code_store.h"
#include "dspic30/core/core_fields.h"
#include "dspic30/core/program_watch.h"
#include "dspic30/core/translator.h"
#include "dspic30/memory/program_memory.h"

namespace dspic {

// jumps within translated code are the translator's affair
#ifdef DSPIC_TRANSLATED
#define DSPIC_JUMP __attribute__((noinline))
inline constexpr bool kIsTranslated = true;
#else
#define DSPIC_JUMP
inline constexpr bool kIsTranslated = false;
#endif

class CodeWords : public CoreFields {
 public:
  /// `store`: of the image that `memory` holds; null: its own.
  CodeWords(ProgramMemory& memory, std::shared_ptr<CodeStore> store);
  Translator* translator = nullptr;  ///< null: everything is interpreted
  ProgramWatch* onlooker = nullptr;  ///< null: nobody
  /// Jumps, in 256s, that make the place they lead to worth translating. Interpreting it has taken an eighth
  /// of what translating takes by then; but a translation is kept for later runs, and programs that run so
  /// long are mostly run again. 0: at once, for tests.
  int hot = 32;
  ProgramMemory& program;

  // --- what is known of the words
  /// Program address of a word, of the host's places, or of where no flash is.
  unsigned address_of(const Decoded* d) const {
    if constexpr (kIsTranslated) return 2 * static_cast<unsigned>(d - code_);
    return address_of_any(d);
  }
  static bool is_decoded(const Decoded* d) { return CodeTable::is_decoded(d); }
  void decode(const Decoded* d) { table_->decode(d, program, hot == 0 ? 1 : kFewJumps); }
  /// The word at program address 0.
  const Decoded* code() const { return code_; }
  /// What is known of its words.
  const CodeTable& table() const { return *table_; }

  // --- which words they are
  /// All words are decoded again, for this robot alone.
  void forget_code() { forget_code(false); }
  /// Is it time for Cpu::choose_code()? Before an instruction.
  bool is_code_stale() const { return code_is_stale || program.version() != code_version_; }
  /// The onlooker hears when the instructions at these program addresses begin, from now on.
  void tell_calls(std::vector<std::uint32_t> addresses);
  /// ... of one more, an even address of flash. The words stay, and what is known of them.
  void tell_also(std::uint32_t address) { store_->tell_also(address); }
  /// These routines are answered by heart from now on, as long as flash stays as it is. Nothing but the PC's
  /// time depends on it.
  void know(std::shared_ptr<const KnownCalls> calls);
  /// Not all registers are written, or RAM is looked after: each instruction has to be looked at.
  bool looks_at_each() const { return looks_at_each_; }
  /// These registers were written since the reset, a bit each.
  void note_written(unsigned registers) {
    if ((registers & ~written & kAllWritten) == 0) return;
    written |= registers;
    looked_at_ = 0;
    code_is_stale = true;
    deadline = 0;
  }

 protected:
  /// `is_other`: flash was written.
  void forget_code(bool is_other);

  std::shared_ptr<CodeStore> store_;
  std::shared_ptr<CodeTable> table_;
  const Decoded* code_ = nullptr;   // the table's words
  std::uint64_t code_version_ = 0;  // of the flash that they were made of
  bool looks_at_each_ = false;
  int looked_at_ = 0;                 // instructions, since a register was written first
  unsigned bad_address_ = kFlashEnd;  // where no flash is, and who runs straight on comes to

 private:
  static constexpr std::uint8_t kFewJumps = 16;  // until a translation of an earlier run is looked for
  unsigned address_of_any(const Decoded* d) const;
  void have_own_store(const std::vector<std::uint32_t>& told,
                      std::shared_ptr<const KnownCalls> known = nullptr);

  bool is_own_ = false;  // the store: nobody else has it
};

}  // namespace dspic
