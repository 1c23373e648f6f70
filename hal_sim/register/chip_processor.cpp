// SPDX-License-Identifier: MIT
#include "hal_sim/register/chip_processor.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "hal_sim/host/host_params.h"
#include "hal_sim/host/image_abi.h"
#include "hal_sim/register/register_params.h"

namespace register_way {

namespace {

constexpr unsigned kU1Mode = 0x20C, kU1Sta = 0x20E, kU1TxReg = 0x210;
constexpr std::uint16_t kUartEnabled = 0x8000, kTransmitEnabled = 0x0400, kBufferFull = 0x0200;

/// Reading it moves a FIFO or lowers a flag, so a loop that does has changed something.
constexpr bool has_side_effect(unsigned address) {
  switch (address & ~1u) {
    case 0x200:  // I2CRCV
    case 0x212:  // U1RXREG
    case 0x21C:  // U2RXREG
    case 0x224:  // SPI1BUF
    case 0x22A:  // SPI2BUF
      return true;
    default:
      return address >= 0x140 && address < 0x160;  // input capture buffers
  }
}
constexpr unsigned kFirstWithSideEffect = 0x140, kLastWithSideEffect = 0x22B;

const char* reason_of(dspic::ResetKind kind) {
  switch (kind) {
    case dspic::ResetKind::Watchdog:
      return "the watchdog was not cleared in time, so it resets the processor";
    case dspic::ResetKind::TrapConflict:
      return "a hard trap met another one, so the processor resets";
    default:
      return "the processor resets";
  }
}

}  // namespace

bool wants_chip(const char* image_flags) { return image_flags && std::strstr(image_flags, "register"); }

ChipProcessor::ChipProcessor(host::Robot& robot) : robot_(robot), outside_(robot.board()) {}

// --- life -------------------------------------------------------------------------------------------------

void ChipProcessor::power_up() {
  latest_ = 0;
  chip_ = std::make_unique<dspic::Dspic30f6014a>(outside_, this);
  outside_.fill_eeprom(*chip_);
  next_reset_ = dspic::ResetKind::PowerOn;
}

void ChipProcessor::reset(Cycle now) {
  chip_->reset(next_reset_, at(now));
  next_reset_ = dspic::ResetKind::Instruction;
  robot_.board().processor_reset(latest_);
  watched_reads_ = 0;
}

void ChipProcessor::note_reset(host::ResetCause cause) {
  if (cause == host::ResetCause::Button) next_reset_ = dspic::ResetKind::Pin;
}

void ChipProcessor::stop(Cycle now) {
  chip_->reset(dspic::ResetKind::Pin, at(now));
  robot_.board().processor_reset(latest_);
}

bool ChipProcessor::begin_window(Cycle now) { return outside_.begin_window(*chip_, at(now)); }

void ChipProcessor::end_window(Cycle now) {
  chip_->run_to(at(now));
  outside_.end_window(*chip_, latest_);
}

void ChipProcessor::remote_changed(Cycle now) { chip_->outside_changed(at(now)); }

void ChipProcessor::report(const dspic::Diagnosis& d) {
  char when[48];
  std::snprintf(when, sizeof when, " (%.6f s)", static_cast<double>(d.cycle) / host::kFcyHz);
  notices_.push_back(std::string(dspic::cause_name(d.cause)) + ": " + d.message + when);
}

// --- registers --------------------------------------------------------------------------------------------

std::uint16_t ChipProcessor::read(unsigned address, unsigned bits, Cycle now) {
  const Cycle t = at(now);
  const bool may_change_it = address >= kFirstWithSideEffect && address <= kLastWithSideEffect;
  if (may_change_it || watched_reads_ > 0) return read_closely(address, bits, t);
  robot_.lower_horizon(t);
  return chip_->read(address, bits, t);
}

std::uint16_t ChipProcessor::read_closely(unsigned address, unsigned bits, Cycle t) {
  const std::uint16_t value = chip_->read(address, bits, t);
  if (has_side_effect(address)) {
    robot_.note_write();
    robot_.changed();
  }
  if (watched_reads_ > 0) {
    --watched_reads_;
    robot_.lower_horizon(chip_->horizon(address, t));
  } else {
    robot_.lower_horizon(t);
  }
  return value;
}

void ChipProcessor::write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
  const Cycle calm = chip_->write(address, value, bits, at(now));
  robot_.note_write();
  robot_.calm_until(calm, latest_);
  const Cycle stalled = chip_->stalled_until();
  if (stalled > latest_) robot_.spend(stalled - latest_);
}

