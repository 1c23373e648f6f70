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

TEST_F(Command, help_names_every_verb) {
  const Said s = twinpuck("--help");
  EXPECT_EQ(s.exit_code, 0);
  for (const char* verb :
       {"run", "check", "build", "lint", "cycles", "inspect", "new", "init", "paths", "list", "lab"})
    EXPECT_NE(s.text.find(verb), std::string::npos) << verb;
}

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
  EXPECT_NE(s.text.find("division by zero"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("main.c:3"), std::string::npos) << s.text;
  const json trap = json::parse(read(path("s.json")))["robots"][0]["traps"][0];
  EXPECT_EQ(trap["kind"], "math error");
  EXPECT_EQ(trap["line"], 3);
}

TEST_F(Command, strict_makes_diagnoses_an_error) {
  write("floating/main.c",
        "#include <motor_led/e_epuck_ports.h>\n"
        "int main(void) { long i; while (1) { LATAbits.LATA6 ^= 1; for (i = 0; i < 1000; i++); } }\n");
  const std::string run = "run maze --for 0.1 --fw '*=" + path("floating") + "' ";
  const Said relaxed = twinpuck(run + "--summary " + path("s.json"));
  EXPECT_EQ(relaxed.exit_code, 0) << relaxed.text;
  EXPECT_NE(relaxed.text.find("s: TRISA6: input driven: LATA6"), std::string::npos) << relaxed.text;
  EXPECT_NE(relaxed.text.find("e_init_port()"), std::string::npos) << relaxed.text;
  const std::string json = read(path("s.json"));
  EXPECT_NE(json.find("\"cause\": \"input driven\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"place\": \"TRISA6\""), std::string::npos) << json;
  const Said strict = twinpuck(run + "--strict -q");
  EXPECT_EQ(strict.exit_code, 1) << strict.text;
  EXPECT_NE(strict.text.find("input driven"), std::string::npos) << strict.text;
  EXPECT_EQ(twinpuck("run maze --for 0.1 --strict -q").exit_code, 0);
}

