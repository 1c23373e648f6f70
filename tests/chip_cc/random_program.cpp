// SPDX-License-Identifier: MIT
#include "tests/chip_cc/random_program.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <vector>

#include "compiler/cache/object_cache.h"

namespace chip_cc {

namespace {

namespace fs = std::filesystem;

struct Type {
  const char* name;
  int bits;
};
constexpr Type kTypes[] = {{"i8", 8},   {"u8", 8},   {"i16", 16}, {"u16", 16},
                           {"i32", 32}, {"u32", 32}, {"i64", 64}, {"u64", 64}};

constexpr const char* kHead = R"(
#ifdef __TWINPUCK__
typedef signed char i8; typedef unsigned char u8; typedef int i16; typedef unsigned u16;
typedef long i32; typedef unsigned long u32; typedef long long i64; typedef unsigned long long u64;
#else
#include <stdint.h>
typedef int8_t i8; typedef uint8_t u8; typedef int16_t i16; typedef uint16_t u16;
typedef int32_t i32; typedef uint32_t u32; typedef int64_t i64; typedef uint64_t u64;
#endif
struct s { u8 a; i16 b; i8 c; i32 d; u16 e : 3; u16 f : 9; };
)";
constexpr const char* kVariables = R"(
static struct s st = {1, 2, 3, 4, 5, 6};
static volatile u16 flags;
static i16 array16[8] = {5, -3, 12000, 7, -200, 9, 31, -32768};
static u8 array8[8] = {200, 3, 45, 255, 0, 9, 128, 127};
static i32 array32[8] = {70000, -5, 3, -2000000000, 9, 0, 65536, 12};
)";

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed), wide_(seed % 5 == 0 ? 8 : 6) {}

  std::string program() {
    std::ostringstream out;
    out << kVariables;
    std::string calls;
    const int functions = 1 + below(3);
    for (int f = 0; f < functions; ++f) {
      out << function(f);
      for (int again = 0; again < 3; ++again) {
        calls += "  h = h * 31 + (u32)f" + std::to_string(f) + "(";
        for (std::size_t i = 0; i < arguments_[f].size(); ++i)
          calls += (i ? ", " : "") + constant(arguments_[f][i]);
        calls += ");\n";
      }
    }
    out << "long bench_run(void) {\n  u32 h = 7;\n  i16 i;\n"
        << calls
        << "  for (i = 0; i < 8; i++) {\n    h = h * 33 + (u32)array16[i];\n    h = h * 33 + "
           "(u32)array8[i];\n"
        << "    h = h * 33 + (u32)array32[i];\n  }\n"
        << "  return h ^ flags ^ (u32)st.b ^ (u32)st.d ^ st.e ^ (u32)st.f << 3;\n}\n";
    return out.str();
  }

 private:
  int below(int n) { return int(random_() % std::uint32_t(n)); }
  bool chance(int percent) { return below(100) < percent; }
  Type any() { return kTypes[below(wide_)]; }
  static std::string cast(Type t, const std::string& e) { return "((" + std::string(t.name) + ")" + e + ")"; }

  std::string constant(Type t) {
    static constexpr unsigned long long kTelling[] = {0,   1,   2,    3,      31,     32,    100,
                                                      255, 256, 1000, 0x7FFF, 0x8000, 0xFFFF};
    unsigned long long v = chance(70) ? kTelling[below(13)] : (unsigned long long)random_() << 32 | random_();
    if (chance(30)) v = 0 - v;
    if (t.bits < 64) v &= (1ull << t.bits) - 1;
    return cast(t, std::to_string(v) + "ULL");
  }
  std::string place() {
    const std::string index = "[(" + (names_.empty() ? "3" : names_[below(int(names_.size()))]) + ") & 7]";
    switch (below(10)) {
      case 0:
        return "array16" + index;
      case 1:
        return "array8" + index;
      case 2:
        return "array32" + index;
      case 3:
        return std::string("st.") + "abcdef"[below(6)];
      default:
        return names_.empty() ? "st.d" : names_[below(int(names_.size()))];
    }
  }
  std::string expression(int depth, Type t) {
    if (depth <= 0 || chance(12)) return chance(25) ? constant(t) : cast(t, place());
    const int kind = below(100);
    const auto part = [&](Type of) { return expression(depth - 1, of); };
    if (kind < 50)
      return cast(
          t, "(" + part(t) + " " + "+-*&|^+-"[below(8)] + " " + (chance(70) ? part(t) : constant(t)) + ")");
    if (kind < 62) {
      const int most = std::min(t.bits, 32);
      const std::string amount =
          chance(50) ? std::to_string(below(most))
                     : "(" + expression(depth - 2, kTypes[1]) + " & " + std::to_string(most - 1) + ")";
      const std::string to_unsigned = std::string("(u") + (t.name + 1) + ")";
      if (chance(50)) return cast(t, "(" + to_unsigned + part(t) + " << " + amount + ")");
      return cast(t, "(" + part(t) + " >> " + amount + ")");
    }
    if (kind < 70)
      return cast(t, "(" + part(t) + (chance(50) ? " / " : " % ") +
                         cast(t, "((" + expression(depth - 2, t) + " & 0x7F) | 1)") + ")");
    if (kind < 80) {
      static constexpr const char* kCompare[] = {"<", "<=", ">", ">=", "==", "!="};
      const Type of = any();
      return cast(
          t, "(" + part(of) + " " + kCompare[below(6)] + " " + (chance(50) ? part(of) : constant(of)) + ")");
    }
    if (kind < 90) return "(" + part(any()) + " ? " + part(t) + " : " + part(t) + ")";
    return cast(t, std::string(1, "-~!"[below(3)]) + part(t));
  }
  std::string statement(int depth) {
    const int kind = below(100);
    if (kind < 50 || depth <= 0) {
      if (chance(15)) {
        static constexpr const char* kBits[] = {"|= 0x0010", "&= ~0x0200", "^= 0x8000", "|= 1", "&= ~1"};
        return std::string("flags ") + kBits[below(5)] + ";\n";
      }
      static constexpr const char* kInto[] = {" = ", " += ", " -= ", " ^= ", " |= ", " &= "};
      return place() + kInto[chance(75) ? 0 : below(6)] + expression(3, any()) + ";\n";
    }
    if (kind < 68)
      return "if (" + expression(2, any()) + ") {\n" + block(depth - 1, 2) + "} else {\n" +
             block(depth - 1, 1) + "}\n";
    if (kind < 86) {
      const std::string k = "k" + std::to_string(loops_++);
      return "{ i16 " + k + "; for (" + k + " = 0; " + k + " < " + std::to_string(1 + below(8)) + "; " + k +
             "++) {\n" + block(depth - 1, 2) + "} }\n";
    }
    std::string text = "switch ((u8)" + expression(1, kTypes[1]) + " & 7) {\n";
    for (int i = 0, cases = 2 + below(5); i < cases; ++i)
      text += "case " + std::to_string(i) + ": " + block(0, 1) + (chance(70) ? "break;\n" : "");
    return text + "default: " + block(0, 1) + "}\n";
  }
  std::string block(int depth, int statements) {
    std::string text;
    for (int i = 0; i < statements; ++i) text += statement(depth);
    return text;
  }
  std::string function(int f) {
    auto& arguments = arguments_.emplace_back();
    names_.clear();
    std::string head, body, sum = "0";
    for (int i = 0, n = below(9); i < n; ++i) {
      arguments.push_back(any());
      names_.push_back("a" + std::to_string(i));
      head += (i ? ", " : "") + std::string(arguments.back().name) + " " + names_.back();
    }
    for (int i = 0, n = 1 + below(4); i < n; ++i) {
      const Type t = any();
      const std::string value = expression(1, t);
      names_.push_back("v" + std::to_string(i));
      body += std::string(t.name) + " " + names_.back() + " = " + value + ";\n";
    }
    body += block(2, 2 + below(4));
    for (const auto& name : names_) sum += " ^ (u32)" + name;
    const Type result = any();
    return std::string("__attribute__((noinline)) ") + result.name + " f" + std::to_string(f) + "(" +
           (head.empty() ? "void" : head) + ") {\n" + body + "return (" + result.name + ")(" + sum +
           ");\n}\n";
  }

  std::mt19937 random_;
  int wide_, loops_ = 0;
  std::vector<std::string> names_;            // of the function being made
  std::vector<std::vector<Type>> arguments_;  // of each function
};

}  // namespace

