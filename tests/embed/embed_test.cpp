// SPDX-License-Identifier: MIT
// Each function of the three headers, and what each refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "twinpuck/twinpuck.h"

namespace {

using twinpuck::Robot;
using twinpuck::Settings;
using twinpuck::World;

constexpr const char* kTwo = R"(twinpuck = 1
[world]
seed = 5
[arena]
size = [1, 1]
[proximity]
noise_scale = 0
[[robot]]
name = "ann"
position = [0.1, -0.2]
heading = 90
[[robot]]
name = "bob"
position = [-0.43, 0.3]
heading = 180
)";

constexpr const char* kProgram = R"(
#include <motor_led/e_init_port.h>
#include <motor_led/e_led.h>
#include <motor_led/e_motors.h>
#include <uart/e_uart_char.h>
int position, zero, speed = 300, driven;
unsigned heard;
float gain = 1.5f;
char last;
struct { int left[2]; } turn = {{4, -9}};
int main(void) {
  e_init_port();
  e_init_motors();
  e_init_uart1();
  e_init_uart2();
  e_set_led(2, 1);
  e_set_front_led(1);
  e_send_uart1_char("one", 3);
  e_send_uart2_char("second", 6);
  for (;;) {
    if (speed != driven) {
      driven = speed;
      e_set_speed_left(speed);
      e_set_speed_right(speed);
    }
    position = SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3;
    while (e_getchar_uart2(&last)) ++heard;
    if (position == 15) position /= zero;
  }
}
)";

struct Embed : testing::Test {
  Embed() {
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/main.c") << "#include <motor_led/e_epuck_ports.h>\n" << kProgram;
    settings.firmware = {{"ann", folder}, {"*", "blink"}};
    settings.tell = [this](const std::string& line) { told += line + "\n"; };
  }
  ~Embed() override { std::filesystem::remove_all(folder); }
  World world() { return World::of_text(kTwo, settings); }
  std::string refused(const std::function<void()>& act) {
    try {
      act();
    } catch (const twinpuck::Error& wrong) {
      EXPECT_FALSE(wrong.lines().empty());
      return wrong.what();
    }
    return "nothing";
  }

  const std::string folder =
      testing::TempDir() + "twinpuck-embed-" + testing::UnitTest::GetInstance()->current_test_info()->name();
  Settings settings;
  std::string told;
};

TEST_F(Embed, a_robot_is_seen_and_touched_by_name) {
  World w = world();
  EXPECT_EQ(w.robots(), (std::vector<std::string>{"ann", "bob"}));
  Robot ann = w.robot("ann"), bob = w.robot("bob");
  EXPECT_EQ(ann.name(), "ann");
  EXPECT_EQ(bob.pose().x_m, -0.43);
  EXPECT_EQ(bob.pose().y_m, 0.3);
  EXPECT_NEAR(bob.pose().heading_rad, std::acos(-1.0), 1e-12);
  ann.turn_selector(9);
  ann.send("hey", 2);
  w.run(1);
  EXPECT_EQ(w.time_s(), 1);
  // 300 steps/s of 0.1288 mm for a little less than a second, towards y
  EXPECT_NEAR(static_cast<double>(ann.left_steps()), 295, 5);
  EXPECT_EQ(ann.right_steps(), ann.left_steps());
  EXPECT_NEAR(ann.distance_m(), static_cast<double>(ann.left_steps()) * 0.1288e-3, 3e-4);
  EXPECT_NEAR(ann.pose().y_m, -0.2 + ann.distance_m(), 1e-4);
  EXPECT_NEAR(ann.pose().x_m, 0.1, 1e-3);
  EXPECT_EQ(bob.left_steps(), 0);
  for (int led = 0; led < 10; ++led) EXPECT_EQ(ann.led(led), led == 2 || led == 9) << led;
  EXPECT_EQ(ann.serial(), "one");
  EXPECT_EQ(ann.serial(2), "second");
  EXPECT_EQ(ann.variable("heard"), 3);
  EXPECT_EQ(ann.variable("last"), 'y');
  EXPECT_EQ(ann.variable("position"), 9);
  EXPECT_EQ(ann.variable("turn.left[1]"), -9);
  EXPECT_EQ(ann.variable("gain"), 1.5);
  // bob looks at the wall, 33 mm before him
  EXPECT_GT(bob.proximity(0), 120);
  EXPECT_LT(bob.proximity(3), 60);
  ann.set_variable("turn.left[1]", 65536 + 7);
  EXPECT_EQ(ann.variable("turn.left[1]"), 7);
  ann.set_variable("speed", 0);
  w.run(0.25);
  for (const twinpuck::Pose& nowhere :
       {twinpuck::Pose{NAN, 0, 0}, {0, INFINITY, 0}, {0, 1e9, 0}, {0, 0, NAN}})
    EXPECT_THROW(ann.place(nowhere), twinpuck::Error);
  ann.place({-0.3, 0.1, 1.5});
  EXPECT_NEAR(ann.pose().x_m, -0.3, 1e-12);
  const double before_m = ann.distance_m();
  w.run(0.5);
  EXPECT_NEAR(ann.pose().heading_rad, 1.5, 1e-3);
  EXPECT_NEAR(ann.distance_m(), before_m, 1e-4);
  EXPECT_EQ(ann.collisions(), 0);
  bob.place({0.4629, 0, 0});
  ann.place({0.37, 0, 0});
  ann.set_variable("speed", 1000);
  w.run(1);
  EXPECT_GE(ann.collisions(), 1);
  EXPECT_TRUE(ann.traps().empty());
  ann.turn_selector(15);
  w.run(0.1);
  ASSERT_FALSE(ann.traps().empty());
  EXPECT_EQ(ann.traps()[0].rfind("MathError: ", 0), 0u) << ann.traps()[0];
  EXPECT_NE(ann.traps()[0].find(" at main (" + folder + "/main.c:"), std::string::npos) << ann.traps()[0];
  EXPECT_TRUE(bob.traps().empty());
}

