// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "import/carried.h"
#include "sim_core/load/floor_image.h"

namespace wbt {
namespace {

namespace fs = std::filesystem;
using sim::ObjectKind;

std::string from(const std::string& type, const std::string& name, const std::string& def, int line) {
  std::string out = printable(type);
  if (!name.empty()) out += " \"" + printable(name) + "\"";
  if (!def.empty()) out += ", DEF " + printable(def);
  return fmt::format("{}, line {}", out, line);
}

constexpr const char* kTooLarge = "larger or further away than a world of ours may be";

// names in our files: no control characters, not endless
std::string clean(const std::string& text) { return printable(text, 80); }

// what programs are told
std::string clean_line(const std::string& text) { return printable(text, kLongestText); }

// a robot's name: messages and tables part names by these
std::string robot_name(const std::string& text) {
  std::string out = text.empty() ? "robot" : clean(text);
  for (char& c : out) c = c == ',' || c == '"' || c == '=' ? '_' : c;
  return out;
}

// a name as our files may hold it, or empty
std::string relative_name(const std::string& file, const Options& o) {
  std::error_code error;
  const fs::path p = fs::relative(file, o.out_folder.empty() ? "." : o.out_folder, error);
  return error || p.empty() ? file : p.string();
}

class Settler {
 public:
  Settler(const Scene& s, const Options& o, Report& r, std::optional<double> floor_z)
      : scene_(s), options_(o), report_(r), is_furniture_(floor_z.has_value()) {
    floor_z_ = floor_z.value_or(0);
  }

  Carried carried() {
    out_.cosmetic = scene_.cosmetic;
    out_.info = scene_.info;
    sim::WorldDesc& w = out_.world;
    w.title = clean(scene_.title);
    w.models = {options_.model};
    w.webots.time_step_s = scene_.time_step_s;
    w.webots.axes = scene_.nue ? sim::Axes::Nue : sim::Axes::Enu;
    if (scene_.gravity_m_s2) w.gravity_m_s2 = *scene_.gravity_m_s2;
    if (scene_.seed) w.seed = *scene_.seed;
    if (scene_.sky) w.sky.colour = *scene_.sky;
    if (!scene_.robots.empty()) {
      out_.profile = scene_.new_sensors ? "webots-new" : "webots-old";
      if (scene_.uniform_noise) w.proximity.noise_law = sim::NoiseLaw::Uniform;
    }
    engine();
    if (!is_furniture_) find_floor();
    if (!is_furniture_ && !options_.folder.empty()) {
      w.webots.world = relative_name((fs::path(options_.folder) / options_.file).string(), options_);
      if (printable(w.webots.world, 10000) != w.webots.world || std::abs(floor_z_) > kFarthestM)
        w.webots.world.clear();
      w.webots.floor_m = as_written(floor_z_);
    }
    for (const FoundArena& a : scene_.arenas) arena(a);
    for (std::size_t b = 0; b < scene_.bodies.size(); ++b) body(b);
    for (const FoundLamp& l : scene_.lamps) lamp(l);
    if (is_furniture_) return std::move(out_);
    for (const FoundRobot& r : scene_.robots) robot(r);
    for (const FoundSupervisor& s : scene_.supervisors) supervisor(s);
    return std::move(out_);
  }

 private:
  void engine() {
    const auto& robots = scene_.robots;
    const auto still =
        std::count_if(robots.begin(), robots.end(), [](const FoundRobot& r) { return r.kinematic; });
    if (scene_.planar) out_.world.engine = sim::Engine::Planar;
    if (still == 0 || scene_.planar) return;
    out_.world.engine = sim::Engine::Kinematic;
    if (still < static_cast<long>(robots.size())) {
      for (const FoundRobot& r : robots) {
        if (!r.kinematic)
          report_.add(r.line, r.type, "physics beside kinematic robots", "all robots are kinematic");
      }
    }
  }

  // a body's face that robots can stand on, as high as they stand
  bool is_floor(const Piece& p, bool movable) const {
    if (movable || p.kind == ObjectKind::Ball || p.kind == ObjectKind::Cylinder) return false;
    const auto [low, high] = std::minmax(p.size.x, p.size.y);
    if (p.kind == ObjectKind::Box && low < kFloorSideM) return false;
    if (p.area() < kFloorSideM * kFloorSideM) return false;
    if (p.ramp && !p.endless_floor) return false;
    if (scene_.robots.empty())
      return p.endless_floor || (p.z_high - p.z_low < kFlatM && std::abs(p.z_high) < kFlatM);
    const auto some = scene_.robots.begin() +
                      std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(scene_.robots.size()), 50);
    return std::any_of(scene_.robots.begin(), some, [&](const FoundRobot& r) {
      return p.covers({r.pose.x_m, r.pose.y_m}) && p.z_high > r.z_m - kFloorBelowM &&
             p.z_high < r.z_m + kFloorAboveM;
    });
  }

