// SPDX-License-Identifier: MIT
#include "supervisor/webots/shared.h"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace webots {

namespace {

constexpr double kPi = 3.14159265358979323846;

double next_s = 0;

struct Vector {
  double x, y, z;
};

/// Rodrigues' formula: `v` turned about an axis of any length.
Vector turned(const Vector& v, const double r[4]) {
  const double size = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  if (!(size > 0)) return v;
  const Vector k{r[0] / size, r[1] / size, r[2] / size};
  const double c = std::cos(r[3]), s = std::sin(r[3]), d = (k.x * v.x + k.y * v.y + k.z * v.z) * (1 - c);
  return {v.x * c + (k.y * v.z - k.z * v.y) * s + k.x * d, v.y * c + (k.z * v.x - k.x * v.z) * s + k.y * d,
          v.z * c + (k.x * v.y - k.y * v.x) * s + k.z * d};
}

}  // namespace

bool step(int ms) {
  const double span_s = ms > 0 ? ms / 1000.0 : sv_webots_time_step();
  next_s += span_s;
  // steps follow each other exactly, however the world's ticks round them
  double ahead_s = next_s - sv_time();
  if (ahead_s < 1e-9) ahead_s = 1e-9;
  const bool goes_on = sv_step(ahead_s) >= 0;
  fill_receivers();
  refresh_buffers();
  return goes_on;
}

double time_s() { return next_s; }

void warn(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  sv_log("warning: %s", text);
}

Pose pose_of(int thing, bool nue) {
  sv_pose p{};
  sv_get_pose(thing, &p);
  const bool robot = thing < sv_robots();
  const double z = robot ? p.z : p.z + 0.5 * sv_height(thing);
  if (!nue) return {{p.x, p.y, z}, {0, 0, 1, p.heading}};
  // robots look along -z at angle 0, objects keep their x axis
  return {{p.x, z, -p.y}, {0, 1, 0, robot ? p.heading - kPi / 2 : p.heading}};
}

void put(int thing, const Pose& pose, bool nue) {
  const bool robot = thing < sv_robots();
  const double* t = pose.position;
  sv_pose p{t[0], nue ? -t[2] : t[1], nue ? t[1] : t[2], 0};
  const Vector ahead = turned(nue && robot ? Vector{0, 0, -1} : Vector{1, 0, 0}, pose.rotation);
  p.heading = nue ? std::atan2(-ahead.z, ahead.x) : std::atan2(ahead.y, ahead.x);
  if (!robot) p.z -= 0.5 * sv_height(thing);
  if (p.z < 0) p.z = 0;
  sv_set_pose(thing, &p);
}

void rest_all() {
  const sv_velocity none{};
  for (int thing = 0; thing < sv_things(); ++thing)
    if (sv_is_movable(thing)) sv_set_velocity(thing, &none);
}

void reset_all() {
  for (int thing = 0; thing < sv_things(); ++thing)
    if (sv_is_movable(thing)) sv_reset(thing);
  for (int robot = 0; robot < sv_robots(); ++robot)
    if (*sv_firmware(robot)) sv_restart(robot);
}

std::string picture_name(const char* file) {
  std::string name = file ? file : "";
  const std::size_t dot = name.rfind('.');
  const std::string kind = dot == std::string::npos ? "" : name.substr(dot);
  if (kind != ".png" && kind != ".svg") name += ".png";
  return name;
}

}  // namespace webots
