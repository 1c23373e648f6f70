// SPDX-License-Identifier: MIT
// Each key of a world file arrives where it belongs, in SI units, and what is not written has the value that docs/worlds.md
// says: keys/*.txt were worked out by hand from keys/*.toml and that page.
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "sim_core/load/schema.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

/// A world's description, a line a field.
class Told {
 public:
  std::string text;

  /// `names`: of the values, with blanks between.
  template <typename... T>
  void fields(const std::string& before, const std::string& names, const T&... values) {
    std::istringstream in(names);
    std::string name;
    (((in >> name), (*this)(before + name, values)), ...);
  }

  void operator()(const std::string& name, const std::string& value) { text += name + " '" + value + "'\n"; }
  void operator()(const std::string& name, double value) { text += fmt::format("{} {:.6g}\n", name, value); }
  void operator()(const std::string& name, const sim::Vec2& v) {
    text += fmt::format("{} {:.6g} {:.6g}\n", name, v.x, v.y);
  }
  void operator()(const std::string& name, const sim::Vec3& v) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}\n", name, v.x, v.y, v.z);
  }
  void operator()(const std::string& name, const sim::Colour& c) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}\n", name, c.r, c.g, c.b);
  }
  void operator()(const std::string& name, const sim::Pose2& p) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}\n", name, p.x_m, p.y_m, p.heading_rad);
  }
  void operator()(const std::string& name, const sim::ResponseRow& r) {
    text += fmt::format("{} {:.6g} {:.6g} {:.6g}\n", name, r.distance_m, r.value, r.relative_noise);
  }
  void operator()(const std::string& name, const sim::Dropout& d) {
    text += fmt::format("{} {:.6g} {:.6g}\n", name, d.begin_s, d.span_s);
  }
  template <typename T, std::enable_if_t<std::is_enum_v<T>, int> = 0>
  void operator()(const std::string& name, T value) {
    (*this)(name, static_cast<double>(value));
  }
  template <typename T>
  void operator()(const std::string& name, const std::optional<T>& value) {
    if (value) (*this)(name, *value);
  }
  template <typename T>
  void operator()(const std::string& name, const std::vector<T>& values) {
    for (const T& value : values) (*this)(name, value);
  }
  template <std::size_t N>
  void operator()(const std::string& name, const std::array<double, N>& values) {
    for (const double value : values) (*this)(name, value);
  }
  void operator()(const std::string& name, const sim::Material& m) {
    fields(name + ".", "name colour ir_reflectance roughness friction restitution", m.name, m.colour,
           m.ir_reflectance, m.roughness, m.friction, m.restitution);
  }
  void operator()(const std::string& name, const sim::WheelSettings& w) {
    fields(name + ".", "noise noise_law slip", w.noise, w.noise_law, w.slip);
  }
  void operator()(const std::string& name, const sim::ProximitySettings& p) {
    fields(name + ".",
           "profile table type rays aperture_rad gaussian_width layout colour_rule noise_law noise_scale",
           p.profile, p.table, p.type, p.rays, p.aperture_rad, p.gaussian_width, p.layout, p.colour_rule,
           p.noise_law, p.noise_scale);
  }
  void operator()(const std::string& name, const sim::DeviceDesc& d) {
    fields(name + ".",
           "name kind channel range_m baud_rate_bit_s infra_red width height at_m heading_rad fov_rad "
           "vertical_fov_rad near_m far_m table rays aperture_rad",
           d.name, d.kind, d.channel, d.range_m, d.baud_rate_bit_s, d.infra_red, d.width, d.height, d.at_m,
           d.heading_rad, d.fov_rad, d.vertical_fov_rad, d.near_m, d.far_m, d.table, d.rays, d.aperture_rad);
  }
  void operator()(const std::string& name, const sim::ObjectDesc& o) {
    fields(name + ".",
           "kind name def size_m radius_m corners_m pose z_m movable mass_kg floor_friction rolling_friction "
           "material model recognition_colours node",
           o.kind, o.name, o.def, o.size_m, o.radius_m, o.corners_m, o.pose, o.z_m, o.movable, o.mass_kg,
           o.floor_friction, o.rolling_friction, o.material, o.model, o.recognition_colours, o.node);
  }
  void operator()(const std::string& name, const sim::Variation& v) {
    fields(name + ".",
           "sensor_gain sensor_offset_counts left_wheel_ratio right_wheel_ratio axle_ratio clock_ppm "
           "boot_delay_s gain_spread offset_spread_counts wheel_spread axle_spread clock_spread_ppm "
           "boot_spread_s acc_offset_m_s2 gyro_offset_rad_s acc_offset_spread_m_s2 gyro_offset_spread_rad_s "
           "motion_noise_scale",
           v.sensor_gain, v.sensor_offset_counts, v.left_wheel_ratio, v.right_wheel_ratio, v.axle_ratio,
           v.clock_ppm, v.boot_delay_s, v.gain_spread, v.offset_spread_counts, v.wheel_spread, v.axle_spread,
           v.clock_spread_ppm, v.boot_spread_s, v.acc_offset_m_s2, v.gyro_offset_rad_s,
           v.acc_offset_spread_m_s2, v.gyro_offset_spread_rad_s, v.motion_noise_scale);
  }
  void operator()(const std::string& name, const sim::SoundDesc& s) {
    fields(name + ".",
           "name kind position_m level_db pressure_pa frequency_hz band_hz file loop times_s every_s "
           "jitter_s seed start_s stop_s",
           s.name, s.kind, s.position_m, s.level_db, s.pressure_pa, s.frequency_hz, s.band_hz, s.file, s.loop,
           s.times_s, s.every_s, s.jitter_s, s.seed, s.start_s, s.stop_s);
  }
  void operator()(const std::string& name, const sim::WallDesc& w) {
    fields(name + ".", "points_m closed thickness_m height_m z_m material", w.points_m, w.closed,
           w.thickness_m, w.height_m, w.z_m, w.material);
  }
  void operator()(const std::string& name, const sim::RampDesc& r) {
    fields(name + ".", "name pose size_m low_m high_m material", r.name, r.pose, r.size_m, r.low_m, r.high_m,
           r.material);
  }
  void operator()(const std::string& name, const sim::LampDesc& l) {
    fields(name + ".", "name position_m intensity_w_m2 attenuation colour on node", l.name, l.position_m,
           l.intensity_w_m2, l.attenuation, l.colour, l.on, l.node);
  }
  void operator()(const std::string& name, const sim::ArenaDesc& a) {
    fields(name + ".", "size_m centre_m wall_height_m wall_thickness_m material", a.size_m, a.centre_m,
           a.wall_height_m, a.wall_thickness_m, a.material);
  }
  void operator()(const std::string& name, const sim::SensorDesc& s) {
    (*this)(name + ".index", s.index);
    (*this)(name, s.proximity);
  }
  void operator()(const std::string& name, const sim::KeyDesc& k) {
    fields(name + ".", "code at_s hold_s address", k.code, k.at_s, k.hold_s, k.address);
  }
  void operator()(const std::string& name, const sim::RobotDesc& r) {
    fields(name + ".",
           "name def model firmware args supervisor custom_data recognition_colours node selector pose seed "
           "battery_v battery_wh colour wheels uart1 uart2 link.number link.name link.pin link.dropouts "
           "variation proximity sensors keys devices",
           r.name, r.def, r.model, r.firmware, sim::argument_words(r.args), r.supervisor, r.custom_data,
           r.recognition_colours, r.node,
           static_cast<double>(sim::OwnSettings(puck().keys, r.own).integer("selector")), r.pose, r.seed,
           r.battery_v, r.battery_wh, r.colour, r.wheels, r.uart1, r.uart2, r.link.number, r.link.name,
           r.link.pin, r.link.dropouts, r.variation, r.proximity, r.sensors, r.keys, r.devices);
  }
  void operator()(const std::string& name, const sim::SupervisorDesc& s) {
    fields(name + ".", "name program args def custom_data devices node", s.name, s.program, s.args, s.def,
           s.custom_data, s.devices, s.node);
  }
  void operator()(const sim::WorldDesc& w) {
    fields("",
           "title physics_hz engine gravity_m_s2 seed ambient_w_m2 wheels materials arena floor.colour "
           "floor.ir_reflectance floor.image floor.friction floor.tilt_x_rad floor.tilt_y_rad sky.colour "
           "sky.light_w_m2 ramp wall object lamp sound proximity radio.model radio.range_m radio.exponent "
           "radio.fading_db radio.loss radio.capture_db radio.carrier_sense radio.seed link.range_m "
           "link.latency_s link.bandwidth_bit_s link.timeout_s link.dropouts link.dropout_rate_hz "
           "link.dropout_span_s webots.time_step_s webots.speed_unit_rad_s webots.sensor_order webots.axes "
           "webots.world webots.floor_m robot supervisor",
           w.title, w.physics_hz, w.engine, w.gravity_m_s2, w.seed, w.ambient_w_m2, w.wheels, w.materials,
           w.arena, w.floor.colour, w.floor.ir_reflectance, w.floor.image, w.floor.friction,
           w.floor.tilt_x_rad, w.floor.tilt_y_rad, w.sky.colour, w.sky.light_w_m2, w.ramps, w.walls,
           w.objects, w.lamps, w.sounds, w.proximity, w.radio.model, w.radio.range_m, w.radio.exponent,
           w.radio.fading_db, w.radio.loss, w.radio.capture_db, w.radio.carrier_sense, w.radio.seed,
           w.link.range_m, w.link.latency_s, w.link.bandwidth_bit_s, w.link.timeout_s, w.link.dropouts,
           w.link.dropout_rate_hz, w.link.dropout_span_s, w.webots.time_step_s, w.webots.speed_unit_rad_s,
           w.webots.sensor_order, w.webots.axes, w.webots.world, w.webots.floor_m, w.robots, w.supervisors);
  }
};

