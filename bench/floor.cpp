// SPDX-License-Identifier: MIT
// See floor.h. A tick: wheels follow their courses, traction pulls the robots after them, whoever is too near
// to something is pushed out. Every 64 ms: rays, response, wheels' new courses. Each robot keeps a list of
// what is near, made anew when the fastest robot may have gone the list's margin.
#include "bench/floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim_core/light/profiles.h"

namespace bench {
namespace {

constexpr double kControlPeriodS = 0.064;
constexpr double kCruiseSteps = 621, kLimitSteps = 994;  // steps/s [firmware/bench_braitenberg]
constexpr double kGravity = 9.81;                        // m/s2
constexpr double kFloorFriction = 0.5;                   // half of the weight is what both wheels can push
constexpr double kMarginM = 0.05;                        // of the lists
constexpr double kCellM = 0.25;
constexpr double kWallPieceM = 0.3;  // walls are cut, so that a cell holds few of them
constexpr int kSensors = 8, kRays = 3;
constexpr std::array<double, kSensors> kLeftWeights = {-1.3, -1, -.5, 0, 0, .5, 1, 1.1},
                                       kRightWeights = {1.1, 1, .5, 0, 0, -.5, -1, -1.3};

/// A box by its sides: outside of side i where normal i times the point is above offset i.
struct Box {
  double nx[4], ny[4], offset[4];
  double x, y, reach;  // centre, and half the diagonal

  Box(double cx, double cy, double heading, double half_x, double half_y)
      : x(cx), y(cy), reach(std::hypot(half_x, half_y)) {
    const double half[4] = {half_x, half_y, half_x, half_y};
    for (int i = 0; i < 4; ++i) {
      nx[i] = std::cos(heading + i * sim::kPi / 2);
      ny[i] = std::sin(heading + i * sim::kPi / 2);
      offset[i] = half[i] + nx[i] * cx + ny[i] * cy;
    }
  }
  /// How far a point is outside of the side it is farthest from, and which that is.
  double outside(double px, double py, int& side) const {
    double most = -1e9;
    for (int i = 0; i < 4; ++i)
      if (const double d = nx[i] * px + ny[i] * py - offset[i]; d > most) most = d, side = i;
    return most;
  }
};

/// What lies in which cell of a square floor.
class Grid {
 public:
  void resize(double side_m) { cells_ = int(side_m / kCellM) + 1; }
  template <typename X, typename Y>
  void fill(int items, X x, Y y) {
    first_.assign(std::size_t(cells_ * cells_) + 1, 0);
    items_.resize(std::size_t(items));
    for (int i = 0; i < items; ++i) ++first_[std::size_t(at(x(i), y(i))) + 1];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (int i = 0; i < items; ++i) items_[std::size_t(next[std::size_t(at(x(i), y(i)))]++)] = i;
  }
  template <typename Visit>
  void each_near(double x, double y, double reach, Visit visit) const {
    for (int row = place(y - reach); row <= place(y + reach); ++row)
      for (int column = place(x - reach); column <= place(x + reach); ++column) {
        const std::size_t cell = std::size_t(row * cells_ + column);
        for (int k = first_[cell]; k < first_[cell + 1]; ++k) visit(items_[std::size_t(k)]);
      }
  }

 private:
  int place(double v) const { return std::clamp(int(v / kCellM), 0, cells_ - 1); }
  int at(double x, double y) const { return place(y) * cells_ + place(x); }
  int cells_ = 1;
  std::vector<int> first_, items_;
};

using Array = std::vector<double>;

}  // namespace

struct Floor::Inside {
  explicit Inside(const sim::WorldDesc& world);
  void tick();
  double drive();
  void push_out(double moved_m);
  void gather();
  void control();
  void sense(int robot, double (&readings)[kSensors]) const;
  double response(double distance_m) const;

