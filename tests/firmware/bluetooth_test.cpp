// SPDX-License-Identifier: MIT
// The functions of e_bluetooth.h: real packets over UART 1 to the module's model, and two robots that talk.
#include "hal_sim/board/bluetooth_module.h"
#include "tests/support/firmware_test.h"

using namespace firmware_test;

namespace {

const char* const kHead = R"(
#include <p30F6014A.h>
#include <string.h>
#include <bluetooth/e_bluetooth.h>
#include <uart/e_uart_char.h>
#include <motor_led/e_epuck_ports.h>
static void pause(int ms) { long i; long n = ms * 1000L; for (i = 0; i < n; i++); }
)";

class BluetoothFirmware : public FirmwareTest {
 protected:
  Robot& bt_robot(const std::string& source) { return add_robot_with_source(kHead + source).bluetooth(); }
  template <std::size_t N>
  static std::string text(const Robot& r, const char* name) {
    const auto bytes = r.variables<char>(name, N);
    return std::string(bytes.data(), strnlen(bytes.data(), N));
  }
};

TEST_F(BluetoothFirmware, own_name_pin_filter_reset_and_factory_settings) {
  Robot& r = bt_robot(R"(
char name[48], renamed[48], factory[48], pin[20], pin2[20], pin3[20];
int s[16], version, filter0, filter1, done;
int main(void) {
  e_init_uart1();
  s[0] = e_bt_read_local_name(name);
  s[1] = e_bt_write_local_name("walker");
  s[2] = e_bt_read_local_name(renamed);
  s[3] = e_bt_read_local_pin_number(pin);
  s[4] = e_bt_write_local_pin_number("9876");
  s[5] = e_bt_read_local_pin_number(pin2);
  filter0 = e_bt_get_event_filter();
  s[6] = e_bt_set_event_filter(0);
  filter1 = e_bt_get_event_filter();
  s[7] = e_bt_release_SPP_link();
  s[8] = e_bt_send_SPP_data("x", 1);
  s[9] = e_bt_tranparent_mode();
  s[10] = e_bt_list_local_paired_device();
  version = e_bt_reset();
  s[11] = e_bt_factory_reset();
  e_bt_read_local_name(factory);
  e_bt_read_local_pin_number(pin3);
  done = 1;
  while (1);
})");
  r.settings().link.number = 1234;
  ASSERT_TRUE(run_until([&] { return r.variable("done") == 1; }, 5));
  const auto s = r.variables("s", 12);
  for (int i : {0, 1, 2, 3, 4, 5, 6, 10, 11}) EXPECT_EQ(s[static_cast<std::size_t>(i)], 0) << i;
  EXPECT_EQ(s[7], 0x1F);  // no link
  EXPECT_EQ(s[8], 0x1F);
  EXPECT_EQ(s[9], 0x1F);
  EXPECT_EQ(text<48>(r, "name"), "e-puck_1234");
  EXPECT_EQ(text<20>(r, "pin"), "1234");
  EXPECT_EQ(text<48>(r, "renamed"), "walker");
  EXPECT_EQ(text<20>(r, "pin2"), "9876");
  EXPECT_EQ(r.variable("filter0"), 1);
  EXPECT_EQ(r.variable("filter1"), 0);
  EXPECT_EQ(r.variable("version"), 212);
  EXPECT_EQ(text<48>(r, "factory"), "Serial Port Device");
  EXPECT_EQ(text<20>(r, "pin3"), "0000");
  expect_no_traps();
}

TEST_F(BluetoothFirmware, a_silenced_module_never_answers) {
  Robot& r = bt_robot(R"(
char name[48];
int s = 7, done;
int main(void) {
  e_init_uart1();
  s = e_bt_set_event_filter(2);
  while (e_uart1_sending()); /* nothing was waited for: the packet is still leaving */
  done = 1;
  e_bt_read_local_name(name);
  done = 2;
  while (1);
})");
  run_for(2);
  EXPECT_EQ(r.variable("s"), 0);
  EXPECT_EQ(r.variable("done"), 1);
}

