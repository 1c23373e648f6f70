// SPDX-License-Identifier: MIT
#include "hal_sim/register/chip_processor.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "hal_sim/host/host_params.h"
#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/observer.h"
#include "hal_sim/host/oscillator.h"
#include "hal_sim/register/register_params.h"

namespace register_way {

namespace {

using dspic::sfr;

constexpr unsigned kU1Mode = sfr("U1MODE"), kU2Mode = sfr("U2MODE"), kIfs0 = sfr("IFS0");
constexpr std::uint16_t kUartEnabled = 0x8000, kTransmitEnabled = 0x0400, kBufferFull = 0x0200;

constexpr unsigned kFirstWithSideEffect = sfr("IC1BUF"), kLastWithSideEffect = sfr("SPI2BUF") + 1;

}  // namespace

bool wants_chip(const char* image_flags) { return image_flags && std::strstr(image_flags, "register"); }

ChipProcessor::ChipProcessor(host::CompiledRunner& runner) : runner_(runner), chip_(runner.board()) {}

// --- life -----------------------------------------------------------------------------------------------

void ChipProcessor::power_up() {
  dspic::Configuration configuration;
  const tp_image& image = runner_.image();
  if (image.fosc) {
    configuration.fosc = *static_cast<const std::uint16_t*>(image.fosc);
    configuration.fcy_hz = static_cast<double>(board::kFcyHz) * host::clock_factor(configuration.fosc);
  }
  if (image.fwdt) configuration.fwdt = *static_cast<const std::uint16_t*>(image.fwdt);
  chip_.power_up(configuration);
  parts_ = &chip_.parts();
}

void ChipProcessor::reset(Cycle now) {
  chip_.reset(now);
  watched_reads_ = 0;
}

void ChipProcessor::note_reset(host::ResetCause cause) {
  if (cause == host::ResetCause::Button) chip_.note_reset(dspic::ResetKind::Pin);
}

// --- registers ------------------------------------------------------------------------------------------

inline bool ChipProcessor::may_change_it(unsigned address) {
  return address - kFirstWithSideEffect <= kLastWithSideEffect - kFirstWithSideEffect;
}

std::int64_t ChipProcessor::read(unsigned address, unsigned bits) {
  if (watched_reads_ > 0 || runner_.is_observed()) return read_watched(address, bits);
  const Cycle t = at(runner_.now_in_code());
  if (!parts_->is_result(address, bits, t)) return read_other(address, bits, t);
  runner_.lower_horizon(t);
  return parts_->read_result(address, t);
}

std::int64_t ChipProcessor::read_watched(unsigned address, unsigned bits) {
  return read_other(address, bits, at(runner_.now()));
}

std::int64_t ChipProcessor::read_other(unsigned address, unsigned bits, Cycle t) {
  if (may_change_it(address) || watched_reads_ > 0) return read_closely(address, bits, t);
  runner_.lower_horizon(t);
  return parts_->read(address, bits, t);
}

std::uint16_t ChipProcessor::read_closely(unsigned address, unsigned bits, Cycle t) {
  const std::uint16_t value = device().read(address, bits, t);
  if (dspic::ChipParts::is_changed_by_reading(address)) {
    runner_.note_write();
    runner_.changed();
  }
  if (watched_reads_ > 0) {
    --watched_reads_;
    runner_.lower_horizon(device().horizon(address, t));
  } else {
    runner_.lower_horizon(t);
  }
  return value;
}

inline void ChipProcessor::wrote(Cycle horizon) {
  runner_.note_write();
  runner_.note_interrupt_horizon(horizon, chip_.latest());
}

void ChipProcessor::write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
  const Cycle t = at(now);
  wrote(parts_->write(address, value, bits, t));
  if (const Cycle stalled = parts_->nvm.stalled_until(); stalled > t) runner_.spend(stalled - t);
}

void ChipProcessor::modify(unsigned address, std::uint16_t keep, std::uint16_t flip) {
  const Cycle t = at(runner_.now_in_code());
  if (watched_reads_ > 0 || flip != 0 || !parts_->are_flags(address, t) ||
      !parts_->lower_flags(address, keep, t))
    return modify_other(address, keep, flip, t);
  runner_.lower_horizon(t);
  runner_.note_write();
}

void ChipProcessor::modify_other(unsigned address, std::uint16_t keep, std::uint16_t flip, Cycle t) {
  if (parts_->is_latch(address) && watched_reads_ == 0) {
    runner_.lower_horizon(t);
    return wrote(parts_->modify_latch(address, keep, flip, t));
  }
  const auto old = static_cast<std::uint16_t>(read_other(address, 16, t));
  write(address, static_cast<std::uint16_t>((old & keep) ^ flip), 16, t);
}

std::uint16_t ChipProcessor::table_read(unsigned program_address, Cycle now) {
  return device().table_read(program_address, at(now));
}

void ChipProcessor::table_write(unsigned program_address, std::uint16_t value, Cycle now) {
  device().table_write(program_address, value, at(now));
  runner_.note_write();
}

