// SPDX-License-Identifier: MIT
// The processor's state, as its instructions see it; Processor (processor.h) is the front door.
//
//   flash word --decode once--> Decoded {run, registers, literal, cycles} --run(cpu, decoded)--> next Decoded
//                                  in a CodeTable (code_store.h), which robots with the same image share
//
// Time: `now` is the cycle in which an instruction begins, by the program's clock (two_clocks.h); a stall
// delays its accesses by `lead`. Straight code runs until `deadline`, the next instant at which anything else
// may happen, by the same clock; whatever changes that instant lowers it. What leaves the core sees the true
// time. Stalls are found when a word is decoded. Flags are kept as they fall out of an operation and put
// together when SR is read.
//
// Modelled: see docs/dev/chip.md. Source: [chip C2] to [chip C16].
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "dspic30/core/code_store.h"
#include "dspic30/core/core_fields.h"
#include "dspic30/core/counting.h"
#include "dspic30/core/course_watch.h"
#include "dspic30/core/host_calls.h"
#include "dspic30/core/host_place.h"
#include "dspic30/core/instruction_table.h"
#include "dspic30/core/known_waits.h"
#include "dspic30/core/program_watch.h"
#include "dspic30/core/semantics.h"
#include "dspic30/core/translator.h"
#include "dspic30/core/trap_record.h"
#include "dspic30/core/two_clocks.h"
#include "dspic30/core/wait_heads.h"
#include "dspic30/device/chip_parts.h"
#include "dspic30/memory/host_places.h"
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

class MemoryCheck;  // memory_check.h
class Waits;

class Cpu final : public SfrOwner, public CoreFields {
 public:
  /// `store`: of the image that `program` holds; null: its own.
  Cpu(ChipParts& parts, ProgramMemory& program, std::shared_ptr<CodeStore> store);
  Translator* translator = nullptr;  ///< null: everything is interpreted
  ProgramWatch* onlooker = nullptr;  ///< null: nobody
  CourseWatch* course = nullptr;     ///< null: nobody
  /// Jumps, in 256s, that make the place they lead to worth translating. Interpreting it has taken an eighth
  /// of what translating takes by then; but a translation is kept for later runs, and programs that run so
  /// long are mostly run again. 0: at once, for tests.
  int hot = 32;

