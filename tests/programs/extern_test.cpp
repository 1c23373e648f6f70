// SPDX-License-Identifier: MIT
// Programs that somebody starts outside of the run, and that connect to it: `twinpuck run --extern`,
// "<extern>".
#include <sys/stat.h>

#include "tests/programs/process_watch.h"

namespace {

using namespace programs_test;

const char* const kProgram =
    "from controller import Robot\nimport sys\nrobot = Robot()\nn = 0\n"
    "while robot.step(64) != -1:\n    n += 1\n    if len(sys.argv) > 1 and n == int(sys.argv[1]): "
    "break\nprint('steps', n, robot.getName())\n";

class Extern : public WatchedRuns {
 protected:
  /// Starts the run beside; its text goes to out.txt.
  void begin(const std::string& arguments, const std::string& before = "") {
    run_ = std::thread(
        [=] { said_ = run(arguments + " >" + path("out.txt") + " 2>&1", "timeout -s KILL 30 " + before); });
  }
  /// The socket that the run names; empty: none in ten seconds.
  std::string socket() {
    std::string found;
    wait_until(
        [&] {
          const std::string text = read(path("out.txt")), key = "TWINPUCK_CONTROLLER=unix:";
          const std::size_t at = text.find(key), end = text.find('\n', at);
          if (at != std::string::npos && end != std::string::npos)
            found = text.substr(at + key.size(), end - at - key.size());
          return !found.empty();
        },
        10);
    return found;
  }
  /// A program of ours, as somebody at another terminal starts it; what it prints.
  std::string connect(const std::string& socket, const std::string& arguments = "") const {
    const std::string line = "cd '" + folder.string() + "' && env '" + mark +
                             "' PYTHONPATH=" TWINPUCK_SOURCE_DIR
                             "/programs/controller/python TWINPUCK_LIBCONTROLLER=" TWINPUCK_BUILD_DIR
                             "/libcontroller.so"
                             " TWINPUCK_CONTROLLER=unix:" +
                             socket + " timeout -s KILL 20 python3 outside.py " + arguments + " 2>&1";
    const Said said = shell::run(line);
    return said.text + "status " + std::to_string(said.exit_code);
  }
  const Said& end() {
    run_.join();
    said_.text = read(path("out.txt"));
    return said_;
  }
  void SetUp() override { write("outside.py", kProgram); }
  void TearDown() override {
    if (run_.joinable()) run_.join();
  }

