// SPDX-License-Identifier: MIT
// The camera's renderer against a plain ray per pixel, and against sizes and colours worked out by hand.
#include "sim_core/camera/camera.h"

#include <cmath>

#include "sim_core/geometry/solid.h"
#include "tests/sim_core/fixture.h"

namespace {

using sim::Light;
using sim_test::world_of;

constexpr double kFocalPx = 716.5;  // of 640 columns over 0.84 rad: 320 / tan(0.42)

std::vector<double> tangents(int count, int zoom, bool up) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) {
    const double px = (i + 0.5 - 0.5 * count) * zoom;
    out.push_back((up ? -px : px) / kFocalPx);
  }
  return out;
}

class Eye {
 public:
  explicit Eye(const std::string& toml, std::vector<sim::RobotModel> models = {sim_test::puck()})
      : simulation_(sim_test::cruising(world_of(toml, std::move(models)), 0, 0)) {}
  sim::Simulation& simulation() { return *simulation_; }
  const sim::Scene& scene() const { return simulation_->scene(); }

  std::vector<Light> look(int columns = 40, int rows = 40, int zoom = 8, int robot = 0) {
    std::vector<Light> out;
    sim::render_camera(scene(), robot, {0.030, 0, 0.028}, scene().now(), tangents(columns, zoom, false),
                       tangents(rows, zoom, true), out);
    return out;
  }

 private:
  std::unique_ptr<sim::Simulation> simulation_;
};

const char* const kOneRobot = "[[robot]]\nname = \"eye\"\n";

// 0.2 m from the lens (at 0.030), radius 25 mm: half angle asin(25/200) = 7.181 deg, tan 0.12599;
// 0.12599 * 716.5 / 8 = 11.28 columns to each side, so columns 20 - 11.28 = 8.72 to 31.28: centres 9 to
// 30 of 0.5-based ones
TEST(Camera, red_cylinder_covers_its_angle) {
  Eye eye(
      std::string(
          "twinpuck = 1\n[floor]\ncolour = [1, 1, 1]\n[[cylinder]]\nposition = [0.23, 0]\nradius = 0.025\n"
          "height = 0.2\ncolour = [1, 0, 0]\n") +
      kOneRobot);
  const std::vector<Light> image = eye.look();
  for (int column = 0; column < 40; ++column) {
    const Light& p = image[static_cast<std::size_t>(20 * 40 + column)];
    EXPECT_EQ(p.g < 0.1, column >= 9 && column <= 30) << column;
  }
  // upright faces get 0.8 of the sky's light
  EXPECT_FLOAT_EQ(image[20 * 40 + 20].r, 0.8f);
  EXPECT_FLOAT_EQ(image[20 * 40 + 20].b, 0.0f);
  // the floor white, the sky its own colour
  EXPECT_FLOAT_EQ(image[39 * 40 + 0].g, 1.0f);
  EXPECT_FLOAT_EQ(image[0].r, 0.72f);
}

// a box 0.2 m from the lens meets the floor 0.028 / 0.2 * 716.5 / 8 = 12.54 rows below the middle; from 10 mm
// higher 17.02
TEST(Camera, the_eye_is_as_high_as_its_robot) {
  Eye eye(std::string("twinpuck = 1\n[floor]\ncolour = [1, 1, 1]\n[[box]]\nposition = [0.28, 0]\n"
                      "size = [0.1, 0.4, 0.3]\ncolour = [1, 0, 0]\n") +
          kOneRobot);
  for (const auto& [z_m, rows] : {std::pair{0.0, 13}, {0.01, 17}}) {
    eye.simulation().move(0, {}, z_m);
    const std::vector<Light> image = eye.look();
    int red = 0;
    for (std::size_t row = 20; row < 40; ++row) red += image[row * 40 + 20].g < 0.1;
    EXPECT_EQ(red, rows) << z_m;
  }
}