  void find_floor() {
    // An arena has the floor.
    for (const FoundArena& a : scene_.arenas) {
      if (!is_sensible(a)) continue;
      floor_z_ = a.z_m;
      have_floor_ = true;
      return;
    }
    // Else the largest flat piece under the robots.
    double best = 0;
    for (const Body& b : scene_.bodies) {
      for (const Piece& p : b.pieces) {
        if (p.area() > best && is_floor(p, b.movable)) {
          best = p.area();
          floor_z_ = p.z_high;
          floor_ = &p;
          floor_body_ = &b;
        }
      }
    }
    if (!floor_) {
      if (!scene_.robots.empty()) floor_z_ = scene_.robots.front().z_m;
      if (std::abs(floor_z_) < kFloorBelowM) floor_z_ = 0;
      report_.add(0, "floor", "nothing flat lies under the robots", "an endless floor");
      return;
    }
    have_floor_ = true;
    // floors are often laid of several pieces: the rectangle around those of the same height
    double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
    int parts = 0;
    for (const Body& b : scene_.bodies) {
      for (const Piece& p : b.pieces) {
        if (&p != floor_ && !(std::abs(p.z_high - floor_z_) < kFlatM && !b.movable && p.area() > 0.25 * best))
          continue;
        ++parts;
        for (const Vec2 c : p.outline()) {
          x0 = std::min(x0, c.x), x1 = std::max(x1, c.x), y0 = std::min(y0, c.y), y1 = std::max(y1, c.y);
        }
      }
    }
    // The arena is that rectangle, without walls.
    sim::ArenaDesc a;
    a.size_m = {std::clamp(x1 - x0, 0.01, kFarthestM), std::clamp(y1 - y0, 0.01, kFarthestM)};
    a.centre_m = {(x0 + x1) / 2, (y0 + y1) / 2};
    a.wall_height_m = 0;
    if (std::max(std::abs(a.centre_m.x), std::abs(a.centre_m.y)) > kFarthestM) return;
    out_.world.arena = a;
    out_.world.floor.colour = floor_->surface.colour;
    out_.floor_from = from(floor_body_->type, floor_body_->name, floor_body_->def, floor_body_->line);
    out_.arena_from = out_.floor_from + (parts > 1 ? fmt::format(" and {} more pieces", parts - 1) : "");
    if (parts == 1 && floor_->area() < 0.99 * a.size_m.x * a.size_m.y)
      report_.add(floor_->line, "floor", "its outline", "the rectangle around it");
  }

  static bool is_sensible(const FoundArena& a) {
    return std::min(a.size.x, a.size.y) >= 0.01 && std::max(a.size.x, a.size.y) <= kFarthestM &&
           Vec3(a.at.x, a.at.y, a.z_m).allFinite() && std::isfinite(a.heading_rad) &&
           std::max({std::abs(a.at.x), std::abs(a.at.y), std::abs(a.z_m)}) <= kFarthestM;
  }

  void image(const FoundArena& a) {
    sim::FloorDesc read;
    const std::string name = relative_name(a.image, options_);
    const std::string wrong = printable(name, 10000) != name ? "not a name of printable characters"
                                                             : sim::read_floor_image(a.image, read);
    if (wrong.empty())
      out_.world.floor.image = name;
    else
      report_.add(a.line, a.type, "its picture: " + printable(wrong, 200), "its average colour");
  }

