// SPDX-License-Identifier: MIT
#include "hal_sim/chip/camera_pins.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "hal_sim/board/camera_params.h"

namespace chip {

namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }
std::int64_t ceil_div(std::int64_t a, std::int64_t b) { return -floor_div(-a, b); }

}  // namespace

bool CameraPins::refresh(Cycle at) {
  board::Camera* camera = board_.camera();
  if (!camera) return false;
  if (camera->timing() == timing_) return true;
  timing_ = camera->timing();
  const Cycle origin = camera->frame_origin(at);
  const Cycle length = camera->frame_cycles();
  const board::SensorSetup setup = camera->setup();
  f_.start = origin;
  f_.length = length;
  f_.line = Cycle{setup.sub_sampling} * setup.line_cycles();
  f_.first = f_.line;
  f_.lines = (board::kArrayHeight - setup.first_y) / setup.sub_sampling;
  f_.bytes = std::int64_t{board::kArrayWidth / setup.sub_sampling} * setup.bytes_per_pixel();
  f_.byte_half_cycles = setup.byte_half_cycles;
  f_.high = std::min(f_.line - 1, ceil_div(f_.bytes * f_.byte_half_cycles, 2));
  f_.lines = std::min(f_.lines, (f_.length - f_.first) / f_.line);
  return true;
}

bool CameraPins::has_news() const {
  return f_.lines != 0 && (f_.start != told_start_ || f_.length != told_length_ ||
                           (board_.camera() && board_.camera()->timing() != timing_));
}

bool CameraPins::take_news() {
  if (f_.lines == 0) return false;  // nobody has asked
  refresh(f_.start);
  const bool news = f_.start != told_start_ || f_.length != told_length_;
  told_start_ = f_.start;
  told_length_ = f_.length;
  return news;
}

// --- edges

std::int64_t CameraPins::count(int bit, bool rising, Cycle at) const {
  const std::int64_t frame = floor_div(at - f_.start, f_.length);
  const Cycle phase = at - f_.start - frame * f_.length;
  if (bit == Vsync) return frame + (rising || phase >= f_.line / 2 ? 1 : 0);
  const Cycle in_lines = phase - f_.first - (bit == Href && !rising ? f_.high : 0);
  if (bit == Href)
    return frame * f_.lines + std::clamp<std::int64_t>(floor_div(in_lines, f_.line) + 1, 0, f_.lines);
  const std::int64_t line = std::clamp<std::int64_t>(floor_div(in_lines, f_.line), -1, f_.lines - 1);
  std::int64_t here = 0;
  if (line >= 0) {
    const Cycle r = in_lines - line * f_.line;
    const std::int64_t half = rising ? 1 : 2;  // in halves of a byte
    here = line * f_.bytes +
           std::clamp<std::int64_t>(
               floor_div(4 * r - half * f_.byte_half_cycles, 2 * f_.byte_half_cycles) + 1, 0, f_.bytes);
  }
  return frame * f_.lines * f_.bytes + here;
}

Cycle CameraPins::instant(int bit, bool rising, std::int64_t index) const {
  if (bit == Vsync) return f_.start + index * f_.length + (rising ? 0 : f_.line / 2);
  const std::int64_t a_frame = bit == Href ? f_.lines : f_.lines * f_.bytes;
  const std::int64_t frame = floor_div(index, a_frame);
  const std::int64_t rest = index - frame * a_frame;
  const Cycle lines_from = f_.start + frame * f_.length + f_.first;
  if (bit == Href) return lines_from + rest * f_.line + (rising ? 0 : f_.high);
  const std::int64_t line = rest / f_.bytes, byte = rest % f_.bytes;
  return lines_from + line * f_.line + ceil_div((2 * byte + (rising ? 1 : 2)) * f_.byte_half_cycles, 4);
}

std::int64_t CameraPins::edges(int bit, bool rising, Cycle after, Cycle until) {
  if (!refresh(after)) return 0;
  return count(bit, rising, until) - count(bit, rising, after);
}

Cycle CameraPins::nth_edge(int bit, bool rising, Cycle after, std::int64_t n) {
  if (!refresh(after)) return board::kNever;
  return instant(bit, rising, count(bit, rising, after) + n - 1);
}

Cycle CameraPins::horizon(std::uint16_t pins, Cycle after) {
  Cycle next = board::kNever;
  for (const int bit : {Href, Vsync, Pclk})
    if (pins >> bit & 1)
      for (const bool rising : {false, true}) next = std::min(next, nth_edge(bit, rising, after, 1));
  return next;
}

