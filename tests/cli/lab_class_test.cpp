// SPDX-License-Identifier: MIT
// twinpuck lab for classes: whatever a student hands in comes to a row; a run that failed is shown again.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;
using wording::replaced;

namespace {

fs::path reference(const char* name) { return fs::path(TWINPUCK_SOURCE_DIR) / "firmware/lab" / name; }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class LabClass : public CommandTest {
 protected:
  static constexpr const char* kStands = "int main(void) { while (1); }\n";

  /// One of our programs, as `student` hands it in.
  void hand_in(const std::string& student, const char* program, const std::string& below = "") const {
    const fs::path home = folder / "class" / student / below;
    fs::create_directories(home);
    fs::copy(reference(program), home / program, fs::copy_options::recursive);
    fs::remove(home / program / "test.cpp");
  }
  /// The command in this test's folder.
  Said here(const std::string& arguments) const { return twinpuck(arguments, "cd '" + path("") + "' &&"); }
  /// A line of the table, with single spaces.
  static std::string row(const std::string& text, const std::string& student) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind(student + " ", 0) != 0) continue;
      std::istringstream words(line);
      std::string all;
      for (std::string word; words >> word;) all += (all.empty() ? "" : " ") + word;
      return all;
    }
    return "";
  }
};

// hands in: all, nothing, one program deep down, what does not compile, traps, stands, hangs the compiler
TEST_F(LabClass, whatever_is_handed_in_comes_to_a_row) {
  hand_in("anna", "obstacle");
  hand_in("anna", "u_obstacle");
  hand_in("b o'b", "u_obstacle", "homework 3/controllers");
  write("class/carl/obstacle/main.c", "int main(void) { retrun 0; }\n");
  write("class/dora/obstacle/main.c", "volatile int z; int main(void) { return 1 / z; }\n");
  write("class/emil/README", "sorry\n");
  write("class/faye/obstacle/main.c", kStands);
  write("class/gus/obstacle/obstacle.py", "print(1)\n");
  write("class/.git/obstacle/main.c", kStands);
  write("class/notes.txt", "nobody\n");
  const Said s = here(
      "lab I1 I3 S2 --mine class --seeds 1 --csv t.csv --html t.html --junitxml t.xml --runs r.csv --jobs 2");
  EXPECT_EQ(s.exit_code, 1) << s.text;
  EXPECT_EQ(row(s.text, "student"), "student I1 S2 I3 passed") << s.text;
  EXPECT_EQ(row(s.text, "anna"), "anna pass seen pass 2 of 2");
  EXPECT_EQ(row(s.text, "b o'b"), "b o'b none none pass 1 of 2");
  EXPECT_EQ(row(s.text, "carl"), "carl FAIL FAIL none 0 of 2");
  EXPECT_EQ(row(s.text, "dora"), "dora FAIL FAIL none 0 of 2");
  EXPECT_EQ(row(s.text, "emil"), "emil none none none 0 of 2");
  EXPECT_EQ(row(s.text, "faye"), "faye FAIL seen none 0 of 2");
  EXPECT_EQ(row(s.text, "gus"), "gus none none none 0 of 2");
  for (const char* line :
       {"I1: avoid any obstacle in any maze: needs all 4: standstill at most 5 s, wall touch at most 0.5 s\n",
        "S2: a long, narrow corridor with a dead end: is looked at\n",
        "carl I1, S2 FAIL: ", "carl/obstacle does not build\n  ", "main.c:1:18: error: use of undeclared",
        "dora I1 FAIL: 0 of 4 runs", "math error: division by zero", "  at main (",
        "faye I1 FAIL: 0 of 4 runs neither stuck nor at a wall, max standstill 120 s",
        "  twinpuck lab --replay I1:obstacle:1 --mine class/faye --hal sim --picture I1.png --report "
        "I1.html\n"})
    EXPECT_TRUE(has(s.text, line)) << line << "\nin " << s.text;
  EXPECT_FALSE(has(s.text, "git")) << s.text;
  EXPECT_EQ(read(path("t.csv")),
            "student,I1,S2,I3,passed,judged\nanna,pass,seen,pass,2,2\nb o'b,none,none,pass,1,2\n"
            "carl,FAIL,FAIL,none,0,2\ndora,FAIL,FAIL,none,0,2\nemil,none,none,none,0,2\n"
            "faye,FAIL,seen,none,0,2\ngus,none,none,none,0,2\n");
  const std::string runs = read(path("r.csv")), page = read(path("t.html")), junit = read(path("t.xml"));
  EXPECT_EQ(runs.rfind("student,exercise,world,", 0), 0u);
  // anna: 4 + 1 + 1, bob: 1, dora and faye: 4 + 1
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 1 + 6 + 1 + 5 + 5);
  for (const char* part : {"<th>b o'b</th>", "class=\"FAIL\"", "href=\"#s5-I1\"", "--replay I1:obstacle:1",
                           "undeclared identifier", "<td>2 of 2</td>"})
    EXPECT_TRUE(has(page, part)) << part << "\nin " << page;
  // a program that does not build is told once; both its exercises lead there
  EXPECT_EQ(page.find("undeclared identifier"), page.rfind("undeclared identifier")) << page;
  EXPECT_NE(page.find("href=\"#s2-I1\""), page.rfind("href=\"#s2-I1\"")) << page;
  EXPECT_FALSE(has(page, "#s2-S2")) << page;
  EXPECT_TRUE(has(page, "<title>The lab: class</title>")) << page;
  for (const char* part :
       {"<testsuites name=\"twinpuck lab\" tests=\"21\" failures=\"3\" errors=\"2\" skipped=\"11\">",
        "<testsuite name=\"carl\" tests=\"3\" failures=\"0\" errors=\"2\" skipped=\"1\">",
        "<testcase classname=\"emil\" name=\"I1 avoid any obstacle in any maze\"><skipped message=\"no "
        "program "
        "'obstacle' in class/emil\"/>",
        "<failure message=\"0 of 4 runs"})
    EXPECT_TRUE(has(junit, part)) << part << "\nin " << junit;
  // of any number of processes, every time
  const Said again = here("lab I1 I3 S2 --mine class --seeds 1 --csv u.csv --html u.html --junitxml u.xml");
  EXPECT_EQ(again.text, s.text);
  for (const auto& [one, other] : {std::pair{"t.csv", "u.csv"}, {"t.html", "u.html"}, {"t.xml", "u.xml"}})
    EXPECT_EQ(read(path(one)), read(path(other)));
}