  void arena(const FoundArena& a) {
    const std::string source = from(a.type, "", "", a.line);
    if (!is_sensible(a)) return report_.add(a.line, a.type, "its measures make no sense");
    // Ours lies square to the axes; one that is turned by a quarter has its sides exchanged.
    const double height = std::clamp(a.wall_height_m, 0.0, kFarthestM);
    const double thickness = std::clamp(a.wall_thickness_m, kLeastM, 10.0);
    const double quarter = a.heading_rad / (sim::kPi / 2);
    const bool straight = std::abs(quarter - std::round(quarter)) < 1e-3;
    const bool turned = static_cast<long>(std::round(quarter)) % 2 != 0;
    const Vec2 size = turned ? Vec2{a.size.y, a.size.x} : a.size;
    if (!out_.world.arena && (straight || a.round)) {
      sim::ArenaDesc d;
      d.size_m = size;
      d.centre_m = a.at;
      d.wall_height_m = a.round ? 0 : height;
      d.wall_thickness_m = thickness;
      if (a.walls) d.material.colour = a.walls->colour, d.material.roughness = a.walls->roughness;
      out_.world.arena = d;
      out_.arena_from = source;
      if (a.floor) out_.world.floor.colour = a.floor->colour;
      if (!a.image.empty() && !options_.folder.empty()) image(a);
      if (!a.round) return;
    } else if (!straight && !out_.world.arena && a.floor) {
      out_.world.floor.colour = a.floor->colour;
    }
    // What cannot be an arena of ours gets its walls one by one.
    if (height <= 0) {
      if (out_.arena_from != source)
        report_.add(a.line, a.type, "a second floor, or one that lies askew", "the floor goes on");
      return;
    }
    sim::WallDesc w;
    w.closed = true;
    w.height_m = std::max(height, kLeastM);
    w.thickness_m = thickness;
    w.z_m = std::clamp(a.z_m - floor_z_, 0.0, kFarthestM);
    if (a.walls) w.material.colour = a.walls->colour;
    const double hx = a.size.x / 2 + thickness / 2, hy = a.size.y / 2 + thickness / 2;
    const double c = std::cos(a.heading_rad), s = std::sin(a.heading_rad);
    const int corners = a.round ? 36 : 4;
    for (int i = 0; i < corners; ++i) {
      const double t = 2 * sim::kPi * i / corners;
      const Vec2 p = a.round ? Vec2{hx * std::cos(t), hx * std::sin(t)}
                             : Vec2{i == 0 || i == 3 ? -hx : hx, i < 2 ? -hy : hy};
      w.points_m.push_back(a.at + Vec2{c * p.x - s * p.y, s * p.x + c * p.y});
    }
    for (const Vec2 p : w.points_m) {
      if (std::max(std::abs(p.x), std::abs(p.y)) > kFarthestM)
        return report_.add(a.line, a.type, kTooLarge, "no walls");
    }
    out_.world.walls.push_back(w);
    out_.wall_from.push_back(source);
  }

  const Contact* contact_of(const std::string& material) const {
    const Contact* fallback = nullptr;
    for (const Contact& c : scene_.contacts) {
      const bool touches = c.one == material || c.other == material;
      if (touches && (c.one == "default" || c.other == "default")) return &c;
      if (touches && !fallback) fallback = &c;
    }
    return fallback;
  }

  // within the bounds of our worlds, as it will be written
  bool fits(const Piece& p) const {
    double most = std::max({std::abs(p.at.x), std::abs(p.at.y), p.size.x, p.size.y, p.radius_m,
                            p.z_high - p.z_low, std::abs(p.z_low - floor_z_), std::abs(p.z_high - floor_z_)});
    for (const Vec2 c : p.corners) most = std::max({most, std::abs(c.x), std::abs(c.y)});
    return most <= kFarthestM;
  }

  void body(std::size_t index) {
    const Body& b = scene_.bodies[index];
    const std::string title = (b.def.empty() ? "" : b.def + " ") + b.type;
    std::vector<Piece> pieces;
    for (const Piece& p : b.pieces) {
      if (fits(p))
        pieces.push_back(p);
      else
        report_.add(p.line, title, kTooLarge);
    }
    if (b.movable && pieces.size() > 1) {
      std::vector<Vec3> points;
      double volume = 0;
      for (const Piece& p : pieces) {
        for (const Vec2 c : p.outline())
          points.emplace_back(c.x, c.y, p.z_low), points.emplace_back(c.x, c.y, p.z_high);
        volume += p.volume_m3;
      }
      auto hull = hull_piece(points);
      if (!hull) return report_.add(b.line, title, "has no extent");
      if (!fits(*hull)) return report_.add(b.line, title, kTooLarge);
      hull->surface = pieces.front().surface;
      hull->volume_m3 = volume;
      report_.add(b.line, title, fmt::format("that it is made of {} pieces", pieces.size()),
                  "the upright prism around them");
      pieces = {*hull};
    }
    for (Piece& p : pieces) place(b, p, title);
  }

