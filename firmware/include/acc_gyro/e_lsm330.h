/* SPDX-License-Identifier: MIT
 * Accelerometer and gyroscope of robots of revision 1.3, over I2C. Every reading blocks for about 1 ms.
 * Accelerometer +-2 g, 16384 per g, 1600 Hz. Gyroscope +-250 degrees per second, 760 Hz.
 */
#ifndef __LSM330_H__
#define __LSM330_H__

/** Configures both sensors; e_init_port() calls it where they are found. */
void initAccAndGyro(void);

/** Six bytes, x, y, z, low byte first; offsets not subtracted. `arr` holds 6 bytes. */
void getAllAxesAccRaw(unsigned char *arr);
void getAllAxesGyroRaw(unsigned char *arr);

/** All axes, 16 bits each; the gyroscope's offsets are subtracted. */
void getAllAxesAcc(signed int *x, signed int *y, signed int *z);
void getAllAxesGyro(signed int *x, signed int *y, signed int *z);

/** Degrees Celsius, relative to the sensor's own zero. */
signed char getTemperature(void);

/** One axis. The low byte is taken as signed: a reading is 256 too low whenever its low byte is 0x80 or
 *  above. */
int getXAxisAcc();
int getYAxisAcc();
int getZAxisAcc();
int getXAxisGyro();
int getYAxisGyro();
int getZAxisGyro();

/** Takes the mean of some readings as the gyroscope's zero; the robot must stand still. The definition has
 *  one argument, int numSamples, which this prototype leaves open, as in the original. */
void calibrateGyroscope();

/** Gyroscope reading in degrees per second: value x 0.00875. */
float rawToDps(int value);

/** Gyroscope reading in degrees per millisecond: value x 0.00000875. */
float rawToDpms(int value);

#endif
