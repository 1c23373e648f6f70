// SPDX-License-Identifier: MIT
// The primitives of hal_dspic's I2C master (hal_dspic/I2C), as they are compiled at -O1. Each begins one
// operation of the module, then counts rounds down until the module's interrupt has cleared the mode:
//
//   prologue --register--> operation on the bus --flag--> handler (mode = 0) --> rest of a round, epilogue
//                          meanwhile rounds, one like the other
//
// The operation runs on the chip's module, at the cycle at which the routine would begin it; the interrupt is
// entered and left as the core does. What comes in between is a closed form of when the flag rises. Where
// anything else may happen before the routine is over, where it would give up or wait in vain, or where the
// wait is not known as one yet (core/waits.h counts it), the routine runs.
#include <array>
#include <optional>
#include <utility>

#include "dspic30/core/waits.h"
#include "dspic30/routines/forms.h"
#include "dspic30/routines/known_routines.h"

namespace dspic {

namespace {

using namespace forms;
using Operation = I2c::Operation;

constexpr unsigned kTrn = sfr("I2CTRN"), kCon = sfr("I2CCON"), kRcv = sfr("I2CRCV"), kFlags = sfr("IFS0") + 1;
constexpr unsigned kVector = kFirstIrqVector + irq::MasterI2c;
constexpr unsigned kFlagBit = 1u << (irq::MasterI2c - 8);  // of the flags' high byte
constexpr Cycle kHandlerCycles = 8;                        // of its instructions before RETFIE
constexpr int kRound = 6, kPlaces = 5, kBranch = 2;  // cycles, instructions of a round; cycles of its last

// the handler, whose sixth word is CLR.B of the mode
constexpr std::uint32_t kClearMode = 0xEF6000;
constexpr std::array<std::uint32_t, 9> kHandler = {0xF80034,   0x781F80, 0x200000, 0x8801A0, 0xA9C085,
                                                   kClearMode, 0x78004F, 0xF90034, 0x064000};

/// How a primitive is made. Cycles from its first instruction on, as it runs without a stop.
struct Shape {
  Operation operation = Operation::None;
  Cycle begins = 0;    ///< the access that begins the operation
  Cycle head = 0;      ///< the first round
  Cycle epilogue = 0;  ///< behind the last round, RETURN included
  int head_at = 0;     ///< words from its first instruction
  unsigned count = 0;  ///< register that counts, from here on
  unsigned from = 0;
  unsigned high = 0;     ///< the count's high word, which stays
  unsigned seen = 0;     ///< the mode's
  unsigned mode = 0;     ///< what the mode is meanwhile
  unsigned pushed = 0;   ///< W0 in the loop; of Receive, the count's high word
  unsigned stacked = 0;  ///< words that it has pushed when the interrupt comes
};

/// One call.
class Primitive {
 public:
  Primitive(Cpu& cpu, std::int64_t limit, const Shape& shape, unsigned mode_address)
      : cpu_(cpu), shape_(shape), mode_(mode_address), begin_(cpu.deadline - 1 - limit), limit_(limit) {}

  /// When all comes. False: the routine has to run.
  bool can_be() {
    const Interrupts& interrupts = cpu_.parts.interrupts;
    const I2c& module = cpu_.parts.i2c;
    if (cpu_.parts.fabric.outside.i2c_may_stretch() || !cpu_.waits || !module.is_ready()) return false;
    if (cpu_.looks_at_each()) return false;  // each instruction counts
    if (!interrupts.sources().enabled(irq::MasterI2c) ||
        interrupts.sources().priority(irq::MasterI2c) <= interrupts.cpu().level() ||
        interrupts.sources().flag(irq::MasterI2c) || !interrupts.has_no_other(kNoVector) ||
        interrupts.cpu().disi_until() > begin_)
      return false;
    if (mode_ % 0x2000 != mode_ || cpu_.is_elsewhere(mode_, true) || !is_handler()) return false;
    begins_ = cpu_.clocks.true_at(begin_ + shape_.begins);
    const Cycle flag = begins_ + module.duration(shape_.operation);
    // the first place in a round at which the flag is seen
    const Cycle head = begin_ + shape_.head, seen = cpu_.clocks.program_at(flag + 1) - head;
    if (seen < kRound) return false;
    rounds_ = seen / kRound;
    place_ = static_cast<int>(seen % kRound);
    if (place_ == kPlaces) {
      ++rounds_;
      place_ = 0;
    }
    cut_ = head + rounds_ * kRound + place_;
    // with what the host's handlers take in between
    constexpr Cycle kMost = 100;
    if (rounds_ + 2 >= shape_.from || flag + kMost >= cpu_.clocks.true_at(begin_ + limit_)) return false;
    is_short_ = holds_all();
    if (cpu_.host && is_host_disturbed(cpu_.clocks.true_at(cut_))) return false;
    return cpu_.waits->is_free_until(cpu_, flag + kMost) && is_known_wait(head);
  }

