// SPDX-License-Identifier: MIT
// What a folder is, and how it becomes a program: small projects as people have them.
#include "programs/build/build.h"
#include "programs/build/files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "compiler/cache/child_process.h"
#include "tests/support/wording.h"
#include "twinpuck_paths.h"

namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const char* const kMakeEnd =
    "null :=\nspace := $(null) $(null)\n"
    "WEBOTS_HOME_PATH?=$(subst $(space),\\ ,$(strip $(subst \\,/,$(WEBOTS_HOME))))\n"
    "include $(WEBOTS_HOME_PATH)/resources/Makefile.include\n";

class BuildTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/programs-XXXXXX";
    home_ = mkdtemp(name);
    // the product's own library, or a stand-in where that is not built
    library_ = fs::path(TWINPUCK_BUILD_DIR) / "libcontroller.so";
    if (!fs::exists(library_)) make_stand_in();
    setenv("TWINPUCK_LIBCONTROLLER", library_.c_str(), 1);
  }
  void make_stand_in() {
    library_ = home_ / "libcontroller.so";
    const fs::path source = home_ / "stand_in.c";
    std::ofstream(source)
        << "int wb_robot_init(void){return 1;} int wb_robot_step(int d){return -1;}\n"
           "void wb_robot_cleanup(void){} int robot_step(int d){return 0;}\n"
           "void robot_live(void (*r)(void)){} unsigned short wb_robot_get_device(const char* n){return 1;}\n"
           "void wb_motor_set_velocity(unsigned short t, double v){}\n";
    ASSERT_EQ(cc::run_process({"gcc", "-shared", "-fPIC", "-o", library_.string(), source.string()}).status,
              0);
  }
  void TearDown() override {
    unsetenv("TWINPUCK_LIBCONTROLLER");
    std::error_code none;
    fs::remove_all(home_, none);
  }

  std::string folder(const std::string& name, const Files& files) {
    const fs::path at = home_ / "controllers" / name;
    fs::create_directories(at);
    for (const auto& [file, text] : files) {
      fs::create_directories((at / file).parent_path());
      std::ofstream(at / file, std::ios::binary) << text;
    }
    return at.string();
  }

  bool prepare(const std::string& path) {
    problems_.clear();
    told_.clear();
    return programs::prepare(
        path, (home_ / "cache").string(), [&](const std::string& line) { told_.push_back(line); }, problems_,
        launch_);
  }

  /// What the program prints when it is started as `launch_` says, in its folder.
  std::string output() {
    std::vector<std::string> words = {"env", "--chdir=" + launch_.folder};
    words.insert(words.end(), launch_.environment.begin(), launch_.environment.end());
    words.insert(words.end(), launch_.words.begin(), launch_.words.end());
    return cc::run_process(words).output;
  }

  std::string all_problems() const {
    std::string all;
    for (const std::string& line : problems_) all += line + "\n";
    return all;
  }
  bool has_environment(const std::string& setting) const {
    return std::find(launch_.environment.begin(), launch_.environment.end(), setting) !=
           launch_.environment.end();
  }

  fs::path home_, library_;
  std::vector<std::string> problems_, told_;
  programs::Launch launch_;
};

// --- what a text says

TEST(Text, c_without_comments_and_with_empty_strings) {
  const struct {
    const char *source, *bare;
  } rows[] = {{"", ""},
              {"a", "a"},
              {"/", "/"},
              {"// all of it", "\n"},
              {"// one\nint a;", "\nint a;"},
              {"/* one */int a;", " int a;"},
              {"int a; // more", "int a; \n"},
              {"int a; /* never ends", "int a;  "},
              {"/*/ still one */b", " b"},
              {"a /* x\n // y */ b // /* c\nd", "a   b \nd"},
              {"a / b /", "a / b /"},
              {"s = \"// no /* comment\";", "s = \"\";"},
              {"s = \"a\\\"// b\"; c", "s = \"\"; c"},
              {"c = '\"'; // d", "c = ''; \n"},
              {"c = '\\''; d", "c = ''; d"},
              {"s = \"open\nd", "s = \"\"d"}};
  for (const auto& row : rows) EXPECT_EQ(programs::without_comments(row.source), row.bare) << row.source;
}

