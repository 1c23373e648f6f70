// SPDX-License-Identifier: MIT
// Whole programs on the chip: right at every level, and how long they take beside XC16's.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "compiler/cache/object_cache.h"
#include "tests/chip_cc/chip_program.h"
#include "tests/chip_cc/random_program.h"
#include "twinpuck_paths.h"

namespace chip_cc {
namespace {

namespace fs = std::filesystem;

const fs::path kCycles = fs::path(TWINPUCK_SOURCE_DIR) / "tests/chip_cc/xc16-cycles";
const fs::path kBlind = fs::path(TWINPUCK_SOURCE_DIR) / "tests/chip_cc/xc16-cycles-blind";

std::vector<std::map<std::string, std::string>> rows_of(const fs::path& csv) {
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  std::ifstream in(csv);
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    auto& made = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), row.size()); ++i) made[names[i]] = row[i];
  }
  return rows;
}

/// What XC16's code of the file's own function takes at a level, and its name.
std::map<std::string, std::pair<std::string, double>> vendor_cycles(const fs::path& set,
                                                                    const std::string& level) {
  std::map<std::string, std::pair<std::string, double>> all;
  for (const auto& row : rows_of(set / "cycles.csv"))
    if ((!row.count("role") || row.at("role") == "primary") && row.at("opt") == level)
      all[row.at("file")] = {row.at("function"), std::stod(row.at("cycles_own"))};
  return all;
}

/// The functions of a set at a level: right, and each at most `most` times the vendor's cycles there. Returns
/// the geometric mean over the vendor's.
double slowness_at(const std::string& level, double most, const fs::path& set = kCycles, int files = 71) {
  const auto vendor = vendor_cycles(set, level);
  double sum = 0;
  int count = 0;
  for (const auto& row : rows_of(set / "results.csv")) {
    const std::string name = row.at("file");
    ChipProgram program(name, cc::bytes_of(set / "src" / name), level);
    EXPECT_TRUE(program.is_whole()) << name << ": " << program.error();
    if (!program.is_whole()) continue;
    const auto& [function, cycles] = vendor.at(name);
    dspic::Cycle own = 0;
    EXPECT_EQ(program.run_counting(function, own), std::stoul(row.at("result_hex"), nullptr, 16)) << name;
    EXPECT_GT(own, 0) << name;
    EXPECT_LE(double(own) / cycles, most) << name << level << ": " << own << " cycles, XC16 " << cycles;
    sum += std::log(double(std::max<dspic::Cycle>(own, 1)) / cycles);
    ++count;
  }
  EXPECT_EQ(count, files);
  std::printf("cycles over XC16's at %s, geometric mean of %d: %.3f\n", level.c_str(), count,
              std::exp(sum / count));
  return std::exp(sum / count);
}

// bars of the geometric mean and of each; measured: 0.884 and 1.49
TEST(ChipPrograms, public_functions_are_right_and_no_slower_than_xc16) {
  EXPECT_LT(slowness_at("-O1", 1.5), 0.95);
}

// no rule of the compiler was chosen with these in sight
TEST(ChipPrograms, unseen_functions_are_right_and_no_slower_than_xc16) {
  EXPECT_LT(slowness_at("-O1", 2, kBlind, 45), 1);
}

TEST(ChipPrograms, public_functions_for_size_are_no_slower_than_xc16_s_for_size) {
  EXPECT_LT(slowness_at("-Os", 2), 1);
}

// XC16's -O1 keeps such loops, of a global, of a local, and within another; its -O2 and -Os drop them
TEST(ChipPrograms, delay_loops_wait_at_o0_and_o1_and_are_gone_at_o2) {
  const char* source = R"(
long i;
void __attribute__((noinline)) wait(void) {
  int j, k;
  for (i = 0; i < 1000; i++);
  for (j = 0; j < 10; j++) for (k = 0; k < 100; k++) {}
}
long bench_run(void) { wait(); return i; })";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    ChipProgram program("delay_loops.c", source, level);
    ASSERT_TRUE(program.is_whole()) << level << program.error();
    dspic::Cycle own = 0;
    EXPECT_EQ(program.run_counting("wait", own), 1000u) << level;
    if (level[2] == '0' || level[2] == '1')
      EXPECT_GT(own, 2 * 1000 * 3) << level;
    else
      EXPECT_LT(own, 100) << level;
  }
}

