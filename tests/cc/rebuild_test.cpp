// SPDX-License-Identifier: MIT
// What makes a second build of a program do something, and what does not: an image is made anew after each
// kind of change that can make it another one, and left alone after none.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <mutex>
#include <thread>

#include "compiler/build/build_record.h"
#include "compiler/cache/object_cache.h"
#include "tests/cc/bench.h"
#include "twinpuck_paths.h"

using namespace cc_test;
namespace fs = std::filesystem;

namespace {

/// A program in a folder whose objects are kept in that folder, too.
class Rebuild : public ::testing::Test {
 protected:
  cc::BuildResult build_again() {
    cc::BuildOptions o = options;
    o.source_dir = folder.path / "prog";
    o.output = folder.image();
    o.cache_dir = folder.path / "cache";
    return cc::build_image(o);
  }
  /// Builds until the files are old enough for their times to count.
  void build_and_settle() {
    const auto first = build_again();
    ASSERT_TRUE(first.ok) << text_of(first);
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
    build_again();
    ASSERT_FALSE(is_made_anew()) << "without any change";
  }
  bool is_made_anew() {
    const auto before = number();
    const auto result = build_again();
    EXPECT_TRUE(result.ok) << text_of(result);
    return number() != before;
  }
  /// An image ends with its stamp; half of one does not open.
  bool bytes_are_whole() const {
    const std::string bytes = cc::bytes_of(folder.image());
    return bytes.rfind(
               "\x7F"
               "ELF",
               0) == 0 &&
           bytes.size() > 4096;
  }
  std::string console() { return output_of(folder.image()); }
  void main_c(const std::string& text) { folder.file("prog/main.c", text); }
  ino_t number() const {
    struct stat s {};
    stat((folder.image()).c_str(), &s);
    return s.st_ino;
  }

  Folder folder;
  cc::BuildOptions options;
};

constexpr const char* kSaysSpeed =
    "#include <stdio.h>\n#include \"Speed.h\"\nint main(void) { printf(\"%d\", SPEED); return 0; }";

TEST_F(Rebuild, nothing_is_done_when_nothing_has_changed) {
  main_c("int main(void) { int unused; return 70000; }");
  const auto first = build_again();
  ASSERT_TRUE(first.ok);
  EXPECT_EQ(first.compiled, 1) << "the program: the library is there";
  build_and_settle();
  const auto again = build_again();
  EXPECT_TRUE(again.ok);
  EXPECT_EQ(again.compiled, 0);
  EXPECT_EQ(again.reused, first.compiled + first.reused);
  EXPECT_EQ(again.seconds, 0);
  EXPECT_EQ(text_of(again), text_of(first)) << "warnings are told again";
  EXPECT_FALSE(text_of(again).empty());
  EXPECT_EQ(again.stack_bytes, first.stack_bytes);
}

// two views of one program, or a view and a run: a saved file starts a build in each of them
TEST_F(Rebuild, builds_of_one_program_at_the_same_moment_do_not_spoil_each_others) {
  const auto text = [](char c) {
    return std::string("#include <stdio.h>\nint main(void) { printf(\"") + c + "\"); return 0; }";
  };
  // as editors save: the file is the old or the new one
  const auto save = [&](char c) {
    folder.file("prog/next", text(c));
    fs::rename(folder.path / "prog/next", folder.path / "prog/main.c");
  };
  main_c(text('0'));
  ASSERT_TRUE(build_again().ok);
  std::atomic<bool> ended{false};
  std::atomic<int> failed{0};
  std::string said;
  std::mutex mutex;
  std::vector<std::thread> builders;
  for (int i = 0; i < 3; ++i)
    builders.emplace_back([&] {
      while (!ended) {
        const auto result = build_again();
        if (result.ok && bytes_are_whole()) continue;
        ++failed;
        const std::lock_guard<std::mutex> lock(mutex);
        said = text_of(result);
      }
    });
  for (int round = 0; round < 12; ++round) {
    save(static_cast<char>('1' + round % 2));
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  ended = true;
  for (auto& builder : builders) builder.join();
  EXPECT_EQ(failed, 0) << said;
  // and whatever they have left behind misleads nobody
  for (char c : std::string("1212")) {
    save(c);
    ASSERT_TRUE(build_again().ok);
    EXPECT_EQ(console(), std::string(1, c));
  }
}

TEST_F(Rebuild, a_touched_file_of_the_same_content_is_no_change) {
  main_c("int main(void) { return 0; }");
  build_and_settle();
  main_c("int main(void) { return 0; }");
  EXPECT_FALSE(is_made_anew());
}

// each that an assembler source reads, by itself or through another
TEST_F(Rebuild, what_an_assembler_source_includes_is_a_change) {
  main_c(
      "#include <stdio.h>\nextern int one, two, three;\nint main(void) { printf(\"%d %d %d\", one, two, "
      "three); return 0; }");
  const auto source = [](int n) {
    return ".equ N" + std::to_string(n % 10) + ", " + std::to_string(n) + "\n";
  };
  folder.file("prog/first file.inc", source(1));
  folder.file("prog/second.inc", ".include \"third.inc\"\n" + source(2));
  folder.file("prog/third.inc", source(3));
  folder.file("prog/words.s",
              ".include \"first file.inc\"\n.include \"second.inc\"\n.global _one, _two, _three\n"
              ".section .data, data\n_one: .word N1\n_two: .word N2\n_three: .word N3\n.end\n");
  build_and_settle();
  EXPECT_EQ(console(), "1 2 3");
  folder.file("prog/first file.inc", source(11));
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "11 2 3");
  folder.file("prog/second.inc", ".include \"third.inc\"\n" + source(12));
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "11 12 3");
  folder.file("prog/third.inc", source(13));
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "11 12 13");
}

