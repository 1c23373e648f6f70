// SPDX-License-Identifier: MIT
#include "outputs/terminal_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace outputs {

namespace {

constexpr std::uint8_t kLed = 196, kNose = 231, kOutside = 234;  // of xterm's 256 colours
constexpr double kMarginPx = 1;
constexpr std::size_t kMostSaid = 200;  // lines
constexpr double kDark = 0.3;           // of what the floor may reflect
// of two pixels in a character the one farther right is shown, where there are no colours
constexpr char kSigns[] = " .:#%o+*";
// 24 rows: 1, a map of 16, 2 robots, 5 lines of text
constexpr int kRowsPerRobotLine = 12, kRowsOfText = 5, kOfRows = 24;

/// The nearest of xterm's cube of 6 by 6 by 6.
std::uint8_t xterm(const sim::Colour& c) {
  const auto level = [](double v) { return static_cast<int>(std::lround(5 * std::clamp(v, 0.0, 1.0))); };
  return static_cast<std::uint8_t>(16 + 36 * level(c.r) + 6 * level(c.g) + level(c.b));
}

/// Characters that take two columns, roughly as Unicode's East Asian Width says.
bool is_wide(std::uint32_t c) {
  return (c >= 0x1100 && c <= 0x115F) || (c >= 0x2E80 && c <= 0xA4CF) || (c >= 0xAC00 && c <= 0xD7A3) ||
         (c >= 0xF900 && c <= 0xFAFF) || (c >= 0xFE30 && c <= 0xFE6F) || (c >= 0xFF00 && c <= 0xFF60) ||
         (c >= 0x1F300 && c <= 0x1FAFF) || c >= 0x20000;
}

/// The character that begins at `i`, which goes behind it; 0xFFFD: what is there is no UTF-8.
std::uint32_t next_character(const std::string& text, std::size_t& i) {
  const auto first = static_cast<unsigned char>(text[i++]);
  if (first < 0x80) return first;
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC2 ? 1 : 0;
  if (more == 0 || first > 0xF4 || i + static_cast<std::size_t>(more) > text.size()) return 0xFFFD;
  std::uint32_t c = first & (0x3Fu >> more);
  for (int k = 0; k < more; ++k) {
    const auto byte = static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]);
    if ((byte & 0xC0) != 0x80) return 0xFFFD;
    c = c << 6 | (byte & 0x3F);
  }
  i += static_cast<std::size_t>(more);
  return c;
}

/// Is the point within a convex outline in the world?
bool is_within(const sim::Placed& p, sim::Vec2 at) {
  if (p.solid->kind != sim::SolidKind::Prism) return sim::length(at - p.frame.at) <= p.solid->radius_m;
  const auto& outline = p.solid->outline;
  bool inside = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const sim::Vec2 a = p.frame.to_world(outline[i]), b = p.frame.to_world(outline[j]);
    if ((a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x)
      inside = !inside;
  }
  return inside;
}

}  // namespace

TerminalView::TerminalView(const twin::Twin& twin, bool colours, TerminalSize size)
    : twin_(twin), colours_(colours) {
  resize(size);
}

void TerminalView::resize(TerminalSize size) {
  size_ = {std::max(size.columns, 1), std::max(size.rows, 1)};
  robot_rows_ = std::clamp(size_.rows / kRowsPerRobotLine, size_.rows < kRowsPerRobotLine ? 1 : 2,
                           std::max(2, twin_.robots()));
  map_rows_ = std::max(0, size_.rows - 1 - robot_rows_ - std::max(1, size_.rows * kRowsOfText / kOfRows));
  lay_ground();
}