/// Words of code of one function in our object.
unsigned words_of(const fs::path& source, const std::string& function, const std::string& level) {
  const std::string root = TWINPUCK_SOURCE_DIR;
  const fs::path work = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "chip_sizes";
  fs::create_directories(work);
  const auto run = cc::run_process({std::string(TWINPUCK_BUILD_DIR) + "/twinpuck-cc", "-c", level, "-include",
                                    root + "/firmware/libc/include/xc16_builtins.h", source.string(),
                                    "-I" + root + "/firmware/include", "-I" + root + "/firmware/libc/include",
                                    "-o", (work / "x.o").string()});
  EXPECT_EQ(run.status, 0) << run.output;
  const auto sections = cc::run_process({"readelf", "-SW", (work / "x.o").string()});
  std::istringstream lines(sections.output);
  for (std::string line; std::getline(lines, line);) {
    // ...] .text._function PROGBITS address offset size
    const auto at = line.find(" .text._" + function + " ");
    if (at == std::string::npos) continue;
    std::istringstream words(line.substr(at));
    std::string name, type, address, offset, size;
    words >> name >> type >> address >> offset >> size;
    return unsigned(std::stoul(size, nullptr, 16) / 4);
  }
  return 0;
}

TEST(ChipPrograms, public_functions_are_hardly_larger_than_xc16s) {
  constexpr double kMost = 1.1;
  double sum = 0;
  int count = 0;
  for (const auto& row : rows_of(kCycles / "cycles.csv")) {
    if (row.at("role") != "primary" || row.at("opt") != "-Os") continue;
    const unsigned ours = words_of(kCycles / "src" / row.at("file"), row.at("function"), "-Os");
    ASSERT_GT(ours, 0u) << row.at("file");
    sum += std::log(ours / std::stod(row.at("code_words")));
    ++count;
  }
  EXPECT_EQ(count, 71);
  EXPECT_LT(std::exp(sum / count), kMost);
  std::printf("words over XC16's at -Os, geometric mean of %d: %.3f\n", count, std::exp(sum / count));
}

TEST(ChipPrograms, public_functions_are_right_at_the_other_levels) {
  // one level each, in turns; docs/dev/chip.md sums them up
  const char* const levels[] = {"-O0", "-Os", "-O2"};
  int n = 0;
  for (const auto& row : rows_of(kCycles / "results.csv")) {
    const std::string level = levels[n++ % 3];
    ChipProgram program(row.at("file"), cc::bytes_of(kCycles / "src" / row.at("file")), level);
    ASSERT_TRUE(program.is_whole()) << row.at("file") << level << ": " << program.error();
    EXPECT_EQ(program.run(), std::stoul(row.at("result_hex"), nullptr, 16)) << row.at("file") << level;
  }
}

TEST(ChipPrograms, loads_and_stores_work_at_every_offset_of_every_type_and_base) {
  // offsets around what [W+lit] reaches: 511 and 512 bytes, 1022 and 1024; by pointer, array, member and
  // index
  std::ostringstream source;
  source << "struct s { char gap[1300]; };\nstatic char memory[1400], local_sum;\n"
            "#define MEMORY(t, k) (*(t *)(memory + (k)))\n";
  int n = 0;
  std::uint32_t expected = 0;
  std::ostringstream calls;
  for (const char* type : {"signed char", "unsigned char", "int", "long", "long long", "float"})
    for (const int offset : {0, 2, 30, 62, 64, 510, 512, 514, 1020, 1022, 1024, 1026, 1200}) {
      const int value = n % 100 + 1;
      source << "__attribute__((noinline)) void store" << n << "(" << type << " *p, " << type << " v) { *("
             << type << " *)((char *)p + " << offset << ") = v; }\n"
             << "__attribute__((noinline)) " << type << " load" << n << "(" << type << " *p) { return *("
             << type << " *)((char *)p + " << offset << "); }\n"
             << "__attribute__((noinline)) " << type << " indexed" << n << "(char *p, int i) { return *("
             << type << " *)(p + i); }\n"
             << "__attribute__((noinline)) " << type << " fixed" << n << "(void) { return MEMORY(" << type
             << ", " << offset << "); }\n";
      if (offset <= 600)
        source << "__attribute__((noinline)) " << type << " stacked" << n << "(" << type
               << " v) { volatile char frame[620]; *(volatile " << type << " *)(frame + " << offset
               << ") = v; return *(volatile " << type << " *)(frame + " << offset << "); }\n";
      calls << "  store" << n << "((" << type << " *)memory, " << value << ");\n  sum = sum * 31 + (long)load"
            << n << "((" << type << " *)memory) + (long)indexed" << n << "(memory, " << offset
            << ") * 2 + (long)fixed" << n << "() * 3";
      std::uint32_t each = value * 6u;
      if (offset <= 600) {
        calls << " + (long)stacked" << n << "(" << value << ") * 4";
        each += value * 4u;
      }
      calls << ";\n";
      expected = expected * 31 + each;
      ++n;
    }
  source << "long bench_run(void) {\n  unsigned long sum = 0;\n" << calls.str() << "  return sum;\n}\n";
  for (const char* level : {"-O0", "-O1", "-Os"}) {
    ChipProgram program("offsets", source.str(), level);
    ASSERT_TRUE(program.is_whole()) << level << program.error();
    EXPECT_EQ(program.run(), expected) << level;
  }
}

