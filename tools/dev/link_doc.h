// SPDX-License-Identifier: MIT
// The table of the link's records (programs/link/messages.def) as docs/control.md has it.
#pragma once
#include <string>

#include "programs/link/packet.h"

namespace dev {

inline const char* const kTableBegins = "<!-- records: build/twinpuck-dev page control docs/control.md -->\n";
inline const char* const kTableEnds = "<!-- end of the records -->\n";

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

/// The page with this table between its marks; empty: it has none.
inline std::string with_link_table(const std::string& page, const std::string& table) {
  const std::size_t begin = page.find(kTableBegins), end = page.find(kTableEnds);
  if (begin == std::string::npos || end == std::string::npos || end < begin) return "";
  const std::size_t from = begin + std::string(kTableBegins).size();
  return page.substr(0, from) + table + page.substr(end);
}

}  // namespace dev
