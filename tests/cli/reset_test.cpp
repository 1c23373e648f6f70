// SPDX-License-Identifier: MIT
// A supervisor puts robots back and restarts their programs: the course of the world after it is the first
// one again, to the last bit.
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

/// Notes everything that a supervisor sees of the world, and compares it with that of the first stretch,
/// which it keeps in a file: some resets begin with the supervisor again. CALL is the reset; steps are 64
/// ticks, so that each stretch has its looks at the same instants.
const char* const kWitness = R"(
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <webots/robot.h>
#include <webots/supervisor.h>
#define ROBOTS 4
#define LOOKS 24
static struct seen {
  double place[3], turn[4], velocity[6], battery, steps[2], proximity[8];
  int leds;
} first[LOOKS][ROBOTS + 1], now[ROBOTS + 1];
static const char *const names[ROBOTS + 1] = {"light", "other", "teller", "line", "ball"};
static double number_of(WbNodeRef node, const char *name) {
  return wb_supervisor_field_get_sf_float(wb_supervisor_node_get_field(node, name));
}
static void look(void) {
  int thing, i;
  memset(now, 0, sizeof now);
  for (thing = 0; thing <= ROBOTS; thing++) {
    WbNodeRef node = wb_supervisor_node_get_from_def(names[thing]);
    struct seen *s = &now[thing];
    memcpy(s->place, wb_supervisor_node_get_position(node), sizeof s->place);
    memcpy(s->turn, wb_supervisor_field_get_sf_rotation(wb_supervisor_node_get_field(node, "rotation")), sizeof s->turn);
    memcpy(s->velocity, wb_supervisor_node_get_velocity(node), sizeof s->velocity);
    if (thing == ROBOTS) continue;
    s->battery = number_of(node, "batteryVoltage");
    s->steps[0] = number_of(node, "leftSteps");
    s->steps[1] = number_of(node, "rightSteps");
    s->leds = wb_supervisor_field_get_sf_int32(wb_supervisor_node_get_field(node, "leds"));
    for (i = 0; i < 8; i++)
      s->proximity[i] = wb_supervisor_field_get_mf_float(wb_supervisor_node_get_field(node, "proximity"), i);
  }
}
/* rounds so far, looks that were different, and the way of all; they outlive this process */
static struct { int round, different; double way; } kept;
int main(void) {
  FILE *file;
  wb_robot_init();
  for (;;) {
    int number;
    if ((file = fopen("kept", "rb"))) {
      if (fread(&kept, sizeof kept, 1, file) != 1 || fread(first, sizeof first, 1, file) != 1) return 1;
      fclose(file);
    }
    for (number = 0; number < LOOKS; number++) {
      int thing;
      if (wb_robot_step(125) == -1) return 1;
      look();
      if (kept.round == 0) memcpy(first[number], now, sizeof now);
      else if (memcmp(first[number], now, sizeof now)) kept.different++;
      for (thing = 0; thing <= ROBOTS; thing++)
        kept.way += hypot(now[thing].place[0] - first[0][thing].place[0], now[thing].place[1] - first[0][thing].place[1]);
    }
    if (++kept.round == 3) {
      printf("%d looks are different, way %g\n", kept.different, kept.way);
      wb_supervisor_simulation_quit(kept.different || kept.way < 1);
      wb_robot_cleanup();
      return 0;
    }
    if (!(file = fopen("kept", "wb")) || fwrite(&kept, sizeof kept, 1, file) != 1 || fwrite(first, sizeof first, 1, file) != 1) return 1;
    fclose(file);
    CALL();
  }
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
         "[[ball]]\nname = \"ball\"\nposition = [0.0, -0.08]\nradius = 0.02\nmass = 0.01\nmovable = true\n";
}

TEST_F(Resets, every_reset_gives_the_first_run_again_to_the_last_bit) {
  write("teller/teller.c", kTeller);
  for (const char* call :
       {"wb_supervisor_simulation_reset", "wb_supervisor_simulation_revert", "wb_supervisor_world_reload"})
    for (const char* engine : {"dynamic", "kinematic", "planar"}) {
      SCOPED_TRACE(std::string(engine) + " " + call);
      const std::string folder = std::string(call) + "_" + engine;
      write(folder + "/" + folder + ".c", "#define CALL " + std::string(call) + "\n" + kWitness);
      const Said said =
          twinpuck("run '" + write("world.toml", world_of(engine)) + "' --hal dspic --for 20 --supervisor '" +
                   path(folder) + "' --uart 'teller=file:" + path("words") + "'");
      EXPECT_EQ(said.exit_code, 0) << said.text;
      EXPECT_NE(said.text.find("0 looks are different"), std::string::npos) << said.text;
      // 29 lines of each stretch; the EEPROM is as programmed, RAM empty, and it was switched on
      const std::string words = read(path("words")), once = words.substr(0, words.size() / 3);
      EXPECT_EQ(once.substr(0, 5), "70 0 ");
      EXPECT_GT(std::count(once.begin(), once.end(), '\n'), 20);
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
  const std::string program = write("again.c", R"(
#include <webots/robot.h>
#include <webots/supervisor.h>
int main(void) {
  wb_robot_init();
  wb_robot_step(500);
  wb_supervisor_simulation_reset();
  wb_robot_step(500);
  return 0;
}
)");
  const Said said =
      twinpuck("run '" + write("world.toml", world_of("dynamic")) + "' --hal dspic --for 1 --supervisor '" +
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
  const std::string program = write("any.c", R"(
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <webots/robot.h>
#include <webots/supervisor.h>
#define THINGS 60
#define LOOKS 16
static double first[LOOKS][THINGS][3];
int main(void) {
  int round, number, thing, different = 0;
  double way = 0;
  wb_robot_init();
  for (round = 0; round < 2; round++) {
    for (number = 0; number < LOOKS; number++) {
      WbFieldRef children = wb_supervisor_node_get_field(wb_supervisor_node_get_root(), "children");
      wb_robot_step(125);
      for (thing = 0; thing < wb_supervisor_field_get_count(children) && thing < THINGS; thing++) {
        const double *now = wb_supervisor_node_get_position(wb_supervisor_field_get_mf_node(children, thing));
        if (!now) continue;
        if (!round) memcpy(first[number][thing], now, sizeof first[0][0]);
        else if (memcmp(now, first[number][thing], sizeof first[0][0])) different++;
        way += hypot(now[0] - first[0][thing][0], now[1] - first[0][thing][1]);
      }
    }
    wb_supervisor_simulation_reset();
  }
  printf("%d places are different, way %g\n", different, way);
  wb_supervisor_simulation_quit(different || !(way > 0));
  wb_robot_cleanup();
  return 0;
}
)");
  for (const char* world : {"flock", "clap", "ramp", "line", "red_ball", "push", "multi_obstacle"}) {
    const Said said =
        twinpuck(std::string("run ") + world + " --hal dspic --for 20 --supervisor '" + program + "'");
    EXPECT_EQ(said.exit_code, 0) << world << "\n" << said.text;
  }
}

}  // namespace
