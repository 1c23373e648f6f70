// SPDX-License-Identifier: MIT
#include "hal_sim/signals/condition.h"

#include "tests/support/firmware_test.h"

namespace {

using signals::Condition;

class ConditionTest : public firmware_test::FirmwareTest {
 protected:
  void SetUp() override {
    add_robot_with_source(
        "int state = 3; int row[2][2] = {{1, -2}, {30, 40}}; struct { int in[2]; } s = {{7, 8}}, *ps = &s; "
        "long far = 100000; int main(void) { for (;;) ++far; }",
        "e-puck")
        .at(0.25, 0.5, 90)
        .selector(5);
    add_robot("", "b.2").at(0.5, 0.5);
  }
  double value(const std::string& text, int robot = 0) {
    return Condition(text, twin(), robot).value(twin());
  }
  std::string refused(const std::string& text, int robot = 0) {
    try {
      Condition(text, twin(), robot);
      return "";
    } catch (const std::runtime_error& e) {
      return e.what();
    }
  }
};

TEST_F(ConditionTest, numbers_and_signs_are_those_of_c) {
  EXPECT_EQ(value("1 + 2 * 3"), 7);
  EXPECT_EQ(value("(1 + 2) * 3"), 9);
  EXPECT_EQ(value("2 ^ 10"), 1024);
  EXPECT_EQ(value("1 < 2 && 2 >= 2"), 1);
  EXPECT_EQ(value("1 > 2 || 3 != 3"), 0);
  EXPECT_EQ(value("!(1 > 2)"), 1);
  EXPECT_EQ(value("! 0 && !0"), 1);
  EXPECT_EQ(value("1e-3 * 1.5E+3"), 1.5);
  EXPECT_EQ(value("0x10 + .5"), 16.5);
  EXPECT_EQ(value("1 > 0 ? 5 : 6"), 5);
  EXPECT_EQ(value("not false and true or false"), 1);
  EXPECT_EQ(value("min(3, 1, 2) + max(4, 5) + abs(-2) + floor(2.7) + mod(7, 4)"), 1 + 5 + 2 + 2 + 3);
  EXPECT_NEAR(value("sin(pi / 2)"), 1, 1e-12);
  EXPECT_FALSE(Condition("0 / 0", twin(), 0).holds(twin()));
}

TEST_F(ConditionTest, names_are_the_robots_own_or_have_a_robot_before_them) {
  EXPECT_EQ(value("x_m"), 0.25);
  EXPECT_EQ(value("e-puck.x_m"), 0.25);  // no difference of two things
  EXPECT_EQ(value("'e-puck'.x_m"), 0.25);
  EXPECT_EQ(value("b.2.x_m - e-puck.x_m"), 0.25);
  EXPECT_EQ(value("\"b.2\".x_m", -1), 0.5);
  EXPECT_EQ(value("x_m", 1), 0.5);
  // wherever in an expression, and not as an end of another name
  EXPECT_EQ(value("1 + e-puck.x_m"), 1.25);
  EXPECT_EQ(value("1+e-puck.x_m*b.2.x_m"), 1.125);
  EXPECT_EQ(value("(e-puck.x_m)"), 0.25);
  EXPECT_EQ(value("-e-puck.x_m < b.2.x_m && !e-puck.led0"), 1);
  EXPECT_EQ(refused("xe-puck.x_m").substr(0, 8), "got 'xe'");
  EXPECT_EQ(value("x_m-y_m"), -0.25);
  EXPECT_EQ(value("selector==5&&!led0"), 1);
  run_for(0.1);
  EXPECT_EQ(value("$state"), 3);
  EXPECT_EQ(value("e-puck.$state == 3 && e-puck.var(state * 2) == 6", -1), 1);
  EXPECT_EQ(value("$far > 100000"), 1);
  EXPECT_EQ(value("$row[1][0] + $row[0][1] == 28 && $s.in[1] > 7"), 1);
  EXPECT_EQ(value("(1+$ps->in[0])*2 + $(row[1][1] - row[(1)][0])"), 16 + 10);
  EXPECT_EQ(refused("$row[1"), "got an open bracket, expected it closed");
  EXPECT_EQ(value("$(state + 1) * 2"), 8);
}

TEST_F(ConditionTest, it_is_looked_at_as_things_stand) {
  Condition later("time_s >= 0.5", twin());
  EXPECT_FALSE(later.holds(twin()));
  run_for(0.5);
  EXPECT_TRUE(later.holds(twin()));
}

TEST_F(ConditionTest, what_is_no_condition_is_told) {
  const auto says = [&](const std::string& text, const std::string& what, int robot = 0) {
    EXPECT_EQ(refused(text, robot), what) << text.substr(0, 20);
  };
  says("", "got nothing, expected a condition such as x_m > 0.2 && led0");
  says("x_m = 3", "got '=', expected == to compare");
  says("x_m & led0", "got '&', expected &&");
  says("x_m > 20mm", "got 'mm' behind a number, expected an operator; units are part of the names");
  says("xm > 0.2",
       "got 'xm', expected a signal; did you mean 'x_m'?; twinpuck list signals names them, $NAME is a "
       "variable of the program");
  says("abz(x_m) > 0.2",
       "got 'abz(', expected a function: abs min max sqrt exp ln log10 sin cos tan asin acos atan atan2 sign "
       "mod hypot floor ceil round; did you mean 'abs'?");
  says("epuck.x_m > 0", "got 'epuck', expected a robot; did you mean 'e-puck'?; the robots are e-puck, b.2");
  says("'epuck'.x_m > 0",
       "got 'epuck', expected a robot; did you mean 'e-puck'?; the robots are e-puck, b.2");
  says("x_m > ",
       "got 'x_m > ', expected a condition such as x_m > 0.2 && led0: unexpected end of expression");
  says("(x_m > 1", "got '(x_m > 1', expected a condition such as x_m > 0.2 && led0: missing parenthesis");
  says("x_m > 1, y_m", "got 'x_m > 1, y_m', expected one condition, without a comma");
  says("x_m y_m",
       "got 'x_m y_m', expected a condition such as x_m > 0.2 && led0: unexpected variable \"y_m\" found");
  says("x_m > 1; 2", "got '; 2', expected a condition of names, numbers and + - * / ^ < > == && || !");
  says("x_m > 0", "got 'x_m' without a robot, expected ROBOT.x_m; the robots are e-puck, b.2", -1);
  says("$", "got '$', expected the name of a signal");
  says("$(state", "got an open bracket, expected it closed");
  says("$nothing == 1", "got 'nothing', expected a variable of the image that is known here");
  says("b.2.$state == 1", "got a variable of a robot that runs no program");
  says(std::string(100, '(') + "1", "got more than 60 brackets within one another");
  says(std::string(5000, '1'), "got a condition of 5000 characters, expected at most 4000");
}

}  // namespace
