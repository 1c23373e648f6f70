// SPDX-License-Identifier: MIT
// Walks the TOML tree along the schema. Keys are applied in the schema's order, so that an object's own
// colour comes after its material whatever the order in the file.
#include "sim_core/load/world_loader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "sim_core/base/input_file.h"
#include "sim_core/load/floor_image.h"
#include "sim_core/load/schema.h"
#include "sim_core/load/schema_reader.h"
#include "sim_core/sound/wav_file.h"
#include "sim_core/world/most_ranges.h"

namespace sim {
namespace {

class Reader : private SchemaReader {
 public:
  Reader(const std::string& path, const std::vector<RobotModel>& models,
         const std::vector<PartKind>& part_kinds, TomlTree* known)
      : SchemaReader(known) {
    world_.file = path;
    world_.models = models;
    world_.part_kinds = part_kinds;
  }

  LoadedWorld read(std::string_view text) {
    LoadedWorld out;
    const toml::table* const root = parse(text);
    if (root) read_all(*root);
    // what could be read is checked too, so that nothing is told only when other mistakes are gone
    if (root)
      for (WorldProblem& p : check_world(world_, unplaced_robots_)) problem(std::move(p));
    sort_problems();
    if (problems_.empty())
      out.world = std::move(world_);
    else
      out.draft = std::move(world_);
    out.problems = std::move(problems_);
    return out;
  }

 private:
  /// Sections that may stand inside `path`.
  static const std::vector<std::string>& inner_sections(const std::string& path) {
    static const auto all = [] {
      std::map<std::string, std::vector<std::string>> by_outer;
      for (const SectionSpec& s : world_schema()) {
        const std::string p = s.path;
        const std::size_t dot = p.rfind('.');
        if (p.empty()) continue;
        by_outer[dot == std::string::npos ? "" : p.substr(0, dot)].push_back(
            dot == std::string::npos ? p : p.substr(dot + 1));
      }
      return by_outer;
    }();
    static const std::vector<std::string> kNone;
    const auto found = all.find(path);
    return found == all.end() ? kNone : found->second;
  }

  /// Applies every key of a table and names the unknown ones.
  void read_table(const std::string& path, const toml::table& table, void* target) {
    read_table(section(path), table, target);
  }
  /// The same by a section that the schema does not hold as a whole.
  void read_table(const SectionSpec& spec, const toml::table& table, void* target) {
    SchemaReader::read_table(spec, inner_sections(spec.path), table, target, world_);
  }

  /// The same of a body; false: where it is, or how large, is not known.
  bool read_place(const SectionSpec& spec, const toml::table& table, void* target) {
    is_place_in_doubt_ = false;
    read_table(spec, table, target);
    return !is_place_in_doubt_;
  }

  /// A [section], if it is there.
  void read_one(const char* path, const toml::table& parent, const char* key, void* target) {
    const toml::node* node = parent.get(key);
    if (!node) return;
    if (const toml::table* table = node->as_table()) return read_table(path, *table, target);
    problem(node->source(),
            fmt::format("{}: got {}, expected a table, written [{}]", path, written(*node), path));
  }

  void read_objects(const toml::table& root, const char* path, ObjectKind kind) {
    read_many(path, root, path, [&](const toml::table& t) {
      ObjectDesc o;
      o.kind = kind;
      o.line = line_of(t);
      const bool is_placed = read_place(section(path), t, &o);
      if (kind == ObjectKind::Ball) o.size_m.z = 2 * o.radius_m;
      if (is_placed) world_.objects.push_back(std::move(o));
    });
  }

