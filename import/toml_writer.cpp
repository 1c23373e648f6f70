// SPDX-License-Identifier: MIT
// Writes the world file as somebody would by hand: what differs from the defaults, in the order of
// docs/worlds.md, with the name and line of the node that each part was.
#include <fmt/format.h>

#include <map>

#include "import/carried.h"

namespace wbt {
namespace {

// short and without needless zeros: 0.1 mm, or five digits of small numbers
std::string num(double x, int digits = 4) {
  if (x != 0 && std::abs(x) < 0.01 && digits < 9) digits = 6;
  std::string s = fmt::format("{:.{}f}", x, digits);
  while (s.find('.') != std::string::npos && s.back() == '0') s.pop_back();
  if (s.back() == '.') s += "0";
  return s == "-0.0" ? "0.0" : s;
}

// a place or a measure
std::string metres(double x) {
  std::string s = fmt::format("{:.4f}", x);
  while (s.back() == '0' && s[s.size() - 2] != '.') s.pop_back();
  return s == "-0.0" ? "0.0" : s;
}

std::string pair(double x, double y) { return fmt::format("[{}, {}]", metres(x), metres(y)); }
std::string three(double x, double y, double z) {
  return fmt::format("[{}, {}, {}]", metres(x), metres(y), metres(z));
}
std::string colour(const sim::Colour& c) {
  return fmt::format("[{}, {}, {}]", num(c.r, 3), num(c.g, 3), num(c.b, 3));
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : printable(text, text.size())) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string degrees(double rad) {
  const double d = std::remainder(sim::degrees(rad), 360.0);
  return metres(std::round((std::abs(d + 180) < 1e-9 ? 180 : d) * 100) / 100);
}

class Writer {
 public:
  explicit Writer(const Carried& c) : c_(c), w_(c.world) {}

  std::string text(const Options& options, const std::vector<Remark>& report, const std::string& version) {
    // What the reader has to know: where this is from, and what is not in it.
    line("# Made by `twinpuck import` from " + printable(options.file, 200) + " (Webots " + version + ").");
    for (const std::string& i : c_.info) comment(i);
    if (!report.empty()) {
      line("#");
      line("# Not carried:");
      for (const Remark& r : report) {
        if (&r - report.data() == kMostCommentLines) {
          line(fmt::format("#   and {} more: run the import again to see them",
                           report.size() - kMostCommentLines));
          break;
        }
        line("#   " + (r.line > 0 ? fmt::format("line {}: ", r.line) : std::string()) +
             printable(r.text, 400));
      }
    }
    if (!c_.cosmetic.empty()) {
      std::string list;
      for (std::size_t i = 0; i < std::min<std::size_t>(c_.cosmetic.size(), 8); ++i)
        list += (i ? ", " : "") + printable(c_.cosmetic[i]);
      line("# Left out, nothing here depends on it: " + list + ".");
    }
    // The world, in the order of docs/worlds.md.
    line("twinpuck = 1");
    if (!w_.title.empty()) key("title", quoted(w_.title));
    world();
    materials();
    arena();
    for (std::size_t i = 0; i < w_.ramps.size(); ++i) ramp(i);
    for (std::size_t i = 0; i < w_.walls.size(); ++i) wall(i);
    for (std::size_t i = 0; i < w_.objects.size(); ++i) object(i);
    for (std::size_t i = 0; i < w_.lamps.size(); ++i) lamp(i);
    if (!c_.profile.empty()) {
      section("[proximity]", "readings as Webots " + version + " computes them");
      key("profile", quoted(c_.profile));
      if (w_.proximity.noise_law) key("noise_law", "\"uniform\"");
    }
    webots();
    for (std::size_t i = 0; i < w_.robots.size(); ++i) robot(i);
    for (std::size_t i = 0; i < w_.supervisors.size(); ++i) {
      section("[[supervisor]]", c_.supervisor_from[i]);
      key("name", quoted(w_.supervisors[i].name));
      key("program", quoted(w_.supervisors[i].program));
      if (!w_.supervisors[i].args.empty()) key("args", quoted(w_.supervisors[i].args));
      if (!w_.supervisors[i].def.empty()) key("def", quoted(w_.supervisors[i].def));
      if (!w_.supervisors[i].custom_data.empty()) key("custom_data", quoted(w_.supervisors[i].custom_data));
      node(w_.supervisors[i].node);
      devices("[[supervisor.device]]", c_.supervisor_devices[i]);
    }
    return out_;
  }

