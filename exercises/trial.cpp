// SPDX-License-Identifier: MIT
#include "exercises/trial.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "hal_sim/twin/world_file.h"
#include "install/places.h"
#include "outputs/summary.h"
#include "sim_core/light/proximity.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/layout.h"
#include "sim_core/world/scene.h"

namespace lab {

namespace {

constexpr double kProgressM = 0.02;         // what counts as progress
constexpr double kStartClearanceM = 0.01;   // free room around a robot that starts at random
constexpr int kMostTries = 10000;           // places tried for one robot
constexpr std::uint32_t kStreamStart = 50;  // below the boards' streams
constexpr double kLiftM = 0.05;
constexpr sim::Clicks kTrapLook = sim::kClicksPerSecond / 4;
constexpr double kSlipWindowS = 1, kSlipM = 0.002;  // less than this in a window is rounding of whole steps

double uniform(const sim::RandomKey& key, std::uint64_t counter, Span span) {
  return span.low + (span.high - span.low) * sim::random_uniform(key, counter);
}

// a free place for robot `index`, given where those before it stand
bool place_anywhere(sim::WorldDesc& world, std::size_t index, const sim::Layout& layout) {
  const sim::RandomKey key{world.seed, static_cast<std::uint32_t>(index), kStreamStart};
  const double radius_m = world.model_of(world.robots[index])->body_radius_m + kStartClearanceM;
  for (int n = 0; n < kMostTries; ++n) {
    const auto counter = static_cast<std::uint64_t>(3 * n);
    const sim::Vec2 at{uniform(key, counter, {layout.low_m.x, layout.high_m.x}),
                       uniform(key, counter + 1, {layout.low_m.y, layout.high_m.y})};
    if (world.arena && (std::fabs(at.x - world.arena->centre_m.x) > world.arena->size_m.x / 2 - radius_m ||
                        std::fabs(at.y - world.arena->centre_m.y) > world.arena->size_m.y / 2 - radius_m))
      continue;
    bool is_free = true;
    for (const sim::Placed& solid : layout.fixed)
      is_free = is_free && sim::plan_distance_m(at, solid) > radius_m;
    for (std::size_t other = 0; other < index; ++other) {
      const sim::Pose2& p = world.robots[other].pose;
      is_free = is_free && std::hypot(p.x_m - at.x, p.y_m - at.y) > 2 * radius_m;
    }
    if (!is_free) continue;
    world.robots[index].pose = {at.x, at.y, uniform(key, counter + 2, {0, 2 * sim::kPi})};
    return true;
  }
  return false;
}

bool place_robots(sim::WorldDesc& world, const Start& start) {
  const sim::Layout layout = sim::build_layout(world);
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    if (start.anywhere) {
      if (!place_anywhere(world, i, layout)) return false;
      continue;
    }
    const sim::RandomKey key{world.seed, static_cast<std::uint32_t>(i), kStreamStart};
    sim::Pose2& pose = world.robots[i].pose;
    pose.x_m += uniform(key, 0, start.x_m);
    pose.y_m += uniform(key, 1, start.y_m);
    pose.heading_rad += sim::radians(uniform(key, 2, start.heading_deg));
  }
  return true;
}

// what this process has had of the processor: on an idle PC as much as passes, on a busy one less
double cpu_s() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// follows one robot through its run
class Watch {
 public:
  Watch(const sim::Simulation& simulation, int robot, const std::vector<double>& region, double wheel_step_m)
      : simulation_(simulation), robot_(robot), region_(region), step_m_(wheel_step_m) {
    anchor_ = simulation.pose(robot);
  }

  void look() {
    const double now_s = sim::to_seconds(simulation_.now());
    const sim::Pose2& p = simulation_.pose(robot_);
    if (std::hypot(p.x_m - anchor_.x_m, p.y_m - anchor_.y_m) >= kProgressM) anchor_ = p, anchor_s_ = now_s;
    standstill_s = std::max(standstill_s, now_s - anchor_s_);
    if (!region_.empty() && std::isinf(escape_s) &&
        (p.x_m < region_[0] || p.y_m < region_[1] || p.x_m > region_[2] || p.y_m > region_[3]))
      escape_s = now_s;
    if (now_s - window_s_ < kSlipWindowS) return;
    window_s_ = now_s;
    const auto report = simulation_.minds()[static_cast<std::size_t>(robot_)]->report();
    const auto steps = report.left_steps + report.right_steps;
    const double turned_m = std::fabs(0.5 * step_m_ * static_cast<double>(steps - last_steps_));
    const double made_m = simulation_.distance_m(robot_) - last_distance_m_;
    if (turned_m - made_m > kSlipM) slip_m += turned_m - made_m;
    last_steps_ = steps;
    last_distance_m_ = simulation_.distance_m(robot_);
  }

