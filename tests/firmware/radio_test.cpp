// SPDX-License-Identifier: MIT
// The functions of ComModule.h between whole robots: from the library's call over I2C and the air to
// the other's buffer.

#include "hal_sim/board/radio_turret.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

class RadioFirmware : public FirmwareTest {
 protected:
  Robot& radio_robot(const std::string& source) {
    Robot& r = add_robot_with_source(
        "#include <p30F6014A.h>\n#include <contrib/SWIS_com_module/ComModule.h>\n" + source);
    r.settings().parts.push_back({"radio", {}, 0});
    return r;
  }
  board::RadioTurret& turret(int robot) {
    return dynamic_cast<board::RadioTurret&>(*twin().mind(robot).board().i2c().find(0x7E));
  }
};

TEST_F(RadioFirmware, settings_are_written_and_read_back) {
  Robot& r = radio_robot(R"(
unsigned int GetOwnAddress();
int plugged, group, address, soft, clamped, status, enabled, hard, done;
int main(void) {
  InitComModule(0x22, 0x1234, COM_MODULE_HW_ATTENUATOR_25DB, 17);
  plugged = IsModulePlugged();
  group = GetOwnGroup();
  address = GetOwnAddress();
  soft = GetSoftwareAttenuator();
  SetSoftwareAttenuator(77);
  clamped = GetSoftwareAttenuator();
  status = GetStatus();
  SetHardwareAttenuator(COM_MODULE_HW_ATTENUATOR_0DB);
  hard = GetHardwareAttenuator();
  SetRadioEnabledState(0);
  enabled = GetRadioEnabledState();
  done = 1;
  while (1);
})");
  ASSERT_TRUE(run_until([&] { return r.variable("done") == 1; }, 1));
  EXPECT_EQ(r.variable("plugged"), 1);
  EXPECT_EQ(r.variable("group"), 0x22);
  EXPECT_EQ(r.variable("address"), 0x1234);
  EXPECT_EQ(r.variable("soft"), 17);
  EXPECT_EQ(r.variable("clamped"), 31);
  EXPECT_EQ(r.variable("status"), 0x02);
  EXPECT_EQ(r.variable("hard"), 1);             // always 1, although it was switched off
  EXPECT_EQ(r.variable("enabled"), 1);          // the same
  EXPECT_DOUBLE_EQ(turret(0).power_db(), -25);  // only the software attenuator is left
  EXPECT_EQ(turret(0).listening_since, board::RadioTurret::kOff);
  expect_no_traps();
}

TEST_F(RadioFirmware, without_a_turret_nothing_is_plugged) {
  Robot& r = radio_robot(R"(
#include <I2C/e_I2C_protocol.h>
int plugged = 7, status, done;
int main(void) {
  e_i2cp_init();
  e_i2cp_enable();
  plugged = IsModulePlugged();
  status = GetStatus();
  done = 1;
  InitComModule(1, 1, 0, 1);
  done = 2;
  while (1);
})");
  r.settings().parts.clear();
  ASSERT_TRUE(run_until([&] { return r.variable("done") == 1; }, 1));
  EXPECT_EQ(r.variable("plugged"), 0);
  EXPECT_EQ(r.variable("status"), 0xFF);
  run_for(1);
  EXPECT_EQ(r.variable("done"), 1);  // waits for it, for ever
}

const char* const kSender = R"(
unsigned char text[109] = "hello";
int sent, too_long, rounds;
long i;
int main(void) {
  InitComModule(COM_MODULE_DEFAULT_GROUP, 1, 0, 1);
  too_long = SendPacket(COM_MODULE_DEFAULT_GROUP, 2, text, 109);
  for (rounds = 0; rounds < 5; rounds++) {
    text[5] = '0' + rounds;
    sent += SendPacket(COM_MODULE_DEFAULT_GROUP, 2, text, 6);
    for (i = 0; i < 100000; i++);
  }
  while (1);
})";

const char* const kReceiver = R"(
unsigned char buffer[108];
char all[200];
int size, packets, total, empty, nothing, j;
int main(void) {
  InitComModule(COM_MODULE_DEFAULT_GROUP, 2, 0, 1);
  nothing = IsPacketReady(0, &size);
  while (1) {
    if (IsPacketReady(buffer, &size)) {
      packets++;
      for (j = 0; j < size; j++) all[total++] = buffer[j];
    } else empty++;
  }
})";

TEST_F(RadioFirmware, packets_arrive_in_order_and_whole) {
  Robot& a = radio_robot(kSender);
  Robot& b = radio_robot(kReceiver).at(0.5, 0);
  run_for(1.5);
  EXPECT_EQ(a.variable("too_long"), 0);
  EXPECT_EQ(a.variable("sent"), 5);
  EXPECT_EQ(b.variable("packets"), 5);
  const auto all = b.variables<char>("all", 30);
  EXPECT_EQ(std::string(all.begin(), all.end()), "hello0hello1hello2hello3hello4");
  EXPECT_EQ(b.variable("size"), 6);
  EXPECT_EQ(b.variable("nothing"), 0);
  EXPECT_GT(b.variable("empty"), 20);
  ASSERT_TRUE(twin().radio());
  EXPECT_EQ(twin().radio()->counters().sent, 5);
  EXPECT_EQ(twin().radio()->counters().delivered, 5);
  expect_no_traps();
}

