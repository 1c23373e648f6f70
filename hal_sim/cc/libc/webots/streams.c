/* SPDX-License-Identifier: MIT
 * Firmware libc: files of programs written for Webots' interfaces, in a folder of the robot's own on the PC
 * (docs/webots.md); the robot itself has none. They take the time of their instructions and none of a disk's. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "hal_sim/host/pins_virtual.h"

#define NONE (-2)
#define LONGEST_FIELD 250 /* characters that one fscanf() takes at most */

int write(int handle, void *bytes, unsigned int length);

struct tp_file {
  tp_i64 handle; /* 0 the console */
  int kept;      /* a character that ungetc() gave back */
  char at_end, failed;
};

static struct tp_file console = {0, NONE, 0, 0};
FILE *const tp_stdout = &console;

FILE *fopen(const char *name, const char *mode)
{
  FILE *file;
  tp_i64 handle = tp_file_open(name, mode);
  if (handle <= 0) return 0;
  file = calloc(1, sizeof *file);
  if (!file) return 0;
  file->handle = handle;
  file->kept = NONE;
  return file;
}

int fclose(FILE *file)
{
  if (!file || !file->handle) return 0;
  tp_file_close(file->handle);
  free(file);
  return 0;
}

/* --- out */

static size_t put(FILE *to, const void *bytes, size_t n)
{
  if (!to) return 0;
  if (!to->handle) return (size_t)write(1, (void *)bytes, n);
  if (tp_file_write(to->handle, bytes, n) == (tp_i64)n) return n;
  to->failed = 1;
  return 0;
}

size_t fwrite(const void *from, size_t bytes, size_t n, FILE *to)
{
  return bytes ? put(to, from, bytes * n) / bytes : 0;
}

int fputs(const char *s, FILE *to)
{
  put(to, s, strlen(s));
  return 0;
}

int fputc(int c, FILE *to)
{
  char one = (char)c;
  return put(to, &one, 1) ? c : EOF;
}

int putc(int c, FILE *to) { return fputc(c, to); }

int vfprintf(FILE *to, const char *format, va_list list)
{
  char text[256], *all = text;
  int n;
  va_list again;
  if (to && !to->handle) return vprintf(format, list);
  va_copy(again, list);
  n = vsnprintf(text, sizeof text, format, list);
  if (n >= (int)sizeof text) {
    all = malloc((size_t)n + 1);
    if (!all) return -1;
    vsnprintf(all, (size_t)n + 1, format, again);
  }
  put(to, all, (size_t)n);
  if (all != text) free(all);
  va_end(again);
  return n;
}

int fprintf(FILE *to, const char *format, ...)
{
  int n;
  va_list list;
  va_start(list, format);
  n = vfprintf(to, format, list);
  va_end(list);
  return n;
}

int fflush(FILE *to)
{
  if (to && to->handle) tp_file_flush(to->handle);
  return 0;
}

/* --- in */

size_t fread(void *to, size_t bytes, size_t n, FILE *from)
{
  tp_i64 wanted = (tp_i64)bytes * n, got = 0;
  char *at = to;
  if (!from || !from->handle || !wanted) return 0;
  if (from->kept != NONE) *at++ = (char)from->kept, got = 1, from->kept = NONE;
  if (got < wanted) got += tp_file_read(from->handle, at, wanted - got);
  if (got < wanted) from->at_end = 1;
  return (size_t)(got / (tp_i64)bytes);
}

int fgetc(FILE *from)
{
  unsigned char c;
  return fread(&c, 1, 1, from) ? c : EOF;
}

int getc(FILE *from) { return fgetc(from); }

int ungetc(int c, FILE *from)
{
  if (c == EOF || !from) return EOF;
  from->kept = c;
  from->at_end = 0;
  return c;
}

char *fgets(char *to, int size, FILE *from)
{
  int n = 0, c = 0;
  while (n + 1 < size && c != '\n' && (c = fgetc(from)) != EOF) to[n++] = (char)c;
  to[n] = 0;
  return n ? to : 0;
}

/* the text that lies ahead is read as by sscanf(), and the file set behind what that has taken */
int tp_image_scan(const char *s, const char *format, va_list given, int *taken);

int fscanf(FILE *from, const char *format, ...)
{
  char ahead[LONGEST_FIELD + 1];
  int done, taken = 0, n, i;
  long start = ftell(from);
  va_list list;
  if (start < 0) return EOF;
  n = (int)fread(ahead, 1, LONGEST_FIELD, from);
  ahead[n] = 0;
  for (i = 0; i < n && strchr(" \t\r\n", ahead[i]); i++) {
  }
  if (i == n) return EOF;
  va_start(list, format);
  done = tp_image_scan(ahead, format, list, &taken);
  va_end(list);
  fseek(from, start + taken, SEEK_SET);
  return done;
}

/* --- where */

int fseek(FILE *file, long offset, int from)
{
  if (!file || !file->handle) return -1;
  if (from == SEEK_CUR && file->kept != NONE) offset--;
  file->kept = NONE;
  file->at_end = 0;
  return tp_file_seek(file->handle, offset, from) < 0 ? -1 : 0;
}

long ftell(FILE *file)
{
  if (!file || !file->handle) return -1;
  return (long)tp_file_seek(file->handle, 0, SEEK_CUR) - (file->kept != NONE);
}

void rewind(FILE *file) { fseek(file, 0, SEEK_SET); }
int feof(FILE *file) { return file && file->at_end; }
int ferror(FILE *file) { return file && file->failed; }
void clearerr(FILE *file) { file->at_end = file->failed = 0; }
int remove(const char *name) { return tp_file_remove(name) ? 0 : -1; }
void perror(const char *text) { printf("%s: failed\n", text); }
