/* SPDX-License-Identifier: MIT
 * Firmware libc: the printf family. int arguments have 16 bits, %ld 32, double is single precision. %e and %g give some 16
 * digits, %f 17 places and all digits before them; zeros follow. Not: %a, wide characters. printf() and its like end in
 * write(), which a program may replace by its own, as with XC16; ours sends to the UART that __C30_UART names. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <tp_runtime.h>
#include "numbers.h"

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

/* a number as it is printed: sign or base, zeros, text, point, zeros, exponent; all but the text may be missing */
struct number {
  const char *prefix, *text, *exponent;
  unsigned int digits, before, point, after; /* characters of the text, zeros before it, points and zeros behind it */
  unsigned char *pairs;               /* in place of the text: two digits each, the leading one last */
};

static void put_times(struct sink *s, char c, int n)
{
  for (; n > 0; n--) put(s, c);
}

static void put_number(struct sink *s, const struct spec *f, const struct number *n)
{
  int pad = f->width - (int)(strlen(n->prefix) + n->before + n->digits + n->point + n->after + strlen(n->exponent));
  const char *text;
  unsigned int i = n->digits;
  if (!f->left && !f->zero) put_times(s, ' ', pad);
  for (text = n->prefix; *text; text++) put(s, *text);
  if (!f->left && f->zero) put_times(s, '0', pad);
  put_times(s, '0', (int)n->before);
  if (n->pairs)
    for (; i; i--) put(s, (char)('0' + (i & 1 ? n->pairs[i / 2] % 10 : n->pairs[i / 2 - 1] / 10)));
  else
    for (text = n->text; i; i--) put(s, *text++);
  put_times(s, '.', (int)n->point);
  put_times(s, '0', (int)n->after);
  for (text = n->exponent; *text; text++) put(s, *text);
  if (f->left) put_times(s, ' ', pad);
}

static void put_text(struct sink *s, struct spec *f, const char *prefix, const char *text, unsigned int n)
{
  struct number all = {prefix, text, "", n, 0, 0, 0, 0};
  f->zero = 0;
  put_number(s, f, &all);
}

static void put_integer(struct sink *s, struct spec *f, unsigned long long v, const char *prefix, unsigned int base, int upper)
{
  char digits[24], *p = digits + sizeof digits;
  const char *names = upper ? "0123456789ABCDEF" : "0123456789abcdef";
  struct number n = {prefix, 0, "", 0, 0, 0, 0, 0};
  unsigned int least = 1;
  if (f->precision >= 0) f->zero = 0, least = (unsigned int)f->precision;
  if (v >> 32) {
    for (; v; v /= base) *--p = names[(unsigned int)(v % base)];
  } else {
    unsigned long w = (unsigned long)v;
    for (; w >> 16; w /= base) *--p = names[(unsigned int)(w % base)];
    { unsigned int u = (unsigned int)w; for (; u; u /= base) *--p = names[u % base]; }
  }
  n.text = p, n.digits = (unsigned int)(digits + sizeof digits - p);
  if (base == 8 && f->alt && n.digits >= least) least = n.digits + 1; /* begins with 0 */
  if (n.digits < least) n.before = least - n.digits;
  put_number(s, f, &n);
}

/* --- floating point */

enum { kBias = 1023, kFractionBits = 52, kMostDigits = 18, kMostPairs = 155 };

union bits {
  long double v;
  unsigned long long whole;
  unsigned int word[4];
};

/* decimal digits of v < 1e18 with up to 17 places after the point; their number */
static unsigned int fixed(char *to, long double v, int places)
{
  unsigned long long whole = (unsigned long long)v, fraction;
  const long double scale = tp_scaled(1, 10, places);
  long double rest = (v - (long double)whole) * scale;
  char digits[20];
  unsigned int n = 0, count = 0;
  fraction = (unsigned long long)rest;
  rest -= (long double)fraction;
  /* exact halves go to the even digit, as the library does */
  if (rest > 0.5L || (rest == 0.5L && ((places ? fraction : whole) & 1))) fraction++;
  if ((long double)fraction >= scale) whole++, fraction -= (unsigned long long)scale;
  do digits[n++] = (char)('0' + (int)(whole % 10)), whole /= 10; while (whole);
  while (n) to[count++] = digits[--n];
  if (places > 0) {
    to[count++] = '.';
    for (; n < (unsigned int)places; n++) digits[n] = (char)('0' + (int)(fraction % 10)), fraction /= 10;
    while (n) to[count++] = digits[--n];
  }
  return count;
}

