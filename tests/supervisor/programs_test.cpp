// SPDX-License-Identifier: MIT
// Programs of supervisor.h: turns, time, chance, things, what a crash does, two copies of one program.
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hal_sim/host/shared_object.h"
#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace {

using firmware_test::FirmwareTest;

/// A robot that stands, and a list of what supervisors say.
class SupervisorTest : public FirmwareTest {
 protected:
  void listen() {
    team().say = [this](const std::string& line) { said.push_back(line); };
  }
  std::vector<std::string> said;
};

sim::ObjectDesc ball_at(double x_m, double y_m, double z_m) {
  sim::ObjectDesc ball;
  ball.kind = sim::ObjectKind::Ball;
  ball.name = "ball";
  ball.def = "BALL";
  ball.radius_m = 0.02;
  ball.size_m.z = 0.04;
  ball.movable = true;
  ball.pose = {x_m, y_m, 0};
  ball.z_m = z_m;
  return ball;
}

const char* const kIdle = "int main(void) { for (;;) ; }";

TEST_F(SupervisorTest, a_verdict_ends_the_run_where_it_is_spoken) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source(R"(
    #include <supervisor.h>
    int main(void) {
      while (sv_step(0.1) >= 0)
        if (sv_time() > 0.45) { sv_end(1, "%d steps", 5); break; }
      return 0;
    })",
                             "c");
  run_for(2);
  // it runs at 0, 0.1, ... and 0.5 is the first time after 0.45; ticks of 1/512 s round each step up
  EXPECT_NEAR(now_s(), 0.5, 5 * 1.0 / 512);
  EXPECT_TRUE(team().has_ended());
  EXPECT_EQ(finish().code, 1);
  EXPECT_FALSE(finish().crashed);
  EXPECT_NE(finish().text.find("failed: 5 steps"), std::string::npos) << finish().text;
}

TEST_F(SupervisorTest, the_end_of_the_run_is_told_once) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source(R"(
    #include <supervisor.h>
    int main(void) {
      int rounds = 0;
      while (sv_step(0.25) >= 0) rounds++;
      sv_log("%d rounds, step now %g", rounds, sv_step(1) < 0 ? -1.0 : 0.0);
      return 0;
    })",
                             "c");
  listen();
  run_for(1);
  EXPECT_TRUE(said.empty());
  EXPECT_FALSE(finish().ended);
  // at 0.25, 0.5, 0.75 and 1 s; the second sv_step() after the end never comes back
  EXPECT_TRUE(said.empty());
}

TEST_F(SupervisorTest, period_says_how_often_it_runs) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source(R"(
    #include <supervisor.h>
    int rounds;
    int main(void) {
      while (sv_step(0) >= 0) rounds++;
      sv_log("%d %g", rounds, sv_period());
      return 0;
    })",
                             "c", 0.125);
  listen();
  run_for(1);
  finish();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find(": 8 0.125"), std::string::npos) << said[0];  // 1 s / 0.125 s
}

TEST_F(SupervisorTest, things_are_found_moved_and_reset) {
  add_robot_with_source(kIdle, "alice").at(0.1, 0.2, 90);
  robot(0).settings().def = "FIRST";
  world.objects.push_back(ball_at(0.5, 0, 0));
  sim::ObjectDesc box;
  box.name = "box";
  box.pose = {-1, -1, 0};
  world.objects.push_back(box);
  add_supervisor_with_source(R"(
    #include <supervisor.hpp>
    #include <cmath>
    void expect(bool good, const char* what) { if (!good) sv::fail(what); }
    int main() {
      expect(sv_robots() == 1 && sv_things() == 3, "counts");
      sv::Robot alice("FIRST");
      expect(sv_find("alice") == 0 && sv_find("BALL") == 1 && sv_find("ball") == 1 && sv_find("x") == SV_NONE, "names");
      expect(std::fabs(alice.pose().heading - M_PI / 2) < 1e-9 && alice.pose().y == 0.2, "pose");
      sv::Thing ball("BALL");
      ball.put({0.3, 0.4, 0, 0});
      expect(ball.pose().x == 0.3 && ball.velocity().x == 0, "moved");
      ball.set_velocity({0.5, 0, 0, 0});
      double from = ball.pose().x;
      sv::step(0.1);
      // it starts with 0.5 m/s and rolling takes 0.02 g: 0.05 m - 0.098 * 0.1^2 m, and up to a tick more
      expect(ball.pose().x - from > 0.0489 && ball.pose().x - from < 0.0501, "rolled");
      ball.reset();
      expect(ball.pose().x == 0.5 && ball.pose().y == 0, "reset");
      bool threw = false;
      try { sv::Thing("box").put({0, 0, 0, 0}); } catch (const sv::Error& e) {
        threw = std::string(e.what()).find("stands fast") != std::string::npos;
      }
      expect(threw, "fixed things stay");
      sv_end(0, "done");
    })");
  listen();
  run_for(1);
  EXPECT_EQ(finish().code, 0) << finish().text;
  EXPECT_NE(finish().text.find("passed: done"), std::string::npos) << finish().text;
  ASSERT_EQ(said.size(), 1u);  // the mistake was told
  EXPECT_NE(said[0].find("got 'box', which stands fast"), std::string::npos);
}

