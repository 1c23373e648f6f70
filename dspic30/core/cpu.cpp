// SPDX-License-Identifier: MIT
#include "dspic30/core/cpu.h"

#include <algorithm>
#include <utility>

#include "dspic30/core/memory_check_each.h"
#include "dspic30/core/pointers.h"
#include "dspic30/core/waits.h"

namespace dspic {

namespace {

constexpr SfrBits kDl = sfr_field("CORCON", "DL"), kIpl = sfr_field("SR", "IPL");
constexpr std::uint16_t kSab = sfr_bits("SR", "SAB"), kSa = sfr_bits("SR", "SA"), kSb = sfr_bits("SR", "SB");
constexpr std::uint16_t kCorconAtReset = sfr_bits("CORCON", "SATDW");
constexpr int kLongestLook = 10000;  // instructions; most start-ups are over by then
constexpr int kDeepestDo = kDl.mask >> kDl.lowest;

// a wait is known to begin here
const Decoded* meet_head(Cpu& cpu, const Decoded* d) {
  if (!cpu.stops_at(d)) return cpu.table().beside_wait(d)(cpu, d);
  cpu.now -= d->cycles;
  return d;
}

}  // namespace

Cpu::Cpu(ChipParts& chip, ProgramMemory& memory, std::shared_ptr<CodeStore> store)
    : DataSpace(*this, chip, memory, std::move(store)) {
  reset();
}

// --- code

// while registers are still being written, it runs on the table for all of them, each instruction looked at
void Cpu::choose_code() {
  if (program.version() != code_version_) {
    code_version_ = program.version();
    window_words = nullptr;
    forget_code(true);
    forget_waits();
  }
  const auto [reads, writes] = special_registers(*this);
  const unsigned so_far = written & kAllWritten;
  const bool lasts = hot == 0 || looked_at_ >= kLongestLook;
  std::shared_ptr<CodeTable> table = store_->table({so_far, reads, writes}, lasts);
  looks_at_each_ = (!table && so_far != kAllWritten) || memory_check;
  if (memory_check) looked_at_ = 0;
  run_on(table ? table : store_->table({kAllWritten, reads, writes}, true));
}

void Cpu::run_on(std::shared_ptr<CodeTable> table) {
  const Decoded *const words = table->words(), *const before = code_;
  const auto moved = [&](const Decoded* d) { return address_of_host_place(d) ? d : words + (d - code_); };
  if (at) at = moved(at);
  next = next ? moved(next) : words;
  code_ = words;
  table_ = std::move(table);
  if (!address_of_host_place(next) && !is_decoded(next)) decode(next);
  find_loop_end();
  code_is_stale = false;
  if (words == before) return;
  known_waits.move(words);
  known_counts.move(words);
  heads.move(words, [this](const Decoded* head) {
    if (!is_decoded(head)) decode(head);
    table_->mark_wait(head, &meet_head);
  });
  if (waits && before) waits->move(before, words);
}

void Cpu::forget_waits() {
  known_waits.forget();
  known_counts.forget();
  heads.forget();
  if (waits) waits->forget(*this);
}

// an address in a register that was never written resets the chip
Run Cpu::looked_at(const Decoded* d, bool is_alone) {
  const bool is_of_host = address_of_host_place(d) != 0;
  if (!is_of_host && !is_decoded(d)) decode(d);
  if (memory_check) memory_check->begins(*this, d);
  if (is_of_host) return table_->plain(d);
  const WordRegisters& registers = table_->registers(d);
  if (registers.uses & ~written & kAllWritten) return &illegal;
  note_written(registers.gives);
  if (!table_->tells(d)) return table_->plain(d);
  if (is_alone && !memory_check) {  // what is translated goes on behind it
    if (!table_->known_at(address_of(d))) hear(*this, d);
    return table_->plain(d);
  }
  const Run beside =
      table_->beside_wait(d);  // whoever runs each instruction has seen that a wait begins here
  return beside ? beside : d->run.load(std::memory_order_acquire);
}

void Cpu::run_each() {
  if (memory_check && (written & kAllWritten) == kAllWritten) return run_checked();
  while (now < deadline) {
    const Decoded* const d = at = next;
    if (heads.has(d) && stops_at(d)) return;
    const Decoded* following = looked_at(d, false)(*this, d);
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
  forget_waits();
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
  const Run run = looks_at_each_ ? looked_at(d, true) : table_->plain(d);
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

}  // namespace dspic
