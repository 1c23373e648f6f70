// SPDX-License-Identifier: MIT
// supervisor.h: time, chance, the end of the run; things, lamps and noise. And what programs call without
// knowing: functions of the C library that would end the process or look at the PC's clock.
#include <sys/time.h>

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "sim_core/random/counter_random.h"
#include "supervisor/asked.h"
#include "supervisor/include/supervisor.h"

using supervisor::asking;
using supervisor::Member;

namespace {

constexpr double kFar = 1000;  // m: world files reach no further

std::string formatted(const char* format, va_list arguments) {
  char text[1024];
  std::vsnprintf(text, sizeof text, format, arguments);
  return text;
}

/// Streams of supervisors lie beyond all robots'.
sim::RandomKey key_of(const Member& me, std::uint32_t stream) {
  return {me.team.twin().world().seed, 0xFFFF0000u + static_cast<std::uint32_t>(me.index), stream};
}

bool is_finite(Member& me, const char* function, std::initializer_list<double> values) {
  for (double v : values)
    if (!supervisor::in_range(me, function, "a coordinate of", v, -kFar, kFar, "")) return false;
  return true;
}

const sim::LampDesc* lamp_of(Member& me, const char* function, int lamp) {
  const auto& lamps = me.team.twin().world().lamps;
  if (lamp >= 0 && lamp < static_cast<int>(lamps.size())) return &lamps[static_cast<std::size_t>(lamp)];
  me.refuse(fmt::format("{}: got lamp {}, expected {}", function, lamp,
                        supervisor::count_text("lamps", static_cast<int>(lamps.size()))));
  return nullptr;
}

}  // namespace

extern "C" {

double sv_step(double seconds) { return asking().step(seconds); }
double sv_time(void) { return asking().team.now_s(); }
double sv_tick(void) { return asking().team.simulation().scene().tick_s(); }
double sv_period(void) { return std::max(sv_tick(), asking().period_s); }

int sv_set_period(double seconds) {
  Member& me = asking();
  if (!supervisor::in_range(me, "sv_set_period", "", seconds, 0, 1e7, "s")) return -1;
  me.period_s = seconds;
  return 0;
}

double sv_random(void) {
  Member& me = asking();
  return sim::random_uniform(key_of(me, 0), me.draws++);
}

double sv_random_normal(void) {
  Member& me = asking();
  return sim::random_gaussian(key_of(me, 0), me.draws++);
}

void sv_end(int code, const char* format, ...) {
  Member& me = asking();
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format ? format : "", arguments);
  va_end(arguments);
  me.team.end({true, false, code == 0 ? 0 : 1,
               fmt::format("supervisor '{}', t={:.6f} s: {}{}{}", me.name, me.team.now_s(),
                           code == 0 ? "passed" : "failed", text.empty() ? "" : ": ", text)});
}

void sv_log(const char* format, ...) {
  Member& me = asking();
  va_list arguments;
  va_start(arguments, format);
  const std::string text = formatted(format, arguments);
  va_end(arguments);
  me.team.say(fmt::format("{} {:.3f} s: {}", me.name, me.team.now_s(), text));
}

const char* sv_error(void) { return asking().last_error.c_str(); }
const char* sv_name(void) { return asking().name.c_str(); }
const char* sv_title(void) { return asking().team.twin().world().title.c_str(); }
uint64_t sv_seed(void) { return asking().team.twin().world().seed; }

// --- things

int sv_find(const char* name) { return asking().team.things().find(name ? name : ""); }
int sv_robots(void) { return asking().team.things().robots(); }
int sv_things(void) { return asking().team.things().count(); }

const char* sv_thing_name(int thing) {
  Member& me = asking();
  return supervisor::is_thing(me, "sv_thing_name", thing) ? me.team.things().name(thing).c_str() : "";
}

