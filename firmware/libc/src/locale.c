/* SPDX-License-Identifier: MIT
 * Firmware libc: the "C" locale, and its characters, which are bytes. */
#include <limits.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

char *setlocale(int category, const char *name)
{
  static char c[] = "C";
  if (category < LC_ALL || category > LC_TIME) return 0;
  return !name || !*name || !strcmp(name, c) ? c : 0;
}

struct lconv *localeconv(void)
{
  static struct lconv of_c;
  static char point[] = ".", none[] = "";
  char **text;
  of_c.decimal_point = point;
  for (text = &of_c.thousands_sep; text <= &of_c.negative_sign; text++) *text = none;
  memset(&of_c.int_frac_digits, CHAR_MAX, sizeof of_c - offsetof(struct lconv, int_frac_digits));
  return &of_c;
}

/* --- a character is a byte, and the byte 0 ends */

int mbtowc(wchar_t *to, const char *s, size_t n)
{
  if (!s) return 0; /* no shift states */
  if (n == 0) return -1;
  if (to) *to = (unsigned char)*s;
  return *s != 0;
}

int mblen(const char *s, size_t n) { return mbtowc(0, s, n); }

int wctomb(char *to, wchar_t c)
{
  if (!to) return 0;
  if (c > UCHAR_MAX) return -1;
  *to = (char)c;
  return 1;
}

size_t mbstowcs(wchar_t *to, const char *s, size_t n)
{
  size_t made = 0;
  if (!to) return strlen(s);
  for (; made < n; made++)
    if ((to[made] = (unsigned char)s[made]) == 0) break;
  return made;
}

size_t wcstombs(char *to, const wchar_t *s, size_t n)
{
  size_t made = 0;
  for (; !to || made < n; made++) {
    if (s[made] > UCHAR_MAX) return (size_t)-1;
    if (to) to[made] = (char)s[made];
    if (!s[made]) break;
  }
  return made;
}
