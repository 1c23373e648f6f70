// SPDX-License-Identifier: MIT
// supervisor.h: robots' devices, their firmware's variables, virtual sensors, messages.
#include <cstring>

#include "hal_sim/host/variables.h"
#include "supervisor/asked.h"
#include "supervisor/include/supervisor.h"

using supervisor::asking;
using supervisor::Member;

namespace {

constexpr int kMostBytes = 1 << 20;  // of a message

/// The robot's mind; null, with a message, when there is none of that number.
host::FirmwareMind* mind_of(Member& me, const char* function, int robot) {
  return supervisor::is_robot(me, function, robot) ? &me.team.twin().mind(robot) : nullptr;
}

/// Its processor; null, with a message, when it runs no firmware.
host::Runner* firmware_of(Member& me, const char* function, int robot) {
  host::FirmwareMind* mind = mind_of(me, function, robot);
  if (!mind) return nullptr;
  if (!mind->runner())
    me.refuse(fmt::format("{}: got robot '{}', which runs no firmware, expected one that does", function,
                          me.team.things().name(robot)));
  return mind->runner();
}

const host::Variable* variable_of(Member& me, const char* function, host::Runner& runner,
                                  const char* expression) {
  std::string error;
  const host::Variable* found = runner.find_variable(expression ? expression : "", error);
  if (!found) me.refuse(fmt::format("{}: robot '{}': {}", function, runner.name(), error));
  return found;
}

const host::Variable* scalar_of(Member& me, const char* function, host::Runner& runner,
                                const char* expression) {
  const host::Variable* found = variable_of(me, function, runner, expression);
  if (!found || (found->kind != host::Variable::Kind::Aggregate && found->bytes <= 8)) return found;
  me.refuse(
      fmt::format("{}: robot '{}': got '{}', which has {} bytes, expected a number; name a member or element",
                  function, runner.name(), expression, found->bytes));
  return nullptr;
}

void note(Member& me, int robot, const char* text, const void* bytes, std::size_t size) {
  me.team.simulation().note_intervention(supervisor::digest_of(
      bytes, size, supervisor::digest_of(text, std::strlen(text), static_cast<std::uint64_t>(robot) + 1)));
}

}  // namespace