  double standstill_s = 0, slip_m = 0;
  double escape_s = std::numeric_limits<double>::infinity();

 private:
  const sim::Simulation& simulation_;
  const int robot_;
  const std::vector<double>& region_;
  const double step_m_;
  sim::Pose2 anchor_;
  double anchor_s_ = 0, window_s_ = 0, last_distance_m_ = 0;
  std::int64_t last_steps_ = 0;
};

// objects that somebody lifts while the world runs
class Lifts {
 public:
  explicit Lifts(const sim::Simulation& simulation) : simulation_(simulation) { look(); }

  void look() {
    const int bodies = static_cast<int>(simulation_.scene().layout().moving.size());
    heights_m_.resize(static_cast<std::size_t>(bodies));
    for (int body = simulation_.robots(); body < bodies; ++body) {
      double& before_m = heights_m_[static_cast<std::size_t>(body)];
      const double z_m = simulation_.state(body).z_m;
      if (began_ && z_m > before_m + kLiftM) ++restarts, restart_m = std::min(restart_m, z_m);
      before_m = z_m;
    }
    began_ = true;
  }

  int restarts = 0;
  double restart_m = std::numeric_limits<double>::infinity();

 private:
  const sim::Simulation& simulation_;
  bool began_ = false;
  std::vector<double> heights_m_;
};

void run(twin::Twin& twin, programs::Team& team, const Trial& trial, Measures& m, TrialOnlooker* onlooker) {
  const Step& step = *trial.step;
  auto& simulation = twin.simulation();
  Lifts lifts(simulation);  // sees the kick-off
  team.before_first_tick();
  if (onlooker) onlooker->before_run();
  std::vector<Watch> watches;
  for (int i = 0; i < twin.robots(); ++i) {
    const auto* model = twin.world().model_of(twin.world().robots[static_cast<std::size_t>(i)]);
    watches.emplace_back(simulation, i, step.region,
                         2 * sim::kPi * model->wheel_radius_m / model->steps_per_turn);
  }
  const double cpu_before_s = cpu_s();
  const sim::Clicks end = sim::from_seconds(trial.seconds);
  const auto all_out = [&] {
    return !step.region.empty() && std::all_of(watches.begin(), watches.end(),
                                               [](const Watch& w) { return std::isfinite(w.escape_s); });
  };
  // who has trapped has failed: a program that resets for ever would take its time
  sim::Clicks next_look = 0;
  const auto has_trapped = [&] {
    if (simulation.now() < next_look) return false;
    next_look = simulation.now() + kTrapLook;
    return !twin.traps().empty();
  };
  while (simulation.now() < end && !all_out() && !team.has_ended() && !has_trapped()) {
    simulation.step();
    for (Watch& w : watches) w.look();
    lifts.look();
    if (onlooker) onlooker->after_tick();
  }
  team.finish();
  m[Measure::Restarts] = lifts.restarts;
  m[Measure::RestartM] = lifts.restart_m;
  m[Measure::Speed] = sim::to_seconds(simulation.now()) / (cpu_s() - cpu_before_s);
  m[Measure::StandstillS] = m[Measure::WallTouchS] = m[Measure::TouchS] = m[Measure::Collisions] = 0;
  m[Measure::EscapeS] = m[Measure::SlipM] = 0;
  m[Measure::DistanceM] = std::numeric_limits<double>::infinity();
  for (int i = 0; i < twin.robots(); ++i) {
    const Watch& w = watches[static_cast<std::size_t>(i)];
    const auto raise = [&](Measure what, double value) { m[what] = std::max(m[what], value); };
    raise(Measure::StandstillS, w.standstill_s);
    raise(Measure::WallTouchS, simulation.touches(i).longest_wall_touch_s);
    raise(Measure::TouchS, simulation.touches(i).longest_touch_s);
    raise(Measure::EscapeS, w.escape_s);
    raise(Measure::SlipM, w.slip_m);
    m[Measure::Collisions] += simulation.touches(i).collisions;
    m[Measure::DistanceM] = std::min(m[Measure::DistanceM], simulation.distance_m(i));
  }
  if (step.region.empty()) m[Measure::EscapeS] = std::numeric_limits<double>::quiet_NaN();
}

// farthest wall, of the material of the world's first one, that sensor 0 tells from nothing
double detection_m(sim::WorldDesc world) {
  const double range_m = sim::resolve_proximity(world, 0, 0).table.back().distance_m;
  const sim::SensorMount mount = world.model_of(world.robots[0])->proximity[0];
  sim::ObjectDesc wall;
  wall.size_m = {0.01, 1, 0.1};
  wall.material = world.walls.empty() ? world.arena->material : world.walls[0].material;
  world.walls.clear(), world.objects.clear(), world.arena.reset();
  world.robots.resize(1);
  world.robots[0].pose = {};
  const auto value_at = [&](double gap_m) {
    // square to the sensor's axis
    const double reach_m = gap_m + wall.size_m.x / 2;
    wall.pose = {mount.at_m.x + reach_m * std::cos(mount.yaw_rad),
                 mount.at_m.y + reach_m * std::sin(mount.yaw_rad), mount.yaw_rad};
    world.objects = {wall};
    const auto optics = sim::make_optics(world);
    sim::Scene scene(world, sim::optics_reach_m(*optics));
    scene.attach_optics(optics);
    return sim::sense_proximity(scene, 0, 0, 0).value;
  };
  const double nothing = value_at(10);
  double low_m = 0, high_m = range_m + 0.01;
  while (high_m - low_m > 1e-5) {
    const double middle_m = 0.5 * (low_m + high_m);
    (std::fabs(value_at(middle_m) - nothing) > 0.5 ? low_m : high_m) = middle_m;  // half a count
  }
  return low_m;
}

void measure_sensor(const sim::WorldDesc& world, Measures& m) {
  const sim::ProximityConfig c = sim::resolve_proximity(world, 0, 0);
  m[Measure::Rows] = static_cast<double>(c.table.size());
  m[Measure::RangeM] = c.table.back().distance_m;
  const auto rays = sim::plan_rays(c.rays, c.aperture_rad, c.gaussian_width, c.layout);
  m[Measure::CentreWeight] = rays.front().weight;
  m[Measure::OuterWeight] = rays.size() > 1 ? rays.back().weight : 0;
  double n = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  for (const sim::ResponseRow& row : c.table) {
    n += 1, x += row.distance_m, y += row.value;
    xx += row.distance_m * row.distance_m, yy += row.value * row.value, xy += row.distance_m * row.value;
  }
  const double covariance = n * xy - x * y;
  m[Measure::Straightness] = covariance * covariance / ((n * xx - x * x) * (n * yy - y * y));
  m[Measure::DetectionM] = detection_m(world);
}

}  // namespace

