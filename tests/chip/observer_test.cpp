// SPDX-License-Identifier: MIT
// What whoever writes a chip robot's course down is told: handlers, waits as wholes, the chip's changes; and
// that it is not asked at each instruction for that.
#include <vector>

#include "tests/chip/chip_fixture.h"

using namespace chip_test;

namespace {

using host::Cycle;

/// Keeps all that it is told.
struct Course : host::Observer {
  struct Handler {
    int vector;
    Cycle flagged, entry, first, end;
  };
  struct Wait {
    Cycle from, to;
    int depth;
  };
  std::vector<Handler> handlers;
  std::vector<Wait> waits;
  Cycle waiting = 0, latest = 0;  // in the program's waits; of all times
  int looks = 0;
  bool is_in_order = true;

  void come(Cycle at) {
    is_in_order &= at >= latest;
    latest = std::max(latest, at);
  }
  void reached(Cycle at) override {
    ++looks;
    come(at);
  }
  void about_to_change(Cycle at) override {
    ++looks;
    come(at);
  }
  void handler_begins(int vector, Cycle flagged, Cycle entry, Cycle first) override {
    come(entry);
    handlers.push_back({vector, flagged, entry, first, -1});
  }
  void handler_ends(Cycle at) override {
    come(at);
    handlers.back().end = at;
  }
  void callback(std::uintptr_t, Cycle) override {}
  void waited(Cycle from, Cycle to, int depth) override {
    is_in_order &= waits.empty() || to >= waits.back().to;
    // the first rounds of a loop may have been told before
    if (!waits.empty()) from = std::max(from, waits.back().to);
    waits.push_back({from, to, depth});
    waiting += to - from;
  }
  void ended(Cycle at) override { come(at); }
};

class Observers : public ChipTest {
 protected:
  Course& watch(const std::string& program) {
    add_robot(hex(program));
    runner().observe(&course_);
    watches_ = true;
    return course_;
  }
  ~Observers() override {
    if (watches_) runner().observe(nullptr);
  }
  /// Of the waits that were told, and of the one that goes on.
  Cycle waited() {
    const Cycle since =
        std::max(runner().waiting_since(), course_.waits.empty() ? 0 : course_.waits.back().to);
    return course_.waiting + std::max<Cycle>(0, runner().cycles() - since);
  }

