// SPDX-License-Identifier: MIT
// twinpuck new and init: folders of one's own that build, run, are debugged and read by editors as they are.
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class New : public CommandTest {};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(New, a_folder_of_ones_own_builds_and_runs_wherever_it_lies) {
  ASSERT_EQ(in_folder("twinpuck new my_robot").exit_code, 0);
  // nobody is asked for a path of the clone, and no word of a template is left
  const std::string makefile = read(path("my_robot/Makefile"));
  EXPECT_EQ(makefile.find(TWINPUCK_SOURCE_DIR), std::string::npos);
  EXPECT_EQ(std::count(makefile.begin(), makefile.end(), '\n'), 5);
  for (const auto& entry : fs::recursive_directory_iterator(folder / "my_robot")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = read(entry.path());
    EXPECT_FALSE(contains(text, "@") && !contains(text, "actions/checkout@") && !contains(text, "$@"))
        << entry;
    EXPECT_FALSE(contains(text, "SPDX")) << entry;
  }
  // what the tests beside it ask for: it drives and touches nothing
  ASSERT_EQ(in_folder("cd my_robot && twinpuck run world.toml --for 10 --summary s.json").exit_code, 0);
  const json robot = json::parse(read(path("my_robot/s.json")))["robots"][0];
  EXPECT_GT(robot["distance_m"].get<double>(), 0.2);
  EXPECT_EQ(robot["collisions"], 0);
}

TEST_F(New, its_tests_pass_and_fail_with_the_program) {
  ASSERT_EQ(in_folder("twinpuck new my_robot").exit_code, 0);
  const Said good = in_folder("make -C my_robot test ARGS='--junitxml build/tests.xml'");
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
  const Said bad = in_folder("cd my_robot && twinpuck test");
  EXPECT_EQ(bad.exit_code, 1) << bad.text;
  EXPECT_TRUE(contains(bad.text, " 2 failed")) << bad.text;
  // a program of one's own that does nothing passes what init asks of it
  write("old/main.c", "int main(void) { while (1); }\n");
  ASSERT_EQ(in_folder("twinpuck init old").exit_code, 0);
  const Said old = in_folder("cd old && twinpuck test");
  EXPECT_EQ(old.exit_code, 0) << old.text;
  EXPECT_TRUE(contains(old.text, " 2 passed")) << old.text;
}

TEST_F(New, editors_find_the_headers) {
  ASSERT_EQ(in_folder("twinpuck new my_robot").exit_code, 0);
  const std::string compiler = "/usr/lib/llvm-14/bin/clang";
  if (fs::exists(compiler)) {
    // as clangd compiles it: without a word
    std::istringstream lines(read(path("my_robot/.clangd")));
    std::string command = compiler + " -fsyntax-only";
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("    - ", 0) == 0) command += " " + line.substr(6);
    EXPECT_EQ(in_folder(command + " my_robot/main.c").text, "");
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

}  // namespace
