// SPDX-License-Identifier: MIT
// All parts of the chip, and the calls that a host makes at every access and interrupt, inline. Whoever runs
// firmware may include this beside dspic30f6014a.h and call them on Dspic30f6014a::parts(): the same answers
// as that class gives, without the way there. Everything else talks to Dspic30f6014a.
//
// The bus knows who answers for an address; flags and the converter's results, which handlers touch most, are
// then asked without a virtual call.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/periph/adc.h"
#include "dspic30/periph/capture_compare.h"
#include "dspic30/periph/dci.h"
#include "dspic30/periph/external_interrupts.h"
#include "dspic30/periph/i2c.h"
#include "dspic30/periph/kept_registers.h"
#include "dspic30/periph/nvm.h"
#include "dspic30/periph/ports.h"
#include "dspic30/periph/spi.h"
#include "dspic30/periph/system_control.h"
#include "dspic30/periph/timers.h"
#include "dspic30/periph/uart.h"

namespace dspic {

struct ChipParts {
  ChipParts(Outside& outside, DiagnosticSink* sink, const Configuration& c)
      : configuration(c),
        diagnostics(sink),
        bus(diagnostics, c.warn_uninitialised),
        interrupts(diagnostics),
        fabric{outside, bus, events, interrupts, ports, diagnostics, c.fcy_hz},
        ports(fabric),
        timers(fabric),
        adc(fabric, timers),
        uarts{Uart(fabric, 1), Uart(fabric, 2)},
        i2c(fabric),
        dci(fabric),
        external(fabric, adc),
        change(fabric),
        capture(fabric, timers),
        compare(fabric, timers),
        spis{Spi(fabric, 1), Spi(fabric, 2)},
        system(fabric, c.fosc, c.fwdt),
        nvm(fabric, c.eeprom ? *c.eeprom : own_eeprom, c.program),
        cans{Can(fabric, 1), Can(fabric, 2)},
        cpu(fabric),
        plain(fabric) {
    cpu.attach();
    interrupts.attach(bus);
    change.attach();
    timers.attach();
    capture.attach();
    compare.attach();
    i2c.attach();
    for (Uart& u : uarts) u.attach();
    for (Spi& s : spis) s.attach();
    dci.attach();
    adc.attach();
    ports.attach();
    external.attach();
    for (Can& c : cans) c.attach();
    system.attach();
    plain.attach(kBsram, kSsram);
    nvm.attach();
    plain.attach(kPmd1, kPmd3);
    bus.mark_unmodelled(kBsram, 0x0007);
    bus.mark_unmodelled(kSsram, 0x0007);
  }

  Configuration configuration;
  OwnEeprom own_eeprom;  // unless the configuration has one
  Diagnostics diagnostics;
  SfrBus bus;
  Events events;
  Interrupts interrupts;
  Fabric fabric;
  Ports ports;
  Timers timers;
  Adc adc;
  std::array<Uart, 2> uarts;
  I2c i2c;
  Dci dci;
  ExternalInterrupts external;
  ChangeNotification change;
  InputCapture capture;
  OutputCompare compare;
  std::array<Spi, 2> spis;
  SystemControl system;
  Nvm nvm;
  std::array<Can, 2> cans;
  CpuRegisters cpu;
  PlainRegisters plain;

  // --- registers; as Dspic30f6014a has them
  std::uint16_t read(unsigned address, unsigned bits, Cycle now) {
    events.run_to(now);
    events.tell_read(now);
    return bus.read(address, bits, now);
  }
  /// Is read_result() the same as read()?
  bool is_result(unsigned address, unsigned bits, Cycle now) const {
    return address - Adc::kBuffer < Adc::kBufferEnd - Adc::kBuffer && bits > 8 && events.next() > now &&
           adc.is_cruising() && !events.is_watched();
  }
  __attribute__((always_inline)) std::uint16_t read_result(unsigned address, Cycle now) {
    return adc.read_result(static_cast<int>((address - Adc::kBuffer) / 2), now);
  }

  // registers of a converter that is off, as handlers set it up between two sequences: read() and write(),
  // where nothing else comes of it
  /// Null: read() it.
  const std::uint16_t* idle_word(unsigned address) const {
    const std::uint16_t* const word = adc.idle_word(address);
    return word && bus.reader(address) == &adc && !events.is_watched() ? word : nullptr;
  }
  /// False: nothing has happened.
  bool write_idle(unsigned address, std::uint16_t value) {
    if (!idle_word(address) || !bus.keeps(address, value)) return false;
    adc.write_idle(address, bus.accept_plain(address, value));
    return true;
  }
  /// Can modify_converter() do it?
  bool is_converter(unsigned address) const {
    return address == kAdcon1 && bus.reader(address) == &adc && !events.is_watched();
  }
  /// Of ADCON1, as modify_latch(); `lanes`: of what is written.
  Cycle modify_converter(std::uint16_t keep, std::uint16_t flip, std::uint16_t lanes, Cycle now);

