// SPDX-License-Identifier: MIT
// UART 1 or 2: UxMODE, UxSTA, UxTXREG, UxRXREG, UxBRG.
//
//   UxTXREG -> FIFO of 4 -> shift register -> TX       RX -> shift register -> FIFO of 4 -> UxRXREG
//
// Modelled: 8 and 9 bits, parity, stop bits, both FIFOs, TXIF and RXIF in all modes, TRMT, UTXBF, RIDLE, OERR
// with a blocked receiver, PERR and FERR per word, address detection, break both ways, loop-back, alternate
// pins. A word on the line is sampled in the middle of the receiver's own bits, so wrong rates and formats
// are received as on the chip. WAKE wakes with the byte, not with its start edge. Not modelled: ABAUD, USIDL,
// a second start edge inside one word's frame, breaking off a word that is on its way out. Source: [chip P5],
// frame errors with two stop bits [DS70150E 18.5.2], effect of UARTEN = 0 on UxSTA and of LPBACK on TX
// [assumed: as remembered of the family manual]; [?] phase of the first start bit, TXIF when UTXEN is set.
#pragma once
#include <array>
#include <cstdint>
#include <list>

#include "dspic30/periph/ports.h"

namespace dspic {

class Uart final : public SfrOwner, public EventOwner {
 public:
  Uart(const Fabric& fabric, int number);
  void attach();
  void reset(Cycle now);
  /// A word comes in; frame.start may lie in the future.
  void receive(const UartFrame& frame, Cycle now);
  std::int64_t overruns() const { return overruns_; }
  std::uint64_t state_hash() const;
  static constexpr std::uint16_t kOn = sfr_bits("U1MODE", "UARTEN"), kSends = sfr_bits("U1STA", "UTXEN"),
                                 kOverrun = sfr_bits("U1STA", "OERR");
  bool enabled() const { return (mode_ & kOn) != 0; }
  std::uint16_t brg() const { return brg_; }
  bool transmits() const { return enabled() && (sta_ & kSends); }
  /// Words that follow one another on the line are put there when somebody looks, or something comes of it:
  /// up to `now` all are.
  void advance(Cycle now) {
    if (next_move_ <= now) move_up_to(now);
  }
  /// A write of UxTXREG that nothing comes of before another one, or loaded(): a word is on its way out until
  /// then, and there is room.
  void load(std::uint16_t word) { out_.push(word & kWordBits); }
  void loaded() { schedule_transmit(0); }
  // --- behind advance():
  /// When the word that is being sent is over; in the past: none is.
  Cycle busy_until() const { return break_since_ < 0 ? busy_until_ : 0; }
  /// UTXBF is 0; words that it has room for; URXDA; OERR.
  bool has_room() const { return !out_.full(); }
  unsigned room() const { return static_cast<unsigned>(kFifoWords - out_.count); }
  bool has_received() const { return in_.count > 0; }
  bool has_overrun() const { return (sta_ & kOverrun) != 0; }

  std::uint16_t read(unsigned address, Cycle now) override;
  void write(unsigned address, std::uint16_t value, std::uint16_t lanes, Cycle now) override;
  std::uint16_t peek(unsigned address, Cycle now) const override;
  Cycle horizon(unsigned address, Cycle now) const override;
  void on_event(int id, Cycle at) override;

 private:
  static constexpr std::size_t kFifoWords = 4;
  struct Received {
    std::uint16_t word;
    bool parity_error, frame_error;
  };
  template <class T>
  struct Fifo {
    std::array<T, kFifoWords> words{};
    std::size_t count = 0;
    bool full() const { return count == kFifoWords; }
    void push(T w) { words[count++] = w; }
    T pop() {
      T first = words[0];
      for (std::size_t i = 1; i < count; ++i) words[i - 1] = words[i];
      --count;
      return first;
    }
  };
  static constexpr std::uint16_t kWordBits = 0x1FF;  // of a word in the FIFO
  enum : int { Transmit, TransmitLast, Receive };

  Cycle sixteenth() const { return Cycle{brg_} + 1; }
  Cycle bit() const { return 16 * sixteenth(); }
  Cycle align(Cycle at) const;
  UartFrame format(std::uint16_t word, Cycle start) const;
  Cycle transfer_time(const UartFrame& frame) const;
  void move_up_to(Cycle now);
  void schedule_transmit(Cycle now);
  Cycle move_behind(Cycle at) const;
  void set_transmit_event();
  void begin_break(Cycle now);
  void end_break(Cycle now);
  void schedule_receive(Cycle now);
  void enqueue(UartFrame frame, Cycle now);
  void take_in(const UartFrame& frame, Cycle at);
  void set_enabled(bool on, Cycle now);
  void own_pins(Cycle at);
  void check_rate(Cycle at);
  void tell_full(Cycle now);
  std::string name(const char* suffix) const;

  const Fabric& f_;
  int number_;
  unsigned base_;
  int tx_irq_, rx_irq_;
  int slot_tx_ = -1, slot_last_ = -1, slot_rx_ = -1;
  std::uint16_t mode_ = 0, brg_ = 0;
  std::uint16_t sta_ = 0;  // control bits and OERR; the rest is worked out
  Cycle epoch_ = 0;        // of the baud counter
  Fifo<std::uint16_t> out_;
  Cycle busy_until_ = 0;      // the shift register
  Cycle next_move_ = kNever;  // of the FIFO's first word to there
  Cycle break_since_ = -1;
  Fifo<Received> in_;
  std::list<UartFrame> line_;  // to come, or under way
  Cycle line_free_ = 0;
  bool rate_checked_ = false;
  std::int64_t overruns_ = 0;
};

}  // namespace dspic
