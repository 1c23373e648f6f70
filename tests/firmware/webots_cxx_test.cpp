// SPDX-License-Identifier: MIT
// Webots' controllers in C++, and what controllers have of the PC: files, a keyboard, a display.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hal_sim/cc/build.h"
#include "tests/support/firmware_test.h"
#include "twinpuck_paths.h"

using namespace firmware_test;

namespace {

namespace fs = std::filesystem;

/// A folder of the test's own, empty.
fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(TWINPUCK_BUILD_DIR) / "tests" / "webots_cxx" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string text_of(const fs::path& file) {
  std::ostringstream all;
  all << std::ifstream(file).rdbuf();
  return all.str();
}

class WebotsCxx : public FirmwareTest {
 protected:
  /// A controller's folder with one file.
  Robot& add(const std::string& folder, const std::string& file, const std::string& source) {
    source_ = fresh_folder(folder);
    std::ofstream(source_ / file) << source;
    return add_robot(source_.string(), "puck");
  }
  fs::path source_;
};

TEST_F(WebotsCxx, a_controller_in_cpp_drives_with_the_classes_of_webots) {
  Robot& r = add("drive", "drive.cpp", R"(
    #include <webots/DistanceSensor.hpp>
    #include <webots/Motor.hpp>
    #include <webots/Robot.hpp>
    #include <iostream>
    using namespace webots;
    class Driver : public Robot {
     public:
      Driver() {
        left = getMotor("left wheel motor");
        right = dynamic_cast<Motor*>(getDevice("right wheel motor"));
        ps = getDistanceSensor(std::string("ps") + "0");
        ps->enable(64);
        for (Motor* m : {left, right}) m->setPosition(INFINITY), m->setVelocity(3.14);
      }
      void run() {
        while (step(64) != -1)
          if (++steps == 10) std::cout << ps->getName() << (ps->getValue() > 1000 ? " sees" : " is blind") << std::endl;
      }
     private:
      Motor *left, *right;
      DistanceSensor* ps;
      int steps = 0;
    };
    Driver* driver = new Driver();
    int main(int argc, char** argv) { driver->run(); delete driver; return 0; })");
  wall(0.09, -0.2, 0.09, 0.2);
  run_for(1.2);
  EXPECT_GT(r.left_steps(), 300);
  EXPECT_GT(r.right_steps(), 300);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"ps0 sees"}));
  expect_no_traps();
}

TEST_F(WebotsCxx, containers_and_streams_of_cpp_do_what_they_do_on_a_pc) {
  Robot& r = add("containers", "containers.cpp", R"(
    #include <webots/Robot.hpp>
    #include <algorithm>
    #include <deque>
    #include <iomanip>
    #include <iostream>
    #include <list>
    #include <map>
    #include <memory>
    #include <set>
    #include <sstream>
    #include <string>
    #include <unordered_map>
    #include <vector>
    using namespace std;
    struct Shape { virtual ~Shape() { cout << "gone" << endl; } virtual double area() const = 0; };
    struct Named { virtual ~Named() {} string name = "square"; };
    struct Square : Shape, Named { double s; Square(double s) : s(s) {} double area() const override { return s * s; } };
    static vector<int> table = {5, 3, 1, 4};
    int main() {
      webots::Robot robot;
      sort(table.begin(), table.end());
      for (int t : table) cout << t << ' ';
      cout << endl << fixed << setprecision(2) << 3.14159 << setw(5) << 42 << hex << 255 << dec << endl;
      map<int, string> m;
      for (int i = 0; i < 40; i++) m[(i * 17) % 40] = to_string(i);
      for (int i = 0; i < 40; i += 2) m.erase(i);
      int in_order = 1, last = -1;
      for (auto& e : m) { if (e.first <= last) in_order = 0; last = e.first; }
      for (auto it = m.rbegin(); it != m.rend(); ++it) { if (it->first > last) in_order = 0; last = it->first; }
      cout << m.size() << ' ' << in_order << ' ' << m[17] << endl;
      unordered_map<string, int> u;
      for (int i = 0; i < 100; i++) u["k" + to_string(i)] = i;
      cout << u.size() << ' ' << u["k77"] << endl;
      unique_ptr<Shape> shape(new Square(1.5));
      cout << shape->area() << ' ' << dynamic_cast<Named*>(shape.get())->name << endl;
      shape.reset();
      list<int> l = {3, 1, 2}; l.sort(); l.reverse();
      for (int x : l) cout << x;
      deque<double> d; d.push_front(1); d.push_back(2.5);
      cout << ' ' << d.size() << d.back() << endl;
      stringstream ss("12 2.5 word"); int a; double b; string w; ss >> a >> b >> w;
      cout << a + 1 << ' ' << b * 2 << ' ' << w << (ss >> a ? "" : " end") << endl;
      int* many = new int[300]; many[299] = 7; cout << many[299] + (int)(&many[299] - many) << endl; delete[] many;
      return 0;
    })");
  run_for(3.0);
  EXPECT_EQ(r.console(),
            (std::vector<std::string>{"1 3 4 5 ", "3.14   42ff", "20 1 1", "100 77", "2.25 square", "gone",
                                      "321 22.50", "13 5.00 word end", "306"}));
  expect_no_traps();
}

