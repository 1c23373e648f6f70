// SPDX-License-Identifier: MIT
#include "dspic30/periph/uart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kMode = 0, kSta = 2, kTxReg = 4, kRxReg = 6;
constexpr unsigned kU1Mode = sfr("U1MODE"), kU2Mode = sfr("U2MODE");
constexpr std::uint16_t sta(const char* bit) { return sfr_bits("U1STA", bit); }
constexpr std::uint16_t kAltio = sfr_bits("U1MODE", "ALTIO"), kLpback = sfr_bits("U1MODE", "LPBACK"),
                        kStsel = sfr_bits("U1MODE", "STSEL");
constexpr std::uint16_t kUtxisel = sta("UTXISEL"), kUtxbrk = sta("UTXBRK"), kUtxen = sta("UTXEN"),
                        kUtxbf = sta("UTXBF"), kTrmt = sta("TRMT"), kAdden = sta("ADDEN"),
                        kRidle = sta("RIDLE"), kPerr = sta("PERR"), kFerr = sta("FERR"), kOerr = sta("OERR"),
                        kUrxda = sta("URXDA");
constexpr SfrBits kPdsel = sfr_field("U1MODE", "PDSEL"), kUrxisel = sfr_field("U1STA", "URXISEL");
constexpr std::uint16_t kControls = kUtxisel | kUtxbrk | kUtxen | kUrxisel.mask | kAdden;
constexpr Cycle kWriteToShift = 1;
// rates that the other end may be set to
constexpr double kRates[] = {300,   600,   1200,  2400,   4800,   9600,   14400,  19200,  28800,
                             38400, 57600, 76800, 115200, 230400, 250000, 460800, 500000, 921600};
constexpr double kWorstRateError = 0.02;

}  // namespace

Uart::Uart(const Fabric& fabric, int number)
    : f_(fabric),
      number_(number),
      base_(number == 1 ? kU1Mode : kU2Mode),
      tx_irq_(number == 1 ? irq::U1Tx : irq::U2Tx),
      rx_irq_(number == 1 ? irq::U1Rx : irq::U2Rx) {}

void Uart::attach() {
  f_.bus.attach(*this, base_, base_ + 8);
  f_.bus.mark_unmodelled(base_ + kMode,
                         std::integral_constant<std::uint16_t, sfr_bits("U1MODE", "USIDL", "ABAUD")>());
  slot_tx_ = f_.events.add(*this, Transmit, std::uint64_t{1} << tx_irq_, true);
  slot_last_ = f_.events.add(*this, TransmitLast, std::uint64_t{1} << tx_irq_, false);
  slot_rx_ = f_.events.add(*this, Receive, std::uint64_t{1} << rx_irq_, false);
}

void Uart::reset(Cycle now) {
  advance(now);
  mode_ = sta_ = brg_ = 0;
  out_.count = in_.count = 0;
  busy_until_ = epoch_ = now;
  break_since_ = -1;
  rate_checked_ = false;
  next_move_ = kNever;
  set_transmit_event();
  schedule_receive(now);
}

std::string Uart::name(const char* suffix) const { return "U" + std::to_string(number_) + suffix; }

Cycle Uart::align(Cycle at) const {
  const Cycle step = sixteenth(), over = (at - epoch_) % step;
  return over == 0 ? at : at + step - over;
}

UartFrame Uart::format(std::uint16_t word, Cycle start) const {
  UartFrame frame;
  const unsigned format = kPdsel.of(mode_);
  frame.data_bits = format == 3 ? 9 : 8;
  frame.parity = format == 1 ? Parity::Even : format == 2 ? Parity::Odd : Parity::None;
  frame.stop_bits = (mode_ & kStsel) ? 2 : 1;
  frame.word = static_cast<std::uint16_t>(word & (format == 3 ? kWordBits : 0xFF));
  frame.start = start;
  frame.bit = bit();
  return frame;
}

// --- out

void Uart::schedule_transmit(Cycle now) {
  next_move_ = move_behind(now);
  set_transmit_event();
}

Cycle Uart::move_behind(Cycle at) const {
  const bool waits = transmits() && out_.count > 0 && break_since_ < 0;
  return waits ? std::max(busy_until_, at + kWriteToShift) : kNever;
}

