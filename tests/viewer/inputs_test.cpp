// SPDX-License-Identifier: MIT
// What may be done to a running world from outside: each kind of it does what it says, within its bounds, and is in the
// digest.
#include "hal_sim/inputs/inputs.h"

#include <limits>

#include "hal_sim/signals/signals.h"
#include "tests/support/firmware_test.h"

namespace {

using inputs::Json;

class InputsTest : public firmware_test::FirmwareTest {
 protected:
  InputsTest() {
    arena(2, 2);
    sim::LampDesc lamp;
    lamp.position_m = {0, 0, 1};
    lamp.intensity_w_m2 = 5;
    world.lamps.push_back(lamp);
    sim::ObjectDesc box;
    box.pose = {0.5, 0.5, 0};
    box.movable = true;
    world.objects.push_back(box);
    add_robot_with_source(
        "#include <uart/e_uart_char.h>\nint goal = 7, heard;\nchar last;\nint main(void) {\n  "
        "e_init_uart2();\n"
        "  for (;;) while (e_getchar_uart2(&last)) ++heard;\n}\n",
        "puck");
    add_robot_with_source("int main(void) { for (;;) continue; }", "other").at(0.5, -0.5);
    add_robot("", "off").at(-0.5, -0.5);
  }
  void apply(const std::string& text) { inputs().apply(Json::parse(text)); }
  std::string refused(const std::string& text) {
    try {
      apply(text);
    } catch (const std::exception& wrong) {
      return wrong.what();
    }
    return "nothing";
  }
  inputs::Inputs& inputs() {
    if (!inputs_) inputs_ = std::make_unique<inputs::Inputs>(twin());
    return *inputs_;
  }
  double look(const char* signal, int robot = 0) {
    return signals::find(twin(), robot, signal).value(twin());
  }
  /// Edges of the remote control's light, each of which a frame has several of.
  int edges(int robot) {
    const board::RemoteReceiver& remote = twin().mind(robot).board().remote();
    int count = 0;
    for (board::Cycle at = 0; (at = remote.next_edge(at, true)) < board::kNever && count < 1000;) ++count;
    return count;
  }

