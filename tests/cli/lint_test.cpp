// SPDX-License-Identifier: MIT
// What `lint` prints of plain variables that a handler writes: where, which, and what XC16 would do; and of
// which variables it says nothing.
#include <sstream>
#include <vector>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::twinpuck;

// three lines before the program's own
const std::string kHandler = R"(#include <p30F6014A.h>
void work(void);
void __attribute__((interrupt, auto_psv)) _T4Interrupt(void) { IFS1bits.T4IF = 0; work(); }
)";
constexpr const char* kWritten =
    "written by _T4Interrupt(); got a plain variable, expected volatile; XC16 may read it once at -O1 and "
    "wait for "
    "ever";

struct Told {
  const char *place, *variable, *text;  // "main.c:7"; the sentence above
};

struct Case {
  const char *name, *program;  // behind kHandler
  std::vector<Told> told;      // all lines, in their order
  const char *other = "", *file = "work.c";
};

const Case kCases[] = {
    {"a plain flag",
     "int flag;\nvoid work(void) { flag = 1; }\nint main(void) {\n  while (!flag);\n  while (1);\n}\n",
     {{"main.c:7", "flag", kWritten}}},
    {"a flag that is set first",
     "int flag;\nvoid work(void) { flag = 0; }\nint main(void) {\n  flag = 1;\n  while (flag);\n  while "
     "(1);\n}\n",
     {{"main.c:8", "flag", kWritten}}},
    {"a member that is set first",
     "struct { int a, b; } s;\nvoid work(void) { s.a = 0; }\nint main(void) {\n  s.a = 1;\n  while (s.a);\n  "
     "while "
     "(1);\n}\n",
     {{"main.c:8", "s", kWritten}}},
    {"an element",
     "int a[4], n = 2;\nvoid work(void) { a[n] = 7; }\nint main(void) {\n  while (a[2] != 7);\n  while "
     "(1);\n}\n",
     {{"main.c:7", "a", kWritten}}},
    {"a static of a function, by a pointer",
     "static int *at;\nvoid work(void) { if (at) *at = 1; }\nint main(void) {\n  static int flag;\n  at = "
     "&flag;\n  "
     "while (!flag);\n  while (1);\n}\n",
     {{"main.c:9", "flag", kWritten}}},
    {"two statics of one name",
     "static int *p, *q;\nvoid work(void) { if (p) *p = 1; if (q) *q = 1; }\nint main(void) {\n"
     "  { static int flag; p = &flag; flag = 0; while (!flag); }\n"
     "  { static int flag; q = &flag; flag = 0; while (!flag); }\n  while (1);\n}\n",
     {{"main.c:7", "flag", kWritten}, {"main.c:8", "flag", kWritten}}},
    {"written through a parameter",
     "int flag;\nvoid set(int *p) { *p = 1; }\nvoid work(void) { set(&flag); }\nint main(void) {\n  while "
     "(!flag);\n  "
     "while (1);\n}\n",
     {{"main.c:8", "flag", kWritten}}},
    {"with a limit",
     "int m;\nvoid work(void) { m = 1; }\nint main(void) {\n  long i;\n  for (i = 100000; i; i--)\n    if "
     "(m) break;\n  "
     "while (1);\n}\n",
     {{"main.c:9", "m", kWritten}}},
    {"do while",
     "int m;\nvoid work(void) { m++; }\nint main(void) {\n  int k;\n  do {\n    k = m;\n  } while (k < 2);\n "
     " while "
     "(1);\n}\n",
     {{"main.c:9", "m", kWritten}}},
    {"two variables",
     "int a, b;\nvoid work(void) { a = b = 1; }\nint main(void) {\n  while (!a);\n  while (!b);\n  while "
     "(1);\n}\n",
     {{"main.c:7", "a", kWritten}, {"main.c:8", "b", kWritten}}},
    {"not seen: with a call that changes nothing",
     "int flag;\nvoid again(void) { }\nvoid work(void) { flag = 1; }\nint main(void) {\n  while (!flag) "
     "again();\n  "
     "while (1);\n}\n",
     {}},
    {"written in another file",
     "extern int flag;\nint main(void) {\n  while (!flag);\n  while (1);\n}\n",
     {{"main.c:6", "flag", kWritten}},
     "int flag;\nvoid work(void) { flag = 1; }\n"},
    {"set first, written in another file",
     "extern int flag;\nint main(void) {\n  flag = 1;\n  while (flag);\n  while (1);\n}\n",
     {{"main.c:7", "flag", kWritten}},
     "int flag;\nvoid work(void) { flag = 0; }\n"},
    {"read in another file",
     "int flag;\nvoid wait(void);\nvoid work(void) { flag = 0; }\nint main(void) {\n  wait();\n  while "
     "(1);\n}\n",
     {{"work.c:4", "flag", kWritten}},
     "extern int flag;\nvoid wait(void) {\n  flag = 1;\n  while (flag);\n}\n"},
    {"by a pointer that another file keeps",
     "int flag;\nvoid keep(int *);\nint main(void) {\n  keep(&flag);\n  flag = 0;\n  while (!flag);\n  while "
     "(1);\n}\n",
     {{"main.c:9", "flag", kWritten}},
     "static int *kept;\nvoid keep(int *p) { kept = p; }\nvoid work(void) { if (kept) *kept = 1; }\n"},
    {"also where the project says -O0",
     "int flag;\nvoid work(void) { flag = 1; }\nint main(void) {\n  while (!flag);\n  while (1);\n}\n",
     {{"main.c:7", "flag", kWritten}},
     "CFLAGS = -O0\n",
     "Makefile"},
    {"volatile needs no word",
     "volatile int flag;\nvoid work(void) { flag = 1; }\nint main(void) {\n  while (!flag);\n  while "
     "(1);\n}\n",
     {}},
    {"nor does what a call of another file may change",
     "int flag;\nvoid again(void);\nvoid work(void) { flag = 1; }\nint main(void) {\n  while (!flag) "
     "again();\n  while "
     "(1);\n}\n",
     {},
     "void again(void) { }\n"},
    {"nor what only the handler reads",
     "int n;\nvoid work(void) { n = 3; while (n) n--; }\nint main(void) {\n  while (1);\n}\n",
     {}},
    {"nor what only main() writes",
     "int n;\nvoid work(void) { }\nint main(void) {\n  n = 3;\n  while (n) n--;\n  while (1);\n}\n",
     {}},
    {"nor what is read once",
     "int n, k;\nvoid work(void) { n++; }\nint main(void) {\n  k = n;\n  while (1);\n}\n",
     {}},
};

class Lint : public CommandTest {};

TEST_F(Lint, names_each_plain_variable_that_a_handler_writes_and_what_xc16_does) {
  for (const Case& c : kCases) {
    SCOPED_TRACE(c.name);
    std::filesystem::remove_all(folder / "p");
    write("p/main.c", kHandler + c.program);
    if (*c.other) write("p/" + std::string(c.file), c.other);
    const auto said = twinpuck("lint " + path("p"));
    EXPECT_EQ(said.exit_code, c.told.empty() ? 0 : 1) << said.text;
    std::vector<std::string> lines;
    std::istringstream text(said.text);
    for (std::string line; std::getline(text, line);)
      if (!line.empty() && line.find("nothing to complain about") == std::string::npos) lines.push_back(line);
    ASSERT_EQ(lines.size(), c.told.size()) << said.text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Told& t = c.told[i];
      const std::string wanted = "/p/" + std::string(t.place) + ": warning: " + t.variable + ": " + t.text;
      EXPECT_EQ(lines[i].substr(lines[i].size() - std::min(lines[i].size(), wanted.size())), wanted)
          << lines[i];
    }
  }
}

}  // namespace
