// SPDX-License-Identifier: MIT
// CHECK(condition, "sentence"): our own bugs end the program at once, with the place. Never for user's input.
#pragma once
#include <cstdio>
#include <cstdlib>

#define CHECK(condition, sentence)                                                                      \
  do {                                                                                                  \
    if (!(condition)) {                                                                                 \
      std::fprintf(stderr, "twinpuck: internal error at %s:%d: %s (%s)\n", __FILE__, __LINE__, sentence, #condition); \
      std::abort();                                                                                     \
    }                                                                                                   \
  } while (false)
