// SPDX-License-Identifier: MIT
// What supervisors see and change of robots: devices, firmware's variables, virtual sensors, messages, lamps,
// colours, noise; and that each change is in the world's digest.
#include "sim_core/light/proximity.h"
#include "tests/support/firmware_test.h"

namespace {

using firmware_test::FirmwareTest;

class SupervisorRobotsTest : public FirmwareTest {
 protected:
  void expect_pass(double seconds = 1) {
    run_for(seconds);
    EXPECT_EQ(finish().code, 0) << finish().text;
    EXPECT_TRUE(finish().ended) << "the program did not come to its end";
  }
};

/// Begins every program of this file: expect(), and pass() at its end.
const char* const kHead = R"(
#include <supervisor.hpp>
#include <cmath>
#define EXPECT(what) do { if (!(what)) sv_end(1, "line %d: %s", __LINE__, #what); } while (0)
)";

const char* const kVariables = R"(
#include <stdint.h>
struct point { int x; long y; };
struct state {
  char mode;
  unsigned flag : 3;
  int level : 5;
  union { unsigned whole; unsigned char part[2]; };
  struct point at[2];
};
enum colour { RED, GREEN, BLUE };
volatile int count = -3;
volatile unsigned positive = 65535u;
volatile long big = -2147483647L;
volatile unsigned long bigger = 4294967295UL;
volatile long long biggest = -5;
volatile signed char tiny = -7;
volatile unsigned char byte_ = 200;
volatile float half = 0.5f;
volatile double real = -0.25;
volatile enum colour colour = BLUE;
volatile int grid[2][3] = {{1, 2, 3}, {4, 5, 6}};
volatile struct state state = {9, 5, -2, {0x1234}, {{1, 100000L}, {-2, -100000L}}};
static volatile int hidden = 77;
volatile int* pointer = &count;
static void tick(void) { static volatile int inside = 12; inside++; }
int main(void) { tick(); tick(); while (1) { count = count; hidden = hidden; } }
)";

TEST_F(SupervisorRobotsTest, variables_of_every_width) {
  add_robot_with_source(kVariables);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::step(0.05);
      sv::Robot r(0);
      EXPECT(r.variable("count") == -3);
      EXPECT(r.variable("positive") == 65535);
      EXPECT(r.variable("big") == -2147483647.0);
      EXPECT(r.variable("bigger") == 4294967295.0);
      EXPECT(r.variable("biggest") == -5);
      EXPECT(r.variable("tiny") == -7);
      EXPECT(r.variable("byte_") == 200);
      EXPECT(r.variable("half") == 0.5);
      EXPECT(r.variable("real") == -0.25);
      EXPECT(r.variable("colour") == 2);
      EXPECT(r.variable("grid[1][2]") == 6 && r.variable("grid[0][1]") == 2);
      EXPECT(r.variable("state.mode") == 9);
      EXPECT(r.variable("state.flag") == 5 && r.variable("state.level") == -2);
      EXPECT(r.variable("state.whole") == 0x1234 && r.variable("state.part[1]") == 0x12);
      EXPECT(r.variable("state.at[1].y") == -100000 && r.variable("state.at[0].x") == 1);
      EXPECT(r.variable("hidden") == 77 && r.variable("main.c:hidden") == 77);
      EXPECT(r.variable("inside") == 14 && r.variable("tick:inside") == 14);
      EXPECT(r.variable("pointer") != 0);
      short row[3];
      EXPECT(sv_read_variable(0, "grid[1]", row, sizeof row) == 6 && row[0] == 4 && row[2] == 6);
      EXPECT(sv_read_variable(0, "grid", row, 2) == 12);
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, variables_are_written_to_their_width) {
  add_robot_with_source(kVariables);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::step(0.05);
      sv::Robot r(0);
      r.set_variable("count", 70000);   // 70000 - 65536
      EXPECT(r.variable("count") == 4464);
      r.set_variable("positive", -1);
      EXPECT(r.variable("positive") == 65535);
      r.set_variable("state.flag", 2);
      r.set_variable("state.level", -16);
      EXPECT(r.variable("state.flag") == 2 && r.variable("state.level") == -16 && r.variable("state.mode") == 9);
      r.set_variable("half", -1.5);
      EXPECT(r.variable("half") == -1.5);
      r.set_variable("grid[0][2]", -30);
      EXPECT(r.variable("grid[0][2]") == -30 && r.variable("grid[1][0]") == 4);
      short row[3] = {7, 8, 9};
      EXPECT(sv_write_variable(0, "grid[1]", row, sizeof row) == 0 && r.variable("grid[1][1]") == 8);
      EXPECT(sv_write_variable(0, "grid[1]", row, 7) == -1);
      sv::step(0.05);  // the program itself has written count meanwhile: what it read
      EXPECT(r.variable("count") == 4464);
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, what_is_no_variable_is_explained) {
  add_robot_with_source(kVariables);
  robot(0).settings().name = "alice";
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <cstring>
    bool says(const char* expression, const char* words) {
      double value;
      return sv_get_variable(0, expression, &value) == -1 && std::strstr(sv_error(), words);
    }
    int main() {
      EXPECT(says("cuont", "robot 'alice': got 'cuont', expected a variable"));
      EXPECT(says("grid[2][0]", "index 2, expected 0 to 1"));
      EXPECT(says("grid[0][0][0]", "it is no array"));
      EXPECT(says("grid[1]", "which has 6 bytes, expected a number"));
      EXPECT(says("state.colour", "no member 'colour' in 'state'"));
      EXPECT(says("count.x", "no member 'x'"));
      EXPECT(says("grid[x]", "expected a number in [ ]"));
      EXPECT(says("other.c:hidden", "in 'other.c'"));
      EXPECT(says("", "expected a variable"));
      double value;
      EXPECT(sv_get_variable(3, "count", &value) == -1 && std::strstr(sv_error(), "got robot 3, expected 0 to 0"));
      sv::pass();
    })");
  team().say = [](const std::string&) {};
  expect_pass();
}

