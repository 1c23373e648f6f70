/* SPDX-License-Identifier: MIT
 * Commands to the Bluetooth module: real packets over UART 1, answered by the module's model (hal_sim/board).
 *
 * Modelled: packets byte by byte, waiting without time-out, what is returned, an end of an answer that is taken too
 * early when its last payload byte is 3, the filter's answer not waited for above 1 (so that the next command may
 * overwrite the packet while it leaves), the break. Not modelled: answers
 * longer than the library's buffers, which overwrite its stack on the robot; names over 20 and lists over 8, which
 * overwrite its variables.
 * Source: [lib: bluetooth/e_bluetooth.c], facts restated.
 */
#include "bluetooth/e_bluetooth.h"

#include <stdlib.h>
#include <string.h>

#include "hal.h"
#include "uart/e_uart_char.h"

#define START 0x02
#define END 0x03
#define REQUEST 0x52
#define CONFIRM 0x43
#define INDICATION 0x69

#define TYPE 1
#define OPCODE 2
#define LENGTH 3
#define PAYLOAD 6 /* where it begins in a packet */

#define OWN_PORT 1
#define LONGEST_SENT 138 /* ten bytes around 127 and one to spare; the library has 120 */
#define LONGEST_ANSWER 255

#define NAME_BYTES 20
#define PAIRED 8
#define FOUND 10
#define INQUIRY_S 5
#define NOBODY_FOUND 99
#define LAST_ANSWERED_FILTER 1

unsigned char e_bt_local_paired_device[6 * PAIRED];
struct BtDevice e_bt_present_device[FOUND];
struct BtEPuck e_bt_present_epuck[FOUND];

static char packet[LONGEST_SENT];
static unsigned char answer[LONGEST_ANSWER + 1];

/* the payload stands at packet + PAYLOAD */
static void send(unsigned char opcode, unsigned char length) {
  packet[0] = START;
  packet[TYPE] = REQUEST;
  packet[OPCODE] = (char)opcode;
  packet[LENGTH] = (char)length;
  packet[LENGTH + 1] = 0;
  packet[LENGTH + 2] = (char)(REQUEST + opcode + length);
  packet[PAYLOAD + length] = END;
  e_send_uart1_char(packet, PAYLOAD + 1 + length);
}

/* until a byte of 3 that is not too early by the length; by that rule a payload that ends in 3 ends the answer */
static void receive(void) {
  int count = 0;
  char last = 0;
  answer[LENGTH] = 0;
  do {
    char c;
    if (e_getchar_uart1(&c)) {
      if (count < LONGEST_ANSWER) answer[count] = (unsigned char)c;
      last = c;
      count++;
    }
  } while (last != END || count < (signed char)answer[LENGTH] + PAYLOAD);
  answer[count < LONGEST_ANSWER ? count : LONGEST_ANSWER] = 0;
}

static char command(unsigned char opcode, unsigned char length) {
  send(opcode, length);
  receive();
  return (char)answer[PAYLOAD];
}

static void copy(void *to, const void *from, unsigned int bytes) { memcpy(to, from, bytes); }

int e_bt_inquiry(struct BtDevice *device) {
  int found = 0;
  packet[PAYLOAD] = INQUIRY_S;
  packet[PAYLOAD + 1] = FOUND;
  packet[PAYLOAD + 2] = 0;
  send(0x00, 3);
  do {
    receive();
    if (answer[TYPE] == INDICATION) {
      copy(device[found].address, answer + PAYLOAD, 6);
      copy(device[found].class, answer + PAYLOAD + 6, 3);
      found++;
    }
  } while (answer[TYPE] != CONFIRM && answer[OPCODE] != 0x00);
  return found;
}

char e_bt_get_friendly_name(struct BtDevice *device) {
  unsigned char length;
  copy(packet + PAYLOAD, device->address, 6);
  if (command(0x02, 6) == 0) {
    length = answer[13];
    copy(device->friendly_name, answer + 14, length < NAME_BYTES ? length : NAME_BYTES);
  }
  return (char)answer[PAYLOAD];
}

char e_bt_read_local_name(char *name) {
  command(0x03, 0);
  copy(name, answer + 8, answer[7]); /* the module's length includes the end of the text */
  return (char)answer[PAYLOAD];
}

