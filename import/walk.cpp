// SPDX-License-Identifier: MIT
#include "import/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace wbt {
namespace {

bool is_group(const std::string& t) {
  return t == "Group" || t == "Transform" || t == "Pose" || t == "Billboard";
}

bool is_solid(const std::string& t) {
  return t == "Solid" || t == "Charger" || t == "TouchSensor" || t == "Track" || t == "ImmersionNode";
}

bool is_robot(const std::string& t) {
  return t == "Robot" || t == "DifferentialWheels" || t == "Supervisor" || t == "CustomRobot";
}

bool is_joint(const std::string& t) {
  return t == "HingeJoint" || t == "Hinge2Joint" || t == "SliderJoint" || t == "BallJoint" || t == "Slot" ||
         t == "Servo";
}

// nothing that robots sense or touch depends on them
bool is_cosmetic(const std::string& t) {
  return t == "Viewpoint" || t == "TexturedBackground" || t == "TexturedBackgroundLight" || t == "Fog";
}

Vec3 vector_of(const Node& n, const char* field, sim::Vec3 otherwise) {
  return {n.number(field, otherwise.x, 0), n.number(field, otherwise.y, 1), n.number(field, otherwise.z, 2)};
}

// which way a file of the years in between means, when it does not say: by the axes it turns things about
bool turns_about_y(const WorldText& text) {
  int y = 0, z = 0;
  for (const NodePtr& n : text.nodes) {
    if (n->type == "Viewpoint" || n->type == "DirectionalLight") continue;
    const Vec3 axis = vector_of(*n, "rotation", {});
    if (std::abs(axis.y()) > 0.99) ++y;
    if (std::abs(axis.z()) > 0.99) ++z;
    const Vec3 at = vector_of(*n, "translation", {});
    if (n->field("translation") && std::abs(at.y()) < 0.2 && std::abs(at.z()) > 0.3) ++y;
    if (n->field("translation") && std::abs(at.z()) < 0.2 && std::abs(at.y()) > 0.3) ++z;
  }
  return y >= z;
}

}  // namespace