extern "C" {

int sv_proximity(int robot, int sensor) {
  Member& me = asking();
  host::FirmwareMind* mind = mind_of(me, "sv_proximity", robot);
  if (!mind) return 0;
  if (sensor < 0 || sensor >= board::kRingSensors) {
    me.refuse(fmt::format("sv_proximity: got sensor {}, expected 0 to {}", sensor, board::kRingSensors - 1));
    return 0;
  }
  return mind->proximity_counts(me.team.simulation().scene(), sensor);
}

int64_t sv_left_steps(int robot) {
  const auto* mind = mind_of(asking(), "sv_left_steps", robot);
  return mind ? mind->report().left_steps : 0;
}

int64_t sv_right_steps(int robot) {
  const auto* mind = mind_of(asking(), "sv_right_steps", robot);
  return mind ? mind->report().right_steps : 0;
}

unsigned sv_leds(int robot) {
  const auto* mind = mind_of(asking(), "sv_leds", robot);
  return mind ? mind->report().leds : 0;
}

int sv_selector(int robot) {
  const auto* mind = mind_of(asking(), "sv_selector", robot);
  return mind ? mind->board().selector() : 0;
}

int sv_set_selector(int robot, int position) {
  Member& me = asking();
  host::FirmwareMind* mind = mind_of(me, "sv_set_selector", robot);
  if (!mind || !supervisor::in_range(me, "sv_set_selector", "position", position, 0, 15, "")) return -1;
  mind->board().turn_selector(position);
  if (mind->runner()) mind->runner()->wake();
  note(me, robot, "selector", &position, sizeof position);
  return 0;
}

double sv_battery(int robot) {
  const auto* mind = mind_of(asking(), "sv_battery", robot);
  return mind ? mind->board().battery().voltage(mind->now()) : 0;
}

int sv_set_battery(int robot, double volts) {
  Member& me = asking();
  host::FirmwareMind* mind = mind_of(me, "sv_set_battery", robot);
  if (!mind || !supervisor::in_range(me, "sv_set_battery", "", volts, 3.0, 4.2, "V")) return -1;
  mind->board().set_battery(volts, mind->now());
  if (mind->runner()) mind->runner()->wake();
  note(me, robot, "battery", &volts, sizeof volts);
  return 0;
}

double sv_distance(int robot) {
  Member& me = asking();
  return supervisor::is_robot(me, "sv_distance", robot) ? me.team.simulation().distance_m(robot) : 0;
}

int sv_collisions(int robot) {
  Member& me = asking();
  return supervisor::is_robot(me, "sv_collisions", robot) ? me.team.simulation().touches(robot).collisions
                                                          : 0;
}

double sv_longest_wall_touch(int robot) {
  Member& me = asking();
  return supervisor::is_robot(me, "sv_longest_wall_touch", robot)
             ? me.team.simulation().touches(robot).longest_wall_touch_s
             : 0;
}

double sv_cpu_load(int robot) {
  const host::FirmwareMind* mind = mind_of(asking(), "sv_cpu_load", robot);
  return mind && mind->runner() ? mind->runner()->cpu_load() : 0;
}

int sv_traps(int robot) {
  const host::FirmwareMind* mind = mind_of(asking(), "sv_traps", robot);
  return mind && mind->runner() ? static_cast<int>(mind->runner()->traps().size()) : 0;
}

const char* sv_trap(int robot, int number) {
  Member& me = asking();
  const host::FirmwareMind* mind = mind_of(me, "sv_trap", robot);
  if (!mind || number < 0 || number >= sv_traps(robot)) return "";
  const host::TrapReport& t = mind->runner()->traps()[static_cast<std::size_t>(number)];
  me.text =
      fmt::format("{}: {} at {}, {:.6f} s", host::trap_name(t.kind), t.message, to_string(t.place), t.time_s);
  return me.text.c_str();
}

int sv_restart(int robot) {
  Member& me = asking();
  return supervisor::for_robots(me, "sv_restart", robot, [&](int r) {
    host::Runner* firmware = firmware_of(me, "sv_restart", r);
    if (!firmware) return -1;
    firmware->restart();
    note(me, r, "restart", nullptr, 0);
    me.team.note_reset(r, true);
    return 0;
  });
}

// --- variables

int sv_get_variable(int robot, const char* expression, double* value) {
  Member& me = asking();
  host::Runner* firmware = firmware_of(me, "sv_get_variable", robot);
  const host::Variable* v = firmware ? scalar_of(me, "sv_get_variable", *firmware, expression) : nullptr;
  if (!v) return -1;
  char bytes[8] = {};
  firmware->read_memory(v->address, bytes, v->bytes);
  *value = host::variable_value(*v, bytes);
  return 0;
}

int sv_set_variable(int robot, const char* expression, double value) {
  Member& me = asking();
  host::Runner* firmware = firmware_of(me, "sv_set_variable", robot);
  const host::Variable* v = firmware ? scalar_of(me, "sv_set_variable", *firmware, expression) : nullptr;
  if (!v) return -1;
  char bytes[8] = {};
  firmware->read_memory(v->address, bytes, v->bytes);
  host::set_variable_value(*v, bytes, value);
  firmware->write_memory(v->address, bytes, v->bytes);
  note(me, robot, expression, bytes, v->bytes);
  return 0;
}

int sv_read_variable(int robot, const char* expression, void* to, int size) {
  Member& me = asking();
  host::Runner* firmware = firmware_of(me, "sv_read_variable", robot);
  const host::Variable* v = firmware ? variable_of(me, "sv_read_variable", *firmware, expression) : nullptr;
  if (!v) return -1;
  if (size > 0) firmware->read_memory(v->address, to, std::min(v->bytes, static_cast<std::size_t>(size)));
  return static_cast<int>(v->bytes);
}

int sv_write_variable(int robot, const char* expression, const void* from, int size) {
  Member& me = asking();
  host::Runner* firmware = firmware_of(me, "sv_write_variable", robot);
  const host::Variable* v = firmware ? variable_of(me, "sv_write_variable", *firmware, expression) : nullptr;
  if (!v) return -1;
  if (size < 0 || static_cast<std::size_t>(size) > v->bytes)
    return me.refuse(fmt::format("sv_write_variable: robot '{}': got {} bytes for '{}', expected 0 to {}",
                                 firmware->name(), size, expression, v->bytes));
  firmware->write_memory(v->address, from, static_cast<std::size_t>(size));
  note(me, robot, expression, from, static_cast<std::size_t>(size));
  return 0;
}

// --- virtual sensors, messages

int sv_set_sensor(int robot, const char* name, double value) {
  Member& me = asking();
  if (!name || !*name) return me.refuse("sv_set_sensor: got no name, expected one");
  return supervisor::for_robots(me, "sv_set_sensor", robot, [&](int r) {
    host::FirmwareMind& mind = me.team.twin().mind(r);
    mind.board().virtual_devices().set(name, value);
    if (mind.runner()) mind.runner()->wake();
    note(me, r, name, &value, sizeof value);
    return 0;
  });
}

int sv_listen(int channel) {
  Member& me = asking();
  if (channel < sim::kAllChannels)
    return me.refuse(
        fmt::format("sv_listen: got channel {}, expected 0 or more, or SV_ALL_CHANNELS", channel));
  me.channels.insert(channel);
  return 0;
}

int sv_send(int channel, const void* data, int size) {
  Member& me = asking();
  if (channel < sim::kAllChannels)
    return me.refuse(fmt::format("sv_send: got channel {}, expected 0 or more, or SV_ALL_CHANNELS", channel));
  if (size < 1 || size > kMostBytes)
    return me.refuse(fmt::format("sv_send: got {} bytes, expected 1 to {}", size, kMostBytes));
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  sim::Packet packet;
  packet.channel = channel;
  packet.bytes.assign(bytes, bytes + size);
  packet.at = me.team.simulation().now();
  me.send(std::move(packet));
  note(me, me.team.things().robots() + channel, "send", data, static_cast<std::size_t>(size));
  return 0;
}

int sv_receive(struct sv_message* message) {
  Member& me = asking();
  if (me.inbox_.empty()) return 0;
  me.open_packet = std::move(me.inbox_.front());
  me.inbox_.pop_front();
  const sim::ReceivedPacket& p = me.open_packet;
  *message = {p.channel, p.from_robot, static_cast<int>(p.bytes.size()), p.bytes.data(),
              sim::to_seconds(p.delivered)};
  return 1;
}

int sv_waiting(void) { return static_cast<int>(asking().inbox_.size()); }
}
