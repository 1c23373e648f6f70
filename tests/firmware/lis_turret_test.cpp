// SPDX-License-Identifier: MIT
// The LIS turret, the ultrasonic ranger and the compass through the library's functions, in worlds whose
// distances are known: sound at 343 m/s, 58 us a cm, 65 ms a ranging.
#include <cmath>

#include "hal_sim/board/part.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

constexpr double kFcy = 14745600.0;

class LisTest : public FirmwareTest {
 protected:
  static sim::OwnValue number(double value) {
    sim::OwnValue v;
    v.numbers = {value};
    return v;
  }
  static sim::OwnValue text(const std::string& value) {
    sim::OwnValue v;
    v.text = value;
    return v;
  }
  static void add_part(Robot& r, const std::string& kind, std::map<std::string, sim::OwnValue> values = {}) {
    sim::PartDesc desc;
    desc.kind = kind;
    desc.values = std::move(values);
    r.settings().parts.push_back(desc);
  }
  /// A wall across the robot's way, its near face `x_m` ahead of the origin.
  void wall_at(double x_m) { wall(x_m + 0.005, -1, x_m + 0.005, 1); }
};

const char* const kRanger = R"(
#include <contrib/LIS_sensors_turret/e_devantech.h>
#include <I2C/e_I2C_protocol.h>
int distance, light, version, busy_word, word, done;
unsigned int ranging_ticks, access_ticks;
int main(void) {
  T1CON = 0; PR1 = 0xFFFF; T1CONbits.TCKPS = 3; T1CONbits.TON = 1;   /* 17.4 us */
  e_init_devantech();
  TMR1 = 0;
  distance = e_get_dist_devantech(0xE0);
  ranging_ticks = TMR1;
  light = e_get_light_devantech(0xE0);
  TMR1 = 0;
  version = e_get_sr_devantech(0xE0);
  access_ticks = TMR1;
  e_set_gain_devantech(0xE0, 5);
  e_i2cd_write(0xE0, 0, 82);
  busy_word = e_i2cd_readw(0xE0, 2);   /* 20 ms after the command: nobody answers */
  while (e_i2cd_readb(0xE0, 0) == -1) continue;
  word = e_i2cd_readw(0xE0, 2);
  e_disable_devantech();
  done = 1;
  while (1);
}
)";

// the ranger is 20 mm before the wheels; 0.5 m: 2 * 0.5 / 343 = 2915.45 us, / 58 = 50.3 cm
TEST_F(LisTest, ranger_measures_a_wall_in_cm_and_us) {
  wall_at(0.52);
  Robot& r = add_robot_with_source(kRanger);
  add_part(r, "ultrasonic-ranger", {{"noise", number(0)}});
  run_for(1);
  ASSERT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("distance"), 50);
  EXPECT_EQ(r.variable("word"), 2915);
  EXPECT_EQ(r.variable("busy_word"), -1);
  EXPECT_EQ(r.variable("version"), 10);
  EXPECT_EQ(r.variable("light"), 2);  // darkness
  // 65 ms, and at most two transactions more than it takes; an access ends with a reset: about 8 ms
  EXPECT_NEAR(r.variable<std::uint16_t>("ranging_ticks") * 256 / kFcy, 0.067, 0.002);
  EXPECT_NEAR(r.variable<std::uint16_t>("access_ticks") * 256 / kFcy, 0.0086, 0.001);
  expect_no_traps();
}

TEST_F(LisTest, ranger_sees_nothing_in_an_empty_world_and_light_through_a_signed_char) {
  world.ambient_w_m2 = 0.6;
  Robot& r = add_robot_with_source(kRanger);
  add_part(r, "ultrasonic-ranger", {{"noise", number(0)}});
  run_for(1);
  ASSERT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("distance"), 0);
  // 2 + 0.6 * 246 = 149.6 -> 150 = 0x96, returned as 0xFF96
  EXPECT_EQ(r.variable<std::uint16_t>("light"), 0xFF96);
}