  void reset();
  /// All words are decoded again, for this robot alone.
  void forget_code() { forget_code(false); }
  /// Is it time for choose_code()? Before an instruction.
  bool is_code_stale() const { return code_is_stale || program.version() != code_version_; }
  /// Moves to the code that goes with its flash, the registers that were written, and special pointers.
  void choose_code();
  /// The onlooker hears when the instructions at these program addresses begin, from now on.
  void tell_calls(std::vector<std::uint32_t> addresses);
  /// These routines are answered by heart from now on, as long as flash stays as it is. Nothing but the PC's
  /// time depends on it.
  void know(std::shared_ptr<const KnownCalls> calls) {
    if (!store_->know(calls)) {
      have_own_store(store_->told());
      store_->know(calls);
    }
    code_is_stale = true;
  }
  /// RAM is looked after from now on, before anything has run: each instruction is interpreted. Nothing but
  /// the PC's time depends on it.
  void check_memory(MemoryCheck* check);
  // --- flow
  unsigned address_of(const Decoded* d) const {
    if constexpr (kIsTranslated) return 2 * static_cast<unsigned>(d - code_);
    return address_of_any(d);
  }
  /// The instruction at a program address that the course jumps to.
  const Decoded* jump(unsigned address, const Decoded* from);
  const Decoded* arrive(const Decoded* target) {
    if (!is_decoded(target)) decode(target);
    now -= target->lead;
    count_jump(target);
    return target;
  }
  DSPIC_JUMP const Decoded* offset(const Decoded* from, std::int32_t words) {
    const std::ptrdiff_t index = from - code_ + words;
    return index >= 0 && index < static_cast<std::ptrdiff_t>(kFlashWords)
               ? arrive(code_ + index)
               : jump(static_cast<unsigned>(2 * index) & 0x7FFFFE, from);
  }
  /// Back to where an interrupt cut the program: as jump(), but nothing begins there.
  const Decoded* jump_back(unsigned address, const Decoded* from);
  /// A call of the function at a program address, with the one that it returns to; and a return.
  DSPIC_JUMP const Decoded* call_to(unsigned address, const Decoded* from, [[maybe_unused]] unsigned back) {
    return jump(address, from);
  }
  DSPIC_JUMP const Decoded* return_to(unsigned address, const Decoded* from) {
    return jump(pointed(address, from), from);
  }
  /// ... of the instruction at `at`, out of translated code.
  static const Decoded* return_from(Cpu& cpu, const Decoded*, unsigned address) {
    return cpu.return_to(address, cpu.at);
  }
  static bool is_decoded(const Decoded* d) { return CodeTable::is_decoded(d); }
  static const Decoded* arrive_from(Cpu& cpu, const Decoded* from, std::int32_t words) {
    return cpu.offset(from, words);
  }
  /// Straight on to a place that counts as one that is jumped to: translated code ended before it.
  static const Decoded* go_on(Cpu& cpu, const Decoded* from, std::int32_t words) {
    const Decoded* const d = from + words;
    if (cpu.is_decoded(d)) cpu.count_jump(d);
    return d;
  }
  void decode(const Decoded* d) { table_->decode(d, program, hot == 0 ? 1 : kFewJumps); }
  const Decoded* code() const { return code_; }
  /// What is known of its words.
  const CodeTable& table() const { return *table_; }
  /// This one instruction alone, with its own function: not the translated code that begins there.
  static const Decoded* run_alone(Cpu& cpu, const Decoded* d) {
    if (cpu.looks_at_each_) return cpu.looked_at(d)(cpu, d);
    if (!cpu.is_decoded(d)) cpu.decode(d);
    return cpu.table().plain(d)(cpu, d);
  }
  /// ... and the onlooker hears of it.
  static const Decoded* run_one(Cpu& cpu, const Decoded* d) {
    if (!cpu.looks_at_each_ && !address_of_host_place(d) && cpu.is_decoded(d) && cpu.table().tells(d) &&
        !cpu.table().known_at(cpu.address_of(d)))
      hear(cpu, d);
    return run_alone(cpu, d);
  }
  /// Runs up to `deadline` as long as not all registers are written, when each instruction
  /// has to be looked at.
  bool looks_at_each() const { return looks_at_each_; }
  void run_each();
  void run_checked();
  /// The function of this one instruction for this robot, whose registers count as written by it.
  Run looked_at(const Decoded* d);
  /// Up to `deadline`, as straight as code goes.
  void run_straight() {
    const Decoded* d = next;
    while (now < deadline) {
      at = d;
      const Decoded* following = d->run.load(std::memory_order_acquire)(*this, d);
      now += d->cycles;
      if (d == loop_end) following = loop_back(d, following);
      d = following;
    }
    next = d;
  }
  /// These registers were written since the reset, a bit each.
  void note_written(unsigned registers) {
    if ((registers & ~written & kAllWritten) == 0) return;
    written |= registers;
    looked_at_ = 0;
    code_is_stale = true;
    deadline = 0;
  }
  const Decoded* loop_back(const Decoded* last, const Decoded* next);
  /// Iterations up to the last one or to `deadline`; then d itself is next.
  const Decoded* run_repeated(const Decoded* d);
  void begin_do(unsigned count, const Decoded* first, const Decoded* last);
  /// The instruction at `at` does what the chip does not allow: the flag is set, and the trap's handler comes
  /// before the next instruction.
  void trap(Trap which);
  /// Of a register or the stack: where it leads. A null pointer is told.
  unsigned pointed(unsigned address, const Decoded* from) {
    if (address == 0) tell_null_pointer(address_of(from));
    return address;
  }

  // --- flags
  unsigned sr() const;
  unsigned sr_low() const;
  void set_sr(unsigned value, unsigned lanes);
  void set_flags(unsigned sr_low_bits);  ///< C Z OV N

