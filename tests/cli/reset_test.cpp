// SPDX-License-Identifier: MIT
// A supervisor puts a robot back and presses its reset button: it takes its first way again, up to what a
// program does of an instruction that was under way (a cycle of its speed is 7 nm).
#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Resets : public CommandTest {};

TEST_F(Resets, reset_and_restart_give_the_first_run_again) {
  const std::string head =
      "#include <math.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <supervisor.h>\n"
      "static struct sv_pose first[60];\n"
      "static int round_, number;\nstatic double worst, way;\n"
      "static void look(void) {\n"
      "  struct sv_pose now; double off;\n"
      "  sv_get_pose(0, &now);\n"
      "  if (!round_) { first[number] = now; return; }\n"
      "  off = hypot(now.x - first[number].x, now.y - first[number].y) + fabs(now.heading - "
      "first[number].heading);\n"
      "  if (off > worst) worst = off;\n"
      "  way += hypot(now.x - first[0].x, now.y - first[0].y);\n"
      "}\n";
  const std::string tail =
      "  if (worst > 1e-6 || way < 0.1) sv_end(1, \"off by %g after a way of %g\", worst, way);\n"
      "  sv_end(0, \"the same\");\n  return 0;\n}\n";
  write("ours.c", head +
                      "int main(void) {\n"
                      "  for (; round_ < 3; round_++) {\n"
                      "    for (number = 0; number < 60; number++) { sv_step(0.1); look(); }\n"
                      "    if (round_) { sv_restart(SV_ALL); sv_reset(0); sv_reset(1); }\n"
                      "    else { sv_reset(0); sv_reset(1); sv_restart(SV_ALL); }\n"
                      "  }\n" +
                      tail);
  for (const char* call :
       {"wb_supervisor_simulation_reset", "wb_supervisor_simulation_revert", "wb_supervisor_world_reload"})
    write(std::string(call) + ".c",
          head +
              "#include <webots/robot.h>\n#include <webots/supervisor.h>\n"
              "int main(void) {\n  wb_robot_init();\n"
              "  for (; round_ < 3; round_++) {\n"
              "    for (number = 0; number < 60; number++) { wb_robot_step(125); look(); }\n"
              "    " +
              call + "();\n  }\n" + tail);
  for (const char* engine : {"dynamic", "planar"})
    for (const char* firmware : {"obstacle", "square"}) {
      // noise of sensors and wheels, walls to meet, another robot, a box
      write("world.toml",
            std::string("twinpuck = 1\n[world]\nengine = \"") + engine +
                "\"\nwheel_noise = 0.05\n[arena]\nsize = [0.5, 0.5]\n"
                "[[robot]]\nname = \"puck\"\nheading = 30\nfirmware = \"" +
                firmware +
                "\"\n[[robot]]\nname = \"other\"\nposition = [0.15, 0.1]\nfirmware = \"obstacle\"\n");
      for (const char* program : {"ours.c", "wb_supervisor_simulation_reset.c",
                                  "wb_supervisor_simulation_revert.c", "wb_supervisor_world_reload.c"}) {
        const Said said = twinpuck("run '" + path("world.toml") + "' --way chip --for 60 --supervisor '" +
                                   path(program) + "'");
        EXPECT_EQ(said.exit_code, 0) << engine << " " << firmware << " " << program << "\n" << said.text;
      }
    }
}

}  // namespace
