/* SPDX-License-Identifier: MIT
 * Sensors of one number, by either interface: distance (ring, ground, virtual), light, touch.
 */
#include <math.h>

#include "I2C/e_I2C_protocol.h"
#include "a_d/advance_ad_scan/e_prox.h"
#include "core.h"
#include "device/distance_sensor.h"
#include "device/light_sensor.h"
#include "device/touch_sensor.h"
#include "webots/distance_sensor.h"
#include "webots/light_sensor.h"
#include "webots/touch_sensor.h"

#define FULL_SCALE 4095
#define GROUND_SCALE 1000 /* [Webots: E-puckGroundSensors.proto, lookup table] */
#define RING_APERTURE_RAD 0.3f
#define GROUND_ADDRESS ((char)0xC0)

static void sample_ring(struct webots_device* device) {
  int counts = e_get_calibrated_prox(device->index);
  device->value = (float)(counts > FULL_SCALE ? FULL_SCALE : counts);
}

/* left, centre, right: two registers each, the high byte first */
static void sample_ground(struct webots_device* device) {
  unsigned int high, low;
  e_i2cp_enable();
  high = (unsigned char)e_i2cp_read(GROUND_ADDRESS, (char)(2 * device->index));
  low = (unsigned char)e_i2cp_read(GROUND_ADDRESS, (char)(2 * device->index + 1));
  e_i2cp_disable();
  device->value = (float)(high << 8 | low);
}

static void sample_light(struct webots_device* device) {
  device->value = (float)e_get_ambient_light(device->index);
}

static void enable_distance(struct webots_device* d, int period) {
  if (d) webots_enable(d, period, d->source == WEBOTS_GROUND ? sample_ground : sample_ring);
}

static struct webots_device* distance(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_DISTANCE_SENSOR, function);
}
static struct webots_device* light(WbDeviceTag tag, const char* function) {
  return webots_device_of(tag, WB_NODE_LIGHT_SENSOR, function);
}

static double value_of(const struct webots_device* d) { return d && d->fresh ? d->value : NAN; }

/* the interface of 2005: whole numbers of 16 bits, 0 before the first */
static unsigned short counts_of(const struct webots_device* d) {
  if (!d || !d->fresh || isnan(d->value) || d->value < 0) return 0;
  return d->value > 65535.0f ? 65535u : (unsigned short)d->value;
}

/* --- distance sensors */

void wb_distance_sensor_enable(WbDeviceTag tag, int sampling_period) {
  enable_distance(distance(tag, "wb_distance_sensor_enable"), sampling_period);
}
void wb_distance_sensor_disable(WbDeviceTag tag) {
  enable_distance(distance(tag, "wb_distance_sensor_disable"), 0);
}
int wb_distance_sensor_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = distance(tag, "wb_distance_sensor_get_sampling_period");
  return d ? d->period : 0;
}
double wb_distance_sensor_get_value(WbDeviceTag tag) {
  return value_of(distance(tag, "wb_distance_sensor_get_value"));
}
double wb_distance_sensor_get_max_value(WbDeviceTag tag) {
  const struct webots_device* d = distance(tag, "wb_distance_sensor_get_max_value");
  return d && d->source == WEBOTS_GROUND ? GROUND_SCALE : FULL_SCALE;
}
double wb_distance_sensor_get_min_value(WbDeviceTag tag) { return (void)tag, 0; }
double wb_distance_sensor_get_aperture(WbDeviceTag tag) {
  const struct webots_device* d = distance(tag, "wb_distance_sensor_get_aperture");
  return d && d->source == WEBOTS_ROBOT ? RING_APERTURE_RAD : 0;
}
WbDistanceSensorType wb_distance_sensor_get_type(WbDeviceTag tag) { return (void)tag, WB_DISTANCE_SENSOR_INFRA_RED; }
int wb_distance_sensor_get_lookup_table_size(WbDeviceTag tag) { return (void)tag, 0; }
const double* wb_distance_sensor_get_lookup_table(WbDeviceTag tag) { return (void)tag, (const double*)0; }

void distance_sensor_enable(DeviceTag tag, int ms) {
  enable_distance(distance(tag, "distance_sensor_enable"), ms);
}
void distance_sensor_disable(DeviceTag tag) { enable_distance(distance(tag, "distance_sensor_disable"), 0); }
unsigned short distance_sensor_get_value(DeviceTag tag) {
  return counts_of(distance(tag, "distance_sensor_get_value"));
}

/* --- light sensors */

void wb_light_sensor_enable(WbDeviceTag tag, int sampling_period) {
  struct webots_device* d = light(tag, "wb_light_sensor_enable");
  if (d) webots_enable(d, sampling_period, sample_light);
}
void wb_light_sensor_disable(WbDeviceTag tag) { wb_light_sensor_enable(tag, 0); }
int wb_light_sensor_get_sampling_period(WbDeviceTag tag) {
  const struct webots_device* d = light(tag, "wb_light_sensor_get_sampling_period");
  return d ? d->period : 0;
}
double wb_light_sensor_get_value(WbDeviceTag tag) { return value_of(light(tag, "wb_light_sensor_get_value")); }
int wb_light_sensor_get_lookup_table_size(WbDeviceTag tag) { return (void)tag, 0; }
const double* wb_light_sensor_get_lookup_table(WbDeviceTag tag) { return (void)tag, (const double*)0; }

void light_sensor_enable(DeviceTag tag, int ms) {
  struct webots_device* d = light(tag, "light_sensor_enable");
  if (d) webots_enable(d, ms, sample_light);
}
void light_sensor_disable(DeviceTag tag) { light_sensor_enable(tag, 0); }
unsigned short light_sensor_get_value(DeviceTag tag) {
  return counts_of(light(tag, "light_sensor_get_value"));
}

/* --- touch sensors */

