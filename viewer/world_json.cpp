// SPDX-License-Identifier: MIT
#include "viewer/world_json.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/base/base64.h"
#include "sim_core/base/common_ends.h"
#include "sim_core/load/schema.h"
#include "sim_core/sound/sound_source.h"

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

/// Pieces that stand for themselves: nothing else is another where one of them is.
bool is_drawn(const std::string& path) {
  for (const char* drawn : {"box", "cylinder", "ball", "polygon", "wall", "ramp", "lamp", "sound", "robot"})
    if (path == drawn) return true;
  return false;
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

namespace {

/// Tells a world, or what became other in it.
class Teller {
 public:
  /// `only`: the pieces that are told whole; null: all.
  Teller(const sim::LoadedWorld& loaded, const sim::WorldText& text, const twin::Twin* twin,
         const std::vector<int>& movable, const std::set<int>* only)
      : loaded_(loaded),
        world_(loaded.world ? *loaded.world : loaded.draft),
        text_(text),
        twin_(twin),
        movable_(movable),
        only_(only) {}

  Json head(const std::string& base) const {
    Json out{
        {"title", world_.title}, {"file", world_.file}, {"base", base}, {"tick_s", 1.0 / world_.physics_hz}};
    out["step_s"] = world_.webots.time_step_s;
    if (world_.arena) {
      const sim::ArenaDesc& a = *world_.arena;
      out["arena"] = {{"id", nth_id(text_, "arena", 0)},      {"size", point(a.size_m)},
                      {"centre", point(a.centre_m)},          {"wall_height", a.wall_height_m},
                      {"wall_thickness", a.wall_thickness_m}, {"colour", colour(a.material.colour)}};
    }
    out["floor"] = {{"colour", colour(world_.floor.colour)},
                    {"image", world_.floor.image_rgb.empty() ? "" : world_.floor.image}};
    Json problems = Json::array();
    for (const sim::WorldProblem& p : loaded_.problems)
      problems.push_back({{"line", p.line},
                          {"column", p.column},
                          {"text", p.text},
                          {"id", p.line > 0 ? id_at(text_, p.line) : 0}});
    out["problems"] = std::move(problems);
    return out;
  }

  void things() {
    for (const sim::WallDesc& w : world_.walls)
      piece(id_at(text_, w.line), [&](int id) { return wall(id, w); });
    for (const sim::ObjectDesc& o : world_.objects)
      piece(id_at(text_, o.line), [&](int id) { return object(id, o); });
    for (const sim::RampDesc& r : world_.ramps)
      piece(id_at(text_, r.line), [&](int id) {
        return pose({{"id", id},
                     {"kind", "ramp"},
                     {"name", r.name},
                     {"size", point(r.size_m)},
                     {"low", r.low_m},
                     {"high", r.high_m},
                     {"colour", colour(r.material.colour)}},
                    r.pose);
      });
    for (std::size_t i = 0; i < world_.lamps.size(); ++i)
      piece(nth_id(text_, "lamp", static_cast<int>(i)), [&](int id) { return lamp(id, world_.lamps[i]); });
    for (const sim::SoundDesc& s : world_.sounds)
      piece(id_at(text_, s.line), [&](int id) {
        return Json{{"id", id},
                    {"kind", "sound"},
                    {"name", s.name},
                    {"position", point(s.position_m)},
                    {"level", s.pressure_pa ? level_of_pressure_db(*s.pressure_pa) : s.level_db},
                    {"colour", {0.8, 0.47, 0.65}}};
      });
  }

  void robots() {
    for (const sim::RobotDesc& r : world_.robots)
      if (const sim::RobotModel* model = world_.model_of(r))
        piece(id_at(text_, r.line), [&](int id) { return robot(id, r, *model); });
  }

  void elements() {
    for (const auto& e : text_.elements())
      piece(e.id, [&](int id) {
        Json values = Json::object();
        for (const auto& [key, value] : text_.values(id)) values[key] = value;
        std::string name = text_.value(id, "name");
        if (name.size() > 1) name = name.substr(1, name.size() - 2);
        return Json{{"id", id},
                    {"path", e.path},
                    {"name", name},
                    {"line", e.first_line},
                    {"last_line", e.last_line},
                    {"values", values}};
      });
  }

  /// What was told since the last time: whole pieces, and the ids of all in their order.
  Json take() {
    order_.clear();
    return std::exchange(told_, Json::array());
  }
  Json take_changes() {
    Json out{{"fresh", std::exchange(told_, Json::array())}, {"order", order_}};
    order_.clear();
    return out;
  }

 private:
  template <typename Tell>
  void piece(int id, Tell tell) {
    order_.push_back(id);
    if (!only_ || only_->count(id) > 0) told_.push_back(tell(id));
  }

  static Json wall(int id, const sim::WallDesc& w) {
    Json points = Json::array();
    for (const sim::Vec2& p : w.points_m) points.push_back(point(p));
    return {{"id", id},
            {"kind", "wall"},
            {"points", points},
            {"closed", w.closed},
            {"thickness", w.thickness_m},
            {"height", w.height_m},
            {"z", w.z_m},
            {"colour", colour(w.material.colour)}};
  }

  Json object(int id, const sim::ObjectDesc& o) const {
    Json thing{{"id", id},
               {"kind", kind_of(o.kind)},
               {"name", o.name},
               {"size", point(o.size_m)},
               {"radius", o.radius_m},
               {"z", o.z_m},
               {"colour", colour(o.material.colour)},
               {"movable", o.movable}};
    for (const sim::Vec2& c : o.corners_m) thing["corners"].push_back(point(c));
    if (o.movable) {
      const auto at = std::find(movable_.begin(), movable_.end(), id);
      thing["body"] =
          !twin_ || at == movable_.end() ? -1 : twin_->robots() + static_cast<int>(at - movable_.begin());
    }
    return pose(std::move(thing), o.pose);
  }

  static Json lamp(int id, const sim::LampDesc& l) {
    return {{"id", id},
            {"kind", "lamp"},
            {"name", l.name},
            {"position", point(l.position_m)},
            {"intensity", l.intensity_w_m2},
            {"attenuation", l.attenuation},
            {"on", l.on},
            {"colour", colour(l.colour)}};
  }

  Json robot(int id, const sim::RobotDesc& r, const sim::RobotModel& m) const {
    Json leds = Json::array(), sensors = Json::array(), parts = Json::array();
    for (const sim::LedMount& led : m.leds)
      leds.push_back({led.at_m.x, led.at_m.y, led.z_m, led.colour.r, led.colour.g, led.colour.b});
    for (const sim::SensorMount& s : m.proximity)
      sensors.push_back({s.at_m.x, s.at_m.y, s.at_m.z, s.yaw_rad});
    for (const sim::PartDesc& part : r.parts) parts.push_back(part.kind);
    return pose({{"id", id},
                 {"kind", "robot"},
                 {"name", r.name},
                 {"firmware", r.firmware},
                 {"body", twin_ ? twin_->find(r.name) : -1},
                 {"colour", colour(r.colour ? *r.colour : m.colour)},
                 {"radius", m.body_radius_m},
                 {"z0", m.body_z0_m},
                 {"height", m.body_height_m},
                 {"wheel_radius", m.wheel_radius_m},
                 {"axle", m.axle_m},
                 {"parts", parts},
                 {"leds", leds},
                 {"sensors", sensors}},
                r.pose);
  }

  const sim::LoadedWorld& loaded_;
  const sim::WorldDesc& world_;
  const sim::WorldText& text_;
  const twin::Twin* const twin_;
  const std::vector<int>& movable_;
  const std::set<int>* const only_;
  Json told_ = Json::array();
  std::vector<int> order_;
};

/// Of a text that is split at line breaks: how many lines above stay, how many behind them go, and the lines
/// that come in their place.
Json changed_lines(const std::string& before, const std::string& after) {
  auto [head, tail] = sim::common_ends(before, after);
  // whole lines of both
  head = head == 0 ? 0 : before.rfind('\n', head - 1) + 1;
  const std::size_t line_break = after.find('\n', after.size() - tail);
  tail = line_break == std::string::npos ? 0 : after.size() - line_break - 1;
  const std::string_view gone = std::string_view(before).substr(head, before.size() - tail - head);
  std::string_view fresh = std::string_view(after).substr(head, after.size() - tail - head);
  const auto breaks = [](std::string_view text) { return std::count(text.begin(), text.end(), '\n'); };
  Json lines = Json::array();
  if (tail == 0 || !fresh.empty()) {
    if (tail > 0) fresh.remove_suffix(1);
    for (std::size_t from = 0; from <= fresh.size();) {
      const std::size_t to = std::min(fresh.find('\n', from), fresh.size());
      lines.push_back(fresh.substr(from, to - from));
      from = to + 1;
    }
  }
  return {{"above", breaks(std::string_view(before).substr(0, head))},
          {"gone", breaks(gone) + (tail == 0 ? 1 : 0)},
          {"lines", std::move(lines)}};
}

}  // namespace

Json world_json(const sim::LoadedWorld& loaded, const sim::WorldText& text, const std::string& base,
                const twin::Twin* twin, const std::vector<int>& movable) {
  Teller teller(loaded, text, twin, movable, nullptr);
  Json out = teller.head(base);
  out["text"] = text.text();
  teller.things();
  out["things"] = teller.take();
  teller.robots();
  out["robots"] = teller.take();
  teller.elements();
  out["elements"] = teller.take();
  return out;
}

std::optional<Json> world_changes(const Told& told, const sim::LoadedWorld& loaded,
                                  const sim::WorldText& text, const std::string& base, const twin::Twin* twin,
                                  const std::vector<int>& movable) {
  if (!told.is_good || !loaded.world || told.runs != (twin != nullptr)) return std::nullopt;
  std::set<int> fresh;
  // the arena, materials, settings and the like count for others, too
  for (const int id : text.differing(told.text)) {
    if (!is_drawn(text.find(id)->path)) return std::nullopt;
    fresh.insert(id);
  }
  for (const auto& e : told.text.elements())
    if (!is_drawn(e.path) && !text.find(e.id)) return std::nullopt;
  // bodies have numbers by the robots' order
  if (text.ids_of("robot") != told.text.ids_of("robot")) return std::nullopt;
  if (movable != told.movable) fresh.insert(movable.begin(), movable.end());
  Teller teller(loaded, text, twin, movable, &fresh);
  Json out{{"head", teller.head(base)}};
  out["text"] = changed_lines(told.text.text(), text.text());
  teller.things();
  out["things"] = teller.take_changes();
  teller.robots();
  out["robots"] = teller.take_changes();
  teller.elements();
  out["elements"] = teller.take_changes();
  std::vector<int> lines;
  for (const auto& e : text.elements()) {
    lines.push_back(e.first_line);
    lines.push_back(e.last_line);
  }
  out["elements"]["lines"] = std::move(lines);
  return out;
}

Json floor_json(const sim::FloorDesc& floor) {
  return {{"width", floor.image_width},
          {"height", floor.image_height},
          {"rgb", sim::base64(std::string(floor.image_rgb.begin(), floor.image_rgb.end()))}};
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
