// SPDX-License-Identifier: MIT
// What the e-puck senses, as programs of Webots' interfaces are told: proximity, light, ground, motion, the
// simulator's truth, pictures, sounds, packets. Expectations by hand, or from the board itself.
#include <algorithm>
#include <cmath>

#include "sim_core/light/profiles.h"
#include "tests/programs/program_fixture.h"

namespace {

using programs_test::ProgramTest;
using programs_test::Robot;

class Sensing : public ProgramTest {};

// --- proximity and light

TEST_F(Sensing, ps_are_the_counts_of_the_board_dark_less_lit) {
  wall(0.065, -0.3, 0.065, 0.3);
  wall(-0.3, -0.05, 0.3, -0.05);
  sim::LampDesc lamp;
  lamp.position_m = {-0.5, 0.2, 0.5};
  world.lamps.push_back(lamp);
  Robot& r =
      add_c("WbDeviceTag ps[8]; char name[4];",
            "for (int i = 0; i < 8; i++) { sprintf(name, \"ps%d\", i); ps[i] = wb_robot_get_device(name);\n"
            "wb_distance_sensor_enable(ps[i], 64); }\n"
            "printf(\"range %g %g %d\\n\", wb_distance_sensor_get_min_value(ps[0]), "
            "wb_distance_sensor_get_max_value(ps[0]),\n"
            "wb_distance_sensor_get_type(ps[0]) == WB_DISTANCE_SENSOR_INFRA_RED);",
            "printf(\"ps\"); for (int i = 0; i < 8; i++) printf(\" %g\", "
            "wb_distance_sensor_get_value(ps[i])); printf(\"\\n\");");
  run_for(1);
  const auto ps = told(r, "ps");
  ASSERT_EQ(ps.size(), 8u);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(ps[static_cast<std::size_t>(i)], r.proximity(i), 3) << "ps" << i;
  EXPECT_GT(ps[0], 150);
  EXPECT_GT(ps[2], 1000) << "the right wall is 1.5 cm away";
  EXPECT_LT(ps[5], 150) << "nothing is to the left";
  EXPECT_EQ(told(r, "range"), (std::vector<double>{0, 4095, 1}));
}

TEST_F(Sensing, ls_are_nearly_full_in_the_dark_and_less_in_light) {
  const char* const before =
      "for (int i = 0; i < 8; i++) { char name[4]; sprintf(name, \"ls%d\", i); ls[i] = "
      "wb_robot_get_device(name);\n"
      "wb_light_sensor_enable(ls[i], 64); }";
  const char* const loop =
      "printf(\"ls\"); for (int i = 0; i < 8; i++) printf(\" %g\", wb_light_sensor_get_value(ls[i])); "
      "printf(\"\\n\");";
  Robot& dark = add_c("WbDeviceTag ls[8];", before, loop);
  run_for(0.5);
  for (const double counts : told(dark, "ls")) {
    EXPECT_GT(counts, 3900);
    EXPECT_LE(counts, 4095);
  }
}

TEST_F(Sensing, ls_that_look_at_a_lamp_show_less_than_those_that_do_not) {
  sim::LampDesc lamp;
  lamp.position_m = {0, -0.3, 0.05};  // to the right
  world.lamps.push_back(lamp);
  Robot& r =
      add_c("WbDeviceTag right, left;",
            "right = wb_robot_get_device(\"ls2\"); left = wb_robot_get_device(\"ls5\");\n"
            "wb_light_sensor_enable(right, 64); wb_light_sensor_enable(left, 64);",
            "printf(\"ls %g %g\\n\", wb_light_sensor_get_value(right), wb_light_sensor_get_value(left));");
  run_for(0.5);
  EXPECT_LT(told(r, "ls").at(0), told(r, "ls").at(1) - 300);
}

// a wall 1 cm from the right side, or the left: ps2 and ps5 of the product, ps5 and ps0 of the lab
TEST_F(Sensing, sensors_are_numbered_as_the_world_says) {
  struct Case {
    const char* order;
    double wall_y_m;
    int sees;
  };
  for (const Case& c : {Case{"product", -0.047, 2}, Case{"product", 0.047, 5}, Case{"lab", -0.047, 5},
                        Case{"lab", 0.047, 0}}) {
    struct Run : ProgramTest {
      void TestBody() override {}
      std::vector<double> go(const Case& its) {
        world.webots.sensor_order = its.order;
        wall(-0.3, its.wall_y_m, 0.3, its.wall_y_m);
        Robot& r = add_c("WbDeviceTag ps[8];",
                         "for (int i = 0; i < 8; i++) { char name[4]; sprintf(name, \"ps%d\", i); ps[i] = "
                         "wb_robot_get_device(name); wb_distance_sensor_enable(ps[i], 64); }",
                         "printf(\"ps\"); for (int i = 0; i < 8; i++) printf(\" %g\", "
                         "wb_distance_sensor_get_value(ps[i])); printf(\"\\n\");");
        run_for(0.4);
        return told(r, "ps");
      }
    } run;
    const auto ps = run.go(c);
    ASSERT_EQ(ps.size(), 8u);
    EXPECT_EQ(std::max_element(ps.begin(), ps.end()) - ps.begin(), c.sees) << c.order << " " << c.wall_y_m;
    EXPECT_GT(ps[static_cast<std::size_t>(c.sees)], 1000) << c.order;
  }
}

// the proximity sensors' is that of the world's profile; that of tof: mm of m
TEST_F(Sensing, a_sensor_tells_its_lookup_table_or_warns_once_that_it_has_none) {
  world.proximity.profile = "webots-old";
  world.proximity.noise_scale = 0.5;
  const char* const tell =
      "const char* names[] = {\"tof\", \"ps0\", \"ps7\", \"gs0\", \"selector\"};\n"
      "for (int i = 0; i < 5; i++) { WbDeviceTag d = wb_robot_get_device(names[i]);\n"
      "if (d == 0) continue;\n"
      "int n = wb_distance_sensor_get_lookup_table_size(d);\n"
      "const double* t = wb_distance_sensor_get_lookup_table(d);\n"
      "printf(\"%s %d\", names[i], n); for (int k = 0; k < 3 * n; k++) printf(\" %g\", t[k]);\n"
      "printf(\"\\n\"); }\n"
      "wb_gyro_get_lookup_table_size(wb_robot_get_device(\"gyro\"));";
  Robot& r = add_c("", tell, "");
  run_for(0.1);
  EXPECT_EQ(told(r, "tof"), (std::vector<double>{2, 0, 0, 0, 2, 2000, 0}));
  const auto& law = sim::find_profile("webots-old")->table;
  for (const char* name : {"ps0", "ps7"}) {
    const auto rows = told(r, name);
    ASSERT_EQ(rows.size(), 1 + 3 * law.size()) << name;
    EXPECT_EQ(rows[0], static_cast<double>(law.size()));
    for (std::size_t i = 0; i < law.size(); ++i) {
      EXPECT_NEAR(rows[1 + 3 * i], law[i].distance_m, 1e-6);
      EXPECT_NEAR(rows[2 + 3 * i], law[i].value, 1e-2);
      EXPECT_NEAR(rows[3 + 3 * i], law[i].relative_noise / 2, 1e-6);
    }
  }
  EXPECT_EQ(told(r, "selector"), std::vector<double>{0});
  const auto& lines = r.console();
  EXPECT_EQ(
      std::count_if(lines.begin(), lines.end(),
                    [](const std::string& line) { return line.find("lookup table:") != std::string::npos; }),
      1);
  EXPECT_EQ(
      std::count(lines.begin(), lines.end(),
                 "Warning: lookup table: got device \"selector\", which has none, expected one that measures "
                 "distances; 0 rows"),
      1);
}

// the wall's face is at 0.2 m less half of 1 cm, the sensor 3.5 cm before the middle: 160 mm
TEST_F(Sensing, tof_tells_how_many_mm_are_free_ahead) {
  const char* const before = "tof = wb_robot_get_device(\"tof\"); wb_distance_sensor_enable(tof, 64);";
  const char* const loop = "printf(\"tof %g\\n\", wb_distance_sensor_get_value(tof));";
  Robot& r = add_c("WbDeviceTag tof;", before, loop);
  Robot& away = add_c("WbDeviceTag tof;", before, loop).at(0, 1, 90);
  wall(0.2, -0.1, 0.2, 0.1);
  run_for(0.2);
  EXPECT_NEAR(value(r, "tof"), 160, 1);
  EXPECT_EQ(value(away, "tof"), 2000);
}

TEST_F(Sensing, ground_sensors_tell_white_from_black) {
  const char* const before =
      "for (int i = 0; i < 3; i++) { char name[4]; sprintf(name, \"gs%d\", i); gs[i] = "
      "wb_robot_get_device(name);\n"
      "wb_distance_sensor_enable(gs[i], 64); }\nWbDeviceTag fs = wb_robot_get_device(\"fs1\"); printf(\"fs "
      "%d\\n\", fs != 0);";
  const char* const loop =
      "printf(\"gs\"); for (int i = 0; i < 3; i++) printf(\" %g\", wb_distance_sensor_get_value(gs[i])); "
      "printf(\"\\n\");";
  world.floor.colour = {1, 1, 1};
  Robot& with = add_c("WbDeviceTag gs[3];", before, loop);
  add_part(with, "ground-sensors");
  run_for(0.5);
  EXPECT_EQ(value(with, "fs"), 1) << "the older name";
  for (const double v : told(with, "gs")) EXPECT_NEAR(v, 856, 100);  // white [docs/extending.md]
}

// --- motion and truth

const char* const kMotion = "WbDeviceTag acc, gps, north, imu; const double *v;";
const char* const kMotionOn =
    "acc = wb_robot_get_device(\"accelerometer\"); wb_accelerometer_enable(acc, 64);\n"
    "gps = wb_robot_get_device(\"gps\"); wb_gps_enable(gps, 64);\n"
    "north = wb_robot_get_device(\"north\"); wb_compass_enable(north, 64);\n"
    "imu = wb_robot_get_device(\"imu\"); wb_inertial_unit_enable(imu, 64);";
const char* const kMotionTold =
    "v = wb_accelerometer_get_values(acc); printf(\"acc %g %g %g\\n\", v[0], v[1], v[2]);\n"
    "v = wb_gps_get_values(gps); printf(\"gps %.9g %.9g %.9g\\n\", v[0], v[1], v[2]);\n"
    "printf(\"speed %.9g\\n\", wb_gps_get_speed(gps));\n"
    "v = wb_compass_get_values(north); printf(\"north %.9g %.9g %.9g\\n\", v[0], v[1], v[2]);\n"
    "v = wb_inertial_unit_get_roll_pitch_yaw(imu); printf(\"imu %.9g %.9g %.9g\\n\", v[0], v[1], v[2]);";

struct Truth {
  const char* name;
  sim::Axes axes;
  const char* revision;
  std::vector<double> gps, north, up;
};
class Truths : public Sensing, public ::testing::WithParamInterface<Truth> {};

// at (0.2, 0.1), looking 30 degrees to the left of the world's x. enu: north is y, 60 degrees to its left.
// nue: x right, y up, z towards the reader; north is x, in the robot's right, up, backward
TEST_P(Truths, are_told_in_the_axes_of_the_world) {
  world.webots.axes = GetParam().axes;
  Robot& r = add_c(kMotion, kMotionOn, kMotionTold).at(0.2, 0.1, 30);
  r.settings().variation.motion_noise_scale = 0;
  r.settings().own["revision"] = GetParam().revision;
  r.settings().devices = {device("gps", sim::DeviceKind::Gps), device("north", sim::DeviceKind::Compass),
                          device("imu", sim::DeviceKind::Inertial)};
  run_for(0.6);
  const auto gps = told(r, "gps"), north = told(r, "north"), acc = told(r, "acc"), imu = told(r, "imu");
  ASSERT_EQ(gps.size() + north.size() + acc.size() + imu.size(), 12u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(gps[i], GetParam().gps[i], 1e-5) << i;
    EXPECT_NEAR(north[i], GetParam().north[i], 1e-5) << i;
    EXPECT_NEAR(acc[i], 9.81 * GetParam().up[i], 0.06) << i;
  }
  EXPECT_EQ(value(r, "speed"), 0);
  EXPECT_NEAR(imu[0], 0, 1e-6);
  EXPECT_NEAR(imu[1], 0, 1e-6);
  if (GetParam().axes == sim::Axes::Enu) {
    EXPECT_NEAR(imu[2], 30 * M_PI / 180, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Axes, Truths,
    ::testing::Values(
        Truth{"enu", sim::Axes::Enu, "1.1", {0.2, 0.1, 0}, {0.5, std::sqrt(0.75), 0}, {0, 0, 1}},
        Truth{"enu_13", sim::Axes::Enu, "1.3", {0.2, 0.1, 0}, {0.5, std::sqrt(0.75), 0}, {0, 0, 1}},
        Truth{"nue", sim::Axes::Nue, "1.1", {0.2, 0, -0.1}, {0.5, 0, -std::sqrt(0.75)}, {0, 1, 0}},
        Truth{"nue_13", sim::Axes::Nue, "1.3", {0.2, 0, -0.1}, {0.5, 0, -std::sqrt(0.75)}, {0, 1, 0}}),
    [](const auto& info) { return std::string(info.param.name); });

// wheels at 300 steps/s against each other: 2 * 300 * 0.0001288 m / 0.053 m = 1.458 rad/s
// about the upward axis
struct Gyro {
  const char* revision;
  sim::Axes axes;
};
class Gyros : public Sensing, public ::testing::WithParamInterface<Gyro> {};

TEST_P(Gyros, tell_how_fast_the_robot_turns) {
  world.webots.axes = GetParam().axes;
  const std::size_t up = GetParam().axes == sim::Axes::Nue ? 1 : 2;
  Robot& r = add_c(
      "WbDeviceTag gyro, imu, own; const double *v;",
      "gyro = wb_robot_get_device(\"gyro\"); wb_gyro_enable(gyro, 64); imu = wb_robot_get_device(\"imu\");\n"
      "wb_inertial_unit_enable(imu, 64); own = wb_robot_get_device(\"own\"); wb_gyro_enable(own, 64);\n"
      "wb_differential_wheels_set_speed(-300, 300);",
      "static double before; double yaw; v = wb_gyro_get_values(gyro); printf(\"gyro %g %g %g\\n\", v[0], "
      "v[1], v[2]);\n"
      "v = wb_gyro_get_values(own); printf(\"own %g %g %g\\n\", v[0], v[1], v[2]);\n"
      "yaw = wb_inertial_unit_get_roll_pitch_yaw(imu)[2]; printf(\"rate %g\\n\", remainder(yaw - before, "
      "6.283185307) / 0.064);\n"
      "before = yaw;");
  r.settings().variation.motion_noise_scale = 0;
  r.settings().own["revision"] = GetParam().revision;
  r.settings().devices = {device("imu", sim::DeviceKind::Inertial), device("own", sim::DeviceKind::Gyro)};
  if (std::string(GetParam().revision) == "1.1")
    r.settings().devices.push_back(device("gyro", sim::DeviceKind::Gyro));
  run_for(2);
  const double rate = value(r, "rate");
  EXPECT_NEAR(rate, 1.458, 0.03);
  // Webots' lookup table of the e-puck's: 7509.9 a rad/s; one that a world adds has none
  EXPECT_NEAR(told(r, "gyro").at(up), rate * 7509.9, 0.03 * 1.458 * 7509.9);
  EXPECT_NEAR(told(r, "gyro").at(0), 0, 0.02 * 7509.9);
  EXPECT_NEAR(told(r, "own").at(up), rate, 0.03 * 1.458);
}
INSTANTIATE_TEST_SUITE_P(Revisions, Gyros,
                         ::testing::Values(Gyro{"1.1", sim::Axes::Enu}, Gyro{"1.3", sim::Axes::Enu},
                                           Gyro{"1.1", sim::Axes::Nue}, Gyro{"1.3", sim::Axes::Nue}));

// --- camera and sound

class Cameras : public Sensing, public ::testing::WithParamInterface<const char*> {};

// a red ball of 4 cm, 12 cm before the lens, its middle 2 cm above the floor and the lens at about 3: it is
// in the middle of the picture and not at its sides
TEST_P(Cameras, show_a_red_ball_in_red) {
  sim::ObjectDesc ball;
  ball.kind = sim::ObjectKind::Ball;
  ball.name = "ball";
  ball.radius_m = 0.025;
  ball.size_m.z = 0.05;
  ball.material.colour = {1, 0, 0};
  ball.pose = {0.15, 0, 0};
  world.objects.push_back(ball);
  Robot& r = add_c("WbDeviceTag cam; int pictures;",
                   "cam = wb_robot_get_device(\"camera\"); wb_camera_enable(cam, 128);\n"
                   "printf(\"size %d %d\\nfov %g\\n\", wb_camera_get_width(cam), wb_camera_get_height(cam), "
                   "wb_camera_get_fov(cam));",
                   "const unsigned char *p = wb_camera_get_image(cam); int w = 52;\n"
                   "if (p && p[4 * (52 * 20 + 26) + 2]) { pictures++;\n"
                   "printf(\"middle %d %d %d %d\\n\", wb_camera_image_get_red(p, w, 26, 20), "
                   "wb_camera_image_get_green(p, w, 26, 20), "
                   "wb_camera_image_get_blue(p, w, 26, 20), p[4 * (52 * 20 + 26) + 3]);\n"
                   "printf(\"side %d %d %d\\n\", wb_camera_image_get_red(p, w, 2, 20), "
                   "wb_camera_image_get_green(p, w, 2, 20), "
                   "wb_camera_image_get_blue(p, w, 2, 20)); } printf(\"pictures %d\\n\", pictures);");
  r.settings().own["camera"] = GetParam();
  r.settings().own["camera_noise"] = 0;
  run_for(2);
  EXPECT_EQ(told(r, "size"), (std::vector<double>{52, 39}));
  EXPECT_NEAR(value(r, "fov"), 0.84, 1e-9);
  EXPECT_GT(value(r, "pictures"), 5);
  const auto middle = told(r, "middle"), side = told(r, "side");
  ASSERT_EQ(middle.size(), 4u);
  EXPECT_GT(middle[0], 60);
  EXPECT_GT(middle[0], 2 * middle[1]);
  EXPECT_GT(middle[0], 2 * middle[2]);
  EXPECT_EQ(middle[3], 255);
  EXPECT_LT(std::fabs(side[0] - side[2]), 40) << "the side is no red";
  expect_no_traps();
}
INSTANTIATE_TEST_SUITE_P(Sensors, Cameras, ::testing::Values("po3030k", "po6030k", "po8030d"));

// Posts of 1 cm, 30 cm from the lens: each in the column that the field of view says, 26 / tan(0.42) pixels to the
// tangent.
TEST_P(Cameras, show_things_where_their_field_of_view_has_them) {
  const std::pair<double, sim::Colour> kPosts[] = {{10, {1, 0, 0}}, {20, {0, 1, 0}}, {-20, {0, 0, 1}}};
  for (const auto& [degrees, colour] : kPosts) {
    sim::ObjectDesc post;
    post.kind = sim::ObjectKind::Cylinder;
    post.radius_m = 0.005;
    post.size_m.z = 0.2;
    post.material.colour = colour;
    post.pose = {0.03 + 0.3 * std::cos(sim::radians(degrees)), 0.3 * std::sin(sim::radians(degrees)), 0};
    world.objects.push_back(post);
  }
  Robot& r =
      add_c("WbDeviceTag cam;", "cam = wb_robot_get_device(\"camera\"); wb_camera_enable(cam, 64);",
            "const unsigned char *p = wb_camera_get_image(cam); int x, c, n[3] = {0}; double sum[3] = {0};\n"
            "for (x = 0; p && x < 52; x++) for (c = 0; c < 3; c++) {\n"
            "  const unsigned char *at = p + 4 * (52 * 10 + x); int mine = at[2 - c];\n"
            "  if (mine > 40 + at[(3 - c) % 3] && mine > 40 + at[(4 - c) % 3]) { sum[c] += x; n[c]++; } }\n"
            "if (n[0] && n[1] && n[2]) printf(\"columns %g %g %g\\n\", sum[0] / n[0], sum[1] / n[1], sum[2] "
            "/ n[2]);");
  r.settings().own["camera"] = GetParam();
  r.settings().own["camera_noise"] = 0;
  run_for(3);
  const auto columns = told(r, "columns");
  ASSERT_EQ(columns.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(columns[i], 25.5 - 26 / std::tan(0.42) * std::tan(sim::radians(kPosts[i].first)), 1.01);
}

// a ball of 4 cm, 20 cm before the lens and 2 cm to its left; one behind a wall; one at the robot's back
TEST_F(Sensing, a_camera_recognises_what_has_colours_and_is_in_sight) {
  const auto ball = [&](double x_m, double y_m, sim::Colour colour) {
    sim::ObjectDesc b;
    b.kind = sim::ObjectKind::Ball;
    b.radius_m = 0.02;
    b.size_m.z = 0.04;
    b.model = "ball";
    b.recognition_colours = {colour};
    b.pose = {x_m, y_m, 0};
    world.objects.push_back(b);
  };
  ball(0.23, 0.02, {1, 0, 0});
  ball(0.45, -0.1, {0, 1, 0});
  ball(-0.3, 0, {0, 0, 1});
  sim::ObjectDesc wall;
  wall.size_m = {0.02, 0.2, 0.2};
  wall.pose = {0.35, -0.1, 0};
  world.objects.push_back(wall);
  Robot& r = add_c("#include <webots/camera_recognition_object.h>\nWbDeviceTag cam;",
                   "cam = wb_robot_get_device(\"camera\"); wb_camera_enable(cam, 64);\n"
                   "wb_camera_recognition_enable(cam, 64);",
                   "const WbCameraRecognitionObject *o = wb_camera_recognition_get_objects(cam);\n"
                   "printf(\"count %d\\n\", wb_camera_recognition_get_number_of_objects(cam));\n"
                   "printf(\"place %g %g %g\\n\", o->position[0], o->position[1], o->position[2]);\n"
                   "printf(\"size %g %g\\n\", o->size[0], o->size[1]);\n"
                   "printf(\"pixel %d %d\\n\", o->position_on_image[0], o->position_on_image[1]);\n"
                   "printf(\"pixels %d %d\\n\", o->size_on_image[0], o->size_on_image[1]);\n"
                   "printf(\"colour %g %g %g\\n\", o->colors[0], o->colors[1], o->colors[2]);\n"
                   "printf(\"model %d\\n\", strcmp(o->model, \"ball\"));");
  run_for(0.1);
  EXPECT_EQ(value(r, "count"), 1);
  const auto place = told(r, "place");
  ASSERT_EQ(place.size(), 3u);
  // the lens is 3 cm before the axle and 2.8 cm above the floor
  EXPECT_NEAR(place[0], 0.2, 1e-6);
  EXPECT_NEAR(place[1], 0.02, 1e-6);
  EXPECT_NEAR(place[2], -0.008, 1e-6);
  EXPECT_EQ(told(r, "size"), (std::vector<double>{0.04, 0.04}));
  // 26 / tan(0.42) = 58.2 pixels: 58.2 * 0.1 to the left of 26, 58.2 * 0.04 below 19.5, 11.6 wide
  EXPECT_EQ(told(r, "pixel"), (std::vector<double>{20, 21}));
  EXPECT_EQ(told(r, "pixels"), (std::vector<double>{12, 12}));
  EXPECT_EQ(told(r, "colour"), (std::vector<double>{1, 0, 0}));
  EXPECT_EQ(value(r, "model"), 0);
}

const char* const kEars =
    "static int loud(WbDeviceTag mic) { const short *s = wb_microphone_get_sample_data(mic); int i, low = "
    "32767, high = -32768;\n"
    "if (!s) return -1; for (i = 0; i < wb_microphone_get_sample_size(mic) / 2; i++) { if (s[i] < low) low = "
    "s[i]; if (s[i] > high) high = s[i]; }\n"
    "return high - low; }\nWbDeviceTag mic[3];";
const char* const kEarsOn =
    "for (int i = 0; i < 3; i++) { char name[5]; sprintf(name, \"mic%d\", i); mic[i] = "
    "wb_robot_get_device(name); wb_microphone_enable(mic[i], 64); }\n"
    "printf(\"before %d\\n\", wb_microphone_get_sample_data(mic[0]) != NULL);";

// 90 dB at 1 m are 294 counts of amplitude at 0.3 m, the microphones 0.2937, 0.2937 and 0.322 m away: swings
// of 600, 600 and 548 counts, each 16 of Webots' 16 bits
TEST_F(Sensing, microphones_give_the_newest_hundred_samples) {
  sim::SoundDesc tone;
  tone.kind = sim::SoundKind::Tone;
  tone.frequency_hz = 1000;
  tone.level_db = 90;
  tone.position_m = {0.3, 0, 0.035};
  world.sounds.push_back(tone);
  Robot& r = add_c(kEars, kEarsOn,
                   "printf(\"loud %d %d %d %d\\n\", loud(mic[0]), loud(mic[1]), loud(mic[2]), "
                   "wb_microphone_get_sample_size(mic[0]));");
  run_for(0.6);
  const auto loud = told(r, "loud");
  ASSERT_EQ(loud.size(), 4u);
  EXPECT_EQ(value(r, "before"), 0);
  EXPECT_NEAR(loud[0], 600 * 16, 12 * 16);
  EXPECT_NEAR(loud[1], 600 * 16, 12 * 16);
  EXPECT_NEAR(loud[2], 548 * 16, 12 * 16);
  EXPECT_EQ(loud[3], 200);
}

// "haa" is 2112 samples at 7200 Hz: 0.293 s
TEST_F(Sensing, a_speaker_plays_a_stored_sound_and_another_robot_hears_it) {
  Robot& speaks =
      add_c("WbDeviceTag s;", "s = wb_robot_get_device(\"speaker\");",
            "if (steps == 10) wb_speaker_play_sound(s, s, \"sounds/haa.wav\", 1, 1, 0, 0);\n"
            "if (steps == 40) wb_speaker_play_sound(s, s, \"tune.mp3\", 1, 1, 0, 0);\n"
            "printf(\"plays %d %d\\n\", steps, wb_speaker_is_sound_playing(s, \"sounds/haa.wav\"));",
            32, "speaks");
  Robot& hears = add_c(kEars, kEarsOn, "printf(\"loud %d\\n\", loud(mic[1]));", 32, "hears").at(0.15, 0);
  run_for(0.3);
  const double before = value(hears, "loud");
  EXPECT_LT(before, 16 * 16);
  run_for(0.2);
  EXPECT_GT(value(hears, "loud"), 4 * before);
  EXPECT_EQ(told(speaks, "plays").at(1), 1);
  run_for(0.5);
  EXPECT_LT(value(hears, "loud"), 16 * 16);
  EXPECT_EQ(told(speaks, "plays").at(1), 0);
  run_for(0.6);
  const auto& lines = speaks.console();
  EXPECT_EQ(
      std::count(
          lines.begin(), lines.end(),
          "Warning: speaker: got sound 'tune.mp3', expected one that the robot stores: haa, spaah, ouah, "
          "yaouh, wouaaaah"),
      1);
}

// --- packets

const char* const kReceive =
    "while (wb_receiver_get_queue_length(r) > 0) { const double *d = wb_receiver_get_emitter_direction(r); "
    "got++;\n"
    "printf(\"packet %d %d %g %g %g %g\\n\", got, wb_receiver_get_data_size(r), "
    "wb_receiver_get_signal_strength(r), d[0], d[1], d[2]);\n"
    "printf(\"text_%s 1\\n\", (const char *)wb_receiver_get_data(r)); wb_receiver_next_packet(r); }";
const char* const kReceiveOn = "r = wb_robot_get_device(\"receiver\"); wb_receiver_enable(r, 64);";

TEST_F(Sensing, robots_send_packets_and_hear_from_where) {
  add_c("", "", "if (steps == 5) wb_emitter_send(wb_robot_get_device(\"emitter\"), \"hello\", 6);", 64, "a");
  // 0.5 m to the east of it and looking north: it comes from the left
  Robot& b = add_c("WbDeviceTag r; int got;", kReceiveOn, kReceive, 64, "b").at(0.5, 0, 90);
  Robot& other = add_c("WbDeviceTag r; int got;", std::string(kReceiveOn) + "wb_receiver_set_channel(r, 7);",
                       kReceive, 64, "c")
                     .at(-0.5, 0);
  Robot& all = add_c("WbDeviceTag r; int got;", std::string(kReceiveOn) + "wb_receiver_set_channel(r, -1);",
                     kReceive, 64, "d")
                   .at(0, 1);
  run_for(1);
  const auto packet = told(b, "packet");
  ASSERT_EQ(packet.size(), 6u);
  EXPECT_EQ(packet[0], 1) << "once";
  EXPECT_EQ(packet[1], 6);
  EXPECT_NEAR(packet[2], 4, 0.01);  // 1 / 0.5^2
  EXPECT_NEAR(packet[3], 0, 1e-3);
  EXPECT_NEAR(packet[4], 1, 1e-3);
  EXPECT_EQ(value(b, "text_hello"), 1);
  EXPECT_TRUE(told(other, "packet").empty()) << "another channel";
  EXPECT_NEAR(told(all, "packet").at(2), 1, 0.01) << "channel -1 hears all";
}

TEST_F(Sensing, in_older_axes_a_packet_comes_from_right_up_backward) {
  world.webots.axes = sim::Axes::Nue;
  add_c("", "", "if (steps == 5) wb_emitter_send(wb_robot_get_device(\"emitter\"), \"hello\", 6);", 64, "a");
  Robot& b = add_c("WbDeviceTag r; int got;", kReceiveOn, kReceive, 64, "b").at(0.5, 0, 90);
  run_for(0.6);
  EXPECT_NEAR(told(b, "packet").at(3), -1, 1e-3);
}

TEST_F(Sensing, a_packet_goes_no_further_than_its_range_and_an_emitter_changes_channels) {
  add_c("WbDeviceTag e;", "e = wb_robot_get_device(\"emitter\");",
        "if (steps == 3) { wb_emitter_set_range(e, 0.3); wb_emitter_send(e, \"near\", 5); }\n"
        "if (steps == 6) { wb_emitter_set_range(e, -1); wb_emitter_send(e, \"far\", 4); }\n"
        "if (steps == 9) { wb_emitter_set_channel(e, 5); wb_emitter_send(e, \"five\", 5);\n"
        "printf(\"channel %d %g\\n\", wb_emitter_get_channel(e), wb_emitter_get_range(e)); }",
        64, "a");
  Robot& b = add_c("WbDeviceTag r; int got;", kReceiveOn, kReceive, 64, "b").at(0.5, 0);
  run_for(1);
  EXPECT_EQ(told(b, "packet").at(0), 1);
  EXPECT_TRUE(told(b, "text_near").empty());
  EXPECT_EQ(value(b, "text_far"), 1);
  EXPECT_TRUE(told(b, "text_five").empty());
  EXPECT_EQ(told(robot(0), "channel"), (std::vector<double>{5, -1}));
}

TEST_F(Sensing, an_emitters_queue_is_finite_and_empties) {
  Robot& a = add_c("WbDeviceTag e; char data[96]; int sent;", "e = wb_robot_get_device(\"emitter\");",
                   "if (steps == 1) { for (int i = 0; i < 1000; i++) sent += wb_emitter_send(e, data, 96); "
                   "printf(\"sent %d\\n\", sent); }\n"
                   "if (steps == 5) printf(\"later %d\\n\", wb_emitter_send(e, data, 96));");
  run_for(0.5);
  EXPECT_GE(value(a, "sent"), 4096 / 104);  // each has 96 + 8 bytes
  EXPECT_LT(value(a, "sent"), 1000);
  EXPECT_EQ(value(a, "later"), 1);
}

}  // namespace