bool is_epuck_name(const std::string& type) {
  std::string t;
  for (const char c : type) {
    if (c != '-' && c != '_') t += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (t.rfind("epuck", 0) != 0) return false;
  for (const char* part : {"sensor", "module", "turret", "slot", "ring"}) {
    if (t.find(part) != std::string::npos) return false;
  }
  return true;
}

Walk::Walk(const WorldText& text, const Options& options, Report& report)
    : text_(text), report_(report), surfaces_(options.folder, report), protos_(text, options.folder) {
  scene_.version = text.version;
  const Node* info = nullptr;
  for (const NodePtr& n : text.nodes) {
    if (n->type == "WorldInfo") info = n.get();
  }
  const std::string axes = info ? info->text("coordinateSystem") : "";
  if (!axes.empty())
    scene_.nue = axes != "ENU";  // EUN is the same but for names of directions
  else if (text.at_least(2020, 'b') && !text.at_least(2022, 'a'))
    scene_.nue = turns_about_y(text);
  else
    scene_.nue = !text.at_least(2022, 'a');
  // shapes stand on z since R2022a; its nightly builds called themselves R2021c
  z_up_ = text.at_least(2022, 'a') || (text.at_least(2021, 'c') && !scene_.nue);
  if (scene_.nue) world_.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  scene_.new_sensors = text.at_least(2020, 'b');
  scene_.uniform_noise = text.year == 0 && text.major <= 7;
}

Scene Walk::scene() {
  for (const NodePtr& n : text_.nodes) {
    if (n->type == "WorldInfo") world_info(*n);
  }
  for (const NodePtr& n : text_.nodes) {
    if (n->type == "WorldInfo") continue;
    // each has its own share of nodes, so that a PROTO without end takes nothing else with it
    if (endless_ == kMostEndless) {
      report_.add(*n, "too many nodes stand before it");
      continue;
    }
    visits_ = 0;
    exhausted_ = false;
    visit(*n, world_, 0);
    endless_ += exhausted_;
  }
  for (const Remark& r : text_.remarks) {
    const std::size_t colon = r.text.find(": not carried: ");
    report_.add(r.line, r.text.substr(0, colon), r.text.substr(std::min(colon + 15, r.text.size())));
  }
  return std::move(scene_);
}

bool Walk::afford(const Node& n) {
  if (++visits_ < kMostVisits) return true;
  if (!exhausted_) report_.add(n, fmt::format("more than {} nodes, USE counted each time", kMostVisits));
  exhausted_ = true;
  return false;
}

Affine Walk::inside(const Node& n, const Affine& frame) const {
  Affine own = turned(vector_of(n, "rotation", {0, 0, 1}), n.number("rotation", 0, 3));
  const Field* scale = n.field("scale");
  if (scale && !scale->numbers.empty()) {
    const double first = scale->numbers[0];
    own.scale(vector_of(n, "scale", {first, first, first}));
  }
  own.translation() = vector_of(n, "translation", {});
  return frame * own;
}

void Walk::children(const Node& n, const char* field, const Affine& frame, int depth) {
  const Field* f = n.field(field);
  for (std::size_t i = 0; f && i < f->nodes.size(); ++i) visit(*f->nodes[i], frame, depth + 1);
}

void Walk::visit(const Node& n, const Affine& frame, int depth) {
  if (depth > 2 * kDeepestNode || !afford(n)) return;
  // What Webots knows by its own nodes.
  const std::string& t = n.type;
  if (is_cosmetic(t)) {
    scene_.cosmetic.push_back(fmt::format("{} (line {})", t, n.line));
  } else if (t == "Background") {
    background(n);
  } else if (t == "PointLight" || t == "SpotLight" || t == "DirectionalLight") {
    lamp(n, frame);
  } else if (is_group(t)) {
    children(n, "children", inside(n, frame), depth);
  } else if (is_joint(t)) {
    report_.add(n, "a joint", "its end stands still");
    children(n, "endPoint", frame, depth);
    if (t == "Servo") solid(n, inside(n, frame), depth);
  } else if (is_epuck_name(t)) {
    epuck(n, frame, true);
  } else if (is_robot(t)) {
    robot(n, inside(n, frame), depth);
  } else if (is_solid(t)) {
    solid(n, inside(n, frame), depth);
  } else if (t == "Shape") {
    Body b;
    b.type = t;
    b.def = n.def;
    b.line = n.line;
    b.untouched = true;
    const int before = found();
    gather(n, frame, depth, b.pieces, nullptr, false);
    add_body(std::move(b));
    if (found() == before) report_.add(n, "it has no geometry");
  } else if (known_proto(n, frame)) {
  } else if (const NodePtr body = unfolded(n)) {
    kept_.push_back(body);
    visit(*body, frame, depth + 1);
  } else {
    by_measures(n, frame);
  }
}

void Walk::world_info(const Node& n) {
  scene_.title = n.text("title");
  if (const Field* info = n.field("info")) scene_.info = info->strings;
  scene_.time_step_s = std::clamp(n.number("basicTimeStep", kBasicTimeStepMs), 1.0, 1000.0) / 1000;
  if (const Field* g = n.field("gravity")) {
    double squares = 0;
    for (const double part : g->numbers) squares += part * part;
    scene_.gravity_m_s2 = std::clamp(std::sqrt(squares), kGravityMin, kGravityMax);
    if (!(std::sqrt(squares) >= kGravityMin))
      report_.add(n, *g, "no gravity", fmt::format("{} m/s2", kGravityMin));
  }
  // The seed, the engine, and how materials touch.
  const double seed = n.number("randomSeed", -1);
  if (seed >= 1 && seed < 9e18) scene_.seed = static_cast<std::uint64_t>(seed);
  const std::string fast2d = n.text("fast2d");
  if (!fast2d.empty()) scene_.planar = true;
  if (n.field("physics") && !n.text("physics").empty())
    report_.add(n, *n.field("physics"), "a physics plug-in", "the engines of Twinpuck");
  if (const Field* list = n.field("contactProperties")) {
    for (const NodePtr& c : list->nodes) {
      if (scene_.contacts.size() == kMostContacts) break;
      Contact out;
      out.one = c->text("material1", "default");
      out.other = c->text("material2", "default");
      out.friction = c->number("coulombFriction", kContactFriction);
      out.bounce = c->number("bounce", kContactBounce);
      scene_.contacts.push_back(out);
    }
  }
  for (const char* f : {"ERP", "CFM"}) {
    if (n.field(f)) report_.add(n, *n.field(f), "a setting of another physics engine");
  }
}

void Walk::background(const Node& n) {
  if (n.field("skyColor")) scene_.sky = colour_of(n, "skyColor", 0);
}

void Walk::lamp(const Node& n, const Affine& frame) {
  FoundLamp out;
  out.type = n.type;
  out.line = n.line;
  // What all kinds of lamps have.
  const sim::Colour c = colour_of(n, "color", 1);
  out.lamp.name = n.def;
  out.lamp.colour = c;
  out.lamp.on = n.truth("on", true);
  out.lamp.intensity_w_m2 = std::clamp(n.number("intensity", 1), 0.0, kLightMax);
  double at_once = 1;  // share of the ambient part that arrives
  // A lamp far away shines as from a direction; others have a place, and fade.
  if (n.type == "DirectionalLight") {
    const Vec3 d = frame.linear() * vector_of(n, "direction", {0, 0, -1});
    const double far = d.norm();
    if (!(far > 1e-9) || !std::isfinite(far)) return report_.add(n, "its direction makes no sense");
    out.lamp.position_m = plain((-kSunDistanceM / far) * d);
    if (out.lamp.position_m.z <= 0) {
      report_.add(n, "shines from below");
      out.lamp.intensity_w_m2 = 0;
    }
  } else {
    const Vec3 p = frame * vector_of(n, "location", {});
    out.lamp.position_m = plain(p);
    for (std::size_t i = 0; i < 3; ++i)
      out.lamp.attenuation[i] = std::clamp(n.number("attenuation", i == 0 ? 1 : 0, i), 0.0, 1e6);
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > kFarthestM) return report_.add(n, "too far away");
    const double d = p.norm();  // ambient light at the middle of the world
    at_once = out.lamp.attenuation[0] + d * (out.lamp.attenuation[1] + d * out.lamp.attenuation[2]);
    const auto& fades = out.lamp.attenuation;
    if (!(at_once > 0) || std::max({fades[0], fades[1], fades[2]}) < kFadesLeast) {
      report_.add(n, "its attenuation makes no sense", "none");
      out.lamp.attenuation = {1, 0, 0};
      at_once = 1;
    }
    if (n.type == "SpotLight") report_.add(n, "its beam", "a lamp that shines to all sides");
    if (n.number("ambientIntensity", 0) > 0 && (out.lamp.attenuation[1] > 0 || out.lamp.attenuation[2] > 0))
      report_.add(n, *n.field("ambientIntensity"), "ambient light that fades with the distance",
                  "everywhere as much as in the middle of the world");
  }
  // Ambient light is part of the sky's.
  if (out.lamp.on)
    out.ambient_w_m2 =
        std::clamp(n.number("ambientIntensity", 0), 0.0, kLightMax) * (c.r + c.g + c.b) / 3 / at_once;
  scene_.lamps.push_back(out);
}

