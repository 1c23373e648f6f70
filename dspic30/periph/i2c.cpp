// SPDX-License-Identifier: MIT
#include "dspic30/periph/i2c.h"

#include <cmath>
#include <string>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kRcv = sfr("I2CRCV"), kTrn = sfr("I2CTRN"), kBrg = sfr("I2CBRG"), kCon = sfr("I2CCON"),
                   kStat = sfr("I2CSTAT"), kAdd = sfr("I2CADD");
constexpr std::uint16_t con(const char* bit) { return sfr_bits("I2CCON", bit); }
constexpr std::uint16_t stat(const char* bit) { return sfr_bits("I2CSTAT", bit); }
constexpr std::uint16_t kSen = con("SEN"), kRsen = con("RSEN"), kPen = con("PEN"), kRcen = con("RCEN"),
                        kAcken = con("ACKEN"), kAckdt = con("ACKDT"),
                        kOperations = kSen | kRsen | kPen | kRcen | kAcken;
constexpr std::uint16_t kTbf = stat("TBF"), kRbf = stat("RBF"), kS = stat("S"), kP = stat("P"),
                        kI2cov = stat("I2COV"), kIwcol = stat("IWCOL"), kTrstat = stat("TRSTAT"),
                        kAckstat = stat("ACKSTAT"), kReads = stat("R_NOT_W"), kData = stat("D_NOT_A"),
                        kGeneral = stat("GCSTAT");
constexpr std::uint16_t kSclrel = con("SCLREL"), kStren = con("STREN"), kGcen = con("GCEN");
constexpr std::uint8_t kReleased = 0xFF;
constexpr double kFixedHz = 1111111;  // I2CBRG = FCY/FSCL - FCY/1,111,111 - 1 [chip P6]
// half SCL periods of each operation [?]
constexpr Cycle kStartHalves = 2, kRestartHalves = 4, kStopHalves = 3, kByteHalves = 16, kBitHalves = 2;
constexpr Pin kScl{Port::G, 2}, kSda{Port::G, 3};

}  // namespace

I2c::I2c(const Fabric& fabric)
    : f_(fabric), fixed_(static_cast<Cycle>(std::lround(fabric.fcy_hz / kFixedHz))) {}

void I2c::attach() {
  f_.bus.attach(*this, kRcv, kAdd);
  // slew rate and levels of the pins (DISSLW, SMEN) have no digital effect
  f_.bus.mark_unmodelled(
      kCon, std::integral_constant<std::uint16_t, sfr_bits("I2CCON", "I2CSIDL", "IPMIEN", "A10M")>());
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << irq::MasterI2c, false, true);
}

void I2c::reset(Cycle /*now*/) {
  con_ = kSclrel;
  slave_ = Slave::Idle;
  stat_ = brg_ = add_ = 0;
  rcv_ = 0;
  trn_ = 0xFF;
  operation_ = Operation::None;
  answered_ = false;
  f_.events.set(slot_, kNever);
}

Cycle I2c::duration(Operation operation) const {
  const auto halves = [operation] {
    switch (operation) {
      case Operation::Start:
        return kStartHalves;
      case Operation::Restart:
        return kRestartHalves;
      case Operation::Stop:
        return kStopHalves;
      case Operation::Receive:
        return kByteHalves;
      case Operation::Transmit:
        return kByteHalves + kBitHalves;
      default:
        return kBitHalves;
    }
  }();
  return (halves * scl() + 1) / 2;
}

void I2c::begin(Operation operation, Cycle now) {
  operation_ = operation;
  answered_ = false;
  end_ = now + duration(operation);
  f_.events.set(slot_, end_);
}

void I2c::refuse(const char* what, Cycle now) {
  stat_ |= kIwcol;
  f_.diagnostics.report(Cause::I2cMisuse, "I2CSTAT.IWCOL",
                        std::string("I2C: ") + what +
                            " is asked for while another operation is under way; it is "
                            "ignored and I2CSTAT.IWCOL set",
                        now);
}

void I2c::request(std::uint16_t bits, Cycle now) {
  if (!bits) return;
  if (operation_ != Operation::None) return refuse("an operation", now);
  if (bits & (bits - 1)) bits &= static_cast<std::uint16_t>(-bits);  // the lowest alone
  con_ |= bits;
  switch (bits) {
    case kSen:
      return begin(Operation::Start, now);
    case kRsen:
      return begin(Operation::Restart, now);
    case kPen:
      return begin(Operation::Stop, now);
    case kRcen:
      return begin(Operation::Receive, now);
    default:
      return begin(Operation::Acknowledge, now);
  }
}

