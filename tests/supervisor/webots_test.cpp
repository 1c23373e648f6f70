// SPDX-License-Identifier: MIT
// Programs written for Webots: both interfaces, both axes.
#include <filesystem>
#include <fstream>

#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

namespace {

using firmware_test::FirmwareTest;

class SupervisorWebotsTest : public FirmwareTest {
 protected:
  void SetUp() override {
    sim::ObjectDesc ball;
    ball.kind = sim::ObjectKind::Ball;
    ball.name = "ball";
    ball.def = "BALL";
    ball.radius_m = 0.02;
    ball.size_m.z = 0.04;
    ball.movable = true;
    ball.pose = {0.3, 0.4, 0};
    world.objects.push_back(ball);
    add_robot_with_source("volatile int runs; int main(void) { runs++; while (1) ; }", "puck")
        .at(0.1, 0.2, 90);
    robot(0).settings().def = "PUCK";
  }
  std::vector<std::string> said;
  void expect_pass(double seconds = 1) {
    team().say = [this](const std::string& line) { said.push_back(line); };
    run_for(seconds);
    EXPECT_EQ(finish().code, 0) << finish().text;
    EXPECT_TRUE(finish().ended) << "the program did not come to its end";
  }
};

const char* const kHead = R"(
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define EXPECT(what) do { if (!(what)) { printf("line %d: %s\n", __LINE__, #what); fflush(stdout); exit(1); } } while (0)
)";

TEST_F(SupervisorWebotsTest, nodes_and_fields_in_our_axes) {
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <webots/robot.h>
    #include <webots/supervisor.h>
    int main(void) {
      wb_robot_init();
      WbNodeRef puck = wb_supervisor_node_get_from_def("PUCK"), ball = wb_supervisor_node_get_from_def("BALL");
      WbFieldRef at = wb_supervisor_node_get_field(puck, "translation");
      WbFieldRef turn = wb_supervisor_node_get_field(puck, "rotation");
      const double *v = wb_supervisor_field_get_sf_vec3f(at);
      EXPECT(v[0] == 0.1 && v[1] == 0.2 && v[2] == 0);
      v = wb_supervisor_field_get_sf_rotation(turn);
      EXPECT(v[2] == 1 && fabs(v[3] - M_PI / 2) < 1e-12);
      EXPECT(!strcmp(wb_supervisor_field_get_sf_string(wb_supervisor_node_get_field(puck, "name")), "puck"));
      EXPECT(wb_supervisor_node_get_field(puck, "translaton") == NULL);
      EXPECT(wb_supervisor_field_get_count(wb_supervisor_node_get_field(wb_supervisor_node_get_root(), "children")) == 2);
      /* a ball's translation is its middle */
      v = wb_supervisor_node_get_position(ball);
      EXPECT(v[0] == 0.3 && v[1] == 0.4 && fabs(v[2] - 0.02) < 1e-12);
      const double to[3] = {-0.5, 0.25, 0.12}, about[4] = {0, 0, 1, -1};
      wb_supervisor_field_set_sf_vec3f(wb_supervisor_node_get_field(ball, "translation"), to);
      v = wb_supervisor_node_get_position(ball);
      EXPECT(v[0] == -0.5 && v[1] == 0.25 && fabs(v[2] - 0.12) < 1e-12);
      wb_supervisor_field_set_sf_rotation(turn, about);
      v = wb_supervisor_field_get_sf_rotation(turn);
      EXPECT(fabs(v[3] + 1) < 1e-9);
      const double green[3] = {0, 1, 0};
      wb_supervisor_field_set_mf_color(wb_supervisor_node_get_field(ball, "recognitionColors"), 0, green);
      EXPECT(wb_supervisor_field_get_sf_color(wb_supervisor_node_get_field(ball, "baseColor"))[1] == 1);
      EXPECT(wb_robot_step(64) == 0 && fabs(wb_robot_get_time() - 0.064) < 1e-12);
      EXPECT(wb_supervisor_node_get_velocity(ball)[2] < -0.5); /* it has fallen for 64 ms: 0.63 m/s */
      wb_supervisor_simulation_quit(0);
      wb_robot_cleanup();
      return 0;
    })",
                             "c");
  expect_pass();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("no field 'translaton'"), std::string::npos) << said[0];
}

// two files of one program share a variable that neither initialises, as programs of 2005 do; words come from
// the world file, and files from the program's folder, to which the run does not belong
TEST_F(SupervisorWebotsTest, programs_work_in_their_own_folder_and_get_their_words) {
  const auto folder = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / "supervisor_folder";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "places.txt") << "12\n";
  std::ofstream(folder / "common.c") << "int shared; void set_shared(void) { shared = 5; }";
  std::ofstream(folder / "main.c") << kHead << R"(
    #include <webots/robot.h>
    #include <webots/supervisor.h>
    int shared;
    void set_shared(void);
    int main(int argc, char **argv) {
      int place = 0;
      FILE *in = fopen("places.txt", "r");
      EXPECT(in && fscanf(in, "%d", &place) == 1 && place == 12);
      EXPECT(argc == 3 && !strcmp(argv[1], "fast") && !strcmp(argv[2], "3") && argv[3] == NULL);
      set_shared();
      EXPECT(shared == 5);
      wb_robot_init();
      wb_robot_step(64);
      in = fopen("written.txt", "w");
      EXPECT(in && fclose(in) == 0);
      wb_supervisor_simulation_quit(0);
      return 0;
    })";
  add_supervisor(folder.string());
  world.supervisors.back().args = "fast  3";
  const auto before = std::filesystem::current_path();
  expect_pass();
  EXPECT_EQ(std::filesystem::current_path(), before);
  EXPECT_TRUE(std::filesystem::exists(folder / "written.txt"));
}

