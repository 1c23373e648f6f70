// SPDX-License-Identifier: MIT
// What passes between robots: the radio channel, and short-range serial links.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sim {

enum class RadioModel { LogDistance, Disc };

/// The radio channel that robots with a radio share.
struct RadioDesc {
  RadioModel model = RadioModel::LogDistance;
  /// Where a frame sent at full power is just received. [assumed: 15 cm to 5 m, reported for this turret]
  double range_m = 5;
  double exponent = 3.3;  ///< path loss per decade over 10 dB [derived: that span over 50 dB of attenuation]
  double fading_db = 2;   ///< standard deviation of the level, drawn per frame and receiver [assumed: a room]
  double loss = 0;        ///< part of the frames within range that is lost for no other reason, 0 to 1
  double capture_db =
      3;  ///< the stronger of two frames survives from here on [CC2420 SWRS041: co-channel -3 dB]
  bool carrier_sense = true;          ///< listen before sending, with random waits
  std::optional<std::uint64_t> seed;  ///< of fading, loss and waits; unset: the world's
};

/// A time in which links are lost.
struct Dropout {
  double begin_s = 0;
  double span_s = 0;
};

/// The short-range serial links between robots, or from a robot to a computer.
struct LinkDesc {
  double range_m = 10;       ///< [LMX9838 datasheet: class 2 radio, 10 m]
  double latency_s = 0.008;  ///< one way [measured: 50 to 100 commands and answers per second on the robot]
  double bandwidth_bit_s =
      115200;             /**< per direction [assumed: the modules' serial lines are the narrowest part] */
  double timeout_s = 20;  ///< silence after which a link is lost [Bluetooth core: supervision timeout]
  std::vector<Dropout> dropouts;  ///< of every robot, growing
  double dropout_rate_hz = 0;     ///< further ones by chance, per robot
  double dropout_span_s = 1;      ///< their length
};

/// One robot's end of such links.
struct LinkEndDesc {
  int number = -1;                  ///< negative: its index in the world plus 1
  std::optional<std::string> name;  ///< what others find; unset: made of the number by the board
  std::optional<std::string> pin;   ///< unset: the number, four digits
  std::vector<Dropout> dropouts;    ///< of this robot alone, growing
};

}  // namespace sim