// programs include all of the library for convenience; the heap and classes' tables are known to the checks
TEST_F(WebotsCxx, cpp_runs_with_all_headers_and_with_the_checks_of_sanitize) {
  options.sanitize = true;
  Robot& r = add("sanitized", "sanitized.cpp", R"(
    #include <bits/stdc++.h>
    #include <webots/Robot.hpp>
    using namespace std;
    int main() {
      webots::Robot robot;
      vector<string> words = {"one", "two"};
      words.push_back("a word that is too long for a string's own place");
      cout << accumulate(words.begin(), words.end(), string()).size() << endl;
      return 0;
    })");
  run_for(1.0);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"54"}));
  expect_no_traps();
}

TEST_F(WebotsCxx, what_would_be_an_exception_is_a_trap_that_names_it) {
  Robot& r = add("throws", "throws.cpp", R"(
    #include <webots/Robot.hpp>
    #include <vector>
    int main() { std::vector<int> v(3); return v.at(5); })");
  run_for(0.1);
  ASSERT_EQ(r.traps().size(), 1u);
  EXPECT_NE(r.traps()[0].message.find("std::out_of_range"), std::string::npos) << r.traps()[0].message;
}

TEST_F(WebotsCxx, folders_in_other_languages_are_told_what_is_missing) {
  for (const auto& [file, source, word] :
       {std::tuple{"a.py", "from controller import Robot\n", "Python controllers are not run yet"},
        std::tuple{"a.cpp", "int main() { return 0; }\n", "firmware on the e-puck's library is C"}}) {
    const fs::path folder = fresh_folder("language");
    std::ofstream(folder / file) << source;
    cc::BuildOptions options;
    options.source_dir = folder;
    options.output = folder / "a.so";
    const cc::BuildResult result = cc::build_image(options);
    ASSERT_EQ(result.errors.size(), 1u);
    EXPECT_NE(result.errors[0].find(word), std::string::npos) << result.errors[0];
  }
}

// --- files

constexpr const char* kFiles = R"(
    #include <stdio.h>
    #include <webots/robot.h>
    int values, outside[3], sum; char line[20];
    int main() {
      float a, b;
      FILE* in = fopen("weights.txt", "r");
      FILE* out = fopen("sub/log.csv", "w");
      while (in && fscanf(in, "%f,%f", &a, &b) == 2) values++, sum += (int)(a + b);
      if (in) { rewind(in); fgets(line, 20, in); fclose(in); }
      wb_robot_init();
      fprintf(out, "%d values, %s\n", values, wb_robot_get_name());
      fclose(out);
      outside[0] = fopen("../escape.txt", "w") != 0;
      outside[1] = fopen("/tmp/escape.txt", "w") != 0;
      outside[2] = fopen("link/escape.txt", "w") != 0;
      in = fopen("weights.txt", "w");
      if (in) { fputs("changed", in); fclose(in); }
      return 0;
    })";

TEST_F(WebotsCxx, files_are_read_from_the_controllers_folder_and_written_to_the_robots_own) {
  const fs::path run = fresh_folder("run");
  options.files_folder = run.string();
  Robot& r = add("files", "files.c", kFiles);
  std::ofstream(source_ / "weights.txt") << "1.5,2.5\n-3,4e1\n";
  run_for(0.6);
  EXPECT_EQ(r.variable("values"), 2);
  EXPECT_EQ(r.variable("sum"), 41);
  EXPECT_EQ(text_of(run / "puck" / "sub" / "log.csv"), "2 values, puck\n");
  EXPECT_EQ(text_of(run / "puck" / "weights.txt"), "changed");
  EXPECT_EQ(text_of(source_ / "weights.txt"), "1.5,2.5\n-3,4e1\n")
      << "the controller's folder was written to";
}