const char* const kScanner = R"(
int pucks, status, sent, done, i, k, paired, removed, left, released, after, again, forgotten;
char own_pin[20], got[40];
int main(void) {
  e_init_uart1();
  pucks = e_bt_find_epuck();
  done = 1;
  status = e_bt_connect_epuck();
  done = 2;
  e_bt_read_local_pin_number(own_pin);
  paired = e_bt_list_local_paired_device();
  sent = e_bt_send_SPP_data("ping!", 5);
  e_bt_tranparent_mode();
  while (e_uart1_sending());
  e_send_uart1_char("more", 4);
  while (k < 4) k += e_getchar_uart1(&got[k]);
  pause(200);
  e_bt_exit_tranparent_mode();
  done = 3;
  removed = e_bt_remove_local_paired_device(0);
  left = e_bt_list_local_paired_device();
  released = e_bt_release_SPP_link();
  after = e_bt_release_SPP_link();
  done = 4;
  pause(200);
  e_bt_connect_epuck();
  again = e_bt_list_local_paired_device();
  e_bt_factory_reset();
  forgotten = e_bt_list_local_paired_device();
  done = 5;
  while (1);
})";

const char* const kEcho = R"(
char got[40], c;
int k;
int main(void) {
  e_init_uart1();
  while (1) {
    if (e_getchar_uart1(&c)) {
      got[k++] = c;
      if (k == 9) e_send_uart1_char("pong", 4);
    }
  }
})";

TEST_F(BluetoothFirmware, one_scans_finds_connects_exchanges_and_releases) {
  Robot& a = bt_robot(kScanner);
  Robot& b = bt_robot(kEcho).at(1, 0);
  b.settings().link.number = 2087;
  ASSERT_TRUE(run_until([&] { return a.variable("done") >= 1; }, 8));
  // the inquiry takes 5 s; the name and the commands around it less than one
  EXPECT_GT(now_s(), 5.0);
  EXPECT_LT(now_s(), 6.0);
  EXPECT_EQ(a.variable("pucks"), 1);
  const auto puck = a.variables<unsigned char>("e_bt_present_epuck", 11);
  EXPECT_EQ(std::vector<unsigned char>(puck.begin(), puck.begin() + 6),
            (std::vector<unsigned char>{2087 & 255, 2087 >> 8, 0x00, 0x17, 0x00, 0x08}));
  EXPECT_EQ(std::string(puck.begin() + 6, puck.begin() + 10), "2087");
  ASSERT_TRUE(run_until([&] { return a.variable("done") >= 2; }, 10));
  EXPECT_EQ(a.variable("status"), 0);
  EXPECT_TRUE(twin().bluetooth(1).is_linked());
  ASSERT_TRUE(run_until([&] { return a.variable("done") == 4; }, 5));
  EXPECT_EQ(text<20>(a, "own_pin"), "0001");  // put back
  EXPECT_EQ(a.variable("paired"), 1);
  EXPECT_EQ(a.variable("sent"), 0);
  EXPECT_EQ(text<40>(b, "got").substr(0, 9), "ping!more");
  EXPECT_EQ(text<40>(a, "got"), "pong");
  EXPECT_EQ(a.variable("removed"), 0);
  EXPECT_EQ(a.variable("left"), 0);
  EXPECT_EQ(a.variable("released"), 0);
  EXPECT_EQ(a.variable("after"), 0x1F);
  run_for(0.1);
  EXPECT_FALSE(twin().bluetooth(0).is_linked());
  EXPECT_FALSE(twin().bluetooth(1).is_linked());
  ASSERT_TRUE(run_until([&] { return a.variable("done") == 5; }, 15));
  EXPECT_EQ(a.variable("again"), 1);
  EXPECT_EQ(a.variable("forgotten"), 0) << "a factory reset forgets pairings";
  // the other side is told: indication, link released, two bytes, check 0x69 + 0x0E + 2, by the other, port 1
  const auto end = b.variables<char>("got", 18);
  EXPECT_EQ(std::string(end.begin() + 9, end.end()),
            std::string({0x02, 0x69, 0x0E, 0x02, 0, 0x79, 0x01, 0x01, 0x03}));
  expect_no_traps();
}

