/* SPDX-License-Identifier: MIT
 * Accelerometer and gyroscope, by either interface.
 *
 * The accelerometer is read as the mean of five samples around the nominal zero of 2048 counts, 768 counts for 1 g
 * [lib: a_d/advance_ad_scan/e_acc.h]; on revision 1.3 the library scales to the same. Robots differ by some
 * counts, which a program may calibrate away.
 */
#include <math.h>

#include "a_d/advance_ad_scan/e_acc.h"
#include "acc_gyro/e_lsm330.h"
#include "core.h"
#include "device/accelerometer.h"
#include "device/gyro.h"
#include "webots/accelerometer.h"
#include "webots/gyro.h"

#define ZERO_COUNTS 2048
#define SAMPLES 5
#define GYRO_SCALE 7509.9f /* per rad/s [Webots: E-puck.proto, lookup table of the gyroscope] */
#define RAD_PER_DEG (WEBOTS_PI / 180)

static float acceleration[3], rates[3];
static const float kNone[3] = {NAN, NAN, NAN};
static const float kZeros[3] = {0, 0, 0};

static void sample_acceleration(struct webots_device* device) {
  float m_s2[3]; /* left, forward, up */
  unsigned int axis;
  (void)device;
  for (axis = 0; axis < 3; axis++)
    m_s2[axis] = (float)(e_get_acc_filtered(axis, SAMPLES) - ZERO_COUNTS) * (WEBOTS_G_M_S2 / GRAVITY);
  webots_robot_axes(m_s2[1], m_s2[0], m_s2[2], acceleration);
}

static void sample_rates(struct webots_device* device) {
  int x, y, z; /* forward, left, up */
  float scale = RAD_PER_DEG * GYRO_SCALE;
  (void)device;
  getAllAxesGyro(&x, &y, &z);
  webots_robot_axes(rawToDps(x) * scale, rawToDps(y) * scale, rawToDps(z) * scale, rates);
}

static struct webots_device* accelerometer(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_ACCELEROMETER, function);
}
static struct webots_device* gyro(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_GYRO, function);
}

void wb_accelerometer_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = accelerometer(tag, "wb_accelerometer_enable");
  if (d) webots_enable(d, sampling_period, sample_acceleration);
}
void wb_accelerometer_disable(WbDeviceTag tag) { wb_accelerometer_enable(tag, 0); }
int wb_accelerometer_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = accelerometer(tag, "wb_accelerometer_get_sampling_period");
  return d ? d->period : 0;
}
const double* wb_accelerometer_get_values(WbDeviceTag tag) {
  const struct webots_device* d = accelerometer(tag, "wb_accelerometer_get_values");
  return (const double*)(d && d->fresh ? acceleration : kNone);
}
int wb_accelerometer_get_lookup_table_size(WbDeviceTag tag) { return (void)tag, 0; }
const double* wb_accelerometer_get_lookup_table(WbDeviceTag tag) { return (void)tag, (const double*)0; }

void accelerometer_enable(DeviceTag tag, int ms) {
  struct webots_device* d = accelerometer(tag, "accelerometer_enable");
  if (d) webots_enable(d, ms, sample_acceleration);
}
void accelerometer_disable(DeviceTag tag) { accelerometer_enable(tag, 0); }
const float* accelerometer_get_values(DeviceTag tag) {
  const struct webots_device* d = accelerometer(tag, "accelerometer_get_values");
  return d && d->fresh ? acceleration : kZeros;
}

void wb_gyro_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = gyro(tag, "wb_gyro_enable");
  if (d) webots_enable(d, sampling_period, sample_rates);
}
void wb_gyro_disable(WbDeviceTag tag) { wb_gyro_enable(tag, 0); }
int wb_gyro_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = gyro(tag, "wb_gyro_get_sampling_period");
  return d ? d->period : 0;
}
const double* wb_gyro_get_values(WbDeviceTag tag) {
  const struct webots_device* d = gyro(tag, "wb_gyro_get_values");
  return (const double*)(d && d->fresh ? rates : kNone);
}
int wb_gyro_get_lookup_table_size(WbDeviceTag tag) { return (void)tag, 0; }
const double* wb_gyro_get_lookup_table(WbDeviceTag tag) { return (void)tag, (const double*)0; }

void gyro_enable(DeviceTag tag, int ms) {
  struct webots_device* d = gyro(tag, "gyro_enable");
  if (d) webots_enable(d, ms, sample_rates);
}
void gyro_disable(DeviceTag tag) { gyro_enable(tag, 0); }
const float* gyro_get_values(DeviceTag tag) {
  const struct webots_device* d = gyro(tag, "gyro_get_values");
  return d && d->fresh ? rates : kZeros;
}
