// SPDX-License-Identifier: MIT
#include "dspic30/periph/system_control.h"

#include <cmath>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kRcon = sfr("RCON"), kOsccon = sfr("OSCCON"), kOsctun = sfr("OSCTUN");
constexpr std::uint16_t rcon(const char* bit) { return sfr_bits("RCON", bit); }
constexpr std::uint16_t kPor = rcon("POR"), kBor = rcon("BOR"), kIdle = rcon("IDLE"), kSleep = rcon("SLEEP"),
                        kWdto = rcon("WDTO"), kSwdten = rcon("SWDTEN"), kSwr = rcon("SWR"),
                        kExtr = rcon("EXTR"), kLvden = rcon("LVDEN"), kBgst = rcon("BGST"),
                        kIopuwr = rcon("IOPUWR"), kTrapr = rcon("TRAPR");
constexpr SfrBits kLvdl = sfr_field("RCON", "LVDL"), kNosc = sfr_field("OSCCON", "NOSC"),
                  kCosc = sfr_field("OSCCON", "COSC");
constexpr std::uint16_t kDefaultLvdl = 5 << kLvdl.lowest;
constexpr std::uint16_t kOswen = sfr_bits("OSCCON", "OSWEN"), kCf = sfr_bits("OSCCON", "CF"),
                        kLock = sfr_bits("OSCCON", "LOCK"),
                        kIdleBits = sfr_bits("OSCCON", "LPOSCEN", "POST");  // kept, without effect
constexpr std::uint16_t kUnlockLow[] = {0x46, 0x57}, kUnlockHigh[] = {0x78, 0x9A};
constexpr int kPllSource = 7;
// postscaler A, and the shortest time-out: 256 periods of 128 kHz [chip C16]
constexpr int kPostscaleA[] = {1, 8, 64, 512};
constexpr double kWatchdogSeconds = 0.002;
// V by LVDL, the least value of a sister chip [DS70138G 23-10]; 0: not usable, 15 is an input pin
constexpr double kLvdVolts[] = {0, 0, 0, 0, 2.5, 2.7, 2.8, 3.0, 3.3, 3.5, 3.6, 3.8, 4.0, 4.2, 4.5, 0};

}  // namespace

void SystemControl::attach() {
  f_.bus.attach(*this, kRcon, kOsctun);
  f_.bus.take_all_bits(kOsccon);
  f_.bus.mark_unmodelled(
      kOsctun, std::integral_constant<std::uint16_t, sfr_bits("OSCTUN", "TUN0", "TUN1", "TUN2", "TUN3")>());
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << irq::Lvd, true);
}

Cycle SystemControl::watchdog_period() const {
  const int a = kPostscaleA[fwdt_ >> 4 & 3], b = (fwdt_ & 15) + 1;
  return static_cast<Cycle>(std::llround(kWatchdogSeconds * f_.fcy_hz * a * b));
}

void SystemControl::reset(ResetKind kind, Cycle now) {
  bitten_ = asleep_ = woke_ = false;
  const auto kept = static_cast<std::uint16_t>(rcon_ & ~(kSwdten | kLvden | kBgst | kLvdl.mask));
  // Each reset leaves its bit beside those of earlier ones; a power-on forgets these.
  switch (kind) {
    case ResetKind::PowerOn:
      rcon_ = kPor | kBor;
      break;
    case ResetKind::BrownOut:
      rcon_ = kept | kBor;
      break;
    case ResetKind::Pin:
      rcon_ = kept | kExtr;
      break;
    case ResetKind::Instruction:
      rcon_ = kept | kSwr;
      break;
    case ResetKind::Watchdog:
      rcon_ = kept | kWdto;
      break;
    case ResetKind::IllegalOpcode:
      rcon_ = kept | kIopuwr;
      break;
    case ResetKind::TrapConflict:
      rcon_ = kept | kTrapr;
      break;
  }
  rcon_ |= kDefaultLvdl;
  osctun_ = 0;
  const int source = fosc_ >> 8 & 7;
  osccon_ = static_cast<std::uint16_t>(source << kCosc.lowest | source << kNosc.lowest |
                                       (source == kPllSource ? kLock : 0));
  low_ = high_ = Lock{};
  clear_watchdog(now);
}