TEST_F(LabClass, the_page_of_the_folder_one_is_in_has_its_name) {
  write("heroes/carl/obstacle/main.c", "int main(void) { retrun 0; }\n");
  EXPECT_EQ(in_folder("cd heroes && twinpuck lab I1 --seeds 1 --mine . --html t.html").exit_code, 1);
  EXPECT_TRUE(has(read(path("heroes/t.html")), "<title>The lab: heroes</title>"));
}

TEST_F(LabClass, what_takes_too_long_is_ended_and_told) {
  hand_in("anna", "u_obstacle");
  const Said s = here("lab I3 --mine class --seeds 100000 --limit 4");
  EXPECT_EQ(s.exit_code, 1) << s.text;
  EXPECT_TRUE(has(s.text, "anna I3 FAIL: took longer than 4 s of this PC (--limit)")) << s.text;
  // a million headers: minutes
  write("class/ben/u_obstacle/h0.h", "extern volatile int n;\n");
  for (int k = 1; k <= 20; ++k) {
    const std::string half = "#include \"h" + std::to_string(k - 1) + ".h\"\n";
    write("class/ben/u_obstacle/h" + std::to_string(k) + ".h", half + half);
  }
  write("class/ben/u_obstacle/main.c", "#include \"h20.h\"\nint main(void) { return 0; }\n");
  const Said build = here("lab I3 --mine class --seeds 1 --limit 12");
  EXPECT_EQ(build.exit_code, 1) << build.text;
  EXPECT_EQ(row(build.text, "anna"), "anna pass 1 of 1") << build.text;
  EXPECT_TRUE(has(build.text, "ben/u_obstacle does not build: it took longer than 12 s")) << build.text;
}

