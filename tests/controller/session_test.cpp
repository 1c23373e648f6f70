// SPDX-License-Identifier: MIT
// How a program begins, steps, ends and dies.
#include <gtest/gtest.h>
#include <webots/distance_sensor.h>
#include <webots/robot.h>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>

#include "tests/controller/fake_simulator.h"
#include "tests/support/wording.h"

using fake::Packet;
using fake::Simulator;
using fake::World;

namespace {
const std::vector<fake::Device> kSensors{{1, WB_NODE_DISTANCE_SENSOR, "ps0", {0, 4095, 0.3, 1}}};

void steps_until_the_end() {
  wb_robot_init();
  while (wb_robot_step(32) != -1) printf("%.3f\n", wb_robot_get_time());
  printf("end\n");
  wb_robot_cleanup();
}

}  // namespace

TEST(ControllerSession, hello_says_version_and_language) {
  Simulator sim([] { wb_robot_init(); });
  const fake::Record hello = sim.welcome({});
  EXPECT_EQ(hello.ints[0], LINK_VERSION);
  EXPECT_EQ(hello.ints[1], 0);
  EXPECT_EQ(hello.texts[0], "controller_test");
  EXPECT_EQ(sim.wait(), 0);
}

TEST(ControllerSession, names_come_from_welcome) {
  Simulator sim([] {
    printf("%s|%s|%s|%s|%s|%g|%d", wb_robot_get_name(), wb_robot_get_model(), wb_robot_get_project_path(),
           wb_robot_get_world_path(), wb_robot_get_custom_data(), wb_robot_get_basic_time_step(),
           wb_robot_get_supervisor());
  });
  sim.welcome({});
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "puck|GCtronic e-puck|project|project/worlds/w.wbt|custom|32|0");
}

TEST(ControllerSession, steps_are_answered_until_the_run_is_over) {
  Simulator sim(steps_until_the_end);
  sim.welcome({});
  EXPECT_TRUE(sim.until_step().empty());
  EXPECT_EQ(sim.asked_ms(), 32);
  sim.done(32000000);
  sim.until_step();
  sim.done(64000000);
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0.032\n0.064\nend\n");
  EXPECT_TRUE(sim.next().empty()) << "cleanup closes";
}

TEST(ControllerSession, who_steps_on_after_the_end_is_ended) {
  Simulator sim([] {
    wb_robot_init();
    for (;;) {
      wb_robot_step(64);
      printf("on\n");
    }
  });
  sim.welcome({});
  sim.until_step();
  sim.send(Packet().add(LINK_END));
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "on\n");
}

TEST(ControllerSession, a_socket_that_closes_ends_the_steps) {
  Simulator sim(steps_until_the_end);
  sim.welcome({});
  sim.until_step();
  sim.close();
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "end\n");
}

TEST(ControllerSession, two_halves_of_a_step_are_one) {
  Simulator sim([] {
    wb_robot_init();
    printf("%d ", wb_robot_step_begin(32));
    printf("%d", wb_robot_step_end());
  });
  sim.welcome({});
  sim.until_step();
  sim.done(32000000);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_EQ(sim.output(), "0 0");
}

TEST(ControllerSession, commands_of_a_program_that_just_ends_are_sent) {
  Simulator sim([] { wb_robot_set_custom_data("last words"); });
  sim.welcome({});
  const auto said = sim.next();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].number, LINK_SET_CUSTOM);
  EXPECT_EQ(said[0].texts[0], "last words");
  EXPECT_EQ(sim.wait(), 0);
}

