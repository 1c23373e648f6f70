// SPDX-License-Identifier: MIT
// The accelerometer's API on whole robots: e_acc (before revision 1.3), the basic variant, names of 2005.
// 1 g = 768 counts, 0 g = 2048. Expectations by hand.
#include <cmath>

#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class Accelerometer : public FirmwareTest {
 protected:
  Robot& quiet(Robot& r) {
    r.settings().variation.motion_noise_scale = 0;
    return r;
  }
  /// A ramp of 20 degrees that rises towards +x; its middle at (2, 0).
  void ramp() {
    sim::RampDesc r;
    r.pose = {2, 0, 0};
    r.size_m = {1, 1};
    r.high_m = std::tan(sim::radians(20));
    world.ramps.push_back(r);
  }
};

const char* const kReadAll = R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
void wait(long num);
int raw[3], calibrated[3], filtered[3], means[3], other, too_many, wrong_axis;
TypeAccRaw xyz;
TypeAccSpheric spheric;
float orientation, inclination, length;
int rounds;
int main(void) {
  int i;
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  wait(20000); /* the fiftieth sample: see the test of the first entry */
  for (i = 0; i < 3; i++) raw[i] = e_get_acc(i);
  e_acc_calibr();
  while (1) {
    for (i = 0; i < 3; i++) {
      calibrated[i] = e_get_acc(i);
      filtered[i] = e_get_acc_filtered(i, 10);
    }
    other = e_get_acc(3);
    too_many = e_get_acc_filtered(0, 51);
    wrong_axis = e_get_acc_filtered(3, 5);
    means[0] = e_read_acc_x();
    means[1] = e_read_acc_y();
    means[2] = e_read_acc_z();
    xyz = e_read_acc_xyz();
    spheric = e_read_acc_spheric();
    orientation = e_read_orientation();
    inclination = e_read_inclination();
    length = e_read_acc();
    e_display_angle();
    rounds++;
  }
}
)";

TEST_F(Accelerometer, at_rest_on_the_level_the_constants_of_the_library) {
  Robot& r = quiet(add_robot_with_source(kReadAll));
  run_for(0.5);
  // before calibration the centres are 0, 0 and 2000
  EXPECT_EQ(r.variables("raw", 3), (std::vector<std::int16_t>{2048, 2048, 2816 - 2000}));
  EXPECT_EQ(r.variables("calibrated", 3), (std::vector<std::int16_t>{0, 0, 768}));
  EXPECT_EQ(r.variables("filtered", 3), (std::vector<std::int16_t>{2048, 2048, 2816}));
  EXPECT_EQ(r.variables("means", 3), (std::vector<std::int16_t>{0, 0, 768}));
  EXPECT_EQ(r.variable("other"), 666);
  EXPECT_EQ(r.variable("too_many"), 0);
  EXPECT_EQ(r.variable("wrong_axis"), 0);
  EXPECT_FLOAT_EQ(r.variable<float>("length"), 768);
  EXPECT_NEAR(r.variable<float>("inclination"), 0, 0.01);
  EXPECT_EQ(r.variable<float>("orientation"), 0);
  EXPECT_EQ(r.leds() & 0xFF, 0u) << "nothing has tilted yet";
  expect_no_traps();
}

TEST_F(Accelerometer, calibrating_at_once_takes_in_the_entry_that_is_still_empty) {
  // e_init_ad_scan() returns at the 49th sample; entry 0 is filled by the 50th. The mean of 50 is 49 / 50 of
  // 2048, 2007.04, and of 2816, 2759.68
  Robot& r = quiet(add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
int x, y, z;
int main(void) {
  e_init_ad_scan(ALL_ADC);
  e_acc_calibr();
  x = e_get_acc(0);
  y = e_get_acc(1);
  z = e_get_acc(2);
  while (1);
}
)"));
  run_for(0.3);
  EXPECT_EQ(r.variable("x"), 2048 - 2007);
  EXPECT_EQ(r.variable("y"), 2048 - 2007);
  EXPECT_EQ(r.variable("z"), 2816 - (2759 - 768));
}