  int n;
  double dt, now_s = 0, next_control_s = 0;
  long ticks = 0;
  // of the model
  double radius, axle, radians_per_step, wheel_radius, most_push, most_turn;
  double range, reach;  // of a ray, and of the sensor farthest from the centre
  double at_x[kSensors], at_y[kSensors], axis_x[kSensors], axis_y[kSensors];
  double ray_x[kSensors][kRays], ray_y[kSensors][kRays];
  double slant;  // how much longer than the centre ray the others are
  Array curve;   // response at equal distances, 0 to 1
  // robots: pose, speed, wheels' courses (steps at time 0, steps/s), their angles at the last tick
  Array x, y, heading, vx, vy, turn, left, right, left_rate, right_rate, left_rad, right_rad;
  // what is near each of them: first[i] to first[i + 1] of both lists
  std::vector<Box> boxes;
  std::vector<int> near_robots, first_robot, near_boxes, first_box;
  Array room;          // distance to the nearest when the lists were made
  double moved_m = 0;  // since then, at most
  double largest_box = 0;
  Grid robot_grid, box_grid;
};

Floor::Inside::Inside(const sim::WorldDesc& world) : n(int(world.robots.size())), dt(1.0 / world.physics_hz) {
  const sim::RobotModel& model = *world.model_of(world.robots.front());
  radius = model.body_radius_m;
  axle = model.axle_m;
  wheel_radius = model.wheel_radius_m;
  radians_per_step = 2 * sim::kPi / model.steps_per_turn;
  const double push_n = model.mass_kg * kGravity * kFloorFriction;
  most_push = push_n / model.mass_kg * dt;
  most_turn = push_n * 0.5 * axle / model.inertia_kg_m2 * dt;

  const sim::ProximityConfig sensor = sim::resolve_proximity(world, 0, 0);
  range = sensor.max_range_m();
  reach = range;
  for (int s = 0; s < kSensors; ++s) {
    const sim::SensorMount& mount = model.proximity[std::size_t(s)];
    at_x[s] = mount.at_m.x, at_y[s] = mount.at_m.y;
    axis_x[s] = std::cos(mount.yaw_rad), axis_y[s] = std::sin(mount.yaw_rad);
    reach = std::max(reach, range + std::hypot(at_x[s], at_y[s]));
    for (int r = 0; r < kRays; ++r) {
      const double angle = mount.yaw_rad + (r - 1) * sensor.aperture_rad / 2;
      ray_x[s][r] = std::cos(angle), ray_y[s][r] = std::sin(angle);
    }
  }
  slant = 1 / std::cos(sensor.aperture_rad / 2);
  constexpr int kCurvePieces = 256;
  for (int k = 0; k <= kCurvePieces; ++k) {
    const double d = range * k / kCurvePieces;
    std::size_t row = 1;
    while (row + 1 < sensor.table.size() && sensor.table[row].distance_m < d) ++row;
    const auto &a = sensor.table[row - 1], &b = sensor.table[row];
    const double part = (d - a.distance_m) / (b.distance_m - a.distance_m);
    curve.push_back((a.value + part * (b.value - a.value)) / sensor.table.front().value);
  }

  const double shift_x = world.arena->size_m.x / 2 - world.arena->centre_m.x,
               shift_y = world.arena->size_m.y / 2 - world.arena->centre_m.y;
  for (Array* each : {&vx, &vy, &turn, &left, &right, &left_rate, &right_rate, &left_rad, &right_rad, &room})
    each->assign(std::size_t(n), 0);
  for (const sim::RobotDesc& robot : world.robots) {
    x.push_back(robot.pose.x_m + shift_x);
    y.push_back(robot.pose.y_m + shift_y);
    heading.push_back(robot.pose.heading_rad);
  }
  for (const sim::ObjectDesc& box : world.objects)
    boxes.emplace_back(box.pose.x_m + shift_x, box.pose.y_m + shift_y, box.pose.heading_rad, box.size_m.x / 2,
                       box.size_m.y / 2);
  const double side = world.arena->size_m.x, thick = world.arena->wall_thickness_m / 2;
  const int pieces = int(std::ceil(side / kWallPieceM));
  for (int p = 0; p < pieces; ++p) {
    const double middle = (p + 0.5) * side / pieces, half = 0.5 * side / pieces;
    boxes.emplace_back(middle, -thick, 0, half, thick);
    boxes.emplace_back(middle, side + thick, 0, half, thick);
    boxes.emplace_back(-thick, middle, 0, thick, half);
    boxes.emplace_back(side + thick, middle, 0, thick, half);
  }
  for (const Box& box : boxes) largest_box = std::max(largest_box, box.reach);
  robot_grid.resize(side);
  box_grid.resize(side);
  box_grid.fill(
      int(boxes.size()), [&](int i) { return boxes[std::size_t(i)].x; },
      [&](int i) { return boxes[std::size_t(i)].y; });
  gather();
}

/// Lists what comes within reach before the fastest robot has gone half the margin.
void Floor::Inside::gather() {
  robot_grid.fill(
      n, [&](int i) { return x[std::size_t(i)]; }, [&](int i) { return y[std::size_t(i)]; });
  near_robots.clear(), near_boxes.clear(), first_robot.clear(), first_box.clear();
  const double far = reach + kMarginM;
  for (int i = 0; i < n; ++i) {
    const std::size_t me = std::size_t(i);
    first_robot.push_back(int(near_robots.size()));
    first_box.push_back(int(near_boxes.size()));
    double nearest = far - radius;
    robot_grid.each_near(x[me], y[me], far + radius, [&](int j) {
      const double dx = x[std::size_t(j)] - x[me], dy = y[std::size_t(j)] - y[me];
      const double squared = dx * dx + dy * dy;
      if (j == i || squared > (far + radius) * (far + radius)) return;
      nearest = std::min(nearest, std::sqrt(squared) - 2 * radius);
      near_robots.push_back(j);
    });
    box_grid.each_near(x[me], y[me], far + largest_box, [&](int b) {
      int side = 0;
      const double out = boxes[std::size_t(b)].outside(x[me], y[me], side);
      if (out > far) return;
      nearest = std::min(nearest, out - radius);
      near_boxes.push_back(b);
    });
    room[me] = nearest;
  }
  first_robot.push_back(int(near_robots.size()));
  first_box.push_back(int(near_boxes.size()));
  moved_m = 0;
}

/// Wheels, traction, poses, for all robots in one loop without a branch. Returns the highest speed, m/s.
double Floor::Inside::drive() {
  double fastest = 0;
  for (std::size_t i = 0; i < std::size_t(n); ++i) {
    // motors stand still between steps
    const double l = std::floor(left[i] + left_rate[i] * now_s) * radians_per_step,
                 r = std::floor(right[i] + right_rate[i] * now_s) * radians_per_step;
    const double rim_l = (l - left_rad[i]) * wheel_radius / dt,
                 rim_r = (r - right_rad[i]) * wheel_radius / dt;
    left_rad[i] = l, right_rad[i] = r;
    const double wanted = 0.5 * (rim_l + rim_r), wanted_turn = (rim_r - rim_l) / axle;
    turn[i] += std::min(std::max(wanted_turn - turn[i], -most_turn), most_turn);
    const double middle = heading[i] + 0.5 * turn[i] * dt;
    // sine and cosine of the half angle by polynomials, which the compiler turns into vector code
    const double turns = std::floor(middle / (2 * sim::kPi) + 0.5);
    const double h = 0.5 * (middle - turns * 2 * sim::kPi), q = h * h;
    const double s = h * (1 + q * (-1. / 6 + q * (1. / 120 + q * (-1. / 5040 + q * (1. / 362880)))));
    const double c = 1 + q * (-.5 + q * (1. / 24 + q * (-1. / 720 + q * (1. / 40320))));
    const double to_x = wanted * (c * c - s * s) - vx[i], to_y = wanted * 2 * s * c - vy[i];
    const double change = std::sqrt(to_x * to_x + to_y * to_y);
    const double part = change <= most_push ? 1.0 : most_push / change;
    vx[i] += part * to_x, vy[i] += part * to_y;
    x[i] += vx[i] * dt, y[i] += vy[i] * dt, heading[i] += turn[i] * dt;
    fastest = std::max(fastest, vx[i] * vx[i] + vy[i] * vy[i]);
  }
  return std::sqrt(fastest);
}

/// Bodies do not overlap, and do not move into one another. `moved`: what both may have come nearer.
void Floor::Inside::push_out(double moved) {
  for (std::size_t i = 0; i < std::size_t(n); ++i) {
    if (room[i] > moved) continue;
    for (int k = first_robot[i]; k < first_robot[i + 1]; ++k) {
      const std::size_t j = std::size_t(near_robots[std::size_t(k)]);
      const double dx = x[i] - x[j], dy = y[i] - y[j], squared = dx * dx + dy * dy;
      if (squared >= 4 * radius * radius || squared == 0) continue;
      const double d = std::sqrt(squared), nx = dx / d, ny = dy / d, half = 0.5 * (2 * radius - d);
      x[i] += half * nx, y[i] += half * ny, x[j] -= half * nx, y[j] -= half * ny;
      const double along = 0.5 * std::min(0.0, (vx[i] - vx[j]) * nx + (vy[i] - vy[j]) * ny);
      vx[i] -= along * nx, vy[i] -= along * ny, vx[j] += along * nx, vy[j] += along * ny;
    }
    for (int k = first_box[i]; k < first_box[i + 1]; ++k) {
      const Box& box = boxes[std::size_t(near_boxes[std::size_t(k)])];
      int side = 0;
      const double out = box.outside(x[i], y[i], side);
      if (out >= radius) continue;
      const double nx = box.nx[side], ny = box.ny[side];
      x[i] += (radius - out) * nx, y[i] += (radius - out) * ny;
      const double along = std::min(0.0, vx[i] * nx + vy[i] * ny);
      vx[i] -= along * nx, vy[i] -= along * ny;
    }
  }
}

double Floor::Inside::response(double distance_m) const {
  const double at = distance_m / range * double(curve.size() - 1);
  const std::size_t i = std::size_t(at);
  if (i + 1 >= curve.size()) return 0;
  return curve[i] + (at - double(i)) * (curve[i + 1] - curve[i]);
}

/// Readings 0 to 1, by rays in the robot's own frame against what its lists hold.
void Floor::Inside::sense(int robot, double (&readings)[kSensors]) const {
  struct LocalBox {
    double nx[4], ny[4], offset[4];
  };
  struct LocalDisc {
    double x, y;
  };
  constexpr int kMost = 16;
  LocalBox local_boxes[kMost];
  LocalDisc discs[kMost];
  int some_boxes = 0, some_discs = 0;
  const std::size_t me = std::size_t(robot);
  const double c = std::cos(heading[me]), s = std::sin(heading[me]);
  for (int k = first_robot[me]; k < first_robot[me + 1] && some_discs < kMost; ++k) {
    const std::size_t j = std::size_t(near_robots[std::size_t(k)]);
    const double dx = x[j] - x[me], dy = y[j] - y[me];
    if (dx * dx + dy * dy < (reach + radius) * (reach + radius))
      discs[some_discs++] = {c * dx + s * dy, c * dy - s * dx};
  }
  for (int k = first_box[me]; k < first_box[me + 1] && some_boxes < kMost; ++k) {
    const Box& box = boxes[std::size_t(near_boxes[std::size_t(k)])];
    LocalBox& local = local_boxes[some_boxes];
    double out = -1e9;
    for (int i = 0; i < 4; ++i) {
      local.nx[i] = c * box.nx[i] + s * box.ny[i];
      local.ny[i] = c * box.ny[i] - s * box.nx[i];
      local.offset[i] = box.offset[i] - (box.nx[i] * x[me] + box.ny[i] * y[me]);
      out = std::max(out, -local.offset[i]);
    }
    some_boxes += out < reach;
  }
  for (int k = 0; k < kSensors; ++k) {
    readings[k] = 0;
    if (some_boxes + some_discs == 0) continue;
    double hit[kRays] = {range, range, range};
    for (int d = 0; d < some_discs; ++d) {
      const double dx = at_x[k] - discs[d].x, dy = at_y[k] - discs[d].y, squared = dx * dx + dy * dy;
      if (squared > (range + radius) * (range + radius) || dx * axis_x[k] + dy * axis_y[k] > radius) continue;
      for (int r = 0; r < kRays; ++r) {
        const double b = dx * ray_x[k][r] + dy * ray_y[k][r], root = b * b - (squared - radius * radius);
        if (b < 0 && root >= 0) hit[r] = std::min(hit[r], std::max(0.0, -b - std::sqrt(root)));
      }
    }
    for (int i = 0; i < some_boxes; ++i) {
      const LocalBox& box = local_boxes[i];
      double out[4], most = -1e9;
      for (int e = 0; e < 4; ++e)
        most = std::max(most, out[e] = box.nx[e] * at_x[k] + box.ny[e] * at_y[k] - box.offset[e]);
      if (most > range) continue;
      for (int r = 0; r < kRays; ++r) {
        double enter = 0, leave = hit[r];
        for (int e = 0; e < 4; ++e) {
          const double along = box.nx[e] * ray_x[k][r] + box.ny[e] * ray_y[k][r], at = -out[e] / along;
          if (along < 0)
            enter = std::max(enter, at);
          else
            leave = std::min(leave, at);
        }
        if (enter <= leave && enter < hit[r]) hit[r] = enter;
      }
    }
    // every ray answers by itself, and the centre ray makes up for the slant of the others
    // [Enki: IRSensor.cpp]
    double sum = 0;
    for (int r = 0; r < kRays; ++r) sum += response(hit[r]);
    sum -= 2 * response(hit[1] * slant);
    readings[k] = std::clamp(sum, 0.0, 1.0);
  }
}

/// The Braitenberg law: new courses for the wheels, which go on where they are.
void Floor::Inside::control() {
  for (int robot = 0; robot < n; ++robot) {
    double readings[kSensors], sum_left = 1, sum_right = 1;
    sense(robot, readings);
    for (std::size_t s = 0; s < kSensors; ++s) {
      sum_left += kLeftWeights[s] * readings[s];
      sum_right += kRightWeights[s] * readings[s];
    }
    const std::size_t i = std::size_t(robot);
    const auto set = [&](Array& course, Array& rate, double sum) {
      const double speed = std::clamp(kCruiseSteps * sum, -kLimitSteps, kLimitSteps);
      course[i] += (rate[i] - speed) * now_s;
      rate[i] = speed;
    };
    set(left, left_rate, sum_left);
    set(right, right_rate, sum_right);
  }
}

void Floor::Inside::tick() {
  if (now_s >= next_control_s) {
    next_control_s += kControlPeriodS;
    control();
  }
  now_s = double(++ticks) * dt;
  const double step_m = drive() * dt;
  moved_m += step_m;
  push_out(2 * moved_m);
  if (2 * moved_m > kMarginM - 4 * step_m) gather();
}

Floor::Floor(const sim::WorldDesc& world) : inside_(std::make_unique<Inside>(world)) {}
Floor::~Floor() = default;
void Floor::run_until(double seconds) {
  while (inside_->now_s < seconds) inside_->tick();
}
double Floor::checksum() const {
  double sum = 0;
  for (std::size_t i = 0; i < inside_->x.size(); ++i) sum += inside_->x[i] + inside_->y[i];
  return sum;
}

}  // namespace bench
