// SPDX-License-Identifier: MIT
// libtwinpuck.so: a twin behind three headers that name no class of ours. In: calls of somebody's program.
// Out: plain numbers and texts; problems become twinpuck::Error.
#include <algorithm>
#include <array>

#include "embed/twinpuck/twinpuck.h"
#include "hal_sim/board/memory_end.h"
#include "hal_sim/runs/run.h"
#include "hal_sim/twin/world_file.h"

namespace twinpuck {

namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

[[noreturn]] void refuse(const std::string& what) { throw Error({what}); }

std::string world_file(const std::string& name) {
  std::vector<std::string> problems;
  const twin::FoundWorld found = twin::find_world(name, problems);
  if (!problems.empty()) throw Error(problems);
  return found.file;
}

sim::WorldDesc checked(sim::LoadedWorld loaded, const std::string& name, const Settings& settings) {
  if (!loaded.world) refuse(loaded.report(name));
  if (settings.seed >= 0) loaded.world->seed = static_cast<std::uint64_t>(settings.seed);
  return std::move(*loaded.world);
}

}  // namespace

struct Opened {
  sim::WorldDesc world;  // as it begins
  twin::Options options;
  std::function<void(const std::string&)> tell;
  std::unique_ptr<runs::Run> run;
  twin::Twin* twin = nullptr;  // the run's
  programs::Team* team = nullptr;
  std::vector<std::array<board::MemoryEnd*, 2>> lines;  // the boards own them

  Opened(sim::WorldDesc desc, const Settings& settings) : world(std::move(desc)), tell(settings.tell) {
    // of two that mean a robot the later one counts, so "*" comes first
    if (const auto all = settings.firmware.find("*"); all != settings.firmware.end())
      options.firmware.push_back({"*", all->second});
    for (const auto& [robot, program] : settings.firmware)
      if (robot != "*") options.firmware.push_back({robot, program});
    if (!settings.hal.empty() && settings.hal != "sim" && settings.hal != "dspic")
      refuse("settings: hal: got '" + settings.hal + "', expected sim or dspic");
    if (settings.threads < 1)
      refuse("settings: threads: got " + std::to_string(settings.threads) + ", expected 1 or more");
    options.hal = settings.hal;
    options.optimisation = settings.optimisation;
    options.sanitize = settings.sanitize;
    options.threads = settings.threads;
    options.tell = tell;
    begin();
  }

  void begin() {
    run.reset();
    lines.clear();
    std::vector<std::string> problems;
    run = runs::Run::open(world, options, {}, problems);
    if (!run) throw Error(problems);
    twin = &run->twin();
    team = &run->team();
    team->say = [this](const std::string& line) {
      if (tell) tell(line);
    };
    for (int robot = 0; robot < twin->robots(); ++robot) {
      host::FirmwareMind& mind = twin->mind(robot);
      auto& both = lines.emplace_back();
      for (int port = 1; port <= 2; ++port) {
        auto end = std::make_unique<board::MemoryEnd>();
        both[static_cast<std::size_t>(port - 1)] = end.get();
        end->wake = [&mind] { mind.wake(); };
        mind.board().uart(port).connect(std::move(end));
      }
    }
  }

  board::MemoryEnd& line(int robot, int port) {
    if (port != 1 && port != 2)
      refuse("robot '" + name(robot) + "': port: got " + std::to_string(port) + ", expected 1 or 2");
    return *lines[static_cast<std::size_t>(robot)][static_cast<std::size_t>(port - 1)];
  }
  std::string name(int robot) const { return twin->world().robots[static_cast<std::size_t>(robot)].name; }
  /// What executes its program.
  host::Runner& runner(int robot) {
    host::Runner* const runner = twin->mind(robot).runner();
    if (!runner) refuse("robot '" + name(robot) + "': program: got none, expected one");
    return *runner;
  }
  const host::Variable& variable(int robot, const std::string& expression) {
    std::string error;
    const host::Variable* const found = runner(robot).data().find_number(expression, error);
    if (!found) refuse("robot '" + name(robot) + "': " + expression + ": " + error);
    return *found;
  }
};

Error::Error(std::vector<std::string> lines) : std::runtime_error(joined(lines)), lines_(std::move(lines)) {}
Error::~Error() = default;

std::string version() { return TWINPUCK_VERSION; }

// --- World