TEST(Text, what_defines_main) {
  const std::pair<const char*, bool> rows[] = {{"int main() {}", true},
                                               {"int main(void)\n{\n}", true},
                                               {"main ( int argc, char **argv ) {", true},
                                               {"int main(argc, argv) int argc; char **argv; {}", true},
                                               {"int main(int (*f)(void)) {}", true},
                                               {"int main(void);", false},
                                               {"int main;", false},
                                               {"x = main(1) + 2;", false},
                                               {"int domain() {}", false},
                                               {"int main_loop() {}", false},
                                               {"void Robot::main() {}", false},
                                               {"robot.main() {", false},
                                               {"int main(void); int main(void) {}", true},
                                               {"int main(", false},
                                               {"", false}};
  for (const auto& [bare, is_one] : rows) EXPECT_EQ(programs::defines_main(bare), is_one) << bare;
}

// --- what a folder or file is

TEST_F(BuildTest, folders_are_told_apart) {
  const struct {
    const char* name;
    Files files;
    bool is_pc;
  } kCases[] = {
      {"today", {{"today.c", "#include <webots/robot.h>\nint main() {}\n"}}, true},
      {"of2005", {{"of2005.c", "#include \"device/robot.h\"\nint main() {}\n"}}, true},
      {"other_device", {{"main.c", "#include \"device/flash_chip.h\"\nint main() {}\n"}}, false},
      {"by_header",
       {{"a.c", "#include \"my.h\"\nint main() {}\n"}, {"my.h", "#include <webots/motor.h>\n"}},
       true},
      {"firmware", {{"main.c", "#include <p30F6014A.h>\nint main() {}\n"}}, false},
      {"plain_c", {{"main.c", "int main(void) { return 0; }\n"}}, false},
      {"cpp", {{"cpp.cpp", "int main() {}\n"}}, true},
      {"pc_side",
       {{"main.c", "#include \"motor_led/e_led.h\"\nint main() {}\n"}, {"pc/tool.cpp", "int main() {}\n"}},
       false},
      {"python", {{"python.py", "print(1)\n"}}, true},
      {"plots",
       {{"main.c", "#include <e_epuck_ports.h>\nint main() {}\n"}, {"plots.py", "print(1)\n"}},
       false},
      {"java", {{"java.java", "class java {}\n"}}, true},
      {"matlab", {{"matlab.m", "x = 1;\n"}}, true},
      {"elsewhere", {{"Makefile", "C_SOURCES = ../shared/x.c\n" + std::string(kMakeEnd)}}, true},
      {"empty", {{"notes.txt", "nothing\n"}}, false},
  };
  for (const auto& c : kCases) EXPECT_EQ(programs::is_pc_program(folder(c.name, c.files)), c.is_pc) << c.name;
  EXPECT_TRUE(programs::is_pc_program("<extern>"));
  EXPECT_FALSE(programs::is_pc_program((home_ / "nothing").string()));
}

TEST_F(BuildTest, files_are_told_apart) {
  const fs::path at = folder("files", {{"a.py", "1\n"},
                                       {"a.c", "int main(){}\n"},
                                       {"b.PY", "1\n"},
                                       {"c.Cpp", "int main(){}\n"},
                                       {"script", "#!/bin/sh\necho 1\n"},
                                       {"chip.hex", ":00000001FF\n"},
                                       {"text", "words\n"}});
  EXPECT_TRUE(programs::is_pc_program((at / "a.py").string()));
  EXPECT_TRUE(programs::is_pc_program((at / "a.c").string()));
  EXPECT_TRUE(programs::is_pc_program((at / "b.PY").string()));
  EXPECT_TRUE(programs::is_pc_program((at / "c.Cpp").string()));
  EXPECT_TRUE(programs::is_pc_program((at / "script").string()));
  EXPECT_TRUE(programs::is_pc_program("/bin/sh"));
  EXPECT_FALSE(programs::is_pc_program((at / "chip.hex").string()));
  EXPECT_FALSE(programs::is_pc_program((at / "text").string()));
  EXPECT_FALSE(programs::is_pc_program(library_.string()));  // no main() to start
}

TEST_F(BuildTest, controllers_of_this_project_stay_firmware) {
  for (const char* name : {"asercom", "braitenberg", "camera_follow", "blink"})
    EXPECT_FALSE(programs::is_pc_program(TWINPUCK_SOURCE_DIR "/firmware/" + std::string(name))) << name;
}

// --- C and C++

