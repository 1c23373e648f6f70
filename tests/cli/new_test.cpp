// SPDX-License-Identifier: MIT
// twinpuck new and init: folders of one's own that build, run, are debugged and read by editors as they are.
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class New : public CommandTest {
 protected:
  /// The command as a user has it: in this test's folder, found by PATH.
  Said in_folder(const std::string& arguments, const std::string& below = "") const {
    return twinpuck(arguments, "cd '" + path(below) + "' && ");
  }
  /// Another program than the command, which finds the command by PATH.
  static Said shell(const std::string& line) {
    return twinpuck("", "env PATH='" TWINPUCK_BUILD_DIR "':\"$PATH\" " + line + " 2>&1 </dev/null #");
  }
  /// Names of all files below a folder.
  std::set<std::string> files_in(const std::string& below) const {
    std::set<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder / below))
      if (entry.is_regular_file()) files.insert(entry.path().lexically_relative(folder / below).string());
    return files;
  }
};

const std::set<std::string> kMade{".clangd",
                                  ".github/workflows/test.yml",
                                  ".gitignore",
                                  ".vscode/c_cpp_properties.json",
                                  ".vscode/launch.json",
                                  ".vscode/tasks.json",
                                  "Makefile",
                                  "main.c",
                                  "robot.test.toml",
                                  "test_robot.py",
                                  "world.toml"};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(New, a_folder_of_ones_own_builds_and_runs_wherever_it_lies) {
  const Said made = in_folder("new my_robot");
  ASSERT_EQ(made.exit_code, 0) << made.text;
  EXPECT_EQ(files_in("my_robot"), kMade);
  for (const std::string& file : kMade) EXPECT_TRUE(contains(made.text, "  " + file + " ")) << made.text;
  EXPECT_TRUE(contains(made.text, "next:\n")) << made.text;
  EXPECT_TRUE(contains(made.text, "  cd my_robot\n  make test\n")) << made.text;
  // nobody is asked for a path of the clone
  EXPECT_EQ(read(path("my_robot/Makefile")).find(TWINPUCK_SOURCE_DIR), std::string::npos);
  for (const std::string& file : kMade) {
    const std::string text = read(path("my_robot/" + file));
    EXPECT_FALSE(contains(text, "@") && !contains(text, "actions/checkout@") && !contains(text, "$@"))
        << file;
    EXPECT_FALSE(contains(text, "SPDX")) << file;
  }
  // what the tests beside it ask for: it drives, says so, touches nothing
  const Said run = in_folder("run world.toml --for 10 --summary s.json", "my_robot");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  EXPECT_TRUE(contains(run.text, "e-puck: ready\n")) << run.text;
  EXPECT_FALSE(contains(run.text, "which has that name, too")) << run.text;
  const json robot = json::parse(read(path("my_robot/s.json")))["robots"][0];
  EXPECT_GT(robot["distance_m"].get<double>(), 0.2);
  EXPECT_EQ(robot["collisions"], 0);
  EXPECT_EQ(in_folder("check world.toml", "my_robot").exit_code, 0);
  EXPECT_EQ(in_folder("lint .", "my_robot").exit_code, 0);
}

TEST_F(New, its_makefile_has_five_lines_that_work) {
  ASSERT_EQ(in_folder("new my_robot").exit_code, 0);
  const std::string makefile = read(path("my_robot/Makefile"));
  EXPECT_EQ(std::count(makefile.begin(), makefile.end(), '\n'), 5);
  const auto run = [&](const std::string& target) {
    return shell("make -C '" + path("my_robot") + "' " + target);
  };
  const Said ran = run("run ARGS='--for 1'");
  EXPECT_TRUE(contains(ran.text, "world.toml: 1.0 s simulated")) << ran.text;
  const Said built = run("dspic");
  EXPECT_TRUE(fs::exists(folder / "my_robot/build/my_robot.hex")) << built.text;
  run("clean");
  EXPECT_FALSE(fs::exists(folder / "my_robot/build"));
  EXPECT_TRUE(contains(run("-n test ARGS=-x").text, "twinpuck test -x"));
  EXPECT_TRUE(contains(run("-n view").text, "twinpuck view world.toml"));
}

