// SPDX-License-Identifier: MIT
#include "import/piece.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "import/import_params.h"
#include "sim_core/geometry/solid.h"

namespace wbt {
namespace {

using sim::kPi;
using sim::ObjectKind;

constexpr std::size_t kMostCorners = 64;  // of our polygons
constexpr std::size_t kMostParts = 200;   // of one mesh

double area_of(const std::vector<Vec2>& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) twice += sim::cross(p[i], p[(i + 1) % p.size()]);
  return 0.5 * twice;
}

// Andrew's monotone chain; counter-clockwise, without points on straight edges
std::vector<Vec2> convex_hull(std::vector<Vec2> p) {
  std::sort(p.begin(), p.end(), [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  p.erase(std::unique(p.begin(), p.end(), [](Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }), p.end());
  if (p.size() < 3) return p;
  std::vector<Vec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Vec2 q : p) {
      while (hull.size() >= begin + 2 &&
             sim::cross(hull.back() - hull[hull.size() - 2], q - hull.back()) <= 1e-12)
        hull.pop_back();
      hull.push_back(q);
    }
    hull.pop_back();
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

double half_turn(double a) {  // into (-90, 90] degrees: a box looks the same after half a turn
  a = std::remainder(a, kPi);
  return a <= -kPi / 2 + 1e-9 ? a + kPi : a;
}

Piece box(Vec2 at, Vec2 size, double heading, double z_low, double z_high) {
  Piece out;
  out.at = at;
  out.size = size;
  out.heading_rad = half_turn(heading);
  if (out.heading_rad > kPi / 2 - 1e-3 || out.heading_rad < -kPi / 2 + 1e-3) {
    std::swap(out.size.x, out.size.y);  // written along the axes where it lies along them
    out.heading_rad = half_turn(out.heading_rad - kPi / 2);
  }
  out.z_low = z_low;
  out.z_high = z_high;
  out.volume_m3 = size.x * size.y * (z_high - z_low);
  return out;
}

// a convex outline as box where it is one, as a sheet where it has no width
std::optional<Piece> prism(std::vector<Vec2> hull, double z_low, double z_high) {
  for (const Vec2 p : hull) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
  }
  if (hull.size() < 2 || !std::isfinite(z_low) || !std::isfinite(z_high)) return std::nullopt;
  // the longest edge, and how far the others are from it
  std::size_t longest = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (sim::length(hull[(i + 1) % hull.size()] - hull[i]) >
        sim::length(hull[(longest + 1) % hull.size()] - hull[longest]) + 1e-12)
      longest = i;
  }
  const Vec2 edge = hull[(longest + 1) % hull.size()] - hull[longest];
  const double n = sim::length(edge);
  if (!(n > 1e-6)) return std::nullopt;
  const Vec2 u{edge.x / n, edge.y / n}, v{-u.y, u.x};
  // How far it reaches along that edge, and across it.
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (const Vec2 p : hull) {
    u0 = std::min(u0, sim::dot(p, u)), u1 = std::max(u1, sim::dot(p, u));
    v0 = std::min(v0, sim::dot(p, v)), v1 = std::max(v1, sim::dot(p, v));
  }
  const double around = (u1 - u0) * (v1 - v0);
  const bool sheet = v1 - v0 < kLeastM;
  if (sheet || std::abs(area_of(hull)) > 0.9999 * around) {
    const Vec2 at = 0.5 * (u0 + u1) * u + 0.5 * (v0 + v1) * v;
    return box(at, {u1 - u0, sheet ? kSheetM : v1 - v0}, std::atan2(u.y, u.x), z_low, z_high);
  }
  // corners that do nothing go: the flattest first, and as many as there are too many of
  const double close = 0.002 * (u1 - u0);
  while (hull.size() > 3) {
    std::size_t flattest = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2 a = hull[(i + hull.size() - 1) % hull.size()], b = hull[(i + 1) % hull.size()];
      const double off = std::abs(sim::cross(b - a, hull[i] - a)) / std::max(sim::length(b - a), 1e-12);
      if (off < least) least = off, flattest = i;
    }
    if (least > close && hull.size() <= kMostCorners) break;
    hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(flattest));
  }
  // What is left is a polygon, about its middle.
  Piece out;
  out.kind = ObjectKind::Polygon;
  for (const Vec2 p : hull) out.at = out.at + (1.0 / static_cast<double>(hull.size())) * p;
  for (const Vec2 p : hull)  // as they will be written: rounding must not dent the outline
    out.corners.push_back(
        {std::round((p.x - out.at.x) * 1e5) / 1e5, std::round((p.y - out.at.y) * 1e5) / 1e5});
  out.corners = convex_hull(std::move(out.corners));
  if (!sim::is_convex(out.corners))  // too small for a polygon of ours
    return box(out.at, {u1 - u0, std::max(v1 - v0, kSheetM)}, std::atan2(u.y, u.x), z_low, z_high);
  out.z_low = z_low;
  out.z_high = z_high;
  out.volume_m3 = std::abs(area_of(hull)) * (z_high - z_low);
  return out;
}