char e_bt_write_local_name(char *name) {
  unsigned char length = (unsigned char)(strlen(name) + 1);
  packet[PAYLOAD] = (char)length;
  copy(packet + PAYLOAD + 1, name, length);
  return command(0x04, length + 1);
}

char e_bt_read_local_pin_number(char *PIN) {
  command(0x16, 0);
  copy(PIN, answer + 8, answer[7]);
  PIN[answer[7]] = 0;
  return (char)answer[PAYLOAD];
}

char e_bt_write_local_pin_number(char *PIN) {
  unsigned char length = (unsigned char)strlen(PIN);
  packet[PAYLOAD] = (char)length;
  copy(packet + PAYLOAD + 1, PIN, length);
  return command(0x17, length + 1);
}

char e_bt_etablish_SPP_link(char *address) {
  packet[PAYLOAD] = OWN_PORT;
  copy(packet + PAYLOAD + 1, address, 6);
  packet[PAYLOAD + 7] = OWN_PORT;
  send(0x0A, 8);
  do receive();
  while (answer[OPCODE] != 0x0B);
  return (char)answer[PAYLOAD];
}

char e_bt_release_SPP_link(void) {
  packet[PAYLOAD] = OWN_PORT;
  if (command(0x0D, 1) != 0 && answer[OPCODE] == 0x0D) return (char)answer[PAYLOAD];
  do receive();
  while (answer[TYPE] != INDICATION && answer[OPCODE] != 0x51);
  return (char)answer[PAYLOAD];
}

char e_bt_send_SPP_data(char *data, char datalenght) {
  packet[PAYLOAD] = OWN_PORT;
  packet[PAYLOAD + 1] = datalenght;
  packet[PAYLOAD + 2] = 0;
  if (datalenght > 0) copy(packet + PAYLOAD + 3, data, (unsigned char)datalenght);
  return command(0x0F, (unsigned char)(datalenght + 3));
}

char e_bt_tranparent_mode(void) {
  packet[PAYLOAD] = OWN_PORT;
  return command(0x11, 1);
}

void e_bt_exit_tranparent_mode(void) {
  hal_uart1_break();
  e_init_uart1();
}

char e_bt_list_local_paired_device(void) {
  unsigned char count;
  command(0x1C, 0);
  count = answer[7];
  copy(e_bt_local_paired_device, answer + 8, 6 * (count < PAIRED ? count : PAIRED));
  return (char)count;
}

char e_bt_remove_local_paired_device(int index) {
  copy(packet + PAYLOAD, e_bt_local_paired_device + 6 * index, 6);
  return command(0x1B, 6);
}

char e_bt_set_event_filter(char event) {
  packet[PAYLOAD] = event;
  send(0x4E, 1);
  if (event > LAST_ANSWERED_FILTER) return 0;
  receive();
  return (char)answer[PAYLOAD];
}

char e_bt_get_event_filter(void) { return command(0x4F, 0); }

int e_bt_reset(void) {
  command(0x26, 0);
  answer[PAYLOAD + 1 + answer[PAYLOAD]] = 0;
  return atoi((const char *)answer + PAYLOAD + 1);
}

char e_bt_factory_reset(void) { return command(0x1A, 0); }

int e_bt_find_epuck(void) {
  int devices = e_bt_inquiry(e_bt_present_device);
  int found = 0;
  int i;
  for (i = 0; i < devices; i++) {
    struct BtDevice *d = &e_bt_present_device[i];
    if (d->class[0] || d->class[1] || d->class[2] || d->address[5] != 0x08) continue;
    e_bt_get_friendly_name(d);
    if (strncmp(d->friendly_name, "e-p", 3) != 0) continue;
    copy(e_bt_present_epuck[found].address, d->address, 6);
    copy(e_bt_present_epuck[found].number, d->friendly_name + 7, 4);
    e_bt_present_epuck[found].number[4] = 0;
    found++;
  }
  return found;
}

char e_bt_connect_epuck(void) {
  static char own_pin[17];
  char status;
  e_bt_read_local_pin_number(own_pin);
  if (e_bt_find_epuck() == 0) return NOBODY_FOUND;
  e_bt_write_local_pin_number((char *)e_bt_present_epuck[0].number);
  status = e_bt_etablish_SPP_link((char *)e_bt_present_epuck[0].address);
  e_bt_write_local_pin_number(own_pin);
  return status;
}
