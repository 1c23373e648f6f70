/* SPDX-License-Identifier: MIT
 * Arrays to and from Matlab, over UART 1.
 *
 * A message out: 'I' or 'C', number of bytes, data, "EOF" with its 0. A message in: number of bytes, data.
 * Received bytes are chars, hence signed, as on the robot: a length whose low byte is 0x80 or above comes out
 * 256 too small, while the words of the data come out right.
 */
#include "matlab/matlab.h"
#include "motor_led/e_epuck_ports.h"
#include "uart/e_uart_char.h"

/* The driver sends from the caller's memory. Each call waits for the one before, so only the end mark, a
 * constant,
   may still be on its way when the variables of this function die. */
static void send(const char *kind, char *data, int bytes) {
  e_send_uart1_char(kind, 1);
  e_send_uart1_char((char *)&bytes, sizeof(int));
  e_send_uart1_char(data, bytes);
  e_send_uart1_char("EOF\0", 4);
}

void e_send_int_to_matlab(int *data, int array_size) { send("I", (char *)data, 2 * array_size); }

void e_send_char_to_matlab(char *data, int array_size) { send("C", data, array_size); }

static char next_byte(void) {
  char byte;
  while (!e_getchar_uart1(&byte)) continue;
  return byte;
}

/* The announced number of bytes, at most `limit`; *too_long tells whether it was cut. */
static int receive_length(int limit, int *too_long) {
  int bytes = next_byte();
  bytes += (int)next_byte() << 8;
  *too_long = bytes > limit;
  return *too_long ? limit : bytes;
}

/* Drops what has arrived beyond the array's end; what arrives later stays for the next reader. */
static void drop_rest(void) {
  char byte;
  while (e_getchar_uart1(&byte)) continue;
}

int e_receive_int_from_matlab(int *data, int array_size) {
  int too_long, i;
  int bytes = receive_length(2 * array_size, &too_long);
  if (too_long) LED4 = LED4 ^ 1;
  for (i = 0; i < bytes; i++) {
    char byte = next_byte();
    if (i % 2 == 0)
      data[i / 2] = byte;
    else
      data[i / 2] = (data[i / 2] & 0x00FF) | (int)byte << 8;
  }
  if (too_long) drop_rest();
  return bytes >> 1;
}

int e_receive_char_from_matlab(char *data, int array_size) {
  int too_long, i;
  int bytes = receive_length(array_size, &too_long);
  for (i = 0; i < bytes; i++) data[i] = next_byte();
  if (too_long) drop_rest();
  return bytes;
}
