// SPDX-License-Identifier: MIT
// The floors, walls and blocks that come with Webots as PROTOs.

#include <algorithm>

#include "import/walk.h"

namespace wbt {
namespace {

sim::Vec3 three(const Node& n, const char* field, sim::Vec3 otherwise) {
  return {n.number(field, otherwise.x, 0), n.number(field, otherwise.y, 1), n.number(field, otherwise.z, 2)};
}

// [Webots: the PROTO files of projects/objects and projects/samples/curriculum]
struct Block {
  const char* type;
  sim::ObjectKind kind;
  sim::Vec3 size;  // of a cylinder: x its radius, z its height; of a ball: x its radius
  sim::Colour colour;
  bool at_middle;  // its translation is its middle, not its foot
};
const Block kBlocks[] = {
    {"WoodenBox", sim::ObjectKind::Box, {0.6, 0.6, 0.6}, kWood, true},
    {"CardboardBox", sim::ObjectKind::Box, {0.6, 0.6, 0.6}, kCardboard, true},
    {"MetalStorageBox", sim::ObjectKind::Box, {0.6, 0.6, 0.6}, kMetal, true},
    {"PlasticCrate", sim::ObjectKind::Box, {0.6, 0.6, 0.6}, kMetal, false},
    {"SolidBox", sim::ObjectKind::Box, {2, 2, 2}, {1, 1, 1}, true},
    {"Obstacle", sim::ObjectKind::Cylinder, {0.04, 0, 0.05}, {1, 0.501961, 0.25098}, true},
    {"SolidPipe", sim::ObjectKind::Cylinder, {0.05, 0, 0.2}, kMetal, true},
    {"OilBarrel", sim::ObjectKind::Cylinder, {0.305, 0, 0.88}, {0.1, 0.3, 0.6}, true},
    {"WoodenBarrel", sim::ObjectKind::Cylinder, {0.4, 0, 1.0}, kWood, true},
    {"SoccerBall", sim::ObjectKind::Ball, {0.1, 0, 0}, {1, 1, 1}, true},
    {"Ball", sim::ObjectKind::Ball, {0.1, 0, 0}, {1, 1, 1}, true},
};

const std::set<std::string> kPlace{"translation", "rotation", "name",
                                   "locked",      "model",    "immersionProperties"};

}  // namespace

void Walk::known_fields(const Node& n, const std::set<std::string>& carried) {
  for (const Field& f : n.fields) {
    if (!carried.count(f.name) && !kPlace.count(f.name)) report_.add(n, f, "no such thing here");
  }
}

bool Walk::known_proto(const Node& n, const Affine& frame) {
  const std::string& t = n.type;
  if (t == "RectangleArena") return arena(n, inside(n, frame)), true;
  if (t == "CircleArena") return circle_arena(n, inside(n, frame)), true;
  if (t == "Floor" || t == "CheckeredFloor" || t == "UnevenTerrain")
    return floor_proto(n, inside(n, frame)), true;
  if (t == "Wall") return wall_proto(n, inside(n, frame)), true;
  for (const Block& b : kBlocks) {
    // a PROTO of that name beside the world goes first, but for the product's own
    if (t == b.type) return block_proto(n, inside(n, frame)), true;
  }
  return false;
}

namespace {

FoundArena arena_at(const Node& n, const Affine& frame) {
  FoundArena a;
  a.type = n.type;
  a.line = n.line;
  a.at = {frame.translation().x(), frame.translation().y()};
  a.z_m = frame.translation().z();
  return a;
}

}  // namespace

void Walk::arena(const Node& n, const Affine& frame) {
  FoundArena a = arena_at(n, frame);
  // Its measures, and how it lies.
  a.size = {std::abs(n.number("floorSize", kArenaSizeM, 0)), std::abs(n.number("floorSize", kArenaSizeM, 1))};
  a.heading_rad = std::atan2(frame(1, 0), frame(0, 0));
  if (std::hypot(frame(0, 0), frame(1, 0)) < 0.99) a.heading_rad = 0;
  a.wall_height_m = n.number("wallHeight", kArenaWallHeightM);
  a.wall_thickness_m = n.number("wallThickness", kArenaWallThicknessM);
  // The floor: one picture that covers it all can be carried, else its colour.
  if (const Node* look = n.node("floorAppearance")) {
    a.floor = surfaces_.of(look);
    const bool once = std::abs(n.number("floorTileSize", 0.5, 0) - a.size.x) < 1e-6 &&
                      std::abs(n.number("floorTileSize", 0.5, 1) - a.size.y) < 1e-6;
    const std::string picture = surfaces_.picture_of(look);
    if (once && picture.size() > 4 && picture.substr(picture.size() - 4) == ".png") {
      a.image = picture;
      if (std::abs(std::remainder(a.heading_rad, 2 * sim::kPi)) > 0.01)
        report_.add(*look, "that its picture is turned with the arena", "the picture lies north up");
    } else if (!picture.empty()) {
      report_.add(*look, once ? "a picture that is not a PNG file" : "a picture that is repeated",
                  "its average colour");
    }
  } else if (const Field* url = n.field("floorTextureUrl")) {
    report_.add(n, *url, "a picture on the floor", "the colour of parquet");
  }
  // Walls and floor without a look of their own have the PROTO's.
  if (const Node* look = n.node("wallAppearance")) a.walls = surfaces_.of(look);
  if (n.field("wallColor")) a.walls = Surface{colour_of(n, "wallColor", 1), 0};
  if (!a.walls) a.walls = Surface{kMetal, 0};
  if (!a.floor) a.floor = Surface{kParquet, 0};
  known_fields(
      n, {"floorSize", "floorTileSize", "floorAppearance", "floorTextureUrl", "wallHeight", "wallThickness",
          "wallAppearance", "wallColor", "wallTileSize", "contactMaterial", "wallTextureUrl"});
  scene_.arenas.push_back(a);
}

void Walk::circle_arena(const Node& n, const Affine& frame) {
  FoundArena a = arena_at(n, frame);
  const double r = std::abs(n.number("radius", 1));
  a.size = {2 * r, 2 * r};
  a.round = true;
  a.wall_height_m = n.number("wallHeight", kArenaWallHeightM);
  a.wall_thickness_m = n.number("wallThickness", kArenaWallThicknessM);
  a.floor = n.node("floorAppearance") ? surfaces_.of(n.node("floorAppearance")) : Surface{kParquet, 0};
  a.walls = n.node("wallAppearance") ? surfaces_.of(n.node("wallAppearance")) : Surface{kMetal, 0};
  scene_.arenas.push_back(a);
}

void Walk::floor_proto(const Node& n, const Affine& frame) {
  if (n.type == "UnevenTerrain") return report_.add(n, "uneven ground", "flat ground");
  FoundArena a = arena_at(n, frame);
  a.size = {std::abs(n.number("size", 10, 0)), std::abs(n.number("size", 10, 1))};
  a.heading_rad = std::atan2(frame(1, 0), frame(0, 0));
  const Node* look = n.node("appearance");
  a.floor = look ? surfaces_.of(look) : Surface{kParquet, 0};
  if (n.type == "CheckeredFloor") report_.add(n, "its checkered pattern", "the colour of parquet");
  scene_.arenas.push_back(a);
}

void Walk::wall_proto(const Node& n, const Affine& frame) {
  const sim::Vec3 size = three(n, "size", z_up_ ? sim::Vec3{0.2, 1, 2.4} : sim::Vec3{1, 2.4, 0.2});
  Node box;
  box.type = "Box";
  box.line = n.line;
  box.fields.push_back({"size", n.line, {size.x, size.y, size.z}, {}, {}, {}});
  Affine middle = frame;
  middle.translate(z_up_ ? Vec3(0, 0, size.z / 2) : Vec3(0, size.y / 2, 0));
  Body b = body_of(n);
  std::string why;
  b.pieces = pieces_of(box, middle, z_up_, why);
  if (!why.empty()) report_.add(n, why);
  for (Piece& p : b.pieces)
    p.surface = n.node("appearance") ? surfaces_.of(n.node("appearance")) : Surface{kStone, 0};
  add_body(std::move(b));
}

void Walk::block_proto(const Node& n, const Affine& frame) {
  const Block* known = nullptr;
  for (const Block& b : kBlocks) {
    if (n.type == b.type) known = &b;
  }
  Node shape;
  shape.line = n.line;
  const auto give = [&](const char* name, std::vector<double> numbers) {
    shape.fields.push_back({name, n.line, std::move(numbers), {}, {}, {}});
  };
  double height = known->size.z;
  if (known->kind == sim::ObjectKind::Box) {
    shape.type = "Box";
    const sim::Vec3 s = three(n, "size", known->size);
    give("size", {s.x, s.y, s.z});
    height = z_up_ ? s.z : s.y;
  } else if (known->kind == sim::ObjectKind::Cylinder) {
    shape.type = "Cylinder";
    height = n.number("height", known->size.z);
    give("radius", {n.number("radius", known->size.x)});
    give("height", {height});
  } else {
    shape.type = "Sphere";
    give("radius", {n.number("radius", known->size.x)});
  }
  Affine place = frame;
  // blocks that are not placed lie on the ground
  if (!n.field("translation") || !known->at_middle)
    place.translate(z_up_ ? Vec3(0, 0, height / 2) : Vec3(0, height / 2, 0));
  Body b = body_of(n);
  b.contact = n.text("contactMaterial", "default");
  b.mass_kg = n.number("mass", 0);
  b.movable = b.mass_kg > 0;
  if (known->kind == sim::ObjectKind::Ball && !n.field("mass")) b.movable = true;
  if (const Node* physics = n.node("physics")) {
    b.movable = true;
    b.mass_kg = physics->number("mass", -1);
    b.density_kg_m3 = physics->number("density", kDensityKgM3);
  }
  std::string why;
  b.pieces = pieces_of(shape, place, z_up_, why);
  if (!why.empty()) report_.add(n, why);
  Surface surface{known->colour, 0};
  if (n.field("color")) surface.colour = colour_of(n, "color", 1);
  if (const Node* look = n.node("appearance")) surface = surfaces_.of(look);
  for (Piece& p : b.pieces) p.surface = surface;
  known_fields(n, {"size", "radius", "height", "mass", "physics", "color", "appearance", "contactMaterial",
                   "thickness", "subdivision", "boundingObject", "texture", "textureUrl"});
  add_body(std::move(b));
}

// a PROTO that is not known: if it says how large it is, it stands there as a block
void Walk::by_measures(const Node& n, const Affine& frame) {
  const Field* size = n.field("size");
  const bool box = size && size->numbers.size() == 3;
  const bool round = n.field("radius") && n.field("height");
  if ((!box && !round) || !n.field("translation")) {
    const Proto* proto = protos_.find(n.type);
    const bool script = proto && proto->has_script;
    report_.add(n, script ? "a PROTO with a script"
                          : "a node that is not known here, and no PROTO file is beside the world");
    return;
  }
  Node shape;
  shape.type = box ? "Box" : "Cylinder";
  shape.line = n.line;
  for (const char* f : {"size", "radius", "height"}) {
    if (n.field(f)) shape.fields.push_back(*n.field(f));
  }
  Body b = body_of(n);
  std::string why;
  b.pieces = pieces_of(shape, inside(n, frame), z_up_, why);
  if (!why.empty()) report_.add(n, why);
  for (Piece& p : b.pieces) p.surface = surfaces_.of(n.node("appearance"));
  report_.add(n, "a PROTO that is not known here",
              box ? "a box of its size" : "a cylinder of its radius and height");
  add_body(std::move(b));
}

}  // namespace wbt