TEST_F(Embed, time_goes_in_ticks_and_begins_anew) {
  World w = world();
  const auto first = w.digest();
  w.step();
  EXPECT_EQ(w.time_s(), 1.0 / 512);
  w.run(0.25 - 1.0 / 512);
  EXPECT_EQ(w.time_s(), 0.25);
  w.run(0.0001);
  EXPECT_EQ(w.time_s(), 0.25 + 1.0 / 512) << "to the end of the tick";
  w.run(0);
  EXPECT_EQ(w.time_s(), 0.25 + 1.0 / 512);
  Robot ann = w.robot("ann");
  EXPECT_TRUE(w.run_until([&] { return ann.left_steps() >= 100; }, 5));
  EXPECT_EQ(ann.left_steps(), 100);
  const double at_s = w.time_s();
  EXPECT_FALSE(w.run_until([] { return false; }, 0.125));
  EXPECT_EQ(w.time_s(), at_s + 0.125);
  const auto digest = w.digest();
  const double end_s = w.time_s();
  w.reset();
  EXPECT_EQ(w.time_s(), 0);
  EXPECT_EQ(w.digest(), first);
  EXPECT_EQ(ann.left_steps(), 0) << "a handle is good over a reset";
  w.run(end_s);
  EXPECT_EQ(w.digest(), digest);
  EXPECT_EQ(ann.serial(), "one") << "since the world began";
}

TEST_F(Embed, settings_are_the_runs) {
  const auto digest = [&] {
    World w = world();
    w.run(0.25);
    return w.digest();
  };
  const auto usual = digest();
  settings.threads = 2;
  EXPECT_EQ(digest(), usual) << "threads change nothing";
  settings.seed = 5;
  EXPECT_EQ(digest(), usual) << "the world's own seed";
  settings.seed = 0;
  EXPECT_NE(digest(), usual);
  settings = Settings();
  World w = World::of_text(kTwo, settings);
  EXPECT_EQ(refused([&] { w.robot("ann").variable("x"); }), "robot 'ann': program: got none, expected one");
  EXPECT_EQ(World("maze").robots(), std::vector<std::string>{"puck"});
  EXPECT_EQ(twinpuck::version().find_first_not_of("0123456789."), std::string::npos);
}

TEST_F(Embed, what_is_wrong_is_refused_in_words) {
  World w = world();
  Robot ann = w.robot("ann");
  const std::pair<std::function<void()>, std::string> rows[] = {
      {[&] { w.robot("eve"); }, "robot: got 'eve', expected one of this world: ann, bob"},
      {[&] { w.run(-1); }, "run: seconds: got -1.000000, expected 0 to 1e7"},
      {[&] { w.run(1.1e7); }, "run: seconds: got 11000000.000000, expected 0 to 1e7"},
      {[&] { w.run(NAN); }, "run: seconds: got nan, expected 0 to 1e7"},
      {[&] { w.run_until([] { return true; }, -1); }, "run_until: seconds: got -1.000000, expected 0 to 1e7"},
      {[&] { ann.led(10); }, "robot 'ann': LED: got 10, expected 0 to 9"},
      {[&] { ann.led(-1); }, "robot 'ann': LED: got -1, expected 0 to 9"},
      {[&] { ann.proximity(8); }, "robot 'ann': proximity sensor: got 8, expected 0 to 7"},
      {[&] { ann.proximity(-1); }, "robot 'ann': proximity sensor: got -1, expected 0 to 7"},
      {[&] { ann.turn_selector(16); }, "robot 'ann': selector: got 16, expected 0 to 15"},
      {[&] { ann.turn_selector(-1); }, "robot 'ann': selector: got -1, expected 0 to 15"},
      {[&] { ann.serial(0); }, "robot 'ann': port: got 0, expected 1 or 2"},
      {[&] { ann.send("x", 3); }, "robot 'ann': port: got 3, expected 1 or 2"},
      {[&] { ann.variable("turn"); },
       "robot 'ann': turn: got 'turn', expected a number; name a member or element"},
      {[&] { ann.set_variable("nix", 1); },
       "robot 'ann': nix: got 'nix', expected a variable of the image that is known here"},
      {[&] {
         settings.threads = 0;
         world();
       },
       "settings: threads: got 0, expected 1 or more"},
      {[&] {
         settings.threads = 1;
         settings.hal = "chip";
         world();
       },
       "settings: hal: got 'chip', expected sim or dspic"},
      {[&] { World::of_text("twinpuck = 2"); }, ""},
      {[&] { World("nowhere"); }, ""},
  };
  for (const auto& [act, expected] : rows) {
    const std::string said = refused(act);
    if (!expected.empty()) {
      EXPECT_EQ(said, expected);
    }
    EXPECT_NE(said, "nothing");
  }
  settings.hal = "dspic";
  EXPECT_EQ(world().robots().size(), 2u);
}

}  // namespace