TEST_F(SupervisorRobotsTest, robots_of_one_image_keep_their_own_variables) {
  const char* const source = R"(
    volatile int mine, seen;
    int main(void) { while (1) seen = mine; }
  )";
  for (int i = 0; i < 3; ++i) add_robot_with_source(source).at(0.2 * i, 0);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      for (int i = 0; i < 3; ++i) sv::Robot(i).set_variable("mine", 10 + i);
      sv::step(0.05);
      for (int i = 0; i < 3; ++i) {
        EXPECT(sv::Robot(i).variable("mine") == 10 + i);
        EXPECT(sv::Robot(i).variable("seen") == 10 + i);
      }
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, a_firmware_that_waits_for_a_flag_sees_it) {
  add_robot_with_source(R"(
    #include <motor_led/advance_one_timer/e_led.h>
    #include <motor_led/e_init_port.h>
    volatile int go;
    int main(void) {
      e_init_port();
      while (!go) ;
      e_set_led(3, 1);
      while (1) ;
    })");
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::Robot r(0);
      sv::step(0.2);
      EXPECT(r.leds() == 0);
      r.set_variable("go", 1);
      sv::step(0.01);
      EXPECT(r.leds() == 1 << 3);
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, devices_and_the_reset_button) {
  add_robot_with_source(R"(
    #include <motor_led/advance_one_timer/e_agenda.h>
    #include <motor_led/advance_one_timer/e_motors.h>
    #include <motor_led/e_init_port.h>
    volatile int starts, zero;
    int main(void) {
      e_init_port();
      e_start_agendas_processing();
      e_init_motors();
      e_set_speed_left(500);
      e_set_speed_right(500);
      starts++;
      while (zero == 0) ;
      zero = 1 / (zero - 2);
      while (1) ;
    })")
      .selector(5);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::Robot r(0);
      EXPECT(r.selector() == 5);
      r.turn_selector(9);
      EXPECT(r.selector() == 9);
      sv::step(1);
      // 500 steps/s for a second, less the start
      EXPECT(sv_left_steps(0) > 480 && sv_left_steps(0) <= 500);
      EXPECT(std::fabs(r.distance() - sv_left_steps(0) * 0.0001288) < 0.002);
      EXPECT(r.battery() > 3 && r.battery() <= 4.2 && sv_cpu_load(0) >= 0);
      r.set_variable("zero", 2);
      sv::step(0.05);
      EXPECT(r.traps() == 1 && std::string(sv_trap(0, 0)).find("division by zero") != std::string::npos);
      const double stood = r.pose().x;
      r.restart();
      sv::step(0.5);
      EXPECT(r.variable("zero") == 0 && r.variable("starts") == 1);  // start-up values
      EXPECT(r.pose().x > stood + 0.02 && r.traps() == 1);           // it drives again
      r.reset();
      EXPECT(r.pose().x == 0);
      sv::pass();
    })");
  expect_pass(3);
}

