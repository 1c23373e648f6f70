// SPDX-License-Identifier: MIT
#include "hal_sim/inputs/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "hal_sim/board/bluetooth_module.h"
#include "hal_sim/board/uart_end.h"
#include "hal_sim/host/variables.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/base/hash.h"
#include "sim_core/base/utf8.h"
#include "sim_core/load/world_loader.h"

namespace inputs {

namespace {

[[noreturn]] void refuse_input(const std::string& what) { throw std::runtime_error(what); }

/// A field of an input that must be there.
const Json& field(const Json& input, const char* key, const std::string& expected) {
  if (!input.contains(key)) refuse_input(fmt::format("{}: got none, expected {}", key, expected));
  return input.at(key);
}

/// A field of one type; `is` says whether it is of that.
template <typename T>
T typed(const Json& input, const char* key, bool (Json::*is)() const noexcept, const char* expected) {
  const Json& value = field(input, key, expected);
  if (!(value.*is)()) refuse_input(fmt::format("{}: got {}, expected {}", key, value.dump(), expected));
  return value.get<T>();
}

std::string text(const Json& input, const char* key) {
  return typed<std::string>(input, key, &Json::is_string, "a text");
}

double real(const Json& input, const char* key) {
  return typed<double>(input, key, &Json::is_number, "a number");
}

/// NaN, which is in no range, where it is no number.
double value_of(const Json& value) { return value.is_number() ? value.get<double>() : std::nan(""); }

int whole(const Json& input, const char* key, int least, int most) {
  const std::string range =
      most < least ? fmt::format("none: there is no {}", key) : fmt::format("{} to {}", least, most);
  const Json& given = field(input, key, range);
  const double value = value_of(given);
  if (!(value >= least && value <= most) || value != static_cast<int>(value))
    refuse_input(fmt::format("{}: got {}, expected {}", key, given.dump(), range));
  return static_cast<int>(value);
}

double number(const Json& input, const char* key, double least, double most) {
  const std::string range = fmt::format("{} to {}", least, most);
  const Json& given = field(input, key, range);
  const double value = value_of(given);
  if (!(value >= least && value <= most))
    refuse_input(fmt::format("{}: got {}, expected {}", key, given.dump(), range));
  return value;
}

/// Without what is of the request, or of its place in a recording.
Json bare(Json input) {
  for (const char* other : {"id", "at"}) input.erase(other);
  return input;
}

std::string bytes_of(const std::string& text) {
  const auto bytes = sim::bytes_of_characters(text);
  if (!bytes) refuse_input("bytes: got a character above U+00FF, expected one byte a character");
  return *bytes;
}

}  // namespace

/// The far end of a serial line on which somebody types. What the robot sends is heard elsewhere.
class TypedLine final : public board::UartEnd {
 public:
  void type(const std::string& bytes) {
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    set_idle(waiting_.empty());
  }
  void deliver(const std::uint8_t*, const board::Cycle*, std::size_t) override {}
  std::size_t collect(std::uint8_t* bytes, std::size_t room, board::Cycle) override {
    std::size_t count = 0;
    for (; count < room && !waiting_.empty(); ++count) {
      bytes[count] = static_cast<std::uint8_t>(waiting_.front());
      waiting_.pop_front();
    }
    set_idle(waiting_.empty());
    return count;
  }
  std::string name() const override { return {}; }

