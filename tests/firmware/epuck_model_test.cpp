// SPDX-License-Identifier: MIT
// What a world file may say of an e-puck alone: the messages, and what becomes of it.
#include "hal_sim/board/epuck_model.h"

#include <gtest/gtest.h>

#include "sim_core/load/world_loader.h"

namespace {

sim::LoadedWorld load(const std::string& robot) {
  return sim::parse_world("twinpuck = 1\n[[robot]]\n" + robot, "w.toml", {board::epuck_model()});
}

board::Setup setup_of(const std::string& robot) {
  const sim::LoadedWorld loaded = load(robot);
  EXPECT_TRUE(loaded.world) << loaded.report("w.toml");
  board::Setup setup;
  const sim::RobotDesc& desc = loaded.world->robots.front();
  board::set_up(setup, {loaded.world->model_of(desc)->keys, desc.own});
  return setup;
}

TEST(EpuckModel, its_keys_say_what_is_wrong) {
  const auto report = [](const std::string& robot) { return load(robot).report("w.toml"); };
  EXPECT_EQ(report("selector = 16\n"),
            "w.toml:3:12: robot.selector: got 16, expected whole number from 0 to 15");
  EXPECT_EQ(report("revision = \"2.0\"\n"),
            "w.toml:3:12: robot.revision: got \"2.0\", expected one of 1.1, 1.3");
  EXPECT_EQ(report("camera = \"po3030\"\n"),
            "w.toml:3:10: robot.camera: got \"po3030\", expected one of po3030k, po6030k, po8030d, none; did "
            "you mean 'po3030k'?");
}

TEST(EpuckModel, its_keys_set_up_the_board) {
  const board::Setup usual = setup_of("");
  EXPECT_EQ(usual.selector, 0);
  EXPECT_EQ(usual.revision, board::Revision::Analogue);
  EXPECT_EQ(usual.camera, board::usual_camera(usual.revision));
  EXPECT_EQ(usual.camera_noise, 1);
  const board::Setup newer = setup_of("selector = 9\nrevision = \"1.3\"\n");
  EXPECT_EQ(newer.selector, 9);
  EXPECT_EQ(newer.revision, board::Revision::Rev13);
  EXPECT_EQ(newer.camera, board::usual_camera(board::Revision::Rev13));
  const board::Setup blind = setup_of("camera = \"none\"\ncamera_mount = \"inverted\"\ncamera_noise = 0\n");
  EXPECT_EQ(blind.camera, board::CameraKind::None);
  EXPECT_EQ(blind.camera_mount, board::CameraMount::Inverted);
  EXPECT_EQ(blind.camera_noise, 0);
}

}  // namespace
