// SPDX-License-Identifier: MIT
// twinpuck lab: one line an exercise, the same however many processes, and honest about what fails.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <vector>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Lab : public CommandTest {
 protected:
  /// A table of one exercise about the robot of worlds/wall.toml, which runs nothing and stays where it is.
  std::string table(const std::string& bounds) const {
    return write(
        "lab.toml",
        "[[exercise]]\nid = \"X1\"\ntitle = \"stand\"\n[[exercise.step]]\nworlds = [\"wall\"]\nseconds = "
        "7\nseeds = [2, 3]\nsays = \"stand\"\n" +
            bounds);
  }

  /// A program as the lab's text has students write them: says its name, does `what` every 64 ms.
  static std::string program(const std::string& name, const std::string& what) {
    return "#include <device/robot.h>\n#include <device/differential_wheels.h>\nstatic int n;\n"
           "static void reset(void) { robot_console_printf(\"" +
           name + "\\n\"); }\nstatic int run(int ms) { n++; " + what +
           " return 64; }\nint main() { robot_live(reset); robot_run(run); return 0; }\n";
  }
};

/// What of the project's own goes into the place of a student's program.
fs::path solution(const char* name) { return fs::path(TWINPUCK_SOURCE_DIR) / "firmware/lab" / name; }

/// Names in `worlds = [...]` of the lab's table, and those of chapter 2.2. Not soccer, whose supervisor sets
/// variables of its players: no other program runs there.
std::set<std::string> worlds_of_the_lab() {
  std::ifstream in(fs::path(TWINPUCK_SOURCE_DIR) / "docs/lab.toml");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::set<std::string> names{"braitenberg", "braitenberg_four"};
  for (std::size_t at = text.find("\nworlds = ["); at != std::string::npos;
       at = text.find("\nworlds = [", at + 1)) {
    std::istringstream words(text.substr(at, text.find(']', at) - at));
    std::string name;
    std::getline(words, name, '"');
    while (std::getline(words, name, '"')) {
      names.insert(name);
      std::getline(words, name, '"');
    }
  }
  names.erase("soccer");
  return names;
}

TEST_F(Lab, every_exercise_of_the_lab_has_a_line_and_passes) {
  const Said s = twinpuck("lab --seeds 5 --no-times --jobs 2");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  std::istringstream lines(s.text);
  std::vector<std::string> ids;
  for (std::string line; std::getline(lines, line);) ids.push_back(line.substr(0, line.find(' ')));
  for (const char* id : {"e-puck", "I1", "S2", "I3", "S4", "S5", "Q6", "Q7", "I8", "Q9", "S10", "S11", "S12",
                         "I13", "S14", "S15", "S16", "Q17"})
    EXPECT_NE(std::find(ids.begin(), ids.end(), id), ids.end()) << id;
}

// `twinpuck lab --hal dspic` is all of them, in seven minutes
TEST_F(Lab, exercises_pass_with_the_robots_own_drivers_too) {
  const Said chip = twinpuck("lab e-puck I3 S16 --seeds 1 --no-times --hal dspic");
  EXPECT_EQ(chip.exit_code, 0) << chip.text;
  EXPECT_NE(chip.text.find("3 of 3 pass"), std::string::npos) << chip.text;
}

TEST_F(Lab, the_number_of_processes_changes_nothing) {
  const Said one = twinpuck("lab I3 S15 --seeds 3 --no-times --csv " + path("1.csv"));
  const Said three = twinpuck("lab I3 S15 --seeds 3 --no-times --jobs 3 --csv " + path("3.csv"));
  EXPECT_EQ(one.exit_code, 0) << one.text;
  EXPECT_EQ(one.text, three.text);
  // rows agree but for the speed, which is the PC's: column 14 of 20
  const auto rows = [&](const std::string& file) {
    std::istringstream in(read(path(file)));
    std::string all;
    for (std::string line; std::getline(in, line);) {
      std::istringstream cells(line);
      std::string cell;
      for (int k = 0; std::getline(cells, cell, ','); ++k)
        if (k != 13) all += cell + ",";
      all += "\n";
    }
    return all;
  };
  EXPECT_EQ(rows("1.csv"), rows("3.csv"));
  EXPECT_NE(read(path("1.csv")).find("I3,u_obstacle,u_obstacle,,3,1,"), std::string::npos);
}

