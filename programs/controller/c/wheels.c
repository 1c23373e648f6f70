/* SPDX-License-Identifier: MIT
 * Motors, and both wheels together as versions up to R2018 had them.
 */
#include <math.h>

#include "programs/controller/c/library.h"

#define RAD_S 6.283185307179586 /* of a wheel where nothing else is told: a turn a second */
#define STEPS_PER_RAD (1000 / 6.283185307179586)

/* numbers of DEVICE */
enum { MOTOR_MOST, MOTOR_SENSOR };

/* what a motor was told; made at the first call */
struct motor {
  double velocity, most, target, acceleration;
};

static struct motor* state_of(struct device* d) {
  struct motor* m = d->own;
  if (m) return m;
  d->own = m = grow(0, sizeof *m);
  m->most = device_info(d, MOTOR_MOST, RAD_S);
  m->velocity = m->most;
  m->target = 0;
  m->acceleration = -1;
  return m;
}

static struct device* motor_device(WbDeviceTag tag, const char* function) {
  if (any_device(tag) && any_device(tag)->kind == WB_NODE_LINEAR_MOTOR) return any_device(tag);
  return device_of(tag, WB_NODE_ROTATIONAL_MOTOR, function);
}

static struct motor* motor(WbDeviceTag tag, const char* function) {
  struct device* d = motor_device(tag, function);
  return d ? state_of(d) : 0;
}

static void say(int record, WbDeviceTag tag, double value) {
  struct link_packet* out = command(record);
  link_int(out, tag);
  link_number(out, value);
  command_end();
}

static void set_position(struct device* d, double position) {
  state_of(d)->target = position;
  say(LINK_POSITION, d->tag, position);
}

static void set_velocity(struct device* d, double velocity, const char* function) {
  struct motor* m = state_of(d);
  if (fabs(velocity) > m->most) {
    if (fabs(velocity) > m->most * 1.001)
      WARN("%s(): got %g rad/s for \"%s\", expected at most %g, which is taken", function, velocity, d->name, m->most);
    velocity = velocity < 0 ? -m->most : m->most;
  }
  m->velocity = velocity;
  say(LINK_VELOCITY, d->tag, velocity);
}

void wb_motor_set_position(WbDeviceTag tag, double position) {
  struct device* d = motor_device(tag, "wb_motor_set_position");
  if (!d) return;
  if (isnan(position))
    WARN("wb_motor_set_position(): got NaN, expected rad");
  else
    set_position(d, position);
}

void wb_motor_set_velocity(WbDeviceTag tag, double velocity) {
  struct device* d = motor_device(tag, "wb_motor_set_velocity");
  if (!d) return;
  if (isnan(velocity))
    WARN("wb_motor_set_velocity(): got NaN, expected rad/s");
  else
    set_velocity(d, velocity, "wb_motor_set_velocity");
}

/* steppers start at once and hold what they can */
void wb_motor_set_acceleration(WbDeviceTag tag, double acceleration) {
  struct motor* m = motor(tag, "wb_motor_set_acceleration");
  if (m) m->acceleration = acceleration;
}
static void no_torque(WbDeviceTag tag, const char* function) {
  if (motor(tag, function)) WARN("%s(): the e-puck's wheels are stepper motors, which have no force or torque to set", function);
}
void wb_motor_set_force(WbDeviceTag tag, double force) { (void)force, no_torque(tag, "wb_motor_set_force"); }
void wb_motor_set_torque(WbDeviceTag tag, double torque) { (void)torque, no_torque(tag, "wb_motor_set_torque"); }
void wb_motor_set_available_force(WbDeviceTag tag, double force) { (void)force, (void)motor(tag, "wb_motor_set_available_force"); }
void wb_motor_set_available_torque(WbDeviceTag tag, double torque) { (void)torque, (void)motor(tag, "wb_motor_set_available_torque"); }
void wb_motor_set_control_pid(WbDeviceTag tag, double p, double i, double d) {
  (void)p, (void)i, (void)d, (void)motor(tag, "wb_motor_set_control_pid");
}

double wb_motor_get_target_position(WbDeviceTag tag) {
  const struct motor* m = motor(tag, "wb_motor_get_target_position");
  return m ? m->target : NAN;
}
double wb_motor_get_velocity(WbDeviceTag tag) {
  const struct motor* m = motor(tag, "wb_motor_get_velocity");
  return m ? m->velocity : NAN;
}
double wb_motor_get_max_velocity(WbDeviceTag tag) {
  const struct motor* m = motor(tag, "wb_motor_get_max_velocity");
  return m ? m->most : NAN;
}
double wb_motor_get_acceleration(WbDeviceTag tag) {
  const struct motor* m = motor(tag, "wb_motor_get_acceleration");
  return m ? m->acceleration : NAN;
}

