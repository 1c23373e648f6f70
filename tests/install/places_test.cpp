// SPDX-License-Identifier: MIT
// Where caches go, by the environment and by what is there.
#include "install/places.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <map>

#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;

struct Places : testing::Test {
  Places() {
    for (const char* name : {"XDG_CACHE_HOME", "HOME", "TMPDIR", "TWINPUCK_ROOT"})
      before[name] = std::getenv(name) ? std::getenv(name) : "";
    fs::create_directories(folder);
    set("XDG_CACHE_HOME", "");
    set("TWINPUCK_ROOT", "");
    set("HOME", (folder / "home").string());
    set("TMPDIR", folder.string());
    fs::create_directories(folder / "home");
  }
  ~Places() override {
    for (const auto& [name, value] : before) set(name, value);
    fs::remove_all(folder);
  }
  static void set(const std::string& name, const std::string& value) {
    value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
  }
  fs::path temporary() const { return folder / ("twinpuck-" + std::to_string(geteuid())); }
  static unsigned mode(const fs::path& path) {
    struct stat s;
    return lstat(path.c_str(), &s) == 0 ? s.st_mode & 07777u : 0;
  }

  const fs::path folder = fs::temp_directory_path() / ("twinpuck_places_" + std::to_string(getpid()));
  std::map<std::string, std::string> before;
};

TEST_F(Places, of_a_build_folder_are_the_clone_and_itself) {
  EXPECT_EQ(places::share_root(), TWINPUCK_SOURCE_DIR);
  EXPECT_EQ(places::tools_folder(), TWINPUCK_BUILD_DIR);
  EXPECT_EQ(places::page_folder(), TWINPUCK_BUILD_DIR "/page");
  EXPECT_EQ(places::command_file(), TWINPUCK_BUILD_DIR "/twinpuck");
  EXPECT_FALSE(places::is_installed());
  set("TWINPUCK_ROOT", "/some/where");
  EXPECT_EQ(places::share_root(), "/some/where");
  EXPECT_EQ(places::product_share(), TWINPUCK_SOURCE_DIR) << "the compiler's own library stays its own";
}

TEST_F(Places, for_caches_are_tried_in_order) {
  set("XDG_CACHE_HOME", (folder / "xdg" / "deep").string());
  EXPECT_EQ(places::cache_folder("a"), folder / "xdg/deep/twinpuck/a");
  EXPECT_EQ(mode(folder / "xdg/deep/twinpuck"), 0700u) << "for the user alone";
  set("XDG_CACHE_HOME", "relative");  // the standard says that such a one is nothing
  EXPECT_EQ(places::cache_folder("a"), folder / "home/.cache/twinpuck/a");
  set("HOME", "/dev/null");
  EXPECT_EQ(places::cache_folder("a"), temporary() / "a");
  EXPECT_EQ(mode(temporary()), 0700u);
}

TEST_F(Places, that_cannot_be_written_to_are_passed_over) {
  std::ofstream(folder / "home" / ".cache") << "a file";
  EXPECT_EQ(places::cache_folder("a"), temporary() / "a");
  fs::remove(folder / "home" / ".cache");
  set("XDG_CACHE_HOME", "/proc");  // which takes no folder, even from root
  EXPECT_EQ(places::cache_folder("a"), folder / "home/.cache/twinpuck/a");
}

TEST_F(Places, of_other_users_are_passed_over) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(chown((folder / "home").c_str(), kNobody, kNobody), 0);
  EXPECT_EQ(places::cache_folder("a"), temporary() / "a") << "root leaves nothing in a user's HOME";
  EXPECT_FALSE(fs::exists(folder / "home/.cache"));
  ASSERT_EQ(chown(temporary().c_str(), kNobody, kNobody), 0);
  const fs::path refused = places::cache_folder("a");  // nobody else's: the first one, and why
  EXPECT_EQ(refused, folder / "home/.cache/twinpuck/a");
}

TEST_F(Places, in_the_temporary_folder_may_not_be_a_link_or_open_to_others) {
  set("HOME", "/dev/null");
  fs::create_directories(folder / "trap");
  fs::create_directory_symlink(folder / "trap", temporary());
  EXPECT_EQ(places::cache_folder("a"), "/dev/null/.cache/twinpuck/a");
  EXPECT_FALSE(fs::exists(folder / "trap" / "a"));
  fs::remove(temporary());
  fs::create_directory(temporary());
  // what others may do there: read, but not write
  for (const mode_t mode : {0700, 0701, 0704, 0711, 0755, 0720, 0702, 0777, 0722}) {
    ASSERT_EQ(chmod(temporary().c_str(), mode), 0);
    EXPECT_EQ(places::cache_folder("a"),
              (mode & (S_IWGRP | S_IWOTH)) == 0 ? temporary() / "a" : fs::path("/dev/null/.cache/twinpuck/a"))
        << std::oct << mode;
  }
}

TEST_F(Places, tell_why_nothing_can_be_written) {
  EXPECT_EQ(places::why_not_writable(folder / "new" / "one"), "");
  EXPECT_EQ(places::why_not_writable("/dev/null/.cache/twinpuck/objects"),
            "/dev/null/.cache/twinpuck/objects: cache: got Not a directory, expected a folder that can be "
            "written; set XDG_CACHE_HOME to one");
}

}  // namespace
