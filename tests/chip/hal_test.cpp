// SPDX-License-Identifier: MIT
// One program, two HALs: linked with hal_sim, and as the image that is flashed. After two seconds they stand
// at the same place, have said the same and show the same.
#include <cmath>

#include "hal_sim/chip/chip_runner.h"
#include "hal_sim/drivers/drivers.h"
#include "tests/chip/hal_flight.h"
#include "tests/chip/onlooker.h"

namespace {

using hal_test::Flight;
using hal_test::Onlooker;
using hal_test::world_with;

constexpr double kSamePlaceM = 0.001, kSameLoad = 0.01;

struct Case {
  const char* world;
  const char* firmware;  // empty: the world's
};

// every controller that moves has a world in which it does what it is for
const Case kCases[] = {
    {"braitenberg", ""},
    {"maze", "obstacle"},
    {"maze", "u_obstacle"},
    {"arena", "braiten"},
    {"arena", "braitenberg"},
    {"maze", "braitenberg_2a"},
    {"maze", "braitenberg_2b"},
    {"maze", "braitenberg_3a"},
    {"maze", "braitenberg_3b"},
    {"corridor", ""},
    {"maze", "follow_wall"},
    {"lamp", ""},
    {"arena", "follow_light"},
    {"arena", "square"},
    {"arena", "tilt"},
    {"arena", "blink"},
    {"line", ""},
    {"flock", ""},
    {"arena", "soccer_player"},
    {"arena", "sound_locate"},
    {"arena", "serial_echo"},
    {"arena", "selector_demo"},
    {"arena", "asercom"},
    {"arena", "e-puck"},
    {"arena", "camera_follow"},
};

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  std::string name = std::string(info.param.world) + "_" + info.param.firmware;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

sim::WorldDesc world_of(const Case& c) {
  const std::string file = std::string(TWINPUCK_SOURCE_DIR) + "/worlds/" + c.world + ".toml";
  sim::LoadedWorld loaded = twin::load_world(file);
  EXPECT_TRUE(loaded.world) << loaded.report(file);
  if (!loaded.world) return {};
  if (*c.firmware)
    for (auto& robot : loaded.world->robots) robot.firmware = c.firmware;
  return *loaded.world;
}

class HalTest : public ::testing::TestWithParam<Case> {};

TEST_P(HalTest, two_seconds_are_the_same) {
  const Flight sim(world_of(GetParam()), "sim"), dspic(world_of(GetParam()), "dspic");
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  for (int robot = 0; robot < sim.twin().robots(); ++robot) {
    SCOPED_TRACE(sim.twin().world().robots[static_cast<std::size_t>(robot)].name);
    const sim::Pose2 a = sim.twin().simulation().pose(robot), b = dspic.twin().simulation().pose(robot);
    EXPECT_LT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), kSamePlaceM);
    EXPECT_EQ(sim.text(robot), dspic.text(robot));
    const host::Runner &one = *sim.twin().mind(robot).runner(), &other = *dspic.twin().mind(robot).runner();
    EXPECT_EQ(one.traps().size(), other.traps().size());
    EXPECT_NEAR(one.cpu_load(), other.cpu_load(), kSameLoad);
  }
  EXPECT_EQ(sim.leds().back(), dspic.leds().back());
}

INSTANTIATE_TEST_SUITE_P(Controllers, HalTest, ::testing::ValuesIn(kCases), name_of);

// A callback of two milliseconds loses ticks, and motors that stand behind it in the list step when it returns.
// Where that was taken for in time, the wheels were 11 mm apart.
TEST(HalPlaces, behind_a_long_callback_motors_are_as_late_as_on_the_chip) {
  constexpr double kNearM = 0.0001;
  const char* const kMotors = "e_init_motors();";
  const char* const kCallback = "e_activate_agenda(slow, 100);";
  struct {
    const char *name, *first, *second;
    int speed;
  } const cases[] = {{"callback_first", kMotors, kCallback, 500},  // the newest agenda comes first
                     {"callback_first_fast", kMotors, kCallback, 700},
                     {"motors_first", kCallback, kMotors, 500}};
  for (const auto& c : cases) {
    SCOPED_TRACE(c.name);
    const sim::WorldDesc world = world_with(
        c.name, std::string("#include <motor_led/e_init_port.h>\n"
                            "#include <motor_led/advance_one_timer/e_agenda.h>\n"
                            "#include <motor_led/advance_one_timer/e_motors.h>\n"
                            "volatile int n;\nvoid slow(void) { for (int i = 0; i < 4000; i++) n += i; }\n"
                            "int main(void) {\n  e_init_port();\n  ") +
                    c.first + c.second + "e_start_agendas_processing(); e_set_speed(" +
                    std::to_string(c.speed) + ", 0);\n  for (;;) continue;\n}\n");
    const Flight sim(world, "sim"), dspic(world, "dspic");
    ASSERT_TRUE(sim.is_there() && dspic.is_there());
    const sim::Pose2 a = sim.twin().simulation().pose(0), b = dspic.twin().simulation().pose(0);
    EXPECT_GT(b.x_m, 0.1);
    EXPECT_LT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), kNearM);
  }
}