TEST_F(BuildTest, projects_compile_and_run) {
  const std::string robot = "#include <stdio.h>\n#include <webots/robot.h>\n";
  const struct {
    const char* name;
    Files files;
    int sources;
    const char* prints;
  } kCases[] = {
      {"c", {{"c.c", robot + "int main() { printf(\"%d\", (int)sizeof(int)); return 0; }\n"}}, 1, "4"},
      {"cpp",
       {{"cpp.cpp",
         "#include <iostream>\n#include \"Body.hpp\"\nint main() { std::cout << Body(3).twice(); }\n"},
        {"Body.hpp", "class Body { int n; public: explicit Body(int n); int twice() const; };\n"},
        {"Body.cpp",
         "#include \"Body.hpp\"\nBody::Body(int n) : n(n) {}\nint Body::twice() const { return 2 * n; }\n"}},
       2,
       "6"},
      {"makefile",
       {{"makefile.c", robot + "#include \"half.h\"\nint main() { printf(\"%.1f\", half(3)); return 0; }\n"},
        {"sub/half.c",
         "#include <math.h>\n#include \"half.h\"\ndouble half(double x) { return fabs(x) / 2 + BIAS; }\n"},
        {"inc/half.h", "double half(double);\n"},
        {"unfinished.c", "this does not compile\n"},
        {"Makefile",
         "C_SOURCES = makefile.c \\\n sub/half.c\nINCLUDE = -I\"inc\"\nLIBRARIES = -L\"lib\" -lm\n"
         "CFLAGS = -DBIAS=1 -Werror -o unused -MMD -MF unused.d\n" +
             std::string(kMakeEnd)}},
       2,
       "2.5"},
      {"c_api",
       {{"c_api.cpp",
         "#include <webots/robot.h>\n#include <iostream>\nint main() { if (NAME[0] == 0) wb_robot_init(); "
         "std::cout << NAME; "
         "}\n"},
        {"Makefile", "CXX_SOURCES = c_api.cpp\nUSE_C_API = true\nCFLAGS = -DNAME=\\\"$(NAME)\\\"\n" +
                         std::string(kMakeEnd)}},
       1,
       "c_api"},
      {"named_alone",
       {{"named_alone.c", robot + "int main() { printf(\"ok\"); return 0; }\n"},
        {"old.c", "int broken = ;\n"},
        {"Makefile",
         "WEBOTS_HOME = C:\\PROGRA~1\\Webots\nWEBOTS_HOME_PATH=C:/PROGRA~1/Webots\n"
         "include $(WEBOTS_HOME_PATH)/resources/Makefile.include\n"}},
       1,
       "ok"},
      {"two_mains",
       {{"two_mains.c", robot + "int f(void);\nint main() { printf(\"%d\", f()); return 0; }\n"},
        {"trial.c", "#include <stdio.h>\nint main(void)\n{ return 1; }\n"},
        {"f.c", "int f(void) { return 7; }\n"}},
       2,
       "7"},
      {"as_text",
       {{"as_text.c", robot + "#include \"part.c\"\nint main() { printf(\"%d\", part()); return 0; }\n"},
        {"part.c", "static int part(void) { return 5; }\nint shared;\n"}},
       1,
       "5"},
      {"as_text_in_a_circle",
       {{"as_text_in_a_circle.c",
         robot + "#include \"part.c\"\nint main() { printf(\"%d\", part()); return 0; }\n"},
        {"part.c",
         "#ifndef PART\n#define PART\n#include \"other.c\"\nstatic int part(void) { return other(); "
         "}\n#endif\n"},
        {"other.c", "#include \"part.c\"\nstatic int other(void) { return 8; }\n"}},
       1,
       "8"},
      {"old_c",
       {{"old_c.c", robot +
                        "#include \"common.h\"\ninline int twice(int n) { return 2 * n; }\n"
                        "main() { shared = 4; printf(\"%d %d\", twice(helper(1)), shared); return 0; }\n"},
        {"helper.c", "#include \"common.h\"\nhelper(n) int n; { return n + 1; }\n"},
        {"common.h", "int shared;\n"}},
       2,
       "4 4"},
      {"slashes",
       {{"slashes.c", robot + "#include \"Sub\\Part.H\"\nint main() { printf(\"%d\", PART); return 0; }\n"},
        {"sub/part.h", "#include \"more.h\"\n"},
        {"sub/more.h", "#define PART 9\n"}},
       1,
       "9"},
      {"by_hand",
       {{"by_hand.c", robot + "#include <math.h>\nint main(int argc, char** argv) { printf(\"%.0f\", "
                              "pow(argc, 3)); return 0; }\n"},
        {"Makefile",
         "by_hand: by_hand.o\n\tgcc -o by_hand by_hand.o -L$(WEBOTS_HOME)/lib -lController -lm\n"}},
       1,
       "1"},
      // what is made of which source is in no rule; a file that nobody names is not looked at
      {"objects",
       {{"objects.c",
         robot +
             "int a(void), b(void), c(void);\nint main() { printf(\"%d\", a() + b() + c()); return 0; }\n"},
        {"sub/a.c", "int a(void) { return 1; }\n"},
        {"b.c", "int b(void) { return 20; }\n"},
        {"c.c", "int c(void) { return 300; }\n"},
        {"broken.c", "int broken = ;\n"},
        {"Makefile",
         "OBJS = objects.o sub/a.o b.o c.o\nobjects: $(OBJS)\n\tgcc -o objects $(OBJS) -lController\n"}},
       4,
       "321"},
      {"objects_cpp",
       {{"objects_cpp.cpp", "#include <cstdio>\nint a();\nint main() { std::printf(\"%d\", a()); }\n"},
        {"a.cc", "int a() { return 5; }\n"},
        {"broken.cpp", "int broken = ;\n"},
        {"Makefile", "OBJ = objects_cpp.o a.o\nobjects_cpp: $(OBJ)\n\tg++ -o $@ $^\n"}},
       2,
       "5"},
      {"sources",
       {{"sources.c", robot + "int a(void);\nint main() { printf(\"%d\", a()); return 0; }\n"},
        {"a.c", "int a(void) { return 6; }\n"},
        {"broken.c", "int broken = ;\n"},
        {"Makefile", "SRCS = sources.c a.c nosuch.c notes.txt\nsources: $(SRCS)\n\tgcc -o $@ $^\n"}},
       2,
       "6"},
      {"-odd (name) 'x'",
       {{"-odd.c", robot + "int main() { printf(\"odd\"); return 0; }\n"}, {"._odd.c", "binary"}},
       1,
       "odd"},
      {"old_cpp",
       {{"old_cpp.cpp",
         "#include <cstdio>\nint f(int n) throw(int) { return n; }\nint main() { register int i = 3; "
         "std::printf(\"%d\", f(i)); }\n"}},
       1,
       "3"},
      // headers that older libraries of C++ brought along
      {"no_headers",
       {{"no_headers.cpp",
         "#include <cstdio>\nusing namespace std;\nint main() { function<int(int)> f = [](int n) { return n; "
         "};\n"
         "unique_ptr<array<int, 2>> a(new array<int, 2>); (*a)[1] = f(6); printf(\"%d\", (*a)[1]); }\n"}},
       1,
       "6"},
      // asserts are off, as in what Webots builds
      {"asserts",
       {{"asserts.c", robot + "#include <assert.h>\nint main() { assert(0); printf(\"on\"); return 0; }\n"}},
       1,
       "on"},
  };
  for (const auto& c : kCases) {
    ASSERT_TRUE(prepare(folder(c.name, c.files))) << c.name << "\n" << all_problems();
    EXPECT_EQ(launch_.files, c.sources) << c.name;
    EXPECT_EQ(launch_.folder, (home_ / "controllers" / c.name).string());
    EXPECT_EQ(output(), c.prints) << c.name;
  }
}

