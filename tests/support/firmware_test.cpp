// SPDX-License-Identifier: MIT
#include "tests/support/firmware_test.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "hal_sim/board/part.h"
#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/chip/profile.h"
#include "hal_sim/faults/injector.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/base/hash.h"
#include "sim_core/load/world_loader.h"
#include "tests/support/memory_end.h"
#include "twinpuck_paths.h"

namespace firmware_test {

namespace {

std::string all_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& l : lines) text += l + "\n";
  return text;
}

// a controller written in a test gets a folder of its own, named after its content
std::string folder_for(const std::string& source, const std::string& language = "c") {
  std::uint64_t h = source.size() + (language == "c" ? 0 : 1);
  for (unsigned char c : source) h = sim::mix64(h ^ c);
  char name[32];
  std::snprintf(name, sizeof name, "t%016llx", static_cast<unsigned long long>(h));
  const std::filesystem::path folder = std::filesystem::path(TWINPUCK_BUILD_DIR) / "tests" / "inline" / name;
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / ("main." + language);
  if (!std::filesystem::exists(file)) std::ofstream(file) << source;
  return folder.string();
}

}  // namespace

// --- Robot

Robot& Robot::at(double x_m, double y_m, double heading_deg) {
  desc_.pose = {x_m, y_m, sim::radians(heading_deg)};
  return *this;
}
Robot& Robot::selector(int position) {
  desc_.own["selector"] = position;
  return *this;
}
Robot& Robot::battery(double volts) {
  desc_.battery_v = volts;
  return *this;
}

sim::Pose2 Robot::pose() const { return test_->twin().simulation().pose(index_); }
host::FirmwareMind& Robot::mind() const { return test_->twin().mind(index_); }
double Robot::distance_m() const { return test_->twin().simulation().distance_m(index_); }
std::int64_t Robot::left_steps() const { return mind().report().left_steps; }
std::int64_t Robot::right_steps() const { return mind().report().right_steps; }
std::uint32_t Robot::leds() const { return mind().report().leds; }
bool Robot::led(int number) const { return (leds() >> number & 1) != 0; }
bool Robot::pin(char port, int bit) const {
  return (mind().board().pins().read(port, board::Pins::Register::Port, mind().now()) >> bit & 1) != 0;
}
int Robot::proximity(int sensor) const {
  return mind().proximity_counts(test_->twin().simulation().scene(), sensor);
}
int Robot::collisions() const { return test_->twin().simulation().touches(index_).collisions; }
Robot& Robot::bluetooth() {
  keeps_bluetooth_ = true;
  return *this;
}
double Robot::longest_wall_touch_s() const {
  return test_->twin().simulation().touches(index_).longest_wall_touch_s;
}
double Robot::cpu_load() const { return mind().runner()->cpu_load(); }
Robot& Robot::measured() {
  is_measured_ = true;
  return *this;
}
Cost Robot::cost_of(const std::string& function, Caller caller) const {
  const auto* const runner = dynamic_cast<const chip::ChipRunner*>(test_->twin().mind(index_).runner());
  Cost cost;
  std::string error = "no function '" + function + "' in the firmware";
  if (!runner || !chip::cost_of_call(runner->image()->file(), profile_.get(), function, cost, error))
    ADD_FAILURE_AT(caller.file, caller.line) << error;
  return cost;
}
void Robot::copy_variable(const std::string& name, void* to, std::size_t bytes, const Caller& caller) const {
  const auto found = mind().runner()->data().read_variable(name, bytes);
  std::copy_n(found.begin(), std::min(bytes, found.size()), static_cast<char*>(to));
  if (found.size() == bytes) return;
  ADD_FAILURE_AT(caller.file, caller.line)
      << "no variable '" << name << "' of " << bytes << " bytes in the firmware";
}
std::int64_t Robot::cycles() const { return mind().now(); }
void Robot::turn_selector(int position) {
  mind().board().turn_selector(position);
  mind().runner()->wake();
}
void Robot::define_sensor(const std::string& name, double value) {
  test_->twin();
  mind().board().virtual_devices().set(name, value);
}
void Robot::press_key(int key, double hold_s, int address) {
  const double at_s = test_->now_s();
  test_->twin();
  mind().press_key({key, at_s, hold_s, address});
}
double Robot::battery_v() const { return mind().board().power().battery().voltage(mind().now()); }
void Robot::push_to(double x_m, double y_m, double heading_deg) {
  test_->twin().simulation().move(index_, {x_m, y_m, sim::radians(heading_deg)});
}
SerialEnd& Robot::uart(int port) {
  test_->twin();
  return serial_[port - 1];
}

