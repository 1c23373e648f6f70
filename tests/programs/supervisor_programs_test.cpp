// SPDX-License-Identifier: MIT
// Supervisors as programs: the digest sees what they do, how they begin and end, chance, the interface of
// 2005, Python, the command line.
#include "programs/team/names.h"
#include "sim_core/light/proximity.h"
#include "tests/programs/supervisor_fixture.h"
#include "tests/support/wording.h"

namespace {

using namespace programs_test;

class SupervisorPrograms : public SupervisorTest {};

// --- the digest

std::uint64_t digest_with(const std::string& deed, int threads) {
  struct Run : SupervisorPrograms {
    void TestBody() override {}
    std::uint64_t go(const std::string& its_deed, int its_threads) {
      options.threads = its_threads;
      sim::LampDesc lamp;
      lamp.name = "sun";
      world.lamps.push_back(lamp);
      sim::ObjectDesc box;
      box.name = "box";
      box.pose = {2, 2, 0};
      world.objects.push_back(box);
      for (int i = 0; i < 2; ++i)
        add_robot_with_source("volatile int x; int main(void) { while (1) ; }", "r" + std::to_string(i))
            .at(0.2 * i, 0);
      add_judge(
          "const double green[3] = {0, 1, 0}, to[3] = {0.4, 0.4, 0}; (void)green, (void)to; "
          "wb_robot_step(50);\n" +
          its_deed + "\nwb_robot_step(50);");
      listen();
      run_for(0.2);
      finish();
      return digest();
    }
  } run;
  return run.go(deed, threads);
}

TEST_F(SupervisorPrograms, digests_see_what_supervisors_do_and_repeat) {
  const std::uint64_t nothing = digest_with("", 1);
  EXPECT_EQ(nothing, digest_with("", 2));
  for (const char* deed : {"wb_supervisor_field_set_sf_color(field(\"box\", \"diffuseColor\"), green);",
                           "wb_supervisor_field_set_sf_bool(field(\"sun\", \"on\"), 0);",
                           "set(\"r0\", \"proximityNoise\", 3);", "set(\"r0\", \"wheelNoise\", 0.1);",
                           "set(\"r1\", \"variable:x\", 1);", "set(\"r0\", \"sensor:s\", 1);",
                           "wb_supervisor_field_set_sf_vec3f(field(\"r1\", \"translation\"), to);"}) {
    const std::uint64_t once = digest_with(deed, 1);
    EXPECT_NE(once, nothing) << deed;
    EXPECT_EQ(once, digest_with(deed, 2)) << deed;
  }
}

// --- beginnings and ends

// words come from the world file, files from the program's folder, to which the run does not belong; two
// files of one program share a variable that neither initialises, as programs of 2005 do
TEST_F(SupervisorPrograms, programs_work_in_their_own_folder_and_get_their_words) {
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "supervisor_folder";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::ofstream(folder / "places.txt") << "12\n";
  std::ofstream(folder / "common.c") << "int shared; void set_shared(void) { shared = 5; }\n";
  std::ofstream(folder / "supervisor_folder.c") << kHeaders << kTools << R"(
    int shared;
    void set_shared(void);
    int main(int argc, char **argv) {
      int place = 0;
      FILE *in = fopen("places.txt", "r");
      wb_robot_init();
      EXPECT(in && fscanf(in, "%d", &place) == 1 && place == 12);
      EXPECT(argc == 4 && !strcmp(argv[1], "fast") && !strcmp(argv[2], "3") && !strcmp(argv[3], "two words") && argv[4] == NULL);
      set_shared();
      EXPECT(shared == 5);
      in = fopen("written.txt", "w");
      EXPECT(in && fclose(in) == 0);
      ends(0);
      return 0;
    })";
  add_robot_with_source(kIdle);
  add_supervisor(folder.string());
  world.supervisors.back().args = "fast  3 \"two words\"";
  const fs::path before = fs::current_path();
  expect_pass();
  EXPECT_EQ(fs::current_path(), before);
  EXPECT_TRUE(fs::exists(folder / "written.txt"));
}

TEST_F(SupervisorPrograms, two_of_one_program_are_two_processes) {
  add_robot_with_source(kIdle);
  for (int i = 0; i < 2; ++i)
    add_supervisor_in_c("", "", "if (steps == 3) printf(\"rounds %d\\n\", steps);", 250);
  listen();
  run_for(1);
  EXPECT_EQ(said, (std::vector<std::string>{"supervisor0: rounds 3", "supervisor1: rounds 3"}));
}

