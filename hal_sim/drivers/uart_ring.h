// SPDX-License-Identifier: MIT
// The library's receive interrupt and the ring behind it, of one UART.
//
//   board::Uart --each byte--> ring of 64 --take()--> program
//
// Modelled: overwriting of unread bytes, 16-bit counters. Not modelled: the handler's time. Source: [lib:
// uart/], facts restated.
#pragma once
#include <array>
#include <cstdint>

#include "hal_sim/board/uart.h"
#include "hal_sim/drivers/driver_params.h"

namespace drivers {

class UartRing final : private board::UartReceiver {
 public:
  /// `uart` outlives this, and has no other receiver meanwhile.
  explicit UartRing(board::Uart& uart) : uart_(uart) { uart_.set_receiver(this); }
  ~UartRing() override { uart_.set_receiver(nullptr); }
  UartRing(const UartRing&) = delete;
  UartRing& operator=(const UartRing&) = delete;

  /// e_init_uartN(): the UART is enabled at BRG `brg`, the ring empty.
  void init(int brg, Cycle at) {
    uart_.switch_on(brg, at);
    reset();
    is_on_ = true;
  }
  /// After the UART's own reset.
  void reset() {
    is_on_ = false;
    received_ = read_ = 0;
  }
  /// Bytes received minus bytes read, as a 16-bit difference.
  int unread(Cycle at) {
    uart_.settle(at);
    return static_cast<std::int16_t>(received_ - read_);
  }
  /// The next byte, or -1.
  int take(Cycle at) {
    uart_.settle(at);
    return received_ == read_ ? -1 : ring_[read_++ % kUartRingBytes];
  }

 private:
  void take(std::uint8_t byte) override {
    if (is_on_) ring_[received_++ % kUartRingBytes] = byte;
  }

  board::Uart& uart_;
  std::array<std::uint8_t, kUartRingBytes> ring_{};
  std::uint16_t received_ = 0, read_ = 0;
  bool is_on_ = false;
};

}  // namespace drivers
