// SPDX-License-Identifier: MIT
#include "tests/chip_cc/abi_program.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

#include "compiler/cache/child_process.h"
#include "compiler/cache/object_cache.h"

namespace chip_cc {
namespace {

namespace fs = std::filesystem;

/// What is set and read on its own: SET_k() and GET_k() of kHead know the kinds.
struct Leaf {
  std::string path;
  char kind = 'i';  // i: integer, w: int, q: 64 bits, f: float, p: pointer, n: pointer to a function
};

struct Shape {
  std::string keyword = "struct", members;  // in C
  std::vector<Leaf> leaves;                 // together they are the whole value
  std::vector<Leaf> views;                  // read only: the same bytes by another member of a union
  bool is_size_fixed = false;               // no compiler pads it
};

constexpr int kLargest = 20;  // bytes

constexpr const char* kHead = R"(
#include <stdarg.h>
#ifdef __C30__
typedef signed char i8; typedef int i16; typedef long i32; typedef long long i64;
typedef unsigned char u8; typedef unsigned u16; typedef unsigned long u32; typedef unsigned long long u64;
#else
#include <stdint.h>
typedef int8_t i8; typedef int16_t i16; typedef int32_t i32; typedef int64_t i64;
typedef uint8_t u8; typedef uint16_t u16; typedef uint32_t u32; typedef uint64_t u64;
#endif
#define ALONE __attribute__((noinline))
typedef u16 (*Fn)(u16);
ALONE u16 mix(u16 h, u16 v) { return (u16)(h * 31u + v); }
u32 all = 1;
ALONE void add(u16 v) { all = all * 33u + v; }
volatile u16 one = 1;
const u8 bytes[16] = {3, 1, 4, 1, 5, 9, 2, 6, 5, 3, 5, 8, 9, 7, 9, 3};
ALONE u16 fn_0(u16 v) { return (u16)(v + 1); }
ALONE u16 fn_1(u16 v) { return (u16)(v * 3u); }
ALONE u16 fn_2(u16 v) { return (u16)~v; }
ALONE u16 fn_3(u16 v) { return mix(v, 9); }
Fn const fns[4] = {fn_0, fn_1, fn_2, fn_3};
#define MAKE_i(v) ((u32)(u16)(v) * 2654435761ul)
#define MAKE_w(v) ((i16)MAKE_i(v))
#define MAKE_q(v) ((u64)(u16)(v) * 0x9E3779B97F4A7C15ull)
#define MAKE_f(v) ((float)(i16)((v) & 1023) / 4)
#define MAKE_p(v) (bytes + ((v) & 15))
#define MAKE_n(v) (fns[(v) & 3])
#define GET_i(x) ((u16)((u32)(x) ^ (u32)(x) >> 16))
#define GET_w(x) ((u16)(x))
#define GET_q(x) GET_i((u32)(x) ^ (u32)((u64)(x) >> 32))
#define GET_f(x) ((u16)(i16)((x) * 4))
#define GET_p(x) ((u16)*(x))
#define GET_n(x) ((x)(5))
)";

std::string text_of(int n) { return std::to_string(n); }

Shape chars(int bytes) {
  Shape s;
  s.is_size_fixed = true;
  if (bytes) s.members = "u8 c[" + text_of(bytes) + "];";
  for (int i = 0; i < bytes; ++i) s.leaves.push_back({"c[" + text_of(i) + "]"});
  return s;
}

/// Members of these sizes in turn: 4 is a long, -4 a float.
Shape members(int bytes, const std::vector<int>& sizes) {
  Shape s;
  s.is_size_fixed = sizes.size() == 1 && bytes % sizes[0] == 0;
  for (int i = 0, left = bytes; left > 0; ++i) {
    int size = sizes[std::size_t(i) % sizes.size()];
    while (std::abs(size) > left) size = std::abs(size) / 2;
    const std::string name = "m" + text_of(i);
    s.members += (size == 1    ? "u8 "
                  : size == 2  ? "i16 "
                  : size == 4  ? "u32 "
                  : size == -4 ? "float "
                               : "i64 ") +
                 name + "; ";
    s.leaves.push_back({name, size == 8 ? 'q' : size == -4 ? 'f' : 'i'});
    left -= std::abs(size);
  }
  return s;
}

Shape within(const std::string& path, Shape inner) {
  for (auto* list : {&inner.leaves, &inner.views})
    for (Leaf& leaf : *list) leaf.path = path + "." + leaf.path;
  inner.members = inner.keyword + " { " + inner.members + " } " + path + ";";
  inner.keyword = "struct";
  return inner;
}

Shape joined(Shape a, const Shape& b) {
  a.members += " " + b.members;
  a.leaves.insert(a.leaves.end(), b.leaves.begin(), b.leaves.end());
  a.views.insert(a.views.end(), b.views.begin(), b.views.end());
  a.is_size_fixed = a.is_size_fixed && b.is_size_fixed;
  return a;
}

Shape one_char(const std::string& name) {
  Shape s;
  s.members = "u8 " + name + ";";
  s.leaves = {{name}};
  s.is_size_fixed = true;
  return s;
}

Shape nested(int bytes) {
  if (!bytes) return within("in", {});
  return joined(one_char("k"), within("in", chars(bytes - 1)));
}

/// A struct within a struct within one, with a char before each.
Shape deeply_nested(int bytes) {
  if (bytes < 3) return nested(bytes);
  return joined(one_char("k"), within("in", joined(one_char("k"), within("in", members(bytes - 2, {2, 1})))));
}

/// An array of structs of three bytes, and the rest.
Shape of_odd_elements(int bytes) {
  Shape made = chars(bytes % 3);
  if (bytes >= 3) made.members += "struct { u8 b[3]; } a[" + text_of(bytes / 3) + "];";
  for (int i = 0; i < bytes / 3 * 3; ++i)
    made.leaves.push_back({"a[" + text_of(i / 3) + "].b[" + text_of(i % 3) + "]"});
  return made;
}

/// An array of two dimensions, one of longs, and the rest in chars.
Shape of_arrays(int bytes) {
  const int longs = bytes / 8, left = bytes - longs * 4, pairs = left / 2;
  Shape made = chars(left % 2);
  made.is_size_fixed = false;
  if (pairs) made.members += " i8 p[" + text_of(pairs) + "][2];";
  for (int i = 0; i < pairs * 2; ++i)
    made.leaves.push_back({"p[" + text_of(i / 2) + "][" + text_of(i % 2) + "]"});
  if (longs) made.members += " i32 l[" + text_of(longs) + "];";
  for (int i = 0; i < longs; ++i) made.leaves.push_back({"l[" + text_of(i) + "]"});
  return made;
}

Shape union_of(int bytes) {
  Shape s = chars(bytes);
  s.keyword = "union";
  s.is_size_fixed = false;
  for (const auto& [type, name, size] : {std::tuple("u16", "w", 2), {"i32", "l", 4}, {"u64", "q", 8}})
    if (bytes >= size) {
      s.members += std::string(" ") + type + " " + name + ";";
      s.views.push_back({name, size == 8 ? 'q' : 'i'});
    }
  if (bytes >= 3) s.members += " struct { u8 x; u16 y; } in;";
  return s;
}

Shape with_union(int bytes) {
  if (bytes < 2) return chars(bytes);
  return joined(joined(one_char("k"), within("u", union_of(bytes - 2))), one_char("z"));
}

/// Fields of odd widths, so many that `bytes` are full.
Shape bit_fields(int bytes) {
  struct Field {
    const char* type;
    int bits;
  };
  constexpr Field kFields[] = {{"u16", 3}, {"i16", 5}, {"u16", 9},  {"u16", 16}, {"u32", 20},
                               {"u8", 1},  {"i32", 7}, {"u16", 11}, {"i16", 1},  {"u32", 30}};
  Shape s;
  int bits = 0;
  for (int i = 0; bits < bytes * 8; ++i) {
    const Field& f = kFields[(i + bytes) % 10];
    const int width = std::min(f.bits, bytes * 8 - bits);
    const std::string name = "f" + text_of(i);
    s.members += std::string(f.type) + " " + name + " : " + text_of(width) + "; ";
    s.leaves.push_back({name});
    bits += width;
  }
  return s;
}

/// Pointers and pointers to functions, two bytes each on the chip.
Shape pointers(int bytes) {
  Shape s = chars(bytes % 2);
  s.is_size_fixed = false;
  for (int i = 0; i < bytes / 2; ++i) {
    const std::string name = "p" + text_of(i);
    s.members += (i % 2 ? " Fn " : " const u8 *") + name + ";";
    s.leaves.push_back({name, i % 2 ? 'n' : 'p'});
  }
  return s;
}

std::string get(const std::string& value, const Leaf& leaf) {
  return std::string("GET_") + leaf.kind + "(" + value + (leaf.path.empty() ? "" : "." + leaf.path) + ")";
}

/// h takes in the whole value.
std::string sum_of(const std::string& value, const Shape& shape) {
  std::string text;
  for (const auto* list : {&shape.leaves, &shape.views})
    for (const Leaf& leaf : *list) text += "h = mix(h, " + get(value, leaf) + "); ";
  return text;
}

/// The whole value is made of the number `seed`.
std::string made_of(const std::string& value, const Shape& shape, const std::string& seed) {
  std::string text;
  int i = 0;
  for (const Leaf& leaf : shape.leaves)
    text +=
        value + "." + leaf.path + " = MAKE_" + leaf.kind + "(" + seed + " * 7 + " + text_of(13 * ++i) + "); ";
  return text;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// All that is done with one shape, as run_part_N(); names end with _N.
std::string part_of_shape(int number, const Shape& shape) {
  std::string text = R"(
typedef KIND { MEMBERS } S_N;
struct W_N { u8 odd; S_N s; S_N more[2]; u8 end; } w_N;
ALONE void set_N(S_N *p, u16 seed) { SET }
ALONE u16 two_N(S_N t, S_N s) { u16 h = 5; SUM s = t; SUM return h; }
ALONE u16 behind_N(u8 a, u32 b, S_N s, u8 z) { u16 h = mix(a, (u16)b); SUM return mix(h, z); }
ALONE u16 far_N(u32 a, u64 b, float c, S_N s, u16 z) {
  u16 h = mix((u16)a, (u16)(b + (u16)c)); SUM return mix(h, z); }
ALONE u16 list_N(int n, ...) {
  u16 h = 7; va_list ap;
  va_start(ap, n);
  while (n--) { S_N s = va_arg(ap, S_N); SUM h = mix(h, (u16)va_arg(ap, int)); }
  va_end(ap);
  return h;
}
ALONE u16 mixed_N(const char *kinds, ...) {
  u16 h = 9; va_list ap, again;
  va_start(ap, kinds);
  va_copy(again, ap);
  for (; *kinds; kinds++)
    switch (*kinds) {
      case 'i': h = mix(h, (u16)va_arg(ap, int)); break;
      case 'l': { u32 l = va_arg(ap, u32); h = mix(h, GET_i(l)); break; }
      case 'q': { u64 q = va_arg(ap, u64); h = mix(h, GET_q(q)); break; }
      case 'd': h = mix(h, GET_f(va_arg(ap, double))); break;
      case 'p': h = mix(h, *va_arg(ap, const u8 *)); break;
      case 'n': h = mix(h, va_arg(ap, Fn)(h)); break;
      case 's': { S_N s = va_arg(ap, S_N); SUM break; }
    }
  va_end(ap);
  h = mix(h, (u16)va_arg(again, int));
  va_end(again);
  return h;
}
ALONE S_N give_N(const S_N *p) { return *p; }
ALONE S_N pass_N(S_N s) { return s; }
ALONE S_N late_N(u16 a, u32 b, u16 c, S_N s, u16 d) { if (a + b + c == d) return s; return w_N.s; }
ALONE u16 first_N(S_N s, u16 z) { u16 h = 3; SUM return mix(h, z); }
ALONE u16 own_N(S_N s) { S_N *p = &s; set_N(p, 50); return first_N(*p, 1); }
S_N (*volatile by_N)(S_N) = pass_N;
u16 (*const table_N[2])(S_N, u16) = {first_N, first_N};
AFTER
ALONE void work_N(S_N *p) {
  set_N(&w_N.s, 1); set_N(&w_N.more[0], 2); set_N(&w_N.more[1], 3);
  w_N.odd = 17; w_N.end = 19;
  add(first_N(w_N.s, 7)); add(first_N(*p, 8)); add(first_N(p[1], 9));
  add(behind_N(1, 2, w_N.more[1], 3)); add(far_N(1, 2, 3, w_N.more[0], 4)); add(two_N(w_N.s, w_N.more[0]));
  add(list_N(2, w_N.s, 5, p[1], 6)); add(list_N(3, *p, 1, w_N.more[1], 2, w_N.s, 3));
  add(mixed_N("isldsqs", 5, w_N.s, (u32)70000, 2.5, p[1], (u64)1 << 40, *p));
  add(mixed_N("idpsnli", 6, 7.25, bytes + 4, *p, fn_1, (u32)1 << 30, 3));
  add(first_N(give_N(p + 1), 1)); add(first_N(pass_N(w_N.s), 2)); add(own_N(w_N.s)); add(first_N(w_N.s, 7));
  add(first_N(late_N(1, 2, 3, *p, 6), 1)); add(first_N(by_N(p[1]), 2)); add(table_N[one](w_N.s, 4));
  w_N.more[0] = w_N.s; p[1] = pass_N(*p);
  { S_N local = p[1]; add(first_N(local, 1)); add(list_N(1, local, 2)); }
  CALLS
  add(w_N.odd); add(w_N.end); SIZE
}
void run_part_N(void) { work_N(w_N.more); }
)";
  // behind 0 to 9 ints: registers run out somewhere
  std::string after, calls;
  for (int ints = 0; ints <= 9; ++ints) {
    std::string heads, values, sums;
    for (int i = 0; i < ints; ++i) {
      heads += "u16 a" + text_of(i) + ", ";
      values += text_of(100 + i) + ", ";
      sums += "h = mix(h, a" + text_of(i) + "); ";
    }
    after += "ALONE u16 after" + text_of(ints) + "_N(" + heads +
             "S_N s, u16 y, u32 z) { u16 h = " + text_of(ints) + "; " + sums +
             "SUM return mix(mix(h, y), GET_i(z)); }\n";
    calls += "add(after" + text_of(ints) + "_N(" + values + (ints % 2 ? "w_N.s" : "p[1]") + ", 8, 99999)); ";
  }
  replace_all(text, "AFTER", after);
  replace_all(text, "CALLS", calls);
  replace_all(text, "SIZE", shape.is_size_fixed ? "add(sizeof(S_N));" : "");
  replace_all(text, "KIND", shape.keyword);
  replace_all(text, "MEMBERS", shape.members);
  replace_all(text, "SUM", sum_of("s", shape));
  replace_all(text, "SET", made_of("(*p)", shape, "seed"));
  replace_all(text, "_N", "_" + text_of(number));
  return text;
}

/// Functions with arguments, results and structs by chance.
class SignatureMaker {
 public:
  explicit SignatureMaker(std::uint32_t seed) : random_(seed) {}

