// SPDX-License-Identifier: MIT
// Parts on whole robots: how they get there from a world file, and the ground sensors' numbers.
#include <fstream>
#include <sstream>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/world_file.h"
#include "sim_core/load/schema.h"
#include "tests/support/firmware_test.h"
#include "tools/dev/doc_part.h"
#include "twinpuck_paths.h"

using namespace firmware_test;

namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(std::string(TWINPUCK_SOURCE_DIR "/") + path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(Parts, the_page_in_docs_is_the_one_the_schema_makes) {
  const std::string page = text_of("docs/worlds.md");
  EXPECT_EQ(page, dev::with_doc_part(page, "world keys",
                                     sim::world_format_page(twin::robot_models(), board::part_kinds())))
      << "run build/twinpuck-dev page docs/worlds.md";
}

TEST(Parts, every_kind_has_a_name_of_its_own_and_sensible_defaults) {
  const auto& types = board::part_types();
  for (const board::PartType* type : types) {
    EXPECT_EQ(board::find_part_type(type->kind.name), type) << type->kind.name;
    const board::PartSettings settings(type->kind, {}, 0);
    for (const sim::OwnKey& key : type->kind.keys) {
      if (key.fallback.empty() || key.fallback == "required") continue;
      if (key.type == sim::OwnKeyType::Number || key.type == sim::OwnKeyType::Integer) {
        EXPECT_GE(settings.number(key.key), key.least) << key.key;
        EXPECT_LE(settings.number(key.key), key.most) << key.key;
      }
    }
  }
  EXPECT_EQ(board::find_part_type("toaster"), nullptr);
}

TEST(Parts, two_of_one_address_are_refused) {
  sim::WorldDesc world;
  world.models = twin::robot_models();
  sim::RobotDesc robot;
  robot.name = "puck";
  robot.parts.resize(2);
  robot.parts[0].kind = "ground-sensors";
  robot.parts[1].kind = "compass";
  world.robots.push_back(robot);
  std::vector<std::string> problems;
  EXPECT_EQ(twin::Twin::open(world, {}, problems), nullptr);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0],
            "robot 'puck': part 'compass': got I2C address 0xC0, which another device of this robot has, "
            "expected one "
            "of its own; leave one of them out");
}

class PartTest : public FirmwareTest {
 protected:
  static sim::PartDesc part(const std::string& kind, std::map<std::string, sim::OwnValue> values = {}) {
    sim::PartDesc desc;
    desc.kind = kind;
    desc.values = std::move(values);
    return desc;
  }
  static sim::OwnValue number(double value) {
    sim::OwnValue v;
    v.numbers = {value};
    return v;
  }
};

// five words: left, centre, right, left cliff, right cliff
const char* const kReadGround = R"(
#include <I2C/e_I2C_protocol.h>
#include <motor_led/e_init_port.h>
int words[5], unused, rounds;
static int word(char reg) {
  unsigned int high = (unsigned char)e_i2cp_read(0xC0, reg);
  return high << 8 | (unsigned char)e_i2cp_read(0xC0, reg + 1);
}
int main(void) {
  int i;
  e_init_port();
  e_i2cp_init();
  while (1) {
    e_i2cp_enable();
    for (i = 0; i < 3; i++) words[i] = word(2 * i);
    for (i = 0; i < 2; i++) words[3 + i] = word(13 + 2 * i);
    unused = e_i2cp_read(0xC0, 9);
    e_i2cp_disable();
    rounds++;
  }
}
)";

struct GroundTest : PartTest {
  Robot& reader(double noise) {
    Robot& r = add_robot_with_source(kReadGround);
    r.settings().parts.push_back(part("ground-sensors", {{"noise", number(noise)}}));
    return r;
  }
};

// height 3.3 mm, apparent distance 3.3 / (0.2 + 0.8 red), value 1000 - 700 * apparent / 16 mm, not below 300:
// white 1000 - 700 * 3.3 / 16 = 855.6; red 0.5: 3.3 / 0.6 = 5.5 -> 759.4; black: 16.5 -> 300
TEST_F(GroundTest, plain_floors_read_as_the_published_table_says) {
  const struct {
    double red;
    int counts;
  } kFloors[] = {{1.0, 856}, {0.5, 759}, {0.0, 300}};
  for (const auto& floor : kFloors) {
    board::Board robot{board::Setup{}};
    sim::WorldDesc plain;
    plain.models = world.models;
    plain.robots.resize(1);
    plain.floor.colour = {floor.red, 0.2, 0.9};
    plain.floor.ir_reflectance = -1;
    const sim::Scene scene(plain, {0.1});
    robot.look_at(&scene);
    const board::PartType* type = board::find_part_type("ground-sensors");
    robot.plug_in(type->make(board::PartSettings(type->kind, part("", {{"noise", number(0)}}), 0)));
    board::I2cDevice* device = robot.i2c().find(0xC0);
    ASSERT_NE(device, nullptr);
    for (int word : {0, 2, 4, 13, 15}) {
      device->begin(0xC0, false, 0);
      device->write(static_cast<std::uint8_t>(word), 0);
      device->begin(0xC0, true, 0);
      const int high = device->read(0), low = device->read(0);
      EXPECT_EQ(high * 256 + low, floor.counts) << "register " << word;
    }
  }
}

