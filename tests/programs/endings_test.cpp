// SPDX-License-Identifier: MIT
// How programs of the PC end, hostile ones among them: what the run says and does then, its exit code
// (docs/start.md), its records, and that no process of theirs is left. All against the shipped command.
#include <atomic>
#include <mutex>

#include "tests/programs/process_watch.h"

namespace {

using namespace programs_test;
using cli_test::signal_once;

/// The link without libcontroller: rec() packs a record as programs/link/packet.h says, after hello() the
/// program has the turn, step() gives it back.
const char* const kRaw = R"(
import os, signal, socket, struct, sys, time
s = socket.socket(fileno=int(os.environ["TWINPUCK_CONTROLLER"].split(":")[1]))
HELLO, STEP, FIND_DEVICE = 1, 10, 50

def rec(number, *members):
    body = b""
    for m in members:
        if isinstance(m, int):
            body += struct.pack("<q", m)
        elif isinstance(m, float):
            body += struct.pack("<d", m)
        else:
            m = m.encode()
            body += struct.pack("<q", len(m)) + m + bytes(-len(m) % 8)
    return struct.pack("<II", number, len(body)) + body

def hello():
    s.send(rec(HELLO, 2, 2, "raw"))
    s.recv(1 << 18)

def step():
    s.send(rec(STEP, 32))
    return s.recv(1 << 18)
)";

const char* const kGood =
    "#include <webots/motor.h>\n#include <webots/robot.h>\n#include <math.h>\n"
    "int main(void) { WbDeviceTag left; wb_robot_init(); left = wb_robot_get_device(\"left wheel motor\");\n"
    "wb_motor_set_position(left, INFINITY); wb_motor_set_velocity(left, 3); while (wb_robot_step(32) != -1) "
    "; return 0; }\n";

/// A line of C that the message must name: line 5 of the file.
std::string c_crash(const std::string& line) {
  return "#include <webots/robot.h>\n#include <stdlib.h>\nvolatile int *nowhere; volatile int zero;\nvoid "
         "dies(void) {\n" +
         line +
         "\n}\nint main(void) { wb_robot_init(); while (wb_robot_get_time() < 0.5) wb_robot_step(32); "
         "dies(); return 0; }\n";
}

struct Ending {
  const char* name;
  const char* language;  // "raw": Python behind kRaw
  std::string source;
  int code;
  const char* says;          // behind what each run shows
  double runs_s = 1.9;       // the record goes at least so far; the world is run for 2 s
  const char* options = "";  // more of the command line
};

class Endings : public WatchedRuns, public ::testing::WithParamInterface<Ending> {
 protected:
  /// Without the lines that each run has: what runs, how far it comes on a busy PC, where all are, what was
  /// written.
  static std::string without_report(const std::string& text) {
    std::istringstream in(text);
    std::string rest;
    for (std::string line; std::getline(in, line);)
      if (line.find(" s simulated, ") == std::string::npos &&
          std::none_of(kReport.begin(), kReport.end(),
                       [&](const char* begin) { return line.rfind(begin, 0) == 0; }))
        rest += line + "\n";
    return rest;
  }
  static constexpr std::array kReport{"bad: /", "good: /", "/", "robot  ", "bad  ", "good  ", "written: "};
};

TEST_P(Endings, are_told_and_leave_whole_records_and_no_process) {
  const Ending& e = GetParam();
  const bool is_raw = std::string(e.language) == "raw";
  const std::string bad = program("bad", is_raw ? "py" : e.language, (is_raw ? kRaw : "") + e.source);
  world({{"bad", bad}, {"good", program("good", "c", kGood)}});
  const Said said =
      run("--for 2 --record " + path("r.csv") + " --record-every 0.1 " + e.options, "timeout -s KILL 20");
  const std::string shown = said.text.substr(0, 3000);
  EXPECT_EQ(said.exit_code, e.code) << shown;
  EXPECT_TRUE(reads(without_report(said.text), e.says));
  expect_whole(path("r.csv"), e.runs_s, e.name);
  expect_nothing_left(e.name);
}

