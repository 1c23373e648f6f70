// SPDX-License-Identifier: MIT
// A world that pages look at and touch: running, stepping, inputs, edits, recordings, programs.
#include <fcntl.h>

#include <thread>

#include "hal_sim/twin/world_file.h"

#include "hal_sim/inputs/recording.h"
#include "tests/support/shell.h"
#include "tests/viewer/driven_world.h"
#include "twinpuck_paths.h"

namespace {

using namespace viewer_test;

using Session = DrivenWorld;

TEST_F(Session, tells_the_world_and_a_first_frame) {
  Page page(open("world.toml"));
  ASSERT_TRUE(page.is_open());
  const Json hello = page.event("hello");
  EXPECT_EQ(hello.at("version"), 2);
  EXPECT_EQ(hello.at("world").at("robots").at(0).at("name"), "puck");
  EXPECT_EQ(hello.at("world").at("arena").at("size"), Json({2.0, 1.0}));
  EXPECT_EQ(hello.at("programs").at(0).at("files"), Json({"main.c"}));
  EXPECT_EQ(hello.at("state").at("steering"), hello.at("you"));
  const Frame frame = page.frame();
  EXPECT_EQ(frame.robots, 1u);
  EXPECT_EQ(frame.time_s, 0);
  EXPECT_FLOAT_EQ(frame.body.at(0).x, -0.5f);
}

TEST_F(Session, plays_at_a_pace_and_pauses) {
  Page page(open("world.toml"));
  page.good({{"do", "speed"}, {"factor", "max"}});
  page.good({{"do", "play"}});
  page.frame([](const Frame& f) { return f.time_s > 20; });
  page.good({{"do", "pause"}});
  const Json state = page.good({{"do", "state"}}).at("state");
  EXPECT_FALSE(state.at("playing"));
  const double time_s = state.at("time_s");
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("time_s"), time_s);
  // a quarter of real time: at most a quarter of what passes on the clock
  page.good({{"do", "speed"}, {"factor", 0.25}});
  const auto begin = std::chrono::steady_clock::now();
  page.good({{"do", "play"}});
  const Frame later = page.frame([&](const Frame& f) { return f.time_s > time_s + 0.05; });
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_LE(later.time_s - time_s, 0.25 * took_s + 0.01);
}

TEST_F(Session, steps_a_tick_a_control_step_and_an_interrupt) {
  Page page(open("world.toml"));
  const double clicks_per_s = static_cast<double>(sim::kClicksPerSecond);
  const auto clicks = [&] { return page.good({{"do", "state"}}).at("state").at("clicks").get<double>(); };
  page.good({{"do", "step"}});
  EXPECT_EQ(clicks(), clicks_per_s / 512);
  page.good({{"do", "step"}, {"unit", "control"}});
  EXPECT_NEAR(clicks(), clicks_per_s * (1.0 / 512 + 0.032), clicks_per_s / 512);
  EXPECT_EQ(page.refusal({{"do", "step"}, {"unit", "furlong"}}),
            "unit: got \"furlong\", expected tick, control or interrupt");
}

// Timer 1 comes every 57600 cycles of 256 clocks: each second
TEST_F(Session, steps_to_the_next_interrupt_or_says_that_none_came) {
  for (const bool has_timer : {true, false}) {
    write("drive/main.c",
          std::string("#include <p30F6014A.h>\nvolatile int n;\nvoid __attribute__((interrupt, auto_psv)) "
                      "_T1Interrupt(void) { IFS0bits.T1IF = 0; n++; }\nint main(void) {\n  PR1 = 57599;\n") +
              (has_timer ? "  IEC0bits.T1IE = 1;\n" : "") + "  T1CON = 0x8030;\n  while (1) ;\n}\n");
    Page page(open("world.toml"));
    const auto time_s = [&] { return page.good({{"do", "state"}}).at("state").at("time_s").get<double>(); };
    for (int i = 1; i <= 3; ++i) {
      const Json answer = page.ask({{"do", "step"}, {"unit", "interrupt"}, {"robot", "puck"}});
      EXPECT_EQ(answer.value("error", ""), has_timer ? "" : "no interrupt came within 10 s");
      EXPECT_NEAR(time_s(), has_timer ? i : 10 * i, 0.01);
    }
  }
}

