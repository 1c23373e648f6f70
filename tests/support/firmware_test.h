// SPDX-License-Identifier: MIT
// The fixture for firmware tests, hardware-in-the-loop style: a world in a few lines, a robot with
// a controller, run for so long or until something happens, expect what the robot did.
// docs/testing.md is the guide.
//
//   TEST_F(FirmwareTest, blink_lights_the_ring) {
//     Robot& robot = add_robot("blink");
//     run_for(0.95);
//     EXPECT_TRUE(robot.led(0));
//     expect_no_traps();
//   }
#pragma once
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/chip/call_cost.h"
#include "hal_sim/runs/run.h"

namespace firmware_test {

class FirmwareTest;
class MemoryEnd;

/// The line of the test that called: as a default argument, so that a failure names it and not this file's.
struct Caller {
  const char* file;
  int line;
  static Caller here(const char* file = __builtin_FILE(), int line = __builtin_LINE()) {
    return {file, line};
  }
};

using Cost = chip::CallCost;

/// The test's end of a robot's serial line.
class SerialEnd {
 public:
  std::string text() const;             ///< everything sent so far
  void send(const std::string& bytes);  ///< arrives at the line's baud rate

 private:
  friend class FirmwareTest;
  FirmwareTest* test_ = nullptr;
  int robot_ = 0;
  MemoryEnd* end_ = nullptr;  // the UART's
};

/// One robot of a test. Before the first run it collects settings; afterwards it answers questions.
class Robot {
 public:
  // --- before the first run
  Robot& at(double x_m, double y_m, double heading_deg = 0);
  Robot& selector(int position);
  Robot& battery(double volts);
  /// UART 1 keeps the Bluetooth module, instead of a line that the test holds: for commands and links.
  Robot& bluetooth();
  /// Calls of its functions are measured: for cost_of(). It runs instruction by instruction then.
  Robot& measured();
  sim::RobotDesc& settings() { return desc_; }  ///< everything else a world file can say

  // --- while running
  double x_m() const { return pose().x_m; }
  double y_m() const { return pose().y_m; }
  double heading_deg() const { return sim::degrees(pose().heading_rad); }
  double distance_m() const;        ///< way travelled over the floor
  std::int64_t left_steps() const;  ///< motor steps since power-up, not wrapped
  std::int64_t right_steps() const;
  bool led(int number) const;          ///< 0 to 7 the ring, 8 body, 9 front
  std::uint32_t leds() const;          ///< the same as a mask
  bool pin(char port, int bit) const;  ///< level of a pin, e.g. ('D', 3): left motor, phase D
  int proximity(int sensor) const;     ///< what e_get_prox would give, counts
  int collisions() const;
  double longest_wall_touch_s() const;
  double cpu_load() const;      ///< share of cycles not spent waiting, 0 to 1
  std::int64_t cycles() const;  ///< instruction cycles since power-up
  /// The line of UART 1 or 2.
  SerialEnd& uart(int port);
  /// Lines that a program for Webots' interfaces wrote to the simulator's console so far.
  const std::vector<std::string>& console() const { return console_; }
  /// A virtual sensor, as a supervisor defines it.
  void define_sensor(const std::string& name, double value);
  void turn_selector(int position);
  /// Somebody presses a key of a remote control now, for `hold_s` seconds: key 0 to 63, address 0 to 31.
  void press_key(int key, double hold_s = 0.1, int address = 0);
  double battery_v() const;                                  ///< V at the terminals
  void push_to(double x_m, double y_m, double heading_deg);  ///< puts the robot somewhere else by hand

  /// Value of a global or static variable of the firmware by name (16-bit int by default).
  template <typename T = std::int16_t>
  T variable(const std::string& name, Caller caller = Caller::here()) const {
    T value{};
    copy_variable(name, &value, sizeof value, caller);
    return value;
  }

  /// The first `count` elements of an array of the firmware.
  template <typename T = std::int16_t>
  std::vector<T> variables(const std::string& name, std::size_t count, Caller caller = Caller::here()) const {
    std::vector<T> values(count);
    copy_variable(name, values.data(), count * sizeof(T), caller);
    return values;
  }