// a slope of this tilted box's upper face
std::optional<sim::RampDesc> slope(const Affine& half) {
  int up = 0;
  half.linear().row(2).cwiseQuotient(half.linear().colwise().norm()).cwiseAbs().maxCoeff(&up);
  Vec3 a = half.linear().col((up + 1) % 3), b = half.linear().col((up + 2) % 3);
  if (std::abs(a.z()) < std::abs(b.z())) std::swap(a, b);  // a climbs, b lies across
  if (std::abs(b.z()) > 0.03 * b.norm()) return std::nullopt;
  if (a.z() < 0) a = -a;
  const double angle = std::asin(std::min(1.0, a.z() / a.norm()));
  const Vec3 rise = half.linear().col(up);
  if (!(angle <= kSteepestRampRad) || rise.norm() > 0.6 * a.norm()) return std::nullopt;
  const Vec3 top = half.translation() + (rise.z() < 0 ? -1.0 : 1.0) * rise;
  sim::RampDesc out;
  out.pose = {top.x(), top.y(), std::atan2(a.y(), a.x())};
  out.size_m = {2 * std::hypot(a.x(), a.y()), 2 * b.norm()};
  out.low_m = top.z() - a.z();
  out.high_m = top.z() + a.z();
  return out;
}

std::optional<Piece> box_piece(const Vec3& size, const Affine& frame) {
  const Affine half = frame * Eigen::Scaling(Vec3(0.5 * size));  // from a cube of 2 m
  const Vec3 at = frame.translation();
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back(half * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  const double volume = size.prod() * std::abs(frame.linear().determinant());
  for (int up = 0; up < 3; ++up) {
    const double h = std::abs(half(2, up));
    if (!(h > kUprightZ * half.linear().col(up).norm())) continue;
    // x and y of the plan: the first of the two others that lies flat gives the heading
    const Vec3 a = half.linear().col(up == 0 ? 1 : 0), b = half.linear().col(up == 2 ? 1 : 2);
    if (std::abs(a.x() * b.x() + a.y() * b.y()) > 0.001 * a.norm() * b.norm()) break;  // sheared
    Piece out = box({at.x(), at.y()}, {2 * std::hypot(a.x(), a.y()), 2 * std::hypot(b.x(), b.y())},
                    std::atan2(a.y(), a.x()), at.z() - h, at.z() + h);
    out.volume_m3 = volume;
    return out;
  }
  std::optional<Piece> out = hull_piece(corners);
  if (!out) return out;
  out->volume_m3 = volume;
  out->approximation = "a tilted box: carried as the upright prism around it";
  out->ramp = slope(half);
  return out;
}

// a body of revolution by its rings: height along the axis and radius
std::optional<Piece> round_piece(const std::vector<Vec2>& rings, bool plain, const Affine& frame, bool z_up) {
  const Vec3 axis = frame.linear().col(z_up ? 2 : 1), side = frame.linear().col(0),
             other = frame.linear().col(z_up ? 1 : 2), at = frame.translation();
  const double n = axis.norm();
  double low = 1e300, high = -1e300, radius = 0;
  for (const Vec2 r : rings) {
    low = std::min(low, r.x), high = std::max(high, r.x), radius = std::max(radius, r.y);
  }
  // It stands upright: a cylinder.
  if (n > 0 && std::abs(axis.z()) > kUprightZ * n) {
    Piece out;
    out.kind = ObjectKind::Cylinder;
    out.at = {at.x(), at.y()};
    out.radius_m = radius * std::max(side.norm(), other.norm());
    out.heading_rad = std::atan2(side.y(), side.x());
    const double a = at.z() + low * axis.z(), b = at.z() + high * axis.z();
    out.z_low = std::min(a, b);
    out.z_high = std::max(a, b);
    out.volume_m3 = kPi * out.radius_m * out.radius_m * (out.z_high - out.z_low);
    if (!plain) out.approximation = "carried as the cylinder around it";
    return out;
  }
  // It lies: the prism around points of its rings.
  std::vector<Vec3> points;
  for (const Vec2 r : rings) {
    for (int i = 0; i < 24; ++i) {
      const double t = 2 * kPi * i / 24;
      points.push_back(
          frame * Vec3(r.y * std::cos(t), z_up ? r.y * std::sin(t) : r.x, z_up ? r.x : r.y * std::sin(t)));
    }
  }
  std::optional<Piece> out = hull_piece(points);
  if (out) {
    out->volume_m3 = kPi * radius * radius * (high - low) * n * side.norm() * other.norm();
    out->approximation = "lies on its side: carried as the upright prism around it";
  }
  return out;
}

struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
};