/* decimal digits of v >= 1e18, which is whole: its fraction, and eight bits more a round; their number */
static unsigned int large(unsigned char *pairs, long double v)
{
  union bits u;
  unsigned int n = 0, i, carry;
  int more;
  unsigned long long m;
  u.v = v;
  more = (int)(u.word[3] >> 4) - kBias - kFractionBits;
  u.word[3] = (u.word[3] & 0xF) | 0x10; /* the hidden bit in place of the exponent */
  m = u.whole;
  for (; m; m /= 100) pairs[n++] = (unsigned char)(m % 100);
  while (more) {
    const int by = more < 8 ? more : 8;
    more -= by;
    for (i = 0, carry = 0; i < n; i++) {
      carry += (unsigned int)pairs[i] << by;
      pairs[i] = (unsigned char)(carry % 100);
      carry /= 100;
    }
    for (; carry; carry /= 100) pairs[n++] = (unsigned char)(carry % 100);
  }
  return 2 * n - (pairs[n - 1] < 10);
}

/* v > 0 to so many decimal digits, without a point; the exponent of the first to *e */
static void rounded_to(char *to, long double v, int digits, int *e)
{
  const long double end = tp_scaled(1, 10, digits);
  union bits u;
  long double scaled, rest;
  unsigned long long n;
  int bits, low = 0;
  if (v < 1e-300L) v *= 1e30L, low = 30; /* it may have no hidden bit */
  u.v = v;
  bits = (int)(u.word[3] >> 4) - kBias;
  /* log10(2), never more than it is; one too low shows */
  *e = (int)((long)bits * (bits < 0 ? 19729 : 19728) >> 16);
  scaled = tp_scaled(v, 10, digits - 1 - *e);
  if (scaled >= end) scaled = tp_scaled(v, 10, digits - 1 - ++*e);
  n = (unsigned long long)scaled;
  rest = scaled - (long double)n;
  if (rest > 0.5L || (rest == 0.5L && (n & 1))) n++;
  if ((long double)n >= end) n /= 10, ++*e; /* 9.99 has become 10.0 */
  *e -= low;
  while (digits--) to[digits] = (char)('0' + (int)(n % 10)), n /= 10;
}

/* e+05 */
static void exponent_text(char *to, int e, char letter)
{
  unsigned int v = e < 0 ? 0u - (unsigned int)e : (unsigned int)e;
  *to++ = letter;
  *to++ = e < 0 ? '-' : '+';
  if (v >= 100) *to++ = (char)('0' + v / 100), v %= 100;
  *to++ = (char)('0' + v / 10);
  *to++ = (char)('0' + v % 10);
  *to = 0;
}

/* %f of what has more digits than 64 bits hold */
__attribute__((noinline)) static void put_large(struct sink *s, const struct spec *f, struct number *n, long double v)
{
  unsigned char pairs[kMostPairs];
  n->pairs = pairs;
  n->digits = large(pairs, v);
  put_number(s, f, n);
}

/* %e, and %g with an exponent or without: digits, of which those from `point` on are behind it */
static void put_scientific(struct sink *s, const struct spec *f, struct number *n, long double v, int places, char kind)
{
  enum { kMostZeros = 4 }; /* of 0.0001 */
  char digits[kMostZeros + kMostDigits], text[kMostZeros + kMostDigits + 1], exponent[6];
  const int is_general = (kind | 0x20) == 'g';
  int made, count, e = 0, point = 1, zeros = 0, i;
  if (is_general) places -= places > 0;
  made = places < kMostDigits ? places + 1 : kMostDigits;
  for (i = 0; i < kMostZeros + kMostDigits; i++) digits[i] = '0';
  if (v != 0) rounded_to(digits + kMostZeros, v, made, &e);
  if (is_general && e >= -kMostZeros && e <= places) {
    if (e < 0) zeros = -e;
    else point = e + 1;
  } else {
    exponent_text(exponent, e, (char)(kind - (is_general ? 2 : 0)));
    n->exponent = exponent;
  }
  count = zeros + made;
  if (is_general && !f->alt)
    while (count > point && digits[kMostZeros - zeros + count - 1] == '0') count--;
  else
    n->after = (unsigned int)(places + 1 - made);
  for (i = 0; i < count; i++) {
    if (i == point) text[n->digits++] = '.';
    text[n->digits++] = digits[kMostZeros - zeros + i];
  }
  if (count < point) n->after = (unsigned int)(point - count);
  n->point = count <= point && (f->alt || (n->after && !is_general));
  n->text = text;
  put_number(s, f, n);
}

