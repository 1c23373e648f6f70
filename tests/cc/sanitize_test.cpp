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

// the libc's own code is not the program's, yet what it does to the program's arrays is the program's doing
TEST(sanitize, string_functions_stay_inside_the_programs_arrays) {
  const char* const kCases[][3] = {
      {"char to[4], next[40];", "memcpy(to, next, n + 5);", "main.c:5: write out of bounds of to"},
      {"char from[4], to[40];", "memcpy(to, from, n + 5);", "main.c:5: read out of bounds of from"},
      {"char to[4];", "memset(to, 1, n + 5);", "main.c:5: write out of bounds of to"},
      {"char to[4];", "strcpy(to, \"four\" + n);", "in strcpy(): write out of bounds of to"},
      {"char to[4] = \"abc\";", "strcat(to, \"d\" + n);", "write out of bounds of to"},
      {"char to[4];", "strncpy(to, \"a\" + n, 5);", "in strncpy(): write out of bounds of to"},
      {"char no_end[4];", "memset(no_end, 1, 4); n = strlen(no_end);",
       "in strlen(): read out of bounds of no_end"},
      {"char to[4];", "sprintf(to, \"%d\", 1234 + n);", "write out of bounds of to"},
      {"char to[40], no_end[4];", "memset(no_end, 'x', 4); sprintf(to, \"%s\", no_end);",
       "read out of bounds of no_end"},
      {"char other;", "char to[4]; strcpy(to, \"four\" + n); other = to[n];",
       "in strcpy(): write out of bounds of a local variable"},
      {"char *h;", "h = malloc(8 + n); strcpy(h, \"12345678\");",
       "in strcpy(): out of the bounds of a heap block"},
      {"char t[] = \"77\"; char c[4]; int v;", "sscanf(t, \"%s\", c); strcpy(t, \"12345\" + n);",
       "in strcpy(): write out of bounds of t"}};
  for (const auto& c : kCases)
    for (const char* level : {"-O0", "-O1"}) {
      const auto run =
          sanitized(std::string("#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n") + c[0] +
                        " volatile int n;\nint main(void) { " + c[1] + " return 0; }",
                    level);
      EXPECT_EQ(run.end, "trap 7") << c[1] << " " << level;
      EXPECT_NE(run.message.find(c[2]), std::string::npos) << c[1] << ": " << run.message;
    }
}

TEST(sanitize, string_functions_that_fit_run_clean) {
  const std::string text =
      "#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\n#include <stdarg.h>\n"
      "char all[40]; volatile int n; int order(const void *a, const void *b) { return *(int *)a - *(int *)b; "
      "}\n"
      "void tell(char *to, const char *how, ...) { va_list v; va_start(v, how); vsprintf(to, how, v); "
      "va_end(v); }\n"
      "int main(void) {\n"
      "  char five[5], line[80]; int k[4] = {4, 3, 2, 1}, a, b; char *end, *heap = malloc(6);\n"
      "  memcpy(five, \"four\", 5); strcpy(heap, five); strcat(heap, \"5\"); strncpy(all, heap, sizeof "
      "all);\n"
      "  sprintf(line, \"%d %ld %f %s %c %x %d %d %d %d\", 1, 2L, 3.5, five, 'c', 255, 5, 6, 7, 8);\n"
      "  tell(all, \"%d %d %d %d %d %d %d %ld\", 1, 2, 3, 4, 5, 6, 7, 8L);\n"
      "  sscanf(\"12 34\", \"%d %d\", &a, &b); qsort(k, 4, sizeof k[0], order);\n"
      "  a += (int)strtol(\"99\", &end, 10) + atoi(five) + (int)strlen(line) + k[0];\n"
      "  memmove(all + 1, all, 39); memset(all, 0, sizeof all); snprintf(five, 5, \"%s\", line);\n"
      "  strtok(line, \" \"); strtok(0, \" \"); strstr(line, \"1\"); puts(five); printf(\"%s\", heap);\n"
      "  free(heap); return a + b; }";
  for (const char* level : {"-O0", "-O1", "-O2"}) {
    const auto run = sanitized(text, level);
    EXPECT_EQ(run.end, "return") << level << ": " << run.message;
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