TEST_F(Accelerometer, on_a_ramp_of_20_degrees_as_trigonometry_says) {
  ramp();
  Robot& r = quiet(add_robot_with_source(kReadAll));
  run_for(0.3);
  // 768 sin 20 = 262.67, 768 cos 20 = 721.68
  struct Case {
    double heading_deg;
    int x, y, led;
    double orientation;
  };
  // nose up: its back is lowest; left side low; nose down; right side low
  for (const Case& c : {Case{0, 0, 263, 4, 180}, Case{90, -263, 0, 6, 90}, Case{180, 0, -263, 0, 0},
                        Case{270, 263, 0, 2, 270}}) {
    r.push_to(2, 0, c.heading_deg);
    run_for(0.3);
    EXPECT_EQ(r.variables("calibrated", 3), (std::vector<std::int16_t>{static_cast<std::int16_t>(c.x),
                                                                       static_cast<std::int16_t>(c.y), 722}))
        << c.heading_deg;
    EXPECT_EQ(r.variables("xyz", 3), r.variables("calibrated", 3));
    EXPECT_NEAR(r.variable<float>("inclination"), 20, 0.1);
    EXPECT_NEAR(r.variable<float>("length"), 768, 1);
    EXPECT_NEAR(std::remainder(r.variable<float>("orientation") - c.orientation, 360), 0, 0.2)
        << c.heading_deg;
    EXPECT_EQ(r.leds() & 0xFF, 1u << c.led) << c.heading_deg;
    const std::vector<float> spheric = r.variables<float>("spheric", 3);
    EXPECT_NEAR(spheric[0], 768, 1);
    EXPECT_NEAR(spheric[2], 20, 0.1);
  }
}

TEST_F(Accelerometer, noise_and_offset_are_calibrated_away) {
  Robot& r = add_robot_with_source(kReadAll);
  r.settings().variation.acc_offset_m_s2 = {0.5, -0.5, 0.3};
  run_for(0.5);
  // 0.5 m/s2 are 39 counts; noise of 6 counts a sample
  EXPECT_NEAR(r.variables("raw", 3)[1], 2048 + 39, 25);
  EXPECT_NEAR(r.variables("raw", 3)[0], 2048 - 39, 25);
  EXPECT_NEAR(r.variables("means", 3)[0], 0, 12);
  EXPECT_NEAR(r.variables("means", 3)[2], 768, 12);
}

TEST_F(Accelerometer, a_filter_of_no_samples_divides_by_zero) {
  Robot& r = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
volatile unsigned int size;
int main(void) {
  e_init_ad_scan(ALL_ADC);
  e_get_acc_filtered(0, size);
  while (1);
}
)");
  run_for(0.3);
  ASSERT_GE(r.traps().size(), 1u);
}

// 776 steps/s, of which the library makes 10000 / 12 = 833: 0.1073 m/s
const char* const kCrash = R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
int lowest = 9999, highest = -9999, sideways, samples;
int main(void) {
  int before;
  e_init_port();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  long start;
  for (start = 0; start < 50000; start++);
  e_acc_calibr();
  e_start_agendas_processing();
  e_set_speed_left(776);
  e_set_speed_right(776);
  for (start = 0; start < 200000; start++);
  before = e_get_acc(0);
  while (1) {
    int y = e_get_acc(1), x = e_get_acc(0);
    if (y < lowest) lowest = y;
    if (y > highest) highest = y;
    if (x > sideways) sideways = x;
    if (-x > sideways) sideways = -x;
  }
}
)";

TEST_F(Accelerometer, a_collision_at_10_cm_s_is_felt_backwards) {
  box(0.3, 0, 0.2);  // its face at 0.2; contact when the middle is at 0.163
  Robot& r = quiet(add_robot_with_source(kCrash));
  run_for(3);
  EXPECT_GT(r.collisions(), 0);
  // 0.1073 m/s within 5 ms are 21.5 m/s2, 1680 counts
  EXPECT_LT(r.variable("lowest"), -800);
  EXPECT_GT(r.variable("lowest"), -1800);
  EXPECT_LT(r.variable("highest"), 400);
  EXPECT_LT(r.variable("sideways"), 100);
}

TEST_F(Accelerometer, samples_come_235_times_a_second) {
  Robot& r = quiet(add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
int changes;
int main(void) {
  int last;
  e_init_ad_scan(ALL_ADC);
  last = e_get_acc(1);
  while (1) {
    int now = e_get_acc(1);
    if (now != last) changes++;
    last = now;
  }
}
)"));
  r.settings().variation.motion_noise_scale = 40;  // so that no two samples are alike
  run_for(0.4);
  const int first = r.variable("changes");
  run_for(10);
  // 14745600 / (965 * 65) = 235.08; one in some hundred draws repeats
  // the one before
  EXPECT_NEAR(r.variable("changes") - first, 2340, 22);
  EXPECT_LT(r.cpu_load(), 0.5);
}