// Of words that follow one another something comes only when the FIFO runs empty. In between they are put on
// the line when somebody looks.
void Uart::set_transmit_event() {
  const bool is_quiet = out_.count > 0 && next_move_ == busy_until_ && next_move_ > epoch_ &&
                        (sta_ & kUtxisel) && !(mode_ & kLpback) && rate_checked_ && !f_.events.is_watched();
  Cycle loud = next_move_, quiet = kNever;
  if (is_quiet) {
    quiet = loud + (out_.count > 1 ? static_cast<Cycle>(out_.count - 1) * format(0, 0).end() : 0);
    loud = kNever;
  }
  f_.events.set(slot_tx_, loud);
  f_.events.set(slot_last_, quiet);
}

void Uart::move_up_to(Cycle now) {
  UartFrame frame = format(kWordBits, 0);
  const std::uint16_t bits = frame.word;
  const Cycle length = frame.end();
  for (Cycle at = next_move_; at <= now; at = next_move_) {
    check_rate(at);
    frame.word = out_.pop() & bits;
    // straight after a stop bit there is no gap
    frame.start = at == busy_until_ && at > epoch_ ? at : align(at);
    busy_until_ = frame.start + length;
    if (!(sta_ & kUtxisel) || out_.count == 0) f_.interrupts.raise(tx_irq_, at, false);
    f_.outside.uart_sent(number_, frame);
    if (mode_ & kLpback) enqueue(frame, at);
    next_move_ = move_behind(at);
  }
  set_transmit_event();
}

// how long the line is low is known at the end; the own receiver has a word of zeros long before
void Uart::begin_break(Cycle now) {
  break_since_ = std::max(now + 1, busy_until_);
  if (!(mode_ & kLpback)) return;
  UartFrame low = format(0, break_since_);
  low.broken = true;
  enqueue(low, now);
}

void Uart::end_break(Cycle now) {
  UartFrame low = format(0, break_since_);
  low.broken = true;
  const Cycle length = now + 1 - break_since_;
  break_since_ = -1;
  if (length > 0) {
    low.bit = std::max<Cycle>(1, length / low.bits());
    f_.outside.uart_sent(number_, low);
    busy_until_ = std::max(busy_until_, low.end());
  }
  if (!(mode_ & kLpback)) return;
  // one that was shorter than a word, or never began
  const auto own = std::find_if(line_.begin(), line_.end(),
                                [&](const UartFrame& f) { return f.broken && f.start == low.start; });
  if (own != line_.end() && length <= 0)
    line_.erase(own);
  else if (own != line_.end())
    own->bit = std::min(own->bit, low.bit);
  line_free_ = std::max(length > 0 ? low.end() : now, line_.empty() ? now : line_.back().end());
  schedule_receive(now);
}

// --- in

void Uart::receive(const UartFrame& frame, Cycle now) {
  const bool looped = (mode_ & kLpback) && enabled();
  if (!looped) enqueue(frame, now);
}

void Uart::enqueue(UartFrame frame, Cycle now) {
  frame.start = std::max({frame.start, line_free_, now});
  line_free_ = frame.end();
  line_.push_back(frame);
  if (line_.size() == 1) schedule_receive(now);
}

Cycle Uart::transfer_time(const UartFrame& frame) const {
  const UartFrame own = format(0, align(frame.start));
  const int stop = 1 + own.data_bits + (own.parity != Parity::None ? 1 : 0);
  return own.start + stop * bit() + bit() / 2;
}

void Uart::schedule_receive(Cycle now) {
  Cycle at = kNever;
  if (!line_.empty()) at = enabled() ? transfer_time(line_.front()) : line_.front().end();
  f_.events.set(slot_rx_, std::max(at, now));
}

