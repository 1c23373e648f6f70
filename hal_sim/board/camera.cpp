// SPDX-License-Identifier: MIT
#include "hal_sim/board/camera.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/camera_params.h"
#include "hal_sim/board/specimen.h"
#include "sim_core/base/hash.h"
#include "sim_core/random/counter_random.h"

namespace board {

namespace {

constexpr std::uint32_t kCameraStream = sim::kStreamBoard + 40;
constexpr double kSqrt6 = 2.449489742783178;  // of a triangular draw's half width over its standard deviation

double luma(const sim::Light& l) { return 0.299 * l.r + 0.587 * l.g + 0.114 * l.b; }

/// What the sensor gives back, as a share of full scale, for a count of the gamma table: its inverse.
double light_of_count(const SensorSetup& s, double count) {
  for (int i = 11; i >= 0; --i) {
    const double low = s.gamma[static_cast<std::size_t>(i)];
    if (count < low && i > 0) continue;
    const double high = i == 11 ? 255 : s.gamma[static_cast<std::size_t>(i + 1)];
    const double to = i == 11 ? 256 : kGammaAt[i + 1];
    if (high <= low) continue;
    return (kGammaAt[i] + (to - kGammaAt[i]) * (count - low) / (high - low)) / 256;
  }
  return count / 255;
}

}  // namespace

Camera::Camera(const Specimen& robot, CameraSensor& sensor, CameraMount mount, double noise)
    : robot_(robot), sensor_(sensor), mount_(mount), noise_(noise), exposure_s_(kStartExposureS) {}

// --- frames

SensorSetup Camera::setup() const { return sensor_.setup(); }

/// Registers may have changed: frames then start anew with the write.
void Camera::refresh(Cycle at) {
  if (seen_version_ == sensor_.version()) return;
  now_ = sensor_.setup();
  seen_version_ = sensor_.version();
  frame_start_ = std::min(at, sensor_.written_at());
}

Cycle Camera::frame_cycles() const {
  const SensorSetup s = sensor_.setup();
  const double line_s = static_cast<double>(s.line_cycles()) / static_cast<double>(kFcyHz);
  const double lines = s.auto_exposure ? exposure_s_ / line_s : s.exposure_lines;
  const int integration = static_cast<int>(std::min(lines, static_cast<double>(s.longest_integration)));
  return Cycle{std::max(s.frame_lines, integration + kIntegrationMargin)} * s.line_cycles();
}

Cycle Camera::await_frame(Cycle at) {
  refresh(at);
  ++awaited_;
  first_use.note();
  rendered_ = 0;
  picture_.clear();
  if (const sim::Scene* scene = robot_.scene()) sim::watch_leds(*scene);
  const Cycle frame = frame_cycles();
  return frame_start_ + ((at - frame_start_) / frame + 1) * frame;
}

void Camera::begin_frame(Cut cut, Cycle at) {
  refresh(at);
  cut_ = std::move(cut);
  ++exposed_;
  const Cycle frame = frame_cycles();
  const std::int64_t frames = (at - frame_start_) / frame;
  const Cycle vsync = frame_start_ + frames * frame;
  taken_ = now_;
  make_curve();
  run_automatics(std::min<std::int64_t>(frames, kLongestGap), vsync);
  frame_start_ = vsync;

  const double line_s = static_cast<double>(taken_.line_cycles()) / static_cast<double>(kFcyHz);
  const double seconds = taken_.auto_exposure ? exposure_s_
                                              : std::min(taken_.exposure_lines,
                                                         static_cast<double>(taken_.longest_integration)) *
                                                    line_s * taken_.gain;
  scale_[0] = seconds * kResponse * (taken_.auto_white ? auto_red_ : taken_.red);
  scale_[1] = seconds * kResponse * (taken_.auto_white ? 1.0 : taken_.green);
  scale_[2] = seconds * kResponse * (taken_.auto_white ? auto_blue_ : taken_.blue);
  plan_line();
  rendered_ = 0;
  picture_.clear();
  line_cycles_ = Cycle{taken_.sub_sampling} * taken_.line_cycles();
  first_line_ = vsync + line_cycles_;
}

/// Which pixels the cut's bytes need.
void Camera::plan_line() {
  line_.clear();
  columns_.clear();
  const int bpp = taken_.bytes_per_pixel();
  const int first = taken_.first_x - taken_.sub_sampling;  // of the line as it comes out of the sensor
  int last_pixel = -1;
  for (const int byte : cut_.bytes) {
    const int pixel = byte / bpp;
    if (pixel != last_pixel || columns_.empty()) {
      columns_.push_back(first + (pixel + 0.5) * taken_.sub_sampling);
      last_pixel = pixel;
    }
    line_.push_back({static_cast<std::uint16_t>(columns_.size() - 1), static_cast<std::uint8_t>(byte % bpp),
                     (pixel & 1) != 0});
  }
}

// --- light

/// Tangents for each pixel along a line and down the lines.
std::array<double, 2> Camera::scale() const {
  // the PO6030K shows upright pictures with both mirrors on, the others with both off
  double sign = sensor_.kind() == CameraKind::Po6030k ? -1 : 1;
  if (mount_ != CameraMount::Upright) sign = -sign;
  return {(taken_.mirror_columns ? -sign : sign) / focal_px_,
          (taken_.mirror_lines ? -sign : sign) / focal_px_};
}

std::array<double, 4> Camera::widest_edges() const {
  double right = kArrayWidth / (2 * focal_px_), up = kArrayHeight / (2 * focal_px_);
  if (mount_ == CameraMount::Sideways) std::swap(right, up);
  return {-right, right, -up, up};
}

std::array<double, 4> Camera::edges(const Part& part) const {
  const auto [along, down] = scale();
  const double half = 0.5 * taken_.sub_sampling;
  const auto column = [this](int number) {
    return columns_[std::min(static_cast<std::size_t>(number), columns_.size() - 1)];
  };
  const auto line_from_top = [this, down_by = down](int number) {
    return (taken_.first_y + number * taken_.sub_sampling - 0.5 * kArrayHeight) * down_by;
  };
  const auto x = std::minmax({(column(part.first_column) - half - 0.5 * kArrayWidth) * along,
                              (column(part.last_column) + half - 0.5 * kArrayWidth) * along});
  const auto y = std::minmax(
      {line_from_top(part.first_row * cut_.row_step), line_from_top(part.last_row * cut_.row_step + 1)});
  // as in render(): turned by a quarter, or lines from the top
  if (mount_ == CameraMount::Sideways) return {y.first, y.second, x.first, x.second};
  return {x.first, x.second, -y.second, -y.first};
}

/// Light at places of the array (x along a line, y down the lines), as seen through mirrors, mount and lens.
/// The result is light_[j * x.size() + i], or light_[i * y.size() + j] when transposed_.
void Camera::render(const std::vector<double>& x, const std::vector<double>& y, Cycle at) {
  const sim::Scene* scene = robot_.scene();
  transposed_ = mount_ == CameraMount::Sideways;
  const Damage* const damage = robot_.damage();
  const bool is_covered = damage && damage->lens_covered.at(at) != 0;
  if (is_covered) damage->note(damage->saw_dark, at);
  if (!scene || is_covered) {
    light_.assign(x.size() * y.size(), sim::Light{});
    return;
  }
  const auto [along, down] = scale();
  right_.clear();
  up_.clear();
  if (transposed_) {
    // turned by a quarter: lines go from right to left, along a line it goes down
    for (double row : y) right_.push_back((row - 0.5 * kArrayHeight) * down);
    for (double column : x) up_.push_back((column - 0.5 * kArrayWidth) * along);
  } else {
    for (double column : x) right_.push_back((column - 0.5 * kArrayWidth) * along);
    for (double row : y) up_.push_back(-(row - 0.5 * kArrayHeight) * down);
  }
  sim::render_camera(*scene, robot_.setup().robot, {kCameraXM, 0, kCameraZM}, robot_.clock().click_at(at),
                     right_, up_, light_);
}

void Camera::run_automatics(std::int64_t frames, Cycle at) {
  if (frames <= 0 || (!taken_.auto_exposure && !taken_.auto_white)) return;
  // a coarse look at the whole array
  constexpr int kAcross = 16, kDown = 12;
  columns_.clear();
  lines_.clear();
  for (int i = 0; i < kAcross; ++i) columns_.push_back((i + 0.5) * kArrayWidth / kAcross);
  for (int i = 0; i < kDown; ++i) lines_.push_back((i + 0.5) * kArrayHeight / kDown);
  render(columns_, lines_, at);

  // Limits of the exposure, and the mean that it shall lead to.
  const double line_s = static_cast<double>(taken_.line_cycles()) / static_cast<double>(kFcyHz);
  const double shortest_s = kShortestLines * line_s;
  const double longest_s = taken_.longest_integration * line_s * kLargestGain;
  const double target = light_of_count(taken_, taken_.target);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    // The mean that this exposure gives, and the colours of what is nearly grey and not overexposed.
    double sum = 0, red = 0, green = 0, blue = 0;
    for (const sim::Light& l : light_) {
      const double k = exposure_s_ * kResponse;
      sum += std::min(1.0, luma(l) * k);
      const double most = std::max({l.r, l.g, l.b}), least = std::min({l.r, l.g, l.b});
      if (most <= 0 || most - least > kWhiteChroma * most || most * k >= 1) continue;
      red += l.r;
      green += l.g;
      blue += l.b;
    }
    bool changed = false;
    const double mean = sum / static_cast<double>(light_.size());
    // One step towards the target; within some percent of it nothing moves.
    if (taken_.auto_exposure && std::fabs(mean - target) > kExposureHold * target) {
      const double wanted =
          exposure_s_ * std::clamp(target / std::max(mean, 1e-9), 1 / kExposureStep, kExposureStep);
      const double next = std::clamp(wanted, shortest_s, longest_s);
      changed = next != exposure_s_;
      exposure_s_ = next;
    }
    if (taken_.auto_white && red > 0 && blue > 0) {
      const double r =
          std::clamp(auto_red_ + kWhiteStep * (green / red - auto_red_), kWhiteLeast, kWhiteMost);
      const double b =
          std::clamp(auto_blue_ + kWhiteStep * (green / blue - auto_blue_), kWhiteLeast, kWhiteMost);
      changed = changed || r != auto_red_ || b != auto_blue_;
      auto_red_ = r;
      auto_blue_ = b;
    }
    // from here on all frames would be alike
    if (!changed) break;
  }
}

