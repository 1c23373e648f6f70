// SPDX-License-Identifier: MIT
#include "python/core/world.h"

#include <algorithm>
#include <chrono>

#include "hal_sim/board/bluetooth_module.h"
#include "hal_sim/board/uart_end.h"
#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/record/picture.h"

namespace python {

namespace {

constexpr sim::Clicks kLook = sim::kClicksPerSecond / 64;
constexpr auto kStopEvery = std::chrono::milliseconds(20);

/// Where a link leads that nobody is at any more.
class Nobody : public board::UartEnd {
 public:
  void deliver(const std::uint8_t*, const board::Cycle*, std::size_t) override {}
  std::size_t collect(std::uint8_t*, std::size_t, board::Cycle) override { return 0; }
  std::string name() const override { return {}; }
};

}  // namespace

std::unique_ptr<World> World::open(const Opening& opening, std::vector<std::string>& problems) {
  std::unique_ptr<World> world(new World(opening));
  return world->begin(problems) ? std::move(world) : nullptr;
}

bool World::begin(std::vector<std::string>& problems) {
  sim::LoadedWorld loaded = twin::parse_world(opening_.text, opening_.file);
  if (!loaded.world) {
    problems.push_back(loaded.report(opening_.file));
    return false;
  }
  if (opening_.seed) loaded.world->seed = *opening_.seed;
  opening_.seed = loaded.world->seed;
  twin::Options& options = opening_.options;
  options.tell = [this](const std::string& line) { notices_.push_back(line); };
  run_ = runs::Run::open(std::move(*loaded.world), options, opening_.supervisors, problems);
  if (!run_) return false;
  run_->team().say = [this](const std::string& line) { consoles_[-1].push_back(line); };
  run_->team().should_give_up = [this] { return should_stop && should_stop(); };
  for (const std::string& name : opening_.measured)
    if (name != "*" && twin().find(name) < 0) {
      problems.push_back("World: measured: got '" + name + "', expected a robot of the world, or *");
      return false;
    }
  ways_ = std::make_unique<sim::Trajectories>(twin().robots());
  images_ = inputs::images_of(twin());
  listen();
  run_->team().before_first_tick();
  sample();
  return true;
}

World::~World() {
  std::vector<std::string> ignored;
  finish(ignored);
  for (const auto& [robot, profile] : profiles_)
    dynamic_cast<chip::ChipRunner*>(mind(robot).runner())->watch_steps(profile.get(), false);
}

void World::listen() {
  heard_.resize(static_cast<std::size_t>(twin().robots()));
  for (int robot = 0; robot < twin().robots(); ++robot) {
    host::FirmwareMind& mind = twin().mind(robot);
    for (int port = 1; port <= 2; ++port)
      mind.board().uart(port).listen(
          &heard_[static_cast<std::size_t>(robot)][static_cast<std::size_t>(port - 1)]);
    mind.board().virtual_devices().on_console = [this, robot](const std::string& line) {
      consoles_[robot].push_back(line);
    };
    if (board::Camera* camera = mind.board().camera())
      camera->on_picture = [this, robot](const board::CameraPicture& p) {
        // robots run side by side: each has its own place, made before
        pictures_.at(robot) = p;
      };
    pictures_[robot];
    const std::string& name = twin().world().robots[static_cast<std::size_t>(robot)].name;
    const bool is_measured = std::any_of(opening_.measured.begin(), opening_.measured.end(),
                                         [&](const std::string& m) { return m == "*" || m == name; });
    auto* const runner = is_measured ? dynamic_cast<chip::ChipRunner*>(mind.runner()) : nullptr;
    if (!runner) continue;
    auto& profile = profiles_[robot] = std::make_unique<chip::Profile>(
        runner->image()->file(), runner->processor(), runner->device(), runner->host());
    runner->watch_steps(profile.get(), true);
  }
}

debug::Machine* World::machine(int robot) {
  auto& machine = machines_[robot];
  if (!machine)
    if (auto* const runner = dynamic_cast<chip::ChipRunner*>(mind(robot).runner()))
      machine = std::make_unique<debug::Machine>(*runner);
  return machine.get();
}

// --- running

sim::Clicks World::next_look() const {
  sim::Clicks next = simulation().now() + kLook;
  for (const auto& record : records_) next = std::min(next, record->next);
  return next;
}

World::Why World::run(sim::Clicks end, const std::function<bool()>& each_tick, bool stops_at_traps) {
  using Wall = std::chrono::steady_clock;
  sim::Simulation& simulation = run_->simulation();
  if (stops_at_traps && traps_ < 0) traps_ = traps_seen();
  if (!stops_at_traps) traps_ = -1;
  auto asked = Wall::now();
  while (simulation.now() < end) {
    if (run_->team().has_ended()) return Why::Ended;
    if (each_tick)
      run_->inputs().step();
    else
      run_->inputs().faults().advance(std::min(end, next_look()));
    sample();
    if (stops_at_traps)
      if (const std::int64_t traps = traps_seen(); traps != traps_) {
        traps_ = traps;
        return Why::Trap;
      }
    if (each_tick && each_tick()) return Why::Asked;
    if (!should_stop) continue;
    if (const auto now = Wall::now(); now - asked > kStopEvery) {
      asked = now;
      if (should_stop()) return Why::Stopped;
    }
  }
  return run_->team().has_ended() ? Why::Ended : Why::Time;
}

void World::finish(std::vector<std::string>& problems) {
  if (is_finished_ || !run_) return;
  is_finished_ = true;
  run_->team().finish();
  let_go_of_ends();
  if (auto* coverage = run_->coverage()) coverage->finish(problems);
}

/// Files, ports and terminals are free for another world, whoever still looks at this one.
void World::let_go_of_ends() {
  for (int robot = 0; robot < twin().robots(); ++robot) {
    board::Board& board = twin().mind(robot).board();
    if (!twin().bluetooth(robot).name().empty())
      twin().bluetooth(robot).connect_computer(std::make_shared<Nobody>());
    board.uart(2).connect(nullptr);
  }
}

std::int64_t World::traps_seen() const {
  std::int64_t sum = 0;
  for (int robot = 0; robot < twin().robots(); ++robot)
    if (const host::Runner* program = runner(robot))
      for (const auto& trap : program->traps()) sum += trap.count;
  return sum;
}

void World::sample() {
  const sim::Clicks now = simulation().now();
  if (sampled_ < 0 || now - sampled_ >= kLook) {
    sampled_ = now;
    ways_->sample(simulation().scene());
    if (auto* coverage = run_->coverage()) coverage->look();
  }
  for (const auto& record : records_)
    if (now >= record->next) write_row(*record);
}

// --- touching

void World::apply(const inputs::Json& input) {
  run_->inputs().apply(input);
  inputs::Json line = input;
  line["at"] = simulation().now();
  touches_.push_back(std::move(line));
  // whatever changed the place of something breaks its way
  if (input.at("do") == "move" && input.contains("robot"))
    ways_->lift_pen(twin().find(input.at("robot").get<std::string>()));
}

std::string World::save_recording(const std::string& file) const {
  inputs::Opening opening{opening_.file,    opening_.text,        *opening_.seed,
                          opening_.options, opening_.supervisors, {}};
  inputs::Recorder recorder(file, opening, images_, "save_replay");
  for (const inputs::Json& touch : touches_) recorder.note(touch.at("at").get<sim::Clicks>(), touch);
  recorder.end(simulation().now(), simulation().digest());
  return recorder.error();
}

// --- asking

const std::string& World::heard(int robot, int port) {
  mind(robot).board().exchange(mind(robot).now());
  return heard_[static_cast<std::size_t>(robot)][static_cast<std::size_t>(port - 1)];
}

std::optional<chip::ProfileReport> World::profile(int robot) const {
  const auto found = profiles_.find(robot);
  if (found == profiles_.end()) return {};
  return found->second->report();
}

bool World::cost_of(int robot, const std::string& function, chip::CallCost& cost, std::string& error) {
  const debug::Machine* const program = machine(robot);
  const auto profile = profiles_.find(robot);
  error = "no function '" + function + "' in the firmware";
  return program &&
         chip::cost_of_call(program->file(), profile == profiles_.end() ? nullptr : profile->second.get(),
                            function, cost, error);
}

const board::CameraPicture* World::picture(int robot) const {
  const auto found = pictures_.find(robot);
  return found == pictures_.end() || found->second.rows == 0 ? nullptr : &found->second;
}

std::string World::draw(const std::string& file, const std::string& caption, bool rays, int width_px) {
  sim::PictureOptions options;
  options.caption = caption;
  options.sensor_rays = rays;
  options.width_px = width_px;
  options.labels = run_->team().labels();
  ways_->sample(simulation().scene());
  return sim::write_picture(file, simulation().scene(), simulation().minds(), ways_.get(), options);
}

void World::refresh(Arrays& arrays, bool poses, bool proximity, bool others) {
  const sim::Simulation& simulation = run_->simulation();
  const sim::Scene& scene = simulation.scene();
  for (int robot = 0; robot < twin().robots(); ++robot) {
    const auto r = static_cast<std::size_t>(robot);
    if (poses) {
      const sim::Pose2 pose = simulation.pose(robot);
      double* const to = &arrays.poses[3 * r];
      to[0] = pose.x_m, to[1] = pose.y_m, to[2] = pose.heading_rad;
    }
    sim::RobotMind& mind = *simulation.minds()[r];
    if (proximity) {
      const auto& robot_desc = simulation.scene().world().robots[r];
      const std::size_t sensors =
          std::min<std::size_t>(8, scene.world().model_of(robot_desc)->proximity.size());
      for (std::size_t i = 0; i < sensors; ++i)
        arrays.proximity[8 * r + i] = mind.proximity_counts(scene, static_cast<int>(i));
    }
    if (!others) continue;
    const sim::MindReport report = mind.report();
    for (std::size_t i = 0; i < 10; ++i) arrays.leds[10 * r + i] = report.leds >> i & 1;
    arrays.steps[2 * r] = report.left_steps;
    arrays.steps[2 * r + 1] = report.right_steps;
    const auto& firmware = static_cast<const twin::Twin&>(twin()).mind(robot);
    arrays.battery_v[r] = firmware.board().power().battery().voltage(firmware.now());
  }
}

std::shared_ptr<Record> World::record(double every_s) {
  auto record = std::make_shared<Record>();
  record->every_s = every_s;
  records_.push_back(record);
  write_row(*record);
  return record;
}

void World::write_row(Record& record) {
  const sim::Clicks now = simulation().now();
  const sim::Clicks every = std::max<sim::Clicks>(1, sim::from_seconds(record.every_s));
  record.next = (now / every + 1) * every;
  const auto robots = static_cast<std::size_t>(twin().robots());
  Arrays arrays(robots);
  refresh(arrays, true, true, true);
  for (std::size_t r = 0; r < robots; ++r) {
    record.rows.insert(record.rows.end(), {sim::to_seconds(now), static_cast<double>(r)});
    record.rows.insert(record.rows.end(), &arrays.poses[3 * r], &arrays.poses[3 * r] + 3);
    for (std::size_t i = 0; i < 2; ++i) record.rows.push_back(static_cast<double>(arrays.steps[2 * r + i]));
    for (std::size_t i = 0; i < 8; ++i) record.rows.push_back(arrays.proximity[8 * r + i]);
    unsigned leds = 0;
    for (std::size_t i = 0; i < 10; ++i) leds |= unsigned{arrays.leds[10 * r + i]} << i;
    record.rows.insert(record.rows.end(), {static_cast<double>(leds), arrays.battery_v[r]});
  }
}

}  // namespace python
