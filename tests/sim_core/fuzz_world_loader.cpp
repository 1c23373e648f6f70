// SPDX-License-Identifier: MIT
// libFuzzer target: any bytes are either a world that can be built and stepped, or a list of problems.
// Build: cmake -S . -B build-fuzz -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14
// -DTWINPUCK_FUZZ=ON Run:   build-fuzz/fuzz_world_loader -max_total_time=600 CORPUS worlds
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "sim_core/load/world_loader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sim::RobotModel model;
  model.name = "puck";
  for (int i = 0; i < 8; ++i) model.proximity.push_back({{0.03, 0, 0.03}, 0.785 * i, 0});
  const sim::LoadedWorld loaded =
      sim::parse_world({reinterpret_cast<const char*>(data), size}, "/nonexistent/fuzz.toml", {model});
  if (loaded.world.has_value() == !loaded.problems.empty()) std::abort();
  for (const sim::WorldProblem& p : loaded.problems) {
    if (p.text.empty()) std::abort();
  }
  return 0;
}
