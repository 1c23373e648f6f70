// SPDX-License-Identifier: MIT
// run --coverage: every count of these programs was made by hand.
#include <set>
#include <sstream>

#include "tests/cli/command.h"

namespace {

using cli_test::CommandTest;
using cli_test::Said;
using cli_test::twinpuck;

class Coverage : public CommandTest {
 protected:
  static constexpr const char* kProgram =
      /* 1 */
      "volatile int n, sum, kept;\n"
      /* 2 */
      "int unused(int a) {\n"
      /* 3 */
      "  return a + 1;\n"
      /* 4 */
      "}\n"
      /* 5 */
      "static int twice(int a) { return 2 * a; }\n"
      /* 6 */
      "static void loop(void) {\n"
      /* 7 */
      "  int i;\n"
      /* 8 */
      "  for (i = 0; i < 10; i++) {\n"
      /* 9 */
      "    sum += i;\n"
      /* 10 */
      "    if (i > 6)\n"
      /* 11 */
      "      kept++;\n"
      /* 12 */
      "  }\n"
      /* 13 */
      "}\n"
      /* 14 */
      "static int logic(int a, int b) {\n"
      /* 15 */
      "  if (a && b)\n"
      /* 16 */
      "    return 1;\n"
      /* 17 */
      "  return 0;\n"
      /* 18 */
      "}\n"
      /* 19 */
      "int main(void) {\n"
      /* 20 */
      "  loop();\n"
      /* 21 */
      "  n = twice(3) + logic(1, 0) + logic(1, 1) + logic(0, 1);\n"
      /* 22 */
      "  if (n == 0)\n"
      /* 23 */
      "    n = 5;\n"
      /* 24 */
      "  __asm__ volatile(\"repeat #9\\n nop\");\n"
      /* 25 */
      "  for (;;);\n"
      /* 26 */ "}\n";

