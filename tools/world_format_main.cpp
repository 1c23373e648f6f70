// SPDX-License-Identifier: MIT
// Prints docs/world-format.md, or writes it to the file named.
#include <cstdio>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"

int main(int argc, char** argv) {
  const std::string page = sim::world_format_page(twin::robot_models(), board::part_kinds());
  std::FILE* out = argc > 1 ? std::fopen(argv[1], "wb") : stdout;
  if (!out) {
    std::perror(argv[1]);
    return 2;
  }
  const bool good = std::fwrite(page.data(), 1, page.size(), out) == page.size() && std::fflush(out) == 0;
  return good ? 0 : 2;
}