constexpr const char* kLimit = "--host-limit 1";
constexpr int kTrap = 3, kHostTime = 124;

INSTANTIATE_TEST_SUITE_P(
    OfPrograms, Endings,
    ::testing::Values(
        // by themselves
        Ending{
            "by_itself", "c",
            "#include <webots/robot.h>\nint main(void) { wb_robot_init(); wb_robot_step(320); return 0; }\n",
            0, ""},
        Ending{"without_cleanup_in_python", "py",
               "from controller import Robot\nr = Robot()\nr.step(32)\nprint('done', flush=True)\n", 0,
               "bad: done"},
        Ending{"status_3", "c",
               "#include <webots/robot.h>\n#include <stdlib.h>\nint main(void) { wb_robot_init(); "
               "wb_robot_step(320); exit(3); }\n",
               kTrap, "bad: its program: ended with exit status 3\n  at cycle 4723200, 0.320312 s"},
        Ending{"a_program_that_is_none", "py", "print('hello')\n", 0, "bad: hello"},
        // by a fault
        Ending{"segmentation_fault", "c", c_crash("*nowhere = 1;"), kTrap,
               "bad: its program: ended by signal 11 (Segmentation fault)\n  at dies (@/bad/bad.c:5), cycle "
               "7574400, 0.513672 s"},
        Ending{"division_by_zero", "c", c_crash("zero = 7 / zero;"), kTrap,
               "bad: its program: ended by signal 8 (Floating point exception)\n  at dies (@/bad/bad.c:5), "
               "cycle 7574400, 0.513672 s"},
        Ending{"abort", "c", c_crash("abort();"), kTrap,
               "bad: its program: ended by signal 6 (Aborted)\n  at main (@/bad/bad.c:5), cycle 7574400, "
               "0.513672 s"},
        Ending{"exception_in_python", "py",
               "from controller import Robot\n\ndef deep():\n    raise ValueError('no ball')\n\nr = "
               "Robot()\nr.step(320)\ndeep()\n",
               kTrap,
               "bad: Traceback (most recent call last):\nbad:   File \"@/bad/bad.py\", line 8, in "
               "<module>\nbad:     deep()\nbad:   File \"@/bad/bad.py\", line 4, in deep\nbad:     raise "
               "ValueError('no ball')\nbad: ValueError: no ball\nbad: its program: ended with exit status "
               "1\n  at cycle 4723200, 0.320312 s"},
        Ending{"killed", "raw", "hello()\nstep()\nos.kill(os.getpid(), 9)\n", kTrap,
               "bad: its program: ended by signal 9 (Killed)\n  at cycle 489600, 0.033203 s"},
        // by not coming back
        Ending{"never_says_hello", "py", "import time\ntime.sleep(100)\n", kHostTime,
               "bad: its program has not called wb_robot_init() for … s (t=0.000 s); it was ended\ntwinpuck: "
               "host time: got … s, expected at most 1 s; outputs hold what was simulated",
               -1, kLimit},
        Ending{"hangs", "raw", "hello()\nfor i in range(20):\n    step()\nwhile True:\n    pass\n", kHostTime,
               "bad: its program has not stepped for … s (t=0.641 s); it was ended\ntwinpuck: host time: got "
               "… s, expected at most 1 s; outputs hold what was simulated",
               0.5, kLimit},
        Ending{"hangs_in_a_quiet_run", "raw", "hello()\nstep()\ntime.sleep(100)\n", kHostTime,
               "bad: its program has not stepped for … s (t=0.033 s); it was ended\ntwinpuck: host time: got "
               "… s, expected at most 1 s; outputs hold what was simulated",
               -1, "--host-limit 1 --quiet"},
        Ending{"stops_itself", "raw", "hello()\nstep()\nos.kill(os.getpid(), signal.SIGSTOP)\n", kHostTime,
               "bad: its program has not stepped for … s (t=0.033 s); it was ended\ntwinpuck: host time: got "
               "… s, expected at most 1 s; outputs hold what was simulated",
               -1, kLimit},
        Ending{"prints_without_end", "raw", "hello()\nstep()\nwhile True:\n    print('x' * 1000)\n",
               kHostTime,
               "bad: its program has not stepped for … s (t=… s); it was ended\ntwinpuck: host time: got … "
               "s, expected at most 1 s; outputs hold what was simulated",
               -1, "--host-limit 1 --quiet"},
        // by what it says
        Ending{"garbage", "raw", "hello()\nstep()\ns.send(bytes(range(1, 256)) * 4)\ntime.sleep(100)\n",
               kTrap,
               "bad: its program: spoke wrongly: got a record that is longer than its packet (67305985)\n  "
               "at cycle 489600, 0.033203 s"},
        Ending{"half_a_record", "raw", "hello()\nstep()\ns.send(rec(STEP, 32)[:12])\ntime.sleep(100)\n",
               kTrap,
               "bad: its program: spoke wrongly: got a record that is longer than its packet (STEP)\n  at "
               "cycle 489600, 0.033203 s"},
        Ending{"a_text_of_a_gigabyte", "raw",
               "hello()\nstep()\ns.send(struct.pack('<IIq', 41, 16, 1 << 30) + b'x' * 8)\ntime.sleep(100)\n",
               kTrap,
               "bad: its program: spoke wrongly: got a record whose members are not those of its number "
               "(SAY)\n  at cycle 489600, 0.033203 s"},
        Ending{"a_packet_that_is_too_long", "raw",
               "hello()\nstep()\ns.send(b'x' * 150000)\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got a packet of more than 131072 bytes\n  at cycle 489600, "
               "0.033203 s"},
        Ending{"a_record_of_the_simulators", "raw", "hello()\ns.send(rec(4))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got READY, which the simulator sends\n  at cycle 0, "
               "0.000000 s"},
        Ending{"no_hello", "raw", "s.send(rec(STEP, 32))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got STEP, expected HELLO first\n  at cycle 0, 0.000000 s"},
        Ending{"hello_twice", "raw", "hello()\ns.send(rec(HELLO, 2, 2, 'again'))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got HELLO again\n  at cycle 0, 0.000000 s"},
        Ending{"another_version", "raw", "s.send(rec(HELLO, 99, 2, 'raw'))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got version 99 of the link, expected 2\n  at cycle 0, "
               "0.000000 s"},
        Ending{"a_step_back", "raw", "hello()\ns.send(rec(STEP, -5))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got a step of -5 ms, expected 0 to 2147483647\n  at cycle "
               "0, 0.000000 s"},
        Ending{"a_step_of_ages", "raw", "hello()\ns.send(rec(STEP, 1 << 62))\ntime.sleep(100)\n", kTrap,
               "bad: its program: spoke wrongly: got a step of 4611686018427387904 ms, expected 0 to "
               "2147483647\n  at cycle 0, 0.000000 s"},
        Ending{"asks_without_reading", "raw",
               "hello()\nwhile True:\n    s.send(rec(FIND_DEVICE, 'nothing'))\n", kTrap,
               "bad: its program: does not read what it asked for; it was ended\n  at cycle 0, 0.000000 s"},
        // by what it does to its process
        Ending{"closes_its_descriptors", "raw", "hello()\nstep()\nos.closerange(0, 100)\ntime.sleep(100)\n",
               kTrap,
               "bad: its program: closed its link and went on; it was ended\n  at cycle 489600, 0.033203 s"},
        Ending{"closes_its_output", "raw",
               "hello()\nos.close(1)\nos.close(2)\nwhile b'' != step():\n    pass\n", 0, ""},
        Ending{
            "fork_bomb", "raw",
            "hello()\nstep()\nfor i in range(400):\n    if os.fork() == 0:\n        time.sleep(100)\n     "
            "   os._exit(0)\ntime.sleep(100)\n",
            kTrap,
            "bad: its program: has started … processes, expected at most 256\n  at cycle 489600, 0.033203 s"},
        Ending{"orphans", "raw",
               "hello()\nif os.fork() == 0:\n    os.setsid()\n    if os.fork() == 0:\n        "
               "time.sleep(100)\n    os._exit(0)\n"
               "step()\nsys.exit(0)\n",
               0, ""},
        Ending{"children_that_hold_the_link", "raw",
               "hello()\nstep()\nif os.fork() == 0:\n    time.sleep(100)\nos._exit(0)\n", 0, ""}),
    [](const auto& info) { return std::string(info.param.name); });

