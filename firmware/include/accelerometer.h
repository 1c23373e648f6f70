/* SPDX-License-Identifier: MIT
 * Accelerometer, as the library named it before 2006. Behaviour is that of a_d/e_accelerometer.h; the guard
 * is shared with it.
 */
#ifndef _ACCELEROMETER
#define _ACCELEROMETER

/** Configures the converter. */
void InitAcc(void);

/** Raw samples of the three axes, counts. Blocks for three conversions. */
void GetAcc(int *x, int *y, int *z);

#endif