  // --- data space
  unsigned read16(unsigned ea) {
    if (ea - plain_start < plain_ram() && !(ea & 1)) return load(ea - kRamStart);
    if constexpr (kIsTranslated) {
      if (!(ea & 1) && is_flash_constant(ea)) return flash_constant(ea);
      if (is_served(ea) && !(ea & 1)) return read_served(ea, 16);
    }
    return read_elsewhere(ea, 16);
  }
  /// The second word of a pair: through the PSV window it costs nothing.
  unsigned read16_behind(unsigned ea) {
    if constexpr (kIsTranslated)
      if (is_flash_constant(ea) && !(ea & 1)) return flash_word(ea);
    const Window before = window;
    window = Window::Free;
    const unsigned value = read16(ea);
    window = before;
    return value;
  }
  unsigned read8(unsigned ea) {
    if (ea - plain_start < plain_ram()) return ram[ea - kRamStart];
    if constexpr (kIsTranslated) {
      if (is_flash_constant(ea)) return flash_constant(ea) >> 8 * (ea & 1) & 0xFF;
      if (is_served(ea)) return read_served(ea, 8);
    }
    return read_elsewhere(ea, 8);
  }
  void write16(unsigned ea, unsigned value) {
    if (ea - plain_start < plain_ram() && !(ea & 1))
      store(ea - kRamStart, value);
    else
      write_elsewhere(ea, value, 16);
  }
  void write8(unsigned ea, unsigned value) {
    if (ea - plain_start < plain_ram())
      ram[ea - kRamStart] = static_cast<std::uint8_t>(value);
    else
      write_elsewhere(ea, value, 8);
  }
  template <bool Byte>
  unsigned read(unsigned ea) {
    return Byte ? read8(ea) : read16(ea);
  }
  template <bool Byte>
  void write(unsigned ea, unsigned value) {
    Byte ? write8(ea, value) : write16(ea, value);
  }
  /// Is it no RAM, or not to be had as it is?
  bool is_elsewhere(unsigned ea, bool byte) const {
    return ea - plain_start >= plain_ram() || (!byte && (ea & 1));
  }
  /// What stands there becomes (old & keep) ^ flip; as read and write, faster for what handlers change.
  void modify_elsewhere(unsigned ea, unsigned keep, unsigned flip, unsigned bits);
  /// A return address: two words, as push() puts them one after the other, and as pop() takes them.
  void push_address(unsigned address) {
    const unsigned ea = w[15];
    if (is_plain_pair(ea)) {
      std::memcpy(&ram[ea - kRamStart], &address, 4);
      w[15] = static_cast<std::uint16_t>(ea + 4);
      return;
    }
    push_slowly(address);
  }
  unsigned pop_address() {
    const auto ea = static_cast<std::uint16_t>(w[15] - 4);
    if (is_plain_pair(ea)) {
      std::uint32_t address;
      std::memcpy(&address, &ram[ea - kRamStart], 4);
      w[15] = ea;
      return address & 0x7FFFFE;
    }
    return pop_slowly();
  }
  void push(unsigned value) {
    const unsigned ea = stack_checked(w[15]);
    w[15] = static_cast<std::uint16_t>(ea + 2);
    write16(ea, value);
  }
  unsigned pop() {
    w[15] = static_cast<std::uint16_t>(w[15] - 2);
    const unsigned ea = stack_checked(w[15]);
    return ea - plain_start < plain_ram() && !(ea & 1) ? load(ea - kRamStart) : read_elsewhere(ea, 16);
  }

  /// What handlers save and give back: a word that is nobody's affair but the core's, and its bits.
  /// Null: another address.
  struct Saved {
    std::uint16_t Cpu::*word = nullptr;
    std::uint16_t bits = 0;
  };
  static Saved saved_register(unsigned ea);

