/* SPDX-License-Identifier: MIT
 * Firmware libc: numbers from text. A whole one is multiplied up word by word, so one loop serves long and long long; the
 * fraction of a floating-point one is a whole number of 64 bits first, which is scaled once. long double (64 bits) is good
 * to a unit or two in its last place, float is rounded from it. */
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include "numbers.h"

enum { kMostExponent = 9999 }; /* more is all the same: infinite, or 0 */

/* what is at s of a text that ends before `limit` */
static char at(const char *s, const char *limit)
{
  if (s == limit) return 0;
  return *s;
}

static int digit_of(char c)
{
  if (isdigit(c)) return c - '0';
  return isalpha(c) ? toupper(c) - 'A' + 10 : 99;
}

static const char *behind_sign(const char *s, const char *limit, int *is_negative)
{
  char c;
  while (isspace(at(s, limit))) s++;
  c = at(s, limit);
  *is_negative = c == '-';
  return c == '-' || c == '+' ? s + 1 : s;
}

/* 0x, with what follows left to the caller */
static int has_prefix(const char *s, const char *limit)
{
  return at(s, limit) == '0' && toupper(at(s + 1, limit)) == 'X';
}

/* v * base + digit; what leaves it */
static unsigned int push_digit(union tp_whole *v, int words, int base, int digit)
{
  unsigned int carry = (unsigned int)digit;
  int i;
  for (i = 0; i < words; i++) {
    unsigned long word = (unsigned long)v->word[i] * (unsigned int)base + carry;
    v->word[i] = (unsigned int)word;
    carry = (unsigned int)(word >> 16);
  }
  return carry;
}

int tp_read_whole(const char *s, const char *limit, const char **end, int base, union tp_whole *v, int words)
{
  int is_negative, flags, digit, i;
  for (i = 0; i < words; i++) v->word[i] = 0;
  *end = s;
  s = behind_sign(s, limit, &is_negative);
  flags = is_negative ? kNegative : 0;
  if ((base == 0 || base == 16) && has_prefix(s, limit) && isxdigit(at(s + 2, limit))) s += 2, base = 16;
  if (base == 0) base = at(s, limit) == '0' ? 8 : 10;
  for (; (digit = digit_of(at(s, limit))) < base; *end = ++s)
    if (push_digit(v, words, base, digit)) flags |= kTooLarge;
  return flags;
}

long strtol(const char *s, char **end, int base)
{
  union tp_whole v;
  const char *behind;
  const int flags = tp_read_whole(s, 0, &behind, base, &v, 2);
  const unsigned long most = flags & kNegative ? (unsigned long)LONG_MIN : LONG_MAX;
  if (end) *end = (char *)behind;
  if (flags & kTooLarge || v.two > most) errno = ERANGE, v.two = most;
  return (long)(flags & kNegative ? 0UL - v.two : v.two);
}

unsigned long strtoul(const char *s, char **end, int base)
{
  union tp_whole v;
  const char *behind;
  const int flags = tp_read_whole(s, 0, &behind, base, &v, 2);
  if (end) *end = (char *)behind;
  if (flags & kTooLarge) return errno = ERANGE, ULONG_MAX;
  return flags & kNegative ? 0UL - v.two : v.two;
}

long long strtoll(const char *s, char **end, int base)
{
  union tp_whole v;
  const char *behind;
  const int flags = tp_read_whole(s, 0, &behind, base, &v, 4);
  const unsigned long long most = flags & kNegative ? (unsigned long long)LLONG_MIN : LLONG_MAX;
  if (end) *end = (char *)behind;
  if (flags & kTooLarge || v.four > most) errno = ERANGE, v.four = most;
  return (long long)(flags & kNegative ? 0ULL - v.four : v.four);
}

unsigned long long strtoull(const char *s, char **end, int base)
{
  union tp_whole v;
  const char *behind;
  const int flags = tp_read_whole(s, 0, &behind, base, &v, 4);
  if (end) *end = (char *)behind;
  if (flags & kTooLarge) return errno = ERANGE, ULLONG_MAX;
  return flags & kNegative ? 0ULL - v.four : v.four;
}

long atol(const char *s) { return strtol(s, 0, 10); }
long long atoll(const char *s) { return strtoll(s, 0, 10); }
int atoi(const char *s) { return (int)strtol(s, 0, 10); }