  void read_all(const toml::table& root) {
    // Materials come before what is made of them.
    read_table("", root, &world_);
    read_one("world", root, "world", &world_);
    read_many("material", root, "material", [&](const toml::table& t) {
      Material m;
      read_table("material", t, &m);
      for (const Material& other : world_.materials) {
        if (!m.name.empty() && other.name == m.name) {
          problem(t.source(),
                  fmt::format("material.name: got \"{}\" a second time, expected a name of its own", m.name));
        }
      }
      world_.materials.push_back(std::move(m));
    });
    // The arena and its floor.
    if (root.get("arena")) {
      ArenaDesc arena;
      is_place_in_doubt_ = !root.get("arena")->is_table();
      read_one("arena", root, "arena", &arena);
      if (!is_place_in_doubt_) world_.arena = arena;
    }
    read_one("floor", root, "floor", &world_.floor);
    if (!world_.floor.image.empty()) {
      const std::string wrong = read_floor_image(resolve_path(world_, world_.floor.image), world_.floor);
      const toml::node* node = root["floor"]["image"].node();
      if (!wrong.empty()) problem(node->source(), "floor.image: " + wrong);
      if (!root.get("arena"))
        problem(node->source(), "floor.image: got an image but no [arena], expected an arena to lay it in");
    }
    read_one("sky", root, "sky", &world_.sky);
    read_one("proximity", root, "proximity", &world_.proximity);
    read_many("ramp", root, "ramp", [&](const toml::table& t) {
      RampDesc r;
      r.line = line_of(t);
      const bool is_placed = read_place(section("ramp"), t, &r);
      if (!t.get("angle") && !t.get("heights")) {
        problem(t.source(), "ramp: got neither angle nor heights, expected one of them (deg; m)");
        return;
      }
      if (is_placed) world_.ramps.push_back(std::move(r));
    });
    // What several robots share, then what stands about.
    read_one("radio", root, "radio", &world_.radio);
    read_one("bluetooth", root, "bluetooth", &world_.link);
    read_one("webots", root, "webots", &world_.webots);
    read_many("wall", root, "wall", [&](const toml::table& t) {
      WallDesc w;
      w.line = line_of(t);
      if (read_place(section("wall"), t, &w)) world_.walls.push_back(std::move(w));
    });
    read_objects(root, "box", ObjectKind::Box);
    read_objects(root, "cylinder", ObjectKind::Cylinder);
    read_objects(root, "ball", ObjectKind::Ball);
    read_objects(root, "polygon", ObjectKind::Polygon);
    read_many("lamp", root, "lamp", [&](const toml::table& t) {
      LampDesc lamp;
      read_table("lamp", t, &lamp);
      world_.lamps.push_back(std::move(lamp));
    });
    // Sounds, robots and supervisors.
    read_sounds(root);
    read_robots(root);
    read_many("supervisor", root, "supervisor", [&](const toml::table& t) {
      SupervisorDesc s;
      s.line = line_of(t);
      read_table("supervisor", t, &s);
      s.program_at = place_of(t.get("program"));
      read_devices("supervisor.device", t, s.devices);
      world_.supervisors.push_back(std::move(s));
    });
  }

  void read_sounds(const toml::table& root) {
    read_many("sound", root, "sound", [&](const toml::table& t) {
      SoundDesc sound;
      sound.line = line_of(t);
      read_table("sound", t, &sound);
      if (sound.kind == SoundKind::Wav) {
        WavSound wav;
        const toml::node* file = t.get("file");
        const std::string wrong = file ? read_wav(resolve_path(world_, sound.file), wav)
                                       : "missing, expected the name of a WAV file, since kind is \"wav\"";
        if (!wrong.empty()) problem(file ? file->source() : t.source(), "sound.file: " + wrong);
        sound.samples = std::move(wav.samples);
        sound.sample_rate_hz = wav.rate_hz;
      }
      if (sound.stop_s <= sound.start_s)
        problem(t.get("stop") ? t.get("stop")->source() : t.source(),
                fmt::format("sound.stop: got {} s, expected more than the start at {} s", sound.stop_s,
                            sound.start_s));
      world_.sounds.push_back(std::move(sound));
    });
  }

  /// Of a robot's variation: a number for each sensor, or none.
  void check_count(const toml::table& variation, const char* key, std::size_t got, std::size_t sensors) {
    if (got > 0 && got != sensors)
      problem(
          variation.get(key)->source(),
          fmt::format("robot.variation.{}: got {} numbers, expected {}, one per sensor", key, got, sensors));
  }

  void read_robots(const toml::table& root) {
    read_many("robot", root, "robot", [&](const toml::table& t) {
      RobotDesc r;
      r.name = "robot" + std::to_string(world_.robots.size());
      r.line = line_of(t);
      if (!read_place(robot_keys(t), t, &r)) unplaced_robots_.push_back(world_.robots.size());
      r.firmware_at = place_of(t.get("firmware"));
      read_one("robot.variation", t, "variation", &r.variation);
      if (const toml::table* variation = t["variation"].as_table())
        if (const RobotModel* model = world_.model_of(r)) {
          check_count(*variation, "sensor_gain", r.variation.sensor_gain.size(), model->proximity.size());
          check_count(*variation, "sensor_offset", r.variation.sensor_offset_counts.size(),
                      model->proximity.size());
        }
      read_one("robot.proximity", t, "proximity", &r.proximity);
      read_one("robot.bluetooth", t, "bluetooth", &r.link);
      read_many("robot.sensor", t, "sensor", [&](const toml::table& st) {
        SensorDesc s;
        read_table("robot.sensor", st, &s);
        const RobotModel* model = world_.model_of(r);
        if (model && s.index >= static_cast<int>(model->proximity.size())) {
          problem(st.source(), fmt::format("robot.sensor.index: got {}, expected 0 to {}", s.index,
                                           static_cast<int>(model->proximity.size()) - 1));
        }
        for (const SensorDesc& other : r.sensors) {
          if (other.index == s.index) {
            problem(
                st.source(),
                fmt::format("robot.sensor.index: got {} a second time, expected each sensor once", s.index));
          }
        }
        r.sensors.push_back(std::move(s));
      });
      read_many("robot.part", t, "part", [&](const toml::table& pt) { read_part(pt, r); });
      read_many("robot.key", t, "key", [&](const toml::table& kt) {
        KeyDesc key;
        read_table("robot.key", kt, &key);
        r.keys.push_back(key);
      });
      read_devices("robot.device", t, r.devices);
      world_.robots.push_back(std::move(r));
    });
  }