// as clang, the Mac's compiler, takes it
TEST_F(BuildTest, an_array_may_have_a_constant_s_size) {
  const std::string at = folder(
      "mac_c", {{"mac_c.c",
                 "#include <stdio.h>\n#include <webots/robot.h>\nstatic const int N = 3;\n"
                 "double weights[N];\nint main() { printf(\"%d\", (int)sizeof weights); return 0; }\n"}});
  if (cc::run_process({"sh", "-c", "command -v clang"}).status != 0) {
    EXPECT_FALSE(prepare(at));
    EXPECT_NE(all_problems().find("mac_c.c:4:8: error: variably modified"), std::string::npos);
    return;
  }
  ASSERT_TRUE(prepare(at)) << all_problems();
  EXPECT_EQ(output(), "24");
}

TEST_F(BuildTest, a_conditional_and_a_call_in_a_makefile_count) {
  folder("../libraries/shapes", {{"shapes.c", "int corners(void) { return 4; }\n"},
                                 {"shapes.h", "int corners(void);\n"},
                                 {"Makefile", "C_SOURCES = shapes.c\n" + std::string(kMakeEnd)}});
  const std::string at = folder(
      "cond", {{"a.c",
                "#include <stdio.h>\n#include \"shapes.h\"\n#include <webots/robot.h>\n"
                "int main() { printf(\"%d\", N + corners()); return 0; }\n"},
               {"Makefile",
                "ifeq ($(OSTYPE),linux)\nCFLAGS += -DN=$(shell echo 2)\nendif\nC_SOURCES = $(wildcard *.c)\n"
                "INCLUDE = -I../../libraries/shapes\nLIBRARIES = -L../../libraries/shapes -lshapes\n" +
                    std::string(kMakeEnd)}});
  ASSERT_TRUE(prepare(at)) << all_problems();  // the project's own library was never built
  EXPECT_EQ(output(), "6");
}

