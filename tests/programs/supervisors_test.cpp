// SPDX-License-Identifier: MIT
// What supervisors see and change: variables of firmware, robots, lamps, things, radio,
// sensors that they make up.
#include "tests/programs/supervisor_fixture.h"

namespace {

using namespace programs_test;

class Supervisors : public SupervisorTest {};

// --- firmware's variables

const char* const kVariables = R"(
#include <stdint.h>
struct point { int x; long y; };
struct state {
  char mode;
  unsigned flag : 3;
  int level : 5;
  union { unsigned whole; unsigned char part[2]; };
  struct point at[2];
};
enum colour { RED, GREEN, BLUE };
volatile int count = -3;
volatile unsigned positive = 65535u;
volatile long big = -2147483647L;
volatile unsigned long bigger = 4294967295UL;
volatile long long biggest = -5;
volatile signed char tiny = -7;
volatile unsigned char byte_ = 200;
volatile float half = 0.5f;
volatile double real = -0.25;
volatile enum colour colour = BLUE;
volatile int grid[2][3] = {{1, 2, 3}, {4, 5, 6}};
volatile struct state state = {9, 5, -2, {0x1234}, {{1, 100000L}, {-2, -100000L}}};
static volatile int hidden = 77;
volatile int* pointer = &count;
static void tick(void) { static volatile int inside = 12; inside++; }
int main(void) { tick(); tick(); while (1) { count = count; hidden = hidden; } }
)";

TEST_F(Supervisors, variables_of_every_width_are_fields) {
  add_robot_with_source(kVariables, "alice");
  add_judge(R"(
    static const struct { const char *name; double value; } all[] = {
      {"count", -3}, {"positive", 65535}, {"big", -2147483647.0}, {"bigger", 4294967295.0}, {"biggest", -5}, {"tiny", -7},
      {"byte_", 200}, {"half", 0.5}, {"real", -0.25}, {"colour", 2}, {"grid[1][2]", 6}, {"grid[0][1]", 2}, {"state.mode", 9},
      {"state.flag", 5}, {"state.level", -2}, {"state.whole", 0x1234}, {"state.part[1]", 0x12}, {"state.at[1].y", -100000},
      {"state.at[0].x", 1}, {"hidden", 77}, {"main.c:hidden", 77}, {"inside", 14}, {"tick:inside", 14}};
    char name[64];
    wb_robot_step(50);
    for (unsigned i = 0; i < sizeof all / sizeof *all; i++) {
      snprintf(name, sizeof name, "variable:%s", all[i].name);
      if (get("alice", name) != all[i].value) { printf("%s is %g\n", name, get("alice", name)); ends(1); }
    }
    EXPECT(get("alice", "variable:pointer") != 0);)");
  expect_pass();
}

TEST_F(Supervisors, variables_are_written_to_their_width) {
  add_robot_with_source(kVariables, "alice");
  add_judge(R"(
    wb_robot_step(50);
    set("alice", "variable:count", 70000); /* 70000 - 65536 */
    EXPECT(get("alice", "variable:count") == 4464);
    set("alice", "variable:positive", -1);
    EXPECT(get("alice", "variable:positive") == 65535);
    set("alice", "variable:state.flag", 2);
    set("alice", "variable:state.level", -16);
    EXPECT(get("alice", "variable:state.flag") == 2 && get("alice", "variable:state.level") == -16 && get("alice", "variable:state.mode") == 9);
    set("alice", "variable:half", -1.5);
    EXPECT(get("alice", "variable:half") == -1.5);
    set("alice", "variable:grid[0][2]", -30);
    EXPECT(get("alice", "variable:grid[0][2]") == -30 && get("alice", "variable:grid[1][0]") == 4);
    wb_robot_step(50); /* the program itself has written count meanwhile: what it read */
    EXPECT(get("alice", "variable:count") == 4464);)");
  expect_pass();
}

TEST_F(Supervisors, what_is_no_variable_is_explained) {
  add_robot_with_source(kVariables, "alice");
  add_judge(R"(
    const char *const names[] = {"cuont", "grid[2][0]", "grid[0][0][0]", "grid[1]", "state.colour", "count.x", "grid[x]", "other.c:hidden"};
    char name[64];
    for (int i = 0; i < 8; i++) {
      snprintf(name, sizeof name, "variable:%s", names[i]);
      WbFieldRef f = wb_supervisor_node_get_field(wb_supervisor_node_get_from_def("alice"), name);
      if (f) wb_supervisor_field_get_sf_float(f);
    })");
  expect_pass();
  for (const char* words : {"got 'cuont', expected a variable", "index 2, expected 0 to 1", "it is no array",
                            "expected a number; name a member", "no member 'colour' in 'state'",
                            "no member 'x'", "expected a number in [ ]", "in 'other.c'"})
    EXPECT_TRUE(was_said(words)) << words;
}

