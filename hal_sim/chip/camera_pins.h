// SPDX-License-Identifier: MIT
// The camera's clock and data pins (board/wiring.h) for a processor that takes pictures by itself.
//
//   VSYNC  _|~|______________________________________|~|___     one frame
//   HREF   ______|~~~~~~|__|~~~~~~|__ ... |~~~~~~|_________     one line each, its bytes while it is high
//
// All edges are closed forms of the sensor's clock, so nothing is ticked; a picture is rendered when its data
// pins are read, lines at once. Modelled: frame, line and byte periods of the sensor's registers, the byte on
// the pins at any cycle; which pictures the program made of what it read of a frame. Not modelled: VSYNC's
// true width (half a line here), set-up times, the data between lines (0). Rendered lines are complete.
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/board.h"

namespace chip {

using board::Cycle;

class CameraPins {
 public:
  enum Bit {
    Href = board::kCameraHrefPin.bit,
    Vsync = board::kCameraVsyncPin.bit,
    Pclk = board::kCameraClockPin.bit
  };

  explicit CameraPins(board::Board& board) : board_(board) {}

  static bool has(int bit) { return bit == Href || bit == Vsync || bit == Pclk; }
  /// Levels of the three pins of port C.
  std::uint16_t levels(Cycle at);
  /// Byte on the data pins.
  std::uint8_t data(Cycle at);
  /// First change of HREF or VSYNC after `after`, or of the pixel clock; kNever without a camera.
  Cycle horizon(std::uint16_t pins, Cycle after);
  Cycle next_byte(Cycle after);
  std::int64_t edges(int bit, bool rising, Cycle after, Cycle until);
  Cycle nth_edge(int bit, bool rising, Cycle after, std::int64_t n);
  /// The sensor's registers or the length of its frames have changed since the last call: edges told before
  /// are not true any more.
  bool take_news();
  /// Would take_news() say so?
  bool has_news() const;
  /// The window ends: a frame of which the program read may be over, and what it got is a picture.
  void end_window(Cycle at) {
    if (captured_ >= 0 && at >= captured_ + f_.length && !lines_.empty()) finish_picture();
  }

 private:
  struct Frames {
    Cycle start = 0, length = 1;
    Cycle first = 0, line = 1;  // HREF of line 0 after the frame's start; between two lines
    Cycle high = 0;             // HREF is high
    std::int64_t lines = 0, bytes = 0;
    Cycle byte_half_cycles = 16;
  };
  /// Edges at or before `at`, counted from Frames::start.
  std::int64_t count(int bit, bool rising, Cycle at) const;
  Cycle instant(int bit, bool rising, std::int64_t index) const;
  bool refresh(Cycle at);
  void note_read(std::int64_t line, std::int64_t index, std::uint8_t byte, Cycle at);
  void finish_picture();

  board::Board& board_;
  Frames f_;
  std::uint64_t timing_ = UINT64_MAX;  // Camera::timing() that f_ is of
  Cycle told_start_ = -1, told_length_ = -1;
  Cycle captured_ = -1;  // start of the frame that the camera was asked for
  std::int64_t line_ = -1;
  std::vector<std::uint8_t> bytes_;
  // what was read of that frame
  struct Read {
    std::int64_t line = 0, first = 0, last = 0;  // bytes
    int columns = 0;                             // pixels
    std::vector<std::uint8_t> bytes;
  };
  std::vector<Read> lines_;
  Cycle read_at_ = 0;
};

}  // namespace chip
