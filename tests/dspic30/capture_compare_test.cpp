// SPDX-License-Identifier: MIT
// Input capture and output compare on timers 2 and 3. Timers start in cycle 0, so TMR = now - 1.
#include "tests/dspic30/bench.h"

namespace {

using bench::Bench;
using bench::Cycle;
using dspic::Port;
namespace irq = dspic::irq;

/// Instants at which RD`bit` changed and its level.
std::vector<std::pair<Cycle, bool>> edges(const Bench& b, int bit, Cycle from) {
  std::vector<std::pair<Cycle, bool>> found;
  bool level = false;
  for (const auto& d : b.outside.driven) {
    if (d.port != Port::D) continue;
    const bool now = (d.levels >> bit & 1) != 0;
    if (now != level && d.at >= from) found.emplace_back(d.at, now);
    level = now;
  }
  return found;
}

// edge 1000, captured in 1001: TMR2 = 1000
TEST(InputCapture, takes_the_timer_at_the_edge) {
  Bench b;
  b.outside.clock({Port::D, 8}, 1000, 500, 200, 10);
  b.write("T2CON", 0x8000, 0);
  b.write("IC1CON", 0x0083, 0);  // rising, timer 2
  EXPECT_EQ(b.flag_rises(irq::Ic1, 1), 1001);
  EXPECT_EQ(b.read("IC1CON", 1002) & 8, 8u);
  EXPECT_EQ(b.read("IC1BUF", 1002), 1000u);
  EXPECT_EQ(b.read("IC1CON", 1003) & 8, 0u);
}

TEST(InputCapture, modes_choose_their_edges) {
  const std::pair<unsigned, Cycle> cases[] = {
      {1, 1000}, {2, 1200}, {3, 1000}, {4, 1000 + 3 * 500}, {5, 1000 + 15 * 500}};
  for (const auto& [mode, edge] : cases) {
    Bench b;
    b.outside.clock({Port::D, 9}, 1000, 500, 200, 20);
    b.write("T3CON", 0x8000, 0);
    b.write("IC2CON", mode, 0);
    EXPECT_EQ(b.flag_rises(irq::Ic2, 1), edge + 1) << mode;
    EXPECT_EQ(b.read("IC2BUF", edge + 2), static_cast<unsigned>(edge)) << mode;
  }
}

// every second edge; one of the mode before counts no longer
TEST(InputCapture, interrupts_are_counted_anew_in_another_mode) {
  Bench b;
  b.outside.clock({Port::D, 8}, 1000, 500, 200, 6);
  b.write("T2CON", 0x8000, 0);
  b.write("IC1CON", 0x0083 | 1 << 5, 0);
  b.chip.run_to(1100);
  b.write("IC1CON", 0x0082 | 1 << 5, 1100);  // falling: 1200, 1700
  EXPECT_EQ(b.flag_rises(irq::Ic1, 1101), 1701);
}

TEST(InputCapture, fifo_holds_four_and_then_overflows) {
  Bench b;
  b.outside.clock({Port::D, 8}, 1000, 500, 200, 6);
  b.write("T2CON", 0x8000, 0);
  b.write("IC1CON", 0x0083 | 3 << 5, 0);  // interrupt after four
  EXPECT_EQ(b.flag_rises(irq::Ic1, 1), 2501);
  b.chip.run_to(4000);
  EXPECT_EQ(b.read("IC1CON", 4000) & 0x18, 0x18u);
  for (unsigned i = 0; i < 4; ++i) EXPECT_EQ(b.read("IC1BUF", 4001), 1000 + 500 * i);
  b.write("IC1CON", 0, 4002);
  EXPECT_EQ(b.read("IC1CON", 4003), 0u);
}

// TMR2 = 300 at cycle 301, pin at 302
TEST(OutputCompare, single_edges_and_toggling) {
  Bench b;
  b.write("PR2", 999, 0);
  b.write("T2CON", 0x8000, 0);
  b.write("OC1R", 300, 0);
  b.write("OC1CON", 1, 0);
  b.write("OC2R", 400, 0);
  b.write("OC2CON", 2, 0);
  b.write("OC3R", 500, 0);
  b.write("OC3CON", 3, 0);
  b.chip.run_to(3000);
  EXPECT_EQ(edges(b, 0, 10), (std::vector<std::pair<Cycle, bool>>{{302, true}}));
  EXPECT_EQ(edges(b, 1, 10), (std::vector<std::pair<Cycle, bool>>{{402, false}}));
  EXPECT_EQ(edges(b, 2, 10), (std::vector<std::pair<Cycle, bool>>{{502, true}, {1502, false}, {2502, true}}));
  EXPECT_TRUE(b.flag(irq::Oc1, 3000) && b.flag(irq::Oc2, 3000) && b.flag(irq::Oc3, 3000));
}

TEST(OutputCompare, pulses_rise_at_r_and_fall_at_rs) {
  for (const unsigned mode : {4u, 5u}) {
    Bench b;
    b.write("PR3", 999, 0);
    b.write("T3CON", 0x8000, 0);
    b.write("OC4R", 100, 0);
    b.write("OC4RS", 250, 0);
    b.write("OC4CON", 0x0008 | mode, 0);
    EXPECT_EQ(b.flag_rises(irq::Oc4, 1), 252);
    b.chip.run_to(2000);
    std::vector<std::pair<Cycle, bool>> expected = {{102, true}, {252, false}};
    if (mode == 5) {
      expected.emplace_back(1102, true);
      expected.emplace_back(1252, false);
    }
    EXPECT_EQ(edges(b, 3, 10), expected);
  }
}

// period 1000: high from the reset to the duty's end; a new duty from the next period on
TEST(OutputCompare, pwm_reloads_its_duty_at_the_period) {
  Bench b;
  b.write("PR2", 999, 0);
  b.write("OC1R", 300, 0);
  b.write("OC1RS", 300, 0);
  b.write("OC1CON", 6, 0);
  b.write("T2CON", 0x8000, 0);
  b.chip.run_to(1100);
  b.write("OC1RS", 600, 1100);
  b.chip.run_to(3000);
  const std::vector<std::pair<Cycle, bool>> expected = {
      {1002, true}, {1302, false}, {2002, true}, {2602, false}};
  EXPECT_EQ(edges(b, 0, 500), expected);
  EXPECT_EQ(b.read("OC1R", 3000), 600u);
  b.write("OC1R", 5, 3001);  // read-only
  EXPECT_EQ(b.read("OC1R", 3002), 600u);
}

TEST(OutputCompare, switching_off_gives_the_pin_back_to_the_port) {
  Bench b;
  b.write("OC1CON", 2, 0);
  EXPECT_EQ(b.outside.driven.back().driven & 1, 1);
  b.write("OC1CON", 0, 10);
  EXPECT_EQ(b.outside.driven.back().driven & 1, 0);
}

TEST(OutputCompare, output_pin_is_an_event_of_the_chip) {
  Bench b;
  b.write("T2CON", 0x8000, 0);
  b.write("OC1R", 300, 0);
  b.write("OC1CON", 1, 0);
  EXPECT_EQ(b.chip.next_event(10), 302);
}

}  // namespace