TEST_F(Accelerometer, basic_variant_converts_by_itself_and_stops_the_proximity_timer) {
  Robot& r = quiet(add_robot_with_source(R"(
#include <a_d/e_accelerometer.h>
#include <motor_led/e_init_port.h>
int x, y, z;
int main(void) {
  e_init_port();
  e_init_acc();
  while (1) e_get_acc(&x, &y, &z);
}
)"));
  ramp();
  run_for(0.1);
  EXPECT_EQ(r.variable("x"), 2048);
  EXPECT_EQ(r.variable("y"), 2048);
  EXPECT_EQ(r.variable("z"), 2816);
  r.push_to(2, 0, 0);
  run_for(0.1);
  EXPECT_EQ(r.variable("y"), 2048 + 263);
  EXPECT_EQ(r.variable("z"), 2048 + 722);
  expect_no_traps();
}

TEST_F(Accelerometer, names_of_2005) {
  Robot& r = quiet(add_robot_with_source(R"(
void InitPort(void);
void InitAcc(void);
void GetAcc(int *x, int *y, int *z);
int x, y, z;
int main(void) {
  InitPort();
  InitAcc();
  GetAcc(&x, &y, &z);
  while (1);
}
)"));
  run_for(0.1);
  EXPECT_EQ(r.variable("x"), 2048);
  EXPECT_EQ(r.variable("z"), 2816);
  expect_no_traps();
}

// --- the driver's public variables, read by the program itself

TEST_F(Accelerometer, programs_read_the_driver_s_arrays_themselves) {
  ramp();
  Robot& r = quiet(add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
extern int e_acc_scan[3][ACC_SAMP_NB];
extern unsigned int e_last_acc_scan_id, e_last_mic_scan_id;
extern int e_ambient_ir[10], e_ambient_and_reflected_ir[10];
extern unsigned int tickAdcIsr;
int x, y, z, dark, lit, rounds, wraps, ticks;
static int newest(int scan[3][ACC_SAMP_NB], int axis) { return scan[axis][e_last_acc_scan_id]; }
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  while (1) {
    unsigned int last = e_last_acc_scan_id;
    tickAdcIsr = 0;
    while (e_last_acc_scan_id == last);
    x = e_acc_scan[0][e_last_acc_scan_id];
    y = newest(e_acc_scan, 1);
    z = *(e_acc_scan[2] + e_last_acc_scan_id);
    dark = e_ambient_ir[3];
    lit = e_ambient_and_reflected_ir[3];
    while (e_last_mic_scan_id != 0);
    ticks = tickAdcIsr;
    while (e_last_mic_scan_id == 0);
    wraps++;
    rounds++;
  }
}
)"));
  r.settings().pose.x_m = 0;
  box(0, 0.2, 0.1);
  run_for(0.5);
  EXPECT_EQ(r.variable("x"), 2048);
  EXPECT_EQ(r.variable("z"), 2816);
  EXPECT_EQ(r.variable("dark"), 4095);
  EXPECT_LE(r.variable("lit"), 4095);
  // microphones wrap every 100 interrupts of 900 cycles: 163.84 times a second; a round waits for the next
  // accelerometer sample first, at most 65 interrupts, so most rounds take two wraps or one
  const int first = r.variable("rounds");
  run_for(1);
  EXPECT_GT(r.variable("rounds") - first, 80);
  EXPECT_LE(r.variable("rounds") - first, 164);
  EXPECT_GT(r.variable("ticks"), 0);
  EXPECT_LE(r.variable("ticks"), 166);
  EXPECT_LT(r.cpu_load(), 0.25) << "both loops wait, from interrupt to interrupt";
  r.push_to(2, 0, 0);
  run_for(0.2);
  EXPECT_EQ(r.variable("y"), 2048 + 263);
  expect_no_traps();
}

TEST_F(Accelerometer, a_counter_that_the_program_clears_counts_from_there) {
  Robot& r = add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_ad_conv.h>
extern unsigned int tickAdcIsr;
unsigned int before, after;
int main(void) {
  long i;
  e_init_ad_scan(ALL_ADC);
  tickAdcIsr = 0;
  before = tickAdcIsr;
  while (tickAdcIsr < 1000);
  after = tickAdcIsr;
  while (1);
}
)");
  // e_init_ad_scan() takes 194 ms; 1000 interrupts of 61.035 us follow
  run_for(0.194 + 0.055);
  EXPECT_LE(r.variable("before"), 1);
  EXPECT_EQ(r.variable("after"), 0) << "not yet";
  run_for(0.03);
  EXPECT_EQ(r.variable("after"), 1000);
}