TEST_F(BuildTest, an_include_beside_the_project_is_followed) {
  folder("../controllers",
         {{"Makefile.include",
           "CFLAGS += -DFROM=8\ninclude $(WEBOTS_HOME)/projects/default/controllers/Makefile.include\n"}});
  const std::string at = folder(
      "six",
      {{"six.c",
        "#include <device/robot.h>\n#include <stdio.h>\nint main() { printf(\"%d\", FROM); return 0; }\n"},
       {"Makefile", "include ../Makefile.include\n"}});
  ASSERT_TRUE(prepare(at)) << all_problems();
  EXPECT_EQ(output(), "8");
}

TEST_F(BuildTest, a_link_to_a_controller_is_one) {
  const fs::path real = folder(
      "real",
      {{"real.c", "#include <webots/robot.h>\n#include <stdio.h>\nint main() { printf(\"r\"); return 0; }\n"},
       {"other.c", "int main() { return 0; }\n"}});
  const fs::path link = home_ / "controllers" / "linked";
  fs::create_directory_symlink(real, link);
  EXPECT_TRUE(programs::is_pc_program(link.string()));
  ASSERT_TRUE(prepare(link.string() + "/")) << all_problems();
  EXPECT_EQ(output(), "r");
}

TEST_F(BuildTest, thousands_of_files_of_others_hide_no_source) {
  const fs::path at = folder("zoo", {{"zoo.c",
                                      "#include <webots/robot.h>\n#include <stdio.h>\nint main() { "
                                      "printf(\"z\"); return 0; }\n"},
                                     {"venv/pyvenv.cfg", "home = /usr/bin\n"},
                                     {"venv/lib/extension.c", "int main() { return 1; }\n"}});
  fs::create_directories(at / "a_log");
  for (int i = 0; i < 6000; ++i) std::ofstream(at / "a_log" / std::to_string(i)).flush();
  fs::create_directory_symlink(at, at / "circle");
  ASSERT_TRUE(prepare(at.string())) << all_problems();
  EXPECT_EQ(launch_.files, 1);
  EXPECT_EQ(output(), "z");
}

TEST_F(BuildTest, a_file_is_a_program) {
  const fs::path at = folder("single", {{"b.cpp", "#include <cstdio>\nint main() { std::printf(\"b\"); }\n"},
                                        {"c.c", "int broken = ;\n"}});
  ASSERT_TRUE(prepare((at / "b.cpp").string())) << all_problems();
  EXPECT_EQ(output(), "b");
  EXPECT_EQ(launch_.files, 1);
}

TEST_F(BuildTest, what_does_not_change_is_compiled_once) {
  const fs::path at = folder("kept", {{"kept.c",
                                       "#include <webots/robot.h>\n#include <stdio.h>\n#include "
                                       "\"../n.h\"\nint main() { printf(\"%d\", N); return 0; }\n"}});
  std::ofstream(home_ / "controllers" / "n.h") << "#define N 1\n";
  ASSERT_TRUE(prepare(at.string())) << all_problems();
  const std::string first = launch_.words[0];
  const auto when = fs::last_write_time(first);
  ASSERT_TRUE(prepare(at.string()));
  EXPECT_EQ(launch_.words[0], first);
  EXPECT_EQ(launch_.files, 1);
  EXPECT_EQ(fs::last_write_time(first), when);
  // a header outside of the folder counts as well
  std::ofstream(home_ / "controllers" / "n.h") << "#define N 2\n";
  ASSERT_TRUE(prepare(at.string()));
  EXPECT_NE(launch_.words[0], first);
  EXPECT_EQ(output(), "2");
}

