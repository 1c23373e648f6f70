// SPDX-License-Identifier: MIT
#include "dspic30/periph/interrupts.h"

#include <string>

#include "dspic30/periph/fabric.h"

namespace dspic {

namespace {

constexpr unsigned kIntcon1 = sfr("INTCON1"), kIntcon2 = sfr("INTCON2"), kIfs0 = sfr("IFS0"),
                   kIec0 = sfr("IEC0"), kIpc0 = sfr("IPC0"), kInttreg = sfr("INTTREG");
constexpr SfrBits kIlr = sfr_field("INTTREG", "ILR");
constexpr std::uint16_t kDisi = sfr_bits("INTCON2", "DISI");
constexpr int kDefaultPriority = 4;
// of a hard trap, 13 or 14
constexpr int kHardLevel = 13;

}  // namespace

const char* vector_name(int vector) {
  static constexpr const char* kTraps[] = {"OscillatorFail", "AddressError", "StackError", "MathError"};
  return vector >= 1 && vector <= 4 ? kTraps[vector - 1] : irq_name(vector - kFirstIrqVector);
}

void Interrupts::attach(SfrBus& bus) { bus.attach(*this, kIntcon1, kInttreg); }

void Interrupts::reset(Cycle now) {
  for (int irq = 0; irq < kIrqs; ++irq) note_missed(irq, tally_.missing.end(irq, now), now);
  sources_.reset(kDefaultPriority, now);
  tally_.standing = 0;
  control_ = InterruptControl{};
  cpu_.reset();
  flags_read_.fill(-kReadModifyWrite - 1);
  last_vector_ = last_level_ = 0;
  uncleared_ = uncleared_again_ = 0;
  uncleared_traps_ = 0;
}

// --- flags

void Interrupts::note_missed(int irq, std::int64_t events, Cycle at) {
  if (events <= 0 || !sources_.enabled(irq) || (tally_.standing >> irq & 1)) return;
  if (tally_.missed.add(irq, events) == 0) {
    const std::string name = vector_name(kFirstIrqVector + irq);
    diagnostics_.report(Cause::MissedInterrupt, name,
                        name +
                            ": an event came while its flag was still set and enabled; the handler runs "
                            "once for several (too slow, or held off too long)",
                        at);
  }
}

void Interrupts::set_by_program(std::uint64_t flags, Cycle now) {
  for (; flags; flags &= flags - 1) sources_.note_set(__builtin_ctzll(flags), now + 1);
  stirred_ = true;
}

// --- acceptance

/// A program that leaves handlers by jumps forgets the outermost one.
void CpuLevel::make_room() {
  constexpr std::size_t kFirst = 4;
  if (depth_ < kMostFrames) return frames_.resize(std::max(kFirst, 2 * frames_.size()));
  std::move(frames_.begin() + 1, frames_.end(), frames_.begin());
  --depth_;
}

void Interrupts::check_cleared(int i, Cycle entered, Cycle now) {
  if (!sources_.flag(i) || !sources_.enabled(i) || sources_.since(i) > entered) return;
  // the second time in turn is taken for a mistake, and told once
  const std::uint64_t here = std::uint64_t{1} << i, again = uncleared_ & here & ~uncleared_again_;
  uncleared_ |= here;
  uncleared_again_ |= again;
  if (!again) return;
  tell_uncleared(kFirstIrqVector + i,
                 sfr_bit_name(*sfr_info(kIfs0 + 2 * static_cast<unsigned>(i / 16)), i % 16),
                 "the main program hardly runs", now);
}

void Interrupts::check_trap_cleared(int trap, Cycle now) {
  const unsigned here = 1u << trap;
  if (!control_.has_trap(static_cast<Trap>(trap))) {
    uncleared_traps_ &= ~here;
    return;
  }
  if (uncleared_traps_ & here)
    tell_uncleared(trap, sfr_bit_name(*sfr_info(kIntcon1), __builtin_ctz(trap_flag(trap))),
                   "the program does not go on", now);
  uncleared_traps_ |= here;
}

void Interrupts::tell_uncleared(int vector, const std::string& bit, const char* who_waits, Cycle now) {
  const std::string name = vector_name(vector);
  diagnostics_.report(Cause::FlagNeverCleared, name,
                      "the handler of " + name + " returns without clearing " + bit +
                          ", so it is entered again at once and " + who_waits,
                      now);
}

void Interrupts::set_level(int level, Cycle /*now*/) {
  stirred_ = true;
  if (!control_.nesting_disabled()) cpu_.set(level);
}

void Interrupts::raise_trap(Trap trap, Cycle now) {
  const int number = static_cast<int>(trap), level = trap_level(number);
  const bool hard_pending = (control_.traps() & (trap_flag(1) | trap_flag(2))) != 0;
  if (level >= kHardLevel && (cpu_.level() >= level || hard_pending)) {
    diagnostics_.report(Cause::TrapConflict, vector_name(number),
                        std::string(vector_name(number)) + ": a hard trap during another one resets the chip",
                        now);
    control_.ask_reset();
  }
  control_.raise(trap);
  stirred_ = true;
}

// --- registers

std::uint16_t Interrupts::read(unsigned address, Cycle now) {
  if (address < kIfs0 || address >= kIec0) return peek(address, now);
  return read_flags(static_cast<int>(address - kIfs0) / 2, now);
}

std::uint16_t Interrupts::peek(unsigned address, Cycle now) const {
  if (address == kIntcon1) return control_.intcon1();
  if (address == kIntcon2)
    return static_cast<std::uint16_t>(control_.intcon2() | (cpu_.disi_active(now) ? kDisi : 0));
  if (address == kInttreg) return static_cast<std::uint16_t>(last_vector_ | last_level_ << kIlr.lowest);
  if (address < kIec0) return static_cast<std::uint16_t>(sources_.flags() >> 8 * (address - kIfs0));
  if (address < kIpc0) return static_cast<std::uint16_t>(sources_.enabled_mask() >> 8 * (address - kIec0));
  std::uint16_t word = 0;
  const int first = static_cast<int>(address - kIpc0) * 2;
  const std::uint16_t fields = sfr_info(address)->implemented;
  for (int f = 0; f < 4; ++f)
    if (fields >> 4 * f & 7) word |= static_cast<std::uint16_t>(sources_.priority(first + f) << 4 * f);
  return word;
}

void Interrupts::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if (address >= kIfs0 && address < kIec0)
    return write_flags(static_cast<int>(address - kIfs0) / 2, value, lanes, now);
  stirred_ = true;
  ++writes_;
  if (address == kIntcon1) {
    control_.set_intcon1(merge_lanes(control_.intcon1(), value, lanes));
  } else if (address == kIntcon2) {
    const std::uint16_t before = control_.intcon2();
    control_.set_intcon2(merge_lanes(before, value, lanes) & static_cast<std::uint16_t>(~kDisi));
    for (int n = 0; n < 5; ++n) {  // the other edge counts from now on
      constexpr int kExternal[] = {irq::Int0, irq::Int1, irq::Int2, irq::Int3, irq::Int4};
      FlagListener* listener = listeners_.of(kExternal[n]);
      if (((before ^ control_.intcon2()) >> n & 1) && listener) listener->edge_chosen(kExternal[n], now);
    }
  } else if (address >= kIec0 && address < kIpc0) {
    const int shift = 8 * static_cast<int>(address - kIec0);
    const auto mask = static_cast<std::uint64_t>(lanes) << shift;
    sources_.enable((sources_.enabled_mask() & ~mask) |
                    ((static_cast<std::uint64_t>(value) << shift) & mask));
  } else if (address >= kIpc0 && address < kInttreg) {
    const int first = static_cast<int>(address - kIpc0) * 2;
    for (int f = 0; f < 4; ++f)
      if ((lanes >> 4 * f & 7) && first + f < kIrqs) sources_.set_priority(first + f, value >> 4 * f & 7);
  }
}

Cycle Interrupts::horizon(unsigned address, Cycle now) const {
  // flags: the chip adds the instants of the sources
  if (address == kIntcon2 && cpu_.disi_active(now)) return cpu_.disi_until();
  return kNever;
}

}  // namespace dspic