// --- revision 1.3

TEST_F(Accelerometer, revision_1_3_is_found_on_the_bus_and_reads_the_same_scale) {
  ramp();
  Robot& r = quiet(add_robot_with_source(kReadAll));
  r.settings().own["revision"] = "1.3";
  run_for(0.6);
  // 16384 counts become 1024 - 256; the centre of z is cleared by e_init_ad_scan()
  EXPECT_EQ(r.variables("raw", 3), (std::vector<std::int16_t>{0, 0, 768}));
  EXPECT_EQ(r.variables("calibrated", 3), (std::vector<std::int16_t>{0, 0, 768}));
  EXPECT_EQ(r.variables("filtered", 3), (std::vector<std::int16_t>{2048, 2048, 2816}));
  EXPECT_EQ(r.variable("too_many"), 2048) << "filter size is not looked at";
  EXPECT_EQ(r.variable("wrong_axis"), 666);
  r.push_to(2, 0, 0);  // nose up by 20 degrees: 5604 counts forward become 350 - 87
  run_for(0.3);
  EXPECT_EQ(r.variables("calibrated", 3), (std::vector<std::int16_t>{0, 263, 722}));
  r.push_to(2, 0, 90);  // left side down: -5604 become -351 + 88
  run_for(0.3);
  EXPECT_EQ(r.variables("calibrated", 3), (std::vector<std::int16_t>{-263, 0, 722}));
  EXPECT_EQ(r.leds() & 0xFF, 1u << 6);
  expect_no_traps();
}

TEST_F(Accelerometer, revision_1_3_calibrated_on_a_slope_subtracts_the_other_axis_as_the_library_does) {
  ramp();
  Robot& r = quiet(add_robot_with_source(R"(
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/e_init_port.h>
void wait(long num);
int calibrated[2];
int main(void) {
  e_init_port();
  e_init_ad_scan(ALL_ADC);
  wait(300000);
  e_acc_calibr();
  while (1) {
    calibrated[0] = e_get_acc(0);
    calibrated[1] = e_get_acc(1);
  }
}
)"));
  r.settings().own["revision"] = "1.3";
  r.at(2, 0);  // nose up by 20 degrees: 5604 counts forward, none sideways
  run_for(1);
  // the centres are 0 of x and 5348 of y: single axes take the low byte of 0x15E4 as signed, too. -5348
  // become -335 + 84
  EXPECT_EQ(r.variables("calibrated", 2), (std::vector<std::int16_t>{-251, 263}));
}

const char* const kLsm330 = R"(
#include <acc_gyro/e_lsm330.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
int present, acc[3], gyro[3], single[6], temperature, offset[3];
unsigned char raw[6];
unsigned int ticks;
extern signed int gyroOffsetX, gyroOffsetY, gyroOffsetZ;
int main(void) {
  e_init_port();
  e_init_motors();
  present = isEpuckVersion1_3();
  e_start_agendas_processing();
  e_set_speed_left(-500);
  e_set_speed_right(500);
  T1CON = 0; PR1 = 0xFFFF; T1CONbits.TCKPS = 2; T1CONbits.TON = 1;
  temperature = getTemperature();
  while (1) {
    TMR1 = 0;
    getAllAxesAcc(&acc[0], &acc[1], &acc[2]);
    ticks = TMR1;
    getAllAxesAccRaw(raw);
    getAllAxesGyro(&gyro[0], &gyro[1], &gyro[2]);
    single[0] = getXAxisAcc();
    single[1] = getYAxisAcc();
    single[2] = getZAxisAcc();
    single[3] = getXAxisGyro();
    single[4] = getYAxisGyro();
    single[5] = getZAxisGyro();
  }
}
)";

