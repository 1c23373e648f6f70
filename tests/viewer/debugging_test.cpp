// SPDX-License-Identifier: MIT
// A robot debugged in a view: the run is repeated under the debugger, and what was done to it, too.
#include "tests/viewer/driven_world.h"

namespace {

using namespace viewer_test;

class InTheDebugger : public DrivenWorld {
 protected:
  static Json dap(Page& page, const std::string& command, const Json& arguments = Json::object()) {
    return page.good({{"do", "dap"}, {"message", {{"command", command}, {"arguments", arguments}}}})
        .at("body");
  }
  static Json stopped(Page& page, const std::string& reason) {
    return page.event("dap", [&](const Json& e) {
      return e.at("name") == "stopped" && e.at("body").at("reason") == reason;
    });
  }
  static Json break_at(Page& page, const std::string& file, int line, const std::string& condition = "") {
    return dap(page, "setBreakpoints",
               {{"source", {{"path", file}}}, {"breakpoints", {{{"line", line}, {"condition", condition}}}}});
  }
  static std::int64_t clicks(Page& page) { return page.good({{"do", "state"}}).at("state").at("clicks"); }
  static std::string evaluate(Page& page, const std::string& expression) {
    return dap(page, "evaluate", {{"expression", expression}}).at("result");
  }
  int line_of(const std::string& text) const {
    const std::string source = kDrive;
    return 1 + static_cast<int>(std::count(
                   source.begin(), source.begin() + static_cast<std::ptrdiff_t>(source.find(text)), '\n'));
  }
};

TEST_F(InTheDebugger, a_robot_stops_steps_and_goes_back) {
  Page page(open("world.toml"));
  page.event("hello");
  steps(page, 10);
  page.good({{"do", "set"}, {"robot", "puck"}, {"variable", "speed"}, {"value", 250}});
  steps(page, 10);
  const auto began = clicks(page);
  const double x = page.frame([](const Frame& f) { return f.time_s > 0.6; }).body.at(0).x;
  page.good({{"do", "debug"}, {"robot", "puck"}});
  page.event("state", [](const Json& e) { return e.at("state").at("debugging") == "puck"; });
  EXPECT_LE(std::abs(clicks(page) - began), sim::kClicksPerSecond / 512) << "it stands where the run stood";
  EXPECT_NEAR(page.frame().body.at(0).x, x, 1e-5);
  EXPECT_EQ(evaluate(page, "speed").substr(0, 3), "250") << "what was done to the run was done again";
  const std::string file = path("drive/main.c");
  EXPECT_EQ(break_at(page, file, line_of("e_set_speed_left(speed)")).at("breakpoints").at(0).at("verified"),
            true);
  dap(page, "continue", {{"threadId", 1}});
  stopped(page, "breakpoint");
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("playing"), false) << "it stands, and says so";
  const Json frames = dap(page, "stackTrace", {{"threadId", 1}}).at("stackFrames");
  EXPECT_EQ(frames.at(0).at("name"), "main");
  EXPECT_EQ(frames.at(0).at("line"), line_of("e_set_speed_left(speed)"));
  const int rounds = std::stoi(evaluate(page, "rounds"));
  dap(page, "continue", {{"threadId", 1}});
  stopped(page, "breakpoint");
  EXPECT_EQ(std::stoi(evaluate(page, "rounds")), rounds + 1);
  dap(page, "reverseContinue", {{"threadId", 1}});
  stopped(page, "breakpoint");
  EXPECT_EQ(std::stoi(evaluate(page, "rounds")), rounds) << "back";
  dap(page, "next", {{"threadId", 1}});
  stopped(page, "step");
  EXPECT_EQ(dap(page, "stackTrace", {{"threadId", 1}}).at("stackFrames").at(0).at("line"),
            line_of("e_set_speed_right(speed)"));
  EXPECT_EQ(page.refusal({{"do", "dap"}, {"message", {{"command", "nonsense"}}}}),
            "command: got 'nonsense', expected one of the Debug Adapter Protocol");
  EXPECT_EQ(page.refusal({{"do", "dap"}, {"message", {{"command", "disconnect"}}}}),
            "dap: got disconnect, expected `debug` without a robot");
  EXPECT_EQ(page.refusal({{"do", "dap"}, {"message", {{"command", "setBreakpoints"}}}}),
            "arguments: got none or others, expected those of the Debug Adapter Protocol");
}