void TerminalView::lay_ground() {
  const sim::Scene& scene = twin_.simulation().scene();
  const sim::Layout& layout = scene.layout();
  const sim::Vec2 span{std::max(layout.high_m.x - layout.low_m.x, 1e-3),
                       std::max(layout.high_m.y - layout.low_m.y, 1e-3)};
  px_per_m_ =
      std::max(1e-3, std::min((size_.columns - 2 * kMarginPx) / span.x, (high() - 2 * kMarginPx) / span.y));
  const sim::Vec2 middle{0.5 * (layout.low_m.x + layout.high_m.x), 0.5 * (layout.low_m.y + layout.high_m.y)};
  left_top_m_ = {middle.x - 0.5 * size_.columns / px_per_m_, middle.y + 0.5 * high() / px_per_m_};
  ground_.assign(static_cast<std::size_t>(size_.columns) * static_cast<std::size_t>(high()), {kOutside, ' '});
  for (int y = 0; y < high(); ++y)
    for (int x = 0; x < size_.columns; ++x) {
      const sim::Vec2 p{left_top_m_.x + (x + 0.5) / px_per_m_, left_top_m_.y - (y + 0.5) / px_per_m_};
      if (p.x < layout.low_m.x || p.x > layout.high_m.x || p.y < layout.low_m.y || p.y > layout.high_m.y)
        continue;
      // a floor as bright as walls would hide them
      const sim::Colour c = sim::floor_at(scene.world(), p).colour;
      at(ground_, x, y) = {xterm({0.6 * c.r, 0.6 * c.g, 0.6 * c.b}),
                           (c.r + c.g + c.b) / 3 < kDark ? ':' : '.'};
    }
  for (std::size_t i = 0; i < layout.fixed.size(); ++i)
    solid(ground_, layout.fixed[i], {xterm(layout.fixed_surface[i].colour), '#'});
}

void TerminalView::solid(Pixels& pixels, const sim::Placed& placed, Pixel pixel) const {
  // thin walls, too: nine points of a pixel
  for (int y = 0; y < high(); ++y)
    for (int x = 0; x < size_.columns; ++x)
      for (int k = 0; k < 9; ++k) {
        const int column = k % 3, row = k / 3;
        if (is_within(placed, {left_top_m_.x + (x + (column + 0.5) / 3) / px_per_m_,
                               left_top_m_.y - (y + (row + 0.5) / 3) / px_per_m_})) {
          at(pixels, x, y) = pixel;
          break;
        }
      }
}

void TerminalView::disc(Pixels& pixels, sim::Vec2 at_m, double radius_m, Pixel pixel) const {
  const double x0 = (at_m.x - left_top_m_.x) * px_per_m_, y0 = (left_top_m_.y - at_m.y) * px_per_m_;
  const double r = std::max(radius_m * px_per_m_, 0.5);  // one pixel at least
  for (int y = std::max(0, static_cast<int>(y0 - r)); y < std::min<double>(high(), y0 + r + 1); ++y)
    for (int x = std::max(0, static_cast<int>(x0 - r)); x < std::min<double>(size_.columns, x0 + r + 1); ++x)
      if (std::hypot(x + 0.5 - x0, y + 0.5 - y0) <= r ||
          (x == static_cast<int>(x0) && y == static_cast<int>(y0)))
        at(pixels, x, y) = pixel;
}

void TerminalView::say(const std::string& line) {
  said_.push_back(line);
  if (said_.size() > kMostSaid) said_.pop_front();
}

std::string TerminalView::robot_line(int robot) const {
  const host::FirmwareMind& mind = twin_.mind(robot);
  const sim::Pose2 pose = twin_.simulation().pose(robot);
  std::string leds;
  for (int i = 0; i < 10; ++i) leds += mind.report().leds >> i & 1 ? "01234567BF"[i] : '.';
  const host::Runner* program = mind.runner();
  std::string state = !program                                  ? "no program"
                      : program->has_stopped()                  ? "STOPPED by a trap"
                      : program->waiting_since() < host::kNever ? "waits"
                                                                : "runs";
  // where the robot's own code goes on
  std::int64_t resets = 0;
  if (program && !program->has_stopped())
    for (const host::TrapReport& trap : program->traps()) resets += trap.count;
  if (resets > 0) state = "RESET " + (resets < 1000 ? std::to_string(resets) : ">999") + "x, " + state;
  return fmt::format("{:<12.12} x {:6.3f} y {:6.3f} m {:4.0f} deg  LEDs {}  {}",
                     twin_.world().robots[static_cast<std::size_t>(robot)].name, pose.x_m, pose.y_m,
                     sim::degrees(std::remainder(pose.heading_rad, 2 * sim::kPi)), leds, state);
}

