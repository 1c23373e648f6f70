// SPDX-License-Identifier: MIT
// When faults begin and end, what is told of those that nobody felt, and that runs stay what they are.
#include "tests/faults/looker.h"

namespace {

using faults_test::Bench;

TEST(Injector, a_fault_that_nobody_felt_is_told) {
  constexpr const char* kIdle =
      "#include <p30F6014A.h>\nvolatile int n = 5;\nint main(void) { n = 5; for (;;); }";
  // each of them on a robot that does nothing
  const std::pair<const char*, const char*> kinds[] = {
      {"sensor_blocked", "a sample differed from the one without the cover"},
      {"sensor_dead", "a sample differed from the sound sensor's"},
      {"sensor_dirty", "a sample differed from the clean sensor's"},
      {"hot_light", "a sample differed from the one without the lamp"},
      {"wheel_stuck", "a step was asked for and not made"},
      {"steps_lost", "a step was asked for and not made"},
      {"wheel_slip", "the wheel turned"},
      {"bytes_lost", "a byte that was sent did not arrive"},
      {"bytes_garbled", "a byte that was sent arrived as another"},
      {"line_cut", "a byte that was sent did not arrive"},
      {"battery_sag drop_v=0.1",
       "the low-battery detector, or the count of the battery's voltage (revision 1.3), differed"},
      {"bump impulse_n_s=0", "the body's speed changed"},
      {"crystal_slow ppm=0", "a whole cycle was missing"},
      {"microphone_silent", "a sample differed by a count or more from what was to be heard"},
      {"accelerometer_stuck", "a sample differed, or (revision 1.3) a new one was due"},
      {"led_dead", "the program had it switched on"},
      {"camera_covered", "a line of a picture was exposed"},
      {"bytes_sent bytes=\"hello\"", "the first of them came to a UART that is on"},
      {"selector_turned position=0", "the position changed"},
      {"robot_moved to=[0, 0, 0]", "its place or heading changed"},
      {"pin_forced level=0 pin=G6", "the level differed from the one without the wire"},
      {"variable_set value=5 variable=n", "its bytes changed"},
  };
  for (const auto& [kind, noticed] : kinds) {
    Bench b(kIdle);
    b.add(std::string(kind) + " at=0.1s");  // tick 52 of 1/512 s
    b.run_for(0.5);
    EXPECT_EQ(b.faults().problems(),
              std::vector<std::string>{std::string(kind) +
                                       ": never took effect: it began at 0.102 s, and it was never so that " +
                                       noticed});
  }
}

TEST(Injector, a_fault_that_never_began_is_told) {
  Bench b;
  b.add("wheel_stuck at=5s");
  b.add("wheel_stuck when='x_m > 10'");
  b.run_for(0.5);
  const auto told = b.faults().problems();
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0], "wheel_stuck: never began: the run ended before 5 s");
  EXPECT_EQ(told[1], "wheel_stuck: never began: 'x_m > 10' never held");
}

// looks from outside are no readings of the robot's
TEST(Injector, whoever_looks_from_outside_does_not_count) {
  Bench b("#include <p30F6014A.h>\nint main(void) { for (;;); }");
  b.wall(0.06, -0.3, 0.06, 0.3);
  b.add("sensor_dead sensor=0");
  b.run_for(0.5);
  EXPECT_EQ(b.puck().proximity(0), 0);
  EXPECT_GT(b.puck().proximity(7), 100);
  EXPECT_EQ(b.faults().problems().size(), 1u);
}

TEST(Injector, times_are_ticks_and_conditions_are_looked_at_each_tick) {
  Bench b;
  const int timed = b.add("wheel_stuck at=0.7501s for=0.25s"),
            seen = b.add("led_dead when='x_m > 0.03' for=0.1s");
  b.run_until([&] { return b.puck().x_m() > 0.03; }, 2);
  const double passed_s = b.now_s();
  b.run_for(1);
  // 0.7501 s lie between ticks 384 and 385 of 1/512 s
  EXPECT_DOUBLE_EQ(b.faults().status(timed).begun_s, 385.0 / 512);
  EXPECT_DOUBLE_EQ(b.faults().status(timed).ended_s, (385.0 + 128) / 512);
  EXPECT_DOUBLE_EQ(b.faults().status(seen).begun_s, passed_s);
  EXPECT_NEAR(b.faults().status(seen).ended_s, passed_s + 0.1, 1.0 / 512);
}

