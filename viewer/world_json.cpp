// SPDX-License-Identifier: MIT
#include "viewer/world_json.h"

#include <algorithm>
#include <cmath>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"
#include "sim_core/sound/sound_source.h"
#include "viewer/base64.h"

namespace viewer {

namespace {

using Json = nlohmann::json;

Json colour(const sim::Colour& c) { return {c.r, c.g, c.b}; }
Json point(const sim::Vec2& p) { return {p.x, p.y}; }
Json point(const sim::Vec3& p) { return {p.x, p.y, p.z}; }

int id_at(const sim::WorldText& text, int line) {
  const auto* element = text.at_line(line);
  return element ? element->id : 0;
}

/// Number of the n-th piece of that path; what has no line is found so.
int nth_id(const sim::WorldText& text, const char* path, int n) {
  for (const auto& e : text.elements())
    if (e.path == path && n-- == 0) return e.id;
  return 0;
}

const char* kind_of(sim::ObjectKind kind) {
  switch (kind) {
    case sim::ObjectKind::Box:
      return "box";
    case sim::ObjectKind::Cylinder:
      return "cylinder";
    case sim::ObjectKind::Ball:
      return "ball";
    case sim::ObjectKind::Polygon:
      break;
  }
  return "polygon";
}

/// dB SPL of a root mean square pressure.
double level_of_pressure_db(double pa) {
  return 20 * std::log10(std::max(pa, 1e-9) / sim::pressure_of_level_pa(0));
}

Json pose(Json piece, const sim::Pose2& p) {
  piece["position"] = {p.x_m, p.y_m};
  piece["heading"] = p.heading_rad;
  return piece;
}

const char* type_name(sim::ValueType type) {
  switch (type) {
    case sim::ValueType::Integer:
      return "integer";
    case sim::ValueType::Number:
      return "number";
    case sim::ValueType::Bytes:
    case sim::ValueType::Text:
      return "text";
    case sim::ValueType::Flag:
      return "flag";
    case sim::ValueType::Choice:
      return "choice";
    case sim::ValueType::Pair:
      return "pair";
    case sim::ValueType::Triple:
      return "triple";
    case sim::ValueType::Colour:
      return "colour";
    case sim::ValueType::Numbers:
      return "numbers";
    case sim::ValueType::Points:
      return "points";
    case sim::ValueType::Colours:
      return "colours";
    case sim::ValueType::Rows:
      break;
  }
  return "rows";
}

}  // namespace

Json world_json(const sim::LoadedWorld& loaded, const sim::WorldText& text, const std::string& base,
                const twin::Twin* twin, const std::vector<int>& movable) {
  const sim::WorldDesc& world = loaded.world ? *loaded.world : loaded.draft;
  Json out{{"title", world.title},
           {"file", world.file},
           {"text", text.text()},
           {"base", base},
           {"tick_s", 1.0 / world.physics_hz}};
  out["step_s"] = world.webots.time_step_s;
  if (world.arena) {
    const sim::ArenaDesc& a = *world.arena;
    out["arena"] = {{"id", nth_id(text, "arena", 0)},       {"size", point(a.size_m)},
                    {"centre", point(a.centre_m)},          {"wall_height", a.wall_height_m},
                    {"wall_thickness", a.wall_thickness_m}, {"colour", colour(a.material.colour)}};
  }
  out["floor"] = {{"colour", colour(world.floor.colour)},
                  {"image", world.floor.image_rgb.empty() ? "" : world.floor.image}};
  Json things = Json::array();
  for (const sim::WallDesc& w : world.walls) {
    Json points = Json::array();
    for (const sim::Vec2& p : w.points_m) points.push_back(point(p));
    things.push_back({{"id", id_at(text, w.line)},
                      {"kind", "wall"},
                      {"points", points},
                      {"closed", w.closed},
                      {"thickness", w.thickness_m},
                      {"height", w.height_m},
                      {"z", w.z_m},
                      {"colour", colour(w.material.colour)}});
  }
  const auto body_of_object = [&](int id) {
    const auto at = std::find(movable.begin(), movable.end(), id);
    return !twin || at == movable.end() ? -1 : twin->robots() + static_cast<int>(at - movable.begin());
  };
  for (const sim::ObjectDesc& o : world.objects) {
    Json thing{{"id", id_at(text, o.line)},
               {"kind", kind_of(o.kind)},
               {"name", o.name},
               {"size", point(o.size_m)},
               {"radius", o.radius_m},
               {"z", o.z_m},
               {"colour", colour(o.material.colour)},
               {"movable", o.movable}};
    for (const sim::Vec2& c : o.corners_m) thing["corners"].push_back(point(c));
    if (o.movable) thing["body"] = body_of_object(thing["id"].get<int>());
    things.push_back(pose(std::move(thing), o.pose));
  }
  for (const sim::RampDesc& r : world.ramps)
    things.push_back(pose({{"id", id_at(text, r.line)},
                           {"kind", "ramp"},
                           {"name", r.name},
                           {"size", point(r.size_m)},
                           {"low", r.low_m},
                           {"high", r.high_m},
                           {"colour", colour(r.material.colour)}},
                          r.pose));
  for (std::size_t i = 0; i < world.lamps.size(); ++i) {
    const sim::LampDesc& l = world.lamps[i];
    things.push_back({{"id", nth_id(text, "lamp", static_cast<int>(i))},
                      {"kind", "lamp"},
                      {"name", l.name},
                      {"position", point(l.position_m)},
                      {"intensity", l.intensity_w_m2},
                      {"attenuation", l.attenuation},
                      {"on", l.on},
                      {"colour", colour(l.colour)}});
  }
  for (const sim::SoundDesc& s : world.sounds)
    things.push_back({{"id", id_at(text, s.line)},
                      {"kind", "sound"},
                      {"name", s.name},
                      {"position", point(s.position_m)},
                      {"level", s.pressure_pa ? level_of_pressure_db(*s.pressure_pa) : s.level_db},
                      {"colour", {0.8, 0.47, 0.65}}});
  out["things"] = std::move(things);
  Json robots = Json::array();
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    const sim::RobotDesc& r = world.robots[i];
    const sim::RobotModel* m = world.model_of(r);
    if (!m) continue;
    Json leds = Json::array(), sensors = Json::array();
    for (const sim::LedMount& led : m->leds)
      leds.push_back({led.at_m.x, led.at_m.y, led.z_m, led.colour.r, led.colour.g, led.colour.b});
    for (const sim::SensorMount& s : m->proximity)
      sensors.push_back({s.at_m.x, s.at_m.y, s.at_m.z, s.yaw_rad});
    Json parts = Json::array();
    for (const sim::PartDesc& part : r.parts) parts.push_back(part.kind);
    robots.push_back(pose({{"id", id_at(text, r.line)},
                           {"kind", "robot"},
                           {"name", r.name},
                           {"firmware", r.firmware},
                           {"body", twin ? twin->find(r.name) : -1},
                           {"colour", colour(r.colour ? *r.colour : m->colour)},
                           {"radius", m->body_radius_m},
                           {"z0", m->body_z0_m},
                           {"height", m->body_height_m},
                           {"wheel_radius", m->wheel_radius_m},
                           {"axle", m->axle_m},
                           {"parts", parts},
                           {"leds", leds},
                           {"sensors", sensors}},
                          r.pose));
  }
  out["robots"] = std::move(robots);
  Json elements = Json::array();
  for (const auto& e : text.elements()) {
    Json values = Json::object();
    for (const auto& [key, value] : text.values(e.id)) values[key] = value;
    std::string name = text.value(e.id, "name");
    if (name.size() > 1) name = name.substr(1, name.size() - 2);
    elements.push_back({{"id", e.id},
                        {"path", e.path},
                        {"name", name},
                        {"line", e.first_line},
                        {"last_line", e.last_line},
                        {"values", values}});
  }
  out["elements"] = std::move(elements);
  Json problems = Json::array();
  for (const sim::WorldProblem& p : loaded.problems)
    problems.push_back({{"line", p.line},
                        {"column", p.column},
                        {"text", p.text},
                        {"id", p.line > 0 ? id_at(text, p.line) : 0}});
  out["problems"] = std::move(problems);
  return out;
}

