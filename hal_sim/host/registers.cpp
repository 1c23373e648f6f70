// SPDX-License-Identifier: MIT
#include "hal_sim/host/registers.h"

#include <algorithm>
#include <string>

#include "dspic30/memory/sfr_table.h"
#include "hal_sim/board/board.h"
#include "hal_sim/host/compiled_runner.h"
#include "hal_sim/host/native_processor.h"
#include "hal_sim/host/pins.h"

namespace host {

namespace {

using dspic::sfr;

constexpr unsigned kSr = sfr("SR"), kDisicnt = sfr("DISICNT"), kIntcon1 = sfr("INTCON1"),
                   kIntcon2 = sfr("INTCON2"), kIfs0 = sfr("IFS0"), kIec0 = sfr("IEC0"), kIpc0 = sfr("IPC0"),
                   kI2ccon = sfr("I2CCON"), kRcon = sfr("RCON");
constexpr std::uint16_t kPor = 1 << 0, kBor = 1 << 1, kSwr = 1 << 6, kExtr = 1 << 7, kBgst = 1 << 13;

// timer 1 stands alone; 2 and 3, 4 and 5 are laid out as pairs
struct TimerRegisters {
  unsigned tmr, pr, con;
  int vector;
};
constexpr TimerRegisters kTimers[5] = {{sfr("TMR1"), sfr("PR1"), sfr("T1CON"), TP_V_T1},
                                       {sfr("TMR2"), sfr("PR2"), sfr("T2CON"), TP_V_T2},
                                       {sfr("TMR3"), sfr("PR3"), sfr("T3CON"), TP_V_T3},
                                       {sfr("TMR4"), sfr("PR4"), sfr("T4CON"), TP_V_T4},
                                       {sfr("TMR5"), sfr("PR5"), sfr("T5CON"), TP_V_T5}};

struct PortBlock {
  unsigned tris;
  char letter;
};
constexpr PortBlock kPorts[] = {{sfr("TRISA"), 'A'}, {sfr("TRISB"), 'B'}, {sfr("TRISC"), 'C'},
                                {sfr("TRISD"), 'D'}, {sfr("TRISF"), 'F'}, {sfr("TRISG"), 'G'}};

constexpr const char* kOtherWay =
    "the native way, in which the library's functions drive the hardware, has no model of this register; "
    "run the program without --way native";

// registers that hold what was written and do nothing else here
constexpr unsigned kKept[] = {sfr("TBLPAG"), sfr("PSVPAG"), sfr("CORCON"), sfr("CNEN1"),
                              sfr("CNEN2"),  sfr("CNPU1"),  sfr("CNPU2"),  sfr("ADPCFG"),
                              sfr("OSCTUN"), sfr("PMD1"),   sfr("PMD2")};

const char* register_name(unsigned address) {
  const dspic::SfrInfo* info = dspic::sfr_info(address);
  return info ? info->name : "?";
}

bool is_port(unsigned address, char& letter, board::Board::Register& kind) {
  for (const auto& block : kPorts) {
    if (address < block.tris || address >= block.tris + 6) continue;
    letter = block.letter;
    kind = static_cast<board::Board::Register>((address - block.tris) / 2);
    return true;
  }
  return false;
}

}  // namespace

void NativeRegisters::power_up() {
  processor_reset();
  rcon_ = kPor | kBor;
}

void NativeRegisters::processor_reset() {
  timers_.fill({});
  intcon1_ = intcon2_ = 0;
  kept_.clear();
  runner_.board().processor_reset(runner_.settled_now());
}

void NativeRegisters::note_software_reset() { rcon_ |= kSwr; }
void NativeRegisters::note_reset_button() { rcon_ |= kExtr; }

void NativeRegisters::processor_stopped() { runner_.board().processor_reset(runner_.now()); }

void NativeRegisters::refuse(unsigned address, const char* what) const {
  runner_.last_words() = std::string(register_name(address)) + ": " + what;
  runner_.trap(TP_TRAP_UNSIMULATED, runner_.last_words());
}

void NativeRegisters::refuse_table() const {
  runner_.trap(TP_TRAP_UNSIMULATED,
               "table instructions (__builtin_tblrdl ...) need the chip: run without --way native");
}

// --- timers

Cycle NativeRegisters::prescale(const Timer& t) const {
  constexpr Cycle kDivide[] = {1, 8, 64, 256};
  return kDivide[t.con >> 4 & 3];
}

std::uint16_t NativeRegisters::count_at(const Timer& t, Cycle at) const {
  if (!runs(t)) return t.count;
  const Cycle ticks = (at - t.since) / prescale(t);
  // up to the match (or the 16-bit end when the count is already beyond it), then round and round
  const Cycle first = t.count <= t.pr ? Cycle{t.pr} + 1 - t.count : Cycle{0x10000} - t.count;
  if (ticks < first) return static_cast<std::uint16_t>(t.count + ticks);
  return static_cast<std::uint16_t>((ticks - first) % (Cycle{t.pr} + 1));
}

void NativeRegisters::settle(Timer& t, Cycle at) {
  t.count = count_at(t, at);
  if (runs(t)) at -= (at - t.since) % prescale(t);  // the prescaler keeps its phase
  t.since = at;
}

void NativeRegisters::schedule(int number) {
  Timer& t = timers_[static_cast<std::size_t>(number)];
  auto& source = processor_.interrupts().source(kTimers[number].vector);
  if (!runs(t)) {
    source.due = kNever;
    source.period = 0;
  } else {
    const Cycle ticks = t.count <= t.pr ? Cycle{t.pr} + 1 - t.count : Cycle{0x10000} - t.count + t.pr + 1;
    source.due = t.since + ticks * prescale(t);
    source.period = (Cycle{t.pr} + 1) * prescale(t);
  }
  runner_.changed();
}

NativeRegisters::Timer* NativeRegisters::timer_at(unsigned address, int& which) {
  for (int n = 0; n < 5; ++n) {
    const auto& r = kTimers[n];
    if (address != r.tmr && address != r.pr && address != r.con) continue;
    which = n;
    return &timers_[static_cast<std::size_t>(n)];
  }
  return nullptr;
}

// --- words

std::uint16_t NativeRegisters::read_word(unsigned address) {
  auto& interrupts = processor_.interrupts();
  const Cycle now = runner_.now();
  char letter;
  board::Board::Register kind;
  if (is_port(address, letter, kind)) {
    runner_.lower_horizon(runner_.board().port_horizon(letter, now));
    return runner_.board().port_read(letter, kind, now);
  }
  int n;
  if (const Timer* t = timer_at(address, n)) {
    if (address == kTimers[n].pr) return t->pr;
    if (address == kTimers[n].con) return t->con;
    runner_.lower_horizon(runs(*t) ? now + prescale(*t) - (now - t->since) % prescale(*t) : kNever);
    return count_at(*t, now);
  }
  if (address >= kIfs0 && address < kIfs0 + 6) {
    interrupts.raise_due(now);
    std::uint16_t word = 0;
    for (int v = static_cast<int>(address - kIfs0) * 8, bit = 0; bit < 16 && v + bit < TP_VECTORS; ++bit) {
      word |= static_cast<std::uint16_t>(interrupts.source(v + bit).flag << bit);
      runner_.lower_horizon(interrupts.source(v + bit).due);
    }
    return word;
  }
  if (address >= kIec0 && address < kIec0 + 6) {
    std::uint16_t word = 0;
    for (int v = static_cast<int>(address - kIec0) * 8, bit = 0; bit < 16 && v + bit < TP_VECTORS; ++bit)
      word |= static_cast<std::uint16_t>(interrupts.source(v + bit).enabled << bit);
    return word;
  }
  if (address >= kIpc0 && address < kIpc0 + 22) {
    std::uint16_t word = 0;
    for (int v = static_cast<int>(address - kIpc0) * 2, field = 0; field < 4 && v + field < TP_VECTORS;
         ++field)
      word |= static_cast<std::uint16_t>(interrupts.source(v + field).priority << (4 * field));
    return word;
  }
  switch (address) {
    case kSr:
      return static_cast<std::uint16_t>(std::min(processor_.cpu_level(), 7) << 5);
    case kIntcon1:
      return intcon1_;
    case kIntcon2:
      return static_cast<std::uint16_t>(intcon2_ | (processor_.disi_active(now) ? 1 << 14 : 0));
    case kDisicnt:
      return processor_.disi_active(now) ? 1 : 0;
    case kRcon:
      return rcon_ | kBgst;  // long stable when a program looks
    case kI2ccon:            // of a bus that the library drives: is it on
      return runner_.drivers().i2c_master().is_on() ? 0x9000 : 0x1000;
    default:
      break;
  }
  if (std::find(std::begin(kKept), std::end(kKept), address) != std::end(kKept)) return kept_[address];
  refuse(address, kOtherWay);
}

void NativeRegisters::write_word(unsigned address, std::uint16_t value) {
  auto& interrupts = processor_.interrupts();
  const Cycle now = runner_.now();
  runner_.note_write();
  char letter;
  board::Board::Register kind;
  if (is_port(address, letter, kind)) return runner_.board().port_write(letter, kind, value, now);
  int n;
  if (Timer* t = timer_at(address, n)) {
    settle(*t, now);
    if (address == kTimers[n].pr) {
      t->pr = value;
    } else if (address == kTimers[n].con) {
      if (value & 0x0002)
        refuse(address, "an external timer clock (TCS) needs the chip: run without --way native");
      if (value & 0x0040)
        refuse(address, "gated timer mode (TGATE) needs the chip: run without --way native");
      if ((value & 0x0008) && n > 0)
        refuse(address, "32-bit timer mode (T32) needs the chip: run without --way native");
      t->con = value;
    } else {
      t->count = value;
      t->since = now;
    }
    return schedule(n);
  }
  if (address >= kIfs0 && address < kIfs0 + 6) {
    interrupts.raise_due(now);
    for (int v = static_cast<int>(address - kIfs0) * 8, bit = 0; bit < 16 && v + bit < TP_VECTORS; ++bit) {
      auto& s = interrupts.source(v + bit);
      const bool flag = (value >> bit & 1) != 0;
      if (flag && !s.flag) s.flag_since = now;
      s.flag = flag;
    }
    return runner_.changed();
  }
  if (address >= kIec0 && address < kIec0 + 6) {
    for (int v = static_cast<int>(address - kIec0) * 8, bit = 0; bit < 16 && v + bit < TP_VECTORS; ++bit)
      interrupts.source(v + bit).enabled = (value >> bit & 1) != 0;
    return runner_.changed();
  }
  if (address >= kIpc0 && address < kIpc0 + 22) {
    for (int v = static_cast<int>(address - kIpc0) * 2, field = 0; field < 4 && v + field < TP_VECTORS;
         ++field)
      interrupts.source(v + field).priority = value >> (4 * field) & 7;
    return runner_.changed();
  }
  switch (address) {
    case kSr:
      processor_.set_cpu_level(value >> 5 & 7, now);
      return runner_.changed();
    case kIntcon1:
      intcon1_ = value;
      return;
    case kIntcon2:
      intcon2_ = value & 0x801F;
      processor_.int0_polarity_changed(now);
      return runner_.changed();
    case kDisicnt:
      return runner_.on_disi(value & 0x3FFF);
    case kRcon:
      rcon_ = value;
      return;
    case kI2ccon:  // switching off, so that an extension can be the bus's master, is all a program may do
                   // itself
      if (value & 0x803F) refuse(address, "the I2C bus can be used through the library's functions only");
      return runner_.drivers().i2c_master().switch_off(now);
    default:
      break;
  }
  if (std::find(std::begin(kKept), std::end(kKept), address) != std::end(kKept)) {
    kept_[address] = value;
    return;
  }
  refuse(address, kOtherWay);
}

std::uint16_t NativeRegisters::read(unsigned address, unsigned bits) {
  const std::uint16_t word = read_word(address & ~1u);
  if (bits > 8) return word;
  return (address & 1) ? word >> 8 : word & 0xFF;
}

void NativeRegisters::write(unsigned address, std::uint16_t value, unsigned bits) {
  if (bits > 8) return write_word(address & ~1u, value);
  const std::uint16_t word = read_word(address & ~1u);
  const std::uint16_t merged = (address & 1)
                                   ? static_cast<std::uint16_t>((word & 0x00FF) | (value & 0xFF) << 8)
                                   : static_cast<std::uint16_t>((word & 0xFF00) | (value & 0xFF));
  write_word(address & ~1u, merged);
}

}  // namespace host
