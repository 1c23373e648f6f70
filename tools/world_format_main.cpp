// SPDX-License-Identifier: MIT
// Prints the keys of world files, or writes them into docs/worlds.md: world_format_doc [PAGE]
#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"
#include "tools/doc_part.h"

int main(int argc, char** argv) {
  return tools::write_doc_part(argc, argv, "world keys",
                               sim::world_format_page(twin::robot_models(), board::part_kinds()));
}
