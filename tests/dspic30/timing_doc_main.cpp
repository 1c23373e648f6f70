// SPDX-License-Identifier: MIT
// Writes build/chip-timing.md: chip_timing_doc FILE
#include <cstdio>
#include <fstream>

#include "tests/dspic30/timing_cases.h"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: chip_timing_doc FILE\n");
    return 2;
  }
  std::ofstream page(arguments[1]);
  page << timing::document();
  return page.good() ? 0 : 1;
}
