// SPDX-License-Identifier: MIT
// Soccer: shows every player where things are, sees goals, keeps the score and shows it in pictures, and
// begins anew after each: players at their places, the ball 10 cm above the middle, from where it falls and
// bounces. A ball that nobody gets away from where it lies is dropped anew as well.
#include <supervisor.hpp>

#include <cmath>
#include <cstdio>

namespace {

constexpr double kLookS = 0.032;      // s between two looks
constexpr double kGoalLineM = 0.75;   // m: a ball whose middle is beyond is in the goal
constexpr double kGoalWidthM = 0.36;  // m
constexpr double kDropM = 0.10;       // m: height from which the ball falls
constexpr double kPauseS = 2.0;       // s between a goal and the next kick-off
constexpr double kDeadS = 8;          // s without the ball moving kDeadM: it is dropped anew
constexpr double kDeadM = 0.05;       // m
constexpr int kTeam = 3;              // players; the first three of the world shoot at the goal in the east

int blue = 0, yellow = 0;

int millimetres(double metres) { return static_cast<int>(std::lround(1000 * metres)); }

double way_to(int player, const sv::Pose& ball) {
  const sv::Pose p = sv::Robot(player).pose();
  // who stands behind the ball is nearer than who must go round it
  const double around = (player < kTeam ? p.x > ball.x : p.x < ball.x) ? 0.15 : 0;
  return std::hypot(p.x - ball.x, p.y - ball.y) + around;
}

void tell(const sv::Thing& ball, bool playing) {
  const sv::Pose b = ball.pose();
  // one attacker of a team goes for the ball; the other takes over once it is clearly nearer
  static int goes[2] = {1, kTeam + 1};
  for (int& who : goes) {
    const int other = who % kTeam == 1 ? who + 1 : who - 1;
    if (way_to(other, b) < way_to(who, b) - 0.05) who = other;
  }
  for (int number = 0; number < sv_robots(); ++number) {
    sv::Robot player(number);
    const sv::Pose p = player.pose();
    player.set_variable("my_x", millimetres(p.x));
    player.set_variable("my_y", millimetres(p.y));
    player.set_variable("my_heading", 1000 * std::remainder(p.heading, 2 * M_PI));
    player.set_variable("ball_x", millimetres(b.x));
    player.set_variable("ball_y", millimetres(b.y));
    player.set_variable("goal_x", (number < kTeam ? 1 : -1) * millimetres(kGoalLineM));
    player.set_variable("nearest", number == goes[number / kTeam]);
    player.set_variable("playing", playing);
  }
}

void show_score() {
  char text[64];
  std::snprintf(text, sizeof text, "blue %d : %d yellow", blue, yellow);
  sv::label(0, text, 0.36, 0.01, 0.05, 0x202020);
  const int seconds = static_cast<int>(sv::time());
  std::snprintf(text, sizeof text, "%02d:%02d", seconds / 60, seconds % 60);
  sv::label(1, text, 0.88, 0.01, 0.05, 0x202020);
}

void kick_off(sv::Thing& ball) {
  for (int number = 0; number < sv_robots(); ++number) sv::Robot(number).reset();
  ball.put({0, 0, kDropM, 0});
}

// somewhere, so that one team is nearer
void drop(sv::Thing& ball) { ball.put({0.8 * (sv::random() - 0.5), 0.6 * (sv::random() - 0.5), kDropM, 0}); }

}  // namespace

int main() {
  sv::Thing ball("BALL");
  sv::Pose lies = ball.pose();
  double since = 0;
  show_score();
  kick_off(ball);
  while (sv::step(kLookS)) {
    const sv::Pose b = ball.pose();
    show_score();
    if (std::fabs(b.x) > kGoalLineM && std::fabs(b.y) < kGoalWidthM / 2) {
      ++(b.x > 0 ? blue : yellow);
      show_score();
      sv_log("goal for %s, %d : %d", b.x > 0 ? "blue" : "yellow", blue, yellow);
      tell(ball, false);
      if (!sv::step(kPauseS)) break;
      kick_off(ball);
      since = sv::time();
    }
    if (std::hypot(b.x - lies.x, b.y - lies.y) > kDeadM) {
      lies = b;
      since = sv::time();
    } else if (sv::time() - since > kDeadS) {
      sv_log("dropped ball, it lay at (%.2f, %.2f)", b.x, b.y);
      drop(ball);
      since = sv::time();
    }
    tell(ball, true);
  }
  show_score();
  sv_log("final score: blue %d : %d yellow", blue, yellow);
  return 0;
}
