/* SPDX-License-Identifier: MIT
 * The two halves of the protocol. Each is given the first byte of a command and returns when the command is
 * done and its reply has left.
 */
#ifndef ASERCOM_COMMANDS_H
#define ASERCOM_COMMANDS_H

/** A line of text, ended by CR or LF. `first` is above 0. */
void text_command(char first);

/** A sequence of binary commands, ended by a byte of 0. `first` is below 0. */
void binary_commands(char first);

#endif