  void place(const Body& b, Piece& p, const std::string& title) {
    // What is part of the floor, or nothing that a robot could touch, is no object.
    const bool in_floor = have_floor_ && p.z_high <= floor_z_ + kFlatM;
    if (!b.movable && in_floor) {
      const bool is_part = &b == floor_body_;
      const bool differs = std::abs(p.surface.colour.r - out_.world.floor.colour.r) > 0.02 ||
                           std::abs(p.surface.colour.g - out_.world.floor.colour.g) > 0.02 ||
                           std::abs(p.surface.colour.b - out_.world.floor.colour.b) > 0.02;
      if (!is_part && p.z_high > floor_z_ - kFlatM && differs)
        report_.add(p.line, title, "a coloured patch of the floor", "draw it in [floor] image");
      return;
    }
    if (b.untouched && !b.movable)
      return report_.add(b.line, title, "only cameras notice it (it has no boundingObject)");
    if (p.endless_floor && p.z_high - p.z_low < kFlatM)
      return report_.add(p.line, title, "a flat sheet above the floor");
    // A slope is a ramp where the engine knows heights.
    if (!p.approximation.empty() && !(p.ramp && !b.movable))
      report_.add(p.line, title, "its exact shape", p.approximation);
    if (p.ramp && !b.movable && !scene_.planar && !is_furniture_ && ramp(b, p)) return;
    if (p.ramp && !b.movable) report_.add(p.line, title, "its exact shape", p.approximation);
    if (static_cast<int>(out_.world.objects.size()) >= kMostBodies)
      return report_.add(p.line, title, fmt::format("more than {} objects", kMostBodies));
    // What it is called, and where it stands.
    sim::ObjectDesc o;
    o.kind = p.kind;
    o.name = clean(b.name);
    o.def = clean(b.def);
    o.model = clean(b.model);
    o.recognition_colours = b.recognition;
    o.node = b.line;
    o.pose = {p.at.x, p.at.y, p.heading_rad};
    o.movable = b.movable && movable_ < kMostMovable;
    if (b.movable && ++movable_ > kMostMovable)
      report_.add(p.line, title, fmt::format("more than {} movable objects", kMostMovable), "it is fixed");
    // Heights above the floor; what nearly lies on it does.
    double low = p.z_low - floor_z_, high = p.z_high - floor_z_;
    if (b.movable && low < 0) high -= low, low = 0;
    if (low < (b.movable ? kTouchM : kGapM)) {
      if (p.kind == ObjectKind::Ball && low < -0.001)
        report_.add(p.line, title, "that it is sunk into the floor", "it lies on the floor");
      low = 0;
    }
    o.z_m = low;
    o.size_m = {std::max(p.size.x, kLeastM), std::max(p.size.y, kLeastM), std::max(high - low, kLeastM)};
    o.radius_m = std::max(p.radius_m, kLeastM);
    o.corners_m = p.corners;
    o.material.colour = p.surface.colour;
    o.material.roughness = p.surface.roughness;
    // Friction, bounce and mass.
    if (const Contact* c = contact_of(b.contact)) {
      if (c->friction >= 0) o.floor_friction = std::clamp(c->friction, 0.0, 10.0);
      o.material.restitution = std::clamp(c->bounce, 0.0, 1.0);
    } else if (p.kind == ObjectKind::Ball && b.movable) {
      o.material.restitution = kContactBounce;
    }
    if (b.movable) {
      const double mass = b.mass_kg > 0         ? b.mass_kg
                          : b.density_kg_m3 > 0 ? b.density_kg_m3 * p.volume_m3
                                                : kDensityKgM3 * p.volume_m3;
      o.mass_kg = std::clamp(mass, kLightestKg, kHeaviestKg);
      if (!(mass >= kLightestKg && mass <= kHeaviestKg))
        report_.add(b.line, title, "its mass", fmt::format("{:.4g} kg", o.mass_kg));
    }
    out_.world.objects.push_back(o);
    out_.object_from.push_back(from(b.type, b.name, b.def, b.line));
  }