 private:
  void line(const std::string& s) { out_ += s + "\n"; }
  void comment(const std::string& s) {
    const std::string p = printable(s, 1000);
    for (std::size_t at = 0; at < p.size(); at += 105) line("# " + p.substr(at, 105));
  }
  void section(const std::string& head, const std::string& from) {
    line("");
    if (!from.empty()) line("# " + printable(from, 200));
    line(head);
  }
  void key(const std::string& k, const std::string& v) { line(k + " = " + v); }

  void world() {
    const sim::WorldDesc usual;
    std::vector<std::pair<std::string, std::string>> keys;
    if (w_.engine == sim::Engine::Planar)
      keys.push_back({"engine", "\"planar\""});
    else if (w_.engine == sim::Engine::Kinematic)
      keys.push_back({"engine", "\"kinematic\""});
    if (std::abs(w_.gravity_m_s2 - usual.gravity_m_s2) > 1e-6)
      keys.push_back({"gravity", num(w_.gravity_m_s2)});
    if (w_.seed != usual.seed) keys.push_back({"seed", fmt::format("{}", w_.seed)});
    if (w_.ambient_w_m2 > 0) keys.push_back({"ambient", num(w_.ambient_w_m2)});
    if (keys.empty()) return;
    section("[world]", "");
    for (const auto& [k, v] : keys) key(k, v);
  }

  static std::string surface_key(const sim::Material& m) {
    return fmt::format("{} {}", colour(m.colour), num(m.roughness, 3));
  }

  void materials() {
    // roughness has no key on the objects themselves
    const auto add = [&](const sim::Material& m) {
      if (!(m.roughness > 0) || names_.count(surface_key(m))) return;
      const std::string name = fmt::format("surface {}", names_.size() + 1);
      names_[surface_key(m)] = name;
      section("[[material]]", "");
      key("name", quoted(name));
      key("colour", colour(m.colour));
      key("roughness", num(m.roughness, 3));
    };
    if (w_.arena) add(w_.arena->material);
    for (const auto& o : w_.objects) add(o.material);
  }

  void surface(const sim::Material& m) {
    const auto named = names_.find(surface_key(m));
    if (m.roughness > 0 && named != names_.end())
      key("material", quoted(named->second));
    else if (m.colour.r != 1 || m.colour.g != 1 || m.colour.b != 1)
      key("colour", colour(m.colour));
  }

  void arena() {
    const sim::WorldDesc usual;
    if (w_.arena) {
      const sim::ArenaDesc plain, &a = *w_.arena;
      section("[arena]", c_.arena_from);
      key("size", pair(a.size_m.x, a.size_m.y));
      if (metres(a.centre_m.x) != "0.0" || metres(a.centre_m.y) != "0.0")
        key("centre", pair(a.centre_m.x, a.centre_m.y));
      if (a.wall_height_m != plain.wall_height_m) key("wall_height", metres(a.wall_height_m));
      if (a.wall_height_m > 0) {
        if (a.wall_thickness_m != plain.wall_thickness_m) key("wall_thickness", metres(a.wall_thickness_m));
        surface(a.material);
      }
    }
    const sim::FloorDesc& f = w_.floor;
    if (!f.image.empty() || colour(f.colour) != colour(usual.floor.colour)) {
      section("[floor]", c_.floor_from);
      key("colour", colour(f.colour));
      if (!f.image.empty()) key("image", quoted(f.image));
    }
    if (colour(w_.sky.colour) != colour(usual.sky.colour)) {
      section("[sky]", "");
      key("colour", colour(w_.sky.colour));
    }
  }

  void ramp(std::size_t i) {
    const sim::RampDesc& r = w_.ramps[i];
    section("[[ramp]]", c_.ramp_from[i]);
    if (!r.name.empty()) key("name", quoted(r.name));
    key("position", pair(r.pose.x_m, r.pose.y_m));
    key("size", pair(r.size_m.x, r.size_m.y));
    if (degrees(r.pose.heading_rad) != "0.0") key("heading", degrees(r.pose.heading_rad));
    key("heights", pair(r.low_m, r.high_m));
    surface(r.material);
  }

  void wall(std::size_t i) {
    const sim::WallDesc& d = w_.walls[i];
    section("[[wall]]", c_.wall_from[i]);
    std::string points;
    for (const Vec2 p : d.points_m) points += (points.empty() ? "" : ", ") + pair(p.x, p.y);
    key("points", "[" + points + "]");
    if (d.closed) key("closed", "true");
    key("thickness", metres(d.thickness_m));
    key("height", metres(d.height_m));
    if (d.z_m > 0) key("z", metres(d.z_m));
    surface(d.material);
  }