  std::string part(int number) {
    std::string text, body;
    const int structs = 1 + below(3), functions = 2 + below(4);
    for (int i = 0; i < structs; ++i) text += structure(i);
    for (int i = 0; i < structs; ++i) body += fill(i);
    for (int i = 0; i < functions; ++i) {
      text += function(i);
      for (int again = 0; again < 2; ++again) body += "  " + call(i, true) + "\n";
    }
    // what was given by value is as it was
    for (int i = 0; i < structs; ++i)
      for (const char* which : {"[0]", "[1]"})
        body += "  { u16 h = 1; " + sum_of(place(i) + which, shapes_[std::size_t(i)]) + "add(h); }\n";
    text += "void run_part_N(void) {\n" + body + "}\n";
    replace_all(text, "_N", "_" + text_of(number));
    return text;
  }

 private:
  struct Argument {
    std::string type;
    char kind = 'i';  // a leaf's, or 's'
    int of = 0;       // number of the struct
  };
  struct Signature {
    std::vector<Argument> arguments, behind;
    Argument result;
    bool is_variadic = false, is_static = false;
  };

  int below(int n) { return int(random_() % std::uint32_t(n)); }
  bool chance(int percent) { return below(100) < percent; }
  static std::string place(int i) { return "v" + text_of(i) + "_N.s"; }

