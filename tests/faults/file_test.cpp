// SPDX-License-Identifier: MIT
// The file of faults, good and bad; the line of the command; the page in docs.
#include <fstream>
#include <sstream>

#include "hal_sim/faults/kinds.h"
#include "tests/faults/looker.h"
#include "tools/dev/doc_part.h"
#include "twinpuck_paths.h"

namespace {

using faults::Fault;

std::string told(const std::string& text) { return faults::parse_faults(text, "f.toml").report("f.toml"); }

TEST(FaultFile, a_whole_one_is_read) {
  const auto read = faults::parse_faults(R"(
[[fault]]
kind = "sensor_blocked"
robot = "e-puck"
sensor = 3
at_s = 2.0
for_s = 1.5

[[fault]]
kind = "accelerometer_stuck"
when = "x_m > 0.2"

[[stimulus]]
send = "hello\r\u0000"
uart = 2
[[stimulus]]
press = 5
[[stimulus]]
turn = 3
at_s = 1
[[stimulus]]
move = [0.1, -0.2, 90]
[[stimulus]]
pin = "G6"
level = 0
for_s = 0.5
[[stimulus]]
set = "speed[1]"
value = -4
[[stimulus]]
reset = true
)",
                                         "f.toml");
  ASSERT_TRUE(read.problems.empty()) << read.report("f.toml");
  ASSERT_EQ(read.faults.size(), 9u);
  EXPECT_EQ(read.faults[0].robot, "e-puck");
  EXPECT_EQ(read.faults[0].values.at("sensor").integer, 3);
  EXPECT_EQ(read.faults[0].at_s, 2);
  EXPECT_EQ(read.faults[0].for_s, 1.5);
  EXPECT_EQ(read.faults[0].where, "f.toml:2:1");
  EXPECT_EQ(read.faults[1].when, "x_m > 0.2");
  EXPECT_EQ(read.faults[1].for_s, faults::kForEver);
  EXPECT_EQ(read.faults[2].kind, "bytes_sent");
  EXPECT_EQ(read.faults[2].values.at("bytes").text, std::string("hello\r\0", 7));
  EXPECT_EQ(read.faults[3].kind, "key_pressed");
  EXPECT_EQ(read.faults[4].kind, "selector_turned");
  EXPECT_EQ(read.faults[5].values.at("to").numbers, (std::vector<double>{0.1, -0.2, 90}));
  EXPECT_EQ(read.faults[6].values.at("level").integer, 0);
  EXPECT_EQ(read.faults[7].values.at("value").number, -4);
  EXPECT_EQ(read.faults[8].kind, "reset_pressed");
}

TEST(FaultFile, what_is_wrong_is_told_with_its_place) {
  const auto says = [](const std::string& text, const std::string& what) {
    EXPECT_EQ(told(text), what) << text;
  };
  says("[[fualt]]\nkind = \"bump\"\n",
       "f.toml:1:3: unknown key 'fualt'; did you mean 'fault'? (keys: fault, stimulus)");
  says("[[fault]]\nsensor = 1\n", "f.toml:1:1: fault.kind: missing, expected one of twinpuck list faults");
  says("[[fault]]\nkind = \"wheel_stick\"\n",
       "f.toml:2:8: fault.kind: got \"wheel_stick\", expected one of twinpuck list faults; did you mean "
       "'wheel_stuck'?");
  says("[[fault]]\nkind = \"sensor_dead\"\nsensor = 8\n",
       "f.toml:3:10: fault.sensor: got 8, expected whole number from 0 to 7");
  says("[[fault]]\nkind = \"sensor_dead\"\nsensr = 1\n",
       "f.toml:3:1: unknown key 'sensr' in fault; did you mean 'sensor'? (keys: kind, sensor, part, robot, "
       "at_s, when, for_s)");
  says("[[fault]]\nkind = \"wheel_stuck\"\nwheel = \"lft\"\n",
       "f.toml:3:9: fault.wheel: got \"lft\", expected one of left, right, both; did you mean 'left'?");
  says("[[fault]]\nkind = \"bump\"\nfor_s = 1\n",
       "f.toml:3:1: unknown key 'for_s' in fault (keys: kind, impulse_n_s, direction_deg, spin_deg_s, robot, "
       "at_s, when)");
  says("[[fault]]\nkind = \"bytes_lost\"\nshare = 1.5\n",
       "f.toml:3:9: fault.share: got 1.5, expected number from 0 to 1");
  says("[[fault]]\nkind = \"bytes_lost\"\nat_s = \"2\"\n",
       "f.toml:3:8: fault.at_s: got \"2\", expected number from 0 to 10000000 s");
  says("[[fault]]\nkind = \"bytes_lost\"\nfor_s = 0\n",
       "f.toml:3:9: fault.for_s: got 0, expected number from 1e-06 to 10000000 s");
  says("[[stimulus]]\nsnd = \"x\"\n",
       "f.toml:1:1: stimulus: got none of send, press, turn, move, pin, set, reset, expected one; did you "
       "mean 'send'?");
  says("[[stimulus]]\nsend = \"x\"\npress = 3\n",
       "f.toml:1:1: stimulus: got send and press, expected one of them; write two tables");
  says("[[stimulus]]\nturn = 16\n", "f.toml:2:8: stimulus.turn: got 16, expected whole number from 0 to 15");
  says(
      "[[stimulus]]\nmove = [1, 2]\n",
      "f.toml:2:8: stimulus.move: got [1, 2], expected three numbers [x, y, z] from -1000 to 1000 m, m, deg");
  says("[[stimulus]]\nset = \"x\"\nvalue = nan\n", "f.toml:3:9: stimulus.value: got nan, expected number");
  says("[fault]\nkind = \"bump\"\n",
       "f.toml:1:1: fault: got a table, expected [[fault]] with double brackets");
  says("[[fault]\n", "f.toml:1:9: not TOML: Error while parsing table header: expected ']', saw '\\n'");
  says("[[fault]]\nkind = 3\nkind = 4\n",
       "f.toml:3:8: not TOML: Error while parsing key-value pair: cannot redefine existing integer 'kind'");
  says(std::string(20, '\xff'),
       "f.toml:1:1: not TOML: got a character beyond ASCII, expected those in quotes or comments only");
  EXPECT_EQ(told(""), "");
  // all of them at once
  says("[[fault]]\nkind = \"a\"\n[[fault]]\nkind = \"b\"\n",
       "f.toml:2:8: fault.kind: got \"a\", expected one of twinpuck list faults\nf.toml:4:8: fault.kind: got "
       "\"b\", expected one of twinpuck list faults");
}

