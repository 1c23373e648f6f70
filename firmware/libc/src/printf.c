/* SPDX-License-Identifier: MIT
 * Firmware libc: the printf family. int arguments have 16 bits, %ld 32, %f and friends print a single-precision
 * number. printf() and its like end in write(), which a program may replace by its own, as with XC16; ours sends to
 * the UART that __C30_UART names. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <tp_runtime.h>

struct sink {
  char *at, *end;      /* memory, or 0 */
  unsigned int count;  /* characters made, kept or not */
  char line[32];       /* console output is handed over in pieces */
  unsigned int filled;
};

int __C30_UART = 1;

enum { kStdout = 1 };

int write(int handle, void *bytes, unsigned int length);
__attribute__((weak)) int write(int handle, void *bytes, unsigned int length)
{
  tp_console(bytes, length, __C30_UART);
  return (int)length;
}

static void put(struct sink *s, char c)
{
  s->count++;
  if (s->at) {
    if (s->at < s->end) *s->at++ = c;
  } else {
    s->line[s->filled++] = c;
    if (s->filled == sizeof s->line) write(kStdout, s->line, s->filled), s->filled = 0;
  }
}

struct spec {
  int left, plus, space, alt, zero, width, precision;
};

static void put_padded(struct sink *s, const struct spec *f, const char *prefix, const char *body, unsigned int n)
{
  int pad = f->width - (int)n - (int)strlen(prefix);
  if (!f->left && !f->zero)
    for (; pad > 0; pad--) put(s, ' ');
  while (*prefix) put(s, *prefix++);
  if (!f->left && f->zero)
    for (; pad > 0; pad--) put(s, '0');
  while (n--) put(s, *body++);
  for (; pad > 0; pad--) put(s, ' ');
}

static void put_integer(struct sink *s, struct spec *f, unsigned long long v, const char *prefix, unsigned int base, int upper)
{
  char digits[40], *p = digits + sizeof digits;
  const char *names = upper ? "0123456789ABCDEF" : "0123456789abcdef";
  int n;
  if (f->precision >= 0) f->zero = 0;
  if (v >> 32) {
    for (; v; v /= base) *--p = names[(unsigned int)(v % base)];
  } else {
    unsigned long w = (unsigned long)v;
    for (; w >> 16; w /= base) *--p = names[(unsigned int)(w % base)];
    { unsigned int u = (unsigned int)w; for (; u; u /= base) *--p = names[u % base]; }
  }
  n = (int)(digits + sizeof digits - p);
  while (n < (f->precision < 0 ? 1 : f->precision) && n < 38) *--p = '0', n++;
  put_padded(s, f, prefix, p, (unsigned int)n);
}

/* decimal digits of v with `places` after the point; returns their number. v < 1e18 */
static int fixed(char *to, long double v, int places)
{
  unsigned long long whole;
  long double rest, scale = 1;
  char digits[24];
  int n = 0, count = 0, i;
  unsigned long long fraction;
  for (i = 0; i < places && i < 17; i++) scale *= 10;
  whole = (unsigned long long)v;
  rest = (v - (long double)whole) * scale;
  fraction = (unsigned long long)rest;
  rest -= (long double)fraction;
  /* exact halves go to the even digit, as the library does */
  if (rest > 0.5L || (rest == 0.5L && (fraction & 1))) fraction++;
  if (places == 0 && rest == 0.5L && scale == 1) fraction = whole & 1;
  if ((long double)fraction >= scale) whole++, fraction -= (unsigned long long)scale;
  do digits[n++] = (char)('0' + (int)(whole % 10)), whole /= 10; while (whole);
  while (n) to[count++] = digits[--n];
  if (places > 0) {
    to[count++] = '.';
    for (i = 0; i < places && i < 17; i++) digits[i] = (char)('0' + (int)(fraction % 10)), fraction /= 10;
    while (i) to[count++] = digits[--i];
    for (i = 17; i < places && count < 60; i++) to[count++] = '0';
  }
  return count;
}

static int exponent_of(long double *v)
{
  int e = 0;
  if (*v == 0) return 0;
  while (*v >= 10) *v /= 10, e++;
  while (*v < 1) *v *= 10, e--;
  return e;
}

static int with_exponent(char *to, long double v, int places, int upper)
{
  int e = exponent_of(&v), n = fixed(to, v, places);
  if (to[1] == '0' && to[0] == '1' && n > 1 && to[1] != '.') { /* 9.99 rounded up to 10 */
    v /= 10, e++;
    n = fixed(to, v, places);
  }
  to[n++] = upper ? 'E' : 'e';
  to[n++] = e < 0 ? '-' : '+';
  if (e < 0) e = -e;
  to[n++] = (char)('0' + e / 10);
  to[n++] = (char)('0' + e % 10);
  return n;
}