// 20 mm to the left at 0.2 m: tan = 0.1, 0.1 * 716.5 / 8 = 8.96 columns left of the middle
TEST(Camera, left_is_left) {
  Eye eye(std::string("twinpuck = 1\n[[box]]\nposition = [0.23, 0.02]\nsize = [0.002, 0.002, 0.2]\ncolour = "
                      "[0, 0, 1]\n") +
          kOneRobot);
  const std::vector<Light> image = eye.look();
  int found = -1;
  for (int column = 0; column < 40; ++column)
    if (image[static_cast<std::size_t>(20 * 40 + column)].r < 0.1) found = column;
  EXPECT_EQ(found, 11);  // 20 - 8.96 = 11.04
}

// the lens is 28 mm high: the floor at depth d shows at tan = 0.028 / d below the horizon, so a strip that
// begins 0.25 m ahead begins 0.112 * 716.5 / 8 = 10.03 rows below the middle
TEST(Camera, top_of_a_low_plate_lies_where_perspective_puts_it) {
  Eye eye(std::string(
              "twinpuck = 1\n[[box]]\nposition = [0.78, 0]\nsize = [1.0, 2.0, 0.001]\ncolour = [0, 0, 0]\n") +
          kOneRobot);
  const std::vector<Light> image = eye.look();
  // front edge at 0.28 - 0.03 = 0.25, 1 mm high: side 0.112 to 0.108, 10.03 to 9.67; back edge
  // at 1.25: 0.0216, 1.93
  for (int row = 20; row < 40; ++row)
    EXPECT_EQ(image[static_cast<std::size_t>(row * 40 + 20)].r < 0.1, row >= 22 && row <= 29) << row;
}

TEST(Camera, lamp_lights_by_lambert_and_shows_as_a_disc) {
  Eye eye(std::string("twinpuck = 1\n[sky]\nlight = 0\n[[lamp]]\nposition = [1.03, 0, 0.028]\nintensity = 2\n"
                      "attenuation = [0, 0, 1]\ncolour = [1, 0.5, 0]\n[floor]\ncolour = [1, 1, 1]\n") +
          kOneRobot);
  const std::vector<Light> image = eye.look();
  // 1 m ahead, radius 20 mm: 1.79 columns to each side
  EXPECT_FLOAT_EQ(image[20 * 40 + 20].r, 60.0f);
  EXPECT_FLOAT_EQ(image[20 * 40 + 20].g, 30.0f);
  EXPECT_LT(image[20 * 40 + 23].r, 0.01f);
  // row 29.5 px below the middle: tan = 19.5 * 8 / 716.5 = 0.21773, floor at depth 0.1286; x = 0.1586, to the
  // lamp dx = 0.8714, dy = column 20's 0.5 * 8 / 716.5 * 0.1286 = 0.00072, dz = 0.028: d2 = 0.760123, cos =
  // 0.028 / 0.871850
  EXPECT_NEAR(image[39 * 40 + 20].r, 2 * 0.028 / 0.871850 / 0.760123, 1e-4);
}

class Shining : public sim_test::Cruise {
 public:
  explicit Shining(std::uint32_t leds) : Cruise(0, 0), leds_(leds) {}
  sim::MindReport report() const override { return {0, 0, leds_}; }

 private:
  std::uint32_t leds_;
};

TEST(Camera, lit_leds_of_other_robots_glow) {
  sim::RobotModel model = sim_test::puck();
  model.colour = {0, 0, 0};
  for (int i = 0; i < 8; ++i) model.leds.push_back({{0.033, 0}, {1, 0, 0}});
  model.leds[4].at_m = {-0.033, 0};  // at the back
  const sim::WorldDesc world = world_of(
      "twinpuck = 1\n[[robot]]\nname = \"eye\"\n[[robot]]\nname = \"other\"\nposition = [0.2, 0]\n", {model});
  auto simulation = sim_test::simulation_of(
      world, [](int robot) { return std::make_unique<Shining>(robot == 1 ? 1u << 4 : 0u); });
  const auto look = [&] {
    std::vector<Light> out;
    sim::render_camera(simulation->scene(), 0, {0.030, 0, 0.028}, simulation->scene().now(),
                       tangents(40, 8, false), tangents(40, 8, true), out);
    float most = 0;
    for (const Light& p : out)
      if (p.g < 0.05f) most = std::max(most, p.r);
    return most;
  };
  simulation->step();
  EXPECT_LT(look(), 0.1f);  // nobody watches yet
  sim::watch_leds(simulation->scene());
  simulation->step();
  EXPECT_NEAR(look(), 3.0f, 1e-5);  // kLedGlow times red, on a black body
}

