/* SPDX-License-Identifier: MIT
 * Accelerometer and gyroscope of revision 1.3, over I2C.
 * Source: [lib: acc_gyro/e_lsm330.c], facts restated.
 */
#include "acc_gyro/e_lsm330.h"

#include "I2C/e_I2C_protocol.h"

#define ACC_ADDRESS 0x3C
#define GYRO_ADDRESS 0xD4
#define FIRST_DATA 0x28
#define TEMPERATURE 0x26
#define INCREMENT 0x80 /* bit of the register number: go on to the next one */

int gyroOffsetX, gyroOffsetY, gyroOffsetZ;

/* exported by the library's object */
void writeReg(unsigned char addr, unsigned char reg, unsigned char value);
unsigned char readReg(unsigned char addr, unsigned char reg);
char readRegMulti(char device_add, unsigned char *read_buffer, char start_address, unsigned char numBytes);

void writeReg(unsigned char addr, unsigned char reg, unsigned char value) {
  e_i2cp_enable();
  e_i2cp_write(addr, reg, value);
  e_i2cp_disable();
}

unsigned char readReg(unsigned char addr, unsigned char reg) {
  unsigned char value;
  e_i2cp_enable();
  value = e_i2cp_read(addr, reg);
  e_i2cp_disable();
  return value;
}

/* repeats, with a reset of the bus, until nothing fails */
char readRegMulti(char device_add, unsigned char *read_buffer, char start_address, unsigned char numBytes) {
  for (;;) {
    unsigned int i;
    char fine = 1;
    fine &= e_i2c_start();
    fine &= e_i2c_write(device_add);
    fine &= e_i2c_write(start_address | INCREMENT);
    fine &= e_i2c_restart();
    fine &= e_i2c_write(device_add + 1);
    for (i = 0; i < numBytes; i++) {
      fine &= e_i2c_read((char *)&read_buffer[i]);
      fine &= i + 1 == numBytes ? e_i2c_nack() : e_i2c_ack();
    }
    e_i2c_stop();
    if (fine) return fine;
    e_i2c_reset();
  }
}

void initAccAndGyro(void) {
  e_i2cp_enable();
  e_i2cp_write(ACC_ADDRESS, 0x20, 0x9F);  /* 1600 Hz, block data update, all axes */
  e_i2cp_write(ACC_ADDRESS, 0x25, 0x50);  /* register number grows */
  e_i2cp_write(GYRO_ADDRESS, 0x20, 0xCF); /* 760 Hz, filter of 30 Hz, all axes */
  e_i2cp_write(GYRO_ADDRESS, 0x21, 0x20);
  e_i2cp_write(GYRO_ADDRESS, 0x23, 0x00); /* +-250 degrees per second */
  e_i2cp_disable();
}

static void read_data(char address, unsigned char offset, unsigned char *bytes, unsigned char count) {
  e_i2cp_enable();
  readRegMulti(address, bytes, FIRST_DATA + offset, count);
  e_i2cp_disable();
}

static int word_of(const unsigned char *low) { return (int)((unsigned int)low[1] << 8) + (int)low[0]; }

void getAllAxesAccRaw(unsigned char *arr) { read_data(ACC_ADDRESS, 0, arr, 6); }

void getAllAxesGyroRaw(unsigned char *arr) { read_data(GYRO_ADDRESS, 0, arr, 6); }

void getAllAxesAcc(signed int *x, signed int *y, signed int *z) {
  unsigned char bytes[6];
  getAllAxesAccRaw(bytes);
  *x = word_of(bytes);
  *y = word_of(bytes + 2);
  *z = word_of(bytes + 4);
}

void getAllAxesGyro(signed int *x, signed int *y, signed int *z) {
  unsigned char bytes[6];
  getAllAxesGyroRaw(bytes);
  *x = word_of(bytes) - gyroOffsetX;
  *y = word_of(bytes + 2) - gyroOffsetY;
  *z = word_of(bytes + 4) - gyroOffsetZ;
}

/* the library takes the low byte of a single axis as signed */
static int single_axis(char address, unsigned char axis) {
  unsigned char bytes[2];
  read_data(address, 2 * axis, bytes, 2);
  return (int)((unsigned int)bytes[1] << 8) + (signed char)bytes[0];
}

int getXAxisAcc() { return single_axis(ACC_ADDRESS, 0); }
int getYAxisAcc() { return single_axis(ACC_ADDRESS, 1); }
int getZAxisAcc() { return single_axis(ACC_ADDRESS, 2); }

int getXAxisGyro() { return single_axis(GYRO_ADDRESS, 0) - gyroOffsetX; }
int getYAxisGyro() { return single_axis(GYRO_ADDRESS, 1) - gyroOffsetY; }
int getZAxisGyro() { return single_axis(GYRO_ADDRESS, 2) - gyroOffsetZ; }

signed char getTemperature(void) { return (signed char)readReg(GYRO_ADDRESS, TEMPERATURE); }

/* sums of 16 bits, as in the library: many or large readings run over */
void calibrateGyroscope(int numSamples) {
  unsigned char bytes[6];
  int sum[3] = {0, 0, 0};
  int sample, axis;
  for (sample = 0; sample < numSamples; sample++) {
    getAllAxesGyroRaw(bytes);
    for (axis = 0; axis < 3; axis++) sum[axis] = (int)((unsigned int)sum[axis] + (unsigned int)word_of(bytes + 2 * axis));
  }
  gyroOffsetX = sum[0] / numSamples;
  gyroOffsetY = sum[1] / numSamples;
  gyroOffsetZ = sum[2] / numSamples;
}

/* the sensitivity at +-250 degrees per second */
float rawToDps(int value) { return value * 0.00875f; }

float rawToDpms(int value) { return value * 0.00000875f; }
