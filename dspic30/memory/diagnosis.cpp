// SPDX-License-Identifier: MIT
#include "dspic30/memory/diagnosis.h"

namespace dspic {

const char* cause_name(Cause cause) {
  switch (cause) {
    case Cause::UnmodelledBit:
      return "unmodelled bit";
    case Cause::UnimplementedAddress:
      return "unimplemented address";
    case Cause::UninitialisedRead:
      return "uninitialised read";
    case Cause::UartOverrun:
      return "UART overrun";
    case Cause::UartFrameError:
      return "UART frame error";
    case Cause::UartOff:
      return "UART off";
    case Cause::UartFull:
      return "UART full";
    case Cause::BaudError:
      return "baud rate error";
    case Cause::MissedInterrupt:
      return "missed interrupt";
    case Cause::FlagNeverCleared:
      return "flag never cleared";
    case Cause::InputDriven:
      return "input driven";
    case Cause::AnalogueDigital:
      return "analogue channel left digital";
    case Cause::DigitalAnalogue:
      return "digital pin left analogue";
    case Cause::ChangedWhileOn:
      return "changed while on";
    case Cause::NotUnlocked:
      return "not unlocked";
    case Cause::NvmBusy:
      return "EEPROM busy";
    case Cause::I2cMisuse:
      return "I2C misuse";
    case Cause::WatchdogReset:
      return "watchdog reset";
    case Cause::CodecRate:
      return "codec rate";
    case Cause::TrapConflict:
      return "trap conflict";
    case Cause::CpuTrap:
      return "trap";
    case Cause::IllegalOpcode:
      return "illegal opcode";
  }
  return "?";
}

void Diagnostics::report(Cause cause, const std::string& place, const std::string& message, Cycle at) {
  if (++seen_[{cause, place}] == 1 && sink_) sink_->report({cause, place, message, at});
}

std::int64_t Diagnostics::count(Cause cause, const std::string& place) const {
  const auto found = seen_.find({cause, place});
  return found == seen_.end() ? 0 : found->second;
}

std::int64_t Diagnostics::count(Cause cause) const {
  std::int64_t sum = 0;
  for (const auto& [key, times] : seen_)
    if (key.first == cause) sum += times;
  return sum;
}

}  // namespace dspic
