// SPDX-License-Identifier: MIT
// Programs with their runtime known by heart and without: the same course to the cycle, interrupts in the
// middle of routines included, however time is cut into windows. And what is known of which image.
#include "dspic30/core/processor.h"
#include "dspic30/routines/known_routines.h"
#include "tests/dspic30/core_bench.h"
#include "tests/routines/routine_program.h"

namespace {

using namespace routines_test;
using dspic::Cycle;
using dspic::KnownCalls;

// a timer at 10 kHz, in whose handler routines run as well
constexpr const char* kBusy = R"(
#include <p30F6014A.h>
#include <string.h>
volatile unsigned ticks;
volatile float f = 1.5f, g = 0.001f, in_handler = 1, sum;
volatile long a = 123456789, b = 1, q, r;
volatile unsigned long c = 70000, d;
char text[40], other[40];
static const char constant[] = "a constant text";
void __attribute__((interrupt, auto_psv)) _T1Interrupt(void)
{
  IFS0bits.T1IF = 0;
  in_handler = in_handler * 1.5f + ticks;
  if (in_handler > 1e6f) in_handler = in_handler / 3;
  a = a / 3 + ticks * 100003L;
  ticks++;
}
int main(void)
{
  unsigned i;
  PR1 = 1473;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
  for (i = 0;; i++) {
    f = f * 1.01f - g;
    g = g + f / 7;
    if (f > 1e5f || f < -1e5f) f = 0;
    sum = sum + (float)(long)f;
    q += a / b;
    r += a % b;
    b = b * 5 + 3;
    if (b == 0) b = 1;
    d += (unsigned long)a / c;
    c += 1001;
    strcpy(text, constant);
    text[i & 7] = (char)i;
    memmove(other + 1, text, 12);
    if (strcmp(text, other) > 0) memset(other, 0, i & 31);
    r += strlen(other) + memcmp(text, other, 16);
  }
}
)";

const dspic::FirmwareFile& busy() {
  static const dspic::FirmwareFile* const file = [] {
    auto* made = new dspic::FirmwareFile;
    std::string error;
    EXPECT_TRUE(build(kBusy, *made, error)) << error;
    return made;
  }();
  return *file;
}

struct Chip {
  explicit Chip(const dspic::FirmwareFile& file) {
    for (const auto& [address, word] : file.words) program.write(address, word);
    dspic::Configuration c;
    c.program = &program;
    device = std::make_unique<dspic::Dspic30f6014a>(outside, &notes, c);
    cpu = std::make_unique<dspic::Processor>(*device, program);
  }
  bench::FakeOutside outside;
  bench::Notes notes;
  dspic::ProgramMemory program;
  std::unique_ptr<dspic::Dspic30f6014a> device;
  std::unique_ptr<dspic::Processor> cpu;
};

long answers;
dspic::KnownAction real_action;
int count(dspic::Cpu& cpu, std::int64_t limit) {
  const int cycles = real_action(cpu, limit);
  answers += cycles != 0;
  return cycles;
}

constexpr Cycle kEnd = 3000000;

TEST(Course, is_the_same_by_heart_whatever_interrupts_come) {
  Chip plain(busy()), by_heart(busy());
  by_heart.cpu->know(dspic::known_calls(busy().functions, by_heart.program));
  for (Cycle until = 100000; until <= kEnd; until += 100000) {
    ASSERT_FALSE(plain.cpu->run(until));
    ASSERT_FALSE(by_heart.cpu->run(until));
    ASSERT_EQ(by_heart.cpu->state_hash(), plain.cpu->state_hash()) << "at " << until;
    ASSERT_EQ(by_heart.device->state_hash(until), plain.device->state_hash(until)) << "at " << until;
  }
  EXPECT_GT(by_heart.device->interrupts().served(dspic::kFirstIrqVector + dspic::irq::T1), 1900);
}

