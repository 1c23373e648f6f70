// SPDX-License-Identifier: MIT
// Each kind changes what the program, or the world, gets, and by what its meaning says. A table for each
// subject: a bench with the fault from 1.0 to 2.0 s beside the same bench without it. Expectations by hand.
#include "hal_sim/faults/kinds.h"

#include <cmath>
#include <functional>
#include <set>

#include "tests/faults/looker.h"

namespace {

using faults_test::Bench;

constexpr double kBegins = 1.0, kLooks = 1.9;

/// What is held against each other: the bench with the fault, and the one without, both at kLooks; in between
/// at kBegins both are alike.
struct Row {
  const char* line;  // without its time
  std::function<void(Bench&)> before;
  std::function<void(Bench& with, Bench& without)> expect;
};

// a wall some centimetres before sensors 0 and 7, a robot that stands
void facing_wall(Bench& b) {
  b.wall(0.06, -0.3, 0.06, 0.3);
  b.puck().selector(0);
}
void in_the_open(Bench&) {}

double moved_m(Bench& b) { return std::hypot(b.puck().x_m(), b.puck().y_m()); }

std::vector<Row> of_sensors() {
  return {
      {"sensor_blocked sensor=2", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_LT(without.look("prox", 2), 50);
         EXPECT_GT(with.look("prox", 2), 1000);  // near the top of the sensor's curve
         EXPECT_EQ(with.look("prox", 3), without.look("prox", 3));
         EXPECT_EQ(with.look("ambient", 2), 4095);
       }},
      {"sensor_dead sensor=0", facing_wall,
       [](Bench& with, Bench& without) {
         EXPECT_GT(without.look("prox", 0), 300);
         EXPECT_EQ(with.look("prox", 0), 0);
         EXPECT_EQ(with.look("prox", 7), without.look("prox", 7));
       }},
      {"sensor_dead part=receiver",
       [](Bench& b) {
         facing_wall(b);
         b.world.ambient_w_m2 = 2;
       },
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("ambient", 4), 4095 - 800);  // 400 counts a W/m2
         EXPECT_EQ(with.look("ambient", 4), 4095);
         EXPECT_EQ(with.look("prox", 0), 0);
       }},
      {"sensor_dirty sensor=0 transmits=0.5",
       [](Bench& b) {
         b.wall(0.22, -0.3, 0.22, 0.3);  // the converter does not come to its bottom
         b.world.ambient_w_m2 = 2;
       },
       [](Bench& with, Bench& without) {
         // the flash passes the film twice, light from outside once
         EXPECT_NEAR(with.look("prox", 0), without.look("prox", 0) * 0.25, 2);
         EXPECT_EQ(with.look("ambient", 0), 4095 - 400);
       }},
      {"hot_light sensor=5 w_m2=8", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("ambient", 5), 4095);
         EXPECT_EQ(with.look("ambient", 5), 4095 - 3200);
         EXPECT_EQ(with.look("ambient", 4), 4095);
       }},
  };
}

std::vector<Row> of_wheels() {
  return {
      {"wheel_stuck wheel=left", in_the_open,
       [](Bench& with, Bench& without) {
         // it turns to the left, and its own counter tells it nothing
         EXPECT_NEAR(without.puck().heading_deg(), 0, 0.1);
         EXPECT_GT(with.puck().heading_deg(), 30);
         EXPECT_NEAR(with.look("left_counted"), without.look("left_counted"), 4);
         // 400 steps a second for 0.9 s are missing
         EXPECT_NEAR(without.puck().left_steps() - with.puck().left_steps(), 360, 4);
         EXPECT_NEAR(with.puck().right_steps(), without.puck().right_steps(), 1);
       }},
      {"steps_lost share=0.25", in_the_open,
       [](Bench& with, Bench& without) {
         const auto lost = without.puck().left_steps() - with.puck().left_steps();
         EXPECT_NEAR(static_cast<double>(lost), 90, 45);  // a quarter of 360, falls of four
         EXPECT_EQ(lost % 4, 0);
         EXPECT_NEAR(with.look("left_counted"), without.look("left_counted"), 4);
       }},
      {"wheel_slip share=0.5", in_the_open,
       [](Bench& with, Bench& without) {
         // 400 steps/s are 51.5 mm/s of a wheel of 41 mm: half of 0.9 s is missing
         EXPECT_NEAR(moved_m(without) - moved_m(with), 0.5 * 0.9 * 400 * 0.1288e-3, 0.002);
         EXPECT_EQ(with.puck().left_steps(), without.puck().left_steps());
       }},
  };
}

