// SPDX-License-Identifier: MIT
// One e-puck among many: what all its sensors start from. How it is set up, its clock, the noise of its
// samples, what is wrong with it, and the scene in which it stands. It knows no pin and no device.
#pragma once
#include <memory>

#include "hal_sim/board/clock.h"
#include "hal_sim/board/damage.h"
#include "hal_sim/board/noise.h"
#include "hal_sim/board/setup.h"

namespace sim {
class Scene;
}

namespace board {

class Specimen {
 public:
  explicit Specimen(const Setup& setup);
  Specimen(const Specimen&) = delete;
  Specimen& operator=(const Specimen&) = delete;

  const Setup& setup() const { return setup_; }
  const RobotClock& clock() const { return clock_; }
  /// What draws the noise of this robot's samples.
  const SampleNoise& noise() const { return noise_; }

  /// The frozen scene that sensors see until the next call; null: a dark void. Called before each run window.
  void look_at(const sim::Scene* scene);
  const sim::Scene* scene() const { return scene_; }
  /// Do lamps shine in the scene, or ambient light? Does anything sound in it?
  bool is_lit() const { return is_lit_; }
  bool is_sounding() const { return is_sounding_; }

  /// Null: nothing was ever wrong with it.
  const Damage* damage() const { return damage_.get(); }
  /// For doing damage; made when it is asked for first. Sensors that a program has never read before see it
  /// from the cycles on that its numbers name; who changes dead LEDs or held pins calls
  /// Pins::changed_by_hand().
  Damage& be_damaged();
  /// Parts per million that the crystal is fast, from world time `at` on.
  void set_clock_ppm(double ppm, sim::Clicks at);
  /// Position 0 to 15 of the selector, turned by hand (or a test) while it runs.
  void turn_selector(int position) { setup_.selector = position & 15; }
  int selector() const { return setup_.selector; }

 protected:
  ~Specimen() = default;
  /// World time `now`, which is cycle `at`: clock and noise as at the beginning, nothing is wrong any more.
  void begin_specimen_again(sim::Clicks now, Cycle at);

 private:
  // what every run looks at, together
  const sim::Scene* scene_ = nullptr;
  bool is_lit_ = false, is_sounding_ = false;
  RobotClock clock_;
  std::unique_ptr<Damage> damage_;
  SampleNoise noise_;
  Setup setup_;
};

}  // namespace board