static void put_float(struct sink *s, struct spec *f, long double v, char kind)
{
  char text[40];
  union bits u;
  struct number n = {"", text, "", 0, 0, 0, 0, 0};
  const int places = f->precision < 0 ? 6 : f->precision, is_upper = !(kind & 0x20);
  u.v = v;
  if (u.word[3] & 0x8000 && v == v) n.prefix = "-", v = -v;
  else if (f->plus) n.prefix = "+";
  else if (f->space) n.prefix = " ";
  if (v - v != 0) {
    const char *name = v == v ? "INFinf" : "NANnan";
    put_text(s, f, v == v ? n.prefix : "", is_upper ? name : name + 3, 3);
  } else if ((kind | 0x20) != 'f') {
    put_scientific(s, f, &n, v, places, kind);
  } else {
    const int made = v >= 1e18L ? 0 : places < 17 ? places : 17;
    n.after = (unsigned int)(places - made);
    n.point = made == 0 && (places || f->alt);
    if (v >= 1e18L) {
      put_large(s, f, &n, v);
      return;
    }
    n.digits = fixed(text, v, made);
    put_number(s, f, &n);
  }
}

/* what letters before a conversion make of an int */
enum { kChar = -2, kLong = 1, kLongLong }; /* also long double */

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
    int size = 0;
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
    for (;; format++) {
      if (*format == 'l') size++;
      else if (*format == 'h') size--;
      else if (*format == 'j' || *format == 'L') size = kLongLong;
      else if (*format != 'z' && *format != 't') break;
    }
    switch (*format) {
      case 'd':
      case 'i': {
        long long v = size >= kLongLong ? va_arg(list, long long)
                      : size == kLong   ? va_arg(list, long)
                                        : va_arg(list, int);
        if (size <= kChar) v = (signed char)v;
        prefix = v < 0 ? "-" : f.plus ? "+" : f.space ? " " : "";
        put_integer(s, &f, v < 0 ? 0ULL - (unsigned long long)v : (unsigned long long)v, prefix, 10, 0);
        break;
      }
      case 'u':
      case 'x':
      case 'X':
      case 'o': {
        unsigned long long v = size >= kLongLong ? va_arg(list, unsigned long long)
                               : size == kLong   ? va_arg(list, unsigned long)
                                                 : va_arg(list, unsigned int);
        if (size <= kChar) v = (unsigned char)v;
        if (f.alt && v) prefix = *format == 'x' ? "0x" : *format == 'X' ? "0X" : "";
        put_integer(s, &f, v, prefix, *format == 'u' ? 10 : *format == 'o' ? 8 : 16, *format == 'X');
        break;
      }
      case 'n': {
        void *to = va_arg(list, void *);
        if (size <= kChar) *(signed char *)to = (signed char)s->count;
        else if (size < kLong) *(int *)to = (int)s->count;
        else if (size == kLong) *(long *)to = (long)s->count;
        else *(long long *)to = (long long)s->count;
        break;
      }
      case 'p': put_integer(s, &f, (unsigned long long)(__UINTPTR_TYPE__)va_arg(list, void *), "", 16, 0); break;
      case 'c': {
        char c = (char)va_arg(list, int);
        put_text(s, &f, "", &c, 1);
        break;
      }
      case 's': {
        const char *text = va_arg(list, const char *);
        unsigned int n = 0;
        if (!text) text = "(null)";
        while (text[n] && (f.precision < 0 || n < (unsigned int)f.precision)) n++;
        put_text(s, &f, "", text, n);
        break;
      }
      case 'f': case 'F': case 'e': case 'E': case 'g': case 'G': {
        long double v = size == kLongLong ? va_arg(list, long double) : va_arg(list, double);
        put_float(s, &f, v, *format);
        break;
      }
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

