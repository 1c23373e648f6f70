/* SPDX-License-Identifier: MIT
 * What main.c calls.
 */
int clamp(int value, int limit);
unsigned int next_random(unsigned int seed);
long weighted(const int* from);           /* sum of 8 products */
int smallest(const int* from, int count); /* its place */
void sort_some(int* from, int count);