/// Each of these once came into the program, or into the compiler's words: files of the teacher, of others, of the lab.
TEST_F(LabClass, a_submission_is_built_of_its_own_files) {
  struct Attempt {
    const char* student;
    std::string name, text, says;  // "-> x": a link
  };
  const std::string secret = write("secret.txt", "secret = 1\n");
  const Attempt attempts[] = {
      {"include", "main.c", "#include \"" + secret + "\"\n" + kStands,
       "main.c:1:10: error: include: got '@'"},
      {"other", "main.c", "#include \"../../anna/obstacle/main.c\"\n",
       "main.c:1:10: error: include: got '../../anna/obstacle/main.c'"},
      {"lab", "main.c", "#include \"" TWINPUCK_SOURCE_DIR "/firmware/lab/obstacle/main.c\"\n",
       "main.c:1:10: error: include: got '" TWINPUCK_SOURCE_DIR "/firmware/lab/obstacle/main.c'"},
      {"bytes", "main.c", "__asm__(\".incbin \\\"" + secret + "\\\"\");\n" + kStands, "include: got '@'"},
      {"octal", "main.c", "__asm__(\".incbin \\\"" + path("secre") + "\\\\164.txt\\\"\");\n" + kStands,
       "include: got '@'"},
      {"inside", "main.c", "int main(void) {\n  __asm__(\".include \\\"" + secret + "\\\"\");\n}\n",
       "main.c:2:11: error: include: got '@'"},
      {"macro", "main.c",
       "__asm__(\".macro m x\\n.incbin \\\"" + path("secre") + "\\\\x\\\"\\n.endm\\n m t.txt\");\n" + kStands,
       "include: got '@'"},
      {"assembler", "a.s", "\n .include \"" + secret + "\"\n", "a.s:2:11: error: include: got '@'"},
      {"upper", "a.S", "#include \"" + secret + "\"\n", "a.S:1:10: error: include: got '@'"},
      {"source", "p.c", "-> " + secret, "p.c: source: got '@'"},
      {"s_file", "p.s", "-> " + secret, "p.s: source: got '@'"},
      {"header", "p.h", "-> " + secret, "main.c:1:10: error: include: got 'p.h'"},
      {"folder", "b", "-> /", "main.c:1:10: error: include: got 'b" + secret + "'"},
      {"make", "Makefile", "include " + secret + "\nSRCS = main.c\nCFLAGS = -DX=$(secret)\n",
       "makefile: got '@'"},
      {"list", "Makefile", "SRCS = main.c ../../anna/obstacle/main.c\n",
       "source: got '" + path("class/anna/obstacle/main.c") + "'"},
      {"project", "", "-> " + path("class/anna/obstacle"),
       "project: got '" + path("class/anna/obstacle") + "'"},
  };
  hand_in("anna", "obstacle");
  for (const auto& [student, name, text, says] : attempts) {
    const std::string home = std::string("class/") + student + "/obstacle";
    if (name != "main.c" && !name.empty())
      write(home + "/main.c", std::string(name == "p.h" ? "#include \"p.h\"\n"
                                          : name == "b" ? "#include \"b" + secret + "\"\n"
                                                        : "") +
                                  kStands);
    const fs::path place = name.empty() ? folder / home : folder / home / name;
    fs::create_directories(place.parent_path());
    if (text.rfind("-> ", 0) == 0)
      fs::create_symlink(text.substr(3), place);
    else
      write(home + "/" + name, text);
  }
  const Said s = here("lab I1 --mine class --seeds 1");
  EXPECT_EQ(row(s.text, "anna"), "anna pass 1 of 1") << s.text;
  EXPECT_FALSE(has(s.text, "secret = 1")) << s.text;
  for (const Attempt& attempt : attempts) {
    EXPECT_EQ(row(s.text, attempt.student), std::string(attempt.student) + " FAIL 0 of 1") << s.text;
    const std::string said = replaced(attempt.says, "@", secret) + ", which lies outside " +
                             path(std::string("class/") + attempt.student) +
                             ", expected a file below it; a submission is built of its own files";
    EXPECT_TRUE(has(s.text, said)) << said << "\nin " << s.text;
  }
  // one's own, and what somebody is trusted with
  EXPECT_TRUE(
      has(here("lab I1 --mine class/other --seeds 1").text, "which lies outside " + path("class/other")));
  EXPECT_EQ(here("lab I1 --mine class/other --seeds 1 --trusted").exit_code, 0);
  EXPECT_EQ(here("build class/other/obstacle").exit_code, 0);
}