// TWINPUCK_RANDOM_PROGRAMS="200000 100000" tries so many, from that seed on
TEST(ChipPrograms, random_programs_agree_with_the_pc) {
  constexpr int kTogether = 50;
  int first = 1, count = kTogether;
  if (const char* wish = std::getenv("TWINPUCK_RANDOM_PROGRAMS")) {
    ASSERT_EQ(std::sscanf(wish, "%d %d", &first, &count), 2) << wish;
  }
  for (int seed = first; seed < first + count; seed += kTogether) {
    // from a file beside it: what a build looks for in a program's own text takes longer than to compile this
    const fs::path file =
        fs::temp_directory_path() / ("twinpuck-random-" + std::to_string(getpid()) + ".inc");
    std::ofstream(file) << random_programs(seed, kTogether);
    const std::string source = "#include \"" + file.string() + "\"\n";
    const std::uint32_t expected = result_on_pc(source);
    for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
      ChipProgram program("random" + std::to_string(seed), source, level);
      ASSERT_TRUE(program.is_whole()) << seed << level << program.error();
      if (program.run() == expected) continue;
      for (int one = seed; one < seed + kTogether; ++one) {
        const std::string alone = random_program(one);
        ChipProgram wrong("random" + std::to_string(one), alone, level);
        ASSERT_TRUE(wrong.is_whole()) << one << level << wrong.error();
        EXPECT_EQ(wrong.run(), result_on_pc(alone)) << "seed " << one << " " << level;
      }
      ADD_FAILURE() << "seeds from " << seed << " on, " << level;
    }
    fs::remove(file);
    if (count > kTogether) std::fprintf(stderr, "\r%d", seed + kTogether - first);
  }
}

// SUB, SUBB and BRA NZ, 4 cycles: XC16 keeps empty loops at -O0 and -O1, and this is its loop of a long
// there; up to a variable, and for while (n--), it compares in 2 more (delay_test.cpp). Before it cp, cpb,
// bra (3) or two mov; the last BRA takes 1, RETURN 3.
TEST(ChipPrograms, long_counts_in_as_many_cycles_as_xc16_s) {
  const std::string count = "__attribute__((noinline)) ";
  struct Wait {
    const char* text;
    unsigned cycles;  // of 1,000 rounds
  };
  for (const Wait& wait :
       {Wait{"void wait(long n) { long l; for (l = 0; l < 1000; l++) ; }", 2 + 3999 + 3},
        {"void wait(long n) { long l; for (l = 0; l < n; l++) ; }", 3 + 5999 + 3},
        {"void wait(unsigned long n) { while (n--) ; }", 3 + 5999 + 3},
        {"void wait(long n) { long l; for (l = n; l > 0; l--) ; }", 3 + 3999 + 3},
        {"void wait(long n) { long l; for (l = 0; l < n; l++) __asm__ volatile(\"nop\"); }", 3 + 6999 + 3}}) {
    ChipProgram program("wait", count + wait.text + "\nvolatile long rounds = 1000;\n" +
                                    "long bench_run(void) { wait(rounds); return 1; }");
    ASSERT_TRUE(program.is_whole()) << program.error();
    dspic::Cycle own = 0;
    EXPECT_EQ(program.run_counting("wait", own), 1u);
    EXPECT_EQ(own, wait.cycles) << wait.text;
  }
}