TEST_F(SupervisorTest, a_ball_put_into_the_air_falls) {
  add_robot_with_source(kIdle);
  world.objects.push_back(ball_at(0.5, 0, 0));
  add_supervisor_with_source(R"(
    #include <supervisor.h>
    int main(void) {
      int ball = sv_find("ball");
      struct sv_pose p = {0, 0, 0.1, 0};
      sv_set_pose(ball, &p);
      sv_step(0.1);
      sv_get_pose(ball, &p);
      sv_end(p.z > 0.049 && p.z < 0.053 ? 0 : 1, "z %.4f m", p.z); /* 0.1 - 9.81 / 2 * 0.1^2 = 0.051 */
      sv_step(0.2);
      return 0;
    })",
                             "c");
  run_for(1);
  EXPECT_EQ(finish().code, 0) << finish().text;
}

struct Crash {
  const char* name;
  const char* body;
  const char* says;
};

class CrashTest : public SupervisorTest, public ::testing::WithParamInterface<Crash> {};

TEST_P(CrashTest, ends_the_run_with_a_message) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source(std::string("#include <supervisor.h>\n#include <cstdlib>\n#include <cassert>\n"
                                         "#include <stdexcept>\nvolatile int* nowhere;\nvolatile int zero;\n"
                                         "int deep(volatile int n) { volatile char a[1000]; a[n % 1000] = 1; "
                                         "return deep(n + 1) + a[0]; }\n"
                                         "int main() {\n  sv_step(0.25);\n") +
                             GetParam().body + "\n}\n");
  run_for(1);
  EXPECT_NEAR(now_s(), 0.25, 0.002);
  const supervisor::Outcome& outcome = finish();
  EXPECT_TRUE(outcome.crashed);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.text.find(GetParam().says), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("supervisor 'supervisor0', t=0.25"), std::string::npos) << outcome.text;
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, CrashTest,
    ::testing::Values(Crash{"null", "*nowhere = 1;", "(SIGSEGV) at main ("},
                      Crash{"wild_argument", "sv_get_pose(0, (sv_pose*)8);", "(SIGSEGV) at main ("},
                      Crash{"division", "return 7 / zero;", "(SIGFPE) at main ("},
                      Crash{"abort", "abort();", "(SIGABRT)"},
                      Crash{"assertion", "assert(zero);", "(SIGABRT)"},
                      Crash{"exception", "throw std::runtime_error(\"no ball\");", "nobody caught: no ball"},
                      Crash{"recursion", "return deep(1);", "stack overflow (SIGSEGV) at deep("}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(SupervisorTest, exit_ends_the_program_and_not_the_process) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source(
      "#include <stdlib.h>\n#include <supervisor.h>\nint main(void) { sv_step(0.1); exit(0); }", "c");
  add_supervisor_with_source(
      "#include <stdlib.h>\n#include <supervisor.h>\nint main(void) { sv_step(0.5); exit(7); }", "c");
  run_for(1);
  EXPECT_NEAR(now_s(), 0.5, 0.002);  // exit(0) at 0.1 s lets the world go on
  EXPECT_EQ(finish().code, 1);
  EXPECT_NE(finish().text.find("ended by exit() with 7"), std::string::npos) << finish().text;
}

TEST_F(SupervisorTest, two_supervisors_of_one_program_have_globals_of_their_own) {
  add_robot_with_source(kIdle);
  for (int i = 0; i < 2; ++i)
    add_supervisor_with_source(R"(
      #include <supervisor.hpp>
      static int rounds;
      int& inside() { static int n; return n; }
      int main() {
        while (sv::step(0.25)) { ++rounds; ++inside(); }
        sv::log(std::to_string(rounds) + " " + std::to_string(inside()));
      })");
  listen();
  run_for(1);
  finish();
  ASSERT_EQ(said.size(), 2u);
  for (const std::string& line : said) EXPECT_NE(line.find(": 4 4"), std::string::npos) << line;
}

