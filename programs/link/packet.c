/* SPDX-License-Identifier: MIT */
#include "programs/link/packet.h"

#include <stdlib.h>
#include <string.h>

#define PROGRAM LINK_FROM_PROGRAM
#define ASKS LINK_FROM_ASKS
#define SIMULATOR LINK_FROM_SIMULATOR
#define LINK_RECORD(number, name, who, members, what, text) {number, #name, who, members, what, text},
static const struct link_row kRows[] = {
#include "programs/link/messages.def"
};
#undef LINK_RECORD

#define ROWS (sizeof kRows / sizeof *kRows)
#define HEAD 8 /* bytes before the members */

const struct link_row* link_rows(size_t* count) {
  *count = ROWS;
  return kRows;
}

const struct link_row* link_row_of(int number) {
  /* in their order */
  size_t low = 0, high = ROWS;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (kRows[middle].number == number) return &kRows[middle];
    if (kRows[middle].number < number)
      low = middle + 1;
    else
      high = middle;
  }
  return 0;
}

/* --- writing */

static unsigned char* room(struct link_packet* packet, size_t bytes) {
  size_t at = packet->size, needed = at + bytes;
  if (needed > packet->capacity) {
    size_t capacity = packet->capacity ? packet->capacity : 1024;
    while (capacity < needed) capacity *= 2;
    packet->bytes = (unsigned char*)realloc(packet->bytes, capacity);
    if (!packet->bytes) abort();
    packet->capacity = capacity;
  }
  packet->size = needed;
  return packet->bytes + at;
}

void link_begin(struct link_packet* packet, int number) {
  uint32_t head[2] = {(uint32_t)number, 0};
  packet->record = packet->size;
  memcpy(room(packet, HEAD), head, HEAD);
}

void link_int(struct link_packet* packet, int64_t value) { memcpy(room(packet, 8), &value, 8); }
void link_number(struct link_packet* packet, double value) { memcpy(room(packet, 8), &value, 8); }

void link_bytes(struct link_packet* packet, const void* bytes, size_t size) {
  size_t padded = (size + 7) & ~(size_t)7;
  unsigned char* to;
  link_int(packet, (int64_t)size);
  to = room(packet, padded);
  if (size) memcpy(to, bytes, size);
  memset(to + size, 0, padded - size);
}

void link_text(struct link_packet* packet, const char* text) { link_bytes(packet, text, text ? strlen(text) : 0); }

void link_numbers(struct link_packet* packet, const double* values, size_t count) {
  link_int(packet, (int64_t)count);
  if (count) memcpy(room(packet, count * 8), values, count * 8);
}

void link_end(struct link_packet* packet) {
  uint32_t bytes = (uint32_t)(packet->size - packet->record - HEAD);
  memcpy(packet->bytes + packet->record + 4, &bytes, 4);
}

void link_append(struct link_packet* packet, const struct link_packet* from) {
  if (from->size) memcpy(room(packet, from->size), from->bytes, from->size);
}

void link_clear(struct link_packet* packet) { packet->size = 0; }

void link_free(struct link_packet* packet) {
  free(packet->bytes);
  memset(packet, 0, sizeof *packet);
}

/* --- reading */

void link_read(struct link_reader* reader, const void* bytes, size_t size) {
  reader->at = (const unsigned char*)bytes;
  reader->end = reader->at + size;
  reader->error = 0;
  reader->number = 0;
}

static int fail(struct link_reader* reader, const char* error) {
  reader->error = error;
  return 0;
}

/* The members of a row between `at` and `end`; false: they do not fit it. */
static int take(const char* members, const unsigned char* at, const unsigned char* end, struct link_record* record) {
  int ints = 0, reals = 0, texts = 0, lists = 0;
  for (; *members; members++) {
    int64_t value;
    if (end - at < 8) return 0;
    memcpy(&value, at, 8);
    if (*members == 'f') {
      memcpy(&record->reals[reals++], at, 8);
      at += 8;
      continue;
    }
    at += 8;
    if (*members == 'i') {
      record->ints[ints++] = value;
    } else if (*members == 's') {
      if (value < 0 || value > end - at || ((value + 7) & ~(int64_t)7) > end - at) return 0;
      record->texts[texts].bytes = (const char*)at;
      record->texts[texts++].size = (size_t)value;
      at += (value + 7) & ~(int64_t)7;
    } else {
      if (value < 0 || value > (end - at) / 8) return 0;
      record->lists[lists].values = (const double*)(const void*)at;
      record->lists[lists++].count = (size_t)value;
      at += value * 8;
    }
  }
  return at == end;
}

int link_next(struct link_reader* reader, struct link_record* record) {
  uint32_t head[2];
  const struct link_row* row;
  if (reader->error || reader->at == reader->end) return 0;
  if (reader->end - reader->at < HEAD) return fail(reader, "got a packet that ends within a record");
  memcpy(head, reader->at, HEAD);
  reader->number = (int)head[0];
  if (head[1] % 8 != 0 || head[1] > (size_t)(reader->end - reader->at - HEAD))
    return fail(reader, "got a record that is longer than its packet");
  row = link_row_of(reader->number);
  if (!row) return fail(reader, "got a record of a number that this version does not have");
  if (!take(row->members, reader->at + HEAD, reader->at + HEAD + head[1], record))
    return fail(reader, "got a record whose members are not those of its number");
  record->number = row->number;
  reader->at += HEAD + head[1];
  return 1;
}
