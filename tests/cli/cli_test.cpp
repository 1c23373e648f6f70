// SPDX-License-Identifier: MIT
// The verbs when all goes well, and what they leave behind.
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command.h"
#include "twinpuck_paths.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class Command : public CommandTest {};

TEST_F(Command, run_writes_record_summary_and_picture_that_agree) {
  const Said s = twinpuck("run maze --for 10 --record " + path("r.csv") + " --summary " + path("s.json") +
                          " --picture " + path("p.png") + " -q");
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const json summary = json::parse(read(path("s.json")));
  for (const char* key : {"version", "world", "seed", "simulated_s", "wall_s", "speed", "digest", "robots"})
    EXPECT_TRUE(summary.contains(key)) << key;
  const json& robot = summary["robots"][0];
  for (const char* key :
       {"name", "firmware", "hal", "x_m", "y_m", "heading_rad", "distance_m", "collisions", "cycles",
        "cpu_load", "battery_v", "battery_used_wh", "battery_minutes_left", "traps"})
    EXPECT_TRUE(robot.contains(key)) << key;
  EXPECT_EQ(robot["hal"], "sim");
  EXPECT_EQ(robot["cycles"], 147'456'000);
  // 10 s at something between the electronics' 0.13 A and four coils' 0.24 A more, at nearly 4 V
  EXPECT_GT(robot["battery_used_wh"].get<double>(), 0.12 * 3.8 * 10 / 3600);
  EXPECT_LT(robot["battery_used_wh"].get<double>(), 0.45 * 4.0 * 10 / 3600);
  EXPECT_LT(robot["battery_v"].get<double>(), 4.0);
  EXPECT_GT(robot["battery_minutes_left"].get<double>(), 60);

  std::istringstream csv(read(path("r.csv")));
  std::string line, last, header;
  std::getline(csv, header);
  EXPECT_EQ(header,
            "time_s,robot,x_m,y_m,heading_rad,left_steps,right_steps,ir0,ir1,ir2,ir3,ir4,ir5,ir6,ir7,leds");
  int rows = 0;
  while (std::getline(csv, line)) last = line, ++rows;
  EXPECT_NEAR(rows, 1001, 1);
  double time_s, x_m, y_m;
  char name[32];
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%31[^,],%lf,%lf", &time_s, name, &x_m, &y_m), 4) << last;
  EXPECT_NEAR(time_s, 10, 0.011);
  EXPECT_NEAR(x_m, robot["x_m"].get<double>(), 0.001);
  EXPECT_NEAR(y_m, robot["y_m"].get<double>(), 0.001);
  EXPECT_EQ(read(path("p.png")).substr(1, 3), "PNG");
}

TEST_F(Command, the_same_run_twice_is_the_same_to_the_byte) {
  for (const char* name : {"a", "b"})
    ASSERT_EQ(twinpuck("run maze --for 5 -q --record " + path(std::string(name) + ".csv")).exit_code, 0);
  EXPECT_EQ(read(path("a.csv")), read(path("b.csv")));
}