/* limits that there are none of, and forces that steppers do not tell */
static double nothing(WbDeviceTag tag, const char* function) { return motor(tag, function) ? 0 : NAN; }
#define NOTHING_OF_MOTOR(function) \
  double function(WbDeviceTag tag) { return nothing(tag, #function); }
NOTHING_OF_MOTOR(wb_motor_get_min_position)
NOTHING_OF_MOTOR(wb_motor_get_max_position)
NOTHING_OF_MOTOR(wb_motor_get_force_feedback)
NOTHING_OF_MOTOR(wb_motor_get_torque_feedback)
NOTHING_OF_MOTOR(wb_motor_get_available_force)
NOTHING_OF_MOTOR(wb_motor_get_max_force)
NOTHING_OF_MOTOR(wb_motor_get_available_torque)
NOTHING_OF_MOTOR(wb_motor_get_max_torque)
double wb_motor_get_multiplier(WbDeviceTag tag) { return motor(tag, "wb_motor_get_multiplier") ? 1 : NAN; }
void wb_motor_enable_force_feedback(WbDeviceTag tag, int sampling_period) {
  (void)sampling_period, no_torque(tag, "wb_motor_enable_force_feedback");
}
void wb_motor_enable_torque_feedback(WbDeviceTag tag, int sampling_period) {
  (void)sampling_period, no_torque(tag, "wb_motor_enable_torque_feedback");
}
void wb_motor_disable_force_feedback(WbDeviceTag tag) { (void)motor(tag, "wb_motor_disable_force_feedback"); }
void wb_motor_disable_torque_feedback(WbDeviceTag tag) { (void)motor(tag, "wb_motor_disable_torque_feedback"); }
int wb_motor_get_force_feedback_sampling_period(WbDeviceTag tag) {
  return (void)motor(tag, "wb_motor_get_force_feedback_sampling_period"), 0;
}
int wb_motor_get_torque_feedback_sampling_period(WbDeviceTag tag) {
  return (void)motor(tag, "wb_motor_get_torque_feedback_sampling_period"), 0;
}

WbJointType wb_motor_get_type(WbDeviceTag tag) {
  const struct device* d = motor_device(tag, "wb_motor_get_type");
  return d && d->kind == WB_NODE_LINEAR_MOTOR ? WB_LINEAR : WB_ROTATIONAL;
}
WbDeviceTag wb_motor_get_position_sensor(WbDeviceTag tag) {
  return (WbDeviceTag)device_info(motor_device(tag, "wb_motor_get_position_sensor"), MOTOR_SENSOR, 0);
}
WbDeviceTag wb_motor_get_brake(WbDeviceTag tag) {
  (void)motor(tag, "wb_motor_get_brake");
  return 0;
}

/* --- both wheels */

static int encoder_period;
static double encoder_zero[2]; /* steps */

/* left and right; null: a robot without wheels */
static struct device* wheel(int side) {
  static struct device* wheels[2];
  static const char* const kNames[2] = {"left wheel motor", "right wheel motor"};
  if (!wheels[side]) wheels[side] = first_device(WB_NODE_ROTATIONAL_MOTOR, kNames[side]);
  if (!wheels[side]) WARN("differential wheels: this robot has no \"%s\"", kNames[side]);
  return wheels[side];
}

static struct device* encoder(int side) {
  struct device* d = wheel(side);
  return d ? any_device((int64_t)device_info(d, MOTOR_SENSOR, 0)) : 0;
}

static void set_wheel(int side, double units) {
  struct device* d = wheel(side);
  struct motor* m;
  double rad_s = units * session.speed_unit_rad_s;
  if (!d || isnan(rad_s)) return; /* of a sensor that had no value yet */
  m = state_of(d);
  if (rad_s > m->most) rad_s = m->most;
  if (rad_s < -m->most) rad_s = -m->most;
  if (!isinf(m->target)) set_position(d, INFINITY);
  set_velocity(d, rad_s, "wb_differential_wheels_set_speed");
}

void wb_differential_wheels_set_speed(double left, double right) {
  session_ready();
  set_wheel(0, left);
  set_wheel(1, right);
}

static double wheel_speed(int side) {
  struct device* d = wheel(side);
  return d && isinf(state_of(d)->target) ? state_of(d)->velocity / session.speed_unit_rad_s : 0;
}
double wb_differential_wheels_get_left_speed(void) { return wheel_speed(0); }
double wb_differential_wheels_get_right_speed(void) { return wheel_speed(1); }

void wb_differential_wheels_enable_encoders(int sampling_period) {
  encoder_period = sampling_period > 0 ? sampling_period : 0;
  device_enable(encoder(0), encoder_period);
  device_enable(encoder(1), encoder_period);
}
void wb_differential_wheels_disable_encoders(void) { wb_differential_wheels_enable_encoders(0); }
int wb_differential_wheels_get_encoders_sampling_period(void) { return encoder_period; }

/* whole steps since the start; 0 before the first sample */
static double steps(int side) {
  const struct device* d = encoder(side);
  return d && d->fresh ? rint(d->values[0] * STEPS_PER_RAD) : 0;
}
static double encoder_value(int side) {
  const struct device* d = encoder(side);
  return d && d->fresh ? steps(side) - encoder_zero[side] : 0;
}
double wb_differential_wheels_get_left_encoder(void) { return encoder_value(0); }
double wb_differential_wheels_get_right_encoder(void) { return encoder_value(1); }
void wb_differential_wheels_set_encoders(double left, double right) {
  encoder_zero[0] = steps(0) - left;
  encoder_zero[1] = steps(1) - right;
}
double wb_differential_wheels_get_max_speed(void) { return wheel(0) ? state_of(wheel(0))->most : 0; }
double wb_differential_wheels_get_speed_unit(void) {
  session_ready();
  return session.speed_unit_rad_s;
}