TEST_F(SupervisorRobotsTest, colours_and_noise_reach_the_sensors) {
  // a wall of the arena is no thing: a box stands before the robot
  add_robot_with_source("int main(void) { while (1) ; }");
  sim::ObjectDesc box;
  box.name = "box";
  box.size_m = {0.1, 0.3, 0.1};
  box.pose = {0.10, 0,
              0};  // its face is 2 cm from the sensors at x = 0.03, 2.1 cm along their rays at 17 degrees
  world.objects.push_back(box);
  world.proximity.profile = "webots-old";
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::Robot r(0);
      sv::step(0.05);
      const int white = r.proximity(0);
      sv::Thing("box").colour(0, 0, 1);
      const int blue = r.proximity(0);  // factor 0.2: five times as far, beyond the table's 7 cm
      EXPECT(white > 550 && white < 700 && blue == 34);  // 676 at 2 cm, 491 at 2.5 cm; 34 from 7 cm on
      double rgb[3];
      EXPECT(sv_get_colour(sv_find("box"), rgb) == 0 && rgb[2] == 1 && rgb[0] == 0);
      EXPECT(sv_set_colour(sv_find("box"), 0, 0, 1.5) == -1);
      EXPECT(sv_set_proximity_noise(SV_ALL, 2) == 0 && sv_set_wheel_noise(0, 0.05) == 0);
      sv::pass();
    })");
  team().say = [](const std::string&) {};
  expect_pass();
}

TEST_F(SupervisorRobotsTest, lamps_are_switched_and_moved) {
  sim::LampDesc lamp;
  lamp.name = "sun";
  world.lamps.push_back(lamp);
  add_robot_with_source("int main(void) { while (1) ; }");
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      const int sun = sv_find_lamp("sun");
      sv::Lamp l;
      EXPECT(sun == 0 && sv_lamps() == 1 && sv_find_lamp("moon") == SV_NONE);
      EXPECT(sv_get_lamp(sun, &l) == 0 && l.on == 1 && l.intensity == 1 && l.z == 1);
      l.on = 0;
      l.x = 0.5;
      EXPECT(sv_set_lamp(sun, &l) == 0 && sv_get_lamp(sun, &l) == 0 && l.on == 0 && l.x == 0.5);
      EXPECT(sv_set_lamp(1, &l) == -1);
      sv::pass();
    })");
  team().say = [](const std::string&) {};
  expect_pass();
  EXPECT_FALSE(twin().world().lamps[0].on);
}

/// A robot's program for Webots: answers packets, and reads a sensor that it does not have.
const char* const kRadioRobot = R"(
#include <stdio.h>
#include <webots/distance_sensor.h>
#include <webots/emitter.h>
#include <webots/receiver.h>
#include <webots/robot.h>
volatile double virtual_value;
int main(void) {
  WbDeviceTag emitter, receiver, sensor;
  wb_robot_init();
  emitter = wb_robot_get_device("emitter");
  receiver = wb_robot_get_device("receiver");
  sensor = wb_robot_get_device("ball_distance");
  wb_receiver_enable(receiver, 32);
  wb_distance_sensor_enable(sensor, 32);
  while (wb_robot_step(32) != -1) {
    virtual_value = wb_distance_sensor_get_value(sensor);
    while (wb_receiver_get_queue_length(receiver) > 0) {
      char answer[8];
      sprintf(answer, "%d", wb_receiver_get_data_size(receiver));
      wb_emitter_send(emitter, answer, 2);
      wb_receiver_next_packet(receiver);
    }
  }
  return 0;
}
)";

TEST_F(SupervisorRobotsTest, messages_go_both_ways) {
  add_robot_with_source(kRadioRobot);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::listen(1);
      sv::step(0.5);
      sv::send(1, "hello");
      sv::send(2, "nobody listens");
      sv::step(0.2);
      EXPECT(sv_waiting() == 1);
      auto m = sv::receive();
      EXPECT(m && m->channel == 1 && m->robot == 0 && m->bytes.substr(0, 1) == "5" && m->time > 0.5);
      EXPECT(!sv::receive());
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, firmware_reads_a_virtual_sensor) {
  add_robot_with_source(kRadioRobot);
  add_supervisor_with_source(std::string(kHead) + R"(
    int main() {
      sv::Robot r(0);
      r.set_sensor("ball_distance", 0.5);
      sv::step(0.5);
      EXPECT(r.variable("virtual_value") == 0.5);
      r.set_sensor("ball_distance", 0.25);
      sv::step(0.1);
      EXPECT(r.variable("virtual_value") == 0.25);
      sv::pass();
    })");
  expect_pass();
}