  Cycle write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
    begin_write(now);
    store(address, value, bits, now);
    return end_write();
  }
  // what stands in a word becomes (old & keep) ^ flip, read and written by one instruction: read() and
  // write(), faster for the words that handlers change
  /// Can modify_latch() do it?
  bool is_latch(unsigned address) const {
    return Ports::latch_at(address) >= 0 && bus.reader(address) == &ports;
  }
  Cycle modify_latch(unsigned address, std::uint16_t keep, std::uint16_t flip, Cycle now);
  /// Can modify_flags() do it?
  bool are_flags(unsigned address, Cycle now) const { return is_flags(address) && events.next() > now; }
  /// modify_flags() that flips none, where nothing else comes of it: no event moves, nothing can be served
  /// sooner. False: nothing has happened.
  __attribute__((always_inline)) bool lower_flags(unsigned address, std::uint16_t keep, Cycle now) {
    events.tell_change(now);
    if (!bus.was_written(address) || !interrupts.lower_flags(flag_word(address), keep, now)) return false;
    bus.count_write();
    return true;
  }
  __attribute__((always_inline)) Cycle modify_flags(unsigned address, std::uint16_t keep, std::uint16_t flip,
                                                    Cycle now) {
    const int word = flag_word(address);
    events.tell_change(now);
    interrupts.forget_stir();
    const std::uint16_t old = interrupts.read_flags(word, now);
    const std::uint16_t value = bus.accept_plain(address, static_cast<std::uint16_t>((old & keep) ^ flip));
    interrupts.write_flags(word, value, 0xFFFF, now);
    return end_write();
  }

  // --- interrupts
  __attribute__((always_inline)) Outlook look(Cycle now) {
    events.run_to(now);
    Outlook outlook;
    outlook.level = interrupts.cpu().level();
    outlook.disi = interrupts.cpu().disi_active(now);
    outlook.vector = interrupts.pending(now, outlook.level);
    outlook.reset_due = is_reset_due();
    if (outlook.vector != kNoVector) return outlook;
    outlook.horizon = std::max(now + 1, std::min(notice_horizon(), interrupts.pending_horizon(now)));
    return outlook;
  }
  bool is_reset_due() const { return system.watchdog_bit() || interrupts.control().reset_due().has_value(); }
  Cycle notice_horizon() { return events.notice_horizon(interrupts.sources().enabled_mask()); }
  __attribute__((always_inline)) Cycle interrupt_horizon(int served = kNoVector) {
    return interrupts.has_no_other(served) ? notice_horizon() : 0;
  }

  /// Until when a read of that register gives the same value; may lie in the past. As
  /// Dspic30f6014a::horizon().
  Cycle horizon(unsigned address, Cycle now) const {
    const unsigned word = address & ~1u;
    return is_flags(word) ? events.next_for(std::uint64_t{0xFFFF} << 8 * (word - kIfs0))
                          : bus.horizon(word, now);
  }
  /// Does reading it move a FIFO or lower a flag?
  static constexpr bool is_changed_by_reading(unsigned address) {
    constexpr unsigned kFirstCapture = sfr("IC1BUF"),
                       kLastCapture = sfr("IC8CON");  // not looked up at run time
    switch (address & ~1u) {
      case sfr("I2CRCV"):
      case sfr("U1RXREG"):
      case sfr("U2RXREG"):
      case sfr("SPI1BUF"):
      case sfr("SPI2BUF"):
        return true;
      default:
        return address >= kFirstCapture && address < kLastCapture + 2;  // input capture buffers
    }
  }

  /// Sources of interrupts that need no clock of the processor's, so that they wake it from Sleep: pins, low
  /// voltage, CAN's and UARTs' wake-up, timer 1 and the converter with clocks of their own; a bit each. Source:
  /// [chip C15], [chip P2], [chip P5].
  std::uint64_t without_clock(Cycle now) const;
  /// In Idle, or in Sleep, which stops the timers' clock.
  void fall_asleep(bool is_idle, Cycle now);
  void awake(Cycle now);

  void switch_modules(std::uint16_t next1, std::uint16_t next2, Cycle now);

 private:
  static constexpr unsigned kIfs0 = sfr("IFS0"), kIfsEnd = sfr("IFS2") + 2, kAdcon1 = sfr("ADCON1"),
                            kAdpcfg = sfr("ADPCFG"), kTrisB = sfr("TRISB"), kFirstPort = sfr("TRISA"),
                            kLastPort = sfr("LATG"), kBsram = sfr("BSRAM"), kSsram = sfr("SSRAM"),
                            kPmd1 = sfr("PMD1"), kPmd2 = sfr("PMD2"), kPmd3 = sfr("PMD3");
  static bool is_flags(unsigned address) { return address - kIfs0 < kIfsEnd - kIfs0; }
  static int flag_word(unsigned address) { return static_cast<int>((address - kIfs0) / 2); }

  void begin_write(Cycle now) {
    events.run_to(now);
    events.tell_change(now);
    interrupts.forget_stir();
  }
  Cycle end_write() { return interrupts.stirred() ? 0 : notice_horizon(); }
  void store(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
    if (!is_flags(address)) return write_beyond(address, value, bits, now);
    const SfrBus::Store store = bus.accept(address, value, bits, now);
    if (store.owner) interrupts.write_flags(flag_word(address), store.value, store.lanes, now);
  }
  /// What a write means to others than the register's owner.
  void write_beyond(unsigned address, std::uint16_t value, unsigned bits, Cycle now);
  std::uint16_t pmd1 = 0, pmd2 = 0;
};

}  // namespace dspic