TEST(Course, does_not_depend_on_windows) {
  const auto hash = [](Cycle window, bool knows) {
    Chip chip(busy());
    if (knows) chip.cpu->know(dspic::known_calls(busy().functions, chip.program));
    for (Cycle until = window; until < kEnd / 5; until += window) chip.cpu->run(until);
    chip.cpu->run(kEnd / 5);
    return chip.cpu->state_hash();
  };
  const std::uint64_t plain = hash(kEnd, false);
  for (const Cycle window : {Cycle{1}, Cycle{7}, Cycle{50}, Cycle{150}, Cycle{1111}, Cycle{30000}, kEnd})
    EXPECT_EQ(hash(window, true), plain) << window;
}

TEST(Course, routines_are_indeed_answered) {
  Chip chip(busy());
  const unsigned address = busy().functions.at("__divsi3");
  const dspic::KnownRoutine* const known = dspic::find_known("__divsi3", chip.program, address);
  ASSERT_TRUE(known);
  real_action = known->action;
  const dspic::KnownRoutine counted{known->name, known->code, nullptr, &count};
  auto calls = std::make_shared<KnownCalls>();
  calls->add(address, counted);
  chip.cpu->know(calls);
  answers = 0;
  chip.cpu->run(kEnd);
  EXPECT_GT(answers, 500);  // a division each 3000 cycles or so, and in the handler
}

// --- what is known

TEST(KnownCode, is_found_in_an_image_without_symbols) {
  std::string error;
  dspic::FirmwareFile bare;
  ASSERT_TRUE(dspic::load_firmware(dspic::to_hex(busy()), "busy.hex", bare, error)) << error;
  ASSERT_FALSE(bare.functions.count("__divsi3"));
  Chip chip(busy());
  const auto calls = dspic::known_calls(bare.functions, chip.program);
  for (const char* name :
       {"__divsi3", "__modsi3", "__udivsi3", "__addsf3", "__mulsf3", "__divsf3", "__fixsfsi", "strcmp"}) {
    const dspic::KnownRoutine* const found = calls->find(busy().functions.at(name));
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(std::string(found->name), std::string("_") + name);
  }
}

TEST(KnownCode, a_program_s_own_routine_is_none) {
  dspic::FirmwareFile file;
  std::string error;
  ASSERT_TRUE(build(R"(
volatile long a = 100, b = 7, c;
long __divsi3(long x, long y) { return x - y; }
int main(void) { c = a / b; c = a % b; for (;;) ; }
)",
                    file, error))
      << error;
  Chip chip(file);
  const auto calls = dspic::known_calls(file.functions, chip.program);
  EXPECT_FALSE(calls->find(file.functions.at("__divsi3")));
  EXPECT_TRUE(calls->find(file.functions.at("__modsi3")));
  chip.cpu->know(calls);
  chip.cpu->run(100000);
  const unsigned at = file.objects.at("c");
  EXPECT_EQ(chip.cpu->ram(at), 100 % 7);
}

// another program, so the linker puts everything elsewhere
constexpr const char* kMore = R"(
volatile int n;
int main(void)
{
  while (n < 1000) n = n * 3 + 1;
  return inner();
}
)";

// the same name and one word changed, wherever it lies in what the routine reaches
TEST(KnownCode, one_other_word_is_another_routine) {
  Chip chip(busy());
  const unsigned start = busy().functions.at("__divsi3"), helper = busy().functions.at("_divide_long");
  ASSERT_TRUE(dspic::find_known("__divsi3", chip.program, start));
  for (const unsigned address : {start + 2, helper + 10}) {
    Chip other(busy());
    other.program.write(address, other.program.read(address) ^ 1);
    EXPECT_FALSE(dspic::find_known("__divsi3", other.program, start)) << address;
  }
  EXPECT_FALSE(dspic::find_known("__modsi3", chip.program, start)) << "another routine's code";
  EXPECT_FALSE(dspic::find_known("main", chip.program, start));
}

TEST(KnownCode, lies_anywhere) {
  dspic::FirmwareFile file;
  std::string error;
  ASSERT_TRUE(build(std::string("#define main inner\n") + kBusy + "#undef main\n" + kMore, file, error))
      << error;
  Chip chip(file), first(busy());
  ASSERT_NE(file.functions.at("__addsf3"), busy().functions.at("__addsf3"));
  EXPECT_EQ(dspic::code_sum(chip.program, file.functions.at("__addsf3")),
            dspic::code_sum(first.program, busy().functions.at("__addsf3")));
}

