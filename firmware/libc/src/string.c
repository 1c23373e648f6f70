/* SPDX-License-Identifier: MIT
 * Firmware libc: memory and strings. Plain loops, compiled and costed like the program itself. */
#include <string.h>

void *memcpy(void *to, const void *from, size_t n)
{
  char *t = to;
  const char *f = from;
  while (n--) *t++ = *f++;
  return to;
}

void *memmove(void *to, const void *from, size_t n)
{
  char *t = to;
  const char *f = from;
  if (t < f) {
    while (n--) *t++ = *f++;
  } else {
    while (n) {
      n--;
      t[n] = f[n];
    }
  }
  return to;
}

void *memset(void *to, int value, size_t n)
{
  char *t = to;
  while (n--) *t++ = (char)value;
  return to;
}

int memcmp(const void *a, const void *b, size_t n)
{
  const unsigned char *x = a, *y = b;
  for (; n; n--, x++, y++)
    if (*x != *y) return (int)*x - (int)*y;
  return 0;
}

void *memchr(const void *s, int c, size_t n)
{
  const unsigned char *p = s;
  for (; n; n--, p++)
    if (*p == (unsigned char)c) return (void *)p;
  return 0;
}

size_t strlen(const char *s)
{
  const char *p = s;
  while (*p) p++;
  return (size_t)(p - s);
}

char *strcpy(char *to, const char *from)
{
  char *t = to;
  while ((*t++ = *from++)) {
  }
  return to;
}

char *strncpy(char *to, const char *from, size_t n)
{
  char *t = to;
  while (n && *from) *t++ = *from++, n--;
  while (n) *t++ = 0, n--;
  return to;
}

char *strcat(char *to, const char *from)
{
  strcpy(to + strlen(to), from);
  return to;
}

char *strncat(char *to, const char *from, size_t n)
{
  char *t = to + strlen(to);
  while (n && *from) *t++ = *from++, n--;
  *t = 0;
  return to;
}

int strcmp(const char *a, const char *b)
{
  while (*a && *a == *b) a++, b++;
  return (int)(unsigned char)*a - (int)(unsigned char)*b;
}

int strncmp(const char *a, const char *b, size_t n)
{
  for (; n; n--, a++, b++) {
    if (*a != *b) return (int)(unsigned char)*a - (int)(unsigned char)*b;
    if (!*a) break;
  }
  return 0;
}

static int lower(int c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; }

int strcasecmp(const char *a, const char *b)
{
  while (*a && lower(*a) == lower(*b)) a++, b++;
  return lower((unsigned char)*a) - lower((unsigned char)*b);
}

int strcoll(const char *a, const char *b) { return strcmp(a, b); }

size_t strxfrm(char *to, const char *from, size_t n)
{
  size_t length = strlen(from);
  if (n) strncpy(to, from, n);
  return length;
}

char *strchr(const char *s, int c)
{
  for (;; s++) {
    if (*s == (char)c) return (char *)s;
    if (!*s) return 0;
  }
}

char *strrchr(const char *s, int c)
{
  const char *found = 0;
  for (;; s++) {
    if (*s == (char)c) found = s;
    if (!*s) return (char *)found;
  }
}

char *strstr(const char *s, const char *part)
{
  size_t n = strlen(part);
  for (;; s++) {
    if (!strncmp(s, part, n)) return (char *)s;
    if (!*s) return 0;
  }
}

size_t strspn(const char *s, const char *set)
{
  size_t n = 0;
  while (s[n] && strchr(set, s[n])) n++;
  return n;
}

size_t strcspn(const char *s, const char *set)
{
  size_t n = 0;
  while (s[n] && !strchr(set, s[n])) n++;
  return n;
}

char *strpbrk(const char *s, const char *set)
{
  s += strcspn(s, set);
  return *s ? (char *)s : 0;
}

char *strtok(char *s, const char *separators)
{
  static char *next;
  if (s) next = s;
  if (!next) return 0;
  next += strspn(next, separators);
  if (!*next) return next = 0;
  s = next;
  next += strcspn(next, separators);
  if (*next) *next++ = 0;
  else next = 0;
  return s;
}

char *strerror(int number) { return number ? "error" : "no error"; }
