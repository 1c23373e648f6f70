// SPDX-License-Identifier: MIT
// Prints docs/faults.md, or writes it to the file named.
#include <cstdio>

#include "hal_sim/faults/kinds.h"

int main(int argc, char** argv) {
  const std::string page = faults::page();
  std::FILE* out = argc > 1 ? std::fopen(argv[1], "wb") : stdout;
  if (!out) {
    std::perror(argv[1]);
    return 2;
  }
  const bool good = std::fwrite(page.data(), 1, page.size(), out) == page.size() && std::fflush(out) == 0;
  return good ? 0 : 2;
}