  void read_devices(const char* path, const toml::table& table, std::vector<DeviceDesc>& devices) {
    read_many(path, table, "device", [&](const toml::table& dt) {
      DeviceDesc device;
      device.line = line_of(dt);
      read_table(path, dt, &device);
      const bool is_lidar = device.kind == DeviceKind::Lidar;
      if (is_lidar && !dt.contains("height")) device.height = 1;
      if (is_lidar || device.kind == DeviceKind::RangeFinder) check_ranges(path, dt, device);
      for (const DeviceDesc& other : devices) {
        if (other.name == device.name)
          problem(dt.source(), fmt::format("{}.name: got \"{}\" a second time, expected each device once",
                                           path, device.name));
      }
      if (device.near_m >= device.far_m)
        problem(dt.get("near") ? dt.get("near")->source() : dt.source(),
                fmt::format("{}.near: got {} m, expected less than far, {} m", path, device.near_m,
                            device.far_m));
      devices.push_back(std::move(device));
    });
  }

  void check_ranges(const char* path, const toml::table& table, const DeviceDesc& device) {
    const int all = device.width * device.height;
    if (all <= kMostRanges) return;
    const toml::node* side = table.get(table.contains("width") ? "width" : "height");
    problem(side ? side->source() : table.source(),
            fmt::format("{}.width: got {} columns and {} rows, {} distances, expected at most {}", path,
                        device.width, device.height, all, kMostRanges));
  }

  /// The keys that a robot may have depend on its model, which is therefore looked at first.
  const SectionSpec& robot_keys(const toml::table& table) {
    if (world_.models.empty()) return section("robot");
    RobotDesc robot;
    if (const toml::node* model = table.get("model"); model && model->is_string())
      robot.model = model->as_string()->get();
    const RobotModel* model = world_.model_of(robot);
    if (!model) model = &world_.models.front();
    const auto [at, is_new] = robot_sections_.try_emplace(model);
    if (is_new) at->second = robot_section(*model);
    return at->second;
  }

  /// The keys that a part may have depend on its kind, which is therefore looked at first.
  void read_part(const toml::table& table, RobotDesc& robot) {
    PartDesc part;
    part.line = line_of(table);
    part.column = static_cast<int>(table.source().begin.column);
    std::vector<std::string> names;
    std::string known;
    const toml::node* written_kind = table.get("kind");
    const std::string name =
        written_kind && written_kind->is_string() ? written_kind->as_string()->get() : std::string();
    for (const PartKind& kind : world_.part_kinds) {
      if (kind.name == name) {
        read_table(part_section(kind), table, &part);
        robot.parts.push_back(std::move(part));
        return;
      }
      names.push_back(kind.name);
      known += (known.empty() ? "" : ", ") + kind.name;
    }
    problem(written_kind ? written_kind->source() : table.source(),
            fmt::format("robot.part.kind: {}, expected one of {}{}",
                        written_kind ? "got " + written(*written_kind) : std::string("missing"), known,
                        did_you_mean_tail(name, names)));
  }

  static FilePlace place_of(const toml::node* node) {
    if (!node) return {};
    return {static_cast<int>(node->source().begin.line), static_cast<int>(node->source().begin.column)};
  }

  WorldDesc world_;
  std::vector<std::size_t> unplaced_robots_;  // nobody knows where they are, or how large
  std::map<const RobotModel*, SectionSpec> robot_sections_;
};

}  // namespace

std::string LoadedWorld::report(std::string_view file) const {
  std::string out;
  for (const WorldProblem& p : problems) {
    if (!out.empty()) out += '\n';
    out += p.line > 0 ? fmt::format("{}:{}:{}: {}", file, p.line, p.column, p.text)
                      : fmt::format("{}: {}", file, p.text);
  }
  return out;
}

void LoadedWorld::add(std::vector<WorldProblem> more) {
  // a list that was cut off stays as it is: it says how many are missing
  if (more.empty() || problems.size() > kMostProblems) return;
  problems.insert(problems.end(), more.begin(), more.end());
  sort_by_place(problems);
  if (world) draft = std::move(*world);
  world.reset();
}

LoadedWorld load_world(const std::string& path, const std::vector<RobotModel>& models,
                       const std::vector<PartKind>& part_kinds) {
  std::string text;
  const std::string wrong = read_input_file(path, kLongestWorld, text);
  if (!wrong.empty()) {
    LoadedWorld out;
    out.problems.push_back({0, 0, wrong});
    return out;
  }
  return parse_world(text, path, models, part_kinds);
}

LoadedWorld parse_world(std::string_view text, const std::string& path, const std::vector<RobotModel>& models,
                        const std::vector<PartKind>& part_kinds, KnownWorld* known) {
  if (known && !known->tree) known->tree = std::make_shared<TomlTree>();
  return Reader(path, models, part_kinds, known ? known->tree.get() : nullptr).read(text);
}

std::string resolve_path(const WorldDesc& world, const std::string& name) {
  const std::size_t slash = world.file.rfind('/');
  if (name.empty() || name.front() == '/' || slash == std::string::npos) return name;
  return world.file.substr(0, slash + 1) + name;
}

}  // namespace sim