TEST_F(LisTest, srf10_has_no_light_sensor) {
  wall_at(0.32);
  Robot& r = add_robot_with_source(kRanger);
  add_part(r, "ultrasonic-ranger", {{"noise", number(0)}, {"model", text("srf10")}});
  run_for(1);
  EXPECT_EQ(r.variable("distance"), 30);  // 0.3 m: 1749.3 us / 58 = 30.2
  EXPECT_EQ(r.variable<std::uint16_t>("light"), 0xFF80);
}

const char* const kShortRange = R"(
#include <contrib/LIS_sensors_turret/e_devantech.h>
int far_one, near_one, done;
unsigned int ticks;
int main(void) {
  T1CON = 0; PR1 = 0xFFFF; T1CONbits.TCKPS = 3; T1CONbits.TON = 1;
  e_init_devantech();
  e_set_range_devantech(0xE0, 15);      /* 16 * 43 mm = 0.688 m */
  far_one = e_get_dist_devantech(0xE0);
  e_set_range_devantech(0xE0, 24);      /* 25 * 43 mm = 1.075 m */
  TMR1 = 0;
  near_one = e_get_dist_devantech(0xE0);
  ticks = TMR1;
  done = 1;
  while (1);
}
)";

// 1 m away: beyond the first range, within the second; 65 ms * 25 / 256 = 6.3 ms
TEST_F(LisTest, a_smaller_range_is_measured_sooner) {
  wall_at(1.02);
  Robot& r = add_robot_with_source(kShortRange);
  add_part(r, "ultrasonic-ranger", {{"noise", number(0)}});
  run_for(1);
  ASSERT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("far_one"), 0);
  EXPECT_EQ(r.variable("near_one"), 100);  // 5830.9 us / 58 = 100.5
  EXPECT_NEAR(r.variable<std::uint16_t>("ticks") * 256 / kFcy, 0.0083, 0.0012);
}

// a wall turned by 60 degrees mirrors the sound away; by 20 degrees it is seen by a ray of the beam's side
TEST_F(LisTest, a_slanting_wall_is_not_heard) {
  for (const auto& [turn_deg, heard] : {std::pair{60.0, false}, std::pair{20.0, true}}) {
    struct Run : LisTest {
      void TestBody() override {}
      using FirmwareTest::add_robot_with_source;
      using FirmwareTest::run_for;
      using FirmwareTest::wall;
      using LisTest::add_part;
      using LisTest::number;
    } run;
    const double along = sim::radians(90 + turn_deg);
    run.wall(0.52 - std::cos(along), -std::sin(along), 0.52 + std::cos(along), std::sin(along));
    Robot& r = run.add_robot_with_source(kRanger);
    run.add_part(r, "ultrasonic-ranger", {{"noise", run.number(0)}});
    run.run_for(0.2);
    EXPECT_EQ(r.variable("distance") > 0, heard) << turn_deg;
  }
}

const char* const kDelay = R"(
#include <contrib/LIS_sensors_turret/e_devantech.h>
int entered, left;
int main(void) {
  e_init_devantech();
  entered = 1;
  e_get_delay_devantech(0xE0);
  left = 1;
  while (1);
}
)";

TEST_F(LisTest, get_delay_never_ends) {
  wall_at(0.52);
  Robot& r = add_robot_with_source(kDelay);
  add_part(r, "ultrasonic-ranger");
  run_for(3);
  EXPECT_EQ(r.variable("entered"), 1);
  EXPECT_EQ(r.variable("left"), 0);
  expect_no_traps();
}

const char* const kAbsent = R"(
#include <contrib/LIS_sensors_turret/e_devantech.h>
int left;
int main(void) {
  e_init_devantech();
  e_get_dist_devantech(0xE0);
  left = 1;
  while (1);
}
)";

TEST_F(LisTest, an_absent_ranger_is_asked_for_ever) {
  Robot& r = add_robot_with_source(kAbsent);
  run_for(2);
  EXPECT_EQ(r.variable("left"), 0);
  expect_no_traps();
}