TEST(FaultFile, one_that_is_not_there_is_told) {
  EXPECT_NE(faults::load_faults("/nowhere/f.toml").report("/nowhere/f.toml"), "");
}

TEST(FaultLine, is_a_fault_in_a_line) {
  Fault f;
  std::string error;
  ASSERT_TRUE(faults::parse_fault_line("sensor_blocked sensor=0 at=2s for=1500ms robot=e-puck", f, error))
      << error;
  EXPECT_EQ(f.values.at("sensor").integer, 0);
  EXPECT_EQ(f.at_s, 2);
  EXPECT_EQ(f.for_s, 1.5);
  EXPECT_EQ(f.robot, "e-puck");
  ASSERT_TRUE(
      faults::parse_fault_line("bytes_sent bytes=\"go \\\"on\\\"\\r\" when='x_m > 0.2 && led0'", f, error))
      << error;
  EXPECT_EQ(f.values.at("bytes").text, "go \"on\"\r");
  EXPECT_EQ(f.when, "x_m > 0.2 && led0");
  ASSERT_TRUE(faults::parse_fault_line("robot_moved to=[0.1, 0.2, 90] at=1", f, error)) << error;
  EXPECT_EQ(f.values.at("to").numbers[2], 90);
  ASSERT_TRUE(faults::parse_fault_line("bytes_sent bytes=12", f, error) ||
              error.find("expected text") != std::string::npos);
  for (const char* wrong : {"", "sensor=1", "wheel_stick", "wheel_stuck wheel", "wheel_stuck wheel=lft",
                            "wheel_stuck at=soon", "wheel_stuck at=2m", "wheel_stuck for=-1s",
                            "wheel_stuck when='x", "wheel_stuck Wheel=left", "wheel_stuck a\nb=3"}) {
    error.clear();
    EXPECT_FALSE(faults::parse_fault_line(wrong, f, error)) << wrong;
    EXPECT_FALSE(error.empty()) << wrong;
  }
}

TEST(FaultLine, is_said_again_as_it_was_meant) {
  Fault f;
  std::string error;
  ASSERT_TRUE(faults::parse_fault_line("bytes_sent bytes=\"a\\r\" uart=2 robot=p", f, error)) << error;
  EXPECT_EQ(faults::said(f), "bytes_sent bytes=\"a\\r\" uart=2 of p");
}

TEST(FaultPage, the_page_in_docs_is_the_one_the_table_makes) {
  std::ifstream in(TWINPUCK_SOURCE_DIR "/docs/testing.md", std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  EXPECT_EQ(text.str(), dev::with_doc_part(text.str(), "faults", faults::page()))
      << "run build/twinpuck-dev page docs/testing.md";
}

TEST(FaultPage, every_kind_says_what_it_means) {
  EXPECT_GE(faults::kinds().size(), 15u);
  for (const faults::Kind& kind : faults::kinds()) {
    EXPECT_EQ(faults::find_kind(kind.name), &kind);
    EXPECT_GT(std::string(kind.meaning).size(), 30u) << kind.name;
    EXPECT_FALSE(std::string(kind.noticed).empty()) << kind.name;
    for (const faults::Parameter& p : kind.parameters)
      if (p.type == sim::ValueType::Number && std::string(p.usual) != "required" && *p.usual) {
        EXPECT_GE(std::stod(p.usual), p.least) << kind.name << " " << p.name;
        EXPECT_LE(std::stod(p.usual), p.most) << kind.name << " " << p.name;
      }
  }
  EXPECT_NE(faults::text_table().find("wheel_stuck"), std::string::npos);
}

}  // namespace