TEST_F(Supervisors, robots_of_one_image_keep_their_own_variables) {
  for (int i = 0; i < 3; ++i)
    add_robot_with_source("volatile int mine, seen;\nint main(void) { while (1) seen = mine; }\n",
                          "r" + std::to_string(i))
        .at(0.2 * i, 0);
  add_judge(R"(
    const char *const names[] = {"r0", "r1", "r2"};
    wb_robot_step(50); /* the start-up code clears them */
    for (int i = 0; i < 3; ++i) set(names[i], "variable:mine", 10 + i);
    wb_robot_step(50);
    for (int i = 0; i < 3; ++i) EXPECT(get(names[i], "variable:mine") == 10 + i && get(names[i], "variable:seen") == 10 + i);)");
  expect_pass();
}

TEST_F(Supervisors, a_firmware_that_waits_for_a_flag_sees_it) {
  add_robot_with_source(
      "#include <motor_led/advance_one_timer/e_led.h>\n#include <motor_led/e_init_port.h>\nvolatile int go;\n"
      "int main(void) { e_init_port(); while (!go) ; e_set_led(3, 1); while (1) ; }\n",
      "alice");
  add_judge(R"(
    wb_robot_step(200);
    EXPECT(whole("alice", "leds") == 0);
    set("alice", "variable:go", 1);
    wb_robot_step(10);
    EXPECT(whole("alice", "leds") == 1 << 3);)");
  expect_pass();
}

TEST_F(Supervisors, a_program_of_the_pc_has_no_variables_to_see) {
  add_c("", "", "", 64, "puck");
  add_judge(
      "wb_robot_step(64); WbFieldRef f = "
      "wb_supervisor_node_get_field(wb_supervisor_node_get_from_def(\"puck\"), \"variable:steps\");\n"
      "if (f) wb_supervisor_field_get_sf_float(f);");
  expect_pass();
  EXPECT_TRUE(was_said("a program of the PC, whose variables nobody sees"));
}

// --- robots

TEST_F(Supervisors, what_a_robot_does_is_in_its_fields_and_its_program_begins_anew) {
  add_robot_with_source(R"(
    #include <motor_led/advance_one_timer/e_agenda.h>
    #include <motor_led/advance_one_timer/e_motors.h>
    #include <motor_led/e_init_port.h>
    volatile int starts, zero;
    int main(void) {
      e_init_port(); e_start_agendas_processing(); e_init_motors(); e_set_speed_left(500); e_set_speed_right(500);
      starts++;
      while (zero == 0) ;
      zero = 1 / (zero - 2);
      while (1) ;
    })",
                        "alice")
      .selector(5);
  add_judge(R"(
    EXPECT(whole("alice", "selector") == 5);
    wb_supervisor_field_set_sf_int32(field("alice", "selector"), 9);
    EXPECT(whole("alice", "selector") == 9);
    wb_robot_step(1000);
    /* 500 steps/s for a second, less the start */
    EXPECT(get("alice", "leftSteps") > 480 && get("alice", "leftSteps") <= 500 && get("alice", "rightSteps") > 480);
    EXPECT(fabs(get("alice", "distance") - get("alice", "leftSteps") * 0.0001288) < 0.002);
    EXPECT(get("alice", "batteryVoltage") > 3 && get("alice", "batteryVoltage") <= 4.2 && get("alice", "cpuLoad") > 0);
    EXPECT(whole("alice", "collisions") == 0);
    set("alice", "variable:zero", 2);
    wb_robot_step(50);
    WbFieldRef traps = field("alice", "traps");
    EXPECT(wb_supervisor_field_get_count(traps) == 1 && strstr(wb_supervisor_field_get_mf_string(traps, 0), "division by zero"));
    double stood = place("alice")[0];
    wb_supervisor_node_restart_controller(wb_supervisor_node_get_from_def("alice"));
    wb_robot_step(500);
    EXPECT(get("alice", "variable:zero") == 0 && get("alice", "variable:starts") == 1); /* start-up values */
    EXPECT(place("alice")[0] > stood + 0.02);                                            /* it drives again */)");
  expect_pass(3);
}