/// As many characters of plain text as there is room for; what a terminal would obey is left out.
void TerminalView::put(TerminalPicture& picture, int row, const std::string& text) const {
  if (row < 0 || row >= size_.rows) return;
  const auto first = picture.cells.begin() + static_cast<std::ptrdiff_t>(row) * size_.columns;
  int x = 0;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    const std::uint32_t c = next_character(text, i);
    if (c < 32 || (c >= 0x7F && c < 0xA0)) continue;
    if (c >= 0x300 && c <= 0x36F) {  // an accent of the one before
      if (x > 0) first[x - 1].sign += text.substr(begin, i - begin);
      continue;
    }
    const int wide = is_wide(c) ? 2 : 1;
    if (x + wide > size_.columns) return;
    first[x].sign = c == 0xFFFD ? "?" : text.substr(begin, i - begin);
    if (wide == 2) first[x + 1].sign.clear();
    x += wide;
  }
}

void TerminalView::put_map(TerminalPicture& picture, Pixels& pixels) const {
  const auto weight = [](char sign) { return std::strchr(kSigns, sign) - kSigns; };
  for (int row = 0; row < map_rows_; ++row)
    for (int x = 0; x < size_.columns; ++x) {
      const Pixel upper = at(pixels, x, 2 * row), lower = at(pixels, x, 2 * row + 1);
      auto& cell = picture.cells[static_cast<std::size_t>(1 + row) * static_cast<std::size_t>(size_.columns) +
                                 static_cast<std::size_t>(x)];
      if (colours_)
        cell = {"\xE2\x96\x80", upper.colour, lower.colour};  // the upper half of a character
      else
        cell.sign = weight(upper.sign) > weight(lower.sign) ? upper.sign : lower.sign;
    }
}

TerminalPicture TerminalView::picture(double pace, const std::string& hint) const {
  const sim::Scene& scene = twin_.simulation().scene();
  Pixels pixels = ground_;
  for (int b = scene.robots(); b < scene.bodies(); ++b)
    solid(pixels, scene.placed(b, scene.now()),
          {xterm(scene.layout().moving_surface[static_cast<std::size_t>(b)].colour), '%'});
  for (int r = 0; r < twin_.robots() && map_rows_ > 0; ++r) {
    const auto& desc = twin_.world().robots[static_cast<std::size_t>(r)];
    const sim::RobotModel* model = twin_.world().model_of(desc);
    const sim::Pose2 pose = twin_.simulation().pose(r);
    const sim::Vec2 middle{pose.x_m, pose.y_m};
    const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
    const double radius = model->body_radius_m;
    disc(pixels, middle, radius, {xterm(desc.colour ? *desc.colour : model->colour), 'o'});
    disc(pixels, {middle.x + 0.6 * radius * c, middle.y + 0.6 * radius * s}, 0, {kNose, '+'});
    for (std::size_t i = 0; i < model->leds.size(); ++i) {
      const sim::Vec2 led = model->leds[i].at_m;
      if (twin_.mind(r).report().leds >> i & 1)
        disc(pixels, {middle.x + c * led.x - s * led.y, middle.y + s * led.x + c * led.y}, 0, {kLed, '*'});
    }
  }
  TerminalPicture picture;
  picture.size = size_;
  picture.cells.resize(static_cast<std::size_t>(size_.columns) * static_cast<std::size_t>(size_.rows));
  const std::string name = twin_.world().title.empty() ? twin_.world().file : twin_.world().title;
  put(picture, 0,
      fmt::format("{:9.3f} s  x{:<6.3g} {}{}", sim::to_seconds(scene.now()), pace,
                  hint.empty() ? "" : hint + "  ", name));
  put_map(picture, pixels);
  int row = 1 + map_rows_;
  for (int r = 0; r < robot_rows_; ++r, ++row)
    if (r == robot_rows_ - 1 && twin_.robots() > robot_rows_)
      put(picture, row, fmt::format("... and {} more robots", twin_.robots() - robot_rows_ + 1));
    else if (r < twin_.robots())
      put(picture, row, robot_line(r));
  const auto room = static_cast<std::size_t>(std::max(0, size_.rows - row));
  for (std::size_t i = said_.size() > room ? said_.size() - room : 0; i < said_.size(); ++i, ++row)
    put(picture, row, said_[i]);
  return picture;
}

std::string TerminalView::line(double pace) const {
  std::string text =
      fmt::format("{:9.3f} s  x{:<6.3g}", sim::to_seconds(twin_.simulation().scene().now()), pace);
  const int shown = std::min(twin_.robots(), robot_rows_);
  for (int r = 0; r < shown; ++r) text += "  " + robot_line(r);
  if (shown < twin_.robots()) text += fmt::format("  ... and {} more robots", twin_.robots() - shown);
  return text;
}

}  // namespace outputs