// volume by the divergence theorem, seen from a point near it; nothing sensible for open meshes
double volume_of(const Mesh& m, const std::vector<int>& which, const Vec3& from) {
  double six = 0;
  for (const int f : which) {
    const auto& face = m.faces[static_cast<std::size_t>(f)];
    const auto corner = [&](std::size_t i) -> Vec3 {
      return m.points[static_cast<std::size_t>(face[i])] - from;
    };
    for (std::size_t i = 2; i < face.size(); ++i) six += corner(0).dot(corner(i - 1).cross(corner(i)));
  }
  return std::abs(six) / 6;
}

// the upright faces of a hollow mesh, each a thin wall
void sheets_of(const Mesh& m, const std::vector<int>& which, std::vector<Piece>& out) {
  for (const int f : which) {
    std::vector<Vec3> p;
    for (const int i : m.faces[static_cast<std::size_t>(f)])
      p.push_back(m.points[static_cast<std::size_t>(i)]);
    Vec3 normal = Vec3::Zero();
    for (std::size_t i = 2; i < p.size(); ++i) normal += (p[i - 1] - p[0]).cross(p[i] - p[0]);
    const double n = normal.norm();
    if (!(n > 0) || std::abs(normal.z()) > 0.1 * n) continue;
    if (auto piece = hull_piece(p)) {
      piece->approximation = "a face of a hollow mesh: carried as a wall of 2 mm";
      out.push_back(std::move(*piece));
    }
  }
}

std::vector<Piece> mesh_pieces(const Mesh& m) {
  // parts that hang together, by union and find
  std::vector<int> root(m.points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[static_cast<std::size_t>(i)] != i) {
      int& r = root[static_cast<std::size_t>(i)];
      r = root[static_cast<std::size_t>(r)];
      i = r;
    }
    return i;
  };
  for (const auto& f : m.faces) {
    for (const int i : f) root[static_cast<std::size_t>(find(i))] = find(f[0]);
  }
  std::map<int, std::vector<int>> parts;
  for (std::size_t f = 0; f < m.faces.size(); ++f) parts[find(m.faces[f][0])].push_back(static_cast<int>(f));
  std::vector<Piece> out;
  if (parts.size() > kMostParts) {
    if (auto hull = hull_piece(m.points)) {
      hull->approximation = "a mesh of many parts: carried as the upright prism around it";
      out.push_back(std::move(*hull));
    }
    return out;
  }
  // Each part is a prism, or, where it is hollow, its faces are walls.
  for (const auto& [first, faces] : parts) {
    std::vector<Vec3> points;
    for (const int f : faces) {
      for (const int i : m.faces[static_cast<std::size_t>(f)])
        points.push_back(m.points[static_cast<std::size_t>(i)]);
    }
    auto piece = hull_piece(points);
    if (!piece) continue;
    const double full = piece->area() * (piece->z_high - piece->z_low);
    const double volume = volume_of(m, faces, {piece->at.x, piece->at.y, piece->z_low});
    if (piece->z_high - piece->z_low > 0.01 && piece->area() > 1e-4 && volume < kFullMesh * full &&
        static_cast<int>(faces.size()) <= kMostFaces) {
      sheets_of(m, faces, out);
      continue;
    }
    piece->volume_m3 = volume;
    if (piece->kind == ObjectKind::Polygon || volume < 0.999 * full)
      piece->approximation = "a mesh: carried as the upright prism around it";
    out.push_back(std::move(*piece));
  }
  return out;
}

