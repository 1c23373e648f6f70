// SPDX-License-Identifier: MIT
// supervisor.h for C++: things as objects, mistakes as exceptions. Units and meanings are those of
// supervisor.h.
//
//   sv::Robot alice("alice");
//   while (sv::step(0.1)) {
//     if (alice.variable("state.mode") == 2) sv::pass("mode 2 after " + std::to_string(sv::time()) + " s");
//   }
#pragma once
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "supervisor.h"

namespace sv {

using Pose = sv_pose;
using Velocity = sv_velocity;
using Lamp = sv_lamp;

/// A call that the world refused; what() is sv_error().
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws when a function of supervisor.h has returned -1.
inline void check(int result) {
  if (result < 0) throw Error(sv_error());
}

/// False: the run is over.
inline bool step(double seconds = 0) { return sv_step(seconds) >= 0; }
inline double time() { return sv_time(); }
inline double random() { return sv_random(); }
inline void pass(const std::string& text = "passed") { sv_end(0, "%s", text.c_str()); }
inline void fail(const std::string& text = "failed") { sv_end(1, "%s", text.c_str()); }
inline void log(const std::string& text) { sv_log("%s", text.c_str()); }

/// A robot or an object.
class Thing {
 public:
  explicit Thing(int number) : number_(number) {}
  /// By `def` or name; throws when there is none.
  explicit Thing(const std::string& name) : number_(sv_find(name.c_str())) {
    if (number_ < 0) throw Error("the world has no robot or object '" + name + "'");
  }
  int number() const { return number_; }
  std::string name() const { return sv_thing_name(number_); }
  Pose pose() const {
    Pose p{};
    check(sv_get_pose(number_, &p));
    return p;
  }
  Velocity velocity() const {
    Velocity v{};
    check(sv_get_velocity(number_, &v));
    return v;
  }
  void put(const Pose& pose) { check(sv_set_pose(number_, &pose)); }
  void set_velocity(const Velocity& velocity) { check(sv_set_velocity(number_, &velocity)); }
  void reset() { check(sv_reset(number_)); }
  void colour(double red, double green, double blue) { check(sv_set_colour(number_, red, green, blue)); }
  void track(double every_s = 0) { check(sv_track(number_, every_s)); }
  double track_length() const { return sv_track_length(number_); }

 protected:
  int number_;
};

class Robot : public Thing {
 public:
  explicit Robot(int number) : Thing(number) { check_kind(); }
  explicit Robot(const std::string& name) : Thing(name) { check_kind(); }
  int proximity(int sensor) const { return sv_proximity(number_, sensor); }
  unsigned leds() const { return sv_leds(number_); }
  int selector() const { return sv_selector(number_); }
  void turn_selector(int position) { check(sv_set_selector(number_, position)); }
  double battery() const { return sv_battery(number_); }
  double distance() const { return sv_distance(number_); }
  int collisions() const { return sv_collisions(number_); }
  int traps() const { return sv_traps(number_); }
  void restart() { check(sv_restart(number_)); }
  double variable(const std::string& expression) const {
    double value = 0;
    check(sv_get_variable(number_, expression.c_str(), &value));
    return value;
  }
  void set_variable(const std::string& expression, double value) {
    check(sv_set_variable(number_, expression.c_str(), value));
  }
  void set_sensor(const std::string& name, double value) {
    check(sv_set_sensor(number_, name.c_str(), value));
  }

 private:
  void check_kind() const {
    if (number_ >= sv_robots()) throw Error("'" + name() + "' is no robot");
  }
};

struct Message {
  int channel = 0;
  int robot = SV_NONE;
  double time = 0;
  std::string bytes;
};

inline void listen(int channel) { check(sv_listen(channel)); }
inline void send(int channel, const std::string& bytes) {
  check(sv_send(channel, bytes.data(), static_cast<int>(bytes.size())));
}
/// The oldest message that is waiting.
inline std::optional<Message> receive() {
  sv_message m{};
  if (sv_receive(&m) != 1) return std::nullopt;
  return Message{m.channel, m.robot, m.time,
                 std::string(static_cast<const char*>(m.data), static_cast<std::size_t>(m.size))};
}

inline void label(int id, const std::string& text, double x, double y, double size = 0.06,
                  std::uint32_t rgb = 0) {
  check(sv_label(id, text.c_str(), x, y, size, rgb, 0));
}
inline void picture(const std::string& file) { check(sv_picture(file.c_str())); }

}  // namespace sv
