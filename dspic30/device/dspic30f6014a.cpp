// SPDX-License-Identifier: MIT
#include "dspic30/device/dspic30f6014a.h"

#include <algorithm>

#include "dspic30/device/chip_parts.h"

namespace dspic {

namespace {

constexpr unsigned kFirstOc = sfr("OC1RS"), kFirstIc = sfr("IC1BUF");

constexpr int module_bit(const char* name) { return sfr_field("PMD1", name).lowest; }
static_assert(sfr_field("PMD2", "OC1MD").lowest == 0 && sfr_field("PMD2", "IC1MD").lowest == 8);

}  // namespace

// A module that is switched off forgets everything and answers 0.
void ChipParts::switch_modules(std::uint16_t next1, std::uint16_t next2, Cycle now) {
  // Each module with its registers, of the first control register.
  const auto turned = [&](std::uint16_t before, std::uint16_t next, int bit) {
    return ((before ^ next) >> bit & 1) != 0;
  };
  const auto range = [&](std::uint16_t next, int bit, unsigned first, unsigned last) {
    bus.set_disabled(first, last, (next >> bit & 1) != 0);
  };
  struct Module {
    int bit;
    unsigned first, last;
  };
  static constexpr Module kModules[] = {{module_bit("ADCMD"), sfr("ADCBUF0"), sfr("ADCHS")},
                                        {module_bit("ADCMD"), sfr("ADCSSL"), sfr("ADCSSL")},
                                        {module_bit("C1MD"), sfr("C1RXF0SID"), sfr("C1EC")},
                                        {module_bit("C2MD"), sfr("C2RXF0SID"), sfr("C2EC")},
                                        {module_bit("SPI1MD"), sfr("SPI1STAT"), sfr("SPI1BUF")},
                                        {module_bit("SPI2MD"), sfr("SPI2STAT"), sfr("SPI2BUF")},
                                        {module_bit("U1MD"), sfr("U1MODE"), sfr("U1BRG")},
                                        {module_bit("U2MD"), sfr("U2MODE"), sfr("U2BRG")},
                                        {module_bit("I2CMD"), sfr("I2CRCV"), sfr("I2CADD")},
                                        {module_bit("DCIMD"), sfr("DCICON1"), sfr("TXBUF3")},
                                        {module_bit("T1MD"), sfr("TMR1"), sfr("T1CON")},
                                        {module_bit("T2MD"), sfr("TMR2"), sfr("TMR2")},
                                        {module_bit("T2MD"), sfr("PR2"), sfr("PR2")},
                                        {module_bit("T2MD"), sfr("T2CON"), sfr("T2CON")},
                                        {module_bit("T3MD"), sfr("TMR3HLD"), sfr("TMR3")},
                                        {module_bit("T3MD"), sfr("PR3"), sfr("PR3")},
                                        {module_bit("T3MD"), sfr("T3CON"), sfr("T3CON")},
                                        {module_bit("T4MD"), sfr("TMR4"), sfr("TMR4")},
                                        {module_bit("T4MD"), sfr("PR4"), sfr("PR4")},
                                        {module_bit("T4MD"), sfr("T4CON"), sfr("T4CON")},
                                        {module_bit("T5MD"), sfr("TMR5HLD"), sfr("TMR5")},
                                        {module_bit("T5MD"), sfr("PR5"), sfr("PR5")},
                                        {module_bit("T5MD"), sfr("T5CON"), sfr("T5CON")}};
  for (const Module& m : kModules)
    if (turned(pmd1, next1, m.bit)) {
      // what a module does must end before its registers fall silent
      for (unsigned a = m.first; a <= m.last; a += 2)
        if (const SfrInfo* info = sfr_info(a); info && (next1 >> m.bit & 1))
          bus.write(a, info->reset, 16, now);
      range(next1, m.bit, m.first, m.last);
    }
  // The second one has the units of input capture and output compare.
  for (int bit = 0; bit < 16; ++bit) {
    if (!turned(pmd2, next2, bit)) continue;
    const auto n = static_cast<unsigned>(bit & 7);
    const unsigned first = bit < 8 ? kFirstOc + 6 * n : kFirstIc + 4 * n;
    const unsigned last = bit < 8 ? first + 4 : first + 2;
    if (next2 >> bit & 1) bus.write(last, 0, 16, now);
    range(next2, bit, first, last);
  }
  pmd1 = next1;
  pmd2 = next2;
}

Dspic30f6014a::Dspic30f6014a(Outside& outside, DiagnosticSink* sink, const Configuration& configuration)
    : parts_(std::make_unique<ChipParts>(outside, sink, configuration)), interrupts_(*parts_) {
  reset(ResetKind::PowerOn, 0);
}

Dspic30f6014a::~Dspic30f6014a() = default;

void Dspic30f6014a::reset(ResetKind kind, Cycle now) {
  ChipParts& p = *parts_;
  p.events.run_to(now);
  if (kind == ResetKind::PowerOn) p.bus.forget_writes();
  p.switch_modules(0, 0, now);
  p.timers.reset(now);  // which counts what was missed while its interrupts are still enabled
  p.interrupts.reset(now);
  p.ports.reset(now);
  p.adc.reset(now);
  for (Uart& u : p.uarts) u.reset(now);
  p.i2c.reset(now);
  p.dci.reset(now);
  p.external.reset(now);
  p.change.reset(now);
  p.capture.reset(now);
  p.compare.reset(now);
  for (Spi& s : p.spis) s.reset(now);
  p.nvm.reset(now);
  for (Can& c : p.cans) c.reset();
  p.cpu.reset();
  p.plain.reset();
  p.system.reset(kind, now);
}

// --- registers

std::uint16_t Dspic30f6014a::read(unsigned address, unsigned bits, Cycle now) {
  return parts_->read(address, bits, now);
}

Cycle Dspic30f6014a::write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
  return parts_->write(address, value, bits, now);
}