std::vector<Vec3> triples(const Field* f, const Affine& frame) {
  std::vector<Vec3> out;
  for (std::size_t i = 0; f && i + 2 < f->numbers.size(); i += 3)
    out.push_back(frame * Vec3(f->numbers[i], f->numbers[i + 1], f->numbers[i + 2]));
  return out;
}

std::vector<Piece> face_set(const Node& g, const Affine& frame, std::string& why) {
  Mesh m;
  const Node* coord = g.node("coord");
  m.points = triples(coord ? coord->field("point") : nullptr, frame);
  if (m.points.empty()) return why = "has no points", std::vector<Piece>{};
  if (static_cast<int>(m.points.size()) > kMostPoints) {
    auto hull = hull_piece(m.points);
    if (!hull) return why = "has no extent", std::vector<Piece>{};
    hull->approximation = "a large mesh: carried as the upright prism around it";
    return {std::move(*hull)};
  }
  std::vector<int> face;
  const auto close = [&] {
    if (face.size() >= 3) m.faces.push_back(face);
    face.clear();
  };
  if (const Field* index = g.field("coordIndex")) {
    for (const double i : index->numbers) {
      if (i < 0)
        close();
      else if (i < static_cast<double>(m.points.size()))
        face.push_back(static_cast<int>(i));
    }
  }
  close();
  if (m.faces.empty()) return why = "has no faces", std::vector<Piece>{};
  return mesh_pieces(m);
}

std::vector<Vec3> grid_points(const Node& g, const Affine& frame, bool z_up) {
  const Field* height = g.field("height");
  const double nx = std::floor(std::clamp(g.number("xDimension", 0), 0.0, 1e4));
  const double ny = std::floor(std::clamp(g.number(z_up ? "yDimension" : "zDimension", 0), 0.0, 1e4));
  const double dx = g.number("xSpacing", 1), dy = g.number(z_up ? "ySpacing" : "zSpacing", 1);
  std::vector<Vec3> out;
  if (nx < 2 || ny < 2 || nx * ny > 1e6) return out;
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      const std::size_t k =
          static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
      const double h = height && k < height->numbers.size() ? height->numbers[k] : 0;
      out.push_back(frame * (z_up ? Vec3(i * dx, j * dy, h) : Vec3(i * dx, h, j * dy)));
    }
  }
  return out;
}

/// Axes of the plane that a cross-section lies in at each point of a spine: y along it, z as it bends.
/// [ISO/IEC 14772-1, 6.18]
std::vector<Eigen::Matrix3d> section_axes(const std::vector<Vec3>& spine) {
  const std::size_t n = spine.size();
  const bool is_closed = n > 2 && (spine.front() - spine.back()).norm() < 1e-9;
  const auto point = [&](std::size_t i, int by) {  // the neighbour, over the end of a closed one
    if (i == 0 && by < 0) return is_closed ? spine[n - 2] : spine[0];
    if (i + 1 == n && by > 0) return is_closed ? spine[1] : spine[n - 1];
    return by < 0 ? spine[i - 1] : spine[i + 1];
  };
  std::vector<Vec3> along(n), bend(n);
  Vec3 first_bend = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    along[i] = (point(i, 1) - point(i, -1)).normalized();
    if (i > 0 && along[i].isZero(1e-12)) along[i] = along[i - 1];  // a point twice
    bend[i] = (point(i, 1) - spine[i]).cross(point(i, -1) - spine[i]);
    if (first_bend.isZero(1e-12) && bend[i].norm() > 1e-12) first_bend = bend[i].normalized();
  }
  std::vector<Eigen::Matrix3d> axes(n);
  Vec3 before = first_bend;
  for (std::size_t i = 0; i < n; ++i) {
    if (first_bend.isZero(1e-12)) {  // straight: what stands upright is tilted into its direction
      axes[i] = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitY(),
                                                   along[i].isZero(1e-12) ? Vec3(Vec3::UnitY()) : along[i])
                    .toRotationMatrix();
      continue;
    }
    Vec3 z = bend[i].norm() > 1e-12 ? Vec3(bend[i].normalized()) : before;
    if (z.dot(before) < 0) z = -z;
    before = z;
    axes[i] << along[i].cross(z), along[i], z;
  }
  return axes;
}