// a file is a compilation unit of its own, and the first one is not where it dies
TEST_F(WatchedRuns, a_fault_in_another_file_of_a_program_is_found_there) {
  const std::string bad =
      program("bad", "c",
              "#include <webots/robot.h>\nvoid dies(void);\nint main(void) { wb_robot_init(); "
              "wb_robot_step(320); dies(); return 0; }\n");
  write("bad/another.c", "int spare;\nvolatile int *nowhere;\nvoid dies(void) {\n  *nowhere = 1;\n}\n");
  write("bad/further.c", "int further(void) { return 1; }\n");
  world({{"bad", bad}});
  const Said said = run("--for 1 -q", "timeout -s KILL 60");
  EXPECT_EQ(said.exit_code, kTrap);
  EXPECT_TRUE(reads(said.text,
                    "bad: its program: ended by signal 11 (Segmentation fault)\n  at dies "
                    "(@/bad/another.c:4), cycle …, 0.320312 s"));
}

// 10 MB of text in 10 steps: as fast as the pipe takes it. Nothing is lost, nothing waits for ever
TEST_F(WatchedRuns, a_program_may_write_much_to_its_error_output) {
  world({{"bad", program("bad", "py",
                         std::string(kRaw) + "hello()\nline = ('e' * 1000 + '\\n') * 1000\nfor i in "
                                             "range(10):\n    sys.stderr.write(line)\n"
                                             "    step()\nprint('steps', i + 1)\n")}});
  const Said said = run("--for 3 --record " + path("r.csv") + " --record-every 0.1 >" + path("out.txt"),
                        "timeout -s KILL 60");
  EXPECT_EQ(said.exit_code, 0) << said.text;
  const std::string out = read(path("out.txt"));
  EXPECT_EQ(std::count(out.begin(), out.end(), 'e') / 10000000, 1) << "of 10 million";
  EXPECT_NE(out.find("bad: steps 10"), std::string::npos);
  expect_whole(path("r.csv"), 2.9, "floods");
  expect_nothing_left("floods");
}

