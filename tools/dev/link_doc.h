// SPDX-License-Identifier: MIT
// The table of the link's records (programs/link/messages.def) as docs/connecting.md has it.
#pragma once
#include <string>

#include "programs/link/packet.h"

namespace dev {

inline std::string link_table() {
  std::string table = "| number | record | from | members | says |\n|---|---|---|---|---|\n";
  std::size_t count = 0;
  const link_row* rows = link_rows(&count);
  for (std::size_t i = 0; i < count; ++i) {
    const link_row& row = rows[i];
    const char* const who = row.who == LINK_FROM_SIMULATOR ? "simulator"
                            : row.who == LINK_FROM_ASKS    ? "program, asks"
                                                           : "program";
    const std::string members = *row.members ? "`" + std::string(row.members) + "` " + row.what : "";
    table += "| " + std::to_string(row.number) + " | `" + row.name + "` | " + who + " | " + members + " | " +
             row.text + " |\n";
  }
  return table;
}

}  // namespace dev
