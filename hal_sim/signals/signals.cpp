// SPDX-License-Identifier: MIT
#include "hal_sim/signals/signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/debug/machine.h"
#include "hal_sim/debug/values.h"
#include "hal_sim/host/variables.h"
#include "hal_sim/signals/sound_signals.h"
#include "hal_sim/trace/signals.h"
#include "sim_core/base/did_you_mean.h"
#include "sim_core/light/proximity.h"
#include "sim_core/load/schema.h"
#include "sim_core/sound/sound_field.h"

namespace signals {

namespace {

constexpr double kMost = 1e15;  // no bound
constexpr double kFar = kNothingNearM;
constexpr int kMostRobots = sim::kMostRobots;

const host::FirmwareMind& mind(const twin::Twin& twin, int robot) { return twin.mind(robot); }
const host::Runner* program(const twin::Twin& twin, int robot) { return mind(twin, robot).runner(); }

double converted(const twin::Twin& twin, int robot, int channel) {
  const auto& m = mind(twin, robot);
  return m.board().scene() ? double(m.board().convert(channel, m.now())) : 0.0;
}

double step_rate(const twin::Twin& twin, int robot, board::Wheel wheel) {
  const auto& m = mind(twin, robot);
  const board::WheelTurn turn = m.board().motors().turn(wheel, m.now());
  const double ratio = m.board().setup().wheel_ratio[static_cast<std::size_t>(wheel)];
  return turn.rate_rad / (sim::kTwoPi / board::kStepsPerTurn * ratio) * double(board::kFcyHz);
}

double radius_m(const twin::Twin& twin, int robot) {
  return twin.world().model_of(twin.world().robots[static_cast<std::size_t>(robot)])->body_radius_m;
}

double nearest_wall_m(const twin::Twin& twin, int robot) {
  const sim::Scene& scene = twin.simulation().scene();
  const sim::Pose2 pose = scene.pose(robot, scene.now());
  double least = kNothingNearM;
  for (const sim::Placed& fixed : scene.layout().fixed)
    least = std::min(least, sim::plan_distance_m({pose.x_m, pose.y_m}, fixed) - radius_m(twin, robot));
  return least;
}

double nearest_robot_m(const twin::Twin& twin, int robot) {
  const sim::Scene& scene = twin.simulation().scene();
  const sim::Pose2 pose = scene.pose(robot, scene.now());
  double least = kNothingNearM;
  for (int other = 0; other < twin.robots(); ++other) {
    if (other == robot) continue;
    const sim::Pose2 there = scene.pose(other, scene.now());
    const double middles_m = sim::length(sim::Vec2{there.x_m - pose.x_m, there.y_m - pose.y_m});
    least = std::min(least, middles_m - radius_m(twin, robot) - radius_m(twin, other));
  }
  return least;
}

double traps_of(const twin::Twin& twin, int robot, bool resets) {
  double count = 0;
  if (const auto* runner = program(twin, robot))
    for (const auto& trap : runner->traps())
      if ((trap.kind == host::kUnexpectedReset) == resets) count += trap.count;
  return count;
}

std::string range_text(const Signal& s) {
  if (s.most < kMost) return fmt::format("{} to {}", s.least, s.most);
  return s.least > -kMost ? fmt::format("{} or more", s.least) : "any";
}

std::string name_text(const Signal& s) {
  return s.count > 0 ? fmt::format("{0}0 to {0}{1}", s.name, s.count - 1) : s.name;
}

using T = const twin::Twin&;
constexpr int kRing = board::kRingSensors;

// --- the table, a subject each

std::vector<Signal> of_world() {
  return {
      {"time_s", 0, "s", 0, kMost, "simulated time since the world began", true,
       [](T t, int, int) { return sim::to_seconds(t.simulation().now()); }},
      {"robots", 0, "", 0, kMostRobots, "robots of the world", true,
       [](T t, int, int) { return double(t.robots()); }},
  };
}

std::vector<Signal> of_way() {
  return {
      {"x_m", 0, "m", -kFar, kFar, "place of the robot's middle", false,
       [](T t, int r, int) { return t.simulation().pose(r).x_m; }, "x", "m", 1},
      {"y_m", 0, "m", -kFar, kFar, "the same, to the north", false,
       [](T t, int r, int) { return t.simulation().pose(r).y_m; }, "y", "m", 1},
      {"heading_deg", 0, "deg", -kMost, kMost,
       "where it looks, 0 along x, counter-clockwise, whole turns counted", false,
       [](T t, int r, int) { return sim::degrees(t.simulation().pose(r).heading_rad); }, "heading", "deg", 1},
      {"speed_m_s", 0, "m/s", 0, kFar, "speed over the floor", false,
       [](T t, int r, int) { return sim::length(t.simulation().state(r).velocity_m_s); }, "speed", "m/s", 1},
      {"turn_deg_s", 0, "deg/s", -kFar, kFar, "how fast it turns, counter-clockwise", false,
       [](T t, int r, int) { return sim::degrees(t.simulation().state(r).spin_rad_s); }, "spin", "deg/s", 1},
      {"distance_m", 0, "m", 0, kFar, "way over the floor since the world began; moves by hand do not count",
       false, [](T t, int r, int) { return t.simulation().distance_m(r); }, "distance", "m", 1},
  };
}

std::vector<Signal> of_touch() {
  return {
      {"collisions", 0, "", 0, kMost, "touches begun, whatever was touched", false,
       [](T t, int r, int) { return double(t.simulation().touches(r).collisions); }, "collisions", "", 1},
      {"wall_touch_s", 0, "s", 0, kMost, "length of the touch of something fixed that lasts now", false,
       [](T t, int r, int) { return t.simulation().touches(r).wall_touch_s; }},
      {"longest_wall_touch_s", 0, "s", 0, kMost, "the longest such touch so far", false,
       [](T t, int r, int) { return t.simulation().touches(r).longest_wall_touch_s; }},
      {"touch_s", 0, "s", 0, kMost, "time in touch with anything, all together", false,
       [](T t, int r, int) { return t.simulation().touches(r).touch_s; }},
      {"nearest_wall_m", 0, "m", -1, kNothingNearM,
       "gap between its body and the nearest fixed thing, in plan", false,
       [](T t, int r, int) { return nearest_wall_m(t, r); }},
      {"nearest_robot_m", 0, "m", -1, kNothingNearM, "gap between its body and the nearest robot's", false,
       [](T t, int r, int) { return nearest_robot_m(t, r); }},
  };
}

std::vector<Signal> of_light() {
  return {
      {"proximity", kRing, "counts", -board::kAdcMax, board::kAdcMax,
       "what e_get_prox() would give: dark less lit", false,
       [](T t, int r, int i) {
         const auto& m = mind(t, r);
         return m.board().scene() ? double(m.proximity_reading(i)) : 0.0;
       },
       "ir", "counts", 1},
      {"light", kRing, "W/m2", 0, kFar, "light that falls on a proximity sensor", false,
       [](T t, int r, int i) {
         return sim::sense_irradiance_w_m2(t.simulation().scene(), r, i, t.simulation().now());
       },
       "light", "W/m2", 1},
  };
}

std::vector<Signal> of_sound() {
  return {
      {"mic", board::kMicrophones, "counts", 0, board::kAdcMax, "a sample of a microphone: right, left, back",
       false, [](T t, int r, int i) { return converted(t, r, board::kMicChannel + i); }, "mic", "counts", 1},
      {"mic_level", board::kMicrophones, "counts", 0, board::kAdcMax,
       "how loud it is at a microphone, root mean square of 1/64 s, without noise", false,
       [](T t, int r, int i) { return listen(t.simulation().scene(), r).counts[i]; }, "mic_level",
       "counts rms", 1},
      {"loudness", 0, "counts", 0, board::kAdcMax, "the same where it is loudest", false,
       [](T t, int r, int) {
         const Heard heard = listen(t.simulation().scene(), r);
         return *std::max_element(std::begin(heard.counts), std::end(heard.counts));
       }},
      {"sound_bearing_deg", 0, "deg", -180, 180, "where sound comes from, 0 ahead, left positive", false,
       [](T t, int r, int) { return sim::degrees(listen(t.simulation().scene(), r).bearing_rad); },
       "sound_bearing", "deg", 1},
      {"speaker", 0, "%", 0, 100, "what the loudspeaker gets, root mean square of full scale", false,
       [](T t, int r, int) { return speaker_level(mind(t, r)); }, "speaker", "%", 1},
  };
}

std::vector<Signal> of_tilt() {
  return {
      {"acc_x", 0, "counts", 0, board::kAdcMax, "a sample of the accelerometer: to the left", false,
       [](T t, int r, int) { return converted(t, r, board::kAccChannel); }, "acc_x", "counts", 1},
      {"acc_y", 0, "counts", 0, board::kAdcMax, "the same: forward", false,
       [](T t, int r, int) { return converted(t, r, board::kAccChannel + 1); }, "acc_y", "counts", 1},
      {"acc_z", 0, "counts", 0, board::kAdcMax, "the same: up", false,
       [](T t, int r, int) { return converted(t, r, board::kAccChannel + 2); }, "acc_z", "counts", 1},
  };
}

std::vector<Signal> of_wheels() {
  return {
      {"left_steps", 0, "steps", -kMost, kMost, "full steps of the left wheel, forward positive", false,
       [](T t, int r, int) { return double(mind(t, r).report().left_steps); }, "left_steps", "steps", 1},
      {"right_steps", 0, "steps", -kMost, kMost, "the same, right", false,
       [](T t, int r, int) { return double(mind(t, r).report().right_steps); }, "right_steps", "steps", 1},
      {"left_steps_s", 0, "steps/s", -kFar, kFar, "how fast the left motor turns", false,
       [](T t, int r, int) { return step_rate(t, r, board::Wheel::Left); }},
      {"right_steps_s", 0, "steps/s", -kFar, kFar, "the same, right", false,
       [](T t, int r, int) { return step_rate(t, r, board::Wheel::Right); }},
  };
}

std::vector<Signal> of_lamps() {
  return {
      {"led", 10, "", 0, 1, "is it lit? 0 to 7 the ring, 8 body, 9 front", false,
       [](T t, int r, int i) { return double(mind(t, r).report().leds >> i & 1); }, "led", "", 1},
      {"body_led", 0, "", 0, 1, "is it lit?", false,
       [](T t, int r, int) { return double(mind(t, r).report().leds >> 8 & 1); }},
      {"front_led", 0, "", 0, 1, "is it lit?", false,
       [](T t, int r, int) { return double(mind(t, r).report().leds >> 9 & 1); }},
      {"leds", 0, "", 0, 8, "how many of the ring are lit", false,
       [](T t, int r, int) { return double(__builtin_popcount(mind(t, r).report().leds & 0xFFu)); }},
      {"selector", 0, "", 0, 15, "its position", false,
       [](T t, int r, int) { return double(mind(t, r).board().selector()); }, "selector", "", 1},
  };
}

std::vector<Signal> of_battery() {
  return {
      {"battery_v", 0, "V", 0, 5, "voltage at the battery's terminals", false,
       [](T t, int r, int) { return mind(t, r).board().power().battery().voltage(mind(t, r).now()); },
       "battery", "V", 1},
      {"charge", 0, "", -1, 2, "share of a full battery", false,
       [](T t, int r, int) { return mind(t, r).board().power().battery().charge(mind(t, r).now()); },
       "charge", "%", 100},
      {"current_a", 0, "A", 0, 10, "what flows out of it", false,
       [](T t, int r, int) { return mind(t, r).board().power().battery().amps(); }, "current", "mA", 1000},
  };
}

std::vector<Signal> of_program() {
  return {
      {"load", 0, "", 0, 1, "share of processor time not spent waiting, since power-up", false,
       [](T t, int r, int) {
         const auto* robot = program(t, r);
         return robot ? robot->cpu_load() : 0.0;
       },
       "load", "%", 100},
      {"cycles", 0, "cycles", 0, kMost, "instruction cycles since power-up", false,
       [](T t, int r, int) { return double(mind(t, r).now()); }},
      {"interrupts", 0, "", 0, kMost, "handlers that have returned; not those known by heart", false,
       [](T t, int r, int) {
         const auto* robot = program(t, r);
         return robot ? double(robot->interrupts_served()) : 0.0;
       }},
      {"traps", 0, "", 0, kMost, "traps of its program so far", false,
       [](T t, int r, int) { return traps_of(t, r, false); }},
      {"resets", 0, "", 0, kMost, "resets that nobody asked for", false,
       [](T t, int r, int) { return traps_of(t, r, true); }},
      {"stopped", 0, "", 0, 1, "has a trap stopped its program for good?", false,
       [](T t, int r, int) {
         const auto* robot = program(t, r);
         return robot && robot->has_stopped() ? 1.0 : 0.0;
       }},
      {"waiting", 0, "", 0, 1, "does its program wait for something?", false,
       [](T t, int r, int) {
         const auto* robot = program(t, r);
         return robot && robot->waiting_since() < host::kNever ? 1.0 : 0.0;
       }},
      {"diagnoses", 0, "", 0, kMost, "things that board and chip have to say about its program", false,
       [](T t, int r, int) {
         const auto* robot = program(t, r);
         return robot ? double(robot->diagnoses().size()) : 0.0;
       }},
  };
}

std::vector<Signal> of_lines() {
  return {
      {"uart1_bytes", 0, "bytes", 0, kMost, "sent over UART 1 since power-up", false,
       [](T t, int r, int) { return double(mind(t, r).board().uart(1).sent()); }},
      {"uart2_bytes", 0, "bytes", 0, kMost, "sent over UART 2", false,
       [](T t, int r, int) { return double(mind(t, r).board().uart(2).sent()); }},
      {"uart1_received", 0, "bytes", 0, kMost, "that have begun to come over UART 1", false,
       [](T t, int r, int) { return double(mind(t, r).board().uart(1).came()); }},
      {"uart2_received", 0, "bytes", 0, kMost, "that have begun to come over UART 2", false,
       [](T t, int r, int) { return double(mind(t, r).board().uart(2).came()); }},
  };
}

}  // namespace

const std::vector<Signal>& all() {
  static const std::vector<Signal> kAll = [] {
    std::vector<Signal> joined;
    for (const auto subject : {of_world, of_way, of_touch, of_light, of_sound, of_tilt, of_wheels, of_lamps,
                               of_battery, of_program, of_lines})
      for (const Signal& s : subject()) joined.push_back(s);
    return joined;
  }();
  return kAll;
}

std::vector<std::string> names(bool of_world) {
  std::vector<std::string> all_names;
  for (const Signal& s : all()) {
    if (s.is_of_world && !of_world) continue;
    for (int i = 0; i < std::max(1, s.count); ++i)
      all_names.push_back(s.count == 0 ? s.name : s.name + std::to_string(i));
  }
  return all_names;
}

std::string page_table() {
  std::string text = "| name | unit | range | what it is |\n|---|---|---|---|\n";
  for (const Signal& s : all())
    text += fmt::format("| `{}` | {} | {} | {} |\n", name_text(s), s.unit, range_text(s), s.what);
  return text;
}

std::string text_table() {
  std::string text;
  for (const Signal& s : all())
    text += fmt::format("  {:<24} {:<8} {:<18} {}\n", name_text(s), s.unit, range_text(s), s.what);
  return text;
}

std::string robots_text(const twin::Twin& twin) {
  constexpr int kNamed = 4;
  std::string text;
  for (int r = 0; r < std::min(kNamed, twin.robots()); ++r)
    text += (r > 0 ? ", " : "") + twin.world().robots[static_cast<std::size_t>(r)].name;
  if (twin.robots() > kNamed) text += fmt::format(" and {} more", twin.robots() - kNamed);
  return text.empty() ? "the world has no robots" : "the robots are " + text;
}

int robot_before_dot(const twin::Twin& twin, const std::string& text, std::string& rest) {
  int robot = -1;
  std::size_t length = 0;
  for (int r = 0; r < twin.robots(); ++r) {
    const std::string& own = twin.world().robots[static_cast<std::size_t>(r)].name;
    if (own.size() >= length && text.compare(0, own.size() + 1, own + ".") == 0)
      robot = r, length = own.size();
  }
  if (robot >= 0) rest = text.substr(length + 1);
  return robot;
}

// --- of the chip and the program

Named find_pin(twin::Twin& /*twin*/, int robot, const std::string& name) {
  const int bit =
      name.size() > 1 && name.size() < 4 && name.find_first_not_of("0123456789", 1) == std::string::npos
          ? std::stoi(name.substr(1))
          : -1;
  // a bit that has a direction is there
  const std::string tris = std::string("TRIS") + (name.empty() ? ' ' : name[0]);
  if (bit < 0 || !debug::find_sfr(tris + "." + tris + std::to_string(bit)))
    throw std::runtime_error("got pin '" + name + "', expected a port and a bit of the chip's, such as D3");
  return {"", [robot, port = name[0], bit](twin::Twin& t) {
            const auto& m = mind(t, robot);
            return double(m.board().pins().read(port, board::Pins::Register::Port, m.now()) >> bit & 1);
          }};
}

Named find_register(twin::Twin& twin, int robot, const std::string& name) {
  const host::Runner* runner = program(twin, robot);
  std::string error = "got a register of a robot without a chip, expected a robot that runs firmware";
  if (!runner || !runner->chip()) throw std::runtime_error(error);
  const auto found = trace::find_signals(name, runner, error);
  if (found.size() != 1 || found[0].source.kind != trace::Source::Register)
    throw std::runtime_error(error.empty() ? "got '" + name + "', expected a register" : error);
  return {"", [robot, s = found[0]](twin::Twin& t) {
            const auto value = t.mind(robot).runner()->chip()->peek(static_cast<unsigned>(s.source.index),
                                                                    t.mind(robot).now());
            return double(value >> s.shift & ((1u << s.width) - 1));
          }};
}

Named find_variable(twin::Twin& twin, int robot, const std::string& expression) {
  const host::Runner* runner = program(twin, robot);
  if (!runner) throw std::runtime_error("got a variable of a robot that runs no program");
  std::string error;
  // what has a name has a place that stays
  if (runner->data().find_variable(expression, error)) {
    if (!runner->data().find_number(expression, error)) throw std::runtime_error(error);
    // looked up at each look: another program may have been flashed, with its variables elsewhere
    return {"", [robot, expression](twin::Twin& t) {
              const auto* now = program(t, robot);
              std::string none;
              const host::Variable* found = now ? now->data().find_number(expression, none) : nullptr;
              return found ? now->data().number(*found) : std::nan("");
            }};
  }
  // Else it is an expression of C: tried once, to tell what is wrong with it, and computed at each look.
  const auto* chip = dynamic_cast<const chip::ChipRunner*>(runner);
  std::string why;
  double tried = 0;
  if (!chip || !debug::number_of(*chip, expression, true, tried, why)) {
    // of a plain name the first message is the better one
    const bool is_plain = expression.find_first_of(" +-*/%&|^<>=!?()~") == std::string::npos;
    throw std::runtime_error(chip && !is_plain ? why : error);
  }
  return {"", [robot, expression](twin::Twin& t) {
            double value = 0;
            std::string none;
            const auto* now = dynamic_cast<const chip::ChipRunner*>(program(t, robot));
            if (now && !debug::number_of(*now, expression, false, value, none)) value = std::nan("");
            return value;
          }};
}

Named find(twin::Twin& twin, int robot, const std::string& name) {
  const auto inside = [&](const char* what) -> std::optional<std::string> {
    const std::string begin = std::string(what) + "(";
    if (name.rfind(begin, 0) != 0 || name.back() != ')') return {};
    return name.substr(begin.size(), name.size() - begin.size() - 1);
  };
  const auto needs_robot = [&] {
    if (robot < 0)
      throw std::runtime_error(
          fmt::format("got '{0}' without a robot, expected ROBOT.{0}; {1}", name, robots_text(twin)));
  };
  if (const auto pin = inside("pin")) return needs_robot(), find_pin(twin, robot, *pin);
  if (const auto reg = inside("reg")) return needs_robot(), find_register(twin, robot, *reg);
  if (const auto var = inside("var")) return needs_robot(), find_variable(twin, robot, *var);
  if (!name.empty() && name[0] == '$') return needs_robot(), find_variable(twin, robot, name.substr(1));
  // A signal of the table, by its name, or by its name and a number.
  for (const Signal& s : all()) {
    int index = 0;
    const std::string plain(s.name);
    if (s.count == 0 ? name != plain : name.size() != plain.size() + 1 || name.rfind(plain, 0) != 0) continue;
    if (s.count > 0) index = name.back() - '0';
    if (index < 0 || index >= s.count + (s.count == 0)) continue;
    if (!s.is_of_world) needs_robot();
    return {s.unit, [robot, index, look = s.look](twin::Twin& t) { return look(t, robot, index); }};
  }
  std::vector<std::string> candidates = names(true);
  throw std::runtime_error(fmt::format(
      "got '{}', expected a signal{}; twinpuck list signals names them, $NAME is a variable of the program",
      name.substr(0, 60), sim::did_you_mean_tail(name, candidates)));
}

}  // namespace signals
