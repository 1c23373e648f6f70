// SPDX-License-Identifier: MIT
// Devices that programs of the PC find on a robot and on a supervisor's node, in whole runs.
#include "tests/cli/command.h"

namespace {

using cli_test::twinpuck;

class PcDevices : public cli_test::CommandTest {};

TEST_F(PcDevices, wheels_have_the_tags_that_programs_have_written_down) {
  write("controllers/tags/tags.c",
        "#include <stdio.h>\n#include <webots/robot.h>\n"
        "int main(void) {\n  wb_robot_init();\n"
        "  printf(\"tags %d %d %d %d\\n\", wb_robot_get_device(\"left wheel motor\"), "
        "wb_robot_get_device(\"left wheel sensor\"),\n"
        "         wb_robot_get_device(\"right wheel motor\"), wb_robot_get_device(\"right wheel sensor\"));\n"
        "  wb_robot_cleanup();\n  return 0;\n}\n");
  const std::string world =
      write("w.toml", "twinpuck = 1\n[[robot]]\nname = \"a\"\nfirmware = \"controllers/tags\"\n");
  const auto said = twinpuck("run " + world + " --for 0.1");
  EXPECT_NE(said.text.find("tags 1 2 3 4"), std::string::npos) << said.text;
}

// 1 m to the box's near side; what nothing turns stays at 0
TEST_F(PcDevices, a_lidar_measures_and_idle_joints_stand_still) {
  const std::string program =
      "from controller import Robot\nrobot = Robot()\n"
      "lidar, joint = robot.getDevice('lidar'), robot.getDevice('joint')\n"
      "lidar.enable(32)\njoint.enable(32)\nrobot.step(32)\n"
      "print('seen %.3f at %.1f' % (lidar.getRangeImage()[0], joint.getValue()))\n";
  write("controllers/look/look.py", program);
  write("controllers/boss/boss.py",
        "from controller import Robot\nrobot = Robot()\n"
        "joint, camera = robot.getDevice('joint'), robot.getDevice('camera')\n"
        "joint.enable(32)\ncamera.enable(32)\nrobot.step(32)\n"
        "print('boss %.1f, %d black bytes' % (joint.getValue(), len(camera.getImage())))\n");
  const std::string world =
      write("w.toml",
            "twinpuck = 1\n[[box]]\nposition = [1.05, 0]\nsize = [0.1, 1, 0.2]\n"
            "[[robot]]\nname = \"a\"\nfirmware = \"controllers/look\"\n"
            "[[robot.device]]\nname = \"lidar\"\nkind = \"lidar\"\nwidth = 1\nheight = 1\nfov = 0.1\nfar = "
            "3\nat = [0, 0, 0.05]\n"
            "[[robot.device]]\nname = \"joint\"\nkind = \"position\"\n"
            "[[supervisor]]\nprogram = \"controllers/boss\"\n"
            "[[supervisor.device]]\nname = \"joint\"\nkind = \"position\"\n"
            "[[supervisor.device]]\nname = \"camera\"\nkind = \"camera\"\nwidth = 8\nheight = 4\n");
  const auto said = twinpuck("run " + world + " --for 0.1");
  EXPECT_NE(said.text.find("seen 1.000 at 0.0"), std::string::npos) << said.text;
  EXPECT_NE(said.text.find("boss 0.0, 128 black bytes"), std::string::npos) << said.text;
}

}  // namespace
