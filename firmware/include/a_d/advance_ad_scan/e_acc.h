/* SPDX-License-Identifier: MIT
 * Accelerometer, advanced variant: reads what the ADC scan has filed; call e_init_ad_scan(ALL_ADC) first.
 *
 * Robots before revision 1.3: analogue, 12 bits, fresh at 235 Hz, 0 g at about 2048, about 800 counts per g.
 * Revision 1.3: over I2C (a reading older than 3.9 ms is refreshed, which blocks for about 1 ms), 768
 * counts per g, x and y exchanged.
 * Axes: x to the left, y to the front, z up; at rest 1 g on z, and a lower side makes its axis negative: y < 0
 * with the nose down, x < 0 with the left side down.
 */
#ifndef _ACC_DEFS
#define _ACC_DEFS

#include "../../twinpuck.h"

#define CST_RADIAN (180.0/3.1415) /* degrees per radian, with the original's pi */
#define ANGLE_ERROR 666.0         /* what e_get_acc() returns for an unknown axis */
#define FILTER_SIZE 5             /* samples averaged by e_read_acc_*() */
#define ACCX_BUFFER 0
#define ACCY_BUFFER 1
#define ACCZ_BUFFER 2
#define GRAVITY 768          /* counts per g that calibration assumes */
#define GRAVITY_LSM330 16384 /* the same, revision 1.3, raw */

/** Acceleration in spherical coordinates. */
typedef struct {
  float acceleration; /* length of the vector, counts */
  float orientation;  /* direction of the slope, degrees 0 to 360; 0 when nearly flat or upside down */
  float inclination;  /* degrees: 0 flat, 90 on edge, 180 upside down */
} TypeAccSpheric;

/** Acceleration by axis, counts, calibration subtracted. */
typedef struct {
  int acc_x;
  int acc_y;
  int acc_z;
} TypeAccRaw;

/** Newest sample of axis 0, 1 or 2 minus its centre; 666 for other axes. Before e_acc_calibr() the centres
 *  are 0, 0 and 2000. */
int e_get_acc(unsigned int captor);

/** Mean of the newest `filter_size` samples (1 to 50) of an axis, centre not subtracted; 0 for larger sizes
 *  or other axes. filter_size 0 divides by zero: math-error trap. */
int e_get_acc_filtered(unsigned int captor, unsigned int filter_size);

/** Acceleration in spherical coordinates, from means of 5 samples. */
TypeAccSpheric e_read_acc_spheric(void);

/** Degrees; as the fields of TypeAccSpheric. Each call updates from fresh samples. */
float e_read_orientation(void);
float e_read_inclination(void);

/** Length of the acceleration, counts. */
float e_read_acc(void);

/** Means of 5 samples minus the centres, counts: all axes, or one. */
TypeAccRaw e_read_acc_xyz(void);
int e_read_acc_x(void);
int e_read_acc_y(void);
int e_read_acc_z(void);

/** Takes the present mean of 50 samples as the centre of x and y, and mean - 768 as that of z. The robot must
 *  stand flat and still. Does not block. e_init_ad_scan() returns one sample (4 ms) before all 50 are there: at
 *  once, the centres come out 2 % too low. */
void e_acc_calibr(void);

/** Lights the ring LED on the lowest side, and no other. Hysteresis 5 degrees. */
void e_display_angle(void);

#endif
