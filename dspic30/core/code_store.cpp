// SPDX-License-Identifier: MIT
#include "dspic30/core/code_store.h"

#include <algorithm>
#include <new>

#include "dspic30/core/cpu.h"

namespace dspic {

namespace {

constexpr int kWarm = 16;         // jumps, in 256s, of a place that a later run had better translate
constexpr int kMostRefusals = 4;  // then a place is not asked for again: threads share the line it lies in

// no flash at that address
const Decoded* fetch_nothing(Cpu& cpu, const Decoded* d) {
  cpu.trap_at(cpu.address_of(d), TrapRecord::Access::Fetch);
  return d;
}

// where a routine begins that is known by heart
const Decoded* answer(Cpu& cpu, const Decoded* d) {
  if (const KnownRoutine* const routine = cpu.table().known_at(cpu.address_of(d)))
    if (const Decoded* const behind = recall(cpu, d, *routine)) return behind;
  return cpu.table().plain(d)(cpu, d);
}

// writes a register that this table's robots have not written
const Decoded* write_first(Cpu& cpu, const Decoded* d) {
  cpu.note_written(cpu.table().registers(d).gives);
  return function_of(cpu.program.read(cpu.address_of(d)))(cpu, d);
}

// False: it is there already.
bool add_in_order(std::vector<std::uint32_t>& addresses, std::uint32_t address) {
  const auto place = std::lower_bound(addresses.begin(), addresses.end(), address);
  if (place != addresses.end() && *place == address) return false;
  addresses.insert(place, address);
  return true;
}

template <class T>
T* zeroed() {
  void* const memory = std::calloc(kFlashWords + 1, sizeof(T));
  if (!memory) throw std::bad_alloc();
  return static_cast<T*>(memory);
}

}  // namespace

// where a function begins that the onlooker wants to know of
const Decoded* tell(Cpu& cpu, const Decoded* d) { return cpu.table().plain(hear(cpu, d))(cpu, d); }

const Decoded* hear(Cpu& cpu, const Decoded* d) {
  if (cpu.onlooker) cpu.onlooker->entered(cpu.address_of(d));
  return d;
}

// the course has not come there yet
const Decoded* meet(Cpu& cpu, const Decoded* d) {
  cpu.decode(d);
  return d->run.load(std::memory_order_acquire)(cpu, d);
}

Decoded& Decoded::operator=(const Decoded& o) {
  if (this == &o) return *this;
  imm = o.imm;
  writes = o.writes;
  pointers = o.pointers;
  mask = o.mask;
  s = o.s;
  d = o.d;
  b = o.b;
  cycles = o.cycles;
  lead = o.lead;
  psv = o.psv;
  s_pre = o.s_pre;
  s_post = o.s_post;
  d_pre = o.d_pre;
  d_post = o.d_post;
  s_kind = o.s_kind;
  d_kind = o.d_kind;
  heat.store(o.heat.load(std::memory_order_relaxed), std::memory_order_relaxed);
  run.store(o.run.load(std::memory_order_relaxed), std::memory_order_release);
  state.store(o.state.load(std::memory_order_relaxed), std::memory_order_release);
  return *this;
}

// --- one table

CodeTable::CodeTable(const CodeState& state, std::vector<std::uint32_t> told,
                     std::shared_ptr<const KnownCalls> known)
    : state_(state),
      known_(std::move(known)),
      told_(std::move(told)),
      words_(zeroed<Decoded>()),
      beside_(zeroed<Beside>()) {
  Decoded nowhere;
  nowhere.run = &fetch_nothing;
  nowhere.state = Decoded::Met;
  words_[kFlashWords] = nowhere;
  beside_[kFlashWords].plain = &fetch_nothing;
}

void CodeTable::decode(const Decoded* d, const ProgramMemory& program, std::uint8_t jumps) {
  const std::lock_guard lock(mutex_);
  if (is_decoded(d)) return;
  const std::size_t index = index_of(d);
  // the course may step to those behind it, over a skipped one of two words at most
  for (std::size_t i = index + 1; i <= std::min<std::size_t>(index + 3, kFlashWords); ++i)
    if (!words_[i].run.load(std::memory_order_relaxed)) words_[i].run.store(&meet, std::memory_order_release);
  Beside& beside = beside_[index];
  Decoded word = decode_word(program, static_cast<unsigned>(2 * index), state_, beside.registers);
  Run run = word.run;
  if (run != &illegal && (beside.registers.gives & ~state_.written)) run = &write_first;
  word.heat = jumps;
  beside.plain = run;
  const auto address = static_cast<std::uint32_t>(2 * index);
  const bool is_told = std::binary_search(told_.begin(), told_.end(), address);
  const bool is_fronted = is_told || known_at(address);
  beside.tells.store(is_fronted, std::memory_order_release);
  word.state = is_fronted ? Decoded::Fronted : Decoded::Met;
  word.run = is_told ? &tell : is_fronted ? &answer : run;
  words_[index] = word;
  decoded_.push_back(static_cast<std::uint32_t>(index));
}

// the state is stored before `run`: who sees the translation also sees that it is one
void CodeTable::warm(const Cpu& cpu, const Decoded* d, Translator& translator, int hot) {
  const std::uint8_t again = hot == 0 ? 1 : 0xFF;
  bool only_ready, is_warm = false;
  std::uint64_t marks;
  // One thread at a time translates a place. What runs seldom is only asked whether a translation lies ready.
  {
    const std::lock_guard lock(mutex_);
    d->heat.store(0, std::memory_order_relaxed);
    if (d->state.load(std::memory_order_relaxed) == Decoded::Fronted &&
        d->run.load(std::memory_order_relaxed) != &tell)
      return;
    Warmth& warmth = warmth_[d];
    if (warmth.is_busy) return;
    const int times = ++warmth.times;
    only_ready = times < hot;
    is_warm = only_ready && times == kWarm;
    if (only_ready && (times & (times - 1)) != 0) {  // asked 1, 2, 4, ... times on the way
      d->heat.store(again, std::memory_order_relaxed);
      return;
    }
    if (!only_ready) warmth.times = 0;
    warmth.is_busy = true;
    marks = marks_;
  }
  // Translating takes long, so others may use the table meanwhile.
  const Translation translation = translator.translate(cpu, d, only_ready);
  if (is_warm && !translation.run) translator.note_warm(cpu, d);
  const std::lock_guard lock(mutex_);
  Warmth& warmth = warmth_[d];
  warmth.is_busy = false;
  if (marks != marks_) {
    d->heat.store(again, std::memory_order_relaxed);
  } else if (translation.run) {
    d->state.store(Decoded::Fronted, std::memory_order_release);
    d->run.store(translation.run, std::memory_order_release);
    warmth.first = translation.first;
    warmth.last = translation.last;
    ++translated_;
  } else if (only_ready || hot == 0 || ++warmth.refusals < kMostRefusals) {
    d->heat.store(again, std::memory_order_relaxed);
  }
}

// a function that is put in front of it
void CodeTable::forget_translations_of(std::size_t index) {
  ++marks_;
  for (const auto& [head, warmth] : warmth_) {
    const std::ptrdiff_t place = &words_[index] - head;
    if (place < warmth.first || place > warmth.last) continue;
    const Beside& beside = beside_[index_of(head)];
    if (head->state.load(std::memory_order_relaxed) != Decoded::Fronted ||
        beside.wait.load(std::memory_order_relaxed))
      continue;
    const bool tells = beside.tells.load(std::memory_order_relaxed);
    head->run.store(tells ? &tell : beside.plain, std::memory_order_release);
    head->state.store(tells ? Decoded::Fronted : Decoded::Met, std::memory_order_release);
    head->heat.store(0xFF, std::memory_order_relaxed);
    --translated_;
  }
}

void CodeTable::mark_wait(const Decoded* d, Run stop) {
  const std::lock_guard lock(mutex_);
  const std::size_t index = index_of(d);
  if (beside_[index].wait.load(std::memory_order_relaxed)) return;
  forget_translations_of(index);
  beside_[index].wait.store(d->run.load(std::memory_order_relaxed), std::memory_order_release);
  d->state.store(Decoded::Fronted, std::memory_order_release);
  d->run.store(stop, std::memory_order_release);
}

void CodeTable::tell_also(std::uint32_t address) {
  const std::lock_guard lock(mutex_);
  if (!add_in_order(told_, address)) return;
  const std::size_t index = address / 2;
  const Decoded& word = words_[index];
  Beside& beside = beside_[index];
  if (!is_decoded(&word)) return;
  forget_translations_of(index);
  beside.tells.store(true, std::memory_order_release);
  if (beside.wait.load(std::memory_order_relaxed)) {
    beside.wait.store(&tell, std::memory_order_release);
  } else {
    word.state.store(Decoded::Fronted, std::memory_order_release);
    word.run.store(&tell, std::memory_order_release);
  }
}

int CodeTable::translated() const {
  const std::lock_guard lock(mutex_);
  return translated_;
}

void CodeTable::forget() {
  const std::lock_guard lock(mutex_);
  Decoded unmet;
  unmet.run = &meet;
  for (const std::uint32_t index : decoded_) {
    words_[index] = unmet;
    beside_[index].wait.store(nullptr, std::memory_order_relaxed);
  }
  decoded_.clear();
  warmth_.clear();
  translated_ = 0;
}

// --- all of an image

bool CodeStore::tell(const std::vector<std::uint32_t>& addresses) {
  const std::lock_guard lock(mutex_);
  if (std::includes(told_.begin(), told_.end(), addresses.begin(), addresses.end())) return true;
  if (!told_.empty()) return false;
  told_ = addresses;
  tables_.clear();
  return true;
}

void CodeStore::tell_also(std::uint32_t address) {
  const std::lock_guard lock(mutex_);
  if (!add_in_order(told_, address)) return;
  for (const auto& table : tables_) table->tell_also(address);
}

std::vector<std::uint32_t> CodeStore::told() const {
  const std::lock_guard lock(mutex_);
  return told_;
}

bool CodeStore::know(std::shared_ptr<const KnownCalls> calls) {
  const std::lock_guard lock(mutex_);
  if (known_ == calls) return true;
  if (is_told_known_) return false;
  is_told_known_ = true;
  known_ = std::move(calls);
  tables_.clear();
  return true;
}

std::shared_ptr<CodeTable> CodeStore::table(const CodeState& state, bool make) {
  const std::lock_guard lock(mutex_);
  for (const auto& table : tables_)
    if (table->state() == state) return table;
  if (!make) return nullptr;
  // what nobody runs on goes, but for the state that every reset begins with
  const auto is_idle = [](const auto& table) {
    return table.use_count() == 1 && !(table->state() == CodeState{});
  };
  if (tables_.size() >= kMost)
    tables_.erase(std::remove_if(tables_.begin(), tables_.end(), is_idle), tables_.end());
  return tables_.emplace_back(std::make_shared<CodeTable>(state, told_, known_));
}

std::shared_ptr<const KnownCalls> CodeStore::known() const {
  const std::lock_guard lock(mutex_);
  return known_;
}

void CodeStore::forget(bool is_other) {
  const std::lock_guard lock(mutex_);
  if (is_other) known_.reset();
  for (const auto& table : tables_) {
    if (is_other) table->forget_known();
    table->forget();
  }
}

}  // namespace dspic
