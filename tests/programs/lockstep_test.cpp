// SPDX-License-Identifier: MIT
// Programs in lock-step with the world: the outcome depends on nobody's speed; beginnings, resets and ends.
#include <atomic>
#include <thread>

#include "tests/programs/process_watch.h"
#include "tests/programs/program_fixture.h"

namespace {

using programs_test::ProgramTest;
using programs_test::Robot;
namespace fs = std::filesystem;

class Lockstep : public ProgramTest {
 protected:
  static std::string text_of(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// A folder of a test's own, empty.
  static fs::path fresh(const std::string& name) {
    const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "lockstep" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }
};

// avoids what it sees and tells the others; argv[1]: microseconds that it sleeps in each step
const char* const kAvoidGlobals =
    "WbDeviceTag left, right, ps0, ps7, e, r; int heard, sleeps;\n#include <unistd.h>\n";
const char* const kAvoidBefore =
    "sleeps = argc > 1 ? atoi(argv[1]) : 0; left = wb_robot_get_device(\"left wheel motor\"); right = "
    "wb_robot_get_device(\"right wheel motor\");\n"
    "ps0 = wb_robot_get_device(\"ps0\"); ps7 = wb_robot_get_device(\"ps7\"); e = "
    "wb_robot_get_device(\"emitter\"); r = wb_robot_get_device(\"receiver\");\n"
    "wb_distance_sensor_enable(ps0, 32); wb_distance_sensor_enable(ps7, 32); wb_receiver_enable(r, 32);\n"
    "wb_motor_set_position(left, INFINITY); wb_motor_set_position(right, INFINITY); srand(time(NULL));";
const char* const kAvoidLoop =
    "double a = wb_distance_sensor_get_value(ps7), b = wb_distance_sensor_get_value(ps0);\n"
    "while (wb_receiver_get_queue_length(r) > 0) { heard = heard * 31 + *(const char "
    "*)wb_receiver_get_data(r); wb_receiver_next_packet(r); }\n"
    "wb_motor_set_velocity(left, 4 + a / 200 - b / 200 + rand() % 100 / 100.0); wb_motor_set_velocity(right, "
    "4 - a / 200 + b / 200 + heard % 3);\n"
    "wb_emitter_send(e, wb_robot_get_name(), 2); if (sleeps) usleep(sleeps);";

struct Outcome {
  std::uint64_t digest;
  std::vector<double> where;
  bool operator==(const Outcome& o) const { return digest == o.digest && where == o.where; }
};

Outcome crowd(int threads, const std::vector<int>& sleeps = {0, 0, 0, 0}, double seconds = 1.5) {
  struct Run : ProgramTest {
    void TestBody() override {}
    Outcome go(int its_threads, const std::vector<int>& its_sleeps, double its_seconds) {
      options.threads = its_threads;
      arena(0.8, 0.8);
      for (std::size_t i = 0; i < its_sleeps.size(); ++i) {
        Robot& r =
            add_c(kAvoidGlobals, kAvoidBefore, kAvoidLoop, 32, std::string(1, static_cast<char>('a' + i)));
        r.at(0.2 * (i % 2 ? 1 : -1), 0.2 * (i / 2 ? 1 : -1), 45.0 * static_cast<double>(i));
        r.settings().args = std::to_string(its_sleeps[i]);
      }
      run_for(its_seconds);
      Outcome o{digest(), {}};
      for (std::size_t i = 0; i < its_sleeps.size(); ++i) {
        const Robot& r = robot(static_cast<int>(i));
        o.where.insert(o.where.end(), {r.x_m(), r.y_m(), r.heading_deg()});
      }
      return o;
    }
  } run;
  return run.go(threads, sleeps, seconds);
}

TEST_F(Lockstep, the_outcome_is_one_over_twenty_runs_threads_and_load) {
  const Outcome first = crowd(1);
  EXPECT_GT(std::hypot(first.where[0] + 0.2, first.where[1] + 0.2), 0.01) << "it drives";
  for (int n = 0; n < 12; ++n) EXPECT_EQ(crowd(1).digest, first.digest) << n;
  for (const int threads : {2, 4})
    for (int n = 0; n < 2; ++n) EXPECT_TRUE(crowd(threads) == first) << threads << " threads";
  std::atomic<bool> is_over{false};
  std::vector<std::thread> load;
  for (int i = 0; i < 3; ++i)
    load.emplace_back([&] {
      while (!is_over) continue;
    });
  for (int n = 0; n < 4; ++n) EXPECT_TRUE(crowd(1 + n % 2) == first) << "under load " << n;
  is_over = true;
  for (std::thread& t : load) t.join();
}

TEST_F(Lockstep, robots_have_their_turns_in_order_whoever_is_faster) {
  const Outcome first = crowd(1, {0, 0, 0}, 0.5);
  EXPECT_TRUE(crowd(1, {4000, 0, 0}, 0.5) == first) << "the first is the slowest";
  EXPECT_TRUE(crowd(1, {0, 2000, 4000}, 0.5) == first) << "the last is the slowest";
  EXPECT_TRUE(crowd(2, {3000, 100, 2000}, 0.5) == first);
}

// what is sent in one instant arrives in the order of the robots
TEST_F(Lockstep, packets_of_one_instant_arrive_in_the_order_of_the_robots) {
  const char* const send =
      "if (steps == 3) { usleep(atoi(argv[1])); wb_emitter_send(wb_robot_get_device(\"emitter\"), "
      "wb_robot_get_name(), 2); }";
  add_c("#include <unistd.h>\n", "", send, 32, "a").at(0.5, 0.1).settings().args = "20000";
  add_c("#include <unistd.h>\n", "", send, 32, "b").at(0.5, -0.1).settings().args = "0";
  Robot& hears = add_c("WbDeviceTag r;", "r = wb_robot_get_device(\"receiver\"); wb_receiver_enable(r, 32);",
                       "while (wb_receiver_get_queue_length(r) > 0) { printf(\"%s\\n\", (const char "
                       "*)wb_receiver_get_data(r)); wb_receiver_next_packet(r); }",
                       32, "c");
  run_for(0.3);
  EXPECT_EQ(hears.console(), (std::vector<std::string>{"a", "b"}));
}

// each step of a program ends when all four have begun theirs; the world waits for them
TEST_F(Lockstep, programs_compute_side_by_side) {
  const std::string begun = fresh("side_by_side") / "";
  const std::string meet =
      "char name[300]; snprintf(name, 300, \"" + begun +
      "%d %s\", steps, wb_robot_get_name()); "
      "fclose(fopen(name, \"w\"));\n"
      "for (int other = 0, waits = 0; other < 4 && waits < 6000; ) { snprintf(name, 300, \"" +
      begun +
      "%d %c\", steps, 'a' + other); if (access(name, F_OK) == 0) other++; else usleep(10000), waits++; "
      "if (waits == 6000) printf(\"alone\\n\"); }";
  for (int i = 0; i < 4; ++i)
    add_c("#include <unistd.h>\n", "", meet, 32, std::string(1, static_cast<char>('a' + i))).at(0.2 * i, 0);
  run_for(0.16);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(robot(i).console(), std::vector<std::string>{}) << i;
  EXPECT_TRUE(fs::exists(begun + "4 d"));
}

TEST_F(Lockstep, two_hundred_robots_have_their_steps) {
  for (int i = 0; i < 200; ++i)
    add_c("", "wb_differential_wheels_set_speed(100, 100);", "", 64).at(0.15 * (i % 20), 0.15 * (i / 20));
  run_for(0.5);
  for (int i = 0; i < 200; ++i) EXPECT_NEAR(robot(i).left_steps(), 50, 2) << i;
  expect_no_traps();
}

TEST_F(Lockstep, a_world_may_have_a_supervisor_and_no_robot) {
  sim::ObjectDesc box;
  box.name = "box";
  box.pose = {0.1, 0.2, 0};
  world.objects.push_back(box);
  add_supervisor_in_c(
      "",
      "printf(\"box %g\\n\", wb_supervisor_node_get_position(wb_supervisor_node_get_from_def(\"box\"))[1]);",
      "if (steps == 10) wb_supervisor_simulation_quit(0);");
  listen();
  run_for(2);
  EXPECT_TRUE(finish().ended);
  EXPECT_NEAR(now_s(), 0.64, 0.003);
  EXPECT_EQ(said.at(0), "supervisor0: box 0.2");
}

// --- beginnings

const char* const kTracer = "WbDeviceTag gps, ps;";
const char* const kTracerOn =
    "printf(\"begins %g\\n\", wb_robot_get_time()); gps = wb_robot_get_device(\"gps\"); wb_gps_enable(gps, "
    "64); ps = wb_robot_get_device(\"ps0\");\n"
    "wb_distance_sensor_enable(ps, 64); srand(time(NULL)); wb_differential_wheels_set_speed(400 + rand() % "
    "100, 300);";
const char* const kTracerLoop =
    "printf(\"%d %.12g %.12g %g\\n\", steps, wb_gps_get_values(gps)[0], wb_gps_get_values(gps)[1], "
    "wb_distance_sensor_get_value(ps));";

TEST_F(Lockstep, a_reset_of_the_simulation_is_a_fresh_start) {
  for (const char* call : {"wb_supervisor_simulation_reset();", "wb_supervisor_simulation_revert();"}) {
    struct Run : ProgramTest {
      void TestBody() override {}
      std::vector<std::string> go(const std::string& its_call) {
        world.wheels.noise = 0.02;
        wall(0.3, -0.5, 0.3, 0.5);
        Robot& r = add_c(kTracer, kTracerOn, kTracerLoop);
        sim::DeviceDesc gps;
        gps.name = "gps";
        r.settings().devices.push_back(gps);
        add_supervisor_in_c("", "", "if (steps == 10) { static int once; if (!once++) " + its_call + " }",
                            64);
        run_for(1.24);
        return r.console();
      }
    } run;
    const auto lines = run.go(call);
    // "begins 0" and nine or ten steps, twice
    const std::size_t second =
        static_cast<std::size_t>(std::find(lines.begin() + 1, lines.end(), "begins 0") - lines.begin());
    ASSERT_LT(second, lines.size()) << call << ": the program did not begin again";
    ASSERT_GE(second, 9u) << call;
    ASSERT_GE(lines.size(), second + 7) << call;
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(lines[i], lines[second + i]) << call << " " << i;
  }
}

// the first robot's too, whose number is 0
TEST_F(Lockstep, a_reset_gives_custom_data_back) {
  for (const char* name : {"a", "b"}) {
    Robot& r =
        add_c("", "printf(\"has %s\\n\", wb_robot_get_custom_data()); wb_robot_set_custom_data(\"mine\");",
              "if (steps == 2) printf(\"then %s\\n\", wb_robot_get_custom_data());", 64, name);
    r.at(name[0] == 'a' ? 0 : 0.3, 0);
    r.settings().custom_data = std::string("given to ") + name;
  }
  add_supervisor_in_c("", "", "static int once; if (steps == 5 && !once++) wb_supervisor_simulation_reset();",
                      64);
  run_for(0.9);
  for (int i = 0; i < 2; ++i) {
    const std::string has = std::string("has given to ") + (i == 0 ? "a" : "b");
    EXPECT_EQ(robot(i).console(), (std::vector<std::string>{has, "then mine", has, "then mine"})) << i;
  }
}

TEST_F(Lockstep, a_supervisor_starts_one_robots_program_anew) {
  for (const char* name : {"a", "b"})
    add_c("", "printf(\"begins %g\\n\", wb_robot_get_time());", "", 64, name).at(name[0] == 'a' ? 0 : 0.3, 0);
  add_supervisor_in_c(
      "", "",
      "if (steps == 5) wb_supervisor_node_restart_controller(wb_supervisor_node_get_from_def(\"b\"));");
  run_for(0.5);
  EXPECT_EQ(robot(0).console(), (std::vector<std::string>{"begins 0"}));
  EXPECT_EQ(robot(1).console(), (std::vector<std::string>{"begins 0", "begins 0.32"}));  // time goes on
}

TEST_F(Lockstep, a_robot_may_supervise_when_the_world_says_so) {
  const char* const before =
      "WbNodeRef me = wb_supervisor_node_get_self(); printf(\"right %d %d\\n\", wb_robot_get_supervisor(), "
      "me != NULL);\n"
      "if (me) { const double to[3] = {0.4, 0.3, 0}; "
      "wb_supervisor_field_set_sf_vec3f(wb_supervisor_node_get_field(me, \"translation\"), to); }";
  Robot& may = add_c("", before, "", 64, "may");
  Robot& may_not = add_c("", before, "", 64, "may_not").at(1, 1);
  may.settings().supervisor = true;
  run_for(0.2);
  EXPECT_EQ(told(may, "right"), (std::vector<double>{1, 1}));
  EXPECT_EQ(told(may_not, "right"), (std::vector<double>{0, 0}));
  EXPECT_NEAR(may.x_m(), 0.4, 1e-6);
  EXPECT_NEAR(may.y_m(), 0.3, 1e-6);
  EXPECT_EQ(may_not.x_m(), 1);
}

// --- ends

TEST_F(Lockstep, a_supervisor_ends_the_run_with_its_status) {
  for (const int status : {0, 1, 7}) {
    struct Run : ProgramTest {
      void TestBody() override {}
      void go(int its_status) {
        add_c("", "", "");
        add_supervisor_in_c(
            "", "", "if (steps == 5) wb_supervisor_simulation_quit(" + std::to_string(its_status) + ");");
        run_for(2);
        EXPECT_NEAR(now_s(), 0.32, 0.003) << its_status;
        EXPECT_TRUE(finish().ended);
        EXPECT_FALSE(finish().crashed);
        EXPECT_EQ(finish().code, its_status == 0 ? 0 : 1) << its_status;
      }
    } run;
    run.go(status);
  }
}

TEST_F(Lockstep, labels_and_pictures) {
  add_c("", "", "");
  add_supervisor_in_c(
      "", "",
      "if (steps == 1) { wb_supervisor_set_label(0, \"2 : 1\", 0.4, 0.01, 0.1, 0x202020, 0, \"Arial\");\n"
      "wb_supervisor_set_label(1, \"gone\", 0, 0, 0.1, 0, 0, \"Arial\"); "
      "wb_supervisor_export_image(\"moment.svg\", 100); }\n"
      "if (steps == 2) wb_supervisor_set_label(1, \"\", 0, 0, 0.1, 0, 0, \"Arial\");");
  // a name without a path is of the program's folder
  const fs::path picture = fs::path(world.supervisors.back().program) / "moment.svg";
  fs::remove(picture);
  listen();
  run_for(0.3);
  EXPECT_NE(text_of(picture).find("<svg"), std::string::npos);
  ASSERT_EQ(team().labels().size(), 1u);
  EXPECT_EQ(team().labels()[0].text, "2 : 1");
}

// the loop ends with -1, the program writes its file and is waited for; who goes on stepping ends there
TEST_F(Lockstep, the_end_is_told_once_and_files_can_be_written_then) {
  const fs::path folder = fresh("end");
  const std::string file = (folder / "out.txt").string();
  Robot& r = add_c("#include <unistd.h>\n", "", "");
  (void)r;
  Robot& writes = add_source(programs_test::kHeaders + std::string("#include <unistd.h>\n") +
                             "int main() { int n = 0; FILE *out; wb_robot_init(); WbDeviceTag enc = "
                             "wb_robot_get_device(\"left wheel sensor\");\n"
                             "wb_position_sensor_enable(enc, 64); while (wb_robot_step(64) != -1) n++;\n"
                             "usleep(100000); out = fopen(\"" +
                             file +
                             "\", \"w\");\n"
                             "fprintf(out, \"%d steps, %g\\n\", n, wb_position_sensor_get_value(enc)); "
                             "fclose(out); wb_robot_cleanup(); return 0; }\n");
  Robot& goes_on =
      add_source(programs_test::kHeaders +
                 std::string("int main() { int ends = 0; wb_robot_init(); for (;;) if (wb_robot_step(64) == "
                             "-1) { ends++; printf(\"ends %d\\n\", ends); fflush(stdout); } }\n"));
  writes.at(0.3, 0);
  goes_on.at(0.6, 0);
  run_for(1);
  EXPECT_FALSE(fs::exists(file));
  finish();
  EXPECT_EQ(text_of(file), "15 steps, 0\n");
  EXPECT_EQ(goes_on.console(), (std::vector<std::string>{"ends 1"}));
  expect_no_traps();
}

TEST_F(Lockstep, a_program_in_python_can_write_after_the_end) {
  const fs::path folder = fresh("end_py");
  add_source(
      "from controller import Robot\nrobot = Robot()\nn = 0\nwhile robot.step(100) != -1:\n    n += 1\n"
      "open('" +
          (folder / "out.txt").string() + "', 'w').write(str(n))\n",
      "py");
  run_for(1.05);
  finish();
  EXPECT_EQ(text_of(folder / "out.txt"), "10");
}

TEST_F(Lockstep, a_supervisors_run_may_be_ended_by_another_and_both_are_told) {
  const fs::path folder = fresh("two");
  add_c("", "", "");
  add_supervisor_in_c("", "", "if (steps == 3) wb_supervisor_simulation_quit(0);");
  add_supervisor(programs_test::program_folder(
      programs_test::kHeaders +
          std::string(
              "int main() { FILE *out; wb_robot_init(); while (wb_robot_step(64) != -1) ; out = fopen(\"") +
          (folder / "told.txt").string() + "\", \"w\"); fputs(\"told\", out); fclose(out); return 0; }\n",
      "c"));
  run_for(1);
  finish();
  EXPECT_EQ(text_of(folder / "told.txt"), "told");
}

// --- text

TEST_F(Lockstep, lines_come_in_order_at_the_time_that_they_are_printed) {
  Robot& r = add_c("", "printf(\"at first\\n\"); fprintf(stderr, \"an error\\n\");",
                   "printf(\"half \"); printf(\"a line %d\\n\", steps); if (steps == 2) { "
                   "printf(\"\\fcleared\\r\\n\"); printf(\"rest\"); fflush(stdout); }",
                   100);
  run_for(0.05);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"at first", "an error"}));
  run_for(0.1);
  EXPECT_EQ(r.console().size(), 3u);
  EXPECT_EQ(r.console().back(), "half a line 1");
  run_for(0.1);
  EXPECT_EQ(r.console().back(), "cleared") << "a line that is not over waits";
  run_for(0.1);
  EXPECT_EQ(r.console().back(), "resthalf a line 3");
}

TEST_F(Lockstep, lines_of_supervisors_bear_their_name) {
  add_c("", "", "");
  add_supervisor_in_c("", "printf(\"one\\ntwo\\n\");", "");
  listen();
  run_for(0.1);
  EXPECT_EQ(said, (std::vector<std::string>{"supervisor0: one", "supervisor0: two"}));
}

}  // namespace
