// SPDX-License-Identifier: MIT
// twinpuck new NAME: a controller that builds, runs and passes its own test, to start from.
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "install/places.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

const char* const kMain = R"(/* SPDX-License-Identifier: MIT
 * @NAME@: drives forward and turns away from what the front sensors see. A start for your own controller. */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>

#define CRUISE 400 /* steps/s; 1000 is one wheel turn a second */
#define NEAR 300   /* counts; about 3 cm from a white wall */

static volatile int step_due;

/* every 20 ms, from the agenda's interrupt */
static void tick(void)
{
  step_due = 1;
}

static void control_step(void)
{
  int right = e_get_prox(0) + e_get_prox(1);
  int left = e_get_prox(7) + e_get_prox(6);

  if (right < NEAR && left < NEAR) {
    e_set_speed_left(CRUISE);
    e_set_speed_right(CRUISE);
  } else if (right > left) {
    e_set_speed_left(-CRUISE / 2);
    e_set_speed_right(CRUISE / 2);
  } else {
    e_set_speed_left(CRUISE / 2);
    e_set_speed_right(-CRUISE / 2);
  }
  e_set_led(0, 2);
}

int main(void)
{
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(tick, 200); /* 200 ticks of 0.1 ms */
  while (1) {
    while (!step_due)
      ;
    step_due = 0;
    control_step();
  }
}
)";

const char* const kReadme = R"(# @NAME@

Drives forward and turns away from what the front sensors see. Made by `twinpuck new`.

- Run it: `make run FW=@NAME@`, in another world: `make run FW=@NAME@ WORLD=arena`
- Test it: `make test T=@NAME@` (the test is `test.cpp` in this folder; docs/testing.md says what it can do)
- Time it: `build/twinpuck cycles firmware/@NAME@`
- Debug it: `gdb -x scripts/firmware.gdb --args build/twinpuck run worlds/maze.toml --fw '*=firmware/@NAME@'`
)";

const char* const kTest = R"(// SPDX-License-Identifier: MIT
#include "tests/support/firmware_test.h"

using firmware_test::FirmwareTest;

class @NAME@ : public FirmwareTest {};  // `make test T=@NAME@` finds it by this name

TEST_F(@NAME@, drives_and_keeps_off_the_wall) {
  arena(1.0, 1.0);
  auto& robot = add_robot("@NAME@").at(0, 0, 10);
  run_for(5);
  EXPECT_GT(robot.distance_m(), 0.1);
  EXPECT_EQ(robot.collisions(), 0);
  expect_no_traps();
}
)";

const char* const kSupervisor = R"(# SPDX-License-Identifier: MIT
"""@NAME@: ends the run once every robot has driven half a metre, or as failed when one has touched something. A start
for your own supervisor; docs/supervisor.md is the guide."""
import sys

from controller import Supervisor

world = Supervisor()
children = world.getRoot().getField("children")
nodes = [children.getMFNode(i) for i in range(children.getCount())]
robots = [node for node in nodes if node.getTypeName() == "E-puck"]

while world.step(100) != -1:
    for robot in robots:
        if robot.getField("collisions").getSFInt32() > 0:
            print(robot.getField("name").getSFString(), "touched something")
            world.simulationQuit(1)
            sys.exit()
    if all(robot.getField("distance").getSFFloat() > 0.5 for robot in robots):
        print(f"all there after {world.getTime():.1f} s")
        world.simulationQuit(0)
        sys.exit()
)";

const char* const kSupervisorReadme = R"(# @NAME@

Ends the run once every robot has driven half a metre. Made by `twinpuck new --supervisor`.

    build/twinpuck run maze --supervisor @NAME@
)";

std::string replace_all(std::string text, const std::string& key, const std::string& value) {
  for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + value.size()))
    text.replace(at, key.size(), value);
  return text;
}

int make(const std::string& name, bool supervisor) {
  const bool good = !name.empty() && std::islower(static_cast<unsigned char>(name[0])) &&
                    std::all_of(name.begin(), name.end(), [](unsigned char c) {
                      return std::islower(c) || std::isdigit(c) || c == '_';
                    });
  if (!good) {
    complain({"command line: NAME: got '" + name +
              "', expected lower-case letters, digits and underscores, a letter first"});
    return kBadInput;
  }
  const std::string room = supervisor ? "programs/supervisors" : "firmware";
  const char* const what = supervisor ? "new supervisor" : "new controller";
  // what was installed is nobody's to add to
  const char* const root = std::getenv("TWINPUCK_ROOT");
  const bool is_here = places::is_installed() && !(root && *root);
  const fs::path folder = is_here ? fs::path(name) : places::share_root() / room / name;
  if (fs::exists(folder)) {
    complain({folder.string() + ": " + what + ": got a folder that exists, expected a new name"});
    return kBadInput;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  std::vector<std::pair<std::string, const char*>> files{
      {"main.c", kMain}, {"README.md", kReadme}, {"test.cpp", kTest}};
  if (supervisor) files = {{name + ".py", kSupervisor}, {"README.md", kSupervisorReadme}};
  for (const auto& [file, text] : files) {
    std::ofstream out(folder / file);
    out << replace_all(text, "@NAME@", name);
    if (!out.flush()) {
      complain({(folder / file).string() + ": " + what + ": cannot write the file"});
      return kBadInput;
    }
  }
  if (is_here) {
    std::cout << "Made ./" << name << ".\n  twinpuck run maze "
              << (supervisor ? "--supervisor ./" : "--fw ./") << name << "\n";
    return kPass;
  }
  if (supervisor) {
    std::cout << "Made programs/supervisors/" << name << ".\n  build/twinpuck run maze --supervisor " << name
              << "\n";
    return kPass;
  }
  std::cout << "Made firmware/" << name << " with main.c, README.md and test.cpp.\n"
            << "  make run FW=" << name << "\n  make test T=" << name << "\n";
  return kPass;
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "new", "Make a new controller, or a supervisor, that builds and runs, to start from");
  auto name = std::make_shared<std::string>();
  verb->add_option("NAME", *name,
                   "its name: a folder under firmware/ or programs/supervisors/; once installed, in the "
                   "current folder")
      ->required();
  auto supervisor = std::make_shared<bool>(false);
  verb->add_flag("--supervisor", *supervisor, "a supervisor instead of a controller");
  verb->callback([name, supervisor, &exit_code] { exit_code = make(*name, *supervisor); });
}

}  // namespace tools