/* --- floating point */

long double tp_scaled(long double v, int base, int n)
{
  enum { kStep = 300 }; /* 10^300 is finite */
  const int is_down = n < 0;
  if (v == 0) return v;
  if (is_down) n = -n;
  while (n) {
    int left = n < kStep ? n : kStep;
    long double by = 1, power = base;
    n -= left;
    for (; left; left >>= 1, power *= power)
      if (left & 1) by *= power;
    if (is_down) v /= by;
    else v *= by;
    if (v == 0 || v - v != 0) break;
  }
  return v;
}

/* behind the word, in letters of any size; 0: another one is there */
static const char *behind_word(const char *s, const char *limit, const char *word)
{
  for (; *word; word++, s++)
    if (tolower(at(s, limit)) != *word) return 0;
  return s;
}

static const char *behind_special(const char *s, const char *limit, long double *v)
{
  const char *behind = behind_word(s, limit, "inf"), *more;
  if (behind) {
    *v = HUGE_VAL;
    more = behind_word(behind, limit, "inity");
    return more ? more : behind;
  }
  behind = behind_word(s, limit, "nan");
  if (!behind) return 0;
  *v = NAN;
  if (at(behind, limit) != '(') return behind;
  for (more = behind + 1; isalnum(at(more, limit)) || at(more, limit) == '_';) more++;
  return at(more, limit) == ')' ? more + 1 : behind;
}

/* e or p, and a number behind it; to *exponent what it adds */
static const char *behind_exponent(const char *s, const char *limit, int *exponent)
{
  int is_negative, e = 0;
  const char *digits = s + 1;
  if (at(digits, limit) == '-' || at(digits, limit) == '+') digits = behind_sign(digits, limit, &is_negative);
  else is_negative = 0;
  if (!isdigit(at(digits, limit))) return s;
  for (; isdigit(at(digits, limit)); digits++)
    if (e < kMostExponent / 10) e = e * 10 + *digits - '0';
    else e = kMostExponent;
  *exponent += is_negative ? -e : e;
  return digits;
}

long double tp_read_real(const char *s, const char *limit, const char **end, int *is_finite)
{
  union tp_whole m;
  long double v;
  int is_negative, base = 10, digit, exponent = 0, is_fraction = 0, any = 0;
  const char *behind;
  *end = s, *is_finite = 0;
  m.four = 0;
  s = behind_sign(s, limit, &is_negative);
  behind = behind_special(s, limit, &v);
  if (behind) {
    *end = behind;
    return is_negative ? -v : v;
  }
  if (has_prefix(s, limit) && isxdigit(at(at(s + 2, limit) == '.' ? s + 3 : s + 2, limit))) s += 2, base = 16;
  for (;; s++) {
    if (at(s, limit) == '.' && !is_fraction) {
      is_fraction = 1;
      continue;
    }
    digit = digit_of(at(s, limit));
    if (digit >= base) break;
    any = 1;
    /* as many digits as surely fit; the others only count */
    if (m.word[3] < 0x1000) {
      push_digit(&m, 4, base, digit);
      exponent -= is_fraction;
    } else {
      exponent += !is_fraction;
    }
  }
  if (!any) return 0;
  if (base == 16) exponent *= 4;
  if (toupper(at(s, limit)) == (base == 16 ? 'P' : 'E')) s = behind_exponent(s, limit, &exponent);
  *end = s;
  *is_finite = m.four != 0;
  v = tp_scaled((long double)m.four, base == 16 ? 2 : 10, exponent);
  return is_negative ? -v : v;
}

long double strtold(const char *s, char **end)
{
  const char *behind;
  int is_finite;
  const long double v = tp_read_real(s, 0, &behind, &is_finite);
  if (end) *end = (char *)behind;
  if (is_finite && (v == 0 || v - v != 0)) errno = ERANGE;
  return v;
}

double strtod(const char *s, char **end)
{
  const char *behind;
  int is_finite;
  const double v = (double)tp_read_real(s, 0, &behind, &is_finite);
  if (end) *end = (char *)behind;
  if (is_finite && (v == 0 || v - v != 0)) errno = ERANGE;
  return v;
}

float strtof(const char *s, char **end) { return strtod(s, end); }
double atof(const char *s) { return strtod(s, 0); }