// 2 cm to and fro by the speed unit and the order of sensors that the lab's worlds take for granted
TEST_F(LabClass, programs_for_webots_are_kept_on_the_chips_machine) {
  const std::string program =
      "#include <stdio.h>\n#include <device/robot.h>\n#include <device/differential_wheels.h>\nstatic int "
      "n;\n"
      "static void reset(void) {\n#ifndef __dsPIC30F__\n  FILE *f = fopen(\"" +
      path("escaped") +
      "\", \"w\");\n  if (f) fclose(f);\n#endif\n}\n"
      "static int run(int ms) { n++; differential_wheels_set_speed(n & 8 ? 20 : -20, n & 8 ? 20 : -20); "
      "return 64; }\nint main() { robot_live(reset); robot_run(run); return 0; }\n";
  write("class/anna/u_obstacle/u_obstacle.c", program);
  const auto distance_m = [&](const std::string& options) {
    const Said s = here("lab S4 --mine class --seeds 1 --runs r.csv " + options);
    EXPECT_EQ(s.exit_code, 0) << s.text;
    std::istringstream lines(read(path("r.csv")));
    std::string line, cell;
    std::getline(lines, line);
    std::getline(lines, line);
    std::istringstream cells(line);
    for (int k = 0; k < 12; ++k) std::getline(cells, cell, ',');  // student,exercise,...,distance_m
    return std::stod(cell);
  };
  // 60 s of 20 units of 0.1 rad/s on wheels of 20.5 mm
  EXPECT_NEAR(distance_m(""), 2.46, 0.1);
  EXPECT_FALSE(fs::exists(folder / "escaped"));
  EXPECT_NEAR(distance_m("--trusted"), 2.46, 0.1);
  EXPECT_TRUE(fs::exists(folder / "escaped"));
  // of one's own: as they run in Webots; on the chip when that is said
  fs::remove(folder / "escaped");
  EXPECT_EQ(here("lab S4 --seeds 1 --mine class/anna --hal sim").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "escaped"));
}

TEST_F(LabClass, a_folder_is_a_class_when_its_folders_are_students) {
  hand_in("anna", "u_obstacle");
  // one student: as ever
  const Said one = here("lab I3 --seeds 1 --mine class/anna");
  EXPECT_TRUE(has(one.text, "I3     pass  escape from the U: 1 of 1 ")) << one.text;
  // a project of Webots, controllers in a folder of that name
  hand_in("project", "u_obstacle", "controllers");
  EXPECT_TRUE(has(here("lab I3 --seeds 1 --mine class/project").text, "I3     pass  ")) << one.text;
  // attempts of other names, when the exercise is named
  fs::create_directories(folder / "tries");
  fs::copy(reference("u_obstacle"), folder / "tries/try1", fs::copy_options::recursive);
  write("tries/try2/main.c", kStands);
  const Said tries = here("lab I3 --seeds 1 --mine tries");
  EXPECT_EQ(row(tries.text, "try1"), "try1 pass 1 of 1") << tries.text;
  EXPECT_EQ(row(tries.text, "try2"), "try2 FAIL 0 of 1") << tries.text;
  EXPECT_EQ(here("lab --seeds 1 --mine tries").exit_code, 5);
  // a student who has another program of the lab's is no class
  const Said other = here("lab I1 --seeds 1 --mine class/anna");
  EXPECT_EQ(other.exit_code, 5) << other.text;
  // two of a name: one is taken, and it is said
  hand_in("ben", "u_obstacle", "a/b");
  hand_in("ben", "u_obstacle", "a/c");
  const Said two = here("lab I3 --seeds 1 --mine class");
  EXPECT_TRUE(has(two.text, "got several folders 'u_obstacle', expected one; a/b/u_obstacle is taken"))
      << two.text;
  EXPECT_EQ(row(two.text, "ben"), "ben pass 1 of 1") << two.text;
}

TEST_F(LabClass, names_of_students_may_be_of_any_letters) {
  write("class/Zo\xc3\xab & <Co>/u_obstacle/main.c", kStands);
  write("class/\xff/u_obstacle/main.c", kStands);
  const Said s = here("lab I3 --seeds 1 --mine class --html t.html --junitxml t.xml --csv t.csv");
  EXPECT_EQ(s.exit_code, 1) << s.text;
  const std::string junit = read(path("t.xml"));
  EXPECT_TRUE(has(junit, "<testsuite name=\"Zo\xc3\xab &amp; &lt;Co&gt;\"")) << junit;
  EXPECT_TRUE(has(junit, "<testsuite name=\"?\"")) << junit;
  EXPECT_TRUE(has(read(path("t.html")), "<th>Zo\xc3\xab &amp; &lt;Co&gt;</th>"));
  EXPECT_TRUE(has(s.text, "--mine 'class/Zo\xc3\xab & <Co>' ")) << s.text;
}

