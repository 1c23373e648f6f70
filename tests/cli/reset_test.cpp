// SPDX-License-Identifier: MIT
// A supervisor resets the simulation: the course of the world after it is the first one again, to the last bit.
#include <vector>

#include "tests/cli/command.h"
#include "tests/cli/vcd_reader.h"

using namespace cli_test;

namespace {

class Resets : public CommandTest {};

/// Prints what it sees and remembers, also what is in its EEPROM, and shows it on its LEDs.
const char* const kTeller = R"(
#include <stdio.h>
#include <libpic30.h>
#include <p30F6014A.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
static int _EEDATA(_EE_ROW) kept[16] = {70, 80};
static volatile int due;
static void tick(void) { due = 1; }
int main(void) {
  static int number; /* RAM begins empty */
  static char text[80];
  int runs = 0;
  _prog_addressT place;
  _init_prog_address(place, kept);
  _memcpy_p2d16(&runs, place, _EE_WORD);
  _erase_eedata(place, _EE_WORD);
  _wait_eedata();
  _write_eedata_word(place, runs + 1);
  _wait_eedata();
  e_init_port();
  e_init_uart1();
  e_init_motors();
  e_start_agendas_processing();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(tick, 1000);
  e_set_speed_left(600);
  e_set_speed_right(500);
  while (1) {
    int ambient, length;
    while (!due);
    due = 0;
    ambient = e_get_ambient_light(2);
    e_set_led(ambient & 7, 2);
    length = sprintf(text, "%d %d %d %d %d %d %x\n", runs, number++, ambient, e_get_prox(0), e_get_acc(0),
                     e_get_micro(1), (unsigned)RCON);
    e_send_uart1_char(text, length);
    if (number == 20) { e_set_speed_left(-400); e_set_speed_right(-300); }
  }
}
)";

/// Notes everything that a supervisor sees of the world, and compares it with that of the first stretch.
const char* const kWitness = R"(
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <webots/robot.h>
#include <webots/supervisor.h>
#define THINGS 12
#define LOOKS 256
static const char *const kFields[] = {"batteryVoltage", "leftSteps", "rightSteps"};
static struct seen {
  double position[3], orientation[9], velocity[6], fields[3], proximity[8];
  int leds;
} first[THINGS][LOOKS];
static struct thing {
  WbNodeRef node;
  WbFieldRef fields[3], proximity, leds;
} things[THINGS];
static int count, round_, number, different;
static double way;
static void find(void) {
  WbFieldRef children = wb_supervisor_node_get_field(wb_supervisor_node_get_root(), "children");
  int i, f;
  for (i = 0; i < wb_supervisor_field_get_count(children) && count < THINGS; i++) {
    WbNodeRef node = wb_supervisor_field_get_mf_node(children, i);
    const char *type = wb_supervisor_node_get_base_type_name(node);
    struct thing *thing = &things[count];
    int robot = strcmp(type, "Robot") == 0 && strcmp(wb_supervisor_node_get_type_name(node), "Robot") != 0;
    if (!robot && strcmp(type, "Solid") != 0) continue;
    thing->node = node;
    for (f = 0; f < 3 && robot; f++) thing->fields[f] = wb_supervisor_node_get_field(node, kFields[f]);
    if (robot) thing->proximity = wb_supervisor_node_get_field(node, "proximity");
    if (robot) thing->leds = wb_supervisor_node_get_field(node, "leds");
    count++;
  }
}
static void look(void) {
  int i, f;
  for (i = 0; i < count; i++) {
    const struct thing *thing = &things[i];
    struct seen now;
    memset(&now, 0, sizeof now);
    memcpy(now.position, wb_supervisor_node_get_position(thing->node), sizeof now.position);
    memcpy(now.orientation, wb_supervisor_node_get_orientation(thing->node), sizeof now.orientation);
    memcpy(now.velocity, wb_supervisor_node_get_velocity(thing->node), sizeof now.velocity);
    for (f = 0; f < 3 && thing->fields[0]; f++) now.fields[f] = wb_supervisor_field_get_sf_float(thing->fields[f]);
    for (f = 0; f < 8 && thing->proximity; f++) now.proximity[f] = wb_supervisor_field_get_mf_float(thing->proximity, f);
    if (thing->leds) now.leds = wb_supervisor_field_get_sf_int32(thing->leds);
    if (!round_) first[i][number] = now;
    else if (memcmp(&now, &first[i][number], sizeof now)) different++;
    way += hypot(now.position[0] - first[i][0].position[0], now.position[1] - first[i][0].position[1]);
  }
}
static void go_on(int looks) {
  /* six ticks are one step of 10 ms, so 256 are three seconds */
  for (number = 0; number < looks && wb_robot_step(10) != -1; number++) look();
}
static void judge(void) {
  printf("%d looks are different, way %g\n", different, way);
  wb_supervisor_simulation_quit(different || way == 0);
}
)";