TEST_F(InTheDebugger, plays_pauses_takes_inputs_and_lets_go) {
  Page page(open("world.toml"));
  page.event("hello");
  steps(page, 5);
  page.good({{"do", "speed"}, {"factor", "max"}});
  page.good({{"do", "debug"}, {"robot", "puck"}});
  page.good({{"do", "selector"}, {"robot", "puck"}, {"position", 4}});
  page.good({{"do", "play"}});
  page.frame([](const Frame& f) { return f.time_s > 1 && (f.leds.at(0) & 0xFF) == 16; });
  page.good({{"do", "pause"}});
  stopped(page, "pause");
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("playing"), false);
  EXPECT_EQ(page.refusal({{"do", "step"}}), "a robot is debugged: step its program, or end that first")
      << "its program is stepped instead";
  page.good({{"do", "debug"}, {"robot", ""}});
  const Json state = page.good({{"do", "state"}}).at("state");
  EXPECT_EQ(state.at("debugging"), "");
  EXPECT_EQ(page.refusal({{"do", "dap"}, {"message", {{"command", "pause"}}}}),
            "no robot is debugged; debug one first");
  // and goes on, as the same run
  const auto stands = state.at("clicks").get<std::int64_t>();
  steps(page, 3);
  EXPECT_GT(clicks(page), stands);
  EXPECT_EQ(page.frame([&](const Frame& f) {
                  return f.time_s * sim::kClicksPerSecond > static_cast<double>(stands);
                }).leds.at(0) &
                0xFF,
            16u);
}

TEST_F(InTheDebugger, the_run_is_the_same_with_it_and_without) {
  const auto digest_after = [&](bool debugged) {
    open("world.toml");
    Page page(view());
    page.event("hello");
    steps(page, 10);
    page.good({{"do", "move"}, {"robot", "puck"}, {"x", -0.4}, {"y", 0.1}, {"heading", 0.5}});
    steps(page, 10);
    if (debugged) {
      page.good({{"do", "debug"}, {"robot", "puck"}});
      page.good({{"do", "debug"}, {"robot", ""}});
    }
    steps(page, 10);
    return page.good({{"do", "state"}}).at("state").at("digest").get<std::string>();
  };
  EXPECT_EQ(digest_after(true), digest_after(false));
}

// by its source, at the run's begin and on the way, and by another program's name
TEST_F(InTheDebugger, a_program_that_was_replaced_on_the_way_is_debugged) {
  std::string other = kDrive;
  other.replace(other.find("e_set_speed_left(speed)"), 23, "\n    e_set_speed_left(-speed)");
  const int line = line_of("e_set_speed_left(speed)") + 1;
  const auto digest_after = [&](int before, bool by_name, bool debugged) {
    write("drive/main.c", kDrive);
    write("back/main.c", other);
    Page page(open("world.toml"));
    const int robot = page.event("hello").at("world").at("robots").at(0).at("id");
    if (before > 0) steps(page, before);
    if (by_name)
      page.good({{"do", "edit"}, {"op", "set"}, {"thing", robot}, {"values", {{"firmware", "back"}}}});
    else
      write("drive/main.c", other);
    EXPECT_TRUE(page.event("built").at("ok"));
    steps(page, 10);
    if (debugged) {
      page.good({{"do", "debug"}, {"robot", "puck"}});
      page.good({{"do", "debug"}, {"robot", ""}});
    }
    steps(page, 10);
    const std::string digest = page.good({{"do", "state"}}).at("state").at("digest");
    if (!debugged) return digest;
    page.good({{"do", "debug"}, {"robot", "puck"}});
    const std::string file = path(by_name ? "back/main.c" : "drive/main.c");
    EXPECT_EQ(break_at(page, file, line).at("breakpoints").at(0).at("verified"), true);
    const auto goes_to_line = [&](const char* way) {
      dap(page, way, {{"threadId", 1}});
      stopped(page, "breakpoint");
      EXPECT_EQ(dap(page, "stackTrace", {{"threadId", 1}}).at("stackFrames").at(0).at("line"), line) << way;
      return std::stoi(evaluate(page, "rounds"));
    };
    const int rounds = goes_to_line("reverseContinue");
    EXPECT_EQ(goes_to_line("reverseContinue"), rounds - 1);
    EXPECT_EQ(goes_to_line("continue"), rounds);
    break_at(page, file, line, "rounds == 0");
    EXPECT_EQ(goes_to_line("reverseContinue"), 0) << "where it began";
    return digest;
  };
  for (const auto& [before, by_name] : {std::pair{0, false}, {10, false}, {10, true}})
    EXPECT_EQ(digest_after(before, by_name, true), digest_after(before, by_name, false)) << before;
}

TEST_F(InTheDebugger, only_a_robot_with_firmware_is_debugged) {
  write("empty.toml",
        "twinpuck = 1\n[arena]\nsize = [1.0, 1.0]\n[[robot]]\nname = \"idle\"\nposition = [0, 0]\n");
  Page page(open("empty.toml"));
  page.event("hello");
  EXPECT_EQ(page.refusal({{"do", "debug"}, {"robot", "idle"}}),
            "robot: got 'idle', which runs no firmware, expected one with a program of the robot");
  EXPECT_EQ(page.refusal({{"do", "debug"}, {"robot", "nobody"}}),
            "robot: got 'nobody', expected a robot of the world");
  EXPECT_EQ(page.refusal({{"do", "dap"}, {"message", {{"command", "threads"}}}}),
            "no robot is debugged; debug one first");
  steps(page, 1);
}

}  // namespace
