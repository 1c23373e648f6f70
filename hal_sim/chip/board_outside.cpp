// SPDX-License-Identifier: MIT
// Pins: board/wiring.h.
#include "hal_sim/chip/board_outside.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "dspic30/device/chip_parts.h"
#include "dspic30/memory/sfr_table.h"

namespace chip {

namespace {

using board::Board;
using board::Pins;
using dspic::Port;
using dspic::sfr;

static_assert(board::kPorts == dspic::kPorts);  // both in the order of their letters
// a serial line that nobody drives is high
constexpr const board::PortWiring &kWiredC = board::kWiring[board::kC], &kWiredD = board::kWiring[board::kD],
                                  &kWiredF = board::kWiring[board::kF], &kWiredG = board::kWiring[board::kG];
constexpr std::uint16_t kGivenF = kWiredF.serial_in | kWiredF.battery_good | kWiredF.remote,
                        kGivenG = kWiredG.selector | kWiredG.i2c;

constexpr unsigned kDciCon3 = sfr("DCICON3");
constexpr double kCodecRateTolerance = 0.01;

std::string hertz(double rate) { return std::to_string(std::lround(rate)); }

}  // namespace

BoardOutside::BoardOutside(Board& board) : board_(board), selector_(board.selector()), camera_(board) {
  tris_.fill(0xFFFF);
}

bool BoardOutside::may_have_news() const {
  return board_.has_wire_news() || selector_ != board_.selector() || pins_changed_ != pins_changed() ||
         (asks_camera_ && camera_.has_news());
}

bool BoardOutside::begin_window(dspic::Dspic30f6014a& chip, Cycle now) {
  bool news = false;
  if (board_.take_wire_news()) {
    for (int n = 1; n <= 2; ++n) {
      board::Uart& uart = board_.uart(n);
      dspic::UartFrame frame;
      std::uint8_t byte = 0;
      while (uart.take_from_wire(byte, frame.start)) {
        frame.word = byte;
        frame.bit = uart.byte_cycles() / board::kUartBitsPerByte;
        chip.uart_receive(n, frame, now);
        news = true;
      }
    }
  }
  const bool camera_is_new = asks_camera_ && camera_.take_news();
  asks_camera_ = false;
  if (selector_ != board_.selector() || camera_is_new || pins_changed_ != pins_changed()) {
    selector_ = board_.selector();
    pins_changed_ = pins_changed();
    chip.outside_changed(now);
    news = true;
  }
  return news;
}

void BoardOutside::end_window(dspic::Dspic30f6014a& chip, Cycle now) {
  if (const std::int64_t writes = chip.parts().bus.writes(); writes != followed_writes_) {
    followed_writes_ = writes;
    for (int n = 1; n <= 2; ++n) {
      const dspic::Uart& own = chip.parts().uarts[static_cast<std::size_t>(n - 1)];
      board_.uart(n).follow_chip(own.enabled(), own.brg());
    }
  }
  if (takes_pictures_) camera_.end_window(now);
  if (sends_sound_ && board_.codec().line().take_activity()) follow_codec(chip, now);
}

// --- pins

void BoardOutside::pins_driven(Port port, std::uint16_t levels, std::uint16_t driven,
                               std::uint16_t by_peripheral, Cycle at) {
  const auto p = static_cast<std::size_t>(port);
  const char letter = dspic::kPortLetters[p];
  // serial lines are followed word by word; the board sees them as pins that nobody drives
  const std::uint16_t serial = port == Port::D ? 0 : by_peripheral;
  const auto tris = static_cast<std::uint16_t>(~(driven & ~serial));
  const auto lat = static_cast<std::uint16_t>(levels & ~serial);
  if (tris != tris_[p] || lat != levels_[p])
    digest_.note(EventDigest::Kind::Pins,
                 static_cast<std::uint64_t>(p) << 32 | static_cast<std::uint64_t>(tris) << 16 | lat, at);
  // directions first: coils that are switched on together with their pins pull the rotor
  if (tris != tris_[p]) board_.pins().write(letter, Pins::Register::Tris, tris, at);
  if (lat != levels_[p]) board_.pins().write(letter, Pins::Register::Lat, on_board(port, lat, at), at);
  tris_[p] = tris;
  levels_[p] = lat;
  if (port != Port::F) return;
  const auto low = static_cast<std::uint16_t>(driven & ~by_peripheral & ~levels & kWiredF.serial_out);
  if (low != low_lines_) follow_breaks(low, at);
}

/// What a latch does to the board.
std::uint16_t BoardOutside::on_board(Port port, std::uint16_t lat, Cycle at) {
  if (port != Port::D || !shares_coils_) return lat;
  const auto kept =
      static_cast<std::uint16_t>(kWiredD.coils & ~(lat ^ levels_[static_cast<std::size_t>(port)]));
  return static_cast<std::uint16_t>((lat & ~kept) |
                                    (board_.pins().read('D', Pins::Register::Lat, at) & kept));
}

// a port that holds the line low where its module has let go: whoever listens takes more
// than a word for a break
void BoardOutside::follow_breaks(std::uint16_t low, Cycle at) {
  low_lines_ = low;
  for (int n = 1; n <= 2; ++n) {
    Cycle& since = low_since_[static_cast<std::size_t>(n - 1)];
    const bool is_low = (low & board::kUartOutPins[n - 1].mask()) != 0;
    if (is_low == (since >= 0)) continue;
    if (!is_low && at - since > board_.uart(n).byte_cycles()) board_.uart(n).break_on_wire(at);
    since = is_low ? at : -1;
  }
}

dspic::PinLevels BoardOutside::pin_levels(Port port, Cycle at) {
  switch (port) {
    case Port::A:
      return {board_.pins().given(board::kA, at), board_.pins().held(board::kA)};
    case Port::C: {
      asks_camera_ = true;
      const unsigned held = board_.pins().held(board::kC),
                     camera = board_.camera() ? kWiredC.camera & ~held : 0u;
      return {static_cast<std::uint16_t>((camera_.levels(at) & camera) |
                                         (board_.pins().given(board::kC, at) & held)),
              static_cast<std::uint16_t>(camera | held)};
    }
    case Port::D:
      asks_camera_ = takes_pictures_ = true;
      return {static_cast<std::uint16_t>(camera_.data(at) << board::kCameraDataBit),
              board_.camera() ? kWiredD.camera : std::uint16_t{0}};
    case Port::F:
      return {board_.pins().given(board::kF, at), kGivenF};
    case Port::G:
      return {board_.pins().given(board::kG, at), kGivenG};
    default:
      return {};
  }
}

Cycle BoardOutside::levels_horizon(Port port, std::uint16_t pins, Cycle after) {
  switch (port) {
    case Port::C:
      asks_camera_ = true;
      return camera_.horizon(pins, after);
    case Port::D:
      asks_camera_ = true;
      return pins & board::kCameraData ? camera_.next_byte(after) : dspic::kNever;
    case Port::F:
      return board_.pins().given_horizon(board::kF, after);
    default:
      return dspic::kNever;
  }
}

bool BoardOutside::take_edge(dspic::Pin pin, dspic::Edge edge) {
  const auto of = [&](board::Port port) {
    return board_.pins().take_edge(port, pin.bit, edge == dspic::Edge::Rising);
  };
  return pin.port == Port::A ? of(board::kA) : pin.port == Port::F && of(board::kF);
}

std::int64_t BoardOutside::edges(dspic::Pin pin, dspic::Edge edge, Cycle after, Cycle until) {
  if (pin.port == Port::C) {
    asks_camera_ = true;
    return CameraPins::has(pin.bit) ? camera_.edges(pin.bit, edge == dspic::Edge::Rising, after, until) : 0;
  }
  if (pin.port == Port::D) return 0;
  return Outside::edges(pin, edge, after, until);
}

Cycle BoardOutside::nth_edge(dspic::Pin pin, dspic::Edge edge, Cycle after, std::int64_t n) {
  if (pin.port == Port::C) {
    asks_camera_ = true;
    return CameraPins::has(pin.bit) ? camera_.nth_edge(pin.bit, edge == dspic::Edge::Rising, after, n)
                                    : dspic::kNever;
  }
  if (pin.port == Port::F && board_.damage() && (board_.damage()->held_pins[board::kF] >> pin.bit & 1))
    return dspic::kNever;
  if (pin.port == Port::F && pin.bit == board::kRemotePin.bit && n == 1)
    return board_.remote().next_edge(after, edge == dspic::Edge::Falling);
  if (pin.port == Port::D) return dspic::kNever;
  return Outside::nth_edge(pin, edge, after, n);
}

// --- analogue, serial

int BoardOutside::analogue_counts(int channel, Cycle at) {
  if (channel >= board::kMicChannel && channel < board::kAccChannel)
    return board_.ears().counts(channel - board::kMicChannel, at);
  return beside_microphones(channel, at);
}

int BoardOutside::beside_microphones(int channel, Cycle at) {
  const Cycle lit_for =
      channel >= board::kIrChannel ? board_.ir().lit_for(channel - board::kIrChannel, at) : -1;
  return std::max(0, board_.inputs().counts(channel, at, lit_for));
}

void BoardOutside::uart_sent(int uart, const dspic::UartFrame& frame) {
  const Cycle end = frame.end();
  digest_.note(EventDigest::Kind::UartFrame,
               static_cast<std::uint64_t>(uart) << 32 | (frame.broken ? 1u << 16 : 0u) | frame.word, end);
  if (frame.broken)
    board_.uart(uart).break_on_wire(end);
  else
    board_.uart(uart).put_on_wire(static_cast<std::uint8_t>(frame.word), frame.start, end);
}

void BoardOutside::i2c_start(bool repeated, Cycle at) {
  digest_.note(EventDigest::Kind::I2c, repeated ? 0x101 : 0x100, at);
  board_.i2c().start(at, repeated);
}

dspic::I2cReply BoardOutside::i2c_write(std::uint8_t byte, Cycle at) {
  digest_.note(EventDigest::Kind::I2c, byte, at);
  asks_camera_ = true;  // it may be for its registers
  return {board_.i2c().write(byte, at), 0xFF, 0};
}

dspic::I2cReply BoardOutside::i2c_read(Cycle at) {
  const std::uint8_t byte = board_.i2c().read(at);
  digest_.note(EventDigest::Kind::I2c, 0x200u | byte, at);
  return {true, byte, 0};
}

void BoardOutside::i2c_stop(Cycle at) {
  digest_.note(EventDigest::Kind::I2c, 0x102, at);
  asks_camera_ = true;
  board_.i2c().stop(at);
}

// --- codec

// the codec looks at the word that begins a frame; those of other slots are for other devices on the line
std::uint16_t BoardOutside::dci_word(int slot, std::uint16_t transmitted, int bits, Cycle end) {
  if (slot != 0) return 0;
  sends_sound_ = true;
  const auto word = static_cast<std::uint16_t>(transmitted << (16 - bits));
  if (word != 0) digest_.note(EventDigest::Kind::CodecWord, word, end);
  return static_cast<std::uint16_t>(board_.codec().line().word(word, end) >> (16 - bits));
}

void BoardOutside::follow_codec(dspic::Dspic30f6014a& chip, Cycle now) {
  board::CodecLine& line = board_.codec().line();
  line.set_bit_clock(2 * (Cycle{chip.peek(kDciCon3, now) & 0x0FFF} + 1));
  if (!line.is_heard()) return;
  const double by_registers = line.register_rate_hz(), by_frames = line.frame_rate_hz();
  if (by_frames <= 0 || std::abs(by_registers - by_frames) <= kCodecRateTolerance * by_frames) return;
  chip.diagnostics().report(dspic::Cause::CodecRate, "codec",
                            "codec: its registers 3 and 4 and the bit clock give " + hertz(by_registers) +
                                " samples a second, frames come " + hertz(by_frames) + " times a second",
                            now);
}

}  // namespace chip