  Said run(const std::string& program, const std::string& more = "", const std::string& info = "c.info") {
    return twinpuck("run maze --for 0.1 --quiet --fw '" + program + "' --coverage " + path(info) + " " +
                    more);
  }
  /// The records of main.c in `folder`, or all.
  std::set<std::string> records(const std::string& folder = "", const std::string& info = "c.info") {
    std::set<std::string> all;
    std::istringstream in(read(path(info)));
    bool is_it = false;
    for (std::string line; std::getline(in, line);) {
      if (line.rfind("SF:", 0) == 0) is_it = folder.empty() || line == "SF:" + path(folder) + "/main.c";
      if (is_it) all.insert(line);
    }
    return all;
  }
  void expect(const std::set<std::string>& records, const std::vector<std::string>& wanted) {
    for (const std::string& record : wanted) EXPECT_TRUE(records.count(record)) << record;
  }
};

const std::vector<std::string> kOnce{
    "FN:2,unused",  "FNDA:0,unused", "FN:5,twice",  "FNDA:1,twice", "FN:6,loop", "FNDA:1,loop", "FN:14,logic",
    "FNDA:3,logic", "FN:19,main",    "FNDA:1,main", "FNF:5",        "FNH:4",     "DA:3,0",      "DA:5,1",
    "DA:8,11",      "DA:9,10",       "DA:10,10",    "DA:11,3",      "DA:15,3",   "DA:16,1",     "DA:17,2",
    "DA:20,1",      "DA:21,1",       "DA:22,1",     "DA:23,0",      "DA:24,1"};

TEST_F(Coverage, counts_lines_functions_and_branches) {
  write("a/main.c", kProgram);
  const Said s = run("*=" + path("a"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  const auto all = records();
  expect(all, kOnce);
  // a condition that did not hold, and one that held; which of them jumps is the compiler's affair
  const auto both = [&](const std::string& of, int one, int other) {
    const auto two = [&](int a, int b) {
      return all.count("BRDA:" + of + ",0," + std::to_string(a)) > 0 &&
             all.count("BRDA:" + of + ",1," + std::to_string(b)) > 0;
    };
    EXPECT_TRUE(two(one, other) || two(other, one)) << of << "\n" << read(path("c.info"));
  };
  both("8,0", 10, 1);
  both("10,0", 7, 3);
  both("15,0", 2, 1);
  both("15,1", 1, 1);
  both("22,0", 0, 1);
  expect(all, {"BRF:10", "BRH:9"});
  // declarations have no code
  EXPECT_EQ(read(path("c.info")).find("\nDA:1,"), std::string::npos);
  EXPECT_EQ(read(path("c.info")).find("\nDA:7,"), std::string::npos);
}

TEST_F(Coverage, is_the_same_with_either_hal) {
  write("a/main.c", kProgram);
  ASSERT_EQ(run("*=" + path("a"), "--hal sim", "sim.info").exit_code, 0);
  ASSERT_EQ(run("*=" + path("a"), "--hal dspic", "dspic.info").exit_code, 0);
  expect(records("", "dspic.info"), kOnce);
  auto sim = records("", "sim.info"), dspic = records("", "dspic.info");
  // how often an endless loop goes round in 0.1 s depends on the start-up code's time alone
  for (auto* all : {&sim, &dspic}) all->erase(all->lower_bound("DA:25,"), all->upper_bound("DA:25,:"));
  EXPECT_EQ(sim, dspic);
}

TEST_F(Coverage, a_second_run_is_added) {
  write("a/main.c", kProgram);
  ASSERT_EQ(run("*=" + path("a")).exit_code, 0);
  ASSERT_EQ(run("*=" + path("a")).exit_code, 0);
  expect(records(), {"DA:9,20", "DA:11,6", "DA:3,0", "FNDA:6,logic", "FNF:5", "FNH:4", "BRF:10", "BRH:9"});
}

TEST_F(Coverage, robots_are_added) {
  write("a/main.c", kProgram);
  write("b/main.c", "volatile int n;\nint main(void) {\n  n = 3;\n  for (;;);\n}\n");
  write("w.toml",
        "twinpuck = 1\n[[robot]]\nname = \"one\"\nposition = [0.1, 0]\n[[robot]]\nname = \"two\"\nposition = "
        "[0.3, 0]\n"
        "[[robot]]\nname = \"three\"\nposition = [0.5, 0]\n");
  const Said s =
      twinpuck("run " + path("w.toml") + " --for 0.1 --quiet --threads 2 --fw one=" + path("a") +
               " --fw two=" + path("a") + " --fw three=" + path("b") + " --coverage " + path("c.info"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  expect(records("a"), {"DA:9,20", "DA:11,6", "FNDA:6,logic"});
  expect(records("b"), {"DA:3,1", "FNDA:1,main", "FNF:1"});
}

// a header's function, compiled with two files
TEST_F(Coverage, copies_are_added) {
  write("a/shared.h", "static int most(int a, int b) {\n  if (a > b)\n    return a;\n  return b;\n}\n");
  write("a/other.c", "#include \"shared.h\"\nint other(int a) { return most(a, 5); }\n");
  write("a/main.c",
        "#include \"shared.h\"\nint other(int a);\nvolatile int n;\n"
        "int main(void) {\n  n = most(4, 3) + other(7) + other(2);\n  for (;;);\n}\n");
  const Said s = run("*=" + path("a"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  expect(records(), {"FNDA:3,most", "FNDA:2,other", "DA:2,3", "DA:3,2"});
  const std::string info = read(path("c.info"));
  EXPECT_NE(info.find("BRF:2\nBRH:2\n"), std::string::npos) << info;
}

TEST_F(Coverage, of_an_image_is_what_its_lines_say) {
  write("a/main.c",
        "volatile int n = 10, sum;\nint main(void) {\n  int i, end = n;\n  for (i = 0; i < end; i++)\n"
        "    sum += i;\n  for (;;);\n}\n");
  ASSERT_EQ(twinpuck("build " + path("a") + " --opt -O1 --hal dspic -o " + path("a.elf")).exit_code, 0);
  const Said s = run("*=" + path("a.elf"));
  ASSERT_EQ(s.exit_code, 0) << s.text;
  expect(records(), {"DA:3,1", "DA:5,10", "FNDA:1,main"});
}

// what other tools wrote between the records is not kept, so the file becomes shorter
TEST_F(Coverage, counts_are_added_in_the_place_of_what_the_file_holds) {
  write("a/main.c", kProgram);
  ASSERT_EQ(run("*=" + path("a")).exit_code, 0);
  const std::string once = read(path("c.info"));
  std::string longer = once;
  for (int i = 0; i < 200; ++i) longer += "TN:a name of a test that is long\n";
  write("c.info", longer);
  ASSERT_EQ(run("*=" + path("a")).exit_code, 0);
  expect(records(), {"DA:8,22", "DA:11,6", "FNDA:6,logic"});
  const std::string twice = read(path("c.info"));
  EXPECT_LT(twice.size(), once.size() + 50);
  EXPECT_EQ(twice.substr(twice.size() - 14), "end_of_record\n");
}

TEST_F(Coverage, counts_of_another_text_are_not_added) {
  write("a/main.c", kProgram);
  ASSERT_EQ(run("*=" + path("a")).exit_code, 0);
  const std::string before = read(path("c.info"));
  write("a/main.c", std::string(kProgram) + "/* */\n");
  const Said s = run("*=" + path("a"));
  EXPECT_EQ(s.exit_code, 2) << s.text;
  EXPECT_TRUE(reads(s.text,
                    "@/c.info: --coverage: got counts of another text of @/a/main.c, expected those of the "
                    "one that runs; remove the file, or give another one, to count anew"));
  EXPECT_EQ(read(path("c.info")), before);
}

TEST_F(Coverage, a_file_of_something_else_stays) {
  write("a/main.c", kProgram);
  write("c.info", "TN:\nhello\n");
  const Said s = run("*=" + path("a"));
  EXPECT_EQ(s.exit_code, 2) << s.text;
  EXPECT_EQ(read(path("c.info")), "TN:\nhello\n");
  EXPECT_EQ(run("*=" + path("a"), "", "no/such/folder/c.info").exit_code, 2);
}

}  // namespace
