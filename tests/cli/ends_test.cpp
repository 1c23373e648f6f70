// SPDX-License-Identifier: MIT
// Whatever runs, a run ends when the user or --host-limit wants it to. What has not ended ten seconds later
// is killed: exit code 137.
#include <algorithm>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::signal_once;
using cli_test::twinpuck;
namespace fs = std::filesystem;

class Ends : public CommandTest {
 protected:
  static constexpr const char* kTerm = "timeout --preserve-status -k 10 -s TERM 1.5";
  static constexpr const char* kPatient = "timeout --preserve-status -k 1 60";

  std::string endless_supervisor() const {
    return write("endless.c",
                 "#include <webots/robot.h>\n"
                 "volatile int d;\n"
                 "int main(void) {\n"
                 "  wb_robot_init(); wb_robot_step(500);\n"
                 "  for (;;) d++;\n"
                 "}\n");
  }
  /// The last line of a recording is whole: as many fields as the head has.
  void expect_whole_lines(const std::string& file, int least = 10) const {
    const std::string text = read(file);
    ASSERT_FALSE(text.empty());
    EXPECT_EQ(text.back(), '\n');
    const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    const std::string last = text.substr(text.rfind('\n', text.size() - 2) + 1);
    EXPECT_EQ(commas(last), commas(text.substr(0, text.find('\n')))) << last;
    EXPECT_GT(std::count(text.begin(), text.end(), '\n'), least);
  }
};

TEST_F(Ends, a_supervisor_s_endless_loop_ends_at_the_host_limit) {
  ASSERT_EQ(twinpuck("build " + endless_supervisor()).exit_code, 0);  // the limit counts building, too
  const auto said =
      twinpuck("run empty --host-limit 1 --record " + path("r.csv") + " --supervisor " + endless_supervisor(),
               kPatient);
  EXPECT_EQ(said.exit_code, 124) << said.text;
  EXPECT_TRUE(reads(
      said.text,
      "puck: ./firmware/square, 1 file\nendless: its program has not stepped for … s (t=0.500 s); it was "
      "ended\n~/worlds/empty.toml: 0.5 s simulated in … s (… times real time), seed 1, digest …\nrobot       "
      "    x (m)    y (m)   heading  path (m)  collisions  wall (s)   load     used      left\npuck          "
      "  0.025    0.000     0 deg     0.025           0      0.00     …    0 mWh   … min\nwritten: "
      "@/r.csv\ntwinpuck: host time: got … s, expected at most 1 s; outputs hold what was simulated"));
  expect_whole_lines(path("r.csv"));
}

TEST_F(Ends, a_supervisor_s_endless_loop_ends_at_a_signal) {
  for (const char* signal : {"TERM", "INT"}) {
    fs::remove(path("r.csv"));
    const auto said =
        twinpuck("run empty --record " + path("r.csv") + " --supervisor " + endless_supervisor(),
                 signal_once(signal, path("r.csv"), 0, "1.5"));
    EXPECT_EQ(said.exit_code, 130) << said.text;
    EXPECT_TRUE(reads(said.text,
                      "puck: ./firmware/square, 1 file\nendless: its program has not stepped for … s "
                      "(t=0.500 s); it was ended\n~/worlds/empty.toml: 0.5 s simulated in … s (… times real "
                      "time), seed 1, digest …\nrobot           x (m)    y (m)   heading  path (m)  "
                      "collisions  wall (s)   load     used      left\npuck            0.025    0.000     0 "
                      "deg     0.025           0      0.00     …    0 mWh   … min\nwritten: @/r.csv"));
    expect_whole_lines(path("r.csv"));
  }
}

TEST_F(Ends, a_run_at_any_pace_ends_with_its_summary_at_a_signal) {
  for (const char* speed : {"max", "0.0001"}) {
    fs::remove(path("r.csv"));
    const auto said =
        twinpuck("run maze --for 1e6 --record-every 0.1 --record " + path("r.csv") + " --speed " + speed,
                 signal_once("TERM", path("r.csv"), 0, "1.5"));
    EXPECT_EQ(said.exit_code, 130) << said.text;
    EXPECT_NE(said.text.find("s simulated in "), std::string::npos) << said.text;
    if (std::string(speed) == "max") expect_whole_lines(path("r.csv"));
  }
}