TEST_F(Command, the_readme_shows_the_digest_that_a_run_gives) {
  const Said s = twinpuck("run worlds/maze.toml --for 60 -q --summary " + path("s.json"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const std::string digest = json::parse(read(path("s.json")))["digest"];
  EXPECT_NE(read(TWINPUCK_SOURCE_DIR "/README.md").find("digest " + digest), std::string::npos) << digest;
}

TEST_F(Command, the_digest_depends_on_the_seed_and_not_on_threads_or_outputs) {
  const auto digest = [&](const std::string& options) {
    const Said s =
        twinpuck("run bench/worlds/brait_5.toml --for 3 -q --summary " + path("s.json") + " " + options);
    EXPECT_EQ(s.exit_code, 0) << s.text;
    return json::parse(read(path("s.json")))["digest"].get<std::string>();
  };
  const std::string plain = digest("");
  EXPECT_EQ(plain, digest("--threads 2"));
  EXPECT_EQ(plain, digest("--threads 5 --record " + path("x.csv") + " --picture " + path("x.svg")));
  EXPECT_NE(plain, digest("--seed 7"));
}

TEST_F(Command, a_trap_ends_with_exit_code_3_and_says_where) {
  write("bad/main.c", "volatile int zero;\nint main(void) {\n  return 5 / zero;\n}\n");
  const Said s =
      twinpuck("run worlds/maze.toml --fw '*=" + path("bad") + "' --for 1 --summary " + path("s.json"));
  EXPECT_EQ(s.exit_code, 3) << s.text;
  const json trap = json::parse(read(path("s.json")))["robots"][0]["traps"][0];
  EXPECT_EQ(trap["kind"], "math error");
  EXPECT_EQ(trap["line"], 3);
}

TEST_F(Command, a_diagnosis_is_in_the_summary) {
  write("floating/main.c",
        "#include <motor_led/e_epuck_ports.h>\n"
        "int main(void) { long i; while (1) { LATAbits.LATA6 ^= 1; for (i = 0; i < 1000; i++); } }\n");
  twinpuck("run maze -q --for 0.1 --fw " + path("floating") + " --summary " + path("s.json"));
  const json told = json::parse(read(path("s.json")))["robots"][0]["diagnoses"];
  ASSERT_EQ(told.size(), 1u) << told;
  EXPECT_EQ(told[0]["cause"], "input driven");
  EXPECT_EQ(told[0]["place"], "TRISA6");
}

TEST_F(Command, a_real_time_run_is_paced) {
  const Said s = twinpuck("run maze --for 1 --speed 1 --summary " + path("s.json"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NEAR(json::parse(read(path("s.json")))["wall_s"].get<double>(), 1.0, 0.5);
}

TEST_F(Command, the_host_time_guard_ends_with_124) {
  EXPECT_EQ(twinpuck("run maze --for 100 --speed 1 --host-limit 0.5").exit_code, 124);
}

// of a terminal that is closed, and of Ctrl-\, a run left half a summary and no picture
TEST_F(Command, every_signal_that_asks_for_the_end_keeps_the_outputs) {
  twinpuck("run maze --for 0.1 -q");  // its controller is built before the time counts
  for (const char* signal : {"INT", "TERM", "HUP", "QUIT"}) {
    fs::remove(path("r.csv"));
    fs::remove(path("p.png"));
    const Said s = twinpuck("run maze --for 1000 --speed 1 --record " + path("r.csv") + " --summary " +
                                path("s.json") + " --trace " + path("t.json") + " --picture " + path("p.png"),
                            signal_once(signal, path("r.csv"), 0, "1"));
    EXPECT_EQ(s.exit_code, 130) << signal << s.text;
    EXPECT_TRUE(json::accept(read(path("s.json")))) << signal;
    EXPECT_TRUE(json::accept(read(path("t.json")))) << signal;
    EXPECT_EQ(read(path("r.csv")).back(), '\n') << signal;
    EXPECT_GT(read(path("p.png")).size(), 100u) << signal;
  }
  const Said kept = twinpuck("run maze --for 2 --speed 1 --record " + path("n.csv"),
                             signal_once("HUP", path("n.csv"), 0, "0.5") + " nohup");
  EXPECT_EQ(kept.exit_code, 0) << kept.text;
}

// 107 KB, a line for each register
TEST_F(Command, a_program_that_writes_everywhere_is_told_in_few_lines) {
  write("wipe/main.c",
        "int main(void) { unsigned a; for (a = 0x7fe; a >= 0x82; a -= 2) *(volatile unsigned*)a = 1; while "
        "(1); }\n");
  const Said s = twinpuck("run empty --for 0.1 --fw '*=" + path("wipe") + "' --summary " + path("s.json"));
  EXPECT_LT(std::count(s.text.begin(), s.text.end(), '\n'), 50) << s.text;
  EXPECT_NE(
      s.text.find(": 0x0776 to 0x07fe: unimplemented address: 0x0776 to 0x07fe: no register of this chip; "
                  "the write is ignored ("),
      std::string::npos)
      << s.text;
  EXPECT_NE(s.text.find(" more: unimplemented address; --summary FILE lists all\n"), std::string::npos)
      << s.text;
  EXPECT_GT(json::parse(read(path("s.json")))["robots"][0]["diagnoses"].size(), 100u);
}

TEST_F(Command, a_killed_run_leaves_a_readable_recording) {
  twinpuck("run maze --for 1000 --speed 20 -q --record " + path("r.csv"),
           signal_once("KILL", path("r.csv"), 2000));
  const std::string csv = read(path("r.csv"));
  EXPECT_GT(csv.size(), 1000u);
  const std::size_t end = csv.rfind('\n');
  const std::string last = csv.substr(csv.rfind('\n', end - 1) + 1, end - csv.rfind('\n', end - 1) - 1);
  EXPECT_EQ(std::count(last.begin(), last.end(), ','), 15) << last;
}

// the header of a WAV file of a run that was killed tells what is there: 44 bytes and two for each sample
TEST_F(Command, a_killed_run_leaves_whole_sound_files) {
  write("singer/main.c",
        "#include <codec/e_sound.h>\n#include <motor_led/e_init_port.h>\nextern int e_dci_unavailable;\n"
        "int main(void) { e_init_port(); e_init_sound(); while (1) { if (!e_dci_unavailable) "
        "e_play_sound(0, 2112); } }\n");
  const std::string run = "run maze --fw '*=" + path("singer") + "' -q --save-sound " + path("sound");
  EXPECT_EQ(twinpuck(run + " --for 0.5").exit_code, 0);
  for (int killed = 0; killed < 2; ++killed) {
    if (killed) twinpuck(run + " --for 1000 --speed 5", signal_once("KILL", path("sound/puck.wav"), 20000));
    const std::string wav = read(path("sound/puck.wav"));
    ASSERT_GT(wav.size(), 7200u);
    EXPECT_EQ(wav.substr(0, 4), "RIFF");
    std::uint32_t bytes = 0;
    std::memcpy(&bytes, wav.data() + 40, 4);
    // killed between a tick's samples and the header, the header leaves out these samples: 15 of 2 bytes
    EXPECT_LE(bytes, wav.size() - 44);
    EXPECT_GE(bytes + (killed ? 30 : 0), wav.size() - 44);
    EXPECT_NE(wav.find_first_not_of('\0', 44), std::string::npos);
  }
}

TEST_F(Command, keys_of_a_remote_control_arrive) {
  write("remote/main.c",
        "#include <motor_led/advance_one_timer/e_agenda.h>\n"
        "#include <motor_led/advance_one_timer/e_remote_control.h>\n"
        "#include <motor_led/e_init_port.h>\n#include <stdio.h>\n#include <uart/e_uart_char.h>\n"
        "int main(void) { int last = -1; e_init_port(); e_init_uart1(); e_init_remote_control();\n"
        "  e_start_agendas_processing();\n"
        "  while (1) if (e_get_check() != 2 && e_get_data() * 32 + e_get_address() != last) {\n"
        "    last = e_get_data() * 32 + e_get_address();\n"
        "    printf(\"%d/%d \", e_get_data(), e_get_address()); } }\n");
  const Said s = twinpuck("run empty --fw '*=" + path("remote") + "' --uart '*=file:" + path("out.txt") +
                          "' --for 2 --key '*=VOL_UP@1.2+0.3' --key puck=5@0.5 --key '*=8:32@1'");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(read(path("out.txt")), "5/0 32/8 16/0 ");
}

TEST_F(Command, options_may_stand_before_the_world_and_a_controller_alone_is_for_every_robot) {
  const Said before = twinpuck("run --fw blink --for 0.1 epuck_5");
  EXPECT_EQ(before.exit_code, 0) << before.text;
  const Said with_equals = twinpuck("run epuck_5 --for=0.1 --fw=*=blink");
  EXPECT_EQ(before.text.substr(before.text.find("digest"), 23),
            with_equals.text.substr(with_equals.text.find("digest"), 23));
}

TEST_F(Command, uart_output_goes_to_a_file) {
  write("hello/main.c",
        "#include <uart/e_uart_char.h>\nint main(void) { e_init_uart1(); e_send_uart1_char(\"hello\\r\\n\", "
        "7); while (1); }\n");
  const Said s =
      twinpuck("run maze --fw '*=" + path("hello") + "' --uart '*=file:" + path("out.txt") + "' --for 0.5");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(read(path("out.txt")), "hello\r\n");
}

TEST_F(Command, build_then_run_the_image) {
  ASSERT_EQ(twinpuck("build blink -o " + path("blink.elf")).exit_code, 0);
  const Said s = twinpuck("run maze --fw puck=" + path("blink.elf") + " --for 1");
  EXPECT_EQ(s.exit_code, 0) << s.text;
}

TEST_F(Command, check_accepts_every_world_that_ships) {
  const Said s = twinpuck("check worlds/*.toml bench/worlds/*.toml");
  EXPECT_EQ(s.exit_code, 0) << s.text;
}

TEST_F(Command, the_summary_counts_radio_packets_where_there_is_a_radio) {
  ASSERT_EQ(twinpuck("run flock --for 3 -q --summary " + path("s.json")).exit_code, 0);
  const json radio = json::parse(read(path("s.json")))["radio"];
  EXPECT_GT(radio["sent"], 0);
  EXPECT_GT(radio["delivered"], 0);
  int pairs = 0;
  for (const char* key :
       {"delivered", "out_of_range", "by_chance", "by_collision", "while_sending", "switched_off"})
    pairs += radio[key].get<int>();
  EXPECT_NEAR(pairs, 9 * radio["sent"].get<int>(), 9 * 10);  // at most one frame a robot is still on its way
  ASSERT_EQ(twinpuck("run maze --for 0.1 -q --summary " + path("m.json")).exit_code, 0);
  EXPECT_FALSE(json::parse(read(path("m.json"))).contains("radio"));
}

}  // namespace