TEST_F(Rebuild, a_source_of_the_same_length_and_time_is_a_change) {
  main_c("#include <stdio.h>\nint main(void) { printf(\"1\"); return 0; }");
  build_and_settle();
  const fs::path file = folder.path / "prog/main.c";
  const auto time = fs::last_write_time(file);
  main_c("#include <stdio.h>\nint main(void) { printf(\"2\"); return 0; }");
  fs::last_write_time(file, time);
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "2");
}

TEST_F(Rebuild, a_header_of_the_name_as_it_is_written_goes_before_one_in_another_case) {
  main_c(kSaysSpeed);
  folder.file("prog/speed.h", "#define SPEED 3\n");
  build_and_settle();
  EXPECT_EQ(console(), "3");
  folder.file("prog/Speed.h", "#define SPEED 4\n");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "4");
  fs::remove(folder.path / "prog/Speed.h");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "3");
}

TEST_F(Rebuild, a_header_outside_the_project_that_appears_in_front_is_a_change) {
  main_c(kSaysSpeed);
  folder.file("near/placeholder.h", "");
  folder.file("far/Speed.h", "#define SPEED 5\n");
  options.include_dirs = {folder.path / "near", folder.path / "far"};
  build_and_settle();
  EXPECT_EQ(console(), "5");
  folder.file("near/Speed.h", "#define SPEED 6\n");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "6");
}

TEST_F(Rebuild, options_are_a_change) {
  main_c("#include <stdio.h>\nint main(void) { printf(\"%d\", SPEED); return 0; }");
  options.defines = {"SPEED=7"};
  build_and_settle();
  options.defines = {"SPEED=8"};
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "8");
  options.optimisation = "-O0";
  EXPECT_TRUE(is_made_anew());
  options.sanitize = true;
  EXPECT_TRUE(is_made_anew());
  options.name = "somebody_else";
  EXPECT_TRUE(is_made_anew());
}

TEST_F(Rebuild, a_source_that_is_added_or_removed_is_a_change) {
  main_c("#include <stdio.h>\nint main(void) { puts(\"x\"); return 0; }");
  build_and_settle();
  folder.file("prog/mine.c", "#include <stdio.h>\nint puts(const char *s) { printf(\"mine\"); return 0; }");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "mine");
  fs::remove(folder.path / "prog/mine.c");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "x\n");
}

TEST_F(Rebuild, a_project_file_that_appears_is_a_change) {
  main_c(
      "#include <stdio.h>\n#ifndef SPEED\n#define SPEED 1\n#endif\nint main(void) { printf(\"%d\", SPEED); "
      "return 0; }");
  build_and_settle();
  folder.file("prog/Makefile", "CFLAGS = -DSPEED=9\n");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "9");
}

