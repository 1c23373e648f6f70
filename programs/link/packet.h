/* SPDX-License-Identifier: MIT
 * Packets of the link between a program of the PC and the simulator, for both ends (C and C++).
 *
 *   packet = records;  record = u32 number, u32 bytes of its members, members;  all little endian
 *   member = i: i64   f: f64   s: i64 bytes, bytes, zeros up to 8   F: i64 how many, f64 each
 *
 * A packet is one message of a socket of kind SOCK_SEQPACKET, at most LINK_MOST_BYTES long. The records and
 * their members are the table messages.def. Nothing here blocks, allocates (but a packet's growing) or keeps
 * state.
 */
#ifndef PROGRAMS_LINK_PACKET_H
#define PROGRAMS_LINK_PACKET_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LINK_VERSION 2
#define LINK_MOST_BYTES 131072 /* a packet; half of what a socket of Linux takes by default */
#define LINK_FLUSH_BYTES \
  65536 /* a program that has said so much sends it, and goes on with the next packet */

#define LINK_RECORD(number, name, who, members, what, text) LINK_##name = number,
enum link_record_number {
#include "programs/link/messages.def"
};
#undef LINK_RECORD

enum link_who { LINK_FROM_PROGRAM, LINK_FROM_ASKS, LINK_FROM_SIMULATOR };

/** A row of the table. */
struct link_row {
  int number;
  const char* name;
  enum link_who who;
  const char* members; /* i, f, s, F */
  const char* what;    /* what they are, between semicolons */
  const char* text;    /* what it says */
};
/** The row of a number; null: there is none. */
const struct link_row* link_row_of(int number);
/** All rows, and how many. */
const struct link_row* link_rows(size_t* count);

/* --- writing */

/** A packet that is being written. Begin with zeros; link_free() in the end. Out of memory ends the process.
 */
struct link_packet {
  unsigned char* bytes;
  size_t size, capacity;
  size_t record; /* where the last record begins */
};

/** Begins a record; its members follow in their order, then link_end(). */
void link_begin(struct link_packet* packet, int number);
void link_int(struct link_packet* packet, int64_t value);
void link_number(struct link_packet* packet, double value);
void link_bytes(struct link_packet* packet, const void* bytes, size_t size);
void link_text(struct link_packet* packet, const char* text); /* null: empty */
void link_numbers(struct link_packet* packet, const double* values, size_t count);
void link_end(struct link_packet* packet);
/** All records of another packet, as they are. */
void link_append(struct link_packet* packet, const struct link_packet* from);
/** Nothing is in it any more. */
void link_clear(struct link_packet* packet);
void link_free(struct link_packet* packet);

/* --- reading */

#define LINK_MOST_MEMBERS 8 /* of one kind in a record */

/** A record as it was read: members by kind, each counted from 0 in their order. They point into the packet.
 */
struct link_record {
  int number;
  int64_t ints[LINK_MOST_MEMBERS];
  double reals[LINK_MOST_MEMBERS];
  struct {
    const char* bytes; /* not ended by 0 */
    size_t size;
  } texts[LINK_MOST_MEMBERS];
  struct {
    const double* values;
    size_t count;
  } lists[2];
};

/** Where reading has come to. */
struct link_reader {
  const unsigned char* at;
  const unsigned char* end;
  const char* error; /* what was wrong, null: nothing; a static text */
  int number;        /* of the record that was wrong */
};

/** Begins; `bytes` are aligned to 8. */
void link_read(struct link_reader* reader, const void* bytes, size_t size);
/** The next record. 1: there was one; 0: the end, or error is set. Every record that is handed out has the
 * members of its row; numbers may be anything, NaN included. */
int link_next(struct link_reader* reader, struct link_record* record);

#ifdef __cplusplus
}
#endif
#endif