TEST_F(WebotsCxx, files_outside_of_the_robots_folder_cannot_be_opened) {
  const fs::path run = fresh_folder("confined"), elsewhere = fresh_folder("elsewhere");
  fs::create_directories(run / "puck");
  fs::create_directory_symlink(elsewhere, run / "puck" / "link");
  options.files_folder = run.string();
  Robot& r = add("files", "files.c", kFiles);
  run_for(0.6);
  EXPECT_EQ(r.variables("outside", 3), (std::vector<std::int16_t>{0, 0, 0}));
  EXPECT_FALSE(fs::exists(run / "escape.txt"));
  EXPECT_TRUE(fs::is_empty(elsewhere)) << "a link leads out of the folder";
  ASSERT_EQ(r.console().size(), 3u);
  EXPECT_NE(r.console()[0].find("fopen(\"../escape.txt\"): got a path outside of the robot's folder"),
            std::string::npos)
      << r.console()[0];
}

TEST_F(WebotsCxx, streams_of_files_read_and_write) {
  const fs::path run = fresh_folder("streams");
  options.files_folder = run.string();
  Robot& r = add("fstream", "fstream.cpp", R"(
    #include <webots/Robot.hpp>
    #include <fstream>
    #include <iostream>
    #include <string>
    using namespace std;
    int main() {
      webots::Robot robot;
      { ofstream out("a.txt"); out << "one two" << endl << 3.5 << " 4" << endl; }
      { ofstream more("a.txt", ios::app); more << "end"; }
      ifstream in("a.txt");
      string line; getline(in, line);
      double x, y; in >> x >> y;
      cout << line << '|' << x + y << endl;
      while (getline(in, line)) if (!line.empty()) cout << line << endl;
      ifstream none("none.txt");
      cout << none.is_open() << !none << endl;
    })");
  run_for(0.6);
  EXPECT_EQ(r.console(), (std::vector<std::string>{"one two|7.5", "end", "01"}));
  EXPECT_EQ(text_of(run / "puck" / "a.txt"), "one two\n3.5 4\nend");
}

// --- keyboard and display

TEST_F(WebotsCxx, keys_of_the_keyboard_are_there_while_they_are_down) {
  Robot& r = add("keys", "keys.c", R"(
    #include <webots/keyboard.h>
    #include <webots/robot.h>
    int ups, both, other;
    int main() {
      wb_robot_init();
      wb_keyboard_enable(64);
      while (wb_robot_step(64) != -1) {
        int first = wb_keyboard_get_key(), second = first < 0 ? -1 : wb_keyboard_get_key();
        if (first == WB_KEYBOARD_UP && second == -1) ups++;
        else if (first == WB_KEYBOARD_UP && second == 'W') both++;
        else if (first != -1) other++;
      }
    })");
  sim::KeyDesc up, w;
  up.typed = 315, up.at_s = 1, up.hold_s = 1;
  w.typed = 'W', w.at_s = 1.5, w.hold_s = 0.5;
  r.settings().keys = {up, w};
  run_for(3);
  EXPECT_NEAR(r.variable("ups"), 8, 1);
  EXPECT_NEAR(r.variable("both"), 8, 1);
  EXPECT_EQ(r.variable("other"), 0);
}

TEST_F(WebotsCxx, a_display_is_drawn_on_and_saved_as_a_picture) {
  const fs::path run = fresh_folder("display_run");
  options.files_folder = run.string();
  Robot& r = add("display", "display.c", R"(
    #include <webots/display.h>
    #include <webots/robot.h>
    int width, height;
    int main() {
      WbDeviceTag d;
      WbImageRef part;
      wb_robot_init();
      d = wb_robot_get_device("screen");
      width = wb_display_get_width(d), height = wb_display_get_height(d);
      wb_display_set_color(d, 0xFF8000);
      wb_display_fill_rectangle(d, 2, 1, 3, 2);
      wb_display_set_color(d, 0x0000FF);
      wb_display_draw_pixel(d, 0, 0);
      part = wb_display_image_copy(d, 0, 0, 6, 4);
      wb_display_image_save(d, part, "part.png");
      wb_display_image_delete(d, part);
      wb_display_image_save(d, 0, "../outside.png");
      return 0;
    })");
  r.settings().devices.push_back({});
  r.settings().devices.back().name = "screen";
  r.settings().devices.back().kind = sim::DeviceKind::Display;
  r.settings().devices.back().width = 200;
  run_for(0.6);
  EXPECT_EQ(r.variable("width"), 200);
  EXPECT_EQ(r.variable("height"), 64);
  EXPECT_EQ(text_of(run / "puck" / "part.png").substr(1, 3), "PNG");
  EXPECT_FALSE(fs::exists(run / "outside.png"));
  EXPECT_EQ(r.console().size(), 1u) << "the picture outside is refused with a line";
}

}  // namespace
