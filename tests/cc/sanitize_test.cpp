// SPDX-License-Identifier: MIT
// --sanitize and --coverage, as a user sees them.
#include <gtest/gtest.h>

#include "fake_host.h"

using namespace fake;

namespace {
Run sanitized(const std::string& text, const std::string& level = "-O1") {
  Folder folder;
  auto built = build(folder, text, level, [](cc::BuildOptions& o) { o.sanitize = true; });
  EXPECT_TRUE(built.ok) << text_of(built);
  Image image(folder.path / "prog.so");
  EXPECT_EQ(image.error, "");
  if (!image.error.empty()) return Run();
  return image.run();
}
}  // namespace

TEST(sanitize, a_clean_program_runs_clean) {
  auto run = sanitized(
      "#include <stdlib.h>\n#include <string.h>\nstruct s { char n[8]; int v; } all[4]; int sum(int *p, int "
      "n) { int s = 0; while (n--) s += *p++; return s; }\n"
      "int main(void) { int k[5], i; char *h = malloc(20); struct s one; for (i = 0; i < 5; i++) k[i] = i; "
      "strcpy(all[2].n, \"abc\"); one = all[2];\n"
      "strcpy(h, one.n); all[3].v = sum(k, 5); i = h[0] + all[3].v; free(h); return i; }");
  EXPECT_EQ(run.end, "return") << run.message;
}

TEST(sanitize, each_bad_access_names_line_and_kind) {
  const char* const kCases[][2] = {
      {"int a[4], n; int sum(int *p, int n) {\n int s = 0; while (n--)\n s += *p++; return s; }\nint "
       "main(void) { return sum(a, 5); }",
       "read out of bounds of a"},
      {"int s[3]; void fill(int *p, int n) {\n while (n--)\n p[n] = 1; }\nint main(void) { int k[3]; fill(k, "
       "4); return k[0] + s[0]; }",
       "out of bounds of a local"},
      {"#include <stdlib.h>\n char *volatile p; int main(void) { p = malloc(4); free(p);\n return *p; }",
       "freed heap"},
      {"#include <stdlib.h>\n char *volatile p; int main(void) { p = malloc(4); \n return p[4]; }",
       "bounds of a heap block"},
      {"int *volatile p;\n int main(void) {\n return *p; }", "null pointer"},
      {"int *volatile p = (int *)0x7000000;\n int main(void) {\n *p = 3; return 0; }", "wild pointer"},
      {"volatile int big = 32767;\n int main(void) {\n return big + 1; }", "overflow in an addition"},
      {"volatile int big = 300;\n int main(void) {\n return big * big; }", "overflow in a multiplication"},
      {"volatile int n = 16;\n int main(void) {\n return 1 << n; }", "shift by more"},
      {"int t[4]; volatile int n = 4;\n int main(void) {\n return t[n]; }", "out of bounds"}};
  for (const auto& c : kCases)
    for (const char* level : {"-O0", "-O1"}) {
      auto run = sanitized(c[0], level);
      EXPECT_EQ(run.end, "trap 7") << c[1] << " " << level;
      EXPECT_NE(run.message.find(c[1]), std::string::npos) << run.message;
      EXPECT_NE(run.message.find("main.c:3"), std::string::npos) << run.message;
    }
}

TEST(coverage, lines_are_counted) {
  Folder folder;
  auto built = build(folder,
                     "volatile int n = 5, s;\nint main(void) {\n  int i;\n  for (i = 0; i < n; i++)\n    s "
                     "+= i;\n  if (s > 1000)\n    s = 0;\n  return 0; }",
                     "-O0", [](cc::BuildOptions& o) { o.coverage = true; });
  ASSERT_TRUE(built.ok) << text_of(built);
  Image image(folder.path / "prog.so");
  ASSERT_EQ(image.error, "");
  EXPECT_STREQ(image->flags, "coverage");
  image.run();
  long long at5 = -1, at7 = -1;
  for (const auto* c = image->coverage; c != image->coverage_end; ++c) {
    if (c->line == 5) at5 = *c->count;
    if (c->line == 7) at7 = *c->count;
  }
  EXPECT_EQ(at5, 5);
  EXPECT_EQ(at7, 0);
}