std::vector<Row> of_lines() {
  return {
      {"bytes_lost share=1 direction=rx", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("received"), 20);
         EXPECT_EQ(with.look("received"), 0);
         EXPECT_GT(with.puck().uart(1).text().size(), 1000u);
       }},
      {"bytes_garbled share=1 direction=rx", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(with.look("received"), 20);
         const auto was = without.puck().variables<std::uint8_t>("heard", 20);
         const auto is = with.puck().variables<std::uint8_t>("heard", 20);
         for (std::size_t i = 0; i < is.size(); ++i)
           EXPECT_EQ(__builtin_popcount(static_cast<unsigned>(was[i] ^ is[i])), 1) << i;
       }},
      {"line_cut direction=tx", in_the_open,
       [](Bench& with, Bench& without) {
         const std::string before = without.puck().uart(1).text(), after = with.puck().uart(1).text();
         EXPECT_NEAR(static_cast<double>(after.size()) / static_cast<double>(before.size()), 1.0 / 1.9, 0.1);
         EXPECT_EQ(with.look("received"), 20);
       }},
  };
}

std::vector<Row> of_body() {
  return {
      {"battery_sag drop_v=0.9", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("battery_good"), 1);
         EXPECT_EQ(with.look("battery_good"), 0);
         EXPECT_NEAR(without.puck().battery_v() - with.puck().battery_v(), 0.9, 1e-3);
       }},
      {"bump impulse_n_s=0.05 direction_deg=90", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_NEAR(without.puck().y_m(), 0, 1e-6);
         EXPECT_GT(with.puck().y_m(), 0.001);
       }},
      {"lifted", facing_wall,
       [](Bench& with, Bench& without) {
         EXPECT_GT(without.look("prox", 0), 300);
         EXPECT_EQ(with.look("prox", 0), 0);
       }},
      {"lifted height_m=0.2", in_the_open,
       [](Bench& with, Bench& without) {
         // its wheels turn in the air
         EXPECT_NEAR(with.puck().x_m(), without.puck().x_m() - 0.9 * 400 * 0.1288e-3, 0.002);
         EXPECT_EQ(with.puck().left_steps(), without.puck().left_steps());
         EXPECT_DOUBLE_EQ(with.twin().simulation().scene().z_m(0), 0.2);
       }},
      {"crystal_slow ppm=100000", in_the_open,
       [](Bench& with, Bench& without) {
         // an agenda of 10 ms comes 100 times a second, and then 90 times
         EXPECT_NEAR(without.look("beats") - with.look("beats"), 9, 1);
         EXPECT_NEAR(static_cast<double>(without.puck().cycles() - with.puck().cycles()),
                     0.1 * 0.9 * 14745600, 40000);
       }},
      {"microphone_silent microphone=1",
       [](Bench& b) {
         sim::SoundDesc tone;
         tone.kind = sim::SoundKind::Tone;
         tone.frequency_hz = 1000;
         tone.level_db = 90;
         tone.position_m = {0.5, 0, 0.035};
         b.world.sounds.push_back(tone);
       },
       [](Bench& with, Bench& without) {
         EXPECT_GT(without.look("loud", 1), 3 * with.look("loud", 1));
         EXPECT_NEAR(with.look("loud", 0), without.look("loud", 0), 20);
       }},
      {"led_dead led=3", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_TRUE(without.puck().led(3));
         EXPECT_FALSE(with.puck().led(3));
       }},
  };
}