TEST_F(SupervisorPrograms, chance_follows_the_seed_and_differs_between_supervisors) {
  const auto draw = [](std::uint64_t seed) {
    struct Run : SupervisorPrograms {
      void TestBody() override {}
      std::vector<std::string> go(std::uint64_t its_seed) {
        world.seed = its_seed;
        add_robot_with_source(kIdle);
        for (int i = 0; i < 2; ++i)
          add_supervisor_in_c("", "srand(time(NULL)); printf(\"%d %d\\n\", rand(), rand());", "");
        listen();
        run_for(0.01);
        return said;
      }
    } run;
    return run.go(seed);
  };
  const auto a = draw(1), b = draw(1), c = draw(2);
  ASSERT_EQ(a.size(), 2u);
  EXPECT_EQ(a, b);
  EXPECT_NE(a[0], c[0]);
  EXPECT_NE(a[0].substr(a[0].find(": ")), a[1].substr(a[1].find(": ")));
}

TEST_F(SupervisorPrograms, a_program_that_does_not_compile_or_link_is_bad_input) {
  struct Case {
    const char* source;
    const char* says;
  };
  for (const Case& c : {Case{"#include <webots/robot.h>\nint main(void) { return wb_robot_stepp; }\n",
                             ": controller: does not compile:\n….c: In function 'main':\n….c:2:25: error: "
                             "'wb_robot_stepp' undeclared (first use in "
                             "this function); did you mean 'wb_robot_step'?\n"
                             "    2 | int main(void) { return wb_robot_stepp; }\n"
                             "      |                         ^~~~~~~~~~~~~~\n"
                             "      |                         wb_robot_step\n"
                             "….c:2:25: note: each undeclared identifier is reported only once for each "
                             "function it appears in"},
                        Case{"#include <webots/robot.h>\nvoid wb_fly(int);\nint main(void) { "
                             "wb_robot_init(); wb_fly(1); return 0; }\n",
                             ": controller: does not compile:\n/usr/bin/ld: …: in function `main':\n"
                             "….c:3: undefined reference to `wb_fly'"}}) {
    struct Run : SupervisorPrograms {
      void TestBody() override {}
      std::string go(const char* source) {
        add_robot_with_source(kIdle);
        add_supervisor(program_folder(source, "c"));
        try {
          run_for(0.1);
        } catch (const std::runtime_error& e) {
          return e.what();
        }
        return "it started";
      }
    } run;
    const std::string said = run.go(c.source);
    EXPECT_TRUE(wording::reads(
        said, std::string("…: the test's world cannot start:\nsupervisor 'supervisor0': …") + c.says));
  }
}

TEST_F(SupervisorPrograms, one_that_ends_by_itself_lets_the_world_go_on) {
  add_robot_with_source(kIdle);
  add_supervisor(program_folder(
      kHeaders + std::string("int main() { wb_robot_init(); wb_robot_step(100); exit(0); }\n"), "c"));
  run_for(0.5);
  EXPECT_NEAR(now_s(), 0.5, 0.002);
  EXPECT_FALSE(finish().ended);
  EXPECT_EQ(finish().code, 0);
}

struct Crash {
  const char* name;
  const char* body;
  const char* says;
};
class Crashes : public SupervisorPrograms, public ::testing::WithParamInterface<Crash> {};

TEST_P(Crashes, end_the_run_with_a_message) {
  add_robot_with_source(kIdle);
  add_supervisor(program_folder(
      std::string(
          "#include <webots/robot.h>\n#include <cstdlib>\n#include <stdexcept>\n"
          "volatile int* nowhere;\nvolatile int zero;\n"
          "int deep(volatile int n) { volatile char a[1000]; a[n % 1000] = 1; return deep(n + 1) + a[0]; }\n"
          "int main() {\n  wb_robot_init();\n  wb_robot_step(250);\n") +
          GetParam().body + "\n  return 0;\n}\n",
      "cpp"));
  listen();
  run_for(1);
  EXPECT_NEAR(now_s(), 0.25, 0.002);
  const programs::Outcome& outcome = finish();
  EXPECT_TRUE(outcome.ended);
  EXPECT_TRUE(outcome.crashed);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(wording::reads(
      outcome.text,
      std::string("supervisor 'supervisor0', t=0.250000 s: its program ended ") + GetParam().says));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Crashes,
    ::testing::Values(
        Crash{"null", "*nowhere = 1;", "by signal 11 (Segmentation fault) at main (….cpp:10)"},
        Crash{"division", "return 7 / zero;", "by signal 8 (Floating point exception) at main (….cpp:10)"},
        Crash{"abort", "abort();", "by signal 6 (Aborted) at main (….cpp:10)"},
        Crash{"exception", "throw std::runtime_error(\"no ball\");",
              "by signal 6 (Aborted) at main (….cpp:10)"},
        Crash{"recursion", "return deep(1);", "by signal 11 (Segmentation fault) at deep(int) (….cpp:6)"},
        Crash{"status", "exit(7);", "with exit status 7"}),
    [](const auto& info) { return std::string(info.param.name); });