  Shape shape() {
    using Make = Shape (*)(int);
    constexpr Make kMakes[] = {chars,    nested,     deeply_nested, of_odd_elements, of_arrays,
                               union_of, with_union, bit_fields,    pointers};
    const int bytes = below(kLargest + 1);
    if (chance(30)) {
      constexpr int kSizes[] = {1, 2, 4, -4, 8};
      std::vector<int> sizes;
      for (int i = 0, n = 1 + below(3); i < n; ++i) sizes.push_back(kSizes[below(5)]);
      return members(bytes, sizes);
    }
    const Shape made = kMakes[below(9)](bytes);
    return chance(25) ? joined(one_char("first"), within("rest", made)) : made;
  }
  std::string structure(int i) {
    shapes_.push_back(shape());
    const std::string n = text_of(i);
    return "typedef " + shapes_.back().keyword + " { " + shapes_.back().members + " } T" + n +
           "_N;\nstruct { u8 odd" + (chance(50) ? "[2]" : "") + "; T" + n + "_N s[2]; } v" + n + "_N;\n";
  }
  std::string fill(int i) {
    const Shape& s = shapes_[std::size_t(i)];
    return "  { u16 k = (u16)(one * " + text_of(20 + below(200)) + "); " + made_of(place(i) + "[0]", s, "k") +
           made_of(place(i) + "[1]", s, "(k + 9)") + "}\n";
  }

