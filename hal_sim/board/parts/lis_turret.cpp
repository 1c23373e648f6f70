// SPDX-License-Identifier: MIT
// The sensor turret of LIS: a memory that tells it from no turret, a Sharp GP2D120 distance sensor, five
// LEDs. Ranger and compass are parts of their own.
//
//   0xA2            256 bytes that keep what is written (a write takes 5 ms, during which nobody answers)
//   RG6 to RG9, RB6 LEDs 1 to 5, low is on (an inverter drives them)
//   RB7             supply of the Sharp sensor, low is on
//   AN5             its output, volts: 0.40 at 30 cm, 2.65 at 4 cm
//
// Modelled: the sensor measures over and over, 28.7 ms each, beginning when its supply comes; its output is
// that of the last measurement, 0 V before the first. Not modelled: the unstable output after the supply
// comes; the colour of surfaces (it does not depend on it); LEDs as light in the world. The library's remark
// that the supply cannot be switched off on its turret is not followed. Source: [lib:
// contrib/LIS_sensors_turret/], the maker's data sheet.
#include <algorithm>
#include <array>

#include "hal_sim/board/board.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/parts_params.h"
#include "sim_core/world/scene.h"

namespace board {

namespace {

constexpr std::uint8_t kErased = 0xFF;

class LisTurret final : public Part, public I2cRegisters {
 public:
  explicit LisTurret(const PartSettings& settings) : Part(settings), I2cRegisters(kTurretAddress) {
    memory_.fill(kErased);
  }

  void connect() override { board().i2c().attach(*this); }

  void pins_changed(Cycle at) override {
    const bool on = drives_low('B', kSharpSupplyBit, at);
    if (on && !is_on_) on_since_ = at;
    is_on_ = on;
  }

  void processor_reset(Cycle at) override { pins_changed(at); }

  void begin_again(Cycle) override {
    memory_.fill(kErased);
    busy_until_ = 0;
  }

  std::optional<double> analogue_v(int channel, Cycle at) const override {
    if (channel != kSharpChannel) return std::nullopt;
    const Cycle measured = is_on_ ? (at - on_since_) / kSharpPeriod : 0;
    if (measured < 1) return 0.0;
    return level_v(distance_m(on_since_ + (measured - 1) * kSharpPeriod));
  }

  std::string shows(Cycle at) const override {
    std::string out = "LEDs ";
    for (int led = 0; led < 4; ++led) out += drives_low('G', 6 + led, at) ? '1' : '0';
    return out + (drives_low('B', 6, at) ? '1' : '0');
  }

  std::uint64_t state_hash() const override {
    std::uint64_t sum = (static_cast<std::uint64_t>(on_since_) << 1 | (is_on_ ? 1u : 0u)) ^
                        static_cast<std::uint64_t>(busy_until_) << 20;
    for (std::uint8_t byte : memory_) sum = sum * 0x100000001B3u + byte;
    return sum;
  }

 private:
  bool write_register(std::uint8_t number, std::uint8_t value, Cycle at) override {
    if (at < busy_until_) return false;
    memory_[number] = value;
    busy_until_ = at + kTurretWriteCycles;
    return true;
  }
  std::uint8_t read_register(std::uint8_t number, Cycle at) override {
    return at < busy_until_ ? kErased : memory_[number];
  }

  bool drives_low(char port, int bit, Cycle at) const {
    const unsigned mask = 1u << bit;
    return !(board().pins().read(port, Pins::Register::Tris, at) & mask) &&
           !(board().pins().read(port, Pins::Register::Lat, at) & mask);
  }

  double distance_m(Cycle at) const {
    const sim::Scene* scene = board().scene();
    if (!scene) return kSharpReachM;
    const sim::Vec2 eye = to_world({kSharpForwardM, 0}, at);
    const sim::SinCos ahead = sim::sin_cos(pose(at).heading_rad);
    sim::SceneHit hit;
    const bool seen = scene->cast({{eye.x, eye.y, kSharpHeightM}, {ahead.c, ahead.s, 0}}, kSharpReachM,
                                  board().setup().robot, board().clock().click_at(at), &hit);
    return seen ? hit.distance_m : kSharpReachM;
  }

  static double level_v(double distance_m) {
    const double cm = distance_m * 100;
    const double beyond_peak_v = kSharpVCm / (std::max(cm, kSharpPeakCm) + kSharpOffsetCm);
    return cm < kSharpPeakCm ? beyond_peak_v * cm / kSharpPeakCm : beyond_peak_v;
  }

  std::array<std::uint8_t, 256> memory_;
  Cycle busy_until_ = 0;
  bool is_on_ = false;
  Cycle on_since_ = 0;
};

}  // namespace

const PartType& part_lis_turret() {
  static const PartType type{
      {"lis-turret", "LIS sensor turret: memory at 0xA2, Sharp distance sensor on AN5, five LEDs.", {}},
      make_part<LisTurret>};
  return type;
}

}  // namespace board