  // --- pointers
  unsigned source_address(const Decoded* d) {
    if (d->s_kind == Pointer::Stack) return stack_address(d->s_pre, d->s_post);
    if (d->s_kind == Pointer::Special) return special_pointer(d->s, d->s_pre, d->s_post, false);
    const auto ea = static_cast<std::uint16_t>(w[d->s] + d->s_pre);
    w[d->s] = static_cast<std::uint16_t>(ea + d->s_post);
    return ea;
  }
  unsigned destination_address(const Decoded* d) {
    if (d->d_kind == Pointer::Stack) return stack_address(d->d_pre, d->d_post);
    if (d->d_kind == Pointer::Special) return special_pointer(d->d, d->d_pre, d->d_post, true);
    const auto ea = static_cast<std::uint16_t>(w[d->d] + d->d_pre);
    w[d->d] = static_cast<std::uint16_t>(ea + d->d_post);
    return ea;
  }
  unsigned special_pointer(unsigned n, int pre, int post, bool write);
  unsigned stack_address(int pre, int post) {
    const unsigned ea = static_cast<unsigned>(w[15] + pre) & 0xFFFE;
    w[15] = static_cast<std::uint16_t>((ea + static_cast<unsigned>(post)) & 0xFFFE);
    return stack_checked(ea);
  }
  unsigned stack_checked(unsigned ea) {
    if constexpr (kIsTranslated) {
      if (ea - plain_start >= plain_ram() || ea > stack_most) check_stack(ea);
    } else if (ea < kRamStart || ea > stack_most) {
      trap(Trap::StackError);
    }
    return ea;
  }
  /// A register moved by `step` within its modulo buffer, if it has one. `y_space`: by the
  /// Y address generator.
  unsigned stepped(unsigned n, unsigned value, int step, bool y_space) const;
  /// Pointers that need more than an addition, one bit a register: when they read, and when they write.
  std::array<std::uint32_t, 2> special_registers() const;

