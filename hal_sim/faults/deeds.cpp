// SPDX-License-Identifier: MIT
#include "hal_sim/faults/deeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "hal_sim/board/accelerometer.h"
#include "hal_sim/host/variables.h"
#include "sim_core/base/hash.h"
#include "sim_core/base/portable_math.h"
#include "sim_core/base/utf8.h"
#include "sim_core/light/proximity.h"

namespace faults {

namespace {

using board::Board;
using board::Damage;
using board::Noticed;
using board::Wheel;

constexpr Wheel kWheels[] = {Wheel::Left, Wheel::Right};

bool is_kind(const Case& c, const char* name) { return std::strcmp(c.kind->name, name) == 0; }

/// Those of the same kind on the same robot that go on.
template <typename F>
void each_active(const Case& c, const std::vector<Case*>& cases, F f) {
  for (const Case* other : cases)
    if (other->kind == c.kind && other->robot == c.robot && other->is_active()) f(*other);
}

bool means_sensor(const Case& c, int sensor) {
  return !has(c, "sensor") || int(number(c, "sensor")) == sensor;
}
bool means_wheel(const Case& c, Wheel wheel) {
  const std::string which = word(c, "wheel");
  return which == "both" || (which == "left") == (wheel == Wheel::Left);
}
bool means_to_robot(const Case& c) { return word(c, "direction") != "tx"; }
bool means_from_robot(const Case& c) { return word(c, "direction") != "rx"; }
int uart_of(const Case& c) { return int(number(c, "uart")); }
char port_of(const Case& c) { return word(c, "pin").substr(0, 1)[0]; }
int bit_of(const Case& c) { return std::atoi(word(c, "pin").c_str() + 1); }

struct Hands {
  Hands(const Case& c, twin::Twin& twin)
      : twin(twin), robot(c.robot), mind(twin.mind(c.robot)), board(mind.board()), now(mind.now()) {}
  twin::Twin& twin;
  int robot;
  host::FirmwareMind& mind;
  Board& board;
  Cycle now;
  sim::Simulation& simulation() { return twin.simulation(); }
  board::LineDamage& line(int uart) {
    return board.uart(uart).damage(board.setup().seed, board.setup().robot, uart);
  }
};

// --- one function a group of kinds, which sees all cases that go on

void sensors(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  Damage& damage = h.board.be_damaged();
  const sim::Scene& scene = h.simulation().scene();
  for (int s = 0; s < board::kRingSensors; ++s) {
    Damage::Sensor& sensor = damage.sensors[static_cast<std::size_t>(s)];
    double cover = -1, transmits = 1, lamp = 0, emitter = 0, receiver = 0;
    each_active(c, cases, [&](const Case& other) {
      if (!means_sensor(other, s)) return;
      if (is_kind(c, "sensor_blocked")) {
        sim::Surface surface;
        surface.ir_reflectance = number(other, "reflects");
        const sim::FlatWall wall(sim::proximity_config(scene, h.robot, s), surface);
        cover = wall.at(number(other, "gap_mm") * 1e-3).value;
      } else if (is_kind(c, "sensor_dirty")) {
        transmits *= number(other, "transmits");
      } else if (is_kind(c, "hot_light")) {
        lamp += number(other, "w_m2");
      } else {
        (word(other, "part") == "emitter" ? emitter : receiver) = 1;
      }
    });
    if (is_kind(c, "sensor_blocked")) sensor.cover.set(cover, h.now);
    if (is_kind(c, "sensor_dirty")) sensor.transmits.set(transmits, h.now);
    if (is_kind(c, "hot_light")) sensor.lamp_w_m2.set(lamp, h.now);
    if (!is_kind(c, "sensor_dead")) continue;
    sensor.emitter_dead.set(emitter, h.now);
    sensor.receiver_dead.set(receiver, h.now);
  }
}

void steps(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  for (const Wheel wheel : kWheels) {
    double made = 1;
    bool is_blocked = false;
    each_active(c, cases, [&](const Case& other) {
      if (!means_wheel(other, wheel)) return;
      if (is_kind(c, "wheel_stuck"))
        is_blocked = true;
      else
        made *= 1 - number(other, "share");
    });
    board::StepLoss& loss = h.board.be_damaged().steps[static_cast<std::size_t>(wheel)];
    if (is_kind(c, "wheel_stuck"))
      loss.block(is_blocked);
    else
      loss.lose(1 - made);
    h.board.motors().lose_steps(wheel, loss.is_active() ? &loss : nullptr, h.now);
  }
}

/// Of wheel_slip and of lifted, which both take the floor away.
void grip(int robot, const std::vector<Case*>& cases, Hands& h) {
  double hold[2] = {1, 1};
  for (const Case* other : cases) {
    if (other->robot != robot || !other->is_active()) continue;
    for (const Wheel wheel : kWheels) {
      double& held = hold[static_cast<int>(wheel)];
      if (is_kind(*other, "lifted")) held = 0;
      if (is_kind(*other, "wheel_slip") && means_wheel(*other, wheel)) held *= 1 - number(*other, "share");
    }
  }
  h.simulation().set_wheel_grip(robot, hold[0], hold[1]);
}

void line(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  for (int uart = 1; uart <= 2; ++uart) {
    // made for lines that something is wrong with only
    bool is_meant = false;
    for (const Case* other : cases)
      is_meant |= other->kind == c.kind && other->robot == c.robot && uart_of(*other) == uart;
    if (!is_meant) continue;
    for (const bool to_robot : {true, false}) {
      double passes = 1, cut = 0;
      each_active(c, cases, [&](const Case& other) {
        if (uart_of(other) != uart || !(to_robot ? means_to_robot(other) : means_from_robot(other))) return;
        cut = 1;
        if (!is_kind(c, "line_cut")) passes *= 1 - number(other, "share");
      });
      board::WireDamage& wire = to_robot ? h.line(uart).to_robot : h.line(uart).from_robot;
      if (is_kind(c, "line_cut")) wire.cut.set(cut, h.now);
      if (is_kind(c, "bytes_lost")) wire.lost.set(1 - passes, h.now);
      if (is_kind(c, "bytes_garbled")) wire.garbled.set(1 - passes, h.now);
    }
  }
}

void battery(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  double drop_v = 0, more_ohm = 0;
  each_active(c, cases, [&](const Case& other) {
    drop_v += number(other, "drop_v");
    more_ohm += number(other, "more_ohm");
  });
  h.board.power().weaken(drop_v, more_ohm, h.now);
  h.board.pins().changed_by_hand(h.now);
}

void bump(Case& c, Hands& h) {
  const sim::BodyState before = h.simulation().state(h.robot);
  const double mass_kg =
      h.twin.world().model_of(h.twin.world().robots[static_cast<std::size_t>(h.robot)])->mass_kg;
  const sim::SinCos towards =
      sim::sin_cos(before.pose.heading_rad + sim::radians(number(c, "direction_deg")));
  const double change = number(c, "impulse_n_s") / mass_kg;
  h.simulation().set_velocity(
      h.robot, {before.velocity_m_s.x + change * towards.c, before.velocity_m_s.y + change * towards.s},
      before.spin_rad_s + sim::radians(number(c, "spin_deg_s")), 0);
}

void lift(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  double height_m = 0;
  each_active(c, cases, [&](const Case& other) { height_m = std::max(height_m, number(other, "height_m")); });
  h.board.be_damaged().lifted.set(height_m > 0 ? 1 : 0, h.now);
  h.simulation().move(h.robot, h.simulation().pose(h.robot), height_m);
  grip(h.robot, cases, h);
}

void crystal(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  double slower_ppm = 0;
  each_active(c, cases, [&](const Case& other) { slower_ppm += number(other, "ppm"); });
  // a crystal of two faults still runs
  const double ppm = std::clamp(h.board.setup().clock_ppm - slower_ppm, -900000.0, 900000.0);
  h.board.set_clock_ppm(ppm, h.simulation().now());
}

void microphones(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  for (int m = 0; m < board::kMicrophones; ++m) {
    double deaf = 0;
    each_active(c, cases, [&](const Case& other) {
      if (!has(other, "microphone") || int(number(other, "microphone")) == m) deaf = 1;
    });
    h.board.be_damaged().deaf[static_cast<std::size_t>(m)].set(deaf, h.now);
  }
}

std::uint32_t leds_of(const Case& c) { return has(c, "led") ? 1u << int(number(c, "led")) : 0x3FFu; }

void leds(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  std::uint32_t dead = 0;
  each_active(c, cases, [&](const Case& other) { dead |= leds_of(other); });
  h.board.be_damaged().dead_leds = dead;
  h.board.pins().changed_by_hand(h.now);
}

void pins(const Case& c, const std::vector<Case*>& cases, Hands& h) {
  std::optional<bool> level;
  // of two wires the one that came last holds it
  each_active(c, cases, [&](const Case& other) {
    if (port_of(other) == port_of(c) && bit_of(other) == bit_of(c)) level = number(other, "level") != 0;
  });
  h.board.pins().hold(port_of(c), bit_of(c), level, h.now);
}

bool any_active(const Case& c, const std::vector<Case*>& cases) {
  bool any = false;
  each_active(c, cases, [&](const Case&) { any = true; });
  return any;
}

/// The level that a pin would have without a wire.
bool free_level(const Case& c, Board& board, Cycle now) {
  Damage& damage = board.be_damaged();
  const auto held = damage.held_pins;
  damage.held_pins = {};
  const char port = port_of(c);
  const bool level = (board.pins().read(port, board::Pins::Register::Port, now) >> bit_of(c) & 1) != 0;
  damage.held_pins = held;
  return level;
}

Clicks earliest(const Case& c, std::initializer_list<const Noticed*> all, const Board& board) {
  Clicks first = -1;
  for (const Noticed* what : all) {
    if (!what || what->first() >= board::kNever || what->first() < c.begun_cycle ||
        what->first() >= c.ended_cycle)
      continue;
    const Clicks at = board.clock().click_at(what->first());
    if (first < 0 || at < first) first = at;
  }
  return first;
}

/// Those of Damage and of the line that a case looks at; all of them for `forget`.
template <typename F>
void each_notice(const Case& c, Board& board, F f) {
  // What the line notes.
  if (c.kind->name == std::string("bytes_lost") || is_kind(c, "bytes_garbled") || is_kind(c, "line_cut")) {
    if (!board.uart(uart_of(c)).damage()) return;
    board::LineDamage& line =
        board.uart(uart_of(c)).damage(board.setup().seed, board.setup().robot, uart_of(c));
    for (board::WireDamage* wire : {&line.to_robot, &line.from_robot}) {
      if (!(wire == &line.to_robot ? means_to_robot(c) : means_from_robot(c))) continue;
      f(is_kind(c, "line_cut")     ? wire->cut_one
        : is_kind(c, "bytes_lost") ? wire->lost_one
                                   : wire->garbled_one);
    }
    return;
  }
  // What the board notes: at sensors, wheels, ears, or of the whole robot.
  if (!board.damage()) return;
  Damage& damage = board.be_damaged();
  if (c.kind->parameters.size() > 0 && std::strcmp(c.kind->parameters[0].name, "sensor") == 0) {
    for (int s = 0; s < board::kRingSensors; ++s) {
      if (!means_sensor(c, s)) continue;
      Damage::Sensor& sensor = damage.sensors[static_cast<std::size_t>(s)];
      f(is_kind(c, "sensor_blocked") ? sensor.covered
        : is_kind(c, "sensor_dirty") ? sensor.dirty
        : is_kind(c, "hot_light")    ? sensor.lit
                                     : sensor.dead);
    }
  } else if (is_kind(c, "wheel_stuck") || is_kind(c, "steps_lost")) {
    for (const Wheel wheel : kWheels) {
      if (!means_wheel(c, wheel)) continue;
      board::StepLoss& loss = damage.steps[static_cast<std::size_t>(wheel)];
      f(is_kind(c, "wheel_stuck") ? loss.blocked : loss.lost);
    }
  } else if (is_kind(c, "lifted")) {
    f(damage.saw_nothing);
  } else if (is_kind(c, "microphone_silent")) {
    for (int m = 0; m < board::kMicrophones; ++m)
      if (!has(c, "microphone") || int(number(c, "microphone")) == m)
        f(damage.heard_nothing[static_cast<std::size_t>(m)]);
  } else if (is_kind(c, "accelerometer_stuck")) {
    f(damage.acc_stood_still);
  } else if (is_kind(c, "camera_covered")) {
    f(damage.saw_dark);
  }
}

std::string set_variable(const Case& c, twin::Twin& twin, bool is_tried, bool& changed) {
  host::Runner* program = twin.mind(c.robot).runner();
  if (!program) return "variable: got a robot that runs no program";
  std::string error;
  const host::Variable* v = program->data().find_number(word(c, "variable"), error);
  if (!v) return "variable: " + error;
  if (!is_tried) changed = program->data().set_number(*v, number(c, "value"));
  return "";
}

}  // namespace

bool has(const Case& c, const char* parameter) { return c.fault->values.count(parameter) > 0; }

double number(const Case& c, const char* parameter) {
  const auto given = c.fault->values.find(parameter);
  for (const Parameter& p : c.kind->parameters) {
    if (std::strcmp(p.name, parameter) != 0) continue;
    if (given == c.fault->values.end()) return std::strtod(p.usual, nullptr);
    return p.type == sim::ValueType::Integer ? static_cast<double>(given->second.integer)
                                             : given->second.number;
  }
  return 0;
}

std::string word(const Case& c, const char* parameter) {
  const auto given = c.fault->values.find(parameter);
  if (given != c.fault->values.end()) return given->second.text;
  for (const Parameter& p : c.kind->parameters)
    if (std::strcmp(p.name, parameter) == 0) {
      const std::string usual = p.usual;
      return usual.size() >= 2 && usual[0] == '"' ? usual.substr(1, usual.size() - 2) : usual;
    }
  return {};
}

std::string check(const Case& c, twin::Twin& twin) {
  if (is_kind(c, "pin_forced")) {
    const std::string pin = word(c, "pin");
    const bool is_pin =
        pin.size() >= 2 && pin.size() <= 3 && pin.find_first_not_of("0123456789", 1) == std::string::npos;
    if (!is_pin || !board::Pins::can_be_held(pin[0], std::atoi(pin.c_str() + 1)))
      return fmt::format(
          "pin: got '{}', expected an input or an LED's: F1, F6, G6 to G9, A6, A7, A9, A10, A12 to A15, "
          "C1, C2",
          pin.substr(0, 20));
  }
  bool none = false;
  if (is_kind(c, "variable_set")) return set_variable(c, twin, true, none);
  if (is_kind(c, "reset_pressed") && !twin.mind(c.robot).runner())
    return "reset: got a robot that runs no program";
  if (is_kind(c, "camera_covered") && !twin.mind(c.robot).board().camera())
    return "robot: got one without a camera, expected one that has it";
  return "";
}

void apply(Case& c, std::vector<Case*>& cases, twin::Twin& twin) {
  Hands h(c, twin);
  const sim::Pose2 pose = h.simulation().pose(c.robot);
  const sim::BodyState state = h.simulation().state(c.robot);
  bool is_done = false;  // of kinds that do not last: it changed something
  if (is_kind(c, "sensor_blocked") || is_kind(c, "sensor_dead") || is_kind(c, "sensor_dirty") ||
      is_kind(c, "hot_light"))
    sensors(c, cases, h);
  else if (is_kind(c, "wheel_stuck") || is_kind(c, "steps_lost"))
    steps(c, cases, h);
  else if (is_kind(c, "wheel_slip"))
    grip(c.robot, cases, h);
  else if (is_kind(c, "bytes_lost") || is_kind(c, "bytes_garbled") || is_kind(c, "line_cut"))
    line(c, cases, h);
  else if (is_kind(c, "battery_sag"))
    battery(c, cases, h);
  else if (is_kind(c, "bump"))
    bump(c, h);
  else if (is_kind(c, "lifted"))
    lift(c, cases, h);
  else if (is_kind(c, "crystal_slow"))
    crystal(c, cases, h);
  else if (is_kind(c, "microphone_silent"))
    microphones(c, cases, h);
  else if (is_kind(c, "accelerometer_stuck"))
    board::stick_accelerometer(h.board, any_active(c, cases), h.now);
  else if (is_kind(c, "led_dead"))
    leds(c, cases, h);
  else if (is_kind(c, "camera_covered"))
    h.board.be_damaged().lens_covered.set(any_active(c, cases) ? 1 : 0, h.now);
  else if (is_kind(c, "pin_forced"))
    pins(c, cases, h);
  else if (is_kind(c, "bytes_sent")) {
    c.first_byte = h.board.uart(uart_of(c)).queued();
    h.board.uart(uart_of(c)).inject(sim::bytes_of_characters(word(c, "bytes")).value_or(""));
  } else if (is_kind(c, "key_pressed")) {
    h.mind.press_key({int(number(c, "key")), sim::to_seconds(h.simulation().now()), number(c, "hold_s"),
                      int(number(c, "address"))});
    is_done = true;
  } else if (is_kind(c, "selector_turned")) {
    is_done = h.board.selector() != int(number(c, "position"));
    h.board.turn_selector(int(number(c, "position")));
  } else if (is_kind(c, "robot_moved")) {
    const std::vector<double>& to = c.fault->values.at("to").numbers;
    h.simulation().move(c.robot, {to[0], to[1], sim::radians(to[2])}, h.simulation().scene().z_m(c.robot));
  } else if (is_kind(c, "variable_set")) {
    set_variable(c, twin, false, is_done);
  } else if (is_kind(c, "reset_pressed")) {
    if (h.mind.runner()) h.mind.runner()->restart();
    is_done = true;
  }
  // Of what moves a robot: did it stand elsewhere, or move otherwise, before?
  if (is_kind(c, "lifted")) {
    is_done = h.simulation().scene().z_m(c.robot) != state.z_m;
  } else if (is_kind(c, "bump") || is_kind(c, "robot_moved")) {
    const sim::Pose2 after = h.simulation().pose(c.robot);
    const sim::BodyState now = h.simulation().state(c.robot);
    is_done = pose.x_m != after.x_m || pose.y_m != after.y_m || pose.heading_rad != after.heading_rad ||
              state.velocity_m_s.x != now.velocity_m_s.x || state.velocity_m_s.y != now.velocity_m_s.y ||
              state.spin_rad_s != now.spin_rad_s;
  }
  if (is_done && c.is_active() && c.took_effect < 0) c.took_effect = h.simulation().now();
  // Whoever found that nothing would happen looks again, and the run's digest tells that somebody did this.
  h.mind.disturb();
  if (h.mind.runner()) h.mind.runner()->wake();
  std::uint64_t hash = sim::mix64(static_cast<std::uint64_t>(c.robot) * 2 + c.is_active());
  for (const char* letter = c.kind->name; *letter; ++letter)
    hash = sim::mix64(hash ^ static_cast<unsigned char>(*letter));
  h.simulation().note_intervention(hash);
}

Clicks noticed(const Case& c, twin::Twin& twin) {
  if (c.took_effect >= 0) return c.took_effect;
  if (c.begun < 0) return -1;
  const sim::Simulation& simulation = twin.simulation();
  const host::FirmwareMind& mind = std::as_const(twin).mind(c.robot);
  Board& board = twin.mind(c.robot).board();
  const Clicks world_now = simulation.now();
  const Cycle now = mind.now();
  // Some are felt by what the program or the world gets just now.
  const bool lasts_now = c.is_active();
  if (is_kind(c, "wheel_slip") || is_kind(c, "lifted")) {
    const Clicks slipped = simulation.slipped_at(c.robot);
    if (lasts_now && slipped < sim::kEver && slipped > c.begun) return slipped;
  }
  if (is_kind(c, "battery_sag") && lasts_now) {
    const auto& battery = mind.board().power().battery();
    const double volts = battery.voltage(now), sound = battery.sound_voltage(now);
    const bool is_told = (volts >= board::kBatteryLowV) != (sound >= board::kBatteryLowV);
    if (is_told || (volts != sound && board.setup().revision == board::Revision::Rev13)) return world_now;
  }
  if (is_kind(c, "crystal_slow") && lasts_now) {
    const double missing = std::fabs(number(c, "ppm")) * 1e-6 * static_cast<double>(world_now - c.begun);
    if (missing >= 1) return world_now;
  }
  if (is_kind(c, "led_dead") && lasts_now && (board.pins().driven_leds(now) & leds_of(c))) return world_now;
  if (is_kind(c, "pin_forced") && lasts_now && free_level(c, board, now) != (number(c, "level") != 0))
    return world_now;
  if (is_kind(c, "bytes_sent") && board.uart(uart_of(c)).injected() > c.first_byte) return world_now;
  // Of the others the board keeps when they were first felt.
  Clicks first = -1;
  each_notice(c, board, [&](Noticed& what) {
    const Clicks at = earliest(c, {&what}, board);
    if (at >= 0 && (first < 0 || at < first)) first = at;
  });
  return first;
}

void forget(const Case& c, twin::Twin& twin) {
  Board& board = twin.mind(c.robot).board();
  // what has gone over the lines so far was still as it was
  if (c.kind->name[0] == 'b' || is_kind(c, "line_cut")) board.exchange(twin.mind(c.robot).now());
  each_notice(c, board, [](Noticed& what) { what.forget(); });
}

bool is_looked_for(const Case& c) {
  for (const char* kind :
       {"wheel_slip", "battery_sag", "crystal_slow", "led_dead", "pin_forced", "bytes_sent"})
    if (is_kind(c, kind)) return true;
  return false;
}

}  // namespace faults
