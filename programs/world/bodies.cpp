// SPDX-License-Identifier: MIT
#include "programs/world/bodies.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "sim_core/base/input_file.h"
#include "sim_core/load/world_loader.h"

namespace programs {

using wbt::Affine;
using wbt::Vec3;

namespace {

constexpr double kParkedM = 900;    // where robots go that were removed
constexpr double kFarthest = 1000;  // m: worlds reach no further

bool is_upright(const Affine& frame, bool nue) { return (nue ? frame(1, 1) : frame(2, 2)) > 1 - 1e-9; }

std::vector<double> numbers_of(const Affine& frame) {
  return {frame.translation().begin(), frame.translation().end()};
}

bool is_near(const Affine& frame) {
  return frame.translation().allFinite() && frame.translation().cwiseAbs().maxCoeff() <= kFarthest;
}

}  // namespace

Bodies::Bodies(twin::Twin& twin) : twin_(twin) {
  read_file();
  protos_ = std::make_unique<wbt::ProtoFiles>(text_, options_.folder);
  tie_file();
  add_rest();
  tie();
  for (const int id : tree_.below(Tree::kRoot))
    if (tree_.node(id).is != Is::Plain) save(id, "__init__");
}

bool Bodies::is_nue() const { return twin_.world().webots.axes == sim::Axes::Nue; }

// the world's own file, or else just a release with its axes
void Bodies::read_file() {
  const sim::WorldDesc& w = twin_.world();
  options_.model = w.models.empty() ? sim::RobotModel{} : w.models.front();
  std::string text;
  if (!w.webots.world.empty()) {
    const std::filesystem::path file = sim::resolve_path(w, w.webots.world);
    if (sim::read_input_file(file, wbt::kLongestFile, text).empty()) {
      text_ = wbt::read_world_text(text);
      options_.file = file.filename().string();
      options_.folder = std::filesystem::absolute(file).parent_path().string();
    }
    if (!text_.errors.empty()) text_ = {};
  }
  if (!text_.version.empty()) return;
  text_.year = is_nue() ? 2021 : 2023;
  text_.letter = is_nue() ? 'a' : 'b';
  text_.version = is_nue() ? "R2021a" : "R2023b";
  if (is_nue()) {  // such files say it
    auto info = std::make_shared<wbt::Node>();
    info->type = "WorldInfo";
    info->fields.push_back({"coordinateSystem", 0, {}, {"NUE"}, {}, {}});
    text_.nodes.push_back(info);
  }
}

// which node each thing of the world was
void Bodies::tie_file() {
  if (options_.file.empty()) return;
  for (const wbt::NodePtr& n : text_.nodes) tree_.add(*n, Tree::kRoot, "children", -1, *protos_);
  // Of several nodes in one line the one that resembles the thing most.
  const auto node_at = [&](int line, const std::string& def, const std::string& name, Is is) {
    int best = 0, points = -1;
    for (const int id : tree_.at_line(line)) {
      const TreeNode& n = tree_.node(id);
      if (is != Is::Object && n.is != Is::Plain) continue;
      const bool holds = n.base == "Group" || n.base == "Transform" || n.base == "Pose";
      const int now = (n.def == def) + 2 * (n.text("name") == name) + 4 * (n.find("translation") && !holds) +
                      4 * (is == Is::Lamp && n.find("intensity"));
      if (now > points) best = id, points = now;
    }
    return best;
  };
  const sim::WorldDesc& w = twin_.world();
  const auto tie_one = [&](int line, const std::string& def, const std::string& name, Is is,
                           std::size_t number) {
    const int id = line > 0 ? node_at(line, def, name, is) : 0;
    if (id == 0) return;
    tree_.node(id).is = is;
    tree_.node(id).number = static_cast<int>(number);
  };
  // Robots, supervisors and lamps are one node each; an object's node may own several bodies.
  for (std::size_t i = 0; i < w.robots.size(); ++i)
    tie_one(w.robots[i].node, w.robots[i].def, w.robots[i].name, Is::Robot, i);
  for (std::size_t i = 0; i < w.supervisors.size(); ++i)
    tie_one(w.supervisors[i].node, w.supervisors[i].def, w.supervisors[i].name, Is::Supervisor, i);
  for (std::size_t i = 0; i < w.lamps.size(); ++i) tie_one(w.lamps[i].node, w.lamps[i].name, "", Is::Lamp, i);
  owner_.assign(w.objects.size(), 0);
  for (std::size_t i = 0; i < w.objects.size(); ++i) {
    const sim::ObjectDesc& o = w.objects[i];
    const int id = o.node > 0 ? node_at(o.node, o.def, o.name, Is::Object) : 0;
    owner_[i] = id;
    if (id != 0 && tree_.node(id).is == Is::Plain) tree_.node(id).is = Is::Object;
  }
}

// what no file tells of
void Bodies::add_rest() {
  const sim::WorldDesc& w = twin_.world();
  owner_.resize(w.objects.size(), 0);
  // Nodes for what has none yet: the world itself where there is no file, then lamps,
  // objects, robots, supervisors.
  const auto add = [&](const char* type, const std::string& def, const std::string& name, Is is,
                       std::size_t number) {
    const int id = tree_.add(type, def, Tree::kRoot, "children");
    tree_.node(id).is = is;
    tree_.node(id).number = static_cast<int>(number);
    if (!name.empty()) tree_.set(id, "name", name);
    return id;
  };
  if (options_.file.empty()) {
    const int info = add("WorldInfo", "", "", Is::Plain, 0);
    tree_.set(info, "title", w.title);
    tree_.set(info, "basicTimeStep", kFloat, {1000 * w.webots.time_step_s});
    tree_.set(info, "gravity", kFloat, {w.gravity_m_s2});
    add("Viewpoint", "", "", Is::Plain, 0);
    if (w.arena) {
      const int arena = add("RectangleArena", "", "", Is::Plain, 0);
      tree_.set(arena, "floorSize", kVec2, {w.arena->size_m.x, w.arena->size_m.y});
      tree_.set(arena, "wallHeight", kFloat, {w.arena->wall_height_m});
      const sim::Vec3 at = out({w.arena->centre_m.x, w.arena->centre_m.y, 0});
      tree_.set(arena, "translation", kVec3, {at.x, at.y, at.z});
    }
  }
  for (std::size_t i = 0; i < w.lamps.size(); ++i) {
    if (node_of(Is::Lamp, static_cast<int>(i)) != 0) continue;
    const int id = add("PointLight", w.lamps[i].name, "", Is::Lamp, i);
    const sim::Vec3 at = out(w.lamps[i].position_m);
    tree_.set(id, "location", kVec3, {at.x, at.y, at.z});
    tree_.set(id, "intensity", kFloat, {w.lamps[i].intensity_w_m2});
    tree_.set(id, "on", kBool, {w.lamps[i].on ? 1.0 : 0.0});
  }
  for (std::size_t i = 0; i < w.objects.size(); ++i)
    if (owner_[i] == 0) owner_[i] = add_object(w.objects[i]);
  for (std::size_t i = 0; i < w.robots.size(); ++i) {
    const sim::RobotDesc& r = w.robots[i];
    int id = node_of(Is::Robot, static_cast<int>(i));
    if (id == 0) {
      id = add("E-puck", r.def, r.name, Is::Robot, i);
      tree_.set(id, "controller", r.firmware);
      tree_.set(id, "supervisor", kBool, {r.supervisor ? 1.0 : 0.0});
      tree_.set(id, "controllerArgs", kText + kList, {}).texts = sim::argument_words(r.args);
    }
    tree_.set(id, "name", r.name);
    tree_.set(id, "customData", r.custom_data);
  }
  for (std::size_t i = 0; i < w.supervisors.size(); ++i) {
    const sim::SupervisorDesc& s = w.supervisors[i];
    int id = node_of(Is::Supervisor, static_cast<int>(i));
    if (id == 0) {
      id = add("Robot", s.def, s.name, Is::Supervisor, i);
      tree_.set(id, "controller", s.program);
      tree_.set(id, "supervisor", kBool, {1});
      tree_.set(id, "controllerArgs", kText + kList, {}).texts = sim::argument_words(s.args);
    }
    tree_.set(id, "customData", s.custom_data);
  }
}

int Bodies::add_object(const sim::ObjectDesc& o) {
  // The node itself, with its place in the axes of programs.
  const int id = tree_.add("Solid", o.def, Tree::kRoot, "children");
  tree_.node(id).is = Is::Object;
  tree_.set(id, "name", o.name);
  tree_.set(id, "model", o.model);
  // its middle
  const Affine at = from_body(o.pose, o.z_m + 0.5 * o.size_m.z, false);
  tree_.set(id, "translation", kVec3, numbers_of(at));
  tree_.set(id, "rotation", kTurn, axis_angle(at, is_nue()));
  std::vector<double> colours;
  for (const sim::Colour& c : o.recognition_colours) colours.insert(colours.end(), {c.r, c.g, c.b});
  tree_.set(id, "recognitionColors", kColour + kList, colours);
  // Its shape stands there twice, to be seen and to be touched.
  const auto geometry = [&](int parent, const char* field) {
    if (o.kind == sim::ObjectKind::Polygon) return;
    const char* types[] = {"Box", "Cylinder", "Sphere"};
    const int shape = tree_.add(types[static_cast<int>(o.kind)], "", parent, field);
    if (o.kind == sim::ObjectKind::Box)
      tree_.set(shape, "size", kVec3,
                is_nue() ? std::vector<double>{o.size_m.x, o.size_m.z, o.size_m.y}
                         : std::vector<double>{o.size_m.x, o.size_m.y, o.size_m.z});
    else
      tree_.set(shape, "radius", kFloat, {o.radius_m});
    if (o.kind == sim::ObjectKind::Cylinder) tree_.set(shape, "height", kFloat, {o.size_m.z});
  };
  const int shape = tree_.add("Shape", "", id, "children");
  const int look = tree_.add("PBRAppearance", "", shape, "appearance");
  const sim::Colour& c = o.material.colour;
  tree_.set(look, "baseColor", kColour, {c.r, c.g, c.b});
  tree_.set(look, "roughness", kFloat, {o.material.roughness});
  geometry(shape, "geometry");
  geometry(id, "boundingObject");
  if (o.movable) {
    const int physics = tree_.add("Physics", "", id, "physics");
    tree_.set(physics, "density", kFloat, {-1});
    tree_.set(physics, "mass", kFloat, {o.mass_kg});
  }
  return id;
}

int Bodies::node_of(Is is, int number) const {
  for (int id = 1; id <= tree_.count(); ++id)
    if (tree_.node(id).is == is && tree_.node(id).number == number) return id;
  return 0;
}

// per object its body, per node its objects and where both are
void Bodies::tie() {
  const sim::Layout& layout = twin_.simulation().scene().layout();
  const std::vector<sim::ObjectDesc>& objects = twin_.world().objects;
  body_of_.assign(objects.size(), -1);
  for (std::size_t i = 0; i < layout.loose_object.size(); ++i)
    body_of_[static_cast<std::size_t>(layout.loose_object[i])] = twin_.robots() + static_cast<int>(i);
  std::map<int, std::vector<int>> objects_of;
  for (std::size_t i = 0; i < objects.size(); ++i) objects_of[owner_[i]].push_back(static_cast<int>(i));
  for (auto at = pieces_.begin(); at != pieces_.end();)
    at = objects_of.count(at->first) ? std::next(at) : pieces_.erase(at);
  for (auto& [id, list] : objects_of) {
    const bool is_new = !pieces_.count(id);
    if (!is_new) {
      pieces_[id].objects = list;
      continue;
    }
    const sim::ObjectDesc& first = objects[static_cast<std::size_t>(list.front())];
    Piece piece;
    // before it is one: its own fields say where it is
    piece.start = rigid(pose(tree_.node(id).parent) * tree_.local(id));
    piece.body = from_body(first.pose, first.z_m, false);
    piece.objects = std::move(list);
    pieces_[id] = std::move(piece);
  }
}

// --- poses

sim::Vec3 Bodies::out(sim::Vec3 p) const {
  const double up = p.z + twin_.world().webots.floor_m;
  return is_nue() ? sim::Vec3{p.x, up, -p.y} : sim::Vec3{p.x, p.y, up};
}

sim::Vec3 Bodies::in(sim::Vec3 p) const {
  const double floor = twin_.world().webots.floor_m;
  return is_nue() ? sim::Vec3{p.x, -p.z, p.y - floor} : sim::Vec3{p.x, p.y, p.z - floor};
}

Affine Bodies::from_body(const sim::Pose2& pose, double z_m, bool robot) const {
  // robots look along -z at angle 0 where y is up, objects keep their x axis
  const double angle = is_nue() && robot ? pose.heading_rad - sim::kPi / 2 : pose.heading_rad;
  Affine frame = wbt::turned(is_nue() ? Vec3::UnitY() : Vec3::UnitZ(), angle);
  const sim::Vec3 at = out({pose.x_m, pose.y_m, z_m});
  frame.translation() = Vec3(at.x, at.y, at.z);
  return frame;
}

void Bodies::to_body(const Affine& frame, bool robot, sim::Pose2& pose, double& z_m) const {
  const sim::Vec3 at = in(wbt::plain(frame.translation()));
  const Vec3 ahead = frame.linear() * (is_nue() && robot ? Vec3(0, 0, -1) : Vec3(1, 0, 0));
  pose.x_m = at.x;
  pose.y_m = at.y;
  // a turn about another axis than up leaves what it does to the heading
  pose.heading_rad = std::atan2(is_nue() ? -ahead.z() : ahead.y(), ahead.x());
  z_m = robot ? 0 : std::max(0.0, at.z);  // a robot falls to the floor
}

int Bodies::moving_body(int id) const {
  const TreeNode& n = tree_.node(id);
  if (n.is == Is::Robot) return n.number;
  const auto piece = pieces_.find(id);
  return piece != pieces_.end() ? body_of(piece->second.objects.front()) : -1;
}

Affine Bodies::pose(int id) const {
  if (id <= Tree::kRoot) return {};
  const TreeNode& n = tree_.node(id);
  const int body = moving_body(id);
  if (body < 0 || n.gone) return rigid(pose(n.parent) * tree_.local(id));
  const sim::BodyState state = twin_.simulation().state(body);
  Affine now = from_body(state.pose, state.z_m, n.is == Is::Robot);
  if (n.is == Is::Robot) return now;
  const Piece& piece = pieces_.at(id);
  return now * piece.body.inverse(Eigen::Isometry) * piece.start;
}

Vec3 Bodies::centre_of_mass(int id) const {
  const Affine frame = pose(id);
  const TreeNode& n = tree_.node(id);
  if (n.is != Is::Robot) return frame.translation();
  const sim::WorldDesc& world = twin_.world();
  const sim::Vec3 c = world.model_of(world.robots[static_cast<std::size_t>(n.number)])->centre_of_mass_m;
  return frame * (is_nue() ? Vec3(-c.y, c.z, -c.x) : Vec3(c.x, c.y, c.z));
}

std::vector<double> Bodies::place(int id, const std::string& field) const {
  const TreeNode& n = tree_.node(id);
  if (moving_body(id) < 0)
    return n.numbers(field, field == "translation" ? std::vector<double>(3) : std::vector<double>(4));
  const Affine own = pose(n.parent).inverse(Eigen::Isometry) * pose(id);
  return field == "translation" ? numbers_of(own) : axis_angle(own, is_nue());
}

/// The tree's own fields say what the engine has.
void Bodies::sync(int id) {
  if (moving_body(id) < 0) return;
  std::vector<double> t = place(id, "translation"), r = place(id, "rotation");
  tree_.set(id, "translation", kVec3, std::move(t));
  tree_.set(id, "rotation", kTurn, std::move(r));
}

void Bodies::put_body(int body, const Affine& frame, bool robot) {
  sim::Pose2 pose;
  double z_m = 0;
  to_body(frame, robot, pose, z_m);
  twin_.simulation().move(body, pose, z_m);
  if (robot && moved) moved(body);
}

void Bodies::put(int id, const Affine& frame) {
  const int body = moving_body(id);
  if (tree_.node(id).is == Is::Robot) return put_body(body, frame, true);
  const Piece& piece = pieces_.at(id);
  put_body(body, frame * piece.start.inverse(Eigen::Isometry) * piece.body, false);
}

std::string Bodies::set_place(int id, const std::string& field, const std::vector<double>& numbers) {
  sync(id);
  const std::vector<double> old = place(id, field);
  std::map<int, Affine> before;
  for (const int n : tree_.below(id))
    if (pieces_.count(n)) sync(n), before[n] = pose(n);
  tree_.set(id, field, field == "translation" ? kVec3 : kTurn, numbers);
  const Affine to = rigid(pose(tree_.node(id).parent) * tree_.local(id));
  if (!is_near(to)) {
    tree_.set(id, field, field == "translation" ? kVec3 : kTurn, old);
    return "got a place beyond 1000 m; it stays where it is";
  }
  if (moving_body(id) >= 0)
    put(id, to);
  else
    shift(id, before);
  return {};
}

// what stood somewhere stands somewhere else, as the fields say
void Bodies::shift(int id, const std::map<int, Affine>& before) {
  if (before.empty()) return;
  Made made;
  std::set<int> cleared;
  for (const auto& [n, was] : before) {
    if (moving_body(n) >= 0) {  // its place within its parent stays
      put(n, rigid(pose(tree_.node(n).parent) * tree_.local(n)));
      continue;
    }
    const Affine way = pose(n) * was.inverse(Eigen::Isometry);
    if (!is_upright(way, is_nue())) return derive(id, true);
    cleared.insert(n);
    for (const int object : pieces_.at(n).objects) {
      sim::ObjectDesc o = twin_.world().objects[static_cast<std::size_t>(object)];
      const Affine to = way * from_body(o.pose, o.z_m, false);
      to_body(to, false, o.pose, o.z_m);
      made[n].push_back(std::move(o));
    }
  }
  if (!cleared.empty()) apply(cleared, made, false);
}

std::vector<double> Bodies::velocity(int id) const {
  int at = id, body = -1;
  while (at > Tree::kRoot && (body = moving_body(at)) < 0) at = tree_.node(at).parent;
  if (body < 0) return std::vector<double>(6);
  const sim::BodyState s = twin_.simulation().state(body);
  if (is_nue()) return {s.velocity_m_s.x, s.climb_m_s, -s.velocity_m_s.y, 0, s.spin_rad_s, 0};
  return {s.velocity_m_s.x, s.velocity_m_s.y, s.climb_m_s, 0, 0, s.spin_rad_s};
}

bool Bodies::set_velocity(int id, const std::vector<double>& v) {
  const int body = moving_body(id);
  if (body < 0) return false;
  if (is_nue())
    twin_.simulation().set_velocity(body, {v[0], -v[2]}, v[4], v[1]);
  else
    twin_.simulation().set_velocity(body, {v[0], v[1]}, v[5], v[2]);
  return true;
}

void Bodies::rest_all() {
  for (int body = 0; body < twin_.simulation().scene().bodies(); ++body)
    twin_.simulation().set_velocity(body, {}, 0, 0);
}

// --- states

void Bodies::save(int id, const std::string& name) {
  for (const int n : tree_.below(id))
    if (n == id || moving_body(n) >= 0) states_[{n, name}] = {pose(n), velocity(n)};
}

bool Bodies::load(int id, const std::string& name) {
  if (!states_.count({id, name})) return false;
  for (const int n : tree_.below(id)) {
    const auto found = states_.find({n, name});
    if (found == states_.end()) continue;
    const State state = found->second;
    if (moving_body(n) >= 0) {
      put(n, state.pose);
      set_velocity(n, state.velocity);
    } else if (n == id && tree_.node(n).find("translation")) {
      const Affine own = pose(tree_.node(n).parent).inverse(Eigen::Isometry) * state.pose;
      set_place(n, "translation", numbers_of(own));
      set_place(n, "rotation", axis_angle(own, is_nue()));
    }
  }
  return true;
}

// --- what comes, changes and goes

void Bodies::changed(int id) {
  int at = id;
  while (at > Tree::kRoot && tree_.node(at).is == Is::Plain) at = tree_.node(at).parent;
  if (pieces_.count(at)) derive(at, true);
}

// from the text of a node what stands there
void Bodies::derive(int id, bool keep_course) {
  std::set<int> cleared;
  for (const int n : tree_.below(id)) {
    sync(n);
    if (pieces_.count(n)) cleared.insert(n);
  }
  wbt::NodePtr text = tree_.to_wbt(id);
  const Affine around = pose(tree_.node(id).parent);
  if (tree_.node(id).parent > Tree::kRoot) {
    auto outer = std::make_shared<wbt::Node>();
    outer->type = "Transform";
    outer->fields.push_back({"translation", 0, numbers_of(around), {}, {}, {}});
    outer->fields.push_back({"rotation", 0, axis_angle(around, is_nue()), {}, {}, {}});
    outer->fields.push_back({"children", 0, {}, {}, {}, {text}});
    text = outer;
  }
  const wbt::Furniture found = wbt::furniture_of({text}, text_, options_, twin_.world().webots.floor_m);
  Made made;
  for (const sim::ObjectDesc& o : found.objects)
    if (tree_.has(o.node)) made[o.node].push_back(o);
  std::vector<sim::LampDesc> lamps;
  for (const sim::LampDesc& l : found.lamps)
    if (tree_.has(l.node) && tree_.node(l.node).is == Is::Plain) lamps.push_back(l);
  apply(cleared, made, keep_course, lamps);
}

void Bodies::apply(const std::set<int>& cleared, const Made& made, bool keep_course,
                   const std::vector<sim::LampDesc>& lamps) {
  if (cleared.empty() && made.empty() && lamps.empty()) return;
  sim::WorldDesc w = twin_.world();
  const std::vector<sim::ObjectDesc> old = std::move(w.objects);
  w.objects.clear();
  std::vector<int> owner, before;
  const auto add = [&](const sim::ObjectDesc& o, int id, int was) {
    w.objects.push_back(o);
    owner.push_back(id);
    if (o.movable) before.push_back(was);
  };
  for (std::size_t i = 0; i < old.size(); ++i)
    if (!cleared.count(owner_[i])) add(old[i], owner_[i], body_of_[i]);
  for (const auto& [id, list] : made) {
    const auto piece = pieces_.find(id);
    const bool alike = keep_course && piece != pieces_.end() && piece->second.objects.size() == list.size();
    for (std::size_t k = 0; k < list.size(); ++k)
      add(list[k], id, alike && list[k].movable ? body_of(piece->second.objects[k]) : -1);
    pieces_.erase(id);  // tied anew
    if (tree_.node(id).is == Is::Plain) tree_.node(id).is = Is::Object;
  }
  for (const sim::LampDesc& l : lamps) {
    tree_.node(l.node).is = Is::Lamp;
    tree_.node(l.node).number = static_cast<int>(w.lamps.size());
    w.lamps.push_back(l);
  }
  for (const int id : cleared)
    if (!made.count(id)) pieces_.erase(id);
  owner_ = std::move(owner);
  twin_.simulation().refurnish(w, before);
  tie();
}

/// All objects stay, with another look.
void Bodies::refurnish(const sim::WorldDesc& world) {
  std::vector<int> before;
  for (std::size_t i = 0; i < world.objects.size(); ++i)
    if (world.objects[i].movable) before.push_back(body_of_[i]);
  twin_.simulation().refurnish(world, before);
}

std::string Bodies::import(int parent, const std::string& field, int index, const std::string& text) {
  const bool uses = text.find("USE") != std::string::npos;
  const wbt::WorldText read =
      wbt::read_nodes_text(text, text_, uses ? tree_.defs() : std::map<std::string, wbt::NodePtr>{});
  if (!read.errors.empty())
    return "line " + std::to_string(read.errors.front().line) + ": " + read.errors.front().text;
  if (read.nodes.empty()) return "got no node, expected one such as Solid { }";
  for (const wbt::NodePtr& n : read.nodes) {
    if (base_of(n->type) == "Robot" || n->type == "Supervisor")
      return "got a robot, " + n->type + ": robots come and go only when a run begins";
  }
  for (const wbt::NodePtr& n : read.nodes) {
    const int id = tree_.add(*n, parent, field, index, *protos_);
    if (id == 0) return "got too many nodes, or nodes in nodes";
    if (index >= 0) ++index;
    const bool is_part = pieces_.count(parent) || (parent != Tree::kRoot && field != "children");
    if (is_part)
      changed(parent);
    else
      derive(id, false);
  }
  return {};
}

void Bodies::remove(int id, std::string& told) {
  std::set<int> cleared;
  for (const int n : tree_.below(id)) {
    const TreeNode& node = tree_.node(n);
    if (pieces_.count(n)) cleared.insert(n);
    if (node.is == Is::Lamp) {
      const sim::LampDesc& l = twin_.world().lamps[static_cast<std::size_t>(node.number)];
      twin_.simulation().set_lamp(node.number, false, l.intensity_w_m2, l.position_m);
    }
    if (node.is == Is::Robot) {
      told = "robots come and go only when a run begins; '" + node.text("name") + "' waits far away";
      sim::Pose2 parked;
      parked.x_m = kParkedM;
      parked.y_m = kParkedM - node.number;
      twin_.simulation().move(node.number, parked, 0);
      if (moved) moved(node.number);
    }
  }
  const int parent = tree_.node(id).parent;
  for (const int n : tree_.below(id))
    states_.erase(states_.lower_bound({n, ""}), states_.lower_bound({n + 1, ""}));
  tree_.remove(id);
  if (!cleared.empty())
    apply(cleared, {}, false);
  else
    changed(parent);  // a part of something
}

// --- looks

bool Bodies::colour(int id, sim::Colour& colour) const {
  const sim::Scene& scene = twin_.simulation().scene();
  const TreeNode& n = tree_.node(id);
  if (n.is == Is::Robot) {
    colour = sim::surface_of(scene.layout(), {n.number, true}).colour;
    return true;
  }
  const auto piece = pieces_.find(id);
  if (piece == pieces_.end()) return false;
  colour = twin_.world().objects[static_cast<std::size_t>(piece->second.objects.front())].material.colour;
  return true;
}

bool Bodies::set_colour(int id, const sim::Colour& colour) {
  const TreeNode& n = tree_.node(id);
  sim::WorldDesc w = twin_.world();
  if (n.is == Is::Robot) {
    w.robots[static_cast<std::size_t>(n.number)].colour = colour;
  } else {
    const auto piece = pieces_.find(id);
    if (piece == pieces_.end()) return false;
    for (const int o : piece->second.objects) {
      w.objects[static_cast<std::size_t>(o)].material.colour = colour;
      w.objects[static_cast<std::size_t>(o)].material.ir_reflectance = -1;  // the red part
    }
  }
  refurnish(w);
  return true;
}

void Bodies::set_recognition(int id, const std::vector<double>& numbers) {
  const TreeNode& n = tree_.node(id);
  std::vector<sim::Colour> colours;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    colours.push_back({std::clamp(numbers[i], 0.0, 1.0), std::clamp(numbers[i + 1], 0.0, 1.0),
                       std::clamp(numbers[i + 2], 0.0, 1.0)});
  sim::WorldDesc w = twin_.world();
  if (n.is == Is::Robot)
    w.robots[static_cast<std::size_t>(n.number)].recognition_colours = colours;
  else if (const auto piece = pieces_.find(id); piece != pieces_.end())
    for (const int o : piece->second.objects)
      w.objects[static_cast<std::size_t>(o)].recognition_colours = colours;
  else
    return;
  refurnish(w);
}

void Bodies::lamp_changed(int id) {
  const TreeNode& n = tree_.node(id);
  if (n.is != Is::Lamp) return;
  sim::LampDesc l = twin_.world().lamps[static_cast<std::size_t>(n.number)];
  if (n.base != "DirectionalLight") {
    const std::vector<double> at = n.numbers("location", {0, 0, 0});
    Affine there;
    there.translation() = pose(n.parent) * Vec3(at[0], at[1], at[2]);
    if (is_near(there)) l.position_m = in(wbt::plain(there.translation()));
  }
  constexpr double kBrightest = 10000;  // W/m2
  twin_.simulation().set_lamp(n.number, n.numbers("on", {1})[0] != 0,
                              std::clamp(n.numbers("intensity", {1})[0], 0.0, kBrightest), l.position_m);
}

}  // namespace programs