TEST_F(Lab, a_bound_that_is_not_kept_fails_with_exit_code_1) {
  const Said good = twinpuck("lab --table " + table("at_least = { standstill_s = 6.9 }\n"));
  EXPECT_EQ(good.exit_code, 0);
  EXPECT_NE(good.text.find("X1     pass  stand: 2 of 2 stand"), std::string::npos) << good.text;
  const Said bad = twinpuck("lab --full --table " + table("at_most = { standstill_s = 6.9 }\n"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.text.find("X1     FAIL  stand: 0 of 3 stand"), std::string::npos) << bad.text;
}

TEST_F(Lab, measures_are_of_the_way_that_was_driven) {
  write(
      "drive/main.c",
      "#include <motor_led/e_init_port.h>\n#include <motor_led/e_motors.h>\nint main(void) { e_init_port(); "
      "e_init_motors(); e_set_speed_left(500); e_set_speed_right(500); for (;;) continue; }\n");
  const auto world = [&](const std::string& name, const std::string& more) {
    write(name + ".toml", "twinpuck = 1\n" + more + "[[robot]]\nname = \"puck\"\n");
    return "worlds = [\"" + path(name) + "\"]\nfirmware = \"" + path("drive") +
           "\"\nseconds = 4\nseeds = [1, 1]\n";
  };
  const auto measured = [&](const std::string& step) {
    write("l.toml", "[[exercise]]\nid = \"X\"\ntitle = \"x\"\n[[exercise.step]]\nsays = \"drive\"\n" + step);
    EXPECT_EQ(twinpuck("lab --table " + path("l.toml") + " --csv " + path("l.csv")).exit_code, 0);
    std::istringstream lines(read(path("l.csv")));
    std::string names, values, name, value;
    std::getline(lines, names);
    std::getline(lines, values);
    std::map<std::string, double> all;
    for (std::istringstream n(names), v(values); std::getline(n, name, ',') && std::getline(v, value, ',');)
      all[name] = std::atof(value.c_str());
    return all;
  };
  // 64 mm/s for a little less than 4 s; a quarter is lost on this floor
  auto m = measured(world("free", "[world]\nslip = 0.25\n"));
  EXPECT_NEAR(m["distance_m"], 0.75 * 0.064 * 3.97, 0.004);
  EXPECT_NEAR(m["slip_m"], 0.25 * 0.064 * 3.97, 0.002);
  EXPECT_EQ(m["collisions"], 0);
  EXPECT_NEAR(m["standstill_s"], 0.02 / 0.048, 0.05);  // until it has come on by 2 cm
  // a wall 63 mm before it, after a second
  m = measured(world("wall", "[[box]]\nposition = [0.11, 0]\nsize = [0.02, 0.6, 0.1]\n"));
  EXPECT_NEAR(m["distance_m"], 0.063, 0.001);
  EXPECT_EQ(m["collisions"], 1);
  EXPECT_NEAR(m["wall_touch_s"], 2.99, 0.03);
  EXPECT_NEAR(m["touch_s"], 2.99, 0.03);
  EXPECT_NEAR(m["standstill_s"], 3, 0.05);
  EXPECT_NEAR(m["slip_m"], 3 * 0.064, 0.002);
  // out of a region that ends 2 cm before it, and the run ends
  m = measured(world("open", "") + "region = [-1, -1, 0.02, 1]\n");
  EXPECT_NEAR(m["escape_s"], 0.02 / 0.064 + 0.03, 0.01);
  EXPECT_NEAR(m["distance_m"], 0.02, 0.0005);
}

TEST_F(Lab, mistakes_are_named_with_their_place) {
  const Said key = twinpuck("lab --table " + table("at_mots = { standstill_s = 1 }\n"));
  EXPECT_EQ(key.exit_code, 2);
  EXPECT_NE(key.text.find("lab.toml:9:"), std::string::npos) << key.text;
  EXPECT_NE(key.text.find("unknown key 'at_mots'; did you mean 'at_most'?"), std::string::npos) << key.text;
  EXPECT_NE(twinpuck("lab --table " + table("at_most = { standstil_s = 1 }\n"))
                .text.find("did you mean 'standstill_s'?"),
            std::string::npos);
}

TEST_F(Lab, the_share_against_noise_is_drawn) {
  EXPECT_EQ(twinpuck("lab S15 --seeds 1 --plot " + path("p.png")).exit_code, 0);
  EXPECT_EQ(read(path("p.png")).substr(1, 3), "PNG");
  EXPECT_EQ(twinpuck("lab S15 --seeds 1 --plot /nonexistent/p.png").exit_code, 7);
}

TEST_F(Lab, a_students_program_drives_alike_in_all_worlds_of_the_lab) {
  // to and fro by 2 cm, which is free everywhere; what its sensor 2 is, front left, says [webots]
  write("to_and_fro/to_and_fro.c",
        program("x", "differential_wheels_set_speed(n & 8 ? 20 : -20, n & 8 ? 20 : -20);"));
  const auto worlds = worlds_of_the_lab();
  EXPECT_GE(worlds.size(), 20u);
  for (const std::string& world : worlds) {
    const Said s =
        twinpuck("run " + world + " --fw " + path("to_and_fro") + " --for 8 -q --summary " + path("s.json"));
    ASSERT_EQ(s.exit_code, 0) << world << ": " << s.text;
    const auto summary = nlohmann::json::parse(read(path("s.json")));
    // 20 units of 0.1 rad/s on wheels of 20.5 mm: 41 mm/s
    EXPECT_NEAR(summary["robots"][0]["distance_m"].get<double>(), 0.328, 0.02) << world;
    const std::string text = read((fs::path(TWINPUCK_SOURCE_DIR) / "worlds" / (world + ".toml")).string());
    EXPECT_NE(text.find("sensor_order = \"lab\""), std::string::npos) << world;
  }
}

TEST_F(Lab, a_students_folder_goes_before_the_solution_of_its_name) {
  const std::string stand = program("it is mine", "");
  write("work/obstacle/obstacle.c", stand);
  const std::string here = "cd " + path("work") + " &&";
  // here, also where world and program are called the same
  Said s = twinpuck("run obstacle --for 1", here);
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NE(s.text.find("it is mine"), std::string::npos) << s.text;
  // beside the world
  const fs::path world = fs::path(TWINPUCK_SOURCE_DIR) / "worlds/obstacle.toml";
  fs::copy(world, folder / "work/maze.toml");
  s = twinpuck("run " + path("work/maze.toml") + " --for 1");
  EXPECT_NE(s.text.find("it is mine"), std::string::npos) << s.text;
  // nobody's here: the solution; and by its own name it is always ours
  EXPECT_EQ(twinpuck("run obstacle --for 1").text.find("it is mine"), std::string::npos);
  s = twinpuck("run obstacle --fw lab/obstacle --for 1", here);
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(s.text.find("it is mine"), std::string::npos) << s.text;
  s = twinpuck("lab I1 --seeds 1 --no-times", here);
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_EQ(s.text, twinpuck("lab I1 --seeds 1 --no-times").text);
}

TEST_F(Lab, the_names_of_the_lab_are_free_for_new_controllers) {
  const fs::path ours = TWINPUCK_SOURCE_DIR;
  fs::create_directories(folder / "root/firmware");
  for (const char* part : {"lab", "include"})
    fs::create_directory_symlink(ours / "firmware" / part, folder / "root/firmware" / part);
  const std::string root = "TWINPUCK_ROOT=" + path("root");
  const std::string listed = twinpuck("list controllers", root).text;
  for (const char* name : {"obstacle", "u_obstacle", "braiten"}) {
    EXPECT_FALSE(fs::exists(ours / "firmware" / name)) << name;
    EXPECT_NE(listed.find(std::string("  lab/") + name + " "), std::string::npos) << listed;
    write(std::string("root/firmware/") + name + "/main.c", "int main(void) { while (1); }\n");
  }
  // the new one is what the name means
  EXPECT_NE(twinpuck("lint obstacle", root).text.find(path("root/firmware/obstacle")), std::string::npos);
  // a room is no controller
  EXPECT_EQ(twinpuck("lint lab").exit_code, 2);
}

TEST_F(Lab, a_students_programs_are_judged_as_ours_are) {
  fs::create_directories(folder / "mine");
  fs::copy(solution("u_obstacle"), folder / "mine/u_obstacle", fs::copy_options::recursive);
  write("mine/obstacle/obstacle.c", program("x", ""));  // stands for ever
  write("mine/braiten/braiten.c", "int main() { retrun 0; }\n");
  const Said s = twinpuck("lab --seeds 1 --no-times --mine " + path("mine"));
  EXPECT_EQ(s.exit_code, 1) << s.text;
  for (const char* line :
       {"I1     FAIL  avoid any obstacle in any maze: 0 of 4 runs neither stuck nor at a wall, max "
        "standstill "
        "120 s",
        "S2     seen  a long, narrow corridor with a dead end: 0 of 1 get out within a minute",
        "I3     pass  escape from the U: 1 of 1 get out within a minute, escape ", "/braiten does not build",
        "undeclared identifier 'retrun'", "1 of 5 pass, 4 seen"})
    EXPECT_NE(s.text.find(line), std::string::npos) << line << "\nin " << s.text;
  EXPECT_NE(s.text.find("I8     FAIL  "), std::string::npos) << s.text;
  EXPECT_EQ(s.text.find("Q6"), std::string::npos) << "nothing of theirs runs there: " << s.text;
  // ours in the place of theirs measures what `lab` measures
  const auto line = [](const Said& said) { return said.text.substr(said.text.find(": ")); };
  EXPECT_EQ(line(twinpuck("lab I3 --seeds 2 --mine " + path("mine"))), line(twinpuck("lab I3 --seeds 2")));
}

TEST_F(Lab, a_program_that_is_missing_is_named_as_missing) {
  fs::create_directories(folder / "mine");
  fs::copy(solution("u_obstacle"), folder / "mine/u_obstacle", fs::copy_options::recursive);
  const Said s = twinpuck("lab I1 I3 --seeds 1 --mine " + path("mine"));
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_NE(
      s.text.find("I1     none  avoid any obstacle in any maze: no program 'obstacle' in " + path("mine")),
      std::string::npos)
      << s.text;
  EXPECT_NE(s.text.find("I3     pass"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("1 of 1 pass, 1 without a program"), std::string::npos) << s.text;
  write("other/README.md", "nothing\n");
  const Said nothing = twinpuck("lab --mine " + path("other"));
  EXPECT_EQ(nothing.exit_code, 5) << nothing.text;
  EXPECT_NE(nothing.text.find("no program 'braiten' in " + path("other")), std::string::npos) << nothing.text;
  EXPECT_EQ(twinpuck("lab --mine " + path("nowhere")).exit_code, 2);
  EXPECT_NE(twinpuck("lab Q6 --mine " + path("mine")).text.find("got 'Q6', expected one of I1 S2 I3"),
            std::string::npos);
}

TEST_F(Lab, one_controllers_folder_is_judged_too) {
  fs::copy(solution("u_obstacle"), folder / "u_obstacle", fs::copy_options::recursive);
  const Said s = twinpuck("lab --seeds 1 --mine " + path("u_obstacle"));
  EXPECT_NE(s.text.find("I3     pass"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("I1     none"), std::string::npos) << s.text;
  // of another name it is what the exercise asks for, when that is said
  fs::rename(folder / "u_obstacle", folder / "try3");
  EXPECT_EQ(twinpuck("lab --seeds 1 --mine " + path("try3")).exit_code, 5);
  EXPECT_NE(twinpuck("lab I3 --seeds 1 --mine " + path("try3")).text.find("I3     pass"), std::string::npos);
}

}  // namespace