void SystemControl::clear_watchdog(Cycle now) {
  f_.events.set(slot_, watchdog_runs() ? now + watchdog_period() : kNever);
}

void SystemControl::fall_asleep(bool sleep, Cycle now) {
  asleep_ = true;
  rcon_ |= sleep ? kSleep : kIdle;
  clear_watchdog(now);
}

void SystemControl::on_event(int /*id*/, Cycle at) {
  if (asleep_) {
    rcon_ |= kWdto;
    woke_ = true;
    return clear_watchdog(at);
  }
  bitten_ = true;
  f_.diagnostics.report(Cause::WatchdogReset, "RCON.WDTO",
                        "the watchdog was not cleared in time (ClrWdt()); the chip resets with RCON.WDTO = 1",
                        at);
}

void SystemControl::watch_supply(Cycle now) {
  if (!(rcon_ & kLvden)) return;
  const double limit = kLvdVolts[kLvdl.of(rcon_)];
  if (limit > 0 && f_.outside.supply_v(now) < limit) f_.interrupts.raise(irq::Lvd, now + 1, false);
}

std::uint16_t SystemControl::peek(unsigned address, Cycle /*now*/) const {
  if (address == kRcon) return rcon_;
  return address == kOsccon ? osccon_ : osctun_;
}

void SystemControl::write_osccon(std::uint16_t value, std::uint16_t lanes, Cycle now) {
  const bool is_low = lanes == 0x00FF, is_high = lanes == 0xFF00;
  const auto byte = static_cast<std::uint16_t>(is_high ? value >> 8 : value & 0xFF);
  Lock& lock = is_high ? high_ : low_;
  const std::uint16_t* keys = is_high ? kUnlockHigh : kUnlockLow;
  const bool follows = lock.at_write + 1 == f_.bus.writes();
  // | is_high)|A byte counts right behind both keys; else it may be the next key.
  if (is_low || is_high) {
    if (lock.step == 2 && follows) {
      const std::uint16_t writable = is_high ? kNosc.mask : kOswen | kIdleBits;
      const std::uint16_t clear_only = is_high ? 0 : kCf;
      osccon_ = static_cast<std::uint16_t>((osccon_ & ~writable) | (value & writable));
      if (!(value & clear_only)) osccon_ &= static_cast<std::uint16_t>(~clear_only);
      if (osccon_ & (kOswen | kIdleBits))
        f_.diagnostics.report(
            Cause::UnmodelledBit, "OSCCON",
            "OSCCON: clock switching, postscaler and the 32 kHz oscillator are not modelled; the "
            "clock stays as configured",
            now);
      osccon_ &= static_cast<std::uint16_t>(~kOswen);
      lock.step = 0;
      return;
    }
    const int step = follows ? lock.step : 0;
    lock.step = byte == keys[step < 2 ? step : 0] ? (step < 2 ? step : 0) + 1 : 0;
    lock.at_write = f_.bus.writes();
    if (lock.step > 0) return;
  }
  f_.diagnostics.report(
      Cause::NotUnlocked, "OSCCON",
      "OSCCON is written without its unlock sequence (OSCCONH: 0x78, 0x9A; OSCCONL: 0x46, 0x57; as "
      "bytes, one after the other); nothing happens",
      now);
}

void SystemControl::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  if (address == kOsccon) return write_osccon(value, lanes, now);
  if (address == kOsctun) {
    osctun_ = merge_lanes(osctun_, value, lanes);
    return;
  }
  const bool ran = watchdog_runs();
  const std::uint16_t before = rcon_;
  rcon_ = static_cast<std::uint16_t>((merge_lanes(rcon_, value, lanes) & ~kBgst));
  if (rcon_ & kLvden) rcon_ |= kBgst;  // the reference is ready at once
  if (watchdog_runs() != ran) clear_watchdog(now);
  if ((rcon_ & (kLvden | kLvdl.mask)) != (before & (kLvden | kLvdl.mask))) watch_supply(now);
}

}  // namespace dspic