TEST_F(BuildTest, several_runs_at_once_build_one_program) {
  const std::string at =
      folder("shared",
             {{"shared.c",
               "#include <webots/robot.h>\n#include <stdio.h>\nint main() { printf(\"s\"); return 0; }\n"}});
  std::vector<std::thread> runs;
  std::vector<programs::Launch> launches(6);
  std::vector<char> good(6);
  for (std::size_t i = 0; i < launches.size(); ++i)
    runs.emplace_back([&, i] {
      std::vector<std::string> problems;
      good[i] = programs::prepare(at, (home_ / "cache").string(), {}, problems, launches[i]);
    });
  for (auto& run : runs) run.join();
  for (std::size_t i = 0; i < launches.size(); ++i) {
    ASSERT_TRUE(good[i]);
    launch_ = launches[i];
    EXPECT_EQ(launch_.words[0], launches[0].words[0]);
    EXPECT_EQ(output(), "s");
  }
  // nothing of the builds is left but the program and what it needs
  std::set<std::string> left;
  for (const auto& entry : fs::directory_iterator(home_ / "cache"))
    left.insert(entry.path().filename().string());
  EXPECT_EQ(left.size(), 2u) << *left.begin() << " " << *left.rbegin();
}

// --- what cannot be

TEST_F(BuildTest, broken_code_is_named_with_its_line) {
  const std::string at =
      folder("broken", {{"broken.c", "#include <webots/robot.h>\nint main() {\n  int n = ;\n}\n"}});
  EXPECT_FALSE(prepare(at));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "@: controller: does not compile:\n@/broken.c: In function 'main':\n"
                             "@/broken.c:3:11: error: expected expression before ';' token\n"
                             "    3 |   int n = ;\n      |           ^\n"
                             "@/broken.c:3:7: warning: unused variable 'n' [-Wunused-variable]\n"
                             "    3 |   int n = ;\n      |       ^",
                             {{at, "@"}}));
  const std::string link =
      folder("misses",
             {{"misses.c", "#include <webots/robot.h>\nint gone(void);\nint main() { return gone(); }\n"}});
  EXPECT_FALSE(prepare(link));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/misses: controller: does not compile:\n/usr/bin/ld: …: in function "
                             "`main':\n…/misses.c:3: undefined reference to `gone'"));
}

TEST_F(BuildTest, missing_packages_are_named) {
  // a header and a library that nobody has under the names of a known package
  const std::string at = folder(
      "needs",
      {{"needs.c", "#include <webots/robot.h>\n#include <gsl/gsl_nothing.h>\nint main() { return 0; }\n"}});
  EXPECT_FALSE(prepare(at));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/needs: controller: does not compile:\n"
                             "…/needs.c:2:10: fatal error: gsl/gsl_nothing.h: No such file or directory\n"
                             "gsl: apt install libgsl-dev\n    2 | #include <gsl/gsl_nothing.h>\n"
                             "      |          ^~~~~~~~~~~~~~~~~~~"));
  const std::string link =
      folder("links", {{"links.c", "#include <webots/robot.h>\nint main() { return 0; }\n"},
                       {"Makefile", "LIBRARIES = -lopencv_nothing\n" + std::string(kMakeEnd)}});
  EXPECT_FALSE(prepare(link));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/links: controller: does not compile:\n"
                             "/usr/bin/ld: cannot find -lopencv_nothing: No such file or directory\n"
                             "opencv: apt install libopencv-dev\n"
                             "/usr/bin/ld: cannot find -lopencv_nothing: No such file or directory"));
}

TEST_F(BuildTest, lines_of_compilers_and_python_have_a_hint) {
  const std::pair<const char*, const char*> kLines[] = {
      {"x.c:2:10: fatal error: gsl/gsl_rng.h: No such file or directory", "gsl: apt install libgsl-dev"},
      {"x.cpp:2:10: fatal error: Eigen/Dense: No such file or directory", "eigen: apt install libeigen3-dev"},
      {"/usr/bin/ld: cannot find -lgslcblas: No such file or directory", "gsl: apt install libgsl-dev"},
      {"/usr/bin/ld: cannot find -lz: No such file or directory", "zlib: apt install zlib1g-dev"},
      {"/usr/bin/ld: cannot find -lglut", "glut: apt install freeglut3-dev"},
      {"ModuleNotFoundError: No module named 'numpy'", "numpy: apt install python3-numpy"},
      {"ModuleNotFoundError: No module named 'scipy.optimize'", "scipy: apt install python3-scipy"},
      {"ImportError: No module named cv2", "cv2: apt install python3-opencv"},
      {"Package opencv was not found in the pkg-config search path.", "opencv: apt install libopencv-dev"},
      {"x.c:2:10: fatal error: mine.h: No such file or directory", ""},
      {"ModuleNotFoundError: No module named 'my_own'", ""},
      {"all is well", ""},
  };
  for (const auto& [line, hint] : kLines) EXPECT_EQ(programs::package_hint(line), hint) << line;
}

