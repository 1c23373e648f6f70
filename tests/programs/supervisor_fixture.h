// SPDX-License-Identifier: MIT
// Supervisors in tests: a judge in C that looks, and ends the run as passed when it comes to its end.
#pragma once
#include <algorithm>

#include "tests/programs/program_fixture.h"

namespace programs_test {

inline const char* const kIdle = "int main(void) { for (;;) ; }";

/// expect(), fields by name, and pass() at a program's end.
inline const char* const kTools = R"(
static void ends(int status) { fflush(stdout); wb_supervisor_simulation_quit(status); wb_robot_cleanup(); exit(0); }
#define EXPECT(what) do { if (!(what)) { printf("line %d: %s\n", __LINE__, #what); ends(1); } } while (0)
static WbFieldRef field(const char *node, const char *name) {
  WbNodeRef n = wb_supervisor_node_get_from_def(node);
  WbFieldRef f = n ? wb_supervisor_node_get_field(n, name) : NULL;
  if (!f) { printf("no %s.%s\n", node, name); ends(1); }
  return f;
}
static double get(const char *node, const char *name) { return wb_supervisor_field_get_sf_float(field(node, name)); }
static void set(const char *node, const char *name, double value) { wb_supervisor_field_set_sf_float(field(node, name), value); }
static int whole(const char *node, const char *name) { return wb_supervisor_field_get_sf_int32(field(node, name)); }
static const double *place(const char *def) { return wb_supervisor_node_get_position(wb_supervisor_node_get_from_def(def)); }
)";

class SupervisorTest : public ProgramTest {
 protected:
  /// A program that begins before the first tick; at its end it has passed.
  void add_judge(const std::string& body, const std::string& globals = "") {
    add_supervisor(
        program_folder(std::string(kHeaders) + kTools + globals +
                           "\nint main(int argc, char **argv) { (void)argc; (void)argv; wb_robot_init();\n" +
                           body + "\nends(0); return 0; }\n",
                       "c"));
  }
  void expect_pass(double seconds = 1) {
    listen();
    run_for(seconds);
    std::string all;
    for (const std::string& line : said) all += line + "\n";
    EXPECT_TRUE(finish().ended) << "the program did not come to its end\n" << all;
    EXPECT_EQ(finish().code, 0) << finish().text << "\n" << all;
  }
  bool was_said(const std::string& words) const {
    return std::any_of(said.begin(), said.end(),
                       [&](const std::string& l) { return l.find(words) != std::string::npos; });
  }
  void add_ball(double x_m = 0.3, double y_m = 0.4) {
    sim::ObjectDesc ball;
    ball.kind = sim::ObjectKind::Ball;
    ball.name = "ball";
    ball.def = "BALL";
    ball.radius_m = 0.02;
    ball.size_m.z = 0.04;
    ball.movable = true;
    ball.pose = {x_m, y_m, 0};
    world.objects.push_back(ball);
  }
};

}  // namespace programs_test