// the bar of all views: who looks changes nothing
TEST_F(Session, a_page_that_only_looks_changes_no_digest) {
  const auto digest_after = [&](bool looks) {
    open("world.toml");
    Page page(view());
    if (looks) {
      page.good({{"do", "subscribe"},
                 {"names",
                  {"puck.ir0", "puck.light3", "puck.mic0", "puck.battery", "puck.var:rounds", "puck.pin:D3",
                   "puck.load", "puck.acc_x"}}});
      page.good({{"do", "rays"}, {"robots", {"puck"}}});
    }
    steps(page, 40);
    return page.good({{"do", "state"}}).at("state").at("digest").get<std::string>();
  };
  const std::string alone = digest_after(false);
  EXPECT_EQ(digest_after(true), alone);
  EXPECT_NE(alone, "0000000000000000");
}

TEST_F(Session, subscribed_names_come_with_their_units_in_every_frame) {
  Page page(open("world.toml"));
  const Json answer = page.good({{"do", "subscribe"}, {"names", {"puck.x", "puck.var:rounds", "puck.led0"}}});
  EXPECT_EQ(answer.at("units"), Json({"m", "", ""}));
  steps(page, 10);
  const std::uint32_t mine = answer.at("subscription");
  const Frame frame = page.frame([&](const Frame& f) { return f.subscription == mine && f.time_s > 0.3; });
  EXPECT_NEAR(frame.value.at(0), frame.body.at(0).x, 1e-6);
  EXPECT_GT(frame.value.at(1), 0);
  EXPECT_EQ(frame.value.at(2), 1);
  EXPECT_EQ(page.refusal({{"do", "subscribe"}, {"names", {"puck.ir9"}}}),
            "got 'ir9', expected a name such as ir0, speed, pin:D3 or var:counter; did you mean 'ir0'?");
  EXPECT_EQ(page.refusal({{"do", "subscribe"}, {"names", {"nobody.x"}}}),
            "got 'nobody.x', expected ROBOT.NAME with a robot of the world");
}

TEST_F(Session, rays_end_where_they_meet_something) {
  Page page(open("world.toml"));
  page.good({{"do", "rays"}, {"robots", {"puck"}}});
  page.good({{"do", "move"}, {"robot", "puck"}, {"x", 0.72}, {"y", 0}, {"heading", 0}});
  const Frame frame = page.frame([](const Frame& f) { return f.rays > 0 && f.body[0].x > 0.7; });
  int met = 0;
  for (const auto& ray : frame.ray)
    if (ray[6] >= 0) {
      ++met;
      EXPECT_LE(ray[3], 0.791);  // the wall's near face is at 0.79
    }
  EXPECT_GT(met, 0);
}

TEST_F(Session, selector_serial_and_variables_reach_the_program) {
  Page page(open("world.toml"));
  page.good({{"do", "selector"}, {"robot", "puck"}, {"position", 3}});
  page.good({{"do", "set"}, {"robot", "puck"}, {"variable", "speed"}, {"value", 0}});
  steps(page, 20);
  EXPECT_EQ(page.frame([](const Frame& f) { return f.time_s > 0.5; }).leds.at(0) & 0xFF, 8u);
  page.good({{"do", "type"}, {"robot", "puck"}, {"port", 1}, {"bytes", "hi"}});
  steps(page, 20);
  std::string heard;
  while (heard.size() < 2) heard += page.event("serial").at("text").get<std::string>();
  EXPECT_EQ(heard, "hi");
  EXPECT_EQ(page.refusal({{"do", "selector"}, {"robot", "puck"}, {"position", 16}}),
            "position: got 16, expected a whole number, 0 to 15");
  EXPECT_EQ(page.refusal({{"do", "selector"}, {"robot", "nobody"}, {"position", 1}}),
            "robot: got 'nobody', expected a robot of the world");
}

TEST_F(Session, only_one_page_steers) {
  Page first(open("world.toml"));
  first.event("hello");
  Page second(view());
  second.event("hello");
  EXPECT_EQ(second.refusal({{"do", "play"}}), "another page steers; take the wheel first");
  second.good({{"do", "steer"}});
  EXPECT_EQ(first.refusal({{"do", "step"}}), "another page steers; take the wheel first");
  second.good({{"do", "step"}});
}