  Argument any(bool is_behind) {
    if (chance(40)) {
      const int of = below(int(shapes_.size()));
      return {"T" + text_of(of) + "_N", 's', of};
    }
    static const Argument kAll[] = {{"u8"},         {"i8"},       {"u16"},
                                    {"i16"},        {"u32"},      {"i32"},
                                    {"float", 'f'}, {"u64", 'q'}, {"const u8 *", 'p'},
                                    {"Fn", 'n'},    {"i64", 'q'}};
    static const Argument kBehind[] = {{"int", 'w'},        {"u32"},    {"double", 'f'}, {"u64", 'q'},
                                       {"const u8 *", 'p'}, {"Fn", 'n'}};
    return is_behind ? kBehind[below(6)] : kAll[below(11)];
  }
  std::string sum(const std::string& value, const Argument& a) const {
    if (a.kind == 's') return sum_of(value, shapes_[std::size_t(a.of)]);
    return "h = mix(h, " + get(value, {"", a.kind}) + "); ";
  }
  std::string value(const Argument& a, bool with_variable) {
    const std::string k = text_of(1 + below(1000)) + (with_variable && chance(60) ? " * one" : "");
    if (a.kind != 's') return "(" + a.type + ")MAKE_" + a.kind + "(" + k + ")";
    return place(a.of) + (chance(50) ? "[0]" : "[one]");
  }
  std::string function(int number) {
    Signature s;
    s.is_variadic = chance(35);
    for (int i = 0, n = below(10) + s.is_variadic; i < n; ++i) s.arguments.push_back(any(false));
    // what stands before "..." must not be promoted
    if (s.is_variadic && s.arguments.back().type != "u32") s.arguments.back() = {"u32"};
    for (int i = 0, n = below(6); s.is_variadic && i < n; ++i) s.behind.push_back(any(true));
    s.result = any(false);
    s.is_static = chance(30);
    const std::string name = "f" + text_of(number) + "_N";
    std::string head, body = "  u16 h = 1;\n";
    for (std::size_t i = 0; i < s.arguments.size(); ++i)
      head += (i ? ", " : "") + s.arguments[i].type + " a" + text_of(int(i));
    // arguments live across a call
    if (number && chance(50)) body += "  " + call(below(number), false) + "\n";
    if (s.is_variadic) {
      body += "  va_list ap; va_start(ap, a" + text_of(int(s.arguments.size()) - 1) + ");\n";
      for (const Argument& a : s.behind)
        body += "  { " + a.type + " x = va_arg(ap, " + a.type + "); " + sum("x", a) + "}\n";
      body += "  va_end(ap);\n";
    }
    for (std::size_t i = 0; i < s.arguments.size(); ++i) {
      const Argument& a = s.arguments[i];
      const std::string own = "a" + text_of(int(i));
      body += "  " + sum(own, a) + "\n";
      if (a.kind == 's' && chance(40))
        body += "  { " + made_of(own, shapes_[std::size_t(a.of)], "h") + sum(own, a) + "}\n";
    }
    if (s.result.kind == 's')
      body += "  { " + s.result.type + " r; " + made_of("r", shapes_[std::size_t(s.result.of)], "h") +
              "return r; }\n";
    else
      body += "  return (" + s.result.type + ")MAKE_" + s.result.kind + "(h);\n";
    const std::string text = std::string(s.is_static ? "static " : "") + "ALONE " + s.result.type + " " +
                             name + "(" + (head.empty() ? "void" : head + (s.is_variadic ? ", ..." : "")) +
                             ") {\n" + body + "}\n";
    std::string types;
    for (std::size_t i = 0; i < s.arguments.size(); ++i) types += (i ? ", " : "") + s.arguments[i].type;
    signatures_.push_back(s);
    return text + s.result.type + " (*volatile by" + text_of(number) + "_N)(" +
           (types.empty() ? "void" : types + (s.is_variadic ? ", ..." : "")) + ") = " + name + ";\n";
  }
  /// A block that calls f<number>, or by a pointer to it, and takes in what it returns.
  std::string call(int number, bool adds) {
    const Signature& s = signatures_[std::size_t(number)];
    std::string list;
    for (const auto* arguments : {&s.arguments, &s.behind})
      for (const Argument& a : *arguments) list += (list.empty() ? "" : ", ") + value(a, true);
    const std::string name = (chance(40) ? "by" : "f") + text_of(number) + "_N";
    return std::string("{ ") + (adds ? "u16 h = 2; " : "") + s.result.type + " r = " + name + "(" + list +
           "); " + sum("r", s.result) + (adds ? "add(h); }" : "}");
  }