  // --- SfrOwner: 0x000 to 0x052
  std::uint16_t read(unsigned address, Cycle at) override { return peek(address, at); }
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle at) override;
  std::uint16_t peek(unsigned address, Cycle at) const override;
  Cycle horizon(unsigned address, Cycle at) const override;

  /// Reading through the PSV window in the first and last iteration of a REPEAT, and around an interrupt.
  static constexpr Cycle kRepeatWindow = 2;
  // --- time
  /// The true time.
  Cycle true_now() const { return clocks.true_at(now); }
  /// Both clocks agree from here on. Not where straight code goes on: `deadline` is by the clock of before.
  void settle() { clocks.settle(now); }
  TwoClocks clocks;
  Cycle delayed = 0;  ///< cycles spent in repeated NOPs, and in functions of the host that wait
  /// Time since `from`, by the program's clock, only passed.
  void note_delay(Cycle from) {
    delayed += now - from;
    if (course && !in_wait && now > from) course->waited(clocks.true_at(from), true_now());
  }
  bool in_wait = false;  ///< it is told as a whole

  // --- whoever plays the library (host_calls.h)
  HostCalls* host = nullptr;  ///< null: the program is all there is
  /// Plain RAM begins here; what is below is served by the host.
  void serve_ram(unsigned plain_from) { plain_start = plain_from, watch_round(round_memory); }
  /// For host functions that look at something which stays so until then.
  void note_look(Cycle until) {
    looks_outside = true;
    watched_until = std::min(watched_until, until);
  }
  /// What handlers take, or when one comes, may be another from now on.
  void host_changed() { host_stale = true; }
  /// Goes by it, `ahead` cycles from now, unless it stops before its next instruction.
  void follow_changed_host(Cycle ahead);
  bool host_stale = true;
  bool host_followed = false;  ///< since Processor::run() looked last: its deadlines are of a clock of before
  bool host_comes = false;     ///< the handler that calls the program is not switched off
  bool host_is_held = true;    ///< one of the handlers is held off
  Cycle host_due = kNever;     ///< when the next one comes that calls the program
  Cycle stop_at = kNever;      ///< true time: `deadline` but for that handler and for looks
  Cycle soonest = kNever;      ///< ... and whatever the end of run()
  Cycle pause_at = kNever;     ///< ... when a look for a wait comes
  std::int64_t writes_seen = 0;  ///< to interrupt registers, when Processor::run() looked last
  bool host_again = false;       ///< the function of the host that stands there has been called already
  int host_handlers = 0;         ///< handlers known by heart under way, or left by a jump
  /// A handler known by heart is entered, as an interrupt is; go_on_with_handler() is next.
  void enter_handler();
  /// What the handler does next, behind its entry or a return to it. The clock is where that begins.
  const Decoded* go_on_with_handler(const Decoded* from);
  /// RETFIE's work: level, flags and place of the program from the stack. `rest`: cycles of it that
  /// are not counted yet.
  const Decoded* return_from_handler(const Decoded* from, Cycle rest);
  /// A function of the host waits here.
  void stand(Cycle until, const Decoded* d);
  Cycle stands_until = 0;
  const Decoded* stands_at = nullptr;
  /// Does it wait now?
  bool stands_in_host() const;

  // --- waits (waits.h)
  Waits* waits = nullptr;
  bool returned = false;  ///< a handler has, since Processor::run() looked last
  /// Something was done that a wait does not do.
  void note_effect() { watched_until = 0; }
  /// Accesses to RAM are noted from now on; null: no longer.
  void watch_round(RoundMemory* memory) {
    round_memory = memory;
    watching = memory != nullptr;
    plain_bytes = memory || memory_check ? 0 : kRamEnd - plain_start;
  }
  /// A wait was proven that begins here: from now on the program stops there to look, if heads_from says so.
  void mark_head(const Decoded* first);
  /// Where waits of this program begin.
  WaitHeads heads;
  /// The program comes to a head: does it stop?
  bool stops_at(const Decoded* head);
  Cycle watched_until = kNever;  ///< what was read since skip_wait() began to look stays as it is until here
  bool watching = false;
  bool looks_outside = false;           ///< since then a register of a peripheral was read
  bool reads_core = false;              ///< ... or one of the core's, by its address; or DC
  RoundMemory* round_memory = nullptr;  ///< notes accesses to RAM: watch_round()
  Cycle still_since =
      kNever;                ///< since when nothing that the program looks at can change but by an interrupt
  bool still_reads = false;  ///< does such a round read anything at all?

  static constexpr unsigned kRamStart = 0x800, kRamBytes = 0x2000, kRamEnd = kRamStart + kRamBytes,
                            kPsvStart = 0x8000, kYStart = 0x1800;
  unsigned plain_start = kRamStart;                         ///< serve_ram()
  static constexpr unsigned kFlashPages = kFlashEnd >> 15;  ///< of the PSV window
  static constexpr std::uint16_t kPsvOn = sfr_bits("CORCON", "PSV");

  ChipParts& parts;
  ProgramMemory& program;

 private:
  /// Bytes of RAM that are accessed without further ado: none while somebody notes it.
  unsigned plain_ram() const {
#ifdef DSPIC_TRANSLATED
    return kRamEnd - plain_start;
#else
    return plain_bytes;
#endif
  }
  unsigned load(unsigned i) const {
    std::uint16_t value;
    std::memcpy(&value, &ram[i], 2);
    return value;
  }
  void store(unsigned i, unsigned value) {
    const auto word = static_cast<std::uint16_t>(value);
    std::memcpy(&ram[i], &word, 2);
  }
  /// In translated code, of which none is repeated: a word of the flash through the PSV window, and what that
  /// costs (Decoded::psv; the translator knows it).
  bool is_flash_constant(unsigned ea) const { return ea >= kPsvStart && window_words; }
  unsigned flash_constant(unsigned ea) {
    now += psv_cost();
    return flash_word(ea);
  }
  unsigned flash_word(unsigned ea) const { return window_words[(ea & 0x7FFE) >> 1] & 0xFFFF; }
  static int psv_cost();
  /// Does whoever plays the library hold it?
  bool is_served(unsigned ea) const { return ea - kRamStart < plain_start - kRamStart; }
  /// What it holds there by now: nothing else comes of the look, so translated code goes on behind it.
  unsigned read_served(unsigned ea, unsigned bits);
  unsigned read_served(unsigned ea, unsigned bits, Cycle t);
  unsigned read_elsewhere(unsigned ea, unsigned bits);
  __attribute__((noinline)) unsigned read_other(unsigned ea, unsigned bits, Cycle t);
  void write_elsewhere(unsigned ea, unsigned value, unsigned bits);
  unsigned read_psv(unsigned ea, unsigned bits);
  void find_loop_end();
  /// Is it RAM that somebody looks after, and nobody notes?
  bool is_checked(unsigned ea, unsigned bits) const {
    return ea - plain_start < kRamEnd - plain_start && memory_check && !watching && !(bits == 16 && (ea & 1));
  }
  bool is_plain_pair(unsigned ea) const {
    const unsigned bytes = plain_ram();
    return bytes >= 4 && ea - plain_start <= bytes - 4 && !(ea & 1) && ea + 2 <= stack_most;
  }
  __attribute__((noinline)) void push_slowly(unsigned address);
  __attribute__((noinline)) unsigned pop_slowly();
  __attribute__((noinline)) void check_stack(unsigned ea);
  unsigned address_of_any(const Decoded* d) const;
  bool is_plain_frame(unsigned begin, unsigned words) const;
  void push_frame(unsigned registers, int words);
  void pop_frame(unsigned registers, int words);
  /// The deadline is no later than `at`, which is true time.
  void hurry_to(Cycle at) {
    deadline = std::min(deadline, clocks.program_at(at));
    stop_at = std::min(stop_at, at);
    soonest = std::min(soonest, at);
  }
  unsigned plain_bytes = kRamBytes;  // 0 while accesses are noted
  __attribute__((noinline)) void tell_null_pointer(unsigned from);
  static constexpr std::uint8_t kFewJumps = 16;  // until a translation of an earlier run is looked for
  void count_jump(const Decoded* target) {
    const std::uint8_t left = target->heat.load(std::memory_order_relaxed);
    if (left > 1)
      target->heat.store(static_cast<std::uint8_t>(left - 1), std::memory_order_relaxed);
    else if (left == 1)
      warm(target);
  }
  __attribute__((noinline)) void warm(const Decoded* target);
  void run_on(std::shared_ptr<CodeTable> table);
  void forget_code(bool is_other);
  void have_own_store(const std::vector<std::uint32_t>& told,
                      std::shared_ptr<const KnownCalls> known = nullptr);

  std::shared_ptr<CodeStore> store_;
  std::shared_ptr<CodeTable> table_;
  const Decoded* code_ = nullptr;   // the table's words
  std::uint64_t code_version_ = 0;  // of the flash that they were made of
  bool is_own_ = false;             // the store: nobody else has it
  bool looks_at_each_ = false;
  int looked_at_ = 0;         // instructions, since a register was written first
  unsigned bad_address_ = 0;  // where no flash is

 public:
  // what is looked at less often than at each turn lies behind all else
  std::array<std::uint16_t, 4> modulo{};  ///< XMODSRT, XMODEND, YMODSRT, YMODEND
  struct Loop {
    unsigned count = 0, start = 0, end = 0;
  } loop, outer_loop;
  int loop_depth = 0;  ///< DL
  std::array<std::int64_t, 2> acc{};
  struct {
    std::array<std::uint16_t, 4> w{};
    unsigned flags = 0;  // SR<8>, SR<3:0>
  } shadow;
  /// What led to the last trap that was told (Cause::CpuTrap), through all resets. Of a stack error, the
  /// instruction that went beyond the limit, also where that was beyond RAM and so an address error as well. A
  /// store to a frame beyond RAM is an address error with the stack pointer above the limit.
  std::optional<TrapRecord> latest_trap;
  /// The host hears which handlers known by heart the program holds off by now.
  std::function<void()> follow_host;
  KnownWaits known_waits;
  KnownCounts known_counts;
  MemoryCheck* memory_check = nullptr;  ///< null: nobody looks after RAM
  std::array<std::uint8_t, kRamBytes> ram{};
};

#ifdef DSPIC_TRANSLATED
/// All files meet the types in one order, or else their bitcode has types of its own for each.
__attribute__((used)) static void meet_types(Cpu&) {}
#endif

}  // namespace dspic
