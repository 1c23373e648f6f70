// SPDX-License-Identifier: MIT
// Programs on the whole chip: loops, interrupts, traps, resets, power saving, self-programming.
#include "tests/dspic30/core_bench.h"

namespace {

using bench::CoreBench;
using bench::Cycle;

TEST(Core, counts_down_and_stops) {
  CoreBench b(R"(
    mov #10, w0        ; 1
    clr w1             ; 1
1:  add w1, w0, w1     ; 1
    dec w0, w0         ; 1
    bra nz, 1b         ; 2, the last one 1
end: bra end)");
  ASSERT_TRUE(b.run_to("end"));
  EXPECT_EQ(b.w(1), 55u);
  EXPECT_EQ(b.cpu->now(), 2 + 2 + 10 * 4 - 1);  // goto at 0 takes 2
}

}  // namespace
