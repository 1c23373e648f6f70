// SPDX-License-Identifier: MIT
// What a name means, and that it is said: programs and worlds, here, beside the world and in the project.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using namespace cli_test;
using nlohmann::json;

namespace {

class NamedThings : public CommandTest {
 protected:
  NamedThings() {
    write("here/obstacle/main.c", kMain);
    write("here/obstacle/more.c", "int more(void) { return 1; }\n");
    write("here/other/main.c", kMain);
    write("here/arena.toml", kWorld);
  }
  /// In the folder "here".
  Said here(const std::string& arguments) const {
    return twinpuck(arguments, "cd '" + path("here") + "' &&");
  }
  static void expect(const Said& said, const std::string& text, int exit_code = 0) {
    EXPECT_EQ(said.exit_code, exit_code) << said.text;
    EXPECT_NE(said.text.find(text), std::string::npos) << "'" << text << "' in\n" << said.text;
  }
  static void expect_none(const Said& said, const std::string& text) {
    EXPECT_EQ(said.text.find(text), std::string::npos) << "'" << text << "' in\n" << said.text;
  }
  static constexpr const char* kMain = "int main(void) { while (1); }\n";
  static constexpr const char* kWorld = "twinpuck = 1\n[[robot]]\nname = \"puck\"\nfirmware = \"obstacle\"\n";
};

TEST_F(NamedThings, terminal_and_summary_name_the_program_that_ran) {
  const std::string root = TWINPUCK_SOURCE_DIR;
  for (const char* hal : {"sim", "dspic"}) {
    const Said own = here(std::string("run maze --for 0.01 --fw obstacle --summary s.json --hal ") + hal);
    expect(own,
           "puck: ./obstacle, 2 files; not " + root + "/firmware/lab/obstacle, which has that name, too\n");
    const json robot = json::parse(read(path("here/s.json")))["robots"][0];
    EXPECT_EQ(robot["program"], fs::canonical(path("here/obstacle")).string());
    EXPECT_EQ(robot["files"], 2);
  }
  const Said other = here("run maze --for 0.01 --fw other");
  expect(other, "puck: ./other, 1 file\n");
  // nothing is built anew, and it is said all the same
  expect(here("run maze --for 0.01 --fw other"), "puck: ./other, 1 file\n");
  expect(here("run maze --for 0.01 --fw lab/obstacle"), "puck: " + root + "/firmware/lab/obstacle, 1 file");
  expect_none(here("run maze --for 0.01 --fw other -q"), "./other");
  // an image
  ASSERT_EQ(here("build other --hal dspic -o thing.elf").exit_code, 0);
  expect(here("run maze --for 0.01 --fw thing.elf"), "puck: ./thing.elf\n");
  expect(here("debug maze --fw other </dev/null"), "puck: ./other, 1 file\n");
}

TEST_F(NamedThings, robots_that_run_the_same_are_one_line) {
  write("here/many.toml",
        "twinpuck = 1\n[[robot]]\nname = \"a\"\n[[robot]]\nname = \"b\"\nposition = [0.2, 0]\n"
        "[[robot]]\nname = \"c\"\nposition = [0.4, 0]\n");
  const Said said = here("run many --for 0.01 --fw a=other --fw b=obstacle --fw c=other");
  expect(said, "a, c: ./other, 1 file\nb: ./obstacle, 2 files");
}

TEST_F(NamedThings, the_world_s_own_program_goes_before_one_here) {
  write("worlds/mine.toml", kWorld);
  write("worlds/obstacle/main.c", kMain);
  const Said said = here("run ../worlds/mine --for 0.01");
  expect(said, "puck: " + fs::canonical(path("worlds/obstacle")).string() + ", 1 file; not ./obstacle, ");
}

TEST_F(NamedThings, a_world_in_this_folder_is_found_without_its_ending) {
  expect(here("run arena --for 0.01"), "arena.toml: 0.0 s simulated");
  expect(here("check arena"), "arena.toml: good");
  expect(here("run nowhere --for 0.01"), "with or without .toml", 2);
  expect(here("run aren --for 0.01"), "did you mean 'arena'?", 2);
  // a folder of its name does not hide it
  fs::create_directories(path("here/arena"));
  expect(here("run arena --for 0.01"), "arena.toml: 0.0 s simulated");
  // one that the project has as well
  write("here/maze.toml", kWorld);
  const Said said = here("run maze --for 0.01");
  expect(said, "maze: world: ./maze.toml is taken, not " TWINPUCK_SOURCE_DIR "/worlds/maze.toml");
  expect(said, "\nmaze.toml: 0.0 s simulated");
}

TEST_F(NamedThings, rooms_of_the_firmware_are_no_guesses) {
  for (const char* room : {"libc", "library", "include", "webots", "lab"}) {
    const std::string mistyped = std::string(room).substr(0, std::string(room).size() - 1);
    expect_none(here("run maze --for 0.01 --fw " + mistyped), std::string("'") + room + "'");
  }
}

}  // namespace
