/* SPDX-License-Identifier: MIT
 * Firmware libc: first-fit heap in what the linker was told to leave. */
#include <stdlib.h>
#include <string.h>

struct block {
  unsigned int bytes; /* of the payload, even */
  unsigned int used;
};

/* what the linker was told to leave */
extern char _heap[], _eheap[];
#define HEAP _heap
#define HEAP_END _eheap
#define HEAP_ROOM ((unsigned int)(HEAP_END - HEAP))
static int ready;

static struct block *next_of(struct block *b) { return (struct block *)((char *)(b + 1) + b->bytes); }
static struct block *end_of_heap(void) { return (struct block *)HEAP_END; }

void *malloc(size_t bytes)
{
  struct block *b = (struct block *)HEAP;
  if (!ready) {
    ready = 1;
    b->bytes = HEAP_ROOM - sizeof(struct block);
    b->used = 0;
  }
  if (bytes == 0 || bytes > HEAP_ROOM) return 0;
  bytes = (bytes + 3u) & ~3u;
  for (; b < end_of_heap(); b = next_of(b)) {
    if (b->used) continue;
    while (next_of(b) < end_of_heap() && !next_of(b)->used) b->bytes += next_of(b)->bytes + sizeof(struct block);
    if (b->bytes < bytes) continue;
    if (b->bytes >= bytes + sizeof(struct block) + 4) {
      unsigned int rest = b->bytes - bytes - sizeof(struct block);
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
  if (p) ((struct block *)p - 1)->used = 0;
}

void *calloc(size_t n, size_t bytes)
{
  unsigned long all = (unsigned long)n * bytes;
  void *p = all > HEAP_ROOM ? 0 : malloc((size_t)all);
  if (p) memset(p, 0, (size_t)all);
  return p;
}

void *realloc(void *old, size_t bytes)
{
  void *p;
  unsigned int before = old ? ((struct block *)old - 1)->bytes : 0;
  if (old && bytes && before >= bytes) return old;
  p = malloc(bytes);
  if (p && old) memcpy(p, old, before);
  if (p || !bytes) free(old);
  return p;
}
