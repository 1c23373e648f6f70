// SPDX-License-Identifier: MIT
// The product as `make install` leaves it, used as people do: by users who own nothing of it, from elsewhere,
// while clone and build folder are out of sight and the installed tree cannot be written to.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "tests/support/shell.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

using shell::Said;

Said in_shell(const std::string& line) { return shell::run("{ " + line + "\n} 2>&1 </dev/null"); }

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

const char* const kMine = R"(#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
int turns;
int main(void)
{
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  e_set_speed_left(400);
  e_set_speed_right(300);
  while (1) turns++;
}
)";

/// Installed once; each test has users of its own.
class Installed : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    top() = fs::temp_directory_path() / ("twinpuck_installed_" + std::to_string(getpid()));
    fs::create_directories(top());
    fs::permissions(top(), fs::perms(0755));
    const Said made =
        in_shell("cmake --install '" TWINPUCK_BUILD_DIR "' --prefix '" + (top() / "made").string() + "'");
    installed() = made.exit_code == 0 ? "" : made.text;
    // it works where it lies, not where it was put
    if (made.exit_code == 0) fs::rename(top() / "made", prefix());
  }
  static void TearDownTestSuite() { fs::remove_all(top()); }
  void SetUp() override {
    ASSERT_EQ(installed(), "");
    for (const char* user : {"ann", "bob"}) {
      fs::create_directories(home(user));
      if (geteuid() == 0) {
        ASSERT_EQ(chown(home(user).c_str(), id(user), id(user)), 0);
      }
    }
  }
  void TearDown() override { fs::remove_all(top() / name()); }

  static fs::path& top() {
    static fs::path folder;
    return folder;
  }
  static std::string& installed() {
    static std::string wrong;
    return wrong;
  }
  static fs::path prefix() { return top() / "prefix"; }
  static std::string name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }
  static uid_t id(const std::string& user) { return user == "ann" ? 65533 : 65532; }
  static fs::path home(const std::string& user) { return top() / name() / user; }

  /// The line as a user says it, from home. Root, as in a container, plays both users, and sees to it that
  /// nothing of the clone is there and that nothing of the installed tree can be changed.
  static std::string as(const std::string& user, const std::string& line) {
    const std::string in_home = "cd '" + home(user).string() + "' && env -i HOME='" + home(user).string() +
                                "' PATH='" + (prefix() / "bin").string() +
                                ":/usr/bin:/bin' LC_ALL=C sh -c \"" + line + "\"";
    if (geteuid() != 0) return in_home;
    std::ofstream(top() / (user + ".sh"))
        << "cd /\nif mount -t tmpfs none '" TWINPUCK_SOURCE_DIR "' 2>/dev/null; then\n"
        << "  mount --bind '" << prefix().string() << "' '" << prefix().string() << "'\n"
        << "  mount -o remount,ro,bind '" << prefix().string() << "'\nfi\n"
        << "exec setpriv --reuid=$1 --regid=$1 --clear-groups sh -c \"$2\"\n";
    std::string quoted;
    for (const char c : in_home) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    const std::string words =
        "sh '" + (top() / (user + ".sh")).string() + "' " + std::to_string(id(user)) + " '" + quoted + "'";
    return "if unshare -m true 2>/dev/null; then unshare -m " + words + "; else " + words + "; fi";
  }
  static Said said_by(const std::string& user, const std::string& line) { return in_shell(as(user, line)); }
  /// A controller of the user's own.
  static void write_mine(const std::string& user, const std::string& text = kMine) {
    fs::create_directories(home(user) / "mine");
    std::ofstream(home(user) / "mine" / "main.c") << text;
    if (geteuid() == 0) {
      EXPECT_EQ(chown((home(user) / "mine").c_str(), id(user), id(user)), 0);
    }
  }
  static std::string digest_in(const std::string& text) {
    const std::size_t at = text.find("digest ");
    return at == std::string::npos ? text : text.substr(at + 7, 16);
  }
};