// a box's face 2 cm from the sensors at x = 0.03, 2.1 cm along their rays at 17 degrees: 676 at 2 cm, 491
// at 2.5 cm; blue has a factor of 0.2: five times as far, beyond the table's 7 cm, 34
TEST_F(Supervisors, colours_reach_the_sensors) {
  add_robot_with_source(kIdle, "alice");
  sim::ObjectDesc box;
  box.name = "box";
  box.size_m = {0.1, 0.3, 0.1};
  box.pose = {0.10, 0, 0};
  world.objects.push_back(box);
  world.proximity.profile = "webots-old";
  add_judge(R"(
    const double blue[3] = {0, 0, 1};
    wb_robot_step(50);
    double seen = wb_supervisor_field_get_mf_float(field("alice", "proximity"), 0);
    wb_supervisor_field_set_sf_color(field("box", "diffuseColor"), blue);
    wb_robot_step(50);
    double then = wb_supervisor_field_get_mf_float(field("alice", "proximity"), 0);
    EXPECT(wb_supervisor_field_get_count(field("alice", "proximity")) == 8);
    EXPECT(seen > 550 && seen < 700);
    EXPECT(then == 34);
    EXPECT(wb_supervisor_field_get_sf_color(field("box", "diffuseColor"))[2] == 1);)");
  expect_pass();
}

TEST_F(Supervisors, noise_is_set_for_each_robot) {
  add_robot_with_source(kIdle, "alice");
  add_judge(
      "set(\"alice\", \"proximityNoise\", 2); set(\"alice\", \"wheelNoise\", 0.05); wb_robot_step(10);\n"
      "EXPECT(get(\"alice\", \"proximityNoise\") == 2 && get(\"alice\", \"wheelNoise\") == 0.05);\n"
      "set(\"alice\", \"wheelNoise\", 3);");
  expect_pass();
  EXPECT_TRUE(was_said("wheelNoise: got 3, expected 0 to 1"));
}

TEST_F(Supervisors, lamps_are_switched_and_moved) {
  sim::LampDesc lamp;
  lamp.name = "sun";
  world.lamps.push_back(lamp);
  add_robot_with_source(kIdle);
  add_judge(R"(
    const double to[3] = {0.5, 0, 1};
    EXPECT(wb_supervisor_field_get_sf_bool(field("sun", "on")) && get("sun", "intensity") == 1);
    EXPECT(wb_supervisor_node_get_from_def("moon") == NULL);
    wb_supervisor_field_set_sf_bool(field("sun", "on"), 0);
    wb_supervisor_field_set_sf_vec3f(field("sun", "location"), to);
    EXPECT(!wb_supervisor_field_get_sf_bool(field("sun", "on")));)");
  expect_pass();
  EXPECT_FALSE(twin().world().lamps[0].on);
  EXPECT_EQ(twin().world().lamps[0].position_m.x, 0.5);
}

// --- things

TEST_F(Supervisors, nodes_and_fields_in_our_axes) {
  add_ball();
  add_robot_with_source(kIdle, "puck").at(0.1, 0.2, 90).settings().def = "PUCK";
  add_judge(R"(
    WbFieldRef turn = field("PUCK", "rotation");
    const double *v = wb_supervisor_field_get_sf_vec3f(field("PUCK", "translation"));
    EXPECT(v[0] == 0.1 && v[1] == 0.2 && v[2] == 0);
    v = wb_supervisor_field_get_sf_rotation(turn);
    EXPECT(fabs(v[2] - 1) < 1e-12 && fabs(v[3] - M_PI / 2) < 1e-9);
    EXPECT(!strcmp(wb_supervisor_field_get_sf_string(field("PUCK", "name")), "puck"));
    EXPECT(wb_supervisor_node_get_field(wb_supervisor_node_get_from_def("PUCK"), "translaton") == NULL);
    v = place("BALL"); /* a ball's translation is its middle */
    EXPECT(v[0] == 0.3 && v[1] == 0.4 && fabs(v[2] - 0.02) < 1e-9);
    const double to[3] = {-0.5, 0.25, 0.12}, about[4] = {0, 0, 1, -1};
    wb_supervisor_field_set_sf_vec3f(field("BALL", "translation"), to);
    v = place("BALL");
    EXPECT(fabs(v[0] + 0.5) < 1e-9 && fabs(v[1] - 0.25) < 1e-9 && fabs(v[2] - 0.12) < 1e-9);
    wb_supervisor_field_set_sf_rotation(turn, about);
    v = wb_supervisor_field_get_sf_rotation(turn);
    EXPECT(fabs(v[2] * v[3] + 1) < 1e-9);
    EXPECT(wb_robot_step(64) == 0 && fabs(wb_robot_get_time() - 0.064) < 1e-12);
    EXPECT(wb_supervisor_node_get_velocity(wb_supervisor_node_get_from_def("BALL"))[2] < -0.5); /* fallen for 64 ms: 0.63 m/s */)");
  expect_pass();
  EXPECT_NEAR(robot(0).heading_deg(), -180 / M_PI, 1e-6);
}

