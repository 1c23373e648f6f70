// SPDX-License-Identifier: MIT
// The e-puck as a program of the PC commands it: devices with names and tags, on the board and
// the library's drivers.
//
//   records of commands -> Puck -> drivers/ and board/ -> pins, coils, codec ...
//   board/, drivers/ -> Puck -> records of samples
//
// Units, ranges, refresh and noise are those of the robot's own library: proximity and light in counts of
// the scan (one pair each 17 ms), motors in steps, the camera at its own rate of frames, the accelerometer
// as the mean of five samples. GPS, compass, inertial unit and devices of [[robot.device]] are the
// simulator's truth. Sources: docs/webots.md. Instants are cycles of the robot's clock and never go back.
// One thread at a time.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/board/board.h"
#include "hal_sim/drivers/camera_capture.h"
#include "hal_sim/drivers/drivers.h"
#include "hal_sim/drivers/sound_driver.h"
#include "programs/link/packet.h"
#include "programs/puck/camera.h"
#include "programs/puck/wheels.h"

namespace sim {
struct WorldDesc;
}

namespace programs {

using board::Cycle;
using board::kNever;

class Puck {
 public:
  /// Takes the board over: pins as e_init_port() leaves them, scan and motors' agendas run from `start` on.
  /// The board outlives it.
  Puck(board::Board& board, Cycle start);

  /// Appends a DEVICE for each device. The world says by what law the proximity sensors answer.
  void tell_devices(const sim::WorldDesc& world, link_packet& to);
  /// Appends DEVICE for one that was defined meanwhile (a supervisor's sensor), or NOTHING.
  void find_device(const std::string& name, link_packet& to);

  /// Name of the device with this tag; empty: there is none.
  std::string device_name(std::int64_t tag) const {
    return tag >= 1 && tag <= static_cast<std::int64_t>(devices_.size())
               ? devices_[static_cast<std::size_t>(tag - 1)].name
               : "";
  }

  /// A PROGRAM's record about a device (ENABLE to RECOGNISE). Empty, or what was wrong with it.
  std::string command(const link_record& record, Cycle at);
  /// `milliseconds` are over: samples of what is due, appended.
  void sample(std::int64_t milliseconds, Cycle at, link_packet& to);

  /// Something has to be done then, before anybody looks.
  Cycle next_event() const;
  /// What is due up to `at` is done.
  void run(Cycle at);
  struct Kept;
  /// What a program that goes on after a reset relies on: its devices, with their tags and periods.
  std::shared_ptr<const Kept> keep() const;
  void adopt(const Kept& kept, Cycle at);
  /// Motors and lights stop; nothing is sampled.
  void stop(Cycle at);
  /// Of what was commanded and sampled.
  std::uint64_t hash() const { return hash_; }
  const drivers::Drivers& drivers() const { return drivers_; }

 private:
  enum class Kind {
    Proximity,
    Light,
    Ground,
    Virtual,
    Led,
    Motor,
    Encoder,
    Accelerometer,
    Gyro,
    TrueGyro,
    Camera,
    Microphone,
    Speaker,
    Emitter,
    Receiver,
    Gps,
    Compass,
    Inertial,
    Display,
    Selector,
    Battery,
    Keyboard,
    Tof,
    Distance,  // of [[robot.device]], with a table
    Ranges,
    Idle  // there for the program, and does nothing
  };
  struct Device {
    std::string name;
    Kind kind;
    int node;   // WbNodeType
    int index;  // among its kind; of Distance and Ranges among the setup's devices
    std::vector<double> needs;
    std::int64_t period_ms = 0, elapsed_ms = 0;
  };

  void add(const std::string& name, Kind kind, int node, int index, std::vector<double> needs = {});
  void add_own(const sim::WorldDesc& world);
  void add_of_world();
  void tell(std::size_t device, link_packet& to) const;
  void enable(Device& device, std::int64_t period_ms, Cycle at);
  void take(const Device& device, std::size_t number, Cycle at, link_packet& to);
  double proximity(int sensor, Cycle at);
  double light(int sensor, Cycle at);
  double ground(int sensor, Cycle at);
  double time_of_flight(Cycle at) const;
  void take_ranges(const sim::DeviceDesc& desc, std::int64_t tag, Cycle at, link_packet& to) const;
  sim::Vec3 acceleration(Cycle at);
  sim::Vec3 rates(Cycle at);
  void take_sound(int microphone, std::int64_t tag, Cycle at, link_packet& to);
  void take_packets(const Device& device, std::int64_t tag, link_packet& to);
  void set_led(int led, bool on, Cycle at);
  std::string play(std::int64_t tag, const std::string& sound, bool again, Cycle at);
  sim::Vec3 in_world_axes(const sim::Vec3& forward_left_up) const;
  void recognise(std::int64_t milliseconds, Cycle at, link_packet& to);
  void tell_playing(Cycle at, link_packet& to);
  void note(std::uint64_t what);

  board::Board& board_;
  drivers::Drivers drivers_;
  drivers::CameraCapture capture_;
  drivers::SoundDriver speaker_;
  Wheels wheels_;
  std::unique_ptr<PuckCamera> camera_;
  std::vector<Device> devices_;
  bool has_lsm_ = false;
  std::uint64_t hash_ = 1;

  // the loudspeaker
  int sound_ = -1;  // number of the stored sound that plays
  bool again_ = false, speaks_ = false;
  std::string playing_, told_playing_;  // as the program names it; empty: nothing

  std::int64_t recognition_period_ms_ = 0, recognition_elapsed_ms_ = 0;
  Cycle sound_until_ = 0;
};

}  // namespace programs