TEST_F(Installed, it_runs_what_it_brings_along) {
  const Said here = in_shell("cd / && '" TWINPUCK_BUILD_DIR "/twinpuck' run maze --for 2");
  const bool has_page = fs::exists(TWINPUCK_BUILD_DIR "/page/page.js");  // a build of its own
  const Said there = said_by(
      "ann", std::string("twinpuck run maze --for 2 --picture p.png") + (has_page ? " --report r.html" : ""));
  EXPECT_EQ(there.exit_code, 0) << there.text;
  EXPECT_EQ(digest_in(there.text), digest_in(here.text));
  EXPECT_NE(there.text.find((prefix() / "share/twinpuck/worlds/maze.toml").string()), std::string::npos)
      << there.text;
  EXPECT_GT(fs::file_size(home("ann") / "p.png"), 1000u);
  const Said listed = said_by("ann", "twinpuck list");
  EXPECT_EQ(listed.exit_code, 0);
  for (const char* part : {"  blink ", "  maze ", "  soccer "})
    EXPECT_NE(listed.text.find(part), std::string::npos) << part << listed.text;
  EXPECT_EQ(listed.text.find("make run"), std::string::npos) << "there is no Makefile here";
  const Said lab = said_by("ann", "twinpuck lab I1 --seeds 1 --no-times");
  EXPECT_EQ(lab.exit_code, 0) << lab.text;
}

TEST_F(Installed, it_builds_a_users_own_without_compiling_the_library) {
  write_mine("ann");
  const Said built = said_by("ann", "twinpuck build mine && twinpuck build mine --hal dspic -o mine.elf");
  EXPECT_EQ(built.exit_code, 0) << built.text;
  EXPECT_NE(built.text.find(": 1 files compiled, "), std::string::npos) << built.text;
  EXPECT_TRUE(fs::exists(home("ann") / "mine.hex"));
  EXPECT_FALSE(fs::exists(home("ann") / "mine" / "main.o"));
  const Said cycles = said_by("ann", "twinpuck cycles mine --all");
  EXPECT_EQ(cycles.exit_code, 0) << cycles.text;
  EXPECT_NE(cycles.text.find("e_set_speed_left"), std::string::npos) << cycles.text;
  // the library's sources are named where they lie now
  const Said where = said_by("ann",
                             "printf 'break e_set_speed_left\\ncontinue\\nwhere\\nquit\\n' >x; "
                             "twinpuck debug maze --fw mine -x x");
  EXPECT_NE(where.text.find("e_set_speed_left"), std::string::npos) << where.text;
  EXPECT_EQ(where.text.find(TWINPUCK_SOURCE_DIR "/"), std::string::npos) << where.text;
  const std::string listing = read(home("ann") / "mine.lst");
  EXPECT_NE(listing.find("; " + (prefix() / "share/twinpuck/hal_dspic/motor_led").string()),
            std::string::npos);
}

TEST_F(Installed, four_builds_at_once_share_a_cache) {
  write_mine("ann");
  const Said runs =
      said_by("ann",
              "for i in 1 2 3 4; do twinpuck run maze --fw mine --for 1 --opt -O2 >out\\$i 2>&1 & done; "
              "wait; cat out1 out2 out3 out4");
  std::set<std::string> digests;
  int count = 0;
  std::istringstream lines(runs.text);
  for (std::string line; std::getline(lines, line);)
    if (line.find("digest ") != std::string::npos) digests.insert(digest_in(line)), ++count;
  EXPECT_EQ(count, 4) << runs.text;
  EXPECT_EQ(digests.size(), 1u) << runs.text;
  for (const auto& entry : fs::recursive_directory_iterator(home("ann") / ".cache"))
    EXPECT_EQ(entry.path().string().find(".half"), std::string::npos) << entry.path();
}

TEST_F(Installed, two_users_do_not_meet) {
  write_mine("ann");
  write_mine("bob");
  // even where both were told the same place
  const fs::path shared = top() / name() / "shared";
  fs::create_directories(shared);
  ASSERT_EQ(chmod(shared.c_str(), 01777), 0);
  const std::string line = "XDG_CACHE_HOME=" + shared.string() + " twinpuck run maze --fw mine --for 1";
  const Said both = in_shell("(" + as("ann", line) + ") & (" + as("bob", line) + ") & wait");
  EXPECT_NE(both.text.find("digest "), both.text.rfind("digest ")) << both.text;
  EXPECT_EQ(said_by("ann", line).exit_code, 0);
  EXPECT_EQ(said_by("bob", line).exit_code, 0);
  if (geteuid() != 0) return;
  EXPECT_TRUE(fs::exists(home("ann") / ".cache/twinpuck") != fs::exists(home("bob") / ".cache/twinpuck"))
      << "the second one has its own at home";
}