std::vector<Row> of_hands() {
  return {
      {"bytes_sent bytes=\"hello\\u00bc\\u0001\"", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(with.look("received"), without.look("received") + 7);
         const auto heard = with.puck().variables<char>("heard", 25);
         EXPECT_NE(std::string(heard.begin(), heard.end()).find("hello\xbc\x01"), std::string::npos);
       }},
      {"key_pressed key=5 hold_s=0.3", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("remote_lows"), 0);
         EXPECT_GT(with.look("remote_lows"), 3);
       }},
      {"selector_turned position=9", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("selector"), 0);
         EXPECT_EQ(with.look("selector"), 9);
       }},
      {"robot_moved to=[1,2,90]", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_NEAR(with.puck().x_m(), 1, 1e-6);
         EXPECT_NEAR(with.puck().y_m(), 2 + 0.9 * 400 * 0.1288e-3, 0.002);
         EXPECT_NEAR(with.puck().distance_m(), without.puck().distance_m(), 0.002);
       }},
  };
}

std::vector<Row> of_chip() {
  return {
      {"pin_forced pin=G7 level=1", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("selector"), 0);
         EXPECT_EQ(with.look("selector"), 2);
       }},
      {"pin_forced pin=A12 level=0", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_TRUE(without.puck().led(3));
         EXPECT_FALSE(with.puck().led(3));
       }},
      {"variable_set variable=goal value=-3", in_the_open,
       [](Bench& with, Bench& without) {
         EXPECT_EQ(without.look("goal"), 7);
         EXPECT_EQ(with.look("goal"), -3);
       }},
      {"reset_pressed", in_the_open,
       [](Bench& with, Bench& without) {
         // its variables are as at the start
         EXPECT_GT(without.look("beats"), with.look("beats") + 90);
       }},
  };
}

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows = [] {
    std::vector<Row> joined;
    for (const auto subject : {of_sensors, of_wheels, of_lines, of_body, of_hands, of_chip})
      for (const Row& row : subject()) joined.push_back(row);
    return joined;
  }();
  return kRows;
}

std::string kind_of(const Row& row) {
  const std::string line = row.line;
  return line.substr(0, line.find(' '));
}
bool lasts(const Row& row) { return faults::find_kind(kind_of(row))->lasts; }

class Kinds : public ::testing::TestWithParam<std::size_t> {};

/// Both get 20 bytes behind the fault's beginning.
void run(Bench& b) {
  b.run_for(kBegins + 0.1);
  b.puck().uart(1).send("abcdefghijklmnopqrst");
  b.run_for(kLooks - kBegins - 0.1);
}

TEST_P(Kinds, changes_what_its_meaning_says) {
  const Row& row = rows()[GetParam()];
  Bench with, without;
  row.before(with);
  row.before(without);
  const int id = with.add(std::string(row.line) + " at=1s" + (lasts(row) ? " for=1s" : ""));
  run(with);
  run(without);
  row.expect(with, without);
  const faults::Status s = with.faults().status(id);
  EXPECT_NEAR(s.begun_s, 1.0, 1e-9);
  EXPECT_GE(s.took_effect_s, 1.0) << row.line;
  EXPECT_LT(s.took_effect_s, kLooks) << row.line;
  with.run_for(0.3);
  EXPECT_NEAR(with.faults().status(id).ended_s, lasts(row) ? 2.0 : 1.0, 1e-9);
  EXPECT_TRUE(with.faults().problems().empty()) << with.faults().problems()[0];
  with.expect_no_traps();
}

std::string name_of(const ::testing::TestParamInfo<std::size_t>& info) {
  return std::to_string(info.param) + "_" + kind_of(rows()[info.param]);
}
INSTANTIATE_TEST_SUITE_P(Table, Kinds, ::testing::Range<std::size_t>(0, rows().size()), name_of);

