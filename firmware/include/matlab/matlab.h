/* SPDX-License-Identifier: MIT
 * Arrays to and from Matlab over UART 1; call e_init_uart1() first.
 *
 * A message out: 'I' (ints) or 'C' (chars), the number of bytes (2 bytes, low first), the data (low byte
 * first), then 'E' 'O' 'F' and a 0. A message in: the number of bytes (2 bytes, low first), then the data.
 */
#ifndef MATLAB_H
#define MATLAB_H

/** Sends `array_size` elements. Blocks for 86.8 us a byte; the end is still on its way on return, so wait for
 *  e_uart1_sending() to be 0 before the array changes. */
void e_send_int_to_matlab(int *data, int array_size);
void e_send_char_to_matlab(char *data, int array_size);

/** Waits for a message, without time-out, and stores up to `array_size` elements; more are read and dropped
 *  (for ints, LED 4 then toggles). Returns the number of elements announced. Counts whose low byte is 0x80 or
 *  above are misread, as in the original: its bytes are signed. */
int e_receive_int_from_matlab(int *data, int array_size);
int e_receive_char_from_matlab(char *data, int array_size);

#endif