// --- the seam: a routine of 20 cycles with its RETURN, known to give 7

constexpr const char* kCalls = R"(
__reset:
    mov #0x1000, w15
    mov #5, w0
again:
    rcall routine
    mov w0, w8
    inc w9, w9
    bra again
routine:
    repeat #14
    nop
    mov #7, w0
    return
)";

dspic::KnownAnswer seven(std::uint64_t w) { return {(w & ~std::uint64_t{0xFFFF}) | 7, 1 + 15 + 1 + 3}; }

TEST(KnownCalls, takes_the_time_of_the_routine) {
  const dspic::KnownRoutine routine{"routine", 1, &seven, nullptr};
  for (const Cycle window : {Cycle{1}, Cycle{20}, Cycle{23}, Cycle{24}, Cycle{25}, Cycle{1000}}) {
    bench::CoreBench plain(kCalls, {}, false), known(kCalls, {}, false);
    auto calls = std::make_shared<KnownCalls>();
    calls->add(known.symbol("routine"), routine);
    known.cpu->know(calls);
    for (Cycle until = window; until <= 2000; until += window) {
      plain.run(until);
      known.run(until);
      ASSERT_EQ(known.cpu->now(), plain.cpu->now()) << window;
      ASSERT_EQ(known.cpu->pc(), plain.cpu->pc()) << window;
      ASSERT_EQ(known.w(8), plain.w(8)) << window;
      ASSERT_EQ(known.w(9), plain.w(9)) << window;
    }
    EXPECT_EQ(known.w(9), plain.w(9));
    EXPECT_GT(known.w(9), 70u);
  }
}

// a form that lies shows when it is asked: only where the routine has ended before anything else may happen
TEST(KnownCalls, are_answered_where_there_is_time) {
  const dspic::KnownRoutine routine{"routine", 1,
                                    [](std::uint64_t w) {
                                      return dspic::KnownAnswer{(w & ~std::uint64_t{0xFFFF}) | 9, 20};
                                    },
                                    nullptr};
  // it begins in cycle 6, when registers count as written for the first time, and in cycle 32
  for (const auto& [window, result] : {std::pair{52, 7u}, {53, 9u}}) {
    bench::CoreBench known(kCalls, {}, false);
    auto calls = std::make_shared<KnownCalls>();
    calls->add(known.symbol("routine"), routine);
    known.cpu->know(calls);
    known.run(window);
    known.run(56);
    EXPECT_EQ(known.w(8), result) << window;
  }
}

TEST(KnownCalls, finds_each_of_many) {
  static const dspic::KnownRoutine routine{"routine", 1, &seven, nullptr};
  KnownCalls calls;
  EXPECT_FALSE(calls.find(0x100));
  for (unsigned i = 0; i < 100; ++i) calls.add(0x100 + 26 * i, routine);
  calls.add(0x100, routine);
  EXPECT_EQ(calls.size(), 100u);
  for (unsigned i = 0; i < 100; ++i) {
    EXPECT_TRUE(calls.find(0x100 + 26 * i));
    EXPECT_FALSE(calls.find(0x102 + 26 * i));
  }
}

// flash that was written anew holds other routines
TEST(KnownCalls, are_forgotten_with_the_flash) {
  RoutineProgram program(kBusy);
  ASSERT_TRUE(program.is_whole()) << program.error();
  program.cpu().know(dspic::known_calls(program.functions(), program.program()));
  program.cpu().choose_code();
  const unsigned address = program.address_of("__divsi3");
  EXPECT_TRUE(program.cpu().table().known_at(address));
  program.cpu().forget_code();  // decoded anew, and known as before
  program.cpu().choose_code();
  EXPECT_TRUE(program.cpu().table().known_at(address));
  program.cpu().program.erase_row(0x17000);
  program.cpu().choose_code();
  EXPECT_FALSE(program.cpu().table().known_at(address));
}

}  // namespace