// ticks are passed over where nothing is due; faults come at theirs all the same
TEST(Injector, strides_change_nothing) {
  Bench small, large;
  for (Bench* b : {&small, &large}) {
    b->add("wheel_stuck wheel=left at=0.2s for=0.1s");
    b->add("sensor_dirty at=0.4s");
    b->add("bytes_sent bytes=abc at=0.6s");
  }
  small.run_for(1);
  while (large.now_s() < 1) large.faults().advance(sim::from_seconds(1));
  EXPECT_EQ(small.digest(), large.digest());
  for (int id = 0; id < 3; ++id) {
    EXPECT_EQ(small.faults().status(id).begun_s, large.faults().status(id).begun_s);
    EXPECT_EQ(small.faults().status(id).ended_s, large.faults().status(id).ended_s);
  }
}

TEST(Injector, by_hand_one_begins_and_ends_when_one_says_so) {
  Bench b;
  b.run_for(0.5);
  faults::Fault fault;
  fault.kind = "wheel_stuck";
  fault.set("wheel", "left");
  const int id = b.faults().begin(fault);
  const auto steps = b.puck().left_steps();
  b.run_for(0.5);
  EXPECT_EQ(b.puck().left_steps(), steps);
  b.faults().end(id);
  b.run_for(0.5);
  EXPECT_NEAR(static_cast<double>(b.puck().left_steps() - steps), 200, 3);
  const faults::Status s = b.faults().status(id);
  EXPECT_DOUBLE_EQ(s.begun_s, 0.5);
  EXPECT_DOUBLE_EQ(s.ended_s, 1);
  EXPECT_NEAR(s.took_effect_s, 0.5, 0.01);
  // one that waits may be called off
  const int later = b.add("led_dead at=5s");
  b.faults().end(later);
  EXPECT_EQ(b.faults().next(), sim::kEver);
}

TEST(Injector, equal_ones_add_up_and_end_each_by_itself) {
  Bench b;
  b.world.ambient_w_m2 = 4;
  b.add("sensor_dirty sensor=0 transmits=0.5 at=0.5s for=1s");
  b.add("sensor_dirty sensor=0 transmits=0.5 at=1s for=1s");
  b.run_for(0.9);
  EXPECT_EQ(b.look("ambient", 0), 4095 - 800);
  b.run_for(0.5);
  EXPECT_EQ(b.look("ambient", 0), 4095 - 400);
  b.run_for(0.5);
  EXPECT_EQ(b.look("ambient", 0), 4095 - 800);
  b.run_for(0.3);
  EXPECT_EQ(b.look("ambient", 0), 4095 - 1600);
  EXPECT_GE(b.faults().status(1).took_effect_s, 1.0);
}

// the same from run to run, with any number of threads; another seed loses other bytes
TEST(Injector, chance_has_a_seed_and_threads_change_nothing) {
  struct Outcome {
    std::uint64_t digest;
    std::string text;
    double took_effect_s;
  };
  const auto run = [](int threads, std::uint64_t seed) {
    Bench b(faults_test::kLooker, 4);
    b.options.threads = threads;
    b.world.seed = seed;
    b.add("bytes_lost share=0.3");
    b.add("bytes_garbled share=0.1 uart=1");
    b.add("steps_lost share=0.2 at=0.1s");
    b.add("hot_light when='$beats > 20' for=0.2s");
    b.run_for(0.6);
    return Outcome{b.digest(), b.puck(2).uart(1).text(), b.faults().status(2).took_effect_s};
  };
  const Outcome one = run(1, 3), again = run(1, 3), four = run(4, 3), other = run(1, 4);
  EXPECT_EQ(one.digest, again.digest);
  EXPECT_EQ(one.digest, four.digest);
  EXPECT_EQ(one.text, four.text);
  EXPECT_EQ(one.took_effect_s, four.took_effect_s);
  EXPECT_NE(one.digest, other.digest);
  EXPECT_NE(one.text, other.text);
}

TEST(Injector, without_faults_a_run_is_what_it_was) {
  Bench with, without;
  with.faults();
  with.run_for(1);
  without.run_for(1);
  EXPECT_EQ(with.digest(), without.digest());
}

// one that has come and gone, and that a program did not feel, leaves the program as it was
TEST(Injector, a_sensor_is_sound_again_when_the_fault_has_ended) {
  Bench with, without;
  for (Bench* b : {&with, &without}) b->wall(0.08, -0.3, 0.08, 0.3);
  with.add("sensor_dead at=0.2s for=0.2s");
  with.run_for(0.6);
  without.run_for(0.6);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(with.look("prox", i), without.look("prox", i)) << i;
  EXPECT_EQ(with.puck().x_m(), without.puck().x_m());
}

