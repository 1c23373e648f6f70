// SPDX-License-Identifier: MIT
// A run as one file: what it holds is the run, and writing it changes nothing.
#include <malloc.h>
#include <zlib.h>

#include "hal_sim/twin/world_file.h"
#include "tests/viewer/page_client.h"
#include "twinpuck_paths.h"
#include "viewer/report.h"
#include "viewer/trace_feed.h"

namespace {

using namespace viewer_test;

const char* const kWorld = R"(twinpuck = 1
[arena]
size = [2.0, 1.0]
[[robot]]
name = "puck"
firmware = "drive"
position = [-0.5, 0]
)";

// drives, says <so> once, and divides by zero after 0.5 s
const char* const kDrive = R"(#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <uart/e_uart_char.h>

volatile int rounds, zero;
static void count(void) { rounds++; }
int main(void) {
  e_init_port();
  e_init_uart1();
  e_init_motors();
  e_activate_agenda(count, 1000);
  e_start_agendas_processing();
  e_set_led(3, 1);
  e_send_uart1_char("</script>\r\n", 11);
  e_set_speed_left(500);
  e_set_speed_right(500);
  while (rounds < 5) ;
  return 1 / zero;
}
)";

std::string from_base64(const std::string& text) {
  std::string out;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char c : text) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((bits += 6) >= 8) out += static_cast<char>(word >> (bits -= 8) & 255);
  }
  return out;
}

class Report : public ViewTest {
 protected:
  Report() {
    write("world.toml", kWorld);
    write("drive/main.c", kDrive);
    write("page/index.html", "<link rel=\"stylesheet\" href=\"page.css\"><script src=\"start.js\"></script>");
    write("page/page.js", "'</script>'");
    write("page/page.css", "b{}");
    twin::Options options;
    options.world_folder = folder_.string();
    auto loaded = twin::load_world(path("world.toml"));
    twin_ = twin::Twin::open(std::move(*loaded.world), options, problems_);
  }
  /// Runs for that long with a report; the file is then in text_.
  void run(double seconds) {
    viewer::Report report(path("run.html"), *twin_, path("page"), true);
    ASSERT_EQ(report.error(), "");
    report.sample();
    while (twin_->simulation().now() < sim::from_seconds(seconds)) {
      twin_->simulation().step();
      report.sample();
    }
    ASSERT_EQ(report.finish(R"({"seed": 7})"), "");
    text_ = read("run.html");
  }
  /// What stands in the element of that id.
  std::string piece(const std::string& id) const {
    const std::size_t at = text_.find('>', text_.find("id=\"" + id + "\"")) + 1;
    return text_.substr(at, text_.find("</script>", at) - at);
  }
  std::vector<std::string> frames(std::size_t size) const {
    const std::string packed = from_base64(piece("frames"));
    std::string plain(64u << 20, '\0');
    uLongf length = plain.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(plain.data()), &length,
                         reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
              Z_OK);
    std::vector<std::string> out(length / size, std::string(size, '\0'));
    for (std::size_t i = 0; i < length; ++i) out[i % out.size()][i / out.size()] = plain[i];
    return out;
  }

  std::unique_ptr<twin::Twin> twin_;
  std::string text_;
};

TEST_F(Report, holds_the_run_frame_by_frame) {
  ASSERT_TRUE(twin_) << problems_.front();
  run(1.0);
  const Json piece_ = Json::parse(piece("report"));
  EXPECT_EQ(piece_.at("summary").at("seed"), 7);
  EXPECT_EQ(piece_.at("hello").at("world").at("robots").at(0).at("name"), "puck");
  EXPECT_EQ(piece_.at("names").at(0), "puck.x");
  const auto all = frames(piece_.at("frame_bytes"));
  ASSERT_EQ(all.size(), 51u);  // 0, 0.02 .. 1 s
  double x;
  std::memcpy(&x, all.back().data() + 48, sizeof x);
  EXPECT_EQ(x, twin_->simulation().pose(0).x_m);
  double time_s;
  std::memcpy(&time_s, all[25].data() + 8, sizeof time_s);
  EXPECT_NEAR(time_s, 0.5, 0.0021);  // the first tick then or later
}

TEST_F(Report, tells_serial_text_traps_and_time_line) {
  run(1.0);
  const Json events = Json::parse(piece("report")).at("events");
  std::map<std::string, Json> by_name;
  for (const Json& event : events) by_name[event.at("event")] = event;
  EXPECT_EQ(by_name.at("serial").at("text"), "</script>\r\n");
  EXPECT_EQ(by_name.at("trap").at("kind"), "math error");
  const Json trace = by_name.at("trace");
  int agendas = 0;
  for (const Json& span : trace.at("spans")) agendas += span.at(0) == 4 && span.at(3) == "count";
  EXPECT_EQ(agendas, 9);  // 5 up to the trap, 4 behind the reset
  EXPECT_EQ(trace.at("signals").at(3), Json({"LED3", 1}));
  bool is_lit = false;
  for (const Json& change : trace.at("changes")) is_lit = is_lit || (change.at(0) == 3 && change.at(2) == 1);
  EXPECT_TRUE(is_lit);
}

TEST_F(Report, changes_no_digest) {
  run(1.0);
  twin::Options options;
  options.world_folder = folder_.string();
  auto plain = twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), options, problems_);
  plain->simulation().run_until(sim::from_seconds(1.0));
  EXPECT_EQ(plain->simulation().digest(), twin_->simulation().digest());
}

TEST_F(Report, of_a_long_run_has_its_frames_farther_apart) {
  run(80.0);
  const auto all = frames(Json::parse(piece("report")).at("frame_bytes"));
  EXPECT_EQ(all.size(), 2001u);
  double time_s;
  std::memcpy(&time_s, all[1000].data() + 8, sizeof time_s);
  EXPECT_NEAR(time_s, 40, 0.0021);
}

// a line that sends without a pause changes some 70,000 times a second, 24 bytes each: all of them would be 30 MB
TEST_F(Report, forgets_old_changes_of_a_line_that_never_rests) {
  write("drive/main.c",
        "#include <stdio.h>\n#include <uart/e_uart_char.h>\n"
        "int main(void) { e_init_uart1(); for (;;) printf(\"hello\\n\"); }\n");
  twin::Options options;
  options.world_folder = folder_.string();
  const auto open = [&] {
    return twin::Twin::open(std::move(*twin::load_world(path("world.toml")).world), options, problems_);
  };
  twin_ = open();
  {
    viewer::Report report(path("run.html"), *twin_, path("page"), true);
    const auto begin = mallinfo2().uordblks;
    while (twin_->simulation().now() < sim::from_seconds(20)) {
      twin_->simulation().step();
      report.sample();
    }
    EXPECT_LT(mallinfo2().uordblks, begin + (15u << 20));
  }
  twin_ = open();
  viewer::TraceFeed feed(*twin_, 0, {"TX1"});
  while (twin_->simulation().now() < sim::from_seconds(1)) {
    twin_->simulation().step();
    feed.keep_last(1000);
    ASSERT_LE(feed.kept(), 4000u);
  }
  const Json trace = feed.take(1000);
  EXPECT_EQ(trace.at("changes").size(), 1000u);
  EXPECT_GT(trace.at("lost"), 30000);
}

TEST_F(Report, without_a_bundled_page_is_refused) {
  const viewer::Report report(path("run.html"), *twin_, path("nowhere"), true);
  EXPECT_TRUE(wording::reads(
      report.error(),
      "@/run.html: --report: got no bundled page, expected one in @/nowhere; `make page` makes it",
      {{folder_.string(), "@"}}));
}

}  // namespace
