// SPDX-License-Identifier: MIT
// The table itself, section by section in the order of docs/worlds.md. Degrees and such become SI here.
// Longer than 300 lines because it is one table: every key, its limits and its meaning on neighbouring lines.
// Sections of a room with much to say stand in a file of their own, schema_<room>.cpp.
#include "sim_core/load/schema.h"

#include <fmt/format.h>

#include "sim_core/base/check.h"
#include "sim_core/base/clock.h"
#include "sim_core/geometry/solid.h"
#include "sim_core/light/profiles.h"
#include "sim_core/load/schema_keys.h"
#include "sim_core/load/schema_radio.h"
#include "sim_core/load/schema_sections.h"

namespace sim {

std::string find_material(const WorldDesc& draft, const std::string& name, Material& out) {
  std::string known;
  for (const Material& m : draft.materials) {
    if (m.name == name) {
      out = m;
      return {};
    }
    known += (known.empty() ? "" : ", ") + m.name;
  }
  return fmt::format("got \"{}\", expected the name of a [[material]]{}", name,
                     known.empty() ? " (there are none)" : " (" + known + ")");
}

namespace {

template <typename T>
std::vector<KeySpec> material_keys() {
  return {
      {"material", ValueType::Text, "", 0, 0, "", "",
       "name of a `[[material]]`; without it a white one is used",
       checked<T>(
           [](T& t, const Value& v, const WorldDesc& d) { return find_material(d, v.text, t.material); })},
      {"colour", ValueType::Colour, "", 0, 1, "", "", "red, green, blue; overrides the material's colour",
       into<T>([](T& t, const Value& v) { t.material.colour = colour_of(v); })},
  };
}

template <typename T>
std::vector<KeySpec> object_keys(ObjectKind kind, std::vector<KeySpec> shape) {
  std::vector<KeySpec> keys{
      {"name", ValueType::Text, "", 0, 0, "", "", "shown in messages and pictures",
       into<T>([](T& o, const Value& v) { o.name = v.text; })},
      def_key<T>(),
      {"position", ValueType::Pair, "m", -kFar, kFar, "", kind == ObjectKind::Polygon ? "[0, 0]" : "required",
       kind == ObjectKind::Polygon ? "x and y of the origin of its points" : "x and y of its middle",
       into<T>([](T& o, const Value& v) { o.pose.x_m = v.numbers[0], o.pose.y_m = v.numbers[1]; })},
      {"z", ValueType::Number, "m", 0, kFar, "", "0",
       "height of its underside; a movable one falls from there",
       into<T>([](T& o, const Value& v) { o.z_m = v.number; })},
      {"heading", ValueType::Number, "deg", -kMany, kMany, "", "0", "counter-clockwise from +x",
       into<T>([](T& o, const Value& v) { o.pose.heading_rad = radians(v.number); })},
      {"movable", ValueType::Flag, "", 0, 0, "", "false", "true: it can be pushed and it falls",
       into<T>([](T& o, const Value& v) { o.movable = v.flag; })},
      {"mass", ValueType::Number, "kg", 1e-4, 1000, "", "0.1", "of a movable one",
       into<T>([](T& o, const Value& v) { o.mass_kg = v.number; })},
      {"friction", ValueType::Number, "", 0, 10, "", "0.5",
       "Coulomb coefficient of a movable one against whatever it stands on",
       into<T>([](T& o, const Value& v) { o.floor_friction = v.number; })},
  };
  for (KeySpec& k : material_keys<T>()) keys.push_back(std::move(k));
  keys.push_back({"restitution", ValueType::Number, "", 0, 1, "", "", "bounce; overrides the material's",
                  into<T>([](T& o, const Value& v) { o.material.restitution = v.number; })});
  keys.push_back({"model", ValueType::Text, "", 0, 0, "", "", "what cameras that recognise objects call it",
                  into<T>([](T& o, const Value& v) { o.model = v.text; })});
  keys.push_back(recognition_key<T>());
  keys.push_back(node_key<T>());
  shape.insert(shape.end(), keys.begin(), keys.end());
  return shape;
}

/// Proximity keys, for whatever struct holds the settings.
template <typename T, typename Get>
std::vector<KeySpec> proximity_keys(Get get) {
  const auto to = [get](auto assign) {
    return into<T>([get, assign](T& t, const Value& v) { assign(get(t), v); });
  };
  static const std::string names = [] {
    std::string all;
    for (const ProximityProfile& p : proximity_profiles())
      all += (all.empty() ? "" : "|") + std::string(p.name);
    return all;
  }();
  using P = ProximitySettings;
  return {
      {"profile", ValueType::Choice, "", 0, 0, names.c_str(), "\"inverse-square\"",
       "lookup table, rays, colour rule and noise law by name",
       to([](P& p, const Value& v) { p.profile = v.text; })},
      {"table", ValueType::Rows, "m, counts, fraction", 0, 1e6, "", "",
       "own lookup table instead of the profile's: rows of distance, value and relative noise, distances "
       "growing; "
       "linear in between, clamped beyond the ends",
       checked<T>([get](T& t, const Value& v, const WorldDesc&) {
         std::vector<ResponseRow> rows;
         for (const std::vector<double>& row : v.rows) {
           if (!rows.empty() && row[0] <= rows.back().distance_m) {
             return fmt::format("got distance {} after {}, expected growing distances in m", row[0],
                                rows.back().distance_m);
           }
           if (row[0] > 10) return fmt::format("got a distance of {} m, expected at most 10 m", row[0]);
           rows.push_back({row[0], row[1], row[2]});
         }
         if (rows.size() < 2) return fmt::format("got {} row(s), expected at least 2", rows.size());
         get(t).table = rows;
         return std::string();
       })},
      {"type", ValueType::Choice, "", 0, 0, "infra-red|generic", "\"infra-red\"",
       "generic sensors do not see colour", to([](P& p, const Value& v) {
         p.type = v.text == "generic" ? SensorType::Generic : SensorType::InfraRed;
       })},
      {"rays", ValueType::Integer, "", 1, 100, "", "", "how many; the profile's otherwise",
       to([](P& p, const Value& v) { p.rays = static_cast<int>(v.integer); })},
      {"aperture", ValueType::Number, "deg", 0, 180, "", "",
       "full angle that the rays cover; 0 leaves one ray",
       to([](P& p, const Value& v) { p.aperture_rad = radians(v.number); })},
      {"aperture_rad", ValueType::Number, "rad", 0, kPi, "", "",
       "the same in radians, as Webots worlds write it",
       to([](P& p, const Value& v) { p.aperture_rad = v.number; })},
      {"gaussian_width", ValueType::Number, "", 0, 1000, "", "1",
       "a ray at angle t weighs exp(-(t / (aperture * width))^2); 0 leaves only the ray on the axis (the "
       "innermost where none lies there), and is told",
       to([](P& p, const Value& v) { p.gaussian_width = v.number; })},
      {"layout", ValueType::Choice, "", 0, 0, "cone|fan", "", "rays on cones (Webots) or side by side (Enki)",
       to([](P& p, const Value& v) { p.layout = v.text == "fan" ? RayLayout::Fan : RayLayout::Cone; })},
      {"colour_rule", ValueType::Choice, "", 0, 0, "old|new|none", "",
       "old: distances are divided by 0.2 + 0.8 red; new: the red part also shrinks with roughness",
       to([](P& p, const Value& v) {
         p.colour_rule = v.text == "old"   ? ColourRule::Old
                         : v.text == "new" ? ColourRule::New
                                           : ColourRule::None;
       })},
      {"noise_law", ValueType::Choice, "", 0, 0, "uniform|gaussian", "",
       "what the table's third column means: half width or standard deviation", to([](P& p, const Value& v) {
         p.noise_law = v.text == "uniform" ? NoiseLaw::Uniform : NoiseLaw::Gaussian;
       })},
      {"noise_scale", ValueType::Number, "", 0, 1000, "", "1",
       "factor on the table's noise; 0 switches it off",
       to([](P& p, const Value& v) { p.noise_scale = v.number; })},
  };
}

/// What robots have for themselves or from the world.
template <typename T>
std::vector<KeySpec> wheel_keys(const char* none, const char* usual_law) {
  return {
      {"wheel_noise", ValueType::Number, "", 0, 0.5, "", none,
       "random part of each wheel's travel, drawn anew every 1/32 s; a robot without one has the "
       "world's",
       into<T>([](T& t, const Value& v) { t.wheels.noise = v.number; })},
      {"wheel_noise_law", ValueType::Choice, "", 0, 0, "uniform|gaussian", usual_law,
       "what `wheel_noise` is: half width (factors of 1 - n to 1 + n) or standard deviation",
       into<T>([](T& t, const Value& v) {
         t.wheels.noise_law = v.text == "uniform" ? NoiseLaw::Uniform : NoiseLaw::Gaussian;
       })},
      {"slip", ValueType::Number, "", 0, 1, "", none,
       "part of the wheels' travel that is lost on the floor; a robot without one has the world's",
       into<T>([](T& t, const Value& v) { t.wheels.slip = v.number; })},
  };
}

/// none, pty, pty:LINK, tcp:PORT or file:PATH.
std::string uart_text(const Value& v, std::string& out) {
  const std::string& t = v.text;
  bool good = t == "none" || t == "-" || t == "pty" || (t.rfind("file:", 0) == 0 && t.size() > 5) ||
              (t.rfind("pty:", 0) == 0 && t.size() > 4);
  if (t.rfind("tcp:", 0) == 0 && t.size() > 4 && t.size() <= 9 &&
      t.find_first_not_of("0123456789", 4) == std::string::npos) {
    const int port = std::stoi(t.substr(4));
    good = port >= 1 && port <= 65535;
  }
  if (!good)
    return fmt::format(
        "got \"{}\", expected none, -, pty, pty:LINK, tcp:PORT with a port of 1 to 65535, or file:PATH", t);
  out = t;
  return {};
}

std::vector<KeySpec> variation_keys() {
  using V = Variation;
  const auto number = [](const char* key, const char* unit, double least, double most, const char* fallback,
                         const char* doc, double V::*field) {
    return KeySpec{
        key, ValueType::Number, unit, least, most, "", fallback, doc, into<V>([field](V& t, const Value& v) {
          t.*field = v.number;
        })};
  };
  return {
      {"sensor_gain", ValueType::Numbers, "", 0, 10, "", "", "factor per proximity sensor, from sensor 0 on",
       into<V>([](V& t, const Value& v) { t.sensor_gain = v.numbers; })},
      {"sensor_offset", ValueType::Numbers, "counts", -4095, 4095, "", "", "added per proximity sensor",
       into<V>([](V& t, const Value& v) { t.sensor_offset_counts = v.numbers; })},
      number("left_wheel", "", 0.5, 2, "1", "true over nominal size of the left wheel", &V::left_wheel_ratio),
      number("right_wheel", "", 0.5, 2, "1", "true over nominal size of the right wheel",
             &V::right_wheel_ratio),
      number("axle", "", 0.5, 2, "1", "effective over nominal distance of the wheels", &V::axle_ratio),
      number("clock_ppm", "ppm", -10000, 10000, "0", "error of the robot's clock; positive is fast",
             &V::clock_ppm),
      number("boot_delay", "s", 0, 3600, "0", "from the world's beginning to the robot's first instruction",
             &V::boot_delay_s),
      number("gain_spread", "", 0, 1, "0", "standard deviation of a further factor per sensor",
             &V::gain_spread),
      number("offset_spread", "counts", 0, 1000, "0", "standard deviation of a further offset per sensor",
             &V::offset_spread_counts),
      number("wheel_spread", "", 0, 0.2, "0", "standard deviation of a further factor per wheel",
             &V::wheel_spread),
      number("axle_spread", "", 0, 0.2, "0", "standard deviation of a further factor on the axle",
             &V::axle_spread),
      number("clock_spread", "ppm", 0, 1000, "0", "standard deviation of a further clock error",
             &V::clock_spread_ppm),
      number("boot_spread", "s", 0, 3600, "0", "the boot delay grows by a random time from 0 to this",
             &V::boot_spread_s),
      {"acc_offset", ValueType::Triple, "m/s2", -20, 20, "", "[0, 0, 0]",
       "added to what the accelerometer feels: forward, left, up", into<V>([](V& t, const Value& v) {
         t.acc_offset_m_s2 = {v.numbers[0], v.numbers[1], v.numbers[2]};
       })},
      number("acc_offset_spread", "m/s2", 0, 20, "0", "standard deviation of a further offset per axis",
             &V::acc_offset_spread_m_s2),
      {"gyro_offset", ValueType::Triple, "deg/s", -250, 250, "", "[0, 0, 0]",
       "added to what the gyroscope feels about these axes", into<V>([](V& t, const Value& v) {
         t.gyro_offset_rad_s = {radians(v.numbers[0]), radians(v.numbers[1]), radians(v.numbers[2])};
       })},
      {"gyro_offset_spread", ValueType::Number, "deg/s", 0, 250, "", "0",
       "standard deviation of a further offset per axis",
       into<V>([](V& t, const Value& v) { t.gyro_offset_spread_rad_s = radians(v.number); })},
      number("motion_noise", "", 0, 100, "1", "factor on the noise of accelerometer and gyroscope; 0 = none",
             &V::motion_noise_scale),
  };
}

std::vector<SectionSpec> make_schema() {
  std::vector<SectionSpec> s;
  const auto section = [&](const char* path, bool many, const char* doc, std::vector<KeySpec> keys) {
    s.push_back({path, many, doc, std::move(keys)});
  };
  using W = WorldDesc;

  section("", false, "The file itself.",
          {
              {"twinpuck", ValueType::Integer, "", kWorldFormatVersion, kWorldFormatVersion, "", "required",
               "version of this format", into<W>([](W&, const Value&) {})},
              {"title", ValueType::Text, "", 0, 0, "", "\"\"", "shown in pictures and lists",
               into<W>([](W& w, const Value& v) { w.title = v.text; })},
          });
  section(
      "world", false, "Physics and chance.",
      {
          {"physics_hz", ValueType::Integer, "Hz", 32, 4096, "", "512",
           "ticks per second; must divide 14,745,600: 96, 128, 256, 512, 1024 and others",
           checked<W>([](W& w, const Value& v, const WorldDesc&) {
             if (kClicksPerSecond % v.integer != 0) {
               return fmt::format("got {} Hz, expected a divisor of {} such as 96, 128, 256, 512, 1024",
                                  v.integer, kClicksPerSecond);
             }
             w.physics_hz = static_cast<int>(v.integer);
             return std::string();
           })},
          {"engine", ValueType::Choice, "", 0, 0, "dynamic|kinematic|planar", "\"dynamic\"",
           "dynamic: traction, slip, pushing, falling; kinematic: no forces, robots stop at contacts; "
           "planar: two dimensions, wheels never slip, movable objects are pushed, no heights (worlds.md)",
           into<W>([](W& w, const Value& v) {
             w.engine = v.text == "dynamic"     ? Engine::Dynamic
                        : v.text == "kinematic" ? Engine::Kinematic
                                                : Engine::Planar;
           })},
          {"gravity", ValueType::Number, "m/s2", 0.01, 100, "", "9.81", "downwards",
           into<W>([](W& w, const Value& v) { w.gravity_m_s2 = v.number; })},
          {"seed", ValueType::Integer, "", 0, 9e18, "", "1", "of all that is left to chance",
           into<W>([](W& w, const Value& v) { w.seed = static_cast<std::uint64_t>(v.integer); })},
          {"ambient", ValueType::Number, "W/m2", 0, 10000, "", "0",
           "light that reaches every sensor from everywhere",
           into<W>([](W& w, const Value& v) { w.ambient_w_m2 = v.number; })},
      });
  for (KeySpec& k : wheel_keys<W>("0", "\"uniform\"")) s.back().keys.push_back(std::move(k));
  using M = Material;
  section("material", true, "How a surface looks and feels. Walls and objects refer to it by name.",
          {
              {"name", ValueType::Text, "", 0, 0, "", "required", "what others write in `material`",
               into<M>([](M& m, const Value& v) { m.name = v.text; })},
              {"colour", ValueType::Colour, "", 0, 1, "", "[1, 1, 1]", "red, green, blue",
               into<M>([](M& m, const Value& v) { m.colour = colour_of(v); })},
              {"ir_reflectance", ValueType::Number, "", 0, 1, "", "",
               "what proximity sensors take for red; without it the red part of the colour",
               into<M>([](M& m, const Value& v) { m.ir_reflectance = v.number; })},
              {"roughness", ValueType::Number, "", 0, 1, "", "0",
               "0 mirror to 1 matt; only the new colour rule asks for it",
               into<M>([](M& m, const Value& v) { m.roughness = v.number; })},
              {"friction", ValueType::Number, "", 0, 10, "", "0.3", "Coulomb coefficient of the sides",
               into<M>([](M& m, const Value& v) { m.friction = v.number; })},
              {"restitution", ValueType::Number, "", 0, 1, "", "0", "bounce",
               into<M>([](M& m, const Value& v) { m.restitution = v.number; })},
          });
  using A = ArenaDesc;
  std::vector<KeySpec> arena{
      {"size", ValueType::Pair, "m", 0.01, kFar, "", "required", "inside measures along x and y",
       into<A>([](A& a, const Value& v) {
         a.size_m = {v.numbers[0], v.numbers[1]};
       })},
      {"centre", ValueType::Pair, "m", -kFar, kFar, "", "[0, 0]", "where its middle lies",
       into<A>([](A& a, const Value& v) {
         a.centre_m = {v.numbers[0], v.numbers[1]};
       })},
      {"wall_height", ValueType::Number, "m", 0, kFar, "", "0.1", "0 leaves the arena without walls",
       into<A>([](A& a, const Value& v) { a.wall_height_m = v.number; })},
      {"wall_thickness", ValueType::Number, "m", kThin, 10, "", "0.01", "",
       into<A>([](A& a, const Value& v) { a.wall_thickness_m = v.number; })},
  };
  for (KeySpec& k : material_keys<A>()) arena.push_back(std::move(k));
  section("arena", false, "A rectangle with four walls. Without it the floor is endless.", std::move(arena));
  using F = FloorDesc;
  section("floor", false, "What robots drive on.",
          {
              {"colour", ValueType::Colour, "", 0, 1, "", "[0.93, 0.93, 0.9]", "red, green, blue",
               into<F>([](F& f, const Value& v) { f.colour = colour_of(v); })},
              {"ir_reflectance", ValueType::Number, "", 0, 1, "", "", "without it the red part of the colour",
               into<F>([](F& f, const Value& v) { f.ir_reflectance = v.number; })},
              {"image", ValueType::Text, "", 0, 0, "", "",
               "PNG file stretched over the arena, north up; relative to this file",
               into<F>([](F& f, const Value& v) { f.image = v.text; })},
              {"friction", ValueType::Number, "", 0, 10, "", "1", "factor on the traction of wheels",
               into<F>([](F& f, const Value& v) { f.friction = v.number; })},
              {"tilt", ValueType::Pair, "deg", -40, 40, "", "[0, 0]",
               "the whole floor, with all that stands on it, rises by these angles along +x and along +y",
               into<F>([](F& f, const Value& v) {
                 f.tilt_x_rad = radians(v.numbers[0]), f.tilt_y_rad = radians(v.numbers[1]);
               })},
          });
  for (SectionSpec& camera : camera_sections()) s.push_back(std::move(camera));
  s.push_back(ramp_section());
  using L = WallDesc;
  std::vector<KeySpec> wall{
      {"points", ValueType::Points, "m", -kFar, kFar, "", "required",
       "corners of the middle line, two or more", checked<L>([](L& w, const Value& v, const WorldDesc&) {
         w.points_m = points_of(v);
         if (w.points_m.size() < 2)
           return fmt::format("got {} point(s), expected at least 2", w.points_m.size());
         for (std::size_t i = 1; i < w.points_m.size(); ++i) {
           if (length(w.points_m[i] - w.points_m[i - 1]) < kThin) {
             return fmt::format("got points {} and {} at the same place, expected at least {} m between them",
                                i - 1, i, kThin);
           }
         }
         return std::string();
       })},
      {"closed", ValueType::Flag, "", 0, 0, "", "false", "true: the last point joins the first",
       checked<L>([](L& w, const Value& v, const WorldDesc&) {
         w.closed = v.flag;
         if (v.flag && (w.points_m.size() < 3 || length(w.points_m.back() - w.points_m.front()) < kThin)) {
           return std::string("got true, expected three or more points, the last not on the first");
         }
         return std::string();
       })},
      {"thickness", ValueType::Number, "m", kThin, 10, "", "0.01", "",
       into<L>([](L& w, const Value& v) { w.thickness_m = v.number; })},
      {"height", ValueType::Number, "m", kThin, kFar, "", "0.1", "",
       into<L>([](L& w, const Value& v) { w.height_m = v.number; })},
      {"z", ValueType::Number, "m", 0, kFar, "", "0", "height of its underside: a gate robots pass under",
       into<L>([](L& w, const Value& v) { w.z_m = v.number; })},
  };
  for (KeySpec& k : material_keys<L>()) wall.push_back(std::move(k));
  section("wall", true, "A line of walls with square corners.", std::move(wall));

  using O = ObjectDesc;
  const KeySpec height{
      "height", ValueType::Number, "m", kThin, kFar, "", "0.1", "", into<O>([](O& o, const Value& v) {
        o.size_m.z = v.number;
      })};
  const KeySpec radius{
      "radius", ValueType::Number, "m", kThin, kFar, "", "required", "", into<O>([](O& o, const Value& v) {
        o.radius_m = v.number;
      })};
  section(
      "box", true, "A block.",
      object_keys<O>(ObjectKind::Box, {{"size", ValueType::Triple, "m", kThin, kFar, "", "[0.1, 0.1, 0.1]",
                                        "along x, y and z", into<O>([](O& o, const Value& v) {
                                          o.size_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
                                        })}}));
  section("cylinder", true, "An upright cylinder.", object_keys<O>(ObjectKind::Cylinder, {radius, height}));
  section("ball", true, "A ball.",
          object_keys<O>(
              ObjectKind::Ball,
              {radius,
               {"rolling_friction", ValueType::Number, "", 0, 10, "", "0.02",
                "of a movable one: what slows it as it rolls, as a part of its weight; counts instead of "
                "`friction`",
                into<O>([](O& o, const Value& v) { o.rolling_friction = v.number; })}}));
  section("polygon", true, "An upright prism over a convex outline.",
          object_keys<O>(
              ObjectKind::Polygon,
              {{"points", ValueType::Points, "m", -kFar, kFar, "", "required",
                "corners of a convex outline, 3 to 64, around `position` before it is turned by `heading`",
                checked<O>([](O& o, const Value& v, const WorldDesc&) {
                  o.corners_m = points_of(v);
                  if (o.corners_m.size() < 3 || o.corners_m.size() > 64) {
                    return fmt::format("got {} points, expected 3 to 64", o.corners_m.size());
                  }
                  if (!is_convex(o.corners_m)) {
                    return std::string(
                        "got a shape that is not convex, expected corners that all turn the same way; "
                        "build other shapes of several polygons");
                  }
                  return std::string();
                })},
               height}));
  using P = LampDesc;
  section(
      "lamp", true, "A point light. Bodies cast shadows.",
      {
          {"name", ValueType::Text, "", 0, 0, "", "", "",
           into<P>([](P& p, const Value& v) { p.name = v.text; })},
          {"position", ValueType::Triple, "m", -kFar, kFar, "", "required", "x, y and z",
           into<P>([](P& p, const Value& v) {
             p.position_m = {v.numbers[0], v.numbers[1], v.numbers[2]};
           })},
          {"intensity", ValueType::Number, "W/m2", 0, 10000, "", "1",
           "on a surface that faces it, before attenuation",
           into<P>([](P& p, const Value& v) { p.intensity_w_m2 = v.number; })},
          {"attenuation", ValueType::Triple, "1, 1/m, 1/m2", 0, 1e6, "", "[1, 0, 0]",
           "a, b, c: light at d metres is divided by a + b d + c d2",
           checked<P>([](P& p, const Value& v, const WorldDesc&) {
             if (v.numbers[0] + v.numbers[1] + v.numbers[2] <= 0) {
               return std::string("got [0, 0, 0], expected at least one number above 0");
             }
             p.attenuation = {v.numbers[0], v.numbers[1], v.numbers[2]};
             return std::string();
           })},
          {"colour", ValueType::Colour, "", 0, 1, "", "[1, 1, 1]", "red, green, blue; sensors see the mean",
           into<P>([](P& p, const Value& v) { p.colour = colour_of(v); })},
          {"on", ValueType::Flag, "", 0, 0, "", "true", "",
           into<P>([](P& p, const Value& v) { p.on = v.flag; })},
          node_key<P>(),
      });
  for (SectionSpec& spec : sound_sections()) s.push_back(std::move(spec));
  section("proximity", false,
          "Proximity sensors of all robots. `[robot.proximity]` and `[[robot.sensor]]` take the same keys "
          "for one robot "
          "and one sensor; the nearest setting counts.",
          proximity_keys<ProximitySettings>([](ProximitySettings& p) -> ProximitySettings& { return p; }));

  add_radio_sections(s);
  s.push_back(webots_section());

  using R = RobotDesc;
  section(
      "robot", true, "A robot.",
      {
          {"name", ValueType::Text, "", 0, 0, "", "\"robotN\"", "N counts from 0; names differ",
           checked<R>([](R& r, const Value& v, const WorldDesc&) {
             if (v.text.empty() || v.text.find_first_of(",\"\n\r=") != std::string::npos) {
               return fmt::format("got \"{}\", expected a name without comma, quote, = or line break",
                                  v.text);
             }
             r.name = v.text;
             return std::string();
           })},
          def_key<R>(),
          {"model", ValueType::Text, "", 0, 0, "", "", "kind of robot; the first that the program knows",
           checked<R>([](R& r, const Value& v, const WorldDesc& d) {
             r.model = v.text;
             std::string known;
             for (const RobotModel& m : d.models) known += (known.empty() ? "" : ", ") + m.name;
             return d.model_of(r) ? std::string()
                                  : fmt::format("got \"{}\", expected one of the models: {}", v.text, known);
           })},
          {"firmware", ValueType::Text, "", 0, 0, "", "\"\"",
           "controller by name, or a file relative to this one",
           into<R>([](R& r, const Value& v) { r.firmware = v.text; })},
          {"args", ValueType::Text, "", 0, 0, "", "\"\"",
           "what a controller that runs on the PC gets as its arguments: words between blanks, `'two words'` "
           "in quotes; firmware has none",
           into<R>([](R& r, const Value& v) { r.args = v.text; })},
          {"supervisor", ValueType::Flag, "", 0, 0, "", "false",
           "its controller, which runs on the PC, may do what supervisors may (docs/connecting.md)",
           into<R>([](R& r, const Value& v) { r.supervisor = v.flag; })},
          custom_data_key<R>(),
          {"position", ValueType::Pair, "m", -kFar, kFar, "", "[0, 0]",
           "x and y of the middle between its wheels",
           into<R>([](R& r, const Value& v) { r.pose.x_m = v.numbers[0], r.pose.y_m = v.numbers[1]; })},
          {"heading", ValueType::Number, "deg", -kMany, kMany, "", "0", "counter-clockwise from +x",
           into<R>([](R& r, const Value& v) { r.pose.heading_rad = radians(v.number); })},
          {"seed", ValueType::Integer, "", 0, 9e18, "", "",
           "its own seed; otherwise made of the world's seed and its number",
           into<R>([](R& r, const Value& v) { r.seed = static_cast<std::uint64_t>(v.integer); })},
          {"battery", ValueType::Number, "V", 2.5, 5, "", "",
           "voltage at the beginning, only the electronics being on; the model's otherwise",
           into<R>([](R& r, const Value& v) { r.battery_v = v.number; })},
          {"battery_wh", ValueType::Number, "Wh", 1e-3, 1000, "", "",
           "energy of its battery when full; the model's otherwise",
           into<R>([](R& r, const Value& v) { r.battery_wh = v.number; })},
          {"colour", ValueType::Colour, "", 0, 1, "", "", "of the body; the model's otherwise",
           into<R>([](R& r, const Value& v) { r.colour = colour_of(v); })},
          {"uart1", ValueType::Text, "", 0, 0, "", "\"-\"",
           "- (text is shown on the terminal), none, pty, pty:LINK, tcp:PORT or file:PATH",
           checked<R>([](R& r, const Value& v, const WorldDesc&) { return uart_text(v, r.uart1); })},
          {"uart2", ValueType::Text, "", 0, 0, "", "\"none\"",
           "none, -, pty, pty:LINK, tcp:PORT or file:PATH",
           checked<R>([](R& r, const Value& v, const WorldDesc&) { return uart_text(v, r.uart2); })},
      });
  for (KeySpec& key : wheel_keys<R>("", "")) s.back().keys.push_back(std::move(key));
  s.back().keys.push_back(recognition_key<R>());
  s.back().keys.push_back(node_key<R>());
  section("robot.variation", false, "How this robot differs from its model.", variation_keys());
  section("robot.proximity", false, "Proximity sensors of this robot; keys as in `[proximity]`.",
          proximity_keys<ProximitySettings>([](ProximitySettings& p) -> ProximitySettings& { return p; }));
  std::vector<KeySpec> sensor{
      {"index", ValueType::Integer, "", 0, 63, "", "required", "which sensor",
       into<SensorDesc>([](SensorDesc& t, const Value& v) { t.index = static_cast<int>(v.integer); })}};
  for (KeySpec& k :
       proximity_keys<SensorDesc>([](SensorDesc& t) -> ProximitySettings& { return t.proximity; })) {
    sensor.push_back(std::move(k));
  }
  section("robot.sensor", true, "One proximity sensor of this robot; keys as in `[proximity]`.",
          std::move(sensor));
  add_robot_link_section(s);
  section("robot.part", true,
          "Something plugged into this robot, such as a turret or a sensor board. The other keys depend on "
          "the kind.",
          {{"kind", ValueType::Text, "", 0, 0, "", "required", "which part",
            into<PartDesc>([](PartDesc& p, const Value& v) { p.kind = v.text; })}});
  s.push_back(remote_key_section());
  s.push_back(robot_device_section());
  s.push_back(supervisor_section());
  s.push_back(supervisor_device_section());
  return s;
}

}  // namespace

const std::vector<SectionSpec>& world_schema() {
  static const std::vector<SectionSpec> schema = make_schema();
  return schema;
}

const SectionSpec& section(const std::string& path) {
  for (const SectionSpec& s : world_schema()) {
    if (path == s.path) return s;
  }
  CHECK(false, "no such section in the schema");
  return world_schema().front();
}

}  // namespace sim
