// SPDX-License-Identifier: MIT
// The radio turret of SWIS as a part; what it does stands in radio_turret.h. The channel that all of them
// share is made by whoever makes the world (hal_sim/twin).
#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/radio_turret.h"

namespace board {

namespace {

class Radio final : public Part {
 public:
  explicit Radio(const PartSettings& settings) : Part(settings) {}
  void connect() override {
    turret_ = std::make_unique<RadioTurret>(board().clock(), board().setup().robot);
    board().i2c().attach(*turret_);
  }

 private:
  std::unique_ptr<RadioTurret> turret_;
};

}  // namespace

const PartType& part_radio() {
  static const PartType type{
      {"radio", "Packet radio of the ZigBee kind, I2C address 0x7E; its channel is `[radio]`.", {}},
      make_part<Radio>};
  return type;
}

}  // namespace board