  std::unique_ptr<inputs::Inputs> inputs_;
};

TEST_F(InputsTest, each_does_what_it_says) {
  run_for(0.25);
  EXPECT_NEAR(look("light0"), 5 * 0.96, 5);  // whatever the angle, there is light
  const double lit = look("light0");
  apply(R"({"do": "lamp", "lamp": 0, "on": false})");
  EXPECT_EQ(look("light0"), 0);
  apply(R"({"do": "lamp", "lamp": 0, "on": true, "intensity": 10})");
  EXPECT_NEAR(look("light0"), 2 * lit, 1e-9);
  apply(R"({"do": "lamp", "lamp": 0, "on": true})");
  EXPECT_NEAR(look("light0"), lit, 1e-9) << "the world's own";
  apply(R"({"do": "move", "robot": "puck", "x": 0.125, "y": -0.25, "heading": 1.5})");
  EXPECT_NEAR(robot(0).x_m(), 0.125, 1e-12);
  EXPECT_NEAR(robot(0).y_m(), -0.25, 1e-12);
  EXPECT_NEAR(robot(0).heading_deg(), 85.9437, 1e-3);
  apply(R"({"do": "move", "body": 3, "x": 0.75, "y": 0.5, "heading": 0})");
  EXPECT_NEAR(twin().simulation().scene().state(3).pose.x_m, 0.75, 1e-12);
  apply(R"({"do": "selector", "robot": "puck", "position": 11})");
  EXPECT_EQ(look("selector"), 11);
  apply(R"({"do": "battery", "robot": "puck", "volts": 3.5})");
  EXPECT_NEAR(look("battery_v"), 3.5, 1e-6);
  apply(R"({"do": "set", "robot": "puck", "variable": "goal", "value": -3})");
  EXPECT_EQ(robot(0).variable("goal"), -3);
  EXPECT_FALSE(twin().mind(0).board().virtual_devices().get("smoke"));
  apply(R"({"do": "sensor", "robot": "puck", "name": "smoke", "value": 0.5})");
  EXPECT_EQ(twin().mind(0).board().virtual_devices().get("smoke"), 0.5);
  apply(R"({"do": "write", "robot": "puck", "address": 8190, "bytes": 2, "value": 4660})");
  std::uint16_t word = 0;
  twin().mind(0).runner()->data().read_memory(8190, &word, 2);
  EXPECT_EQ(word, 0x1234);
  apply(R"({"do": "reset", "robot": "puck"})");
  run_for(0.25);
  EXPECT_EQ(robot(0).variable("goal"), 7) << "as at its start";
}

TEST_F(InputsTest, a_key_is_held_for_a_tenth_of_a_second_where_nothing_else_is_said) {
  run_for(0.1);
  EXPECT_EQ(edges(0), 0);
  apply(R"({"do": "key", "robot": "puck", "key": 5})");
  apply(R"({"do": "key", "robot": "other", "key": 5, "hold": 0.1})");
  apply(R"({"do": "key", "robot": "off", "key": 5, "hold": 0.2, "address": 31})");
  EXPECT_GT(edges(0), 8);
  EXPECT_EQ(edges(1), edges(0));
  EXPECT_GT(edges(2), edges(0) + 8) << "a frame begins each 0.114 s";
}

TEST_F(InputsTest, the_digest_knows_of_each) {
  std::set<std::uint64_t> digests{digest()};
  for (const char* what :
       {R"({"do": "selector", "robot": "puck", "position": 3})",
        R"({"do": "set", "robot": "puck", "variable": "goal", "value": 8})",
        R"({"do": "sensor", "robot": "puck", "name": "a", "value": 1})",
        R"({"do": "sensor", "robot": "other", "name": "a", "value": 1})",
        R"({"do": "key", "robot": "puck", "key": 1})", R"({"do": "lamp", "lamp": 0, "on": false})",
        R"({"do": "move", "robot": "puck", "x": 0.1, "y": 0, "heading": 0})"}) {
    apply(what);
    run_for(1.0 / 512);
    EXPECT_TRUE(digests.insert(digest()).second) << what;
  }
}

// three robots, then the box: which body a movable object was before
TEST_F(InputsTest, a_new_world_says_of_each_movable_object_which_body_it_was) {
  run_for(0.1);
  const auto with = [](const std::string& before) {
    return R"({"do": "world", "text": "twinpuck = 1\n[[robot]]\nname = \"puck\"\n[[robot]]\nname = \"other\"\nposition = [0.5, -0.5]\n)"
           R"([[robot]]\nname = \"off\"\nposition = [-0.5, -0.5]\n[[box]]\nposition = [0.7, 0.7]\nsize = [0.1, 0.1, 0.1]\nmovable = true\n)"
           R"([[box]]\nposition = [-0.7, 0.7]\nsize = [0.1, 0.1, 0.1]\nmovable = true\n", "before": )" +
           before + "}";
  };
  EXPECT_EQ(refused(with("[]")), "before: expected one number for each movable object");
  EXPECT_EQ(refused(with("[3, -1, -1]")), "before: expected one number for each movable object");
  for (const int wrong : {0, 1, 2, 4, 1000})
    EXPECT_EQ(refused(with("[-1, " + std::to_string(wrong) + "]")),
              "before: got " + std::to_string(wrong) + ", expected a movable object or -1");
  EXPECT_EQ(refused(with("[-1, 3]")), "nothing");
}