TEST_F(Supervisors, axes_of_older_worlds) {
  world.webots.axes = sim::Axes::Nue;
  add_ball();
  add_robot_with_source(kIdle, "puck").at(0.1, 0.2, 90).settings().def = "PUCK";
  add_judge(R"(
    const double *v = place("PUCK");
    EXPECT(fabs(v[0] - 0.1) < 1e-12 && fabs(v[1]) < 1e-12 && fabs(v[2] + 0.2) < 1e-12);
    v = wb_supervisor_node_get_center_of_mass(wb_supervisor_node_get_from_def("PUCK"));
    EXPECT(fabs(v[0] - 0.1) < 1e-12 && fabs(v[1] - 0.015) < 1e-12 && fabs(v[2] + 0.2) < 1e-12);
    /* it looks north, along -z: angle 0 */
    v = wb_supervisor_field_get_sf_rotation(field("PUCK", "rotation"));
    EXPECT(fabs(v[3]) < 1e-9);
    const double west[4] = {0, 1, 0, M_PI / 2}, at[3] = {0, 0, 0};
    wb_supervisor_field_set_sf_rotation(field("PUCK", "rotation"), west);
    v = wb_supervisor_node_get_orientation(wb_supervisor_node_get_from_def("PUCK")); /* about y by 90 degrees: -z becomes -x */
    EXPECT(fabs(v[2] - 1) < 1e-9 && fabs(v[6] + 1) < 1e-9 && fabs(v[0]) < 1e-9);
    const double speed[6] = {0.1, 0, 0.2, 0, 0, 0};
    wb_supervisor_field_set_sf_vec3f(field("BALL", "translation"), at);
    wb_supervisor_node_set_velocity(wb_supervisor_node_get_from_def("BALL"), speed);
    v = wb_supervisor_node_get_velocity(wb_supervisor_node_get_from_def("BALL"));
    EXPECT(fabs(v[0] - 0.1) < 1e-9 && fabs(v[2] - 0.2) < 1e-9);
    wb_robot_step(16);
    EXPECT(fabs(place("BALL")[1] - 0.02) < 1e-3); /* not into the floor */)");
  expect_pass();
  EXPECT_NEAR(std::fabs(robot(0).heading_deg()), 180, 1e-6);
}

// 0.5 m/s less rolling, 0.02 g: 0.05 m - 0.098 * 0.1^2 m, and up to a tick more; from 10 cm it falls 9.81 / 2
// * 0.1^2 m
TEST_F(Supervisors, things_are_thrown_moved_and_fall) {
  add_ball(0.5, 0);
  add_robot_with_source(kIdle);
  add_judge(R"(
    const double to[3] = {0.3, 0.4, 0.02}, speed[6] = {0.5, 0, 0, 0, 0, 0}, up[3] = {0, 0, 0.12};
    WbNodeRef ball = wb_supervisor_node_get_from_def("BALL");
    wb_supervisor_field_set_sf_vec3f(field("BALL", "translation"), to);
    wb_supervisor_node_reset_physics(ball);
    EXPECT(fabs(place("BALL")[0] - 0.3) < 1e-9 && wb_supervisor_node_get_velocity(ball)[0] == 0);
    wb_supervisor_node_set_velocity(ball, speed);
    wb_robot_step(100);
    EXPECT(place("BALL")[0] - 0.3 > 0.0489 && place("BALL")[0] - 0.3 < 0.0501);
    wb_supervisor_field_set_sf_vec3f(field("BALL", "translation"), up);
    wb_supervisor_node_reset_physics(ball);
    wb_robot_step(100);
    EXPECT(place("BALL")[2] - 0.02 > 0.049 && place("BALL")[2] - 0.02 < 0.053);)");
  expect_pass();
}

