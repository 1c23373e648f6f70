// SPDX-License-Identifier: MIT
#include "dspic30/core/cpu.h"

#include <algorithm>
#include <string>
#include <utility>

#include "dspic30/core/memory_check_each.h"
#include "dspic30/core/waits.h"
#include "dspic30/memory/hex.h"
#include "dspic30/memory/host_places.h"

namespace dspic {

namespace {

constexpr unsigned kSplim = sfr("SPLIM"), kAccal = sfr("ACCAL"), kAccbu = sfr("ACCBU"), kPcl = sfr("PCL"),
                   kPch = sfr("PCH"), kTblpag = sfr("TBLPAG"), kPsvpag = sfr("PSVPAG"),
                   kRcount = sfr("RCOUNT"), kDcount = sfr("DCOUNT"), kDostartl = sfr("DOSTARTL"),
                   kDostarth = sfr("DOSTARTH"), kDoendl = sfr("DOENDL"), kDoendh = sfr("DOENDH"),
                   kSr = sfr("SR"), kCorcon = sfr("CORCON"), kModcon = sfr("MODCON"),
                   kXmodsrt = sfr("XMODSRT"), kYmodend = sfr("YMODEND"), kXbrev = sfr("XBREV"),
                   kDisicnt = sfr("DISICNT"), kLast = kDisicnt;
constexpr SfrBits kDl = sfr_field("CORCON", "DL"), kXwm = sfr_field("MODCON", "XWM"),
                  kYwm = sfr_field("MODCON", "YWM"), kBwm = sfr_field("MODCON", "BWM"),
                  kXb = sfr_field("XBREV", "XB"), kIpl = sfr_field("SR", "IPL");
constexpr std::uint16_t kIpl3 = sfr_bits("CORCON", "IPL3"), kEdt = sfr_bits("CORCON", "EDT"),
                        kXmoden = sfr_bits("MODCON", "XMODEN"), kYmoden = sfr_bits("MODCON", "YMODEN"),
                        kBren = sfr_bits("XBREV", "BREN"), kCorconKept = 0xFFFF & ~(kIpl3 | kDl.mask | kEdt);
constexpr std::uint16_t kSab = sfr_bits("SR", "SAB"), kSa = sfr_bits("SR", "SA"), kSb = sfr_bits("SR", "SB");
constexpr std::uint16_t kCorconAtReset = sfr_bits("CORCON", "SATDW");
constexpr int kLongestLook = 10000;  // instructions; most start-ups are over by then
constexpr int kDeepestDo = kDl.mask >> kDl.lowest;
constexpr unsigned kNoPointer = 15;  // as XWM, YWM or BWM: none is chosen [DS70143 4.2.2]

// a wait is known to begin here
const Decoded* meet_head(Cpu& cpu, const Decoded* d) {
  if (!cpu.stops_at(d)) return cpu.table().beside_wait(d)(cpu, d);
  cpu.now -= d->cycles;
  return d;
}

void set_low(unsigned& address, unsigned value) { address = (address & 0x7F0000) | (value & 0xFFFE); }
void set_high(unsigned& address, unsigned value) { address = (address & 0xFFFF) | (value & 0x7F) << 16; }

}  // namespace

Cpu::Cpu(ChipParts& chip, ProgramMemory& memory, std::shared_ptr<CodeStore> store)
    : parts(chip), program(memory), store_(std::move(store)), code_version_(memory.version()) {
  parts.bus.attach(*this, 0, kLast);
  parts.bus.share();
  if (!store_) forget_code();
  reset();
}

// --- code

// `is_other`: flash was written
void Cpu::forget_code(bool is_other) {
  if (is_own_)
    store_->forget(is_other);
  else if (store_)
    have_own_store(store_->told(), is_other ? nullptr : store_->known());
  else
    have_own_store({});
  code_is_stale = true;
}

void Cpu::tell_calls(std::vector<std::uint32_t> addresses) {
  std::sort(addresses.begin(), addresses.end());
  if (!store_->tell(addresses)) have_own_store(addresses, store_->known());
  code_is_stale = true;
}

void Cpu::have_own_store(const std::vector<std::uint32_t>& told, std::shared_ptr<const KnownCalls> known) {
  store_ = std::make_shared<CodeStore>();
  store_->tell(told);
  if (known) store_->know(std::move(known));
  is_own_ = true;
}

// while registers are still being written, it runs on the table for all of them, each instruction looked at
void Cpu::choose_code() {
  if (program.version() != code_version_) {
    code_version_ = program.version();
    window_words = nullptr;
    forget_code(true);
  }
  const auto [reads, writes] = special_registers();
  const unsigned so_far = written & kAllWritten;
  const bool lasts = hot == 0 || looked_at_ >= kLongestLook;
  std::shared_ptr<CodeTable> table = store_->table({so_far, reads, writes}, lasts);
  looks_at_each_ = (!table && so_far != kAllWritten) || memory_check;
  if (memory_check) looked_at_ = 0;
  run_on(table ? table : store_->table({kAllWritten, reads, writes}, true));
}

void Cpu::run_on(std::shared_ptr<CodeTable> table) {
  const Decoded* const words = table->words();
  const auto moved = [&](const Decoded* d) { return address_of_host_place(d) ? d : words + (d - code_); };
  if (at) at = moved(at);
  next = next ? moved(next) : words;
  code_ = words;
  table_ = std::move(table);
  if (!address_of_host_place(next) && !is_decoded(next)) decode(next);
  known_waits.forget();
  known_counts.forget();
  heads.reset(words);
  find_loop_end();
  code_is_stale = false;
}

// an address in a register that was never written resets the chip
Run Cpu::looked_at(const Decoded* d) {
  const bool is_of_host = address_of_host_place(d) != 0;
  if (!is_of_host && !is_decoded(d)) decode(d);
  if (memory_check) memory_check->begins(*this, d);
  if (is_of_host) return table_->plain(d);
  const WordRegisters& registers = table_->registers(d);
  if (registers.uses & ~written & kAllWritten) return &illegal;
  note_written(registers.gives);
  if (!table_->tells(d)) return table_->plain(d);
  const Run beside =
      table_->beside_wait(d);  // whoever runs each instruction has seen that a wait begins here
  return beside ? beside : d->run.load(std::memory_order_acquire);
}

void Cpu::run_each() {
  if (memory_check && (written & kAllWritten) == kAllWritten) return run_checked();
  while (now < deadline) {
    const Decoded* const d = at = next;
    if (heads.has_any() && heads.has(d) && stops_at(d)) return;
    const Decoded* following = looked_at(d)(*this, d);
    now += d->cycles;
    if (d == loop_end) following = loop_back(d, following);
    next = following;
    if (address_of_host_place(d) || ++looked_at_ < kLongestLook)
      continue;  // a wait there has any number of steps
    code_is_stale = true;
    return;
  }
}

void Cpu::warm(const Decoded* target) {
  if (translator)
    table_->warm(*this, target, *translator, hot);
  else
    target->heat.store(0xFF, std::memory_order_relaxed);
}

void Cpu::reset() {
  w.fill(0);
  w[15] = kRamStart;
  n = 0;
  z = 1;
  c = ov = dc = 0;
  repeating = repeat_is_fresh = window_was_free = end_loop = splim_on = false;
  window = Window::Plain;
  power = Power::On;
  reset_due.reset();
  host_again = false;
  host_handlers = 0;
  host_stale = true;
  written = 0;
  stack_most = kNoLimit;
  window_words = nullptr;
  if (memory_check) memory_check->restart();
  splim = tblpag = psvpag = rcount = modcon = xbrev = 0;
  corcon = kCorconAtReset;
  modulo = {0, 1, 0, 1};
  loop = outer_loop = Loop{};
  loop_depth = 0;
  acc.fill(0);
  oa = ob = sa = sb = false;
  shadow = {};
  next = code_;
  deadline = 0;
  looked_at_ = 0;
  choose_code();
}

// --- flow

unsigned Cpu::address_of_any(const Decoded* d) const {
  if (const unsigned place = address_of_host_place(d)) return place;
  const auto index = static_cast<unsigned>(d - code_);
  return index < kFlashWords ? 2 * index : bad_address_;
}

const Decoded* Cpu::jump(unsigned address, const Decoded* /*from*/) {
  if (address < kFlashEnd) return arrive(code_ + address / 2);
  // nobody gets to a function there but by the linker's handle
  if (address == kHostHandlerReturn && host_handlers > 0) {
    host_again = false;
    return host_place(address);
  }
  bad_address_ = address;
  return code_ + kFlashWords;
}

bool Cpu::stops_at(const Decoded* head) {
  const bool passes = std::exchange(heads.passes, false);
  if (passes || watching || !heads.is_due(head, true_now()) || waits->passes(*this, head)) return false;
  heads.meet(deadline);
  deadline = 0;
  return true;
}

void Cpu::mark_head(const Decoded* first) {
  if (hot == 0) return;  // all shall be translated
  heads.add(first);
  table_->mark_wait(first, &meet_head);
}

const Decoded* Cpu::jump_back(unsigned address, const Decoded* from) {
  host_again = host && is_host_place(address) && address != kHostHandlerReturn;
  if (host_again) return host_place(address);
  if (address >= kFlashEnd) return jump(address, from);
  const Decoded* const target = code_ + address / 2;
  if (!is_decoded(target)) decode(target);
  now -= target->lead;
  return target;
}

void Cpu::check_stack(unsigned ea) {
  if (ea < kRamStart || ea > stack_most) trap(Trap::StackError);
}

void Cpu::push_slowly(unsigned address) {
  push(address & 0xFFFF);
  push(address >> 16);
}

unsigned Cpu::pop_slowly() {
  const unsigned high = pop() & 0x7F, low = pop();
  return high << 16 | (low & 0xFFFE);
}

void Cpu::trap(Trap which) {
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
  if (!follows) latest_trap = {which, address_of(at), w[15], splim_on ? splim : 0u, now};
  const char* name = vector_name(static_cast<int>(which));
  const std::string place = std::string(name) + " at " + hex(address_of(at), 6);
  parts.diagnostics.report(Cause::CpuTrap, place, place + ": the program goes on at the trap's vector", now);
  parts.events.run_to(now);
  if (onlooker) onlooker->trapped(which, address_of(at));
  parts.interrupts.raise_trap(which, now);
  deadline = 0;
}

void Cpu::tell_null_pointer(unsigned from) {
  if (onlooker) onlooker->went_to_reset_vector(from);
}

// --- loops

void Cpu::begin_do(unsigned count, const Decoded* first, const Decoded* last) {
  outer_loop = loop;
  const auto index = static_cast<unsigned>(last - code_);
  loop = {count, address_of(first), 2 * index & 0x7FFFFE};
  loop_depth = std::min(loop_depth + 1, kDeepestDo);
  find_loop_end();
}

void Cpu::find_loop_end() {
  loop_end = loop_depth > 0 && loop.end < kFlashEnd ? code_ + loop.end / 2 : nullptr;
}

const Decoded* Cpu::loop_back(const Decoded* last, const Decoded* following) {
  if (following != last + 1) return following;  // it left the loop
  if (loop.count > 0 && !end_loop) {
    --loop.count;
    const Decoded* first = jump(loop.start, last);
    if (last->writes & first->pointers) ++now;
    return first;
  }
  end_loop = false;
  if (--loop_depth > 0) loop = outer_loop;
  find_loop_end();
  return following;
}

// between two iterations an interrupt may come; RCOUNT then says how many follow the one that comes next
const Decoded* Cpu::run_repeated(const Decoded* d) {
  if (!is_decoded(d)) decode(d);
  at = d;
  const Run run = looks_at_each_ ? looked_at(d) : table_->plain(d);
  const bool only_passes_time = run == &no_operation;
  const Cycle began = now;
  const auto counted = [&] {
    if (only_passes_time) note_delay(began);
  };
  do {
    const bool is_last = rcount == 0;
    if (is_last) repeating = false;
    window = is_last || repeat_is_fresh ? Window::RepeatEdge : Window::Free;
    window_was_free = false;
    if (!repeat_is_fresh && (d->writes & d->pointers)) ++now;  // it stalls behind itself
    const Decoded* following = run(*this, d);
    window = Window::Plain;
    repeat_is_fresh = false;
    now += d->cycles;
    if (is_last || reset_due) {
      counted();
      return following;
    }
    if (rcount > 0) --rcount;
    if ((only_passes_time || is_idle_step(run, rcount)) && now < deadline) {  // as many at once as fit
      const Cycle many = std::min<Cycle>(rcount, deadline - now);
      now += many;
      rcount = static_cast<std::uint16_t>(rcount - many);
    }
  } while (now < deadline);
  counted();
  return d;
}

// --- status

unsigned Cpu::sr_low() const {
  return static_cast<unsigned>(flag_c()) | flag_z() << 1 | flag_ov() << 2 | flag_n() << 3 | repeating << 4 |
         (static_cast<unsigned>(parts.interrupts.cpu().level()) & 7) << 5;
}

unsigned Cpu::sr() const {
  return sr_low() | flag_dc() << 8 | (loop_depth > 0) << 9 | (sa || sb) << 10 | (oa || ob) << 11 | sb << 12 |
         sa << 13 | ob << 14 | static_cast<unsigned>(oa) << 15;
}

void Cpu::set_flags(unsigned bits) {
  c = bits & 1;
  z = bits & 2 ? 0 : 1;
  ov = bits & 4 ? 0x8000 : 0;
  n = bits & 8 ? 0x8000 : 0;
}

// the overflow bits are the engine's; saturation bits can only be cleared, both by SAB
void Cpu::set_sr(unsigned value, unsigned lanes) {
  if (lanes & 0xFF) {
    settle();
    set_flags(value);
    parts.interrupts.set_level(static_cast<int>(kIpl.of(value)) | (parts.interrupts.cpu().level() & 8), now);
    deadline = 0;
  }
  if (!(lanes & 0xFF00)) return;
  dc = value & 0x100;
  const bool both_stay = !(sa || sb) || (value & kSab);
  sa = sa && both_stay && (value & kSa);
  sb = sb && both_stay && (value & kSb);
}

// --- registers 0x000 to 0x052

std::uint16_t Cpu::peek(unsigned address, Cycle when) const {
  if (address < kSplim) return w[address / 2];
  if (address >= kAccal && address <= kAccbu) {
    const std::int64_t a = acc[(address - kAccal) / 6];
    return static_cast<std::uint16_t>(a >> 8 * ((address - kAccal) % 6));
  }
  if (address >= kXmodsrt && address <= kYmodend) return modulo[(address - kXmodsrt) / 2];
  const unsigned pc = address_of(next);
  switch (address) {
    case kSplim:
      return splim;
    case kPcl:
      return static_cast<std::uint16_t>(pc);
    case kPch:
      return static_cast<std::uint16_t>(pc >> 16);
    case kTblpag:
      return tblpag;
    case kPsvpag:
      return psvpag;
    case kRcount:
      return rcount;
    case kDcount:
      return static_cast<std::uint16_t>(loop.count);
    case kDostartl:
      return static_cast<std::uint16_t>(loop.start);
    case kDostarth:
      return static_cast<std::uint16_t>(loop.start >> 16);
    case kDoendl:
      return static_cast<std::uint16_t>(loop.end);
    case kDoendh:
      return static_cast<std::uint16_t>(loop.end >> 16);
    case kSr:
      return static_cast<std::uint16_t>(sr());
    case kCorcon:
      return static_cast<std::uint16_t>(corcon | (parts.interrupts.cpu().level() > 7 ? kIpl3 : 0) |
                                        loop_depth << kDl.lowest);
    case kModcon:
      return modcon;
    case kXbrev:
      return xbrev;
    case kDisicnt:
      return static_cast<std::uint16_t>(
          std::clamp<Cycle>(parts.interrupts.cpu().disi_until() - when, 0, kMostDisi));
    default:
      return 0;
  }
}

Cycle Cpu::horizon(unsigned address, Cycle when) const {
  return address == kDisicnt && parts.interrupts.cpu().disi_active(when) ? when + 1 : kNever;
}

void Cpu::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle when) {
  const std::uint16_t wanted = merge_lanes(peek(address, when), value, lanes);
  if (address < kSplim) {
    w[address / 2] = address == 0x1E ? wanted & 0xFFFE : wanted;
    if (lanes == 0xFFFF) note_written(1u << address / 2);
    return;
  }
  if (address >= kAccal && address <= kAccbu) {
    std::int64_t& a = acc[(address - kAccal) / 6];
    const unsigned shift = 8 * ((address - kAccal) % 6);
    const std::uint64_t mask = std::uint64_t{shift == 32 ? 0xFFu : 0xFFFFu} << shift;
    const std::uint64_t bits =
        (static_cast<std::uint64_t>(a) & ~mask) | ((std::uint64_t{wanted} << shift) & mask);
    a = static_cast<std::int64_t>(bits << 24) >> 24;
    return;
  }
  switch (address) {
    case kSplim:
      splim = wanted;
      splim_on |= lanes == 0xFFFF;
      if (splim_on) stack_most = splim;
      break;
    case kTblpag:
      tblpag = wanted;
      break;
    case kPsvpag:
      psvpag = wanted;
      window_words = nullptr;
      break;
    case kRcount:
      rcount = wanted;
      break;
    case kDcount:
      loop.count = wanted;
      break;
    case kDostartl:
      set_low(loop.start, wanted);
      break;
    case kDostarth:
      set_high(loop.start, wanted);
      break;
    case kDoendl:
      set_low(loop.end, wanted);
      find_loop_end();
      break;
    case kDoendh:
      set_high(loop.end, wanted);
      find_loop_end();
      break;
    case kSr:
      set_sr(value, lanes);
      break;
    case kCorcon:
      corcon = wanted & kCorconKept;
      window_words = nullptr;
      if ((lanes & kIpl3) && !(value & kIpl3) && parts.interrupts.cpu().level() > 7)
        parts.interrupts.set_level(parts.interrupts.cpu().level() & 7, when);
      end_loop |= (value & kEdt) && loop_depth > 0;
      deadline = 0;
      break;
    case kDisicnt:
      parts.interrupts.disi(wanted, when);
      deadline = 0;
      break;
    default: {
      if (address == kPcl || address == kPch) break;
      // the modulo and bit-reversed pointers decide which table the code runs on
      const auto special = special_registers();
      if (address == kModcon) modcon = wanted;
      if (address == kXbrev) xbrev = wanted;
      if (address >= kXmodsrt && address <= kYmodend)
        modulo[(address - kXmodsrt) / 2] = address & 2 ? wanted | 1 : wanted & 0xFFFE;
      if (special == special_registers()) break;
      code_is_stale = true;
      deadline = 0;
    }
  }
}

