/* SPDX-License-Identifier: MIT
 * Firmware libc: the heap of programs written for Webots' interfaces. They come from the PC, where a leak of some
 * bytes a step is never noticed; so theirs has 1 MB, outside the robot's own data. A first fit, as in malloc.c. The
 * robot itself has 8 KB of memory in all: see docs/webots.md. */
#include <stdlib.h>
#include <string.h>
#include "hal_sim/host/pins_virtual.h"

#define HEAP_BYTES (1L << 20)

struct block {
  long bytes; /* of the payload, a multiple of 8 */
  long used;
};

char *tp_webots_heap; /* null before the first call; --sanitize asks for it */
#define heap tp_webots_heap
static struct block *lowest; /* nothing below it is free */

static struct block *next_of(struct block *b) { return (struct block *)((char *)(b + 1) + b->bytes); }
static struct block *end_of_heap(void) { return (struct block *)(heap + HEAP_BYTES); }

static void begin(void)
{
  heap = tp_virtual_heap(HEAP_BYTES);
  lowest = (struct block *)heap;
  lowest->bytes = HEAP_BYTES - (long)sizeof(struct block);
  lowest->used = 0;
}

void *malloc(size_t wanted)
{
  long bytes = ((long)wanted + 7) & ~7L;
  struct block *b;
  if (!heap) begin();
  if (bytes == 0) return 0;
  while (lowest < end_of_heap() && lowest->used) lowest = next_of(lowest);
  for (b = lowest; b < end_of_heap(); b = next_of(b)) {
    if (b->used) continue;
    while (next_of(b) < end_of_heap() && !next_of(b)->used) b->bytes += next_of(b)->bytes + (long)sizeof(struct block);
    if (b->bytes < bytes) continue;
    if (b->bytes >= bytes + (long)sizeof(struct block) + 8) {
      long rest = b->bytes - bytes - (long)sizeof(struct block);
      b->bytes = bytes;
      next_of(b)->bytes = rest;
      next_of(b)->used = 0;
    }
    b->used = 1;
    return b + 1;
  }
  return 0;
}

void free(void *p)
{
  struct block *b = (struct block *)p - 1;
  if (!p) return;
  b->used = 0;
  if (b < lowest) lowest = b;
}

void *calloc(size_t n, size_t bytes)
{
  unsigned long all = (unsigned long)n * bytes;
  void *p = all > 0xFFF8UL ? 0 : malloc((size_t)all);
  if (p) memset(p, 0, (size_t)all);
  return p;
}

void *realloc(void *old, size_t bytes)
{
  void *p;
  long before = old ? ((struct block *)old - 1)->bytes : 0;
  if (old && bytes && before >= (long)bytes) return old;
  p = malloc(bytes);
  if (p && old) memcpy(p, old, (size_t)before);
  if (p || !bytes) free(old);
  return p;
}
