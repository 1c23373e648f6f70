/* SPDX-License-Identifier: MIT
 * Firmware libc: kinds of characters (ASCII). */
#ifndef TP_LIBC_CTYPE_H
#define TP_LIBC_CTYPE_H
int isalpha(int c);
int isdigit(int c);
int isalnum(int c);
int isxdigit(int c);
int isspace(int c);
int isupper(int c);
int islower(int c);
int isprint(int c);
int isgraph(int c);
int iscntrl(int c);
int ispunct(int c);
int toupper(int c);
int tolower(int c);
#endif
