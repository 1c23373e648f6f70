// SPDX-License-Identifier: MIT
// A chip on a bench: registers by name, pins as lists of levels, and everything that leaves
// the chip written down.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "dspic30/device/dspic30f6014a.h"
#include "dspic30/memory/sfr_table.h"

namespace bench {

using dspic::Cycle;
using dspic::kNever;
using dspic::Port;

/// Numbers by chance, the same ones for a seed.
struct Draw {
  std::uint32_t state;
  unsigned operator()(unsigned below) {
    state = state * 1664525u + 1013904223u;
    return static_cast<unsigned>((std::uint64_t{state} * below) >> 32);
  }
};

struct FakeOutside : dspic::Outside {
  // levels of a port from given cycles on
  std::map<Port, std::map<Cycle, std::uint16_t>> waves;
  std::map<Port, std::uint16_t> wired;  // pins that the outside drives
  struct Driven {
    Port port;
    std::uint16_t levels, driven;
    Cycle at;
  };
  std::vector<Driven> driven;
  std::function<int(int, Cycle)> analogue = [](int channel, Cycle) { return 100 * channel; };
  std::vector<std::pair<int, Cycle>> held;
  std::vector<dspic::UartFrame> sent;
  std::array<std::vector<dspic::UartFrame>, 2> sent_by;  // each UART's own
  std::vector<std::string> i2c;
  std::vector<Cycle> i2c_at;
  dspic::I2cReply reply;
  std::vector<std::pair<std::uint16_t, Cycle>> codec;
  std::function<std::uint16_t(std::uint16_t)> codec_answer = [](std::uint16_t) { return 0; };
  std::vector<std::pair<std::uint16_t, Cycle>> spi;
  double supply = 3.3;

  /// A pulse train: high for `high` cycles at start, start + period, ...
  void clock(dspic::Pin pin, Cycle start, Cycle period, Cycle high, int pulses) {
    auto& wave = waves[pin.port];
    wired[pin.port] |= static_cast<std::uint16_t>(1 << pin.bit);
    if (wave.empty()) wave[0] = 0;
    for (int i = 0; i < pulses; ++i) {
      wave[start + i * period] = static_cast<std::uint16_t>(1 << pin.bit);
      wave[start + i * period + high] = 0;
    }
  }

  void pins_driven(Port port, std::uint16_t levels, std::uint16_t mask, std::uint16_t, Cycle at) override {
    driven.push_back({port, levels, mask, at});
  }
  dspic::PinLevels pin_levels(Port port, Cycle at) override {
    const auto wave = waves.find(port);
    std::uint16_t levels = 0;
    if (wave != waves.end()) {
      auto next = wave->second.upper_bound(at);
      if (next != wave->second.begin()) levels = std::prev(next)->second;
    }
    return {levels, wired[port]};
  }
  Cycle levels_horizon(Port port, std::uint16_t /*pins*/, Cycle after) override {
    const auto wave = waves.find(port);
    if (wave == waves.end()) return kNever;
    const auto next = wave->second.upper_bound(after);
    return next == wave->second.end() ? kNever : next->first;
  }
  int analogue_counts(int channel, Cycle at) override {
    held.emplace_back(channel, at);
    return analogue(channel, at);
  }
  double supply_v(Cycle) override { return supply; }
  void uart_sent(int uart, const dspic::UartFrame& frame) override {
    sent.push_back(frame);
    sent_by[static_cast<std::size_t>(uart - 1)].push_back(frame);
  }
  void note(const std::string& what, Cycle at) {
    i2c.push_back(what);
    i2c_at.push_back(at);
  }
  void i2c_start(bool repeated, Cycle at) override { note(repeated ? "restart" : "start", at); }
  dspic::I2cReply i2c_write(std::uint8_t byte, Cycle at) override {
    note("write " + std::to_string(byte), at);
    return reply;
  }
  dspic::I2cReply i2c_read(Cycle at) override {
    note("read", at);
    return reply;
  }
  void i2c_acknowledge(bool yes, Cycle at) override { note(yes ? "ack" : "nack", at); }
  void i2c_stop(Cycle at) override { note("stop", at); }
  std::uint16_t dci_word(int, std::uint16_t word, int, Cycle end) override {
    codec.emplace_back(word, end);
    return codec_answer(word);
  }
  std::uint16_t spi_word(int, std::uint16_t word, int, Cycle end) override {
    spi.emplace_back(word, end);
    return static_cast<std::uint16_t>(~word);
  }
};

struct Notes : dspic::DiagnosticSink {
  std::vector<dspic::Diagnosis> all;
  void report(const dspic::Diagnosis& d) override { all.push_back(d); }
  int count(dspic::Cause cause) const {
    return static_cast<int>(
        std::count_if(all.begin(), all.end(), [&](const auto& d) { return d.cause == cause; }));
  }
};

struct Bench {
  explicit Bench(const dspic::Configuration& c = {}) : chip(outside, &notes, c) {}
  FakeOutside outside;
  Notes notes;
  dspic::Dspic30f6014a chip;

  static unsigned at(const std::string& name) {
    const dspic::SfrInfo* info = dspic::sfr_named(name);
    EXPECT_TRUE(info) << name;
    return info ? info->address : 0;
  }
  void write(const std::string& name, unsigned value, Cycle now) {
    chip.write(at(name), static_cast<std::uint16_t>(value), 16, now);
  }
  unsigned read(const std::string& name, Cycle now) { return chip.read(at(name), 16, now); }
  unsigned peek(const std::string& name, Cycle now) { return chip.peek(at(name), now); }
  /// Bit operation: read and write in one instruction.
  void set(const std::string& name, unsigned bits, Cycle now) { write(name, read(name, now) | bits, now); }
  void clear(const std::string& name, unsigned bits, Cycle now) { write(name, read(name, now) & ~bits, now); }
  bool flag(int irq, Cycle now) { return chip.interrupts().has_flag(dspic::kFirstIrqVector + irq, now); }
  void clear_flag(int irq, Cycle now) { clear("IFS" + std::to_string(irq / 16), 1u << irq % 16, now); }
  void enable(int irq, Cycle now) { set("IEC" + std::to_string(irq / 16), 1u << irq % 16, now); }
  /// First cycle >= `from` at which the flag is set; -1 when it is not within `within` cycles.
  Cycle flag_rises(int irq, Cycle from, Cycle within = 20'000'000) {
    for (Cycle now = from; now < from + within;) {
      if (flag(irq, now)) return std::max(from, chip.interrupts().flag_since(dspic::kFirstIrqVector + irq));
      now = chip.horizon(0x084 + 2 * static_cast<unsigned>(irq / 16), now);
    }
    return -1;
  }
};

}  // namespace bench
