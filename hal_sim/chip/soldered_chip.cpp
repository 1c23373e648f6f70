// SPDX-License-Identifier: MIT
#include "hal_sim/chip/soldered_chip.h"

namespace chip {

namespace {

/// What to do about it; empty where the message says so.
std::string hint_for(dspic::Cause cause) {
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
    case Cause::UartOff:
      return "call e_init_uart1() or e_init_uart2() first, or set UxMODE.UARTEN";
    case Cause::UartFull:
      return "wait until UxSTA.UTXBF is 0 before each write, or call e_send_uart1_char()";
    case Cause::BaudError:
      return "UxBRG = FCY / (16 baud) - 1 with FCY = " + std::to_string(board::kFcyHz) +
             " Hz: 7 for 115200, 95 for 9600";
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
    case Cause::NvmBusy:
      return "call _wait_eedata(), or wait until NVMCON.WR is 0, before the next operation";
    case Cause::I2cMisuse:
      return "set I2CCON.I2CEN, then wait until SEN, RSEN, PEN, RCEN, ACKEN and I2CSTAT.TRSTAT are 0";
    case Cause::CodecRate:
      return "choose the divider N1 and multiplier M1 in the codec's registers 3 and 4 for the rate of the "
             "DCI's frames";
    case Cause::WatchdogReset:
      return "call ClrWdt() in the main loop, or leave RCON.SWDTEN 0";
    case Cause::TrapConflict:
      return "";
    case Cause::CpuTrap:
      return "twinpuck dis shows the instruction there; without a handler of its own a program resets";
    case Cause::IllegalOpcode:
      return "did the program run into data, or into flash that holds nothing?";
  }
  return "";
}

}  // namespace

// --- life

void SolderedChip::power_up(dspic::Configuration configuration) {
  latest_ = 0;
  configuration.eeprom = &eeprom_;
  dspic::DiagnosticSink* sink = this;
  device_ = std::make_unique<dspic::Dspic30f6014a>(outside_, sink, configuration);
  parts_ = &device_->parts();
  device_->watch(watch_);
  outside_.chip_was_reset();
  board_.processor_reset(latest_);
  next_reset_ = dspic::ResetKind::PowerOn;
}

void SolderedChip::reset(Cycle now) {
  device_->reset(next_reset_, at(now));
  outside_.chip_was_reset();
  next_reset_ = dspic::ResetKind::Instruction;
  board_.processor_reset(latest_);
}

void SolderedChip::begin_again(Cycle now) {
  latest_ = now;
  next_reset_ = dspic::ResetKind::PowerOn;
  reset(now);
  next_reset_ = dspic::ResetKind::PowerOn;
}

void SolderedChip::end_window(Cycle now) {
  device_->run_to(at(now));
  outside_.end_window(*device_, latest_);
}

void SolderedChip::watch(dspic::EventWatch* watch) {
  watch_ = watch;
  device_->watch(watch);
}

// --- diagnoses

std::vector<board::Diagnosis> SolderedChip::diagnoses() const {
  std::vector<board::Diagnosis> all;
  for (const dspic::Diagnosis& d : diagnoses_) {
    board::Diagnosis one{dspic::cause_name(d.cause), d.place, d.message, hint_for(d.cause), d.cycle};
    one.count = count_of(d);
    all.push_back(std::move(one));
  }
  return all;
}

// some causes are counted elsewhere, each time; the report comes once
std::int64_t SolderedChip::count_of(const dspic::Diagnosis& d) const {
  if (d.cause == dspic::Cause::MissedInterrupt)
    for (int v = dspic::kFirstIrqVector; v < dspic::kVectors; ++v)
      if (d.place == dspic::vector_name(v)) return device_->interrupts().missed(v, latest_);
  if (d.cause == dspic::Cause::UartOverrun) return device_->uart_overruns(d.place[1] - '0');
  return device_->diagnostics().count(d.cause, d.place);
}

}  // namespace chip