  std::mt19937 random_;
  std::vector<Shape> shapes_;
  std::vector<Signature> signatures_;
};

}  // namespace

std::string AbiProgram::source() const {
  std::string text = kHead, calls;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    text += parts[i];
    calls += "run_part_" + text_of(int(i)) + "(); ";
  }
  return text + "\nlong bench_run(void) { " + calls + "return (long)all; }\n";
}

std::string AbiProgram::source_of(std::size_t part) const {
  return kHead + parts.at(part) + "\nlong bench_run(void) { run_part_" + text_of(int(part)) +
         "(); return (long)all; }\n";
}

std::vector<AbiProgram> abi_programs_by_shape() {
  using Make = Shape (*)(int);
  constexpr int kTogether = 7;  // sizes; more would not fit at -O0
  const std::pair<const char*, Make> shapes[] = {{"chars", chars},
                                                 {"chars and ints",
                                                  [](int n) {
                                                    return members(n, {1, 2});
                                                  }},
                                                 {"longs and chars",
                                                  [](int n) {
                                                    return members(n, {4, 1});
                                                  }},
                                                 {"ints", [](int n) { return members(n, {2}); }},
                                                 {"floats and chars",
                                                  [](int n) {
                                                    return members(n, {-4, 1});
                                                  }},
                                                 {"long longs and ints",
                                                  [](int n) {
                                                    return members(n, {8, 2});
                                                  }},
                                                 {"a struct within", nested},
                                                 {"structs within structs", deeply_nested},
                                                 {"an array of odd structs", of_odd_elements},
                                                 {"arrays", of_arrays},
                                                 {"unions", union_of},
                                                 {"a union within", with_union},
                                                 {"bit-fields", bit_fields},
                                                 {"pointers and functions", pointers}};
  std::vector<AbiProgram> all;
  for (const auto& [what, make] : shapes)
    for (int first = 0; first <= kLargest; first += kTogether) {
      AbiProgram& program = all.emplace_back();
      program.what = what + std::string(", ") + text_of(first) + " bytes and more";
      for (int bytes = first; bytes < first + kTogether; ++bytes) {
        program.names.push_back(what + std::string(", ") + text_of(bytes) + " bytes");
        program.parts.push_back(part_of_shape(bytes - first, make(bytes)));
      }
    }
  return all;
}