TEST(ControllerSession, garbage_of_the_simulator_ends_the_program_with_a_message) {
  std::string short_record(16, '\0');
  short_record[0] = LINK_DONE, short_record[4] = 8;  // one member of two
  std::string unknown(8, '\0');
  unknown[0] = 99;
  std::string too_long(8, '\0');
  too_long[0] = LINK_DONE, too_long[5] = 1;
  Packet welcome_again;
  welcome_again.add(LINK_FIELD, 1, 1, 1, "text");
  const std::string out_of_place(static_cast<const char*>(welcome_again.bytes()), welcome_again.size());
  for (const auto& [garbage, said] :
       {std::pair{std::string("xyz"), "a packet that ends within a record (record 0)"},
        std::pair{short_record, "a record whose members are not those of its number (record 11)"},
        std::pair{unknown, "a record of a number that this version does not have (record 99)"},
        std::pair{too_long, "a record that is longer than its packet (record 11)"},
        std::pair{out_of_place, "record 63 within a step, expected samples and DONE or END"}}) {
    Simulator sim(steps_until_the_end);
    sim.welcome({});
    sim.until_step();
    sim.send_bytes(garbage);
    EXPECT_EQ(sim.wait(), 1);
    EXPECT_TRUE(wording::reads(sim.errors(), std::string("libcontroller: the simulator: got ") + said));
  }
}

TEST(ControllerSession, another_version_is_named) {
  Simulator sim([] { wb_robot_init(); });
  World world;
  world.version = LINK_VERSION + 1;
  sim.welcome(world);
  EXPECT_EQ(sim.wait(), 1);
  EXPECT_TRUE(wording::reads(
      sim.errors(),
      "libcontroller: the simulator: got version 3 of the link, expected 2; build the program anew"));
}

TEST(ControllerSession, a_refusal_is_told) {
  Simulator sim(steps_until_the_end);
  sim.welcome({});
  sim.until_step();
  sim.send(Packet().add(LINK_REFUSED, "you spoke in riddles"));
  EXPECT_EQ(sim.wait(), 1);
  EXPECT_TRUE(
      wording::reads(sim.errors(), "libcontroller: the simulator ended the program: you spoke in riddles"));
}

TEST(ControllerSession, a_program_without_a_simulation_says_what_to_do) {
  char folder[] = "/tmp/controller_testXXXXXX";
  ASSERT_TRUE(mkdtemp(folder));
  Simulator sim([&] {
    unsetenv("TWINPUCK_CONTROLLER");
    setenv("XDG_RUNTIME_DIR", folder, 1);
    wb_robot_init();
  });
  EXPECT_EQ(sim.wait(), 1);
  EXPECT_TRUE(wording::reads(sim.errors(),
                             "libcontroller: this program belongs to a simulation, and none waits for it. "
                             "Let a world start it (twinpuck run WORLD), or start a simulation that waits "
                             "(twinpuck run WORLD --extern ROBOT) and then this program"));
  rmdir(folder);
}