  /// Exact cycles of a call of a function of the firmware on the chip, callees included, handlers not
  /// (docs/time.md): in the run so far, if the robot is measured() and has called it, else by its code.
  Cost cost_of(const std::string& function, Caller caller = Caller::here()) const;

  const std::vector<host::TrapReport>& traps() const { return mind().runner()->traps(); }
  /// What board and chip have to say about the firmware so far (docs/controllers.md).
  std::vector<board::Diagnosis> diagnoses() const { return mind().runner()->diagnoses(); }
  /// The same, a line each: "place: cause: message; hint".
  std::string diagnoses_text() const;

 private:
  friend class FirmwareTest;
  sim::Pose2 pose() const;
  host::FirmwareMind& mind() const;
  void copy_variable(const std::string& name, void* to, std::size_t bytes, const Caller& caller) const;

  FirmwareTest* test_ = nullptr;
  int index_ = 0;
  sim::RobotDesc desc_;
  SerialEnd serial_[2];
  std::vector<std::string> console_;
  bool keeps_bluetooth_ = false, is_measured_ = false;
  std::shared_ptr<chip::Profile> profile_;
};

class FirmwareTest : public ::testing::Test {
 public:
  FirmwareTest();
  ~FirmwareTest() override;

 protected:
  // --- the world, before the first run
  sim::WorldDesc world;  ///< an empty floor without walls or noise; change anything
  void arena(double width_m, double depth_m);
  /// A fixed wall from one point to another, 10 cm high; colour parts 0 to 1.
  void wall(double x0_m, double y0_m, double x1_m, double y1_m, sim::Colour colour = {1, 1, 1});
  /// A fixed box with its centre at (x, y).
  void box(double x_m, double y_m, double size_m, double heading_deg = 0);
  /// Starts from a world file instead (path relative to the project).
  void load_world(const std::string& path, Caller caller = Caller::here());

  /// A robot with a controller: a name under firmware/, a folder, or a .so.
  Robot& add_robot(const std::string& firmware, const std::string& name = "");
  /// A robot with a controller written in the test itself.
  Robot& add_robot_with_source(const std::string& c_source, const std::string& name = "");
  /// A supervisor: a name under programs/supervisors/, a file or a folder (docs/connecting.md). Runs stop when
  /// it ends them.
  void add_supervisor(const std::string& program);
  /// A supervisor written in the test itself; "cpp" or "c".
  void add_supervisor_with_source(const std::string& source, const std::string& language = "cpp");
  Robot& robot(int index) { return *robots_[static_cast<std::size_t>(index)]; }

  // --- running
  void run_for(double seconds, Caller caller = Caller::here());
  /// Runs until `done` holds (looked at every tick) or `at_most_s` have passed; false then.
  bool run_until(const std::function<bool()>& done, double at_most_s, Caller caller = Caller::here());
  double now_s() const;
  std::uint64_t digest() const;
  void expect_no_traps(Caller caller = Caller::here()) const;
  /// No diagnosis of any robot.
  void expect_no_diagnoses(Caller caller = Caller::here()) const;
  /// Faults and stimuli (hal_sim/faults/injector.h); the runs look at them.
  faults::Injector& faults(Caller caller = Caller::here());
  /// The world's supervisors; started on first use.
  programs::Team& team();
  /// The run is over: every supervisor has its last go. How they ended it.
  const programs::Outcome& finish();
  /// Number of threads, extra flags for twinpuck-cc; before the first run. `options.coverage`: an lcov file
  /// that the counts of the test's programs are added to when it ends.
  twin::Options options;
  /// A register of a device of a robot's I2C bus, as another master reads it now.
  int bus_register(int robot, int address, int number);
  twin::Twin& twin(Caller caller = Caller::here());

 private:
  friend class Robot;
  friend class SerialEnd;
  void start(const Caller& caller);
  void step();

  std::vector<std::unique_ptr<Robot>> robots_;
  std::unique_ptr<runs::Run> run_;
  twin::Twin* twin_ = nullptr;  // the run's
};

}  // namespace firmware_test