TEST_F(Supervisors, a_robot_that_is_put_in_the_air_falls_to_the_floor) {
  add_robot_with_source(kIdle, "puck").at(0.1, 0.2, 90);
  add_judge(R"(
    const double to[3] = {0.3, 0.4, 0.05};
    wb_supervisor_field_set_sf_vec3f(field("puck", "translation"), to);
    wb_robot_step(64);
    EXPECT(fabs(place("puck")[0] - 0.3) < 1e-9 && place("puck")[2] == 0);)");
  expect_pass();
}

TEST_F(Supervisors, a_reset_puts_everything_back) {
  add_ball();
  add_robot_with_source("volatile int runs; int main(void) { runs++; while (1) ; }", "puck").at(0.1, 0.2, 90);
  add_judge(
      "const double to[3] = {1, 1, 0.02}; wb_robot_step(32);\n"
      "wb_supervisor_field_set_sf_vec3f(field(\"puck\", \"translation\"), to);\n"
      "wb_supervisor_field_set_sf_vec3f(field(\"BALL\", \"translation\"), to); set(\"puck\", "
      "\"variable:runs\", 50);\n"
      "wb_robot_step(32); wb_supervisor_simulation_reset(); wb_robot_step(64);");
  expect_pass();
  EXPECT_EQ(robot(0).variable("runs"), 1);
  EXPECT_NEAR(robot(0).x_m(), 0.1, 1e-9);
  EXPECT_NEAR(twin().simulation().state(1).pose.x_m, 0.3, 1e-9);
}

// as in Webots: the world is loaded anew, with all its programs
TEST_F(Supervisors, a_revert_begins_with_the_supervisor_again) {
  for (const char* call : {"wb_supervisor_simulation_revert();", "wb_supervisor_world_reload();"}) {
    struct Run : Supervisors {
      void TestBody() override {}
      std::vector<std::string> go(const std::string& its_call) {
        add_ball();
        add_robot_with_source(kIdle, "puck").at(0.1, 0.2, 90);
        add_judge(
            "const double to[3] = {1, 1, 0.02}; printf(\"begins %g %g %g\\n\", wb_robot_get_time(), "
            "place(\"puck\")[0], place(\"BALL\")[0]);\n"
            "wb_supervisor_field_set_sf_vec3f(field(\"puck\", \"translation\"), to); "
            "wb_supervisor_field_set_sf_vec3f(field(\"BALL\", \"translation\"), to);\n"
            "wb_robot_step(64); " +
            its_call + " wb_robot_step(64); printf(\"goes on\\n\");");
        listen();
        run_for(0.16);
        return said;
      }
    } run;
    const std::string begins = "supervisor0: begins 0 0.1 0.3";
    EXPECT_EQ(run.go(call), (std::vector<std::string>{begins, begins, begins})) << call;
  }
}

// who does so as soon as it begins would have time stand still
TEST_F(Supervisors, whoever_reloads_the_world_again_and_again_at_one_instant_is_ended) {
  add_robot_with_source(kIdle, "puck");
  add_judge("wb_supervisor_world_reload(); wb_robot_step(32);");
  run_for(0.1);
  EXPECT_TRUE(finish().crashed);
  EXPECT_EQ(finish().text,
            "supervisor 'supervisor0', t=0.000000 s: its program has the world begin again and again at one "
            "instant; it was ended");
}

// --- radio and virtual sensors

TEST_F(Supervisors, messages_go_both_ways) {
  add_c("WbDeviceTag e, r; char answer[8];",
        "e = wb_robot_get_device(\"emitter\"); r = wb_robot_get_device(\"receiver\"); wb_receiver_enable(r, "
        "32);",
        "while (wb_receiver_get_queue_length(r) > 0) { sprintf(answer, \"%d\", "
        "wb_receiver_get_data_size(r)); wb_emitter_send(e, answer, 2); wb_receiver_next_packet(r); }",
        32, "puck");
  add_judge(R"(
    WbDeviceTag e = wb_robot_get_device("emitter"), r = wb_robot_get_device("receiver");
    wb_receiver_enable(r, 32);
    EXPECT(wb_robot_get_device("camera") == 0);
    wb_emitter_send(e, "hello", 5);
    wb_emitter_set_channel(e, 2);
    wb_emitter_send(e, "nobody listens", 14);
    for (int i = 0; i < 6; i++) wb_robot_step(32);
    EXPECT(wb_receiver_get_queue_length(r) == 1 && wb_receiver_get_data_size(r) == 2);
    EXPECT(!strcmp((const char *)wb_receiver_get_data(r), "5"));
    wb_receiver_next_packet(r);
    EXPECT(wb_receiver_get_queue_length(r) == 0);)");
  expect_pass();
}