std::string random_program(std::uint32_t seed) { return kHead + Generator(seed).program(); }

std::string random_programs(std::uint32_t first, int count) {
  constexpr const char* kNames[] = {"st", "flags", "array16", "array8",   "array32",
                                    "f0", "f1",    "f2",      "bench_run"};
  std::ostringstream out;
  out << kHead;
  for (int i = 0; i < count; ++i) {
    for (const char* name : kNames) out << "#define " << name << " " << name << "_" << i << "\n";
    out << Generator(first + std::uint32_t(i)).program();
    for (const char* name : kNames) out << "#undef " << name << "\n";
  }
  out << "long bench_run(void) {\n  u32 h = 0;\n";
  for (int i = 0; i < count; ++i) out << "  h = h * 31 + (u32)bench_run_" << i << "();\n";
  out << "  return h;\n}\n";
  return out.str();
}

std::uint32_t result_on_pc(const std::string& source) {
  const fs::path folder = fs::temp_directory_path() / ("twinpuck-chip-random-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "x.c")
      << source << "#include <stdio.h>\nint main(void) { printf(\"%lx\", bench_run() & 0xFFFFFFFFL); }\n";
  const auto compiled = cc::run_process(
      {"clang-14", "-w", "-fwrapv", "-O1", (folder / "x.c").string(), "-o", (folder / "x").string()});
  const auto run = cc::run_process({(folder / "x").string()});
  fs::remove_all(folder);
  return compiled.status || run.status ? 0xDEAD0000u : std::uint32_t(std::stoul(run.output, nullptr, 16));
}

}  // namespace chip_cc
