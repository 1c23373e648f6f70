/* SPDX-License-Identifier: MIT
 * What no e-puck has here, and no simulation without a window: each function warns of a wrong tag and answers 0.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "programs/controller/c/library.h"

/* what is not here looks at nothing that it is given */
#pragma GCC diagnostic ignored "-Wunused-parameter"

/* --- devices of kinds that the simulator does not have */

#define DO(KIND, function, ...) \
  void function(WbDeviceTag tag, ##__VA_ARGS__) { (void)device_of(tag, KIND, #function); }
#define TELL(KIND, type, otherwise, function, ...) \
  type function(WbDeviceTag tag, ##__VA_ARGS__) { return (void)device_of(tag, KIND, #function), otherwise; }

DO(WB_NODE_BRAKE, wb_brake_set_damping_constant, double damping_constant)
TELL(WB_NODE_BRAKE, WbJointType, WB_ROTATIONAL, wb_brake_get_type)
TELL(WB_NODE_BRAKE, WbDeviceTag, 0, wb_brake_get_motor)
TELL(WB_NODE_BRAKE, WbDeviceTag, 0, wb_brake_get_position_sensor)

DO(WB_NODE_CONNECTOR, wb_connector_enable_presence, int sampling_period)
DO(WB_NODE_CONNECTOR, wb_connector_disable_presence)
TELL(WB_NODE_CONNECTOR, int, 0, wb_connector_get_presence_sampling_period)
TELL(WB_NODE_CONNECTOR, int, 0, wb_connector_get_presence)
TELL(WB_NODE_CONNECTOR, bool, false, wb_connector_is_locked)
DO(WB_NODE_CONNECTOR, wb_connector_lock)
DO(WB_NODE_CONNECTOR, wb_connector_unlock)

DO(WB_NODE_RADAR, wb_radar_enable, int sampling_period)
DO(WB_NODE_RADAR, wb_radar_disable)
TELL(WB_NODE_RADAR, int, 0, wb_radar_get_sampling_period)
TELL(WB_NODE_RADAR, int, 0, wb_radar_get_number_of_targets)
TELL(WB_NODE_RADAR, const WbRadarTarget*, NULL, wb_radar_get_targets)
TELL(WB_NODE_RADAR, double, 0, wb_radar_get_min_range)
TELL(WB_NODE_RADAR, double, 0, wb_radar_get_max_range)
TELL(WB_NODE_RADAR, double, 0, wb_radar_get_horizontal_fov)
TELL(WB_NODE_RADAR, double, 0, wb_radar_get_vertical_fov)

DO(WB_NODE_PEN, wb_pen_write, bool write)
DO(WB_NODE_PEN, wb_pen_set_ink_color, int color, double density)

DO(WB_NODE_VACUUM_GRIPPER, wb_vacuum_gripper_enable_presence, int sampling_period)
DO(WB_NODE_VACUUM_GRIPPER, wb_vacuum_gripper_disable_presence)
TELL(WB_NODE_VACUUM_GRIPPER, int, 0, wb_vacuum_gripper_get_presence_sampling_period)
TELL(WB_NODE_VACUUM_GRIPPER, bool, false, wb_vacuum_gripper_get_presence)
DO(WB_NODE_VACUUM_GRIPPER, wb_vacuum_gripper_turn_on)
DO(WB_NODE_VACUUM_GRIPPER, wb_vacuum_gripper_turn_off)
TELL(WB_NODE_VACUUM_GRIPPER, bool, false, wb_vacuum_gripper_is_on)

DO(WB_NODE_SKIN, wb_skin_set_bone_orientation, int index, const double orientation[4], bool absolute)
DO(WB_NODE_SKIN, wb_skin_set_bone_position, int index, const double position[3], bool absolute)
TELL(WB_NODE_SKIN, int, 0, wb_skin_get_bone_count)
TELL(WB_NODE_SKIN, const char*, "", wb_skin_get_bone_name, int index)
TELL(WB_NODE_SKIN, const double*, NULL, wb_skin_get_bone_orientation, int index, bool absolute)
TELL(WB_NODE_SKIN, const double*, NULL, wb_skin_get_bone_position, int index, bool absolute)

DO(WB_NODE_RADIO, wb_radio_enable, int sampling_period)
DO(WB_NODE_RADIO, wb_radio_disable)
DO(WB_NODE_RADIO, wb_radio_set_address, const char* address)
TELL(WB_NODE_RADIO, const char*, "", wb_radio_get_address)
DO(WB_NODE_RADIO, wb_radio_set_frequency, double hz)
TELL(WB_NODE_RADIO, double, 0, wb_radio_get_frequency)
DO(WB_NODE_RADIO, wb_radio_set_channel, int channel)
TELL(WB_NODE_RADIO, int, 0, wb_radio_get_channel)
DO(WB_NODE_RADIO, wb_radio_set_bitrate, int bits_per_second)
TELL(WB_NODE_RADIO, int, 0, wb_radio_get_bitrate)
DO(WB_NODE_RADIO, wb_radio_set_rx_sensitivity, double dBm)
TELL(WB_NODE_RADIO, double, 0, wb_radio_get_rx_sensitivity)
DO(WB_NODE_RADIO, wb_radio_set_tx_power, double dBm)
TELL(WB_NODE_RADIO, double, 0, wb_radio_get_tx_power)
DO(WB_NODE_RADIO, wb_radio_set_callback, void (*callback)(const WbRadioEvent))
DO(WB_NODE_RADIO, wb_radio_send, const WbRadioMessage message, double delay)

struct message {
  int length;
  char *body, *destination;
};
WbRadioMessage wb_radio_message_new(int length, const char* body, const char* destination) {
  struct message* message = grow(0, sizeof *message);
  message->length = body && length > 0 ? length : 0;
  message->body = copy_text(body, (size_t)message->length);
  message->destination = copy_text(destination, destination ? strlen(destination) : 0);
  return message;
}
void wb_radio_message_delete(WbRadioMessage message) {
  if (!message) return;
  free(((struct message*)message)->body);
  free(((struct message*)message)->destination);
  free(message);
}
const char* wb_radio_message_get_destination(WbRadioMessage message) {
  return message ? ((const struct message*)message)->destination : "";
}
int wb_radio_message_get_length(WbRadioMessage message) { return message ? ((const struct message*)message)->length : 0; }
const char* wb_radio_message_get_body(WbRadioMessage message) {
  return message ? ((const struct message*)message)->body : "";
}
WbDeviceTag wb_radio_event_get_radio(const WbRadioEvent event) { return (void)event, 0; }
char* wb_radio_event_get_data(const WbRadioEvent event) { return (void)event, NULL; }
int wb_radio_event_get_data_size(const WbRadioEvent event) { return (void)event, 0; }
char* wb_radio_event_get_emitter(const WbRadioEvent event) { return (void)event, NULL; }
double wb_radio_event_get_rssi(const WbRadioEvent event) { return (void)event, 0; }

/* --- windows */

void* wb_remote_control_custom_function(void* argument) { return (void)argument, NULL; }
void* wb_robot_window_custom_function(void* argument) { return (void)argument, NULL; }
void wb_robot_wwi_send(const char* data, int size) { (void)data, (void)size; }
void wb_robot_wwi_send_text(const char* text) { (void)text; }
const char* wb_robot_wwi_receive(int* size) {
  if (size) *size = 0;
  return NULL;
}
const char* wb_robot_wwi_receive_text(void) { return NULL; }
void wbu_default_robot_window_configure(void) {}
void wbu_default_robot_window_update(void) {}
void wbu_default_robot_window_set_images_max_size(int max_width, int max_height) { (void)max_width, (void)max_height; }

/* --- the system */

const char* wbu_system_getenv(const char* variable) { return getenv(variable); }
const char* wbu_system_short_path(const char* path) { return path; }
const char* wbu_system_tmpdir(void) {
  const char* folder = getenv("TMPDIR");
  return folder && *folder ? folder : "/tmp";
}
const char* wbu_system_webots_instance_path(bool refresh) { return (void)refresh, wbu_system_tmpdir(); }

const char* wb_gps_convert_to_degrees_minutes_seconds(double decimal_degrees) {
  static char text[64];
  /* whole seconds, which never round up to 60 */
  const double seconds = rint(fabs(decimal_degrees) * 3600), minutes = floor(seconds / 60), degrees = floor(minutes / 60);
  snprintf(text, sizeof text, "%s%.0f\302\260 %.0f' %.0f''", decimal_degrees < 0 ? "-" : "", degrees,
           minutes - 60 * degrees, seconds - 60 * minutes);
  return text;
}
