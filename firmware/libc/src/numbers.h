/* SPDX-License-Identifier: MIT
 * Firmware libc: what reads and writes numbers shares. Not for programs. */
#ifndef TP_LIBC_NUMBERS_H
#define TP_LIBC_NUMBERS_H

/** A whole number, least significant word first. */
union tp_whole {
  unsigned int word[4];
  unsigned long two;
  unsigned long long four;
};

enum { kNegative = 1, kTooLarge = 2 };

/** Magnitude of the number at s, which ends before `limit` (0: at its own end), modulo 2^(16 words); the flags above. *end is
 * behind all its digits, or s where there are none. */
int tp_read_whole(const char* s, const char* limit, const char** end, int base, union tp_whole* v, int words);

/** The same for floating point: decimal, hexadecimal, inf, nan. *is_finite: digits, and not all of them 0. */
long double tp_read_real(const char* s, const char* limit, const char** end, int* is_finite);

/** v * base^n, base 2 or 10, rounded once where the power is exact. */
long double tp_scaled(long double v, int base, int n);
#endif