void I2c::on_event(int /*id*/, Cycle at) {
  Cycle stretched = 0;
  if (!answered_) {
    answered_ = true;
    if (operation_ == Operation::Transmit) {
      const I2cReply reply = f_.outside.i2c_write(trn_, at);
      acknowledged_ = reply.acknowledged;
      stretched = reply.stretched;
    } else if (operation_ == Operation::Receive) {
      const I2cReply reply = f_.outside.i2c_read(at);
      byte_ = reply.byte;
      stretched = reply.stretched;
    }
  }
  if (stretched > 0) {
    end_ = at + stretched;
    f_.events.set(slot_, end_);
    return;
  }
  finish(at);
}

void I2c::finish(Cycle at) {
  // It reaches the outside now that it is complete.
  switch (operation_) {
    case Operation::Start:
    case Operation::Restart:
      stat_ = static_cast<std::uint16_t>((stat_ | kS) & ~kP);
      f_.outside.i2c_start(operation_ == Operation::Restart, at);
      break;
    case Operation::Stop:
      stat_ = static_cast<std::uint16_t>((stat_ | kP) & ~kS);
      f_.outside.i2c_stop(at);
      break;
    case Operation::Receive:
      if (stat_ & kRbf) {
        stat_ |= kI2cov;
      } else {
        rcv_ = byte_;
        stat_ |= kRbf;
      }
      break;
    case Operation::Acknowledge:
      f_.outside.i2c_acknowledge(!(con_ & kAckdt), at);
      break;
    case Operation::Transmit:
      stat_ =
          static_cast<std::uint16_t>((stat_ & ~(kTbf | kTrstat | kAckstat)) | (acknowledged_ ? 0 : kAckstat));
      break;
    case Operation::None:
      return;
  }
  con_ &= static_cast<std::uint16_t>(~kOperations);
  operation_ = Operation::None;
  f_.interrupts.raise(irq::MasterI2c, at);
}

// --- as a slave

void I2c::tell_alone(const char* place, Cycle now) {
  if (f_.outside.i2c_has_master()) return;
  f_.diagnostics.report(Cause::UnmodelledBit, place,
                        std::string(place) +
                            ": the chip is the only master of its I2C bus here, so as a slave it is never "
                            "spoken to",
                        now);
}

bool I2c::holds_clock() const { return on() && slave_ != Slave::Idle && !(con_ & kSclrel); }

void I2c::hear_start(Cycle /*at*/) {
  if (!on()) return;
  stat_ = static_cast<std::uint16_t>((stat_ | kS) & ~kP);
  slave_ = Slave::Addressing;
}

void I2c::hear_stop(Cycle /*at*/) {
  if (!on()) return;
  stat_ = static_cast<std::uint16_t>((stat_ | kP) & ~kS);
  slave_ = Slave::Idle;
}

bool I2c::hear_byte(std::uint8_t byte, Cycle at) {
  if (!on()) return false;
  if (slave_ == Slave::Receiving) {
    stat_ |= kData;
    return take_in(byte, at);
  }
  if (slave_ != Slave::Addressing) return false;
  const bool reads = (byte & 1) != 0, is_general = byte == 0 && (con_ & kGcen);
  slave_ = Slave::Idle;
  if (!is_general && (add_ == 0 || byte >> 1 != (add_ & 0x7F))) return false;
  stat_ = static_cast<std::uint16_t>((stat_ & ~(kData | kReads | kGeneral)) | (reads ? kReads : 0) |
                                     (is_general ? kGeneral : 0));
  const bool acknowledged = take_in(byte, at);
  if (!acknowledged) return false;
  slave_ = reads ? Slave::Sending : Slave::Receiving;
  if (reads && !(stat_ & kTbf)) con_ &= static_cast<std::uint16_t>(~kSclrel);
  return true;
}

// what was not read before is kept, the byte is lost and not acknowledged, and the
// interrupt comes all the same
bool I2c::take_in(std::uint8_t byte, Cycle at) {
  f_.interrupts.raise(irq::SlaveI2c, at);
  if (stat_ & kRbf) {
    stat_ |= kI2cov;
    return false;
  }
  rcv_ = byte;
  stat_ |= kRbf;
  if (con_ & kStren) con_ &= static_cast<std::uint16_t>(~kSclrel);
  return !(stat_ & kI2cov);
}

std::uint8_t I2c::say_byte() {
  if (!on() || slave_ != Slave::Sending) return kReleased;
  stat_ = static_cast<std::uint16_t>((stat_ & ~kTbf) | kData);
  return trn_;
}