TEST_F(Rebuild, a_source_or_header_of_the_library_is_a_change) {
  const fs::path ours = TWINPUCK_SOURCE_DIR;
  options.api_dir = folder.path / "api";
  options.include_root = folder.path / "include";
  fs::copy(ours / "hal_dspic", options.api_dir, fs::copy_options::recursive);
  for (const char* other : {"runtime", "bootloader"}) fs::remove_all(options.api_dir / other);
  fs::copy(ours / "firmware/include", options.include_root, fs::copy_options::recursive);
  folder.file("api/number.c", "int number(void) { return 1; }");
  main_c(
      "#include <stdio.h>\n#include \"e_sound.h\"\n#ifndef SPEED\n#define SPEED 0\n#endif\n"
      "int number(void);\nint main(void) { printf(\"%d %d\", number(), SPEED); return 0; }");
  build_and_settle();
  EXPECT_EQ(console(), "1 0");
  folder.file("api/number.c", "int number(void) { return 2; }");
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "2 0");
  std::ofstream(options.include_root / "codec/e_sound.h", std::ios::app) << "#define SPEED 3\n";
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "2 3");
  folder.file("include/motor_led/e_sound.h", "#define SPEED 4\n");  // looked up first
  EXPECT_TRUE(is_made_anew());
  EXPECT_EQ(console(), "2 4");
}

TEST_F(Rebuild, an_image_that_was_replaced_or_removed_is_made_again) {
  main_c("int main(void) { return 0; }");
  build_and_settle();
  std::ofstream(folder.image(), std::ios::app) << "x";
  EXPECT_TRUE(is_made_anew());
  build_and_settle();
  fs::remove(folder.image());
  EXPECT_TRUE(is_made_anew());
}

TEST_F(Rebuild, a_failed_build_is_tried_again) {
  main_c("int main(void) { return nothing; }");
  EXPECT_FALSE(build_again().ok);
  EXPECT_FALSE(build_again().ok);
  main_c("int main(void) { return 0; }");
  EXPECT_TRUE(build_again().ok);
}

// what cannot be exchanged under a test is at least among what is compared
TEST_F(Rebuild, compiler_and_library_are_compared) {
  main_c("int main(void) { return 0; }");
  build_and_settle();
  std::string record;
  for (const auto& entry : fs::directory_iterator(folder.path / "cache"))
    if (entry.path().extension() == ".record") record = cc::bytes_of(entry.path());
  for (const std::string path :
       {TWINPUCK_BUILD_DIR "/twinpuck-cc", TWINPUCK_SOURCE_DIR "/hal_dspic/runtime/libc_calls.c",
        TWINPUCK_SOURCE_DIR "/hal_dspic/motor_led/e_motors.c"})
    EXPECT_NE(record.find('\0' + path + '\0'), std::string::npos) << path;
}

TEST(build_inputs, a_file_that_changes_in_the_same_instant_is_told_by_its_content) {
  Folder folder;
  const fs::path file = folder.file("a.h", "1");
  cc::BuildOptions o;
  o.cache_dir = folder.path;
  o.output = folder.path / "x.elf";
  const cc::BuildRecord record(o);
  cc::BuildInputs inputs;
  inputs.look_at(file);
  EXPECT_EQ(inputs.all.begin()->second.state.changed_ns, 0) << "the time of so young a file says nothing";
  folder.file("a.h", "2");  // within the grain of the file system's clock, of the same length
  record.keep({}, inputs.all);
  EXPECT_FALSE(record.recall());
  folder.file("a.h", "1");
  EXPECT_TRUE(record.recall());
}

TEST(build_inputs, what_is_refused_is_told_once) {
  cc::BuildInputs inputs;
  inputs.refuse("/a/b.h", "header");
  inputs.refuse("/a/b.h", "header");
  EXPECT_EQ(inputs.refusals().size(), 1u);
  inputs.refuse("/a/c.h", "header");
  ASSERT_EQ(inputs.refusals().size(), 2u);
  EXPECT_EQ(inputs.refusals()[1].rfind("/a/c.h: ", 0), 0u);
}

TEST(build_inputs, a_file_that_changed_while_its_reader_ran_is_never_the_same) {
  Folder folder;
  const std::int64_t began = cc::now_ns();
  const fs::path file = folder.file("a.h", "1");
  cc::BuildInputs inputs;
  cc::BuildInputs later;
  EXPECT_NE(inputs.look_at(file, began), later.look_at(file));
}

}  // namespace
