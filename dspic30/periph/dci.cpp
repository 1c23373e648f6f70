// SPDX-License-Identifier: MIT
#include "dspic30/periph/dci.h"

#include <algorithm>
#include <type_traits>

namespace dspic {

namespace {

constexpr unsigned kCon1 = sfr("DCICON1"), kCon2 = sfr("DCICON2"), kCon3 = sfr("DCICON3"),
                   kStat = sfr("DCISTAT"), kTscon = sfr("TSCON"), kRscon = sfr("RSCON"), kRx = sfr("RXBUF0"),
                   kTx = sfr("TXBUF0");
constexpr std::uint16_t kDcien = sfr_bits("DCICON1", "DCIEN"), kDloop = sfr_bits("DCICON1", "DLOOP"),
                        kUnfm = sfr_bits("DCICON1", "UNFM"), kDjst = sfr_bits("DCICON1", "DJST");
constexpr std::uint16_t kTmpty = sfr_bits("DCISTAT", "TMPTY"), kTunf = sfr_bits("DCISTAT", "TUNF"),
                        kRful = sfr_bits("DCISTAT", "RFUL"), kRov = sfr_bits("DCISTAT", "ROV");
constexpr SfrBits kSlot = sfr_field("DCISTAT", "SLOT");
constexpr Cycle kStartBits = 1;  // bit clocks from DCIEN to the first frame [?]
constexpr Pin kCsdi{Port::G, 12}, kCsdo{Port::G, 13}, kCsck{Port::G, 14}, kCofs{Port::G, 15};

int nth_bit(std::uint16_t mask, std::int64_t n) {
  for (; n > 0; --n) mask &= static_cast<std::uint16_t>(mask - 1);
  return __builtin_ctz(mask);
}

}  // namespace

void Dci::attach() {
  f_.bus.attach(*this, kCon1, kTx + 6);
  f_.bus.mark_unmodelled(
      kCon1,
      std::integral_constant<std::uint16_t, sfr_bits("DCICON1", "DCISIDL", "CSCKD", "COFSD", "COFSM")>());
  slot_ = f_.events.add(*this, 0, std::uint64_t{1} << irq::Dci, false, true);
}

void Dci::reset(Cycle /*now*/) {
  con1_ = con2_ = con3_ = stat_ = tscon_ = rscon_ = 0;
  rx_.fill(0);
  tx_.fill(0);
  rx_shadow_.fill(0);
  tx_shadow_.fill(0);
  written_ = false;
  passed_ = index_ = 0;
  f_.events.set(slot_, kNever);
}

std::uint16_t Dci::slots() const {
  const auto in_frame = static_cast<std::uint16_t>((1u << frame_words()) - 1);
  return static_cast<std::uint16_t>((tscon_ | rscon_) & in_frame);
}

int Dci::slot_number(std::int64_t n) const {
  const std::uint16_t mask = slots();
  return nth_bit(mask, n % __builtin_popcount(mask));
}

Cycle Dci::slot_end(std::int64_t n) const {
  const int each = __builtin_popcount(slots());
  return first_ + (n / each * frame_words() + slot_number(n) + 1) * word();
}

int Dci::slot_in_progress(Cycle now) const {
  if (!runs() || now < first_) return 0;
  return static_cast<int>((now - first_) / word() % frame_words());
}

void Dci::start(Cycle now) {
  // with DJST = 0 the data follows the frame sync by one bit
  first_ = now + 1 + (kStartBits + ((con1_ & kDjst) ? 0 : 1)) * bit();
  passed_ = 0;
  index_ = 0;
}

void Dci::transfer() {
  if (stat_ & kRful) stat_ |= kRov;
  if (!written_) stat_ |= kTunf;
  rx_ = rx_shadow_;
  if (written_)
    tx_shadow_ = tx_;
  else if (!(con1_ & kUnfm))
    tx_shadow_.fill(0);
  written_ = false;
  index_ = 0;
  stat_ |= kRful | kTmpty;
}

void Dci::advance(Cycle now) {
  if (!runs() || !slots()) return;
  for (Cycle end = slot_end(passed_); end <= now; end = slot_end(passed_)) {
    const int slot = slot_number(passed_), unused = 16 - bits();
    const auto i = static_cast<std::size_t>(index_);
    const bool sends = (tscon_ >> slot & 1) != 0;
    const auto sent = static_cast<std::uint16_t>(sends ? tx_shadow_[i] >> unused : 0);
    std::uint16_t received = f_.outside.dci_word(slot, sent, bits(), end);
    if (con1_ & kDloop) received = sent;
    if (rscon_ >> slot & 1) rx_shadow_[i] = static_cast<std::uint16_t>(received << unused);
    ++passed_;
    if (++index_ >= buffer_words()) {
      transfer();
      f_.interrupts.raise(irq::Dci, end);
    }
  }
}

void Dci::schedule() {
  Cycle at = kNever;
  if (runs() && slots()) at = slot_end(passed_ + std::max(1, buffer_words() - index_) - 1);
  f_.events.set(slot_, at);
}

void Dci::on_event(int /*id*/, Cycle at) {
  advance(at);
  schedule();
}

std::uint16_t Dci::read(unsigned address, Cycle now) {
  if (address >= kRx && address < kTx) stat_ &= static_cast<std::uint16_t>(~(kRful | kRov));
  return peek(address, now);
}

std::uint16_t Dci::peek(unsigned address, Cycle now) const {
  if (address >= kTx) return tx_[(address - kTx) / 2];
  if (address >= kRx) return rx_[(address - kRx) / 2];
  switch (address) {
    case kCon1:
      return con1_;
    case kCon2:
      return con2_;
    case kCon3:
      return con3_;
    case kStat:
      return static_cast<std::uint16_t>(stat_ | slot_in_progress(now) << kSlot.lowest);
    case kTscon:
      return tscon_;
    default:
      return rscon_;
  }
}

void Dci::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  // Words to send; then the control registers, which may switch it on or off.
  if (address >= kTx) {
    auto& word = tx_[(address - kTx) / 2];
    word = merge_lanes(word, value, lanes);
    written_ = true;
    stat_ &= static_cast<std::uint16_t>(~(kTmpty | kTunf));
    return;
  }
  if (address >= kRx || address == kStat) return;
  advance(now);
  const bool was_on = (con1_ & kDcien) != 0, ran = runs();
  std::uint16_t& word = address == kCon1    ? con1_
                        : address == kCon2  ? con2_
                        : address == kCon3  ? con3_
                        : address == kTscon ? tscon_
                                            : rscon_;
  const std::uint16_t before = word;
  word = merge_lanes(word, value, lanes);
  const bool on = (con1_ & kDcien) != 0;
  if (on && !was_on) {
    // what was loaded beforehand goes out in the first frame
    written_ = true;
    transfer();
    stat_ = kTmpty;
    for (const Pin pin : {kCsdo, kCsck, kCofs}) f_.ports.own_output(pin, true, now + 1);
    f_.ports.own_input(kCsdi, now + 1);
    start(now);
  } else if (!on && was_on) {
    stat_ = 0;
    for (const Pin pin : {kCsdi, kCsdo, kCsck, kCofs}) f_.ports.release(pin, now + 1);
  } else if (on && (word != before || ran != runs())) {
    start(now);  // another clock or frame begins anew
  }
  schedule();
}

Cycle Dci::horizon(unsigned address, Cycle now) const {
  if (!runs() || address < kStat || address == kTscon || address == kRscon || address >= kTx) return kNever;
  Cycle next = f_.events.when(slot_);
  if (address == kStat) {
    const Cycle word_end = now < first_ ? first_ : now + word() - (now - first_) % word();
    next = std::min(next, std::max(word_end, now + 1));
  }
  return next;
}

}  // namespace dspic
