// SPDX-License-Identifier: MIT
// Prints the table of the link's records for docs/control.md, or writes it there, between its two marks.
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>

#include "tools/link_doc.h"

int main(int argc, char** argv) {
  const std::string table = tools::link_table();
  if (argc < 2) {
    std::cout << table;
    return 0;
  }
  std::ifstream in(argv[1]);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string page = tools::with_link_table(text.str(), table);
  if (page.empty()) {
    std::cerr << argv[1] << ": got a page without the marks of the table, expected both\n";
    return 2;
  }
  std::ofstream(argv[1]) << page;
  return 0;
}
