/* SPDX-License-Identifier: MIT
 * Turrets: SWIS radio.
 */
#include "contrib/SWIS_com_module/ComModule.h"
#include "unsimulated.h"

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
