/* SPDX-License-Identifier: MIT
 * Radio turret of SWIS over I2C, one register a transaction of about 0.5 ms.
 *
 * Modelled: blocking until the turret answers and until it is idle, attenuator clamped to 31, the two Get functions
 * that always answer 1, the 4096 rounds of IsPacketReady() without a packet.
 * Source: [lib: contrib/SWIS_com_module/ComModule.c], facts restated.
 */
#include "contrib/SWIS_com_module/ComModule.h"

#include "I2C/e_I2C_protocol.h"

#define TURRET (0x3F << 1)

/* registers */
#define STATUS 0
#define CONFIG 1
#define SEND 2
#define SOFT_ATTENUATOR 3
#define OWN_GROUP 4
#define OWN_ADDRESS_LOW 5
#define OWN_ADDRESS_HIGH 6
#define SEND_BUFFER 7
#define BUFFER_LAST (COM_MODULE_MAXSIZE + 14)
#define RECEIVE_BUFFER (SEND_BUFFER + BUFFER_LAST + 1)

/* status and configuration bits */
#define PACKET_READY 0x01
#define TRANSMITTER_IDLE 0x02
#define TRANSMIT_ERROR 0x08
#define HARDWARE_ATTENUATOR 0x01
#define RADIO_ENABLED 0x80

/* offsets in a message */
#define LENGTH 0
#define DESTINATION_LOW 6
#define DESTINATION_HIGH 7
#define TYPE 8
#define GROUP 9
#define DATA 10
#define TYPE_OF_ALL 0x0A

#define EMPTY_ROUNDS 0x1000

unsigned int GetOwnAddress(); /* in none of the library's headers */

static unsigned char read_register(unsigned char number) {
  return (unsigned char)e_i2cp_read(TURRET, (char)number);
}

static void write_register(unsigned char number, unsigned char value) {
  e_i2cp_write(TURRET, (char)number, (char)value);
}

static void switch_config(unsigned char bit, unsigned char on) {
  unsigned char old = read_register(CONFIG);
  write_register(CONFIG, on ? old | bit : old & ~bit);
}

void InitComModule(unsigned char owngroup, unsigned int ownaddress, unsigned char hardwareattenuatormode,
                   unsigned char softwareattenuatorvalue) {
  e_i2cp_init();
  e_i2cp_enable();
  while (!IsModulePlugged()) continue;
  SetOwnGroup(owngroup);
  SetOwnAddress(ownaddress);
  SetHardwareAttenuator(hardwareattenuatormode);
  SetSoftwareAttenuator(softwareattenuatorvalue);
  SetRadioEnabledState(1);
}

int IsModulePlugged() { return GetStatus() != 0xFF; }

void SetRadioEnabledState(unsigned char mode) { switch_config(RADIO_ENABLED, mode); }

void SetHardwareAttenuator(unsigned char AttenuatorMode) { switch_config(HARDWARE_ATTENUATOR, AttenuatorMode); }

void SetSoftwareAttenuator(unsigned char AttenuatorValue) {
  write_register(SOFT_ATTENUATOR, AttenuatorValue > 31 ? 31 : AttenuatorValue);
}

void SetOwnGroup(unsigned char GroupID) { write_register(OWN_GROUP, GroupID); }

void SetOwnAddress(unsigned int ownaddress) {
  write_register(OWN_ADDRESS_LOW, ownaddress & 0xFF);
  write_register(OWN_ADDRESS_HIGH, ownaddress >> 8);
}

/* the original's two tests have no effect: it reads the register and answers 1 */
unsigned char GetHardwareAttenuator() {
  read_register(CONFIG);
  return 1;
}

unsigned char GetRadioEnabledState() {
  read_register(CONFIG);
  return 1;
}

unsigned char GetSoftwareAttenuator() { return read_register(SOFT_ATTENUATOR); }

unsigned char GetOwnGroup() { return read_register(OWN_GROUP); }

unsigned int GetOwnAddress() {
  unsigned char low = read_register(OWN_ADDRESS_LOW);
  return low | (unsigned int)read_register(OWN_ADDRESS_HIGH) << 8;
}

unsigned char GetStatus() { return read_register(STATUS); }

int SendPacket(unsigned char destinationgroup, unsigned int destinationaddress, unsigned char *packet,
               int packetsize) {
  int i;
  if (packetsize > COM_MODULE_MAXSIZE) return 0;
  while (!(GetStatus() & TRANSMITTER_IDLE)) continue;
  write_register(SEND_BUFFER + TYPE, TYPE_OF_ALL);
  write_register(SEND_BUFFER + GROUP, destinationgroup);
  write_register(SEND_BUFFER + DESTINATION_LOW, destinationaddress & 0xFF);
  write_register(SEND_BUFFER + DESTINATION_HIGH, destinationaddress >> 8);
  for (i = 0; i < packetsize; i++) write_register(SEND_BUFFER + DATA + i, packet[i]);
  write_register(SEND, 1);
  return !(GetStatus() & TRANSMIT_ERROR);
}

int IsPacketReady(unsigned char *packet, int *packetSize) {
  unsigned int rounds;
  int i;
  if (!packet || !packetSize) return 0;
  if (!(GetStatus() & PACKET_READY)) {
    for (rounds = 0; rounds < EMPTY_ROUNDS; rounds++) continue;
    return 0;
  }
  *packetSize = read_register(RECEIVE_BUFFER + LENGTH);
  if (*packetSize > COM_MODULE_MAXSIZE) return 0;
  for (i = 0; i < *packetSize; i++) packet[i] = read_register(RECEIVE_BUFFER + DATA + i);
  read_register(RECEIVE_BUFFER + BUFFER_LAST); /* frees it */
  return 1;
}