// docs/connecting.md's example, 40 lines of another language
TEST_F(Session, the_example_client_drives_it) {
  open("world.toml");
  const std::string command =
      "python3 " TWINPUCK_SOURCE_DIR "/tests/viewer/example_client.py " + view().server().address() + " 2>&1";
  const auto [exit_code, out] = shell::run(command);
  EXPECT_EQ(exit_code, 0) << out;
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 20) << out;
  EXPECT_NE(out.find("1.9"), std::string::npos) << out;
}

// --- touch

TEST_F(Session, a_wall_dragged_before_a_driving_robot_stops_it_and_the_file_keeps_its_style) {
  Page page(open("world.toml"));
  const int wall = thing(page.event("hello").at("world"), "wall");
  steps(page, 20);
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"position", {-0.2, 0.0}}}}});
  EXPECT_GT(page.good({{"do", "state"}}).at("state").at("time_s"), 0.5) << "the run goes on";
  steps(page, 300);
  const Frame frame = page.frame([](const Frame& f) { return f.time_s > 9; });
  EXPECT_NEAR(frame.body.at(0).x, -0.2 - 0.01 - 0.037, 0.003);
  EXPECT_EQ(read("world.toml"), kWorld) << "not saved yet";
  page.good({{"do", "save"}});
  std::string wanted = kWorld;
  wanted.replace(wanted.find("[0.80, 0.00]"), 12, "[-0.20, 0.00]");
  EXPECT_EQ(read("world.toml"), wanted);
}

TEST_F(Session, edits_are_undone_and_redone) {
  Page page(open("world.toml"));
  const int wall = thing(page.event("hello").at("world"), "wall");
  for (double x : {0.7, 0.6, 0.5})
    page.good(
        {{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"position", {x, 0}}}}, {"group", 7}});
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"colour", {0, 0, 0}}}}});
  const auto position = [&](const Json& world) {
    for (const Json& t : world.at("things"))
      if (t.at("id") == wall) return t.at("position").at(0).get<double>();
    return -99.0;
  };
  page.good({{"do", "undo"}});
  page.good({{"do", "undo"}});  // the drag as a whole
  EXPECT_EQ(
      position(
          page.event("world", [&](const Json& e) { return position(e.at("world")) == 0.8; }).at("world")),
      0.8);
  EXPECT_TRUE(page.good({{"do", "state"}}).at("state").at("saved"));
  EXPECT_EQ(page.good({{"do", "redo"}}).at("done"), true);
  EXPECT_FALSE(page.good({{"do", "state"}}).at("state").at("saved"));
  // what was undone is gone with the next edit
  page.good({{"do", "undo"}});
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"position", {0.1, 0}}}}});
  EXPECT_EQ(page.good({{"do", "redo"}}).at("done"), false);
}

TEST_F(Session, problems_stand_beside_what_they_are_about_and_the_run_goes_on) {
  Page page(open("world.toml"));
  const int wall = thing(page.event("hello").at("world"), "wall");
  steps(page, 3);
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"size", {-1, 0.5, 0.1}}}}});
  const Json world =
      page.event("world", [](const Json& e) { return !e.at("world").at("problems").empty(); }).at("world");
  EXPECT_EQ(world.at("problems").at(0).at("id"), wall);
  EXPECT_TRUE(wording::reads(
      world.at("problems").at(0).at("text"),
      "box.size: got [-1.00, 0.50, 0.1], expected three numbers [x, y, z] from 0.0005 to 1000 m"));
  steps(page, 3);
  page.good({{"do", "undo"}});
  EXPECT_TRUE(page.event("world", [](const Json& e) { return e.at("world").at("problems").empty(); })
                  .contains("world"));
}

TEST_F(Session, a_robot_added_in_the_page_runs) {
  Page page(open("world.toml"));
  page.event("hello");
  steps(page, 3);
  page.good({{"do", "edit"},
             {"op", "add"},
             {"anew", true},
             {"path", "robot"},
             {"values", {{"name", "second"}, {"firmware", "drive"}, {"position", {-0.5, 0.3}}}}});
  steps(page, 40);
  const Frame frame = page.frame([](const Frame& f) { return f.robots == 2 && f.time_s > 1.2; });
  EXPECT_GT(frame.body.at(1).x, -0.48);
}