TEST(ControllerSession, a_program_from_outside_finds_the_one_that_waits) {
  char folder[] = "/tmp/controller_testXXXXXX";
  ASSERT_TRUE(mkdtemp(folder));
  const std::string below = std::string(folder) + "/twinpuck-" + std::to_string(getuid());
  const std::string path = below + "/puck.sock";
  // a simulator that was killed has left its socket
  ASSERT_EQ(system(("mkdir " + below + " && touch " + below + "/999999999-puck.sock").c_str()), 0);
  const int waiting = socket(AF_UNIX, SOCK_SEQPACKET, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  strcpy(address.sun_path, path.c_str());
  ASSERT_EQ(bind(waiting, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(waiting, 1), 0);
  Simulator sim([&] {
    unsetenv("TWINPUCK_CONTROLLER");
    setenv("XDG_RUNTIME_DIR", folder, 1);
    wb_robot_init();
  });
  const int there = accept(waiting, nullptr, nullptr);
  char bytes[256];
  EXPECT_GT(recv(there, bytes, sizeof bytes, 0), 8);
  EXPECT_EQ(bytes[0], LINK_HELLO);
  ::close(there);
  ::close(waiting);
  EXPECT_EQ(sim.wait(), 1);
  EXPECT_EQ(system(("rm -r " + std::string(folder)).c_str()), 0);
}

TEST(ControllerSession, the_calendar_is_made_of_the_seed_and_simulated_time) {
  const auto calendar = [](std::int64_t seed) {
    Simulator sim([] {
      const time_t before = time(nullptr);  // as srand(time(NULL)) at the beginning of a main()
      wb_robot_init();
      wb_robot_step(2000);
      printf("%ld %ld", static_cast<long>(before), static_cast<long>(time(nullptr) - before));
    });
    World world;
    world.seed = seed;
    sim.welcome(world);
    sim.until_step();
    sim.done(2000000000);
    EXPECT_EQ(sim.wait(), 0);
    return sim.output();
  };
  const std::string once = calendar(7);
  EXPECT_EQ(once, calendar(7));
  EXPECT_NE(once, calendar(8));
  EXPECT_EQ(once.substr(once.find(' ')), " 2");
  const long begin = atol(once.c_str());
  EXPECT_GE(begin, 1000000000L);
  EXPECT_LT(begin, 1000000000L + 3L * 365 * 86400);
}

namespace {
void dies_here(int how) {
  wb_robot_init();
  if (how == SIGSEGV) *static_cast<volatile int*>(nullptr) = 1;
  if (how == SIGABRT) abort();
  raise(how);
}
}  // namespace

TEST(ControllerSession, a_crash_is_told_with_its_place) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has handlers of its own, which stay";
#endif
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS}) {
    Simulator sim([&] { dies_here(signal); });
    sim.welcome({});
    const auto said = sim.next();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].number, LINK_CRASH);
    EXPECT_EQ(said[0].ints[0], signal);
    EXPECT_NE(said[0].texts[0].find("controller_test"), std::string::npos) << said[0].texts[0];
    EXPECT_GT(said[0].ints[1], 0);
    EXPECT_EQ(sim.wait(), 1000 + signal);
    // the place is within the function, as the file's own tables have it
    char hex[64];
    snprintf(hex, sizeof hex, "0x%llx", static_cast<unsigned long long>(said[0].ints[1]));
    FILE* lines = popen(("addr2line -f -e '" + said[0].texts[0] + "' " + hex).c_str(), "r");
    char name[256] = "";
    ASSERT_TRUE(lines && fgets(name, sizeof name, lines));
    pclose(lines);
    EXPECT_NE(std::string(name).find("dies_here"), std::string::npos) << signal << ": " << name;
  }
}

namespace {
int deeper(int n) {
  volatile char room[4096];
  room[0] = static_cast<char>(n);
  return n < 0 ? room[0] : deeper(n + 1) + room[0];
}
}  // namespace

TEST(ControllerSession, a_stack_that_overflows_is_told) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer has handlers of its own, which stay";
#endif
  Simulator sim([] {
    wb_robot_init();
    printf("%d", deeper(0));
  });
  sim.welcome({});
  const auto said = sim.next();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].number, LINK_CRASH);
  EXPECT_EQ(said[0].ints[0], SIGSEGV);
  EXPECT_EQ(sim.wait(), 1000 + SIGSEGV);
}

TEST(ControllerSession, a_programs_own_handler_stays) {
  Simulator sim([] {
    signal(SIGFPE, [](int) { _exit(42); });
    wb_robot_init();
    raise(SIGFPE);
  });
  sim.welcome({});
  EXPECT_TRUE(sim.next().empty());
  EXPECT_EQ(sim.wait(), 42);
}

TEST(ControllerSession, a_command_that_fits_no_packet_is_dropped_and_the_rest_sent) {
  Simulator sim([] {
    const std::string much(200000, 'x'), some(50000, 'y');
    wb_robot_init();
    wb_robot_set_custom_data(much.c_str());
    for (int i = 0; i < 4; ++i) wb_robot_set_custom_data(some.c_str());
    wb_robot_step(32);
  });
  sim.welcome({});
  std::size_t texts = 0;
  for (bool stepped = false; !stepped;)
    for (const auto& r : sim.next()) {
      texts += r.number == LINK_SET_CUSTOM ? r.texts[0].size() : 0;
      stepped = r.number == LINK_STEP;
    }
  EXPECT_EQ(texts, 200000u) << "four of 50000, not the one of 200000";
  sim.done(32000000);
  EXPECT_EQ(sim.wait(), 0);
  EXPECT_TRUE(wording::reads(sim.errors(),
                             "Warning: a command is dropped: got 200016 bytes, expected at most 131072"));
}
