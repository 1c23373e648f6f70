// SPDX-License-Identifier: MIT
// Ground sensors: three infra-red sensors that look down, and two for edges, at I2C address 0xC0.
//
//   register  0 1 left   2 3 centre   4 5 right     high byte first, 0 to about 1000: bright floors are high
//            13 14 left cliff   15 16 right cliff   the same scale
//
// Modelled: place, the lookup table of the published model with its colour rule (white 856, black 300), the
// spot's mean over five points, noise, floor colour and floor image, objects under the robot are not. A low
// byte belongs to the high byte read before it. Other registers read 0. Writing does nothing. Source: [FRM
// A5] (docs/dev/sources.md); registers from programs that read the board.
#include <algorithm>
#include <cmath>

#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/parts_params.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

constexpr sim::Vec2 kPlaces[] = {{kGroundForwardM, kGroundSideM},
                                 {kGroundForwardM, 0},
                                 {kGroundForwardM, -kGroundSideM},
                                 {kGroundForwardM, kCliffSideM},
                                 {kGroundForwardM, -kCliffSideM}};

class GroundSensors final : public Part, public I2cRegisters {
 public:
  explicit GroundSensors(const PartSettings& settings)
      : Part(settings),
        I2cRegisters(kGroundAddress),
        noise_(settings.number("noise")),
        height_m_(settings.number("height")) {}

  void connect() override { board().i2c().attach(*this); }

  std::uint64_t state_hash() const override { return static_cast<std::uint64_t>(word_); }

 private:
  bool write_register(std::uint8_t, std::uint8_t, Cycle) override { return true; }

  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    const int byte = number < kGroundFirstCliff ? number : number - kGroundFirstCliff + 6;
    if (byte >= 10 || (number > 5 && number < kGroundFirstCliff)) return 0;
    if (byte % 2 == 0) word_ = counts(byte / 2, at);
    return static_cast<std::uint8_t>(byte % 2 == 0 ? word_ >> 8 : word_ & 0xFF);
  }

  int counts(int sensor, Cycle at) const {
    const double red = reflectance(kPlaces[sensor], at);
    const double apparent_m = height_m_ / (kGroundDarkFactor + (1 - kGroundDarkFactor) * red);
    double value =
        kGroundNearCounts + (kGroundFarCounts - kGroundNearCounts) * std::min(apparent_m / kGroundFarM, 1.0);
    // one sample a period, however often it is read
    const std::uint64_t sample = static_cast<std::uint64_t>(since_begin(at) / kGroundPeriod);
    if (noise_ > 0) value *= 1 + noise_ * sim::random_gaussian(random(sensor), sample);
    return static_cast<int>(std::clamp(std::floor(value + 0.5), 0.0, 65535.0));
  }

  /// Mean over the middle of the spot and four points on its edge; 0 in a void.
  double reflectance(sim::Vec2 place_m, Cycle at) const {
    const sim::Scene* scene = board().scene();
    if (!scene) return 0;
    constexpr sim::Vec2 kSpot[] = {
        {0, 0}, {kGroundSpotM, 0}, {-kGroundSpotM, 0}, {0, kGroundSpotM}, {0, -kGroundSpotM}};
    double sum = 0;
    for (sim::Vec2 offset : kSpot)
      sum += sim::floor_at(scene->world(), to_world(place_m + offset, at)).ir_reflectance;
    return sum / 5;
  }

  double noise_;
  double height_m_;
  int word_ = 0;  // whose low byte is still to be read
};

}  // namespace

const PartType& part_ground_sensors() {
  static const PartType type{
      {"ground-sensors",
       "Three infra-red sensors that look at the floor and two at its edges, I2C address 0xC0.",
       {{"noise", sim::OwnKeyType::Number, "", 0, 1, "", "0.1",
         "standard deviation of a reading, as a part of it; 0 switches it off"},
        {"height", sim::OwnKeyType::Number, "m", 0.0005, 0.05, "", "0.0033",
         "of the sensors above the floor"}}},
      make_part<GroundSensors>};
  return type;
}

}  // namespace board
