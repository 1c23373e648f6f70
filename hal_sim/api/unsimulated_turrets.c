/* SPDX-License-Identifier: MIT
 * Turrets: LIS sensors.
 */
#include "contrib/LIS_sensors_turret/e_devantech.h"
#include "contrib/LIS_sensors_turret/e_sensext.h"
#include "contrib/LIS_sensors_turret/e_sharp.h"
#include "unsimulated.h"

#define DEVICE "LIS sensor turret"
UNSIMULATED_VOID(e_init_devantech, (void))
UNSIMULATED_VOID(e_disable_devantech, (void))
UNSIMULATED(unsigned int, e_get_dist_devantech, (char device_add))
UNSIMULATED(unsigned int, e_get_delay_devantech, (char device_add))
UNSIMULATED(char, e_get_sr_devantech, (char device_add))
UNSIMULATED(unsigned int, e_get_light_devantech, (char device_add))
UNSIMULATED_VOID(e_set_gain_devantech, (char device_add, char gain))
UNSIMULATED_VOID(e_set_range_devantech, (char device_add, char range))
UNSIMULATED_VOID(e_i2cd_write, (char device_add, char reg, char value))
UNSIMULATED(char, e_i2cd_readb, (char device_add, char reg))
UNSIMULATED(unsigned int, e_i2cd_readw, (char device_add, char reg))

UNSIMULATED_VOID(e_init_sensext, (void))
UNSIMULATED(int, e_sensext_process, (int *sensext_param, unsigned int *sensext_value))
UNSIMULATED_VOID(e_stop_sensext_wait, (void))
UNSIMULATED_VOID(e_start_sensext_wait, (void))
UNSIMULATED(int, e_get_sensext_wait, (void))

UNSIMULATED_VOID(e_init_sharp, (void))
UNSIMULATED(int, e_get_dist_sharp, (void))
UNSIMULATED_VOID(e_set_sharp_led, (unsigned int sharp_led_number, unsigned int value))
UNSIMULATED_VOID(e_sharp_led_clear, (void))
UNSIMULATED_VOID(e_sharp_on, (void))
UNSIMULATED_VOID(e_sharp_off, (void))
