// SPDX-License-Identifier: MIT
// Programs that the PC's compilers build: the classes of C++, and C with its own functions of our names.
#include <gtest/gtest.h>
#include <webots/nodes.h>

#include <cstdlib>
#include <fstream>

#include "tests/controller/fake_simulator.h"

using fake::Packet;
using fake::Simulator;

namespace {

/// A folder for a test's program and what it writes.
class Folder {
 public:
  Folder() {
    if (!mkdtemp(path_)) path_[0] = 0;
  }
  ~Folder() { EXPECT_EQ(system(("rm -rf " + std::string(path_)).c_str()), 0); }
  std::string path() const { return path_; }
  /// Compiles a text with all warnings; the program's path.
  std::string program(const std::string& compiler, const std::string& name, const std::string& text) const {
    const std::string source = path() + "/" + name, program = source + ".out", headers = SOURCE_FOLDER;
    std::ofstream(source) << text;
    const std::string command = compiler + " -Wall -Wextra -Werror -O0 " SANITIZER " -I" + headers +
                                "/programs/controller/include -I" + headers + "/firmware/include " + source +
                                " -o " + program + " -L" + BUILD_FOLDER + " -lcontroller -Wl,-rpath," +
                                BUILD_FOLDER;
    EXPECT_EQ(system(command.c_str()), 0) << command;
    return program;
  }

 private:
  char path_[32] = "/tmp/controller_testXXXXXX";
};

}  // namespace

TEST(ControllerCxx, a_robot_of_classes) {
  Folder folder;
  const std::string program = folder.program("g++ -std=c++11", "avoid.cpp", R"(
#include <webots/Robot.hpp>
#include <webots/DistanceSensor.hpp>
#include <webots/Motor.hpp>
#include <webots/PositionSensor.hpp>
#include <webots/LED.hpp>
#include <webots/utils/AnsiCodes.hpp>
using namespace webots;
class Avoider : public Robot {
 public:
  Avoider() : sensor(getDistanceSensor("ps0")), motor(dynamic_cast<Motor *>(getDevice("left wheel motor"))) {
    sensor->enable(32);
    motor->setPosition(INFINITY);
    motor->setVelocity(1.5);
    getLED("led0")->set(1);
  }
  void run() {
    std::cout << getName() << " " << (getMotor("nobody") == NULL) << (getMotor("ps0") == NULL) << " "
              << (getDistanceSensor("ps0") == sensor) << " " << motor->getPositionSensor()->getName() << std::endl;
    while (step(32) != -1) std::cout << sensor->getValue() << " " << getTime() << std::endl;
  }
  DistanceSensor *sensor;
  Motor *motor;
};
int main() {
  Avoider *robot = new Avoider();
  robot->run();
  delete robot;
  return 5;
}
)");
  Simulator sim(program, folder.path());
  fake::World world;
  world.devices = {{1, WB_NODE_DISTANCE_SENSOR, "ps0", {0, 4095, 0.3, 1}},
                   {2, WB_NODE_ROTATIONAL_MOTOR, "left wheel motor", {6.28, 3}},
                   {3, WB_NODE_POSITION_SENSOR, "left wheel sensor", {2}},
                   {4, WB_NODE_LED, "led0", {}}};
  EXPECT_EQ(sim.welcome(world).ints[1], 1) << "it says that it is C++";
  auto said = sim.next();
  ASSERT_EQ(said.size(), 5u) << "its commands, then a question for the motor that there is not";
  sim.send(Packet().add(LINK_NOTHING, ""));
  EXPECT_TRUE(sim.until_step().empty());
  Packet samples;
  samples.add(LINK_NUMBERS, 1, std::vector<double>{55.5});
  sim.done(32000000, samples);
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 5) << sim.errors();
  EXPECT_EQ(sim.output(), "puck 11 1 left wheel sensor\n55.5 0.032\n");
}

TEST(ControllerCxx, a_supervisor_of_classes) {
  Folder folder;
  const std::string program = folder.program("g++", "referee.cpp", R"(
#include <webots/Supervisor.hpp>
#include <webots/Node.hpp>
#include <webots/Field.hpp>
#include <cstdio>
using namespace webots;
int main() {
  Supervisor *referee = new Supervisor();
  Node *ball = referee->getFromDef("BALL");
  Field *place = ball->getField("translation");
  const double *at = place->getSFVec3f();
  printf("%d %g %d\n", ball->getId(), at[0], ball->getType() == Node::SOLID && place->getType() == Field::SF_VEC3F);
  const double start[3] = {0, 0, 0.1};
  place->setSFVec3f(start);
  referee->setLabel(0, "1:0", 0, 0, 0.1, 0xFFFFFF, 0);
  referee->simulationQuit(EXIT_SUCCESS);
  referee->step(32);
  delete referee;
}
)");
  Simulator sim(program, folder.path());
  fake::World world;
  world.supervisor = true;
  sim.welcome(world);
  sim.next();
  sim.send(Packet().add(LINK_NODE, 4, 1, int{WB_NODE_SOLID}, "BALL", "Ball", "Solid"));
  sim.next();
  sim.send(Packet().add(LINK_FIELD, 8, 5, -1, "translation"));
  sim.next();
  sim.send(Packet().add(LINK_VALUE, -1, 0, std::vector<double>{0.25, 0, 0}, ""));
  const auto said = sim.until_step();
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said[0].lists[0], (std::vector<double>{0, 0, 0.1}));
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "4 0.25 1\n");
}

TEST(ControllerCxx, a_programs_own_functions_of_our_names_are_its_own) {
  Folder folder;
  const std::string program = folder.program("gcc", "own.c", R"(
#include <webots/robot.h>
#include <stdio.h>
static int run(int ms) { printf("run %d\n", ms); return 32; }
void robot_run(int speed) { printf("own %d\n", speed); }
void led_set(int a) { (void)a; }
int session_begin(void) { return 1; }
int main(void) {
  wb_robot_init();
  robot_run(7);
  wb_robot_run(run);
  return session_begin();
}
)");
  Simulator sim(program, folder.path());
  sim.welcome({});
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "own 7\nrun 0\n");
}

TEST(ControllerCxx, every_header_compiles_alone) {
  Folder folder;
  const std::string headers = SOURCE_FOLDER;
  const std::string find = "{ cd " + headers +
                           "/programs/controller/include && find webots twinpuck -name '*.h'; cd " + headers +
                           "/firmware/include && find webots device -name '*.h'; }";
  const std::string options = " -Wall -Wextra -Werror -fsyntax-only -I" + headers +
                              "/programs/controller/include -I" + headers + "/firmware/include - ";
  EXPECT_EQ(system((find + " | while read h; do echo \"#include <$h>\" | gcc -std=c99 -x c" + options +
                    " || exit 1; done")
                       .c_str()),
            0);
  // the classes, which read much of the library: all, in both orders
  for (const char* order : {"sort", "sort -r"})
    EXPECT_EQ(system(("cd " + headers + "/programs/controller/include && find webots -name '*.hpp' | " +
                      order + " | sed 's/.*/#include <&>/' | g++ -std=c++11 -x c++" + options)
                         .c_str()),
              0);
}
