/* SPDX-License-Identifier: MIT
 * The camera, whichever sensor the robot carries: identity, set-up, and calls passed on to the sensor's file. The
 * capture itself is each HAL's own. Source: [lib: camera/fast_2_timer/e_common.c], facts restated.
 */
#include "camera/fast_2_timer/e_poxxxx.h"

#include "I2C/e_I2C_protocol.h"
#include "camera.h"
#include "camera/fast_2_timer/e_po3030k.h"
#include "camera/fast_2_timer/e_po6030k.h"
#include "camera/fast_2_timer/e_po8030d.h"
#include "hal.h"
#include "motor_led/e_init_port.h"
#include "p30F6014A.h"

#define PO3030K 0x3030u
#define PO6030K 0x6030u
#define PO8030D 0x8030u
#define MOUNT_WORD 0xFFFE /* last word of the data EEPROM */
#define UNKNOWN_SENSOR 11 /* answer of config_cam */

static unsigned int camera_version;

unsigned int getCameraVersion();

unsigned int getCameraVersion() { return camera_version; }

/* --- whichever sensor it is */

int e_poxxxx_init_cam(void) {
  unsigned int high, low;
  e_init_port();
  e_i2cp_init();
  hal_camera_reset();
  INTCON1bits.NSTDIS = 0;
  IPC5 = (IPC5 & 0xF00F) + 0x0660;
  high = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, 0);
  low = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, 1);
  camera_version = high << 8 | low;
  switch (camera_version) {
    case PO3030K:
      e_poxxxx_set_mirror(0, 0);
      break;
    case PO6030K:
      e_poxxxx_set_mirror(1, 1);
      break;
    case PO8030D:
      e_poxxxx_set_mirror(0, 0);
      init_po8030();
      break;
  }
  e_poxxxx_write_cam_registers();
  return (int)camera_version;
}

int e_poxxxx_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                        unsigned int sensor_height, unsigned int zoom_fact_width,
                        unsigned int zoom_fact_height, int color_mode) {
  switch (camera_version) {
    case PO3030K:
      return e_po3030k_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
    case PO6030K:
      return e_po6030k_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
    case PO8030D:
      return e_po8030d_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
  }
  return UNKNOWN_SENSOR;
}

void e_poxxxx_set_mirror(int vertical, int horizontal) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_mirror(vertical, horizontal);
      break;
    case PO6030K:
      e_po6030k_set_mirror(vertical, horizontal);
      break;
    case PO8030D:
      e_po8030d_set_mirror(vertical, horizontal);
      break;
  }
}

void e_poxxxx_write_cam_registers(void) {
  if (camera_version == PO3030K) e_po3030k_write_cam_registers();
}

int e_poxxxx_get_orientation(void) {
  switch (camera_version) {
    case PO3030K:
      switch (hal_eeprom_word(MOUNT_WORD) & 3) {
        case 2:
          return 2;
        case 3:
          return 0;
      }
      return 1; /* 1 says so, and 0 falls through to the other sensors in the original */
    case PO6030K:
    case PO8030D:
      return 1;
  }
  return -1;
}

void e_poxxxx_set_awb_ae(int awb, int ae) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_awb_ae(awb, ae);
      break;
    case PO6030K:
      e_po6030k_set_awb_ae(awb, ae);
      break;
    case PO8030D:
      e_po8030d_set_awb_ae(awb, ae);
      break;
  }
}

void e_poxxxx_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_color_gain(40, r, g, g, b);
      break;
    case PO6030K:
      e_po6030k_set_rgb_gain(r, g, b);
      break;
    case PO8030D:
      e_po8030d_set_rgb_gain(r, g, b);
      break;
  }
}

void e_poxxxx_set_exposure(unsigned long exp) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_exposure((long)exp);
      break;
    case PO6030K:
      e_po6030k_set_exposure(exp);
      break;
    case PO8030D:
      e_po8030d_set_exposure(exp);
      break;
  }
}
