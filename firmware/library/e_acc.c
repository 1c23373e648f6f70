/* SPDX-License-Identifier: MIT
 * Accelerometer, usual variant: samples of the ADC scan before revision 1.3, the LSM330 over I2C on it.
 * Axes: x to the left, y forward, z up, as what the floor pushes: a side that is lower makes its axis negative.
 *
 * Revision 1.3: x and y are exchanged, 16 bits are scaled to about those of the analogue part, and new values
 * are fetched at most every 64 interrupts of the scan.
 * Source: [lib: a_d/advance_ad_scan/e_acc.c], facts restated.
 */
#include "a_d/advance_ad_scan/e_acc.h"

#include <math.h>
#include <stdlib.h>

#include "acc_gyro/e_lsm330.h"
#include "hal.h"
#include "motor_led/e_init_port.h"

#define REFRESH_INTERRUPTS 64  /* where updateAccI2CCounter stops */
#define ANALOGUE_ZERO 2048     /* added to filtered values of revision 1.3 */
#define FLAT_DEGREES 5         /* below this inclination there is no orientation ... */
#define UPSIDE_DOWN_DEGREES 160 /* ... nor above this one */
#define HYSTERESIS_DEGREES 5.0
#define SECTOR_DEGREES 45.0

int centre_z = 2000; /* exported by the library's object; on revision 1.3 e_init_ad_scan() clears it */
static int centre_x;
static int centre_y;
static int last_x, last_y, last_z; /* newest values of revision 1.3 */
static unsigned int scan_starts_seen;
static unsigned char is_calibrating;
static int acc_x, acc_y, acc_z;
static float acceleration, orientation, inclination;
static int shown_angle;

/** 16 bits to about the counts of the analogue part: 16384 becomes 768. */
static int to_analogue_scale(int value) { return (value >> 4) - (value >> 6); }

static void refresh_lsm330(void) {
  unsigned int starts = hal_scan_starts();
  if (starts != scan_starts_seen) {
    scan_starts_seen = starts;
    centre_z = 0;
  }
  if (updateAccI2CCounter != REFRESH_INTERRUPTS) return;
  getAllAxesAcc(&last_x, &last_y, &last_z);
  updateAccI2CCounter = 0;
}

int e_get_acc(unsigned int captor) {
  if (isEpuckVersion1_3()) {
    refresh_lsm330();
    /* the readings change places here and the centres do not: the original's own slip */
    switch (captor) {
      case ACCX_BUFFER: return to_analogue_scale(last_y - centre_y);
      case ACCY_BUFFER: return to_analogue_scale(last_x - centre_x);
      case ACCZ_BUFFER: return to_analogue_scale(last_z - centre_z);
      default: return (int)ANGLE_ERROR;
    }
  }
  switch (captor) {
    case ACCX_BUFFER: return hal_acc_newest(ACCX_BUFFER) - centre_x;
    case ACCY_BUFFER: return hal_acc_newest(ACCY_BUFFER) - centre_y;
    case ACCZ_BUFFER: return hal_acc_newest(ACCZ_BUFFER) - centre_z;
    default: return (int)ANGLE_ERROR;
  }
}

/** The filter is ignored; while calibrating the full raw values, one axis at a time. */
static int filtered_lsm330(unsigned int captor) {
  refresh_lsm330();
  if (is_calibrating) {
    switch (captor) {
      case ACCX_BUFFER: return getYAxisAcc();
      case ACCY_BUFFER: return getXAxisAcc();
      case ACCZ_BUFFER: return getZAxisAcc();
      default: return (int)ANGLE_ERROR;
    }
  }
  switch (captor) {
    case ACCX_BUFFER: return to_analogue_scale(last_y) + ANALOGUE_ZERO;
    case ACCY_BUFFER: return to_analogue_scale(last_x) + ANALOGUE_ZERO;
    case ACCZ_BUFFER: return to_analogue_scale(last_z) + ANALOGUE_ZERO;
    default: return (int)ANGLE_ERROR;
  }
}