TEST_F(Installed, a_home_that_cannot_be_written_is_no_hindrance) {
  write_mine("ann");
  const Said s = said_by("ann", "HOME=/nonexistent twinpuck run maze --fw mine --for 1");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  const Said none = said_by("ann", "HOME=/nonexistent TMPDIR=/proc twinpuck run maze --fw mine --for 1");
  EXPECT_EQ(none.exit_code, 2) << none.text;
  if (geteuid() == 0) fs::remove_all(fs::temp_directory_path() / ("twinpuck-" + std::to_string(id("ann"))));
}

TEST_F(Installed, a_full_disk_is_told_in_a_line) {
  if (geteuid() != 0 || in_shell("unshare -m true").exit_code != 0)
    GTEST_SKIP() << "only root makes small disks";
  write_mine("bob");
  const std::string disk = home("bob").string() + "/disk";
  const std::string run = (prefix() / "bin/twinpuck").string() + " run maze --fw '" +
                          (home("bob") / "mine").string() + "' --for 1";
  fs::create_directories(disk);
  const auto on_it = [&](const std::string& then) {
    return in_shell("unshare -m sh -c \"mount -t tmpfs -o size=64k none '" + disk + "' && XDG_CACHE_HOME='" +
                    disk + "' " + then + "\"");
  };
  const Said full = on_it("HOME=/proc TMPDIR='" + disk + "' " + run);
  EXPECT_EQ(full.exit_code, 2) << full.text;
  EXPECT_TRUE(wording::reads(
      full.text, disk + "/twinpuck/objects: cache: got No space left on device, expected a folder "
                        "that can be written; set XDG_CACHE_HOME to one"));
  const Said elsewhere = on_it("HOME='" + (top() / "root").string() + "' " + run);
  EXPECT_EQ(elsewhere.exit_code, 0) << "another place does: " << elsewhere.text;
}

TEST_F(Installed, what_new_makes_passes_its_own_tests) {
  if (in_shell("/usr/bin/python3 -c 'import numpy, pytest'").exit_code != 0)
    GTEST_SKIP() << "numpy or pytest is not here";
  const Said made = said_by("ann", "twinpuck new my_robot && cd my_robot && twinpuck test");
  EXPECT_EQ(made.exit_code, 0) << made.text;
}

TEST_F(Installed, python_finds_its_module) {
  if (in_shell("/usr/bin/python3 -c 'import numpy'").exit_code != 0) GTEST_SKIP() << "numpy is not here";
  const Said s =
      said_by("ann", "PYTHONPATH=" + (prefix() / "lib/twinpuck/python").string() +
                         " /usr/bin/python3 -c 'import twinpuck; w = twinpuck.World(\\\"maze\\\"); "
                         "w.run(1); print(\\\"at\\\", w.time_s)'");
  EXPECT_EQ(s.exit_code, 0) << s.text;
}

TEST_F(Installed, it_makes_a_controller_where_one_stands) {
  const Said made = said_by("ann", "twinpuck new my_robot && twinpuck run maze --fw ./my_robot --for 2");
  EXPECT_EQ(made.exit_code, 0) << made.text;
  EXPECT_TRUE(fs::exists(home("ann") / "my_robot" / "main.c"));
}

TEST_F(Installed, it_runs_programs_of_webots) {
  fs::create_directories(home("ann") / "avoid");
  std::ofstream(home("ann") / "avoid" / "avoid.c")
      << "#include <webots/robot.h>\n#include <stdio.h>\nint main(void) {\n  wb_robot_init();\n"
         "  for (int i = 0; i < 5; i++) wb_robot_step(64);\n  printf(\"five steps\\n\");\n  "
         "wb_robot_cleanup();\n"
         "  return 0;\n}\n";
  fs::create_directories(home("ann") / "look");
  std::ofstream(home("ann") / "look" / "look.py")
      << "from controller import Robot\nrobot = Robot()\nfor i in range(4):\n    robot.step(64)\nprint('four "
         "steps')\n";
  const Said s = said_by("ann", "twinpuck run maze --fw avoid --for 1; twinpuck run maze --fw look --for 1");
  EXPECT_NE(s.text.find("five steps"), std::string::npos) << s.text;
  EXPECT_NE(s.text.find("four steps"), std::string::npos) << s.text;
}

