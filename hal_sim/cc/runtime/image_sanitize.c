/* SPDX-License-Identifier: MIT
 * Runtime of --sanitize, inside the image. Checks that an access lies in a global, a live local variable, a heap
 * block or a string constant, and receives the 16-bit overflow reports of -fsanitize. No shadow memory: tables.
 * Not found: a pointer that strays from one live object exactly into another.
 */
#include <stdio.h>
#include "hal_sim/host/image_abi.h"

struct object {
  char *begin;
  tp_i64 size;
  const char *name;
};
extern const struct object tp_objects_begin[], tp_objects_end[];
extern char tp_data_begin[], tp_data_end[], tp_text_begin[];
extern char tp_image_heap[] __attribute__((weak));
extern unsigned int tp_image_heap_bytes __attribute__((weak));

#define LOCALS 256
static struct { char *begin; tp_i64 size; } locals[LOCALS];
static int depth;

void tp_image_local_enter(char *begin, tp_i64 size)
{
  if (depth < LOCALS) {
    locals[depth].begin = begin;
    locals[depth].size = size;
  }
  depth++;
}

void tp_image_local_leave(tp_i64 count) { depth -= (int)count; }

static int telling; /* its own snprintf is not to be looked at */

static void report(const char *where, const char *what, const char *name)
{
  char message[200];
  telling = 1;
  snprintf(message, sizeof message, "%s: %s%s%s", where, what, name ? " of " : "", name ? name : "");
  tp_trap_message(TP_TRAP_SANITIZER, message);
}

struct block { unsigned int bytes, used; };

static int in_heap(char *p, tp_i64 size, const char **what)
{
  char *at = tp_image_heap, *end = tp_image_heap + tp_image_heap_bytes;
  if (!tp_image_heap || p < at || p >= end) return 0;
  while (at < end) {
    struct block *b = (struct block *)at;
    char *payload = at + sizeof *b, *next = payload + b->bytes;
    if (p < next) {
      if (p < payload || p + size > next) *what = "out of the bounds of a heap block";
      else if (!b->used) *what = "use of freed heap memory";
      return 1;
    }
    at = next;
  }
  return 1;
}

void tp_image_check(char *p, tp_i64 size, tp_i64 writes, const char *where)
{
  const struct object *o, *near_one = 0;
  const char *what = 0;
  int i;
  if (size == 0 || telling) return;
  for (i = (depth < LOCALS ? depth : LOCALS) - 1; i >= 0; i--)
    if (p >= locals[i].begin && p + size <= locals[i].begin + locals[i].size) return;
  if (depth > LOCALS) {
    char here;
    if (p > &here && p < &here + 262144L) return; /* deeper than the table: the stack as a whole */
  }
  if (in_heap(p, size, &what)) {
    if (what) report(where, what, 0);
    return;
  }
  for (o = tp_objects_begin; o < tp_objects_end; o++) {
    if (p >= o->begin && p + size <= o->begin + o->size) return;
    if (p + size > o->begin && p < o->begin + o->size + 32) near_one = o;
  }
  if (near_one) {
    report(where, writes ? "write out of bounds" : "read out of bounds", near_one->name);
    return;
  }
  for (i = (depth < LOCALS ? depth : LOCALS) - 1; i >= 0; i--)
    if (p + size > locals[i].begin - 32 && p < locals[i].begin + locals[i].size + 32) {
      report(where, writes ? "write out of bounds" : "read out of bounds", "a local variable");
      return;
    }
  if (p >= tp_data_begin && p < tp_data_end) return; /* data of the library, which is not instrumented */
  if (!writes && p >= tp_text_begin && p < tp_data_begin) return; /* constants, those that hold addresses, too */
  {
    char here; /* locals of functions whose address escaped before they were registered, interrupt frames */
    if (p > &here - 4096 && p < &here + 262144L) return;
  }
  report(where, (__UINTPTR_TYPE__)p < 4096 ? "null pointer used" : writes ? "write through a wild pointer" : "read through a wild pointer", 0);
}

/* --- 16-bit overflow, shifts, array bounds: layouts fixed by clang's -fsanitize --- */
struct source { const char *file; unsigned long line, column; };

static void tell(struct source *s, const char *what)
{
  char where[120];
  snprintf(where, sizeof where, "%s:%lu", s->file, s->line);
  report(where, what, 0);
}

#define HANDLER(name, what) \
  void __ubsan_handle_##name(struct source *s, void *a, void *b) { tell(s, what); } \
  void __ubsan_handle_##name##_abort(struct source *s, void *a, void *b) { tell(s, what); }
HANDLER(add_overflow, "integer overflow in an addition")
HANDLER(sub_overflow, "integer overflow in a subtraction")
HANDLER(mul_overflow, "integer overflow in a multiplication")
HANDLER(divrem_overflow, "integer overflow in a division")
HANDLER(negate_overflow, "integer overflow in a negation")
HANDLER(shift_out_of_bounds, "shift by more than the width of the operand")
HANDLER(out_of_bounds, "array index out of bounds")