TEST_F(New, its_tests_pass_and_fail_with_the_program) {
  ASSERT_EQ(in_folder("new my_robot").exit_code, 0);
  const Said good = shell("make -C '" + path("my_robot") + "' test ARGS='--junitxml build/tests.xml'");
  EXPECT_EQ(good.exit_code, 0) << good.text;
  EXPECT_TRUE(contains(good.text, " 2 passed")) << good.text;
  EXPECT_TRUE(fs::exists(folder / "my_robot/build/tests.xml"));
  // blind and dumb: both see it
  std::string program = read(path("my_robot/main.c"));
  for (const char* line :
       {"  e_send_uart1_char(", "  int right = e_get_prox(0)", "  int left = e_get_prox(7)"})
    program.insert(program.find(line), "//");
  program.insert(program.find("static void control_step"), "static int left, right;\n");
  write("my_robot/main.c", program);
  const Said bad = in_folder("test", "my_robot");
  EXPECT_EQ(bad.exit_code, 1) << bad.text;
  EXPECT_TRUE(contains(bad.text, " 2 failed")) << bad.text;
  // a program of one's own that does nothing passes what init asks of it
  write("old/main.c", "int main(void) { while (1); }\n");
  ASSERT_EQ(in_folder("init old").exit_code, 0);
  const Said old = in_folder("test", "old");
  EXPECT_EQ(old.exit_code, 0) << old.text;
  EXPECT_TRUE(contains(old.text, " 2 passed")) << old.text;
}

TEST_F(New, editors_find_the_headers) {
  ASSERT_EQ(in_folder("new my_robot").exit_code, 0);
  const std::string compiler = "/usr/lib/llvm-14/bin/clang";
  if (fs::exists(compiler)) {
    // as clangd compiles it: without a word
    std::istringstream lines(read(path("my_robot/.clangd")));
    std::string command = compiler + " -fsyntax-only";
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("    - ", 0) == 0) command += " " + line.substr(6);
    EXPECT_EQ(shell(command + " '" + path("my_robot/main.c") + "'").text, "");
  }
  for (const char* file : {"c_cpp_properties", "tasks", "launch"}) {
    const std::string text = read(path(std::string("my_robot/.vscode/") + file + ".json"));
    EXPECT_FALSE(json::parse(text, nullptr, false, true).is_discarded()) << text;
  }
  const json of_c = json::parse(read(path("my_robot/.vscode/c_cpp_properties.json")))["configurations"][0];
  for (const json& place : of_c["includePath"]) {
    const std::string text = place.get<std::string>();
    EXPECT_TRUE(contains(text, "${workspaceFolder}") || fs::is_directory(text)) << text;
  }
  EXPECT_TRUE(fs::exists(of_c["forcedInclude"][0].get<std::string>()));
  const json debug = json::parse(read(path("my_robot/.vscode/launch.json")), nullptr, true, true);
  EXPECT_EQ(debug["configurations"][0]["type"], "twinpuck");
  // what launch.json tells to copy
  const std::string editors = twinpuck("paths editors").text;
  EXPECT_TRUE(fs::exists(fs::path(editors.substr(0, editors.size() - 1)) / "vscode/extension.js")) << editors;
}

TEST_F(New, places_are_printed_alone_or_all) {
  const std::string all = twinpuck("paths").text;
  for (const char* place : {"firmware/include\n", "firmware/libc/include\n", "/worlds\n"})
    EXPECT_TRUE(contains(all, place)) << all;
  EXPECT_EQ(twinpuck("paths headers").text, TWINPUCK_SOURCE_DIR "/firmware/include\n");
  const Said wrong = twinpuck("paths heders");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_TRUE(contains(wrong.text, "did you mean 'headers'?")) << wrong.text;
}

TEST_F(New, paths_and_dots_name_the_folder) {
  EXPECT_EQ(in_folder("new a/b/c-3/").exit_code, 0);
  EXPECT_TRUE(contains(read(path("a/b/c-3/Makefile")), "build/c-3.elf"));
  fs::create_directories(folder / "here");
  EXPECT_EQ(in_folder("new .", "here").exit_code, 0);
  EXPECT_TRUE(contains(read(path("here/world.toml")), "title = \"here\""));
  EXPECT_EQ(in_folder("new " + path("whole")).exit_code, 0);
}

