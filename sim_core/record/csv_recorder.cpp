// SPDX-License-Identifier: MIT
#include "sim_core/record/csv_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr std::size_t kBufferBytes = 1u << 16;  // at most this much is lost with the power
constexpr int kIrColumns = 8;

// a field with a comma or a quote stands in quotes (RFC 4180)
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace

CsvRecorder::CsvRecorder(const std::string& path, double every_s)
    : file_(path), every_(std::max<Clicks>(1, from_seconds(every_s))) {
  buffer_ = "time_s,robot,x_m,y_m,heading_rad,left_steps,right_steps,ir0,ir1,ir2,ir3,ir4,ir5,ir6,ir7,leds\n";
}

CsvRecorder::~CsvRecorder() { flush(); }

void CsvRecorder::sample(const Scene& scene, const Minds& minds) {
  const Clicks now = scene.now();
  if (now < next_ || !is_good()) return;
  next_ = (now / every_ + 1) * every_;
  auto out = std::back_inserter(buffer_);
  for (int r = 0; r < scene.robots(); ++r) {
    const Pose2& p = scene.state(r).pose;
    RobotMind& mind = *minds[static_cast<std::size_t>(r)];
    const MindReport report = mind.report();
    fmt::format_to(out, "{:.6f},{},{:.6f},{:.6f},{:.6f},{},{}", to_seconds(now),
                   field(scene.world().robots[static_cast<std::size_t>(r)].name), p.x_m, p.y_m, p.heading_rad,
                   report.left_steps, report.right_steps);
    const int sensors = static_cast<int>(
        scene.world().model_of(scene.world().robots[static_cast<std::size_t>(r)])->proximity.size());
    for (int i = 0; i < kIrColumns; ++i) {
      if (i < sensors) {
        fmt::format_to(out, ",{}", mind.proximity_counts(scene, i));
      } else {
        fmt::format_to(out, ",");
      }
    }
    fmt::format_to(out, ",{:03x}\n", report.leds);
    if (buffer_.size() >= kBufferBytes) write_buffer();
  }
}

bool CsvRecorder::flush() {
  write_buffer();
  return is_good();
}

void CsvRecorder::write_buffer() {
  if (is_good()) file_.append_lines(buffer_);
  buffer_.clear();
}

}  // namespace sim
