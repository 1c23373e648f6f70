// SPDX-License-Identifier: MIT
// The two lines between one UART of the processor and the world, byte by byte.
//
//   the chip's transmitter -> put_on_wire() -> [ on its way ] -> UartEnd
//   UartEnd, inject() -> [ on its way ] -> take_from_wire() -> the chip's receiver
//
// One byte is 10 bits, of 16 (BRG + 1) cycles each.
// A byte's beginning and end are known when it begins. So nothing is ticked. Modelled: times, break, damage
// of the lines, bytes that come while the UART is off or that nobody takes: they are lost. Buffers, framing
// and interrupts are the chip's own (dspic30/periph/uart.h). Source: [DS70143 18].
#pragma once
#include <cstdint>
#include <deque>
#include <list>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/epuck_params.h"
#include "hal_sim/board/first_use.h"
#include "hal_sim/board/line_damage.h"
#include "hal_sim/board/uart_end.h"

namespace board {

/// Told of every byte that goes over a UART's two lines, as soon as it is known to come: for traces.
class UartWatch {
 public:
  virtual ~UartWatch() = default;
  /// UART 1 or 2; `sent` by the robot or received; from the start bit's beginning to the stop bit's end. A
  /// sent byte that a reset or a break cuts off was reported all the same.
  virtual void frame(int uart, bool sent, std::uint8_t byte, Cycle start, Cycle end) = 0;
};

class Uart {
 public:
  /// First byte or break that is sent, or an end that may send.
  FirstUse first_use;

  void reset(Cycle at);
  /// Behind reset(): nothing is on the wire.
  void begin_again(Cycle at);

  Cycle byte_cycles() const { return Cycle{kUartBitsPerByte} * kUartCyclesPerBrg * (brg_ + 1); }

  /// End of the next byte known to be on its way to the chip; kNever if none. What nobody has taken by `at`
  /// is lost.
  Cycle next_arrival(Cycle at);

  // --- outside
  void connect(std::shared_ptr<UartEnd> end) {
    end_ = std::move(end);
    if (!end_) return;
    end_->first_use = first_use;
    if (!end_->is_idle() || break_until_ >= 0) first_use.note();
  }
  UartEnd* end() const { return end_.get(); }
  /// Null: nobody looks. `number` is told back.
  void watch(UartWatch* watch, int number) {
    watch_ = watch;
    number_ = number;
  }
  /// What the robot sends is added to `heard` at the end of each tick, whoever else takes it.
  void listen(std::string* heard) { heard_.push_back(heard); }
  /// Tick boundary: what has left goes to the end; what has come starts on the wire, or waits outside until
  /// the UART is enabled.
  void exchange(Cycle at);
  /// Has exchange() nothing to do, now and until the program sends something or its end is idle no more?
  bool is_quiet() const {
    return (!end_ || (end_->is_idle() && break_until_ < 0)) && out_ends_.empty() && on_wire_.empty() &&
           injected_.empty();
  }
  /// Somebody puts these bytes on the line to the robot, behind what its end sends. They wait until the
  /// program has set the UART up.
  void inject(const std::string& bytes) {
    if (bytes.empty()) return;
    injected_.insert(injected_.end(), bytes.begin(), bytes.end());
    first_use.note();
  }
  /// Bytes of inject() that have begun to come, since power-up.
  std::int64_t injected() const { return injected_count_; }
  /// And those that wait.
  std::int64_t queued() const { return injected_count_ + static_cast<std::int64_t>(injected_.size()); }
  /// What is wrong with the line; null: nothing ever was. Made by the first damage().
  LineDamage& damage(std::uint64_t seed, int robot, int uart) {
    if (!damage_) damage_ = std::make_unique<LineDamage>(seed, robot, uart);
    return *damage_;
  }
  const LineDamage* damage() const { return damage_.get(); }
  /// Bytes that have begun to come to the robot, since power-up, however many it has looked at.
  std::int64_t came() const { return came_; }
  // --- a chip's own UART on the wire
  /// Follows the chip's switch and rate; bytes come in at that rate.
  void follow_chip(bool enabled, int brg) {
    enabled_ = enabled;
    brg_ = brg & 0xFFFF;
  }
  /// A byte leaves the chip, its stop bit over at `end`; not before the one before.
  void put_on_wire(std::uint8_t byte, Cycle start, Cycle end);
  /// The chip holds the line low until `end`.
  void break_on_wire(Cycle end);
  /// Does take_from_wire() have a byte?
  bool has_on_wire() const { return !on_wire_.empty(); }
  /// Takes the next byte that is on its way to the chip and says when its start bit begins. False: none is.
  bool take_from_wire(std::uint8_t& byte, Cycle& start);

  /// Bytes sent since power-up.
  std::int64_t sent() const { return sent_; }
  std::uint64_t state_hash() const { return hash_; }

 private:
  void cut_off(Cycle at);
  /// What should have been taken by `at` and was not.
  void lose_untaken(Cycle at);
  void hand_out(Cycle at);
  void begin_on_wire(std::uint8_t byte, Cycle at);

  struct Arrival {
    std::uint8_t byte;
    Cycle at;
  };

  bool enabled_ = false;
  int brg_ = kUart1Brg;

  Cycle free_at_ = 0;
  std::vector<std::uint8_t> out_bytes_;  // begun, not yet handed out
  std::vector<Cycle> out_ends_;
  std::int64_t sent_ = 0;

  std::unique_ptr<LineDamage> damage_;
  std::deque<char> injected_;  // not yet on the wire
  std::int64_t injected_count_ = 0, came_ = 0;
  std::list<Arrival> on_wire_;
  Cycle wire_free_at_ = 0;

  std::shared_ptr<UartEnd> end_;
  UartWatch* watch_ = nullptr;
  int number_ = 0;
  std::vector<std::string*> heard_;
  Cycle break_until_ = -1;
  std::uint64_t hash_ = 0;
};

}  // namespace board