Cycle ChipParts::modify_latch(unsigned address, std::uint16_t keep, std::uint16_t flip, Cycle now) {
  const int port = Ports::latch_at(address);
  begin_write(now);
  const auto value = static_cast<std::uint16_t>((ports.latch(port) & keep) ^ flip);
  const std::uint16_t stored = bus.accept_plain(address, value);
  adc.advance(now);
  ports.write_latch(port, stored, now);
  return end_write();
}

Cycle ChipParts::modify_converter(std::uint16_t keep, std::uint16_t flip, std::uint16_t lanes, Cycle now) {
  begin_write(now);
  const std::uint16_t old = lanes == 0xFF00 ? adc.upper_control() : adc.read(kAdcon1, now);
  const auto value = static_cast<std::uint16_t>((old & keep) ^ flip);
  if (!bus.keeps(kAdcon1, value)) {
    store(lanes == 0xFF00 ? kAdcon1 + 1 : kAdcon1, lanes == 0xFF00 ? value >> 8 : value,
          lanes == 0xFFFF ? 16 : 8, now);
    return end_write();
  }
  adc.write(kAdcon1, bus.accept_plain(kAdcon1, value), lanes, now);
  external.converter_changed(now);
  return end_write();
}

void ChipParts::write_beyond(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
  const unsigned word = address & ~1u;
  const SfrBus::Store store = bus.accept(address, value, bits, now);
  if (!store.owner) return;
  if ((word >= kFirstPort && word <= kLastPort) || word == kAdpcfg) {
    adc.advance(now);  // inputs held up to now saw the pins as they were
    if (word == kAdpcfg || word == kTrisB) adc.pins_changed();
    const int latch = Ports::latch_at(word);
    if (latch >= 0 && store.lanes == 0xFFFF) return ports.write_latch(latch, store.value, now);
    return ports.write(word, store.value, store.lanes, now);
  }
  store.owner->write(word, store.value, store.lanes, now);
  if (word == kAdcon1) external.converter_changed(now);
  if (word == kPmd1 || word == kPmd2) switch_modules(plain.word(kPmd1), plain.word(kPmd2), now);
}

std::uint64_t ChipParts::without_clock(Cycle now) const {
  static constexpr int kAlways[] = {irq::Int0, irq::Int1, irq::Int2, irq::Int3, irq::Int4,
                                    irq::Cn,   irq::Lvd,  irq::C1,   irq::C2};
  static constexpr std::pair<int, unsigned> kCaptures[] = {
      {irq::Ic1, sfr("IC1CON")}, {irq::Ic2, sfr("IC2CON")}, {irq::Ic3, sfr("IC3CON")},
      {irq::Ic4, sfr("IC4CON")}, {irq::Ic5, sfr("IC5CON")}, {irq::Ic6, sfr("IC6CON")},
      {irq::Ic7, sfr("IC7CON")}, {irq::Ic8, sfr("IC8CON")}};
  static constexpr auto kMode = sfr_bits("IC1CON", "ICM"), kPinAlone = kMode;  // all three bits: the pin
  static constexpr auto kOutside = sfr_bits("T1CON", "TCS"), kInStep = sfr_bits("T1CON", "TSYNC"),
                        kOwn = sfr_bits("ADCON3", "ADRC"), kWake = sfr_bits("U1MODE", "WAKE");
  std::uint64_t all = 0;
  const auto add = [&](int source, bool is_one) { all |= std::uint64_t{is_one} << source; };
  for (const int source : kAlways) add(source, true);
  for (const auto& [source, mode] : kCaptures) add(source, (bus.peek(mode, now) & kMode) == kPinAlone);
  add(irq::T1, (bus.peek(sfr("T1CON"), now) & (kOutside | kInStep)) == kOutside);
  add(irq::U1Rx, (bus.peek(sfr("U1MODE"), now) & kWake) != 0);
  add(irq::U2Rx, (bus.peek(sfr("U2MODE"), now) & kWake) != 0);
  add(irq::Adc, (bus.peek(sfr("ADCON3"), now) & kOwn) != 0);
  return all;
}

