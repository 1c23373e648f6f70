/* SPDX-License-Identifier: MIT
 * The wheels, by either interface: differential_wheels_* and motor_*, with their encoders.
 *
 * The robot's motors take speeds and count the steps they command, 16 bits. A position is reached by an agenda that
 * sets, every 20 ms, a speed proportional to what is missing (Webots' P of 10 per second) up to the velocity.
 */
#include <math.h>
#include <stdlib.h>

#include "core.h"
#include "device/differential_wheels.h"
#include "motor_led/advance_one_timer/e_agenda.h"
#include "motor_led/advance_one_timer/e_motors.h"
#include "webots/differential_wheels.h"
#include "webots/motor.h"
#include "webots/position_sensor.h"

#define STEPS_PER_RAD (WEBOTS_WHEEL_STEPS / (2 * WEBOTS_PI))
#define USUAL_SPEED_UNIT 0.00628f /* rad/s: 1000 is a turn a second [Webots: e-puck of versions 6 to 8] */
#define WATCH_TICKS 100           /* of 0.1 ms, for one wheel after the other */
#define GAIN 10                   /* steps/s for each step that is missing [Webots: Motor.controlPID] */

struct wheel {
  long steps;       /* since the start */
  int seen;         /* the library's counter at the last look */
  int command;      /* steps/s, what the motor was told */
  float speed;      /* rad/s as asked for, limited */
  float velocity;   /* rad/s, of position control the most */
  float target;     /* rad; infinite: none */
  long target_steps;
  int most;              /* steps/s, of velocity */
  unsigned char is_free; /* there is no target */
};

#define MOST_STEPS_S 1000 /* WEBOTS_MAX_RAD_S */
static struct wheel wheels[2] = {{0, 0, 0, 0, WEBOTS_MAX_RAD_S, 0, 0, MOST_STEPS_S, 0},
                                 {0, 0, 0, 0, WEBOTS_MAX_RAD_S, 0, 0, MOST_STEPS_S, 0}};
static unsigned char watching; /* the agenda runs */
static unsigned char watched;  /* the wheel whose turn it is */

/* repeating a speed would restart the motor's half step: only what changes is told */
static void command(int wheel, int steps_s) {
  if (wheels[wheel].command == steps_s) return;
  wheels[wheel].command = steps_s;
  if (wheel == 0)
    e_set_speed_left(steps_s);
  else
    e_set_speed_right(steps_s);
}

static void count(int wheel) {
  struct wheel* w = &wheels[wheel];
  int now = wheel == 0 ? e_get_steps_left() : e_get_steps_right();
  w->steps += (int)((unsigned int)now - (unsigned int)w->seen);
  w->seen = now;
}

static int to_steps_s(float rad_s) { return (int)(rad_s * STEPS_PER_RAD + (rad_s < 0 ? -0.5f : 0.5f)); }

static void set_velocity(struct wheel* w, float rad_s) {
  w->velocity = rad_s;
  w->most = to_steps_s(fabsf(rad_s));
}

/* integers alone: this runs in an agenda, and the converter's next frame comes within 60 us */
static void approach(int wheel) {
  struct wheel* w = &wheels[wheel];
  long missing;
  int speed, change, tenth;
  if (w->is_free) return;
  missing = w->target_steps - w->steps;
  speed = missing > 200 ? 200 * GAIN : missing < -200 ? -200 * GAIN : (int)missing * GAIN;
  if (speed > w->most) speed = w->most;
  if (speed < -w->most) speed = -w->most;
  if (speed == w->command) return;
  /* near the target each step would bring another speed; a tenth is near enough */
  change = speed > w->command ? speed - w->command : w->command - speed;
  tenth = w->command < 0 ? -w->command : w->command;
  if (speed != 0 && (speed > 0) == (w->command > 0) && change * 10 < tenth) return;
  command(wheel, speed);
}

static void watch(void) {
  watched ^= 1;
  count(watched);
  approach(watched);
}

void webots_wheels_step(void) {
  if (watching) return;
  count(0);
  count(1);
}

long webots_wheel_steps(int wheel) {
  long steps;
  if (watching) e_pause_agenda(watch);
  count(wheel);
  steps = wheels[wheel].steps;
  if (watching) e_restart_agenda(watch);
  return steps;
}

