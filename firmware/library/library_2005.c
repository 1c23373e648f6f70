/* SPDX-License-Identifier: MIT
 * The names of the library before 2006 (motors.h, led.h, prox.h, ...): the basic variants under other names.
 * Their headers share guards with the later ones, so their prototypes are repeated here.
 */
#include "a_d/e_accelerometer.h"
#include "a_d/e_ad_conv.h"
#include "a_d/e_prox.h"
#include "motor_led/e_init_port.h"
#include "motor_led/e_led.h"
#include "motor_led/e_motors.h"
#include "uart/e_uart_char.h"

void InitPort(void) { e_init_port(); }

void InitMotors(void) { e_init_motors(); }
void SetSpeedLeft(int motor_speed) { e_set_speed_left(motor_speed); }
void SetSpeedRight(int motor_speed) { e_set_speed_right(motor_speed); }
int GetStepsLeft(void) { return e_get_steps_left(); }
int GetStepsRight(void) { return e_get_steps_right(); }
void SetStepsLeft(int set_steps) { e_set_steps_left(set_steps); }
void SetStepsRight(int set_steps) { e_set_steps_right(set_steps); }

void SetLed(unsigned int led_number, unsigned int value) { e_set_led(led_number, value); }
void LedClear(void) { e_led_clear(); }
void SetBodyLed(unsigned int value) { e_set_body_led(value); }
void SetFrontLed(unsigned int value) { e_set_front_led(value); }

void InitProx(void) { e_init_prox(); }
int GetProx(unsigned int sensor_number) { return e_get_prox(sensor_number); }
int GetAmbientLight(unsigned int sensor_number) { return e_get_ambient_light(sensor_number); }

void InitAcc(void) { e_init_acc(); }
void GetAcc(int *x, int *y, int *z) { e_get_acc(x, y, z); }

void InitAd(void) { e_init_ad(); }
int ReadAd(unsigned int channel) { return e_read_ad(channel); }

void InitUart1(void) { e_init_uart1(); }
int GetcharUart1(char *car) { return e_getchar_uart1(car); }
void SendUart1Char(char *buff, int length) { e_send_uart1_char(buff, length); }
void InitUart2(void) { e_init_uart2(BAUD115200); }
int GetcharUart2(char *car) { return e_getchar_uart2(car); }
void SendUart2Char(char *buff, int length) { e_send_uart2_char(buff, length); }