TEST_F(Session, a_robot_copied_in_a_run_begins_anew_with_whoever_looks) {
  Page page(open("world.toml"));
  const int robot = page.event("hello").at("world").at("robots").at(0).at("id");
  page.good({{"do", "subscribe"},
             {"names", {"puck.x", "puck.ir0", "puck.light0", "puck.mic0", "puck.var:rounds"}}});
  steps(page, 5);
  page.good({{"do", "edit"},
             {"op", "copy"},
             {"anew", true},
             {"thing", robot},
             {"values", {{"name", "puck2"}, {"position", {-0.5, 0.2}}}}});
  const Frame frame = page.frame([](const Frame& f) { return f.robots == 2; });
  EXPECT_EQ(frame.time_s, 0);
  EXPECT_FLOAT_EQ(frame.body.at(1).y, 0.2f);
}

TEST_F(Session, an_edit_that_needs_a_new_run_says_why_before_it_is_done) {
  Page page(open("world.toml"));
  const int robot = page.event("hello").at("world").at("robots").at(0).at("id");
  steps(page, 5);
  const auto refused = [&](Json request) {
    request["do"] = "edit";
    const Json answer = page.ask(request);
    EXPECT_TRUE(answer.value("anew", false)) << answer.dump();
    return answer.value("error", std::string());
  };
  EXPECT_EQ(refused({{"op", "remove"}, {"thing", robot}}),
            "robots come and go only when a run begins: the run would begin anew");
  EXPECT_EQ(refused({{"op", "set"}, {"thing", robot}, {"values", {{"seed", 3}}}}),
            "`seed` of puck is set when it is switched on: the run would begin anew");
  EXPECT_EQ(
      refused(
          {{"op", "add_inner"}, {"thing", robot}, {"path", "robot.part"}, {"values", {{"kind", "compass"}}}}),
      "what is plugged into puck is there from its power-up on: the run would begin anew");
  EXPECT_EQ(refused({{"op", "text"}, {"text", std::string(kWorld) + "[world]\nseed = 4\n"}}),
            "[world] counts for a whole run: the run would begin anew");
  // nothing was done, and nothing is there to be undone
  const Json state = page.good({{"do", "state"}}).at("state");
  EXPECT_TRUE(state.at("saved"));
  EXPECT_FALSE(state.at("undo"));
  EXPECT_NEAR(state.at("time_s"), 0.16, 0.01);
  page.good({{"do", "edit"}, {"anew", true}, {"op", "set"}, {"thing", robot}, {"values", {{"seed", 3}}}});
  EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("time_s"), 0);
  // undoing it is the same question
  steps(page, 5);
  EXPECT_TRUE(page.ask({{"do", "undo"}}).value("anew", false));
  EXPECT_TRUE(page.good({{"do", "state"}}).at("state").at("undo"));
}

TEST_F(Session, a_robot_that_runs_takes_place_colour_selector_battery_and_program_from_the_file) {
  write("back/main.c",
        std::string(kDrive).replace(std::string(kDrive).find("speed = 500"), 11, "speed =-500"));
  Page page(open("world.toml"));
  const int robot = page.event("hello").at("world").at("robots").at(0).at("id");
  page.good({{"do", "subscribe"}, {"names", {"puck.selector", "puck.battery"}}});
  steps(page, 10);
  page.good({{"do", "edit"},
             {"op", "set"},
             {"thing", robot},
             {"values",
              {{"position", {0.1, 0.2}},
               {"heading", 90},
               {"colour", {1, 0, 0}},
               {"selector", 4},
               {"battery", 3.4}}}});
  steps(page, 1);
  const Frame moved = page.frame([](const Frame& f) { return f.time_s > 0.33; });
  EXPECT_NEAR(moved.body.at(0).x, 0.1, 0.002);
  EXPECT_GT(moved.body.at(0).y, 0.2);
  EXPECT_EQ(moved.value.at(0), 4);
  EXPECT_NEAR(moved.value.at(1), 3.4, 0.1);
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", robot}, {"values", {{"firmware", "back"}}}});
  page.event("programs", [](const Json& e) {
    for (const Json& p : e.at("programs"))
      if (p.at("name") == "back") return !p.at("robots").empty();
    return false;
  });
  EXPECT_TRUE(page.event("built").at("ok"));
  steps(page, 30);
  const Frame back = page.frame([](const Frame& f) { return f.time_s > 1.3; });
  EXPECT_LT(back.body.at(0).y, moved.body.at(0).y);
  // and a new run has it, too
  page.good({{"do", "restart"}});
  steps(page, 10);
  EXPECT_LT(page.frame([](const Frame& f) { return f.time_s > 0.3 && f.time_s < 1; }).body.at(0).y, 0.2);
}