TEST_F(SupervisorTest, chance_follows_the_seed_and_differs_between_supervisors) {
  const auto draw = [](std::uint64_t seed) {
    struct Run : SupervisorTest {
      void TestBody() override {}
      std::vector<std::string> go(std::uint64_t its_seed) {
        world.seed = its_seed;
        add_robot_with_source(kIdle);
        for (int i = 0; i < 2; ++i)
          add_supervisor_with_source(R"(
            #include <stdio.h>
            #include <stdlib.h>
            #include <time.h>
            #include <supervisor.h>
            int main(void) {
              srand(time(NULL));
              sv_log("%.9f %.9f %d", sv_random(), sv_random_normal(), rand());
              return 0;
            })",
                                     "c");
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
  EXPECT_NE(a[0].substr(a[0].find("s: ")), a[1].substr(a[1].find("s: ")));
}

TEST_F(SupervisorTest, a_program_that_does_not_compile_is_bad_input) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source("#include <supervisor.h>\nint main(void) { return sv_stepp(1); }", "cpp");
  try {
    run_for(0.1);
    FAIL() << "it started";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("sv_stepp"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("main.cpp:2"), std::string::npos) << e.what();
  }
}

TEST_F(SupervisorTest, a_function_that_supervisors_do_not_have_is_named) {
  add_robot_with_source(kIdle);
  add_supervisor_with_source("void wb_radar_enable(int); int main(void) { wb_radar_enable(1); return 0; }",
                             "c");
  try {
    run_for(0.1);
    FAIL() << "it started";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("wb_radar_enable, which supervisors do not have"), std::string::npos)
        << e.what();
  }
}

TEST_F(SupervisorTest, tracks_leave_out_moves_by_hand) {
  const auto file = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / "tracks.csv";
  add_robot_with_source(kIdle);
  world.objects.push_back(ball_at(0.5, 0, 0));
  add_supervisor_with_source(R"(
    #include <supervisor.hpp>
    int main() {
      sv::Thing ball("ball");
      ball.track(0.05);
      ball.set_velocity({0.5, 0, 0, 0});
      sv::step(0.5);
      double way = ball.track_length();
      ball.put({-2, 0, 0, 0});
      sv::step(0.5);
      // 0.5 * 0.5 - 0.098 * 0.5^2
      if (way < 0.2245 || way > 0.2265 || ball.track_length() != way) sv::fail(std::to_string(way));
      // 0, 0.05, ... 1 s
      if (sv_track_points(ball.number()) != 21) sv::fail(std::to_string(sv_track_points(ball.number())));
      sv::check(sv_save_tracks(")" +
                             file.string() + R"("));
      sv::pass();
    })");
  run_for(2);
  EXPECT_EQ(finish().code, 0) << finish().text;
  std::ifstream in(file);
  std::string head, first;
  std::getline(in, head);
  std::getline(in, first);
  EXPECT_EQ(head, "time_s,thing,x_m,y_m,z_m,heading_rad");
  EXPECT_EQ(first, "0.000000,ball,0.500000,0.000000,0.000000,0.000000");
}

TEST_F(SupervisorTest, a_picture_at_a_chosen_moment) {
  const auto file = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / "moment.svg";
  std::filesystem::remove(file);
  add_robot_with_source(kIdle);
  add_supervisor_with_source(R"(
    #include <supervisor.hpp>
    int main() {
      sv::step(0.1);
      sv::label(0, "2 : 1", 0.4, 0.01);
      sv::picture(")" + file.string() +
                             R"(");
      if (sv_picture("/nowhere/at.all.png") != -1) sv::fail("wrote nowhere");
    })");
  listen();
  run_for(0.3);
  EXPECT_FALSE(finish().ended) << finish().text;
  EXPECT_GT(std::filesystem::file_size(file), 500u);
  ASSERT_EQ(team().labels().size(), 1u);
  EXPECT_EQ(team().labels()[0].text, "2 : 1");
}

// an inline variable keeps code in memory for good; the next program must not be taken for it
TEST(SharedObjectTest, code_that_stays_does_not_stand_for_the_next_file) {
  const auto folder = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / "inline";
  std::filesystem::create_directories(folder);
  for (const int number : {10, 20}) {
    const auto source = folder / ("stays" + std::to_string(number) + ".cpp");
    std::ofstream(source) << "struct S { static inline int n; }; int main() { S::n++; return " << number
                          << "; }";
    // a shared object that a user brings, compiled without what provide_program() adds
    const std::string file = source.string() + ".so";
    ASSERT_EQ(std::system(("g++ -shared -fPIC -o '" + file + "' '" + source.string() + "'").c_str()), 0);
    std::string error;
    const auto object = host::SharedObject::open(file, true, error);
    ASSERT_TRUE(object) << error;
    const auto number_of = reinterpret_cast<int (*)()>(object->symbol("main"));
    ASSERT_TRUE(object->locate(reinterpret_cast<std::uintptr_t>(number_of)));
    EXPECT_TRUE(object->is_code(reinterpret_cast<std::uintptr_t>(number_of)));
    EXPECT_FALSE(object->is_code(object->base()));
    EXPECT_EQ(number_of(), number);
  }
}

}  // namespace
