/* SPDX-License-Identifier: MIT
 * Port initialisation, and the question whether this robot is of revision 1.3: only there a sensor answers at the
 * accelerometer's I2C address. Latches are written before the pins become outputs, so nothing blinks.
 * Source: [lib: motor_led/e_init_port.c], facts restated.
 */
#include "motor_led/e_init_port.h"

#include "I2C/e_I2C_protocol.h"
#include "acc_gyro/e_lsm330.h"
#include "hal.h"

#define ACC_ADDRESS 0x3C
#define WHO_AM_I 0x0F
#define ACC_IDENTITY 0x40

/* exported under this name by the library's object */
unsigned char isPresentFlag;

unsigned char isEpuckVersion1_1(void);

static void clear_outputs(void) {
  hal_set_rings(0);
  FRONT_LED = 0;
  BODY_LED = 0;
  PULSE_IR0 = 0;
  PULSE_IR1 = 0;
  PULSE_IR2 = 0;
  PULSE_IR3 = 0;
  AUDIO_ON = 0;
  hal_coils(0, 0);
  hal_coils(1, 0);
  CAM_RESET = 0;
  SIO_C = 0;
  SIO_D = 0;
}

static void set_directions(void) {
  LED0_DIR = OUTPUT_PIN;
  LED1_DIR = OUTPUT_PIN;
  LED2_DIR = OUTPUT_PIN;
  LED3_DIR = OUTPUT_PIN;
  LED4_DIR = OUTPUT_PIN;
  LED5_DIR = OUTPUT_PIN;
  LED6_DIR = OUTPUT_PIN;
  LED7_DIR = OUTPUT_PIN;
  FRONT_LED_DIR = OUTPUT_PIN;
  BODY_LED_DIR = OUTPUT_PIN;
  PULSE_IR0_DIR = OUTPUT_PIN;
  PULSE_IR1_DIR = OUTPUT_PIN;
  PULSE_IR2_DIR = OUTPUT_PIN;
  PULSE_IR3_DIR = OUTPUT_PIN;
  AUDIO_ON_DIR = OUTPUT_PIN;
  MOTOR1_PHA_DIR = OUTPUT_PIN;
  MOTOR1_PHB_DIR = OUTPUT_PIN;
  MOTOR1_PHC_DIR = OUTPUT_PIN;
  MOTOR1_PHD_DIR = OUTPUT_PIN;
  MOTOR2_PHA_DIR = OUTPUT_PIN;
  MOTOR2_PHB_DIR = OUTPUT_PIN;
  MOTOR2_PHC_DIR = OUTPUT_PIN;
  MOTOR2_PHD_DIR = OUTPUT_PIN;
  CAM_RESET_DIR = OUTPUT_PIN;
  SIO_C_DIR = OUTPUT_PIN;
  SIO_D_DIR = OUTPUT_PIN;

  BATT_LOW_DIR = INPUT_PIN;
  REMOTE_DIR = INPUT_PIN;
  SELECTOR0_DIR = INPUT_PIN;
  SELECTOR1_DIR = INPUT_PIN;
  SELECTOR2_DIR = INPUT_PIN;
  SELECTOR3_DIR = INPUT_PIN;
  CAM_y0_DIR = INPUT_PIN;
  CAM_y1_DIR = INPUT_PIN;
  CAM_y2_DIR = INPUT_PIN;
  CAM_y3_DIR = INPUT_PIN;
  CAM_y4_DIR = INPUT_PIN;
  CAM_y5_DIR = INPUT_PIN;
  CAM_y6_DIR = INPUT_PIN;
  CAM_y7_DIR = INPUT_PIN;
}

/* one try: an empty bus answers 0xFF, and a bus that hangs must not hang the program */
static unsigned char sensor_answers(void) {
  char identity = 0;
  char fine;
  e_i2cp_init();
  e_i2c_reset();
  fine = e_i2c_start();
  fine &= e_i2c_write(ACC_ADDRESS);
  fine &= e_i2c_write(WHO_AM_I);
  fine &= e_i2c_restart();
  fine &= e_i2c_write(ACC_ADDRESS + 1);
  fine &= e_i2c_read(&identity);
  e_i2c_nack();
  e_i2c_stop();
  e_i2c_disable();
  return fine && identity == ACC_IDENTITY;
}

void e_init_port(void) {
  clear_outputs();
  set_directions();
  isPresentFlag = sensor_answers();
  if (isPresentFlag) initAccAndGyro();
}

unsigned char isEpuckVersion1_3(void) { return isPresentFlag; }
unsigned char isEpuckVersion1_1(void) { return isPresentFlag; }