// --- SerialEnd

std::string SerialEnd::text() const {
  host::FirmwareMind& mind = test_->twin().mind(robot_);
  mind.board().exchange(mind.now());
  return end_->text();
}
void SerialEnd::send(const std::string& bytes) {
  host::FirmwareMind& mind = test_->twin().mind(robot_);
  end_->inject(bytes, mind.now());
}

// --- FirmwareTest

FirmwareTest::FirmwareTest() {
  world.models = twin::robot_models();
  world.part_kinds = board::part_kinds();
  world.title = "test";
  world.proximity.noise_scale = 0;
  // the same tests with the other HAL: TWINPUCK_HAL=sim or dspic
  if (const char* hal = std::getenv("TWINPUCK_HAL")) options.hal = hal;
  // counts of all tests that run: TWINPUCK_COVERAGE=c.info
  if (const char* file = std::getenv("TWINPUCK_COVERAGE")) options.coverage = file;
}
FirmwareTest::~FirmwareTest() {
  std::vector<std::string> problems;
  if (run_ && run_->coverage()) run_->coverage()->finish(problems);
  for (const std::string& problem : problems) ADD_FAILURE() << problem;
}

int FirmwareTest::bus_register(int robot, int address, int number) {
  host::FirmwareMind& mind = twin().mind(robot);
  board::I2cDevice& device = *mind.board().i2c().find(address);
  const auto to = static_cast<std::uint8_t>(address);
  device.begin(to, false, mind.now());
  device.write(static_cast<std::uint8_t>(number), mind.now());
  device.begin(to, true, mind.now());
  return device.read(mind.now());
}

void FirmwareTest::arena(double width_m, double depth_m) {
  world.arena = sim::ArenaDesc{};
  world.arena->size_m = {width_m, depth_m};
}

void FirmwareTest::wall(double x0_m, double y0_m, double x1_m, double y1_m, sim::Colour colour) {
  sim::WallDesc w;
  w.points_m = {{x0_m, y0_m}, {x1_m, y1_m}};
  w.material.colour = colour;
  world.walls.push_back(w);
}

void FirmwareTest::box(double x_m, double y_m, double size_m, double heading_deg) {
  sim::ObjectDesc o;
  o.name = "box" + std::to_string(world.objects.size());
  o.size_m = {size_m, size_m, size_m};
  o.pose = {x_m, y_m, sim::radians(heading_deg)};
  world.objects.push_back(o);
}

void FirmwareTest::load_world(const std::string& path, Caller caller) {
  const auto file = std::filesystem::path(TWINPUCK_SOURCE_DIR) / path;
  auto loaded = twin::load_world(file.string());
  if (!loaded.world) {
    ADD_FAILURE_AT(caller.file, caller.line) << loaded.report(path);
    return;
  }
  world = *loaded.world;
  robots_.clear();
  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    robots_.push_back(std::make_unique<Robot>());
    robots_.back()->test_ = this;
    robots_.back()->index_ = static_cast<int>(i);
    robots_.back()->desc_ = world.robots[i];
  }
}

Robot& FirmwareTest::add_robot(const std::string& firmware, const std::string& name) {
  auto r = std::make_unique<Robot>();
  r->test_ = this;
  r->index_ = static_cast<int>(robots_.size());
  r->desc_.firmware = firmware;
  r->desc_.name = name.empty() ? "robot" + std::to_string(robots_.size()) : name;
  robots_.push_back(std::move(r));
  return *robots_.back();
}

Robot& FirmwareTest::add_robot_with_source(const std::string& c_source, const std::string& name) {
  return add_robot(folder_for(c_source), name);
}

