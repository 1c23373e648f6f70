// SPDX-License-Identifier: MIT
// Robots with the same image share its code; each runs as if it had it for itself.
#include "dspic30/core/code_store.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <thread>

#include "tests/dspic30/core_bench.h"

namespace {

using namespace bench;
using Store = std::shared_ptr<dspic::CodeStore>;

Store new_store() { return std::make_shared<dspic::CodeStore>(); }

/// Hot code is translated, as in the product.
std::unique_ptr<CoreBench> robot(const std::string& text, const Store& store) {
  static dspic::translate::Translations translations(chip::translator_library(), {});
  auto b = std::make_unique<CoreBench>(text, dspic::Configuration{}, false, store);
  b->cpu->set_translator(&translations);
  return b;
}

constexpr unsigned kFlag = 0x900;  // a word of RAM in which two robots differ

struct Course {
  std::uint64_t hash;
  Cycle now;
  int resets;
  unsigned pc, w0;
  bool operator==(const Course& o) const {
    return hash == o.hash && now == o.now && resets == o.resets && pc == o.pc && w0 == o.w0;
  }
};

Course course_of(const CoreBench& b) {
  return {b.cpu->state_hash(), b.cpu->now(), b.resets, b.cpu->pc(), b.w(0)};
}

/// Runs robots with these flags to the end, on one store, in turns; returns each one's course, which is the
/// same as if it had run alone. `step`: length of a turn.
std::vector<Course> together(const std::string& text, const std::vector<std::uint8_t>& flags, Cycle end,
                             Cycle step) {
  const Store store = new_store();
  std::vector<std::unique_ptr<CoreBench>> robots;
  for (const std::uint8_t flag : flags) {
    robots.push_back(robot(text, store));
    robots.back()->cpu->set_ram(kFlag, flag);
  }
  for (Cycle at = step; at < end + step; at += step)
    for (const auto& b : robots) b->run(std::min(at, end));
  std::vector<Course> courses;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    CoreBench alone(text, {}, false);
    alone.cpu->set_ram(kFlag, flags[i]);
    alone.run(end);
    courses.push_back(course_of(*robots[i]));
    EXPECT_TRUE(course_of(alone) == courses.back()) << "robot " << i << " with flag " << int{flags[i]};
  }
  return courses;
}

// all registers are written, then rounds that get hot
const std::string kWriteAll = [] {
  std::string text;
  for (int n = 0; n < 15; ++n) text += "    clr w" + std::to_string(n) + "\n";
  return text;
}();
const std::string kRounds = "__reset:\n" + kWriteAll + R"(
1:  mov #0x0A00, w1
    mov #200, w2
2:  inc [w1], [w1]
    add w3, w2, w3
    xor w3, w2, w4
    add w4, [w1++], w5
    dec w2, w2
    bra nz, 2b
    inc w0, w0
    bra 1b
)";

TEST(CodeStore, what_one_robot_translated_all_have) {
  const Store store = new_store();
  const auto first = robot(kRounds, store);
  first->run(4000000);
  ASSERT_GT(first->cpu->cpu().table().translated(), 0);
  const auto second = robot(kRounds, store);
  second->run(30);
  EXPECT_EQ(second->cpu->cpu().table().translated(), first->cpu->cpu().table().translated());
  CoreBench alone(kRounds, {}, false);
  alone.run(4000000);
  second->run(4000000);
  EXPECT_TRUE(course_of(*second) == course_of(alone));
  EXPECT_TRUE(course_of(*first) == course_of(alone));
}

// before and after the words of its loop are shared and hot
TEST(CodeStore, a_robot_that_programs_its_flash_has_its_own_code_from_then_on) {
  const std::string text = kFlashMacro + "__reset:\n" + kWriteAll + R"(
    mov #40, w12
1:  mov #5000, w10
2:  rcall routine
    add w0, w5, w0
    dec w10, w10
    bra nz, 2b
    cp0 0x900
    bra z, 3f
    clr 0x900
    clr TBLPAG
    mov #routine, w1
    mov w1, NVMADR
    clr NVMADRU
    mov w0, w13
    go 0x4041
    mov #0x0075, w2         ; mov #7, w5; return
    mov #0x0020, w3
    tblwtl w2, [w1]
    tblwth w3, [w1++]
    mov #0x0000, w2
    mov #0x06, w3
    tblwtl w2, [w1]
    tblwth w3, [w1]
    go 0x4001
    mov w13, w0
3:  dec w12, w12
    bra nz, 1b
end: bra end
    .section .routine, code, address(0x1000)
routine: mov #1, w5
    return)";
  for (const Cycle step : {Cycle{1000}, Cycle{100000}, Cycle{3000000}}) {
    const auto courses = together(text, {0, 1, 0}, 3000000, step);
    EXPECT_EQ(courses[0].w0, 40u * 5000 % 65536);
    EXPECT_EQ(courses[1].w0, (5000u + 39 * 5000 * 7) % 65536);
    EXPECT_EQ(courses[2].w0, courses[0].w0);
  }
}