TEST_F(WatchedRuns, ctrl_c_ends_a_run_whose_program_hangs) {
  world(
      {{"bad", program("bad", "py",
                       std::string(kRaw) + "hello()\nfor i in range(30):\n    step()\ntime.sleep(100)\n")}});
  for (const char* signal : {"INT", "TERM"}) {
    fs::remove(path("r.csv"));
    const Said said = run("--for 60 --record-every 0.1 --record " + path("r.csv"),
                          signal_once(signal, path("r.csv"), 0, "0.7"));
    EXPECT_EQ(said.exit_code, 130) << said.text;
    EXPECT_TRUE(
        reads(said.text,
              "bad: @/bad\nbad: its program has not stepped for … s (t=0.961 s); it was ended\n@/w.toml: 1.0 "
              "s simulated in … s (… times real time), seed 1, digest …\nrobot           x (m)    y (m)   "
              "heading  path (m)  collisions  wall (s)   load     used      left\nbad             0.000    "
              "0.000     0 deg     0.000           0      0.00     0%    0 mWh   … min\nwritten: @/r.csv"));
    expect_whole(path("r.csv"), 0.8, signal);
    expect_nothing_left(signal);
  }
}

TEST_F(WatchedRuns, a_simulator_that_is_killed_leaves_no_program) {
  world({{"a", program("good", "c", kGood)},
         {"b", program("bad", "py", std::string(kRaw) + "hello()\nstep()\ntime.sleep(100)\n")}});
  const Said said = run("--for 1000 --record " + path("r.csv"), signal_once("KILL", path("r.csv"), 0, "0.5"));
  EXPECT_EQ(said.exit_code, 137) << said.text;
  expect_nothing_left("killed");
}

