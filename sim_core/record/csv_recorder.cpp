// SPDX-License-Identifier: MIT
#include "sim_core/record/csv_recorder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr std::size_t kBufferBytes = 1u << 16;  // at most this much is lost with the power
constexpr int kIrColumns = 8;

}  // namespace

CsvRecorder::CsvRecorder(std::string path, double every_s)
    : path_(std::move(path)), every_(std::max<Clicks>(1, from_seconds(every_s))) {
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) error_ = fmt::format("{}: cannot be written: {}", path_, std::strerror(errno));
  buffer_ = "time_s,robot,x_m,y_m,heading_rad,left_steps,right_steps,ir0,ir1,ir2,ir3,ir4,ir5,ir6,ir7,leds\n";
}

CsvRecorder::~CsvRecorder() {
  flush();
  if (file_ >= 0) ::close(file_);
}

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
                   scene.world().robots[static_cast<std::size_t>(r)].name, p.x_m, p.y_m, p.heading_rad,
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
  // the buffer always ends with a whole line; a short write is carried on with
  std::size_t done = 0;
  while (is_good() && done < buffer_.size()) {
    const ssize_t wrote = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
    } else if (errno != EINTR) {
      error_ = fmt::format("{}: cannot be written: {}", path_, std::strerror(errno));
    }
  }
  buffer_.clear();
}

}  // namespace sim