// XC16's write(): UART 1 is switched on if nobody has done so, and every character waits for room
bool ChipProcessor::print(const char* bytes, std::int64_t length, int uart) {
  const unsigned mode = uart == 2 ? kU2Mode : kU1Mode, sta = mode + 2, tx_reg = mode + 4;
  const auto poll = [this](unsigned address) { return device().peek(address, at(runner_.now())); };
  if (!(poll(mode) & kUartEnabled)) write(mode, kUartEnabled, 16, runner_.now());
  if (!(poll(sta) & kTransmitEnabled)) write(sta, poll(sta) | kTransmitEnabled, 16, runner_.now());
  for (std::int64_t i = 0; i < length; ++i) {
    while (poll(sta) & kBufferFull) runner_.wait_until(device().horizon(sta, chip_.latest()));
    write(tx_reg, static_cast<std::uint8_t>(bytes[i]), 16, runner_.now());
  }
  return true;
}

// --- interrupts -----------------------------------------------------------------------------------------

host::Processor::Outlook ChipProcessor::look(Cycle now) { return outlook_of(parts_->look(at(now))); }

__attribute__((always_inline)) inline host::Processor::Outlook ChipProcessor::outlook_of(
    const dspic::Outlook& chip) {
  Outlook outlook{host::kNoVector, chip.level > 0 || chip.disi, chip.horizon};
  if (chip.reset_due) {
    why_reset_ = chip_.note_reset_due();
    outlook.vector = host::kResetDue;
  } else if (chip.vector >= dspic::kFirstIrqVector) {
    outlook.vector = chip.vector - dspic::kFirstIrqVector;
  } else if (chip.vector != dspic::kNoVector) {
    outlook.vector = host::kTrapVector + chip.vector - 1;
  }
  return outlook;
}

__attribute__((always_inline)) inline host::Processor::Return ChipProcessor::left(Cycle now) {
  const Cycle next = parts_->interrupts.leave(at(now));
  return {next, parts_->interrupt_horizon()};
}

bool ChipProcessor::serve(Cycle now) {
  const Cycle t = at(now);
  dspic::ChipParts& p = *parts_;
  p.events.run_due(t);
  const int vector = p.interrupts.pending(t, p.interrupts.level());
  if (vector < dspic::kFirstIrqVector || p.is_reset_due()) return false;
  void (*handler)() =
      runner_.handler_of(vector - dspic::kFirstIrqVector, p.interrupts.uses_alternate_table());
  if (!handler) return false;
  const Cycle end = runner_.run_handler(handler, enter_at(vector, t));
  runner_.handler_returned(left(end));
  return true;
}

host::Processor::Outlook ChipProcessor::take(Cycle now, Entry& entry) {
  const Cycle t = at(now);
  const dspic::Outlook chip = parts_->look(t);
  if (chip.vector != dspic::kNoVector && !chip.reset_due) entry = enter_at(chip.vector, t);
  return outlook_of(chip);
}

__attribute__((always_inline)) inline host::Processor::Entry ChipProcessor::enter_at(int number, Cycle t) {
  watched_reads_ = 0;  // whatever waits looks again afterwards
  const Cycle first = parts_->interrupts.enter(number, t).first_instruction;
  return {nullptr, first, parts_->interrupt_horizon(number), kSavingCycles,
          parts_->interrupts.uses_alternate_table()};
}

host::Processor::Entry ChipProcessor::enter(int vector, Cycle now) {
  const int number =
      vector >= host::kTrapVector ? vector - host::kTrapVector + 1 : vector + dspic::kFirstIrqVector;
  return enter_at(number, at(now));
}

host::Processor::Return ChipProcessor::leave(Cycle now) { return left(now); }

host::Processor::Waiting ChipProcessor::longest_waiting(Cycle now) {
  const chip::SolderedChip::Waiting oldest = chip_.longest_waiting(now);
  if (oldest.vector == dspic::kNoVector) return {};
  return {oldest.vector - dspic::kFirstIrqVector, oldest.since};
}

// --- observers ------------------------------------------------------------------------------------------

// at the observer's own instants, which may lie before the latest of the program
bool ChipProcessor::flag(int vector, Cycle at) {
  return device().has_flag(vector + dspic::kFirstIrqVector, at);
}

Cycle ChipProcessor::flag_horizon(int vector, Cycle at) {
  return device().horizon(kIfs0 + 2 * static_cast<unsigned>(vector / 16), at);
}

Cycle ChipProcessor::flag_since(int vector) {
  return vector >= host::kTrapVector ? -1 : device().flag_since(vector + dspic::kFirstIrqVector);
}

void ChipProcessor::observe(host::Observer* observer) {
  observer_ = observer;
  chip_.watch(observer ? this : nullptr);
}

void ChipProcessor::about_to_change(Cycle at) { observer_->about_to_change(at); }

}  // namespace register_way
