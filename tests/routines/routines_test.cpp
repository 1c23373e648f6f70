// SPDX-License-Identifier: MIT
// Every routine that is known by heart against itself on the core: results and cycles, on random and
// on awkward operands.
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "dspic30/routines/known_routines.h"
#include "tests/routines/routine_program.h"
#include "twinpuck_paths.h"

namespace {

using namespace routines_test;

/// Operands a routine; `make routines` asks for ten million.
long operands() {
  const char* const asked = std::getenv("TWINPUCK_ROUTINES");
  return asked ? std::atol(asked) : 100000;
}

std::string source() {
  std::ostringstream text;
  text << std::ifstream(std::string(TWINPUCK_SOURCE_DIR) + "/tests/routines/every_routine.c").rdbuf();
  return text.str();
}

RoutineProgram& program() {
  static RoutineProgram all(source());
  return all;
}

struct Draw {
  std::uint64_t state;
  std::uint64_t operator()() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state * 0x2545F4914F6CDD1Du;
  }
  unsigned below(unsigned n) { return static_cast<unsigned>((*this)() >> 32) % n; }
};

/// As a float and as an integer: ends of ranges, powers of two and their neighbours, few bits set.
std::uint32_t awkward(Draw& draw) {
  static constexpr std::uint32_t kEnds[] = {
      0,          0x80000000, 1,          0x80000001, 0x007FFFFF, 0x00800000, 0x7F7FFFFF, 0xFF7FFFFF,
      0x7F800000, 0xFF800000, 0x7FC00000, 0x7F800001, 0x3F800000, 0xBF800000, 0x3F800001, 0x3F7FFFFF,
      0xFFFFFFFF, 0x7FFFFFFF, 0x0000FFFF, 0x00010000, 0x00010001, 0xFFFF0000, 0x4B000000, 0x4B7FFFFF,
      0x4F000000, 0xCF000000, 0x4EFFFFFF, 0x4F7FFFFF, 0x5F000000, 0x3F000000, 2,          3};
  const auto bits = static_cast<std::uint32_t>(draw());
  switch (draw.below(8)) {
    case 0:
      return kEnds[draw.below(sizeof kEnds / sizeof *kEnds)];
    case 1:
      return (1u << (bits & 31)) + (bits >> 8 & 3) - 1;
    case 2:  // a float of few digits
      return (bits & 0x80000000u) | ((bits & 0x7F800000u) + (bits << 20 & 0x700000));
    case 3:  // a float near 1
      return (bits & 0x807FFFFFu) | ((0x78 + (bits >> 24 & 15)) << 23);
    case 4:
      return bits >> (bits & 31);
    case 5:
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(bits) >> (bits & 31));
    default:
      return bits;
  }
}

Words draw_operands(Draw& draw) {
  std::array<std::uint32_t, 8> pairs{};
  for (std::uint32_t& pair : pairs) pair = awkward(draw);
  // the second is often near the first one, or its opposite
  for (const std::size_t of : {0u, 2u}) switch (draw.below(6)) {
      case 0:
        pairs[of + 1] = pairs[of] + draw.below(5) - 2;
        break;
      case 1:
        pairs[of + 1] = pairs[of] ^ 0x80000000u ^ (1u << draw.below(32));
        break;
      case 2:
        pairs[of + 1] = ((pairs[of] & 0xFF800000u) + (draw.below(33) << 23)) | (pairs[of + 1] & 0x007FFFFFu);
        break;
      default:
        break;
    }
  Words w;
  std::memcpy(w.data(), pairs.data(), sizeof w);
  // 64 bits: often less of the divisor; by how much to shift
  switch (draw.below(4)) {
    case 0:
      w[7] = w[6] = 0;
      break;
    case 1:
      w[3] = w[2] = w[7] = w[6] = 0;
      break;
    case 2:
      w[4] = static_cast<std::uint16_t>(draw.below(64));
      break;
    default:
      break;
  }
  return w;
}

/// Two places in RAM or among the constants, near one another at times, and few bytes; texts end soon.
Words draw_memory(Draw& draw) {
  Words w = draw_operands(draw);
  const auto place = [&] {
    const unsigned in_ram = RoutineProgram::kData + 32 + draw.below(160);
    return draw.below(4) ? in_ram : program().constants() + draw.below(30);
  };
  w[0] = static_cast<std::uint16_t>(place());
  w[1] = static_cast<std::uint16_t>(draw.below(3) ? place() : w[0] + draw.below(9) - 4);
  w[2] = static_cast<std::uint16_t>(draw.below(32));
  std::uint8_t* const data = &program().cpu().ram[RoutineProgram::kData - dspic::Cpu::kRamStart];
  for (int i = 0; i < 256; ++i) {
    if (draw.below(4) == 0) data[i] = draw.below(3) ? 'a' : 0;
    if (i > 32 && draw.below(8) == 0) data[i] = data[i - draw.below(32)];
  }
  return w;
}