/// Two of a kind: the first from 0.3 to 0.7 s, the second from 0.4 to 0.5 s. What there is to see with the first
/// alone, with both, with the first again, and after both.
struct Pair {
  const char *first, *second;
  std::function<double(Bench&)> look;
  double one, both, none;
};

const board::Damage& damage(Bench& b) { return *b.twin().mind(0).board().damage(); }
const board::WireDamage& to_robot(Bench& b) { return b.twin().mind(0).board().uart(1).damage()->to_robot; }

void expect_joined(const std::vector<Pair>& pairs) {
  Bench b;
  b.puck().settings().variation.clock_ppm = 1000;
  for (const Pair& pair : pairs) {
    b.add(std::string(pair.first) + " at=0.3s for=0.4s");
    b.add(std::string(pair.second) + " at=0.4s for=0.1s");
  }
  for (const auto& [until_s, is_first, is_second] :
       {std::tuple(0.38, true, false), {0.48, true, true}, {0.68, true, false}, {0.88, false, false}}) {
    b.run_for(until_s - b.now_s());
    for (const Pair& pair : pairs) {
      const double expected = is_second ? pair.both : is_first ? pair.one : pair.none;
      EXPECT_NEAR(pair.look(b), expected, 0.05 * std::max(0.2, std::abs(expected)))
          << pair.second << " at " << until_s << " s";
    }
  }
}

TEST(KindsTable, two_of_a_kind_join_and_each_ends_for_itself) {
  expect_joined({
      {"sensor_dirty sensor=2 transmits=0.5", "sensor_dirty transmits=0.4",
       [](Bench& b) { return damage(b).sensors[2].transmits.now(); }, 0.5, 0.2, 1},
      {"hot_light sensor=5 w_m2=8", "hot_light w_m2=2",
       [](Bench& b) { return damage(b).sensors[5].lamp_w_m2.now(); }, 8, 10, 0},
      {"sensor_dead sensor=0", "sensor_dead part=receiver",
       [](Bench& b) {
         return damage(b).sensors[0].emitter_dead.now() + 2 * damage(b).sensors[0].receiver_dead.now();
       },
       1, 3, 0},
      {"sensor_blocked sensor=1 reflects=0 gap_mm=50", "sensor_blocked sensor=3",
       [](Bench& b) { return damage(b).sensors[1].cover.now() < 0 ? -1 : 1; }, 1, 1, -1},
      {"bytes_lost share=0.5", "bytes_lost share=0.2", [](Bench& b) { return to_robot(b).lost.now(); }, 0.5,
       0.6, 0},
      {"bytes_garbled share=0.4", "bytes_garbled share=0.5",
       [](Bench& b) { return to_robot(b).garbled.now(); }, 0.4, 0.7, 0},
      {"line_cut", "line_cut", [](Bench& b) { return to_robot(b).cut.now(); }, 1, 1, 0},
      {"battery_sag drop_v=0.1", "battery_sag drop_v=0.2",
       [](Bench& b) {
         const auto& mind = b.twin().mind(0);
         const auto& cell = mind.board().power().battery();
         return cell.sound_voltage(mind.now()) - cell.voltage(mind.now());
       },
       0.1, 0.3, 0},
      {"microphone_silent microphone=1", "microphone_silent",
       [](Bench& b) { return damage(b).deaf[1].now() + 2 * damage(b).deaf[0].now(); }, 1, 3, 0},
      {"led_dead led=3", "led_dead led=5", [](Bench& b) { return damage(b).dead_leds; }, 8, 40, 0},
      {"pin_forced pin=G7 level=1", "pin_forced pin=G7 level=0",
       [](Bench& b) { return b.puck().pin('G', 7); }, 1, 0, 0},
      // a thousandth faster than the world, less what the faults take
      {"crystal_slow ppm=100000", "crystal_slow ppm=50000",
       [](Bench& b) {
         const auto before = b.puck().cycles();
         b.run_for(5.0 / 512);
         return static_cast<double>(b.puck().cycles() - before) / 144 - 1000;
       },
       1 - 100, 1 - 150, 1},
  });
  expect_joined({
      {"wheel_slip share=0.5", "wheel_slip share=0.4",
       [](Bench& b) { return sim::length(b.twin().simulation().state(0).velocity_m_s) / (400 * 0.1288e-3); },
       0.5, 0.3, 1},
  });
  expect_joined({
      {"lifted height_m=0.1", "lifted height_m=0.3",
       [](Bench& b) { return b.twin().simulation().scene().z_m(0); }, 0.1, 0.3, 0},
      {"wheel_stuck wheel=left", "wheel_stuck",
       [](Bench& b) { return damage(b).steps[0].is_active() + 2 * damage(b).steps[1].is_active(); }, 1, 3, 0},
  });
}

