// SPDX-License-Identifier: MIT
#include "hal_sim/twin/twin.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <utility>

#include "hal_sim/api/host_table.h"
#include "hal_sim/board/bluetooth_module.h"
#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/board/uart_end.h"
#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/chip/library_sources.h"
#include "hal_sim/chip/oscillator.h"
#include "hal_sim/twin/large_pages.h"
#include "hal_sim/twin/robot_check.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/base/input_file.h"
#include "sim_core/radio/link_medium.h"
#include "sim_core/world/variation.h"

namespace twin {

/// What a robot runs, loaded once for all that run it.
struct Firmware {
  std::shared_ptr<const chip::ChipImage> image;
  std::shared_ptr<const programs::Launch> program;  // or a program of the PC
  std::string hal = "";                             // of the image: sim, dspic or own
  std::string path = "";
  Program made_of = {};

  bool is_open() const { return image || program; }
};

namespace {

// what the command line says about a robot, or what the world file says
std::string chosen(const std::vector<Choice>& choices, const std::string& robot,
                   const std::string& from_world) {
  std::string value = from_world;
  for (const auto& c : choices)
    if (c.robot == robot || c.robot == "*") value = c.value;
  return value;
}

void check_names(const sim::WorldDesc& world, const std::vector<Choice>& choices, const char* option,
                 std::vector<std::string>& problems) {
  std::vector<std::string> names;
  for (const auto& r : world.robots) names.push_back(r.name);
  for (const auto& c : choices) {
    if (c.robot == "*" || std::find(names.begin(), names.end(), c.robot) != names.end()) continue;
    problems.push_back("command line: " + std::string(option) + ": got robot '" + c.robot +
                       "', expected a robot of the world" + sim::did_you_mean_tail(c.robot, names));
  }
}

// where a robot's pseudo-terminal is found: a stable name in the run's folder
std::string pty_link(const std::string& robot, int port) {
  return "twinpuck-" + robot + "-uart" + std::to_string(port);
}

// noise settings stay with the world's optics; the board gets what is this robot's own
board::Setup setup_of(const sim::WorldDesc& world, int index) {
  const sim::RobotDesc& robot = world.robots[static_cast<std::size_t>(index)];
  const sim::ResolvedVariation variation = sim::resolve_variation(world, index);
  board::Setup setup;
  setup.robot = index;
  setup.seed = variation.seed;
  setup.battery_v = robot.battery_v >= 0 ? robot.battery_v : world.model_of(robot)->battery_v;
  setup.battery_wh = robot.battery_wh >= 0 ? robot.battery_wh : world.model_of(robot)->battery_wh;
  setup.wheel_ratio = {variation.left_wheel_ratio, variation.right_wheel_ratio};
  for (std::size_t i = 0; i < setup.ir_gain.size(); ++i) {
    if (i < variation.sensor_gain.size()) setup.ir_gain[i] = variation.sensor_gain[i];
    if (i < variation.sensor_offset_counts.size())
      setup.ir_offset_counts[i] = variation.sensor_offset_counts[i];
  }
  setup.acc_offset_m_s2 = variation.acc_offset_m_s2;
  setup.gyro_offset_rad_s = variation.gyro_offset_rad_s;
  setup.motion_noise_scale = robot.variation.motion_noise_scale;
  setup.name = robot.name;
  setup.webots = world.webots;
  setup.devices = robot.devices;
  setup.clock_ppm = variation.clock_ppm;
  setup.boot_delay_s = variation.boot_delay_s;
  board::set_up(setup, own_settings(world, robot));
  return setup;
}

board::BluetoothSetup bluetooth_of(const sim::WorldDesc& world, int index) {
  const sim::LinkEndDesc& link = world.robots[static_cast<std::size_t>(index)].link;
  board::BluetoothSetup setup;
  setup.number = link.number >= 0 ? link.number : index + 1;
  setup.name = link.name.value_or("");
  setup.pin = link.pin.value_or("");
  setup.seed = world.seed;
  setup.timeout_s = world.link.timeout_s;
  return setup;
}

/// An image with its debug information takes some hundred KB.
constexpr std::size_t kLongestImage = 256 << 20;  // bytes

Firmware open_firmware(const std::string& path, const Options& options, std::string& error) {
  if (programs::is_pc_program(path)) {
    auto launch = std::make_shared<programs::Launch>();
    std::vector<std::string> problems;
    if (provide_launch(path, "", options, problems, *launch)) return {nullptr, launch, ""};
    for (const std::string& problem : problems) error += (error.empty() ? "" : "\n") + problem;
    return {};
  }
  std::string bytes;
  const std::string wrong = sim::read_input_file(path, kLongestImage, bytes);
  if (!wrong.empty()) {
    error = path + ": firmware image: " + wrong + "; build it, or name the program's folder";
    return {};
  }
  dspic::FirmwareFile file = chip::firmware_file();
  if (!dspic::load_firmware(bytes, path, file, error)) return {};
  const std::string hal = dspic::hal_of(file);
  if (hal == "sim" && dspic::host_table_of(file) != api::host_table_sum()) {
    error =
        path + ": image: got one linked with another hal_sim, expected one of this twinpuck; build it again";
    return {};
  }
  return {std::make_shared<chip::ChipImage>(std::move(file)), nullptr, hal};
}

std::uint16_t fosc_of(const dspic::FirmwareFile& file) {
  const auto word = file.words.find(dspic::kConfigurationStart);
  return word == file.words.end() ? dspic::Configuration{}.fosc : static_cast<std::uint16_t>(word->second);
}

/// What executes a program on a board, powered up at `start`. The program's configuration words make the
/// clock of the robot that is set up.
host::RunnerFactory runner_for(const Firmware& program, board::Setup& setup, host::Cycle start,
                               const std::shared_ptr<programs::Seat>& seat) {
  if (program.program)
    return [=, name = setup.name](board::Board& board) {
      return std::make_unique<programs::ProgramRunner>(name, seat, board, start);
    };
  const std::uint16_t fosc = fosc_of(program.image->file());
  setup.clock_ppm = chip::clock_ppm(setup.clock_ppm, fosc);
  return [=, name = setup.name, seed = setup.seed, image = program.image](board::Board& board) {
    return std::make_unique<chip::ChipRunner>(name, image, chip::clock_factor(fosc), board, start, seed);
  };
}

/// Text of firmware goes to whoever listens between ticks, robot by robot.
class ConsoleMedium final : public sim::Medium {
 public:
  explicit ConsoleMedium(std::vector<board::VirtualDevices*> robots) : robots_(std::move(robots)) {
    for (board::VirtualDevices* robot : robots_) robot->tell(&somebody_writes_);
  }
  void exchange(const sim::Scene&, sim::Clicks) override {
    if (!somebody_writes_.exchange(false, std::memory_order_relaxed)) return;
    for (board::VirtualDevices* robot : robots_) robot->deliver();
  }
  bool is_busy() const override { return false; }