 private:
  Course course_;
  bool watches_ = false;
};

// a timer's handler of BCLR (1 cycle) and RETFIE (3) each 1000 cycles. It begins 4 cycles behind the flag, of
// which the entry takes 3; a BRA to itself, of 2, may have a cycle to go
constexpr const char* kTimer =
    "__reset: mov #999, w0\n mov w0, PR1\n bset IEC0, #3\n mov #0x8000, w0\n mov w0, T1CON\n"
    "end: bra end\n"
    "__T1Interrupt: bclr IFS0, #3\n retfie\n";

TEST_F(Observers, see_handlers_at_their_cycles_and_the_wait_between_them_whole) {
  const Course& course = watch(kTimer);
  run_for(0.1);
  // 0.1 s are 52 ticks: 1,497,600 cycles
  ASSERT_EQ(runner().cycles(), 1497600);
  ASSERT_EQ(course.handlers.size(), 1497u);
  EXPECT_TRUE(course.is_in_order);
  for (std::size_t i = 1; i < course.handlers.size(); ++i) {
    const Course::Handler& h = course.handlers[i];
    EXPECT_EQ(h.vector, 3);
    EXPECT_EQ(h.flagged - course.handlers[i - 1].flagged, 1000);
    EXPECT_GE(h.entry, h.flagged + 1);
    EXPECT_LE(h.entry, h.flagged + 2);
    EXPECT_EQ(h.first - h.entry, 3);
    EXPECT_EQ(h.end - h.first, 1 + 3);
  }
  // behind each the loop, one wait up to the next; a look takes two rounds of it
  EXPECT_LE(course.waits.size(), 1497u + 5);
  for (std::size_t i = 100; i < course.waits.size(); ++i) {
    const Course::Wait& wait = course.waits[i];
    EXPECT_EQ(wait.depth, 0);
    EXPECT_GE(wait.to - wait.from, 1000 - 8 - 8);
  }
  EXPECT_EQ(waited(), runner().idle_cycles());
  // flag, entry, BCLR, RETFIE, and the ends of windows, not 750,000 instructions
  EXPECT_LT(course.looks, 8 * 1497);
}

TEST_F(Observers, see_delay_loops_repeated_nops_and_sleep_as_waits) {
  const char* kinds[] = {
      // a delay loop, and what follows it
      "__reset: mov #5000, w2\n1: dec w2, w2\n bra nz, 1b\n inc w3, w3\n bra __reset\n",
      // repeated NOPs, in a loop that is none
      "__reset: repeat #9999\n nop\n btg LATA, #6\n bra __reset\n",
      // Idle, up to a timer
      "__reset: mov #9999, w0\n mov w0, PR1\n bset IEC0, #3\n mov #0x8000, w0\n mov w0, T1CON\n"
      "1: pwrsav #1\n bra 1b\n"
      "__T1Interrupt: bclr IFS0, #3\n retfie\n"};
  for (const char* kind : kinds) {
    SCOPED_TRACE(kind);
    struct One : Observers {
      void TestBody() override {}
      void run(const std::string& program) {
        const Course& course = watch(program);
        run_for(0.1);
        EXPECT_TRUE(course.is_in_order);
        EXPECT_EQ(waited(), runner().idle_cycles());
        EXPECT_GT(waited(), runner().cycles() / 100 * 95);
        EXPECT_LT(course.waits.size(), 2000u);
      }
    } one;
    one.run(kind);
  }
}

TEST_F(Observers, see_a_pin_before_and_after_its_write) {
  struct Pin : Course {
    board::Board* board = nullptr;
    std::vector<std::pair<Cycle, bool>> changes;
    void about_to_change(Cycle at) override {
      Course::about_to_change(at);
      // what was written last is in place, what comes is not
      const bool is_lit = (board->pins().leds(at - 1) & 1) != 0;
      if (changes.empty() || changes.back().second != is_lit) changes.push_back({before, is_lit});
      before = at;
    }
    Cycle before = 0;
  } pin;
  // BTG, two NOPs, BRA: a change each 5 cycles
  add_robot(hex("__reset: bclr TRISA, #6\n1: btg LATA, #6\n nop\n nop\n bra 1b\n"));
  pin.board = &twin().mind(0).board();
  runner().observe(&pin);
  run_for(0.01);
  runner().observe(nullptr);
  ASSERT_GT(pin.changes.size(), 1000u);
  for (std::size_t i = 2; i < 1000; ++i) EXPECT_EQ(pin.changes[i].first - pin.changes[i - 1].first, 5);
}

TEST_F(Observers, are_asked_at_each_instruction_only_if_they_want_it) {
  Course course;
  course.look_every = 1;
  add_robot(hex("__reset: inc w0, w0\n inc w1, w1\n inc w2, w2\n bra __reset\n"));
  runner().observe(&course);
  run_for(0.01);
  runner().observe(nullptr);
  // 3 instructions of a cycle, one of two
  EXPECT_NEAR(course.looks, runner().cycles() * 4 / 5, 100);
}

TEST_F(Observers, see_traps_as_traps) {
  const Course& course = watch(
      "__reset: mov #0x1235, w1\n mov [w1], w2\nend: bra end\n__AddressError: bclr INTCON1, #3\n retfie\n");
  run_for(0.01);
  ASSERT_EQ(course.handlers.size(), 1u);
  EXPECT_EQ(course.handlers[0].vector, host::kTrapVector + 1);
  EXPECT_EQ(course.handlers[0].flagged, -1);
}

}  // namespace
