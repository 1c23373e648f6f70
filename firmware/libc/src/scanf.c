/* SPDX-License-Identifier: MIT
 * Firmware libc: sscanf with d i u x o c s f n, widths, h and l, assignment suppression and [sets]. */
#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

int vsscanf(const char *s, const char *format, va_list given)
{
  int done = 0;
  const char *start = s;
  va_list list;
  va_copy(list, given);
  for (; *format; format++) {
    int skip = 0, longs = 0, halves = 0;
    unsigned int width = 0;
    char word[40], *end;
    if (isspace(*format)) {
      while (isspace(*s)) s++;
      continue;
    }
    if (*format != '%') {
      if (*s != *format) break;
      s++;
      continue;
    }
    format++;
    if (*format == '*') skip = 1, format++;
    while (isdigit(*format)) width = width * 10 + (unsigned int)(*format++ - '0');
    for (; *format == 'l' || *format == 'h'; format++) longs += *format == 'l', halves += *format == 'h';
    if (*format == 'n') {
      *va_arg(list, int *) = (int)(s - start);
      continue;
    }
    if (*format == '%') {
      if (*s++ != '%') break;
      continue;
    }
    if (*format == 'c') {
      char *to = skip ? 0 : va_arg(list, char *);
      if (!width) width = 1;
      if (strlen(s) < width) break;
      for (; width; width--, s++)
        if (to) *to++ = *s;
      done += !skip;
      continue;
    }
    if (*format == 's' || *format == '[') {
      const char *set = 0, *set_end = 0;
      char *to = skip ? 0 : va_arg(list, char *);
      unsigned int n = 0;
      if (*format == '[') {
        set = set_end = format + 1;
        if (*set_end == '^') set_end++;
        if (*set_end == ']') set_end++;
        while (*set_end && *set_end != ']') set_end++;
        format = set_end;
        if (!*set_end) break;
      } else {
        while (isspace(*s)) s++;
      }
      while (*s && (!width || n < width) && (set ? in_set(set, set_end, *s) : !isspace(*s))) {
        if (to) *to++ = *s;
        s++, n++;
      }
      if (!n) break;
      if (to) *to = 0, done++;
      continue;
    }
    while (isspace(*s)) s++;
    if (!*s) {
      if (!done) done = EOF;
      break;
    }
    strncpy(word, s, sizeof word - 1);
    word[width && width < sizeof word ? width : sizeof word - 1] = 0;
    if (*format == 'f' || *format == 'e' || *format == 'g') {
      double v = strtod(word, &end);
      if (end == word) break;
      if (!skip) *va_arg(list, float *) = v;
    } else {
      int base = *format == 'x' || *format == 'X' ? 16 : *format == 'o' ? 8 : *format == 'i' ? 0 : 10;
      long v = strtol(word, &end, base);
      if (end == word) break;
      if (!skip) {
        if (longs) *va_arg(list, long *) = v;
        else if (halves > 1) *va_arg(list, char *) = (char)v;
        else *va_arg(list, int *) = (int)v;
      }
    }
    s += end - word;
    done += !skip;
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