const char* const kSensext = R"(
#include <contrib/LIS_sensors_turret/e_sensext.h>
#include <I2C/e_I2C_protocol.h>
#include <motor_led/e_init_port.h>
int parameters[2], answers[4], present, early;
unsigned int range_value[2], compass_value[2];
int done;
int main(void) {
  long i;
  e_init_port();
  e_i2cp_init();
  e_i2cp_enable();
  e_i2cp_write(I2C_ADDR_SENSEXT, 0, 49);
  early = e_i2cp_read(I2C_ADDR_SENSEXT, 0);
  for (i = 0; i < 20000; i++) asm("nop");
  present = e_i2cp_read(I2C_ADDR_SENSEXT, 0);
  parameters[0] = -1;
  answers[0] = e_sensext_process(parameters, range_value);
  parameters[0] = -2;
  answers[1] = e_sensext_process(parameters, compass_value);
  parameters[0] = 32;
  answers[2] = e_sensext_process(parameters, compass_value);
  parameters[0] = -3;
  answers[3] = e_sensext_process(parameters, compass_value);
  done = 1;
  while (1);
}
)";

// heading 30 degrees from east, counter-clockwise: 60 degrees from north, clockwise; 600 tenths, 600 * 256 /
// 3600 = 42
TEST_F(LisTest, sensext_asks_memory_ranger_and_compass) {
  Robot& r = add_robot_with_source(kSensext).at(0, 0, 30);
  box(0.6 * std::cos(sim::radians(30)), 0.6 * std::sin(sim::radians(30)), 0.16, 30);  // face 0.52 m ahead
  add_part(r, "lis-turret");
  add_part(r, "ultrasonic-ranger", {{"noise", number(0)}, {"model", text("srf10")}});
  add_part(r, "compass", {{"noise", number(0)}});
  run_for(1);
  ASSERT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("present"), 49);
  EXPECT_EQ(r.variable("early"), -1);  // 5 ms a write: the memory does not answer meanwhile
  EXPECT_EQ(r.variables("answers", 4), (std::vector<std::int16_t>{1, 1, 0, 0}));
  EXPECT_EQ(r.variables("range_value", 2), (std::vector<std::int16_t>{50, 0x80}));
  EXPECT_EQ(r.variables("compass_value", 2), (std::vector<std::int16_t>{600, 42}));
  expect_no_traps();
}

const char* const kAbsentTurret = R"(
#include <contrib/LIS_sensors_turret/e_sensext.h>
#include <I2C/e_I2C_protocol.h>
int present, done;
int main(void) {
  e_i2cp_init();
  e_i2cp_enable();
  e_i2cp_write(I2C_ADDR_SENSEXT, 0, 49);
  present = e_i2cp_read(I2C_ADDR_SENSEXT, 0);
  done = 1;
  while (1);
}
)";

TEST_F(LisTest, without_a_turret_the_memory_is_not_there) {
  Robot& r = add_robot_with_source(kAbsentTurret);
  run_for(0.2);
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("present"), -1);
}

const char* const kWait = R"(
#include <contrib/LIS_sensors_turret/e_sensext.h>
#include <motor_led/advance_one_timer/e_agenda.h>
int before, waiting, after, done;
int main(void) {
  e_init_sensext();
  e_start_agendas_processing();
  before = e_get_sensext_wait();
  e_start_sensext_wait();
  waiting = e_get_sensext_wait();
  e_set_agenda_cycle(e_stop_sensext_wait, 50);
  while (e_get_sensext_wait());
  after = e_get_sensext_wait();
  done = 1;
  while (1);
}
)";

// 50 agenda ticks of 0.1 ms
TEST_F(LisTest, the_waiting_flag_is_cleared_by_its_agenda) {
  Robot& r = add_robot_with_source(kWait);
  run_for(2 / 512.0);  // 3.9 ms
  EXPECT_EQ(r.variable("waiting"), 1);
  EXPECT_EQ(r.variable("done"), 0);
  run_for(1 / 512.0);  // 5.9 ms
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("before"), 0);
  EXPECT_EQ(r.variable("after"), 0);
}

const char* const kSharp = R"(
#include <contrib/LIS_sensors_turret/e_sharp.h>
int main(void) {
  e_init_sharp();
  e_set_sharp_led(2, 1);
  e_set_sharp_led(5, 1);
  e_set_sharp_led(4, 2);   /* was off */
  e_set_sharp_led(2, 2);   /* was on */
  e_sharp_on();
  while (1);
}
)";

const char* const kSharpOff = R"(
#include <contrib/LIS_sensors_turret/e_sharp.h>
int main(void) {
  e_init_sharp();
  e_set_sharp_led(0, 1);
  e_sharp_led_clear();
  e_sharp_on();
  e_sharp_off();
  while (1);
}
)";

