// SPDX-License-Identifier: MIT
// Programs of the PC in tests: written in the test in C, C++ or Python, each in a folder of its own; what
// they print is what the test looks at.
//
//   Robot& r = add_c("WbDeviceTag gps;", "gps = wb_robot_get_device(\"gps\"); wb_gps_enable(gps, 64);",
//                    "printf(\"x %g\\n\", wb_gps_get_values(gps)[0]);");
//   run_for(1);
//   EXPECT_NEAR(told(r, "x")[0], 0.2, 1e-5);
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "sim_core/base/hash.h"
#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace programs_test {

namespace fs = std::filesystem;
using firmware_test::Robot;

/// A folder with one program, named after its content: built once however often it is run.
inline std::string program_folder(const std::string& source, const std::string& ending) {
  std::uint64_t h = source.size();
  for (const unsigned char c : source + ending) h = sim::mix64(h ^ c);
  char name[32];
  std::snprintf(name, sizeof name, "p%016llx", static_cast<unsigned long long>(h));
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "programs_inline" / name;
  fs::create_directories(folder);
  const fs::path file = folder / (name + ("." + ending));
  if (!fs::exists(file)) std::ofstream(file) << source;
  return folder.string();
}

/// Today's interface, whole.
inline const char* const kHeaders =
    "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n#include <time.h>\n"
    "#include <webots/accelerometer.h>\n#include <webots/camera.h>\n#include <webots/compass.h>\n"
    "#include <webots/device.h>\n#include <webots/differential_wheels.h>\n#include <webots/display.h>\n"
    "#include <webots/distance_sensor.h>\n#include <webots/emitter.h>\n#include <webots/gps.h>\n"
    "#include <webots/gyro.h>\n#include <webots/inertial_unit.h>\n#include <webots/keyboard.h>\n"
    "#include <webots/led.h>\n#include <webots/light_sensor.h>\n#include <webots/microphone.h>\n"
    "#include <webots/motor.h>\n#include <webots/position_sensor.h>\n#include <webots/receiver.h>\n"
    "#include <webots/robot.h>\n#include <webots/speaker.h>\n#include <webots/supervisor.h>\n";

/// Declarations, what runs before the loop, the loop's body: `steps` counts.
inline std::string c_program(const std::string& globals, const std::string& before, const std::string& loop,
                             int step_ms = 64) {
  return kHeaders + ("int steps;\n" + globals) +
         "\nint main(int argc, char **argv) {\n(void)argc; (void)argv;\n" + "wb_robot_init();\n" + before +
         "\nwhile (wb_robot_step(" + std::to_string(step_ms) + ") != -1) {\nsteps++;\n" + loop +
         "\n}\nwb_robot_cleanup();\nreturn 0;\n}\n";
}

class ProgramTest : public firmware_test::FirmwareTest {
 protected:
  Robot& add_c(const std::string& globals, const std::string& before, const std::string& loop,
               int step_ms = 64, const std::string& name = "") {
    return add_robot(program_folder(c_program(globals, before, loop, step_ms), "c"), name);
  }
  Robot& add_source(const std::string& source, const std::string& ending = "c",
                    const std::string& name = "") {
    return add_robot(program_folder(source, ending), name);
  }
  void add_supervisor_in_c(const std::string& globals, const std::string& before, const std::string& loop,
                           int step_ms = 64) {
    add_supervisor(program_folder(c_program(globals, before, loop, step_ms), "c"));
  }

  static sim::DeviceDesc device(const std::string& name, sim::DeviceKind kind) {
    sim::DeviceDesc d;
    d.name = name;
    d.kind = kind;
    return d;
  }
  static void add_part(Robot& robot, const std::string& kind) {
    robot.settings().parts.push_back({});
    robot.settings().parts.back().kind = kind;
  }

  /// The numbers behind the last line that begins with this word; empty: there is none.
  static std::vector<double> told(const Robot& robot, const std::string& key) {
    return numbers_in(robot.console(), key);
  }
  static double value(const Robot& robot, const std::string& key) {
    const auto all = told(robot, key);
    if (all.empty()) {
      ADD_FAILURE() << "nothing was told of '" << key << "'";
      return 0;
    }
    return all[0];
  }
  static std::vector<double> numbers_in(const std::vector<std::string>& lines, const std::string& key) {
    for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
      if (line->rfind(key + " ", 0) != 0) continue;
      std::istringstream words(line->substr(key.size()));
      std::vector<double> numbers;
      for (std::string word; words >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
      return numbers;
    }
    return {};
  }

  /// Lines of supervisors from now on.
  void listen() {
    team().say = [this](const std::string& line) { said.push_back(line); };
  }
  std::vector<std::string> said;
};

}  // namespace programs_test
