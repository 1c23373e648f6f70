// SPDX-License-Identifier: MIT
// The interrupt controller by itself.
#include "hal_sim/host/interrupts.h"

#include <gtest/gtest.h>

namespace {

using host::Cycle;
using host::InterruptController;

struct Flags : ::testing::Test {
  InterruptController controller;
  void enable(int vector, Cycle due, int priority = 4) {
    auto& source = controller.source(vector);
    source.enabled = true;
    source.priority = priority;
    source.due = due;
    controller.touch();
  }
  void clear(int vector) {
    controller.source(vector).flag = false;
    controller.touch();
  }
};

// DS70143 5.1: natural order decides among equals, whatever rose first
TEST_F(Flags, among_equal_priorities_the_lower_vector_comes_first) {
  enable(22, 100);
  enable(3, 300);
  enable(9, 200);
  controller.raise_due(500);
  for (const int expected : {3, 9, 22}) {
    EXPECT_EQ(controller.select(0, false), expected);
    clear(expected);
  }
  EXPECT_EQ(controller.select(0, false), -1);
}

TEST_F(Flags, a_higher_priority_comes_before_a_lower_vector) {
  enable(3, 100, 4);
  enable(22, 200, 5);
  controller.raise_due(500);
  EXPECT_EQ(controller.select(0, false), 22);
  EXPECT_EQ(controller.select(4, false), 22);
  EXPECT_EQ(controller.select(5, false), -1);
}

TEST_F(Flags, a_flag_knows_when_it_rose_and_the_oldest_waits_longest) {
  enable(3, 300);
  enable(22, 100);
  controller.raise_due(500);
  EXPECT_EQ(controller.source(3).flag_since, 300);
  EXPECT_EQ(controller.source(22).flag_since, 100);
  EXPECT_EQ(controller.longest_waiting(7, false), 22);
  // a flag that is up stays as old as it is; one that was cleared and rises again is young
  controller.source(3).due = 600;
  clear(22);
  controller.source(22).due = 700;
  controller.touch();
  controller.raise_due(800);
  EXPECT_EQ(controller.source(3).flag_since, 300);
  EXPECT_EQ(controller.source(22).flag_since, 700);
  EXPECT_EQ(controller.longest_waiting(7, false), 3);
}

}  // namespace
