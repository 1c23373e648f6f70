/* SPDX-License-Identifier: MIT
 * Sensors of numbers: each kind has the same three functions to enable it, and its own names for the values.
 */
#include <math.h>

#include "programs/controller/c/library.h"

#define ONE_VALUE(name)                                                                                          \
  double wb_##name##_get_value(WbDeviceTag tag) {                                                                \
    return device_value(name(tag, "wb_" #name "_get_value"), "wb_" #name "_get_value");                          \
  }
#define SOME_VALUES(name)                                                                                        \
  const double* wb_##name##_get_values(WbDeviceTag tag) {                                                        \
    return device_values(name(tag, "wb_" #name "_get_values"), "wb_" #name "_get_values");                       \
  }
/* of others an empty table is usual: their values are the truth */
static void tell_of_no_table(const struct device* device) {
  static int told;
  if (!told && (device->kind == WB_NODE_DISTANCE_SENSOR || device->kind == WB_NODE_LIGHT_SENSOR))
    warn(&told, "lookup table: got device \"%s\", which has none, expected one that measures distances; 0 rows",
         device->name);
}
/* rows of three behind `first` numbers of DEVICE */
#define LOOKUP_TABLE(name, first)                                                                                \
  int wb_##name##_get_lookup_table_size(WbDeviceTag tag) {                                                       \
    const struct device* d = name(tag, "wb_" #name "_get_lookup_table_size");                                    \
    const int size = d && d->info_count > first ? (d->info_count - first) / 3 : 0;                               \
    if (d && size == 0) tell_of_no_table(d);                                                                     \
    return size;                                                                                                 \
  }                                                                                                              \
  const double* wb_##name##_get_lookup_table(WbDeviceTag tag) {                                                  \
    const struct device* d = name(tag, "wb_" #name "_get_lookup_table");                                         \
    return d && d->info_count > first ? d->info + first : 0;                                                     \
  }

/* numbers of DEVICE of a distance sensor */
enum { DISTANCE_LEAST, DISTANCE_MOST, DISTANCE_APERTURE, DISTANCE_TYPE, DISTANCE_TABLE };

SENSOR(distance_sensor, WB_NODE_DISTANCE_SENSOR)
ONE_VALUE(distance_sensor)
LOOKUP_TABLE(distance_sensor, DISTANCE_TABLE)
double wb_distance_sensor_get_min_value(WbDeviceTag tag) {
  return device_info(distance_sensor(tag, "wb_distance_sensor_get_min_value"), DISTANCE_LEAST, 0);
}
double wb_distance_sensor_get_max_value(WbDeviceTag tag) {
  return device_info(distance_sensor(tag, "wb_distance_sensor_get_max_value"), DISTANCE_MOST, 0);
}
double wb_distance_sensor_get_aperture(WbDeviceTag tag) {
  return device_info(distance_sensor(tag, "wb_distance_sensor_get_aperture"), DISTANCE_APERTURE, 0);
}
WbDistanceSensorType wb_distance_sensor_get_type(WbDeviceTag tag) {
  return (WbDistanceSensorType)device_info(distance_sensor(tag, "wb_distance_sensor_get_type"), DISTANCE_TYPE, 0);
}

SENSOR(light_sensor, WB_NODE_LIGHT_SENSOR)
ONE_VALUE(light_sensor)
LOOKUP_TABLE(light_sensor, 0)

SENSOR(touch_sensor, WB_NODE_TOUCH_SENSOR)
ONE_VALUE(touch_sensor)
SOME_VALUES(touch_sensor)
LOOKUP_TABLE(touch_sensor, 1)
WbTouchSensorType wb_touch_sensor_get_type(WbDeviceTag tag) {
  return (WbTouchSensorType)device_info(touch_sensor(tag, "wb_touch_sensor_get_type"), 0, 0);
}

SENSOR(position_sensor, WB_NODE_POSITION_SENSOR)
ONE_VALUE(position_sensor)
WbJointType wb_position_sensor_get_type(WbDeviceTag tag) {
  (void)position_sensor(tag, "wb_position_sensor_get_type");
  return WB_ROTATIONAL;
}
WbDeviceTag wb_position_sensor_get_motor(WbDeviceTag tag) {
  return (WbDeviceTag)device_info(position_sensor(tag, "wb_position_sensor_get_motor"), 0, 0);
}
WbDeviceTag wb_position_sensor_get_brake(WbDeviceTag tag) {
  (void)position_sensor(tag, "wb_position_sensor_get_brake");
  return 0;
}

SENSOR(accelerometer, WB_NODE_ACCELEROMETER)
SOME_VALUES(accelerometer)
LOOKUP_TABLE(accelerometer, 0)

SENSOR(gyro, WB_NODE_GYRO)
SOME_VALUES(gyro)
LOOKUP_TABLE(gyro, 0)

SENSOR(compass, WB_NODE_COMPASS)
SOME_VALUES(compass)
LOOKUP_TABLE(compass, 0)

SENSOR(altimeter, WB_NODE_ALTIMETER)
ONE_VALUE(altimeter)

/* position, then velocity */
SENSOR(gps, WB_NODE_GPS)
SOME_VALUES(gps)
const double* wb_gps_get_speed_vector(WbDeviceTag tag) {
  const double* values = device_values(gps(tag, "wb_gps_get_speed_vector"), "wb_gps_get_speed_vector");
  return values + 3;
}
double wb_gps_get_speed(WbDeviceTag tag) {
  const double* v = device_values(gps(tag, "wb_gps_get_speed"), "wb_gps_get_speed");
  return sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5]);
}
WbGpsCoordinateSystem wb_gps_get_coordinate_system(WbDeviceTag tag) {
  (void)gps(tag, "wb_gps_get_coordinate_system");
  return WB_GPS_LOCAL_COORDINATE;
}

SENSOR(inertial_unit, WB_NODE_INERTIAL_UNIT)
const double* wb_inertial_unit_get_roll_pitch_yaw(WbDeviceTag tag) {
  return device_values(inertial_unit(tag, "wb_inertial_unit_get_roll_pitch_yaw"), "wb_inertial_unit_get_roll_pitch_yaw");
}
double wb_inertial_unit_get_noise(WbDeviceTag tag) {
  (void)inertial_unit(tag, "wb_inertial_unit_get_noise");
  return 0;
}
/* x, y, z, w: yaw about the upward axis, then pitch, then roll */
const double* wb_inertial_unit_get_quaternion(WbDeviceTag tag) {
  static double q[4];
  struct device* d = inertial_unit(tag, "wb_inertial_unit_get_quaternion");
  const double* v = device_values(d, "wb_inertial_unit_get_quaternion");
  double cr, sr, cp, sp, cy, sy;
  cr = cos(v[0] / 2), sr = sin(v[0] / 2), cp = cos(v[1] / 2), sp = sin(v[1] / 2), cy = cos(v[2] / 2), sy = sin(v[2] / 2);
  q[0] = sr * cp * cy - cr * sp * sy;
  q[1] = cr * sp * cy + sr * cp * sy;
  q[2] = cr * cp * sy - sr * sp * cy;
  q[3] = cr * cp * cy + sr * sp * sy;
  return q;
}
