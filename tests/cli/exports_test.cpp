// SPDX-License-Identifier: MIT
// What supervisors and firmware need of the executable is what ships: programs run by the product itself, and
// test programs that export nothing more.
#include <set>
#include <sstream>

#include "tests/cli/command.h"

using namespace cli_test;

namespace {

class Exports : public CommandTest {
 protected:
  static std::set<std::string> exported(const std::string& program) {
    std::set<std::string> names;
    FILE* pipe = popen(("nm -D --defined-only '" + program + "'").c_str(), "r");
    std::string text;
    for (int c; (c = fgetc(pipe)) != EOF;) text.push_back(static_cast<char>(c));
    EXPECT_EQ(pclose(pipe), 0) << program;
    std::istringstream lines(text);
    for (std::string address, kind, name; lines >> address >> kind >> name;)
      // what templates and vague linkage leave behind is the linker's business, and the libraries' copies too
      if (std::string("TDRG").find(kind) != std::string::npos && name.find('@') == std::string::npos)
        names.insert(name);
    return names;
  }
};

TEST_F(Exports, test_programs_export_what_the_product_exports) {
  const std::set<std::string> product = exported(executable());
  EXPECT_GT(product.size(), 200u);
  EXPECT_TRUE(product.count("__wrap_exit"));
  int programs = 0;
  for (const auto& file : fs::directory_iterator(fs::path(TWINPUCK_BUILD_DIR) / "tests")) {
    const std::string name = file.path().filename();
    // cc_test is a host of its own; firmware_test gives its modules all of itself, and runs no supervisor
    if (!file.is_regular_file() || name.size() < 5 || name.substr(name.size() - 5) != "_test" ||
        name == "cc_test" || name == "firmware_test" ||
        read(file.path())
                .compare(0, 4,
                         "\x7f"
                         "ELF") != 0)
      continue;
    ++programs;
    for (const std::string& symbol : exported(file.path()))
      EXPECT_TRUE(product.count(symbol)) << name << " exports " << symbol << ", and twinpuck does not";
  }
  EXPECT_GT(programs, 0);
}

TEST_F(Exports, supervisors_written_for_webots_run_in_the_product) {
  write("world.toml", "twinpuck = 1\n[[robot]]\nname = \"puck\"\n");
  // each of the functions that are replaced, in C and in C++, by the interfaces of all times
  const std::string calls =
      "  srand(1); srandom(1); srand48(1);\n"
      "  printf(\"chance %d\\n\", rand() >= 0 && random() >= 0 && drand48() >= 0);\n"
      "  struct timeval now; gettimeofday(&now, 0);\n"
      "  printf(\"clocks %d\\n\", (int)(time(0) + now.tv_sec + clock()) >= 0);\n  fflush(stdout);\n";
  const std::string headers =
      "#include <stdio.h>\n#include <stdlib.h>\n#include <sys/time.h>\n#include <time.h>\n#include "
      "<unistd.h>\n";
  write("now.c", headers +
                     "#include <webots/robot.h>\n#include <webots/supervisor.h>\n"
                     "int main(void) {\n  wb_robot_init();\n" +
                     calls +
                     "  WbNodeRef robot = wb_supervisor_node_get_from_def(\"puck\");\n"
                     "  printf(\"robot %d\\n\", robot != NULL);\n"
                     "  while (wb_robot_step(64) != -1)\n"
                     "    if (wb_robot_get_time() > 0.5) { wb_robot_cleanup(); exit(0); }\n"
                     "  return 0;\n}\n");
  write("old.c", headers + "#include <device/robot.h>\n#include <device/supervisor.h>\nint main(void) {\n" +
                     calls + "  robot_step(64);\n  if (time(0) > 99) _exit(3);\n  exit(0);\n}\n");
  write("classes.cpp", headers + "#include <webots/Supervisor.hpp>\nint main() {\n  webots::Supervisor s;\n" +
                           calls + "  s.step(64);\n  quick_exit(0);\n}\n");
  write("plain.c", headers + "#include <supervisor.h>\nint main(void) {\n" + calls +
                       "  sv_step(0.1);\n  _Exit(sv_find(\"puck\"));\n}\n");
  for (const char* program : {"now.c", "old.c", "classes.cpp", "plain.c"}) {
    const Said said =
        twinpuck("run '" + path("world.toml") + "' --for 1 --supervisor '" + path(program) + "'");
    EXPECT_EQ(said.exit_code, 0) << program << said.text;
    for (const char* text : {"chance 1", "clocks 1", "1.0 s simulated"})
      EXPECT_NE(said.text.find(text), std::string::npos) << program << ": " << said.text;
  }
}

}  // namespace
