// SPDX-License-Identifier: MIT
#include "hal_sim/register/chip_processor.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "dspic30/device/chip_parts.h"
#include "hal_sim/host/host_params.h"
#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/observer.h"
#include "hal_sim/host/oscillator.h"
#include "hal_sim/register/register_params.h"

namespace register_way {

namespace {

constexpr unsigned kU1Mode = 0x20C, kU2Mode = 0x216, kIfs0 = 0x084;
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

/// What to do about it; empty where the message says so.
const char* hint_for(dspic::Cause cause) {
  using dspic::Cause;
  switch (cause) {
    case Cause::UnmodelledBit:
      return "the robot may do something here that the twin does not; see docs/limits.md";
    case Cause::UnimplementedAddress:
      return "is the header the dsPIC30F6014A's?";
    case Cause::UninitialisedRead:
      return "write it first";
    case Cause::UartOverrun:
      return "read UxRXREG in the receive interrupt until URXDA is 0, and clear UxSTA.OERR";
    case Cause::UartFrameError:
      return "compare baud rate, parity and stop bits of both ends";
    case Cause::BaudError:
      return "UxBRG = FCY / (16 baud) - 1 with FCY = 14745600 Hz: 7 for 115200, 95 for 9600";
    case Cause::MissedInterrupt:
      return "make the handler shorter, raise its priority, or allow nesting (INTCON1.NSTDIS = 0)";
    case Cause::FlagNeverCleared:
      return "clear the flag in the handler";
    case Cause::InputDriven:
      return "clear the TRIS bit, or call e_init_port() first";
    case Cause::AnalogueDigital:
      return "clear the channel's ADPCFG bit and set its TRIS bit";
    case Cause::DigitalAnalogue:
      return "set the ADPCFG bit";
    case Cause::ChangedWhileOn:
      return "clear ADCON1.ADON first";
    case Cause::NotUnlocked:
      return "write the unlock sequence directly before, with interrupts off";
    case Cause::I2cMisuse:
      return "wait until SEN, RSEN, PEN, RCEN, ACKEN and I2CSTAT.TRSTAT are 0";
    case Cause::CodecRate:
      return "choose the divider N1 and multiplier M1 in the codec's registers 3 and 4 for the rate of the "
             "DCI's frames";
    case Cause::WatchdogReset:
      return "call ClrWdt() in the main loop, or leave RCON.SWDTEN 0";
    case Cause::TrapConflict:
      return "";
  }
  return "";
}

}  // namespace

bool wants_chip(const char* image_flags) { return image_flags && std::strstr(image_flags, "register"); }

ChipProcessor::ChipProcessor(host::Robot& robot) : robot_(robot), outside_(robot.board()) {}

// --- life -----------------------------------------------------------------------------------------------

void ChipProcessor::power_up() {
  latest_ = 0;
  dspic::Configuration configuration;
  const tp_image& image = robot_.image();
  if (image.fosc) {
    configuration.fosc = *static_cast<const std::uint16_t*>(image.fosc);
    configuration.fcy_hz *= host::clock_factor(configuration.fosc);
  }
  if (image.fwdt) configuration.fwdt = *static_cast<const std::uint16_t*>(image.fwdt);
  chip_ = std::make_unique<dspic::Dspic30f6014a>(outside_, this, configuration);
  parts_ = &chip_->parts();
  outside_.fill_eeprom(*chip_);
  robot_.board().processor_reset(latest_);
  observe(observer_);
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

void ChipProcessor::report(const dspic::Diagnosis& d) { diagnoses_.push_back(d); }

std::vector<board::Diagnosis> ChipProcessor::diagnoses() const {
  std::vector<board::Diagnosis> all;
  for (const dspic::Diagnosis& d : diagnoses_) {
    board::Diagnosis one{dspic::cause_name(d.cause), d.place, d.message, hint_for(d.cause), d.cycle};
    one.count = count_of(d);
    all.push_back(std::move(one));
  }
  return all;
}

// some causes are counted elsewhere, each time; the report comes once
std::int64_t ChipProcessor::count_of(const dspic::Diagnosis& d) const {
  if (d.cause == dspic::Cause::MissedInterrupt)
    for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
      if (d.place == dspic::vector_name(v)) return chip_->missed_interrupts(v);
  if (d.cause == dspic::Cause::UartOverrun) return chip_->uart_overruns(d.place[1] - '0');
  return chip_->diagnostics().count(d.cause, d.place);
}

// --- registers ------------------------------------------------------------------------------------------

inline bool ChipProcessor::may_change_it(unsigned address) {
  return address - kFirstWithSideEffect <= kLastWithSideEffect - kFirstWithSideEffect;
}

std::uint16_t ChipProcessor::read(unsigned address, unsigned bits, Cycle now) {
  const Cycle t = at(now);
  if (watched_reads_ > 0 || !parts_->is_result(address, bits, t)) return read_other(address, bits, t);
  robot_.lower_horizon(t);
  return parts_->read_result(address, t);
}

std::uint16_t ChipProcessor::read_other(unsigned address, unsigned bits, Cycle t) {
  if (may_change_it(address) || watched_reads_ > 0) return read_closely(address, bits, t);
  robot_.lower_horizon(t);
  return parts_->read(address, bits, t);
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

inline void ChipProcessor::wrote(Cycle calm) {
  robot_.note_write();
  robot_.calm_until(calm, latest_);
  if (const Cycle stalled = parts_->nvm.stalled_until(); stalled > latest_) robot_.spend(stalled - latest_);
}

void ChipProcessor::write(unsigned address, std::uint16_t value, unsigned bits, Cycle now) {
  wrote(parts_->write(address, value, bits, at(now)));
}

void ChipProcessor::modify(unsigned address, std::uint16_t keep, std::uint16_t flip, Cycle now) {
  const Cycle t = at(now);
  if (watched_reads_ > 0 || !parts_->are_flags(address, t)) return modify_other(address, keep, flip, t);
  robot_.lower_horizon(t);
  wrote(parts_->modify_flags(address, keep, flip, t));
}

void ChipProcessor::modify_other(unsigned address, std::uint16_t keep, std::uint16_t flip, Cycle t) {
  if (!may_change_it(address) && watched_reads_ == 0) {
    robot_.lower_horizon(t);
    return wrote(parts_->modify(address, keep, flip, t));
  }
  const std::uint16_t old = read_closely(address, 16, t);
  wrote(parts_->write(address, static_cast<std::uint16_t>((old & keep) ^ flip), 16, t));
}

std::uint16_t ChipProcessor::table_read(unsigned program_address, Cycle now) {
  return chip_->table_read(program_address, at(now));
}

void ChipProcessor::table_write(unsigned program_address, std::uint16_t value, Cycle now) {
  chip_->table_write(program_address, value, at(now));
  robot_.note_write();
}

// XC16's write(): UART 1 is switched on if nobody has done so, and every character waits for room
bool ChipProcessor::print(const char* bytes, std::int64_t length, int uart) {
  const unsigned mode = uart == 2 ? kU2Mode : kU1Mode, sta = mode + 2, tx_reg = mode + 4;
  const auto poll = [this](unsigned address) {
    Cycle t = at(robot_.now());
    return chip_->peek(address, t);
  };
  if (!(poll(mode) & kUartEnabled)) write(mode, kUartEnabled, 16, robot_.now());
  if (!(poll(sta) & kTransmitEnabled)) write(sta, poll(sta) | kTransmitEnabled, 16, robot_.now());
  for (std::int64_t i = 0; i < length; ++i) {
    while (poll(sta) & kBufferFull) robot_.wait_until(chip_->horizon(sta, latest_));
    write(tx_reg, static_cast<std::uint8_t>(bytes[i]), 16, robot_.now());
  }
  return true;
}

// --- interrupts -----------------------------------------------------------------------------------------

host::Processor::Outlook ChipProcessor::look(Cycle now) { return outlook_of(parts_->look(at(now))); }

__attribute__((always_inline)) inline host::Processor::Outlook ChipProcessor::outlook_of(
    const dspic::Outlook& chip) {
  Outlook outlook{host::kNoVector, chip.level > 0 || chip.disi, chip.quiet_until};
  if (chip.reset_due) {
    note_reset_due();
    outlook.vector = host::kResetDue;
  } else if (chip.vector >= dspic::kFirstIrqVector) {
    outlook.vector = chip.vector - dspic::kFirstIrqVector;
  } else if (chip.vector != dspic::kNoVector) {
    outlook.vector = host::kTrapVector + chip.vector - 1;
  }
  return outlook;
}

void ChipProcessor::note_reset_due() {
  next_reset_ = *chip_->reset_due(latest_);
  why_reset_ = reason_of(next_reset_);
}

host::Processor::Outlook ChipProcessor::take(Cycle now, Entry& entry) {
  const Cycle t = at(now);
  dspic::ChipParts& p = *parts_;
  p.events.run_to(t);
  const int irq = p.interrupts.sole_pending(t);
  if (irq < 0 || p.is_reset_due()) return take_in_general(t, entry);
  watched_reads_ = 0;  // whatever waits looks again afterwards
  const Cycle first = p.interrupts.enter_sole(irq, t);
  entry = {nullptr, first, p.events.next() <= first ? 0 : p.next_notice(), kSavingCycles,
           p.interrupts.uses_alternate_table()};
  return {irq, true, 0};
}

host::Processor::Outlook ChipProcessor::take_in_general(Cycle t, Entry& entry) {
  const dspic::Outlook chip = parts_->look(t);
  if (chip.vector != dspic::kNoVector && !chip.reset_due) entry = enter_at(chip.vector, t);
  return outlook_of(chip);
}

__attribute__((always_inline)) inline host::Processor::Entry ChipProcessor::enter_at(int number, Cycle t) {
  watched_reads_ = 0;  // whatever waits looks again afterwards
  const Cycle first = parts_->interrupts.enter(number, t).first_instruction;
  return {nullptr, first, parts_->calm_until(first, number), kSavingCycles,
          parts_->interrupts.uses_alternate_table()};
}

host::Processor::Entry ChipProcessor::enter(int vector, Cycle now) {
  const int number =
      vector >= host::kTrapVector ? vector - host::kTrapVector + 1 : vector + dspic::kFirstIrqVector;
  return enter_at(number, at(now));
}

host::Processor::Return ChipProcessor::leave(Cycle now) {
  const Cycle next = parts_->interrupts.leave(at(now));
  return {next, parts_->calm_until(next)};
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

// --- observers ------------------------------------------------------------------------------------------

// at the observer's own instants, which may lie before the latest of the program
bool ChipProcessor::flag(int vector, Cycle at) {
  return chip_->has_flag(vector + dspic::kFirstIrqVector, at);
}

Cycle ChipProcessor::next_flag(int vector, Cycle at) {
  return chip_->horizon(kIfs0 + 2 * static_cast<unsigned>(vector / 16), at);
}

Cycle ChipProcessor::flag_since(int vector) {
  return vector >= host::kTrapVector ? -1 : chip_->flag_since(vector + dspic::kFirstIrqVector);
}

void ChipProcessor::observe(host::Observer* observer) {
  observer_ = observer;
  chip_->watch(observer ? this : nullptr);
}

void ChipProcessor::about_to_change(Cycle at) { observer_->about_to_change(at); }

}  // namespace register_way