std::uint16_t ChipProcessor::table_read(unsigned program_address, Cycle now) {
  return chip_->table_read(program_address, at(now));
}

void ChipProcessor::table_write(unsigned program_address, std::uint16_t value, Cycle now) {
  chip_->table_write(program_address, value, at(now));
  robot_.note_write();
}

// XC16's write(): UART 1 is switched on if nobody has done so, and every character waits for room
bool ChipProcessor::print(const char* bytes, std::int64_t length) {
  const auto poll = [this](unsigned address) {
    Cycle t = at(robot_.now());
    return chip_->peek(address, t);
  };
  if (!(poll(kU1Mode) & kUartEnabled)) {
    write(kU1Mode, kUartEnabled, 16, robot_.now());
    write(kU1Sta, kTransmitEnabled, 16, robot_.now());
  }
  for (std::int64_t i = 0; i < length; ++i) {
    while (poll(kU1Sta) & kBufferFull) robot_.wait_until(chip_->horizon(kU1Sta, latest_));
    write(kU1TxReg, static_cast<std::uint8_t>(bytes[i]), 16, robot_.now());
  }
  return true;
}

// --- interrupts -------------------------------------------------------------------------------------------

host::Processor::Outlook ChipProcessor::look(Cycle now) {
  const dspic::Outlook chip = chip_->look(at(now));
  Outlook outlook{host::kNoVector, chip.level > 0 || chip.disi, chip.quiet_until};
  if (chip.reset_due) {
    next_reset_ = *chip_->reset_due(latest_);
    why_reset_ = reason_of(next_reset_);
    outlook.vector = host::kResetDue;
  } else if (chip.vector >= dspic::kFirstIrqVector) {
    outlook.vector = chip.vector - dspic::kFirstIrqVector;
  } else if (chip.vector != dspic::kNoVector) {
    outlook.vector = host::kTrapVector + chip.vector - 1;
  }
  return outlook;
}

host::Processor::Entry ChipProcessor::enter(int vector, Cycle now) {
  const int number =
      vector >= host::kTrapVector ? vector - host::kTrapVector + 1 : vector + dspic::kFirstIrqVector;
  const dspic::InterruptEntry entry = chip_->enter_interrupt(number, at(now));
  watched_reads_ = 0;  // whatever waits looks again afterwards
  const Cycle first = entry.first_instruction + kSavingCycles;
  return {nullptr, first, chip_->calm_until(first, number)};
}

host::Processor::Return ChipProcessor::leave(Cycle now) {
  const Cycle next = chip_->return_from_interrupt(at(now));
  return {next, chip_->calm_until(next)};
}

host::Processor::Waiting ChipProcessor::longest_waiting(Cycle now) {
  const Cycle t = at(now);
  if (chip_->cpu_level() == 0 && !chip_->disi_active(t)) return {};
  Waiting oldest;
  for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v) {
    if (!chip_->is_enabled(v) || chip_->priority(v) == 0 || !chip_->has_flag(v, t)) continue;
    const bool held =
        chip_->priority(v) <= chip_->cpu_level() || (chip_->disi_active(t) && chip_->priority(v) < 7);
    const Cycle since = chip_->flag_since(v);
    if (held && (oldest.vector < 0 || since < oldest.since)) oldest = {v - dspic::kFirstIrqVector, since};
  }
  return oldest;
}

bool ChipProcessor::wakes(Cycle now) { return chip_->wakes(at(now)); }

}  // namespace register_way
