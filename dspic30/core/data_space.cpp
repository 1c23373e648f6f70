// SPDX-License-Identifier: MIT
#include "dspic30/core/data_space.h"

#include <string>
#include <utility>

#include "dspic30/core/cpu.h"
#include "dspic30/core/memory_check_each.h"
#include "dspic30/memory/hex.h"

namespace dspic {

namespace {

constexpr unsigned kTblpag = sfr("TBLPAG"), kPsvpag = sfr("PSVPAG"), kRcount = sfr("RCOUNT"),
                   kDisicnt = sfr("DISICNT"), kLast = kDisicnt;

}  // namespace

DataSpace::DataSpace(Cpu& cpu, ChipParts& chip, ProgramMemory& memory, std::shared_ptr<CodeStore> store)
    : CodeWords(memory, std::move(store)), parts(chip), registers_(cpu) {
  parts.bus.attach(registers_, 0, kLast);
  parts.bus.share();
}

const Cpu& DataSpace::whole() const { return static_cast<const Cpu&>(*this); }

// --- the stack

void DataSpace::check_stack(unsigned ea) {
  if (ea < kRamStart || ea > stack_most) trap(Trap::StackError);
}

void DataSpace::push_slowly(unsigned address) {
  push(address & 0xFFFF);
  push(address >> 16);
}

unsigned DataSpace::pop_slowly() {
  const unsigned high = pop() & 0x7F, low = pop();
  return high << 16 | (low & 0xFFFE);
}

/// Of the stack, `words` from `begin` on: are they plain RAM below the limit, and nobody notes it?
bool DataSpace::is_plain_frame(unsigned begin, unsigned words) const {
  const unsigned end = begin + 2 * words;
  return plain_bytes_ > 0 && !(begin & 1) && begin >= plain_start && end <= kRamEnd &&
         (!splim_on || end <= splim);
}

// how many of them are W0, W1, ... without a gap
static unsigned count_low(unsigned registers) { return static_cast<unsigned>(__builtin_ctz(~registers)); }

// registers from W0 up, then RCOUNT, PSVPAG, and others that are nobody's affair
void DataSpace::push_frame(unsigned registers, int words) {
  const auto other = [&](int i) { return i == 0 ? rcount : i == 1 ? psvpag : std::uint16_t{0}; };
  const auto count = static_cast<unsigned>(__builtin_popcount(registers) + words);
  if (!is_plain_frame(w[15], count)) {
    // a stack that is full ends it there
    const auto is_full = [&] { return parts.interrupts.control().has_trap(Trap::StackError); };
    for (unsigned left = registers; left != 0 && !is_full(); left &= left - 1) push(w[__builtin_ctz(left)]);
    for (int i = 0; i < words && !is_full(); ++i) push(other(i));
    return;
  }
  unsigned at_byte = w[15] - kRamStart;
  const unsigned low = count_low(registers);
  std::memcpy(&ram[at_byte], w.data(), 2 * low);
  at_byte += 2 * low;
  for (unsigned left = registers >> low << low; left != 0; left &= left - 1, at_byte += 2)
    store(at_byte, w[__builtin_ctz(left)]);
  for (int i = 0; i < words; ++i, at_byte += 2) store(at_byte, other(i));
  w[15] = static_cast<std::uint16_t>(at_byte + kRamStart);
}

void DataSpace::pop_frame(unsigned registers, int words) {
  const auto count = static_cast<unsigned>(__builtin_popcount(registers) + words);
  const unsigned begin = w[15] - 2 * count;
  const bool is_plain = is_plain_frame(begin, count);
  unsigned at_byte = w[15] - kRamStart;
  const auto next_word = [&] { return static_cast<std::uint16_t>(is_plain ? load(at_byte -= 2) : pop()); };
  for (int i = words; i-- > 0;) {
    const std::uint16_t word = next_word();
    if (i == 0) rcount = word & saved_register(kRcount).bits;
    if (i == 1 && psvpag != (word & saved_register(kPsvpag).bits)) {
      psvpag = word & saved_register(kPsvpag).bits;
      window_words = nullptr;
    }
  }
  const unsigned low = is_plain ? count_low(registers) : 0;
  for (unsigned left = registers >> low << low; left != 0;) {
    const unsigned highest = 31u - static_cast<unsigned>(__builtin_clz(left));
    w[highest] = next_word();
    left &= ~(1u << highest);
  }
  if (low > 0) std::memcpy(w.data(), &ram[at_byte - 2 * low], 2 * low);
  if (is_plain) w[15] = static_cast<std::uint16_t>(begin);
}

// --- traps

void DataSpace::trap(Trap which, std::optional<TrapRecord::Touch> touch) {
  settle();
  const int level = parts.interrupts.cpu().level(), own_level = trap_level(static_cast<int>(which));
  if (level < own_level && parts.interrupts.control().has_trap(which))
    return;                                               // of this instruction, or as it is entered
  if (which == Trap::StackError && level == own_level) {  // its handler works above the limit: the flag alone
    parts.interrupts.raise_trap(which, now);
    deadline = 0;
    return;
  }
  // beyond the limit and beyond RAM at once: the limit is what the program was to keep
  const bool follows = which == Trap::AddressError && parts.interrupts.control().has_trap(Trap::StackError) &&
                       latest_trap && latest_trap->pc == address_of(at);
  const TrapRecord record{which, address_of(at), now, touch};
  if (!follows) latest_trap = record;
  const char* name = vector_name(static_cast<int>(which));
  const std::string place = std::string(name) + " at " + hex(address_of(at), 6),
                    why = touch ? ": " + text_of(*touch) : "";
  parts.diagnostics.report(Cause::CpuTrap, place, place + why + ": the program goes on at the trap's vector",
                           now);
  parts.events.run_to(now);
  if (onlooker) onlooker->trapped(record);
  parts.interrupts.raise_trap(which, now);
  deadline = 0;
}

// --- data space beyond RAM

DataSpace::Saved DataSpace::saved_register(unsigned ea) {
  switch (ea) {
    case kTblpag:
      return {&CoreFields::tblpag, 0x00FF};
    case kPsvpag:
      return {&CoreFields::psvpag, 0x00FF};
    case kRcount:
      return {&CoreFields::rcount, 0x3FFF};
    default:
      return {};
  }
}

unsigned DataSpace::read_elsewhere(unsigned ea, unsigned bits) {
  if (is_checked(ea, bits)) {
    memory_check->reads(whole(), ea, bits);
    return bits == 16 ? load(ea - kRamStart) : ram[ea - kRamStart];
  }
  const Cycle t = true_now() + at->lead;
  if (!(ea & 1) && !watching && bits == 16) {
    if (parts.is_result(ea, bits, t)) return parts.read_result(ea, t);
    if (const std::uint16_t* const word = parts.idle_word(ea)) return *word;
  }
  return read_other(ea, bits, t);
}

unsigned DataSpace::read_served(unsigned ea, unsigned bits) {
  return read_served(ea, bits, true_now() + at->lead);
}

unsigned DataSpace::read_served(unsigned ea, unsigned bits, Cycle t) {
  const unsigned word = host->read(ea & ~1u, t);
  return bits == 16 ? word : word >> 8 * (ea & 1) & 0xFF;
}

// all but results of the converter
unsigned DataSpace::read_other(unsigned ea, unsigned bits, Cycle t) {
  if (bits == 16 && (ea & 1)) {
    trap_at(ea, TrapRecord::Access::Read, true);
    return 0;
  }
  if (is_served(ea)) {
    if (watching) note_look(host->horizon(ea & ~1u, t));
    return read_served(ea, bits, t);
  }
  if (ea - kRamStart < kRamBytes) {
    if (memory_check) memory_check->reads(whole(), ea, bits);
    if (watching) round_memory->note_read(ram.data(), ea - kRamStart);
    return bits == 16 ? load(ea - kRamStart) : ram[ea - kRamStart];
  }
  if (ea < kDisicnt) {
    reads_core = true;
    if (memory_check && ea < 2 * w.size()) memory_check->meets_null(whole(), ea, bits, false);
    if (const Saved saved = saved_register(ea); saved.word && bits == 16) return this->*saved.word;
    const unsigned word = registers_.peek(ea & ~1u, t);
    if (watching) watched_until = std::min(watched_until, registers_.horizon(ea & ~1u, t));
    return bits == 16 ? word : word >> 8 * (ea & 1) & 0xFF;
  }
  // what a peripheral's register says holds until its horizon
  if (ea < kSfrBytes) {
    const unsigned value = parts.read(ea, bits, t);
    if (!watching) return value;
    looks_outside = true;
    watched_until = ChipParts::is_changed_by_reading(ea) ? 0 : std::min(watched_until, parts.horizon(ea, t));
    return value;
  }
  if (ea >= kPsvStart && (corcon & kPsvOn)) return read_psv(ea, bits);
  trap_at(ea, TrapRecord::Access::Read);
  return 0;
}

unsigned DataSpace::read_psv(unsigned ea, unsigned bits) {
  if (window == Window::Free)
    window_was_free = true;
  else
    now += window == Window::Plain ? at->psv : kRepeatWindow;
  const unsigned address = static_cast<unsigned>(psvpag) << 15 | (ea & 0x7FFE);
  const bool is_eeprom = address - kEepromStart < 2 * kEepromWordCount;
  if (is_eeprom) note_effect();
  if (psvpag < kFlashPages) window_words = program.flash() + (static_cast<std::size_t>(psvpag) << 14);
  const unsigned word = (is_eeprom ? parts.nvm.table_read(address) : program.read(address)) & 0xFFFF;
  return bits == 16 ? word : word >> 8 * (ea & 1) & 0xFF;
}

void DataSpace::modify_elsewhere(unsigned ea, unsigned keep, unsigned flip, unsigned bits) {
  const unsigned word = ea & ~1u;
  const Cycle t = true_now() + at->lead;
  // flags and latches change in one step, so what the hardware sets meanwhile survives
  const bool are_flags = parts.are_flags(word, t);
  const bool is_converter = parts.is_converter(word);
  if ((!are_flags && !is_converter && !parts.is_latch(word)) || (bits == 16 && (ea & 1)))
    return write_elsewhere(ea, (read_elsewhere(ea, bits) & keep) ^ flip, bits);
  note_effect();
  const int shift = bits == 8 && (ea & 1) ? 8 : 0;
  const unsigned lanes = bits == 8 ? 0xFFu << shift : 0xFFFF;
  const auto kept = static_cast<std::uint16_t>(keep << shift | ~lanes),
             flipped = static_cast<std::uint16_t>(flip << shift & lanes);
  if (are_flags && flipped == 0 && parts.lower_flags(word, kept, t)) return;
  hurry_to(are_flags      ? parts.modify_flags(word, kept, flipped, t)
           : is_converter ? parts.modify_converter(kept, flipped, static_cast<std::uint16_t>(lanes), t)
                          : parts.modify_latch(word, kept, flipped, t));
}

void DataSpace::write_elsewhere(unsigned ea, unsigned value, unsigned bits) {
  if (is_checked(ea, bits)) {
    memory_check->writes(whole(), ea, bits);
    return bits == 16 ? store(ea - kRamStart, value)
                      : static_cast<void>(ram[ea - kRamStart] = static_cast<std::uint8_t>(value));
  }
  if (bits == 16 && parts.write_idle(ea, static_cast<std::uint16_t>(value))) {
    if (memory_check) memory_check->writes(whole(), ea, bits);
    return note_effect();
  }
  write_other(ea, value, bits);
}

// all but registers of a converter that is off
void DataSpace::write_other(unsigned ea, unsigned value, unsigned bits) {
  if (bits == 16 && (ea & 1)) return trap_at(ea, TrapRecord::Access::Write, true);
  if (const unsigned i = ea - kRamStart; is_served(ea)) {
    note_effect();
    const unsigned shift = bits == 8 && (ea & 1) ? 8 : 0;
    const Cycle t = true_now() + at->lead;
    parts.events.tell_change(t);
    host->write(ea & ~1u, static_cast<std::uint16_t>(value << shift),
                static_cast<std::uint16_t>(bits == 16 ? 0xFFFFu : 0xFFu << shift), t);
    return;
  } else if (i < kRamBytes) {
    if (memory_check) memory_check->writes(whole(), ea, bits);
    if (watching) round_memory->note_write(ram.data(), i, bits == 16);
    bits == 16 ? store(i, value) : static_cast<void>(ram[i] = static_cast<std::uint8_t>(value));
    return;
  }
  note_effect();
  // what handlers save and give back is the core's own affair
  if (ea < kDisicnt && bits == 16)
    if (const Saved saved = saved_register(ea); saved.word) {
      this->*saved.word = static_cast<std::uint16_t>(value & saved.bits);
      window_words = nullptr;
      return;
    }
  if (memory_check) memory_check->writes(whole(), ea, bits);
  const Cycle t = true_now() + at->lead;
  if (ea >= kSfrBytes) return trap_at(ea, TrapRecord::Access::Write);
  hurry_to(parts.write(ea, static_cast<std::uint16_t>(value), bits, t));
  if (parts.nvm.stalled_until() > t) {  // flash is being programmed
    now += parts.nvm.stalled_until() - t;
    deadline = 0;
  }
}

}  // namespace dspic