// in the maze the two part behind 18 s, when a reading that decides between two ways falls otherwise
TEST(HalLong, ten_seconds_of_obstacle_end_at_the_same_place) {
  constexpr double kLong = 10, kNearM = 0.002;
  const Flight sim(world_of({"maze", "obstacle"}), "sim", "", kLong),
      dspic(world_of({"maze", "obstacle"}), "dspic", "", kLong);
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  const sim::Pose2 a = sim.twin().simulation().pose(0), b = dspic.twin().simulation().pose(0);
  EXPECT_LT(std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), kNearM);
  EXPECT_NEAR(sim.twin().mind(0).runner()->cpu_load(), dspic.twin().mind(0).runner()->cpu_load(), kSameLoad);
}

// Three frames go with two ticks, 65 with 63,916 2/3 cycles: as a whole number of cycles that is a third too
// many, 1.6 frames of 299,734
TEST(HalLong, the_converter_makes_as_many_frames) {
  constexpr double kLong = 20;
  const Flight sim(world_of({"maze", "braitenberg"}), "sim", "", kLong),
      dspic(world_of({"maze", "braitenberg"}), "dspic", "", kLong);
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  host::Runner& runner = *sim.twin().mind(0).runner();
  const auto frames =
      static_cast<double>(runner.closed_drivers()->scan().clock().interrupts(runner.cycles()));
  const auto served = static_cast<double>(dynamic_cast<chip::ChipRunner&>(*dspic.twin().mind(0).runner())
                                              .device()
                                              .interrupts()
                                              .served(::dspic::irq::Adc + ::dspic::kFirstIrqVector));
  EXPECT_GT(served, 299'000);
  EXPECT_NEAR(frames, served, 2.5);
}

// --- programs of this test

const char* const kHead = R"(
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
void run_left_motor(void);
void run_right_motor(void);
)";

// Nothing interrupts, so each call takes what it takes: 600 of them, with lists, speeds and
// phases as chance has it
const std::string kCalls = std::string(kHead) + R"(
#define CALLS 600
unsigned int took[CALLS], gave[CALLS], asked[CALLS];
volatile int done;
static void f0(void) {}
static void f1(void) { done = 0; }
static void f2(void) { done = 0; done = 0; }
static void f3(void) { done = 0; done = 0; done = 0; }
static void (*const functions[6])(void) = {f0, f1, f2, f3, run_left_motor, run_right_motor};
static unsigned int seed = 12345;
static unsigned int chance(unsigned int below) { seed = seed * 25173 + 13849; return (seed >> 4) % below; }
static const int speeds[8] = {0, 1, 300, 600, 601, 1000, 1001, 32767};
extern int e_ambient_ir[10], e_ambient_and_reflected_ir[10], hal_free_space[10];
static unsigned int __attribute__((noinline)) call(unsigned int what, void (*function)(void), int number, int other) {
  switch (what) {
    case 0: case 1: case 2: return e_activate_agenda(function, number);
    case 3: return e_destroy_agenda(function);
    case 4: return e_set_agenda_cycle(function, number);
    case 5: return e_reset_agenda(function);
    case 6: return e_pause_agenda(function);
    case 7: return e_restart_agenda(function);
    case 8: e_set_speed_left(number); return 0;
    case 9: e_set_speed_right(number); return 0;
    case 10: e_set_speed(number, other); return 0;
    case 11: return e_get_steps_left();
    case 12: return e_get_steps_right();
    case 13: e_set_steps_left(number); return 0;
    case 14: e_set_steps_right(number); return 0;
    case 15: e_init_motors(); return 0;
    case 16: return e_ad_is_array_filled();
    case 17: return e_ad_is_acquisition_completed();
    case 18: e_end_agendas_processing(); return 0;
    case 19: return e_get_prox(other);
    case 20: return e_get_calibrated_prox(other);
    case 21: return e_get_ambient_light(other);
    default: e_ad_scan_off(); return 0;
  }
}
int main(void) {
  unsigned int i;
  T4CON = 0; PR4 = 0xFFFF; T4CONbits.TON = 1;
  for (i = 0; i < 10; i++) {
    e_ambient_ir[i] = chance(4096);
    e_ambient_and_reflected_ir[i] = chance(4096);
    hal_free_space[i] = chance(2000);
  }
  for (i = 1; i < 4; i++) { /* as far away as they were calibrated */
    e_ambient_and_reflected_ir[i] = e_ambient_ir[i] / 2;
    hal_free_space[i] = e_ambient_ir[i] - e_ambient_and_reflected_ir[i];
  }
  for (i = 0; i < CALLS; i++) {
    unsigned int what = chance(23), begun;
    void (*function)(void) = functions[chance(6)];
    int number = speeds[chance(8)], other = speeds[chance(8)];
    if (chance(2)) number = -number;
    if (chance(2)) other = -other;
    if (what >= 19) other = chance(12) - 1;
    IEC0bits.T2IE = chance(2);
    asked[i] = what;
    begun = TMR4;
    gave[i] = call(what, function, number, other);
    took[i] = TMR4 - begun;
  }
  done = 1;
  for (;;);
}
)";