// --- pointers

std::array<std::uint32_t, 2> Cpu::special_registers() const {
  const auto chosen = [](unsigned n) { return n == kNoPointer ? 0u : 1u << n; };
  const std::uint32_t read = modcon & kXmoden ? chosen(kXwm.of(modcon)) : 0;
  return {read, read | (xbrev & kBren ? chosen(kBwm.of(modcon)) : 0)};
}

unsigned Cpu::stepped(unsigned reg, unsigned value, int step, bool y_space) const {
  const unsigned moved = (value + static_cast<unsigned>(step)) & 0xFFFF;
  const bool on =
      y_space ? (modcon & kYmoden) && kYwm.of(modcon) == reg : (modcon & kXmoden) && kXwm.of(modcon) == reg;
  if (!on || reg == kNoPointer) return moved;
  const int start = modulo[y_space ? 2 : 0], end = modulo[y_space ? 3 : 1], length = end - start + 1;
  const int place = static_cast<int>(value) + step;
  if (place > end && step > 0) return static_cast<unsigned>(place - length) & 0xFFFF;
  if (place < start && step < 0) return static_cast<unsigned>(place + length) & 0xFFFF;
  return moved;
}

// XB is added from the highest bit down, to words
static unsigned reversed_step(unsigned value, unsigned xb) {
  unsigned sum = value >> 1, carry = xb & kXb.mask;
  while (carry) {
    const unsigned both = sum & carry;
    sum ^= carry;
    carry = both >> 1;
  }
  return (sum << 1 | (value & 1)) & 0xFFFF;
}

