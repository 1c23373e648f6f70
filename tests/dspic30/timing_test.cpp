// SPDX-License-Identifier: MIT
// Every row of docs/chip-timing.md: the models give the cycles of the notes, and the page says so.
#include "tests/dspic30/timing_cases.h"
#include "twinpuck_paths.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace {

TEST(Timing, models_give_the_cycles_of_the_notes) {
  for (const timing::Case& c : timing::cases())
    EXPECT_EQ(c.measure(), c.document) << c.part << ": " << c.what;
}

TEST(Timing, page_is_up_to_date) {
  std::ifstream page(std::string(TWINPUCK_SOURCE_DIR) + "/docs/chip-timing.md");
  std::stringstream text;
  text << page.rdbuf();
  EXPECT_EQ(text.str(), timing::document()) << "run build/tests/chip_timing_doc docs/chip-timing.md";
}

}  // namespace