class HalLevelTest : public ::testing::TestWithParam<const char*> {};

TEST_P(HalLevelTest, calls_take_the_same_cycles_and_give_the_same) {
  constexpr std::size_t kCallsMade = 600;
  const sim::WorldDesc world = world_with("calls", kCalls);
  const Flight sim(world, "sim", GetParam(), 0.5), dspic(world, "dspic", GetParam(), 0.5);
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  ASSERT_EQ(sim.words("done", 1)[0], 1);
  ASSERT_EQ(dspic.words("done", 1)[0], 1);
  EXPECT_EQ(sim.words("gave", kCallsMade), dspic.words("gave", kCallsMade));
  const auto here = sim.words("took", kCallsMade), there = dspic.words("took", kCallsMade),
             asked = sim.words("asked", kCallsMade);
  for (std::size_t i = 0; i < kCallsMade; ++i)
    EXPECT_EQ(here[i], there[i]) << "call " << i << ", kind " << asked[i] << ", gave "
                                 << sim.words("gave", kCallsMade)[i];
}

INSTANTIATE_TEST_SUITE_P(Levels, HalLevelTest, ::testing::Values("-O0", "-O1", "-O2", "-Os"),
                         [](const auto& info) { return std::string(info.param).substr(1); });

// what a program writes over the scan's variables stays until the handler writes there again
const std::string kArrays = std::string(kHead) + R"(
extern int e_mic_scan[3][MIC_SAMP_NB], e_acc_scan[3][ACC_SAMP_NB], e_ambient_ir[10];
extern unsigned int e_last_mic_scan_id, e_last_acc_scan_id, tickAdcIsr;
extern unsigned char updateAccI2CCounter;
int zeros[4], counters[6], sensors[2];
volatile int done;
static int count(const int *values, int many) { int i, n = 0; for (i = 0; i < many; i++) n += values[i] == 0x7654; return n; }
static void fill(int *values, int many) { int i; for (i = 0; i < many; i++) values[i] = 0x7654; }
int main(void) {
  unsigned int index;
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  /* twenty frames after a new one */
  index = e_last_mic_scan_id;
  while (*(volatile unsigned int *)&e_last_mic_scan_id == index);
  fill(e_mic_scan[0], 3 * MIC_SAMP_NB);
  tickAdcIsr = 0;
  while (*(volatile unsigned int *)&tickAdcIsr < 20);
  zeros[0] = count(e_mic_scan[0], 3 * MIC_SAMP_NB);
  /* the counters: from what was written on, as far as they go */
  tickAdcIsr = 65530u;
  updateAccI2CCounter = 60;
  index = e_last_acc_scan_id;
  while (*(volatile unsigned int *)&e_last_acc_scan_id == index);
  while (*(volatile unsigned int *)&e_last_acc_scan_id == (index + 1) % ACC_SAMP_NB);
  counters[0] = tickAdcIsr;
  counters[1] = updateAccI2CCounter;
  updateAccI2CCounter = 0;
  counters[2] = updateAccI2CCounter < 3;
  /* three samples of the accelerometer */
  fill(e_acc_scan[0], 3 * ACC_SAMP_NB);
  index = e_last_acc_scan_id;
  while ((*(volatile unsigned int *)&e_last_acc_scan_id + ACC_SAMP_NB - index) % ACC_SAMP_NB < 3);
  zeros[1] = count(e_acc_scan[0], 3 * ACC_SAMP_NB);
  /* an index that was written is gone on from */
  e_last_acc_scan_id = 7;
  while (*(volatile unsigned int *)&e_last_acc_scan_id == 7);
  counters[3] = e_last_acc_scan_id;
  e_ad_scan_off();
  fill(e_ambient_ir, 10);
  sensors[0] = count(e_ambient_ir, 10);
  e_ad_scan_on();
  for (index = 0; index < 6; index++) { tickAdcIsr = 0; while (*(volatile unsigned int *)&tickAdcIsr < 65); }
  sensors[1] = count(e_ambient_ir, 10);
  done = 1;
  for (;;);
}
)";