/// Noise of everything, clocks that are off, one that boots later, a lamp, a line, walls and a ball to meet.
std::string world_of(const std::string& engine) {
  return "twinpuck = 1\n[world]\nengine = \"" + engine +
         "\"\nambient = 0.3\nwheel_noise = 0.05\n[arena]\nsize = [0.5, 0.5]\n"
         "[[lamp]]\nposition = [0.1, 0.1, 0.3]\nintensity = 3\n"
         "[[sound]]\nkind = \"noise\"\nposition = [0.1, 0.1, 0.3]\n"
         "[[robot]]\nname = \"light\"\nheading = 30\nfirmware = \"braitenberg_3b\"\n"
         "[robot.variation]\nclock_ppm = 131\n"
         "[[robot]]\nname = \"other\"\nposition = [0.15, 0.1]\nfirmware = \"obstacle\"\n"
         "[robot.variation]\nclock_ppm = -57\nboot_delay = 0.0123\n"
         "[[robot]]\nname = \"teller\"\nposition = [-0.1, -0.12]\nheading = 20\nfirmware = \"teller\"\n"
         "[[robot]]\nname = \"line\"\nposition = [-0.12, 0.15]\nfirmware = \"line_follow\"\n"
         "[[robot.part]]\nkind = \"ground-sensors\"\n"
         "[[ball]]\nposition = [0.0, -0.08]\nradius = 0.02\nmass = 0.01\nmovable = true\n";
}

TEST_F(Resets, reset_and_restart_give_the_first_run_again_to_the_last_bit) {
  write("teller/teller.c", kTeller);
  const std::string program = write("resets.c", std::string(kWitness) + R"(
int main(void) {
  wb_robot_init();
  find();
  for (; round_ < 3; round_++) {
    go_on(LOOKS);
    wb_supervisor_simulation_reset();
  }
  judge();
  wb_robot_cleanup();
  return 0;
}
)");
  for (const char* engine : {"dynamic", "kinematic", "planar"})
  {
    SCOPED_TRACE(engine);
    const Said said =
        twinpuck("run '" + write("world.toml", world_of(engine)) + "' --way chip --for 20 --supervisor '" +
                 program + "' --uart 'teller=file:" + path("words") + "'");
    EXPECT_EQ(said.exit_code, 0) << said.text;
    // lines of each stretch; the EEPROM is as programmed, RAM empty, and it was switched on
    const std::string words = read(path("words")), once = words.substr(0, words.size() / 3);
    EXPECT_EQ(once.substr(0, 5), "70 0 ");
    EXPECT_GT(std::count(once.begin(), once.end(), '\n'), 15);
    EXPECT_EQ(words, once + once + once);
  }
}

// what a signal does in a stretch of half a second, counted from its beginning; not the changes that are the
// reset itself, seen when a robot runs again
Dump::Changes stretch(const Dump::Changes& all, int number) {
  constexpr long long kStretch = 500'000'000, kBoot = 15'000'000, kMargin = 1'000'000;  // ns
  Dump::Changes part;
  for (const auto& [ns, value] : all) {
    const long long since = ns - number * kStretch;
    if (since > kBoot && since < kStretch - kMargin) part.emplace_back(since, value);
  }
  return part;
}

TEST_F(Resets, pins_motors_and_words_come_again_at_the_same_instants) {
  write("teller/teller.c", kTeller);
  const std::string program = write("ours.c", R"(
#include <webots/robot.h>
#include <webots/supervisor.h>
int main(void) {
  wb_robot_init();
  while (wb_robot_step(500) != -1) wb_supervisor_simulation_reset();
  wb_robot_cleanup();
  return 0;
}
)");
  const Said said =
      twinpuck("run '" + write("world.toml", world_of("dynamic")) + "' --way chip --for 1 --supervisor '" +
               program + "' --vcd '" + path("run.vcd") + "'");
  EXPECT_EQ(said.exit_code, 0) << said.text;
  const Dump dump = parse(read(path("run.vcd")));
  std::size_t words = 0, lights = 0, coils = 0;
  for (const auto& [name, changes] : dump.signals) {
    const Dump::Changes once = stretch(changes, 0);
    EXPECT_EQ(once, stretch(changes, 1)) << name;
    if (name.find("TX1") != std::string::npos) words += once.size();
    if (name.find("LED") != std::string::npos) lights += once.size();
    if (name.find("MOTOR") != std::string::npos) coils += once.size();
  }
  EXPECT_GT(words, 40u);
  EXPECT_GT(lights, 2u);
  EXPECT_GT(coils, 100u);
}

// radio, claps, slopes, a floor image, a camera, things that are pushed
TEST_F(Resets, our_worlds_take_their_first_course_again) {
  const std::string program = write("any.c", std::string(kWitness) + R"(
int main(void) {
  wb_robot_init();
  find();
  for (; round_ < 2; round_++) {
    go_on(200);
    wb_supervisor_simulation_reset();
  }
  judge();
  wb_robot_cleanup();
  return 0;
}
)");
  for (const char* world : {"flock", "clap", "ramp", "line", "red_ball", "push", "multi_obstacle"}) {
    const Said said =
        twinpuck(std::string("run ") + world + " --way chip --for 20 --supervisor '" + program + "'");
    EXPECT_EQ(said.exit_code, 0) << world << "\n" << said.text;
  }
}

}  // namespace