// The same counter where there is work, whose index becomes a pointer. A round: mov, add, addc, add #4, sub,
// subb, bra (2).
TEST(ChipPrograms, long_counter_of_an_array_is_a_pointer) {
  const std::string source = R"(
long v[300], n = 300;
__attribute__((noinline)) long sum(long *p, long n) { long s = 0, i; for (i = 0; i < n; i++) s += p[i]; return s; }
__attribute__((noinline)) long last(long *p, long n) { long i; for (i = n - 1; i >= 0; i--) if (p[i] == 7) return i; return -1; }
__attribute__((noinline)) long read(long n) { long i, s = 0; for (i = 1; i < n; i += 3) s++; return i * 1000 + s; }
long bench_run(void) {
  long i;
  for (i = 0; i < n; i++) v[i] = i;
  if (sum(v, n) != 44850 || sum(v, 0) != 0 || sum(v, -5) != 0) return 1;
  if (last(v, n) != 7 || last(v, 7) != -1 || last(v, 0) != -1) return 2;
  if (read(10) != 10003 || read(11) != 13004 || read(-1) != 1000) return 3;
  return 0;
})";
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) {
    ChipProgram program("longs", source, level);
    ASSERT_TRUE(program.is_whole()) << program.error();
    dspic::Cycle own = 0;
    EXPECT_EQ(program.run_counting("sum", own), 0u) << level;
    if (level == std::string("-O1")) {
      EXPECT_EQ(own, 6 + 300 * 8 - 1 + 3 + 2 * (6 + 1 + 3));  // twice without a round: a BRA taken
    }
  }
}

// BSET of a word keeps its lowest bit for the number of the bit: an odd address would be another word's
TEST(ChipPrograms, bit_of_a_word_at_an_odd_address_is_refused) {
  const std::string head =
      "volatile int v[2] __attribute__((near)) = {0, 0};\nlong bench_run(void) { __asm__ volatile(\"";
  ChipProgram even(
      "bits", head + "bset _v, #9\\n bset _v+2, #1\\n bset.b _v+3, #7\"); return v[0] | (long)v[1] << 16; }");
  ASSERT_TRUE(even.is_whole()) << even.error();
  EXPECT_EQ(even.run(), 0x80020200u);
  for (const auto& [odd, address] :
       {std::pair("bset _v+1, #9", "801"), {"btg _v+1, #2", "801"}, {"bclr _v+3, #15", "803"}}) {
    ChipProgram refused("bits", head + odd + "\"); return 0; }");
    EXPECT_EQ(refused.error(), std::string("main.c:3: error: v: got address 0x") + address +
                                   ", expected even and below 0x2000: a near variable\n");
  }
}

// clang takes a section that it knows nothing of for one that cannot be written: stores were left out
TEST(ChipPrograms, variables_with_a_place_and_a_value_are_written) {
  for (const char* place :
       {"near", "far", "address(0x1200)", "space(xmemory)", "space(ymemory)", "space(data)"})
    for (const char* level : {"-O0", "-O1", "-Os"}) {
      ChipProgram program("placed", "int __attribute__((" + std::string(place) + R"()) counted = 3;
static void __attribute__((noinline)) count(void) { counted++; }
long bench_run(void) { count(); return counted; })",
                          level);
      ASSERT_TRUE(program.is_whole()) << place << program.error();
      EXPECT_EQ(program.run(), 4u) << place << " " << level;
      EXPECT_EQ(program.peek(program.address_of("counted"), 2), 4u) << place << " " << level;
    }
}

// A copy stood between the two moves that reloaded a pair of registers, and read half of the pair.
TEST(ChipPrograms, spilled_pair_comes_back_whole) {
  for (const int seed : {100044, 203087, 204600, 204999}) {
    const std::string source = random_program(seed);
    ChipProgram program("pair" + std::to_string(seed), source, "-O1");
    ASSERT_TRUE(program.is_whole()) << seed << program.error();
    EXPECT_EQ(program.run(), result_on_pc(source)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace chip_cc