TEST(HalArrays, what_is_written_stays_until_the_handler_writes) {
  const sim::WorldDesc world = world_with("arrays", kArrays);
  for (const char* hal : {"sim", "dspic"}) {
    SCOPED_TRACE(hal);
    const Flight flight(world, hal, "-O1", 1);
    ASSERT_TRUE(flight.is_there());
    ASSERT_EQ(flight.words("done", 1)[0], 1);
    const auto zeros = flight.words("zeros", 2), counters = flight.words("counters", 4),
               sensors = flight.words("sensors", 2);
    EXPECT_NEAR(zeros[0], 3 * (100 - 20), 6);  // a frame may come while they are filled
    EXPECT_EQ(static_cast<std::uint16_t>(counters[0]), 65535);
    EXPECT_EQ(counters[1], 64);
    EXPECT_EQ(counters[2], 1);
    EXPECT_EQ(zeros[1], 3 * (50 - 3));
    EXPECT_EQ(counters[3], 8);
    EXPECT_EQ(sensors[0], 10);
    EXPECT_EQ(sensors[1], 2);  // those of the turret
  }
}

// The scan's first fill takes 0.21 s, of which the handlers take a seventh; what they have taken by the reset
// is not lost
TEST(HalReset, a_reset_by_the_program_comes_at_its_true_time) {
  const sim::WorldDesc world = world_with("reset", std::string(kHead) + R"(
int main(void) {
  e_init_port(); e_init_motors(); e_start_agendas_processing(); e_init_ad_scan(ALL_ADC);
  if (RCONbits.POR) { RCONbits.POR = 0; __asm__ volatile("reset"); }
  e_set_led(0, 1);
  while (1);
}
)");
  const Flight sim(world, "sim", "-O1", 0.5), dspic(world, "dspic", "-O1", 0.5);
  ASSERT_TRUE(sim.is_there() && dspic.is_there());
  EXPECT_NEAR(sim.twin().mind(0).runner()->cpu_load(), dspic.twin().mind(0).runner()->cpu_load(), kSameLoad);
  const auto lit = [](const Flight& flight) {
    return std::find_if(flight.leds().begin(), flight.leds().end(), [](auto leds) { return leds != 0; }) -
           flight.leds().begin();
  };
  EXPECT_GT(lit(sim), 100);
  EXPECT_NEAR(static_cast<double>(lit(sim)), static_cast<double>(lit(dspic)), 1);  // ticks
}

// now and then, or at each instruction: the scan's first fill is waited for as long
TEST(HalDigest, is_the_same_whoever_looks) {
  const Case maze{"maze", "obstacle"};
  for (const char* hal : {"sim", "dspic"}) {
    SCOPED_TRACE(hal);
    std::uint64_t digests[5];
    for (int looks = 0; looks < 5; ++looks) {
      Onlooker onlooker;
      if (looks >= 3) onlooker.look_every = looks == 3 ? 1 : 100;
      std::vector<std::string> problems;
      twin::Options options;
      options.hal = hal;
      const auto twin = twin::Twin::open(world_of(maze), options, problems);
      ASSERT_TRUE(twin);
      if (looks >= 2) twin->mind(0).runner()->observe(&onlooker);
      while (sim::to_seconds(twin->simulation().now()) < 1) {
        twin->simulation().step();
        if (looks == 1) {
          std::int16_t word = 0;
          twin->mind(0).runner()->data().read_memory(0x80C, &word, 2);
          twin->mind(0).runner()->diagnoses();
        }
      }
      digests[looks] = twin->mind(0).state_hash();
    }
    for (int looks = 1; looks < 5; ++looks) EXPECT_EQ(digests[0], digests[looks]) << looks;
  }
}

}  // namespace
