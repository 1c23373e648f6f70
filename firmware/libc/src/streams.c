/* SPDX-License-Identifier: MIT
 * Firmware libc: stdout and stderr, the only streams, which are the console. */
#include <stdio.h>
#include <string.h>

int write(int handle, void *bytes, unsigned int length);

struct tp_file { int unused; };
static struct tp_file console;
FILE *const tp_stdout = &console;

int vfprintf(FILE *to, const char *format, va_list list) { return vprintf(format, list); }

int fprintf(FILE *to, const char *format, ...)
{
  int n;
  va_list list;
  va_start(list, format);
  n = vprintf(format, list);
  va_end(list);
  return n;
}

int fputs(const char *s, FILE *to)
{
  write(1, (void *)s, strlen(s));
  return 0;
}

size_t fwrite(const void *from, size_t bytes, size_t n, FILE *to)
{
  if (bytes == 0 || n == 0) return 0;
  write(1, (void *)from, bytes * n);
  return n;
}

int fputc(int c, FILE *to) { return putchar(c); }
int putc(int c, FILE *to) { return putchar(c); }
int fflush(FILE *to) { return 0; }
