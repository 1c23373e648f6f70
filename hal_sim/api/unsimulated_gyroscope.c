/* SPDX-License-Identifier: MIT
 * Accelerometer and gyroscope of robots of revision 1.3. The two conversions need no sensor and are real.
 */
#include "acc_gyro/e_lsm330.h"
#include "unsimulated.h"
#define DEVICE "accelerometer and gyroscope of revision 1.3"

/* variables of the driver that programs may name */
__attribute__((weak)) signed int gyroOffsetX, gyroOffsetY, gyroOffsetZ;

UNSIMULATED_VOID(initAccAndGyro, (void))
UNSIMULATED_VOID(getAllAxesAccRaw, (unsigned char *arr))
UNSIMULATED_VOID(getAllAxesAcc, (signed int *x, signed int *y, signed int *z))
UNSIMULATED_VOID(getAllAxesGyroRaw, (unsigned char *arr))
UNSIMULATED_VOID(getAllAxesGyro, (signed int *x, signed int *y, signed int *z))
UNSIMULATED(signed char, getTemperature, (void))
UNSIMULATED(int, getXAxisAcc, ())
UNSIMULATED(int, getYAxisAcc, ())
UNSIMULATED(int, getZAxisAcc, ())
UNSIMULATED(int, getXAxisGyro, ())
UNSIMULATED(int, getYAxisGyro, ())
UNSIMULATED(int, getZAxisGyro, ())
UNSIMULATED_VOID(calibrateGyroscope, (int numSamples))

/* the sensitivity at +-250 degrees per second */
float rawToDps(int value) { return value * 0.00875f; }

float rawToDpms(int value) { return value * 0.00000875f; }