AbiProgram abi_program_by_chance(std::uint32_t first, int count) {
  AbiProgram program;
  program.what = "seeds from " + std::to_string(first) + " on";
  for (int i = 0; i < count; ++i) {
    program.names.push_back("seed " + std::to_string(first + std::uint32_t(i)));
    program.parts.push_back(SignatureMaker(first + std::uint32_t(i)).part(i));
  }
  return program;
}

std::uint32_t result_on_avr(const std::string& source, std::string& error) {
  // 128 KB of program memory: pointers to functions need no detours. The result goes out by the UART; asleep
  // without interrupts, simavr ends
  constexpr const char* kChip = "atmega1284p";
  constexpr const char* kMain = R"(
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>
static void put(char c) { while (!(UCSR0A & 1 << UDRE0)) ; UDR0 = c; }
int main(void) {
  u32 r = (u32)bench_run();
  const char *text = "result ";
  int i;
  UCSR0B = 1 << TXEN0;
  while (*text) put(*text++);
  for (i = 28; i >= 0; i -= 4) put("0123456789abcdef"[r >> i & 15]);
  put('\n'); put('\n');
  cli();
  sleep_mode();
  return 0;
}
)";
  const fs::path folder = fs::temp_directory_path() / ("twinpuck-avr-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "x.c") << source << kMain;
  const std::string image = (folder / "x.elf").string();
  const auto compiled = cc::run_process({"avr-gcc", std::string("-mmcu=") + kChip, "-w", "-std=gnu99", "-Os",
                                         "-fwrapv", (folder / "x.c").string(), "-o", image});
  const auto run = compiled.status
                       ? compiled
                       : cc::run_process({"timeout", "60", "simavr", "-m", kChip, "-f", "16000000", image});
  fs::remove_all(folder);
  const std::size_t at = run.output.find("result ");
  if (!run.status && at != std::string::npos)
    return std::uint32_t(std::stoul(run.output.substr(at + 7, 8), nullptr, 16));
  error = run.output;
  return 0xDEAD0000u;
}

}  // namespace chip_cc