std::vector<Vec3> extrusion_points(const Node& g, const Affine& frame) {
  const auto numbers = [&](const char* name, const std::vector<double>& usual) {
    const Field* const field = g.field(name);
    return field && !field->numbers.empty() ? field->numbers : usual;
  };
  const std::vector<double> section = numbers("crossSection", {1, 1, 1, -1, -1, -1, -1, 1, 1, 1}),
                            scale = numbers("scale", {1, 1}), turn = numbers("orientation", {0, 0, 1, 0}),
                            way = numbers("spine", {0, 0, 0, 0, 1, 0});
  std::vector<Vec3> spine, out;
  for (std::size_t i = 0; i + 2 < way.size(); i += 3) spine.emplace_back(way[i], way[i + 1], way[i + 2]);
  if (spine.empty() || static_cast<double>(section.size()) * static_cast<double>(spine.size()) > 1e6)
    return out;
  const std::vector<Eigen::Matrix3d> axes = section_axes(spine);
  for (std::size_t s = 0; s < spine.size(); ++s) {
    // one scale and turn a point, or one for all
    const std::size_t k = std::min(2 * s + 2, scale.size() / 2 * 2),
                      r = std::min(4 * s + 4, turn.size() / 4 * 4);
    const double wide = k >= 2 ? scale[k - 2] : 1, deep = k >= 2 ? scale[k - 1] : 1;
    Eigen::Matrix3d turned_axes = axes[s];
    if (const Vec3 axis = r >= 4 ? Vec3(turn[r - 4], turn[r - 3], turn[r - 2]) : Vec3(Vec3::Zero());
        axis.norm() > 1e-12)
      turned_axes = axes[s] * Eigen::AngleAxisd(turn[r - 1], axis.normalized()).toRotationMatrix();
    for (std::size_t i = 0; i + 1 < section.size(); i += 2)
      out.push_back(frame * (spine[s] + turned_axes * Vec3(section[i] * wide, 0, section[i + 1] * deep)));
  }
  return out;
}

}  // namespace

std::vector<Vec2> Piece::outline() const {
  std::vector<Vec2> local = corners;
  if (kind == ObjectKind::Box) {
    const double a = size.x / 2, b = size.y / 2;
    local = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  } else if (kind != ObjectKind::Polygon) {
    local.clear();
    for (int i = 0; i < 24; ++i)
      local.push_back({radius_m * std::cos(2 * kPi * i / 24), radius_m * std::sin(2 * kPi * i / 24)});
  }
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  for (Vec2& p : local) p = at + Vec2{c * p.x - s * p.y, s * p.x + c * p.y};
  return local;
}

double Piece::area() const { return std::abs(area_of(outline())); }

bool Piece::covers(Vec2 p) const {
  const std::vector<Vec2> o = outline();
  for (std::size_t i = 0; i < o.size(); ++i) {
    if (sim::cross(o[(i + 1) % o.size()] - o[i], p - o[i]) < 0) return false;
  }
  return true;
}