TEST_F(New, what_is_there_is_not_written_over) {
  write("full/main.c", "int mine;\n");
  write("full/notes.txt", "mine\n");
  const Said full = in_folder("new full");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_TRUE(contains(full.text, "new: got a folder that is not empty, expected a new name")) << full.text;
  EXPECT_EQ(files_in("full").size(), 2u);
  EXPECT_EQ(in_folder("new full --force").exit_code, 0);
  EXPECT_TRUE(contains(read(path("full/main.c")), "control_step"));
  EXPECT_EQ(read(path("full/notes.txt")), "mine\n");
  // what a link leads to is not the folder's
  write("elsewhere.c", "theirs\n");
  fs::create_directories(folder / "linked");
  fs::create_symlink(folder / "elsewhere.c", folder / "linked/main.c");
  EXPECT_EQ(in_folder("new linked --force").exit_code, 0);
  EXPECT_EQ(read(path("elsewhere.c")), "theirs\n");
  write("file", "");
  const Said file = in_folder("new file --force");
  EXPECT_EQ(file.exit_code, 2);
  EXPECT_TRUE(contains(file.text, "new: got a file, expected a folder")) << file.text;
}

TEST_F(New, a_product_without_templates_says_so) {
  const Said s = twinpuck("new " + path("x"), "TWINPUCK_ROOT=" + path("none"));
  EXPECT_EQ(s.exit_code, 2);
  EXPECT_TRUE(contains(s.text, "tools/templates/project: templates: cannot be read")) << s.text;
  EXPECT_FALSE(fs::exists(folder / "x"));
}

TEST_F(New, init_adds_what_is_missing_and_touches_nothing) {
  write("robot/src/main.c", "int main(void) { while (1); }\n");
  write("robot/Makefile", "SRCS = src/main.c\nall:\n");
  write("robot/.gitignore", "mine\n");
  const Said s = in_folder("init robot");
  ASSERT_EQ(s.exit_code, 0) << s.text;
  auto all = kMade;
  all.erase("main.c");
  all.insert("src/main.c");
  EXPECT_EQ(files_in("robot"), all);
  EXPECT_EQ(read(path("robot/.gitignore")), "mine\n");
  EXPECT_TRUE(contains(read(path("robot/Makefile")), "SRCS"));
  const auto added = s.text.find("added to robot:"), left = s.text.find("left as it was:");
  ASSERT_NE(added, std::string::npos);
  ASSERT_NE(left, std::string::npos) << s.text;
  for (const char* file : {"world.toml", "test_robot.py", "robot.test.toml", ".vscode/tasks.json"})
    EXPECT_LT(s.text.find(std::string("  ") + file), left) << s.text;
  EXPECT_GT(s.text.find("  Makefile"), left);
  EXPECT_TRUE(contains(s.text, "for .gitignore: /build/")) << s.text;
  // its program is run, and nothing of ours is asked of it
  const Said run = in_folder("run world.toml --for 1", "robot");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_FALSE(contains(read(path("robot/test_robot.py")), "\n    assert \"ready\""));
  EXPECT_FALSE(contains(read(path("robot/robot.test.toml")), "\nexpect"));
  // again: nothing; and here, without a name
  const Said again = in_folder("init", "robot");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_TRUE(contains(again.text, "nothing was missing in .")) << again.text;
  // what is of this PC alone comes back
  fs::remove(folder / "robot/.clangd");
  EXPECT_TRUE(contains(in_folder("init robot").text, "  .clangd"));
}

TEST_F(New, init_takes_a_project_of_mplab_and_no_empty_folder) {
  write("p/robot.mcp",
        "[HEADER]\nmagic_cookie={66E99B07-E706-4689-9E80-9B2582898A13}\n[FILE_INFO]\nfile_000=src\\main.c\n");
  write("p/src/main.c", "int main(void) { while (1); }\n");
  EXPECT_EQ(in_folder("init p").exit_code, 0);
  const Said run = in_folder("run p/world.toml --for 0.1");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  fs::create_directories(folder / "empty");
  const Said empty = in_folder("init empty");
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_TRUE(contains(empty.text, "init: got no C file, Makefile or project of MPLAB")) << empty.text;
  EXPECT_TRUE(fs::is_empty(folder / "empty"));
  EXPECT_EQ(in_folder("init nowhere").exit_code, 2);
}

TEST_F(New, init_of_a_new_folder_misses_nothing) {
  ASSERT_EQ(in_folder("new r").exit_code, 0);
  EXPECT_TRUE(contains(in_folder("init r").text, "nothing was missing in r"));
}

TEST_F(New, a_supervisor_runs_from_its_folder) {
  const Said made = in_folder("new --supervisor referee");
  ASSERT_EQ(made.exit_code, 0) << made.text;
  EXPECT_EQ(files_in("referee"), (std::set<std::string>{"README.md", "referee.py"}));
  const Said s = in_folder("run maze --fw obstacle --for 30 --supervisor referee");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_TRUE(contains(s.text, "referee: all there after ")) << s.text;
}

}  // namespace
