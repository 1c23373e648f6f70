// SPDX-License-Identifier: MIT
// Prints the tables of the live view's protocol, or writes them into docs/connecting.md: protocol_doc [PAGE];
// or its types, for the page: protocol_doc --types
#include <cstring>

#include "tools/doc_part.h"
#include "viewer/requests.h"

int main(int argc, char** argv) {
  if (argc == 2 && std::strcmp(argv[1], "--types") == 0) {
    std::cout << viewer::protocol_types() << std::flush;
    return std::cout ? 0 : 2;
  }
  return tools::write_doc_part(argc, argv, "requests", viewer::protocol_tables());
}