TEST_F(Session, a_source_of_sound_moves_while_the_robot_hears_it) {
  write("world.toml",
        std::string(kWorld) +
            "\n[[sound]]\nname = \"horn\"\nkind = \"tone\"\nlevel = 80\nposition = [-0.5, 0.2, 0.035]\n");
  write("drive/main.c", "int main(void) { while (1); }\n");
  Page page(open("world.toml"));
  const int horn = thing(page.event("hello").at("world"), "horn");
  page.good({{"do", "subscribe"}, {"names", {"puck.sound_bearing", "puck.mic_level0", "puck.mic_level1"}}});
  steps(page, 5);
  const Frame left = page.frame([](const Frame& f) { return f.time_s > 0.15; });
  EXPECT_NEAR(left.value.at(0), 90, 3);
  // 80 dB are 0.2 Pa at 1 m; 0.169 m to the left microphone: 0.2 / 0.169 * 98.5 counts
  EXPECT_NEAR(left.value.at(2), 117, 3);
  EXPECT_LT(left.value.at(1), left.value.at(2));
  page.good({{"do", "edit"}, {"op", "set"}, {"thing", horn}, {"values", {{"position", {-0.7, 0, 0.035}}}}});
  steps(page, 5);
  const Frame behind = page.frame([](const Frame& f) { return f.time_s > 0.3; });
  EXPECT_NEAR(std::fabs(behind.value.at(0)), 180, 3);
}