TEST_F(Supervisors, two_supervisors_speak_on_a_channel_of_theirs) {
  add_robot_with_source(kIdle);
  add_supervisor_in_c("WbDeviceTag e;", "e = wb_robot_get_device(\"emitter\"); wb_emitter_set_channel(e, 3);",
                      "if (steps == 1) wb_emitter_send(e, \"ping\", 5);", 32);
  add_judge(R"(
    WbDeviceTag r = wb_robot_get_device("receiver");
    wb_receiver_enable(r, 32); wb_receiver_set_channel(r, 3);
    for (int i = 0; i < 4; i++) wb_robot_step(32);
    EXPECT(wb_receiver_get_queue_length(r) == 1 && !strcmp((const char *)wb_receiver_get_data(r), "ping"));)");
  expect_pass();
}

TEST_F(Supervisors, its_own_devices_are_those_of_the_world) {
  add_judge(R"(
    WbDeviceTag to = wb_robot_get_device("to"), from = wb_robot_get_device("receiver");
    WbDeviceTag eye = wb_robot_get_device("eye"), arm = wb_robot_get_device("arm");
    EXPECT(wb_robot_get_number_of_devices() == 4);
    EXPECT(wb_emitter_get_channel(to) == 3 && wb_emitter_get_range(to) == 0.75 && wb_emitter_get_buffer_size(to) == 4096);
    EXPECT(wb_receiver_get_channel(from) == 1);
    EXPECT(wb_camera_get_width(eye) == 12 && wb_camera_get_height(eye) == 8 && wb_camera_get_fov(eye) == 0.5);
    EXPECT(wb_motor_get_max_velocity(arm) == 10);
    EXPECT(wb_robot_get_device("emitter") == 0);)");
  const auto add = [&](const char* name, sim::DeviceKind kind) -> sim::DeviceDesc& {
    auto& devices = world.supervisors.back().devices;
    devices.push_back(device(name, kind));
    return devices.back();
  };
  sim::DeviceDesc& to = add("to", sim::DeviceKind::Emitter);
  to.channel = 3;
  to.range_m = 0.75;
  add("arm", sim::DeviceKind::Motor);
  sim::DeviceDesc& eye = add("eye", sim::DeviceKind::Camera);
  eye.width = 12;
  eye.height = 8;
  eye.fov_rad = 0.5;
  expect_pass();
}

TEST_F(Supervisors, a_device_without_a_node_is_told_by_its_name) {
  add_judge(R"(
    EXPECT(wb_supervisor_node_get_from_device(wb_robot_get_device("receiver")) == NULL);
    wb_robot_step(32);)");
  listen();
  expect_pass();
  EXPECT_EQ(std::count(said.begin(), said.end(),
                       "supervisor0: Warning: wb_supervisor_node_get_from_device(): the device 'receiver' "
                       "has no node in the world"),
            1)
      << ::testing::PrintToString(said);
}

TEST_F(Supervisors, a_made_up_sensor_is_read_by_programs_and_firmware) {
  add_c("WbDeviceTag s;", "s = wb_robot_get_device(\"ball_distance\"); wb_distance_sensor_enable(s, 32);",
        "printf(\"s %g\\n\", wb_distance_sensor_get_value(s));", 32, "puck")
      .settings()
      .devices = {[] {
    sim::DeviceDesc d;
    d.name = "ball_distance";
    d.kind = sim::DeviceKind::Distance;
    return d;
  }()};
  add_robot_with_source(
      "#include <twinpuck/virtual.h>\nvolatile float seen;\nint main(void) { float v; while (1) if "
      "(twinpuck_virtual_sensor(\"ball_distance\", &v)) seen = v; }\n",
      "firm")
      .at(0.3, 0);
  add_judge(R"(
    set("puck", "sensor:ball_distance", 0.5); set("firm", "sensor:ball_distance", 0.5);
    wb_robot_step(300);
    EXPECT(get("firm", "variable:seen") == 0.5);
    set("puck", "sensor:ball_distance", 0.25); set("firm", "sensor:ball_distance", 0.25);
    wb_robot_step(100);
    EXPECT(get("firm", "variable:seen") == 0.25);)");
  expect_pass();
  EXPECT_EQ(value(robot(0), "s"), 0.25);
}