std::string hex_of(const Words& w) {
  std::ostringstream text;
  text << std::hex;
  for (int i = 7; i >= 0; --i) text << w[static_cast<std::size_t>(i)] << (i ? " " : "");
  return text.str();
}

bool is_of_memory(const dspic::KnownRoutine& routine) {
  const std::string name = routine.name;
  return name.rfind("_mem", 0) == 0 || name.rfind("_str", 0) == 0;
}

class Routine : public ::testing::TestWithParam<const dspic::KnownRoutine*> {};

TEST_P(Routine, GivesWhatItGivesAndTakesWhatItTakes) {
  const dspic::KnownRoutine& routine = *GetParam();
  ASSERT_TRUE(program().is_whole()) << program().error();
  const unsigned address = program().address_of(routine.name + 1);
  ASSERT_NE(address, 0u);
  EXPECT_EQ(dspic::code_sum(program().program(), address), routine.code)
      << routine.name << "'s code is another one: look at its form again, then this is its sum: 0x"
      << std::hex << dspic::code_sum(program().program(), address);
  Draw draw{0x9E3779B97F4A7C15u};
  long known = 0, wrong = 0;
  static State before, by_heart, on_the_core;
  program().fill_ram(1);
  for (long i = 0; i < operands(); ++i) {
    const Words w = is_of_memory(routine) ? draw_memory(draw) : draw_operands(draw);
    const unsigned flags = draw.below(32);
    program().look(before);
    if (!program().recall(routine, address, w, flags)) continue;
    ++known;
    program().look(by_heart);
    program().restore(before);
    program().call(address, w, flags);
    program().look(on_the_core);
    const std::string wrong_here = difference(by_heart, on_the_core);
    if (!wrong_here.empty() && ++wrong <= 5)
      ADD_FAILURE() << routine.name << " with W7 to W0 " << hex_of(w) << ": " << wrong_here;
    // which flags it found shows in none that it leaves
    program().restore(before);
    if (routine.keeps_flags || !program().recall(routine, address, w, flags ^ 31)) continue;
    const unsigned left = by_heart.sr;
    program().look(by_heart);
    if (by_heart.sr != left && ++wrong <= 5)
      ADD_FAILURE() << routine.name << " with W7 to W0 " << hex_of(w) << " leaves flags as they were";
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(known, operands() / 4);
  RecordProperty("known", std::to_string(known));
}

// before it is over nothing may come; what comes a little later may
TEST_P(Routine, IsKnownWhereNothingComesBeforeItIsOver) {
  const dspic::KnownRoutine& routine = *GetParam();
  const unsigned address = program().address_of(routine.name + 1);
  Draw draw{0x9E3779B97F4A7C15u};
  static State before, after;
  program().fill_ram(1);
  long known = 0;
  for (int i = 0; i < 2000; ++i) {
    const Words w = is_of_memory(routine) ? draw_memory(draw) : draw_operands(draw);
    program().look(before);
    if (!program().recall(routine, address, w, 0)) continue;
    ++known;
    program().look(after);
    constexpr dspic::Cycle kLittle = 80;  // comparisons and memmove() take their longest way for granted
    for (const dspic::Cycle late : {kLittle, dspic::Cycle{0}}) {
      program().restore(before);
      ASSERT_EQ(program().recall(routine, address, w, 0, after.cycles + late), late > 0)
          << routine.name << " with W7 to W0 " << hex_of(w) << " takes " << after.cycles;
    }
    program().restore(before);
  }
  EXPECT_GT(known, 500);
}

// those of the I2C master have more than operands: i2c_test.cpp
std::vector<const dspic::KnownRoutine*> of_operands() {
  std::vector<const dspic::KnownRoutine*> all;
  for (const dspic::KnownRoutine* routine : dspic::known_routines())
    if (std::string(routine->name).rfind("_e_i2c", 0) != 0) all.push_back(routine);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, Routine, ::testing::ValuesIn(of_operands()), [](const auto& info) {
  std::string name = info.param->name;
  return name.substr(name.find_first_not_of('_'));
});

}  // namespace