TEST_F(Installed, the_page_is_there) {
  if (!fs::exists(TWINPUCK_BUILD_DIR "/page/page.js")) GTEST_SKIP() << "the page was not built; make page";
  const Said s = said_by(
      "ann",
      "twinpuck view maze >said & p=\\$!; for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do "
      "grep -qs http said && break; sleep 0.2; done; "
      "python3 -c 'import urllib.request, re; a = re.search(r\\\"http\\S+\\\", "
      "open(\\\"said\\\").read()).group(); "
      "print(len(urllib.request.urlopen(a + \\\"page.js\\\").read()))'; kill -INT \\$p; wait \\$p");
  EXPECT_EQ(s.exit_code, 0) << s.text;
  EXPECT_GT(std::atoi(s.text.c_str()), 100'000) << s.text;
  const Said report = said_by("ann", "twinpuck run maze --for 1 -q --report r.html && wc -c <r.html");
  EXPECT_GT(std::atoi(report.text.c_str()), 500'000) << report.text;
}

TEST_F(Installed, pages_of_the_manual_have_no_mistakes) {
  const fs::path pages = prefix() / "share/man/man1";
  int count = 0;
  for (const auto& page : fs::directory_iterator(pages)) {
    ++count;
    const Said lint = in_shell("mandoc -T lint -W warning '" + page.path().string() + "'");
    EXPECT_EQ(lint.exit_code, 0) << lint.text;
  }
  EXPECT_GE(count, 17);
  const std::string run =
      in_shell("mandoc -T utf8 '" + (pages / "twinpuck-run.1").string() + "' | col -b").text;
  for (const char* part : {"SYNOPSIS", "--fw TEXT", "--hal sim|dspic", "Traces", "EXIT STATUS",
                           "TWINPUCK_CACHE_MB", "twinpuck run maze --fw obstacle --for 60"})
    EXPECT_NE(run.find(part), std::string::npos) << part << "\n" << run;
}

TEST_F(Installed, bash_completes_verbs_options_and_names) {
  const auto completed = [&](const std::string& line) {
    std::ofstream(home("ann") / "complete.sh")
        << ". '" << (prefix() / "share/bash-completion/completions/twinpuck").string() << "'\nCOMP_LINE='"
        << line << "' COMP_POINT=" << line.size() << "\n_twinpuck\nprintf '%s ' \"${COMPREPLY[@]}\"\n";
    return " " + said_by("ann", "bash complete.sh").text;
  };
  const auto has = [](const std::string& words, const std::string& word) {
    return words.find(" " + word + " ") != std::string::npos;
  };
  EXPECT_TRUE(has(completed("twinpuck r"), "run")) << completed("twinpuck r");
  EXPECT_EQ(completed("twinpuck ru"), " run ");
  EXPECT_EQ(completed("twinpuck run maz"), " maze ");
  EXPECT_TRUE(has(completed("twinpuck run "), "arena"));
  EXPECT_EQ(completed("twinpuck run maze --pict"), " --picture ");
  EXPECT_EQ(completed("twinpuck run maze --hal "), " sim dspic ");
  EXPECT_EQ(completed("twinpuck run maze --opt -O"), " -O0 -O1 -O2 -Os ");
  EXPECT_EQ(completed("twinpuck run maze --fw obst"), " obstacle ") << "the lab's by their plain names, too";
  EXPECT_EQ(completed("twinpuck run maze --for 10 --fw pu"), " puck= ");
  EXPECT_EQ(completed("twinpuck run maze --fw puck=bli"), " blink ");
  EXPECT_EQ(completed("twinpuck debug maze --robot "), " puck ");
  EXPECT_EQ(completed("twinpuck list wo"), " worlds ");
  EXPECT_EQ(completed("twinpuck help cyc"), " cycles ");
  EXPECT_TRUE(has(completed("twinpuck build bli"), "blink"));
  fs::create_directories(home("ann") / "mine");
  EXPECT_TRUE(has(completed("twinpuck build mi"), "mine/")) << completed("twinpuck build mi");
}

TEST_F(Installed, a_program_has_it_in_itself) {
  fs::copy(prefix() / "share/twinpuck/examples/embed", home("ann") / "embed");
  if (geteuid() == 0) {
    ASSERT_EQ(chown((home("ann") / "embed").c_str(), id("ann"), id("ann")), 0);
  }
  const Said built = said_by("ann", "cmake -S embed -B embed/build -DCMAKE_PREFIX_PATH=" + prefix().string() +
                                        " && cmake --build embed/build");
  ASSERT_EQ(built.exit_code, 0) << built.text;
  const Said run = said_by("ann", "embed/build/follow");
  EXPECT_EQ(run.exit_code, 0) << run.text;
  EXPECT_NE(run.text.find("near a wall after "), std::string::npos) << run.text;
  EXPECT_NE(run.text.find("the same again"), std::string::npos) << run.text;
}

}  // namespace