// at any time: the run goes on without that program and says so, or is over already
TEST_F(WatchedRuns, programs_may_be_killed_at_any_time) {
  world({{"a", program("good", "c", kGood)}, {"b", path("good")}});
  constexpr int kRuns = 50, kAtOnce = 2;
  run("--for 0.1");  // compiled once
  std::atomic<int> next{0}, killed{0};
  std::mutex telling;
  const auto work = [&] {
    for (int n; (n = next++) < kRuns;) {
      const std::string mine = mark + "-" + std::to_string(n) + "-";
      Said said;
      std::thread victim([&] {
        if (!wait_until([&] { return programs_with(mine).size() >= 1; }, 10)) return;
        // from at once to beyond the end of the run
        std::this_thread::sleep_for(std::chrono::microseconds(n * n * 60));
        const auto programs = programs_with(mine);
        if (!programs.empty()) kill(programs[static_cast<std::size_t>(n) % programs.size()], SIGKILL);
      });
      said = cli_test::twinpuck("run " + path("w.toml") + " --for 20 --record-every 0.5 --record " +
                                    path(std::to_string(n) + ".csv"),
                                "env '" + mine + "' timeout -s KILL 20");
      victim.join();
      const std::lock_guard<std::mutex> lock(telling);
      // one that was told the end has done all it was to do
      const bool was_hit = said.text.find("signal 9 (Killed)") != std::string::npos &&
                           said.text.find("told that the run is over") == std::string::npos;
      killed += was_hit;
      EXPECT_EQ(said.exit_code, was_hit ? 3 : 0) << n << ": " << said.text;
      expect_whole(path(std::to_string(n) + ".csv"), 19, "killed");
      EXPECT_TRUE(wait_until([&] { return processes_with(mine).empty(); }, 0.5)) << n;
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < kAtOnce; ++i) threads.emplace_back(work);
  for (std::thread& t : threads) t.join();
  EXPECT_GT(killed, 5) << "hardly any was hit";
}

TEST_F(WatchedRuns, keys_of_the_command_line_reach_a_program) {
  world(
      {{"puck", program("keys", "c",
                        "#include <stdio.h>\n#include <webots/keyboard.h>\n#include <webots/robot.h>\n"
                        "int main(void) { int ups = 0, w = 0, key; wb_robot_init(); wb_keyboard_enable(32);\n"
                        "while (wb_robot_step(32) != -1) while ((key = wb_keyboard_get_key()) >= 0) ups += "
                        "key == WB_KEYBOARD_UP, w += key == 'W';\n"
                        "printf(\"ups %d w %d\\n\", ups, w); return 0; }\n")}});
  const Said said = run("--for 2 --key 'puck=keyboard:UP@0.5+0.64' --key 'puck=keyboard:W@1.5'");
  EXPECT_EQ(said.exit_code, 0) << said.text;
  const std::size_t at = said.text.find("puck: ups ");
  ASSERT_NE(at, std::string::npos) << said.text;
  int ups = 0, w = 0;
  ASSERT_EQ(std::sscanf(said.text.c_str() + at, "puck: ups %d w %d", &ups, &w), 2);
  EXPECT_NEAR(ups, 20, 1);  // 0.64 s of 32 ms
  EXPECT_NEAR(w, 3, 1);     // 0.1 s
}

}  // namespace