std::optional<Piece> hull_piece(const std::vector<Vec3>& points) {
  if (points.size() < 2) return std::nullopt;
  std::vector<Vec2> plan;
  double low = 1e300, high = -1e300;
  for (const Vec3& p : points) {
    if (!p.allFinite() || p.cwiseAbs().maxCoeff() > 1e6) return std::nullopt;
    plan.push_back({p.x(), p.y()});
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  return prism(convex_hull(std::move(plan)), low, high);
}

bool is_geometry(const std::string& t) {
  return t == "Box" || t == "Sphere" || t == "Cylinder" || t == "Capsule" || t == "Cone" || t == "Plane" ||
         t == "IndexedFaceSet" || t == "ElevationGrid" || t == "Extrusion" || t == "Mesh" ||
         t == "IndexedLineSet" || t == "PointSet";
}

std::vector<Piece> pieces_of(const Node& g, const Affine& frame, bool z_up, std::string& why) {
  // Measures that are missing are Webots' defaults.
  std::vector<Piece> out;
  std::optional<Piece> one;
  const double r = std::abs(g.number("radius", g.type == "Cone" ? g.number("bottomRadius", 1) : 1));
  if (g.type == "Box") {
    const bool old_default = !z_up;  // 2 m until R2018, 0.1 m today; nobody relies on it
    const double d = old_default ? 2 : 0.1;
    one = box_piece(Vec3(g.number("size", d, 0), g.number("size", d, 1), g.number("size", d, 2)).cwiseAbs(),
                    frame);
  } else if (g.type == "Sphere") {
    Piece p;
    p.kind = ObjectKind::Ball;
    const Vec3 at = frame.translation();
    p.at = {at.x(), at.y()};
    p.radius_m = r * frame.linear().colwise().norm().maxCoeff();
    p.z_low = at.z() - p.radius_m;
    p.z_high = at.z() + p.radius_m;
    p.volume_m3 = 4.0 / 3 * kPi * p.radius_m * p.radius_m * p.radius_m;
    one = p;
  } else if (g.type == "Cylinder") {
    const double h = std::abs(g.number("height", 2)) / 2;
    one = round_piece({{-h, r}, {h, r}}, true, frame, z_up);
  } else if (g.type == "Capsule") {
    const double h = std::abs(g.number("height", 2)) / 2;
    one = round_piece({{-h - r, 0}, {-h, r}, {h, r}, {h + r, 0}}, false, frame, z_up);
  } else if (g.type == "Cone") {
    const double h = std::abs(g.number("height", 2)) / 2;
    one = round_piece({{-h, r}, {h, 0}}, false, frame, z_up);
  } else if (g.type == "Plane") {
    const double a = std::abs(g.number("size", 1, 0)) / 2, b = std::abs(g.number("size", 1, 1)) / 2;
    std::vector<Vec3> p;
    for (int i = 0; i < 4; ++i) {
      const double x = i & 1 ? a : -a, y = i & 2 ? b : -b;
      p.push_back(frame * (z_up ? Vec3(x, y, 0) : Vec3(x, 0, y)));
    }
    one = hull_piece(p);
    if (one) one->endless_floor = true;
  } else if (g.type == "IndexedFaceSet") {
    out = face_set(g, frame, why);
    if (out.empty() && why.empty()) why = "has no extent";
  } else if (g.type == "ElevationGrid") {
    one = hull_piece(grid_points(g, frame, z_up));
    if (one && one->z_high - one->z_low > kFlatM) {
      one.reset();
      why = "uneven ground";
    }
  } else if (g.type == "Extrusion") {
    one = hull_piece(extrusion_points(g, frame));
    if (one) one->approximation = "an extrusion: carried as the upright prism around its cross-sections";
  } else {
    why = g.type == "Mesh" ? "its shape is in another file" : "has no volume";
  }
  // What makes no sense is left out.
  if (one) out.push_back(std::move(*one));
  for (const Piece& p : out) {
    const double far = std::max({std::abs(p.at.x), std::abs(p.at.y), std::abs(p.z_low), std::abs(p.z_high)});
    if (!(far < 1e6) || !std::isfinite(p.volume_m3) || !std::isfinite(p.radius_m) ||
        !std::isfinite(p.size.x) || !std::isfinite(p.size.y) || !std::isfinite(p.heading_rad)) {
      out.clear();
      break;
    }
  }
  if (out.empty() && why.empty()) why = "its measures make no sense";
  for (Piece& p : out) p.line = g.line;
  return out;
}

}  // namespace wbt
