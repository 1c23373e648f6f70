// SPDX-License-Identifier: MIT
// The students' edition (make students): no line of a solution is in it, and what students do works there.
#include <set>
#include <sstream>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

const fs::path kTree = TWINPUCK_SOURCE_DIR;

std::string text_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Lines without the spaces around them, of so many characters at least.
std::set<std::string> lines_in(const fs::path& file, std::size_t least) {
  std::istringstream in(text_in(file));
  std::set<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    const auto begin = line.find_first_not_of(" \t"), end = line.find_last_not_of(" \t\r");
    if (begin != std::string::npos && end - begin + 1 >= least)
      lines.insert(line.substr(begin, end - begin + 1));
  }
  return lines;
}

class Students : public CommandTest {
 protected:
  static Said students(const std::string& arguments) {
    return twinpuck("", "python3 scripts/students.py " + arguments + " 2>&1 #");
  }
  /// The edition, made once for all tests.
  static void SetUpTestSuite() {
    edition =
        fs::path(::testing::TempDir()) / ("twinpuck-" + std::to_string(getpid()) + "-edition") / "twinpuck";
    const Said made = students(edition.string());
    ASSERT_EQ(made.exit_code, 0) << made.text;
  }
  static void TearDownTestSuite() { fs::remove_all(edition.parent_path()); }
  /// The command as the edition's own.
  Said in_edition(const std::string& arguments) const {
    return twinpuck(arguments, "cd '" + path("") + "' && TWINPUCK_ROOT='" + edition.string() + "'");
  }
  static fs::path edition;
};
fs::path Students::edition;

TEST_F(Students, no_line_of_a_solution_is_in_the_edition) {
  for (const char* gone : {"firmware/lab", "firmware/blink/test.cpp", "docs/lab-answers.md",
                           "programs/supervisors/soccer_drop", "tests", ".git"})
    EXPECT_FALSE(fs::exists(edition / gone)) << gone;
  for (const char* there :
       {"firmware/braitenberg/main.c", "docs/start.md", "docs/lab.toml", "worlds/u_obstacle.toml",
        "programs/supervisors/soccer/soccer.c", "tools/templates/project/main.c"})
    EXPECT_TRUE(fs::exists(edition / there)) << there;
  // what solutions share with every program of the robot is no solution
  std::set<std::string> secret, common;
  for (const auto& entry : fs::directory_iterator(kTree / "firmware"))
    if (entry.path().filename() != "lab" && fs::exists(entry.path() / "main.c"))
      for (const std::string& line : lines_in(entry.path() / "main.c", 1)) common.insert(line);
  for (const char* solution : {"obstacle", "u_obstacle", "braiten"})
    for (const char* file : {"main.c", "README.md"})
      for (const std::string& line : lines_in(kTree / "firmware/lab" / solution / file, 25))
        if (!common.count(line) && line.find("SPDX") == std::string::npos && line.rfind("#include", 0) != 0)
          secret.insert(line);
  EXPECT_GT(secret.size(), 60u);
  for (const std::string& line : lines_in(kTree / "docs/lab-answers.md", 50)) secret.insert(line);
  EXPECT_GT(secret.size(), 150u);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(edition)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".png") continue;
    ++files;
    for (const std::string& line : lines_in(entry.path(), 25))
      EXPECT_EQ(secret.count(line), 0u) << entry.path() << ": " << line;
  }
  EXPECT_GT(files, 1000);
  // pages lead nowhere that is gone
  const std::string lab = text_in(edition / "docs/start.md");
  for (const char* word : {"](lab-answers", "](../firmware/lab", "<!-- ", "wobbles"})
    EXPECT_EQ(lab.find(word), std::string::npos) << word;
  EXPECT_NE(lab.find("#### I1: obstacle.c"), std::string::npos);
}

TEST_F(Students, what_students_do_works_there) {
  // make run has a program
  const Said make = twinpuck("", "make -n -C '" + edition.string() + "' run 2>&1 #");
  EXPECT_NE(make.text.find("--fw '*=braitenberg'"), std::string::npos) << make.text;
  const Said run = in_edition("run maze --fw '*=braitenberg' --for 2");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  fs::create_directories(folder / "mine");
  fs::copy(kTree / "firmware/lab/u_obstacle", folder / "mine/u_obstacle", fs::copy_options::recursive);
  const Said mine = in_edition("lab --seeds 1 --mine mine");
  EXPECT_NE(mine.text.find("I3     pass  "), std::string::npos) << mine.text;
  EXPECT_EQ(in_edition("new robot").exit_code, 0);
  // without --mine: what there is to run, and what there is not
  const Said lab = in_edition("lab I1 e-puck Q6 S16 --seeds 5");
  EXPECT_EQ(lab.exit_code, 0) << lab.text;
  EXPECT_TRUE(reads(
      lab.text,
      "e-puck pass  the lab's example program, which does not avoid very well: 4 of 5 bump into something, "
      "median collisions 3, max wall touch … s, median distance … m (needs 2 of 5: collisions at least "
      "1)\nI1     none  avoid any obstacle in any maze: its solution is not in this edition of Twinpuck; "
      "--mine DIR runs a program of yours\nQ6     none  how a proximity sensor works: its answer is not in "
      "this edition of Twinpuck\nS16    none  soccer, the ball restarts 10 cm up in the air: its solution is "
      "not in this edition of Twinpuck\n1 of 1 pass, 3 without a program"));
  EXPECT_EQ(in_edition("lab I1").exit_code, 5);
  EXPECT_EQ(in_edition("lab --replay I1:corners:1").exit_code, 5);
}

TEST_F(Students, the_archive_is_the_same_every_time) {
  ASSERT_EQ(students(path("b/twinpuck")).exit_code, 0);
  const std::string one = text_in(edition.string() + ".tar.gz");
  EXPECT_GT(one.size(), 1'000'000u);
  EXPECT_TRUE(one == read(path("b/twinpuck.tar.gz")));
}

TEST_F(Students, an_installed_product_loses_its_solutions) {
  for (const char* part : {"firmware/lab", "firmware/include", "programs/supervisors/soccer_drop"})
    fs::create_directories(folder / "usr/share/twinpuck" / part);
  write("usr/share/twinpuck/firmware/lab/obstacle/main.c", "solution\n");
  write("usr/share/twinpuck/docs/lab-answers.md", "answer\n");
  write("usr/share/doc/twinpuck/lab-answers.md", "answer\n");
  write("usr/share/doc/twinpuck/start.md",
        "a\n<!-- solution -->\nhow\n<!-- /solution -->\nb [Answer](lab-answers.md#s2).\n");
  ASSERT_EQ(students("--prune " + path("usr")).exit_code, 0);
  std::set<std::string> left;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "usr"))
    if (entry.is_regular_file()) left.insert(entry.path().lexically_relative(folder).string());
  EXPECT_EQ(left, (std::set<std::string>{"usr/share/doc/twinpuck/start.md"}));
  EXPECT_EQ(read(path("usr/share/doc/twinpuck/start.md")), "a\nb\n");
  EXPECT_TRUE(fs::exists(folder / "usr/share/twinpuck/firmware/include"));
}

}  // namespace