// 12.249 / (cm + 0.622): the data sheet's 0.40 V at 30 cm; the sensor is 30 mm before the wheels
TEST_F(LisTest, sharp_gives_the_data_sheets_voltage_when_its_first_measurement_is_over) {
  wall_at(0.33);
  Robot& r = add_robot_with_source(kSharp);
  add_part(r, "lis-turret");
  run_for(0.01);
  const board::Board& board = twin().mind(0).board();
  EXPECT_EQ(board.inputs().part_v(4, r.cycles()), std::nullopt);
  EXPECT_EQ(board.inputs().part_v(5, r.cycles()), 0.0);  // 10 of 28.7 ms
  EXPECT_EQ(board.parts()[0]->shows(r.cycles()), "LEDs 00011");
  run_for(0.03);
  ASSERT_TRUE(board.inputs().part_v(5, r.cycles()));
  EXPECT_NEAR(*board.inputs().part_v(5, r.cycles()), 0.40, 0.003);
  // 12 bits over 3.3 V: 0.40 V is 496 counts
  EXPECT_NEAR(twin().mind(0).board().convert(5, r.cycles()), 496, 4);
  // 4 cm before the sensor: 2.65 V; what moved is measured anew every 28.7 ms
  r.push_to(0.26, 0, 0);
  run_for(0.06);
  EXPECT_NEAR(*board.inputs().part_v(5, r.cycles()), 2.65, 0.01);
  expect_no_traps();
}

TEST_F(LisTest, sharp_without_supply_gives_nothing) {
  wall_at(0.33);
  Robot& r = add_robot_with_source(kSharpOff);
  add_part(r, "lis-turret");
  run_for(0.1);
  const board::Board& board = twin().mind(0).board();
  EXPECT_EQ(board.inputs().part_v(5, r.cycles()), 0.0);
  EXPECT_EQ(board.parts()[0]->shows(r.cycles()), "LEDs 00000");
  EXPECT_TRUE(r.pin('B', 7));
}

const char* const kSensextSharp = R"(
#include <contrib/LIS_sensors_turret/e_sensext.h>
#include <contrib/LIS_sensors_turret/e_sharp.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
int parameters[2] = {0, 0}, answers[3], ticks[3], done;
unsigned int values[3];
volatile int now;
void count(void) { now++; }
void ask(int pattern) {
  int begin = now;
  parameters[0] = pattern;
  answers[done] = e_sensext_process(parameters, &values[done]);
  ticks[done++] = now - begin;
}
int main(void) {
  e_init_sharp();
  e_init_sensext();
  e_activate_agenda(count, 1);
  e_start_agendas_processing();
  e_init_ad_scan(ALL_ADC);
  ask(5);
  ask(5);
  ask(31);
  while (1);
}
)";

// another pattern: 5 ms without supply, 30 ms with it, in ticks of 0.1 ms; the same again is read at once
TEST_F(LisTest, sensext_shows_a_pattern_and_waits_for_sharp_when_it_is_another) {
  wall_at(0.33);
  Robot& r = add_robot_with_source(kSensextSharp);
  add_part(r, "lis-turret");
  const auto leds = [this, &r] { return twin().mind(0).board().parts()[0]->shows(r.cycles()); };
  run_for(0.22);  // 194 ms until the scan is full
  EXPECT_EQ(r.variable("done"), 0);
  EXPECT_EQ(leds(), "LEDs 10100");
  run_for(0.03);
  EXPECT_EQ(r.variable("done"), 2);
  EXPECT_EQ(leds(), "LEDs 11111");
  run_for(0.03);
  EXPECT_EQ(r.variables("answers", 3), (std::vector<std::int16_t>{1, 1, 1}));
  const auto ticks = r.variables("ticks", 3);
  EXPECT_NEAR(ticks[0], 350, 2);
  EXPECT_NEAR(ticks[1], 0, 1);
  EXPECT_NEAR(ticks[2], 350, 2);
  for (const std::int16_t value : r.variables("values", 3)) EXPECT_NEAR(value, 496, 4);  // 0.40 V
}

}  // namespace