const std::string kFolder = TWINPUCK_SOURCE_DIR "/tests/sim_core/keys/";

TEST(Keys, arrive_where_they_belong_and_have_the_default_that_is_documented) {
  for (const std::string name : {"every_key", "no_key"}) {
    const auto loaded =
        sim::parse_world(text_of(kFolder + name + ".toml"), kFolder + name + ".toml", {puck()});
    ASSERT_TRUE(loaded.world) << loaded.report(name);
    Told told;
    told(*loaded.world);
    const std::string kept = testing::TempDir() + name + ".txt";
    if (told.text != text_of(kFolder + name + ".txt")) std::ofstream(kept) << told.text;
    EXPECT_EQ(told.text, text_of(kFolder + name + ".txt")) << "read what has changed, and copy " << kept;
  }
}

TEST(Keys, are_all_in_the_file_that_has_every_key) {
  const std::string text = text_of(kFolder + "every_key.toml");
  for (const sim::SectionSpec& section : sim::world_schema()) {
    const std::string path = section.path;
    const std::string head = path.empty() ? "" : section.many ? "\n[[" + path + "]]\n" : "\n[" + path + "]\n";
    if (path == "robot.part") continue;  // of models that know some
    std::string inside;                  // of all sections of that name
    for (std::size_t at = text.find(head); at != std::string::npos; at = text.find(head, at + 1))
      inside += text.substr(at + head.size(), text.find("\n[", at + head.size()) - at - head.size()) + "\n";
    for (const sim::KeySpec& key : section.keys) {
      if (path == "robot.sensor" && std::string(key.key) != "index" && std::string(key.key) != "rays")
        continue;  // as [proximity]
      const std::string is_kind = path == "robot.proximity" ? "aperture_rad" : "aperture";
      if (std::string(key.key).rfind("aperture", 0) == 0 && path.find("proximity") != std::string::npos &&
          key.key != is_kind)
        continue;
      EXPECT_NE(("\n" + inside).find("\n" + std::string(key.key) + " = "), std::string::npos)
          << path << ": " << key.key;
    }
  }
}

}  // namespace
