// SPDX-License-Identifier: MIT
#include "dspic30/periph/external_interrupts.h"

#include <algorithm>

namespace dspic {

namespace {

constexpr Pin kPins[] = {{Port::F, 6}, {Port::A, 12}, {Port::A, 13}, {Port::A, 14}, {Port::A, 15}};
constexpr int kFlags[] = {irq::Int0, irq::Int1, irq::Int2, irq::Int3, irq::Int4};
constexpr Cycle kEdgeToFlag = 2;  // synchroniser, then the flag [?]

constexpr unsigned kCnen1 = sfr("CNEN1"), kCnpu1 = sfr("CNPU1"), kCnpu2 = sfr("CNPU2");
constexpr Pin kCnPins[] = {{Port::C, 14}, {Port::C, 13}, {Port::B, 0},  {Port::B, 1}, {Port::B, 2},
                           {Port::B, 3},  {Port::B, 4},  {Port::B, 5},  {Port::G, 6}, {Port::G, 7},
                           {Port::G, 8},  {Port::G, 9},  {Port::B, 15}, {Port::D, 4}, {Port::D, 5},
                           {Port::D, 6},  {Port::D, 7},  {Port::F, 4},  {Port::F, 5}, {Port::D, 13},
                           {Port::D, 14}, {Port::D, 15}, {Port::A, 6},  {Port::A, 7}};
constexpr int kCnInputs = 24;  // [DS70286C], the 80-pin chip of the same layout

}  // namespace

void ExternalInterrupts::attach() {
  for (int n = 0; n < kLines; ++n) {
    std::uint64_t flags = std::uint64_t{1} << kFlags[n];
    if (n == 0) flags |= std::uint64_t{1} << irq::Adc;
    slots_[static_cast<std::size_t>(n)] = f_.events.add(*this, n, flags, false);
    f_.interrupts.listeners().listen(kFlags[n], *this);
    f_.ports.watch(kPins[n], *this);
  }
}

void ExternalInterrupts::reset(Cycle now) {
  own_flag_.fill(kNever);
  seen_.fill(now);
  adc_waits_ = false;
  for (int n = 0; n < kLines; ++n) schedule(n, now);
}

void ExternalInterrupts::schedule(int n, Cycle now) {
  const auto i = static_cast<std::size_t>(n);
  Cycle at = own_flag_[i];
  if (!f_.interrupts.sources().flag(kFlags[n]) || (n == 0 && adc_waits_)) {
    const Cycle next = f_.ports.nth_edge(kPins[n], edge(n), seen_[i], 1);
    if (next < kNever) at = std::min(at, std::max(next + kEdgeToFlag, now));
  }
  f_.events.set(slots_[i], at);
}

void ExternalInterrupts::on_event(int id, Cycle at) {
  const auto i = static_cast<std::size_t>(id);
  if (own_flag_[i] <= at) own_flag_[i] = kNever;
  seen_[i] = std::max(seen_[i], at - kEdgeToFlag);
  if (id == 0) adc_.int0_edge(at);
  f_.interrupts.raise(kFlags[id], at);
  schedule(id, at);
}

void ExternalInterrupts::flag_cleared(int irq, Cycle now) {
  for (int n = 0; n < kLines; ++n) {
    if (kFlags[n] != irq) continue;
    const auto i = static_cast<std::size_t>(n);
    const Cycle until = now - kEdgeToFlag;
    if (until > seen_[i]) {
      if (f_.interrupts.sources().enabled(irq))
        f_.interrupts.note_missed(irq, f_.ports.edges(kPins[n], edge(n), seen_[i], until), now);
      seen_[i] = until;
    }
    schedule(n, now);
  }
}

// what lies further back than the synchroniser has been dealt with
void ExternalInterrupts::forget_before(int n, Cycle now) {
  auto& seen = seen_[static_cast<std::size_t>(n)];
  seen = std::max(seen, now - kEdgeToFlag);
}

void ExternalInterrupts::edge_chosen(int irq, Cycle now) {
  for (int n = 0; n < kLines; ++n) {
    if (kFlags[n] != irq) continue;
    forget_before(n, now);
    schedule(n, now);
  }
}

void ExternalInterrupts::own_edge(Pin pin, Edge made, Cycle at) {
  for (int n = 0; n < kLines; ++n) {
    if (kPins[n].port != pin.port || kPins[n].bit != pin.bit || made != edge(n)) continue;
    own_flag_[static_cast<std::size_t>(n)] = at + kEdgeToFlag;
    schedule(n, at);
  }
}

void ExternalInterrupts::converter_changed(Cycle now) {
  const bool waits = adc_.wants_int0();
  if (waits == adc_waits_) return;
  adc_waits_ = waits;
  if (waits) forget_before(0, now);
  schedule(0, now);
}

void ExternalInterrupts::outside_changed(Cycle now) {
  for (int n = 0; n < kLines; ++n) {
    if (!f_.interrupts.sources().flag(kFlags[n])) forget_before(n, now);
    const bool rose = f_.outside.take_edge(kPins[n], Edge::Rising),
               fell = f_.outside.take_edge(kPins[n], Edge::Falling);
    if (edge(n) == Edge::Rising ? rose : fell) own_flag_[static_cast<std::size_t>(n)] = now + kEdgeToFlag;
    schedule(n, now);
  }
}

// --- change notification

void ChangeNotification::attach() {
  f_.bus.attach(*this, kCnen1, kCnpu2);
  enum : int { Change, Flag };
  slot_ = f_.events.add(*this, Change, std::uint64_t{1} << irq::Cn, false);
  flag_slot_ = f_.events.add(*this, Flag, std::uint64_t{1} << irq::Cn, false);
  for (const Pin pin : kCnPins) f_.ports.watch(pin, *this);
}

void ChangeNotification::reset(Cycle /*now*/) {
  enabled_ = pull_ups_ = 0;
  levels_.fill(0);
  f_.ports.set_hearing(*this, false);
  f_.events.set(slot_, kNever);
  f_.events.set(flag_slot_, kNever);
}

std::uint16_t ChangeNotification::watched(Port port) const {
  std::uint16_t mask = 0;
  for (int n = 0; n < kCnInputs; ++n)
    if ((enabled_ >> n & 1) && kCnPins[n].port == port)
      mask |= static_cast<std::uint16_t>(1 << kCnPins[n].bit);
  return mask;
}

void ChangeNotification::schedule(Cycle now) {
  Cycle next = kNever;
  if (enabled_)
    for (int p = 0; p < kPorts; ++p)
      if (const std::uint16_t pins = watched(static_cast<Port>(p)))
        next = std::min(next, f_.outside.levels_horizon(static_cast<Port>(p), pins, now));
  f_.events.set(slot_, next);
}

void ChangeNotification::compare(Cycle at) {
  if (!enabled_) return;
  bool differs = false;
  for (int p = 0; p < kPorts; ++p) {
    const auto port = static_cast<Port>(p);
    const std::uint16_t mask = watched(port);
    if (!mask) continue;
    const std::uint16_t levels = f_.ports.pins(port, at);
    auto& before = levels_[static_cast<std::size_t>(p)];
    // a pin that has moved, and now differs from what the program knows
    if ((levels ^ before) & (levels ^ f_.ports.last_read(port)) & mask) differs = true;
    before = levels;
  }
  if (differs) f_.events.set(flag_slot_, at + kEdgeToFlag);
}

void ChangeNotification::on_event(int id, Cycle at) {
  if (id == 1) return f_.interrupts.raise(irq::Cn, at);
  compare(at);
  schedule(at);
}

void ChangeNotification::own_edge(Pin /*pin*/, Edge /*edge*/, Cycle at) { compare(at); }

void ChangeNotification::outside_changed(Cycle now) {
  compare(now);
  schedule(now);
}

std::uint16_t ChangeNotification::peek(unsigned address, Cycle /*now*/) const {
  const std::uint32_t word = address >= kCnpu1 ? pull_ups_ : enabled_;
  return static_cast<std::uint16_t>((address & 2) ? word >> 16 : word);
}

void ChangeNotification::write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) {
  const int shift = (address & 2) ? 16 : 0;
  std::uint32_t& word = address >= kCnpu1 ? pull_ups_ : enabled_;
  const std::uint32_t mask = std::uint32_t{lanes} << shift;
  const std::uint32_t before = word;
  word = (word & ~mask) | ((std::uint32_t{value} << shift) & mask);
  if (address >= kCnpu1) {
    std::array<std::uint16_t, kPorts> pull{};
    for (int n = 0; n < kCnInputs; ++n)
      if (pull_ups_ >> n & 1)
        pull[static_cast<std::size_t>(kCnPins[n].port)] |= static_cast<std::uint16_t>(1 << kCnPins[n].bit);
    for (int p = 0; p < kPorts; ++p)
      f_.ports.set_pull_ups(static_cast<Port>(p), pull[static_cast<std::size_t>(p)]);
    return;
  }
  f_.ports.set_hearing(*this, enabled_ != 0);
  // a newly watched pin starts from its present level
  for (int n = 0; n < kCnInputs; ++n)
    if ((enabled_ & ~before) >> n & 1) {
      const Port port = kCnPins[n].port;
      f_.ports.note_read(port, now);
      levels_[static_cast<std::size_t>(port)] = f_.ports.pins(port, now);
    }
  schedule(now);
}

}  // namespace dspic
