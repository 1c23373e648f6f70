/* SPDX-License-Identifier: MIT
 * Soccer: shows every player where things are, sees goals, keeps the score and shows it in pictures, and begins anew
 * after each: players at their places, the ball in the middle. A ball that nobody gets away from where it lies is put
 * somewhere else. Players are robots of the e-puck's own library: it writes their variables, as a camera above the
 * field would tell them.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include <webots/robot.h>
#include <webots/supervisor.h>

/* S16 of the lab: a copy of this program lets the ball fall from another height */
#ifndef KICK_OFF_M
#define KICK_OFF_M 0.0 /* m above the floor, where a kick-off puts the ball */
#endif

#define LOOK_MS 32
#define GOAL_LINE_M 0.75  /* a ball whose middle is beyond is in the goal */
#define GOAL_WIDTH_M 0.36
#define PAUSE_MS 2000     /* between a goal and the next kick-off */
#define DEAD_S 8          /* without the ball moving by DEAD_M */
#define DEAD_M 0.05
#define TEAM 3            /* players; the first three of the world shoot at the goal in the east */
#define PLAYERS (2 * TEAM)

enum { MY_X, MY_Y, MY_HEADING, BALL_X, BALL_Y, GOAL_X, NEAREST, PLAYING, VARIABLES };
static const char *const kVariables[VARIABLES] = {"my_x",   "my_y",   "my_heading", "ball_x",
                                                  "ball_y", "goal_x", "nearest",    "playing"};

struct player {
  WbNodeRef node;
  WbFieldRef translation, rotation;
  WbFieldRef variables[VARIABLES];
  double place[3], turn[4]; /* where it began */
};

static struct player players[PLAYERS];
static WbNodeRef ball;
static WbFieldRef ball_translation;
static double ball_rests_m; /* its middle above the floor */
static int blue, yellow;

static double millimetres(double metres) { return floor(1000 * metres + 0.5); }

static int find_everything(void) {
  static const char *const kNames[PLAYERS] = {"blue0", "blue1", "blue2", "yellow0", "yellow1", "yellow2"};
  int p, v, i;
  ball = wb_supervisor_node_get_from_def("BALL");
  if (!ball) return 0;
  ball_translation = wb_supervisor_node_get_field(ball, "translation");
  ball_rests_m = wb_supervisor_field_get_sf_vec3f(ball_translation)[2];
  for (p = 0; p < PLAYERS; p++) {
    struct player *me = &players[p];
    me->node = wb_supervisor_node_get_from_def(kNames[p]);
    if (!me->node) return 0;
    me->translation = wb_supervisor_node_get_field(me->node, "translation");
    me->rotation = wb_supervisor_node_get_field(me->node, "rotation");
    for (i = 0; i < 3; i++) me->place[i] = wb_supervisor_field_get_sf_vec3f(me->translation)[i];
    for (i = 0; i < 4; i++) me->turn[i] = wb_supervisor_field_get_sf_rotation(me->rotation)[i];
    for (v = 0; v < VARIABLES; v++) {
      char name[32];
      snprintf(name, sizeof name, "variable:%s", kVariables[v]);
      me->variables[v] = wb_supervisor_node_get_field(me->node, name);
    }
  }
  return 1;
}

static double way_to(int number, const double *to) {
  const double *p = wb_supervisor_field_get_sf_vec3f(players[number].translation);
  /* who stands behind the ball is nearer than who must go round it */
  double around = (number < TEAM ? p[0] > to[0] : p[0] < to[0]) ? 0.15 : 0;
  return hypot(p[0] - to[0], p[1] - to[1]) + around;
}