TEST_F(Session, who_looks_at_a_robot_is_told_of_place_parts_and_picture) {
  write("world.toml", std::string(kWorld) +
                          "\n[[robot.part]]\nkind = \"lis-turret\"\n\n[[robot]]\nname = \"eye\"\nfirmware = "
                          "\"eye\"\nposition = [0, 0.4]\n");
  write("eye/main.c", R"(#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/e_init_port.h>
static char picture[2 * 40 * 30];
int main(void) {
  e_init_port();
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(0, 0, 640, 480, 16, 16, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  while (1) {
    e_poxxxx_launch_capture(picture);
    while (!e_poxxxx_is_img_ready())
      ;
  }
}
)");
  Page page(open("world.toml"));
  page.event("hello");
  page.good({{"do", "look"}, {"robot", "eye"}});
  const Json before = page.event("look");
  EXPECT_FALSE(before.contains("picture"));
  EXPECT_EQ(before.at("camera").at("pictures"), 0);
  steps(page, 60);
  const Json look = page.event("look", [](const Json& e) { return e.contains("picture"); });
  EXPECT_EQ(look.at("place").at("line"), 11);
  EXPECT_EQ(look.at("place").at("function"), "main");
  const Json& picture = look.at("picture");
  EXPECT_EQ(picture.at("columns"), 40);
  EXPECT_EQ(picture.at("rows"), 30);
  EXPECT_EQ(picture.at("bytes_per_pixel"), 2);
  EXPECT_EQ(picture.at("rgb").get<std::string>().size(), 40u * 30 * 4);  // base64 of three bytes a pixel
  // 640 columns cover 0.84 rad
  EXPECT_NEAR(look.at("camera").at("edges").at(1).get<double>(), std::tan(0.42), 0.03);
  page.good({{"do", "look"}, {"robot", "puck"}});
  EXPECT_EQ(page.event("look", [](const Json& e) { return e.at("robot") == "puck"; }).at("parts"),
            Json({{{"kind", "lis-turret"}, {"shows", "LEDs 00000"}}}));
}

TEST_F(Session, parts_are_plugged_in_and_unplugged) {
  Page page(open("world.toml"));
  const int robot = page.event("hello").at("world").at("robots").at(0).at("id");
  page.good({{"do", "edit"},
             {"op", "add_inner"},
             {"thing", robot},
             {"path", "robot.part"},
             {"values", {{"kind", "ground-sensors"}}}});
  const Json world = page.event("world").at("world");
  EXPECT_EQ(world.at("robots").at(0).at("parts"), Json({"ground-sensors"}));
  EXPECT_EQ(world.at("text"), std::string(kWorld) + "[[robot.part]]\nkind = \"ground-sensors\"\n");
  page.good({{"do", "edit"}, {"op", "remove_inner"}, {"thing", robot}, {"path", "robot.part"}, {"index", 0}});
  EXPECT_EQ(page.event("world").at("world").at("text"), kWorld);
  EXPECT_EQ(page.ask({{"do", "edit"},
                      {"op", "add_inner"},
                      {"thing", robot},
                      {"path", "robot.part"},
                      {"values", {{"nonsense", 1}}}})
                .at("error"),
            "key: got 'nonsense', expected a key of robot.part");
}

TEST_F(Session, a_world_drawn_from_nothing_runs_from_the_command_line) {
  write("new.toml", "twinpuck = 1\n");
  Page page(open("new.toml"));
  page.event("hello");
  page.good({{"do", "edit"},
             {"op", "add"},
             {"path", "box"},
             {"values", {{"position", {0.3, 0}}, {"size", {0.02, 0.4, 0.1}}}}});
  page.good({{"do", "edit"},
             {"op", "add"},
             {"path", "robot"},
             {"values", {{"name", "puck"}, {"firmware", "drive"}, {"position", {0, 0}}}}});
  page.good({{"do", "save_as"}, {"name", "drawn.toml"}});
  const std::string text = read("drawn.toml");
  const sim::LoadedWorld loaded = twin::parse_world(text, path("drawn.toml"));
  ASSERT_TRUE(loaded.world) << loaded.report("drawn.toml") << text;
  EXPECT_EQ(loaded.world->objects.size(), 1u);
  EXPECT_EQ(loaded.world->robots.size(), 1u);
}

TEST_F(Session, files_elsewhere_are_neither_read_nor_written) {
  Page page(open("world.toml"));
  write("secret.txt", "s");
  for (const char* name : {"../evil.toml", "/tmp/evil.toml", ".evil.toml", "evil.sh", "sub/evil.toml"})
    EXPECT_EQ(page.refusal({{"do", "save_as"}, {"name", name}}),
              "name: got '" + std::string(name) +
                  "', expected a file name that ends in .toml, for the world's own folder");
  EXPECT_EQ(page.refusal({{"do", "save_as"}, {"name", "world.toml"}}),
            "name: got 'world.toml', which is there already; overwrite it?")
      << "it is there already";
  std::filesystem::create_symlink(folder_ / "secret.txt", folder_ / "drive" / "link.c");
  for (const std::string name : {"../secret.txt", "../world.toml", "/etc/passwd", "link.c", ""}) {
    const std::string told = "file: got '" + name + "', expected one of the controller's sources";
    EXPECT_EQ(page.refusal({{"do", "source"}, {"program", "drive"}, {"file", name}}), told);
    EXPECT_EQ(page.refusal({{"do", "write_source"}, {"program", "drive"}, {"file", name}, {"text", "x"}}),
              told);
  }
  EXPECT_EQ(read("secret.txt"), "s");
  // a recording's inputs are not for pages: they name files
  EXPECT_EQ(page.refusal({{"do", "program"}, {"robots", {0}}, {"image", "/tmp/x.so"}}),
            "do: got 'program', expected a request of docs/connecting.md");
  EXPECT_EQ(page.refusal({{"do", "world"}, {"text", "twinpuck = 1"}, {"before", Json::array()}}),
            "do: got 'world', expected a request of docs/connecting.md; did you mean worlds?");
}

// --- recordings

TEST_F(Session, a_recorded_session_repeats_bit_by_bit) {
  {
    Page page(open("world.toml", path("inputs.jsonl")));
    const int wall = thing(page.event("hello").at("world"), "wall");
    page.good({{"do", "speed"}, {"factor", "max"}});
    page.good({{"do", "play"}});
    page.frame([](const Frame& f) { return f.time_s > 1; });
    page.good({{"do", "edit"}, {"op", "set"}, {"thing", wall}, {"values", {{"position", {0.1, 0}}}}});
    page.good({{"do", "type"}, {"robot", "puck"}, {"port", 1}, {"bytes", "abc"}});
    page.good({{"do", "selector"}, {"robot", "puck"}, {"position", 5}});
    page.good({{"do", "move"}, {"robot", "puck"}, {"x", -0.4}, {"y", 0.1}, {"heading", 0.3}});
    const double now_s = page.good({{"do", "state"}}).at("state").at("time_s");
    page.frame([&](const Frame& f) { return f.time_s > now_s + 3; });
  }
  close();
  std::vector<std::string> problems;
  const auto replay = inputs::Replay::open(path("inputs.jsonl"), problems);
  ASSERT_TRUE(replay) << problems.at(0);
  sim::LoadedWorld loaded = twin::parse_world(replay->opening.text, replay->opening.file);
  loaded.world->seed = replay->opening.seed;
  twin::Options options;
  options.world_folder = folder_.string();
  auto twin = twin::Twin::open(*loaded.world, options, problems);
  ASSERT_TRUE(twin);
  inputs::Inputs inputs(*twin);
  auto& simulation = twin->simulation();
  ASSERT_GT(replay->end(), 0);
  while (simulation.now() < replay->end()) {
    replay->apply_due(inputs, simulation.now());
    simulation.advance(std::min(replay->end(), replay->next()));
  }
  replay->finish(inputs, simulation, problems);
  EXPECT_TRUE(problems.empty()) << problems.at(0);
  EXPECT_EQ(simulation.digest(), replay->digest());
}

TEST_F(Session, a_recording_is_shown_again_to_its_end) {
  {
    Page page(open("world.toml", path("inputs.jsonl")));
    page.event("hello");
    steps(page, 20);
    page.good({{"do", "move"}, {"robot", "puck"}, {"x", -0.4}, {"y", 0.1}, {"heading", 0.3}});
    steps(page, 20);
  }
  close();
  auto replay = inputs::Replay::open(path("inputs.jsonl"), problems_);
  ASSERT_TRUE(replay) << problems_.at(0);
  const auto end = replay->end();
  char digest[20];
  std::snprintf(digest, sizeof digest, "%016llx", static_cast<unsigned long long>(replay->digest()));
  inputs::Opening opening = replay->opening;
  view_ = viewer::LiveView::open(std::move(opening), "", 0, path("page"), problems_, std::move(replay));
  ASSERT_TRUE(view_);
  Page page(*view_);
  page.event("hello");
  page.good({{"do", "speed"}, {"factor", "max"}});
  // each run from time 0 is the recording's, whoever begins it
  for (int run = 0; run < 2; ++run) {
    page.good({{"do", "restart"}, {"play", true}});
    Json state;
    do {
      state = page.good({{"do", "state"}}).at("state");
    } while (state.at("playing"));
    EXPECT_EQ(state.at("clicks"), end) << "it stands still there";
    EXPECT_EQ(state.at("digest"), digest);
  }
  // and may go on
  page.good({{"do", "play"}});
  page.frame([&](const Frame& f) { return f.time_s * sim::kClicksPerSecond > static_cast<double>(end); });
}

// --- programs

TEST_F(Session, a_saved_program_is_rebuilt_and_started_where_the_robot_stands) {
  Page page(open("world.toml"));
  page.event("hello");
  steps(page, 40);
  const Frame before = page.frame([](const Frame& f) { return f.time_s > 1.2; });
  const Json there = page.good({{"do", "source"}, {"program", "drive"}, {"file", "main.c"}});
  std::string source = there.at("text");
  EXPECT_EQ(source, kDrive);
  source.replace(source.find("speed = 500"), 11, "speed = -500");
  page.good({{"do", "write_source"},
             {"program", "drive"},
             {"file", "main.c"},
             {"text", source},
             {"base", there.at("base")}});
  const Json built = page.event("built");
  EXPECT_TRUE(built.at("ok")) << built;
  page.good({{"do", "step"}});
  const Frame after = page.frame([&](const Frame& f) { return f.time_s > before.time_s; });
  EXPECT_NEAR(after.body.at(0).x, before.body.at(0).x, 0.002);
  steps(page, 40);
  const Frame later = page.frame([&](const Frame& f) { return f.time_s > before.time_s + 1.2; });
  EXPECT_LT(later.body.at(0).x, before.body.at(0).x - 0.04);
}

TEST_F(Session, a_program_that_does_not_compile_leaves_the_old_one_running) {
  Page page(open("world.toml"));
  page.event("hello");
  write("drive/main.c",
        std::string(kDrive) + "\nint broken(void) { return nothing_of_that_name; }\n");  // any editor
  const Json built = page.event("built");
  EXPECT_FALSE(built.at("ok"));
  EXPECT_TRUE(
      wording::reads(built.at("problems").at(0),
                     "…/drive/main.c:31:27: error: use of undeclared identifier 'nothing_of_that_name'"));
  steps(page, 40);
  EXPECT_GT(page.frame([](const Frame& f) { return f.time_s > 1.2; }).body.at(0).x, -0.48);
  write("drive/main.c", kDrive);
  EXPECT_TRUE(page.event("built").at("ok"));
}

TEST_F(Session, a_trap_is_told_with_its_place) {
  write("drive/main.c", "int zero;\nint main(void) {\n  return 1 / zero;\n}\n");
  Page page(open("world.toml"));
  page.event("hello");
  steps(page, 3);
  const Json trap = page.event("trap");
  EXPECT_EQ(trap.at("kind"), "math error");
  EXPECT_EQ(trap.at("line"), 3);
  // it begins anew
  EXPECT_EQ(page.frame([](const Frame& f) { return f.time_s > 0.05; }).state.at(0) & viewer::kStopped, 0u);
}

// every robot's, in whichever order; who comes later is told what was
TEST_F(Session, traps_of_several_robots_are_told_once_each) {
  write("late/main.c",
        "int zero;\nvolatile long i;\nint main(void) {\n  for (i = 0; i < 40000; i++);\n  return 1 / "
        "zero;\n}\n");
  write("never/main.c",
        "#include <p30F6014A.h>\n_FOSC(CSW_FSCM_OFF & EC_PLL8);\nint main(void) { while (1); }\n");
  write("world.toml",
        "twinpuck = 1\n[arena]\nsize = [2, 1]\n"
        "[[robot]]\nname = \"a\"\nfirmware = \"late\"\nposition = [-0.5, 0]\n"
        "[[robot]]\nname = \"b\"\nfirmware = \"never\"\nposition = [0.5, 0]\n");
  Page page(open("world.toml"));
  EXPECT_EQ(page.event("hello").at("traps"), Json::array());
  steps(page, 10);
  const Json first = page.event("trap"), second = page.event("trap");
  EXPECT_EQ(first.at("robot"), "b");
  EXPECT_EQ(first.at("text"),
            "configuration word FOSC: got 0xFFEE, a source of clock that the robot has not, expected its "
            "crystal of "
            "7.3728 MHz, as with XT_PLL8");
  EXPECT_EQ(second.at("robot"), "a");
  EXPECT_EQ(second.at("line"), 5);
  Page other(view());
  const Json traps = other.event("hello").at("traps");
  ASSERT_EQ(traps.size(), 2u) << traps;
  EXPECT_EQ(traps.at(0).at("robot"), "a");
  EXPECT_EQ(traps.at(1), first);
  // a new run begins without, and tells them again
  page.good({{"do", "restart"}});
  steps(page, 10);
  EXPECT_EQ(page.event("trap").at("robot"), "b");
}

TEST_F(Session, an_endless_wait_is_explained) {
  const std::string start =
      "#include <motor_led/e_init_port.h>\n#include <motor_led/advance_one_timer/e_agenda.h>\n"
      "volatile char due;\nvoid tick(void) { due = 1; }\n"
      "int main(void) {\n  e_init_port();\n  e_activate_agenda(tick, 320);\n";
  write("drive/main.c", start + "  while (!due);\n  return 0;\n}\n");
  {
    Page page(open("world.toml"));
    steps(page, 10);
    const Json told = page.event("diagnoses", [](const Json& e) { return !e.at("diagnoses").empty(); })
                          .at("diagnoses")
                          .at(0);
    EXPECT_EQ(told.at("cause"), "endless wait");
    EXPECT_TRUE(wording::reads(told.at("place"), "main (…/drive/main.c:8)"));
  }
  // with the agendas started, or in a loop that is empty on purpose, there is nothing to say
  for (const char* end :
       {"  e_start_agendas_processing();\n  while (!due);\n  while (1);\n}\n", "  while (1);\n}\n"}) {
    close();  // or the view before would build the same program at the same time
    write("drive/main.c", start + end);
    Page page(open("world.toml"));
    steps(page, 10);
    EXPECT_EQ(page.good({{"do", "state"}}).at("state").at("diagnoses"), Json::array()) << end;
  }
}

}  // namespace