TEST_F(Supervisors, custom_data_reaches_the_robots_program) {
  add_c("", "", "printf(\"custom_%s 1\\n\", wb_robot_get_custom_data());", 32, "puck");
  add_judge(
      "wb_robot_step(96); wb_supervisor_field_set_sf_string(field(\"puck\", \"customData\"), \"blue\"); "
      "wb_robot_step(96);");
  expect_pass();
  EXPECT_EQ(value(robot(0), "custom_"), 1);
  EXPECT_EQ(value(robot(0), "custom_blue"), 1);
}

// what comes with the steps (FOLLOW) is what a question would be answered
TEST_F(Supervisors, what_is_followed_is_what_is_asked) {
  add_c("WbDeviceTag l, r;",
        "l = wb_robot_get_device(\"left wheel motor\"); r = wb_robot_get_device(\"right wheel motor\");"
        "wb_motor_set_position(l, INFINITY); wb_motor_set_position(r, INFINITY);"
        "wb_motor_set_velocity(l, 3); wb_motor_set_velocity(r, 5);",
        "", 32, "puck");
  add_judge(R"(
    WbNodeRef puck = wb_supervisor_node_get_from_def("puck");
    WbFieldRef place = field("puck", "translation"), turn = field("puck", "rotation");
    double before = 0;
    for (int i = 0; i < 20; i++) {
      double is[25];
      const double *now[5];
      wb_robot_step(i % 3 ? 32 : 48);
      for (int fresh = 0; fresh < 2; fresh++) {
        if (fresh) wb_supervisor_node_save_state(puck, "kept"); /* what is known is old now */
        now[0] = wb_supervisor_field_get_sf_vec3f(place);
        now[1] = wb_supervisor_field_get_sf_rotation(turn);
        now[2] = wb_supervisor_node_get_position(puck);
        now[3] = wb_supervisor_node_get_orientation(puck);
        now[4] = wb_supervisor_node_get_velocity(puck);
        const int counts[5] = {3, 4, 3, 9, 6};
        double *to = is;
        for (int k = 0; k < 5; to += counts[k++])
          if (fresh)
            EXPECT(memcmp(to, now[k], sizeof(double) * counts[k]) == 0);
          else
            memcpy(to, now[k], sizeof(double) * counts[k]);
      }
      EXPECT(i < 2 || is[0] != before);
      before = is[0];
    })");
  expect_pass(2);
}

TEST_F(Supervisors, variables_that_are_followed_are_those_of_now) {
  add_robot_with_source(
      "#include <stdint.h>\nvolatile uint16_t count; volatile int mine;\nint main(void) { while (1) count++; "
      "}\n",
      "alice");
  add_judge(R"(
    double before = -1;
    for (int i = 0; i < 12; i++) {
      wb_robot_step(10);
      const double now = get("alice", "variable:count");
      set("alice", "variable:mine", 3 * i);
      EXPECT(get("alice", "variable:mine") == 3 * i);
      EXPECT(get("alice", "variable:count") == now && now != before);
      EXPECT(whole("alice", "collisions") == 0);
      before = now;
    })");
  expect_pass(1);
}

TEST_F(Supervisors, who_comes_second_sees_what_the_first_has_done) {
  add_robot_with_source(kIdle);
  add_ball();
  add_supervisor_in_c(
      "WbFieldRef f;",
      "f = wb_supervisor_node_get_field(wb_supervisor_node_get_from_def(\"BALL\"), \"translation\");",
      "double to[3] = {0.01 * steps, 0, 0.02}; wb_supervisor_field_set_sf_vec3f(f, to);", 32);
  add_judge(R"(
    WbFieldRef f = field("BALL", "translation");
    for (int i = 0; i < 12; i++) {
      wb_robot_step(32);
      const double x = wb_supervisor_field_get_sf_vec3f(f)[0], k = x / 0.01;
      EXPECT(fabs(k - floor(k + 0.5)) < 1e-9 && k >= i && k <= i + 2); /* put there now, and not rolled on */
    })");
  expect_pass(2);
}

}  // namespace
