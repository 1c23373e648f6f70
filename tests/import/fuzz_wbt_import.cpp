// SPDX-License-Identifier: MIT
// libFuzzer target: any bytes are either a list of errors or a world that our loader accepts.
// Build: cmake -S . -B build-fuzz -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14
// -DTWINPUCK_FUZZ=ON Run:   build-fuzz/fuzz_wbt_import -max_total_time=600 -dict=tests/import/wbt.dict CORPUS
// tests/import/worlds
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "import/import.h"
#include "sim_core/load/world_loader.h"

namespace {

// parts are known by name only here: the loader of the fuzzer has no board
std::vector<sim::PartKind> parts() {
  sim::PartKind ground;
  ground.name = "ground-sensors";
  return {ground};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wbt::Options options;
  options.file = "fuzz.wbt";
  options.model.name = "puck";
  for (int i = 0; i < 8; ++i) options.model.proximity.push_back({{0.03, 0, 0.03}, 0.785 * i, 0});
  const wbt::Imported made = wbt::import_world({reinterpret_cast<const char*>(data), size}, options);
  if (made.errors.empty() == made.toml.empty()) std::abort();
  for (const wbt::Remark& r : made.report) {
    if (r.text.empty()) std::abort();
  }
  if (!made.errors.empty()) return 0;
  const sim::LoadedWorld loaded =
      sim::parse_world(made.toml, "/nonexistent/fuzz.toml", {options.model}, parts());
  if (!loaded.world) {
    std::fprintf(stderr, "%s\n%s\n", made.toml.c_str(), loaded.report("fuzz.toml").c_str());
    std::abort();
  }
  return 0;
}