 private:
  std::vector<board::VirtualDevices*> robots_;
  std::atomic<bool> somebody_writes_{false};
};

// in the order of time: the toggle bit changes from press to press; `from_s`: when the robot began
void press_keys(host::FirmwareMind& mind, std::vector<sim::KeyDesc> keys, double from_s = 0) {
  std::stable_sort(keys.begin(), keys.end(),
                   [](const sim::KeyDesc& a, const sim::KeyDesc& b) { return a.at_s < b.at_s; });
  for (const sim::KeyDesc& key : keys) {
    const double at_s = from_s + key.at_s;
    if (key.typed)
      mind.board().virtual_devices().typed.push_back({key.typed, at_s, at_s + key.hold_s});
    else
      mind.press_key({key.code, at_s, key.hold_s, key.address});
  }
}

void check_choices(const sim::WorldDesc& world, const Options& options, std::vector<std::string>& problems) {
  std::vector<Choice> externs;
  for (const std::string& name : options.externs) externs.push_back({name, ""});
  check_names(world, options.firmware, "--fw", problems);
  check_names(world, options.uart1, "--uart", problems);
  check_names(world, externs, "--extern", problems);
  check_names(world, options.uart2, "--uart2", problems);
}

/// Keys of a robot that only a program of the PC heeds.
void check_program_keys(const sim::RobotDesc& robot, const Firmware* firmware,
                        std::vector<std::string>& problems) {
  if (!firmware || firmware->program) return;
  const auto wrong = [&](const char* key, const std::string& got) {
    problems.push_back("robot '" + robot.name + "': " + key + ": got " + got +
                       " and firmware, expected a program of the PC with it");
  };
  if (!robot.args.empty()) wrong("args", "'" + robot.args + "'");
  if (robot.supervisor) wrong("supervisor", "true");
}

std::string chosen_firmware(const Options& options, const sim::RobotDesc& robot) {
  for (const std::string& outside : options.externs)
    if (outside == robot.name || outside == "*") return kExtern;
  return chosen(options.firmware, robot.name, robot.firmware);
}

/// Every distinct firmware is found, built and loaded once.
class FirmwareShelf {
 public:
  FirmwareShelf(const Options& options, std::vector<std::string>& problems)
      : options_(options), problems_(problems) {}

