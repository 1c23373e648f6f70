/* SPDX-License-Identifier: MIT
 * GPS, compass and inertial unit, by either interface: the simulator's truth. Empty on the robot.
 */
#ifdef __TWINPUCK_PC__
#include <math.h>

#include "core.h"
#include "device/compass.h"
#include "device/gps.h"
#include "webots/compass.h"
#include "webots/gps.h"
#include "webots/inertial_unit.h"

static float position[3], velocity[3], north[3], attitude[3], matrix[16];
static const float kNone[3] = {NAN, NAN, NAN};
static const float kZeros[16] = {0};

/* roll, pitch and yaw of the flat floor are enough for the old matrix: columns right, up, backward, position; with
   axes of today forward, left, up, position */
static void sample_position(struct webots_device* device) {
  float angles[3], c, s;
  (void)device;
  twin_position(position, velocity);
  twin_attitude(angles);
  c = cosf(angles[2]), s = sinf(angles[2]);
  matrix[0] = c, matrix[15] = 1;
  if (twin_nue()) {
    matrix[2] = -s, matrix[5] = 1, matrix[8] = s, matrix[10] = c;
  } else {
    matrix[1] = s, matrix[4] = -s, matrix[5] = c, matrix[10] = 1;
  }
  matrix[12] = position[0], matrix[13] = position[1], matrix[14] = position[2];
}

static void sample_north(struct webots_device* device) {
  (void)device;
  twin_north(north);
}

static void sample_attitude(struct webots_device* device) {
  (void)device;
  twin_attitude(attitude);
}

static struct webots_device* gps(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_GPS, function);
}
static struct webots_device* compass(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_COMPASS, function);
}
static struct webots_device* inertial(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_INERTIAL_UNIT, function);
}

static const double* three(const struct webots_device* d, const float* values) {
  return (const double*)(d && d->fresh ? values : kNone);
}

void wb_gps_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = gps(tag, "wb_gps_enable");
  if (d) webots_enable(d, sampling_period, sample_position);
}
void wb_gps_disable(WbDeviceTag tag) { wb_gps_enable(tag, 0); }
int wb_gps_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = gps(tag, "wb_gps_get_sampling_period");
  return d ? d->period : 0;
}
const double* wb_gps_get_values(WbDeviceTag tag) { return three(gps(tag, "wb_gps_get_values"), position); }
const double* wb_gps_get_speed_vector(WbDeviceTag tag) {
  return three(gps(tag, "wb_gps_get_speed_vector"), velocity);
}
double wb_gps_get_speed(WbDeviceTag tag) {
  const struct webots_device* d = gps(tag, "wb_gps_get_speed");
  if (!d || !d->fresh) return NAN;
  return sqrtf(velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2]);
}

void gps_enable(DeviceTag tag, int ms) {
  struct webots_device* d = gps(tag, "gps_enable");
  if (d) webots_enable(d, ms, sample_position);
}
void gps_disable(DeviceTag tag) { gps_enable(tag, 0); }
const float* gps_get_values(DeviceTag tag) {
  const struct webots_device* d = gps(tag, "gps_get_values");
  return d && d->fresh ? position : kZeros;
}
const float* gps_get_matrix(DeviceTag tag) {
  const struct webots_device* d = gps(tag, "gps_get_matrix");
  return d && d->fresh ? matrix : kZeros;
}
void gps_euler(const float* of, float* angles) {
  angles[0] = angles[1] = angles[2] = 0;
  if (twin_nue())
    angles[1] = atan2f(of[8], of[0]);
  else
    angles[2] = atan2f(of[1], of[0]);
}

void wb_compass_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = compass(tag, "wb_compass_enable");
  if (d) webots_enable(d, sampling_period, sample_north);
}
void wb_compass_disable(WbDeviceTag tag) { wb_compass_enable(tag, 0); }
int wb_compass_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = compass(tag, "wb_compass_get_sampling_period");
  return d ? d->period : 0;
}
const double* wb_compass_get_values(WbDeviceTag tag) {
  return three(compass(tag, "wb_compass_get_values"), north);
}
int wb_compass_get_lookup_table_size(WbDeviceTag tag) { return (void)tag, 0; }
const double* wb_compass_get_lookup_table(WbDeviceTag tag) { return (void)tag, (const double*)0; }

void compass_enable(DeviceTag tag, int ms) {
  struct webots_device* d = compass(tag, "compass_enable");
  if (d) webots_enable(d, ms, sample_north);
}
void compass_disable(DeviceTag tag) { compass_enable(tag, 0); }
const float* compass_get_values(DeviceTag tag) {
  const struct webots_device* d = compass(tag, "compass_get_values");
  return d && d->fresh ? north : kZeros;
}

void wb_inertial_unit_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = inertial(tag, "wb_inertial_unit_enable");
  if (d) webots_enable(d, sampling_period, sample_attitude);
}
void wb_inertial_unit_disable(WbDeviceTag tag) { wb_inertial_unit_enable(tag, 0); }
int wb_inertial_unit_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = inertial(tag, "wb_inertial_unit_get_sampling_period");
  return d ? d->period : 0;
}
const double* wb_inertial_unit_get_roll_pitch_yaw(WbDeviceTag tag) {
  return three(inertial(tag, "wb_inertial_unit_get_roll_pitch_yaw"), attitude);
}
#endif