void Uart::take_in(const UartFrame& frame, Cycle at) {
  check_rate(frame.start);
  // The word as this receiver's own rate and format see the line.
  const UartFrame own = format(0, align(frame.start));
  const auto sample = [&](int index) { return frame.level(own.start + index * bit() + bit() / 2); };
  if (sample(0)) return;  // too short for a start bit
  Received received{0, false, false};
  int at_bit = 1;
  bool ones = false;
  for (int i = 0; i < own.data_bits; ++i)
    if (sample(at_bit++)) {
      received.word |= static_cast<std::uint16_t>(1 << i);
      ones = !ones;
    }
  if (own.parity != Parity::None) {
    const bool parity = sample(at_bit++);
    received.parity_error = parity != (own.parity == Parity::Even ? ones : !ones);
  }
  // with two stop bits both must be high
  received.frame_error = !sample(at_bit) || (own.stop_bits == 2 && !sample(at_bit + 1));
  if (received.frame_error && !frame.broken)
    f_.diagnostics.report(
        Cause::UartFrameError, name("STA.FERR"),
        name("RX") + ": a word came without its stop bit; the two ends differ in rate or format", at);
  // Words for others are dropped, and so are those that find no room.
  if ((sta_ & kAdden) && own.data_bits == 9 && !(received.word & 0x100)) return;
  if (sta_ & kOerr) {  // blocked
    ++overruns_;
    return;
  }
  if (in_.full()) {
    sta_ |= kOerr;
    ++overruns_;
    f_.diagnostics.report(Cause::UartOverrun, name("STA.OERR"),
                          name("RX") + ": a fifth word came while four waited in " + name("RXREG") +
                              "; it is lost, and reception stops until " + name("STA.OERR") + " is cleared",
                          at);
    return;
  }
  // The interrupt comes by the number of words that wait.
  in_.push(received);
  const unsigned select = kUrxisel.of(sta_);
  const std::size_t needed = select == 3 ? 4 : select == 2 ? 3 : 1;
  if (in_.count >= needed) f_.interrupts.raise(rx_irq_, at, false);
}

void Uart::on_event(int id, Cycle at) {
  if (id != Receive) return advance(at);
  const UartFrame frame = line_.front();
  line_.pop_front();
  if (enabled() && transfer_time(frame) <= at) take_in(frame, at);
  schedule_receive(at);
}

// --- registers

std::uint16_t Uart::read(unsigned address, Cycle now) {
  advance(now);
  if (address - base_ != kRxReg || in_.count == 0) return peek(address, now);
  return in_.pop().word;
}

// behind advance(), which the chip calls before somebody peeks
std::uint16_t Uart::peek(unsigned address, Cycle now) const {
  switch (address - base_) {
    case kMode:
      return mode_;
    case kSta: {
      std::uint16_t word = sta_;
      if (out_.full()) word |= kUtxbf;
      if (out_.count == 0 && now >= busy_until_) word |= kTrmt;
      const bool receiving = enabled() && !line_.empty() && line_.front().start <= now;
      if (!receiving) word |= kRidle;
      if (in_.count) {
        word |= kUrxda;
        if (in_.words[0].parity_error) word |= kPerr;
        if (in_.words[0].frame_error) word |= kFerr;
      }
      return word;
    }
    case kTxReg:
      return 0;
    case kRxReg:
      return in_.count ? in_.words[0].word : 0;
    default:
      return brg_;
  }
}

void Uart::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  advance(now);
  switch (address - base_) {
    case kMode: {
      const bool was_enabled = enabled();
      mode_ = merge_lanes(mode_, value, lanes);
      if (enabled() != was_enabled)
        set_enabled(enabled(), now);
      else if (enabled())
        own_pins(now + 1);
      set_transmit_event();
      schedule_receive(now);
      break;
    }
    case kSta: {
      const std::uint16_t before = sta_, wanted = merge_lanes(sta_, value, lanes);
      sta_ = static_cast<std::uint16_t>((wanted & kControls) | (before & wanted & kOerr));
      if (!enabled()) sta_ &= static_cast<std::uint16_t>(~(kUtxen | kUtxbrk));
      if ((before & kOerr) && !(sta_ & kOerr)) in_.count = 0;
      if (!(before & kUtxen) && (sta_ & kUtxen)) f_.interrupts.raise(tx_irq_, now + 1, false);
      if (!(before & kUtxbrk) && (sta_ & kUtxbrk)) begin_break(now);
      if ((before & kUtxbrk) && !(sta_ & kUtxbrk) && break_since_ >= 0) end_break(now);
      if ((before ^ sta_) & kUtxen) own_pins(now + 1);
      schedule_transmit(now);
      break;
    }
    case kTxReg:
      if (!enabled())
        f_.diagnostics.report(Cause::UartOff, name("TXREG"),
                              name("TXREG") + " is written while " + name("MODE.UARTEN") +
                                  " is 0: nothing is sent, and what is written is lost",
                              now);
      if (!(lanes & 0xFF)) break;
      if (out_.full()) {
        if (enabled()) tell_full(now);
        break;
      }
      load(value);
      if (out_.count == 1)
        schedule_transmit(now);
      else
        set_transmit_event();
      break;
    case kRxReg:
      break;
    default:
      brg_ = merge_lanes(brg_, value, lanes);
      epoch_ = now + 1;
      rate_checked_ = false;
      set_transmit_event();
      schedule_receive(now);
      break;
  }
}

