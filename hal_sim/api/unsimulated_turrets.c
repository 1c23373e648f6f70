/* SPDX-License-Identifier: MIT
 * Turrets: LIS sensors, SWIS radio.
 */
#include "contrib/LIS_sensors_turret/e_devantech.h"
#include "contrib/LIS_sensors_turret/e_sensext.h"
#include "contrib/LIS_sensors_turret/e_sharp.h"
#include "contrib/SWIS_com_module/ComModule.h"
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
#undef DEVICE

#define DEVICE "SWIS radio turret"
UNSIMULATED_VOID(InitComModule, (unsigned char owngroup, unsigned int ownaddress,
                                 unsigned char hardwareattenuatormode, unsigned char softwareattenuatorvalue))
UNSIMULATED(int, IsModulePlugged, ())
UNSIMULATED_VOID(SetRadioEnabledState, (unsigned char mode))
UNSIMULATED_VOID(SetHardwareAttenuator, (unsigned char AttenuatorMode))
UNSIMULATED_VOID(SetSoftwareAttenuator, (unsigned char AttenuatorValue))
UNSIMULATED_VOID(SetOwnGroup, (unsigned char GroupID))
UNSIMULATED_VOID(SetOwnAddress, (unsigned int ownaddress))
UNSIMULATED(unsigned char, GetRadioEnabledState, ())
UNSIMULATED(unsigned char, GetHardwareAttenuator, ())
UNSIMULATED(unsigned char, GetSoftwareAttenuator, ())
UNSIMULATED(unsigned char, GetOwnGroup, ())
UNSIMULATED(unsigned char, GetStatus, ())
UNSIMULATED(int, SendPacket, (unsigned char destinationgroup, unsigned int destinationaddress,
                              unsigned char *packet, int packetsize))
UNSIMULATED(int, IsPacketReady, (unsigned char *packet, int *packetSize))

/* in the library's object, in none of its headers */
unsigned int GetOwnAddress();
UNSIMULATED(unsigned int, GetOwnAddress, ())