static void put_float(struct sink *s, struct spec *f, double value, char kind)
{
  char text[72];
  const char *prefix = "";
  long double v = value;
  int n, upper = kind == 'E' || kind == 'G', places = f->precision < 0 ? 6 : f->precision;
  if (value != value) {
    f->zero = 0;
    put_padded(s, f, "", "nan", 3);
    return;
  }
  if (v < 0 || (v == 0 && 1 / value < 0)) prefix = "-", v = -v;
  else if (f->plus) prefix = "+";
  else if (f->space) prefix = " ";
  if (v > 3.5e38L) {
    f->zero = 0;
    put_padded(s, f, prefix, "inf", 3);
    return;
  }
  if (places > 30) places = 30;
  if (kind == 'g' || kind == 'G') {
    long double scaled = v;
    int e = exponent_of(&scaled);
    if (places == 0) places = 1;
    if (v != 0) {
      /* the exponent after rounding decides */
      n = with_exponent(text, v, places - 1, 0);
      e = (text[n - 2] - '0') * 10 + text[n - 1] - '0';
      if (text[n - 3] == '-') e = -e;
    }
    if (v != 0 && (e < -4 || e >= places)) {
      n = with_exponent(text, v, places - 1, upper);
      if (!f->alt) { /* zeros before the exponent go */
        int cut = n - 4, last = cut;
        while (last > 1 && text[last - 1] == '0') last--;
        if (last > 1 && text[last - 1] == '.') last--;
        if (places > 1) {
          memmove(text + last, text + cut, 4);
          n = last + 4;
        }
      }
    } else {
      n = fixed(text, v, places - 1 - (v == 0 ? 0 : e));
      if (!f->alt && memchr(text, '.', (size_t)n)) {
        while (text[n - 1] == '0') n--;
        if (text[n - 1] == '.') n--;
      }
    }
  } else if (kind == 'e' || kind == 'E' || v >= 1e18L) {
    n = with_exponent(text, v, places, upper);
  } else {
    n = fixed(text, v, places);
  }
  put_padded(s, f, prefix, text, (unsigned int)n);
}

static int number_in(const char **format, va_list *list)
{
  int v = 0;
  if (**format == '*') {
    (*format)++;
    return va_arg(*list, int);
  }
  while (**format >= '0' && **format <= '9') v = v * 10 + *(*format)++ - '0';
  return v;
}

static void format_into(struct sink *s, const char *format, va_list given)
{
  va_list list;
  va_copy(list, given);
  for (; *format; format++) {
    if (*format != '%') {
      put(s, *format);
      continue;
    }
    struct spec f = {0, 0, 0, 0, 0, 0, -1};
    int longs = 0;
    const char *prefix = "";
    for (format++;; format++) {
      if (*format == '-') f.left = 1;
      else if (*format == '+') f.plus = 1;
      else if (*format == ' ') f.space = 1;
      else if (*format == '#') f.alt = 1;
      else if (*format == '0') f.zero = 1;
      else break;
    }
    f.width = number_in(&format, &list);
    if (f.width < 0) f.left = 1, f.width = -f.width;
    if (*format == '.') format++, f.precision = number_in(&format, &list);
    for (; *format == 'l' || *format == 'h' || *format == 'z'; format++)
      if (*format == 'l') longs++;
    switch (*format) {
      case 'd':
      case 'i': {
        long long v = longs > 1 ? va_arg(list, long long) : longs ? va_arg(list, long) : va_arg(list, int);
        prefix = v < 0 ? "-" : f.plus ? "+" : f.space ? " " : "";
        put_integer(s, &f, v < 0 ? 0ULL - (unsigned long long)v : (unsigned long long)v, prefix, 10, 0);
        break;
      }
      case 'u':
      case 'x':
      case 'X':
      case 'o': {
        unsigned long long v = longs > 1 ? va_arg(list, unsigned long long) : longs ? va_arg(list, unsigned long) : va_arg(list, unsigned int);
        if (f.alt && v) prefix = *format == 'x' ? "0x" : *format == 'X' ? "0X" : *format == 'o' ? "0" : "";
        put_integer(s, &f, v, prefix, *format == 'u' ? 10 : *format == 'o' ? 8 : 16, *format == 'X');
        break;
      }
      case 'p': put_integer(s, &f, (unsigned long long)(__UINTPTR_TYPE__)va_arg(list, void *), "", 16, 0); break;
      case 'c': {
        char c = (char)va_arg(list, int);
        f.zero = 0;
        put_padded(s, &f, "", &c, 1);
        break;
      }
      case 's': {
        const char *text = va_arg(list, const char *);
        unsigned int n = 0;
        if (!text) text = "(null)";
        while (text[n] && (f.precision < 0 || n < (unsigned int)f.precision)) n++;
        f.zero = 0;
        put_padded(s, &f, "", text, n);
        break;
      }
      case 'f': case 'F': case 'e': case 'E': case 'g': case 'G': put_float(s, &f, va_arg(list, double), *format); break;
      case '%': put(s, '%'); break;
      case 0: va_end(list); return;
      default: put(s, '%'); put(s, *format);
    }
  }
  va_end(list);
}

int vsnprintf(char *to, size_t size, const char *format, va_list list)
{
  struct sink s;
  char none;
  s.at = size ? to : &none, s.end = size ? to + size - 1 : &none, s.count = 0, s.filled = 0;
  format_into(&s, format, list);
  if (size) *s.at = 0;
  return (int)s.count;
}

int vsprintf(char *to, const char *format, va_list list) { return vsnprintf(to, 32767, format, list); }

int vprintf(const char *format, va_list list)
{
  struct sink s;
  s.at = s.end = 0, s.count = 0, s.filled = 0;
  format_into(&s, format, list);
  if (s.filled) write(kStdout, s.line, s.filled);
  return (int)s.count;
}

#define FORWARD(call) { int n; va_list list; va_start(list, format); n = call; va_end(list); return n; }
int printf(const char *format, ...) FORWARD(vprintf(format, list))
int sprintf(char *to, const char *format, ...) FORWARD(vsprintf(to, format, list))
int snprintf(char *to, size_t size, const char *format, ...) FORWARD(vsnprintf(to, size, format, list))

int puts(const char *s)
{
  write(kStdout, (void *)s, strlen(s));
  write(kStdout, "\n", 1);
  return 0;
}

int putchar(int c)
{
  char one = (char)c;
  write(kStdout, &one, 1);
  return c;
}

