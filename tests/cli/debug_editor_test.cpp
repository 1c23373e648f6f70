// SPDX-License-Identifier: MIT
// What an editor sees: sources by their whole paths, wherever it and the program's folder are.
#include "tests/cli/debug_fixture.h"

namespace {

using cli_test::fs::canonical;

/// Folders of the test, and one in the clone.
class DebugEditor : public cli_test::CommandTest {
 protected:
  ~DebugEditor() override { cli_test::fs::remove_all(in_clone()); }
  /// Below build/, which is the clone's.
  std::string in_clone() const { return TWINPUCK_BUILD_DIR "/editor-" + folder.filename().string(); }

  /// An editor whose workspace is `workspace` asks for breakpoints in `source`, and for a program as
  /// `firmware` says. `more`: options of the script.
  void edit(const std::string& workspace, const std::string& firmware, const std::string& source,
            const std::string& more = "") const {
    const std::string line =
        "cd '" + workspace + "' && python3 '" TWINPUCK_SOURCE_DIR "/tests/cli/dap_paths.py' '" +
        cli_test::executable() + "' '" + firmware + "' '" + source + "' " + more + " 2>&1";
    const auto said = shell::run(line);
    EXPECT_EQ(said.exit_code, 0) << line << "\n" << said.text;
    EXPECT_EQ(said.text, "all as expected\n") << line;
  }
  static void write_program(const std::string& at) {
    cli_test::fs::create_directories(at);
    std::ofstream(at + "/main.c") << cli_test::kProgram;
  }
};

TEST_F(DebugEditor, breakpoints_are_found_from_any_folder) {
  for (const std::string& root : {folder.string(), in_clone()}) {
    const std::string mine = root + "/desk/robots/mine", main = mine + "/main.c";
    write_program(mine);
    edit(root + "/desk/robots/mine", ".", main);  // the controller's own folder: names are "./main.c"
    edit(root + "/desk", "robots/mine", main);    // one above
    edit(root, "desk/robots/mine", main);         // two above
    edit(root, mine, main);                       // as ${fileDirname} has it
    edit(TWINPUCK_SOURCE_DIR, mine, main);        // the clone
    edit("/", mine, main);
    edit(root + "/desk", "../desk/robots/mine", main);
  }
  // a controller of the project, by its name
  edit(folder, "lab/obstacle", TWINPUCK_SOURCE_DIR "/firmware/lab/obstacle/main.c", "--any-line");
}

TEST_F(DebugEditor, a_copied_controller_has_its_own_paths) {
  write_program(path("one/mine"));
  edit(path("one"), "mine", path("one/mine/main.c"));
  // the same name, the same bytes, from another folder
  cli_test::fs::copy(path("one"), path("two"), cli_test::fs::copy_options::recursive);
  edit(path("two"), "mine", path("two/mine/main.c"));
  edit(path("one"), "mine", path("one/mine/main.c"));
  // under another name, and into the clone
  cli_test::fs::copy(path("one/mine"), path("two/yours"), cli_test::fs::copy_options::recursive);
  edit(path("two"), "yours", path("two/yours/main.c"));
  cli_test::fs::create_directories(in_clone());
  cli_test::fs::copy(path("one/mine"), in_clone() + "/mine", cli_test::fs::copy_options::recursive);
  edit(in_clone(), "mine", in_clone() + "/mine/main.c");
  // a file of that name in another program is not the program's
  write("two/stranger/main.c", std::string("/* not it */\n") + cli_test::kProgram);
  edit(path("two"), "mine", path("two/stranger/main.c"), "--stranger");
}

TEST_F(DebugEditor, an_image_knows_its_sources_wherever_it_is_built_and_used) {
  write_program(path("one/mine"));
  const auto built =
      cli_test::twinpuck("build mine --hal dspic -o ../mine.elf", "cd '" + path("one") + "' &&");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  edit(path("."), "mine.elf", path("one/mine/main.c"));
  edit("/", path("mine.elf"), path("one/mine/main.c"));
  // through a link, which the editor's path keeps
  cli_test::fs::create_symlink(path("one"), path("link"));
  edit(path("."), "mine.elf", path("link/mine/main.c"));
  // on another machine, where the sources lie elsewhere
  cli_test::fs::rename(path("one"), path("moved"));
  edit(path("."), "mine.elf", path("moved/mine/main.c"));
}

}  // namespace