int e_get_acc_filtered(unsigned int captor, unsigned int filter_size) {
  long sum = 0;
  unsigned int sample, index;
  if (isEpuckVersion1_3()) return filtered_lsm330(captor);
  if (captor <= ACCZ_BUFFER && filter_size <= ACC_SAMP_NB) {
    index = e_last_acc_scan_id;
    for (sample = 0; sample < filter_size; sample++) {
      sum += e_acc_scan[captor][index];
      index = index == 0 ? ACC_SAMP_NB - 1 : index - 1;
    }
  }
  /* a size of 0 divides by zero, as on the robot */
  return (int)(sum / filter_size);
}

static void read_cartesian(void) {
  if (isEpuckVersion1_3()) {
    acc_x = e_get_acc(ACCX_BUFFER);
    acc_y = e_get_acc(ACCY_BUFFER);
    acc_z = e_get_acc(ACCZ_BUFFER);
    return;
  }
  acc_x = e_get_acc_filtered(ACCX_BUFFER, FILTER_SIZE) - centre_x;
  acc_y = e_get_acc_filtered(ACCY_BUFFER, FILTER_SIZE) - centre_y;
  acc_z = e_get_acc_filtered(ACCZ_BUFFER, FILTER_SIZE) - centre_z;
}

static void read_spherical(void) {
  long across2, all2;
  read_cartesian();
  across2 = (long)acc_x * acc_x + (long)acc_y * acc_y;
  all2 = across2 + (long)acc_z * acc_z;
  acceleration = sqrtf((float)all2);
  inclination = 90.0 - atan2f((float)acc_z, sqrtf((float)across2)) * CST_RADIAN;
  if (inclination < FLAT_DEGREES || inclination > UPSIDE_DOWN_DEGREES)
    orientation = 0;
  else
    orientation = atan2f((float)acc_x, (float)acc_y) * CST_RADIAN + 180.0;
}

TypeAccSpheric e_read_acc_spheric(void) {
  TypeAccSpheric result;
  read_spherical();
  result.acceleration = acceleration;
  result.orientation = orientation;
  result.inclination = inclination;
  return result;
}

float e_read_orientation(void) {
  read_spherical();
  return orientation;
}

float e_read_inclination(void) {
  read_spherical();
  return inclination;
}

float e_read_acc(void) {
  read_spherical();
  return acceleration;
}

TypeAccRaw e_read_acc_xyz(void) {
  TypeAccRaw result;
  read_cartesian();
  result.acc_x = acc_x;
  result.acc_y = acc_y;
  result.acc_z = acc_z;
  return result;
}

int e_read_acc_x(void) {
  read_cartesian();
  return acc_x;
}

int e_read_acc_y(void) {
  read_cartesian();
  return acc_y;
}

int e_read_acc_z(void) {
  read_cartesian();
  return acc_z;
}

void e_acc_calibr(void) {
  is_calibrating = 1;
  centre_x = e_get_acc_filtered(ACCX_BUFFER, ACC_SAMP_NB);
  centre_y = e_get_acc_filtered(ACCY_BUFFER, ACC_SAMP_NB);
  centre_z = e_get_acc_filtered(ACCZ_BUFFER, ACC_SAMP_NB) - (isEpuckVersion1_3() ? GRAVITY_LSM330 : GRAVITY);
  is_calibrating = 0;
}

void e_display_angle(void) {
  float angle = e_read_orientation();
  unsigned int sector;
  /* the library's abs() is that of whole numbers: 5.9 degrees count as 5 */
  if (!(abs((int)(shown_angle - angle)) > HYSTERESIS_DEGREES)) return;
  hal_set_rings(0);
  /* sectors begin above their lower limit and follow each other against the numbers of the LEDs */
  sector = 0;
  while (sector < RING_LEDS && angle > SECTOR_DEGREES * sector + SECTOR_DEGREES / 2) sector++;
  hal_set_ring((RING_LEDS - sector) % RING_LEDS, 1);
  shown_angle = (int)angle;
}
