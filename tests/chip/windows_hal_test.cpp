// SPDX-License-Identifier: MIT
// A robot's course does not depend on where its windows end: ten robots with controllers of all kinds, under
// either HAL, on a floor that stands still meanwhile.
#include <algorithm>
#include <functional>

#include "hal_sim/chip/chip_runner.h"
#include "tests/chip/hal_flight.h"

namespace {

using board::Cycle;

const char* const kControllers[] = {"obstacle",     "braitenberg", "follow_wall", "square",        "tilt",
                                    "sound_locate", "asercom",     "line_follow", "soccer_player", "blink"};
constexpr int kRobots = 10;

/// What a robot has come to at an instant.
struct Look {
  Cycle now = 0, idle = 0;
  std::uint64_t hash = 0, ram = 0;
  unsigned pc = 0;
  bool operator==(const Look& o) const {
    return now == o.now && idle == o.idle && hash == o.hash && ram == o.ram && pc == o.pc;
  }
};
std::ostream& operator<<(std::ostream& out, const Look& look) {
  return out << "now " << look.now << " idle " << look.idle << " hash " << look.hash << " ram " << look.ram
             << " pc " << look.pc;
}

Look look_at(chip::ChipRunner& runner) {
  const dspic::Processor& cpu = runner.processor();
  Look look{cpu.now(), runner.idle_cycles(), runner.hash(), 0, cpu.pc()};
  for (unsigned at = dspic::Processor::kRamStart; at < dspic::Processor::kRamStart + 0x2000; ++at)
    look.ram = look.ram * 31 + cpu.ram(at);
  return look;
}

using Course = std::vector<std::vector<Look>>;

/// `cut`: the next window's length. Looks stand at instants that do not depend on it.
Course course_of(const std::string& hal, Cycle length, int robots, const std::function<Cycle()>& cut) {
  const std::string file = std::string(TWINPUCK_SOURCE_DIR) + "/bench/worlds/brait_10.toml";
  sim::LoadedWorld loaded = twin::load_world(file);
  EXPECT_TRUE(loaded.world) << loaded.report(file);
  Course course;
  if (!loaded.world) return course;
  for (int i = 0; i < kRobots; ++i)
    loaded.world->robots[static_cast<std::size_t>(i)].firmware = kControllers[i];
  twin::Options options;
  options.hal = hal;
  std::vector<std::string> problems;
  const auto twin = twin::Twin::open(*loaded.world, options, problems);
  for (const std::string& p : problems) ADD_FAILURE() << p;
  if (!twin) return course;
  for (int tick = 0; tick < 60; ++tick) twin->simulation().step();
  constexpr Cycle kLookEvery = 14'741;
  for (int i = 0; i < robots; ++i) {
    auto& runner = dynamic_cast<chip::ChipRunner&>(*twin->mind(i).runner());
    course.emplace_back();
    Cycle at = runner.cycles();
    const Cycle end = at + length;
    for (Cycle look = at + kLookEvery; look <= end; look += kLookEvery) {
      while (at < look) {
        const Cycle to = std::min(look, at + cut());
        runner.begin_window(at);
        runner.run_until(to);
        at = to;
      }
      course.back().push_back(look_at(runner));
    }
  }
  return course;
}

void expect_same(const Course& whole, const Course& other, const std::string& how) {
  for (std::size_t robot = 0; robot < other.size(); ++robot)
    for (std::size_t i = 0; i < other[robot].size(); ++i)
      ASSERT_EQ(other[robot][i], whole[robot][i])
          << how << ", " << kControllers[robot] << ", look " << i << " of " << other[robot].size();
}

class HalWindows : public ::testing::TestWithParam<const char*> {};

TEST_P(HalWindows, do_not_matter_to_ten_robots) {
  constexpr Cycle kSecond = board::kFcyHz, kLong = kSecond / 5, kShort = 60'000;
  const Course whole = course_of(GetParam(), kLong, kRobots, [] { return kSecond; });
  ASSERT_EQ(whole.size(), std::size_t{kRobots});
  EXPECT_NE(whole[0].front().hash, whole[0].back().hash);
  std::uint64_t state = 7;
  const auto draw = [&](std::uint64_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<Cycle>((state >> 33) % below);
  };
  expect_same(whole, course_of(GetParam(), kLong, kRobots, [] { return Cycle{28'800}; }), "a tick");
  expect_same(
      whole,
      course_of(GetParam(), kLong, kRobots, [&] { return 1 + draw(draw(2)   ? 90
                                                                  : draw(2) ? 900
                                                                            : 30'000); }),
      "at random");
  expect_same(whole, course_of(GetParam(), kShort, kRobots, [] { return Cycle{1}; }), "one cycle");
}

// with agenda and scan beside it, which the UART's handlers hold off; both become pending meanwhile now and then
constexpr const char* kTalkers[] = {
    // a line at an agenda's beat, and a wait for its end
    R"(
    while (!due) continue;
    due = 0;
    sprintf(text, "%05d 34567890123456789012345678901234\r\n", n++);
    e_send_uart1_char(text, 40);
    while (e_uart1_sending()) continue;
)",
    // without pause, out of the flash
    R"(
    if (!e_uart1_sending()) e_send_uart1_char("of the flash, without pause\r\n", 15 + ++n % 14);
    if (n % 512 == 0) e_set_speed_left(n % 1000);
)",
    // delay loops, and sections that hold off everything for longer than four bytes take
    R"(
    e_send_uart1_char(text, 37);
    for (pause = 0; pause < 3000; pause++) continue;
    SRbits.IPL = 7;
    for (pause = 0; pause < 700; pause++) continue;
    SRbits.IPL = 0;
    e_end_agendas_processing();
    for (pause = 0; pause < 900; pause++) continue;
    e_start_agendas_processing();
)",
    // what comes goes back
    R"(
    if (e_getchar_uart1(&text[n])) n++;
    if (n == 5 || (n > 0 && due > 2)) {
      e_send_uart1_char(text, n);
      while (e_uart1_sending()) continue;
      n = due = 0;
    }
)",
};

class UartUnderHalSim : public ::testing::TestWithParam<std::size_t> {};

TEST_P(UartUnderHalSim, is_the_same_by_heart_and_as_it_runs) {
  const std::string name = "uart-by-heart-" + std::to_string(GetParam());
  const sim::WorldDesc world = hal_test::world_with(name, std::string(R"(
#include <p30F6014A.h>
#include <stdio.h>
#include "motor_led/e_init_port.h"
#include "motor_led/advance_one_timer/e_motors.h"
#include "motor_led/advance_one_timer/e_agenda.h"
#include "a_d/advance_ad_scan/e_ad_conv.h"
#include "uart/e_uart_char.h"
static volatile int due;
static volatile unsigned pause;
static void tick(void) { due++; }
static char text[64];
int main(void) {
  int n = 0;
  e_init_port();
  e_init_motors();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(tick, 200);
  e_start_agendas_processing();
  e_set_speed_left(400);
  for (;;) {
)") + kTalkers[GetParam()] + "  }\n}\n");
  std::string text[2];
  std::vector<board::Cycle> ends[2];
  std::uint64_t hash[2] = {};
  Cycle idle[2] = {};
  for (const std::size_t knows : {0u, 1u}) {
    twin::Options options;
    options.hal = "sim";
    std::vector<std::string> problems;
    const auto twin = twin::Twin::open(world, options, problems);
    for (const std::string& p : problems) ADD_FAILURE() << p;
    if (!twin) return;
    const auto line = std::make_shared<hal_test::MemoryEnd>();
    twin->mind(0).board().uart(1).connect(line);
    for (int i = 1; i < 400; ++i)
      line->inject(std::string(1 + i % 7, static_cast<char>('a' + i % 26)), i * 100003);
    auto& runner = dynamic_cast<chip::ChipRunner&>(*twin->mind(0).runner());
    if (!knows) runner.processor().know(nullptr);
    while (sim::to_seconds(twin->simulation().now()) < 3) twin->simulation().step();
    text[knows] = line->text();
    for (std::size_t i = 0; i < text[knows].size(); ++i) ends[knows].push_back(line->ended_at(i));
    hash[knows] = runner.hash();
    idle[knows] = runner.idle_cycles();
  }
  EXPECT_GT(text[0].size(), 1000u);
  EXPECT_EQ(text[1], text[0]);
  EXPECT_EQ(ends[1], ends[0]);
  EXPECT_EQ(hash[1], hash[0]);  // each word on the line at its cycle, each step of the motor
  // waits are found by looks, whose instants routines known by heart move (docs/limits.md): a load of 0.0005
  constexpr double kNear = 0.0005 * 3 * 14745600;
  EXPECT_NEAR(static_cast<double>(idle[1]), static_cast<double>(idle[0]), kNear);
}

INSTANTIATE_TEST_SUITE_P(Of, UartUnderHalSim, ::testing::Range<std::size_t>(0, std::size(kTalkers)));

INSTANTIATE_TEST_SUITE_P(Of, HalWindows, ::testing::Values("sim", "dspic"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
