// SPDX-License-Identifier: MIT
// Each key of a world file arrives where it belongs, in SI units, and what is not written has the value that docs/worlds.md
// says: keys/*.txt were worked out by hand from keys/*.toml and that page.
#include <fmt/format.h>

#include <fstream>
#include <set>

#include "sim_core/load/schema.h"
#include "tests/sim_core/fixture.h"
#include "twinpuck_paths.h"

using namespace sim_test;

namespace {

/// A world's description, a line a field.
class Told {
 public:
  std::string text;

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
    (*this)(name + ".name", m.name);
    (*this)(name + ".colour", m.colour);
    (*this)(name + ".ir_reflectance", m.ir_reflectance);
    (*this)(name + ".roughness", m.roughness);
    (*this)(name + ".friction", m.friction);
    (*this)(name + ".restitution", m.restitution);
  }
  void operator()(const std::string& name, const sim::WheelSettings& w) {
    (*this)(name + ".noise", w.noise);
    (*this)(name + ".noise_law", w.noise_law);
    (*this)(name + ".slip", w.slip);
  }
  void operator()(const std::string& name, const sim::ProximitySettings& p) {
    (*this)(name + ".profile", p.profile);
    (*this)(name + ".table", p.table);
    (*this)(name + ".type", p.type);
    (*this)(name + ".rays", p.rays);
    (*this)(name + ".aperture_rad", p.aperture_rad);
    (*this)(name + ".gaussian_width", p.gaussian_width);
    (*this)(name + ".layout", p.layout);
    (*this)(name + ".colour_rule", p.colour_rule);
    (*this)(name + ".noise_law", p.noise_law);
    (*this)(name + ".noise_scale", p.noise_scale);
  }
  void operator()(const std::string& name, const sim::DeviceDesc& d) {
    (*this)(name + ".name", d.name);
    (*this)(name + ".kind", d.kind);
    (*this)(name + ".channel", d.channel);
    (*this)(name + ".range_m", d.range_m);
    (*this)(name + ".baud_rate_bit_s", d.baud_rate_bit_s);
    (*this)(name + ".infra_red", d.infra_red);
    (*this)(name + ".width", d.width);
    (*this)(name + ".height", d.height);
    (*this)(name + ".at_m", d.at_m);
    (*this)(name + ".heading_rad", d.heading_rad);
    (*this)(name + ".fov_rad", d.fov_rad);
    (*this)(name + ".vertical_fov_rad", d.vertical_fov_rad);
    (*this)(name + ".near_m", d.near_m);
    (*this)(name + ".far_m", d.far_m);
    (*this)(name + ".table", d.table);
    (*this)(name + ".rays", d.rays);
    (*this)(name + ".aperture_rad", d.aperture_rad);
  }
  void operator()(const std::string& name, const sim::ObjectDesc& o) {
    (*this)(name + ".kind", o.kind);
    (*this)(name + ".name", o.name);
    (*this)(name + ".def", o.def);
    (*this)(name + ".size_m", o.size_m);
    (*this)(name + ".radius_m", o.radius_m);
    (*this)(name + ".corners_m", o.corners_m);
    (*this)(name + ".pose", o.pose);
    (*this)(name + ".z_m", o.z_m);
    (*this)(name + ".movable", o.movable);
    (*this)(name + ".mass_kg", o.mass_kg);
    (*this)(name + ".floor_friction", o.floor_friction);
    (*this)(name + ".rolling_friction", o.rolling_friction);
    (*this)(name + ".material", o.material);
    (*this)(name + ".model", o.model);
    (*this)(name + ".recognition_colours", o.recognition_colours);
    (*this)(name + ".node", o.node);
  }
  void operator()(const std::string& name, const sim::Variation& v) {
    (*this)(name + ".sensor_gain", v.sensor_gain);
    (*this)(name + ".sensor_offset_counts", v.sensor_offset_counts);
    (*this)(name + ".left_wheel_ratio", v.left_wheel_ratio);
    (*this)(name + ".right_wheel_ratio", v.right_wheel_ratio);
    (*this)(name + ".axle_ratio", v.axle_ratio);
    (*this)(name + ".clock_ppm", v.clock_ppm);
    (*this)(name + ".boot_delay_s", v.boot_delay_s);
    (*this)(name + ".gain_spread", v.gain_spread);
    (*this)(name + ".offset_spread_counts", v.offset_spread_counts);
    (*this)(name + ".wheel_spread", v.wheel_spread);
    (*this)(name + ".axle_spread", v.axle_spread);
    (*this)(name + ".clock_spread_ppm", v.clock_spread_ppm);
    (*this)(name + ".boot_spread_s", v.boot_spread_s);
    (*this)(name + ".acc_offset_m_s2", v.acc_offset_m_s2);
    (*this)(name + ".gyro_offset_rad_s", v.gyro_offset_rad_s);
    (*this)(name + ".acc_offset_spread_m_s2", v.acc_offset_spread_m_s2);
    (*this)(name + ".gyro_offset_spread_rad_s", v.gyro_offset_spread_rad_s);
    (*this)(name + ".motion_noise_scale", v.motion_noise_scale);
  }
  void operator()(const std::string& name, const sim::SoundDesc& s) {
    (*this)(name + ".name", s.name);
    (*this)(name + ".kind", s.kind);
    (*this)(name + ".position_m", s.position_m);
    (*this)(name + ".level_db", s.level_db);
    (*this)(name + ".pressure_pa", s.pressure_pa);
    (*this)(name + ".frequency_hz", s.frequency_hz);
    (*this)(name + ".band_hz", s.band_hz);
    (*this)(name + ".file", s.file);
    (*this)(name + ".loop", s.loop);
    (*this)(name + ".times_s", s.times_s);
    (*this)(name + ".every_s", s.every_s);
    (*this)(name + ".jitter_s", s.jitter_s);
    (*this)(name + ".seed", s.seed);
    (*this)(name + ".start_s", s.start_s);
    (*this)(name + ".stop_s", s.stop_s);
  }
  void operator()(const std::string& name, const sim::WallDesc& w) {
    (*this)(name + ".points_m", w.points_m);
    (*this)(name + ".closed", w.closed);
    (*this)(name + ".thickness_m", w.thickness_m);
    (*this)(name + ".height_m", w.height_m);
    (*this)(name + ".z_m", w.z_m);
    (*this)(name + ".material", w.material);
  }
  void operator()(const std::string& name, const sim::RampDesc& r) {
    (*this)(name + ".name", r.name);
    (*this)(name + ".pose", r.pose);
    (*this)(name + ".size_m", r.size_m);
    (*this)(name + ".low_m", r.low_m);
    (*this)(name + ".high_m", r.high_m);
    (*this)(name + ".material", r.material);
  }
  void operator()(const std::string& name, const sim::LampDesc& l) {
    (*this)(name + ".name", l.name);
    (*this)(name + ".position_m", l.position_m);
    (*this)(name + ".intensity_w_m2", l.intensity_w_m2);
    (*this)(name + ".attenuation", l.attenuation);
    (*this)(name + ".colour", l.colour);
    (*this)(name + ".on", l.on);
    (*this)(name + ".node", l.node);
  }
  void operator()(const std::string& name, const sim::ArenaDesc& a) {
    (*this)(name + ".size_m", a.size_m);
    (*this)(name + ".centre_m", a.centre_m);
    (*this)(name + ".wall_height_m", a.wall_height_m);
    (*this)(name + ".wall_thickness_m", a.wall_thickness_m);
    (*this)(name + ".material", a.material);
  }
  void operator()(const std::string& name, const sim::SensorDesc& s) {
    (*this)(name + ".index", s.index);
    (*this)(name, s.proximity);
  }
  void operator()(const std::string& name, const sim::KeyDesc& k) {
    (*this)(name + ".code", k.code);
    (*this)(name + ".at_s", k.at_s);
    (*this)(name + ".hold_s", k.hold_s);
    (*this)(name + ".address", k.address);
  }
  void operator()(const std::string& name, const sim::RobotDesc& r) {
    (*this)(name + ".name", r.name);
    (*this)(name + ".def", r.def);
    (*this)(name + ".model", r.model);
    (*this)(name + ".firmware", r.firmware);
    (*this)(name + ".args", sim::argument_words(r.args));
    (*this)(name + ".supervisor", r.supervisor);
    (*this)(name + ".custom_data", r.custom_data);
    (*this)(name + ".recognition_colours", r.recognition_colours);
    (*this)(name + ".node", r.node);
    (*this)(name + ".selector",
            static_cast<double>(sim::OwnSettings(puck().keys, r.own).integer("selector")));
    (*this)(name + ".pose", r.pose);
    (*this)(name + ".seed", r.seed);
    (*this)(name + ".battery_v", r.battery_v);
    (*this)(name + ".battery_wh", r.battery_wh);
    (*this)(name + ".colour", r.colour);
    (*this)(name + ".wheels", r.wheels);
    (*this)(name + ".uart1", r.uart1);
    (*this)(name + ".uart2", r.uart2);
    (*this)(name + ".link.number", r.link.number);
    (*this)(name + ".link.name", r.link.name);
    (*this)(name + ".link.pin", r.link.pin);
    (*this)(name + ".link.dropouts", r.link.dropouts);
    (*this)(name + ".variation", r.variation);
    (*this)(name + ".proximity", r.proximity);
    (*this)(name + ".sensors", r.sensors);
    (*this)(name + ".keys", r.keys);
    (*this)(name + ".devices", r.devices);
  }
  void operator()(const std::string& name, const sim::SupervisorDesc& s) {
    (*this)(name + ".name", s.name);
    (*this)(name + ".program", s.program);
    (*this)(name + ".args", s.args);
    (*this)(name + ".def", s.def);
    (*this)(name + ".custom_data", s.custom_data);
    (*this)(name + ".devices", s.devices);
    (*this)(name + ".node", s.node);
    (*this)(name + ".period_s", s.period_s);
  }
  void operator()(const sim::WorldDesc& w) {
    (*this)("title", w.title);
    (*this)("physics_hz", w.physics_hz);
    (*this)("engine", w.engine);
    (*this)("gravity_m_s2", w.gravity_m_s2);
    (*this)("seed", w.seed);
    (*this)("ambient_w_m2", w.ambient_w_m2);
    (*this)("wheels", w.wheels);
    (*this)("materials", w.materials);
    (*this)("arena", w.arena);
    (*this)("floor.colour", w.floor.colour);
    (*this)("floor.ir_reflectance", w.floor.ir_reflectance);
    (*this)("floor.image", w.floor.image);
    (*this)("floor.friction", w.floor.friction);
    (*this)("floor.tilt_x_rad", w.floor.tilt_x_rad);
    (*this)("floor.tilt_y_rad", w.floor.tilt_y_rad);
    (*this)("sky.colour", w.sky.colour);
    (*this)("sky.light_w_m2", w.sky.light_w_m2);
    (*this)("ramp", w.ramps);
    (*this)("wall", w.walls);
    (*this)("object", w.objects);
    (*this)("lamp", w.lamps);
    (*this)("sound", w.sounds);
    (*this)("proximity", w.proximity);
    (*this)("radio.model", w.radio.model);
    (*this)("radio.range_m", w.radio.range_m);
    (*this)("radio.exponent", w.radio.exponent);
    (*this)("radio.fading_db", w.radio.fading_db);
    (*this)("radio.loss", w.radio.loss);
    (*this)("radio.capture_db", w.radio.capture_db);
    (*this)("radio.carrier_sense", w.radio.carrier_sense);
    (*this)("radio.seed", w.radio.seed);
    (*this)("link.range_m", w.link.range_m);
    (*this)("link.latency_s", w.link.latency_s);
    (*this)("link.bandwidth_bit_s", w.link.bandwidth_bit_s);
    (*this)("link.timeout_s", w.link.timeout_s);
    (*this)("link.dropouts", w.link.dropouts);
    (*this)("link.dropout_rate_hz", w.link.dropout_rate_hz);
    (*this)("link.dropout_span_s", w.link.dropout_span_s);
    (*this)("webots.time_step_s", w.webots.time_step_s);
    (*this)("webots.speed_unit_rad_s", w.webots.speed_unit_rad_s);
    (*this)("webots.sensor_order", w.webots.sensor_order);
    (*this)("webots.axes", w.webots.axes);
    (*this)("webots.world", w.webots.world);
    (*this)("webots.floor_m", w.webots.floor_m);
    (*this)("robot", w.robots);
    (*this)("supervisor", w.supervisors);
  }
};

const std::string kFolder = TWINPUCK_SOURCE_DIR "/tests/sim_core/keys/";

std::string text_of(const std::string& file) {
  std::ifstream in(kFolder + file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Keys, arrive_where_they_belong_and_have_the_default_that_is_documented) {
  for (const std::string name : {"every_key", "no_key"}) {
    const auto loaded = sim::parse_world(text_of(name + ".toml"), kFolder + name + ".toml", {puck()});
    ASSERT_TRUE(loaded.world) << loaded.report(name);
    Told told;
    told(*loaded.world);
    const std::string kept = testing::TempDir() + name + ".txt";
    if (told.text != text_of(name + ".txt")) std::ofstream(kept) << told.text;
    EXPECT_EQ(told.text, text_of(name + ".txt")) << "read what has changed, and copy " << kept;
  }
}

TEST(Keys, are_all_in_the_file_that_has_every_key) {
  const std::string text = text_of("every_key.toml");
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