  void object(std::size_t i) {
    const sim::ObjectDesc& o = w_.objects[i];
    const char* heads[] = {"[[box]]", "[[cylinder]]", "[[ball]]", "[[polygon]]"};
    section(heads[static_cast<int>(o.kind)], c_.object_from[i]);
    if (!o.name.empty()) key("name", quoted(o.name));
    if (!o.def.empty()) key("def", quoted(o.def));
    // Where it is, and how large.
    key("position", pair(o.pose.x_m, o.pose.y_m));
    if (metres(o.z_m) != "0.0") key("z", metres(o.z_m));
    if (o.kind == sim::ObjectKind::Box) key("size", three(o.size_m.x, o.size_m.y, o.size_m.z));
    if (o.kind == sim::ObjectKind::Cylinder || o.kind == sim::ObjectKind::Ball)
      key("radius", metres(o.radius_m));
    if (o.kind == sim::ObjectKind::Polygon) {
      std::string points;
      for (const Vec2 p : o.corners_m)
        points += fmt::format("{}[{}, {}]", points.empty() ? "" : ", ", fmt::format("{:.5f}", p.x),
                              fmt::format("{:.5f}", p.y));
      key("points", "[" + points + "]");
    }
    if (o.kind == sim::ObjectKind::Cylinder || o.kind == sim::ObjectKind::Polygon)
      key("height", metres(o.size_m.z));
    const bool round = o.kind == sim::ObjectKind::Cylinder || o.kind == sim::ObjectKind::Ball;
    if (degrees(o.pose.heading_rad) != "0.0" && (!round || o.movable))
      key("heading", degrees(o.pose.heading_rad));
    // How it moves, and what it is made of.
    if (o.movable) {
      key("movable", "true");
      key("mass", num(o.mass_kg));
      if (o.floor_friction != 0.5) key("friction", num(o.floor_friction));
    }
    surface(o.material);
    if (o.material.restitution > 0) key("restitution", num(o.material.restitution));
    if (!o.model.empty()) key("model", quoted(o.model));
    recognition(o.recognition_colours);
    node(o.node);
  }

  void lamp(std::size_t i) {
    const sim::LampDesc& l = w_.lamps[i];
    section("[[lamp]]", c_.lamp_from[i]);
    if (!l.name.empty()) key("name", quoted(l.name));
    key("position", three(l.position_m.x, l.position_m.y, l.position_m.z));
    key("intensity", num(l.intensity_w_m2));
    if (l.attenuation[0] != 1 || l.attenuation[1] != 0 || l.attenuation[2] != 0)
      key("attenuation",
          fmt::format("[{}, {}, {}]", num(l.attenuation[0]), num(l.attenuation[1]), num(l.attenuation[2])));
    if (l.colour.r != 1 || l.colour.g != 1 || l.colour.b != 1) key("colour", colour(l.colour));
    if (!l.on) key("on", "false");
    node(l.node);
  }

  void webots() {
    section("[webots]", "what programs written for Webots find");
    key("time_step", num(w_.webots.time_step_s));
    if (w_.webots.speed_unit_rad_s > 0) key("speed_unit", num(w_.webots.speed_unit_rad_s, 6));
    if (w_.webots.axes == sim::Axes::Nue) key("axes", "\"nue\"");
    if (!w_.webots.world.empty()) {
      key("world", quoted(w_.webots.world));
      if (w_.webots.floor_m != 0) key("floor", metres(w_.webots.floor_m));
    }
  }

  // which node of that world it was
  void node(int line_of) {
    if (line_of > 0 && !w_.webots.world.empty()) key("node", fmt::format("{}", line_of));
  }

  void recognition(const std::vector<sim::Colour>& colours) {
    std::string list;
    for (const sim::Colour& c : colours) list += (list.empty() ? "" : ", ") + colour(c);
    if (!colours.empty()) key("recognition_colours", "[" + list + "]");
  }

  static std::string rows(const std::vector<sim::ResponseRow>& table) {
    std::string rows;
    for (const auto& r : table)
      rows += fmt::format("{}[{}, {}, {}]", rows.empty() ? "" : ", ", num(r.distance_m, 9), num(r.value),
                          num(r.relative_noise, 5));
    return "[" + rows + "]";
  }

  void proximity(const sim::ProximitySettings& p) {
    if (p.table) key("table", rows(*p.table));
    if (p.type == sim::SensorType::Generic) key("type", "\"generic\"");
    if (p.rays) key("rays", fmt::format("{}", *p.rays));
    if (p.aperture_rad) key("aperture_rad", num(*p.aperture_rad));
    if (p.gaussian_width) key("gaussian_width", num(*p.gaussian_width));
  }

