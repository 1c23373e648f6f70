// SPDX-License-Identifier: MIT
// The peer of the benchmark: libenki (Debian's package) in the same scene, with the same controller law.
#pragma once
#include <memory>

#include "sim_core/world/world_desc.h"

namespace bench {

class EnkiSwarm {
 public:
  /// Arena, boxes and robots of the world; every robot runs the Braitenberg law of
  /// docs/dev/performance.md in C++.
  explicit EnkiSwarm(const sim::WorldDesc& world);
  ~EnkiSwarm();
  /// One control period of 64 ms with six physics substeps of 10.7 ms.
  void control_step();

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace bench