TEST_F(BuildTest, a_pipe_in_place_of_a_source_is_refused) {
  const fs::path at =
      folder("pipe", {{"pipe.c", "#include <webots/robot.h>\n#include \"x.h\"\nint main() { return 0; }\n"}});
  ASSERT_EQ(mkfifo((at / "x.h").c_str(), 0600), 0);
  EXPECT_FALSE(prepare(at.string()));
  EXPECT_TRUE(wording::reads(all_problems(), "…/x.h: controller: got a pipe or a device, expected a file"));
  EXPECT_FALSE(prepare((at / "x.h").string()));
}

TEST_F(BuildTest, what_is_not_run_is_named) {
  EXPECT_FALSE(prepare(folder("mat", {{"mat.m", "x = 1;\n"}})));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/mat: controller: got a program in MATLAB, expected one in C, C++, Python or "
                             "Java; MATLAB programs are not run"));
  EXPECT_FALSE(prepare(folder("stale", {{"Makefile", "C_SOURCES = gone.c\n" + std::string(kMakeEnd)},
                                        {"stale.c", "#include <webots/robot.h>\n"}})));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/stale/Makefile: sources: got gone.c, which is not there, expected a file"));
  EXPECT_FALSE(prepare(
      folder("twice", {{"a.c", "#include <webots/robot.h>\nint main() {}\n"}, {"b.c", "int main() {}\n"}})));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/twice: controller: got main() in each of a.c, b.c, expected one, in a file "
                             "that is named as the folder: twice.c"));
  EXPECT_FALSE(prepare(folder("windows", {{"windows.exe", "MZ"}})));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/windows: controller: got a program of Windows without its source, expected "
                             "source or a program of this machine"));
  EXPECT_FALSE(prepare(folder("chip", {{"main.c", "#include <p30F6014A.h>\nint main() {}\n"}})));
  EXPECT_TRUE(wording::reads(all_problems(),
                             "…/chip: controller: got firmware of the e-puck, expected a program of the PC: "
                             "C or C++ with Webots' headers, Python, Java, or a program of this machine"));
}

TEST_F(BuildTest, a_makefile_without_end_does_not_hold_a_run) {
  const std::string at =
      folder("loop", {{"loop.c", "#include <webots/robot.h>\nint main() { return 0; }\n"},
                      {"Makefile", "include Makefile\nA = $(B)\nB = $(A)\nC_SOURCES = $(A)\n"}});
  ASSERT_TRUE(prepare(at)) << all_problems();  // make gives up, and the folder's files are taken
  EXPECT_EQ(launch_.files, 1);
}

// --- Python, Java, ready-made

TEST_F(BuildTest, python_runs_as_runtime_ini_says) {
  const std::string at = folder(
      "py",
      {{"py.py",
        "import os, sys\nprint(sys.flags.optimize, os.environ['A'], os.environ['PLACE'], "
        "os.environ['PYTHONHASHSEED'], __file__, sys.path[1])\n"},
       {"helper.py", "from controller import Robot\n"},
       {"runtime.ini",
        "; mine\r\n[environment variables]\r\nA = one ; two\n[environment variables for Windows]\nA = no\n"
        "[environment variables with paths]\nPLACE = lib:$(NOBODY_SET_IT):../../x\nPYTHONPATH = mods\n"
        "[python]\nCOMMAND = python3\nOPTIONS = -O -B\n"}});
  ASSERT_TRUE(prepare(at)) << all_problems();
  EXPECT_EQ(launch_.files, 0);
  const std::string ours = TWINPUCK_SOURCE_DIR "/programs/controller/python";
  EXPECT_EQ(output(), "1 one " + at + "/lib:" + home_.string() + "/x 0 " + at + "/py.py " + ours + "\n");
  EXPECT_TRUE(has_environment("PYTHONUNBUFFERED=1"));
  EXPECT_TRUE(std::any_of(launch_.environment.begin(), launch_.environment.end(), [&](const std::string& e) {
    return e.rfind("PYTHONPATH=" + ours + ":" + at + "/mods", 0) == 0;
  }));
}