  std::thread run_;
  Said said_;
};

TEST_F(Extern, a_robots_program_is_started_outside_and_connects) {
  const std::string good = program("good", "c",
                                   "#include <webots/robot.h>\nint main(void) { wb_robot_init(); while "
                                   "(wb_robot_step(64) != -1) ; return 0; }\n");
  // named by the world, and by the command line in the place of what the world says
  struct Case {
    const char* firmware;
    const char* options;
  };
  for (const Case& c : {Case{"<extern>", ""}, Case{"", "--extern puck"}, Case{"", "--extern '*'"}}) {
    fs::remove(path("out.txt"));
    world({{"puck", *c.firmware ? c.firmware : good}});
    begin(std::string("--for 2 ") + c.options);
    const std::string at = socket();
    ASSERT_FALSE(at.empty()) << read(path("out.txt"));
    // only this user may come in
    struct stat folder_is {};
    ASSERT_EQ(stat(fs::path(at).parent_path().c_str(), &folder_is), 0);
    EXPECT_EQ(folder_is.st_mode & 0777, 0700u);
    EXPECT_EQ(folder_is.st_uid, getuid());
    EXPECT_EQ(connect(at), "steps 31 puck\nstatus 0") << c.options;
    EXPECT_EQ(end().exit_code, 0) << said_.text;
    EXPECT_TRUE(
        reads(said_.text,
              "puck: <extern>\npuck: waits for its program: TWINPUCK_CONTROLLER=unix:…\n@/w.toml: 2.0 s "
              "simulated in … s (… times real time), seed 1, digest …\nrobot           x (m)    y (m)   "
              "heading  path (m)  collisions  wall (s)   load     used      left\npuck            0.000    "
              "0.000     0 deg     0.000           0      0.00     0%    0 mWh   … min"));
    EXPECT_FALSE(fs::exists(at)) << "the socket is gone";
    expect_nothing_left(c.options);
  }
}

TEST_F(Extern, the_world_waits_for_who_comes_late) {
  world({{"puck", "<extern>"}});
  begin("--for 1 --record " + path("r.csv"));
  const std::string at = socket();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  EXPECT_EQ(read(path("out.txt")).find("simulated in"), std::string::npos) << "the run did not wait";
  EXPECT_EQ(connect(at), "steps 15 puck\nstatus 0");
  EXPECT_EQ(end().exit_code, 0) << said_.text;
}

TEST_F(Extern, a_program_that_never_comes_ends_with_the_hosts_limit) {
  world({{"puck", "<extern>"},
         {"b",
          program("b", "py", "from controller import Robot\nr = Robot()\nwhile r.step(64) != -1: pass\n")}});
  begin("--for 1 --host-limit 1 --record " + path("r.csv"));
  const std::string at = socket();
  EXPECT_EQ(end().exit_code, 124) << said_.text;
  EXPECT_TRUE(
      reads(said_.text,
            "puck: <extern>\nb: @/b\npuck: waits for its program: TWINPUCK_CONTROLLER=unix:…\npuck: its "
            "program has not called wb_robot_init() for … s (t=0.000 s); it was ended\n@/w.toml: 0.0 s "
            "simulated in … s (… times real time), seed 1, digest …\nrobot           x (m)    y (m)   "
            "heading  path (m)  collisions  wall (s)   load     used      left\npuck            0.000    "
            "0.000     0 deg     0.000           0      0.00     0%    0 mWh         -\nb               "
            "0.000    1.000     0 deg     0.000           0      0.00     0%    0 mWh         -\nwritten: "
            "@/r.csv\ntwinpuck: host time: got … s, expected at most 1 s; outputs hold what was simulated"));
  EXPECT_FALSE(fs::exists(at));
  expect_whole(path("r.csv"), -1, "never");
  expect_nothing_left("never");
}

TEST_F(Extern, a_program_that_ends_lets_the_run_go_on) {
  world({{"puck", "<extern>"}});
  begin("--for 3 --record " + path("r.csv"));
  EXPECT_EQ(connect(socket(), "5"), "steps 5 puck\nstatus 0");
  EXPECT_EQ(end().exit_code, 0) << said_.text;
  expect_whole(path("r.csv"), 2.9, "ends");
}

constexpr const char* kNobody =
    ": got nobody who waits there (No such file or directory), expected a simulation; start one first: "
    "twinpuck run "
    "WORLD --extern ROBOT\nstatus 1";

TEST_F(Extern, who_connects_to_nobody_is_told) {
  world({{"puck", "<extern>"}});
  const std::string text = connect(path("nobody.sock"));
  EXPECT_TRUE(reads(text, "libcontroller: @/nobody.sock" + std::string(kNobody)));
}

TEST_F(Extern, a_second_program_finds_the_place_taken) {
  world({{"puck", "<extern>"}});
  begin("--for 20000");
  const std::string at = socket();
  std::string first;
  std::thread one([&] { first = connect(at, "20"); });
  ASSERT_TRUE(wait_until([&] { return !fs::exists(at); }, 10)) << "nobody was let in";
  const std::string second = connect(at);
  EXPECT_TRUE(reads(second, "libcontroller: …" + std::string(kNobody)));
  one.join();
  EXPECT_EQ(first, "steps 20 puck\nstatus 0");
  for (const pid_t pid : processes_with(mark)) kill(pid, SIGINT);
  end();
}

}  // namespace
