// SPDX-License-Identifier: MIT
// See uart.h.
#include "hal_sim/board/uart.h"

#include <algorithm>

#include "sim_core/base/hash.h"

namespace board {

void Uart::cut_off(Cycle at) {
  while (!out_ends_.empty() && out_ends_.back() > at) {
    out_ends_.pop_back();
    out_bytes_.pop_back();
  }
}

void Uart::reset(Cycle at) {
  lose_untaken(at);
  cut_off(at);  // a byte cut off by the reset never arrives
  enabled_ = false;
  free_at_ = at;
}

void Uart::begin_again(Cycle at) {
  reset(at);
  on_wire_.clear();
  wire_free_at_ = at;
  break_until_ = -1;
  injected_.clear();
  damage_.reset();
  if (end_) end_->begin_again();
}

void Uart::lose_untaken(Cycle at) {
  while (!on_wire_.empty() && on_wire_.front().at <= at) {
    const Arrival arrival = on_wire_.front();
    on_wire_.pop_front();
    if (!enabled_) continue;
    hash_ = sim::mix64(hash_ ^ (arrival.byte | static_cast<std::uint64_t>(arrival.at) << 8 | 1ull << 63));
  }
}

Cycle Uart::next_arrival(Cycle at) {
  lose_untaken(at);
  return on_wire_.empty() ? kNever : on_wire_.front().at;
}

void Uart::put_on_wire(std::uint8_t byte, Cycle start, Cycle end) {
  first_use.note();
  free_at_ = end;
  out_bytes_.push_back(byte);
  out_ends_.push_back(end);
  if (watch_) watch_->frame(number_, true, byte, start, end);
  ++sent_;
  hash_ = sim::mix64(hash_ ^ (byte | static_cast<std::uint64_t>(end) << 8));
}

void Uart::break_on_wire(Cycle end) {
  if (end_) first_use.note();
  free_at_ = break_until_ = end;
  hash_ = sim::mix64(hash_ ^ static_cast<std::uint64_t>(end));
}

bool Uart::take_from_wire(std::uint8_t& byte, Cycle& start) {
  if (on_wire_.empty()) return false;
  const Arrival arrival = on_wire_.front();
  on_wire_.pop_front();
  byte = arrival.byte;
  start = arrival.at - byte_cycles();
  hash_ = sim::mix64(hash_ ^ (arrival.byte | static_cast<std::uint64_t>(arrival.at) << 8 | 1ull << 63));
  return true;
}

void Uart::hand_out(Cycle at) {
  const std::size_t done =
      static_cast<std::size_t>(std::upper_bound(out_ends_.begin(), out_ends_.end(), at) - out_ends_.begin());
  if (done == 0) return;
  // a packet is full, too old, or followed by a pause
  if (end_ && end_->takes_packets() && free_at_ > at && done < kPacketBytes &&
      at - out_ends_.front() < kPacketCycles)
    return;
  const auto carried = [this](const std::uint8_t* bytes, const Cycle* ends, std::size_t count) {
    if (end_ && count > 0) end_->deliver(bytes, ends, count);
    for (std::string* heard : heard_) heard->append(reinterpret_cast<const char*>(bytes), count);
  };
  if (!damage_) {
    carried(out_bytes_.data(), out_ends_.data(), done);
  } else {
    std::vector<std::uint8_t> bytes;
    std::vector<Cycle> ends;
    for (std::size_t i = 0; i < done; ++i) {
      std::uint8_t byte = out_bytes_[i];
      if (!damage_->from_robot.carry(byte, out_ends_[i])) continue;
      bytes.push_back(byte);
      ends.push_back(out_ends_[i]);
    }
    carried(bytes.data(), ends.data(), bytes.size());
  }
  out_bytes_.erase(out_bytes_.begin(), out_bytes_.begin() + static_cast<std::ptrdiff_t>(done));
  out_ends_.erase(out_ends_.begin(), out_ends_.begin() + static_cast<std::ptrdiff_t>(done));
}

void Uart::exchange(Cycle at) {
  if (is_quiet()) return;
  if (break_until_ >= 0 && break_until_ <= at) {
    // what came before the break first
    hand_out(break_until_);
    if (end_) end_->on_break(break_until_);
    break_until_ = -1;
  }
  hand_out(at);
  lose_untaken(at);
  // before the program has set the UART up, nobody outside is made to talk to a deaf robot
  if (!enabled_) return;
  // only what the wire can carry soon is taken; the rest waits outside
  constexpr std::size_t kAhead = 64;
  // what is wrong with a line is found out as bytes begin: those of a damaged one begin when they are due
  constexpr std::size_t kDueSoon = 128;
  const auto may_begin = [&] {
    return on_wire_.size() < kAhead &&
           (!damage_ || wire_free_at_ - at < static_cast<Cycle>(kDueSoon) * byte_cycles());
  };
  while (end_ && may_begin()) {
    std::uint8_t bytes[kAhead];
    const std::size_t count = end_->collect(bytes, kAhead - on_wire_.size(), at);
    if (count == 0) break;
    for (std::size_t i = 0; i < count; ++i) begin_on_wire(bytes[i], at);
  }
  for (; !injected_.empty() && may_begin(); injected_.pop_front()) {
    ++injected_count_;
    begin_on_wire(static_cast<std::uint8_t>(injected_.front()), at);
  }
}

/// A byte comes to the robot as soon as the line is free.
void Uart::begin_on_wire(std::uint8_t byte, Cycle at) {
  wire_free_at_ = std::max(wire_free_at_, at) + byte_cycles();
  if (damage_ && !damage_->to_robot.carry(byte, wire_free_at_)) return;
  ++came_;
  on_wire_.push_back({byte, wire_free_at_});
  if (watch_) watch_->frame(number_, false, byte, wire_free_at_ - byte_cycles(), wire_free_at_);
}

}  // namespace board