static void tell(int playing) {
  static int goes[2] = {1, TEAM + 1}; /* one attacker of a team goes for the ball */
  double at[2];
  int team, number, v;
  at[0] = wb_supervisor_field_get_sf_vec3f(ball_translation)[0];
  at[1] = wb_supervisor_field_get_sf_vec3f(ball_translation)[1];
  for (team = 0; team < 2; team++) {
    /* the other takes over once it is clearly nearer */
    int other = goes[team] % TEAM == 1 ? goes[team] + 1 : goes[team] - 1;
    if (way_to(other, at) < way_to(goes[team], at) - 0.05) goes[team] = other;
  }
  for (number = 0; number < PLAYERS; number++) {
    const struct player *me = &players[number];
    const double *p = wb_supervisor_field_get_sf_vec3f(me->translation);
    const double *r = wb_supervisor_field_get_sf_rotation(me->rotation);
    double heading = remainder(r[2] < 0 ? -r[3] : r[3], 2 * acos(-1));
    double values[VARIABLES];
    values[MY_X] = millimetres(p[0]), values[MY_Y] = millimetres(p[1]);
    values[MY_HEADING] = floor(1000 * heading + 0.5);
    values[BALL_X] = millimetres(at[0]), values[BALL_Y] = millimetres(at[1]);
    values[GOAL_X] = (number < TEAM ? 1 : -1) * millimetres(GOAL_LINE_M);
    values[NEAREST] = number == goes[number / TEAM];
    values[PLAYING] = playing;
    for (v = 0; v < VARIABLES; v++) wb_supervisor_field_set_sf_float(me->variables[v], values[v]);
  }
}

static void show_score(void) {
  char text[64];
  int seconds = (int)wb_robot_get_time();
  snprintf(text, sizeof text, "blue %d : %d yellow", blue, yellow);
  wb_supervisor_set_label(0, text, 0.36, 0.01, 0.05, 0x202020, 0, "Arial");
  snprintf(text, sizeof text, "%02d:%02d", seconds / 60, seconds % 60);
  wb_supervisor_set_label(1, text, 0.88, 0.01, 0.05, 0x202020, 0, "Arial");
}

static void put_ball(double x, double y) {
  double to[3];
  to[0] = x, to[1] = y, to[2] = ball_rests_m + KICK_OFF_M;
  wb_supervisor_field_set_sf_vec3f(ball_translation, to);
  wb_supervisor_node_reset_physics(ball);
}

static void kick_off(void) {
  int number;
  for (number = 0; number < PLAYERS; number++) {
    wb_supervisor_field_set_sf_vec3f(players[number].translation, players[number].place);
    wb_supervisor_field_set_sf_rotation(players[number].rotation, players[number].turn);
    wb_supervisor_node_reset_physics(players[number].node);
  }
  put_ball(0, 0);
}

/* -1 to 1 */
static double chance(void) { return 2.0 * rand() / RAND_MAX - 1; }

int main(void) {
  double lies[2] = {0, 0}, since = 0;
  wb_robot_init();
  if (!find_everything()) {
    fprintf(stderr, "soccer: expected a BALL and players blue0 to yellow2\n");
    return 1;
  }
  srand((unsigned int)time(NULL)); /* simulated, so each seed of the world has its own match */
  show_score();
  kick_off();
  while (wb_robot_step(LOOK_MS) != -1) {
    const double *at = wb_supervisor_field_get_sf_vec3f(ball_translation);
    double x = at[0], y = at[1];
    show_score();
    if (fabs(x) > GOAL_LINE_M && fabs(y) < GOAL_WIDTH_M / 2) {
      if (x > 0)
        blue++;
      else
        yellow++;
      show_score();
      printf("goal for %s, %d : %d\n", x > 0 ? "blue" : "yellow", blue, yellow);
      tell(0);
      if (wb_robot_step(PAUSE_MS) == -1) break;
      kick_off();
      since = wb_robot_get_time();
    }
    if (hypot(x - lies[0], y - lies[1]) > DEAD_M) {
      lies[0] = x, lies[1] = y;
      since = wb_robot_get_time();
    } else if (wb_robot_get_time() - since > DEAD_S) {
      printf("dropped ball, it lay at (%.2f, %.2f)\n", x, y);
      put_ball(0.4 * chance(), 0.3 * chance()); /* so that one team is nearer */
      since = wb_robot_get_time();
    }
    tell(1);
  }
  show_score();
  printf("final score: blue %d : %d yellow\n", blue, yellow);
  wb_robot_cleanup();
  return 0;
}