void FirmwareTest::add_supervisor(const std::string& program) {
  sim::SupervisorDesc desc;
  desc.program = program;
  desc.name = "supervisor" + std::to_string(world.supervisors.size());
  world.supervisors.push_back(desc);
}

void FirmwareTest::add_supervisor_with_source(const std::string& source, const std::string& language) {
  add_supervisor(folder_for(source, language));
}

void FirmwareTest::start(const Caller& caller) {
  const std::string where = std::string(caller.file) + ":" + std::to_string(caller.line) + ": ";
  world.robots.clear();
  for (const auto& r : robots_) world.robots.push_back(r->desc_);
  std::vector<std::string> problems;
  run_ = runs::Run::open(world, options, {}, problems);
  if (!run_) throw std::runtime_error(where + "the test's world cannot start:\n" + all_lines(problems));
  twin_ = &run_->twin();
  for (auto& r : robots_) {
    auto* const runner = r->is_measured_ ? dynamic_cast<chip::ChipRunner*>(r->mind().runner()) : nullptr;
    if (!runner) continue;
    r->profile_ = std::make_shared<chip::Profile>(runner->image()->file(), runner->processor(),
                                                  runner->device(), runner->host());
    runner->watch_steps(r->profile_.get(), true);
  }
  for (auto& r : robots_) {
    Robot* robot = r.get();
    robot->mind().board().virtual_devices().on_console = [robot](const std::string& line) {
      robot->console_.push_back(line);
    };
  }
  for (auto& r : robots_)
    for (int port = r->keeps_bluetooth_ ? 2 : 1; port <= 2; ++port) {
      auto end = std::make_unique<MemoryEnd>();
      SerialEnd& line = r->serial_[port - 1];
      line.test_ = this;
      line.robot_ = r->index_;
      line.end_ = end.get();
      end->wake = [mind = &r->mind()] { mind->wake(); };
      r->mind().board().uart(port).connect(std::move(end));
    }
}

twin::Twin& FirmwareTest::twin(Caller caller) {
  if (!twin_) start(caller);
  return *twin_;
}

void FirmwareTest::run_for(double seconds, Caller caller) {
  auto& s = twin(caller).simulation();
  const sim::Clicks end = s.now() + sim::from_seconds(seconds);
  while (s.now() < end && !run_->team().has_ended()) step();
  run_->inputs().faults().look();
}

bool FirmwareTest::run_until(const std::function<bool()>& done, double at_most_s, Caller caller) {
  auto& s = twin(caller).simulation();
  const sim::Clicks end = s.now() + sim::from_seconds(at_most_s);
  while (!done()) {
    if (s.now() >= end || run_->team().has_ended()) return false;
    step();
  }
  return true;
}

void FirmwareTest::step() { run_->inputs().step(); }

faults::Injector& FirmwareTest::faults(Caller caller) {
  twin(caller);
  return run_->inputs().faults();
}

programs::Team& FirmwareTest::team() {
  twin();
  return run_->team();
}

const programs::Outcome& FirmwareTest::finish() {
  team().finish();
  return team().outcome();
}

double FirmwareTest::now_s() const { return twin_ ? sim::to_seconds(twin_->simulation().now()) : 0; }
std::uint64_t FirmwareTest::digest() const { return twin_ ? twin_->simulation().digest() : 0; }

std::string Robot::diagnoses_text() const {
  std::string text;
  for (const auto& d : diagnoses())
    text += d.place + ": " + d.cause + ": " + d.message + "; " + d.hint + "\n";
  return text;
}

void FirmwareTest::expect_no_diagnoses(Caller caller) const {
  if (!twin_) return;
  for (const auto& robot : robots_)
    if (const std::string said = robot->diagnoses_text(); !said.empty())
      ADD_FAILURE_AT(caller.file, caller.line) << robot->desc_.name << ": " << said;
}

void FirmwareTest::expect_no_traps(Caller caller) const {
  if (!twin_) return;
  for (const auto& t : twin_->traps())
    ADD_FAILURE_AT(caller.file, caller.line)
        << t.robot << ": " << host::trap_name(t.kind) << ": " << t.message << " at " << to_string(t.place);
}

}  // namespace firmware_test