double sv_height(int thing) {
  Member& me = asking();
  if (!supervisor::is_thing(me, "sv_height", thing)) return 0;
  const sim::Candidate& place = me.team.things().place(thing);
  const sim::Layout& layout = me.team.simulation().scene().layout();
  const sim::Solid& solid =
      *(place.moving ? layout.moving : layout.fixed)[static_cast<std::size_t>(place.index)].solid;
  return solid.z1_m - solid.z0_m;
}

const char* sv_firmware(int robot) {
  Member& me = asking();
  if (!supervisor::is_robot(me, "sv_firmware", robot)) return "";
  return me.team.twin().world().robots[static_cast<std::size_t>(robot)].firmware.c_str();
}

double sv_webots_time_step(void) { return asking().team.twin().world().webots.time_step_s; }
int sv_webots_axes(void) { return asking().team.twin().world().webots.axes == sim::Axes::Nue; }

int sv_is_movable(int thing) {
  Member& me = asking();
  return supervisor::is_thing(me, "sv_is_movable", thing) && me.team.things().body(thing) >= 0;
}

int sv_get_pose(int thing, struct sv_pose* pose) {
  Member& me = asking();
  if (!supervisor::is_thing(me, "sv_get_pose", thing)) return -1;
  const int body = me.team.things().body(thing);
  if (body >= 0) {
    const sim::BodyState& b = me.team.simulation().state(body);
    *pose = {b.pose.x_m, b.pose.y_m, b.z_m, b.pose.heading_rad};
  } else {
    const sim::WorldDesc& world = me.team.twin().world();
    const sim::ObjectDesc& o = world.objects[static_cast<std::size_t>(thing - me.team.things().robots())];
    *pose = {o.pose.x_m, o.pose.y_m, o.z_m, o.pose.heading_rad};
  }
  return 0;
}

int sv_get_velocity(int thing, struct sv_velocity* velocity) {
  Member& me = asking();
  if (!supervisor::is_thing(me, "sv_get_velocity", thing)) return -1;
  *velocity = {};
  const int body = me.team.things().body(thing);
  if (body < 0) return 0;
  const sim::BodyState& b = me.team.simulation().state(body);
  *velocity = {b.velocity_m_s.x, b.velocity_m_s.y, b.climb_m_s, b.spin_rad_s};
  return 0;
}

int sv_set_pose(int thing, const struct sv_pose* pose) {
  Member& me = asking();
  if (!supervisor::is_movable(me, "sv_set_pose", thing) ||
      !is_finite(me, "sv_set_pose", {pose->x, pose->y}) ||
      !supervisor::in_range(me, "sv_set_pose", "heading", pose->heading, -1e9, 1e9, "rad") ||
      !supervisor::in_range(me, "sv_set_pose", "z", pose->z, 0, kFar, "m"))
    return -1;
  me.team.simulation().move(me.team.things().body(thing), {pose->x, pose->y, pose->heading}, pose->z);
  me.team.note_move(thing);
  return 0;
}

int sv_set_velocity(int thing, const struct sv_velocity* v) {
  Member& me = asking();
  if (!supervisor::is_movable(me, "sv_set_velocity", thing) ||
      !is_finite(me, "sv_set_velocity", {v->x, v->y, v->z, v->spin}))
    return -1;
  me.team.simulation().set_velocity(me.team.things().body(thing), {v->x, v->y}, v->spin, v->z);
  return 0;
}

int sv_reset(int thing) {
  Member& me = asking();
  if (!supervisor::is_movable(me, "sv_reset", thing)) return -1;
  const sim::Layout& layout = me.team.simulation().scene().layout();
  const auto body = static_cast<std::size_t>(me.team.things().body(thing));
  me.team.simulation().move(static_cast<int>(body), layout.moving_pose[body], layout.moving[body].z_m);
  me.team.note_move(thing);
  if (me.team.things().is_robot(thing)) me.team.note_reset(thing, false);
  return 0;
}

int sv_set_colour(int thing, double red, double green, double blue) {
  Member& me = asking();
  if (!supervisor::is_thing(me, "sv_set_colour", thing)) return -1;
  for (double part : {red, green, blue})
    if (!supervisor::in_range(me, "sv_set_colour", "a part of", part, 0, 1, "")) return -1;
  me.team.simulation().set_colour(me.team.things().place(thing), {red, green, blue});
  return 0;
}