TEST_F(BuildTest, a_folder_of_python_stays_as_it_is) {
  const fs::path at =
      folder("clean", {{"clean.py", "import helper\nprint(helper.n)\n"}, {"helper.py", "n = 3\n"}});
  ASSERT_TRUE(prepare(at.string()));
  EXPECT_EQ(output(), "3\n");
  EXPECT_FALSE(fs::exists(at / "__pycache__"));
  EXPECT_TRUE(fs::exists(home_ / "cache/python"));  // and is read faster the second time
}

TEST_F(BuildTest, an_interpreter_that_is_not_here_is_told) {
  const std::string at = folder(
      "mac", {{"other_name.py", "print(5)\n"},
              {"runtime.ini", "[python]\nCOMMAND = /opt/local/bin/python3.8\n[colours]\nx = 1\nodd\n"}});
  ASSERT_TRUE(prepare(at)) << all_problems();
  EXPECT_EQ(output(), "5\n");
  ASSERT_EQ(told_.size(), 3u);
  EXPECT_TRUE(wording::reads(told_[0],
                             "…/controllers/mac/runtime.ini:3: got section [colours], expected environment "
                             "variables, python, java or matlab"));
  EXPECT_TRUE(wording::reads(told_[1],
                             "…/controllers/mac/runtime.ini:5: got a line without =, expected NAME = VALUE"));
  EXPECT_TRUE(wording::reads(told_[2],
                             "…/controllers/mac/runtime.ini: python.COMMAND: got /opt/local/bin/python3.8, "
                             "which is not here; python3 is taken"));
}

TEST_F(BuildTest, of_several_python_files_one_must_be_the_main_one) {
  EXPECT_FALSE(prepare(folder("many", {{"a.py", "1\n"}, {"b.py", "2\n"}})));
  EXPECT_TRUE(wording::reads(
      all_problems(),
      "…/many: controller: got 2 files in Python, expected one that is named as the folder: many.py"));
  ASSERT_TRUE(prepare(folder("uses", {{"a.py", "1\n"}, {"b.py", "from controller import Robot\n"}})));
  EXPECT_EQ(launch_.words.back(), "b.py");
}

TEST_F(BuildTest, a_virtual_environment_in_the_folder_is_taken) {
  const fs::path at =
      folder("with_env", {{"with_env.py", "print(1)\n"}, {"venv/pyvenv.cfg", "home = /usr/bin\n"}});
  fs::create_directories(at / "venv/bin");
  fs::create_symlink("/bin/echo", at / "venv/bin/python3");
  ASSERT_TRUE(prepare(at.string()));
  EXPECT_EQ(launch_.words[0], (at / "venv/bin/python3").string());
}

TEST_F(BuildTest, a_ready_made_program_runs_as_it_is) {
  const fs::path at = folder("ready", {});
  fs::copy_file("/bin/echo", at / "ready");
  ASSERT_TRUE(programs::is_pc_program(at.string()));
  ASSERT_TRUE(prepare(at.string())) << all_problems();
  EXPECT_EQ(launch_.words, std::vector<std::string>{(at / "ready").string()});
  EXPECT_EQ(launch_.files, 0);
  // Webots' name of the library leads to ours
  EXPECT_TRUE(fs::equivalent(home_ / "cache/names/libController.so", library_));
  EXPECT_TRUE(std::any_of(launch_.environment.begin(), launch_.environment.end(), [&](const std::string& e) {
    return e.rfind("LD_LIBRARY_PATH=", 0) == 0 && e.find("cache/names") != std::string::npos;
  }));
}

TEST_F(BuildTest, a_program_from_outside_is_waited_for) {
  ASSERT_TRUE(prepare("<extern>"));
  EXPECT_TRUE(launch_.is_extern);
  EXPECT_TRUE(launch_.words.empty());
}

TEST_F(BuildTest, java_is_compiled_where_there_is_a_compiler) {
  const std::string at = folder(
      "Jay",
      {{"Jay.java",
        "public class Jay { public static void main(String[] a) { System.out.println(Other.n()); } }\n"},
       {"Other.java", "class Other { static int n() { return 11; } }\n"}});
  const bool has_compiler = cc::run_process({"sh", "-c", "command -v javac"}).status == 0;
  EXPECT_EQ(prepare(at), has_compiler);
  if (!has_compiler) {
    EXPECT_NE(all_problems().find("apt install default-jdk-headless"), std::string::npos);
    return;
  }
  EXPECT_EQ(launch_.files, 2);
  EXPECT_EQ(output(), "11\n");
  const auto kept = launch_.words;
  ASSERT_TRUE(prepare(at));
  EXPECT_EQ(launch_.words, kept);
}

}  // namespace
