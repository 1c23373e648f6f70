// SPDX-License-Identifier: MIT
#include "hal_sim/twin/world_file.h"

#include <filesystem>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/twin/robot_check.h"

namespace twin {
namespace {

sim::LoadedWorld with_robots_checked(sim::LoadedWorld loaded) {
  loaded.add(check_robots(loaded.world ? *loaded.world : loaded.draft));
  return loaded;
}

}  // namespace

std::vector<sim::RobotModel> robot_models() {
  sim::RobotModel model = board::epuck_model();
  model.keys.push_back({"hal", sim::OwnKeyType::Choice, "", 0, 0, "sim|dspic", "\"sim\"",
                        "firmware built from source runs as the robot's own code, linked with this HAL: its "
                        "busy drivers are the simulator's, or the image is the one that is flashed"});
  return {std::move(model)};
}

sim::LoadedWorld load_world(const std::string& file) {
  sim::LoadedWorld loaded = with_robots_checked(sim::load_world(file, robot_models(), board::part_kinds()));
  std::error_code none;
  const std::filesystem::path path(file);
  if (!loaded.world && path.extension() == ".wbt" && std::filesystem::is_regular_file(path, none))
    loaded.problems = {{0, 0,
                        "world: got one of Webots, expected one of ours; `twinpuck import " + file +
                            "` makes " +
                            std::filesystem::path(path).replace_extension(".toml").filename().string()}};
  return loaded;
}

sim::LoadedWorld parse_world(std::string_view text, const std::string& file, sim::KnownWorld* known) {
  return with_robots_checked(sim::parse_world(text, file, robot_models(), board::part_kinds(), known));
}

}  // namespace twin