int sv_get_colour(int thing, double rgb[3]) {
  Member& me = asking();
  if (!supervisor::is_thing(me, "sv_get_colour", thing)) return -1;
  const sim::Colour& c = me.team.simulation().scene().surface(me.team.things().place(thing)).colour;
  rgb[0] = c.r, rgb[1] = c.g, rgb[2] = c.b;
  return 0;
}

// --- settings

int sv_lamps(void) { return static_cast<int>(asking().team.twin().world().lamps.size()); }

int sv_find_lamp(const char* name) {
  const auto& lamps = asking().team.twin().world().lamps;
  for (std::size_t i = 0; i < lamps.size(); ++i)
    if (name && *name && lamps[i].name == name) return static_cast<int>(i);
  return SV_NONE;
}

int sv_get_lamp(int lamp, struct sv_lamp* state) {
  const sim::LampDesc* l = lamp_of(asking(), "sv_get_lamp", lamp);
  if (!l) return -1;
  *state = {l->on, l->intensity_w_m2, l->position_m.x, l->position_m.y, l->position_m.z};
  return 0;
}

int sv_set_lamp(int lamp, const struct sv_lamp* s) {
  Member& me = asking();
  if (!lamp_of(me, "sv_set_lamp", lamp) || !is_finite(me, "sv_set_lamp", {s->x, s->y, s->z}) ||
      !supervisor::in_range(me, "sv_set_lamp", "intensity", s->intensity, 0, 10000, "W/m2"))
    return -1;
  me.team.simulation().set_lamp(lamp, s->on != 0, s->intensity, {s->x, s->y, s->z});
  return 0;
}

int sv_set_proximity_noise(int robot, double scale) {
  Member& me = asking();
  if (!supervisor::in_range(me, "sv_set_proximity_noise", "scale", scale, 0, 1000, "")) return -1;
  return supervisor::for_robots(me, "sv_set_proximity_noise", robot, [&](int r) {
    me.team.simulation().set_proximity_noise(r, scale);
    return 0;
  });
}

int sv_set_wheel_noise(int robot, double n) {
  Member& me = asking();
  if (!supervisor::in_range(me, "sv_set_wheel_noise", "", n, 0, 1, "")) return -1;
  return supervisor::for_robots(me, "sv_set_wheel_noise", robot, [&](int r) {
    me.team.simulation().set_wheel_noise(r, n);
    return 0;
  });
}

// --- instead of the C library's (the programs are linked with --wrap)

[[noreturn]] void __wrap_exit(int status) { supervisor::Program::exit(status); }
[[noreturn]] void __wrap__exit(int status) { supervisor::Program::exit(status); }
[[noreturn]] void __wrap__Exit(int status) { supervisor::Program::exit(status); }
[[noreturn]] void __wrap_quick_exit(int status) { supervisor::Program::exit(status); }

// chance comes from the world's seed, whatever a program says about its own
int __wrap_rand(void) { return static_cast<int>(sv_random() * 2147483648.0); }
long __wrap_random(void) { return static_cast<long>(sv_random() * 2147483648.0); }
double __wrap_drand48(void) { return sv_random(); }
void __wrap_srand(unsigned) {}
void __wrap_srandom(unsigned) {}
void __wrap_srand48(long) {}

// clocks show simulated time
time_t __wrap_time(time_t* to) {
  const auto now = static_cast<time_t>(sv_time());
  if (to) *to = now;
  return now;
}
int __wrap_gettimeofday(struct timeval* to, void*) {
  const double now = sv_time();
  to->tv_sec = static_cast<time_t>(now);
  to->tv_usec = static_cast<suseconds_t>((now - std::floor(now)) * 1e6);
  return 0;
}
clock_t __wrap_clock(void) { return static_cast<clock_t>(sv_time() * CLOCKS_PER_SEC); }
}
