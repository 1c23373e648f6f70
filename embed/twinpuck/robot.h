// SPDX-License-Identifier: MIT
// One robot of a world, by name: what can be seen of it from outside, and of its program as
// a debugger sees it.
#pragma once
#include <string>
#include <vector>

#if defined(__GNUC__)
#define TWINPUCK_PUBLIC __attribute__((visibility("default")))
#else
#define TWINPUCK_PUBLIC
#endif

namespace twinpuck {

class World;
struct Opened;  // a world that was opened

/// Where a robot's middle stands.
struct Pose {
  double x_m = 0, y_m = 0;
  double heading_rad = 0;  ///< counter-clockwise from the x axis; not wrapped, so that a full turn shows
};

/// A handle: it is copied freely, and is good as long as its world is, over World::reset(), too.
class TWINPUCK_PUBLIC Robot {
 public:
  std::string name() const;
  Pose pose() const;
  /// Puts it somewhere else, at rest.
  void place(const Pose& pose);

  /// LED 0 to 7 of the ring; 8 the body, 9 the front. Throws for another.
  bool led(int number) const;
  /// What proximity sensor 0 to 7 reads now (counts). Throws for another.
  int proximity(int sensor) const;
  /// Steps that the wheels have made, forwards is positive.
  long long left_steps() const;
  long long right_steps() const;
  /// Way over the floor so far (m).
  double distance_m() const;
  /// Walls, objects and robots that it has touched so far, each touch once.
  int collisions() const;
  /// Turns the selector to 0 to 15. Throws for another.
  void turn_selector(int position);

  /// All that it has sent on UART 1 or 2 since the world began, as bytes. Throws for another port.
  std::string serial(int port = 1) const;
  /// Bytes that come to it from now on, at the line's speed.
  void send(const std::string& bytes, int port = 1);

  /// A number of its program by an expression of C: "counter", "state.speed[1]". Throws when there is none,
  /// or it is no number.
  double variable(const std::string& expression) const;
  /// Changes it, cut to the variable's width.
  void set_variable(const std::string& expression, double value);
  /// Traps and unexpected resets so far, a line each: "MathError: division by zero at drive (main.c:42)".
  std::vector<std::string> traps() const;

 private:
  friend class World;
  Robot(Opened* opened, int index) : opened_(opened), index_(index) {}
  Opened* opened_;
  int index_;
};

}  // namespace twinpuck