TEST_F(RadioFirmware, a_packet_that_nobody_fetched_makes_the_next_one_lost) {
  radio_robot(kSender);
  Robot& b = radio_robot(R"(
unsigned char buffer[108];
int size, first, second, status, cleared;
long i;
int main(void) {
  InitComModule(COM_MODULE_DEFAULT_GROUP, 2, 0, 1);
  for (i = 0; i < 1500000; i++);
  status = GetStatus();
  first = IsPacketReady(buffer, &size);
  cleared = GetStatus();
  second = IsPacketReady(buffer, &size);
  while (1);
})")
                 .at(0.5, 0);
  run_for(4);
  EXPECT_EQ(b.variable("status"), 0x07);
  EXPECT_EQ(b.variable("first"), 1);
  EXPECT_EQ(b.variable("cleared"), 0x02);
  EXPECT_EQ(b.variable("second"), 0);
  EXPECT_EQ(b.variable<unsigned char>("buffer"), 'h');
  EXPECT_EQ(b.variables<char>("buffer", 6)[5], '0');  // the first, not the last
  EXPECT_EQ(turret(1).lost(), 4);
}

TEST_F(RadioFirmware, attenuators_shorten_the_range) {
  // 50 dB at exponent 3.3: 5 m become 0.153 m
  world.radio.fading_db = 0;
  std::string source = kSender;
  source.replace(source.find("1, 0, 1)"), 8, "1, 1, 31)");
  radio_robot(source);
  Robot& near = radio_robot(kReceiver).at(0.15, 0);
  Robot& far = radio_robot(kReceiver).at(-0.16, 0);
  run_for(1.5);
  EXPECT_EQ(near.variable("packets"), 5);
  EXPECT_EQ(far.variable("packets"), 0);
}

TEST_F(RadioFirmware, a_hundred_robots_do_not_depend_on_threads) {
  const char* const source = R"(
#include <stdlib.h>
unsigned char out[4], in[108];
int size, sent, packets, bad;
int main(void) {
  int address = rand();
  InitComModule(COM_MODULE_DEFAULT_GROUP, address, 0, 15);
  while (1) {
    out[0] = sent;
    out[1] = address;
    out[2] = out[0] ^ out[1];
    if (SendPacket(COM_MODULE_DEFAULT_GROUP, 0xFFFF, out, 3)) sent++;
    if (IsPacketReady(in, &size)) {
      packets++;
      if (size != 3 || in[2] != (in[0] ^ in[1])) bad++;
    }
  }
})";
  const std::string folder = radio_robot(source).settings().firmware;
  std::uint64_t digests[2];
  for (int round = 0; round < 2; ++round) {
    sim::WorldDesc w = world;
    w.physics_hz = 96;
    twin::Options o;
    o.threads = round == 0 ? 1 : 3;
    for (int i = 0; i < 100; ++i) {
      sim::RobotDesc r;
      r.name = "r" + std::to_string(i);
      r.firmware = folder;
      r.parts.push_back({"radio", {}, 0});
      r.pose = {0.3 * (i % 10), 0.3 * (i / 10), 0};
      w.robots.push_back(r);
    }
    w.radio.range_m = 1;
    std::vector<std::string> problems;
    auto twin = twin::Twin::open(w, o, problems);
    ASSERT_TRUE(twin) << problems.front();
    twin->simulation().run_until(sim::from_seconds(1));
    digests[round] = twin->simulation().digest();
    const sim::RadioCounters& k = twin->radio()->counters();
    EXPECT_GT(k.sent, 500);
    EXPECT_GT(k.delivered, 100);
    EXPECT_GT(k.by_collision, 0);
    EXPECT_GT(k.out_of_range, 0);
    EXPECT_EQ(k.delivered + k.out_of_range + k.by_chance + k.by_collision + k.while_sending + k.switched_off,
              k.sent * 99);
    int packets = 0;
    for (int i = 0; i < 100; ++i) {
      std::int16_t value = 0;
      auto bytes = twin->mind(i).runner()->data().read_variable("packets", 2);
      std::memcpy(&value, bytes.data(), 2);
      packets += value;
      bytes = twin->mind(i).runner()->data().read_variable("bad", 2);
      std::memcpy(&value, bytes.data(), 2);
      EXPECT_EQ(value, 0) << "robot " << i;
    }
    EXPECT_GT(packets, 100);
  }
  EXPECT_EQ(digests[0], digests[1]);
}

}  // namespace
