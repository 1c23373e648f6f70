/* SPDX-License-Identifier: MIT
 * Firmware libc: kinds of characters (ASCII). */
#ifndef TP_LIBC_CTYPE_H
#define TP_LIBC_CTYPE_H
int isalpha(int __c);
int isdigit(int __c);
int isalnum(int __c);
int isxdigit(int __c);
int isspace(int __c);
int isupper(int __c);
int islower(int __c);
int isprint(int __c);
int isgraph(int __c);
int iscntrl(int __c);
int ispunct(int __c);
int toupper(int __c);
int tolower(int __c);
#endif