// --- the interface of 2005

TEST_F(SupervisorPrograms, the_interface_of_2005) {
  world.webots.axes = sim::Axes::Nue;
  add_ball();
  add_robot_with_source(kIdle, "puck").at(0.1, 0.2, 90).settings().def = "PUCK";
  add_supervisor(program_folder(R"(
    #include <math.h>
    #include <stdio.h>
    #include <stdlib.h>
    #include <device/robot.h>
    #include <device/supervisor.h>
    #define EXPECT(what) do { if (!(what)) { robot_console_printf("line %d: %s\n", __LINE__, #what); exit(1); } } while (0)
    static NodeRef ball, puck;
    static float xz[2], where[3], all[7];
    static int calls, total;
    static void reset(void) {
      ball = supervisor_node_get_from_def("BALL");
      puck = supervisor_node_get_from_def("PUCK");
      robot_step(0);
      EXPECT(supervisor_node_was_found(ball) && !supervisor_node_was_found(supervisor_node_get_from_def("X")));
      supervisor_field_get(ball, SUPERVISOR_FIELD_TRANSLATION, where, 128);
      supervisor_field_get(puck, SUPERVISOR_FIELD_TRANSLATION_AND_ROTATION, all, 64);
      EXPECT(where[0] == 0.3f && where[2] == -0.4f && fabs(all[4] - 1) < 1e-6);
      xz[0] = 0;
      xz[1] = 0.1f;
    }
    static int run(int ms) {
      total += ms;
      if (++calls == 1) {
        EXPECT(ms == 0);
        supervisor_field_set(ball, SUPERVISOR_FIELD_TRANSLATION_X | SUPERVISOR_FIELD_TRANSLATION_Z, xz);
        supervisor_set_label(0, "0 - 0", 0.4, 0.01, 0.1, 0xff0000);
        EXPECT(where[0] == 0.3f); /* the buffer is older */
      } else if (calls == 2) {
        EXPECT(ms == 64 && where[0] == 0.3f);
      } else if (calls == 3) {
        EXPECT(ms == 64 && fabs(where[0]) < 1e-6 && fabs(where[2] - 0.1f) < 1e-6 && fabs(where[1] - 0.02) < 1e-4);
        supervisor_field_get(ball, SUPERVISOR_FIELD_TRANSLATION, where, 0);
        const float up[3] = {0, 0.1f, 0};
        supervisor_field_set(ball, SUPERVISOR_FIELD_TRANSLATION, up);
      } else if (calls == 5) {
        EXPECT(fabs(where[2] - 0.1f) < 1e-6); /* no longer refreshed */
        EXPECT(total == 256);
        robot_console_printf("goal %d\n", 1);
        supervisor_simulation_quit();
      }
      return 64;
    }
    int main() {
      robot_live(reset);
      robot_run(run);
      return 0;
    })",
                                "c"));
  expect_pass();
  EXPECT_EQ(team().labels().at(0).text, "0 - 0");
  EXPECT_TRUE(was_said("goal 1"));
  EXPECT_NEAR(now_s(), 0.256, 0.003);
  // it fell for 0.128 s from where its middle was 0.1 m high: 0.08 m - 9.81 / 2 * 0.128^2 < 0,
  // so it lies or bounced
  EXPECT_LT(twin().simulation().state(1).z_m, 0.001);
}