TEST_F(LabClass, other_seeds_are_other_runs) {
  hand_in("anna", "u_obstacle");
  const Said s = here("lab I3 --mine class --seeds 2 --first-seed 700 --runs r.csv");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  const std::string runs = read(path("r.csv"));
  EXPECT_TRUE(has(runs, ",,700,1,")) << runs;
  EXPECT_TRUE(has(runs, ",,701,1,")) << runs;
  EXPECT_FALSE(has(runs, ",,1,1,")) << runs;
}

/// An exercise of a table, of so many runs of a second.
std::string exercise_of(const std::string& id, int runs) {
  const std::string count = std::to_string(runs);
  return "[[exercise]]\nid = \"" + id + "\"\ntitle = \"run\"\n[[exercise.step]]\nworlds = [\"wall\"]\n" +
         "firmware = \"lab/obstacle\"\nseconds = 1\nseeds = [" + count + ", " + count + "]\nsays = \"run\"\n";
}

TEST_F(LabClass, what_was_tried_before_ctrl_c_stands_in_the_tables) {
  write("t.toml", exercise_of("Q", 1) + exercise_of("L", 100000));  // the second does not end for hours
  for (const char* name : {"anna", "bob"}) write("class/" + std::string(name) + "/obstacle/main.c", kStands);
  // a student's, by exercises: the file has its first bytes behind the first one
  const Said one = twinpuck("lab --table t.toml --mine class/anna --csv r.csv --junitxml r.xml",
                            "cd '" + path("") + "' && " + signal_once("INT", path("r.csv"), 1, "0.3"));
  EXPECT_EQ(one.exit_code, 130) << one.text;
  EXPECT_TRUE(has(one.text, "lab: interrupted; tables hold what was tried\n")) << one.text;
  const std::string runs = read(path("r.csv")), suite = read(path("r.xml"));
  EXPECT_TRUE(has(runs, "\nQ,")) << runs;
  EXPECT_FALSE(has(runs, "\nL,")) << runs;
  EXPECT_TRUE(has(suite, "tests=\"1\" failures=\"0\"")) << suite;
  // a class's, by students; nothing tells from outside when the first exercise is over, so a busy PC gets
  // longer
  Said all;
  for (const char* wait : {"3", "12", "48"}) {
    all = in_folder(
        "(exec twinpuck lab --table t.toml --mine class --csv c.csv --limit 600 > out.txt) & p=$!; "
        "sleep " +
        std::string(wait) + "; kill -s INT $p; wait $p; echo code $?; cat out.txt");
    if (row(all.text, "anna") != "anna open open 0 of 2") break;
  }
  EXPECT_TRUE(has(all.text, "code 130\n")) << all.text;
  EXPECT_EQ(row(all.text, "anna"), "anna pass open 1 of 2") << all.text;
  EXPECT_EQ(row(all.text, "bob"), "bob open open 0 of 2") << all.text;
  EXPECT_EQ(read(path("c.csv")), "student,Q,L,passed,judged\nanna,pass,open,1,2\nbob,open,open,0,2\n");
}