TEST_F(SupervisorRobotsTest, digests_see_what_supervisors_do_and_repeat) {
  const auto digest_with = [](const std::string& deed, int threads) {
    struct Run : FirmwareTest {
      void TestBody() override {}
      std::uint64_t go(const std::string& its_deed, int its_threads) {
        options.threads = its_threads;
        sim::LampDesc lamp;
        world.lamps.push_back(lamp);
        sim::ObjectDesc box;
        box.name = "box";
        box.pose = {2, 2, 0};
        world.objects.push_back(box);
        for (int i = 0; i < 2; ++i)
          add_robot_with_source("volatile int x; int main(void) { while (1) ; }").at(0.2 * i, 0);
        add_supervisor_with_source(
            "#include <supervisor.h>\nint main(void) { struct sv_lamp l; (void)l; sv_step(0.05);" + its_deed +
                "; return 0; }",
            "c");
        run_for(0.1);
        finish();
        return digest();
      }
    } run;
    return run.go(deed, threads);
  };
  const std::uint64_t nothing = digest_with("", 1);
  EXPECT_EQ(nothing, digest_with("", 2));
  const char* const deeds[] = {
      "sv_set_colour(2, 0, 1, 0)",    "sv_get_lamp(0, &l); l.on = 0; sv_set_lamp(0, &l)",
      "sv_set_proximity_noise(0, 3)", "sv_set_wheel_noise(0, 0.1)",
      "sv_set_variable(1, \"x\", 1)", "sv_set_sensor(0, \"s\", 1)",
      "sv_send(1, \"a\", 1)"};
  for (const char* deed : deeds) {
    const std::uint64_t once = digest_with(deed, 1);
    EXPECT_NE(once, nothing) << deed;
    EXPECT_EQ(once, digest_with(deed, 2)) << deed;
  }
}

// --- the same without a program: what Simulation offers to whoever attends it

TEST_F(SupervisorRobotsTest, lamps_and_noise_count_from_the_next_sample_on) {
  sim::LampDesc lamp;
  lamp.position_m = {1, 0, 0.5};
  world.lamps.push_back(lamp);
  sim::ObjectDesc box;
  box.pose = {0.10, 0, 0};
  box.size_m = {0.1, 0.3, 0.02};  // lower than the sensors: the lamp shines over it
  world.objects.push_back(box);
  add_robot_with_source("int main(void) { while (1) ; }");
  world.proximity.profile = "webots-old";
  run_for(0.01);
  sim::Simulation& simulation = twin().simulation();
  const auto light = [&] { return sim::sense_irradiance_w_m2(simulation.scene(), 0, 0, simulation.now()); };
  const double before = light();
  EXPECT_GT(before, 0);
  simulation.set_lamp(0, true, 2, lamp.position_m);
  EXPECT_DOUBLE_EQ(light(), 2 * before);
  simulation.set_lamp(0, false, 2, lamp.position_m);
  EXPECT_EQ(light(), 0);
  const auto noise = [&] {
    return sim::sense_proximity(simulation.scene(), 0, 2, simulation.now()).relative_noise;
  };
  EXPECT_EQ(noise(), 0);  // the fixture's worlds have none
  simulation.set_proximity_noise(0, 1);
  EXPECT_DOUBLE_EQ(noise(), 0.704);  // sensor 2 sees nothing: the last row of the table
  simulation.set_proximity_noise(0, 2);
  EXPECT_DOUBLE_EQ(noise(), 2 * 0.704);
}

TEST_F(SupervisorRobotsTest, engines_take_the_velocities_that_they_know) {
  const auto way_after = [](sim::Engine engine, double climb_m_s) {
    struct Run : FirmwareTest {
      void TestBody() override {}
      sim::BodyState go(sim::Engine its_engine, double its_climb_m_s) {
        world.engine = its_engine;
        sim::ObjectDesc box;
        box.movable = true;
        box.pose = {0.5, 0, 0};
        world.objects.push_back(box);
        add_robot_with_source("int main(void) { while (1) ; }");
        run_for(0.01);
        twin().simulation().set_velocity(1, {0.5, 0}, 0, its_climb_m_s);
        run_for(0.02);
        return twin().simulation().state(1);
      }
    } run;
    return run.go(engine, climb_m_s);
  };
  // 0.5 m/s for 20 ms against friction of 0.5 g: 10 mm - 1 mm, give or take a tick
  EXPECT_NEAR(way_after(sim::Engine::Dynamic, 0).pose.x_m, 0.509, 0.0015);
  EXPECT_NEAR(way_after(sim::Engine::Planar, 0).pose.x_m, 0.509, 0.0015);
  EXPECT_EQ(way_after(sim::Engine::Kinematic, 0).pose.x_m, 0.5);
  EXPECT_EQ(way_after(sim::Engine::Kinematic, 0).velocity_m_s.x, 0);
  // thrown up at 1 m/s: 20 mm - 2 mm
  EXPECT_NEAR(way_after(sim::Engine::Dynamic, 1).z_m, 0.018, 0.002);
  EXPECT_NEAR(way_after(sim::Engine::Kinematic, 1).z_m, 0.018, 0.002);
  EXPECT_EQ(way_after(sim::Engine::Planar, 1).z_m, 0);
}

}  // namespace
