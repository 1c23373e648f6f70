/* SPDX-License-Identifier: MIT
 * --sanitize: what a program calls only to be heard (dspic30/memory/host_places.h). Whoever looks after its memory
 * knows where these begin. */
void tp_checked_local(void *at, unsigned int bytes, const char *name) {}
void tp_checked_add_overflow(void) {}
void tp_checked_sub_overflow(void) {}
void tp_checked_mul_overflow(void) {}
void tp_checked_divrem_overflow(void) {}
void tp_checked_negate_overflow(void) {}
void tp_checked_shift_out_of_bounds(void) {}
void tp_checked_out_of_bounds(void) {}