TEST_F(InputsTest, what_lies_beyond_the_bounds_is_refused) {
  run_for(0.1);
  const std::pair<const char*, const char*> rows[] = {
      {R"({"do": "fly"})", "do: got 'fly', expected an input"},
      {R"({"do": "move", "robot": "eve", "x": 0, "y": 0, "heading": 0})",
       "robot: got 'eve', expected a robot of the world"},
      {R"({"do": "move", "robot": "puck", "x": 1000.5, "y": 0, "heading": 0})",
       "x: got 1000.5, expected -1000 to 1000"},
      {R"({"do": "move", "robot": "puck", "x": 0, "y": -1000.5, "heading": 0})",
       "y: got -1000.5, expected -1000 to 1000"},
      {R"({"do": "move", "robot": "puck", "x": 0, "y": 0, "heading": 1000001})",
       "heading: got 1000001, expected -1000000 to 1000000"},
      {R"({"do": "move", "body": 4, "x": 0, "y": 0, "heading": 0})", "body: got 4, expected 0 to 3"},
      {R"({"do": "move", "body": -1, "x": 0, "y": 0, "heading": 0})", "body: got -1, expected 0 to 3"},
      {R"({"do": "move", "body": 0.5, "x": 0, "y": 0, "heading": 0})", "body: got 0.5, expected 0 to 3"},
      {R"({"do": "lamp", "lamp": 1, "on": true})", "lamp: got 1, expected 0 to 0"},
      {R"({"do": "lamp", "lamp": 0, "on": true, "intensity": 10001})",
       "intensity: got 10001, expected 0 to 10000"},
      {R"({"do": "lamp", "lamp": 0, "on": true, "intensity": -1})", "intensity: got -1, expected 0 to 10000"},
      {R"({"do": "selector", "robot": "puck", "position": 16})", "position: got 16, expected 0 to 15"},
      {R"({"do": "selector", "robot": "puck", "position": -1})", "position: got -1, expected 0 to 15"},
      {R"({"do": "battery", "robot": "puck", "volts": 2.99})", "volts: got 2.99, expected 3 to 4.2"},
      {R"({"do": "battery", "robot": "puck", "volts": 4.21})", "volts: got 4.21, expected 3 to 4.2"},
      {R"({"do": "key", "robot": "puck", "key": 64})", "key: got 64, expected 0 to 63"},
      {R"({"do": "key", "robot": "puck", "key": 1, "hold": 60.1})", "hold: got 60.1, expected 0 to 60"},
      {R"({"do": "key", "robot": "puck", "key": 1, "hold": -0.1})", "hold: got -0.1, expected 0 to 60"},
      {R"({"do": "type", "robot": "puck", "port": 3, "bytes": "x"})", "port: got 3, expected 1 to 2"},
      {R"({"do": "type", "robot": "puck", "port": 0, "bytes": "x"})", "port: got 0, expected 1 to 2"},
      {R"({"do": "type", "robot": "puck", "port": 2, "bytes": "\u0100"})",
       "bytes: got a character above U+00FF, expected one byte a character"},
      {R"({"do": "write", "robot": "puck", "address": 65535, "bytes": 2, "value": 0})",
       "address: got 65535, expected 0 to 65534"},
      {R"({"do": "write", "robot": "puck", "address": 0, "bytes": 9, "value": 0})",
       "bytes: got 9, expected 1 to 8"},
      {R"({"do": "write", "robot": "puck", "address": 0, "bytes": 0, "value": 0})",
       "bytes: got 0, expected 1 to 8"},
      {R"({"do": "set", "robot": "off", "variable": "goal", "value": 0})",
       "robot: got \"off\", which runs no program"},
      {R"({"do": "reset", "robot": "off"})", "robot: got \"off\", which runs no program"},
      {R"({"do": "set", "robot": "puck", "variable": "nix", "value": 0})",
       "got 'nix', expected a variable of the image that is known here"},
      {R"({"do": "end_fault", "fault": 0})", "fault: got 0, expected none: there is no fault"},
      {R"({"do": "world", "text": "twinpuck = 1\n", "before": []})",
       "text: got other robots or another tick, expected the same"},
  };
  const auto before = digest();
  for (const auto& [text, expected] : rows) EXPECT_EQ(refused(text), expected) << text;
  EXPECT_EQ(digest(), before) << "nothing was done";
}

}  // namespace