void ChipParts::fall_asleep(bool is_idle, Cycle now) {
  events.run_to(now);
  timers.set_clock(is_idle ? Timers::Clock::Idles : Timers::Clock::Stands, now);
  interrupts.tally().standing = is_idle ? 0 : ~without_clock(now);
  system.fall_asleep(!is_idle, now);
}

void ChipParts::awake(Cycle now) {
  events.run_to(now);
  timers.set_clock(Timers::Clock::Runs, now);
  interrupts.tally().standing = 0;
  system.awake();
}

std::uint16_t Dspic30f6014a::peek(unsigned address, Cycle now) {
  run_to(now);
  return parts_->bus.peek(address, now);
}

Cycle Dspic30f6014a::horizon(unsigned address, Cycle now) {
  ChipParts& p = *parts_;
  p.events.run_to(now);
  return std::max(p.horizon(address, now), now + 1);
}

const char* Dspic30f6014a::register_name(unsigned address) {
  const SfrInfo* info = sfr_info(address);
  return info ? info->name : nullptr;
}

// --- time

void Dspic30f6014a::run_to(Cycle now) {
  ChipParts& p = *parts_;
  p.events.run_to(now);
  p.adc.advance(now);
  p.dci.advance(now);
  for (Uart& u : p.uarts) u.advance(now);
}

void Dspic30f6014a::run_events(Cycle now) { parts_->events.run_to(now); }

void Dspic30f6014a::watch(EventWatch* watch) { parts_->events.watch(watch); }

Cycle Dspic30f6014a::next_event(Cycle now) {
  ChipParts& p = *parts_;
  p.events.run_to(now);
  const Cycle next = std::min(p.events.notice_horizon(p.interrupts.sources().enabled_mask()),
                              p.interrupts.pending_horizon(now));
  return next >= kNever ? kNever : std::max(next, now + 1);
}

void Dspic30f6014a::outside_changed(Cycle now) {
  ChipParts& p = *parts_;
  run_to(now);
  p.timers.outside_changed(now);
  p.external.outside_changed(now);
  p.change.outside_changed(now);
  p.capture.outside_changed(now);
  p.system.outside_changed(now);
}

void Dspic30f6014a::uart_receive(int uart, const UartFrame& frame, Cycle now) {
  parts_->uarts[static_cast<std::size_t>(uart - 1)].receive(frame, now);
}

// --- instructions

void Dspic30f6014a::clear_watchdog(Cycle now) {
  parts_->events.run_to(now);
  parts_->system.clear_watchdog(now);
}

std::optional<ResetKind> Dspic30f6014a::reset_due(Cycle now) {
  parts_->events.run_to(now);
  if (parts_->system.watchdog_bit()) return ResetKind::Watchdog;
  return parts_->interrupts.control().reset_due();
}

Cycle Dspic30f6014a::stalled_until() const { return parts_->nvm.stalled_until(); }

std::uint16_t Dspic30f6014a::table_read(unsigned program_address, Cycle now) {
  parts_->events.run_to(now);
  return parts_->nvm.table_read(program_address);
}

void Dspic30f6014a::table_write(unsigned program_address, std::uint16_t value, Cycle now) {
  parts_->events.run_to(now);
  parts_->nvm.table_write(program_address, value);
}

Eeprom& Dspic30f6014a::eeprom() { return parts_->nvm.eeprom(); }

// --- diagnosis

Diagnostics& Dspic30f6014a::diagnostics() { return parts_->diagnostics; }

std::int64_t Dspic30f6014a::uart_overruns(int uart) {
  return parts_->uarts[static_cast<std::size_t>(uart - 1)].overruns();
}

std::uint64_t Dspic30f6014a::state_hash(Cycle now) {
  run_to(now);
  std::uint64_t h = 0xCBF29CE484222325u;
  const auto add = [&h](std::uint64_t v) { h = (h ^ v) * 0x100000001B3u; };
  for (const unsigned address : parts_->bus.written()) add(parts_->bus.peek(address, now));
  for (const Uart& u : parts_->uarts) add(u.state_hash());
  add(static_cast<std::uint64_t>(parts_->interrupts.cpu().level()));
  add(parts_->nvm.eeprom_hash());
  return h;
}

}  // namespace dspic
