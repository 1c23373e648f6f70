// SPDX-License-Identifier: MIT
// Writes hal_dspic/codec/sound_samples.c: the board's sound bank as C for the chip.
//
//   build/sound_samples hal_dspic/codec/sound_samples.c
#include <cstdio>
#include <fstream>

#include "tests/hal_dspic/sound_samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: sound_samples FILE\n");
    return 2;
  }
  std::ofstream(argv[1], std::ios::binary) << hal_dspic_test::sound_samples_source();
  return 0;
}