// an image of two pixels over a 1 m arena: black west, white east; the robot stands on the border, nose
// north: left sensors 10 and 20 mm to the west, right ones to the east; the middle one's spot: 1 point of 5
// west, 4 on or east of the border
TEST_F(GroundTest, the_image_of_the_floor_is_seen_where_each_sensor_is) {
  arena(1, 1);
  world.floor.image_width = 2;
  world.floor.image_height = 1;
  world.floor.image_rgb = {0, 0, 0, 255, 255, 255};
  Robot& r = reader(0).at(0, 0, 90);
  run_for(0.1);
  ASSERT_GE(r.variable("rounds"), 1);
  const auto words = r.variables("words", 5);
  EXPECT_EQ(words[0], 300);
  EXPECT_EQ(words[2], 856);
  EXPECT_EQ(words[3], 300);
  EXPECT_EQ(words[4], 856);
  // reflectance 0.8: 3.3 / 0.84 = 3.93 mm -> 828; on the border rounding may move 3 points: 0.2 -> 599
  EXPECT_GE(words[1], 599);
  EXPECT_LE(words[1], 828);
  EXPECT_EQ(r.variable("unused"), 0);
  expect_no_traps();
}

// 10 % of 856 is 86: over 200 readings the mean stays within 4 standard errors (24), the
// deviation within 20 %
TEST_F(GroundTest, noise_has_the_size_asked_for_and_repeats) {
  std::uint64_t digests[2];
  for (auto& digest_of_run : digests) {
    struct Run : GroundTest {
      void TestBody() override {}
      using FirmwareTest::digest;
      using FirmwareTest::run_for;
      using FirmwareTest::world;
      using GroundTest::reader;
    } run;
    run.world.floor.colour = {1, 1, 1};
    Robot& r = run.reader(0.1);
    run.run_for(0.1);
    double sum = 0, squares = 0;
    for (int i = 0; i < 200; ++i) {
      run.run_for(0.02);
      const double value = r.variables("words", 1)[0];
      sum += value;
      squares += value * value;
    }
    const double mean = sum / 200;
    EXPECT_NEAR(mean, 855.6, 24.5);
    EXPECT_NEAR(std::sqrt(squares / 200 - mean * mean), 85.6, 17);
    digest_of_run = run.digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

TEST_F(GroundTest, a_part_that_nobody_knows_is_named) {
  std::vector<std::string> problems;
  sim::WorldDesc copy = world;
  copy.robots.resize(1);
  copy.robots[0].name = "r";
  copy.robots[0].parts.push_back(part("toaster"));
  EXPECT_EQ(twin::Twin::open(copy, options, problems), nullptr);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0], "robot 'r': part: got kind 'toaster', expected one that the program knows");
}

const char* const kReadColour = R"(
#include <I2C/e_I2C_protocol.h>
int red, green, blue, brighter, gain, done;
int main(void) {
  e_i2cp_init();
  e_i2cp_enable();
  red = (unsigned char)e_i2cp_read(0x52, 0);
  green = (unsigned char)e_i2cp_read(0x52, 1);
  blue = (unsigned char)e_i2cp_read(0x52, 2);
  e_i2cp_write(0x52, 3, 2);
  e_i2cp_write(0x52, 4, 7); /* there is none */
  gain = e_i2cp_read(0x52, 3);
  brighter = (unsigned char)e_i2cp_read(0x52, 1);
  done = 1;
  while (1);
}
)";

// 255 * 0.8 = 204, 255 * 0.4 = 102, 255 * 0.2 = 51; gain 2: 204
TEST_F(PartTest, the_example_reads_the_floor) {
  world.floor.colour = {0.8, 0.4, 0.2};
  Robot& r = add_robot_with_source(kReadColour);
  r.settings().parts.push_back(part("floor-colour", {{"noise", number(0)}}));
  run_for(0.1);
  EXPECT_EQ(r.variable("done"), 1);
  EXPECT_EQ(r.variable("red"), 204);
  EXPECT_EQ(r.variable("green"), 102);
  EXPECT_EQ(r.variable("blue"), 51);
  EXPECT_EQ(r.variable("gain"), 2);
  EXPECT_EQ(r.variable("brighter"), 204);
  expect_no_traps();
}

// what a program wrote into its parts is gone when the robot is put back, as if the world began
TEST_F(PartTest, each_is_as_at_first_when_its_robot_begins_anew) {
  Robot& robot = add_robot_with_source(R"(
#include <I2C/e_I2C_protocol.h>
#include <motor_led/e_init_port.h>
static const unsigned char devices[] = {0xC0, 0xE0, 0x7E, 0xA2, 0x52};
unsigned char seen[5 * 8], after[5 * 8];
int rounds;
int main(void) {
  int d, r, i;
  long pause;
  e_init_port();
  e_i2cp_init();
  e_i2cp_enable();
  for (i = 0; i < 2; i++) {
    for (d = 0; d < 5; d++)
      for (r = 0; r < 8; r++) (i ? after : seen)[8 * d + r] = e_i2cp_read(devices[d], r);
    for (d = 0; d < 5 && !i; d++)
      for (r = 2; r < 8; r++) e_i2cp_write(devices[d], r, 5);
    e_i2cp_write(0xE0, 0, 81);
    for (pause = 0; pause < 200000; pause++) asm("nop");
    rounds++;
  }
  while (1);
}
)");
  robot.settings().parts = {part("compass"), part("ultrasonic-ranger"), part("radio"), part("lis-turret"),
                            part("floor-colour")};
  std::vector<unsigned char> first[2];
  for (auto& seen : first) {
    run_for(2);
    EXPECT_EQ(robot.variable("rounds"), 2);
    seen = robot.variables<unsigned char>("seen", 40);
    EXPECT_NE(seen, robot.variables<unsigned char>("after", 40)) << "writing has changed them";
    twin().mind(0).runner()->restart();
    twin().simulation().move(0, {0, 0, 0});
    twin().begin_again(0);
    twin().simulation().begin_again();
  }
  EXPECT_EQ(first[0], first[1]);
}

}  // namespace
