// SPDX-License-Identifier: MIT
// The example of docs/extending.md: a colour sensor under the robot's middle, at I2C address 0x52.
//
//   register 0 red   1 green   2 blue, 0 to 255        register 3 gain, 1 to 16, may be written
//
// Modelled: the floor's colour where the sensor is, noise. Not modelled: height, ambient
// light. Source: invented.
#include <algorithm>
#include <cmath>

#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

class FloorColour final : public Part, public I2cRegisters {
 public:
  explicit FloorColour(const PartSettings& settings)
      : Part(settings),
        I2cRegisters(0x52),
        forward_m_(settings.number("forward")),
        noise_(settings.number("noise")) {}

  void connect() override { board().i2c().attach(*this); }
  std::uint64_t state_hash() const override { return static_cast<std::uint64_t>(gain_); }

  void begin_again(Cycle) override { gain_ = 1; }

 private:
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle) override {
    if (number != 3) return false;  // not acknowledged
    gain_ = std::clamp<int>(value, 1, 16);
    return true;
  }

  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    if (number == 3) return static_cast<std::uint8_t>(gain_);
    if (number > 3 || !board().scene()) return 0;
    const sim::Colour seen = sim::floor_at(board().scene()->world(), to_world({forward_m_, 0}, at)).colour;
    double level = 255 * gain_ * (number == 0 ? seen.r : number == 1 ? seen.g : seen.b);
    level += noise_ * sim::random_gaussian(random(number), static_cast<std::uint64_t>(since_begin(at)));
    return static_cast<std::uint8_t>(std::clamp(std::floor(level + 0.5), 0.0, 255.0));
  }

  double forward_m_;
  double noise_;
  int gain_ = 1;
};

}  // namespace

const PartType& part_floor_colour() {
  static const PartType type{
      {"floor-colour",
       "Example of docs/extending.md: the colour of the floor under the robot, I2C address 0x52.",
       {{"forward", sim::OwnKeyType::Number, "m", -0.03, 0.03, "", "0", "where it sits, from the middle"},
        {"noise", sim::OwnKeyType::Number, "", 0, 50, "", "1", "standard deviation of a reading"}}},
      make_part<FloorColour>};
  return type;
}

}  // namespace board