TEST(CodeStore, a_modulo_pointer_is_the_robot_s_own_affair) {
  const std::string text = "__reset:\n" + kWriteAll + R"(
    mov #0x0A00, w0
    mov w0, XMODSRT
    mov #0x0A07, w0
    mov w0, XMODEND
    mov #0x80F8, w7
    clr w0
    mov #300, w12
1:  cp0 0x900
    bra z, 2f
    mov w7, MODCON          ; on and off again, in every other round
    nop
    btg w7, #15
2:  mov #0x0A00, w8
    mov #100, w10
3:  mov w10, [w8++]
    inc w2, w2
    add w8, w0, w0
    dec w10, w10
    bra nz, 3b
    dec w12, w12
    bra nz, 1b
end: bra end)";
  unsigned plain = 0, modulo = 0;
  for (unsigned i = 1; i <= 100; ++i) {
    plain += 0xA00 + 2 * i;
    modulo += 0xA00 + 2 * (i % 4);
  }
  for (const Cycle step : {Cycle{500}, Cycle{50000}, Cycle{1000000}}) {
    const auto courses = together(text, {0, 1, 0}, 1000000, step);
    EXPECT_EQ(courses[0].w0, 300 * plain % 65536);
    EXPECT_EQ(courses[1].w0, (150 * plain + 150 * modulo) % 65536);
  }
}

// an address in w5, which only one of them has written: at once, and behind a long start-up
TEST(CodeStore, a_register_that_was_never_written_is_the_robot_s_own_affair) {
  for (const char* rounds : {"1", "20000"}) {
    const std::string text = "__reset: mov #" + std::string(rounds) + R"(, w1
1:  dec w1, w1
    bra nz, 1b
    cp0 0x900
    bra z, 2f
    mov #0x0A00, w5
2:  mov #30000, w1
3:  dec w1, w1
    bra nz, 3b
    mov [w5], w0
    mov #0x1234, w0
end: bra end)";
    for (const auto& flags : {std::vector<std::uint8_t>{1, 0}, {0, 1}, {0, 1, 1, 0}})
      for (const Cycle step : {Cycle{700}, Cycle{1000000}}) {
        const auto courses = together(text, flags, 1000000, step);
        for (std::size_t i = 0; i < flags.size(); ++i) {
          EXPECT_EQ(courses[i].resets > 0, flags[i] == 0);
          EXPECT_EQ(courses[i].w0 == 0x1234, flags[i] != 0);
        }
      }
  }
}

struct Told final : dspic::ProgramWatch {
  void trapped(const dspic::TrapRecord&) override {}
  void went_to_reset_vector(unsigned) override {}
  void entered(unsigned address) override { all.push_back(address); }
  std::vector<unsigned> all;
};

TEST(CodeStore, whoever_is_told_of_other_functions_has_its_own_code) {
  const std::string text =
      "__reset: mov #3, w1\n1: rcall f\n rcall g\n dec w1, w1\n bra nz, 1b\nend: bra end\n"
      "f: return\ng: return\n";
  const Store store = new_store();
  Told of_f, of_g, also_of_f;
  const auto a = robot(text, store), b = robot(text, store), c = robot(text, store);
  a->cpu->tell_calls(&of_f, {a->symbol("f")});
  b->cpu->tell_calls(&of_g, {b->symbol("g")});
  c->cpu->tell_calls(&also_of_f, {c->symbol("f")});
  for (const auto* one : {&a, &b, &c}) (*one)->run(1000);
  EXPECT_EQ(of_f.all, std::vector<unsigned>(3, a->symbol("f")));
  EXPECT_EQ(of_g.all, std::vector<unsigned>(3, a->symbol("g")));
  EXPECT_EQ(also_of_f.all, of_f.all);
}

// of code that is translated, too, and for all that run it
TEST(CodeStore, one_more_function_is_told_from_then_on) {
  constexpr Cycle kRound = 2 + 3 + 3 + 2;  // RCALL, RETURN, three of one cycle, BRA
  const std::string text =
      "__reset: clr w0\n mov #5, w2\n1: rcall f\n add w0, w2, w2\n mov w2, 0x900\n inc w0, w0\n bra 1b\n"
      "f: return\ng: return\n";
  const Store store = new_store();
  Told told;
  const auto a = robot(text, store), b = robot(text, store), later = robot(text, store);
  a->cpu->tell_calls(&told, {a->symbol("g")});
  for (const auto* one : {&a, &b}) (*one)->run(400000);
  const int translated = a->cpu->cpu().table().translated();
  EXPECT_GT(translated, 0);
  EXPECT_TRUE(told.all.empty());
  const Cycle from = a->cpu->now();
  for (int times = 0; times < 2; ++times) a->cpu->tell_calls(&told, {a->symbol("f")});
  EXPECT_LT(a->cpu->cpu().table().translated(), translated);
  for (const auto* one : {&a, &b}) (*one)->run(from + 400000);
  EXPECT_NEAR(static_cast<double>(told.all.size()), 400000.0 / kRound, 1);
  EXPECT_EQ(told.all.back(), a->symbol("f"));
  // it runs as one that nobody is told of, and so does one that begins now
  EXPECT_EQ(course_of(*a), course_of(*b));
  later->run(from + 400000);
  EXPECT_EQ(course_of(*a), course_of(*later));
}