  /// What a robot runs; null for nothing, and with a line in the problems where it cannot be had.
  const Firmware* find(const sim::WorldDesc& world, const sim::RobotDesc& robot) {
    if (robot.firmware.empty()) return nullptr;
    Options of_robot = options_;
    of_robot.webots_settings = webots_settings_of(world);
    if (of_robot.hal.empty() && robot.own.count("hal")) of_robot.hal = own_settings(world, robot).text("hal");
    const auto [at, is_new] = known_.try_emplace({of_robot.hal, robot.firmware});
    if (is_new) load(robot, of_robot, at->second);
    return &at->second;
  }

 private:
  void load(const sim::RobotDesc& robot, const Options& options, Firmware& firmware) {
    Program made_of;
    const std::string path =
        provide_image(robot.firmware, options.world_folder, options, problems_, &made_of);
    if (path.empty()) return;
    std::string error;
    firmware = open_firmware(path, options_, error);
    firmware.path = path;
    if (!firmware.is_open())
      problems_.push_back(error);
    else if (firmware.hal == "sim" && hal_of(options, path) == "dspic")
      problems_.push_back("robot '" + robot.name + "': hal: got dspic, but " + path +
                          " was linked with hal_sim, expected an image of `twinpuck build DIR --hal dspic`");
    else if (firmware.program)
      made_of.files = firmware.program->files;
    firmware.made_of = made_of;
  }