  /// Up to the epilogue: what begins the operation, rounds, interrupt, the rest of a round.
  template <typename Begin>
  void run(Begin begin) {
    const Cycle end = cpu_.clocks.true_at(begin_ + limit_), now = cpu_.now;
    begin(begins_);
    cpu_.ram[mode_ - Cpu::kRamStart] = 0;
    rounds();
    interrupt();
    const Cycle rest = finish_round();
    cycles_ = cpu_.now + rest + shape_.epilogue - begin_;
    cpu_.deadline = cpu_.clocks.program_at(std::min(end, cpu_.waits->look_at(cpu_)));
    epilogue_ = cpu_.now + rest;
    cpu_.now = now;
  }
  /// When the epilogue begins: true time.
  Cycle epilogue() const { return cpu_.clocks.true_at(epilogue_); }
  int cycles() const { return static_cast<int>(cycles_); }

 private:
  // Would one of a round's places be met as the head of a known wait? The mode is in RAM by then.
  bool is_known_wait(Cycle head) {
    std::uint8_t& mode = cpu_.ram[mode_ - Cpu::kRamStart];
    const std::uint8_t kept = std::exchange(mode, static_cast<std::uint8_t>(shape_.mode));
    for (known_ = 0; known_ < kPlaces; ++known_) {
      wait_.head = first() + known_;
      if (!cpu_.table().is_wait(wait_.head)) continue;
      wait_.vector = kVector;
      wait_.came = cpu_.clocks.own_cycles(head + known_);
      wait_.came_true = cpu_.clocks.true_at(head + known_);
      if (cpu_.waits->knows(cpu_, wait_)) break;
    }
    mode = kept;
    return known_ < kPlaces;
  }
  /// The first instruction of a round.
  const Decoded* first() const { return cpu_.at + shape_.head_at; }
  // is the interrupt's handler the library's, with the same mode?
  bool is_handler() const {
    const unsigned vector =
        (cpu_.parts.interrupts.control().uses_alternate_table() ? 0x84u : 0x04u) + 2 * kVector;
    const std::uint32_t* const flash = cpu_.program.flash();
    const unsigned at = flash[vector / 2] & 0x7FFFFE;
    if (at >= kFlashEnd - 2 * kHandler.size()) return false;
    const std::uint32_t* const words = flash + at / 2;
    constexpr std::size_t kClear = 5;
    return words[kClear] == (kClearMode | mode_) &&
           std::memcmp(words, kHandler.data(), kClear * sizeof *words) == 0 &&
           std::memcmp(words + kClear + 1, &kHandler[kClear + 1],
                       (kHandler.size() - kClear - 1) * sizeof *words) == 0;
  }

  // does a handler known by heart, which this one's interrupt holds off, become pending meanwhile?
  bool is_host_disturbed(Cycle entered) const {
    // from its entry to behind its RETFIE, and some more: what handlers that it does not hold off may take
    constexpr Cycle kBefore = 4, kAlone = kInterruptEntryCycles + kHandlerCycles + kInterruptReturnCycles + 4;
    const Cycle longest = is_short_ ? kAlone : 60;
    for (int h = 0; h < HostCalls::kHandlers; ++h)
      if (cpu_.host->vector(h) != kNoVector &&
          cpu_.host->source_event(h, entered - kBefore) <= entered + longest)
        return true;
    return false;
  }

  void zero_extend(unsigned mode) {
    set(cpu_, shape_.seen, mode);
    logic(cpu_, mode);
    cpu_.c = 1;
  }
  void instruction(int place, unsigned mode) {
    if (place == 0) set(cpu_, shape_.count, sub(cpu_, cpu_.w[shape_.count], 1));
    if (place == 1) set(cpu_, shape_.high, subb(cpu_, cpu_.w[shape_.high], 0));
    if (place == 3) zero_extend(mode);
  }

  // the last whole one leaves its flags; then as far as the interrupt lets it
  void rounds() {
    set(cpu_, shape_.count, shape_.from - static_cast<unsigned>(rounds_) + 1);
    set(cpu_, shape_.high, shape_.operation == Operation::Receive ? shape_.pushed : 0);
    for (int i = 0; i < kPlaces; ++i) instruction(i, shape_.mode);
    for (int i = 0; i < place_; ++i) instruction(i, shape_.mode);
  }