void I2c::hear_acknowledge(bool acknowledged, Cycle at) {
  if (!on() || slave_ != Slave::Sending) return;
  f_.interrupts.raise(irq::SlaveI2c, at);
  stat_ = static_cast<std::uint16_t>((stat_ & ~kAckstat) | (acknowledged ? 0 : kAckstat));
  if (!acknowledged)
    slave_ = Slave::Idle;
  else if (!(stat_ & kTbf))
    con_ &= static_cast<std::uint16_t>(~kSclrel);
}

// --- registers

std::uint16_t I2c::read(unsigned address, Cycle now) {
  if (address == kRcv) stat_ &= static_cast<std::uint16_t>(~kRbf);
  return peek(address, now);
}

std::uint16_t I2c::peek(unsigned address, Cycle now) const {
  switch (address) {
    case kRcv:
      return rcv_;
    case kTrn:
      return trn_;
    case kBrg:
      return brg_;
    case kCon:
      return con_;
    case kStat:
      // the buffer is empty after the eighth bit, while the ninth is under way
      if (operation_ == Operation::Transmit && !answered_ && now >= end_ - scl())
        return static_cast<std::uint16_t>(stat_ & ~kTbf);
      return stat_;
    default:
      return add_;
  }
}

void I2c::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  switch (address) {
    case kTrn:
      if (!(lanes & 0xFF)) break;
      if (!on()) {
        f_.diagnostics.report(Cause::I2cMisuse, "I2CCON.I2CEN",
                              "I2CTRN is written while I2CCON.I2CEN = 0; nothing is sent", now);
        trn_ = static_cast<std::uint8_t>(value);
      } else if (slave_ == Slave::Sending) {
        trn_ = static_cast<std::uint8_t>(value);
        stat_ |= kTbf;
      } else if (operation_ != Operation::None) {
        refuse("a byte", now);
      } else {
        trn_ = static_cast<std::uint8_t>(value);
        stat_ |= kTbf | kTrstat;
        begin(Operation::Transmit, now);
      }
      break;
    case kBrg:
      brg_ = merge_lanes(brg_, value, lanes);
      break;
    case kCon: {
      const bool was_on = on();
      std::uint16_t wanted = merge_lanes(con_, value, lanes);
      if (wanted & kGcen) tell_alone("I2CCON.GCEN", now);
      if (!(wanted & kStren)) wanted |= con_ & kSclrel;  // then the program can only release the clock
      const auto fresh = static_cast<std::uint16_t>(wanted & kOperations & ~con_);
      // a bit under way cannot be taken back
      con_ = static_cast<std::uint16_t>((wanted & ~kOperations) | (con_ & kOperations));
      // Off: all that was under way is over, and the pins are the port's again.
      if (!on()) {
        con_ &= static_cast<std::uint16_t>(~kOperations);
        stat_ &= kP;  // a start is over; a stop stays seen: the library waits for it before its first start
        operation_ = Operation::None;
        slave_ = Slave::Idle;
        con_ |= kSclrel;
        f_.events.set(slot_, kNever);
        if (was_on) {
          f_.ports.release(kScl, now + 1);
          f_.ports.release(kSda, now + 1);
        }
        if (fresh)
          f_.diagnostics.report(Cause::I2cMisuse, "I2CCON.I2CEN",
                                "an I2C operation is asked for while I2CCON.I2CEN = 0; nothing happens", now);
        break;
      }
      // On: the pins are taken from the port.
      if (!was_on) {
        const bool was_low = !f_.ports.level(kSda, now);
        f_.ports.own_input(kScl, now + 1);  // open drain: the outside gives the level
        f_.ports.own_input(kSda, now + 1);
        // pins that the port held low rise as it takes them over, the clock no later than
        // the data: a stop [?]
        if (was_low && f_.ports.level(kScl, now + 2) && f_.ports.level(kSda, now + 2)) stat_ |= kP;
      }
      request(fresh, now);
      break;
    }
    case kStat: {
      const auto kept = static_cast<std::uint16_t>(~(kIwcol | kI2cov) | merge_lanes(stat_, value, lanes));
      stat_ &= kept;
      break;
    }
    case kAdd:
      add_ = merge_lanes(add_, value, lanes);
      if (add_ != 0) tell_alone("I2CADD", now);
      break;
    default:
      break;
  }
}

Cycle I2c::horizon(unsigned address, Cycle now) const {
  if (operation_ == Operation::None || address == kBrg || address == kAdd || address == kTrn) return kNever;
  const Cycle eighth = end_ - scl();
  if (address == kStat && operation_ == Operation::Transmit && !answered_ && eighth > now) return eighth;
  return end_;
}

}  // namespace dspic
