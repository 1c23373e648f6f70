/* SPDX-License-Identifier: MIT
 * Soccer player: gets behind the ball and drives it towards the goal. It is blind for ball and field; a camera
 * above, the supervisor soccer, tells it where everything is by writing the variables below. The selector is its
 * place in the team: 0 keeper, 1 and 2 attackers. Its own sensors keep it off walls and players.
 */
#include <math.h>
#include <stdlib.h>

#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>

#define CONTROL_PERIOD 320 /* agenda ticks of 0.1 ms */
#define FAST 900           /* steps/s */
#define TURN 500           /* steps/s for a radian of error */
#define TOUCH 56           /* mm from middle to middle when the ball touches the robot */
#define NEAR 600           /* counts: about 2 cm */
#define STUCK_PERIODS 12   /* at least so many without a way of 5 mm, up to six times as many by chance */
#define BACK_PERIODS 18
#define REACH 60           /* mm: a keeper leaves its corners open */
#define AIM 130            /* mm: it shoots somewhere between the posts, 180 mm off the middle */

/* what the camera sees, mm and milliradians in the field's frame: the goal to shoot at lies at (goal_x, 0) */
volatile int playing;
volatile int nearest; /* of the two attackers of its team, to the ball */
volatile int my_x, my_y, my_heading;
volatile int ball_x, ball_y;
volatile int goal_x;

static int aim_y;
static volatile int control_due;

static void control_tick(void) { control_due = 1; }

static int clamp(float v, int most) { return v > most ? most : v < -most ? -most : (int)v; }

static float wrap(float angle) {
  while (angle > 3.1416f) angle -= 6.2832f;
  while (angle < -3.1416f) angle += 6.2832f;
  return angle;
}

static void drive(int left, int right) {
  static int last_left, last_right;
  if (left == last_left && right == last_right) return;
  last_left = left;
  last_right = right;
  e_set_speed_left(left);
  e_set_speed_right(right);
}

/* Towards a point, turning on the spot when it lies behind; 0 when it is there. */
static int go_to(float x, float y) {
  float dx = x - my_x, dy = y - my_y;
  float error = wrap(atan2f(dy, dx) - my_heading / 1000.0f);
  float ahead = dx * dx + dy * dy < 900.0f ? 0.3f : 1.0f;
  float forward = error > 1.2f || error < -1.2f ? 0 : FAST * ahead * cosf(error);
  float turn = TURN * error;
  if (dx * dx + dy * dy < 100.0f) {
    drive(0, 0);
    return 0;
  }
  drive(clamp(forward - turn, 1000), clamp(forward + turn, 1000));
  return 1;
}

/* Behind the ball it pushes; elsewhere it goes round. `far`: how far behind it waits. */
static int attack(void) {
  float gx = goal_x - ball_x, gy = aim_y - ball_y;
  float length = sqrtf(gx * gx + gy * gy);
  float rx = my_x - ball_x, ry = my_y - ball_y, along, side;
  if (length < 1.0f) length = 1.0f;
  gx /= length;
  gy /= length;
  along = rx * gx + ry * gy; /* negative: behind */
  side = ry * gx - rx * gy;  /* positive: left of the line of shot */
  if (along < -30.0f && fabsf(side) < 12.0f - 0.25f * along) return go_to(ball_x + 150.0f * gx, ball_y + 150.0f * gy);
  if (along > -TOUCH) {
    /* round the ball, on the side where it is, well clear of it */
    float out = side >= 0 ? 95.0f : -95.0f;
    return go_to(ball_x - 90.0f * gx - out * gy, ball_y - 90.0f * gy + out * gx);
  }
  return go_to(ball_x - 90.0f * gx, ball_y - 90.0f * gy);
}

static int keep(void) {
  float y = ball_y > REACH ? REACH : ball_y < -REACH ? -REACH : ball_y;
  /* a ball that comes near is shot away */
  if (abs(ball_x - my_x) < 120 && abs(ball_y - my_y) < 120) return attack();
  return go_to(goal_x > 0 ? -660 : 660, y);
}

static void control(void) {
  static int still, back, seen_x, seen_y, patience = STUCK_PERIODS;
  int role = getselector() % 3;
  int wants;
  if (!playing) {
    drive(0, 0);
    still = back = 0;
    return;
  }
  e_set_body_led(role == 0);
  if (back > 0) {
    --back;
    drive(role == 1 ? -600 : -450, role == 1 ? -450 : -600);
    return;
  }
  if (role == 0)
    wants = keep();
  else if (nearest)
    wants = attack();
  else /* behind the other, and to one side */
    wants = go_to(ball_x + (goal_x > 0 ? -250 : 250), ball_y * 0.4f + (ball_y > 0 ? -120 : 120));

  /* somebody else in front: the ball itself is lower than the sensors' beam is wide, and to be pushed */
  {
    float bx = ball_x - my_x, by = ball_y - my_y;
    if (bx * bx + by * by > 90.0f * 90.0f) {
      if (e_get_prox(0) + e_get_prox(1) > NEAR)
        drive(-150, 500);
      else if (e_get_prox(7) + e_get_prox(6) > NEAR)
        drive(500, -150);
    }
  }
  /* wheels turn and nothing moves */
  if (!wants || abs(my_x - seen_x) + abs(my_y - seen_y) > 5) {
    seen_x = my_x;
    seen_y = my_y;
    still = 0;
  } else if (++still > patience) {
    /* a duel: who gives way first lets the other push on, so both do it at some time of their own */
    still = 0;
    back = BACK_PERIODS;
    patience = STUCK_PERIODS + rand() % (5 * STUCK_PERIODS);
    aim_y = rand() % (2 * AIM) - AIM;
  }
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    if (!control_due) continue;
    control_due = 0;
    control();
  }
}
