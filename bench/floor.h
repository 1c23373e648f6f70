// SPDX-License-Identifier: MIT
// How fast the common workload can be: our laws of motion and light on arrays, and nothing else. No firmware,
// no board, no Box2D, no record. What `make bench` calls the floor.
#pragma once
#include <memory>

#include "sim_core/world/world_desc.h"

namespace bench {

/// Arena, boxes and robots of the world; every robot runs the Braitenberg law of docs/dev/performance.md.
class Floor {
 public:
  explicit Floor(const sim::WorldDesc& world);
  ~Floor();
  /// Runs on to `seconds` after the start.
  void run_until(double seconds);
  /// Sum of all coordinates, m: changes when anything does.
  double checksum() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace bench