// --- the yardstick: one ray per pixel, every solid

Light plain_pixel(const sim::Scene& scene, int robot, double right, double up) {
  const sim::Frame2 body(scene.pose(robot, scene.now()));
  const sim::Vec2 eye = body.to_world({0.030, 0});
  const double k = 1 / std::sqrt(1 + right * right + up * up);
  const sim::Vec2 dir = body.turn({k, -k * right});
  const sim::Ray ray{{eye.x, eye.y, 0.028}, {dir.x, dir.y, k * up}};
  sim::SceneHit hit;
  const sim::WorldDesc& world = scene.world();
  const double sky = world.sky.light_w_m2;
  if (!scene.cast(ray, 100, robot, scene.now(), &hit))
    return {static_cast<float>(world.sky.colour.r * sky), static_cast<float>(world.sky.colour.g * sky),
            static_cast<float>(world.sky.colour.b * sky)};
  const double even = sky * (0.8 + 0.2 * hit.normal.z);
  double e[3] = {even, even, even};
  for (const sim::LampDesc& lamp : world.lamps) {
    const double x = lamp.position_m.x - hit.point_m.x, y = lamp.position_m.y - hit.point_m.y,
                 z = lamp.position_m.z - hit.point_m.z, d = std::sqrt(x * x + y * y + z * z);
    const double cosine = (x * hit.normal.x + y * hit.normal.y + z * hit.normal.z) / d;
    if (cosine <= 0) continue;
    const double share = lamp.intensity_w_m2 * cosine /
                         (lamp.attenuation[0] + lamp.attenuation[1] * d + lamp.attenuation[2] * d * d);
    e[0] += share * lamp.colour.r;
    e[1] += share * lamp.colour.g;
    e[2] += share * lamp.colour.b;
  }
  const sim::Colour& c = hit.surface.colour;
  return {static_cast<float>(c.r * e[0]), static_cast<float>(c.g * e[1]), static_cast<float>(c.b * e[2])};
}

TEST(Camera, picture_equals_one_ray_per_pixel) {
  std::string world =
      "twinpuck = 1\n[arena]\nsize = [1.6, 1.2]\ncolour = [0.9, 0.9, 1]\n"
      "[[wall]]\npoints = [[-0.5, 0.6], [-0.5, 0.0], [-0.2, -0.1]]\nthickness = 0.02\ncolour = [0.2, 0.3, "
      "0.9]\n"
      "[[box]]\nposition = [0.3, 0.3]\nheading = 20\nsize = [0.1, 0.05, 0.02]\ncolour = [0.1, 0.8, 0.1]\n"
      "[[box]]\nposition = [0.3, -0.1]\nsize = [0.1, 0.1, 0.05]\nz = 0.06\ncolour = [0.8, 0.8, 0.1]\n"
      "[[cylinder]]\nposition = [0.0, 0.35]\nradius = 0.04\nheight = 0.02\ncolour = [1, 0, 0]\n"
      "[[ball]]\nposition = [0.15, 0.2]\nradius = 0.03\ncolour = [1, 0.5, 0]\nmovable = true\n"
      "[[polygon]]\npoints = [[0, 0], [0.1, 0], [0.05, 0.1]]\nposition = [-0.3, 0.3]\nheight = 0.07\n"
      "colour = [0.5, 0, 0.5]\n"
      "[[lamp]]\nposition = [0.2, 0.1, 1.5]\nintensity = 1.5\nattenuation = [1, 0.5, 1]\ncolour = [1, 0.9, "
      "0.8]\n";
  const double places[10][3] = {{0.5, 0.4, 200},  {-0.6, 0.3, -60},  {-0.3, 0.1, 45}, {0.1, -0.3, 90},
                                {0.6, -0.4, 170}, {-0.65, -0.4, 20}, {0.2, 0.0, 120}, {-0.1, 0.5, -80},
                                {0.65, 0.1, 185}, {-0.3, -0.35, 0}};
  for (const auto& p : places)
    world += "[[robot]]\nposition = [" + std::to_string(p[0]) + ", " + std::to_string(p[1]) +
             "]\nheading = " + std::to_string(p[2]) + "\n";
  Eye eye(world);
  eye.simulation().step();
  const std::vector<double> right = tangents(40, 8, false), up = tangents(40, 8, true);
  int pixels = 0;
  for (int robot = 0; robot < 10; ++robot) {
    const std::vector<Light> image = eye.look(40, 40, 8, robot);
    for (std::size_t row = 0; row < 40; ++row)
      for (std::size_t column = 0; column < 40; ++column) {
        const Light want = plain_pixel(eye.scene(), robot, right[column], up[row]);
        const Light& got = image[row * 40 + column];
        EXPECT_NEAR(got.r, want.r, 1e-5) << robot << ' ' << row << ' ' << column;
        EXPECT_NEAR(got.g, want.g, 1e-5) << robot << ' ' << row << ' ' << column;
        EXPECT_NEAR(got.b, want.b, 1e-5) << robot << ' ' << row << ' ' << column;
        ++pixels;
      }
  }
  EXPECT_EQ(pixels, 16000);
}