TEST(Injector, what_the_world_has_not_is_told_before_the_run) {
  Bench b;
  const auto says = [&](const char* line, const char* what) {
    EXPECT_EQ(b.added_wrongly(line), what) << line;
  };
  says("wheel_stuck robot=pukc0",
       "robot: got 'pukc0', expected a robot of the world; did you mean 'puck0'?; the robots are puck0");
  says("wheel_stuck when='x_n > 3'",
       "when: got 'x_n', expected a signal; did you mean 'x_m'?; twinpuck list signals names them, $NAME is "
       "a variable of the program");
  says("wheel_stuck when='x_m >'",
       "when: got 'x_m >', expected a condition such as x_m > 0.2 && led0: unexpected end of expression");
  says("variable_set variable=gaol value=1",
       "variable: got 'gaol', expected a variable of the image that is known here");
  says("pin_forced pin=D3",
       "pin: got 'D3', expected an input or an LED's: F1, F6, G6 to G9, A6, A7, A9, A10, A12 to A15, C1, C2");
  says("pin_forced pin=nonsense",
       "pin: got 'nonsense', expected an input or an LED's: F1, F6, G6 to G9, A6, A7, A9, A10, A12 to A15, "
       "C1, C2");
  says("bytes_sent bytes=\"\\u00ff\\u0100\"",
       "bytes: got a character above U+00FF, expected one byte a character");
  faults::Fault fault;
  fault.kind = "sensor_blocked";
  const auto adds = [&] { b.faults().add(fault); };
  fault.set("sensor", 9);
  EXPECT_THROW(adds(), std::runtime_error);
  fault.values.clear();
  fault.set("sensro", 1);
  EXPECT_THROW(adds(), std::runtime_error);
  fault.values.clear();
  fault.at_s = -1;
  EXPECT_THROW(adds(), std::runtime_error);
  fault.at_s = 0;
  fault.kind = "sensor_block";
  EXPECT_THROW(adds(), std::runtime_error);
  EXPECT_TRUE(b.faults().is_empty());
  // all of several, or none
  fault = {};
  fault.kind = "wheel_stuck";
  faults::Fault of_nobody = fault, of_nothing = fault;
  of_nobody.robot = "puck1";
  of_nobody.where = "f.toml:4";
  of_nothing.kind = "wheel_stick";
  try {
    b.faults().add({fault, of_nobody, of_nothing});
    ADD_FAILURE() << "two of them are none";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(
        e.what(),
        "f.toml:4: robot: got 'puck1', expected a robot of the world; did you mean 'puck0'?; the robots "
        "are puck0\nkind: got 'wheel_stick', expected one of twinpuck list faults; did you mean "
        "'wheel_stuck'?");
  }
  EXPECT_TRUE(b.faults().is_empty());
  EXPECT_EQ(b.faults().add({fault, fault}), (std::vector<int>{0, 1}));
}

// a reset of the world is a fresh start for its faults, too
TEST(Injector, faults_begin_again_with_the_world) {
  Bench b;
  b.add("wheel_stuck wheel=left at=0.3s for=0.2s");
  b.add("lifted at=0.6s");
  b.add("crystal_slow at=0.1s");
  b.add("bytes_lost share=0.5");
  b.add("accelerometer_stuck at=0.2s");
  b.add("led_dead when='time_s > 0.7' for=5s");  // of the first stretch, and from the beginning of the others
  b.run_for(0.8);
  double heading_deg[2] = {}, x_m[2] = {};
  for (int stretch = 0; stretch < 2; ++stretch) {
    twin::Twin& t = b.twin();
    const double began_s = b.now_s();
    t.mind(0).runner()->restart();
    t.simulation().move(0, {0, 0, 0});
    t.begin_again(0);
    t.simulation().begin_again();
    b.run_for(0.05);
    EXPECT_LT(b.faults().status(0).begun_s, 0);
    EXPECT_EQ(b.twin().simulation().scene().z_m(0), 0);
    b.run_for(0.75);
    EXPECT_NEAR(b.faults().status(0).begun_s, began_s + 0.3, 1.0 / 512);
    EXPECT_NEAR(b.faults().status(0).ended_s, began_s + 0.5, 2.0 / 512);
    EXPECT_DOUBLE_EQ(b.faults().status(3).begun_s, began_s);
    x_m[stretch] = b.puck().x_m();
    heading_deg[stretch] = b.puck().heading_deg();
  }
  EXPECT_EQ(x_m[0], x_m[1]);
  EXPECT_EQ(heading_deg[0], heading_deg[1]);
  EXPECT_GT(heading_deg[0], 5);
  EXPECT_TRUE(b.faults().problems().empty());
}

}  // namespace