TEST_F(SupervisorPrograms, python_supervises_as_c_does) {
  add_ball();
  add_robot_with_source("volatile int count = -3; int main(void) { while (1) ; }", "alice").at(0.1, 0.2);
  add_supervisor(program_folder(R"(
from controller import Supervisor

s = Supervisor()
s.step(64)
ball = s.getFromDef("BALL")
alice = s.getFromDef("alice")
print("ball", *(round(x, 9) for x in ball.getPosition()))
print("count", alice.getField("variable:count").getSFFloat())
alice.getField("translation").setSFVec3f([0.4, -0.1, 0])
s.step(64)
s.simulationQuit(0)
)",
                                "py"));
  expect_pass();
  EXPECT_TRUE(was_said("ball 0.3 0.4 0.02"));
  EXPECT_TRUE(was_said("count -3"));
  EXPECT_NEAR(robot(0).x_m(), 0.4, 1e-9);
}

// --- the command line

TEST(SupervisorsOfTheCommandLine, take_the_place_of_the_worlds) {
  sim::WorldDesc one, two, none;
  one.supervisors.resize(1);
  one.supervisors[0].program = "soccer";
  two.supervisors.resize(2);
  two.supervisors[0].program = "referee.c";
  two.supervisors[1].name = "camera";
  two.supervisors[1].program = "camera.py";
  const auto named = [](const sim::WorldDesc& world, const std::vector<std::string>& given,
                        std::vector<std::string>& problems) {
    std::string all;
    for (const auto& s : programs::supervisors_of(world, "", given, problems))
      all += s.desc.name + "=" + s.desc.program + " ";
    return all;
  };
  std::vector<std::string> problems;
  EXPECT_EQ(named(one, {}, problems), "soccer=soccer ");
  EXPECT_EQ(named(one, {"soccer_drop"}, problems), "soccer=soccer_drop ")
      << "its only one, whatever the name";
  EXPECT_EQ(named(none, {"mine.py"}, problems), "mine=mine.py ");
  EXPECT_EQ(named(two, {"camera=mine.py"}, problems), "referee=referee.c camera=mine.py ");
  EXPECT_EQ(named(two, {"third=mine.py"}, problems), "referee=referee.c camera=camera.py third=mine.py ");
  EXPECT_TRUE(problems.empty());
  named(two, {"mine.py"}, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_TRUE(
      wording::reads(problems[0],
                     "command line: --supervisor: got 'mine.py' for a world with several (referee, camera), "
                     "expected NAME=PROGRAM: whose place it takes, or another name to add it"));
}

// --- without a program: what Simulation offers to whoever attends it

TEST_F(SupervisorPrograms, lamps_and_noise_count_from_the_next_sample_on) {
  sim::LampDesc lamp;
  lamp.position_m = {1, 0, 0.5};
  world.lamps.push_back(lamp);
  sim::ObjectDesc box;
  box.pose = {0.10, 0, 0};
  box.size_m = {0.1, 0.3, 0.02};  // lower than the sensors: the lamp shines over it
  world.objects.push_back(box);
  add_robot_with_source(kIdle);
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

// 0.5 m/s for 20 ms against friction of 0.5 g: 10 mm - 1 mm, give or take a tick; thrown up at
// 1 m/s: 20 mm - 2 mm
TEST_F(SupervisorPrograms, engines_take_the_velocities_that_they_know) {
  const auto way_after = [](sim::Engine engine, double climb_m_s) {
    struct Run : SupervisorPrograms {
      void TestBody() override {}
      sim::BodyState go(sim::Engine its_engine, double its_climb_m_s) {
        world.engine = its_engine;
        sim::ObjectDesc box;
        box.movable = true;
        box.pose = {0.5, 0, 0};
        world.objects.push_back(box);
        add_robot_with_source(kIdle);
        run_for(0.01);
        twin().simulation().set_velocity(1, {0.5, 0}, 0, its_climb_m_s);
        run_for(0.02);
        return twin().simulation().state(1);
      }
    } run;
    return run.go(engine, climb_m_s);
  };
  EXPECT_NEAR(way_after(sim::Engine::Dynamic, 0).pose.x_m, 0.509, 0.0015);
  EXPECT_NEAR(way_after(sim::Engine::Planar, 0).pose.x_m, 0.509, 0.0015);
  EXPECT_EQ(way_after(sim::Engine::Kinematic, 0).pose.x_m, 0.5);
  EXPECT_EQ(way_after(sim::Engine::Kinematic, 0).velocity_m_s.x, 0);
  EXPECT_NEAR(way_after(sim::Engine::Dynamic, 1).z_m, 0.018, 0.002);
  EXPECT_NEAR(way_after(sim::Engine::Kinematic, 1).z_m, 0.018, 0.002);
  EXPECT_EQ(way_after(sim::Engine::Planar, 1).z_m, 0);
}

}  // namespace
