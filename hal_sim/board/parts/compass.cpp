// SPDX-License-Identifier: MIT
// Devantech CMPS03: a compass at I2C address 0xC0 (that of the ground sensors: a robot
// carries one of the two).
//
//   register 0 version   1 bearing 0 to 255   2 3 bearing 0 to 3599, high byte first   others 0
//
// Modelled: bearings clockwise from north (+y of the world) in tenths of a degree, a new one every 40
// ms, noise, a fixed error. Two bytes of one word that are read across the change of a bearing do not
// fit, as on the sensor. Not modelled: calibration, the field of motors and iron. Source: the maker's
// manual, facts restated.
#include <cmath>

#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/parts_params.h"

namespace board {

namespace {

class Compass final : public Part, public I2cRegisters {
 public:
  explicit Compass(const PartSettings& settings)
      : Part(settings),
        I2cRegisters(kCompassAddress),
        noise_deg_(settings.number("noise")),
        offset_deg_(settings.number("offset")) {}

  void connect() override { board().i2c().attach(*this); }

 private:
  bool write_register(std::uint8_t, std::uint8_t, Cycle) override { return true; }

  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    switch (number) {
      case 0:
        return kCompassVersion;
      case 1:
        return static_cast<std::uint8_t>(tenths(at) * 256 / kCompassTurn);
      case 2:
        return static_cast<std::uint8_t>(tenths(at) >> 8);
      case 3:
        return static_cast<std::uint8_t>(tenths(at) & 0xFF);
      default:
        return 0;
    }
  }

  int tenths(Cycle at) const {
    const Cycle sample = since_begin(at) / kCompassPeriod;
    const Cycle taken = at - since_begin(at) % kCompassPeriod;
    double bearing_deg = 90 - sim::degrees(pose(taken).heading_rad) + offset_deg_;
    bearing_deg += noise_deg_ * sim::random_gaussian(random(0), static_cast<std::uint64_t>(sample));
    const int tenths = static_cast<int>(std::floor(bearing_deg * 10 + 0.5)) % kCompassTurn;
    return tenths < 0 ? tenths + kCompassTurn : tenths;
  }

  double noise_deg_;
  double offset_deg_;
};

}  // namespace

const PartType& part_compass() {
  static const PartType type{
      {"compass",
       "Devantech CMPS03 at I2C address 0xC0, north is +y.",
       {{"noise", sim::OwnKeyType::Number, "deg", 0, 180, "", "0.3", "standard deviation of a bearing"},
        {"offset", sim::OwnKeyType::Number, "deg", -180, 180, "", "0", "added to every bearing, clockwise"}}},
      make_part<Compass>};
  return type;
}

}  // namespace board
