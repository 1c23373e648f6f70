/* SPDX-License-Identifier: MIT
 * Firmware libc: sscanf. What is too large for its type loses its upper bits. Not: wide characters. */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include "numbers.h"

static int in_set(const char *set, const char *end, char c)
{
  int inside = 0, negated = *set == '^';
  if (negated) set++;
  for (; set < end; set++) {
    if (set + 2 < end && set[1] == '-') {
      if (c >= set[0] && c <= set[2]) inside = 1;
      set += 2;
    } else if (*set == c) {
      inside = 1;
    }
  }
  return inside != negated;
}

/* what letters before a conversion make of an int */
enum { kChar = -2, kLong = 1, kLongLong };

static void store_whole(void *to, const union tp_whole *v, int size)
{
  if (size <= kChar) *(char *)to = (char)v->word[0];
  else if (size < kLong) *(unsigned int *)to = v->word[0];
  else if (size == kLong) *(unsigned long *)to = v->two;
  else *(unsigned long long *)to = v->four;
}

static int base_of(char conversion)
{
  switch (conversion) {
    case 'd': case 'u': return 10;
    case 'x': case 'X': case 'p': return 16;
    case 'o': return 8;
    case 'i': return 0;
    default: return -1;
  }
}

int vsscanf(const char *s, const char *format, va_list given)
{
  int done = 0;
  const char *start = s;
  va_list list;
  va_copy(list, given);
  for (; *format; format++) {
    int is_skipped = 0, size = 0, base;
    unsigned int width = 0, n = 0;
    const char *end, *limit;
    union tp_whole v;
    if (isspace(*format)) {
      while (isspace(*s)) s++;
      continue;
    }
    if (*format != '%') {
      if (!*s) goto no_input;
      if (*s != *format) break;
      s++;
      continue;
    }
    format++;
    if (*format == '*') is_skipped = 1, format++;
    while (isdigit(*format)) width = width * 10 + (unsigned int)(*format++ - '0');
    for (;; format++) {
      if (*format == 'l') size++;
      else if (*format == 'h') size--;
      else if (*format == 'j' || *format == 'L') size = kLongLong;
      else if (*format != 'z' && *format != 't') break;
    }
    if (*format == 'n') {
      v.four = (unsigned int)(s - start);
      if (!is_skipped) store_whole(va_arg(list, void *), &v, size);
      continue;
    }
    if (*format != 'c' && *format != '[')
      while (isspace(*s)) s++;
    if (!*s) goto no_input;
    if (*format == '%') {
      if (*s++ != '%') break;
      continue;
    }
    if (*format == 'c') {
      char *to = is_skipped ? 0 : va_arg(list, char *);
      if (!width) width = 1;
      for (; width; width--, s++) {
        if (!*s) goto no_input;
        if (to) *to++ = *s;
      }
      done += !is_skipped;
      continue;
    }
    if (*format == 's' || *format == '[') {
      const char *set = 0, *set_end = 0;
      char *to = is_skipped ? 0 : va_arg(list, char *);
      if (*format == '[') {
        set = set_end = format + 1;
        if (*set_end == '^') set_end++;
        if (*set_end == ']') set_end++;
        while (*set_end && *set_end != ']') set_end++;
        format = set_end;
        if (!*set_end) break;
      }
      while (*s && (!width || n < width) && (set ? in_set(set, set_end, *s) : !isspace(*s))) {
        if (to) *to++ = *s;
        s++, n++;
      }
      if (!n) break;
      if (to) *to = 0, done++;
      continue;
    }
    limit = width ? s + width : 0;
    base = base_of(*format);
    if (base >= 0) {
      if (tp_read_whole(s, limit, &end, base, &v, 4) & kNegative) v.four = 0 - v.four;
      if (end == s) break;
      if (!is_skipped) store_whole(va_arg(list, void *), &v, size);
    } else {
      int is_finite;
      long double real;
      if (!*format || !strchr("fegaFEGA", *format)) break;
      real = tp_read_real(s, limit, &end, &is_finite);
      if (end == s) break;
      if (is_skipped) {
      } else if (size == kLongLong) {
        *va_arg(list, long double *) = real;
      } else {
        *va_arg(list, float *) = (float)real;
      }
    }
    s = end;
    done += !is_skipped;
    continue;
  no_input:
    if (!done) done = EOF;
    break;
  }
  va_end(list);
  return done;
}

int sscanf(const char *s, const char *format, ...)
{
  int n;
  va_list list;
  va_start(list, format);
  n = vsscanf(s, format, list);
  va_end(list);
  return n;
}
