// SPDX-License-Identifier: MIT
#include "outputs/terminal_view.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace outputs {

namespace {

constexpr std::uint8_t kLed = 196, kNose = 231, kOutside = 234;  // of xterm's 256 colours
constexpr double kMarginPx = 1;

/// The nearest of xterm's cube of 6 by 6 by 6.
std::uint8_t xterm(const sim::Colour& c) {
  const auto level = [](double v) { return static_cast<int>(std::lround(5 * std::clamp(v, 0.0, 1.0))); };
  return static_cast<std::uint8_t>(16 + 36 * level(c.r) + 6 * level(c.g) + level(c.b));
}

/// As many characters of plain text as there is room for; what a terminal would obey is left out.
std::string fitted(const std::string& text) {
  std::string out;
  int columns = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127) continue;
    if ((byte & 0xC0) != 0x80 && ++columns > TerminalView::kColumns) break;
    out += c;
  }
  return out + "\x1b[K";
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

void write_all(const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(STDOUT_FILENO, bytes.data() + done, bytes.size() - done);
    if (n <= 0) return;  // nobody looks
    done += static_cast<std::size_t>(n);
  }
}

}  // namespace

TerminalView::TerminalView(const twin::Twin& twin) : twin_(twin) {
  const sim::Scene& scene = twin.simulation().scene();
  const sim::Layout& layout = scene.layout();
  const sim::Vec2 span{std::max(layout.high_m.x - layout.low_m.x, 1e-3),
                       std::max(layout.high_m.y - layout.low_m.y, 1e-3)};
  px_per_m_ = std::min((kColumns - 2 * kMarginPx) / span.x, (kHigh - 2 * kMarginPx) / span.y);
  const sim::Vec2 middle{0.5 * (layout.low_m.x + layout.high_m.x), 0.5 * (layout.low_m.y + layout.high_m.y)};
  left_top_m_ = {middle.x - 0.5 * kColumns / px_per_m_, middle.y + 0.5 * kHigh / px_per_m_};
  ground_.assign(kColumns * kHigh, kOutside);
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kColumns; ++x) {
      const sim::Vec2 p{left_top_m_.x + (x + 0.5) / px_per_m_, left_top_m_.y - (y + 0.5) / px_per_m_};
      if (p.x < layout.low_m.x || p.x > layout.high_m.x || p.y < layout.low_m.y || p.y > layout.high_m.y)
        continue;
      // a floor as bright as walls would hide them
      const sim::Colour c = scene.floor(p).colour;
      at(ground_, x, y) = xterm({0.6 * c.r, 0.6 * c.g, 0.6 * c.b});
    }
  for (std::size_t i = 0; i < layout.fixed.size(); ++i)
    solid(ground_, layout.fixed[i], layout.fixed_surface[i].colour);
}

void TerminalView::solid(Pixels& pixels, const sim::Placed& placed, const sim::Colour& colour) const {
  // thin walls, too: nine points of a pixel
  for (int y = 0; y < kHigh; ++y)
    for (int x = 0; x < kColumns; ++x)
      for (int k = 0; k < 9; ++k)
        if (is_within(placed, {left_top_m_.x + (x + (k % 3 + 0.5) / 3) / px_per_m_,
                               left_top_m_.y - (y + (k / 3 + 0.5) / 3) / px_per_m_})) {
          at(pixels, x, y) = xterm(colour);
          break;
        }
}

void TerminalView::disc(Pixels& pixels, sim::Vec2 at_m, double radius_m, std::uint8_t colour) const {
  const double x0 = (at_m.x - left_top_m_.x) * px_per_m_, y0 = (left_top_m_.y - at_m.y) * px_per_m_;
  const double r = std::max(radius_m * px_per_m_, 0.5);  // one pixel at least
  for (int y = std::max(0, static_cast<int>(y0 - r)); y < std::min<double>(kHigh, y0 + r + 1); ++y)
    for (int x = std::max(0, static_cast<int>(x0 - r)); x < std::min<double>(kColumns, x0 + r + 1); ++x)
      if (std::hypot(x + 0.5 - x0, y + 0.5 - y0) <= r ||
          (x == static_cast<int>(x0) && y == static_cast<int>(y0)))
        at(pixels, x, y) = colour;
}

void TerminalView::say(const std::string& line) {
  said_.push_back(line);
  if (said_.size() > kRows - kMapRows - kRobotRows - 1) said_.pop_front();
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

std::string TerminalView::frame(double pace) const {
  const sim::Scene& scene = twin_.simulation().scene();
  Pixels pixels = ground_;
  for (int b = scene.robots(); b < scene.bodies(); ++b)
    solid(pixels, scene.placed(b, scene.now()),
          scene.layout().moving_surface[static_cast<std::size_t>(b)].colour);
  for (int r = 0; r < twin_.robots(); ++r) {
    const auto& desc = twin_.world().robots[static_cast<std::size_t>(r)];
    const sim::RobotModel* model = twin_.world().model_of(desc);
    const sim::Pose2 pose = twin_.simulation().pose(r);
    const sim::Vec2 middle{pose.x_m, pose.y_m};
    const double c = std::cos(pose.heading_rad), s = std::sin(pose.heading_rad);
    const double radius = model->body_radius_m;
    disc(pixels, middle, radius, xterm(desc.colour ? *desc.colour : model->colour));
    disc(pixels, {middle.x + 0.6 * radius * c, middle.y + 0.6 * radius * s}, 0, kNose);
    for (std::size_t i = 0; i < model->leds.size(); ++i) {
      const sim::Vec2 led = model->leds[i].at_m;
      if (twin_.mind(r).report().leds >> i & 1)
        disc(pixels, {middle.x + c * led.x - s * led.y, middle.y + s * led.x + c * led.y}, 0, kLed);
    }
  }
  const std::string name = twin_.world().title.empty() ? twin_.world().file : twin_.world().title;
  std::string out = "\x1b[H\x1b[0m" +
                    fitted(fmt::format("{:9.3f} s  x{:<6.3g} {}", sim::to_seconds(scene.now()), pace, name));
  for (int row = 0; row < kMapRows; ++row) {
    out += "\r\n";
    int fore = -1, back = -1;
    for (int x = 0; x < kColumns; ++x) {
      const int upper = at(pixels, x, 2 * row), lower = at(pixels, x, 2 * row + 1);
      if (upper != fore) out += fmt::format("\x1b[38;5;{}m", fore = upper);
      if (lower != back) out += fmt::format("\x1b[48;5;{}m", back = lower);
      out += "\xE2\x96\x80";  // the upper half of a character
    }
    out += "\x1b[0m";
  }
  for (int r = 0; r < kRobotRows; ++r) {
    std::string line = r < twin_.robots() ? robot_line(r) : "";
    if (r == kRobotRows - 1 && twin_.robots() > kRobotRows)
      line = fmt::format("... and {} more robots", twin_.robots() - kRobotRows + 1);
    out += "\r\n" + fitted(line);
  }
  const std::size_t lines = kRows - kMapRows - kRobotRows - 1;
  for (std::size_t i = 0; i < lines; ++i) out += "\r\n" + fitted(i < said_.size() ? said_[i] : "");
  return out;
}

// --- the terminal

TerminalScreen::TerminalScreen() { write_all("\x1b[?1049h\x1b[?25l\x1b[2J"); }
TerminalScreen::~TerminalScreen() { give_back(); }
void TerminalScreen::show(const std::string& frame) { write_all(frame); }
void TerminalScreen::give_back() { write_all("\x1b[0m\x1b[?25h\x1b[?1049l"); }

}  // namespace outputs