  void robot(std::size_t i) {
    const sim::RobotDesc& r = w_.robots[i];
    section("[[robot]]", c_.robot_from[i]);
    key("name", quoted(r.name));
    if (!r.def.empty()) key("def", quoted(r.def));
    key("firmware", quoted(r.firmware));
    if (!r.args.empty()) key("args", quoted(r.args));
    if (r.supervisor) key("supervisor", "true");
    if (!r.custom_data.empty()) key("custom_data", quoted(r.custom_data));
    // Where it begins, then what differs from the usual robot.
    key("position", pair(r.pose.x_m, r.pose.y_m));
    key("heading", degrees(r.pose.heading_rad));
    if (r.battery_wh > 0) key("battery_wh", num(r.battery_wh));
    if (r.wheels.noise) key("wheel_noise", num(*r.wheels.noise));
    for (const auto& [name, value] : r.own) key(name.c_str(), quoted(value.text));
    recognition(r.recognition_colours);
    node(r.node);
    const bool own = r.proximity.table || r.proximity.type == sim::SensorType::Generic || r.proximity.rays ||
                     r.proximity.aperture_rad || r.proximity.gaussian_width;
    if (own) {
      line("[robot.proximity]");
      proximity(r.proximity);
    }
    for (const sim::SensorDesc& s : r.sensors) {
      line("[[robot.sensor]]");
      key("index", fmt::format("{}", s.index));
      proximity(s.proximity);
    }
    for (const std::string& part : c_.robot_parts[i]) {
      line("[[robot.part]]");
      key("kind", quoted(part));
    }
    devices("[[robot.device]]", c_.robot_devices[i]);
  }

  void devices(const char* head, const std::vector<Device>& list) {
    for (const Device& d : list) {
      line(head);
      key("name", quoted(d.name));
      key("kind", quoted(d.kind));
      if (d.channel) key("channel", fmt::format("{}", *d.channel));
      if (d.range_m) key("range", num(*d.range_m));
      if (d.baud_rate_bit_s) key("baud_rate", num(*d.baud_rate_bit_s));
      if (d.infra_red) key("infra_red", "true");
      if (d.width) key("width", fmt::format("{}", *d.width));
      if (d.height) key("height", fmt::format("{}", *d.height));
      if (d.at.x != 0 || d.at.y != 0 || d.at.z != 0)
        key("at", fmt::format("[{}, {}, {}]", num(d.at.x), num(d.at.y), num(d.at.z)));
      if (d.heading_rad != 0) key("heading", degrees(d.heading_rad));
      if (d.fov_rad) key("fov", num(*d.fov_rad));
      if (d.vertical_fov_rad) key("vertical_fov", num(*d.vertical_fov_rad));
      if (d.near_m) key("near", num(*d.near_m));
      if (d.far_m) key("far", num(*d.far_m));
      if (!d.table.empty()) key("table", rows(d.table));
      if (d.rays > 1) key("rays", fmt::format("{}", d.rays));
      if (d.aperture_rad) key("aperture", num(*d.aperture_rad));
    }
  }

  const Carried& c_;
  const sim::WorldDesc& w_;
  std::string out_;
  std::map<std::string, std::string> names_;
};

void round_place(sim::Pose2& pose) {
  pose = {as_written(pose.x_m), as_written(pose.y_m), sim::radians(std::stod(degrees(pose.heading_rad)))};
}

void round_pair(Vec2& v) { v = {as_written(v.x), as_written(v.y)}; }

}  // namespace

double as_written(double metres) { return std::round(metres * 1e4) / 1e4; }

void round_as_written(sim::WorldDesc& world) {
  if (world.arena) {
    round_pair(world.arena->size_m);
    round_pair(world.arena->centre_m);
    world.arena->wall_thickness_m = as_written(world.arena->wall_thickness_m);
  }
  for (sim::RampDesc& r : world.ramps) {
    round_place(r.pose);
    round_pair(r.size_m);
    r.high_m = as_written(r.high_m);
  }
  for (sim::WallDesc& w : world.walls) {
    for (Vec2& p : w.points_m) round_pair(p);
    for (double* x : {&w.thickness_m, &w.height_m, &w.z_m}) *x = as_written(*x);
  }
  for (sim::ObjectDesc& o : world.objects) {
    round_place(o.pose);
    for (double* x : {&o.z_m, &o.radius_m, &o.size_m.x, &o.size_m.y, &o.size_m.z}) *x = as_written(*x);
  }
  for (sim::RobotDesc& r : world.robots) round_place(r.pose);
}

std::string write_toml(const Carried& c, const Options& options, const std::vector<Remark>& report,
                       const std::string& version) {
  return Writer(c).text(options, report, version);
}

}  // namespace wbt
