/* SPDX-License-Identifier: MIT
 * The interface of 2005 to 2008: devices, over the present one. Values are floats or whole numbers, 0 before the
 * first sample.
 */
#include <math.h>
#include <string.h>

#include "programs/controller/c/library.h"

/* whole numbers of 16 bits */
static unsigned short counts(double value) {
  if (isnan(value) || value < 0) return 0;
  return value > 65535 ? 65535 : (unsigned short)value;
}

#define OLD_SENSOR(name)                                                  \
  void name##_enable(DeviceTag tag, int ms) { wb_##name##_enable(tag, ms); } \
  void name##_disable(DeviceTag tag) { wb_##name##_disable(tag); }
#define OLD_VALUE(name) \
  unsigned short name##_get_value(DeviceTag tag) { return counts(wb_##name##_get_value(tag)); }
#define OLD_VALUES(name, KIND) \
  const float* name##_get_values(DeviceTag tag) { return device_floats(device_of(tag, KIND, #name "_get_values")); }

OLD_SENSOR(distance_sensor)
OLD_VALUE(distance_sensor)
OLD_SENSOR(light_sensor)
OLD_VALUE(light_sensor)
OLD_SENSOR(touch_sensor)
OLD_VALUE(touch_sensor)
OLD_SENSOR(accelerometer)
OLD_VALUES(accelerometer, WB_NODE_ACCELEROMETER)
OLD_SENSOR(gyro)
OLD_VALUES(gyro, WB_NODE_GYRO)
OLD_SENSOR(compass)
OLD_VALUES(compass, WB_NODE_COMPASS)
OLD_SENSOR(camera)
OLD_SENSOR(microphone)
OLD_SENSOR(receiver)

/* --- gps: its matrix needs the heading, which the simulator tells behind position and speed */

OLD_VALUES(gps, WB_NODE_GPS)
void gps_enable(DeviceTag tag, int ms) { wb_gps_enable(tag, ms); }
void gps_disable(DeviceTag tag) { wb_gps_disable(tag); }

const float* gps_get_matrix(DeviceTag tag) {
  static float matrix[16];
  const struct device* d = device_of(tag, WB_NODE_GPS, "gps_get_matrix");
  double angle, c, s;
  memset(matrix, 0, sizeof matrix);
  if (!d || !d->fresh) return matrix;
  angle = d->count > 6 ? d->values[6] : 0;
  c = cos(angle), s = sin(angle);
  matrix[0] = (float)c, matrix[15] = 1;
  if (session.nue) {
    matrix[2] = (float)-s, matrix[5] = 1, matrix[8] = (float)s, matrix[10] = (float)c;
  } else {
    matrix[1] = (float)s, matrix[4] = (float)-s, matrix[5] = (float)c, matrix[10] = 1;
  }
  memcpy(matrix + 12, d->floats, 3 * sizeof(float));
  return matrix;
}

void gps_euler(const float* of, float* angles) {
  angles[0] = angles[1] = angles[2] = 0;
  if (session.nue)
    angles[1] = atan2f(of[8], of[0]);
  else
    angles[2] = atan2f(of[1], of[0]);
}

/* --- the others */

void led_set(DeviceTag tag, long value) { wb_led_set(tag, value); }

unsigned char* camera_get_image(DeviceTag tag) { return (unsigned char*)wb_camera_get_image(tag); }
int camera_get_width(DeviceTag tag) { return wb_camera_get_width(tag); }
int camera_get_height(DeviceTag tag) { return wb_camera_get_height(tag); }
float camera_get_fov(DeviceTag tag) { return (float)wb_camera_get_fov(tag); }
void camera_move_window(DeviceTag tag, int x, int y) { (void)tag, (void)x, (void)y; }

const void* microphone_get_sample_data(DeviceTag tag) { return wb_microphone_get_sample_data(tag); }
int microphone_get_sample_size(DeviceTag tag) { return wb_microphone_get_sample_size(tag); }
void speaker_emit_sample(DeviceTag tag, const void* data, int size) {
  (void)data, (void)size;
  if (device_of(tag, WB_NODE_SPEAKER, "speaker_emit_sample"))
    WARN("speaker_emit_sample(): the e-puck plays sounds of files and its own, not samples");
}

void differential_wheels_set_speed(int left, int right) { wb_differential_wheels_set_speed(left, right); }
void differential_wheels_enable_encoders(int ms) { wb_differential_wheels_enable_encoders(ms); }
void differential_wheels_disable_encoders(void) { wb_differential_wheels_disable_encoders(); }
int differential_wheels_get_left_encoder(void) { return (int)wb_differential_wheels_get_left_encoder(); }
int differential_wheels_get_right_encoder(void) { return (int)wb_differential_wheels_get_right_encoder(); }
void differential_wheels_set_encoders(int left, int right) { wb_differential_wheels_set_encoders(left, right); }

int emitter_send_packet(DeviceTag tag, const void* data, int size) { return wb_emitter_send(tag, data, size); }
void emitter_set_channel(DeviceTag tag, int channel) { wb_emitter_set_channel(tag, channel); }
int emitter_get_channel(DeviceTag tag) { return wb_emitter_get_channel(tag); }
void emitter_set_range(DeviceTag tag, float range) { wb_emitter_set_range(tag, (double)range); }
float emitter_get_range(DeviceTag tag) { return (float)wb_emitter_get_range(tag); }

/* before 5.1.10: one buffer, which every program has once */
static char old_buffer[1024];
void* emitter_get_buffer(DeviceTag tag) {
  return device_of(tag, WB_NODE_EMITTER, "emitter_get_buffer") ? old_buffer : 0;
}
int emitter_send(DeviceTag tag, int size) {
  if (size < 0 || size > (int)sizeof old_buffer) {
    WARN("emitter_send(): got %d bytes, expected at most %zu", size, sizeof old_buffer);
    return 0;
  }
  return wb_emitter_send(tag, old_buffer, size);
}

int receiver_get_queue_length(DeviceTag tag) { return wb_receiver_get_queue_length(tag); }
void receiver_next_packet(DeviceTag tag) { wb_receiver_next_packet(tag); }
int receiver_get_data_size(DeviceTag tag) { return wb_receiver_get_data_size(tag); }
const void* receiver_get_data(DeviceTag tag) { return wb_receiver_get_data(tag); }
float receiver_get_signal_strength(DeviceTag tag) { return (float)wb_receiver_get_signal_strength(tag); }
const float* receiver_get_emitter_direction(DeviceTag tag) {
  static float direction[3];
  const double* from = wb_receiver_get_emitter_direction(tag);
  int i;
  for (i = 0; i < 3; i++) direction[i] = isnan(from[i]) ? 0 : (float)from[i];
  return direction;
}
void receiver_set_channel(DeviceTag tag, int channel) { wb_receiver_set_channel(tag, channel); }
int receiver_get_channel(DeviceTag tag) { return wb_receiver_get_channel(tag); }