float webots_speed_unit(void) {
  float unit = twin_speed_unit();
  return unit > 0 ? unit : USUAL_SPEED_UNIT;
}

static float limited(float rad_s) {
  return rad_s > WEBOTS_MAX_RAD_S ? WEBOTS_MAX_RAD_S : rad_s < -WEBOTS_MAX_RAD_S ? -WEBOTS_MAX_RAD_S : rad_s;
}

void webots_wheel_speed(int wheel, float rad_s) {
  if (isnan(rad_s)) return; /* of a sensor that had no value yet */
  wheels[wheel].target = INFINITY;
  wheels[wheel].is_free = 1;
  wheels[wheel].speed = limited(rad_s);
  set_velocity(&wheels[wheel], wheels[wheel].speed);
  command(wheel, to_steps_s(wheels[wheel].speed));
}

float webots_wheel_command(int wheel) { return wheels[wheel].speed; }

/* --- differential wheels */

static struct webots_device* encoders; /* null until a program wants them */
static long shown[2], zero[2];         /* steps */

static void sample_encoders(struct webots_device* device) {
  (void)device;
  shown[0] = webots_wheel_steps(0);
  shown[1] = webots_wheel_steps(1);
}

static void enable_encoders(int period) {
  webots_init();
  if (!encoders) encoders = webots_add("", WB_NODE_NO_NODE, 0, WEBOTS_ROBOT);
  if (encoders) webots_enable(encoders, period, sample_encoders);
}

static long encoder(int wheel) { return encoders && encoders->fresh ? shown[wheel] - zero[wheel] : 0; }

static void set_encoder(int wheel, long steps) {
  shown[wheel] = webots_wheel_steps(wheel);
  zero[wheel] = shown[wheel] - steps;
}

static void set_speed(float left, float right) {
  float unit = webots_speed_unit();
  webots_init();
  webots_wheel_speed(0, left * unit);
  webots_wheel_speed(1, right * unit);
}

void wb_differential_wheels_set_speed(double left, double right) { set_speed(left, right); }
double wb_differential_wheels_get_left_speed(void) { return wheels[0].speed / webots_speed_unit(); }
double wb_differential_wheels_get_right_speed(void) { return wheels[1].speed / webots_speed_unit(); }
void wb_differential_wheels_enable_encoders(int sampling_period) { enable_encoders(sampling_period); }
void wb_differential_wheels_disable_encoders(void) { enable_encoders(0); }
int wb_differential_wheels_get_encoders_sampling_period(void) { return encoders ? encoders->period : 0; }
double wb_differential_wheels_get_left_encoder(void) { return encoder(0); }
double wb_differential_wheels_get_right_encoder(void) { return encoder(1); }
void wb_differential_wheels_set_encoders(double left, double right) {
  set_encoder(0, (long)left);
  set_encoder(1, (long)right);
}
double wb_differential_wheels_get_max_speed(void) { return WEBOTS_MAX_RAD_S; }
double wb_differential_wheels_get_speed_unit(void) { return webots_speed_unit(); }

void differential_wheels_set_speed(int left, int right) { set_speed(left, right); }
void differential_wheels_enable_encoders(int ms) { enable_encoders(ms); }
void differential_wheels_disable_encoders(void) { enable_encoders(0); }
int differential_wheels_get_left_encoder(void) { return (int)encoder(0); }
int differential_wheels_get_right_encoder(void) { return (int)encoder(1); }
void differential_wheels_set_encoders(int left, int right) {
  set_encoder(0, left);
  set_encoder(1, right);
}

/* --- motors */

static struct webots_device* motor(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_ROTATIONAL_MOTOR, function);
}

void wb_motor_set_position(WbDeviceTag tag, double position) {
  struct webots_device* d = motor(tag, "wb_motor_set_position");
  struct wheel* w;
  if (!d) return;
  if (isnan(position)) {
    webots_warn("wb_motor_set_position", "got NaN, expected rad");
    return;
  }
  w = &wheels[d->index];
  if (isinf(position)) {
    float velocity = w->velocity;
    webots_wheel_speed(d->index, position > 0 ? velocity : -velocity);
    set_velocity(w, velocity);
    return;
  }
  if (watching) e_pause_agenda(watch);
  w->target = position;
  w->target_steps = (long)(position * STEPS_PER_RAD + (position < 0 ? -0.5f : 0.5f));
  w->is_free = 0;
  if (!watching) {
    watching = 1;
    e_activate_agenda(watch, WATCH_TICKS);
  } else {
    e_restart_agenda(watch);
  }
}