void Walk::gather(const Node& n, const Affine& frame, int depth, std::vector<Piece>& out,
                  const Surface* paint, bool nested_solids) {
  if (depth > 2 * kDeepestNode || !afford(n)) return;
  if (n.type == "Shape") {
    const Surface surface = paint ? *paint : surfaces_.of(n.node("appearance"));
    if (const Node* g = n.node("geometry")) gather(*g, frame, depth + 1, out, &surface, nested_solids);
  } else if (is_geometry(n.type)) {
    const Node* coord = n.node("coord");
    const Field* points = coord ? coord->field("point") : n.field("height");
    // what is long to look at counts as many nodes
    double numbers = points ? static_cast<double>(points->numbers.size()) : 0;
    if (const Field* index = n.field("coordIndex")) numbers += static_cast<double>(index->numbers.size());
    if (n.type == "ElevationGrid") numbers += 1e4;
    if (n.type == "Extrusion") numbers += 1e4;
    visits_ += static_cast<int>(std::min(numbers / 60, 1e6));
    std::string why;
    std::vector<Piece> made = pieces_of(n, frame, z_up_, why);
    if (!why.empty()) report_.add(n, why);
    for (Piece& p : made) {
      if (paint) p.surface = *paint;
      if (++pieces_ <= kMostPieces) out.push_back(std::move(p));
    }
  } else if (is_group(n.type) || (nested_solids && is_solid(n.type))) {
    const Affine here = inside(n, frame);
    const Field* f = n.field("children");
    for (std::size_t i = 0; f && i < f->nodes.size(); ++i)
      gather(*f->nodes[i], here, depth + 1, out, paint, nested_solids);
  } else if (nested_solids && is_joint(n.type)) {
    if (const Node* end = n.node("endPoint")) gather(*end, frame, depth + 1, out, paint, nested_solids);
  }
}

Body Walk::body_of(const Node& n) {
  Body b;
  b.type = n.type;
  b.name = n.text("name");
  b.def = n.def;
  b.line = n.line;
  b.model = n.text("model");
  b.recognition = recognition_of(n);
  return b;
}