TEST_F(LabClass, a_line_says_what_it_asks) {
  struct Case {
    const char *bounds, *says;
  };
  for (const Case& c : {
           Case{"at_most = { standstill_s = 8 }\n", "(needs all 2: standstill at most 8 s)"},
           Case{"at_least = { standstill_s = 6 }\nat_most = { standstill_s = 8 }\n",
                "(needs all 2: standstill 6 to 8 s)"},
           Case{"at_least = { standstill_s = 6 }\nshare = [0.5, 1]\n",
                "(needs 1 of 2: standstill at least 6 s)"},
           Case{"at_least = { collisions = 1 }\nshare = [0, 0]\n", "(needs none: collisions at least 1)"},
           Case{"at_least = { collisions = 1 }\nshare = [0, 0.9]\n",
                "(needs at most 1 of 2: collisions at least 1)"},
           Case{"at_least = { collisions = 0 }\nat_most = { wall_touch_s = 0.5 }\nshare = [0.4, 1]\n",
                "(needs 1 of 2: wall touch at most 0.5 s, collisions at least 0)"},
           Case{"at_least = { collisions = 0 }\nshare = [0, 1]\n", "2 of 2 stand\n"},
           Case{"noise_scales = [0, 2]\nat_least = { collisions = 1 }\nshare = [[0, 0], [0, 0.5]]\n",
                "(needs none at noise 0, at most 1 of 2 at noise 2: collisions at least 1)"},
           Case{"", "(needs all 2: a run without a trap)"},
       }) {
    const std::string table = write(
        "lab.toml",
        "[[exercise]]\nid = \"X1\"\ntitle = \"stand\"\n[[exercise.step]]\nworlds = [\"wall\"]\nseconds = 7\n"
        "seeds = [2, 3]\nsays = \"stand\"\n" +
            std::string(c.bounds));
    const Said s = twinpuck("lab --table " + table);
    EXPECT_EQ(s.exit_code, 0) << s.text;
    EXPECT_TRUE(has(s.text, c.says)) << c.bounds << s.text;
  }
  // judged by nothing: nothing is asked
  hand_in("anna", "u_obstacle");
  EXPECT_FALSE(has(here("lab S4 --seeds 1 --mine class/anna").text, "needs")) << "S is looked at";
}

TEST_F(LabClass, a_line_that_failed_has_the_command_that_shows_its_run) {
  write("mine/obstacle/main.c", kStands);
  const Said failed = here("lab I1 --seeds 2 --mine mine --csv r.csv");
  EXPECT_EQ(failed.exit_code, 1);
  const std::string command = "lab --replay I1:obstacle:1 --mine mine --picture I1.png --report I1.html";
  EXPECT_TRUE(has(failed.text, "\n             twinpuck " + command + "\n")) << failed.text;
  // as it is printed; the page of a report is a build of its own
  const bool has_page = fs::exists(TWINPUCK_BUILD_DIR "/page/page.js");
  const Said shown = here(has_page ? command : "lab --replay I1:obstacle:1 --mine mine --picture I1.png");
  EXPECT_EQ(shown.exit_code, 1) << shown.text;
  EXPECT_TRUE(has(shown.text,
                  "I1:obstacle:1: not kept: standstill 120 s, wall touch 0 s; needs standstill at most 5 s"))
      << shown.text;
  EXPECT_EQ(read(path("I1.png")).substr(1, 3), "PNG");
  if (has_page) {
    EXPECT_TRUE(has(read(path("I1.html")), "<html"));
  }
  // the very run
  const std::string runs = read(path("r.csv")),
                    row_of_it = runs.substr(runs.find("I1,obstacle,obstacle,,1,0"));
  const std::string line = row_of_it.substr(0, row_of_it.find('\n'));
  EXPECT_TRUE(has(shown.text, "seed 1, digest " + line.substr(line.rfind(',') + 1))) << line << shown.text;
}

TEST_F(LabClass, replays_are_the_runs_of_the_table) {
  // where robots start at random, their sensors differ, noise has a scale
  const Said s = twinpuck("lab I8 S15 --seeds 2 --csv " + path("r.csv"));
  EXPECT_EQ(s.exit_code, 0) << s.text;
  const auto digest_of = [&](const std::string& begin) {
    std::istringstream lines(read(path("r.csv")));
    for (std::string line; std::getline(lines, line);)
      if (line.rfind(begin, 0) == 0) return line.substr(line.rfind(',') + 1);
    return std::string("no row " + begin);
  };
  for (const auto& [trial, begin] : {std::pair{"I8:epuck:2", "I8,epuck,braiten,,2,"},
                                     {"S15:u_obstacle:2:4", "S15,u_obstacle,braiten,4,2,"},
                                     {"S15:u_obstacle:1:0.25", "S15,u_obstacle,braiten,0.25,1,"}}) {
    const Said replayed = twinpuck(std::string("lab --replay ") + trial + " --record " + path("rec.csv"));
    EXPECT_TRUE(has(replayed.text, "digest " + digest_of(begin)))
        << trial << ": " << digest_of(begin) << replayed.text;
    EXPECT_GT(read(path("rec.csv")).size(), 1000u);
  }
}

}  // namespace
