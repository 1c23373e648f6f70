// SPDX-License-Identifier: MIT
// The bound on caches, and builds that share one.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>
#include <vector>

#include "compiler/build/build.h"
#include "compiler/cache/object_cache.h"
#include "install/cache_bound.h"

namespace {

namespace fs = std::filesystem;

struct Cache : testing::Test {
  Cache() { fs::create_directories(folder); }
  ~Cache() override { fs::remove_all(folder); }
  /// A file of so many bytes that was used so long ago.
  fs::path file(const std::string& name, std::size_t bytes, std::time_t used_s) const {
    const fs::path path = folder / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << std::string(bytes, 'x');
    age(path, used_s);
    return path;
  }
  static void age(const fs::path& path, std::time_t used_s) {
    const std::time_t then = std::time(nullptr) - used_s;
    const timespec times[2] = {{then, 0}, {then, 0}};
    ASSERT_EQ(utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
  }
  cc::BuildOptions program(const std::string& name) const {
    fs::create_directories(folder / name);
    std::ofstream(folder / name / "main.c") << "#include <motor_led/advance_one_timer/e_motors.h>\n"
                                               "int main(void) { e_init_motors(); while (1); }\n";
    cc::BuildOptions o;
    o.source_dir = folder / name;
    o.output = folder / (name + ".elf");
    o.cache_dir = folder / "cache";
    o.hal = "sim";
    return o;
  }
  static std::string errors(const cc::BuildResult& result) {
    std::string all;
    for (const std::string& line : result.errors) all += line + "\n";
    return all;
  }

  const fs::path folder = fs::temp_directory_path() / ("twinpuck_cache_" + std::to_string(getpid()));
};

constexpr std::size_t kBlock = 64 << 10;  // bytes; what a disk takes in whole
constexpr std::time_t kHour = 3600;

TEST_F(Cache, loses_first_what_was_used_longest_ago) {
  const fs::path oldest = file("objects/a.o", kBlock, 9 * kHour),
                 old = file("images/b.elf", kBlock, 8 * kHour),
                 recent = file("programs/c", kBlock, 7 * kHour), newest = file("objects/d.o", kBlock, kHour);
  EXPECT_EQ(places::keep_within(folder, 4 * kBlock), 4 * kBlock) << "that is within the bound";
  EXPECT_TRUE(fs::exists(oldest));
  // 4 blocks are more than 3: down to four fifths of that, which leaves 2
  EXPECT_EQ(places::keep_within(folder, 3 * kBlock), 2 * kBlock);
  EXPECT_FALSE(fs::exists(oldest));
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(recent));
  EXPECT_TRUE(fs::exists(newest));
}

TEST_F(Cache, keeps_what_is_noted_as_used) {
  const fs::path noted = file("a.o", kBlock, 9 * kHour), other = file("b.o", kBlock, 8 * kHour);
  places::note_used(noted);
  places::keep_within(folder, kBlock + kBlock / 2);
  EXPECT_TRUE(fs::exists(noted));
  EXPECT_FALSE(fs::exists(other));
}

TEST_F(Cache, keeps_what_somebody_may_be_about_to_use) {
  const fs::path young = file("a.o", kBlock, 60);
  EXPECT_EQ(places::keep_within(folder, 1), kBlock);
  EXPECT_TRUE(fs::exists(young));
}

TEST_F(Cache, loses_folders_of_classes_whole_and_what_killed_builds_left) {
  const fs::path a = file("programs/x.classes/A.class", kBlock, 9 * kHour),
                 b = file("programs/x.classes/B.class", kBlock, 2 * kHour),
                 kept = file("programs/y", kBlock, 8 * kHour),
                 half = file("objects/z.half1_2", 100, 2 * kHour),
                 started = file("objects/z.half3_4", 100, 60);
  age(a.parent_path(), 9 * kHour);
  places::keep_within(folder, 4 * kBlock);
  EXPECT_FALSE(fs::exists(half)) << "nobody finishes it any more";
  EXPECT_TRUE(fs::exists(started));
  EXPECT_TRUE(fs::exists(a) && fs::exists(b) && fs::exists(kept));
  fs::remove(started);
  places::keep_within(folder, 2 * kBlock + kBlock / 2);  // the class that was used keeps the other
  EXPECT_TRUE(fs::exists(a) && fs::exists(b));
  EXPECT_FALSE(fs::exists(kept));
}

TEST_F(Cache, is_bounded_by_what_the_environment_says) {
  const std::string before = std::getenv("XDG_CACHE_HOME") ? std::getenv("XDG_CACHE_HOME") : "";
  setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  setenv("TWINPUCK_CACHE_MB", "1", 1);
  const fs::path old = file("twinpuck/objects/a.o", 2 << 20, kHour),
                 small = file("twinpuck/objects/b.o", 100, 0);
  places::keep_caches_within_bound();
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(small)) << "a megabyte is left";
  const fs::path next = file("twinpuck/objects/a.o", 2 << 20, kHour);
  places::keep_caches_within_bound();
  EXPECT_TRUE(fs::exists(next)) << "once a minute is enough";
  unsetenv("TWINPUCK_CACHE_MB");
  before.empty() ? unsetenv("XDG_CACHE_HOME") : setenv("XDG_CACHE_HOME", before.c_str(), 1);
}