TEST_F(Ends, every_long_verb_ends_at_a_signal) {
  const auto said = twinpuck("lab --full", kTerm);
  EXPECT_EQ(said.exit_code, 130) << said.text;
}

// `| head -1`: nobody reads the rest, and what is asked for in files is whole up to there
TEST_F(Ends, whoever_has_nobody_left_to_tell_ends) {
  const auto piped = [this](const std::string& line) {
    return in_folder("{ " + line + "; echo $? >code; } | head -1");
  };
  const std::string many = write("many", "continue\ncontinue\n");
  const auto run = piped("timeout 20 twinpuck run maze --fw serial_echo --for 100000 --record r.csv");
  EXPECT_TRUE(reads(run.text,
                    "puck: ~/firmware/serial_echo, 1 file\nstandard output: cannot be written any more; the "
                    "run ended at … s"));
  EXPECT_EQ(read(path("code")), "7\n");
  expect_whole_lines(path("r.csv"), 1);
  for (const std::string& from : {"-x " + many, "<" + many}) {
    const auto debug = piped("timeout 20 twinpuck debug maze --fw obstacle " + from);
    EXPECT_TRUE(reads(debug.text,
                      "puck: ~/firmware/lab/obstacle, 1 file\nstandard output: cannot be written any more; "
                      "debugging ended"));
    EXPECT_EQ(read(path("code")), "7\n");
  }
  const auto lab = piped("timeout 60 twinpuck lab --seeds 1 I1 I3 S14 --csv l.csv");
  EXPECT_NE(lab.text.find("standard output: cannot be written any more; the lab ended behind I"),
            std::string::npos)
      << lab.text;
  EXPECT_EQ(read(path("code")), "7\n");
  EXPECT_GT(read(path("l.csv")).size(), 100u);
  EXPECT_EQ(read(path("l.csv")).find("S14"), std::string::npos);
  // what was all said, and what says nothing, is good
  EXPECT_EQ(piped("twinpuck list worlds").exit_code + piped("twinpuck run maze -q --for 1000").exit_code, 0);
  EXPECT_EQ(read(path("code")), "0\n");
}

// the work that fits before the handlers was computed as 2^64 cycles
TEST_F(Ends, basic_motors_beside_agendas_run_on_at_every_speed) {
  for (const char* speed : {"410", "50", "650", "999"}) {
    write("both/main.c",
          "#include <p30F6014A.h>\n"
          "#include <motor_led/e_init_port.h>\n"
          "#include <motor_led/e_motors.h>\n"
          "#include <motor_led/advance_one_timer/e_agenda.h>\n"
          "volatile unsigned d;\n"
          "int main(void) {\n"
          "  e_init_port(); e_start_agendas_processing(); e_init_motors();\n"
          "  e_set_speed_left(" +
              std::string(speed) + "); e_set_speed_right(" + speed + ");\n  while (1) d++;\n}\n");
    const auto said = twinpuck("run empty --for 2 --host-limit 20 --fw '*=" + path("both") + "'", kPatient);
    EXPECT_EQ(said.exit_code, 0) << speed << "\n" << said.text;
  }
}

// the same cause beside the converter and the codec: the main program stood still while interrupts went on
TEST_F(Ends, delay_loops_beside_scan_sound_and_agendas_go_on) {
  write("delays/main.c", R"(
#include <p30F6014A.h>
#include <stdlib.h>
#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <codec/e_sound.h>
volatile unsigned d, old, same;
void tick(void) { if (d == old) { if (++same > 60) abort(); } else same = 0; old = d; }
int main(void) {
  unsigned i, k, m;
  e_init_port(); e_init_ad_scan(ALL_ADC); e_init_sound();
  e_activate_agenda(tick, 10); e_start_agendas_processing();
  while (1) {
    m = rand() & 1023;
    if (!(d & 1023)) e_play_sound(0, 2000);
    for (k = 0; k < 20; k++) {
      for (i = 0; i < m; i++);
      d++;
      for (i = 0; i < 3; i++) __asm__("nop");
    }
  }
}
)");
  const auto said = twinpuck("run empty --for 10 --host-limit 30 --fw '*=" + path("delays") + "'", kPatient);
  EXPECT_EQ(said.exit_code, 0) << said.text;
}

}  // namespace