void wb_motor_set_velocity(WbDeviceTag tag, double velocity) {
  struct webots_device* d = motor(tag, "wb_motor_set_velocity");
  struct wheel* w;
  if (!d) return;
  if (isnan(velocity)) {
    webots_warn("wb_motor_set_velocity", "got NaN, expected rad/s");
    return;
  }
  if (fabsf(velocity) > WEBOTS_MAX_RAD_S * 1.001f) {
    static unsigned char told;
    if (!told) webots_warn("wb_motor_set_velocity", "got more than 6.28 rad/s, which is what this wheel can do");
    told = 1;
  }
  w = &wheels[d->index];
  if (isinf(w->target))
    webots_wheel_speed(d->index, velocity);
  else
    set_velocity(w, limited(velocity));
}

/* steppers start at once and hold what they can */
void wb_motor_set_acceleration(WbDeviceTag tag, double acceleration) { (void)tag, (void)acceleration; }
void wb_motor_set_available_torque(WbDeviceTag tag, double torque) { (void)tag, (void)torque; }
void wb_motor_set_available_force(WbDeviceTag tag, double force) { (void)tag, (void)force; }
void wb_motor_set_control_pid(WbDeviceTag tag, double p, double i, double d) {
  (void)tag, (void)p, (void)i, (void)d;
}

double wb_motor_get_target_position(WbDeviceTag tag) {
  struct webots_device* d = motor(tag, "wb_motor_get_target_position");
  return d ? wheels[d->index].target : 0;
}

double wb_motor_get_velocity(WbDeviceTag tag) {
  struct webots_device* d = motor(tag, "wb_motor_get_velocity");
  return d ? wheels[d->index].velocity : 0;
}

double wb_motor_get_max_velocity(WbDeviceTag tag) { return motor(tag, "wb_motor_get_max_velocity") ? WEBOTS_MAX_RAD_S : 0; }
double wb_motor_get_min_position(WbDeviceTag tag) { return (void)tag, 0; }
double wb_motor_get_max_position(WbDeviceTag tag) { return (void)tag, 0; }
double wb_motor_get_acceleration(WbDeviceTag tag) { return (void)tag, -1; }
WbJointType wb_motor_get_type(WbDeviceTag tag) { return (void)tag, WB_ROTATIONAL; }
WbDeviceTag wb_motor_get_brake(WbDeviceTag tag) { return (void)tag, 0; }

WbDeviceTag wb_motor_get_position_sensor(WbDeviceTag tag) {
  struct webots_device* d = motor(tag, "wb_motor_get_position_sensor");
  return d ? webots_tag_of(WB_NODE_POSITION_SENSOR, d->index) : 0;
}

/* --- position sensors */

static struct webots_device* sensor(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_POSITION_SENSOR, function);
}

static void sample_position(struct webots_device* device) {
  device->value = (float)webots_wheel_steps(device->index) / STEPS_PER_RAD;
}

void wb_position_sensor_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = sensor(tag, "wb_position_sensor_enable");
  if (d) webots_enable(d, sampling_period, sample_position);
}
void wb_position_sensor_disable(WbDeviceTag tag) { wb_position_sensor_enable(tag, 0); }
int wb_position_sensor_get_sampling_period(WbDeviceTag tag) {
  struct webots_device* d = sensor(tag, "wb_position_sensor_get_sampling_period");
  return d ? d->period : 0;
}
double wb_position_sensor_get_value(WbDeviceTag tag) {
  struct webots_device* d = sensor(tag, "wb_position_sensor_get_value");
  return d && d->fresh ? d->value : NAN;
}
WbJointType wb_position_sensor_get_type(WbDeviceTag tag) { return (void)tag, WB_ROTATIONAL; }
WbDeviceTag wb_position_sensor_get_brake(WbDeviceTag tag) { return (void)tag, 0; }
WbDeviceTag wb_position_sensor_get_motor(WbDeviceTag tag) {
  struct webots_device* d = sensor(tag, "wb_position_sensor_get_motor");
  return d ? webots_tag_of(WB_NODE_ROTATIONAL_MOTOR, d->index) : 0;
}