TEST(KindsTable, each_kind_is_tried) {
  std::set<std::string> tried{"camera_covered", "accelerometer_stuck"};  // below
  for (const Row& row : rows()) tried.insert(kind_of(row));
  for (const faults::Kind& kind : faults::kinds()) EXPECT_TRUE(tried.count(kind.name)) << kind.name;
}

TEST(KindsTable, an_accelerometer_that_stands_still_has_one_value) {
  Bench b;
  b.add("accelerometer_stuck at=1s");
  b.run_for(1.2);
  std::set<int> before, after;
  for (int i = 0; i < 20; ++i) {
    b.run_for(0.02);
    after.insert(b.look("acc_z"));
  }
  Bench sound;
  sound.run_for(1.2);
  for (int i = 0; i < 20; ++i) {
    sound.run_for(0.02);
    before.insert(sound.look("acc_z"));
  }
  EXPECT_GT(before.size(), 2u);  // noise
  EXPECT_EQ(after.size(), 1u);
  EXPECT_GE(b.faults().status(0).took_effect_s, 1.0);
}

TEST(KindsTable, a_covered_camera_sees_black) {
  constexpr const char* kFilms = R"(
#include <p30F6014A.h>
#include <camera/fast_2_timer/e_poxxxx.h>
unsigned char line[40 * 2];
long bright;
int pictures;
int main(void) {
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(0, 0, 640, 16, 16, 16, GREY_SCALE_MODE);
  e_poxxxx_write_cam_registers();
  for (;;) {
    int i;
    e_poxxxx_launch_capture((char *)line);
    while (!e_poxxxx_is_img_ready());
    bright = 0;
    for (i = 0; i < 40; ++i) bright += line[i];
    ++pictures;
  }
}
)";
  Bench b(kFilms);
  b.world.ambient_w_m2 = 5;
  b.add("camera_covered at=2s for=1s");
  b.run_for(1.9);
  ASSERT_GT(b.look("pictures"), 2);
  const long before = b.puck().variable<std::int32_t>("bright");
  b.run_for(1.0);
  const long covered = b.puck().variable<std::int32_t>("bright");
  EXPECT_GT(before, 40 * 40);
  EXPECT_LT(covered, before / 4);
  b.run_for(2);
  EXPECT_GT(b.puck().variable<std::int32_t>("bright"), before / 2);
  EXPECT_TRUE(b.faults().problems().empty());
}

// revision 1.3: its accelerometer is on the bus, the battery on the converter
TEST(KindsTable, a_sagging_battery_is_seen_by_the_converter_of_revision_1_3) {
  Bench b;
  b.puck().settings().own["revision"] = "1.3";
  b.add("battery_sag drop_v=0.1 at=0.5s");
  b.run_for(1);
  EXPECT_NEAR(b.faults().status(0).took_effect_s, 0.5, 0.003);
}

}  // namespace