World::World(const std::string& file, const Settings& settings) {
  const std::string found = world_file(file);
  opened_ = std::make_unique<Opened>(checked(twin::load_world(found), found, settings), settings);
}
World World::of_text(const std::string& text, const Settings& settings) {
  return World(
      std::make_unique<Opened>(checked(twin::parse_world(text, "text"), "text", settings), settings));
}
World::World(std::unique_ptr<Opened> opened) : opened_(std::move(opened)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

void World::reset() { opened_->begin(); }

void World::step() {
  if (!opened_->team->has_ended()) opened_->twin->simulation().step();
}

void World::run(double seconds) {
  if (!(seconds >= 0 && seconds <= 1e7))
    refuse("run: seconds: got " + std::to_string(seconds) + ", expected 0 to 1e7");
  auto& simulation = opened_->twin->simulation();
  const sim::Clicks end = simulation.now() + sim::from_seconds(seconds);
  while (simulation.now() < end && !opened_->team->has_ended()) simulation.step();
}

bool World::run_until(const std::function<bool()>& is_done, double at_most_s) {
  if (!(at_most_s >= 0 && at_most_s <= 1e7))
    refuse("run_until: seconds: got " + std::to_string(at_most_s) + ", expected 0 to 1e7");
  auto& simulation = opened_->twin->simulation();
  const sim::Clicks end = simulation.now() + sim::from_seconds(at_most_s);
  while (!is_done()) {
    if (simulation.now() >= end || opened_->team->has_ended()) return false;
    simulation.step();
  }
  return true;
}

double World::time_s() const { return sim::to_seconds(opened_->twin->simulation().now()); }
std::uint64_t World::digest() const { return opened_->twin->simulation().digest(); }

std::vector<std::string> World::robots() const {
  std::vector<std::string> names;
  for (const auto& robot : opened_->twin->world().robots) names.push_back(robot.name);
  return names;
}

Robot World::robot(const std::string& name) {
  const int index = opened_->twin->find(name);
  if (index < 0) {
    std::string known;
    for (const std::string& other : robots()) known += (known.empty() ? "" : ", ") + other;
    refuse("robot: got '" + name +
           "', expected one of this world: " + (known.empty() ? "it has none" : known));
  }
  return Robot(opened_.get(), index);
}

// --- Robot

std::string Robot::name() const { return opened_->name(index_); }

Pose Robot::pose() const {
  const sim::Pose2 pose = opened_->twin->simulation().pose(index_);
  return {pose.x_m, pose.y_m, pose.heading_rad};
}

void Robot::place(const Pose& pose) {
  constexpr double kFarthest = 1000;  // m, as inputs have it
  for (const double number : {pose.x_m, pose.y_m, pose.heading_rad})
    if (!(std::abs(number) <= kFarthest))
      refuse("robot '" + name() + "': place: got " + std::to_string(number) + ", expected -1000 to 1000");
  opened_->twin->simulation().move(index_, {pose.x_m, pose.y_m, pose.heading_rad});
}

bool Robot::led(int number) const {
  constexpr int kFront = 9;
  if (number < 0 || number > kFront)
    refuse("robot '" + name() + "': LED: got " + std::to_string(number) + ", expected 0 to 9");
  return (opened_->twin->mind(index_).report().leds >> number & 1) != 0;
}

int Robot::proximity(int sensor) const {
  constexpr int kSensors = 8;
  if (sensor < 0 || sensor >= kSensors)
    refuse("robot '" + name() + "': proximity sensor: got " + std::to_string(sensor) + ", expected 0 to 7");
  return opened_->twin->mind(index_).proximity_counts(opened_->twin->simulation().scene(), sensor);
}

long long Robot::left_steps() const { return opened_->twin->mind(index_).report().left_steps; }
long long Robot::right_steps() const { return opened_->twin->mind(index_).report().right_steps; }
double Robot::distance_m() const { return opened_->twin->simulation().distance_m(index_); }
int Robot::collisions() const { return opened_->twin->simulation().touches(index_).collisions; }

void Robot::turn_selector(int position) {
  constexpr int kPositions = 16;
  if (position < 0 || position >= kPositions)
    refuse("robot '" + name() + "': selector: got " + std::to_string(position) + ", expected 0 to 15");
  host::FirmwareMind& mind = opened_->twin->mind(index_);
  mind.board().turn_selector(position);
  if (mind.runner()) mind.runner()->wake();
}

std::string Robot::serial(int port) const {
  board::MemoryEnd& line = opened_->line(index_, port);
  host::FirmwareMind& mind = opened_->twin->mind(index_);
  mind.board().exchange(mind.now());
  return line.text();
}

void Robot::send(const std::string& bytes, int port) {
  opened_->line(index_, port).inject(bytes, opened_->twin->mind(index_).now());
}

double Robot::variable(const std::string& expression) const {
  return opened_->runner(index_).data().number(opened_->variable(index_, expression));
}

void Robot::set_variable(const std::string& expression, double value) {
  opened_->runner(index_).data().set_number(opened_->variable(index_, expression), value);
}

std::vector<std::string> Robot::traps() const {
  std::vector<std::string> lines;
  for (const host::TrapReport& trap : opened_->twin->traps())
    if (trap.robot == name())
      lines.push_back((trap.vector.empty() ? host::trap_name(trap.kind) : trap.vector.c_str()) +
                      std::string(": ") + trap.message + " at " + host::to_string(trap.place));
  return lines;
}

}  // namespace twinpuck