TEST_F(Accelerometer, lsm330_over_the_bus_byte_by_byte) {
  Robot& r = quiet(add_robot_with_source("#include <p30F6014A.h>\n" + std::string(kLsm330)));
  r.settings().own["revision"] = "1.3";
  r.settings().variation.acc_offset_m_s2 = {0, 0.0981, 0};  // 0.01 g: 164 counts, low byte 0xA4
  run_for(1);
  EXPECT_EQ(r.variable("present"), 1);
  EXPECT_EQ(r.variable("temperature"), 25);
  EXPECT_NEAR(r.variables("acc", 3)[1], 164, 1);
  EXPECT_NEAR(r.variables("acc", 3)[2], 16384, 1);
  // 500 steps/s turn the wheels at pi rad/s: 0.0644 m/s on both sides of 53 mm, 2.4303 rad/s to the left;
  // 139.25 deg/s are 15914 counts
  EXPECT_NEAR(r.variables("gyro", 3)[2], 15914, 40);
  EXPECT_NEAR(r.variables("gyro", 3)[0], 0, 2);
  // the single axes take the low byte as signed: 164 becomes 164 - 256
  EXPECT_NEAR(r.variables("single", 6)[1], 164 - 256, 1);
  EXPECT_NEAR(r.variables("single", 6)[2], 16384, 1);
  // 1+9+9+1+9 bits, six bytes of 8+1 bits, stop: 84 bits of 164 cycles, 0.934 ms, and some calls
  const double seconds = r.variable<std::uint16_t>("ticks") * 64 / 14745600.0;
  EXPECT_GT(seconds, 84 * 164 / 14745600.0);
  EXPECT_LT(seconds, 84 * 164 / 14745600.0 * 1.3);
  expect_no_traps();
}

// Registers of both halves as another master reads them, and the gyroscope's bytes, low ones first.
TEST_F(Accelerometer, lsm330_is_set_up_register_by_register) {
  Robot& r = quiet(add_robot_with_source(R"(
#include <acc_gyro/e_lsm330.h>
#include <motor_led/e_init_port.h>
unsigned char bytes[6], present_1_1;
int main(void) {
  e_init_port();
  initAccAndGyro();
  getAllAxesGyroRaw(bytes);
  getAllAxesGyroRaw(bytes);
  present_1_1 = isEpuckVersion1_1();
  while (1);
}
)"));
  r.settings().own["revision"] = "1.3";
  r.settings().variation.gyro_offset_rad_s = {sim::radians(3.5), sim::radians(-7), 0};
  run_for(0.2);
  for (const auto& [number, value] : {std::pair{0x20, 0x9F}, {0x25, 0x50}})
    EXPECT_EQ(bus_register(0, 0x3C, number), value);
  for (const auto& [number, value] : {std::pair{0x20, 0xCF}, {0x21, 0x20}, {0x23, 0x00}})
    EXPECT_EQ(bus_register(0, 0xD4, number), value);
  // 400 is 0x0190, -800 is 0xFCE0
  EXPECT_EQ(r.variables<std::uint8_t>("bytes", 6), (std::vector<std::uint8_t>{0x90, 0x01, 0xE0, 0xFC, 0, 0}));
  EXPECT_EQ(r.variable<std::uint8_t>("present_1_1"), 1) << "the name of before 1.3 for the same flag";
  expect_no_traps();
}

TEST_F(Accelerometer, gyroscope_offsets_are_calibrated_away) {
  Robot& r = quiet(add_robot_with_source(R"(
#include <acc_gyro/e_lsm330.h>
#include <motor_led/e_init_port.h>
int before[3], after[3], dps, dpms;
int main(void) {
  e_init_port();
  getAllAxesGyro(&before[0], &before[1], &before[2]);
  getAllAxesGyro(&before[0], &before[1], &before[2]);
  calibrateGyroscope(10);
  getAllAxesGyro(&after[0], &after[1], &after[2]);
  dps = rawToDps(before[0]) * 100;
  dpms = rawToDpms(before[0]) * 10000;
  while (1);
}
)"));
  r.settings().own["revision"] = "1.3";
  r.settings().variation.gyro_offset_rad_s = {sim::radians(3.5), sim::radians(-7), 0};
  run_for(0.2);
  EXPECT_EQ(r.variables("before", 3), (std::vector<std::int16_t>{400, -800, 0}));  // 8.75 mdps
  EXPECT_EQ(r.variables("after", 3), (std::vector<std::int16_t>{0, 0, 0}));
  EXPECT_NEAR(r.variable("dps"), 350, 1);
  EXPECT_NEAR(r.variable("dpms"), 35, 1);
  expect_no_traps();
}

TEST_F(Accelerometer, older_robots_have_nothing_on_the_bus) {
  Robot& r = add_robot_with_source(R"(
#include <motor_led/e_init_port.h>
int present = 7;
int main(void) { e_init_port(); present = isEpuckVersion1_3(); while (1); }
)");
  run_for(0.1);
  EXPECT_EQ(r.variable("present"), 0);
}

}  // namespace