 private:
  std::deque<char> waiting_;
};

Inputs::~Inputs() = default;

/// One that is done to the world, or to the program or the board of a robot.
struct Inputs::Kind {
  const char* name;
  void (Inputs::*of_world)(const Json&);
  void (Inputs::*of_robot)(const Json&, int robot);
};

const std::vector<Inputs::Kind>& Inputs::kinds() {
  static const std::vector<Kind> all = {
      {"world", &Inputs::refurnish, nullptr},     {"program", &Inputs::flash, nullptr},
      {"move", &Inputs::move, nullptr},           {"faults", &Inputs::add_faults, nullptr},
      {"end_fault", &Inputs::end_fault, nullptr}, {"lamp", &Inputs::set_lamp, nullptr},
      {"sensor", nullptr, &Inputs::set_sensor},   {"selector", nullptr, &Inputs::turn_selector},
      {"battery", nullptr, &Inputs::set_battery}, {"type", nullptr, &Inputs::type},
      {"key", nullptr, &Inputs::press_key},       {"reset", nullptr, &Inputs::restart},
      {"set", nullptr, &Inputs::set_variable},    {"write", nullptr, &Inputs::write_memory},
  };
  return all;
}

int Inputs::robot_of(const Json& input) const {
  const auto name = text(input, "robot");
  const int robot = twin_.find(name);
  if (robot < 0) refuse_input(fmt::format("robot: got '{}', expected a robot of the world", name));
  return robot;
}

host::Runner& Inputs::program_of(const Json& input, int robot) {
  host::Runner* program = twin_.mind(robot).runner();
  if (!program) refuse_input(fmt::format("robot: got {}, which runs no program", input.at("robot").dump()));
  return *program;
}

/// A line gets its far end when somebody types for the first time: a run with a page is one without.
TypedLine& Inputs::line(int robot, int port) {
  auto& line = lines_[robot * 2 + port - 1];
  if (line) return *line;
  if (twin_.uart_choice(robot, port) != "-" && twin_.uart_choice(robot, port) != "none")
    refuse_input(fmt::format("port: got {}, whose other end is {}", port, twin_.uart_choice(robot, port)));
  line = std::make_shared<TypedLine>();
  if (port == 1)
    twin_.bluetooth(robot).connect_computer(line);
  else
    twin_.mind(robot).board().uart(port).connect(line);
  return *line;
}

void Inputs::refurnish(const Json& input) {
  sim::LoadedWorld loaded = twin::parse_world(text(input, "text"), twin_.world().file);
  if (!loaded.world) refuse_input(loaded.report("world"));
  refurnish(input, std::move(*loaded.world));
}

void Inputs::refurnish(const Json& input, sim::WorldDesc world) {
  sim::Simulation& simulation = twin_.simulation();
  if (world.robots.size() != twin_.world().robots.size() || world.physics_hz != twin_.world().physics_hz)
    refuse_input("text: got other robots or another tick, expected the same");
  std::size_t movable = 0;
  for (const auto& object : world.objects) movable += object.movable;
  const auto before = typed<std::vector<int>>(input, "before", &Json::is_array, "a list");
  if (before.size() != movable) refuse_input("before: expected one number for each movable object");
  for (int body : before)
    if (body >= simulation.scene().bodies() || (body >= 0 && body < twin_.robots()))
      refuse_input(fmt::format("before: got {}, expected a movable object or -1", body));
  world.seed = twin_.world().seed;
  for (std::size_t i = 0; i < twin_.world().robots.size(); ++i)
    world.robots[i].firmware = twin_.world().robots[i].firmware;
  simulation.refurnish(world, before);
}

void Inputs::flash(const Json& input) {
  const std::string wrong =
      twin_.flash(typed<std::vector<int>>(input, "robots", &Json::is_array, "a list"), text(input, "image"));
  if (!wrong.empty()) refuse_input(wrong);
}

void Inputs::move(const Json& input) {
  sim::Simulation& simulation = twin_.simulation();
  const int body =
      input.contains("body") ? whole(input, "body", 0, simulation.scene().bodies() - 1) : robot_of(input);
  simulation.move(
      body,
      {number(input, "x", -1000, 1000), number(input, "y", -1000, 1000), number(input, "heading", -1e6, 1e6)},
      simulation.scene().z_m(body));
}

void Inputs::add_faults(const Json& input) {
  const auto of = input.value("of", std::string("faults"));
  const faults::LoadedFaults loaded = faults::parse_faults(text(input, "text"), of);
  if (!loaded.problems.empty()) refuse_input(loaded.report(of));
  faults_.add(loaded.faults);
  faults_.look();  // what begins now meets what is done behind it at this tick
}

void Inputs::end_fault(const Json& input) {
  faults_.end(whole(input, "fault", 0, static_cast<int>(faults_.statuses().size()) - 1));
}

void Inputs::set_lamp(const Json& input) {
  const auto& lamps = twin_.world().lamps;
  const int lamp = whole(input, "lamp", 0, static_cast<int>(lamps.size()) - 1);
  const auto& desc = lamps[static_cast<std::size_t>(lamp)];
  const double intensity_w_m2 =
      input.contains("intensity") ? number(input, "intensity", 0, 1e4) : desc.intensity_w_m2;
  twin_.simulation().set_lamp(lamp, typed<bool>(input, "on", &Json::is_boolean, "true or false"),
                              intensity_w_m2, desc.position_m);
}

void Inputs::set_variable(const Json& input, int robot) {
  host::ProgramData& data = program_of(input, robot).data();
  std::string error;
  const host::Variable* v = data.find_number(text(input, "variable"), error);
  if (!v) refuse_input(error);
  data.set_number(*v, real(input, "value"));
}

void Inputs::write_memory(const Json& input, int robot) {
  const int bytes = whole(input, "bytes", 1, 8);
  const int address = whole(input, "address", 0, 0xFFFF - bytes + 1);
  const auto value = typed<std::uint64_t>(input, "value", &Json::is_number, "a whole number");
  program_of(input, robot)
      .data()
      .write_memory(static_cast<unsigned>(address), &value, static_cast<std::size_t>(bytes));
}

void Inputs::set_sensor(const Json& input, int robot) {
  twin_.mind(robot).board().virtual_devices().set(text(input, "name"), real(input, "value"));
}

void Inputs::turn_selector(const Json& input, int robot) {
  twin_.mind(robot).board().turn_selector(whole(input, "position", 0, 15));
}

void Inputs::set_battery(const Json& input, int robot) {
  host::FirmwareMind& mind = twin_.mind(robot);
  mind.board().power().set_voltage(number(input, "volts", kLeastBatteryV, kMostBatteryV), mind.now());
}

void Inputs::type(const Json& input, int robot) {
  line(robot, whole(input, "port", 1, 2)).type(bytes_of(text(input, "bytes")));
}

void Inputs::restart(const Json& input, int robot) { program_of(input, robot).restart(); }

void Inputs::press_key(const Json& input, int robot) {
  const double hold_s = input.contains("hold") ? number(input, "hold", 0, 60) : 0.1;
  twin_.mind(robot).press_key({whole(input, "key", 0, 63), sim::to_seconds(twin_.simulation().now()), hold_s,
                               input.contains("address") ? whole(input, "address", 0, 31) : 0});
}

void Inputs::apply(const Json& input) {
  const auto what = text(input, "do");
  const auto& all = kinds();
  const auto kind = std::find_if(all.begin(), all.end(), [&](const Kind& k) { return what == k.name; });
  if (kind == all.end()) refuse_input(fmt::format("do: got '{}', expected an input", what));
  if (kind->of_world) return (this->*kind->of_world)(input);
  const int robot = robot_of(input);
  (this->*kind->of_robot)(input, robot);
  // a program that waits looks again, and the digest sees what was done
  if (host::Runner* program = twin_.mind(robot).runner()) program->wake();
  std::uint64_t hash = sim::mix64(static_cast<std::uint64_t>(robot) + 1);
  for (const char c : bare(input).dump()) hash = sim::mix64(hash ^ static_cast<unsigned char>(c));
  twin_.simulation().note_intervention(hash);
}

void Inputs::step() {
  faults_.look();
  twin_.simulation().step();
  faults_.look();
}

}  // namespace inputs