  // a slope that begins at the floor, cut off where it would go under it
  bool ramp(const Body& b, const Piece& p) {
    sim::RampDesc r = *p.ramp;
    r.low_m -= floor_z_;
    r.high_m -= floor_z_;
    if (r.high_m < kFlatM || r.low_m > 0.01 || r.high_m > 10) return false;
    if (r.low_m < 0) {
      const double share = r.high_m / (r.high_m - r.low_m);
      const double lost = (1 - share) * r.size_m.x;
      r.pose.x_m += lost / 2 * std::cos(r.pose.heading_rad);
      r.pose.y_m += lost / 2 * std::sin(r.pose.heading_rad);
      r.size_m.x -= lost;
    } else if (r.low_m > kTouchM) {
      report_.add(p.line, b.type, fmt::format("a step of {:.1f} mm at its low end", 1000 * r.low_m),
                  "it begins on the floor");
    }
    r.low_m = 0;
    if (r.size_m.x < 0.01 || r.size_m.y < 0.01 || std::max(r.size_m.x, r.size_m.y) > kFarthestM ||
        std::max(std::abs(r.pose.x_m), std::abs(r.pose.y_m)) > kFarthestM ||
        std::atan2(r.high_m, r.size_m.x) > kSteepestRampRad)
      return false;
    r.name = clean(b.name);
    r.material.colour = p.surface.colour;
    out_.world.ramps.push_back(r);
    out_.ramp_from.push_back(from(b.type, b.name, b.def, b.line));
    return true;
  }

  void lamp(const FoundLamp& l) {
    out_.world.ambient_w_m2 = std::min(kLightMax, out_.world.ambient_w_m2 + l.ambient_w_m2);
    if (!(l.lamp.intensity_w_m2 > 0) && l.lamp.name.empty()) return;  // nobody can turn it up
    sim::LampDesc d = l.lamp;
    d.name = clean(d.name);
    d.position_m.z -= floor_z_;
    d.node = l.line;
    if (!(std::abs(d.position_m.z) <= kFarthestM)) return report_.add(l.line, l.type, "too far away");
    out_.world.lamps.push_back(d);
    out_.lamp_from.push_back(from(l.type, "", d.name, l.line));
  }

  // the controller's own sources beside the world, a controller of the project, or just its name
  std::string program(const std::string& name, int line, const std::string& type, const char* what) {
    // Names that stand for something else than a program.
    if (options_.without_firmware) return {};
    if (name == "<extern>") return name;
    if (name.empty() || name == "void" || name == "<none>" || name == "<generic>") {
      if (name == "<generic>")
        report_.add(line, type, "controller \"" + name + "\"", std::string("no ") + what);
      return {};
    }
    // A program of ours may have that name.
    std::string plain = clean(name);
    const bool for_robot = std::string(what) == "firmware";
    const auto& is_ours = for_robot ? options_.has_firmware : options_.has_program;
    const bool ours = is_ours && plain == name && is_ours(name);
    const std::string home = std::string(for_robot ? "firmware/" : "programs/supervisors/") + plain;
    // The controller's own sources, where they are.
    if (!options_.folder.empty() && plain == name && name.find('/') == std::string::npos && name != "..") {
      const char* kSources[] = {".c", ".cpp", ".cc", ".cxx", ".py", ".java", ".class", ".jar"};
      const fs::path here = options_.folder;
      std::error_code error;
      std::set<std::string> kinds;
      // as Webots has it; then, for what somebody keeps without its folders, beside the world
      for (const fs::path& folder :
           {here / ".." / "controllers" / name, here / "controllers" / name, here / name}) {
        for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
          kinds.insert(at->path().extension().string());
        for (const char* source : kSources)
          if (kinds.count(source)) return relative_name(folder.lexically_normal().string(), options_);
      }
      for (const char* source : kSources)
        if (fs::is_regular_file(here / (name + source), error))
          return relative_name((here / (name + source)).lexically_normal().string(), options_);
      const char* language = kinds.count(".m") ? "MATLAB" : kinds.count(".bsg") ? "BotStudio" : nullptr;
      if (language) {
        const std::string found = fmt::format("controller \"{}\", a {} program", plain, language);
        // a program of ours that happens to have the name is not this one
        report_.add(line, type, found,
                    ours ? fmt::format("no {}; {} is another program", what, home)
                         : fmt::format("its name is kept; write it in C as {}", home));
        return ours ? std::string() : plain;
      }
    }
    // No sources: ours runs in its place, or its name is kept.
    if (ours)
      report_.add(line, type, fmt::format("controller \"{}\", whose sources are not beside the world", plain),
                  fmt::format("{} has its name and runs in its place", home));
    else if (!options_.folder.empty())
      report_.add(line, type, fmt::format("controller \"{}\", whose sources are not beside the world", plain),
                  fmt::format("its name is kept; put it into {}", home));
    return plain;
  }