// at 0.8 m the picture is 0.36 m wide: a robot passes from beyond one edge to beyond the other
TEST(Camera, other_robots_are_seen_from_edge_to_edge) {
  Eye eye(std::string("twinpuck = 1\n[floor]\ncolour = [1, 1, 1]\n") + kOneRobot +
          "[[robot]]\nname = \"other\"\nposition = [0.5, 0]\n");
  const std::vector<double> right = tangents(40, 8, false);
  int seen = 0;
  for (double y = -0.3; y < 0.31; y += 0.02) {
    eye.simulation().move(1, {0.83, y, 0}, 0);
    const std::vector<Light> image = eye.look();
    for (std::size_t column = 0; column < 40; ++column) {
      const Light want = plain_pixel(eye.scene(), 0, right[column], -4 / kFocalPx);
      EXPECT_NEAR(image[20 * 40 + column].g, want.g, 1e-5) << y << ' ' << column;
      seen += want.g < 0.9;
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(Camera, any_subset_of_the_grid_gives_the_same_pixels) {
  Eye eye(std::string(
              "twinpuck = 1\n[arena]\nsize = [1, 1]\n[[cylinder]]\nposition = [0.2, 0.05]\nradius = 0.03\n"
              "colour = [1, 0, 0]\n") +
          kOneRobot);
  const std::vector<Light> whole = eye.look();
  const std::vector<double> right = tangents(40, 8, false), up = tangents(40, 8, true);
  std::vector<Light> line;
  for (std::size_t row = 0; row < 40; ++row) {
    sim::render_camera(eye.scene(), 0, {0.030, 0, 0.028}, eye.scene().now(), {right.rbegin(), right.rend()},
                       {up[row]}, line);
    for (std::size_t c = 0; c < 40; ++c) EXPECT_EQ(line[39 - c].g, whole[row * 40 + c].g) << row << ' ' << c;
  }
}

TEST(Camera, sky_keys_say_what_is_wrong) {
  const auto report = [](const char* toml) {
    return sim::parse_world(toml, "w.toml", {sim_test::puck()}).report("w.toml");
  };
  EXPECT_EQ(report("twinpuck = 1\n[sky]\nlight = -1\n"),
            "w.toml:3:9: sky.light: got -1, expected number from 0 to 10000 W/m2");
  EXPECT_EQ(report("twinpuck = 1\n[sky]\ncolor = [0, 0, 0]\n"),
            "w.toml:3:1: unknown key 'color' in sky; did you mean 'colour'? (keys: colour, light)");
}

}  // namespace
