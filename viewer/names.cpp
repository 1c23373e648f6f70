// SPDX-License-Identifier: MIT
#include "viewer/names.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "hal_sim/board/sound_params.h"
#include "hal_sim/host/variables.h"
#include "hal_sim/trace/signals.h"
#include "sim_core/light/proximity.h"
#include "sim_core/load/world_loader.h"
#include "sim_core/sound/sound_field.h"

namespace viewer {

namespace {

using Look = double (*)(twin::Twin&, int robot, int index);

struct Entry {
  const char* name;
  int count;  // 0: one, without a number
  const char* unit;
  Look look;
};

const host::FirmwareMind& mind(twin::Twin& twin, int r) { return std::as_const(twin).mind(r); }

// sound is listened to for so long, and at so many instants of it
constexpr sim::Clicks kListen = sim::kClicksPerSecond / 64;
constexpr int kListens = 48;
constexpr sim::Clicks kMoment = sim::kClicksPerSecond / 50000;  // for how fast it changes
constexpr double kFullScale = 32768;                            // of the loudspeaker's samples

/// What arrives at a robot's microphones, without their noise.
struct Heard {
  double counts[board::kMicrophones] = {};  // root mean square
  double bearing_rad = 0;                   // of where it comes from, robot frame
};

Heard listen(const sim::Scene& scene, int robot) {
  Heard heard;
  if (!sim::has_sound(scene)) return heard;
  const auto pressure = [&](int mic, sim::Clicks at) {
    const board::Place& p = board::kMicrophone[mic];
    return sim::sense_sound_pa(scene, robot, {p.x_m, p.y_m, board::kMicrophoneZM}, at);
  };
  double now[kListens][board::kMicrophones] = {}, change[kListens][board::kMicrophones] = {};
  for (int i = 0; i < kListens; ++i) {
    const sim::Clicks at = scene.now() - kMoment - kListen * i / kListens;
    for (int mic = 0; mic < board::kMicrophones && at >= 0; ++mic) {
      now[i][mic] = pressure(mic, at);
      change[i][mic] = pressure(mic, at + kMoment) - now[i][mic];
      heard.counts[mic] += now[i][mic] * now[i][mic] / kListens;
    }
  }
  for (double& counts : heard.counts) counts = std::sqrt(counts);
  // a wave from direction u: its gradient is u times its change in time, over the speed of sound. That a near
  // source is louder at one microphone says nothing of the wave
  double ahead = 0, left = 0;
  constexpr const board::Place* kMic = board::kMicrophone;
  for (int i = 0; i < kListens; ++i) {
    double p[board::kMicrophones], grows = 0;
    for (int mic = 0; mic < board::kMicrophones; ++mic) {
      const double loud = std::max(heard.counts[mic], 1e-12);
      p[mic] = now[i][mic] / loud;
      grows += change[i][mic] / loud;
    }
    ahead += grows * ((p[0] + p[1]) / 2 - p[2]) / (kMic[0].x_m - kMic[2].x_m);
    left += grows * (p[1] - p[0]) / (kMic[1].y_m - kMic[0].y_m);
  }
  for (double& counts : heard.counts) counts *= board::kMicCountsPerPa;
  heard.bearing_rad = std::atan2(left, ahead);
  return heard;
}

/// What the loudspeaker gets, root mean square, in per cent of full scale.
double speaker_level(const host::FirmwareMind& mind) {
  const board::Codec& codec = mind.board().codec();
  if (!codec.was_used()) return 0;
  double sum = 0;
  constexpr int kSamples = static_cast<int>(board::kFcyHz / 64 / board::kCodecSampleCycles);
  for (int i = 0; i < kSamples; ++i) {
    const double out = codec.output(std::max<board::Cycle>(0, mind.now() - i * board::kCodecSampleCycles));
    sum += out * out;
  }
  return 100 * std::sqrt(sum / kSamples) / kFullScale;
}

const Entry kEntries[] = {
    {"x", 0, "m", [](twin::Twin& t, int r, int) { return t.simulation().pose(r).x_m; }},
    {"y", 0, "m", [](twin::Twin& t, int r, int) { return t.simulation().pose(r).y_m; }},
    {"heading", 0, "deg",
     [](twin::Twin& t, int r, int) { return sim::degrees(t.simulation().pose(r).heading_rad); }},
    {"speed", 0, "m/s",
     [](twin::Twin& t, int r, int) { return sim::length(t.simulation().state(r).velocity_m_s); }},
    {"spin", 0, "deg/s",
     [](twin::Twin& t, int r, int) { return sim::degrees(t.simulation().state(r).spin_rad_s); }},
    {"distance", 0, "m", [](twin::Twin& t, int r, int) { return t.simulation().distance_m(r); }},
    {"collisions", 0, "",
     [](twin::Twin& t, int r, int) { return double(t.simulation().touches(r).collisions); }},
    {"ir", board::kRingSensors, "counts",
     [](twin::Twin& t, int r, int i) {
       const auto& m = mind(t, r);
       return m.board().scene() ? double(m.board().proximity_counts(i, m.now())) : 0.0;
     }},
    {"light", board::kRingSensors, "W/m2",
     [](twin::Twin& t, int r, int i) {
       return sim::sense_irradiance_w_m2(t.simulation().scene(), r, i, t.simulation().now());
     }},
    {"mic", board::kMicrophones, "counts",
     [](twin::Twin& t, int r, int i) {
       const auto& m = mind(t, r);
       return m.board().scene() ? double(m.board().convert(board::kMicChannel + i, m.now())) : 0.0;
     }},
    {"mic_level", board::kMicrophones, "counts rms",
     [](twin::Twin& t, int r, int i) { return listen(t.simulation().scene(), r).counts[i]; }},
    {"sound_bearing", 0, "deg",
     [](twin::Twin& t, int r, int) { return sim::degrees(listen(t.simulation().scene(), r).bearing_rad); }},
    {"speaker", 0, "%", [](twin::Twin& t, int r, int) { return speaker_level(mind(t, r)); }},
    {"acc_x", 0, "counts",
     [](twin::Twin& t, int r, int) {
       const auto& m = mind(t, r);
       return m.board().scene() ? double(m.board().convert(board::kAccChannel, m.now())) : 0.0;
     }},
    {"acc_y", 0, "counts",
     [](twin::Twin& t, int r, int) {
       const auto& m = mind(t, r);
       return m.board().scene() ? double(m.board().convert(board::kAccChannel + 1, m.now())) : 0.0;
     }},
    {"acc_z", 0, "counts",
     [](twin::Twin& t, int r, int) {
       const auto& m = mind(t, r);
       return m.board().scene() ? double(m.board().convert(board::kAccChannel + 2, m.now())) : 0.0;
     }},
    {"left_steps", 0, "steps",
     [](twin::Twin& t, int r, int) { return double(mind(t, r).report().left_steps); }},
    {"right_steps", 0, "steps",
     [](twin::Twin& t, int r, int) { return double(mind(t, r).report().right_steps); }},
    {"led", 10, "", [](twin::Twin& t, int r, int i) { return double(mind(t, r).report().leds >> i & 1); }},
    {"selector", 0, "", [](twin::Twin& t, int r, int) { return double(mind(t, r).board().selector()); }},
    {"battery", 0, "V",
     [](twin::Twin& t, int r, int) { return mind(t, r).board().battery().voltage(mind(t, r).now()); }},
    {"charge", 0, "%",
     [](twin::Twin& t, int r, int) { return 100 * mind(t, r).board().battery().charge(mind(t, r).now()); }},
    {"current", 0, "mA",
     [](twin::Twin& t, int r, int) { return 1000 * mind(t, r).board().battery().amps(); }},
    {"load", 0, "%",
     [](twin::Twin& t, int r, int) {
       const auto* robot = mind(t, r).runner();
       return robot ? 100 * robot->cpu_load() : 0.0;
     }},
};

/// "ir3" is "ir" with 3; true when it is this entry.
bool is_called(const Entry& entry, const std::string& name, int& index) {
  const std::string plain(entry.name);
  index = 0;
  if (entry.count == 0) return name == plain;
  if (name.size() != plain.size() + 1 || name.rfind(plain, 0) != 0) return false;
  index = name.back() - '0';
  return index >= 0 && index < entry.count;
}

Named pin(int robot, const std::string& name) {
  const int bit =
      name.size() > 1 && name.size() < 4 && name.find_first_not_of("0123456789", 1) == std::string::npos
          ? std::stoi(name.substr(1))
          : -1;
  if (bit < 0 || bit > 15 || std::string("ABCDFG").find(name[0]) == std::string::npos)
    throw std::runtime_error("got pin '" + name + "', expected a port and a bit, such as D3");
  return {"", [robot, port = name[0], bit](twin::Twin& t) {
            const auto& m = mind(t, robot);
            return double(m.board().port_read(port, board::Board::Register::Port, m.now()) >> bit & 1);
          }};
}

Named variable(twin::Twin& twin, int robot, const std::string& expression) {
  const host::Runner* program = mind(twin, robot).runner();
  if (!program) throw std::runtime_error("got a variable of a robot that runs no program");
  std::string error;
  const host::Variable* v = program->find_variable(expression, error);
  if (!v) throw std::runtime_error(error);
  if (v->kind == host::Variable::Kind::Aggregate || v->bytes > 8)
    throw std::runtime_error("got '" + expression + "', expected a number; name a member or element");
  return {"", [robot, v = *v](twin::Twin& t) {
            char bytes[8] = {};
            mind(t, robot).runner()->read_memory(v.address, bytes, v.bytes);
            return host::variable_value(v, bytes);
          }};
}

/// A register of the chip, or one of its fields, as signals are called; only where there is a chip.
Named chip_register(twin::Twin& twin, int robot, const std::string& name) {
  const host::Runner* program = mind(twin, robot).runner();
  std::string error = "got a register of a robot without a chip, expected a robot that runs firmware";
  if (!program || !program->has_chip()) throw std::runtime_error(error);
  const auto signals = trace::find_signals(name, program, error);
  if (signals.size() != 1 || signals[0].source.kind != trace::Source::Register)
    throw std::runtime_error(error.empty() ? "got '" + name + "', expected a register" : error);
  return {"", [robot, s = signals[0]](twin::Twin& t) {
            const auto value =
                t.mind(robot).runner()->peek(static_cast<unsigned>(s.source.index), t.mind(robot).now());
            return double(value >> s.shift & ((1u << s.width) - 1));
          }};
}

}  // namespace

Named find_named(twin::Twin& twin, const std::string& name) {
  // the longest robot's name that fits: names may hold dots
  int robot = -1;
  std::size_t length = 0;
  for (int r = 0; r < twin.robots(); ++r) {
    const std::string& own = twin.world().robots[static_cast<std::size_t>(r)].name;
    if (own.size() >= length && name.compare(0, own.size() + 1, own + ".") == 0)
      robot = r, length = own.size();
  }
  if (robot < 0)
    throw std::runtime_error("got '" + name + "', expected ROBOT.NAME with a robot of the world");
  const std::string what = name.substr(length + 1);
  if (what.rfind("pin:", 0) == 0) return pin(robot, what.substr(4));
  if (what.rfind("reg:", 0) == 0) return chip_register(twin, robot, what.substr(4));
  if (what.rfind("var:", 0) == 0) return variable(twin, robot, what.substr(4));
  for (const Entry& entry : kEntries) {
    int index = 0;
    if (is_called(entry, what, index))
      return {entry.unit, [robot, index, look = entry.look](twin::Twin& t) { return look(t, robot, index); }};
  }
  const std::string guess = sim::did_you_mean(what, names_of_robots());
  throw std::runtime_error(
      fmt::format("got '{}', expected a name such as ir0, speed, pin:D3 or var:counter{}", what,
                  guess.empty() ? "" : "; did you mean '" + guess + "'?"));
}

std::vector<std::string> names_of_robots() {
  std::vector<std::string> names;
  for (const Entry& entry : kEntries)
    for (int i = 0; i < std::max(1, entry.count); ++i)
      names.push_back(entry.count == 0 ? entry.name : entry.name + std::to_string(i));
  return names;
}

}  // namespace viewer