TEST_F(Cache, that_is_removed_under_builds_does_not_fail_them) {
  std::atomic<bool> over{false};
  std::vector<std::thread> builders;
  std::vector<std::string> wrong(3);
  for (std::size_t i = 0; i < wrong.size(); ++i)
    builders.emplace_back([&, i] {
      const cc::BuildOptions o = program("p" + std::to_string(i));
      do {
        const cc::BuildResult made = cc::build_image(o);
        if (!made.ok) wrong[i] += errors(made);
      } while (!over);
    });
  // three times while compilers are about to write, which is once less than a build begins
  for (int removed = 0; removed < 3; ++removed) {
    const auto is_compiling = [&] {
      std::error_code none;
      for (fs::directory_iterator it(folder / "cache", none), end; !none && it != end; it.increment(none))
        if (it->path().filename().string().find(".half") != std::string::npos) return true;
      return false;
    };
    for (int n = 0; n < 2000 && !is_compiling(); ++n) usleep(1000);
    std::error_code none;
    fs::remove_all(folder / "cache", none);
  }
  over = true;
  for (std::thread& t : builders) t.join();
  for (const std::string& lines : wrong) EXPECT_EQ(lines, "");
}

TEST_F(Cache, whose_objects_are_spoilt_makes_them_again) {
  const cc::BuildOptions o = program("p");
  ASSERT_TRUE(cc::build_image(o).ok);
  fs::remove(o.output);
  for (const auto& entry : fs::directory_iterator(o.cache_dir))
    if (entry.path().extension() == ".o") fs::resize_file(entry.path(), 10);
  const cc::BuildResult again = cc::build_image(o);
  EXPECT_TRUE(again.ok) << errors(again);
  EXPECT_GT(again.compiled, 0);
}

TEST_F(Cache, that_cannot_be_written_is_told_in_a_line) {
  cc::BuildOptions o = program("p");
  o.cache_dir = "/dev/null/cache";
  const cc::BuildResult result = cc::build_image(o);
  EXPECT_FALSE(result.ok);
  EXPECT_EQ(errors(result),
            "/dev/null/cache: cache: got Not a directory, expected a folder that can be written; set "
            "XDG_CACHE_HOME to one\n");
}

TEST_F(Cache, an_object_is_never_replaced_by_another) {
  const cc::BuildOptions o = program("p");
  ASSERT_TRUE(cc::build_image(o).ok);
  const auto objects = [&] {
    std::vector<std::pair<fs::path, std::string>> all;
    for (const auto& entry : fs::directory_iterator(o.cache_dir))
      if (entry.path().extension() == ".o") all.emplace_back(entry.path(), cc::bytes_of(entry.path()));
    return all;
  };
  const auto first = objects();
  std::ofstream(o.source_dir / "main.c") << "int n; int main(void) { while (1) n++; }\n";
  ASSERT_TRUE(cc::build_image(o).ok);
  EXPECT_GT(objects().size(), first.size());
  for (const auto& [path, bytes] : first) EXPECT_EQ(cc::bytes_of(path), bytes) << path;
}

}  // namespace