TEST_F(BluetoothFirmware, a_scan_ends_at_ten_and_knows_pucks_by_their_names) {
  Robot& a = bt_robot(R"(
int devices, pucks = -1;
int main(void) {
  e_init_uart1();
  devices = e_bt_inquiry(e_bt_present_device);
  pucks = e_bt_find_epuck();
  while (1);
})");
  for (int i = 0; i < 12; ++i)
    add_robot("").bluetooth().at(0.1 + 0.1 * i, 0.5).settings().link.name = "fridge";
  ASSERT_TRUE(run_until([&] { return a.variable("devices") > 0 && a.variable("pucks") >= 0; }, 20));
  EXPECT_EQ(a.variable("devices"), 10);
  EXPECT_EQ(a.variable("pucks"), 0);
}

// filters 0 and 1 are answered and waited for, above nobody waits; the next command gets its own answer
TEST_F(BluetoothFirmware, each_filter_s_answer_is_taken_by_who_asked) {
  Robot& r = bt_robot(R"(
char name[48];
int set[2], got[2], status, done;
int main(void) {
  int i;
  e_init_uart1();
  for (i = 1; i >= 0; i--) {
    set[i] = e_bt_set_event_filter(i);
    got[i] = e_bt_get_event_filter();
  }
  set[1] |= e_bt_set_event_filter(1);
  status = e_bt_read_local_name(name);
  done = 1;
  while (1);
})");
  r.settings().link.number = 1234;
  ASSERT_TRUE(run_until([&] { return r.variable("done") == 1; }, 5));
  EXPECT_EQ(r.variable("status"), 0);
  EXPECT_EQ(r.variables("set", 2), (std::vector<std::int16_t>{0, 0}));
  EXPECT_EQ(r.variables("got", 2), (std::vector<std::int16_t>{0, 1}));
  EXPECT_EQ(text<48>(r, "name"), "e-puck_1234");
}

TEST_F(BluetoothFirmware, of_a_long_friendly_name_20_bytes_are_kept) {
  Robot& a = bt_robot(R"(
struct BtDevice found[3];
int devices, done;
int main(void) {
  e_init_uart1();
  memset(found, 0x55, sizeof found);
  devices = e_bt_inquiry(found);
  e_bt_get_friendly_name(&found[0]);
  done = 1;
  while (1);
})");
  add_robot("").bluetooth().at(0.5, 0.5).settings().link.name = "a name of thirty letters, all of it";
  ASSERT_TRUE(run_until([&] { return a.variable("done") == 1; }, 20));
  EXPECT_EQ(a.variable("devices"), 1);
  const auto all = a.variables<char>("found", 87);  // 29 each: address, class, name
  EXPECT_EQ(all[29], 0x55) << "the next one is not written over";
  EXPECT_EQ(std::string(all.data() + 9, 20), "a name of thirty let");
}

TEST_F(BluetoothFirmware, nobody_in_range_is_99) {
  Robot& a =
      bt_robot("int status; int main(void) { e_init_uart1(); status = e_bt_connect_epuck(); while (1); }");
  add_robot("").bluetooth().at(10.5, 0);
  ASSERT_TRUE(run_until([&] { return a.variable("status") != 0; }, 8));
  EXPECT_EQ(a.variable("status"), 99);
}

TEST_F(BluetoothFirmware, a_wrong_pin_a_busy_and_an_absent_robot_refuse) {
  Robot& a = bt_robot(R"(
char to2[6] = {2, 0, 0, 0x17, 0, 8}, to3[6] = {3, 0, 0, 0x17, 0, 8}, to9[6] = {9, 0, 0, 0x17, 0, 8};
struct BtDevice nine = {{9, 0, 0, 0x17, 0, 8}};
int s[5], done;
int main(void) {
  e_init_uart1();
  s[0] = e_bt_etablish_SPP_link(to2);
  s[1] = e_bt_etablish_SPP_link(to9);
  s[2] = e_bt_get_friendly_name(&nine);
  e_bt_write_local_pin_number("0002");
  s[3] = e_bt_etablish_SPP_link(to2);
  s[4] = e_bt_etablish_SPP_link(to3);
  done = 1;
  while (1);
})");
  add_robot("").bluetooth().at(0.2, 0);
  add_robot("").bluetooth().at(0.4, 0);
  ASSERT_TRUE(run_until([&] { return a.variable("done") == 1; }, 20));
  const auto s = a.variables("s", 5);
  EXPECT_EQ(s[0], 3);  // refused: its PIN is 0002, ours 0001
  EXPECT_EQ(s[1], 4);  // nobody of that address: time-out
  EXPECT_EQ(s[2], 4);
  EXPECT_EQ(s[3], 0);
  EXPECT_EQ(s[4], 2);  // we are linked already
  expect_no_traps();
}