Json floor_json(const sim::FloorDesc& floor) {
  return {{"width", floor.image_width},
          {"height", floor.image_height},
          {"rgb", base64(std::string(floor.image_rgb.begin(), floor.image_rgb.end()))}};
}

std::vector<int> movable_ids(const sim::WorldDesc& world, const sim::WorldText& text) {
  std::vector<int> ids;
  for (const sim::ObjectDesc& o : world.objects)
    if (o.movable) ids.push_back(id_at(text, o.line));
  return ids;
}

Json key_json(const char* type, const std::string& choices, double least, double most, Json key) {
  key["type"] = type;
  if (!choices.empty()) key["choices"] = choices;
  if (least < most) key["range"] = {least, most};
  return key;
}

Json schema_json() {
  Json out = Json::object();
  for (const sim::SectionSpec& section : sim::world_schema()) {
    Json keys = Json::array();
    for (const sim::KeySpec& k : section.keys)
      keys.push_back(key_json(type_name(k.type), k.choices, k.least, k.most,
                              {{"key", k.key}, {"unit", k.unit}, {"default", k.fallback}, {"doc", k.doc}}));
    out[section.path] = {{"many", section.many}, {"doc", section.doc}, {"keys", keys}};
  }
  // what only robots of a kind have
  constexpr const char* kTypes[] = {"number", "integer", "flag",   "text",
                                    "choice", "pair",    "triple", "numbers"};
  for (const sim::RobotModel& model : twin::robot_models())
    for (const sim::OwnKey& k : model.keys)
      out["robot"]["keys"].push_back(
          key_json(kTypes[static_cast<int>(k.type)], k.choices, k.least, k.most,
                   {{"key", k.key}, {"unit", k.unit}, {"default", k.fallback}, {"doc", k.doc}}));
  Json& kinds = out["robot.part"]["kinds"] = Json::array();
  for (const sim::PartKind& kind : board::part_kinds())
    kinds.push_back({{"kind", kind.name}, {"doc", kind.doc}});
  return out;
}

}  // namespace viewer
