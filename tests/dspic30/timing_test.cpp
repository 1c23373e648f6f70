// SPDX-License-Identifier: MIT
// Every row of build/chip-timing.md (make chip-tables): the models give the cycles of the notes.
#include "tests/dspic30/timing_cases.h"

#include <gtest/gtest.h>

namespace {

TEST(Timing, models_give_the_cycles_of_the_notes) {
  for (const timing::Case& c : timing::cases())
    EXPECT_EQ(c.measure(), c.document) << c.part << ": " << c.what;
}

}  // namespace