const char* const kTalker = R"(
char to[6] = {2, 0, 0, 0x17, 0, 8};
char line[2] = "a";
int linked, n, heard;
char c, last[40];
int main(void) {
  e_init_uart1();
  e_bt_write_local_pin_number("0002");
  while (e_bt_etablish_SPP_link(to));
  e_bt_tranparent_mode();
  linked = 1;
  while (1) {
    line[0] = 'a' + n % 26;
    e_send_uart1_char(line, 1);
    while (e_uart1_sending());
    n++;
    pause(100);
    while (heard < 40 && e_getchar_uart1(&c)) last[heard++] = c;
  }
})";

const char* const kListener = R"(
char c, got[400];
int k;
int main(void) {
  e_init_uart1();
  while (k < 400) if (e_getchar_uart1(&c)) got[k++] = c;
  while (1);
})";

TEST_F(BluetoothFirmware, a_short_dropout_delays_and_loses_nothing) {
  world.link.dropouts = {{4, 2}};
  bt_robot(kTalker);
  Robot& b = bt_robot(kListener).at(0.5, 0);
  run_for(3.9);
  const int before = b.variable("k");
  EXPECT_GT(before, 3);
  run_for(0.2);
  const int at_once = b.variable("k");
  run_for(1.8);
  EXPECT_EQ(b.variable("k"), at_once);  // nothing passes from 4 to 6 s
  run_for(2);
  EXPECT_GT(b.variable("k"), at_once + 5);
  const std::string got = text<400>(b, "got");
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], static_cast<char>('a' + i % 26)) << i;
  EXPECT_TRUE(twin().bluetooth(0).is_linked());
}

TEST_F(BluetoothFirmware, a_long_dropout_ends_the_link_and_says_so) {
  world.link.timeout_s = 0.5;
  bt_robot(kTalker).settings().link.dropouts = {{4, 1}};
  bt_robot(kListener).at(0.5, 0);
  run_for(3.9);
  EXPECT_TRUE(twin().bluetooth(0).is_linked());
  EXPECT_TRUE(twin().bluetooth(1).is_transparent());
  run_for(1.5);
  EXPECT_FALSE(twin().bluetooth(0).is_linked());
  EXPECT_FALSE(twin().bluetooth(1).is_linked());
  // start, indication, link released, two bytes, check 0x69 + 0x0E + 2, lost, port 1, end
  const std::string released{0x02, 0x69, 0x0E, 0x02, 0x00, 0x79, 0x02, 0x01, 0x03};
  const auto last = robot(0).variables<char>("last", 9);
  EXPECT_EQ(std::string(last.begin(), last.end()), released);
  const auto got = robot(1).variables<char>("got", 400);
  EXPECT_NE(std::string(got.begin(), got.end()).find(released), std::string::npos);
}

TEST_F(BluetoothFirmware, links_do_not_depend_on_threads) {
  std::uint64_t digests[2];
  const std::string talker = bt_robot(kTalker).settings().firmware;
  const std::string listener = bt_robot(kListener).settings().firmware;
  for (int round = 0; round < 2; ++round) {
    sim::WorldDesc w = world;
    w.link.dropout_rate_hz = 0.5;
    w.link.dropout_span_s = 0.3;
    for (int i = 0; i < 6; ++i) {
      sim::RobotDesc r;
      r.name = "r" + std::to_string(i);
      r.firmware = i == 1 ? listener : talker;  // all want the second one; one of them gets it
      r.pose = {0.2 * i, 0, 0};
      w.robots.push_back(r);
    }
    twin::Options o;
    o.threads = round == 0 ? 1 : 3;
    std::vector<std::string> problems;
    auto twin = twin::Twin::open(w, o, problems);
    ASSERT_TRUE(twin) << problems.front();
    twin->simulation().run_until(sim::from_seconds(4));
    EXPECT_TRUE(twin->bluetooth(1).is_linked());
    digests[round] = twin->simulation().digest();
  }
  EXPECT_EQ(digests[0], digests[1]);
}

}  // namespace
