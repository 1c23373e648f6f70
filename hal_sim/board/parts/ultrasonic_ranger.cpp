// SPDX-License-Identifier: MIT
// Devantech SRF08 or SRF10: an ultrasonic ranger that looks forward, with a light sensor (SRF08).
//
//   register 0   read: version         write: 80, 81, 82 start a ranging in inches, cm, us
//            1   read: light at the last ranging     write: greatest gain (no effect)
//            2 3 read: first echo, high byte first, 0 nothing   2 write: greatest range, steps of 43 mm
//
// Modelled: 65 ms a ranging (less with a smaller range), during which nobody answers and reads give 0xFF; the
// beam as a fan of rays, surfaces that are turned away too far unseen; the floor unseen. The world is that of
// the moment of the command. Not modelled: echoes beyond the first (0), gain, crosstalk between robots,
// changing the address, the broadcast address 0. Source: the makers' manuals, facts restated.
#include <algorithm>
#include <cmath>

#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/parts_params.h"
#include "sim_core/light/proximity.h"
#include "sim_core/sound/sound_params.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

class UltrasonicRanger final : public Part, public I2cRegisters {
 public:
  explicit UltrasonicRanger(const PartSettings& settings)
      : Part(settings),
        I2cRegisters(static_cast<std::uint8_t>(settings.integer("address") & 0xFE)),
        has_light_(settings.text("model") == "srf08"),
        heading_rad_(sim::radians(settings.number("heading"))),
        height_m_(settings.number("height")),
        noise_m_(settings.number("noise")) {}

  void connect() override { board().i2c().attach(*this); }

  void begin_again(Cycle) override {
    busy_until_ = 0;
    range_ = 255;
    result_ = 0;
    light_ = kRangerLightDark;
    rangings_ = 0;
  }

  std::uint64_t state_hash() const override {
    return static_cast<std::uint64_t>(busy_until_) * 0x9E3779B97F4A7C15u +
           (static_cast<std::uint64_t>(result_) << 24 ^ static_cast<std::uint64_t>(light_) << 16 ^
            static_cast<std::uint64_t>(range_) << 8 ^ rangings_);
  }

 private:
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) override {
    if (at < busy_until_) return false;
    if (number == 2) range_ = value;
    if (number == 0 && value >= kRangerInches && value <= kRangerUs) measure(value, at);
    return true;
  }

  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    if (at < busy_until_) return 0xFF;
    switch (number) {
      case 0:
        return has_light_ ? kSrf08Version : kSrf10Version;
      case 1:
        return static_cast<std::uint8_t>(has_light_ ? light_ : kRangerNoLight);
      case 2:
        return static_cast<std::uint8_t>(result_ >> 8);
      case 3:
        return static_cast<std::uint8_t>(result_ & 0xFF);
      default:
        return 0;
    }
  }

  void measure(int command, Cycle at) {
    busy_until_ = at + kRangingCycles * (range_ + 1) / kRangerSteps;
    light_ = light(at);
    ++rangings_;
    double range_m = distance_m(std::min(kRangerReachM, (range_ + 1) * kRangerStepM), at);
    result_ = 0;
    if (range_m < 0) return;
    range_m += noise_m_ * sim::random_gaussian(random(0), rangings_);
    const double flight_us = 2e6 * std::max(range_m, kRangerNearestM) / sim::kSoundSpeedMs;
    const double unit_us = command == kRangerUs ? 1 : command == kRangerCm ? kUsPerCm : kUsPerInch;
    result_ = static_cast<int>(std::min(flight_us / unit_us, 65535.0));
  }

  /// Nearest surface in the beam that sends sound back, m; negative: none.
  double distance_m(double limit_m, Cycle at) const {
    const sim::Scene* scene = board().scene();
    if (!scene) return -1;
    const sim::Vec2 eye = to_world({kRangerForwardM, 0}, at);
    const double ahead = pose(at).heading_rad + heading_rad_;
    const double mirror = sim::sin_cos(kRangerMirrorRad).c;
    double nearest = -1;
    for (int up = 0; up < kRangerRaysUp; ++up) {
      for (int across = 0; across < kRangerRaysAcross; ++across) {
        const double lift = kRangerHalfBeamRad * (2.0 * up / (kRangerRaysUp - 1) - 1);
        const double side = kRangerHalfBeamRad * (2.0 * across / (kRangerRaysAcross - 1) - 1);
        const sim::SinCos yaw = sim::sin_cos(ahead + side), pitch = sim::sin_cos(lift);
        const sim::Vec3 dir{yaw.c * pitch.c, yaw.s * pitch.c, pitch.s};
        sim::SceneHit hit;
        if (!scene->cast({{eye.x, eye.y, height_m_}, dir}, limit_m, board().setup().robot,
                         board().clock().click_at(at), &hit) ||
            hit.floor)
          continue;
        const double facing = -(dir.x * hit.normal.x + dir.y * hit.normal.y + dir.z * hit.normal.z);
        if (facing < mirror) continue;
        if (nearest < 0 || hit.distance_m < nearest) nearest = hit.distance_m;
      }
    }
    return nearest;
  }

  /// From the two foremost light sensors of the robot, which look the same way.
  int light(Cycle at) const {
    const sim::Scene* scene = board().scene();
    if (!scene) return kRangerLightDark;
    const sim::Clicks when = board().clock().click_at(at);
    const double w_m2 = (sim::sense_irradiance_w_m2(*scene, board().setup().robot, 0, when) +
                         sim::sense_irradiance_w_m2(*scene, board().setup().robot, 7, when)) /
                        2;
    const double share = std::clamp(w_m2 / kRangerBrightWM2, 0.0, 1.0);
    return static_cast<int>(
        std::floor(kRangerLightDark + (kRangerLightBright - kRangerLightDark) * share + 0.5));
  }

  bool has_light_;
  double heading_rad_;
  double height_m_;
  double noise_m_;
  Cycle busy_until_ = 0;
  int range_ = 255;
  int result_ = 0;
  int light_ = kRangerLightDark;
  std::uint64_t rangings_ = 0;
};

}  // namespace

const PartType& part_ultrasonic_ranger() {
  using sim::OwnKeyType;
  static const PartType type{
      {"ultrasonic-ranger",
       "Devantech SRF08 or SRF10, looking forward from a turret.",
       {{"model", OwnKeyType::Choice, "", 0, 0, "srf08|srf10", "\"srf08\"", "the SRF10 has no light sensor"},
        {"address", OwnKeyType::Integer, "", 0xE0, 0xFE, "", "224", "8-bit I2C address, even: 224 is 0xE0",
         2},
        {"heading", OwnKeyType::Number, "deg", -180, 180, "", "0",
         "where it looks, counter-clockwise from forward"},
        {"height", OwnKeyType::Number, "m", 0.01, 0.5, "", "0.06", "above the floor"},
        {"noise", OwnKeyType::Number, "m", 0, 0.1, "", "0.003", "standard deviation of a distance"}}},
      make_part<UltrasonicRanger>};
  return type;
}

}  // namespace board