  void interrupt() {
    Interrupts& interrupts = cpu_.parts.interrupts;
    wait_.cut = cpu_.clocks.own_cycles(cut_);
    cpu_.now = cut_;
    cpu_.settle();
    wait_.cut_true = cpu_.now;
    cpu_.parts.events.run_to(cpu_.now);
    const unsigned level = static_cast<unsigned>(interrupts.cpu().level());
    const unsigned pc = cpu_.address_of(first()) + 2 * static_cast<unsigned>(place_);
    leave(cpu_, shape_.stacked, pc & 0xFFFF);
    leave(cpu_, shape_.stacked + 1, cpu_.sr_low() << 8 | (level & 8) << 4 | pc >> 16);
    leave(cpu_, shape_.stacked + 2, cpu_.psvpag);
    leave(cpu_, shape_.stacked + 3, shape_.pushed);
    cpu_.now = interrupts.enter(static_cast<int>(kVector), cpu_.now).first_instruction;
    const std::uint64_t share = is_short_ ? cpu_.host->share_q32() : 0;
    follow(0);
    // its flag, and RETFIE
    lower_flag(cpu_.true_now() + 4);
    cpu_.now += kHandlerCycles;
    cpu_.settle();
    cpu_.parts.events.run_to(cpu_.now);
    cpu_.now = interrupts.leave_to(static_cast<int>(level), cpu_.now);
    follow(share);
  }
  // Does it hold off all handlers known by heart? None of them comes meanwhile (is_host_disturbed()), so all
  // that comes of it is that they take no share.
  bool holds_all() const {
    if (!cpu_.host || cpu_.host_is_held || cpu_.host_stale) return false;
    const Interrupts& interrupts = cpu_.parts.interrupts;
    const int own = interrupts.sources().priority(irq::MasterI2c);
    for (int h = 0; h < HostCalls::kHandlers; ++h)
      if (const int vector = cpu_.host->vector(h);
          vector != kNoVector && interrupts.sources().priority(vector - kFirstIrqVector) > own)
        return false;
    return true;
  }
  void follow(std::uint64_t share) {
    cpu_.settle();
    cpu_.parts.events.run_to(cpu_.now);
    if (is_short_)
      cpu_.clocks.set_share(share);
    else if (cpu_.host)
      cpu_.follow_host();
  }
  void lower_flag(Cycle at) {
    ChipParts& parts = cpu_.parts;
    parts.events.run_to(at);
    const unsigned word = kFlags & ~1u;
    const auto kept = static_cast<std::uint16_t>(~(kFlagBit << 8));
    if (!parts.are_flags(word, at))
      parts.write(kFlags, static_cast<std::uint16_t>(parts.read(kFlags, 8, at) & ~kFlagBit), 8, at);
    else if (!parts.lower_flags(word, kept, at))
      parts.modify_flags(word, kept, 0, at);
  }

  /// Cycles from behind the handler to the epilogue: the mode is seen to be 0.
  Cycle finish_round() {
    cpu_.waits->note(cpu_, wait_);
    const bool goes_round = place_ == kPlaces - 1;  // it had been seen before
    if (goes_round) pass(place_, 0);
    const Cycle rest = goes_round ? kBranch : 0;
    const int from = goes_round ? 0 : place_;
    for (int i = from; i < kPlaces; ++i) {
      pass(i, rest + i - from);
      instruction(i, 0);
    }
    const Cycle left = rest + kPlaces - from;
    if (known_ < from) cpu_.waits->note_left(cpu_);
    return left;
  }
  /// So long behind the handler it comes to a place of the round.
  void pass(int place, Cycle behind) {
    if (place != known_) return;
    const Cycle at = cpu_.now + behind;
    cpu_.waits->note_over(cpu_, wait_.head, cpu_.clocks.own_cycles(at), cpu_.clocks.true_at(at));
  }