TEST_F(Command, a_real_time_run_is_paced) {
  const Said s = twinpuck("run maze --for 1 --speed 1 --summary " + path("s.json"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NEAR(json::parse(read(path("s.json")))["wall_s"].get<double>(), 1.0, 0.5);
}

TEST_F(Command, the_host_time_guard_ends_with_124) {
  EXPECT_EQ(twinpuck("run maze --for 100 --speed 1 --host-limit 0.5").exit_code, 124);
}

TEST_F(Command, ctrl_c_ends_with_130_and_keeps_the_outputs) {
  twinpuck("run maze --for 0.1 -q");  // its controller is built before the time counts
  const Said s =
      twinpuck("run maze --for 1000 --speed 1 --record " + path("r.csv") + " --summary " + path("s.json"),
               signal_once("INT", path("r.csv"), 0, "2"));
  EXPECT_EQ(s.exit_code, 130) << s.text;
  EXPECT_TRUE(json::accept(read(path("s.json"))));
  EXPECT_EQ(read(path("r.csv")).back(), '\n');
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
  write("file", "");
  const Said s = twinpuck("run maze --for 0.1 --save-sound " + path("file"));
  EXPECT_EQ(s.exit_code, 2);
  EXPECT_NE(s.text.find("--save-sound: got '"), std::string::npos) << s.text;
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

TEST_F(Command, text_on_uart_1_is_shown_unless_somebody_takes_it) {
  write("chatty/main.c",
        "#include <uart/e_uart_char.h>\nint main(void) { e_init_uart1(); "
        "e_send_uart1_char(\"hello\\r\\n\\1\\2\\nbye\", "
        "13); while (1); }\n");
  const std::string run = "run maze --fw " + path("chatty") + " --for 0.1 ";
  const Said shown = twinpuck(run);
  EXPECT_NE(shown.text.find("puck: hello\npuck: bye\n"), std::string::npos) << shown.text;
  EXPECT_NE(shown.text.find("puck: 2 bytes that are no text; --uart puck=file:F keeps them"),
            std::string::npos)
      << shown.text;
  EXPECT_NE(twinpuck(run + "-q --uart puck=-").text.find("puck: hello"), std::string::npos);
  EXPECT_EQ(twinpuck(run + "-q").text, "");
  EXPECT_EQ(twinpuck(run + "--uart none").text.find("hello"), std::string::npos);
  EXPECT_EQ(twinpuck(run + "--uart puck=file:" + path("out.txt")).text.find("hello"), std::string::npos);
  // who looks changes nothing
  const auto digest = [](const std::string& text) { return text.substr(text.find("digest "), 23); };
  EXPECT_EQ(digest(shown.text), digest(twinpuck(run + "--uart none").text));
}

TEST_F(Command, options_may_stand_before_the_world_and_a_controller_alone_is_for_every_robot) {
  const Said before = twinpuck("run --fw blink --for 0.1 epuck_5");
  EXPECT_EQ(before.exit_code, 0) << before.text;
  const Said with_equals = twinpuck("run epuck_5 --for=0.1 --fw=*=blink");
  EXPECT_EQ(before.text.substr(before.text.find("digest"), 23),
            with_equals.text.substr(with_equals.text.find("digest"), 23));
}

TEST_F(Command, check_finds_what_is_missing_and_what_is_wrong_in_one_pass) {
  write("bad.toml",
        "twinpuck = 1\n[world]\nsed = 2\n[[robot]]\nname = \"a\"\nfirmware = \"blnk\"\n"
        "[[supervisor]]\nprogram = \"socce\"\n");
  const Said s = twinpuck("check " + path("bad.toml"));
  EXPECT_EQ(s.exit_code, 2);
  for (const char* part :
       {"bad.toml:3:1: unknown key 'sed'", "robot 'a': blnk: firmware: ", "did you mean 'blink'?",
        "supervisor 'socce': socce: firmware: ", "did you mean 'soccer'?"})
    EXPECT_NE(s.text.find(part), std::string::npos) << part << " in " << s.text;
  EXPECT_EQ(twinpuck("check maze").text.substr(twinpuck("check maze").text.find("good")),
            "good: 1 robot, 2 objects, 512 Hz\n");
}

TEST_F(Command, help_lists_and_builds_need_no_more_words_than_they_say) {
  const Said help = twinpuck("help run");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* part : {"Robots:", "Outputs:", "Example: twinpuck run maze", "Exit codes:"})
    EXPECT_NE(help.text.find(part), std::string::npos) << part;
  EXPECT_NE(twinpuck("--help").text.find("Exit codes:"), std::string::npos);
  EXPECT_EQ(twinpuck("-V").text.substr(0, 9), "twinpuck ");
  const Said worlds = twinpuck("list worlds");
  EXPECT_NE(worlds.text.find("A maze of 1.6 m by 1.2 m"), std::string::npos) << worlds.text;
  EXPECT_EQ(worlds.text.find("Controllers"), std::string::npos);
  const Said build = twinpuck("build blink");
  EXPECT_EQ(build.exit_code, 0);
  EXPECT_NE(build.text.find("/images/blink-"), std::string::npos) << build.text;
}

TEST_F(Command, a_run_says_what_it_has_written) {
  const Said s = twinpuck("run maze --for 0.1 --summary " + path("s.json") + " --record " + path("r.csv"));
  EXPECT_NE(s.text.find("written: " + path("r.csv") + ", " + path("s.json") + "\n"), std::string::npos)
      << s.text;
  EXPECT_EQ(twinpuck("run maze --for 0.1").text.find("written"), std::string::npos);
}

TEST_F(Command, headings_are_said_as_people_say_them) {
  write("still/main.c", "int main(void) { while (1); }\n");
  write("headings.toml",
        "twinpuck = 1\n[[robot]]\nname = \"a\"\nposition = [-0.0001, 0]\nheading = 341\n[[robot]]\nname = "
        "\"b\"\n"
        "position = [1, 0]\nheading = -0.2\n");
  const Said s = twinpuck("run " + path("headings.toml") + " --for 0.1 --fw " + path("still"));
  EXPECT_NE(s.text.find("a               0.000    0.000   -19 deg"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("b               1.000    0.000     0 deg"), std::string::npos) << s.text;
}

TEST_F(Command, typed_keys_of_a_webots_program_come_from_the_command_line) {
  write("typist/typist.c",
        "#include <stdio.h>\n#include <webots/keyboard.h>\n#include <webots/robot.h>\n"
        "int main(void) { int key;\n"
        "  wb_robot_init(); wb_keyboard_enable(64);\n"
        "  while (wb_robot_step(64) != -1)\n"
        "    if ((key = wb_keyboard_get_key()) > 0) printf(\"%d \", key); }\n");
  const Said s = twinpuck("run empty --fw '*=" + path("typist") +
                          "' --for 2 --key '*=keyboard:UP@1+0.064' --key 'puck=keyboard:w@1.5+0.064'");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NE(s.text.find("puck: 315 87 "), std::string::npos) << s.text;
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
  ASSERT_EQ(twinpuck("build blink -o " + path("blink.so")).exit_code, 0);
  const Said s = twinpuck("run maze --fw puck=" + path("blink.so") + " --for 1");
  EXPECT_EQ(s.exit_code, 0) << s.text;
}

TEST_F(Command, cycles_lists_functions_with_microseconds) {
  const Said s = twinpuck("cycles obstacle");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NE(s.text.find("main"), std::string::npos);
  EXPECT_NE(s.text.find("mean (us)"), std::string::npos);
  // 5 cycles in the run, and by its code
  const std::size_t row = s.text.find("\ncontrol_tick ");
  ASSERT_NE(row, std::string::npos) << s.text;
  std::istringstream in(s.text.substr(row));
  std::string name, min, mean, max, us, load, calls, own, code;
  in >> name >> min >> mean >> max >> us >> load >> calls >> own >> code;
  for (const std::string& cycles : {min, mean, max, own, code}) EXPECT_EQ(cycles, "5") << s.text;
  EXPECT_EQ(us, "0.34");
  EXPECT_EQ(calls, "55");
}

TEST_F(Command, cycles_shows_the_programs_functions_and_the_librarys_when_asked) {
  write("mine/main.c",
        "#include <motor_led/advance_one_timer/e_motors.h>\nvolatile int v;\nstatic void twice(int n) { v = "
        "n * v; }\n"
        "void often(void) { v++; }\nint main(void) { e_init_motors(); twice(2); while (1) often(); }\n");
  const Said s = twinpuck("cycles " + path("mine"));
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(s.text.find("\ne_init_motors"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("functions of the library: --all"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("part of main"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("\ntwice "), std::string::npos) << s.text;
  // main is called once
  const std::string line = s.text.substr(s.text.find("\nmain ") + 1);
  EXPECT_EQ(line.substr(0, line.find('\n')).find('%'), std::string::npos) << s.text;
  EXPECT_NE(twinpuck("cycles --all " + path("mine")).text.find("\ne_init_motors"), std::string::npos);
}

TEST_F(Command, lint_praises_and_blames) {
  EXPECT_EQ(twinpuck("lint blink").exit_code, 0);
  write("sloppy/main.c",
        "int flag;\nvoid _T1Interrupt(void) { flag = 1; }\n"
        "int main(void) { while (!flag); return 70000; }\n");
  const Said s = twinpuck("lint " + path("sloppy"));
  EXPECT_EQ(s.exit_code, 1);
  EXPECT_NE(
      s.text.find(
          "main.c:3: warning: flag: written by _T1Interrupt(); got a plain variable, expected volatile"),
      std::string::npos)
      << s.text;
}

TEST_F(Command, list_shows_controllers_and_worlds) {
  const Said s = twinpuck("list");
  EXPECT_EQ(s.exit_code, 0);
  EXPECT_NE(s.text.find("obstacle"), std::string::npos);
  EXPECT_NE(s.text.find("maze"), std::string::npos);
}

TEST_F(Command, check_accepts_every_world_that_ships) {
  const Said s = twinpuck("check worlds/*.toml bench/worlds/*.toml");
  EXPECT_EQ(s.exit_code, 0) << s.text;
}

TEST_F(Command, sanitize_finds_a_16_bit_overflow_and_a_bad_index) {
  write("over/main.c", "volatile int a = 30000, b;\nint main(void) {\n  b = a + a;\n  while (1);\n}\n");
  Said s = twinpuck("run maze --fw '*=" + path("over") + "' --for 0.1 --sanitize");
  EXPECT_EQ(s.exit_code, 3) << s.text;
  EXPECT_NE(s.text.find("main.c:3"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("integer overflow in an addition"), std::string::npos) << s.text;
  write("index/main.c",
        "int table[4], other[4];\nvolatile int i = 4;\nint main(void) {\n  table[i] = 1;\n  while (1);\n}\n");
  s = twinpuck("run maze --fw '*=" + path("index") + "' --for 0.1 --sanitize");
  EXPECT_EQ(s.exit_code, 3) << s.text;
  EXPECT_NE(s.text.find("main.c:4"), std::string::npos) << s.text;
}

TEST_F(Command, sanitize_names_the_line_that_calls_a_string_function) {
  write("long/main.c",
        "#include <string.h>\nchar name[8], other[8];\nvolatile int n;\nstatic void fill(void) {\n"
        "  strcpy(name, &\"longer than that\"[n]);\n}\nint main(void) {\n  fill();\n  while (1);\n}\n");
  const Said s = twinpuck("run maze --fw '*=" + path("long") + "' --for 0.1 --sanitize --opt -O0");
  EXPECT_EQ(s.exit_code, 3) << s.text;
  EXPECT_NE(s.text.find("in strcpy(): write out of bounds of name"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("  at fill (" + path("long/main.c") + ":5)"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("called from main (" + path("long/main.c") + ":8)"), std::string::npos) << s.text;
  for (const char* inner : {"string.c", "tp_checked"})
    EXPECT_EQ(s.text.find(inner), std::string::npos) << inner << " in\n" << s.text;
}

// each run, not the first alone, and with --strict what does not fit the chip is a fault
TEST_F(Command, warnings_of_the_build_come_with_each_run_and_strict_ends_in_1) {
  write("fat/main.c",
        "char picture[9000];\nvolatile int n;\nint main(void) {\n  int big = 70000;\n  picture[n] = big;\n"
        "  while (1);\n}\n");
  // the chip's linker has no room for it
  const Said linked = twinpuck("run maze --fw '*=" + path("fat") + "' --for 0.1 -q ");
  EXPECT_EQ(linked.exit_code, 2) << linked.text;
  for (const char* part : {"main.c:4", "70000", "link: error: RAM: no room for picture, 9000 bytes"})
    EXPECT_NE(linked.text.find(part), std::string::npos) << linked.text;
  // data and stack together have none
  write("tight/main.c",
        "char picture[7600];\nvolatile int n;\nvoid deep(void) {\n  volatile char room[900];\n"
        "  room[n] = 1;\n}\nint main(void) {\n  int big = 70000;\n  picture[n] = big;\n"
        "  while (1) deep();\n}\n");
  const std::string run = "run maze --fw '*=" + path("tight") + "' --for 0.1 -q ";
  for (const char* strict : {"", "", "--strict"}) {
    const Said s = twinpuck(run + strict);
    EXPECT_EQ(s.exit_code, *strict ? 1 : 0) << s.text;
    EXPECT_NE(s.text.find("main.c:8"), std::string::npos) << s.text;
    EXPECT_NE(s.text.find("70000"), std::string::npos) << s.text;
    EXPECT_NE(
        s.text.find(
            "warning: stack: got 908 bytes at most, expected at most 574, which is what variables leave"),
        std::string::npos)
        << s.text;
  }
  write("thin/main.c", "volatile int n;\nint main(void) {\n  while (1) n++;\n}\n");
  EXPECT_EQ(twinpuck("run maze --fw '*=" + path("thin") + "' --for 0.1 -q --strict").exit_code, 0);
  const Said image = twinpuck("build " + path("thin") + " -o " + path("thin.elf"));
  for (const char* part : {"RAM        2 of 8192 bytes (0 %)", "stack      4 bytes at most"})
    EXPECT_NE(image.text.find(part), std::string::npos) << image.text;
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