  // robots and supervisors of one name are numbered, as Webots does
  std::string name_of_its_own(const std::string& plain) {
    std::string name = plain;
    for (int& i = used_[plain]; !names_.insert(name).second;) name = fmt::format("{}({})", plain, ++i);
    return name;
  }

  // devices of one name: the first counts
  std::vector<Device> devices_of(const std::vector<Device>& found, int line, const std::string& type) {
    std::vector<Device> devices;
    for (Device d : found) {
      d.name = clean(d.name);
      const bool twice =
          std::any_of(devices.begin(), devices.end(), [&](const Device& o) { return o.name == d.name; });
      if (twice || d.name.empty() || d.name.size() > kLongestDevice)
        report_.add(line, type,
                    fmt::format("{} \"{}\"",
                                twice            ? "a second device"
                                : d.name.empty() ? "a device without a name"
                                                 : "a device of so long a name",
                                d.name));
      else
        devices.push_back(d);
    }
    return devices;
  }

  void robot(const FoundRobot& f) {
    // A name of its own, that programs can be told by.
    sim::RobotDesc r;
    const std::string plain = robot_name(f.name);
    if (plain != f.name && !f.name.empty())
      report_.add(f.line, f.type, "the name \"" + clean(f.name) + "\"", "\"" + plain + "\"");
    r.name = name_of_its_own(plain);
    if (r.name != plain)
      report_.add(f.line, f.type, fmt::format("the name \"{}\" a second time", plain), "\"" + r.name + "\"");
    r.def = clean(f.def);
    r.pose = f.pose;
    r.args = clean_line(f.args);
    r.supervisor = f.supervisor;
    r.custom_data = clean_line(f.custom_data);
    r.recognition_colours = f.recognition;
    r.node = f.line;
    // Its program, and what it is equipped with.
    r.firmware = program(f.controller, f.line, f.type, "firmware");
    if (f.controller.empty() && f.by_proto)
      report_.add(f.line, f.type, "the controller that its PROTO names", "no firmware");
    if (f.slip_noise > 0) r.wheels.noise = f.slip_noise;
    if (!f.camera_mount.empty()) r.own["camera_mount"] = f.camera_mount;
    if (f.battery_wh) r.battery_wh = *f.battery_wh;
    r.proximity = f.proximity;
    r.sensors = f.sensors;
    // A world has one unit of speed.
    if (f.speed_unit_rad_s) {
      double& unit = out_.world.webots.speed_unit_rad_s;
      if (unit > 0 && std::abs(unit - *f.speed_unit_rad_s) > 1e-9)
        report_.add(f.line, f.type, "a second speedUnit",
                    fmt::format("that of the first robot, {:g} rad/s", unit));
      else
        unit = *f.speed_unit_rad_s;
    }
    const double above = f.z_m - floor_z_;
    if (std::abs(above) > kFloorBelowM)
      report_.add(f.line, f.type, fmt::format("that it begins {:.2f} m above the floor", above),
                  "it stands on the floor");
    out_.world.robots.push_back(r);
    out_.robot_from.push_back(from(f.type, "", f.def, f.line));
    out_.robot_parts.push_back(f.parts);
    out_.robot_devices.push_back(devices_of(f.devices, f.line, f.type));
  }

  void supervisor(const FoundSupervisor& f) {
    sim::SupervisorDesc s;
    s.name = name_of_its_own(robot_name(f.name));
    s.program = program(f.controller, f.line, f.type, "program");
    s.args = clean_line(f.args);
    s.def = clean(f.def);
    s.custom_data = clean_line(f.custom_data);
    s.node = f.line;
    if (s.program.empty()) return;
    out_.world.supervisors.push_back(s);
    out_.supervisor_from.push_back(from(f.type, "", f.def, f.line));
    out_.supervisor_devices.push_back(devices_of(f.devices, f.line, f.type));
  }

  int movable_ = 0;
  const Scene& scene_;
  const Options& options_;
  Report& report_;
  Carried out_;
  double floor_z_ = 0;
  bool have_floor_ = false;
  const bool is_furniture_;
  const Piece* floor_ = nullptr;
  const Body* floor_body_ = nullptr;
  std::set<std::string> names_;
  std::map<std::string, int> used_;  // how often a name has been asked for again
};

}  // namespace

Carried settle(const Scene& scene, const Options& options, Report& report, std::optional<double> floor_z) {
  return Settler(scene, options, report, floor_z).carried();
}

}  // namespace wbt