  Cpu& cpu_;
  const Shape& shape_;
  const unsigned mode_;
  const Cycle begin_;  // of the program's clock, as cut_ and epilogue_
  const std::int64_t limit_;
  Cycle begins_ = 0, rounds_ = 0, cut_ = 0, cycles_ = 0, epilogue_ = 0;
  int place_ = 0;          // of the interrupt, in a round
  int known_ = 0;          // at which the wait is known
  bool is_short_ = false;  // the interrupt holds off all handlers known by heart: holds_all()
  Waits::ByHeart wait_;
};

/// The address that MOV #address, Wn at so many words from the routine's first instruction loads.
unsigned loaded(const Cpu& cpu, unsigned address, unsigned words) {
  return cpu.program.read(address + 2 * words) >> 4 & 0xFFFF;
}

// BSET of a bit of I2CCON's low byte
void set_bit(Cpu& cpu, unsigned bit, Cycle at) {
  const unsigned old = cpu.parts.read(kCon, 8, at);
  cpu.parts.write(kCon, static_cast<std::uint16_t>(old | 1u << bit), 8, at);
}

int write_byte(Cpu& cpu, std::int64_t limit) {
  static const Shape shape = {Operation::Transmit, 4, 10, 3, 10, 2, 10000, 3, 4, 2, 1, 0};
  const unsigned mode = loaded(cpu, cpu.address_of(cpu.at), 0);
  Primitive call(cpu, limit, shape, mode);
  if (!call.can_be()) return 0;
  const unsigned byte = cpu.w[0] & 0xFF;
  call.run([&](Cycle at) { cpu.parts.write(kTrn, static_cast<std::uint16_t>(byte), 16, at); });
  set(cpu, 0, 1);
  set(cpu, 1, mode);
  return call.cycles();
}

/// Sets a bit that asks for a condition on the bus, which is `started` or not, if that matters. `loads`: the
/// register that holds the mode afterwards.
int ask(Cpu& cpu, std::int64_t limit, const Shape& shape, std::optional<bool> started, unsigned bit,
        unsigned loads) {
  const unsigned mode = loaded(cpu, cpu.address_of(cpu.at), 0);
  Primitive call(cpu, limit, shape, mode);
  if ((started && cpu.parts.i2c.is_started() != *started) || !call.can_be()) return 0;
  call.run([&](Cycle at) { set_bit(cpu, bit, at); });
  set(cpu, 0, 1);
  set(cpu, loads, mode);
  return call.cycles();
}

int stop(Cpu& cpu, std::int64_t limit) {
  static const Shape shape = {Operation::Stop, 3, 9, 3, 9, 2, 10000, 3, 4, 5, 1, 0};
  return ask(cpu, limit, shape, std::nullopt, 2, 1);
}

int restart(Cpu& cpu, std::int64_t limit) {
  static const Shape shape = {Operation::Restart, 7, 14, 3, 14, 1, 10000, 3, 4, 6, 1, 0};
  return ask(cpu, limit, shape, true, 1, 2);
}

// while a start is seen that no stop has followed it begins nothing
int start(Cpu& cpu, std::int64_t limit) {
  static const Shape shape = {Operation::Start, 6, 13, 4, 17, 1, 10000, 3, 4, 1, 0, 0};
  return ask(cpu, limit, shape, false, 0, 2);
}

// by a jump to what acknowledges and refuses
int refuse(Cpu& cpu, std::int64_t limit) {
  const unsigned here = cpu.address_of(cpu.at), answer = target(cpu, here + 2);
  static const Shape plain = {Operation::Acknowledge, 31, 39, 6, 0, 2, 10000, 3, 4, 3, 1, 1};
  Shape shape = plain;
  shape.head_at = static_cast<int>(answer - here) / 2 + 23;
  const unsigned mode = loaded(cpu, answer, 2);
  Primitive call(cpu, limit, shape, mode);
  if (!call.can_be()) return 0;
  const unsigned w8 = cpu.w[8];
  call.run([&](Cycle at) {
    set_bit(cpu, 5, at - 3);
    set_bit(cpu, 4, at);
  });
  leave(cpu, 0, w8);
  set(cpu, 0, 1);
  set(cpu, 1, mode);
  return call.cycles();
}

int read_byte(Cpu& cpu, std::int64_t limit) {
  static const Shape shape = {Operation::Receive, 26, 32, 14, 25, 1, 0x86A0, 0, 3, 4, 1, 5};
  const unsigned mode = loaded(cpu, cpu.address_of(cpu.at), 4), to = cpu.w[0], top = cpu.w[15];
  Primitive call(cpu, limit, shape, mode);
  const bool is_on_stack = to + 4 >= top && to < top + KnownCalls::kStack;
  if (cpu.is_elsewhere(to, true) || to == mode || is_on_stack || !call.can_be()) return 0;
  leave_registers(cpu, 0, 8, 5);
  call.run([&](Cycle at) { set_bit(cpu, 3, at); });
  const unsigned word = cpu.parts.read(kRcv, 16, call.epilogue());
  cpu.ram[to - Cpu::kRamStart] = static_cast<std::uint8_t>(word);
  set(cpu, 0, 1);
  set(cpu, 2, mode);
  return call.cycles();
}

}  // namespace

const std::vector<KnownRoutine>& i2c_routines() {
  static const std::vector<KnownRoutine> all = {
      {"_e_i2c_start", 0xabbef25faddb2679, nullptr, &start},
      {"_e_i2c_restart", 0x4ac219f5647af54f, nullptr, &restart},
      {"_e_i2c_stop", 0xca625e1910e45b8d, nullptr, &stop},
      {"_e_i2c_nack", 0x9d9e28d9f08c39b7, nullptr, &refuse},
      {"_e_i2c_read", 0x86040a38f2c7d7e1, nullptr, &read_byte},
      {"_e_i2c_write", 0xf894015cb6e39eeb, nullptr, &write_byte},
  };
  return all;
}

}  // namespace dspic