unsigned Cpu::special_pointer(unsigned reg, int pre, int post, bool is_write) {
  const bool reversed = is_write && (xbrev & kBren) && kBwm.of(modcon) == reg;
  const auto step = [&](unsigned value, int by) {
    if (reversed && by == 2) return reversed_step(value, xbrev);
    return by ? stepped(reg, value, by, false) : value;
  };
  const unsigned ea = step(w[reg], pre);
  w[reg] = static_cast<std::uint16_t>(step(ea, post));
  return ea;
}

// --- data space beyond RAM

Cpu::Saved Cpu::saved_register(unsigned ea) {
  switch (ea) {
    case kTblpag:
      return {&Cpu::tblpag, 0x00FF};
    case kPsvpag:
      return {&Cpu::psvpag, 0x00FF};
    case kRcount:
      return {&Cpu::rcount, 0x3FFF};
    default:
      return {};
  }
}

unsigned Cpu::read_elsewhere(unsigned ea, unsigned bits) {
  if (is_checked(ea, bits)) {
    memory_check->reads(*this, ea, bits);
    return bits == 16 ? load(ea - kRamStart) : ram[ea - kRamStart];
  }
  const Cycle t = true_now() + at->lead;
  if (!(ea & 1) && !watching && parts.is_result(ea, bits, t)) return parts.read_result(ea, t);
  return read_other(ea, bits, t);
}

