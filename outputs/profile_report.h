// SPDX-License-Identifier: MIT
// --profile: where the time of robots goes (hal_sim/chip/profile.h), as text and JSON.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/chip/profile.h"
#include "hal_sim/twin/twin.h"

namespace outputs {

/// A robot's runner if it runs firmware, else null.
chip::ChipRunner* chip_runner(twin::Twin& twin, int robot);

/// Profiles of all robots of a world that run firmware.
class Profiles {
 public:
  explicit Profiles(twin::Twin& twin) : twin_(twin) {}
  ~Profiles();
  /// From here on; a line in `problems` if no robot runs firmware.
  void begin(const std::string& option, std::vector<std::string>& problems);

  struct Named {
    std::string robot;
    chip::ProfileReport report;
    const dspic::FirmwareFile* program;  ///< the runner's
  };
  std::vector<Named> reports() const;

 private:
  struct Watched {
    int robot;
    chip::ChipRunner* runner;
    std::unique_ptr<chip::Profile> profile;
  };
  twin::Twin& twin_;
  std::vector<Watched> watched_;
};

double micros(double cycles);
/// A path below the current folder, or the project's, is named from there.
std::string from_here(const std::string& path);
/// Does such a path belong to the library and what serves it, and not to the program? One
/// without a source does.
bool is_library_place(const std::string& place);
std::string to_text(const std::string& robot, const chip::ProfileReport& report);
std::string to_json(const std::vector<Profiles::Named>& profiles);

}  // namespace outputs