TrialEnd run_trial(const Trial& trial, TrialOnlooker* onlooker) {
  TrialEnd result;
  auto& problems = result.problems;
  const Step& step = *trial.step;
  const std::string file = (places::share_root() / "worlds" / (trial.world + ".toml")).string();
  sim::LoadedWorld loaded = twin::load_world(file);
  if (!loaded.world) {
    problems.push_back(loaded.report(file));
    return result;
  }
  sim::WorldDesc& world = *loaded.world;
  world.seed = trial.seed;
  if (!std::isnan(trial.noise_scale)) world.proximity.noise_scale = trial.noise_scale;
  if (step.kind == Step::Kind::Sensor) {
    measure_sensor(world, result.measures);
    result.ran = true;
    return result;
  }
  for (sim::RobotDesc& robot : world.robots) {
    robot.variation.gain_spread = step.gain_spread;
    robot.variation.offset_spread_counts = step.offset_spread_counts;
    robot.variation.wheel_spread = step.wheel_spread;
  }
  if (!place_robots(world, step.start)) {
    problems.push_back(file + ": start: got no free place for every robot, expected more room");
    return result;
  }
  twin::Options options;
  options.hal = trial.hal;
  if (!trial.image.empty()) options.firmware = {{"*", trial.image}};
  std::vector<std::string> supervisors;
  if (!step.supervisor.empty()) supervisors.push_back(step.supervisor);
  const auto opened = runs::Run::open(std::move(world), options, supervisors, problems);
  if (!opened || (onlooker && !onlooker->open(*opened, problems))) return result;
  twin::Twin& twin = opened->twin();
  programs::Team& team = opened->team();
  // "NAME TIME s: TEXT"
  team.say = [&result](const std::string& line) {
    const auto colon = line.find(": ");
    result.said = line.substr(colon == std::string::npos ? 0 : colon + 2);
  };
  run(twin, team, trial, result.measures, onlooker);
  result.digest = twin.simulation().digest();
  result.ran = twin.traps().empty() && team.outcome().code == 0;
  if (team.outcome().code != 0) problems.push_back(file + ": supervisor: " + team.outcome().text);
  for (const auto& trap : twin.traps()) problems.push_back(outputs::to_text(trap));
  if (onlooker) onlooker->finish(problems);
  return result;
}

}  // namespace lab
