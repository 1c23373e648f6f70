/* SPDX-License-Identifier: MIT
 * Radio turret of SWIS (ZigBee-like packets), I2C address 0x7E; uses e_i2cp_*, which must be initialised.
 * One register takes about 0.5 ms, a full packet about 60 ms.
 */
#ifndef _COM_MODULE
#define _COM_MODULE

#include "../../p30F6014A.h"

#define COM_MODULE_HW_ATTENUATOR_25DB 1
#define COM_MODULE_HW_ATTENUATOR_0DB 0
#define COM_MODULE_DEFAULT_GROUP 0x7d
#define COM_MODULE_MAXSIZE 108 /* bytes of payload */

/** Waits, without time-out, until the turret answers, then sets group, address and attenuators. Software
 *  attenuator: 1 full power to 31, -25 dB. */
void InitComModule(unsigned char owngroup, unsigned int ownaddress, unsigned char hardwareattenuatormode,
                   unsigned char softwareattenuatorvalue);

/** 1 when the turret answers, else 0. */
int IsModulePlugged();

/** Settings. */
void SetRadioEnabledState(unsigned char mode);
void SetHardwareAttenuator(unsigned char AttenuatorMode);
void SetSoftwareAttenuator(unsigned char AttenuatorValue);
void SetOwnGroup(unsigned char GroupID);
void SetOwnAddress(unsigned int ownaddress);

/** Read back. The first two always return 1, as in the original. */
unsigned char GetRadioEnabledState();
unsigned char GetHardwareAttenuator();
unsigned char GetSoftwareAttenuator();
unsigned char GetOwnGroup();

/** Status register: bit 0 packet waiting, bit 1 transmitter idle, bit 2 packet lost, bit 3 transmit error;
 *  0xFF turret absent. */
unsigned char GetStatus();

/** Sends up to COM_MODULE_MAXSIZE bytes; group and address 0xFF reach everybody. Waits until the transmitter
 *  is idle. Returns 1, or 0 when too long or failed. */
int SendPacket(unsigned char destinationgroup, unsigned int destinationaddress, unsigned char *packet,
               int packetsize);

/** 1 and the packet with its size, or 0. */
int IsPacketReady(unsigned char *packet, int *packetSize);

#endif