// decoding, translating and running at once; `make tsan T=CodeStore`
TEST(CodeStore, threads_share_it) {
  constexpr int kThreads = 4, kRobots = 3;
  constexpr Cycle kEnd = 1500000;
  CoreBench alone(kRounds, {}, false);
  alone.run(kEnd);
  const Course expected = course_of(alone);
  const Store store = new_store();
  std::vector<std::unique_ptr<CoreBench>> robots;
  for (int i = 0; i < kThreads * kRobots; ++i) robots.push_back(robot(kRounds, store));
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (Cycle at = 10000; at <= kEnd; at += 10000)
        for (int i = 0; i < kRobots; ++i) robots[static_cast<std::size_t>(kRobots * t + i)]->run(at);
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& b : robots) EXPECT_TRUE(course_of(*b) == expected);
  EXPECT_GT(robots[0]->cpu->cpu().table().translated(), 0);
}

TEST(ProgramMemory, copies_share_flash_until_one_is_written) {
  dspic::ProgramMemory one;
  one.write(0x100, 0x123456);
  dspic::ProgramMemory two = one, three = one;
  two.erase_row(0x100);
  EXPECT_EQ(one.read(0x100), 0x123456u);
  EXPECT_EQ(two.read(0x100), 0xFFFFFFu);
  EXPECT_EQ(three.read(0x100), 0x123456u);
  one.write(0x102, 0x1);
  EXPECT_EQ(three.read(0x102), 0xFFFFFFu);
  EXPECT_EQ(one.read(0x100), 0x123456u);
  EXPECT_EQ(two.version(), three.version() + 1);
}

// what is decoded or translated is of a version: each change is a new one, and what changes nothing is none
TEST(ProgramMemory, each_change_is_a_new_version) {
  dspic::ProgramMemory program;
  std::array<std::uint32_t, dspic::kFlashRowWords> latches;
  latches.fill(0x00FFFF);
  const struct Change {
    const char* what;
    std::function<void()> make;
    bool is_one;
  } changes[] = {{"write", [&] { program.write(0x100, 0x123456); }, true},
                 {"erase", [&] { program.erase_row(0x100); }, true},
                 {"program", [&] { program.program_row(0x100, latches); }, true},
                 {"erase beyond", [&] { program.erase_row(0x18000); }, false},
                 {"program beyond", [&] { program.program_row(0x18000, latches); }, false}};
  for (const Change& change : changes) {
    const auto before = program.version();
    change.make();
    EXPECT_EQ(program.version() != before, change.is_one) << change.what;
  }
  EXPECT_EQ(program.read(0x100), 0x00FFFFu);
}

// [datasheet DS70143, program space]: what lies beyond the flash, and what is there to be written
TEST(ProgramMemory, has_its_parts_where_the_chip_has_them) {
  const struct Place {
    unsigned address;
    std::uint32_t erased, after_write;  // 0xABCDEF
  } places[] = {{0x17FFE, 0xFFFFFF, 0xABCDEF},
                {0x18000, 0, 0},
                {0x8005BE, 0, 0},
                {0x8005C0, 0xFFFFFF, 0xABCDEF},
                {0x8005FE, 0xFFFFFF, 0xABCDEF},
                {0x800600, 0, 0},
                {0xF7FFFE, 0, 0},
                {0xF80004, 0, 0xCDEF},
                {0xFF0000, 0x0343, 0x0343},
                {0xFF0001, 0x0343, 0x0343},
                {0xFF0002, 0x1000, 0x1000},
                {0xFF0004, 0, 0}};
  for (const Place& p : places) {
    dspic::ProgramMemory memory;
    if (p.address != 0xF80004) {
      EXPECT_EQ(memory.read(p.address), p.erased) << std::hex << p.address;
    }
    const int before = static_cast<int>(memory.version());
    EXPECT_EQ(memory.write(p.address, 0xABCDEF), p.after_write != p.erased) << std::hex << p.address;
    EXPECT_EQ(memory.read(p.address), p.after_write) << std::hex << p.address;
    EXPECT_EQ(static_cast<int>(memory.version()) - before, p.after_write != p.erased);
  }
}

}  // namespace