Cycle CameraPins::next_byte(Cycle after) {
  if (!refresh(after)) return board::kNever;
  return std::min(nth_edge(Href, true, after, 1), nth_edge(Pclk, false, after, 1));
}

// --- levels

std::uint16_t CameraPins::levels(Cycle at) {
  if (!refresh(at)) return 0;
  std::uint16_t word = 0;
  for (const int bit : {Href, Vsync, Pclk})
    if (count(bit, true, at) > count(bit, false, at)) word |= static_cast<std::uint16_t>(1 << bit);
  return word;
}

std::uint8_t CameraPins::data(Cycle at) {
  if (!refresh(at)) return 0;
  // Where in the frame, and in the line, the clock is; between lines there is no data.
  const std::int64_t frame = floor_div(at - f_.start, f_.length);
  const Cycle phase = at - f_.start - frame * f_.length - f_.first;
  const std::int64_t line = floor_div(phase, f_.line);
  if (line < 0 || line >= f_.lines || phase - line * f_.line >= f_.high) return 0;
  board::Camera& camera = *board_.camera();
  const Cycle start = f_.start + frame * f_.length;
  // The first read in a frame takes the whole of it: all lines, all bytes.
  if (captured_ != start) {
    if (!lines_.empty()) finish_picture();
    board::Camera::Cut all;
    all.is_picture = false;
    all.rows = static_cast<int>(f_.lines);
    all.bytes.resize(static_cast<std::size_t>(f_.bytes));
    std::iota(all.bytes.begin(), all.bytes.end(), 0);
    all.columns = static_cast<int>(f_.bytes) / camera.setup().bytes_per_pixel();
    camera.await_frame(at);
    camera.begin_frame(std::move(all), at);
    captured_ = start;
    line_ = -1;
  }
  // A line is rendered when it is first read.
  if (line != line_) {
    bytes_.resize(static_cast<std::size_t>(f_.bytes));
    camera.put_line(static_cast<int>(line), bytes_.data(), start + f_.first + line * f_.line);
    line_ = line;
  }
  // The byte that lies at the pins now.
  const std::int64_t index = floor_div(2 * (phase - line * f_.line), f_.byte_half_cycles);
  const std::int64_t place = std::clamp<std::int64_t>(index, 0, f_.bytes - 1);
  const std::uint8_t byte = bytes_[static_cast<std::size_t>(place)];
  note_read(line, place, byte, at);
  return byte;
}

// --- pictures

void CameraPins::note_read(std::int64_t line, std::int64_t index, std::uint8_t byte, Cycle at) {
  if (lines_.empty() || lines_.back().line != line) lines_.push_back({line, index, -1, 0, {}});
  Read& read = lines_.back();
  if (read.last == index) return;  // it is still there
  const std::int64_t size = board_.camera()->setup().bytes_per_pixel();
  if (read.bytes.empty() || read.last / size != index / size) ++read.columns;
  read.last = index;
  read.bytes.push_back(byte);
  read_at_ = at;
}

/// As many bytes a line as most lines have; a look at the port now and then makes no picture.
void CameraPins::finish_picture() {
  const std::vector<Read> lines = std::move(lines_);
  lines_.clear();
  std::map<std::size_t, int> widths;
  for (const Read& line : lines) ++widths[line.bytes.size()];
  const auto usual = std::max_element(widths.begin(), widths.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  if (usual->second < 2 || usual->first < 2) return;
  const auto model = std::find_if(lines.begin(), lines.end(),
                                  [&](const Read& line) { return line.bytes.size() == usual->first; });
  std::vector<std::uint8_t> bytes;
  for (const Read& line : lines) {
    bytes.insert(bytes.end(), line.bytes.begin(), line.bytes.end());
    bytes.resize(bytes.size() - line.bytes.size() + usual->first);
  }
  board::Camera& camera = *board_.camera();
  const int size = camera.setup().bytes_per_pixel();
  board::Camera::Part part;
  part.first_column = static_cast<int>(model->first) / size;
  part.last_column = static_cast<int>(model->last) / size;
  part.columns = model->columns;
  part.first_row = static_cast<int>(lines.front().line);
  part.last_row = static_cast<int>(lines.back().line);
  part.rows = static_cast<int>(lines.size());
  camera.note_picture(part, std::move(bytes), read_at_);
}

}  // namespace chip