void Uart::tell_full(Cycle now) {
  f_.diagnostics.report(Cause::UartFull, name("TXREG"),
                        name("TXREG") + " is written while four words wait in it" +
                            (transmits() ? "" : ", for " + name("STA.UTXEN") + " is 0") +
                            ": what is written is lost",
                        now);
}

void Uart::set_enabled(bool on, Cycle now) {
  out_.count = in_.count = 0;
  sta_ &= static_cast<std::uint16_t>(~(kUtxen | kUtxbrk | kOerr));
  break_since_ = -1;
  busy_until_ = now;  // nothing is being sent: TRMT stays 1
  epoch_ = now + 1;
  rate_checked_ = false;
  next_move_ = kNever;
  set_transmit_event();
  if (on)  // the middle of a word is no start bit
    while (!line_.empty() && line_.front().start <= now) line_.pop_front();
  own_pins(now + 1);
}

void Uart::own_pins(Cycle at) {
  const Pin rx = number_ == 1 ? Pin{Port::F, 2} : Pin{Port::F, 4};
  const Pin tx = number_ == 1 ? Pin{Port::F, 3} : Pin{Port::F, 5};
  const Pin other_rx{Port::C, 14}, other_tx{Port::C, 13};
  const bool alternate = number_ == 1 && (mode_ & kAltio);
  const Pin in = alternate ? other_rx : rx, out = alternate ? other_tx : tx;
  if (number_ == 1) {
    f_.ports.release(alternate ? rx : other_rx, at);
    f_.ports.release(alternate ? tx : other_tx, at);
  }
  if (enabled())
    f_.ports.own_input(in, at);
  else
    f_.ports.release(in, at);
  if (transmits())
    f_.ports.own_output(out, true, at);
  else
    f_.ports.release(out, at);
}

void Uart::check_rate(Cycle at) {
  if (rate_checked_) return;
  rate_checked_ = true;
  const double rate = f_.fcy_hz / static_cast<double>(bit());
  double nearest = kRates[0];
  for (const double r : kRates)
    if (std::fabs(std::log(rate / r)) < std::fabs(std::log(rate / nearest))) nearest = r;
  const double error = rate / nearest - 1;
  if (std::fabs(error) <= kWorstRateError) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s = %d gives %.0f baud, %+.1f %% from the nearest usual rate, %.0f",
                name("BRG").c_str(), brg_, rate, 100 * error, nearest);
  f_.diagnostics.report(Cause::BaudError, name("BRG"), text, at);
}

Cycle Uart::horizon(unsigned address, Cycle now) const {
  const unsigned r = address - base_;
  if (r != kSta && r != kRxReg) return kNever;
  Cycle next = f_.events.when(slot_rx_);
  if (r == kSta) {
    next = std::min(next, next_move_);
    if (busy_until_ > now) next = std::min(next, busy_until_);
    if (!line_.empty() && line_.front().start > now) next = std::min(next, line_.front().start);
  }
  return next;
}

std::uint64_t Uart::state_hash() const {
  std::uint64_t h = 0x9E3779B97F4A7C15u * static_cast<std::uint64_t>(busy_until_ + 1);
  const auto add = [&h](std::uint64_t v) { h = (h ^ v) * 0x100000001B3u; };
  add(out_.count);
  for (std::size_t i = 0; i < out_.count; ++i) add(out_.words[i]);
  add(in_.count);
  for (std::size_t i = 0; i < in_.count; ++i) add(in_.words[i].word);
  for (const UartFrame& f : line_) add(static_cast<std::uint64_t>(f.start) * 512 + f.word);
  return h;
}

}  // namespace dspic