unsigned Cpu::read_served(unsigned ea, unsigned bits) { return read_served(ea, bits, true_now() + at->lead); }

unsigned Cpu::read_served(unsigned ea, unsigned bits, Cycle t) {
  const unsigned word = host->read(ea & ~1u, t);
  return bits == 16 ? word : word >> 8 * (ea & 1) & 0xFF;
}

// all but results of the converter
unsigned Cpu::read_other(unsigned ea, unsigned bits, Cycle t) {
  if (bits == 16 && (ea & 1)) {
    trap(Trap::AddressError);
    return 0;
  }
  if (is_served(ea)) {
    if (watching) note_look(host->horizon(ea & ~1u, t));
    return read_served(ea, bits, t);
  }
  if (ea - kRamStart < kRamBytes) {
    if (memory_check) memory_check->reads(*this, ea, bits);
    if (watching) round_memory->note_read(ram.data(), ea - kRamStart);
    return bits == 16 ? load(ea - kRamStart) : ram[ea - kRamStart];
  }
  if (ea < kDisicnt) {
    reads_core = true;
    if (memory_check && ea < 2 * w.size()) memory_check->meets_null(*this, ea, bits, false);
    if (const Saved saved = saved_register(ea); saved.word && bits == 16) return this->*saved.word;
    const unsigned word = peek(ea & ~1u, t);
    if (watching) watched_until = std::min(watched_until, horizon(ea & ~1u, t));
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
  trap(Trap::AddressError);
  return 0;
}

unsigned Cpu::read_psv(unsigned ea, unsigned bits) {
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

void Cpu::modify_elsewhere(unsigned ea, unsigned keep, unsigned flip, unsigned bits) {
  const unsigned word = ea & ~1u;
  const Cycle t = true_now() + at->lead;
  // flags and latches change in one step, so what the hardware sets meanwhile survives
  const bool are_flags = parts.are_flags(word, t);
  if ((!are_flags && !parts.is_latch(word)) || (bits == 16 && (ea & 1)))
    return write_elsewhere(ea, (read_elsewhere(ea, bits) & keep) ^ flip, bits);
  note_effect();
  const int shift = bits == 8 && (ea & 1) ? 8 : 0;
  const unsigned lanes = bits == 8 ? 0xFFu << shift : 0xFFFF;
  const auto kept = static_cast<std::uint16_t>(keep << shift | ~lanes),
             flipped = static_cast<std::uint16_t>(flip << shift & lanes);
  if (are_flags && flipped == 0 && parts.lower_flags(word, kept, t)) return;
  hurry_to(are_flags ? parts.modify_flags(word, kept, flipped, t)
                     : parts.modify_latch(word, kept, flipped, t));
}

void Cpu::write_elsewhere(unsigned ea, unsigned value, unsigned bits) {
  if (is_checked(ea, bits)) {
    memory_check->writes(*this, ea, bits);
    return bits == 16 ? store(ea - kRamStart, value)
                      : static_cast<void>(ram[ea - kRamStart] = static_cast<std::uint8_t>(value));
  }
  if (bits == 16 && (ea & 1)) return trap(Trap::AddressError);
  if (const unsigned i = ea - kRamStart; is_served(ea)) {
    note_effect();
    const unsigned shift = bits == 8 && (ea & 1) ? 8 : 0;
    const Cycle t = true_now() + at->lead;
    parts.events.tell_change(t);
    host->write(ea & ~1u, static_cast<std::uint16_t>(value << shift),
                static_cast<std::uint16_t>(bits == 16 ? 0xFFFFu : 0xFFu << shift), t);
    return;
  } else if (i < kRamBytes) {
    if (memory_check) memory_check->writes(*this, ea, bits);
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
  if (memory_check) memory_check->writes(*this, ea, bits);
  const Cycle t = true_now() + at->lead;
  if (ea >= kSfrBytes) return trap(Trap::AddressError);
  hurry_to(parts.write(ea, static_cast<std::uint16_t>(value), bits, t));
  if (parts.nvm.stalled_until() > t) {  // flash is being programmed
    now += parts.nvm.stalled_until() - t;
    deadline = 0;
  }
}

}  // namespace dspic