TEST_F(SupervisorWebotsTest, axes_of_older_worlds) {
  world.webots.axes = sim::Axes::Nue;
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <webots/robot.h>
    #include <webots/supervisor.h>
    int main(void) {
      wb_robot_init();
      WbNodeRef puck = wb_supervisor_node_get_from_def("PUCK"), ball = wb_supervisor_node_get_from_def("BALL");
      const double *v = wb_supervisor_node_get_position(puck);
      EXPECT(v[0] == 0.1 && v[1] == 0 && v[2] == -0.2);
      /* it looks north, along -z: angle 0 */
      v = wb_supervisor_field_get_sf_rotation(wb_supervisor_node_get_field(puck, "rotation"));
      EXPECT(v[1] == 1 && fabs(v[3]) < 1e-12);
      const double west[4] = {0, 1, 0, M_PI / 2}, at[3] = {0, 0, 0};
      wb_supervisor_field_set_sf_rotation(wb_supervisor_node_get_field(puck, "rotation"), west);
      v = wb_supervisor_node_get_orientation(puck); /* about y by 90 degrees: -z becomes -x */
      EXPECT(fabs(v[2] - 1) < 1e-9 && fabs(v[6] + 1) < 1e-9 && fabs(v[0]) < 1e-9);
      wb_supervisor_field_set_sf_vec3f(wb_supervisor_node_get_field(ball, "translation"), at);
      v = wb_supervisor_node_get_position(ball);
      EXPECT(fabs(v[1] - 0.02) < 1e-12); /* not into the floor */
      wb_supervisor_simulation_quit(0);
      wb_robot_step(16);
      return 0;
    })",
                             "c");
  expect_pass();
  EXPECT_NEAR(robot(0).heading_deg(), 180, 1e-6);
}

TEST_F(SupervisorWebotsTest, the_interface_of_2005) {
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <device/robot.h>
    #include <device/supervisor.h>
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
      EXPECT(where[0] == 0.3f && where[2] == -0.4f && all[4] == 1);
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
        EXPECT(ms == 64 && where[0] == 0 && where[2] == 0.1f && fabs(where[1] - 0.02) < 1e-6);
        supervisor_field_get(ball, SUPERVISOR_FIELD_TRANSLATION, where, 0);
        const float up[3] = {0, 0.1f, 0};
        supervisor_field_set(ball, SUPERVISOR_FIELD_TRANSLATION, up);
      } else if (calls == 5) {
        EXPECT(where[0] == 0 && where[2] == 0.1f); /* no longer refreshed */
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
                             "c");
  expect_pass();
  EXPECT_EQ(team().labels().at(0).text, "0 - 0");
  EXPECT_NEAR(now_s(), 0.256, 0.003);  // steps follow each other exactly, however ticks round them
  // it fell for 0.128 s from where its middle was 0.1 m high: 0.08 m - 9.81 / 2 * 0.128^2 < 0, so it lies or
  // bounced
  EXPECT_LT(twin().simulation().state(1).z_m, 0.001);
}

TEST_F(SupervisorWebotsTest, revert_puts_everything_back) {
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <supervisor.h>
    #include <webots/robot.h>
    #include <webots/supervisor.h>
    int main(void) {
      struct sv_pose p = {1, 1, 0, 0};
      double runs = 0;
      wb_robot_init();
      wb_robot_step(32);
      sv_set_pose(0, &p);
      sv_set_pose(1, &p);
      sv_set_variable(0, "runs", 50);
      wb_supervisor_simulation_revert();
      wb_robot_step(32);
      sv_get_variable(0, "runs", &runs);
      EXPECT(runs == 1);
      EXPECT(wb_supervisor_node_get_position(wb_supervisor_node_get_from_def("PUCK"))[0] == 0.1);
      EXPECT(wb_supervisor_node_get_position(wb_supervisor_node_get_from_def("BALL"))[0] == 0.3);
      wb_supervisor_simulation_quit(EXIT_SUCCESS);
      return 0;
    })",
                             "c");
  expect_pass();
}

TEST_F(SupervisorWebotsTest, emitters_and_receivers_between_programs) {
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <webots/emitter.h>
    #include <webots/robot.h>
    int main(void) {
      wb_robot_init();
      WbDeviceTag emitter = wb_robot_get_device("emitter");
      wb_emitter_set_channel(emitter, 3);
      wb_robot_step(32);
      wb_emitter_send(emitter, "ping", 5);
      while (wb_robot_step(32) != -1) ;
      return 0;
    })",
                             "c");
  add_supervisor_with_source(std::string(kHead) + R"(
    #include <webots/receiver.h>
    #include <webots/robot.h>
    #include <webots/supervisor.h>
    int main(void) {
      wb_robot_init();
      WbDeviceTag receiver = wb_robot_get_device("receiver");
      wb_receiver_enable(receiver, 32);
      wb_receiver_set_channel(receiver, 3);
      EXPECT(wb_robot_get_device("camera") == 0);
      for (int i = 0; i < 4; i++) wb_robot_step(32);
      EXPECT(wb_receiver_get_queue_length(receiver) == 1 && wb_receiver_get_data_size(receiver) == 5);
      EXPECT(!strcmp((const char *)wb_receiver_get_data(receiver), "ping"));
      wb_receiver_next_packet(receiver);
      EXPECT(wb_receiver_get_queue_length(receiver) == 0);
      wb_supervisor_simulation_quit(0);
      return 0;
    })",
                             "c");
  expect_pass();
}

}  // namespace