/// Linear share of full scale (in 1024) to counts.
void Camera::make_curve() {
  if (curve_version_ == seen_version_) return;
  curve_version_ = seen_version_;
  curve_.resize(1025);
  for (int i = 0; i <= 1024; ++i) {
    const double x = i * 0.25;  // of 256
    int k = 11;
    while (k > 0 && x < kGammaAt[k]) --k;
    const double from = kGammaAt[k], to = k == 11 ? 256 : kGammaAt[k + 1];
    const double low = now_.gamma[static_cast<std::size_t>(k)],
                 high = k == 11 ? 255 : now_.gamma[static_cast<std::size_t>(k + 1)];
    const double count = (low + (high - low) * (x - from) / (to - from)) * now_.contrast + now_.brightness;
    curve_[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(std::clamp(std::floor(count + 0.5), 0.0, 255.0));
  }
}

/// Light of a pixel to 8 bits a colour. `pixel`: unique among the robot's pixels, names its noise.
std::array<std::uint8_t, 3> Camera::develop(const sim::Light& light, std::uint64_t pixel) const {
  const double in[3] = {light.r * scale_[0], light.g * scale_[1], light.b * scale_[2]};
  std::array<std::uint8_t, 3> out{};
  const std::uint64_t bits =
      noise_ > 0 ? sim::random_bits({robot_.setup().seed, 0, kCameraStream}, pixel) : 0;
  std::uint64_t more = bits;
  for (std::size_t c = 0; c < 3; ++c) {
    double signal = in[c];
    if (noise_ > 0) {
      // two uniform draws of ten bits make a triangular one
      const double draw = (static_cast<double>((more & 1023) + (more >> 10 & 1023)) + 1) / 1024 - 1;
      more >>= 20;
      const double sigma =
          std::sqrt(kReadNoise * kReadNoise + kShotNoise * kShotNoise * std::min(signal, 1.0));
      signal += noise_ * kSqrt6 * sigma * draw;
    }
    out[c] = curve_[static_cast<std::size_t>(std::floor(std::clamp(signal, 0.0, 1.0) * 1024 + 0.5))];
  }
  return out;
}

void Camera::render_rows(int first_row, Cycle at) {
  lines_.clear();
  rendered_ = std::min(kRowsAtOnce, cut_.rows - first_row);
  first_rendered_ = first_row;
  for (int row = first_row; row < first_row + rendered_; ++row)
    lines_.push_back(taken_.first_y + (row * cut_.row_step + 0.5) * taken_.sub_sampling);
  render(columns_, lines_, at);
}

void Camera::put_line(int number, std::uint8_t* to, Cycle at) {
  if (number < first_rendered_ || number >= first_rendered_ + rendered_) render_rows(number, line_at(number));
  const std::size_t row = static_cast<std::size_t>(number - first_rendered_);
  const std::size_t wide = columns_.size(), high = static_cast<std::size_t>(rendered_);
  const double y = lines_[row];
  std::array<std::uint8_t, 3> rgb{};
  int developed = -1;
  for (const Byte& b : line_) {
    // Bytes of one pixel are made of one development, so they share its noise.
    if (b.pixel != developed) {
      developed = b.pixel;
      const std::size_t p = static_cast<std::size_t>(b.pixel);
      const double x = columns_[p];
      // nothing comes out beyond the array
      const bool inside = x >= 0 && x < kArrayWidth && y >= 0 && y < kArrayHeight;
      const std::uint64_t pixel = (static_cast<std::uint64_t>(awaited_ - awaited_before_) << 20) +
                                  static_cast<std::uint64_t>(number) * 1024 + p;
      rgb = inside ? develop(light_[transposed_ ? p * high + row : row * wide + p], pixel)
                   : std::array<std::uint8_t, 3>{};
    }
    // The byte that the format has at this place.
    std::uint8_t value = 0;
    const double luma_count = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
    switch (taken_.format) {
      case SensorSetup::Format::Grey:
        value = static_cast<std::uint8_t>(std::floor(luma_count + 0.5));
        break;
      case SensorSetup::Format::Rgb565:
        value = b.part == 0 ? static_cast<std::uint8_t>((rgb[0] & 0xF8) | rgb[1] >> 5)
                            : static_cast<std::uint8_t>((rgb[1] << 3 & 0xE0) | rgb[2] >> 3);
        break;
      case SensorSetup::Format::Yuv:
        if (b.part == 0) {
          value = static_cast<std::uint8_t>(std::floor(luma_count + 0.5));
        } else {
          const double chroma = b.odd ? 0.713 * (rgb[0] - luma_count) : 0.564 * (rgb[2] - luma_count);
          value = static_cast<std::uint8_t>(std::clamp(std::floor(128.5 + chroma), 0.0, 255.0));
        }
        break;
    }
    *to++ = value;
    hash_ = sim::fold(hash_, static_cast<std::uint64_t>(value));
    if (on_picture && cut_.is_picture) picture_.push_back(value);
  }
  // The last line completes the picture.
  if (number + 1 < cut_.rows || !cut_.is_picture) return;
  note_picture({0, static_cast<int>(columns_.size()) - 1, cut_.columns, 0, cut_.rows - 1, cut_.rows},
               picture_, at);
}

void Camera::note_picture(const Part& part, std::vector<std::uint8_t> bytes, Cycle at) {
  ++pictures_;
  if (on_picture)
    on_picture({taken_.format, part.columns, part.rows, pictures_, at, std::move(bytes), edges(part)});
}

void Camera::sensor_reset(Cycle at) {
  sensor_.reset(at);
  exposure_s_ = kStartExposureS;
  ++exposed_;
  auto_red_ = auto_blue_ = 1;
  if (const sim::Scene* scene = robot_.scene()) sim::watch_leds(*scene);
}

void Camera::begin_again(Cycle at) {
  sensor_reset(at);
  refresh(at);
  frame_start_ = at;
  awaited_before_ = awaited_;
  first_rendered_ = rendered_ = 0;
  picture_.clear();
}

}  // namespace board