std::vector<sim::Colour> Walk::recognition_of(const Node& n) {
  std::vector<sim::Colour> colours;
  const Field* f = n.field("recognitionColors");
  for (std::size_t i = 0; f && i + 2 < f->numbers.size() && colours.size() < kMostRecognition; i += 3) {
    const auto part = [&](std::size_t k) { return std::clamp(f->numbers[i + k], 0.0, 1.0); };
    colours.push_back({part(0), part(1), part(2)});
  }
  return colours;
}

void Walk::solid(const Node& n, const Affine& frame, int depth) {
  // What it is, and whether it moves.
  const int before = found();
  Body b = body_of(n);
  b.contact = n.text("contactMaterial", "default");
  b.robot_like = is_robot(n.type);
  if (const Node* physics = n.node("physics")) {
    b.movable = true;
    b.mass_kg = physics->number("mass", -1);
    b.density_kg_m3 = physics->number("density", kDensityKgM3);
    if (n.truth("locked", false)) b.movable = true;  // locked for the mouse only
  }
  // What it looks like, and what is to be looked at by itself.
  std::vector<Piece> shown, touched;
  const Field* list = n.field("children");
  for (std::size_t i = 0; list && i < list->nodes.size(); ++i) {
    const Node& c = *list->nodes[i];
    // what hangs on a movable body moves with it; what hangs on a fixed one stands by itself
    if (is_group(c.type) || c.type == "Shape" || (b.movable && (is_solid(c.type) || is_joint(c.type))))
      gather(c, frame, depth + 1, shown, nullptr, b.movable);
    const bool has_own = !(c.type == "Shape" || (b.movable && (is_solid(c.type) || is_joint(c.type))));
    if (!has_own) continue;
    if (is_group(c.type)) {  // solids and lamps further inside; shapes are taken already
      std::vector<std::pair<const Node*, Affine>> open{{&c, inside(c, frame)}};
      while (!open.empty() && visits_ < kMostVisits) {
        const auto [group, here] = open.back();
        open.pop_back();
        const Field* inner = group->field("children");
        for (std::size_t k = 0; inner && k < inner->nodes.size(); ++k) {
          const Node& d = *inner->nodes[k];
          if (is_group(d.type) && afford(d))
            open.push_back({&d, inside(d, here)});
          else if (d.type != "Shape" && !is_group(d.type) && !(b.movable && is_solid(d.type)))
            visit(d, here, depth + 2);
        }
      }
    } else if (b.robot_like && !is_solid(c.type) && c.type.find("Light") == std::string::npos) {
      // devices of a robot that is not carried
    } else {
      visit(c, frame, depth + 1);
    }
  }
  if (const Node* bounding = n.node("boundingObject"))
    gather(*bounding, frame, depth + 1, touched, nullptr, false);
  // bodies are what is touched; colours come from what is seen
  if (!touched.empty()) {
    const Piece* largest = nullptr;
    for (const Piece& p : shown) {
      if (!largest || p.area() > largest->area()) largest = &p;
    }
    for (std::size_t i = 0; i < touched.size() && largest; ++i)
      touched[i].surface = touched.size() == shown.size() ? shown[i].surface : largest->surface;
    b.pieces = std::move(touched);
  } else {
    b.pieces = std::move(shown);
    b.untouched = true;
  }
  const bool has_body = !b.pieces.empty();
  add_body(std::move(b));
  // What it does, and that nothing is left of it.
  const std::string stands = has_body ? "it is a body that stands there" : "";
  if (n.type == "Charger") report_.add(n, "that it charges robots", stands);
  if (n.type == "Track") report_.add(n, "that its belt moves", stands);
  if (found() == before && !is_robot(n.type)) report_.add(n, "it has no shape");
}

int Walk::found() const {
  return report_.size() +
         static_cast<int>(scene_.bodies.size() + scene_.lamps.size() + scene_.robots.size() +
                          scene_.supervisors.size() + scene_.arenas.size() + scene_.cosmetic.size());
}

void Walk::add_body(Body body) {
  if (body.pieces.empty()) return;
  if (scene_.bodies.size() == kMostBodies)
    report_.add(body.line, body.type, fmt::format("more than {} bodies", kMostBodies));
  if (scene_.bodies.size() <= kMostBodies) scene_.bodies.push_back(std::move(body));
}

NodePtr Walk::unfolded(const Node& n, bool without_script) {
  const Proto* proto = protos_.find(n.type);
  if (!proto || budget_ == 0 || (proto->has_script && !without_script)) return nullptr;
  return unfold(*proto, n, budget_, without_script);
}

}  // namespace wbt