  const Options& options_;
  std::vector<std::string>& problems_;
  std::map<std::pair<std::string, std::string>, Firmware> known_;  // by HAL and name
};

}  // namespace

std::string wrong_image(const std::string& path) {
  std::string error;
  open_firmware(path, {}, error);
  return error;
}

void note_uart_files(const sim::WorldDesc& world, const Options& options, sim::FileUses& files) {
  for (const sim::RobotDesc& robot : world.robots)
    for (int port = 1; port <= 2; ++port) {
      const std::string choice = port == 1 ? chosen(options.uart1, robot.name, robot.uart1)
                                           : chosen(options.uart2, robot.name, robot.uart2);
      std::string out, in;
      if (!board::is_file_end(choice, out, in)) continue;
      const std::string what = "robot '" + robot.name + "' uart" + std::to_string(port);
      files.reads(in, what);
      files.writes(out, what);
    }
}

void note_programs(const sim::WorldDesc& world, const Options& options, sim::FileUses& files) {
  std::vector<std::string> missing;  // told when it is to run
  std::set<std::string> known;
  for (const sim::RobotDesc& robot : world.robots)
    if (const std::string name = chosen_firmware(options, robot);
        !name.empty() && name != kExtern && known.insert(name).second)
      files.reads_program(find_firmware(name, options.world_folder, missing));
}

std::unique_ptr<Twin> Twin::open(sim::WorldDesc world, const Options& options,
                                 std::vector<std::string>& problems) {
  const std::size_t problems_before = problems.size();
  check_choices(world, options, problems);
  sim::FileUses files;
  note_uart_files(world, options, files);
  files.check(problems);
  if (problems.size() != problems_before) return nullptr;
  FirmwareShelf shelf(options, problems);
  std::vector<const Firmware*> firmware;
  for (auto& robot : world.robots) {
    const std::string of_world = std::exchange(robot.firmware, chosen_firmware(options, robot));
    firmware.push_back(shelf.find(world, robot));  // what it runs, for pictures and supervisors, too
    if (robot.firmware == of_world && options.hal.empty())
      check_program_keys(robot, firmware.back(), problems);
  }
  if (problems.size() != problems_before) return nullptr;

  const LargePages large_pages;
  std::unique_ptr<Twin> twin(new Twin(options));
  std::vector<std::unique_ptr<sim::RobotMind>> minds;
  for (std::size_t i = 0; i < world.robots.size(); ++i)
    minds.push_back(twin->add_robot(world, static_cast<int>(i), firmware[i], problems));
  if (problems.size() != problems_before) return nullptr;
  twin->simulation_ = std::make_unique<sim::Simulation>(std::move(world), std::move(minds), options.threads);
  twin->add_media();
  return twin;
}

/// A robot as it is switched on: its board with parts, lines and program. `firmware`: null for none.
std::unique_ptr<host::FirmwareMind> Twin::add_robot(const sim::WorldDesc& world, int index,
                                                    const Firmware* firmware,
                                                    std::vector<std::string>& problems) {
  const sim::RobotDesc& robot = world.robots[static_cast<std::size_t>(index)];
  Place& place = places_.emplace_back();
  place.uart_choices = {chosen(options_.uart1, robot.name, robot.uart1),
                        chosen(options_.uart2, robot.name, robot.uart2)};
  board::Setup setup = setup_of(world, index);
  host::RunnerFactory make_runner;
  if (firmware) {
    make_runner = runner_for(*firmware, setup, 0, place.seat);
    place.program = firmware->made_of;
    place.image_path = firmware->path;
    place.hal = firmware->hal;
    place.launch = firmware->program;
  }
  auto mind = std::make_unique<host::FirmwareMind>(setup, make_runner);
  place.mind = mind.get();
  for (const sim::WorldProblem& wrong : plug_in_parts(robot, mind->board())) problems.push_back(wrong.text);

  // UART 1 goes through the Bluetooth module to its other end, UART 2 there at once
  const auto other_end = [&](int port) {
    std::string error;
    auto end = board::open_uart_end(uart_choice(index, port), pty_link(robot.name, port), error);
    if (!error.empty())
      problems.push_back("robot '" + robot.name + "': uart" + std::to_string(port) + ": " + error);
    return end;
  };
  place.bluetooth = std::make_shared<board::BluetoothModule>(bluetooth_of(world, index),
                                                             mind->board().clock(), index, other_end(1));
  place.bluetooth->wake = [awake = mind.get()] { awake->wake(); };
  mind->board().uart(1).connect(place.bluetooth);
  if (auto end = other_end(2)) mind->board().uart(2).connect(std::move(end));
  press_keys(*mind, robot.keys);
  return mind;
}

std::string Twin::flash(const std::vector<int>& robots, const std::string& path) {
  std::string error;
  const Firmware program = open_firmware(path, options_, error);
  if (!error.empty()) return error;
  for (int robot : robots) {
    Place& place = at(robot);
    const std::string where = "robot '" + world().robots[static_cast<std::size_t>(robot)].name + "': ";
    if (!place.mind->runner()) return where + "got one that is switched off";
    // whoever gives programs of the PC their turns knows them from the beginning
    if ((program.program != nullptr) != (place.launch != nullptr))
      return where + (program.program ? "got a program of the PC in firmware's place; restart the run"
                                      : "got firmware in the place of a program of the PC; restart the run");
    board::Setup setup = setup_of(world(), robot);
    const auto make_runner = runner_for(program, setup, place.mind->now(), place.seat);
    if (setup.clock_ppm != place.mind->board().setup().clock_ppm)
      return where + "got a program with another clock in its configuration words; restart the run";
    place.mind->flash(make_runner);
    place.image_path = path;
    place.hal = program.hal;
    place.launch = program.program;
    place.program = {path, "", 0};
    simulation_->note_intervention(static_cast<std::size_t>(robot));
    if (flashed_) flashed_(robot);
  }
  return "";
}

void Twin::begin_again(int robot) {
  host::FirmwareMind& mind = *at(robot).mind;
  const sim::Clicks now = simulation_->now();
  mind.begin_again(now);
  mind.board().remote().forget();
  mind.board().virtual_devices().typed.clear();
  press_keys(mind, world().robots[static_cast<std::size_t>(robot)].keys, sim::to_seconds(now));
  simulation_->begin_again(robot);
}

// what passes between robots; a world whose robots have nothing of the kind gets nothing
void Twin::add_media() {
  std::vector<sim::RadioPort*> radios;
  for (const Place& place : places_)
    for (board::I2cDevice* device : place.mind->board().i2c().devices())
      if (auto* port = dynamic_cast<sim::RadioPort*>(device)) radios.push_back(port);
  if (!radios.empty()) {
    auto radio = std::make_unique<sim::RadioMedium>(world().radio, world().seed, std::move(radios));
    radio_ = radio.get();
    simulation_->add(std::move(radio));
  }
  std::vector<sim::LinkPort*> ends;
  std::vector<std::vector<sim::Dropout>> dropouts;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    ends.push_back(places_[i].bluetooth.get());
    dropouts.push_back(world().robots[i].link.dropouts);
  }
  if (!ends.empty())
    simulation_->add(
        std::make_unique<sim::LinkMedium>(world().link, world().seed, std::move(ends), std::move(dropouts)));
  auto packets = std::make_unique<sim::PacketMedium>();
  std::vector<board::VirtualDevices*> consoles;
  for (const Place& place : places_) {
    packets->add(place.mind->board().packets());
    consoles.push_back(&place.mind->board().virtual_devices());
  }
  packets_ = packets.get();
  simulation_->add(std::move(packets));
  simulation_->add(std::make_unique<ConsoleMedium>(std::move(consoles)));
}

void Twin::flush_console() {
  for (const Place& place : places_) place.mind->board().virtual_devices().deliver_rest();
}

int Twin::find(const std::string& name) const {
  const auto& robots = world().robots;
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (robots[i].name == name) return static_cast<int>(i);
  return -1;
}

std::vector<host::TrapReport> Twin::traps() const {
  std::vector<host::TrapReport> all;
  for (const Place& place : places_)
    if (const auto* runner = place.mind->runner())
      all.insert(all.end(), runner->traps().begin(), runner->traps().end());
  return all;
}

}  // namespace twin
